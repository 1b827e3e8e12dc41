// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/bodies_reader.h>
#include <hpvi/reader/body_reader.h>
#include <hpvi/reader/checks/checks.h>
#include <hpvi/reader/grid_cuts.h>
#include <hpvi/reader/input/expressions.h>
#include <hpvi/reader/input/parameters.h>
#include <hpvi/reader/material_reader.h>
#include <hpvi/reader/pretension_reader.h>
#include <hpvi/reader/shapes/hexahedra_from_file.h>
#include <hpvi/reader/shapes/mesh_from_file.h>
#include <hpvi/reader/shapes/shape.h>
#include <hpvi/scene/boundary_parts.h>
#include <hpvi/scene/hexahedral_mesh.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <iterator>
#include <regex>
#include <vector>

namespace hpvi
{
using namespace dealii;

std::map<std::string, double> constants_of(const Material &material, const std::optional<double> t)
{
  std::map<std::string, double> constants = material.constants();
  constants.emplace("pi", numbers::PI);
  if (t)
    constants.emplace("t", *t);
  return constants;
}

std::string remark_on_constants(const Material &material)
{
  return material.constants().empty()
             ? "; " + section_of_material(material.name) + " is orthotropic and has no E, nu and mu"
             : "";
}

template <int dim>
Expression<dim> read_where(const Parameters &parameters, const std::string &section,
                           const std::vector<Point<dim>> &points)
{
  const std::string where = parameters.text(section, "Where");
  if (where.empty())
    parameters.reject(section, "Where",
                      "is missing; give an expression that is positive there and nowhere else");
  static const std::regex t("\\bt\\b");
  if (std::regex_search(where, t))
    parameters.reject(section, "Where",
                      std::string("uses t, and a body keeps its parts; write a function of ") +
                          (dim == 2 ? "x and y" : "x, y and z"));
  const ExpressionReader<dim> reader(parameters, {{"pi", numbers::PI}});
  return reader.template read<1>(section, "Where", "", points)[0];
}

namespace
{
/** The value of an entry of the whole body, which any material may name; they have to agree. */
std::string common_value(const Parameters &parameters, const std::vector<Material> &materials,
                         const std::string &entry)
{
  std::string named_by = section_of_material("");
  for (const Material &material : materials)
    if (const std::string section = section_of_material(material.name);
        parameters.is_named(section, entry) && !parameters.text(section, entry).empty())
    {
      if (parameters.is_named(named_by, entry) &&
          parameters.text(named_by, entry) != parameters.text(section, entry))
        parameters.reject(section, entry,
                          "contradicts " + named_by + "/" + entry + " = " +
                              printable(parameters.text(named_by, entry)) +
                              "; the body has one, give it once");
      named_by = section;
    }
  return parameters.text(named_by, entry);
}

template <int dim>
void read_materials(const Parameters &parameters, const std::vector<std::string> &names,
                    Scene<dim> &scene)
{
  scene.materials = {read_material(parameters, dim, "")};
  for (const std::string &name : names)
    scene.materials.push_back(read_material(parameters, dim, name));
  if (dim == 2)
  {
    const PlaneModel plane = plane_model(common_value(parameters, scene.materials, "Plane"));
    for (Material &material : scene.materials)
      material.plane = plane;
    scene.thickness = std::stod(common_value(parameters, scene.materials, "Thickness"));
  }
  for (Material &material : scene.materials)
    read_elasticity(parameters, dim, material);
}

/** Surfaces of the mesh that a material names; none: that of its name. */
std::vector<std::string> surfaces_of(const Parameters &parameters, const Material &material,
                                     const std::vector<std::string> &surfaces)
{
  const std::string section = section_of_material(material.name);
  if (!parameters.has(section, "Surfaces") || parameters.text(section, "Surfaces").empty())
    return {material.name};
  const std::vector<std::string> named =
      Utilities::split_string_list(parameters.text(section, "Surfaces"), ',');
  for (const std::string &name : named)
    if (std::find(surfaces.begin(), surfaces.end(), name) == surfaces.end())
      parameters.reject(section, "Surfaces",
                        surfaces.empty()
                            ? "are those of a drawing or a mesh file; set Shape = file, or Where"
                            : "names " + printable(name) + ", which the mesh has not; it has " +
                                  listed(surfaces, "and"));
  return named;
}

/** By surface of the mesh. */
std::vector<std::optional<types::material_id>>
materials_of_surfaces(const Parameters &parameters, const std::vector<std::string> &surfaces,
                      const std::vector<Material> &materials)
{
  std::vector<std::optional<types::material_id>> result(surfaces.size());
  for (unsigned int m = 1; m < materials.size(); ++m)
  {
    const std::vector<std::string> own = surfaces_of(parameters, materials[m], surfaces);
    for (unsigned int s = 0; s < surfaces.size(); ++s)
      if (std::find(own.begin(), own.end(), surfaces[s]) != own.end())
      {
        if (result[s])
          parameters.reject(section_of_material(materials[m].name), "Surfaces",
                            "names " + surfaces[s] + ", which is made of " +
                                section_of_material(materials[*result[s]].name) +
                                " already; name it once");
        result[s] = m;
      }
  }
  return result;
}

template <int dim>
void place_materials(const Parameters &parameters, Scene<dim> &scene)
{
  std::vector<std::string> surfaces;
  if (scene.geometry.shape == Shape::file)
    surfaces = scene.geometry.mesh->surfaces;
  scene.material_of_surface = materials_of_surfaces(parameters, surfaces, scene.materials);
  if (scene.geometry.shape == Shape::bodies)
    scene.material_of_surface = materials_of_bodies(parameters, scene);
  const auto is_of_body = [&](const types::material_id m)
  {
    return scene.geometry.shape == Shape::bodies &&
           std::find(scene.material_of_surface.begin(), scene.material_of_surface.end(),
                     std::optional<types::material_id>(m)) != scene.material_of_surface.end();
  };
  std::vector<Expression<dim>> wheres{nullptr};
  bool has_where = false;
  for (unsigned int m = 1; m < scene.materials.size(); ++m)
  {
    const std::string section = section_of_material(scene.materials[m].name);
    const bool is_surface =
        !surfaces.empty() &&
        std::find(scene.material_of_surface.begin(), scene.material_of_surface.end(),
                  std::optional<types::material_id>(m)) != scene.material_of_surface.end();
    wheres.emplace_back();
    if (is_surface && !parameters.text(section, "Where").empty())
      parameters.reject(section, "Where",
                        "stands beside a surface of the mesh that has this name; keep one of the "
                        "two");
    if (is_surface || (is_of_body(m) && parameters.text(section, "Where").empty()))
      continue;
    if (!surfaces.empty() && parameters.text(section, "Where").empty())
      parameters.reject(section, "Where",
                        "is missing, and the mesh has no surface of this name; it has " +
                            listed(surfaces, "and"));
    wheres.back() = read_where(parameters, section, sample_body(scene.geometry));
    has_where = true;
    cut_body(scene, wheres.back(), section + "/Where");
  }
  if (has_where)
    scene.material_at = [wheres](const Point<dim> &x) -> types::material_id
    {
      for (unsigned int m = 1; m < wheres.size(); ++m)
        if (wheres[m] && wheres[m]->value(x) > 0)
          return m;
      return 0;
    };
}

template <int dim>
void read_part(const Parameters &parameters, const std::string &name, Scene<dim> &scene)
{
  const std::vector<std::string> sides = scene.geometry.boundary_names();
  std::vector<std::string> named; // edges of a mesh in no group have no name
  std::copy_if(sides.begin(), sides.end(), std::back_inserter(named),
               [](const std::string &side) { return !side.empty(); });
  const std::string section = "Boundary " + name;
  const auto side = std::find(sides.begin(), sides.end(), parameters.text(section, "On"));
  if (side == sides.end())
    parameters.reject(section, "On", "is no side of the body; give " + listed(named, "or"));
  BoundaryCondition<dim> part;
  part.name = name;
  part.id = scene.boundaries.size();
  part.side = side - sides.begin();
  part.where = read_where(parameters, section, sides_of(scene.geometry)[part.side].sample());
  cut_side(scene, part.side, part.where, section + "/Where");
  part.where = rest_of_part(parameters, scene, part);
  if (part.where)
    scene.boundaries.push_back(part);
}
} // namespace

template <int dim>
void read_body(const Parameters &parameters, const UserNames &names, Scene<dim> &scene)
{
  if (names.bodies.empty())
  {
    scene.geometry = read_geometry<dim>(parameters);
    scene.geometry.grading_levels = parameters.integer("Geometry", "Grading levels");
    scene.name_boundaries();
    if constexpr (dim == 2)
      cut_at_pretensions(parameters, names.pretensions, scene);
  }
  else
    read_bodies(parameters, names, scene);
  if constexpr (dim == 2)
    if (scene.geometry.shape == Shape::file || scene.geometry.shape == Shape::bodies)
    {
      for (const std::string &remark : scene.geometry.mesh->remarks)
        scene.remarks.push_back(remark);
      for (const std::string &remark : remarks_on_polygons(*scene.geometry.mesh))
        scene.remarks.push_back(remark);
    }
  if constexpr (dim == 3)
    if (const HexahedralMesh *const mesh = hexahedra_of(scene.geometry))
    {
      scene.remarks.insert(scene.remarks.end(), mesh->remarks.begin(), mesh->remarks.end());
      for (const std::string &remark : remarks_on_facets(*mesh))
        scene.remarks.push_back(remark);
    }
  read_materials(parameters, names.materials, scene);
  if constexpr (dim == 2)
    if (scene.is_axisymmetric())
      lay_on_axis(scene.geometry);
  const std::vector<Material> materials = scene.materials;
  scene.materials.resize(1); // the shape must be sound before functions are tried on it
  check_body(scene);
  scene.materials = materials;
  place_materials(parameters, scene);
  check_body(scene);
  for (const std::string &part : names.parts)
    read_part(parameters, part, scene);
  if constexpr (dim == 2)
    read_pretensions(parameters, names.pretensions, scene);
}

template <int dim>
std::vector<unsigned int> materials_along(const Scene<dim> &scene,
                                          const BoundaryCondition<dim> &boundary)
{
  if (!scene.has_material_places())
    return {0};
  std::vector<unsigned int> result;
  for (const CoarseFace<dim> &face : coarse_faces(scene.geometry, boundary.side))
    if (boundary_at(scene, boundary.side, middle_of(face)) == boundary.id)
      result.push_back(scene.material_of_coarse_cell(face.inside, face.cell));
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

template Expression<2> read_where(const Parameters &, const std::string &,
                                  const std::vector<Point<2>> &);
template Expression<3> read_where(const Parameters &, const std::string &,
                                  const std::vector<Point<3>> &);
template void read_body(const Parameters &, const UserNames &, Scene<2> &);
template void read_body(const Parameters &, const UserNames &, Scene<3> &);
template std::vector<unsigned int> materials_along(const Scene<2> &, const BoundaryCondition<2> &);
template std::vector<unsigned int> materials_along(const Scene<3> &, const BoundaryCondition<3> &);
} // namespace hpvi
