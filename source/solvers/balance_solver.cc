// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/lac/lapack_templates.h>
#include <hpvi/solvers/balance_solver.h>
#include <hpvi/solvers/newton_system.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr unsigned int maximum_predictions = 50; ///< as in ActiveSet
constexpr unsigned int maximum_minimisations = 200;
constexpr double flat = 1e-12; ///< relative curvature of phi that is round-off

/** One run of the method. */
class Balance
{
public:
  Balance(const BalanceSolver::Inner &inner, const FullMatrix<double> &penalty, double tolerance,
          const QuadraticProgram &qp, const EqualityConstraints &constraints, Vector<double> &z,
          Vector<double> &alpha);

  QpReport run();

private:
  struct Step
  {
    Vector<double> z, alpha;
  };

  bool predict();
  void ascend();
  void minimise();
  bool step_to(const FeasibleSet::Linearisation &prediction, Step &step);
  Vector<double> length(const FullMatrix<double> &M, const Vector<double> &gap) const;
  Vector<double> gradient(const Vector<double> &x);
  FeasibleSet::Linearisation linearise();
  bool is_met() const;
  double size() const;

  const BalanceSolver::Inner &inner;
  const FullMatrix<double> root_of_penalty;
  const double tolerance;
  QuadraticProgram qp;    ///< its d moves with alpha
  const Vector<double> d; ///< for alpha = 0
  const EqualityConstraints &constraints;
  Vector<double> &z, &alpha;
  Vector<double> scale; ///< of steps along the gradient, 1 / S_ii
  Vector<double> noise; ///< of z where nothing presses, as in BalanceSolver
  Vector<double> gap;   ///< e - G'z
  double smallest = 0;  ///< gap so far of minimisers
  double stretch = 1;   ///< of steps along which phi is straight
  unsigned int minimisations = 0;
  QpReport report;
};

Balance::Balance(const BalanceSolver::Inner &inner, const FullMatrix<double> &penalty,
                 const double tolerance, const QuadraticProgram &qp,
                 const EqualityConstraints &constraints, Vector<double> &z, Vector<double> &alpha)
    : inner(inner), root_of_penalty(root_of(penalty)), tolerance(tolerance), qp(qp), d(qp.d),
      constraints(constraints), z(z), alpha(alpha), scale(diagonal_scale(qp.S))
{
  noise = noise_of(d, scale);
  scale.scale(scale);
}

QpReport Balance::run()
{
  const Step start{z, alpha};
  qp.feasible_set.project(z);
  if (!predict())
  {
    z = start.z;
    alpha = start.alpha;
  }
  minimise();
  smallest = size();
  while (report.converged && !is_met() && minimisations < maximum_minimisations)
    ascend();
  report.converged = report.converged && is_met();
  return report;
}

/**
 * Newton's method for z and alpha at once. Nothing falls from step to step; false unless a prediction
 * stays that meets the equations.
 */
bool Balance::predict()
{
  std::set<std::vector<signed char>> known;
  std::vector<signed char> last;
  for (unsigned int steps_left = maximum_predictions; steps_left > 0; --steps_left)
  {
    const FeasibleSet::Linearisation next = linearise();
    if (!known.insert(next.walls).second)
    {
      gap = constraints.gap(z);
      return next.walls == last && is_met();
    }
    last = next.walls;
    Step step;
    if (!step_to(next, step))
      return false;
    z += step.z;
    alpha += step.alpha;
  }
  return false;
}

/**
 * From the minimiser of one alpha to that of another, where phi is larger or the gap half of what it
 * ever was. As phi is concave its slope along the step falls; phi has grown wherever that is positive.
 */
void Balance::ascend()
{
  Step step;
  if (!step_to(linearise(), step))
  {
    report.converged = false;
    return;
  }
  const double slope_at_start = gap * step.alpha;
  double low = 0, slope_at_low = slope_at_start, high = std::numeric_limits<double>::infinity();
  double taken = 0;
  for (double here = 1; minimisations < maximum_minimisations;)
  {
    z.add(here - taken, step.z);
    alpha.add(here - taken, step.alpha);
    taken = here;
    minimise();
    if (!report.converged || is_met())
      return;
    if (size() <= 0.5 * smallest)
      break;
    const double slope = gap * step.alpha;
    const bool is_steep = slope > 0.9 * slope_at_start; // and phi as good as straight
    if (!(slope < 0 || is_steep) || high <= low * (1 + 1e-14))
      break;
    if (slope < 0)
    {
      high = here;
      const double zero = low + (high - low) * slope_at_low / (slope_at_low - slope);
      here = std::clamp(zero, low + 0.1 * (high - low), high - 0.1 * (high - low));
    }
    else
    {
      low = here;
      slope_at_low = slope;
      here = std::isinf(high) ? 2 * here : 0.5 * (low + high);
    }
  }
  smallest = std::min(smallest, size());
  // Where phi bends in one direction and is straight in another, the bent one ends the doubling.
  stretch = std::max(1., 2 * taken * stretch);
}

