// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/lac/householder.h>
#include <deal.II/lac/lapack_templates.h>
#include <hpvi/solver/active_set.h>
#include <hpvi/solver/balance_solver.h>
#include <hpvi/solver/coulomb_solver.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <limits>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr unsigned int maximum_steps = 150; ///< of Newton's method, with or without line search
constexpr unsigned int maximum_fixed_points = 200;
constexpr unsigned int accelerated_start = 15; ///< steps of the fixed point before Newton's method
constexpr unsigned int depth = 5;              ///< of Anderson's acceleration
constexpr unsigned int patience = 30;          ///< steps in which its residual must halve
constexpr unsigned int maximum_newton_steps = 3000; ///< of all rungs together
constexpr double singular = 1e-14;                  ///< reciprocal condition that is round-off
constexpr double round_off = 1e-15;                 ///< of terms that cancel
constexpr double balance_noise = 100; ///< tolerance of the balance in units of the other
constexpr double infinity = std::numeric_limits<double>::infinity();

/** Beside -1, 0 and 1: a tangential component without pressure, which is zero. */
constexpr signed char loose = 2;

/** What Newton's method assumes of each component. */
struct State
{
  std::vector<signed char>
      walls;           ///< -1, 0, 1: at the lower side, free, at the upper; slip, stick, slip
  Vector<double> base; ///< a point on the walls of the components that are fixed
};

/** `x` solves `A x = b`: a dense LU factor, its matrix by columns. */
class LuFactor
{
public:
  explicit LuFactor(std::vector<double> matrix, unsigned int n);

  bool is_singular() const; ///< to round-off

  void solve(std::vector<double> &x) const;

private:
  std::vector<double> factor;
  std::vector<types::blas_int> pivots;
  types::blas_int n;
  double reciprocal_condition = 0;
};

LuFactor::LuFactor(std::vector<double> matrix, const unsigned int n)
    : factor(std::move(matrix)), pivots(n), n(n)
{
  if (n == 0 ||
      !std::all_of(factor.begin(), factor.end(), [](const double x) { return std::isfinite(x); }))
    return;
  types::blas_int info = 0;
  getrf(&this->n, &this->n, factor.data(), &this->n, pivots.data(), &info);
  // L, with 1 on its diagonal and nothing larger below, is well conditioned.
  std::vector<double> work(3 * n);
  std::vector<types::blas_int> integers(n);
  trcon("1", "U", "N", &this->n, factor.data(), &this->n, &reciprocal_condition, work.data(),
        integers.data(), &info);
}

bool LuFactor::is_singular() const
{
  return !(n == 0 || reciprocal_condition > singular);
}

void LuFactor::solve(std::vector<double> &x) const
{
  const types::blas_int one = 1;
  types::blas_int info = 0;
  if (n > 0)
    getrs("N", &n, &one, factor.data(), &n, pivots.data(), x.data(), &n, &info);
}

/** `|x - T(x)| -> 0` faster than by `x := T(x)` (Walker & Ni 2011, doi:10.1137/10078356X). */
class Anderson
{
public:
  /** The next x after `f = T(x) - x`. */
  Vector<double> next(const Vector<double> &x, const Vector<double> &f);

  double contraction = 0; ///< the largest `|T(x) - T(y)| / |x - y|` of successive x

private:
  Vector<double> last_x, last_f;
  std::deque<Vector<double>> dx, df;
};

Vector<double> Anderson::next(const Vector<double> &x, const Vector<double> &f)
{
  if (last_x.size() > 0)
  {
    dx.push_back(x);
    dx.back() -= last_x;
    df.push_back(f);
    df.back() -= last_f;
    Vector<double> change(dx.back());
    change += df.back();
    if (dx.back().l2_norm() > 1e-6 * x.l2_norm()) // else this is round-off
      contraction = std::max(contraction, change.l2_norm() / dx.back().l2_norm());
  }
  if (dx.size() > std::min<std::size_t>(depth, x.size()))
  {
    dx.pop_front();
    df.pop_front();
  }
  last_x = x;
  last_f = f;
  Vector<double> result(x);
  result += f;
  if (df.empty())
    return result;
  FullMatrix<double> matrix(x.size(), df.size());
  for (unsigned int j = 0; j < df.size(); ++j)
    for (unsigned int i = 0; i < x.size(); ++i)
      matrix(i, j) = df[j][i];
  Vector<double> weights(df.size());
  Householder<double>(matrix).least_squares(weights, f);
  // NaN fails too: columns that are as good as dependent
  if (!std::all_of(weights.begin(), weights.end(),
                   [](const double weight) { return std::abs(weight) < 1e3; }))
  {
    dx.clear();
    df.clear();
    return result;
  }
  for (unsigned int j = 0; j < df.size(); ++j)
  {
    result.add(-weights[j], dx[j]);
    result.add(-weights[j], df[j]);
  }
  return result;
}

