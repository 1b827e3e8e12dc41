// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/base/tolerances.h>
#include <hpvi/output/boundary_words.h>
#include <hpvi/output/contact_report.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Has it a part along the axis alone, as forces on an axisymmetric body? */
template <int dim>
bool is_axial(const Tensor<1, dim> &force)
{
  return std::isnan(force[0]);
}

/** |F|, of an axial force that of its part along the axis. */
template <int dim>
double magnitude(const Tensor<1, dim> &force)
{
  return is_axial<dim>(force) ? std::abs(force[1]) : force.norm();
}

/** Forces below a part of this are round-off. */
template <int dim>
double largest_force(const Equilibrium<dim> &equilibrium)
{
  double largest = magnitude<dim>(equilibrium.loads.force);
  for (const BoundaryForce<dim> &force : equilibrium.reactions)
    largest = std::max(largest, magnitude<dim>(force.force));
  return largest;
}

/** As in "axial force 3"; round-off beside @p scale is zero. */
template <int dim>
std::string axial_force_in_words(const Tensor<1, dim> &force, const double scale)
{
  return "axial force " + text(std::abs(force[1]) > shown_as_zero * scale ? force[1] : 0., 6);
}
/** Beside which a force is round-off: around a closed curve tractions balance each other. */
template <int dim>
double force_scale(const Equilibrium<dim> &equilibrium, const ContactState<dim> &state)
{
  return std::max(largest_force(equilibrium),
                  std::abs(state.normal_resultant) + state.absolute_friction);
}

constexpr int digits = shown_digits;

/** As in "(0 7.6969)". */
template <int dim>
std::string point_text(const Tensor<1, dim> &x)
{
  std::string list;
  for (unsigned int d = 0; d < dim; ++d)
    list += (d > 0 ? " " : "") + text(x[d], digits);
  return "(" + list + ")";
}

template <int dim>
const BoundaryForce<dim> &force_of(const Equilibrium<dim> &equilibrium, const std::string &boundary)
{
  return *std::find_if(equilibrium.reactions.begin(), equilibrium.reactions.end(),
                       [&](const BoundaryForce<dim> &force) { return force.boundary == boundary; });
}

std::string moment_text(const double moment)
{
  return text(moment, digits);
}

std::string moment_text(const Tensor<1, 3> &moment)
{
  return point_text(moment);
}

std::string rotation_text(const double rotation)
{
  return text(rotation + 0., 6); // never -0
}

std::string rotation_text(const Tensor<1, 3> &rotation)
{
  return to_string(Point<3>(rotation));
}

/** As in "moment 3 about (0.5 0.5)". */
template <int dim>
std::string moment_text(const BoundaryForce<dim> &force, const Equilibrium<dim> &equilibrium)
{
  return "moment " + moment_text(force.moment) + " about " + point_text<dim>(equilibrium.centre);
}

/** Without the round-off of a component. */
template <int dim>
Tensor<1, dim> clean(Tensor<1, dim> x, const double scale)
{
  for (unsigned int d = 0; d < dim; ++d)
    if (std::abs(x[d]) < shown_as_zero * scale)
      x[d] = 0;
  return x;
}

/** Those on one contact boundary, or of von Mises' stress. */
template <int dim>
std::vector<StressSingularity<dim>> on(const types::boundary_id boundary,
                                       const std::vector<StressSingularity<dim>> &unbounded)
{
  std::vector<StressSingularity<dim>> result;
  std::copy_if(unbounded.begin(), unbounded.end(), std::back_inserter(result),
               [&](const auto &stress) { return stress.peak.boundary == boundary; });
  return result;
}

/** As in "pressure is unbounded at (1 0): 3e5 in the last cells, ...". */
template <int dim>
std::string in_words(const std::string &name, const Scene<dim> &scene,
                     const StressSingularity<dim> &stress)
{
  const bool is_pressure = stress.peak.boundary != numbers::invalid_boundary_id;
  return name + " is unbounded at " + point_text<dim>(stress.where) + ": " +
         with_unit(stress.peak.value, scene.stress_unit) + " in cells of " +
         with_unit(stress.peak.length, scene.length_unit) + ", more in smaller ones" +
         (is_pressure ? "; the last " + with_unit(stress.within, scene.length_unit) + " carry " +
                            text(stress.force, digits)
                      : "") +
         "; up to " + with_unit(stress.largest, scene.stress_unit) +
         (stress.largest > 0 ? " at " + point_text<dim>(stress.largest_point) : "") + " beyond " +
         with_unit(stress.beyond, scene.length_unit) + " from there";
}

