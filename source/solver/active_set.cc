// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/lac/lapack_templates.h>
#include <hpvi/solver/active_set.h>

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

/** One run of the method. */
class Newton
{
public:
  Newton(const QuadraticProgram &qp, const Mprgp::Settings &settings, Vector<double> &z)
      : qp(qp), settings(settings), z(z), r(z.size()), scale(diagonal_scale(qp.S)), step(z.size())
  {
    qp.feasible_set.make_isotropic(scale);
    for (unsigned int i = 0; i < step.size(); ++i)
      step[i] = scale[i] * scale[i];
    qp.S.vmult(r, z);
    ++report.multiplications;
    reference = std::max(norm(r), norm(qp.d));
    r -= qp.d;
  }

  /**
   * Until a prediction stays, comes again, or cannot be followed; or, where round-off keeps changing
   * it or a rim is followed by its tangents, until the gradient is small enough and falls no more.
   */
  QpReport run()
  {
    std::set<std::vector<signed char>> known;
    double last = std::numeric_limits<double>::infinity();
    for (unsigned int steps_left = maximum_steps; steps_left > 0; --steps_left)
    {
      const FeasibleSet::Linearisation next = qp.feasible_set.linearise(z, r, step);
      const bool is_new = known.insert(next.walls).second;
      if (!(is_new || next.curved) || !follow(next))
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
  bool solve_along(const std::vector<FeasibleSet::Direction> &directions);
  double product(const FeasibleSet::Direction &a, const FeasibleSet::Direction &b) const;
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

bool Newton::follow(const FeasibleSet::Linearisation &prediction)
{
  z = prediction.base;
  compute_gradient(z);
  if (!solve_along(prediction.directions))
    return false;
  compute_gradient(z);
  return true;
}

/** `z := z - Q (Q'SQ + C)^-1 Q'r`, Q the directions and C their curvatures. */
bool Newton::solve_along(const std::vector<FeasibleSet::Direction> &directions)
{
  const types::blas_int n = directions.size(), one = 1;
  if (n == 0)
    return true;
  std::vector<double> matrix(directions.size() * directions.size()), change(directions.size());
  for (unsigned int j = 0; j < directions.size(); ++j)
  {
    const FeasibleSet::Direction &q = directions[j];
    for (unsigned int i = j; i < directions.size(); ++i)
      matrix[i + j * directions.size()] = product(directions[i], q);
    matrix[j + j * directions.size()] += q.curvature;
    for (unsigned int k = 0; k < q.size; ++k)
      change[j] += q.weights[k] * r[q.first + k];
  }
  types::blas_int info = 0;
  potrf("L", &n, matrix.data(), &n, &info);
  ++report.dense_solves;
  if (info != 0)
    return false;
  potrs("L", &n, &one, matrix.data(), &n, change.data(), &n, &info);
  for (unsigned int j = 0; j < directions.size(); ++j)
    for (unsigned int k = 0; k < directions[j].size; ++k)
      z[directions[j].first + k] -= directions[j].weights[k] * change[j];
  return true;
}

/** a'Sb. */
double Newton::product(const FeasibleSet::Direction &a, const FeasibleSet::Direction &b) const
{
  double sum = 0;
  for (unsigned int i = 0; i < a.size; ++i)
    for (unsigned int j = 0; j < b.size; ++j)
      sum += a.weights[i] * qp.S(a.first + i, b.first + j) * b.weights[j];
  return sum;
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