/** One run: a program, where it stands, and the ways to move. */
class Iteration
{
public:
  Iteration(const ConeProgram &program, const Mprgp::Settings &settings, Vector<double> &z,
            Vector<double> &alpha);

  CoulombReport newton(bool warm, unsigned int first_rung);
  CoulombReport fixed_point(bool warm);

private:
  /** Of one linear system. */
  struct Unknowns
  {
    using Followers = std::vector<std::pair<unsigned int, double>>; ///< components, by how much
    std::vector<unsigned int> free;
    std::vector<Followers> followers; ///< by free component, what slips with it
    Vector<double> base;              ///< with the free ones where they begin
  };

  CoulombReport finish();

  bool step_on_from(State state);
  bool start_from_frictionless();
  bool search_lines();
  bool start_from_fixed_point();
  bool raise_friction();
  bool iterate_on_pressures(unsigned int steps);

  State stick() const;
  State predict() const;
  State predict_after(const State &last) const;
  bool follow(const State &state);
  Unknowns unknowns_of(const State &state) const;
  std::vector<double> matrix_of(const Unknowns &unknowns, double give) const;
  bool solve_linear_system(const State &state, double give);
  void halve_step(const Vector<double> &old_z, const Vector<double> &old_alpha,
                  const Vector<double> &old_r);
  bool minimise(const FeasibleSet &feasible_set);
  void minimise_without_friction();
  void put_on_cones(const FeasibleSet &tresca);

  double measure();
  double merit() const;
  double sizes_of_terms(const Vector<double> &x) const;
  Vector<double> gradient(const Vector<double> &x);
  double norm(Vector<double> x) const;

  const ConeProgram &program;
  const Mprgp::Settings &settings;
  const FrictionCones *set; ///< the program's, or with less friction
  Vector<double> &z, &alpha;
  Vector<double> r; ///< gradient at z
  const Vector<double> scale;
  Vector<double> step;        ///< its squares
  const Vector<double> noise; ///< of z where nothing presses
  const FullMatrix<double> L; ///< the root of the penalty
  FullMatrix<double> G;       ///< `diag(scale) G L`: the balance in units of energy
  double reference = 0;       ///< as in Mprgp
  double give = 1;            ///< of the balance where no free component answers to it
  std::optional<QuadraticProgram> tresca;
  struct
  {
    Vector<double> z, alpha;
    double residual = infinity;
  } best;
  CoulombReport report;
};

Iteration::Iteration(const ConeProgram &program, const Mprgp::Settings &settings, Vector<double> &z,
                     Vector<double> &alpha)
    : program(program), settings(settings), set(&program.set), z(z), alpha(alpha), r(z.size()),
      scale(diagonal_scale(program.S)), step(scale), noise(noise_of(program.d, scale)),
      L(root_of(program.penalty)), G(z.size(), alpha.size())
{
  step.scale(scale);
  if (alpha.size() > 0)
    program.balance.G.mmult(G, L);
  for (unsigned int i = 0; i < z.size(); ++i)
    for (unsigned int j = 0; j < alpha.size(); ++j)
      G(i, j) *= scale[i];
  program.S.vmult(r, z);
  reference = std::max(norm(r), norm(program.d));
  r = gradient(z);
  best = {z, alpha, infinity};
}

CoulombReport Iteration::newton(const bool warm, const unsigned int first_rung)
{
  const std::vector<std::pair<const char *, std::function<bool()>>> ladder = {
      {"newton", [&] { return step_on_from(warm ? predict() : stick()); }},
      {"newton from frictionless", [&] { return start_from_frictionless(); }},
      {"line search",
       [&]
       {
         minimise_without_friction();
         return search_lines();
       }},
      {"anderson", [&] { return start_from_fixed_point(); }},
      {"continuation", [&] { return raise_friction(); }}};
  for (unsigned int rung = first_rung; rung < ladder.size(); ++rung)
  {
    report.method = ladder[rung].first;
    report.qp.fell_back = rung > 0;
    if (ladder[rung].second())
      break;
  }
  return finish();
}

