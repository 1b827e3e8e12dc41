// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/base/tolerances.h>
#include <hpvi/reader/checks/checks.h>
#include <hpvi/reader/checks/rejection.h>
#include <hpvi/reader/scene_entries.h>
#include <hpvi/scene/boundary_parts.h>
#include <hpvi/scene/data_scale.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** The functions of one entry, and where they are tried. */
template <int dim>
struct EntryFunctions
{
  std::string section, name;
  std::array<Expression<dim>, dim> components;
  std::vector<Point<dim>> points;
};

template <int dim>
std::vector<EntryFunctions<dim>> functions_of(const Scene<dim> &scene)
{
  std::vector<EntryFunctions<dim>> result;
  for (const Load<dim> &force : scene.body_forces())
    result.push_back({"Body force", "Expression", force, sample_body(scene.geometry)});
  const std::vector<Side<dim>> sides = sides_of(scene);
  for (unsigned int b = 0; b < sides.size(); ++b)
  {
    const BoundaryCondition<dim> &boundary = scene.boundaries[b];
    const std::string section = section_of(boundary);
    const std::vector<Point<dim>> points = sides[b].sample();
    result.push_back({section, "Displacement", boundary.displacement, points});
    result.push_back({section, "Traction", boundary.traction, points});
    result.push_back({section, "Gap", {{boundary.gap}}, points});
  }
  return result;
}

/** Loads and displacements enter energies as squares; in load steps, checked by themselves, the smallest are 0. */
template <int dim>
void check_magnitude(const Scene<dim> &scene, const EntryFunctions<dim> &functions)
{
  for (const auto &component : functions.components)
  {
    double magnitude = 0;
    for (const Point<dim> &point : functions.points)
      if (const double value = component ? component->value(point) : 0.; std::isfinite(value))
        magnitude = std::max(magnitude, std::abs(value));
    const bool is_small =
        magnitude > 0 && magnitude < smallest_magnitude && !scene.has_load_history();
    if (magnitude > largest_magnitude || is_small)
      reject(scene, functions.section, functions.name,
             "has a component of magnitude " + to_string(magnitude) +
                 ", outside 1e-100 to 1e100; choose other units or write 0");
  }
}

template <int dim>
void check_finite(const Scene<dim> &scene, const EntryFunctions<dim> &functions)
{
  for (const auto &component : functions.components)
    for (const Point<dim> &point : functions.points)
      if (component && !std::isfinite(component->value(point)))
        reject(scene, functions.section, functions.name,
               "is not finite at " + to_string(point) +
                   "; give a function that is finite everywhere it applies");
}

/** Where a file says what kind of contact it is. */
template <int dim>
std::string law_entry(const BoundaryCondition<dim> &boundary)
{
  return boundary.pair ? "Law" : "Contact";
}

/** Under pressures as large as the loads: where they gather a solution is looked at again. */
template <int dim>
void check_friction_by_pressure(const Scene<dim> &scene, const std::string &section,
                                const FrictionLaw<dim> &law, const std::vector<Point<dim>> &points)
{
  constexpr std::size_t enough = 16; // along the boundary
  const double largest = data_scale(scene).stress;
  for (std::size_t k = 0; k < points.size(); k += 1 + points.size() / enough)
    if (const auto problem = law.problem(points[k], largest))
      reject(scene, section, problem->entry, problem->words);
}

template <int dim>
void check_friction(const Scene<dim> &scene, const std::string &section,
                    const BoundaryCondition<dim> &boundary, const std::vector<Point<dim>> &points)
{
  const FrictionLaw<dim> &law = boundary.friction;
  if (law && !boundary.has_contact())
    reject(scene, section, law.entry(), friction_needs_contact);
  if (law.knows_pressure() && boundary.contact == Contact::tangential)
    reject(scene, section, "Friction coefficient",
           "needs a pressure, which " + law_entry(boundary) +
               " = tangential has not; give Friction bound or set " + law_entry(boundary) +
               " = unilateral");
  if (const auto problem = law.problem(points))
    reject(scene, section, problem->entry, problem->words);
  if (law.by_pressure)
    check_friction_by_pressure(scene, section, law, points);
  if (boundary.contact == Contact::tangential &&
      std::all_of(points.begin(), points.end(),
                  [&](const Point<dim> &x) { return law.at(x).vanishes(); }))
    reject(scene, section, law_entry(boundary),
           "has friction nowhere to act, for Friction bound is 0 all along the boundary; give "
           "Friction bound > 0 or " +
               std::string(boundary.pair ? "remove the section" : "set Contact = none"),
           name_of(boundary.contact));
}

/** The entry of a boundary that gives its load, in a file; Traction where several do. */
template <int dim>
std::string entry_of_load(const Scene<dim> &scene, const std::string &section)
{
  for (const std::string entry : {"Pressure", "Shear"})
    if (scene.parameters && scene.parameters->text(section, "Traction").empty() &&
        (dim == 2 || entry == "Pressure") && !scene.parameters->text(section, entry).empty())
      return entry;
  return "Traction";
}

/** Neither has a meaning beside what decides the same motion. */
template <int dim>
void check_symmetry_and_springs(const Scene<dim> &scene, const BoundaryCondition<dim> &boundary)
{
  const std::string section = section_of(boundary);
  if (boundary.symmetry)
    for (const auto &[is_there, entry] :
         {std::pair<bool, std::string>{boundary.has_displacement(), "Displacement"},
          {boundary.has_contact(), "Contact"},
          {boundary.has_traction(), entry_of_load(scene, section)},
          {bool(boundary.spring), "Spring"}})
      if (is_there)
        reject(scene, section, "Symmetry",
               "contradicts " + mention(scene, section, entry) + "; remove one of the two", "true");
  if (boundary.spring && boundary.has_contact())
    reject(scene, section, "Spring",
           "stands beside Contact = " + name_of(boundary.contact) +
               "; keep one of the two, or give each a part of the side");
}

