// SPDX-License-Identifier: LGPL-2.1-or-later

// The unknowns of friction and pressure are bounded: an interval $[-g, g]$ for friction in the
// plane, a half line for a pressure. All solvers work with any product of such sets, and this is the
// only file that knows their shape: what is asked of it is below.
#include <deal.II/base/exceptions.h>
#include <hpvi/solvers/feasible_set.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace hpvi
{
using namespace dealii;

FeasibleSet::FeasibleSet(const Vector<double> &lower, const Vector<double> &upper)
{
  AssertThrow(lower.size() == upper.size(), ExcDimensionMismatch(lower.size(), upper.size()));
  for (unsigned int i = 0; i < lower.size(); ++i)
    add_interval(lower[i], upper[i]);
}

void FeasibleSet::add_interval(const double lower_side, const double upper_side)
{
  // Written so that NaN fails too.
  AssertThrow(lower_side <= upper_side && lower_side < infinity && upper_side > -infinity,
              ExcMessage("The interval [" + std::to_string(lower_side) + ", " +
                         std::to_string(upper_side) + "] of unknown " + std::to_string(size()) +
                         " is empty."));
  lower.push_back(lower_side);
  upper.push_back(upper_side);
}

double FeasibleSet::lower_side(const unsigned int i) const
{
  return lower[i];
}

double FeasibleSet::upper_side(const unsigned int i) const
{
  return upper[i];
}

unsigned int FeasibleSet::size() const
{
  return lower.size();
}

// @sect3{Projection}
//
// The nearest point of the set, component by component. Every iterate ends here.
void FeasibleSet::project(Vector<double> &z) const
{
  AssertDimension(z.size(), size());
  // Comparisons with NaN are false: it passes, and whoever iterates sees it in the gradient.
  for (unsigned int i = 0; i < size(); ++i)
    if (z[i] < lower[i])
      z[i] = lower[i];
    else if (z[i] > upper[i])
      z[i] = upper[i];
}

// @sect3{The farthest point}
//
// What friction and pressure can resist at most, along a motion of the body: the maximum of a
// linear function over the set. It decides whether there can be equilibrium.
bool FeasibleSet::farthest(const Vector<double> &direction, Vector<double> &z) const
{
  AssertDimension(direction.size(), size());
  z.reinit(size());
  for (unsigned int i = 0; i < size(); ++i)
    if (direction[i] != 0.)
      z[i] = std::copysign(infinity, direction[i]);
  project(z);
  if (std::all_of(z.begin(), z.end(), [](const double z_i) { return std::isfinite(z_i); }))
    return true;
  for (double &z_i : z)
    z_i = std::isfinite(z_i) ? 0. : std::copysign(1., z_i);
  return false;
}

// @sect3{The way to the next wall}
//
// How far a step along $-p$ may go.
double FeasibleSet::distance_to_wall(const Vector<double> &z, const Vector<double> &p) const
{
  AssertDimension(z.size(), size());
  AssertDimension(p.size(), size());
  double alpha = infinity;
  for (unsigned int i = 0; i < size(); ++i)
    if (p[i] > 0)
      alpha = std::min(alpha, (z[i] - lower[i]) / p[i]);
    else if (p[i] < 0)
      alpha = std::min(alpha, (z[i] - upper[i]) / p[i]);
  return alpha;
}

// @sect3{Free and chopped gradient}
//
// (5.8) and (5.9): $\varphi$ is the gradient on free components, $\beta$ that part of it which
// would pull components off their walls. Both vanish at the minimum and nowhere else.
void FeasibleSet::split_gradient(const Vector<double> &z, const Vector<double> &r,
                                 Vector<double> &phi, Vector<double> &beta) const
{
  AssertDimension(z.size(), size());
  AssertDimension(r.size(), size());
  phi.reinit(size());
  beta.reinit(size());
  for (unsigned int i = 0; i < size(); ++i)
  {
    const bool at_lower = z[i] <= lower[i];
    const bool at_upper = z[i] >= upper[i];
    if (!at_lower && !at_upper)
      phi[i] = r[i];
    else if (at_lower && !at_upper)
      beta[i] = std::min(r[i], 0.);
    else if (at_upper && !at_lower)
      beta[i] = std::max(r[i], 0.);
  }
}

// @sect3{Linearisation}
//
// For Newton's method. At the minimum $z = P(z - \alpha r)$, a fixed point of projected gradient
// steps; where such a step leaves the set tells which walls hold. The components at walls get the
// wall's value, the others are free.
FeasibleSet::Linearisation FeasibleSet::linearise(const Vector<double> &z, const Vector<double> &r,
                                                  const Vector<double> &step) const
{
  Linearisation result;
  result.walls.assign(size(), 0);
  result.base = z;
  for (unsigned int i = 0; i < size(); ++i)
  {
    const double target = z[i] - r[i] * step[i];
    if (target > upper[i])
    {
      result.walls[i] = 1;
      result.base[i] = upper[i];
    }
    else if (target < lower[i] || lower[i] == upper[i])
    {
      result.walls[i] = -1;
      result.base[i] = lower[i];
    }
    else
      result.free.push_back(i);
  }
  return result;
}

// @sect3{Scaling}
//
// Scaling by the diagonal of $S$ turns intervals into intervals.
FeasibleSet FeasibleSet::scaled(const Vector<double> &scale) const
{
  AssertDimension(scale.size(), size());
  FeasibleSet result = *this;
  for (unsigned int i = 0; i < size(); ++i)
  {
    Assert(scale[i] > 0, ExcMessage("A scale factor must be positive."));
    result.lower[i] /= scale[i];
    result.upper[i] /= scale[i];
  }
  return result;
}

void FeasibleSet::unscale(const Vector<double> &y, const Vector<double> &scale,
                          Vector<double> &z) const
{
  // Without this a slipping point could miss |z| = g by the rounding of 1/s * s.
  for (unsigned int i = 0; i < size(); ++i)
    if (y[i] == lower[i] / scale[i])
      z[i] = lower[i];
    else if (y[i] == upper[i] / scale[i])
      z[i] = upper[i];
    else
      z[i] = scale[i] * y[i];
  project(z);
}
} // namespace hpvi