CoulombReport Iteration::fixed_point(const bool warm)
{
  report.method = "fixed point";
  if (!warm)
    minimise_without_friction(); // sides of zero may leave no balance
  iterate_on_pressures(maximum_fixed_points);
  return finish();
}

CoulombReport Iteration::finish()
{
  z = best.z;
  alpha = best.alpha;
  report.residual = report.qp.projected_gradient = best.residual;
  report.qp.converged = best.residual <= settings.tolerance;
  report.qp.dense_solves += report.newton_steps;
  return report;
}

/**
 * Until a state stays or comes again, or, where round-off keeps changing it, until the residual is small
 * enough and falls no more. A state that leaves part of the balance undecided may come again and again.
 */
bool Iteration::step_on_from(State state)
{
  std::set<std::vector<signed char>> known;
  double last = infinity;
  give = 1.;
  for (unsigned int steps_left = maximum_steps; steps_left > 0; --steps_left)
  {
    if (known.count(state.walls) > 0 || !follow(state))
      break;
    if (give == 1.)
      known.insert(state.walls);
    const double residual = measure();
    if (residual <= settings.tolerance && residual > 0.5 * last)
      break;
    last = residual;
    state = predict_after(state);
  }
  return measure() <= settings.tolerance;
}

bool Iteration::start_from_frictionless()
{
  minimise_without_friction();
  State state = predict();
  for (const FrictionCones::Cone &cone : set->cones)
    if (state.walls[cone.tangential] != loose)
      state.walls[cone.tangential] = 0;
  return step_on_from(state);
}

/** Steps of Newton's method, each as long as the residual falls; its last ones are whole ones again. */
bool Iteration::search_lines()
{
  for (unsigned int steps_left = maximum_steps; steps_left > 0; --steps_left)
  {
    const Vector<double> old_z(z), old_alpha(alpha), old_r(r);
    const double old_merit = merit();
    if (!follow(predict()))
      break;
    double length = 1.;
    for (; length > 1e-4 && !(merit() <= (1. - 1e-4 * length) * old_merit); length *= 0.5)
      halve_step(old_z, old_alpha, old_r);
    if (measure() <= settings.tolerance)
      return true;
    if (length <= 1e-4)
      break;
  }
  return step_on_from(predict());
}

bool Iteration::start_from_fixed_point()
{
  minimise_without_friction();
  return iterate_on_pressures(accelerated_start) || step_on_from(predict());
}

/** A level that cannot be solved is left out. */
bool Iteration::raise_friction()
{
  double largest = 0;
  for (const FrictionCones::Cone &cone : program.set.cones)
    largest = std::max(largest, cone.mu);
  FrictionCones less = program.set;
  set = &less;
  minimise_without_friction();
  double level = std::min(0.5, 0.25 * largest);
  for (; level < largest; level *= 1.5)
  {
    for (unsigned int k = 0; k < less.cones.size(); ++k)
      less.cones[k].mu = program.set.cones[k].mu * (level / largest);
    const Vector<double> old_z(z), old_alpha(alpha), old_r(r);
    if (step_on_from(predict()) || search_lines())
      continue;
    z = old_z;
    alpha = old_alpha;
    r = old_r;
  }
  set = &program.set;
  return step_on_from(predict()) || search_lines();
}

/** Tresca problems, each with the pressures of the one before. */
bool Iteration::iterate_on_pressures(const unsigned int steps)
{
  const auto pressures = [&]
  {
    Vector<double> x(set->cones.size());
    for (unsigned int k = 0; k < x.size(); ++k)
      x[k] = std::max(0., z[set->cones[k].normal]) / scale[set->cones[k].normal];
    return x;
  };
  Anderson acceleration;
  Vector<double> x = pressures();
  double halved = infinity;
  for (unsigned int step = 0, since = 0; step < steps && since < patience; ++step, ++since)
  {
    Vector<double> given(z);
    for (unsigned int k = 0; k < x.size(); ++k)
      given[set->cones[k].normal] = x[k] * scale[set->cones[k].normal];
    const FeasibleSet frozen = set->at(given);
    ++report.fixed_point_steps;
    if (!minimise(frozen))
      return false;
    put_on_cones(frozen);
    const double residual = measure();
    if (residual <= settings.tolerance)
      return true;
    if (residual <= 0.5 * halved)
    {
      halved = residual;
      since = 0;
    }
    Vector<double> f = pressures();
    f -= x;
    x = acceleration.next(x, f);
    report.contraction = acceleration.contraction;
  }
  return false;
}