/** A plate decides all that a boundary does. */
template <int dim>
void check_plate(const Scene<dim> &scene, const BoundaryCondition<dim> &boundary)
{
  if (!boundary.plate)
    return;
  const std::string section = section_of(boundary);
  for (const auto &[is_there, entry] :
       {std::pair<bool, std::string>{boundary.has_displacement(), "Displacement"},
        {boundary.has_contact(), "Contact"},
        {boundary.symmetry, "Symmetry"},
        {boundary.has_traction(), entry_of_load(scene, section)},
        {bool(boundary.spring), "Spring"}})
    if (is_there)
      reject(scene, section, "Rigid",
             "contradicts " + mention(scene, section, entry) +
                 "; a rigid plate stands alone, give the other a part of the side",
             "true");
  for (unsigned int m = 0; m < RigidPlate<dim>::n_motions; ++m)
    for (const auto &[value, entry] :
         {std::pair{boundary.plate->displacement[m].value_or(0.),
                    m < dim ? "Displacement" : "Rotation"},
          std::pair{boundary.plate->force[m], m < dim ? "Force" : "Moment"}})
      if (!(std::abs(value) <= largest_magnitude))
        reject(scene, section, entry,
               "is not a number up to 1e100 that can be squared; choose other units",
               to_string(value));
}

/** A unit vector out of the body all along the boundary; at the end of a curved side it may be along it. */
template <int dim>
void check_direction(const Scene<dim> &scene, const BoundaryCondition<dim> &boundary,
                     const std::vector<Point<dim>> &points, const Side<dim> &side)
{
  if (!boundary.contact_direction)
    return;
  const std::string section = section_of(boundary), entry = "Contact direction";
  const Tensor<1, dim> &d = *boundary.contact_direction;
  if (!boundary.has_contact())
    reject(scene, section, entry, direction_needs_contact);
  if (!(std::abs(d.norm() - 1) < same_direction))
    reject(scene, section, entry, "has the length " + to_string(d.norm()) + "; give a unit vector");
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    const Point<dim> &x = points[k];
    const Tensor<1, dim> n = side.normal(x);
    const bool is_end = k == 0 || k + 1 == points.size();
    if (!(d * n > (is_end ? -same_direction : same_direction)))
      reject(scene, section, entry,
             "does not point out of the body at " + to_string(x) + ", where the normal is " +
                 to_string(Point<dim>(n)) + "; give a direction d with d . n > 0");
  }
}

/** A load needs a displacement that can give way, contact a boundary that nothing else holds. */
template <int dim>
void check_boundary(const Scene<dim> &scene, const BoundaryCondition<dim> &boundary,
                    const Side<dim> &side)
{
  const std::string section = section_of(boundary);
  for (unsigned int d = 0; d < dim; ++d)
    if (boundary.traction[d] != nullptr && boundary.displacement[d] != nullptr)
      reject(scene, section, entry_of_load(scene, section),
             std::string("acts on the component ") + "xyz"[d] +
                 " that Displacement prescribes; make that component 0 here or free "
                 "there");
  check_friction(scene, section, boundary, side.sample());
  if (boundary.gap != nullptr && !boundary.is_unilateral())
    reject(scene, section, "Gap", gap_needs_contact);
  check_direction(scene, boundary, side.sample(), side);
  check_symmetry_and_springs(scene, boundary);
  check_plate(scene, boundary);
  if (boundary.has_contact() && boundary.has_displacement())
    reject(scene, section, "Displacement",
           "stands beside Contact = " + name_of(boundary.contact) + "; keep only one of the two");
}
/** What code may have done to Scene::boundaries. */
template <int dim>
void check_list(const Scene<dim> &scene)
{
  const unsigned int n_sides = scene.geometry.boundary_names().size();
  if (scene.boundaries.size() < n_sides)
    fail(printable(scene.origin()), "Boundary",
         "has " + std::to_string(scene.boundaries.size()) + " instead of " +
             std::to_string(n_sides) + "; change those of a new scene, add parts and remove none");
  for (unsigned int b = 0; b < scene.boundaries.size(); ++b)
  {
    const BoundaryCondition<dim> &boundary = scene.boundaries[b];
    const std::string section = "Boundary " + boundary.name;
    if (boundary.id != b)
      fail(printable(scene.origin()), section,
           "has the id " + std::to_string(boundary.id) + " and stands at " + std::to_string(b) +
               "; leave ids and order as they are in a new scene, and give parts the next ids");
    if (b < n_sides ? boundary.side != b || boundary.where : boundary.side >= n_sides)
      fail(printable(scene.origin()), section,
           "lies on side " + std::to_string(boundary.side) +
               "; sides lie on themselves and have no Where, parts on one of them");
  }
}
} // namespace

template <int dim>
void check_boundaries(const Scene<dim> &scene)
{
  check_list(scene);
  check_parts(scene);
  const std::vector<Side<dim>> sides = sides_of(scene);
  const std::vector<EntryFunctions<dim>> all = functions_of(scene);
  for (const EntryFunctions<dim> &functions : all)
    check_magnitude(scene, functions);
  for (const EntryFunctions<dim> &functions : all) // after what is huge, which explains it
    check_finite(scene, functions);
  for (unsigned int b = 0; b < sides.size(); ++b)
    check_boundary(scene, scene.boundaries[b], sides[b]);
}

template void check_boundaries(const Scene<2> &);
template void check_boundaries(const Scene<3> &);
} // namespace hpvi
