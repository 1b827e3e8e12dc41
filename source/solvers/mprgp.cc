// SPDX-License-Identifier: LGPL-2.1-or-later

// <i>Modified proportioning with reduced gradient projections</i>, the thesis's solver (Section
// 5.1, Algorithm 1) for
//
// $$q(y) = \tfrac12 y^TSy - d^Ty \to \min, \qquad \ell \le y \le u.$$
//
// If one knew which components of the minimum are at walls, conjugate gradients on the others would
// find it. MPRGP finds out on the way, by three kinds of steps. A <i>CG step</i> minimises on the
// present face. An <i>expansion step</i> hits walls and takes in as many as a projected gradient
// meets. A <i>proportioning step</i> leaves walls that have turned out wrong. Each lowers $q$, so
// that the algorithm cannot cycle, and each costs one or two products with $S$.
#include <hpvi/solvers/mprgp.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr double epsilon = std::numeric_limits<double>::epsilon();

/**
 * Neither NaN nor infinity in what is iterated upon? (The sides of the box have been checked, and
 * may be infinite.)
 */
bool is_finite(const QuadraticProgram &qp, const Vector<double> &z)
{
  const auto finite = [](const double x) { return std::isfinite(x); };
  for (unsigned int j = 0; j < qp.S.n(); ++j)
    for (unsigned int i = 0; i < qp.S.m(); ++i)
      if (!finite(qp.S(i, j)))
        return false;
  return std::all_of(qp.d.begin(), qp.d.end(), finite) && std::all_of(z.begin(), z.end(), finite);
}

/**
 * A rigorous upper bound of |S|_2 for symmetric S: the smaller of row sum norm and Frobenius norm.
 * It reads S once; an iterative estimate would read it several times and come from below.
 */
double norm_bound(const LAPACKFullMatrix<double> &S)
{
  Vector<double> row_sums(S.n());
  double squares = 0;
  for (unsigned int j = 0; j < S.n(); ++j)
    for (unsigned int i = 0; i < S.n(); ++i)
    {
      row_sums[i] += std::abs(S(i, j));
      squares += S(i, j) * S(i, j);
    }
  return std::min(std::sqrt(squares), row_sums.linfty_norm());
}

// @sect3{The state of the iteration}
//
// Beside the point $y$, its gradient $r = Sy - d$ with its two parts $\varphi$ and $\beta$, and the
// direction of conjugate gradients. Steps go along the negative directions.
/**
 * One run of the algorithm in the variables in which it iterates, from a feasible y. The QP value
 * `q(y) = 1/2 y'Sy - d'y` falls in every step.
 */
class Iteration
{
public:
  Iteration(const QuadraticProgram &qp, const Mprgp::Settings &settings, Vector<double> &y);

  QpReport run();

private:
  bool finished();
  bool is_at_rest(bool recurrence_ended);
  void measure();
  bool is_proportional();
  bool minimise_on_face();
  void expand(double cg_length, double wall, double slope, double curvature);
  bool expand_by_projected_cg(double cg_length, double required_change);
  bool proportion();

  void multiply(const Vector<double> &x, Vector<double> &Sx);
  void move(double length, const Vector<double> &direction, const Vector<double> &image);
  void recompute_gradient();
  void split_gradient();
  double reduced_product(const Vector<double> &gradient_part);

  const QuadraticProgram &qp;
  const Mprgp::Settings &settings;
  Vector<double> &y;
  Vector<double> r;         ///< gradient Sy - d
  Vector<double> phi, beta; ///< its free and chopped part
  Vector<double> p, Sp;     ///< CG direction (steps go along -p) and its image
  Vector<double> trial, trial_gradient;
  const double norm;         ///< at least |S|
  const double fixed_length; ///< below 2/|S|: a projected gradient step of this length lowers q
  double reference = 0;      ///< max(|d|, |S y_0|): what |nu| is compared with
  bool gradient_is_recurrence = false; ///< r comes from updates, which drift, not from a product
  double last_look = infinity;         ///< relative gradient when is_at_rest() last looked
  QpReport report;
};

Iteration::Iteration(const QuadraticProgram &qp, const Mprgp::Settings &settings, Vector<double> &y)
    : qp(qp), settings(settings), y(y), r(y.size()), Sp(y.size()), trial_gradient(y.size()),
      norm(norm_bound(qp.S)), fixed_length(norm == 0. ? 1. : 1.95 / norm)
{
  if (!y.all_zero()) // S 0 needs no product
    multiply(y, r);
  reference = std::max(qp.d.l2_norm(), r.l2_norm());
  r -= qp.d;
  split_gradient();
  p = phi;
}