/** z := the minimiser for alpha */
void Balance::minimise()
{
  qp.d = d;
  qp.d += constraints.along(alpha);
  report += inner(qp, z);
  gap = constraints.gap(z);
  ++minimisations;
}

/**
 * What leads from z and alpha to r = 0 along the free directions of @p prediction and to `G'z = e`,
 *
 *     S_FF dz_F = G_F dalpha - r_F,   G_F'dz_F = e - G'z,
 *
 * for singular M as nearly as length() may. False if S_FF is not positive definite.
 */
bool Balance::step_to(const FeasibleSet::Linearisation &prediction, Step &step)
{
  const NewtonSystem system(qp.S, prediction.free);
  report.dense_solves += !prediction.free.empty();
  if (!system.is_positive_definite())
    return false;
  const unsigned int m = alpha.size();
  std::vector<Vector<double>> answers; // of z_F to alpha
  FullMatrix<double> M(m, m);
  for (unsigned int j = 0; j < m; ++j)
  {
    Vector<double> unit(m), forces(m);
    unit[j] = 1.;
    answers.push_back(system.solve(constraints.along(unit)));
    constraints.G.Tvmult(forces, answers.back());
    for (unsigned int k = 0; k < m; ++k)
      M(k, j) = forces[k];
  }
  step.z = prediction.base;
  step.z -= system.solve(gradient(prediction.base));
  step.alpha = length(M, constraints.gap(step.z));
  for (unsigned int j = 0; j < m; ++j)
    step.z.add(step.alpha[j], answers[j]);
  step.z -= z;
  return true;
}

/**
 * `M^-1 gap`. M is never larger than `Gamma^-1 = L^-T L^-1`: the eigenvalues of `L'ML` lie between 0 and 1,
 * and where one is 0 to round-off the step is that for 1,
 * stretched.
 */
Vector<double> Balance::length(const FullMatrix<double> &M, const Vector<double> &gap) const
{
  const types::blas_int m = gap.size(), work_size = 102;
  const FullMatrix<double> &L = root_of_penalty;
  FullMatrix<double> vectors(m, m);
  vectors.triple_product(M, L, L, true);
  std::vector<double> eigenvalues(m), work(work_size);
  types::blas_int info = 0;
  syev("V", "L", &m, &vectors(0, 0), &m, eigenvalues.data(), work.data(), &work_size, &info);
  // LAPACK's columns are rows here.
  Vector<double> scaled(m), parts(m), result(m);
  L.Tvmult(scaled, gap);
  vectors.vmult(parts, scaled);
  for (unsigned int k = 0; k < gap.size(); ++k)
    parts[k] *= eigenvalues[k] > flat ? 1. / eigenvalues[k] : stretch;
  vectors.Tvmult(scaled, parts);
  L.vmult(result, scaled);
  return result;
}

/** `S x - d - G alpha` */
Vector<double> Balance::gradient(const Vector<double> &x)
{
  Vector<double> r(x.size());
  qp.S.vmult(r, x);
  ++report.multiplications;
  r -= d;
  r -= constraints.along(alpha);
  return r;
}

FeasibleSet::Linearisation Balance::linearise()
{
  return qp.feasible_set.linearise(z, gradient(z), scale);
}

bool Balance::is_met() const
{
  return constraints.imbalance(z, noise, tolerance) <= tolerance;
}

/** The gap in units of energy. */
double Balance::size() const
{
  Vector<double> scaled(gap.size());
  root_of_penalty.Tvmult(scaled, gap);
  return scaled.l2_norm();
}
} // namespace

BalanceSolver::BalanceSolver(Inner inner, FullMatrix<double> penalty, const double tolerance)
    : inner(std::move(inner)), penalty(std::move(penalty)), tolerance(tolerance)
{
}

QpReport BalanceSolver::solve(const QuadraticProgram &qp, const EqualityConstraints &constraints,
                              Vector<double> &z, Vector<double> &alpha) const
{
  qp.assert_size(z);
  AssertDimension(constraints.G.m(), z.size());
  AssertDimension(constraints.G.n(), alpha.size());
  return Balance(inner, penalty, tolerance, qp, constraints, z, alpha).run();
}
} // namespace hpvi
