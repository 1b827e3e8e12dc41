// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/dense_algebra.h>
#include <hpvi/solvers/cone_newton.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr unsigned int most_newton_steps = 150;  ///< with or without line search
constexpr unsigned int maximum_all_steps = 3000; ///< of all runs together

/** Beside -1, 0 and 1: a tangential component without pressure, which is zero. */
constexpr signed char loose = 2;
} // namespace

ConeNewton::ConeNewton(ConeIterate &iterate)
    : iterate(iterate), program(iterate.program), point(iterate.point),
      G(point.z.size(), point.alpha.size())
{
  if (G.n() > 0)
    program.balance.G.mmult(G, iterate.L);
  for (unsigned int i = 0; i < G.m(); ++i)
    for (unsigned int j = 0; j < G.n(); ++j)
      G(i, j) *= iterate.scale[i];
}

ConeNewton::State ConeNewton::stick() const
{
  const Vector<double> zero(point.z.size());
  const FeasibleSet::Linearisation all = iterate.set->fixed.linearise(zero, zero, iterate.step);
  State state{all.walls, all.base, {}};
  for (const FrictionCones::Cone &cone : iterate.set->cones)
    if (cone.friction.vanishes())
      state.walls[cone.tangential] = loose;
  return state;
}

/** Where `z - step r` leaves the set whose cones are those at that point, a wall holds. */
ConeNewton::State ConeNewton::predict() const
{
  const Vector<double> target = iterate.target();
  const FeasibleSet::Linearisation all =
      iterate.set->at(target).linearise(point.z, point.r, iterate.step);
  State state{all.walls, all.base, {}};
  for (const FrictionCones::Cone &cone : iterate.set->cones)
  {
    state.pieces.push_back(cone.friction.piece(target[cone.normal]));
    if (!(cone.friction.limit(target[cone.normal]) > 0.))
    {
      state.walls[cone.tangential] = loose;
      state.base[cone.tangential] = 0.;
    }
  }
  return state;
}

ConeNewton::State ConeNewton::stick_where_closed() const
{
  State state = predict();
  for (const FrictionCones::Cone &cone : iterate.set->cones)
    if (state.walls[cone.tangential] != loose)
      state.walls[cone.tangential] = 0;
  return state;
}

ConeNewton::Key ConeNewton::key_of(const State &state) const
{
  std::vector<double> slopes(state.pieces.size());
  for (unsigned int k = 0; k < slopes.size(); ++k)
    if (std::abs(state.walls[iterate.set->cones[k].tangential]) == 1)
      slopes[k] = state.pieces[k].slope;
  return {state.walls, slopes};
}

/** What slipped and would slip the other way sticks first: else the method often cycles. */
ConeNewton::State ConeNewton::predict_after(const State &last) const
{
  State state = predict();
  for (const FrictionCones::Cone &cone : iterate.set->cones)
    if (state.walls[cone.tangential] * last.walls[cone.tangential] == -1)
      state.walls[cone.tangential] = 0;
  return state;
}

/**
 * Until a state stays or comes again, or, where round-off keeps changing it, until the residual is small
 * enough and falls no more. A state that leaves part of the balance undecided may come again and again.
 */
bool ConeNewton::step_on_from(State state)
{
  std::set<Key> known;
  double last = std::numeric_limits<double>::infinity();
  give = 1.;
  for (unsigned int steps_left = most_newton_steps; steps_left > 0; --steps_left)
  {
    if (known.count(key_of(state)) > 0 || !follow(state))
      break;
    if (give == 1.)
      known.insert(key_of(state));
    const double residual = iterate.measure();
    if (residual <= iterate.settings.tolerance && residual > 0.5 * last)
      break;
    last = residual;
    state = predict_after(state);
  }
  return iterate.measure() <= iterate.settings.tolerance;
}

bool ConeNewton::search_lines()
{
  for (unsigned int steps_left = most_newton_steps; steps_left > 0; --steps_left)
  {
    const ConeIterate::Point old = point;
    const double old_merit = iterate.merit();
    if (!follow(predict()))
      break;
    double length = 1.;
    for (; length > 1e-4 && !(iterate.merit() <= (1. - 1e-4 * length) * old_merit); length *= 0.5)
      iterate.halve_step(old);
    if (iterate.measure() <= iterate.settings.tolerance)
      return true;
    if (length <= 1e-4)
      break;
  }
  return step_on_from(predict());
}