/**
 * A point of the line along which a force acts, `(x - c) x F = M` with the moment M about the centre c: where it meets the contact
 * edge, or nearest to c where it is parallel to it. Null where there is no force beyond round-off beside @p scale [stress length].
 */
std::optional<Point<2>> line_of_action(const BoundaryForce<2> &boundary, const Point<2> &centre,
                                       const ContactState<2> &contact, const double scale)
{
  const Tensor<1, 2> &F = boundary.force;
  if (!(F.norm() > shown_as_zero * scale))
    return std::nullopt;
  const auto cross = [](const Tensor<1, 2> &a, const Tensor<1, 2> &b)
  { return a[0] * b[1] - a[1] * b[0]; };
  const Point<2> &begin = contact.begin;
  const Tensor<1, 2> edge = contact.end - begin;
  // (begin + s edge - c) x F = M
  if (std::abs(cross(edge, F)) > 1e-6 * edge.norm() * F.norm())
    return begin + (boundary.moment - cross(begin - centre, F)) / cross(edge, F) * edge;
  return centre + boundary.moment / F.norm_square() * Tensor<1, 2>({F[1], -F[0]});
}

/** In the plane a force has a line; in space in general none, but a moment. */
std::string acting(const BoundaryForce<2> &force, const Equilibrium<2> &equilibrium,
                   const ContactState<2> &state, const double scale)
{
  if (is_axial(force.force))
    return axial_force_in_words(force.force, scale);
  if (const auto line = line_of_action(force, equilibrium.centre, state, scale))
    return "force " + point_text(clean(force.force, scale)) + " through " +
           point_text<2>(clean<2>(*line, state.area));
  return "no force";
}

std::string acting(const BoundaryForce<3> &force, const Equilibrium<3> &equilibrium,
                   const ContactState<3> &, const double scale)
{
  return "force " + point_text(clean(force.force, scale)) + ", " + moment_text(force, equilibrium);
}

template <int dim>
std::string in_words(const ContactState<dim> &state, const StepReport<dim> &step)
{
  const Scene<dim> &scene = step.scene;
  const std::vector<StressSingularity<dim>> unbounded = on(state.slave, step.unbounded);
  const std::string &name = scene.boundaries[state.boundary].name;
  std::string words = "\ncontact " + name + ": " +
                      acting(force_of(step.equilibrium, name), step.equilibrium, state,
                             force_scale(step.equilibrium, state));
  for (const StressSingularity<dim> &stress : unbounded)
    words += "\n  " + in_words("pressure", scene, stress);
  if (state.highest_pressure > 0 && unbounded.empty())
    words += "\n  pressure up to " + with_unit(state.highest_pressure, scene.stress_unit) + " at " +
             point_text<dim>(state.highest_pressure_point);
  for (const ContactZone<dim> &zone : state.zones)
    words += "\n  " + mode_name(zone.mode) + " from " + point_text<dim>(zone.begin) + " to " +
             point_text<dim>(zone.end) + ", length " + with_unit(zone.length, scene.length_unit);
  if constexpr (dim == 3)
    words += "\n  open " + text(state.open_area, digits) + ", slip " +
             text(state.slipping_area, digits) + " of " + text(state.area, digits) +
             (unit_name(scene.length_unit).empty() ? "" : " " + scene.length_unit + "^2");
  if (state.deepest_penetration > 0)
    words += "\n  penetration between points up to " +
             with_unit(state.deepest_penetration, scene.length_unit) + " at " +
             point_text<dim>(state.deepest_penetration_point);
  return words + "\n";
}

using hpvi::json_value;

std::string json_value(const Tensor<1, 3> &value)
{
  return json_point<3>(value);
}

/** A place is null where the value there is zero. */
template <int dim>
std::string json_place(const double value, const Point<dim> &x)
{
  return value > 0 ? json_point<dim>(x) : "null";
}

/** As a list; von Mises' stress carries no force. */
template <int dim>
std::string json(const std::vector<StressSingularity<dim>> &unbounded)
{
  std::vector<std::string> list;
  for (const StressSingularity<dim> &stress : unbounded)
  {
    JsonMembers members{{"at", json_point<dim>(stress.where)},
                        {"value", json_value(stress.peak.value)}};
    if (stress.peak.boundary != numbers::invalid_boundary_id)
      members.insert(members.end(),
                     {{"within", json_value(stress.within)}, {"force", json_value(stress.force)}});
    members.insert(members.end(),
                   {{"beyond", json_value(stress.beyond)},
                    {"largest", json_value(stress.largest)},
                    {"largest_at", json_place<dim>(stress.largest, stress.largest_point)}});
    list.push_back(json_members(members));
  }
  return json_list(list, 8);
}

