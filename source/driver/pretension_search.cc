// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/numerical_failure.h>
#include <hpvi/base/text.h>
#include <hpvi/driver/pretension_search.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr unsigned int most_solutions = 60; ///< on one mesh

/** Over the step that a bolt between rigid walls would take: a part that only tilts on a seat gives way thousands of times as far. */
constexpr double longest = 1e5;

/** Of a force, as long as the quadratic program has no larger error of its own. */
constexpr double smallest_tolerance = 1e-11;
} // namespace

PretensionSearch::PretensionSearch(const Scene<2> &scene, const Vector<double> &learnt)
    : tolerance(std::max(smallest_tolerance, 10 * scene.solver.qp_tolerance)),
      slopes(IdentityMatrix(scene.pretensions.size()))
{
  for (const Pretension<2> &cut : scene.pretensions)
  {
    stiffness.push_back(layer_stiffness(scene, cut));
    wanted.push_back(cut.force / scene.thickness);
  }
  const unsigned int n = wanted.size();
  for (unsigned int i = 0; i < n && learnt.size() == n * n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      slopes(i, j) = learnt[n * i + j];
}

std::vector<double> PretensionSearch::learnt() const
{
  std::vector<double> result;
  for (unsigned int i = 0; i < slopes.m(); ++i)
    for (unsigned int j = 0; j < slopes.n(); ++j)
      result.push_back(slopes(i, j));
  return result;
}

std::vector<double> PretensionSearch::first() const
{
  std::vector<double> result;
  for (unsigned int k = 0; k < wanted.size(); ++k)
    result.push_back(wanted[k] / stiffness[k]);
  return result;
}

void PretensionSearch::begin()
{
  n_solutions = 0;
}

/** The update of Broyden, Fletcher, Goldfarb and Shanno: slopes along @p dx are those seen there, @p dg over it. */
void PretensionSearch::learn(const Vector<double> &dx, const Vector<double> &dg)
{
  const unsigned int n = dx.size();
  Vector<double> was(n);
  slopes.vmult(was, dx);
  const double seen = dg * dx, known = was * dx;
  if (!(seen > 1e-12 * dx.norm_sqr()) || !(known > 0)) // nothing holds the bolts
    return;
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      slopes(i, j) += dg[i] * dg[j] / seen - was[i] * was[j] / known;
}

/** Newton's, with the slopes that are known; where these say nothing, as if they were those of the layers. */
Vector<double> PretensionSearch::step()
{
  FullMatrix<double> inverse(slopes);
  inverse.gauss_jordan();
  Vector<double> step(x.size());
  inverse.vmult(step, g);
  step *= -1.;
  // Slopes are no more than the layer's: a step that goes uphill, or is long, knows only a kink.
  if (!(step * g < 0) || step.l2_norm() > longest * g.l2_norm())
  {
    slopes = IdentityMatrix(x.size());
    step.equ(-1., g);
  }
  return step;
}

std::vector<double> PretensionSearch::next(const Scene<2> &scene, const std::vector<double> &forces)
{
  const unsigned int n = wanted.size();
  Vector<double> here(n), g_here(n);
  unsigned int worst = 0;
  const auto miss = [&](const unsigned int k) { return std::abs(forces[k] / wanted[k] - 1); };
  for (unsigned int k = 0; k < n; ++k)
  {
    here[k] = std::sqrt(stiffness[k]) * scene.pretensions[k].shortening;
    g_here[k] = (forces[k] - wanted[k]) / std::sqrt(stiffness[k]);
    if (!(miss(k) <= miss(worst)))
      worst = k;
  }
  if (n_solutions > 0)
  {
    Vector<double> dx(here), dg(g_here);
    dx -= x;
    dg -= g;
    learn(dx, dg);
  }
  if (miss(worst) <= tolerance)
    return {};
  if (++n_solutions == most_solutions || !std::isfinite(g_here.l2_norm()))
    throw NumericalFailure("the force of Pretension " + scene.pretensions[worst].name + " is " +
                           to_string(forces[worst] * scene.thickness) + " for a shortening of " +
                           to_string(scene.pretensions[worst].shortening) + " after " +
                           std::to_string(n_solutions) +
                           " solutions; see that something holds both ends of the bolt, that no "
                           "other Pretension cuts it, or give a smaller Force");
  x = here;
  g = g_here;
  here += step();
  std::vector<double> result;
  for (unsigned int k = 0; k < n; ++k)
    result.push_back(here[k] / std::sqrt(stiffness[k]));
  return result;
}
} // namespace hpvi