/** All closed, and no point slips. */
State Iteration::stick() const
{
  const Vector<double> zero(z.size());
  const FeasibleSet::Linearisation all = set->fixed.linearise(zero, zero, step);
  State state{all.walls, all.base};
  for (const FrictionCones::Cone &cone : set->cones)
    if (cone.mu == 0.)
      state.walls[cone.tangential] = loose;
  return state;
}

/** Where `z - step r` leaves the set whose cones are those at that point, a wall holds. */
State Iteration::predict() const
{
  Vector<double> target(r);
  target.scale(step);
  target.sadd(-1., 1., z);
  set->fixed.project(target);
  const FeasibleSet::Linearisation all = set->at(target).linearise(z, r, step);
  State state{all.walls, all.base};
  for (const FrictionCones::Cone &cone : set->cones)
    if (!(cone.mu * std::max(0., target[cone.normal]) > 0.))
    {
      state.walls[cone.tangential] = loose;
      state.base[cone.tangential] = 0.;
    }
  return state;
}

/** What slipped and would slip the other way sticks first: else the method often cycles. */
State Iteration::predict_after(const State &last) const
{
  State state = predict();
  for (const FrictionCones::Cone &cone : set->cones)
    if (state.walls[cone.tangential] * last.walls[cone.tangential] == -1)
      state.walls[cone.tangential] = 0;
  return state;
}

/**
 * To the point that @p state describes. Where no free component answers to the balance, all open or all
 * sliding one way, alpha moves by `Gamma (e - G'z)`, the step of the method of multipliers, and ten times
 * as far each time. False if there is no such point.
 */
bool Iteration::follow(const State &state)
{
  if (report.newton_steps >= maximum_newton_steps)
    return false;
  if (solve_linear_system(state, 0.))
  {
    give = 1.;
    return true;
  }
  if (alpha.size() == 0 || !solve_linear_system(state, give))
    return false;
  give *= 0.1;
  return true;
}

/** What @p state leaves free, and what follows it. */
Iteration::Unknowns Iteration::unknowns_of(const State &state) const
{
  Unknowns result{{}, std::vector<Unknowns::Followers>(z.size()), state.base};
  for (unsigned int i = 0; i < z.size(); ++i)
    if (state.walls[i] == 0)
      result.free.push_back(i);
  for (const FrictionCones::Cone &cone : set->cones)
  {
    const signed char wall = state.walls[cone.tangential];
    if (wall == 0)
      continue;
    const double slope = wall == loose ? 0. : wall * cone.mu;
    result.base[cone.tangential] = slope * result.base[cone.normal];
    if (slope != 0. && state.walls[cone.normal] == 0)
      result.followers[cone.normal].emplace_back(cone.tangential, slope);
  }
  return result;
}

/** By columns, in scaled variables. */
std::vector<double> Iteration::matrix_of(const Unknowns &unknowns, const double give) const
{
  const std::vector<unsigned int> &free = unknowns.free;
  const unsigned int f = free.size(), m = alpha.size(), size = f + m;
  std::vector<double> matrix(std::size_t(size) * size);
  for (unsigned int j = 0; j < f; ++j)
  {
    double *column = matrix.data() + std::size_t(j) * size;
    const auto add = [&](const unsigned int component, const double part)
    {
      for (unsigned int i = 0; i < f; ++i)
        column[i] += part * scale[free[i]] * program.S(free[i], component);
      for (unsigned int k = 0; k < m; ++k)
        column[f + k] += part / scale[component] * G(component, k);
    };
    add(free[j], scale[free[j]]);
    for (const auto &[component, slope] : unknowns.followers[free[j]])
      add(component, slope * scale[free[j]]);
  }
  for (unsigned int k = 0; k < m; ++k)
  {
    double *column = matrix.data() + std::size_t(f + k) * size;
    for (unsigned int i = 0; i < f; ++i)
      column[i] = -G(free[i], k);
    column[f + k] = give;
  }
  return matrix;
}

/**
 * With P the directions of the free components F, which take along what slips, `z = base + P y`:
 *
 *     (S P)_F y - G_F dalpha = -r_F(base),   G'P y + give Gamma^-1 dalpha = e - G'base.
 */