/** In space a force has a moment in the place of a line. */
std::pair<std::string, std::string> json_acting(const BoundaryForce<2> &force,
                                                const Equilibrium<2> &equilibrium,
                                                const ContactState<2> &state)
{
  const auto line =
      line_of_action(force, equilibrium.centre, state, force_scale(equilibrium, state));
  return {"through", line ? json_point<2>(*line) : "null"};
}

std::pair<std::string, std::string> json_acting(const BoundaryForce<3> &force,
                                                const Equilibrium<3> &, const ContactState<3> &)
{
  return {"moment", json_value(force.moment)};
}

template <int dim>
std::string json(const BoundaryForce<dim> &force)
{
  return json_members(
      {{"force", json_point<dim>(force.force)}, {"moment", json_value(force.moment)}});
}

template <int dim>
std::string balance_json(const Equilibrium<dim> &equilibrium)
{
  JsonMembers members{{"force", json_value(equilibrium.force_imbalance)},
                      {"moment", json_value(equilibrium.moment_imbalance)},
                      {"moments_about", json_point<dim>(equilibrium.centre)}},
      bodies;
  for (const auto &[name, force, moment] : equilibrium.bodies)
    bodies.emplace_back(
        name, json_members({{"force", json_value(force)}, {"moment", json_value(moment)}}));
  if (!bodies.empty())
    members.emplace_back("bodies", json_members(bodies, 6));
  return json_members(members, 4);
}

template <int dim>
std::string json(const ContactState<dim> &state, const StepReport<dim> &step)
{
  const BoundaryForce<dim> &force =
      force_of(step.equilibrium, step.scene.boundaries[state.boundary].name);
  JsonMembers members{
      {"force", json_point<dim>(force.force)},
      json_acting(force, step.equilibrium, state),
      {"normal_resultant", json_value(state.normal_resultant)},
      {"friction_resultant", json_value(state.friction_resultant)},
      {"largest_pressure", json_value(state.highest_pressure)},
      {"largest_pressure_at", json_place(state.highest_pressure, state.highest_pressure_point)},
      {"unbounded_pressure", json(on(state.slave, step.unbounded))},
      {"largest_penetration", json_value(state.deepest_penetration)},
      {"largest_penetration_at",
       json_place(state.deepest_penetration, state.deepest_penetration_point)}};
  if (dim == 2) // where its modes begin and end
  {
    std::vector<std::string> zones;
    for (const ContactZone<dim> &zone : state.zones)
      zones.push_back(json_members({{"state", json_string(mode_name(zone.mode))},
                                    {"from", json_point<dim>(zone.begin)},
                                    {"to", json_point<dim>(zone.end)},
                                    {"length", json_value(zone.length)}}));
    members.emplace_back("length", json_value(state.area));
    members.emplace_back("zones", json_list(zones, 8));
  }
  members.insert(members.end(), {{"area", json_value(state.area)},
                                 {"open_area", json_value(state.open_area)},
                                 {"slipping_area", json_value(state.slipping_area)}});
  return json_members(members, 6);
}

/** How the rigid plate on @p boundary moves and turns, the end of a line; empty where there is none. */
template <int dim>
std::string plate_in_words(const Scene<dim> &scene, const std::string &boundary,
                           const Equilibrium<dim> &equilibrium)
{
  for (const PlateState<dim> &plate : equilibrium.plates)
    if (scene.boundaries[plate.boundary].name == boundary)
    {
      const std::string unit = unit_name(scene.length_unit);
      return ", moves by " + to_string(Point<dim>(plate.displacement)) +
             (unit.empty() ? "" : " " + unit) + " and turns by " + rotation_text(plate.rotation) +
             " rad at " + to_string(plate.centre);
    }
  return {};
}
} // namespace

template <int dim>
std::string json_point(const Tensor<1, dim> &x)
{
  std::vector<std::string> list;
  for (unsigned int d = 0; d < dim; ++d)
    list.push_back(json_value(x[d]));
  return json_list(list);
}

