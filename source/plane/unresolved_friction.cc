// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/plane/contact_space.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

/** What friction can carry on @p face, to the points of the multiplier and to the integral. */
template <int dim>
UnresolvedBound<dim> ContactSpace<dim>::limit(const ContactFace<dim> &face,
                                              const Vector<double> &z) const
{
  UnresolvedBound<dim> result{&face, face.condition->friction.entry(), 0., 0., 0.};
  const bool knows_pressure = face.condition->friction.knows_pressure();
  for (unsigned int i = 0; i < face.n_multipliers; ++i)
  {
    const ContactMultiplier<dim> &unknown = unknowns[face.first_multiplier + i];
    result.sum +=
        unknown.weight * unknown.friction.continued(knows_pressure ? z[unknown.partner] : 0.);
  }
  for (const PointLimit &point : face.limits)
  {
    const double g = point.friction.continued(knows_pressure ? pressure(face, z, point.s) : 0.);
    result.integral += face.length * point.weight * g;
    result.absolute += face.length * point.weight * std::abs(g);
  }
  return result;
}

template <int dim>
std::vector<UnresolvedBound<dim>> ContactSpace<dim>::limits(const Vector<double> &z) const
{
  std::vector<UnresolvedBound<dim>> result;
  for (const ContactFace<dim> &face : contact_faces)
    result.push_back(limit(face, z));
  return result;
}

namespace
{
/** A part of what friction can carry on all faces. */
template <int dim>
double negligible_force(const std::vector<UnresolvedBound<dim>> &limits)
{
  double sum = 0;
  for (const UnresolvedBound<dim> &limit : limits)
    sum += limit.absolute;
  return 1e-6 * sum;
}
} // namespace

template <int dim>
std::vector<UnresolvedBound<dim>>
ContactSpace<dim>::unresolved_bounds(const Vector<double> &z) const
{
  std::vector<UnresolvedBound<dim>> result = limits(z);
  const double negligible = negligible_force(result);
  const auto is_resolved = [&](const UnresolvedBound<dim> &limit)
  { return std::abs(limit.sum - limit.integral) <= std::max(1e-3 * limit.absolute, negligible); };
  result.erase(std::remove_if(result.begin(), result.end(), is_resolved), result.end());
  return result;
}

/** What the limit on @p face grows by with a unit of g, or else of mu_f. */
template <int dim>
double ContactSpace<dim>::carried_by(const bool by_bound, const ContactFace<dim> &face,
                                     const Vector<double> &z) const
{
  if (!face.condition->friction.knows_pressure())
    return face.length;
  double carried = 0;
  for (unsigned int i = 0; i < face.n_multipliers; ++i)
  {
    const ContactMultiplier<dim> &unknown = unknowns[face.first_multiplier + i];
    const double p = z[unknown.partner];
    const bool capped = unknown.friction.is_capped(p);
    if (by_bound ? capped || std::isinf(unknown.friction.most) : !capped)
      carried += unknown.weight * (by_bound ? 1. : std::abs(p));
  }
  return carried;
}

template <int dim>
std::vector<UnresolvedJump<dim>> ContactSpace<dim>::unresolved_jumps(const Vector<double> &z) const
{
  const double negligible = negligible_force(limits(z));
  std::vector<UnresolvedJump<dim>> result;
  for (const ContactFace<dim> &face : contact_faces)
    for (const bool by_bound : {true, false})
      for (const FrictionRule::Jump &jump : (by_bound ? face.friction : face.coefficient).jumps)
        if (const double height = std::abs(jump.height),
            force = height * carried_by(by_bound, face, z);
            force > negligible)
          result.push_back(
              {&face, friction_entries[by_bound ? 0 : 1], face.point(jump.s), height, force});
  return result;
}

template std::vector<UnresolvedBound<2>>
ContactSpace<2>::unresolved_bounds(const Vector<double> &) const;
template std::vector<UnresolvedJump<2>>
ContactSpace<2>::unresolved_jumps(const Vector<double> &) const;
} // namespace hpvi
