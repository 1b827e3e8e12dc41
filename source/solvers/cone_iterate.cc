// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/solvers/cone_iterate.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr double cancellation = 1e-15; ///< of terms that cancel
} // namespace

ConeIterate::ConeIterate(const ConeProgram &program, const Mprgp::Settings &settings,
                         const Vector<double> &z, const Vector<double> &alpha)
    : program(program), settings(settings), set(&program.set), scale(diagonal_scale(program.S)),
      L(root_of(program.penalty)),
      step(scale), point{z, alpha, Vector<double>(z.size())}, best{z, alpha, {}},
      noise(noise_of(program.d, scale))
{
  step.scale(scale);
  program.S.vmult(point.r, z);
  reference = std::max(norm(point.r), norm(program.d));
  point.r = gradient(z);
}

Vector<double> ConeIterate::gradient(const Vector<double> &x)
{
  Vector<double> result(x.size());
  program.S.vmult(result, x);
  ++cost.multiplications;
  result -= program.d;
  if (point.alpha.size() > 0)
    result -= program.balance.along(point.alpha);
  return result;
}

Vector<double> ConeIterate::target() const
{
  Vector<double> result(point.r);
  result.scale(step);
  result.sadd(-1., 1., point.z);
  set->fixed.project(result);
  return result;
}

Vector<double> ConeIterate::gap(const Vector<double> &x) const
{
  Vector<double> result(point.alpha.size());
  if (result.size() > 0)
    L.Tvmult(result, program.balance.gap(x));
  return result;
}

/**
 * Along the tangent the residual is what a step along the gradient does, within the cone: where pressure is
 * nothing but round-off, so is what it lets slip.
 */
double ConeIterate::measure()
{
  Vector<double> nearest(point.z), phi, beta;
  set->fixed.project(nearest);
  const FeasibleSet own = set->at(nearest);
  own.project(nearest);
  for (const auto &[t, normal, friction] : set->cones)
    if (friction.relative) // a tangent meets its curve to round-off
      if (const double bound = friction.limit(nearest[normal]);
          std::abs(nearest[t]) > (1. - settings.tolerance) * bound)
        nearest[t] = std::copysign(bound, nearest[t]);
  const Vector<double> slope = nearest == point.z ? point.r : gradient(nearest);
  own.split_gradient(nearest, slope, phi, beta);
  for (const FrictionCones::Cone &cone : set->cones)
  {
    const unsigned int t = cone.tangential;
    const double bound = cone.friction.limit(nearest[cone.normal]),
                 moved = nearest[t] - step[t] * slope[t];
    phi[t] = std::isnan(moved) ? moved : (nearest[t] - std::clamp(moved, -bound, bound)) / step[t];
    beta[t] = 0.;
  }
  const double nu = std::hypot(norm(phi), norm(beta)),
               gap = program.balance.imbalance(nearest, noise, balance_noise * settings.tolerance),
               cancelled = cancellation / settings.tolerance * sizes_of_terms(nearest),
               residual = std::max(nu == 0. ? 0. : nu / std::max(reference, cancelled),
                                   gap / balance_noise);
  if (set == &program.set && residual < residual_of_best)
  {
    best = {nearest, point.alpha, {}};
    residual_of_best = residual;
  }
  return residual;
}

double ConeIterate::merit() const
{
  Vector<double> nearest = target();
  set->at(nearest).project(nearest);
  double squares = 0;
  for (unsigned int i = 0; i < nearest.size(); ++i)
    squares += std::pow((point.z[i] - nearest[i]) / scale[i], 2);
  if (point.alpha.size() > 0)
    squares += gap(point.z).norm_sqr();
  return std::sqrt(squares);
}

void ConeIterate::halve_step(const Point &old)
{
  point.z.sadd(0.5, 0.5, old.z);
  point.r.sadd(0.5, 0.5, old.r);
  if (point.alpha.size() > 0)
    point.alpha.sadd(0.5, 0.5, old.alpha);
}

/** `|x|` of a gradient in the variables in which Mprgp would iterate. */
double ConeIterate::norm(Vector<double> x) const
{
  if (settings.diagonal_scaling)
    x.scale(scale);
  return x.l2_norm();
}

/** `|diag(S) x|` likewise: of the terms that cancel in a gradient. */
double ConeIterate::sizes_of_terms(const Vector<double> &x) const
{
  Vector<double> terms(x.size());
  for (unsigned int i = 0; i < x.size(); ++i)
    terms[i] = program.S(i, i) * x[i];
  return norm(terms);
}
} // namespace hpvi
