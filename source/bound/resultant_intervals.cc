// SPDX-License-Identifier: LGPL-2.1-or-later

// Engineers read forces. The weak equation of the exact solution says them with any displacement $w$ that moves one
// boundary and leaves the others where they are,
//
// $$ F = \int_\Gamma T \cdot w \, ds = a(u, w) - L(w), $$
//
// and the same with $u_N$ in the place of $u$ is off by $a(u - u_N, w)$, no more than the guaranteed bound $B$ of the error
// times $|w|_a$. So all that is wanted are displacements of small energy with known boundary values. They are no part of
// the discrete problem: a corner at which a held and a rubbing boundary meet asks for a $w$ that falls along a shorter
// edge than $V_N$ has.
#include <hpvi/bound/resultant_intervals.h>
#include <hpvi/plane/internal_forces.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Of B |w|_a: what falls may add to a half-width, and what a new mesh aims at, so that it serves some steps. */
constexpr double largest_share = 0.1, aim = 0.01;

/** A corner's edge is not bisected more often: coordinates have 16 digits. */
constexpr unsigned int most_levels = 30;
} // namespace

ResultantIntervals::ResultantIntervals(const Scene<2> &scene) : scene(scene)
{
}

std::vector<unsigned int> ResultantIntervals::levels() const
{
  std::vector<unsigned int> result;
  for (const GradedPoint &point : graded)
    result.push_back(point.levels);
  return has_goals ? result : at_first;
}

void ResultantIntervals::begin_with(const std::vector<unsigned int> &levels)
{
  at_first = levels;
}

std::string ResultantIntervals::flaws() const
{
  std::string result;
  const auto add = [&](const std::string &flaw)
  {
    if (result.find(flaw) == std::string::npos)
      result += (result.empty() ? "" : "; ") + flaw;
  };
  for (const OfBoundary &boundary : boundaries)
    for (const Goal &goal : boundary.goals)
      if (const std::string flaw = flaw_of(goal); !flaw.empty())
        add(flaw);
      else if (!std::isfinite(goal.norm + goal.rounding))
        add("a cell is so flat that no rule encloses the energy on it");
      else if (goal.is_pressed)
        add("the pressure on " + scene.boundaries[boundary.boundary].name +
            " in a corner that is held, which has no upper bound");
  return result;
}

/** Why there is none, in words. */
std::string ResultantIntervals::flaw_of(const Goal &goal)
{
  std::string result = goal.test.flaw();
  for (const Lift &lift : goal.lifts)
    if (result.empty())
      result = lift.test.flaw();
  return result;
}

const ResultantIntervals::Goal *
ResultantIntervals::OfBoundary::find(const BoundaryMotion motion) const
{
  for (const Goal &goal : goals)
    if (goal.motion == motion)
      return &goal;
  return nullptr;
}

// Forces along the axes of a boundary in contact are sums of those along its normal and its tangent.
void ResultantIntervals::find_goals(const std::vector<Resultant<2>> &forces)
{
  has_goals = true;
  sides = sides_of(scene);
  for (const Resultant<2> &row : forces)
  {
    if (row.kind == ForceKind::load || row.boundary >= scene.boundaries.size() ||
        sides[row.boundary].pieces.empty())
      continue;
    OfBoundary &own = boundaries.emplace_back(OfBoundary{row.boundary, {}});
    const bool is_along = row.kind == ForceKind::contact && is_straight(sides[row.boundary]);
    for (const BoundaryMotion motion :
         {is_along ? BoundaryMotion::normal : BoundaryMotion::x,
          is_along ? BoundaryMotion::tangential : BoundaryMotion::y, BoundaryMotion::moment})
    {
      if (scene.is_axisymmetric() &&
          (motion == BoundaryMotion::x || motion == BoundaryMotion::moment))
        continue; // what is radial balances itself, and turns nothing
      own.goals.push_back({motion, TestMotion(scene, sides, row.boundary, motion), {}});
      for (const TestMotion::Fall &fall : own.goals.back().test.falls())
        if (std::none_of(graded.begin(), graded.end(),
                         [&](const GradedPoint &point) { return point.x == fall.from; }))
          graded.push_back(
              {fall.from, graded.size() < at_first.size() ? at_first[graded.size()] : 0});
    }
  }
}

