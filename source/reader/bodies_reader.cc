// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/bodies_reader.h>
#include <hpvi/reader/body_reader.h>
#include <hpvi/reader/boundary_reader.h>
#include <hpvi/reader/checks/checks.h>
#include <hpvi/reader/grid_cuts.h>
#include <hpvi/reader/input/expressions.h>
#include <hpvi/reader/input/parameters.h>
#include <hpvi/reader/pair_sides.h>
#include <hpvi/reader/pretension_reader.h>
#include <hpvi/reader/scene_entries.h>
#include <hpvi/reader/shapes/shape.h>
#include <hpvi/reader/space_pairs.h>
#include <hpvi/scene/bodies.h>
#include <hpvi/scene/boundary_parts.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <map>

namespace hpvi
{
using namespace dealii;

namespace
{
/** In the order of the enumerators of Contact behind `none`. */
const std::vector<std::string> law_names = {"bilateral", "unilateral", "tangential", "tied"};

std::string section_of_body(const std::string &name)
{
  return "Body " + name;
}

std::string section_of_pair(const std::string &name)
{
  return "Contact " + name;
}
} // namespace

std::vector<Entry> body_entries(const int dim, const std::string &name)
{
  std::vector<Entry> entries = dim == 2 ? geometry_entries<2>() : geometry_entries<3>();
  entries.push_back({"", "Surfaces", "", std::make_shared<Patterns::Anything>(),
                     "names of surfaces \"A, B\" or nothing",
                     "The physical surfaces of File, in space its volumes, that make this body, as "
                     "several bodies may share a file; named curves, or surfaces, that bound them "
                     "are its boundaries; empty: all."});
  entries.push_back({"", "Material", "", std::make_shared<Patterns::Anything>(),
                     "the name of a material or nothing",
                     "The Material NAME of the body; empty: those that say Where they are, and the "
                     "unnamed one."});
  entries.push_back({"", "Start degree", "0", std::make_shared<Patterns::Integer>(0, 20),
                     "an integer from 0 to 20",
                     "Degree in space, 2 to 8; 0: that of Adaptivity/Start degree."});
  for (Entry &entry : entries)
    entry.section = section_of_body(name);
  return entries;
}

std::vector<Entry> pair_entries(const std::string &name)
{
  const auto text = std::make_shared<Patterns::Anything>();
  const std::string section = section_of_pair(name);
  return {
      {section, "Between", "", text, "two sides BODY.side, BODY.side, or automatic",
       "The two sides of bodies that touch, or parts of sides: of several pairs on one side each "
       "may have its own, a Boundary with On and Where. Normal, tangent and tractions in tables "
       "are those of the first. automatic: all sides of two bodies that lie on each other, or no "
       "farther apart than Closed within, and that no other pair, support or foundation has, each "
       "with what this section says; --validate prints the sections to copy."},
      {section, "Law", "unilateral",
       std::make_shared<Patterns::Selection>("unilateral|bilateral|tied|tangential"),
       "unilateral, bilateral, tied or tangential",
       "unilateral: the bodies may part, [u]_n <= u_0, and pull nowhere, [u] the displacement of "
       "one less that of the other. bilateral: they slide along each other, [u]_n = 0. tied: they "
       "are glued, [u] = 0. tangential: nothing in the normal direction, friction alone acts."},
      {section, "Gap", "", text, "one expression u_0 or nothing",
       "Distance u_0(x,y) beside that of the drawing, along the normal [length], negative: "
       "interference; of Law = unilateral; empty: 0."},
      {section, "Closed within", "0", std::make_shared<Patterns::Double>(0),
       "a number of 0 or more",
       "Distance of the drawing, or depth to which it has the sides in each other, up to which "
       "they "
       "count as touching [length]; 1 % of the size of the bodies at most; 0: what the drawing has "
       "is meant."},
      {section, "Friction bound", "", text, "one expression g >= 0 or nothing",
       "Tresca's bound g(x,y) >= 0 [stress], |T_t| <= g; empty or 0: no friction."},
      {section, "Friction coefficient", "", text, "one expression mu_f >= 0 or nothing",
       "Coulomb's coefficient mu_f(x,y) >= 0, |T_t| <= mu_f p, p = max(0, -T_n), which may use p "
       "as "
       "that of a Boundary; empty or 0: no friction."},
      {section, "Friction law", "automatic",
       std::make_shared<Patterns::Selection>("automatic|limited|cohesive"),
       "automatic, limited or cohesive",
       "What Friction bound g and Friction coefficient mu_f make together, as in a Boundary."},
      wear_entry(section),
      {section, "Slave", "automatic", text, "automatic or one of the two sides",
       "Which of the two sides has the multipliers. automatic: on each mesh the one with more of "
       "them, of equal ones the first."}};
}

namespace
{
/** A body by itself, checked; messages name its section. */
template <int dim>
Scene<dim> single_body(const Parameters &parameters, const std::string &name)
{
  Scene<dim> single;
  single.parameters = parameters.with_section("Geometry", section_of_body(name));
  single.geometry = read_geometry<dim>(*single.parameters);
  single.geometry.grading_levels = single.parameters->integer("Geometry", "Grading levels");
  if (single.geometry.mesh)
    single.remarks = single.geometry.mesh->remarks;
  if (single.geometry.shape != Shape::file &&
      !single.parameters->text("Geometry", "Surfaces").empty())
    single.parameters->reject("Geometry", "Surfaces",
                              "are those of a mesh file; set Shape = file or remove it");
  check_body(single);
  return single;
}

/** Grid lines of a box where materials end, unless the body names its own. */
template <int dim>
void cut_at_materials(const Parameters &parameters, const UserNames &names, const std::string &name,
                      Scene<dim> &body)
{
  if (!parameters.text(section_of_body(name), "Material").empty())
    return;
  for (const std::string &material : names.materials)
    if (const std::string section = section_of_material(material);
        !parameters.text(section, "Where").empty())
      cut_body(body, read_where(parameters, section, sample_body(body.geometry)),
               section + "/Where");
}

/** Grid lines of boxes where parts of sides and materials end, as of one body. */
void cut_bodies(const Parameters &parameters, const UserNames &names,
                std::vector<Scene<2>> &singles)
{
  for (unsigned int b = 0; b < singles.size(); ++b)
  {
    Scene<2> &body = singles[b];
    cut_at_pretensions(parameters, names.pretensions, body);
    cut_at_materials(parameters, names, names.bodies[b], body);
    for (const std::string &part : names.parts)
      for (unsigned int side = 0; side < body.geometry.boundary_names().size(); ++side)
        if (const std::string section = "Boundary " + part;
            parameters.text(section, "On") ==
            names.bodies[b] + "." + body.geometry.boundary_names()[side])
          cut_side(body, side,
                   read_where(parameters, section, sides_of(body.geometry)[side].sample()),
                   section + "/Where");
  }
}

/** Bodies become one geometry, whose boundaries are BODY.side. */
template <int dim>
void join(const UserNames &names, const std::vector<Scene<dim>> &singles, Scene<dim> &scene)
{
  std::vector<SingleBody<dim>> bodies;
  for (unsigned int b = 0; b < singles.size(); ++b)
  {
    bodies.push_back({names.bodies[b], singles[b].geometry});
    for (const std::string &remark : singles[b].remarks)
      scene.remarks.push_back(section_of_body(names.bodies[b]) + ": " + remark);
  }
  scene.geometry = geometry_of_bodies(bodies);
  scene.name_boundaries();
}
} // namespace

void read_bodies(const Parameters &parameters, const UserNames &names, Scene<2> &scene)
{
  std::vector<Scene<2>> singles;
  for (const std::string &name : names.bodies)
  {
    singles.push_back(single_body<2>(parameters, name));
    if (parameters.integer(section_of_body(name), "Start degree") > 0)
      parameters.reject(section_of_body(name), "Start degree",
                        "is for bodies in space; give Adaptivity/Start degree, or a method of hp");
  }
  cut_bodies(parameters, names, singles);
  const std::vector<NamedSide> sides = named_sides(parameters, names, singles);
  std::vector<PairSides> pairs;
  for (const std::string &name : names.pairs)
    pairs.push_back(read_pair_sides(parameters, section_of_pair(name), name, sides, singles));
  if (parameters.text("Error", "Bound") != "false")
    carry_on_cuts(pairs, singles);
  for (PairSides &pair : pairs)
  {
    if (!pair.line)
      match_edges(parameters, singles, pair);
    if (!pair.closed.empty())
      scene.remarks.push_back(pair.closed);
  }
  check_overlap(parameters, pairs);
  join(names, singles, scene);
  for (const PairSides &pair : pairs)
    add_parts(pair, scene);
}

void read_bodies(const Parameters &parameters, const UserNames &names, Scene<3> &scene)
{
  std::vector<Scene<3>> singles;
  for (const std::string &name : names.bodies)
  {
    singles.push_back(single_body<3>(parameters, name));
    scene.adaptivity.degrees_of_bodies.push_back(
        parameters.integer(section_of_body(name), "Start degree"));
    cut_at_materials(parameters, names, name, singles.back());
  }
  std::vector<SpacePair> pairs;
  for (const std::string &name : names.pairs)
    pairs.push_back(read_space_pair(parameters, section_of_pair(name), name, names, singles));
  for (SpacePair &pair : pairs)
  {
    match_faces(parameters, singles, pair);
    if (!pair.closed.empty())
      scene.remarks.push_back(pair.closed);
  }
  join(names, singles, scene);
  for (const SpacePair &pair : pairs)
    add_parts(pair, scene);
}

namespace
{
/** What `Between` calls the side, or part of a side, of which @p part of a pair takes its edges. */
template <int dim>
std::string taken_from(const Parameters &parameters, const Scene<dim> &scene,
                       const BoundaryCondition<dim> &part)
{
  const unsigned int k = scene.pairs[*part.pair].parts[0] == part.id ? 0 : 1;
  return Utilities::split_string_list(parameters.text(section_of_pair(part.pair_name), "Between"),
                                      ',')[k];
}
} // namespace

template <int dim>
Expression<dim> rest_of_part(const Parameters &parameters, const Scene<dim> &scene,
                             const BoundaryCondition<dim> &part)
{
  std::vector<Expression<dim>> taken;
  for (const BoundaryCondition<dim> &other : scene.boundaries)
    if (other.pair && taken_from(parameters, scene, other) == part.name)
      taken.push_back(other.where);
  if (taken.empty())
    return part.where;
  const Expression<dim> rest = expression<dim>(
      [where = part.where, taken](const Point<dim> &x)
      {
        return std::any_of(taken.begin(), taken.end(),
                           [&](const Expression<dim> &one) { return one->value(x) > 0; })
                   ? -1.
                   : where->value(x);
      });
  const std::vector<CoarseFace<dim>> faces = coarse_faces(scene.geometry, part.side);
  const bool has_any =
      std::any_of(faces.begin(), faces.end(),
                  [&](const CoarseFace<dim> &face) { return rest->value(middle_of(face)) > 0; });
  return has_any ? rest : nullptr;
}

template <int dim>
void check_covered_sides(const Parameters &parameters, const Scene<dim> &scene)
{
  const std::vector<Side<dim>> sides = sides_of(scene);
  for (const BoundaryCondition<dim> &part : scene.boundaries)
  {
    if (!part.pair)
      continue;
    const std::string name = taken_from(parameters, scene, part), section = "Boundary " + name;
    if (std::any_of(scene.boundaries.begin(), scene.boundaries.end(),
                    [&](const BoundaryCondition<dim> &rest)
                    { return !rest.pair && rest.name == name && !sides[rest.id].pieces.empty(); }))
      continue;
    for (const char *const entry :
         {"Displacement", "Traction", "Pressure", "Shear", "Symmetry", "Spring", "Rigid", "Force",
          "Rotation", "Moment", "Contact", "Gap", "Contact direction", "Friction bound",
          "Friction coefficient", "Wear coefficient"})
      if (parameters.has(section, entry) && says_something(parameters, section, entry) &&
          (entry != std::string("Wear coefficient") || parameters.number(section, entry) > 0))
        parameters.reject(section, entry,
                          "acts nowhere, for " + section_of_pair(part.pair_name) +
                              " has all of this side; remove it");
  }
}

template <int dim>
std::vector<std::optional<types::material_id>> materials_of_bodies(const Parameters &parameters,
                                                                   const Scene<dim> &scene)
{
  const auto called = [&](const std::string &name) -> std::optional<types::material_id>
  {
    for (unsigned int m = 1; m < scene.materials.size(); ++m)
      if (scene.materials[m].name == name)
        return m;
    return std::nullopt;
  };
  const CoarseMesh &mesh = *scene.geometry.mesh;
  std::vector<std::optional<types::material_id>> result;
  for (const std::string &surface : mesh.surfaces)
    result.push_back(called(surface));
  for (unsigned int b = 0; b < scene.geometry.bodies.size(); ++b)
  {
    const std::string section = section_of_body(scene.geometry.bodies[b].name),
                      name = parameters.text(section, "Material");
    if (name.empty())
      continue;
    const std::optional<types::material_id> material = called(name);
    if (!material)
      parameters.reject(section, "Material",
                        "is no material of this scene; open subsection Material " + name +
                            " or leave the entry empty");
    for (const CoarseMesh::Cell &cell : mesh.cells)
      if (cell.body == b)
        result[cell.surface] = material;
  }
  return result;
}

template <int dim>
void read_pair(const Parameters &parameters, const std::optional<double> t, const Scene<dim> &scene,
               BoundaryCondition<dim> &part)
{
  const std::string section = section_of_pair(part.pair_name);
  std::map<std::string, double> constants{{"pi", numbers::PI}};
  if (t)
    constants.emplace("t", *t);
  const ExpressionReader<dim> expressions(parameters, constants,
                                          "; E, nu and mu are those of no body here");
  const ContactPair &pair = scene.pairs[*part.pair];
  // Both parts are tried at the same places, so that they say the same.
  const std::vector<Point<dim>> points = sides_of(scene)[pair.parts[0]].sample();
  part.contact = static_cast<Contact>(
      1 + (std::find(law_names.begin(), law_names.end(), parameters.text(section, "Law")) -
           law_names.begin()));
  const bool is_apart = part.gap != nullptr;
  part.gap = sum<dim>(part.gap, 1., expressions.template read<1>(section, "Gap", "0", points)[0]);
  part.friction = expressions.read_friction(section, points);
  part.friction.form =
      read_choice<FrictionForm>(parameters, section, "Friction law", friction_law_names);
  part.wear = read_wear(parameters, section, !part.is_tied());
  if (!part.is_unilateral() && !parameters.text(section, "Gap").empty())
    parameters.reject(section, "Gap",
                      "needs contact that can open; set Law = unilateral or remove it");
  if ((part.is_tied() || part.contact == Contact::bilateral) && is_apart)
    parameters.reject(section, "Law",
                      "needs bodies that touch, and " + scene.boundaries[pair.parts[0]].name +
                          " and " + scene.boundaries[pair.parts[1]].name +
                          " lie apart; move them together, set Closed within, or unilateral");
  for (const char *const entry : {"Friction bound", "Friction coefficient"})
    if (part.is_tied() && !parameters.text(section, entry).empty())
      parameters.reject(section, entry, "means nothing where bodies are tied; remove it");
}

template Expression<2> rest_of_part(const Parameters &, const Scene<2> &,
                                    const BoundaryCondition<2> &);
template Expression<3> rest_of_part(const Parameters &, const Scene<3> &,
                                    const BoundaryCondition<3> &);
template void check_covered_sides(const Parameters &, const Scene<2> &);
template void check_covered_sides(const Parameters &, const Scene<3> &);
template std::vector<std::optional<types::material_id>> materials_of_bodies(const Parameters &,
                                                                            const Scene<2> &);
template std::vector<std::optional<types::material_id>> materials_of_bodies(const Parameters &,
                                                                            const Scene<3> &);
template void read_pair(const Parameters &, std::optional<double>, const Scene<2> &,
                        BoundaryCondition<2> &);
template void read_pair(const Parameters &, std::optional<double>, const Scene<3> &,
                        BoundaryCondition<3> &);
} // namespace hpvi
