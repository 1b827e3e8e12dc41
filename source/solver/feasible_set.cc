// SPDX-License-Identifier: LGPL-2.1-or-later

// The unknowns of friction and pressure are bounded: an interval $[-g, g]$ for friction in the
// plane, a half line for a pressure, a disc $|z| \le g$ for friction in space. All solvers work
// with any product of such sets, and this is the only file that knows their shape. Another law of
// friction is another shape: what is asked of it is below.
#include <deal.II/base/exceptions.h>
#include <hpvi/solver/feasible_set.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr double infinity = std::numeric_limits<double>::infinity();

/** A direction that makes no larger angle with the rim goes along it, up to round-off. */
constexpr double along_the_rim = 1e-8;

/** What projection leaves between a point and the rim. */
bool is_on_rim(const double norm, const double radius)
{
  return norm >= radius * (1 - 4 * std::numeric_limits<double>::epsilon());
}
} // namespace

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

void FeasibleSet::add_disc(const double radius)
{
  AssertThrow(radius >= 0, ExcMessage("The disc of radius " + std::to_string(radius) +
                                      " of unknown " + std::to_string(size()) + " is empty."));
  discs.push_back({size(), radius});
  lower.insert(lower.end(), 2, -infinity);
  upper.insert(upper.end(), 2, infinity);
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
// The nearest point of the set, component by component, disc by disc. Every iterate ends here.
void FeasibleSet::project(Vector<double> &z) const
{
  AssertDimension(z.size(), size());
  // Comparisons with NaN are false: it passes, and whoever iterates sees it in the gradient.
  for (unsigned int i = 0; i < size(); ++i)
    if (z[i] < lower[i])
      z[i] = lower[i];
    else if (z[i] > upper[i])
      z[i] = upper[i];
  for (const Disc &disc : discs)
  {
    const double norm = std::hypot(z[disc.first], z[disc.first + 1]);
    if (norm > disc.radius)
      for (const unsigned int i : {disc.first, disc.first + 1})
        z[i] *= disc.radius / norm;
  }
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
  for (const Disc &disc : discs)
  {
    const unsigned int x = disc.first, y = x + 1;
    const double norm = std::hypot(direction[x], direction[y]);
    for (const unsigned int i : {x, y})
      z[i] = norm > 0. ? disc.radius * direction[i] / norm : 0.;
  }
  project(z);
  if (std::all_of(z.begin(), z.end(), [](const double z_i) { return std::isfinite(z_i); }))
    return true;
  for (double &z_i : z)
    z_i = std::isfinite(z_i) ? 0. : std::copysign(1., z_i);
  return false;
}

// @sect3{The way to the next wall}
//
// How far a step along $-p$ may go. For a disc that is the root of a quadratic equation, written so
// that nothing cancels near the rim.
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
  for (const Disc &disc : discs)
  {
    // The larger root of |z - alpha p|^2 = radius^2; from the rim along it no step stays inside.
    const double zx = z[disc.first], zy = z[disc.first + 1], px = p[disc.first],
                 py = p[disc.first + 1];
    const double square = px * px + py * py, product = zx * px + zy * py, norm = std::hypot(zx, zy);
    if (square == 0.)
      continue;
    if (is_on_rim(norm, disc.radius) && product <= along_the_rim * norm * std::sqrt(square))
      alpha = 0.;
    else
      alpha = std::min(alpha, (product + std::sqrt(std::max(0., product * product +
                                                                    square * (disc.radius - norm) *
                                                                        (disc.radius + norm)))) /
                                  square);
  }
  return alpha;
}

// @sect3{Free and chopped gradient}
//
// (5.8) and (5.9): $\varphi$ is the gradient on free components, $\beta$ that part of it which
// would pull components off their walls. Both vanish at the minimum and nowhere else. On the rim of
// a disc the gradient along the rim counts as chopped, as no straight line follows a rim.
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
  for (const Disc &disc : discs)
  {
    const unsigned int x = disc.first, y = x + 1;
    const double norm = std::hypot(z[x], z[y]);
    if (!is_on_rim(norm, disc.radius))
      continue;
    phi[x] = phi[y] = 0.;
    if (disc.radius == 0.)
      continue;
    const double n_x = z[x] / norm, n_y = z[y] / norm,
                 outward = std::min(n_x * r[x] + n_y * r[y], 0.);
    beta[x] = r[x] - outward * n_x;
    beta[y] = r[y] - outward * n_y;
  }
}

// @sect3{Linearisation}
//
// For Newton's method. At the minimum $z = P(z - \alpha r)$, a fixed point of projected gradient
// steps; where such a step leaves the set tells which walls hold. The components at walls get the
// wall's value, the others are free. On a rim the point may still move along the tangent, with a
// curvature that comes from the pressure against it.
FeasibleSet::Linearisation FeasibleSet::linearise(const Vector<double> &z, const Vector<double> &r,
                                                  const Vector<double> &step) const
{
  Linearisation result;
  result.walls.assign(size(), 0);
  result.base = z;
  const auto let_go = [&](const unsigned int i) {
    result.directions.push_back({i, 1, {{1., 0.}}, 0.});
  };
  auto disc = discs.begin();
  for (unsigned int i = 0; i < size(); ++i)
  {
    const double target = z[i] - r[i] * step[i];
    if (disc != discs.end() && disc->first == i)
    {
      const double other = z[i + 1] - r[i + 1] * step[i + 1], norm = std::hypot(target, other);
      if (norm <= disc->radius)
      {
        let_go(i);
        let_go(i + 1);
      }
      else
      {
        const double n_x = target / norm, n_y = other / norm;
        result.walls[i] = result.walls[i + 1] = 1;
        result.base[i] = disc->radius * n_x;
        result.base[i + 1] = disc->radius * n_y;
        if (disc->radius > 0.)
        {
          const double pressure = std::max(0., -(n_x * r[i] + n_y * r[i + 1]));
          result.directions.push_back({i, 2, {{-n_y, n_x}}, pressure / disc->radius});
          result.curved = true;
        }
      }
      ++disc;
      ++i;
    }
    else if (target > upper[i])
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
      let_go(i);
  }
  return result;
}

// @sect3{Scaling}
//
// Scaling by the diagonal of $S$ turns intervals into intervals. A disc stays a disc only if its
// two components are scaled alike.
void FeasibleSet::make_isotropic(Vector<double> &scale) const
{
  for (const Disc &disc : discs)
    scale[disc.first] = scale[disc.first + 1] = std::min(scale[disc.first], scale[disc.first + 1]);
}

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
  for (Disc &disc : result.discs)
  {
    Assert(scale[disc.first] == scale[disc.first + 1],
           ExcMessage("A disc that is scaled must stay a disc."));
    disc.radius /= scale[disc.first];
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
