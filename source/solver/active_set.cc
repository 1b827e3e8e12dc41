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
/** Which components are held: -1 at the lower wall, 1 at the upper, 0 free. */
using Prediction = std::vector<signed char>;

/** Newton's method ends after a dozen steps or not at all. */
constexpr unsigned int maximum_steps = 50;

/** One run of the method. */
class Newton
{
public:
  Newton(const QuadraticProgram &qp, const Mprgp::Settings &settings, Vector<double> &z)
      : qp(qp), box(qp.feasible_set), settings(settings), z(z), r(z.size()),
        scale(diagonal_scale(qp.S))
  {
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
    std::set<Prediction> known;
    double last = std::numeric_limits<double>::infinity();
    for (Prediction next = predict(); known.insert(next).second; next = predict())
    {
      if (known.size() > maximum_steps || !follow(next))
        break;
      const double gradient = projected_gradient();
      if (gradient <= settings.tolerance && gradient > 0.5 * last)
        break;
      last = gradient;
    }
    report.projected_gradient = projected_gradient();
    report.converged = report.projected_gradient <= settings.tolerance;
    box.project(z); // the iterate of a prediction that was wrong may lie outside
    return report;
  }

private:
  Prediction predict() const;
  bool follow(const Prediction &prediction);
  bool solve_for(const std::vector<unsigned int> &free);
  double projected_gradient();

  void compute_gradient(const Vector<double> &x);
  double norm(Vector<double> x) const;

  const QuadraticProgram &qp;
  const FeasibleSet &box;
  const Mprgp::Settings &settings;
  Vector<double> &z;
  Vector<double> r; ///< gradient S z - d
  const Vector<double> scale;
  double reference = 0; ///< as in Mprgp
  QpReport report;
};

Prediction Newton::predict() const
{
  Prediction result(z.size(), 0);
  for (unsigned int i = 0; i < z.size(); ++i)
  {
    const double target = z[i] - r[i] * scale[i] * scale[i];
    if (target > box.upper()[i])
      result[i] = 1;
    else if (target < box.lower()[i] || box.lower()[i] == box.upper()[i])
      result[i] = -1;
  }
  return result;
}

bool Newton::follow(const Prediction &prediction)
{
  std::vector<unsigned int> free;
  for (unsigned int i = 0; i < z.size(); ++i)
    if (prediction[i] == 0)
      free.push_back(i);
    else
      z[i] = prediction[i] > 0 ? box.upper()[i] : box.lower()[i];
  compute_gradient(z);
  if (!solve_for(free))
    return false;
  compute_gradient(z);
  return true;
}

/** `z_F := z_F - S_FF^-1 r_F`. */
bool Newton::solve_for(const std::vector<unsigned int> &free)
{
  const types::blas_int n = free.size(), one = 1;
  if (n == 0)
    return true;
  std::vector<double> matrix(free.size() * free.size()), change(free.size());
  for (unsigned int j = 0; j < free.size(); ++j)
  {
    for (unsigned int i = j; i < free.size(); ++i)
      matrix[i + j * free.size()] = qp.S(free[i], free[j]);
    change[j] = r[free[j]];
  }
  types::blas_int info = 0;
  potrf("L", &n, matrix.data(), &n, &info);
  ++report.dense_solves;
  if (info != 0)
    return false;
  potrs("L", &n, &one, matrix.data(), &n, change.data(), &n, &info);
  for (unsigned int j = 0; j < free.size(); ++j)
    z[free[j]] -= change[j];
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

/** `|nu|` as Mprgp reports it, at the point of the box nearest to z. */
double Newton::projected_gradient()
{
  Vector<double> nearest(z), phi, beta;
  box.project(nearest);
  const Vector<double> gradient(r);
  if (nearest != z)
    compute_gradient(nearest);
  box.split_gradient(nearest, r, phi, beta);
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
