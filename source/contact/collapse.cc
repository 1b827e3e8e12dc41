// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/contact/collapse.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace hpvi
{
using namespace dealii;

namespace
{
/** A contact boundary, as a rigid body meets it. */
template <int dim>
struct ContactSide
{
  const BoundaryCondition<dim> *condition;
  Tensor<1, dim> normal, tangent;
  std::array<Point<dim>, 2> ends;             ///< along the tangent
  double friction = 0;                        ///< int of the limit without pressure
  double most = 0;                            ///< and with any pressure
  std::vector<std::array<double, 2>> mu = {}; ///< mu_f at distances from the first end
  bool is_oblique = false; ///< contact is not along the normal of the body: friction turns, too

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

template <int dim>
std::vector<ContactSide<dim>> contact_sides(const ContactSpace<dim> &contact_space)
{
  std::vector<ContactSide<dim>> sides;
  for (const ContactFace<dim> &face : contact_space.faces())
  {
    if (face.condition->pair)
      return {}; // words for what one body does
    const ContactFrame<dim> middle = face.frame(0.5);
    if (!sides.empty() && sides.back().condition == face.condition &&
        (face.map.is_curved() || (middle.normal - sides.back().normal).norm() > 1e-9))
      return {}; // words for what one line does
    if (sides.empty() || sides.back().condition != face.condition)
      sides.push_back(
          {face.condition, middle.normal, middle.tangent, {{face.point(0.), face.point(0.)}}});
    ContactSide<dim> &side = sides.back();
    side.is_oblique |=
        std::abs((face.point(1.) - face.point(0.)) * middle.normal) > 1e-10 * face.length;
    side.friction += face.friction_without_pressure();
    for (const PointLimit &point : face.limits)
      side.most += face.length * point.weight * point.friction.most;
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

template <int dim>
std::string entry_of(const BoundaryCondition<dim> &condition)
{
  return condition.friction ? condition.friction.entry_to_raise() : "";
}

/** One way to give way: what is missing to resist, in parts of the loads, and what to say. */
struct Way
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
};

template <int dim>
Loads loads_on(const ContactSide<dim> &side, const LoadedMotions<dim> &loaded)
{
  Loads result{loaded.along({side.normal, 0, {}}),
               loaded.along({side.tangent, 0, {}}),
               {{loaded.along({{}, 1., side.ends[0]}), loaded.along({{}, -1., side.ends[1]})}}};
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
Way lift(const ContactSide<dim> &side, const Loads &loads)
{
  std::ostringstream line;
  line.precision(10);
  line << "lifting off " << side.condition->name << ": the loads pull with "
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
Way slide(const ContactSide<dim> &side, const std::vector<ContactSide<dim>> &sides,
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
    names += (names.empty() ? "" : " and ") + other.condition->name;
  }
  std::ostringstream line;
  line.precision(10);
  line << "sliding along " << names << ": the loads push with " << T << ", ";
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
Way topple(const ContactSide<dim> &side, const unsigned int end, const Loads &loads)
{
  const double M = loads.M[end].value_or(0.), N = loads.N.value_or(0.);
  std::ostringstream line;
  line.precision(10);
  line << "toppling about (" << side.ends[end] << "): the loads turn the body with " << M;
  if (N > 1e-6 * loads.size)
  {
    Point<dim> meets = side.ends[end] + (end == 0 ? -M : M) / N * side.tangent;
    for (unsigned int d = 0; d < dim; ++d)
      if (std::abs(meets[d]) < 1e-12 * side.length()) // round-off
        meets[d] = 0;
    line << " and meet " << side.condition->name << " at (" << meets << "), beyond its end";
  }
  line << "; " << remedy("");
  return {M / side.length() / loads.size, line.str()};
}
} // namespace

template <int dim>
std::string friction_entry(const ContactSpace<dim> &contact_space)
{
  for (const ContactSide<dim> &side : contact_sides(contact_space))
    if (const std::string entry = entry_of(*side.condition); !entry.empty())
      return entry;
  return {};
}

template <int dim>
std::string collapse(const ContactSpace<dim> &contact_space, const LoadedMotions<dim> &loaded)
{
  static_assert(dim == 2, "boundaries with two ends");
  const std::vector<ContactSide<dim>> sides = contact_sides(contact_space);
  const bool is_alone = sides.size() == 1, is_coulomb = std::any_of(sides.begin(), sides.end(),
                                                                    [](const ContactSide<dim> &side)
                                                                    { return side.is_coulomb(); });
  Way worst;
  const auto consider = [&](const Way &way)
  {
    if (way.excess > worst.excess)
      worst = way;
  };
  for (const ContactSide<dim> &side : sides)
  {
    const Loads loads = loads_on(side, loaded);
    const bool presses = is_alone && side.condition->is_unilateral();
    if (const Way way = lift(side, loads); presses && way.excess > 1e-10)
      return way.words;
    if (std::all_of(sides.begin(), sides.end(),
                    [&](const ContactSide<dim> &other)
                    { return std::abs(other.normal * side.tangent) < 1e-10; }) &&
        (presses || !is_coulomb))
      consider(slide(side, sides, loads));
    for (const unsigned int end : {0U, 1U})
      if (presses && !side.is_oblique)
        consider(topple(side, end, loads));
  }
  return worst.excess > 1e-13 ? worst.words : "";
}

template std::string friction_entry(const ContactSpace<2> &);
template std::string collapse(const ContactSpace<2> &, const LoadedMotions<2> &);
} // namespace hpvi