// @sect3{Test displacements}
//
bool ResultantIntervals::is_solved(const Goal &goal) const
{
  return goal.test.flaw().empty() && !goal.test.is_zero();
}

void ResultantIntervals::solve(const Solution<2> &solution)
{
  space = std::make_unique<TestSpace>(solution, graded, tables);
  for (OfBoundary &boundary : boundaries)
    for (Goal &goal : boundary.goals)
    {
      if (!is_solved(goal))
        continue;
      goal.w = space->solve(goal.test);
      goal.norm = space->norm(goal.w);
      goal.friction = 0;
      goal.lifts.clear();
      const std::vector<double> l = space->lengths(goal.test);
      for (unsigned int k = 0; k < l.size(); ++k)
      {
        const TestMotion::Fall &fall = goal.test.falls()[k];
        goal.friction += fall.work(scene, l[k]);
        if (fall.kind != TractionKind::friction ||
            !scene.boundaries[fall.boundary].friction.knows_pressure())
          continue;
        TestMotion X = goal.test.pressing(fall, l[k]);
        const double norm = X.flaw().empty() ? space->norm(space->solve(X)) : 0.;
        goal.lifts.push_back({std::move(X), norm});
      }
    }
}

// A fall along friction is short enough where it costs little, one along a pressure where contact is open all along.
double ResultantIntervals::missing_levels(const Goal &goal, const unsigned int fall,
                                          const double length, const Solution<2> &solution,
                                          const ErrorBound &bound) const
{
  const TestMotion::Fall &from = goal.test.falls()[fall];
  if (from.kind == TractionKind::friction)
  {
    const double work = goal.friction + goal.pressed;
    return work > largest_share * bound.total * goal.norm
               ? std::ceil(std::log2(work / (aim * bound.total * goal.norm)))
               : 0.;
  }
  if (bound.kind != BoundKind::energy)
    return 0.;
  const double open = OpenContact(solution, bound, from.boundary, from.from).length();
  return open > 0 && length > open ? std::ceil(std::log2(length / open)) : 0.;
}

/** More bisections where falls ask for them; false: all are there. */
bool ResultantIntervals::grade(const Solution<2> &solution, const ErrorBound &bound)
{
  std::vector<GradedPoint> next = graded;
  for (OfBoundary &boundary : boundaries)
    for (Goal &goal : boundary.goals)
    {
      if (!is_solved(goal))
        continue;
      measure_lifts(goal, solution, bound);
      const std::vector<double> l = space->lengths(goal.test);
      for (unsigned int k = 0; k < l.size(); ++k)
        for (unsigned int point = 0; point < graded.size(); ++point)
          if (graded[point].x == goal.test.falls()[k].from)
            next[point].levels = std::max(
                next[point].levels,
                std::min(most_levels, graded[point].levels +
                                          static_cast<unsigned int>(std::min(
                                              double(most_levels),
                                              missing_levels(goal, k, l[k], solution, bound)))));
    }
  bool is_finer = false;
  for (unsigned int point = 0; point < graded.size(); ++point)
    is_finer = is_finer || next[point].levels > graded[point].levels;
  graded = next;
  return is_finer;
}