bool Iteration::solve_linear_system(const State &state, const double give)
{
  const Unknowns unknowns = unknowns_of(state);
  const std::vector<unsigned int> &free = unknowns.free;
  const unsigned int f = free.size(), m = alpha.size();
  ++report.newton_steps;
  const LuFactor factor(matrix_of(unknowns, give), f + m);
  if (factor.is_singular())
    return false;
  const Vector<double> at_base = gradient(unknowns.base);
  std::vector<double> x(f + m);
  for (unsigned int i = 0; i < f; ++i)
    x[i] = -scale[free[i]] * at_base[free[i]];
  Vector<double> part(m);
  if (m > 0)
    L.Tvmult(part, program.balance.gap(unknowns.base));
  std::copy(part.begin(), part.end(), x.begin() + f);
  factor.solve(x);
  z = unknowns.base;
  for (unsigned int j = 0; j < f; ++j)
  {
    z[free[j]] += scale[free[j]] * x[j];
    for (const auto &[component, slope] : unknowns.followers[free[j]])
      z[component] = slope * z[free[j]];
  }
  std::copy(x.begin() + f, x.end(), part.begin());
  if (m > 0)
    L.vmult_add(alpha, part);
  r = gradient(z);
  return true;
}

/** Half of the way back; the gradient is linear on it. */
void Iteration::halve_step(const Vector<double> &old_z, const Vector<double> &old_alpha,
                           const Vector<double> &old_r)
{
  z.sadd(0.5, 0.5, old_z);
  r.sadd(0.5, 0.5, old_r);
  if (alpha.size() > 0)
    alpha.sadd(0.5, 0.5, old_alpha);
}

/** z := the solution with sides that stay */
bool Iteration::minimise(const FeasibleSet &feasible_set)
{
  if (!tresca)
    tresca = QuadraticProgram{program.S, program.d, {}};
  tresca->feasible_set = feasible_set;
  const BalanceSolver::Inner inner = [&](const QuadraticProgram &qp, Vector<double> &y)
  { return ActiveSet(settings).solve(qp, y); };
  const QpReport part =
      alpha.size() == 0 ? inner(*tresca, z)
                        : BalanceSolver(inner, program.penalty, balance_noise * settings.tolerance)
                              .solve(*tresca, program.balance, z, alpha);
  report.qp.multiplications += part.multiplications;
  report.qp.cg_steps += part.cg_steps;
  report.qp.expansion_steps += part.expansion_steps;
  report.qp.proportioning_steps += part.proportioning_steps;
  report.qp.dense_solves += part.dense_solves;
  r = gradient(z);
  return part.converged;
}

/** With free motions there may be no balance without friction: then nothing slips. */
void Iteration::minimise_without_friction()
{
  z = 0.;
  alpha = 0.;
  minimise(alpha.size() == 0 ? set->at(z) : set->fixed);
}

/** What lies on a side of Tresca's set goes to that side of its cone. */
void Iteration::put_on_cones(const FeasibleSet &tresca)
{
  const Vector<double> zero(z.size());
  Vector<double> lower(z), upper(z);
  for (const FrictionCones::Cone &cone : set->cones)
  {
    lower[cone.tangential] = -infinity;
    upper[cone.tangential] = infinity;
  }
  tresca.project(lower);
  tresca.project(upper);
  for (const FrictionCones::Cone &cone : set->cones)
  {
    const unsigned int t = cone.tangential;
    const double bound = cone.mu * std::max(0., z[cone.normal]);
    if (lower[t] == upper[t]) // new pressure: friction resists
      z[t] = std::copysign(bound, -r[t]);
    else if (z[t] >= upper[t])
      z[t] = bound;
    else if (z[t] <= lower[t])
      z[t] = -bound;
  }
  r = gradient(z);
}

/**
 * The residual of the nearest point in its own set, which is remembered if none was better. Along the
 * tangent it is what a step along the gradient does, within the cone: where pressure is nothing but
 * round-off, so is what it lets slip.
 */
