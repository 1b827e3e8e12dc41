// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/numbers.h>
#include <hpvi/base/tolerances.h>
#include <hpvi/plane/failure_mechanism.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace hpvi
{
using namespace dealii;

namespace
{
/** A contact boundary, as what moves on one side of it meets it. */
template <int dim>
struct ContactSide
{
  const BoundaryCondition<dim> *condition;
  TouchingBodies bodies;
  Tensor<1, dim> normal, tangent;
  std::array<Point<dim>, 2> ends;             ///< along the tangent
  double friction = 0;                        ///< int of the limit without pressure
  double most = 0;                            ///< and with any pressure
  std::vector<std::array<double, 2>> mu = {}; ///< mu_f at distances from the first end
  bool is_oblique = false; ///< contact is not along the normal of the body: friction turns, too
  bool is_line = true;     ///< with one normal: there are words for what one line does

  std::string name() const
  {
    return condition->pair ? condition->pair_name : condition->name;
  }

  bool is_coulomb() const
  {
    return std::any_of(mu.begin(), mu.end(), [](const auto &point) { return point[1] > 0.; });
  }

  double length() const
  {
    return ends[0].distance(ends[1]);
  }
};

constexpr unsigned int pieces = 8; ///< of a face, between which a coefficient is looked at

/** Forces of a body as thick as @p thickness. */
template <int dim>
std::vector<ContactSide<dim>> contact_sides(const ContactSpace<dim> &contact_space,
                                            const double thickness)
{
  std::vector<ContactSide<dim>> sides;
  for (const ContactFace<dim> &face : contact_space.faces())
  {
    const ContactFrame<dim> middle = face.frame(0.5);
    if (sides.empty() || sides.back().condition != face.condition)
      sides.push_back({face.condition,
                       face.bodies,
                       middle.normal,
                       middle.tangent,
                       {{face.point(0.), face.point(0.)}}});
    ContactSide<dim> &side = sides.back();
    side.is_line = side.is_line && !face.map.is_curved() &&
                   (middle.normal - side.normal).norm() <= same_normal &&
                   !face.condition->is_tied();
    side.is_oblique |=
        std::abs((face.point(1.) - face.point(0.)) * middle.normal) > 1e-10 * face.length;
    side.friction += thickness * face.friction_without_pressure();
    for (const PointLimit &point : face.limits)
      side.most += thickness * face.length * point.weight * point.friction.most;
    for (const double s : {0., 1.})
    {
      const Point<dim> x = face.point(s);
      if ((x - side.ends[0]) * side.tangent < 0)
        side.ends[0] = x;
      if ((x - side.ends[1]) * side.tangent > 0)
        side.ends[1] = x;
    }
  }
  for (const ContactFace<dim> &face : contact_space.faces())
    for (ContactSide<dim> &side : sides)
      for (unsigned int k = 0; k <= pieces && side.condition == face.condition; ++k)
      {
        const Point<dim> x = face.point(double(k) / pieces);
        side.mu.push_back({{x.distance(side.ends[0]), face.friction_coefficient(x)}});
      }
  return sides;
}

/** As the body on its other side meets it. */
template <int dim>
ContactSide<dim> reversed(ContactSide<dim> side)
{
  side.normal *= -1.;
  side.tangent *= -1.;
  std::swap(side.ends[0], side.ends[1]);
  for (auto &point : side.mu)
    point[0] = side.length() - point[0];
  return side;
}

/** Bodies that move as one, the others at rest. */
struct Group
{
  std::vector<unsigned int> bodies;

  bool has(const unsigned int body) const
  {
    return std::find(bodies.begin(), bodies.end(), body) != bodies.end();
  }
};

/** What touches the group from outside, as it meets that. */
template <int dim>
std::vector<ContactSide<dim>> around(const Group &group, const std::vector<ContactSide<dim>> &sides)
{
  std::vector<ContactSide<dim>> result;
  for (const ContactSide<dim> &side : sides)
    if (const bool is_inside = group.has(side.bodies[0]); is_inside != group.has(side.bodies[1]))
      result.push_back(is_inside ? side : reversed(side));
  return result;
}

/** Of each body that any motion moves. */
template <int dim>
std::vector<unsigned int> moving_bodies(const LoadedMotions<dim> &loaded)
{
  std::vector<unsigned int> result;
  const auto moves = [](const RigidBodyMotion<dim> &one)
  { return one.translation.norm() > 0 || one.rotation != 0; };
  for (unsigned int b = 0; b < loaded.n_bodies(); ++b)
    if (std::any_of(loaded.motions.begin(), loaded.motions.end(),
                    [&](const RigidBodyMotion<dim> &motion)
                    { return moves(b == 0 ? motion : motion.others[b - 1]); }))
      result.push_back(b);
  return result;
}

template <int dim>
std::vector<Group> groups_of(const LoadedMotions<dim> &loaded)
{
  std::vector<Group> result;
  const std::vector<unsigned int> bodies = moving_bodies(loaded);
  for (unsigned int bits = 1; bits < 1U << bodies.size(); ++bits)
  {
    result.emplace_back();
    for (unsigned int k = 0; k < bodies.size(); ++k)
      if ((bits >> k & 1) == 1)
        result.back().bodies.push_back(bodies[k]);
  }
  return result;
}

/** " upper and lid", or nothing where there is one body alone. */
template <int dim>
std::string names_of(const Group &group, const LoadedMotions<dim> &loaded)
{
  const RigidBodyMotion<dim> &motion = loaded.motions.front();
  std::string result;
  for (const unsigned int b : group.bodies)
    if (!motion.others.empty())
      result += (result.empty() ? " " : " and ") + (b == 0 ? motion : motion.others[b - 1]).name;
  return result;
}

template <int dim>
std::string entry_of(const BoundaryCondition<dim> &condition)
{
  return condition.friction ? condition.friction.entry_to_raise() : "";
}

/** One mechanism: what is missing to resist, in parts of the loads, and what to say. */
struct FailureMechanism
{
  double excess = 0;
  std::string words;
};

/** The loads that a boundary meets: pressing, along it, and about its ends; none that supports resist. */
struct Loads
{
  std::optional<double> N, T;
  std::array<std::optional<double>, 2> M; ///< positive where the other end leaves the foundation
  double size = 0;                        ///< of the largest, as a force
  std::string names;                      ///< of names_of()
};

template <int dim>
Loads loads_on(const Group &group, const ContactSide<dim> &side, const LoadedMotions<dim> &loaded)
{
  const auto along = [&](const RigidBodyMotion<dim> &motion)
  {
    RigidBodyMotion<dim> all = group.has(0) ? motion : RigidBodyMotion<dim>{{}, 0, motion.centre};
    for (unsigned int b = 1; b < loaded.n_bodies(); ++b)
      all.others.push_back(group.has(b) ? motion : RigidBodyMotion<dim>{{}, 0, motion.centre});
    std::optional<double> load = loaded.along(all);
    if (load)
      *load *= loaded.thickness;
    return load;
  };
  Loads result{along({side.normal, 0, {}}),
               along({side.tangent, 0, {}}),
               {{along({{}, 1., side.ends[0]}), along({{}, -1., side.ends[1]})}},
               0,
               names_of(group, loaded)};
  for (const std::optional<double> &force : {result.N, result.T})
    result.size = std::max(result.size, std::abs(force.value_or(0.)));
  for (const std::optional<double> &moment : result.M)
    result.size = std::max(result.size, std::abs(moment.value_or(0.)) / side.length());
  return result;
}

/** What to do against it, where friction of @p entry may help. */
std::string remedy(const std::string &entry)
{
  return entry.empty() ? "add a support or change the loads"
                       : "add a support, raise " + entry + " or lower the loads";
}

template <int dim>
FailureMechanism lift(const ContactSide<dim> &side, const Loads &loads)
{
  std::ostringstream line;
  line.precision(10);
  line << "lifting off " << side.name() << ": the loads pull" << loads.names << " with "
       << -loads.N.value_or(0.) << ", contact can only press; " << remedy("");
  return {-loads.N.value_or(0.) / loads.size, line.str()};
}

/**
 * The most that two pressures whose resultant acts at @p s, or anywhere, rub with, in parts of it: the least
 * concave function above the coefficient.
 */
template <int dim>
double coefficient_at(const ContactSide<dim> &side, const std::optional<double> &s)
{
  double largest = 0;
  for (const auto &[before, left] : side.mu)
    for (const auto &[behind, right] : side.mu)
      if (!s || before == behind)
        largest = std::max(largest, !s || before == *s ? std::max(left, right) : 0.);
      else if (before <= *s && *s <= behind)
        largest = std::max(largest, left + (right - left) * (*s - before) / (behind - before));
  return largest;
}

/** Along boundaries that are parallel, so that no pressure resists. */
template <int dim>
FailureMechanism slide(const ContactSide<dim> &side, const std::vector<ContactSide<dim>> &sides,
                       const Loads &loads)
{
  const double N = std::max(0., loads.N.value_or(0.)), T = std::abs(loads.T.value_or(0.));
  std::optional<double>
      s; // where the loads press, which they do on a side with a coefficient alone
  if (N > 0. && loads.M[0] && !side.is_oblique)
    s = std::clamp(-*loads.M[0] / N, 0., side.length());
  const double mu = coefficient_at(side, s);
  double limit = std::min(mu * N, side.most), without_pressure = 0;
  std::string names;
  for (const ContactSide<dim> &other : sides)
  {
    limit += other.friction;
    without_pressure += other.friction;
    names += (names.empty() ? "" : " and ") + other.name();
  }
  std::ostringstream line;
  line.precision(10);
  line << "sliding along " << names << ": the loads push" << loads.names << " with " << T << ", ";
  const std::string entry = entry_of(*side.condition);
  if (entry.empty())
    line << "nothing resists";
  else
    line << "friction resists with ";
  if (side.is_coulomb() && mu * N <= side.most)
  {
    line << mu << " * " << N;
    if (without_pressure > 0.)
      line << " + " << without_pressure;
    line << " = ";
  }
  if (!entry.empty())
    line << limit;
  if (!entry.empty() && side.friction == 0. && !side.is_coulomb())
    line << ", for " << entry
         << " vanishes wherever this mesh samples it; raise Geometry/Subdivisions, set "
            "Geometry/Graded towards where it acts, or add a support";
  else
    line << "; " << remedy(entry);
  return {(T - limit) / loads.size, line.str()};
}

/** About the end of a boundary that alone presses: the loads meet it at `s = M/N` beyond that end. */
template <int dim>
FailureMechanism topple(const ContactSide<dim> &side, const unsigned int end, const Loads &loads)
{
  const double M = loads.M[end].value_or(0.), N = loads.N.value_or(0.);
  std::ostringstream line;
  line.precision(10);
  line << "toppling about (" << side.ends[end] << "): the loads turn"
       << (loads.names.empty() ? " the body" : loads.names) << " with " << M;
  if (N > 1e-6 * loads.size)
  {
    Point<dim> meets = side.ends[end] + (end == 0 ? -M : M) / N * side.tangent;
    for (unsigned int d = 0; d < dim; ++d)
      if (std::abs(meets[d]) < shown_as_zero * side.length()) // round-off
        meets[d] = 0;
    line << " and meet " << side.name() << " at (" << meets << "), beyond its end";
  }
  line << "; " << remedy("");
  return {M / side.length() / loads.size, line.str()};
}

/** On one of the @p sides that touch what moves; with an infinite excess where it lifts off, which is said before all else. */
template <int dim>
FailureMechanism worst_on(const ContactSide<dim> &side, const std::vector<ContactSide<dim>> &sides,
                          const Loads &loads)
{
  const bool presses = sides.size() == 1 && side.condition->is_unilateral(),
             is_coulomb =
                 std::any_of(sides.begin(), sides.end(),
                             [](const ContactSide<dim> &other) { return other.is_coulomb(); });
  if (const FailureMechanism way = lift(side, loads); presses && way.excess > 1e-10)
    return {infinity, way.words};
  std::vector<FailureMechanism> ways{{}};
  if (std::all_of(sides.begin(), sides.end(),
                  [&](const ContactSide<dim> &other)
                  { return std::abs(other.normal * side.tangent) < 1e-10; }) &&
      (presses || !is_coulomb))
    ways.push_back(slide(side, sides, loads));
  for (const unsigned int end : {0U, 1U})
    if (presses && !side.is_oblique)
      ways.push_back(topple(side, end, loads));
  return *std::max_element(ways.begin(), ways.end(),
                           [](const FailureMechanism &a, const FailureMechanism &b)
                           { return a.excess < b.excess; });
}
} // namespace

template <int dim>
std::string friction_entry(const ContactSpace<dim> &contact_space)
{
  for (const ContactSide<dim> &side : contact_sides(contact_space, 1.))
    if (const std::string entry = entry_of(*side.condition); !entry.empty())
      return entry;
  return {};
}

template <int dim>
std::string failure_mechanism(const ContactSpace<dim> &contact_space,
                              const LoadedMotions<dim> &loaded)
{
  static_assert(dim == 2, "boundaries with two ends");
  const std::vector<ContactSide<dim>> all = contact_sides(contact_space, loaded.thickness);
  FailureMechanism worst;
  for (const Group &group : groups_of(loaded))
  {
    const std::vector<ContactSide<dim>> sides = around(group, all);
    if (!std::all_of(sides.begin(), sides.end(),
                     [](const ContactSide<dim> &side) { return side.is_line; }))
      continue;
    for (const ContactSide<dim> &side : sides)
    {
      const FailureMechanism way = worst_on(side, sides, loads_on(group, side, loaded));
      if (way.excess == infinity)
        return way.words;
      if (way.excess > worst.excess)
        worst = way;
    }
  }
  return worst.excess > 1e-13 ? worst.words : "";
}

template std::string friction_entry(const ContactSpace<2> &);
template std::string failure_mechanism(const ContactSpace<2> &, const LoadedMotions<2> &);
} // namespace hpvi
