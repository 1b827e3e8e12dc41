// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/results/warnings/line.h>
#include <hpvi/results/warnings/warnings.h>
#include <hpvi/scene/bare_joints.h>
#include <hpvi/scene/boundary_parts.h>
#include <hpvi/scene/data_scale.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** A stress that the last bits of u make, or that is nothing beside the data, is none. */
template <int dim>
double round_off_stress(const Scene<dim> &scene, const BodyState<dim> &body)
{
  return round_off_of_data *
         std::max(scene.largest_weight() * body.displacement / scene.geometry.diameter(),
                  data_scale(scene).stress);
}

/** The pulling part of the normal traction is compared with the whole; a corner alone is not worth a word. */
template <int dim>
Warnings tensile_contact(const Scene<dim> &scene, const std::vector<ContactState<dim>> &contact,
                         const BodyState<dim> &body)
{
  double tension = 0, all = 0;
  const ContactState<dim> *worst = nullptr;
  for (const ContactState<dim> &state : contact)
  {
    if (scene.boundaries[state.boundary].contact != Contact::bilateral)
      continue;
    tension += state.tension;
    all += 2 * state.tension - state.normal_resultant;
    if (!worst || state.highest_tension > worst->highest_tension)
      worst = &state;
  }
  if (!worst || !(tension > 0.01 * all && worst->highest_tension > round_off_stress(scene, body)))
    return {};
  return {
      {WarningKind::tension, tension / all,
       line("bilateral contact pulls: ", 100 * tension / all,
            " % of the normal traction is tensile, up to ",
            labelled(worst->highest_tension, scene.stress_unit), " at (",
            worst->highest_tension_point, "); a body that may lift off needs unilateral contact")}};
}

/** Pressures are positive at the points of the multiplier, the polynomial through them need not be. */
template <int dim>
Warnings pulling_pressure(const Scene<dim> &scene, const std::vector<ContactState<dim>> &contact,
                          const BodyState<dim> &body)
{
  const ContactState<dim> *worst = nullptr;
  double share = 0.05;
  for (const ContactState<dim> &state : contact)
    if (scene.boundaries[state.boundary].is_unilateral() &&
        state.highest_tension > share * state.highest_pressure &&
        state.highest_tension > round_off_stress(scene, body))
    {
      worst = &state;
      share = state.highest_tension / state.highest_pressure;
    }
  if (!worst)
    return {};
  return {{WarningKind::pulling_pressure, share,
           line("contact pulls between the points of its multiplier, with up to ",
                labelled(worst->highest_tension, scene.stress_unit), " at (",
                worst->highest_tension_point, "), ", 100 * share,
                " % of the largest pressure; refine there")}};
}

/** The foundation holds the body at points or in moments only. Rigid motions of the whole scene do not change the verdict. */
template <int dim>
Warnings penetration(const Scene<dim> &scene, const std::vector<ContactState<dim>> &contact,
                     const BodyState<dim> &body)
{
  const ContactState<dim> *worst = nullptr;
  for (const ContactState<dim> &state : contact)
    if (!worst || state.deepest_penetration > worst->deepest_penetration)
      worst = &state;
  if (!worst || !(worst->deepest_penetration > 0.01 * body.deformation))
    return {};
  return {
      {WarningKind::penetration, worst->deepest_penetration,
       line(scene.boundaries[worst->boundary].pair ? "the bodies penetrate each other or part at "
                                                   : "the body penetrates the foundation of ",
            scene.boundaries[worst->boundary].name, " by up to ",
            labelled(worst->deepest_penetration, scene.length_unit), " at (",
            worst->deepest_penetration_point, "), more than 1 % of the ",
            labelled(body.deformation, scene.length_unit),
            " by which it deforms; refine there, or put a vertex where Gap has a kink or a "
            "jump")}};
}

/** In space no picture shows a body that is moved away from its foundation. */
template <int dim>
Warnings no_contact(const Scene<dim> &scene, const std::vector<ContactState<dim>> &contact)
{
  std::vector<std::string> names;
  for (const ContactState<dim> &state : contact)
  {
    const BoundaryCondition<dim> &boundary = scene.boundaries[state.boundary];
    if (dim == 2 || !boundary.is_unilateral() || state.open_area < (1 - 1e-9) * state.area)
      return {};
    names.push_back(name_and_place(scene, boundary));
  }
  if (names.empty())
    return {};
  return {{WarningKind::no_contact, 0.,
           "nothing touches: " + listed(names, "and") + (names.size() == 1 ? " is" : " are") +
               " open all over; check which side that is, and the signs of loads, displacements "
               "and Gap"}};
}

/**
 * What lies opposite to a point of two bodies is found along the normal of one of them, and tractions have that normal on
 * both. Where the gap has a slope the other one's differs by it, and forces by slope times friction, slips by slope times gap.
 */
template <int dim>
Warnings steep_gaps(const Scene<dim> &scene, const std::vector<ContactState<dim>> &contact)
{
  constexpr double steep = 0.2;
  double steepest = steep;
  Point<dim> where;
  const BoundaryCondition<dim> *worst = nullptr;
  for (const ContactState<dim> &state : contact)
  {
    const BoundaryCondition<dim> &condition = scene.boundaries[state.boundary];
    if (!condition.pair || !condition.gap)
      continue;
    for (unsigned int k = 0; k + 1 < state.points.size(); ++k)
    {
      const ContactPoint<dim> &one = state.points[k], &other = state.points[k + 1];
      const double distance = one.x.distance(other.x);
      if (one.is_open || other.is_open || !(distance > 0))
        continue;
      const double slope = std::abs(condition.gap_at(other.x) - condition.gap_at(one.x)) / distance;
      if (slope > steepest)
      {
        steepest = slope;
        where = one.x;
        worst = &condition;
      }
    }
  }
  if (!worst)
    return {};
  return {{WarningKind::gap_slope, steepest,
           line("the gap of ", worst->name, " has a slope of ", steepest, " at (", where,
                "), where bodies press; both are taken for parallel there, which is true of "
                "slopes up to ",
                steep, ": draw the sides so that they nearly are")}};
}

Warnings joints_without_pair(const Scene<2> &scene)
{
  const std::vector<BareJoint<2>> joints = bare_joints(scene);
  if (joints.empty())
    return {};
  const auto &[sides, at] = joints.front();
  return {{WarningKind::bare_joint, static_cast<double>(joints.size()),
           line(sides[0], " and ", sides[1], " lie on each other at (", at,
                ") and no Contact names them",
                joints.size() > 1 ? line(", one of ", joints.size(), " such joints") : "",
                ": the bodies part or pass through each other there; open a subsection Contact "
                "NAME with Between = ",
                sides[0], ", ", sides[1])}};
}

/** One body. */
Warnings joints_without_pair(const Scene<3> &)
{
  return {};
}
} // namespace

template <int dim>
Warnings contact_warnings(const Scene<dim> &scene, const std::vector<ContactState<dim>> &contact,
                          const BodyState<dim> &body)
{
  return joined(tensile_contact(scene, contact, body), pulling_pressure(scene, contact, body),
                penetration(scene, contact, body), steep_gaps(scene, contact),
                no_contact(scene, contact), joints_without_pair(scene));
}

template Warnings contact_warnings(const Scene<2> &, const std::vector<ContactState<2>> &,
                                   const BodyState<2> &);
template Warnings contact_warnings(const Scene<3> &, const std::vector<ContactState<3>> &,
                                   const BodyState<3> &);
} // namespace hpvi