// @sect3{The iteration}
//
// Three lines, as in Algorithm 1: until the projected gradient $\nu = \varphi + \beta$ (5.10) is
// small, choose between the face and its walls.
QpReport Iteration::run()
{
  while (!finished())
    if (!(is_proportional() ? minimise_on_face() : proportion()))
      break;
  return report;
}

/** `|nu|` of (5.10) beside the reference. The supports of phi and beta are disjoint. */
void Iteration::measure()
{
  const double nu = std::hypot(phi.l2_norm(), beta.l2_norm());
  report.projected_gradient = nu == 0. ? 0. : nu / reference;
}

// @sect3{When to end}
//
// Two traps are avoided. CG updates the gradient by recurrence, which drifts from the true one and
// goes on to fall when that has come to rest: so the end is confirmed by a product. And a tolerance
// may ask for more than double precision has; an iteration that makes no progress at the level of
// round-off stops, and says so.
bool Iteration::finished()
{
  measure();
  // Only a gradient that comes from a product may say that the end is reached: CG's recurrence goes
  // on to fall where the true gradient has come to rest.
  const bool confirm =
      gradient_is_recurrence && report.projected_gradient <= std::max(settings.tolerance, epsilon);
  if (confirm)
  {
    recompute_gradient();
    p = phi;
    measure();
  }
  report.converged = report.projected_gradient <= settings.tolerance;
  return report.converged || !std::isfinite(report.projected_gradient) ||
         report.multiplications >= settings.maximum_multiplications || is_at_rest(confirm);
}

/**
 * Is there nothing more to be had for this tolerance? So it is if the true gradient does not even
 * halve from one look at the round-off level `eps (|S| |y| + |d|)`, or from one end of the
 * recurrence, to the next.
 */
bool Iteration::is_at_rest(const bool recurrence_ended)
{
  const double round_off = epsilon * (norm * y.l2_norm() + qp.d.l2_norm());
  if (!recurrence_ended &&
      (gradient_is_recurrence || report.projected_gradient * reference > round_off))
    return false;
  const bool halved = report.projected_gradient <= 0.5 * last_look;
  last_look = report.projected_gradient;
  return !halved;
}

// @sect3{Proportionality}
//
// The choice. $\tilde\varphi$ and $\tilde\beta$ are what the walls leave of the gradients (5.11)
// after a step of fixed length. While the free part is the larger one, there is more to be gained
// on the face.
/**
 * `beta . beta~ <= Gamma^2 phi . phi~`: the free part of the gradient dominates, so it pays to go
 * on minimising on the face before walls are given up.
 */
bool Iteration::is_proportional()
{
  if (phi.all_zero() || beta.all_zero()) // decided by logic and not by round-off
    return beta.all_zero();
  return reduced_product(beta) <= settings.gamma * settings.gamma * reduced_product(phi);
}

/** `g . g~` with the reduced gradient `g~ = (y - P(y - alpha g)) / alpha` of (5.11). */
double Iteration::reduced_product(const Vector<double> &gradient_part)
{
  trial = y;
  trial.add(-fixed_length, gradient_part);
  qp.feasible_set.project(trial);
  trial.sadd(-1., 1., y);
  return (trial * gradient_part) / fixed_length;
}

// @sect3{On the face}
//
// One step of conjugate gradients, if it does not cross a wall.
/**
 * A CG step if it stays in the box, else an expansion step. False if q is unbounded below or not a
 * number.
 */
bool Iteration::minimise_on_face()
{
  if (!(p * r > 0)) // CG keeps p . r = |phi|^2; round-off may not
    p = phi;
  multiply(p, Sp);
  const double slope = p * r, curvature = p * Sp;
  const double wall = qp.feasible_set.distance_to_wall(y, p);
  // Without curvature the minimum along p lies on the wall (S singular or indefinite by round-off).
  const double cg_length = curvature > 0 ? slope / curvature : infinity;
  if (!std::isfinite(curvature) || !std::isfinite(std::min(cg_length, wall)))
    return false;

  if (cg_length > wall)
  {
    expand(cg_length, wall, slope, curvature);
    return true;
  }
  move(cg_length, p, Sp);
  p.sadd(-(phi * Sp) / curvature, 1., phi);
  ++report.cg_steps;
  return true;
}

// @sect3{Expansion}
//
// Algorithm 1 goes to the first wall, then along the projected gradient with a fixed length. That
// length must be below $2/\|S\|$ and is short when $S$ is ill conditioned. Projecting the whole CG
// step instead takes in far more walls at once, but may raise $q$; it is tried first and kept only
// if it gains more than the part of the step up to the first wall would have.
/**
 * The minimum along p lies outside: take in many walls at once by projecting it, P(y - alpha_cg p).
 * That is not bound to lower q. It is kept if it beats the part of the step up to the first wall,
 * whose gain is known for nothing; otherwise go to that wall and on by a projected gradient step of
 * fixed length, as Algorithm 1 does, which lowers q for sure.
 */
