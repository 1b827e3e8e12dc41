// SPDX-License-Identifier: LGPL-2.1-or-later

// The default solver of the quadratic program. The primal-dual active set strategy
// (Hinterm&uuml;ller, Ito and Kunisch 2002) predicts from a point and its gradient which walls
// hold, solves for the other components by one Cholesky factorisation, and looks again. It is
// Newton's method for $z = P(z - \alpha(Sz - d))$, and inherits its speed: a few factorisations,
// and fewer still from the step before, whatever the condition of $S$. It is not bound to converge.
// If a prediction comes again, it cycles, and MPRGP takes over from the point that was reached.
#include <hpvi/solvers/active_set.h>
#include <hpvi/solvers/newton_system.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Newton's method ends after a dozen steps or not at all. */
constexpr unsigned int maximum_steps = 50;

// @sect3{One run}
//
// All predictions are remembered. A new one is followed. One that is known ends the run: it is the
// last one if it is right, and the beginning of a cycle if it is not. Which of both is said by the
// same projected gradient that MPRGP uses, so that both solvers mean the same by their tolerance.
/** One run of the method. */
class Newton
{
public:
  Newton(const QuadraticProgram &qp, const Mprgp::Settings &settings, Vector<double> &z)
      : qp(qp), settings(settings), z(z), r(z.size()), scale(diagonal_scale(qp.S)), step(z.size())
  {
    for (unsigned int i = 0; i < step.size(); ++i)
      step[i] = scale[i] * scale[i];
    qp.S.vmult(r, z);
    ++report.multiplications;
    reference = std::max(norm(r), norm(qp.d));
    r -= qp.d;
  }

  /**
   * Until a prediction stays, comes again, or cannot be followed; or, where round-off keeps changing
   * it, until the gradient is small enough and falls no more.
   */
  QpReport run()
  {
    std::set<std::vector<signed char>> known;
    double last = std::numeric_limits<double>::infinity();
    for (unsigned int steps_left = maximum_steps; steps_left > 0; --steps_left)
    {
      const FeasibleSet::Linearisation next = qp.feasible_set.linearise(z, r, step);
      if (!known.insert(next.walls).second || !follow(next))
        break;
      const double gradient = projected_gradient();
      if (gradient <= settings.tolerance && gradient > 0.5 * last)
        break;
      last = gradient;
    }
    report.projected_gradient = projected_gradient();
    report.converged = report.projected_gradient <= settings.tolerance;
    qp.feasible_set.project(z); // the iterate of a prediction that was wrong may lie outside
    return report;
  }

private:
  bool follow(const FeasibleSet::Linearisation &prediction);
  double projected_gradient();

  void compute_gradient(const Vector<double> &x);
  double norm(Vector<double> x) const;

  const QuadraticProgram &qp;
  const Mprgp::Settings &settings;
  Vector<double> &z;
  Vector<double> r;           ///< gradient S z - d
  Vector<double> scale, step; ///< of components, and its squares
  double reference = 0;       ///< as in Mprgp
  QpReport report;
};

// @sect3{One step}
//
// Components at walls are put there, exactly; the rest solves a smaller linear system.
bool Newton::follow(const FeasibleSet::Linearisation &prediction)
{
  z = prediction.base;
  compute_gradient(z);
  const NewtonSystem system(qp.S, prediction.free);
  report.dense_solves += !prediction.free.empty();
  if (!system.is_positive_definite())
    return false;
  z -= system.solve(r);
  compute_gradient(z);
  return true;
}

void Newton::compute_gradient(const Vector<double> &x)
{
  qp.S.vmult(r, x);
  ++report.multiplications;
  r -= qp.d;
}

/** `|x|` of a gradient in the variables in which Mprgp would iterate. */
double Newton::norm(Vector<double> x) const
{
  if (settings.diagonal_scaling)
    x.scale(scale);
  return x.l2_norm();
}

// @sect3{The measure}
//
// The iterate of a wrong prediction may lie outside the set. Measured is the nearest point inside.
/** `|nu|` as Mprgp reports it, at the point of the box nearest to z. */
double Newton::projected_gradient()
{
  Vector<double> nearest(z), phi, beta;
  qp.feasible_set.project(nearest);
  const Vector<double> gradient(r);
  if (nearest != z)
    compute_gradient(nearest);
  qp.feasible_set.split_gradient(nearest, r, phi, beta);
  r = gradient;
  const double nu = std::hypot(norm(phi), norm(beta));
  return nu == 0. ? 0. : nu / reference;
}
} // namespace

// @sect3{With MPRGP behind it}
//
// Speed from the one, safety from the other.
ActiveSet::ActiveSet(const Mprgp::Settings &settings) : settings(settings)
{
}

QpReport ActiveSet::solve(const QuadraticProgram &qp, Vector<double> &z) const
{
  qp.assert_size(z);
  QpReport report;
  report.converged = z.size() == 0;
  if (report.converged)
    return report;
  qp.feasible_set.project(z);
  const Vector<double> start(z);
  report = Newton(qp, settings, z).run();
  if (report.converged)
    return report;

  if (!std::isfinite(report.projected_gradient))
    z = start;
  QpReport rest = Mprgp(settings).solve(qp, z);
  rest.multiplications += report.multiplications;
  rest.dense_solves = report.dense_solves;
  rest.fell_back = true;
  return rest;
}
} // namespace hpvi