/**
 * To the point that @p state describes. Where no free component answers to the balance, all open or all
 * sliding one way, alpha moves by `Gamma (e - G'z)`, the step of the method of multipliers, and ten times
 * as far each time. False if there is no such point.
 */
bool ConeNewton::follow(const State &state)
{
  if (steps >= maximum_all_steps)
    return false;
  if (solve_linear_system(state, 0.))
  {
    give = 1.;
    return true;
  }
  if (point.alpha.size() == 0 || !solve_linear_system(state, give))
    return false;
  give *= 0.1;
  return true;
}

/** What @p state leaves free, and what follows it. */
ConeNewton::Unknowns ConeNewton::unknowns_of(const State &state) const
{
  Unknowns result{{}, std::vector<std::vector<Unknowns::Follower>>(point.z.size()), state.base};
  for (unsigned int i = 0; i < point.z.size(); ++i)
    if (state.walls[i] == 0)
      result.free.push_back(i);
  for (unsigned int k = 0; k < iterate.set->cones.size(); ++k)
  {
    const FrictionCones::Cone &cone = iterate.set->cones[k];
    const signed char wall = state.walls[cone.tangential];
    if (wall == 0)
      continue;
    const bool slips = wall != loose;
    const double at_zero = slips ? wall * state.pieces[k].at_zero : 0.,
                 slope = slips ? wall * state.pieces[k].slope : 0.;
    result.base[cone.tangential] = at_zero + slope * result.base[cone.normal];
    if (slope != 0. && state.walls[cone.normal] == 0)
      result.followers[cone.normal].push_back({cone.tangential, at_zero, slope});
  }
  return result;
}

/** By columns, in scaled variables. */
std::vector<double> ConeNewton::matrix_of(const Unknowns &unknowns, const double give) const
{
  const std::vector<unsigned int> &free = unknowns.free;
  const unsigned int f = free.size(), m = point.alpha.size(), size = f + m;
  std::vector<double> matrix(std::size_t(size) * size);
  for (unsigned int j = 0; j < f; ++j)
  {
    double *column = matrix.data() + std::size_t(j) * size;
    const auto add = [&](const unsigned int component, const double part)
    {
      for (unsigned int i = 0; i < f; ++i)
        column[i] += part * iterate.scale[free[i]] * program.S(free[i], component);
      for (unsigned int k = 0; k < m; ++k)
        column[f + k] += part / iterate.scale[component] * G(component, k);
    };
    add(free[j], iterate.scale[free[j]]);
    for (const Unknowns::Follower &follower : unknowns.followers[free[j]])
      add(follower.component, follower.slope * iterate.scale[free[j]]);
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
bool ConeNewton::solve_linear_system(const State &state, const double give)
{
  const Unknowns unknowns = unknowns_of(state);
  const std::vector<unsigned int> &free = unknowns.free;
  const unsigned int f = free.size(), m = point.alpha.size();
  ++steps;
  const LuFactor factor(matrix_of(unknowns, give), f + m);
  if (factor.is_singular())
    return false;
  const Vector<double> at_base = iterate.gradient(unknowns.base);
  std::vector<double> x(f + m);
  for (unsigned int i = 0; i < f; ++i)
    x[i] = -iterate.scale[free[i]] * at_base[free[i]];
  Vector<double> part = iterate.gap(unknowns.base);
  std::copy(part.begin(), part.end(), x.begin() + f);
  factor.solve(x);
  point.z = unknowns.base;
  for (unsigned int j = 0; j < f; ++j)
  {
    point.z[free[j]] += iterate.scale[free[j]] * x[j];
    for (const Unknowns::Follower &follower : unknowns.followers[free[j]])
      point.z[follower.component] = follower.at_zero + follower.slope * point.z[free[j]];
  }
  std::copy(x.begin() + f, x.end(), part.begin());
  if (m > 0)
    iterate.L.vmult_add(point.alpha, part);
  point.r = iterate.gradient(point.z);
  return true;
}
} // namespace hpvi