void Iteration::expand(const double cg_length, const double wall, const double slope,
                       const double curvature)
{
  const double change_up_to_wall = wall * (-slope + 0.5 * wall * curvature);
  if (!expand_by_projected_cg(cg_length, change_up_to_wall))
  {
    move(wall, p, Sp);
    y.add(-fixed_length, phi);
    qp.feasible_set.project(y);
    recompute_gradient();
  }
  p = phi;
  ++report.expansion_steps;
}

bool Iteration::expand_by_projected_cg(const double cg_length, const double required_change)
{
  if (!std::isfinite(cg_length))
    return false;
  trial = y;
  trial.add(-cg_length, p);
  qp.feasible_set.project(trial);
  multiply(trial, trial_gradient);
  trial_gradient -= qp.d;

  // q(trial) - q(y) = 1/2 (trial - y) . (r_trial + r), free of the cancellation between two values
  double twice_change = 0;
  for (unsigned int i = 0; i < y.size(); ++i)
    twice_change += (trial[i] - y[i]) * (trial_gradient[i] + r[i]);
  if (!(0.5 * twice_change <= required_change))
    return false;
  y.swap(trial);
  r.swap(trial_gradient);
  gradient_is_recurrence = false;
  split_gradient();
  return true;
}

// @sect3{Proportioning}
//
// The thesis's extension to two-sided bounds: the minimum along $\beta$ may lie beyond the opposite
// wall, where the step ends then.
/**
 * Leave walls along the chopped gradient; with two-sided bounds the minimum on that line may lie
 * beyond the opposite wall. False as in minimise_on_face().
 */
bool Iteration::proportion()
{
  multiply(beta, Sp);
  const double slope = beta * r, curvature = beta * Sp;
  const double wall = qp.feasible_set.distance_to_wall(y, beta);
  const double length = std::min(curvature > 0 ? slope / curvature : infinity, wall);
  if (!std::isfinite(curvature) || !std::isfinite(length))
    return false;
  p = beta; // move() overwrites beta
  move(length, p, Sp);
  p = phi;
  ++report.proportioning_steps;
  return true;
}

void Iteration::multiply(const Vector<double> &x, Vector<double> &Sx)
{
  qp.S.vmult(Sx, x);
  ++report.multiplications;
}

/** `y := y - length direction`, a step that ends in the box; image is `S direction`. */
void Iteration::move(const double length, const Vector<double> &direction,
                     const Vector<double> &image)
{
  y.add(-length, direction);
  qp.feasible_set.project(y); // undoes round-off at the wall, no more
  r.add(-length, image);
  gradient_is_recurrence = true;
  split_gradient();
}

void Iteration::recompute_gradient()
{
  multiply(y, r);
  r -= qp.d;
  gradient_is_recurrence = false;
  split_gradient();
}

void Iteration::split_gradient()
{
  qp.feasible_set.split_gradient(y, r, phi, beta);
}

} // namespace

// @sect3{Scaling}
//
// $S$ has entries that differ by powers of ten: edges differ in length, and $w_i$ in size. In $y_i
// = z_i S_{ii}^{1/2}$ the diagonal is one. On the thesis's example this takes the condition number
// from $10^8$ to $10^3$, and the solver iterates in these variables.
Mprgp::Mprgp(const Settings &settings) : settings(settings)
{
}

QpReport Mprgp::solve(const QuadraticProgram &qp, Vector<double> &z) const
{
  qp.assert_size(z);
  QpReport report;
  report.converged = z.size() == 0;
  if (report.converged)
    return report;
  qp.feasible_set.project(z);
  if (!is_finite(qp, z))
  {
    report.projected_gradient = std::numeric_limits<double>::quiet_NaN();
    return report;
  }
  if (!settings.diagonal_scaling)
    return Iteration(qp, settings, z).run();

  const Vector<double> scale = diagonal_scale(qp.S);
  QuadraticProgram scaled{hpvi::scaled(qp.S, scale), qp.d, qp.feasible_set.scaled(scale)};
  scaled.d.scale(scale);
  Vector<double> y(z.size());
  for (unsigned int i = 0; i < z.size(); ++i)
    y[i] = z[i] / scale[i];
  report = Iteration(scaled, settings, y).run();
  qp.feasible_set.unscale(y, scale, z);
  return report;
}

QpReport &QpReport::operator+=(const QpReport &part)
{
  converged = part.converged;
  multiplications += part.multiplications;
  cg_steps += part.cg_steps;
  expansion_steps += part.expansion_steps;
  proportioning_steps += part.proportioning_steps;
  dense_solves += part.dense_solves;
  fell_back = fell_back || part.fell_back;
  projected_gradient = part.projected_gradient;
  return *this;
}
} // namespace hpvi