template <int dim>
std::string contact_in_words(const StepReport<dim> &step)
{
  const Scene<dim> &scene = step.scene;
  const Equilibrium<dim> &equilibrium = step.equilibrium;
  std::string words;
  for (const ContactState<dim> &state : step.contact)
    words += in_words(state, step);
  double scale = largest_force(equilibrium);
  for (const ContactState<dim> &state : step.contact)
    scale = std::max(scale, force_scale(equilibrium, state));
  std::string separator = "\n";
  for (const BoundaryForce<dim> &reaction : equilibrium.reactions)
    if (std::none_of(step.contact.begin(), step.contact.end(),
                     [&](const ContactState<dim> &state)
                     { return scene.boundaries[state.boundary].name == reaction.boundary; }))
      words += std::exchange(separator, "") + kind_of_support(scene, reaction.boundary) + ": " +
               (is_axial(reaction.force) ? axial_force_in_words(reaction.force, scale)
                                         : "force " + point_text(clean(reaction.force, scale)) +
                                               ", " + moment_text(reaction, equilibrium)) +
               plate_in_words(scene, reaction.boundary, equilibrium) + "\n";
  for (const StressSingularity<dim> &stress : on(numbers::invalid_boundary_id, step.unbounded))
    words += "\n" + in_words("von Mises' stress", scene, stress) + "\n";
  return words;
}

template <int dim>
const StressSample<dim> &largest_von_mises(const StepReport<dim> &step)
{
  return *std::find_if(step.extrema.begin(), step.extrema.end(),
                       [](const auto &peak)
                       { return peak.boundary == numbers::invalid_boundary_id; });
}

template <int dim>
JsonMembers contact_members(const StepReport<dim> &step)
{
  const Equilibrium<dim> &equilibrium = step.equilibrium;
  const std::vector<BoundaryCondition<dim>> &boundaries = step.scene.boundaries;
  const StressSample<dim> &largest = largest_von_mises(step);
  JsonMembers forces{{equilibrium.loads.boundary, json(equilibrium.loads)}}, contact, plates;
  for (const BoundaryForce<dim> &force : equilibrium.reactions)
    forces.emplace_back(force.boundary, json(force));
  for (const ContactState<dim> &state : step.contact)
    contact.emplace_back(boundaries[state.boundary].name, json(state, step));
  for (const PlateState<dim> &plate : equilibrium.plates)
    plates.emplace_back(boundaries[plate.boundary].name,
                        json_members({{"mean_point", json_point<dim>(plate.centre)},
                                      {"displacement", json_point<dim>(plate.displacement)},
                                      {"rotation", json_value(plate.rotation)},
                                      {"moment", json_value(plate.moment)}}));
  return {{"forces", json_members(forces, 4)},
          {"balance", balance_json(equilibrium)},
          {"contact", json_members(contact, 4)},
          {"von_mises",
           json_members({{"largest", json_value(largest.value)},
                         {"at", json_point<dim>(largest.where)},
                         {"unbounded", json(on(numbers::invalid_boundary_id, step.unbounded))}},
                        4)},
          {"plates", json_members(plates, 4)}};
}

std::string loads_in_words(const Scene<2> &scene)
{
  if (const double t = scene.has_load_history() ? scene.loading.time(1) : 0.; t > 0)
    return "with t = " + text(t, digits) + ", " + loads_in_words(scene.loading.at(t));
  Triangulation<2> mesh;
  make_mesh(scene, mesh);
  const LoadRules<2> rules(scene, mesh, std::make_shared<const ShapeTables<2>>());
  const LoadSum sum = rules.sum().times(scene.thickness);
  const double none = shown_as_zero * scene.geometry.diameter() * sum.absolute;
  if (is_axial(sum.force))
    return "loads: " + axial_force_in_words(sum.force, sum.absolute) + '\n';
  return "loads: force " + point_text(clean(sum.force, sum.absolute)) + ", moment " +
         text(std::abs(sum.moment) < none ? 0. : sum.moment, digits) + " about " +
         point_text<2>(sum.centre) + (scene.has_plates() ? ", without those on rigid plates" : "") +
         "\n";
}

std::string loads_json(const std::optional<LoadSum> &loads)
{
  if (!loads)
    return "null";
  return json_members({{"force", json_point<2>(loads->force)},
                       {"moment", json_value(loads->moment)},
                       {"about", json_point<2>(loads->centre)}},
                      4);
}

template std::string json_point(const Tensor<1, 2> &);
template std::string json_point(const Tensor<1, 3> &);
template const StressSample<2> &largest_von_mises(const StepReport<2> &);
template const StressSample<3> &largest_von_mises(const StepReport<3> &);
template std::string contact_in_words(const StepReport<2> &);
template std::string contact_in_words(const StepReport<3> &);
template JsonMembers contact_members(const StepReport<2> &);
template JsonMembers contact_members(const StepReport<3> &);
} // namespace hpvi
