// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/solvers/nearest_force.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace hpvi
{
using namespace dealii;

namespace
{
/** How near to e is e. */
constexpr double round_off_of_force = 1e-13;

/**
 * The resultant nearest to e by Wolfe's algorithm ("Finding the nearest point in a polytope", Math.
 * Programming 11, 1976), with rays beside points: the nearest point of what a few extremes span is moved
 * by one more extreme at a time, and those that lose their weight are dropped. Finite for polyhedra.
 */
class Nearest
{
public:
  Nearest(const ForceSet &set, const Force &e);

  Force residual; ///< e less the nearest point

private:
  struct Corner
  {
    ForceSet::Extreme extreme;
    double weight;
  };

  bool add_corner();
  void minimise();
  std::vector<double> minimise_on_span();
  bool shorten(const std::vector<double> &weights);

  const ForceSet &set;
  const Force &e;
  std::vector<Corner> corners; ///< affinely independent, at least one of them a point
};

Nearest::Nearest(const ForceSet &set, const Force &e) : set(set), e(e)
{
  corners.push_back({{set.start(), false}, 1.});
  minimise();
  // Many more than ever seen.
  for (unsigned int steps_left = 10000; steps_left > 0; --steps_left)
    if (residual.norm() <= round_off_of_force * e.norm() || !add_corner())
      return;
}

/** False if no extreme lies nearer to e. */
bool Nearest::add_corner()
{
  const double distance = residual.norm();
  const ForceSet::Extreme extreme = set.farthest(residual);
  if (!extreme.is_ray)
  {
    const double gain = residual * (extreme.place - e) + distance * distance,
                 size = std::max(extreme.place.norm(), e.norm());
    if (gain <= distance * std::max(1e-9 * distance, 1e-15 * size))
      return false;
  }
  if (corners.size() > set.n_equations())
    return false; // their span is all there is: what remains is round-off
  corners.push_back({extreme, 0.});
  minimise();
  return residual.norm() < distance;
}

void Nearest::minimise()
{
  while (!shorten(minimise_on_span()))
    ;
}

/** Sets the residual of the nearest point of the affine span and returns that point's weights. */
std::vector<double> Nearest::minimise_on_span()
{
  const auto base = std::max_element(
      corners.begin(), corners.end(),
      [](const Corner &a, const Corner &b)
      { return (a.extreme.is_ray ? -1. : a.weight) < (b.extreme.is_ray ? -1. : b.weight); });
  residual = e - base->extreme.place;
  std::vector<Force> basis;
  std::vector<std::vector<double>> R; // columns of the triangle in edges = basis R
  std::vector<double> product(corners.size()), weights(corners.size());
  for (const Corner &corner : corners)
  {
    if (&corner == &*base)
      continue;
    Force edge = corner.extreme.place - (corner.extreme.is_ray ? Force() : base->extreme.place);
    std::vector<double> column(basis.size() + 1);
    for (int pass = 0; pass < 2; ++pass) // the second removes the round-off of the first
      for (unsigned int k = 0; k < basis.size(); ++k)
      {
        const double part = basis[k] * edge;
        column[k] += part;
        edge -= part * basis[k];
      }
    column.back() = edge.norm();
    basis.push_back(column.back() > 0. ? edge / column.back() : edge);
    R.push_back(column);
  }
  for (int pass = 0; pass < 3; ++pass)
    for (unsigned int k = 0; k < basis.size(); ++k)
    {
      const double part = basis[k] * residual;
      product[k] += part;
      residual -= part * basis[k];
    }
  weights[base - corners.begin()] = 1.;
  for (unsigned int k = basis.size(), i = corners.size(); k-- > 0;)
  {
    do
      --i;
    while (&corners[i] == &*base);
    weights[i] = R[k].back() > 0. ? product[k] / R[k].back() : 0.;
    for (unsigned int l = 0; l < k; ++l)
      product[l] -= weights[i] * R[k][l];
    if (!corners[i].extreme.is_ray)
      weights[base - corners.begin()] -= weights[i];
  }
  return weights;
}

/** Go towards @p weights as far as all stay positive. True if that is all the way. */
bool Nearest::shorten(const std::vector<double> &weights)
{
  double part = 1.;
  unsigned int blocking = corners.size();
  for (unsigned int k = 0; k < corners.size(); ++k)
    if (weights[k] <= 0. && corners[k].weight <= part * (corners[k].weight - weights[k]))
    {
      part = corners[k].weight - weights[k] > 0.
                 ? corners[k].weight / (corners[k].weight - weights[k])
                 : 0.;
      blocking = k;
    }
  for (unsigned int k = 0; k < corners.size(); ++k)
    corners[k].weight += part * (weights[k] - corners[k].weight);
  if (blocking == corners.size())
    return true;
  corners.erase(corners.begin() + blocking);
  return false;
}
} // namespace

std::optional<Separation> separate(const ForceSet &set, const Force &e, const double negligible)
{
  const Force motion = Nearest(set, e).residual;
  if (motion.norm() == 0.)
    return {};
  const ForceSet::Extreme extreme = set.farthest(motion);
  const double load = motion * e, resistance = motion * extreme.place;
  if (extreme.is_ray || !(load - resistance > negligible * motion.norm() * e.norm()))
    return {};
  return Separation{motion, load, resistance};
}
} // namespace hpvi