// @sect3{Forces}
//
void ResultantIntervals::measure(const Solution<2> &solution, const ErrorBound &bound)
{
  const TestSpace::Residual residual = space->residual(solution);
  const LoadRules<2> &loads = *solution.spaces->loads;
  const double missed =
      residual.rule == 0.
          ? 0.
          : residual.rule * std::sqrt(internal_forces(scene, solution.displacement_space,
                                                      solution.tables, solution.u)
                                          .energy_product);
  for (OfBoundary &boundary : boundaries)
    for (Goal &goal : boundary.goals)
    {
      if (!is_solved(goal))
        continue;
      double absolute = 0;
      goal.centre = 0;
      for (types::global_dof_index i = 0; i < goal.w.size(); ++i)
      {
        goal.centre += goal.w[i] * residual.sum[i];
        absolute += std::abs(goal.w[i]) * residual.absolute[i];
      }
      goal.rounding = 1e-14 * absolute +
                      loads.difference(Datum::load) * loads.sum().absolute * goal.test.largest() +
                      (space->strain_error() + missed) * goal.norm;
      const TractionWork work = work_of(goal.test, solution, bound);
      goal.of_stress = work.sum;
      goal.defect = work.defect(bound.imbalance);
      measure_lifts(goal, solution, bound);
      measure_pressure(goal, solution, bound);
    }
}

// The stress of the bound says the force as well, by its tractions. w is known along the boundary, and linear between the ends of
// edges and falls.
TractionWork ResultantIntervals::work_of(const TestMotion &motion, const Solution<2> &solution,
                                         const ErrorBound &bound) const
{
  const std::vector<double> l = space->lengths(motion);
  TractionWork work;
  for (const EdgeTraction &edge : bound.tractions)
    if (const auto cuts = motion.kinks(edge.boundary, edge.begin, edge.end, l); !cuts.empty())
      work.add(edge, solution, cuts, edge.n_coefficients() / 2 + 1,
               [&](const double, const Point<2> &x)
               {
                 Tensor<1, 2> w;
                 for (const PointCondition<2> &part : motion.conditions(edge.boundary, x, l))
                   w += part.value * part.direction;
                 return w;
               });
  return work;
}

// The pressure of the solution is that of s but for what any displacement X sees of their distance.
void ResultantIntervals::measure_lifts(Goal &goal, const Solution<2> &solution,
                                       const ErrorBound &bound) const
{
  goal.pressed = goal.lifted = 0;
  for (const Lift &lift : goal.lifts)
  {
    const TractionWork work = work_of(lift.test, solution, bound);
    goal.pressed += std::abs(work.sum) + work.defect(bound.imbalance);
    goal.lifted += (bound.total + bound.stress + bound.oscillation) * lift.norm;
  }
}

void ResultantIntervals::measure_pressure(Goal &goal, const Solution<2> &solution,
                                          const ErrorBound &bound) const
{
  goal.pressure = 0;
  goal.is_pressed = false;
  const std::vector<double> l = space->lengths(goal.test);
  for (unsigned int k = 0; k < l.size(); ++k)
  {
    const TestMotion::Fall &fall = goal.test.falls()[k];
    if (fall.kind != TractionKind::pressure)
      continue;
    if (bound.kind != BoundKind::energy) // what follows needs the least one
    {
      goal.is_pressed = true;
      return;
    }
    const OpenContact open(solution, bound, fall.boundary, fall.from);
    goal.is_pressed = goal.is_pressed || !(l[k] <= open.length() * (1 + 1e-9));
    if (!goal.is_pressed)
      goal.pressure += fall.offset.norm() * open.kappa(l[k]) * bound.energy;
  }
}

/** Of a sum of resultants of one boundary. */
std::optional<Interval>
ResultantIntervals::interval(const OfBoundary &boundary,
                             const std::vector<std::pair<BoundaryMotion, double>> &sum,
                             const ErrorBound &bound) const
{
  Interval result;
  double of_stress = 0, defect = 0;
  bool is_by_stress = true; // F_s takes edges for straight
  Vector<double> w;
  for (const auto &[motion, factor] : sum)
  {
    const Goal *const goal = boundary.find(motion);
    if (std::abs(factor) < 1e-14)
      continue;
    if (!goal || !flaw_of(*goal).empty() || goal->is_pressed)
      return std::nullopt;
    if (goal->w.size() == 0)
      continue; // no traction
    result.centre += factor * goal->centre;
    result.half_width += std::abs(factor) * (goal->friction + goal->pressed + goal->lifted +
                                             goal->pressure + goal->rounding);
    is_by_stress = is_by_stress && !goal->test.turns_along_curve();
    of_stress += factor * goal->of_stress;
    defect += std::abs(factor) * goal->defect;
    if (w.size() == 0)
      w.reinit(goal->w.size());
    w.add(factor, goal->w);
  }
  if (w.size() == 0)
    return result;
  const double norm = space->norm(w);
  if (!std::isfinite(norm + result.half_width)) // cells too flat for EnergyRule
    return std::nullopt;
  const double half_way =
      bound.radius * norm + bound.theta * (std::abs(of_stress - result.centre) + defect);
  result.half_width += is_by_stress ? std::min(half_way, bound.total * norm) : bound.total * norm;
  return result;
}

