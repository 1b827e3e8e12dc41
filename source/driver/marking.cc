// SPDX-License-Identifier: LGPL-2.1-or-later

// The strategies of Chapter 5, and one of our own. All get the degrees, an indicator for each cell,
// and a function that gives the decay rate of a cell; all give a list of cells to bisect and a list
// of new degrees. A strategy is a case of a <code>switch</code>: none is longer than a few lines.
#include <hpvi/driver/marking.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hpvi
{
// @sect3{Helpers}
//
// Symmetric problems have equal indicators. Ties are broken by the index of the cell, so that a run
// gives the same meshes on every machine.
namespace
{
/** Cell indices by falling indicator, ties by index. */
std::vector<unsigned int> by_falling_indicator(const std::vector<double> &eta)
{
  std::vector<unsigned int> order(eta.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](const unsigned int a, const unsigned int b) { return eta[a] > eta[b]; });
  return order;
}

unsigned int share_of(const double fraction, const unsigned int n_cells)
{
  // Without the small number 0.1 * 30 would round up to 4.
  return std::min<unsigned int>(n_cells, std::ceil(fraction * n_cells - 1e-9));
}

// No degree exceeds the scene's limit; where $p$ would, the cell is bisected.
void raise_or_bisect(Refinement &refinement, const unsigned int cell, const unsigned int maximum)
{
  if (refinement.degrees[cell] < maximum)
    ++refinement.degrees[cell];
  else
    refinement.bisect[cell] = true;
}

void bisect_above_mean(Refinement &refinement, const std::vector<double> &eta,
                       const double threshold)
{
  const double mean = std::accumulate(eta.begin(), eta.end(), 0.) / eta.size();
  for (unsigned int cell = 0; cell < eta.size(); ++cell)
    refinement.bisect[cell] = eta[cell] > threshold * mean;
}

std::vector<unsigned int> above_share_of_maximum(const std::vector<double> &eta, const double share)
{
  const double largest = *std::max_element(eta.begin(), eta.end());
  std::vector<unsigned int> marked;
  for (unsigned int cell = 0; cell < eta.size(); ++cell)
    if (eta[cell] > share * largest)
      marked.push_back(cell);
  return marked;
}

// @sect3{The hp decision}
//
// Where the solution is smooth raising $p$ gains most for an unknown; where it is not, bisection
// isolates the place.
/** The decision of Section 4.3 on each marked cell. */
void raise_where_smooth(Refinement &refinement, const std::vector<unsigned int> &marked,
                        const std::function<double(unsigned int)> &decay_rate, const double smooth,
                        const unsigned int maximum)
{
  for (const unsigned int cell : marked)
    if (decay_rate(cell) > smooth)
      raise_or_bisect(refinement, cell, maximum);
    else
      refinement.bisect[cell] = true;
}
} // namespace

// @sect3{The strategies}
//
// hup and pu refine everything, by bisection or by degree. hap bisects cells above half of the mean
// indicator. hpa1 sorts cells, bisects the first tenth and raises the degree of the next, without a
// look at smoothness. hpa2 decides by smoothness on the fifth of the cells with the largest
// indicators. hpa3 does so on all cells above a share of the largest one: early, when few cells
// have nearly all of the error, it refines few of them, and late, when the error is spread evenly,
// many, which saves unknowns at the beginning and steps at the end.
Refinement mark(const Adaptivity &adaptivity, const Degrees &degrees,
                const std::vector<double> &eta,
                const std::function<double(unsigned int)> &decay_rate)
{
  const unsigned int n = degrees.size(), maximum = adaptivity.maximum_degree;
  Refinement result{std::vector<bool>(n, false), degrees};
  switch (adaptivity.method)
  {
  case Method::hup2:
  case Method::hup3:
  case Method::hup4:
    result.bisect.assign(n, true);
    break;
  case Method::hap2:
  case Method::hap3:
  case Method::hap4:
    bisect_above_mean(result, eta, adaptivity.hap_threshold);
    break;
  case Method::pu:
    for (unsigned int &degree : result.degrees)
      degree = std::min(degree + 1, maximum);
    break;
  case Method::hpa1:
  {
    const auto order = by_falling_indicator(eta);
    const unsigned int first = share_of(adaptivity.hpa1_bisected, n);
    const unsigned int last = std::min(n, first + share_of(adaptivity.hpa1_raised, n));
    for (unsigned int k = 0; k < first; ++k)
      result.bisect[order[k]] = true;
    for (unsigned int k = first; k < last; ++k)
      raise_or_bisect(result, order[k], maximum);
    break;
  }
  case Method::hpa2:
  {
    auto marked = by_falling_indicator(eta);
    marked.resize(share_of(adaptivity.hpa2_marked, n));
    raise_where_smooth(result, marked, decay_rate, adaptivity.hpa2_decay, maximum);
    break;
  }
  case Method::hpa3:
    raise_where_smooth(result, above_share_of_maximum(eta, adaptivity.hpa3_threshold), decay_rate,
                       adaptivity.hpa3_decay, maximum);
    break;
  case Method::hpa4: // stride()
    break;
  }
  return result;
}

// @sect3{When nothing is marked}
//
// The entry that a user may want to change then.
Stop nothing_marked(const Adaptivity &adaptivity)
{
  switch (adaptivity.method)
  {
  case Method::hap2:
  case Method::hap3:
  case Method::hap4:
    return Stop::hap_threshold;
  case Method::hpa1:
    return Stop::hpa1_bisected;
  case Method::hpa2:
    return Stop::hpa2_marked;
  case Method::hpa3:
    return Stop::hpa3_threshold;
  default:
    return Stop::maximum_degree;
  }
}
} // namespace hpvi