double Iteration::measure()
{
  Vector<double> nearest(z), phi, beta;
  set->fixed.project(nearest);
  const FeasibleSet own = set->at(nearest);
  own.project(nearest);
  const Vector<double> slope = nearest == z ? r : gradient(nearest);
  own.split_gradient(nearest, slope, phi, beta);
  for (const FrictionCones::Cone &cone : set->cones)
  {
    const unsigned int t = cone.tangential;
    const double bound = cone.mu * std::max(0., nearest[cone.normal]),
                 moved = nearest[t] - step[t] * slope[t];
    phi[t] = std::isnan(moved) ? moved : (nearest[t] - std::clamp(moved, -bound, bound)) / step[t];
    beta[t] = 0.;
  }
  const double nu = std::hypot(norm(phi), norm(beta)),
               gap = program.balance.imbalance(nearest, noise, balance_noise * settings.tolerance),
               cancelled = round_off / settings.tolerance * sizes_of_terms(nearest),
               residual = std::max(nu == 0. ? 0. : nu / std::max(reference, cancelled),
                                   gap / balance_noise);
  if (set == &program.set && residual < best.residual)
    best = {nearest, alpha, residual};
  return residual;
}

/** What Newton's method makes zero: `|z - P(z - step r)|`, and the gap of the balance. */
double Iteration::merit() const
{
  Vector<double> target(r);
  target.scale(step);
  target.sadd(-1., 1., z);
  set->fixed.project(target);
  set->at(target).project(target);
  double squares = 0;
  for (unsigned int i = 0; i < z.size(); ++i)
    squares += std::pow((z[i] - target[i]) / scale[i], 2);
  if (alpha.size() > 0)
  {
    Vector<double> gap(alpha.size());
    L.Tvmult(gap, program.balance.gap(z));
    squares += gap.norm_sqr();
  }
  return std::sqrt(squares);
}

/** `S x - d - G alpha` */
Vector<double> Iteration::gradient(const Vector<double> &x)
{
  Vector<double> result(x.size());
  program.S.vmult(result, x);
  ++report.qp.multiplications;
  result -= program.d;
  if (alpha.size() > 0)
    result -= program.balance.along(alpha);
  return result;
}

/** `|x|` of a gradient in the variables in which Mprgp would iterate. */
double Iteration::norm(Vector<double> x) const
{
  if (settings.diagonal_scaling)
    x.scale(scale);
  return x.l2_norm();
}

/** `|diag(S) x|` likewise: of the terms that cancel in a gradient. */
double Iteration::sizes_of_terms(const Vector<double> &x) const
{
  Vector<double> terms(x.size());
  for (unsigned int i = 0; i < x.size(); ++i)
    terms[i] = program.S(i, i) * x[i];
  return norm(terms);
}
} // namespace

CoulombSolver::CoulombSolver(const Mprgp::Settings &settings, const Method method,
                             const unsigned int first_rung)
    : settings(settings), method(method), first_rung(first_rung)
{
}

CoulombReport CoulombSolver::solve(const ConeProgram &program, Vector<double> &z,
                                   Vector<double> &alpha, const bool warm) const
{
  AssertDimension(program.S.n(), z.size());
  AssertDimension(program.d.size(), z.size());
  AssertDimension(program.set.fixed.size(), z.size());
  AssertDimension(program.balance.e.size(), alpha.size());
  CoulombReport report;
  report.qp.converged = z.size() == 0;
  if (report.qp.converged)
    return report;
  if (!warm)
  {
    z = 0.;
    alpha = 0.;
  }
  if (!std::isfinite(program.S.frobenius_norm()) || !std::isfinite(program.d.l2_norm()) ||
      !std::isfinite(z.l2_norm()))
  {
    report.residual = report.qp.projected_gradient = std::numeric_limits<double>::quiet_NaN();
    return report;
  }
  Iteration iteration(program, settings, z, alpha);
  return method == Method::newton ? iteration.newton(warm, first_rung)
                                  : iteration.fixed_point(warm);
}

double CoulombSolver::difference_from_second_start(const ConeProgram &program,
                                                   const Vector<double> &z) const
{
  Vector<double> other(z.size()), alpha(program.balance.e.size());
  if (!CoulombSolver(settings, Method::newton, 1).solve(program, other, alpha, false).qp.converged)
    return std::numeric_limits<double>::quiet_NaN();
  const auto size = [&](const Vector<double> &x)
  {
    Vector<double> product(x.size());
    program.S.vmult(product, x);
    return std::sqrt(std::max(0., x * product));
  };
  const double largest = std::max(size(z), size(other));
  other -= z;
  return largest == 0. ? 0. : size(other) / largest;
}
} // namespace hpvi