void ResultantIntervals::set(const OfBoundary &boundary, const ErrorBound &bound,
                             Resultant<2> &row) const
{
  using Motion = BoundaryMotion;
  const auto of = [&](const std::vector<std::pair<Motion, double>> &sum)
  { return interval(boundary, sum, bound); };
  if (!scene.is_axisymmetric())
    row.moment[0].interval = of({{Motion::moment, 1.}});
  const Side<2> &side = sides[boundary.boundary];
  if (row.kind != ForceKind::contact || !is_straight(side))
  {
    if (!scene.is_axisymmetric())
      row.force[0].interval = of({{Motion::x, 1.}});
    row.force[1].interval = of({{Motion::y, 1.}});
    return;
  }
  row.normal.interval = of({{Motion::normal, 1.}});
  row.friction.interval = of({{Motion::tangential, 1.}});
  const Tensor<1, 2> n =
      scene.boundaries[boundary.boundary].held_direction(side.normal(side.point(0, 0.5)));
  if (!scene.is_axisymmetric())
    row.force[0].interval = of({{Motion::normal, n[0]}, {Motion::tangential, -n[1]}});
  row.force[1].interval = of({{Motion::normal, n[1]}, {Motion::tangential, n[0]}});
}

namespace
{
/** What both sides of a pair bear is one force: the narrower interval is that of both, unless they contradict each other. */
void share(Measured &one, Measured &other, const double sign)
{
  std::optional<Interval> &a = one.interval, &b = other.interval;
  if (!a || !b || std::abs(a->centre - sign * b->centre) > a->half_width + b->half_width)
    return;
  if (a->half_width <= b->half_width)
    b = Interval{sign * a->centre, a->half_width};
  else
    a = Interval{sign * b->centre, b->half_width};
}

void share(const Scene<2> &scene, std::vector<Resultant<2>> &forces)
{
  const auto pair_of = [&](const Resultant<2> &row)
  { return row.kind == ForceKind::contact ? scene.boundaries[row.boundary].pair : std::nullopt; };
  for (auto row = forces.begin(); row != forces.end(); ++row)
    for (auto other = forces.begin(); other != row; ++other)
      if (pair_of(*row) && pair_of(*row) == pair_of(*other))
      {
        share(row->normal, other->normal, 1.);
        share(row->friction, other->friction, 1.);
        for (unsigned int d = 0; d < 2; ++d)
          share(row->force[d], other->force[d], -1.);
      }
}
} // namespace

std::string ResultantIntervals::set(const Solution<2> &solution, const ErrorBound &bound,
                                    std::vector<Resultant<2>> &forces)
{
  if (!has_goals)
    find_goals(forces);
  if (boundaries.empty())
    return {};
  const bool is_curved = scene.geometry.has_curves(); // a body of each step
  if (!space || is_curved ||
      !scene.pretensions.empty()) // loads of a bolt that is tightened are those of the step
    solve(solution);
  while (!is_curved && grade(solution, bound))
    solve(solution);
  measure(solution, bound);
  for (Resultant<2> &row : forces)
    for (const OfBoundary &boundary : boundaries)
      if (row.kind != ForceKind::load && row.boundary == boundary.boundary)
        set(boundary, bound, row);
  share(solution.scene, forces);
  return flaws();
}
} // namespace hpvi
