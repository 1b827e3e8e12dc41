// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/display_name.h>
#include <hpvi/base/input_error.h>
#include <hpvi/base/text.h>
#include <hpvi/reader/shapes/box.h>
#include <hpvi/reader/shapes/half_disc.h>
#include <hpvi/reader/shapes/hexahedra_from_file.h>
#include <hpvi/reader/shapes/mesh_from_file.h>
#include <hpvi/reader/shapes/plate_with_hole.h>
#include <hpvi/reader/shapes/quadrilateral.h>
#include <hpvi/reader/shapes/ring_sector.h>
#include <hpvi/reader/shapes/shape.h>
#include <hpvi/scene/hexahedral_mesh.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace hpvi
{
using namespace dealii;

template <int dim>
const std::vector<ShapeKind<dim>> &shapes()
{
  static const std::vector<ShapeKind<dim>> all = []()
  {
    std::vector<ShapeKind<dim>> kinds{box_shape<dim>()};
    if constexpr (dim == 2)
      for (const ShapeKind<2> &kind :
           {quadrilateral_shape(), ring_sector_shape(), half_disc_shape(), plate_with_hole_shape(),
            mesh_from_file()})
        kinds.push_back(kind);
    else
      kinds.push_back(hexahedra_from_file());
    return kinds;
  }();
  return all;
}

template <int dim>
const ShapeKind<dim> *find_shape(const Shape shape)
{
  for (const ShapeKind<dim> &kind : shapes<dim>())
    if (kind.shape == shape)
      return &kind;
  return nullptr;
}

template <int dim>
std::string name_of_shape(const Shape shape)
{
  const ShapeKind<dim> *const kind = find_shape<dim>(shape);
  return kind == nullptr ? "shape" : kind->name;
}

template <int dim>
std::shared_ptr<const Patterns::PatternBase> point_pattern()
{
  return std::make_shared<Patterns::List>(Patterns::Double(), dim, dim, ",");
}

Entry centre_entry()
{
  return {"Geometry",
          "Centre",
          "0, 0",
          point_pattern<2>(),
          "two finite numbers \"x, y\"",
          "Centre of the circles of a ring sector, a half disc or a hole, x, y [length]."};
}

Entry radius_entry()
{
  return {"Geometry",
          "Radius",
          "1",
          std::make_shared<Patterns::Double>(),
          "a positive number",
          "Radius of a half disc or a hole [length]."};
}

namespace
{
template <int dim>
Entry corner_entry(const std::string &name, const std::string &number, const std::string &which)
{
  const PointWords<dim> words;
  std::string value = number;
  for (unsigned int d = 1; d < dim; ++d)
    value += ", " + number;
  return {"Geometry",
          name,
          value,
          point_pattern<dim>(),
          words.number + " finite numbers \"" + words.axes + "\"",
          "Corner of the box with the " + which + " coordinates, " + words.axes + " [length]."};
}
} // namespace

template <int dim>
Entry lower_corner_entry()
{
  return corner_entry<dim>("Lower corner", "0", "smallest");
}

template <int dim>
Entry upper_corner_entry()
{
  return corner_entry<dim>("Upper corner", "1", "largest");
}

template <int dim>
std::vector<Entry> geometry_entries()
{
  const PointWords<dim> words;
  std::vector<std::string> names;
  std::string pattern, documentation;
  std::vector<Entry> own;
  for (const ShapeKind<dim> &kind : shapes<dim>())
  {
    names.push_back(kind.name);
    pattern += (pattern.empty() ? "" : "|") + kind.name;
    documentation += (documentation.empty() ? "" : " ") + kind.documentation;
    for (const Entry &entry : kind.entries)
      if (std::none_of(own.begin(), own.end(),
                       [&](const Entry &known) { return known.name == entry.name; }))
        own.push_back(entry);
  }
  const Patterns::List point(Patterns::Double(), dim, dim, ",");
  std::vector<Entry> entries{
      {"Geometry", "Shape", names.front(), std::make_shared<Patterns::Selection>(pattern),
       listed(names, "or") + (dim == 2 ? "" : ": space has no other shape"), documentation}};
  entries.insert(entries.end(), own.begin(), own.end());
  entries.insert(
      entries.end(),
      {{"Geometry", "Subdivisions", dim == 2 ? "1, 1" : "1, 1, 1",
        std::make_shared<Patterns::List>(Patterns::Integer(1), dim, dim, ","),
        words.number + " positive integers", "Cells of the coarse mesh in each direction."},
       {"Geometry", "Graded towards", "",
        std::make_shared<Patterns::List>(point, 0, Patterns::List::max_int_value, ";"),
        "points \"" + words.axes + "; " + words.axes + "; ...\" or nothing",
        "Points of the body towards which the coarse mesh is bisected."},
       {"Geometry", "Grading levels", "0", std::make_shared<Patterns::Integer>(0, 40),
        "an integer from 0 to 40", "How often the cells that touch such a point are bisected."}});
  return entries;
}

namespace
{
template <int dim>
bool has_entry(const ShapeKind<dim> &kind, const std::string &name)
{
  return std::any_of(kind.entries.begin(), kind.entries.end(),
                     [&](const Entry &entry) { return entry.name == name; });
}

/** A quadrilateral may be what a box was, in a copy of its scene. */
template <int dim>
bool is_left_of_a_box(const ShapeKind<dim> &kind, const Entry &entry)
{
  return kind.shape == Shape::quadrilateral && has_entry(shapes<dim>().front(), entry.name);
}

/** What another shape has and this one does not: only its default may stand there. */
template <int dim>
void reject_others(const Parameters &parameters, const ShapeKind<dim> &kind)
{
  for (const ShapeKind<dim> &other : shapes<dim>())
    for (const Entry &entry : other.entries)
      if (!has_entry(kind, entry.name) && !is_left_of_a_box(kind, entry) &&
          parameters.text(entry.section, entry.name) != entry.default_value)
        parameters.reject(entry.section, entry.name,
                          "has no meaning for a " + kind.name + "; set Shape = " + other.name +
                              " or remove it");
  const std::string one = dim == 2 ? "1, 1" : "1, 1, 1";
  if (!kind.takes_subdivisions && parameters.text("Geometry", "Subdivisions") != one)
    parameters.reject("Geometry", "Subdivisions",
                      "has no meaning for a " + kind.name +
                          ", whose coarse mesh is given; remove it and let the mesh adapt");
}

/** Null where the text names no shape. */
template <int dim>
const ShapeKind<dim> *shape_called(const std::string &name)
{
  const auto kind = std::find_if(shapes<dim>().begin(), shapes<dim>().end(),
                                 [&](const ShapeKind<dim> &one) { return one.name == name; });
  return kind == shapes<dim>().end() ? nullptr : &*kind;
}

/** The box around a mesh. */
Corners<2> corners_around(const CoarseMesh &mesh)
{
  Point<2> lower = mesh.vertices.front(), upper = lower;
  const auto take = [&](const Point<2> &x)
  {
    for (unsigned int d = 0; d < 2; ++d)
    {
      lower[d] = std::min(lower[d], x[d]);
      upper[d] = std::max(upper[d], x[d]);
    }
  };
  for (const Point<2> &vertex : mesh.vertices)
    take(vertex);
  for (const CoarseMesh::Edge &edge : mesh.edges)
    for (unsigned int k = 1; k < 16 && edge.curve; ++k)
      take(edge.curve.point(k / 16.));
  return box_corners(lower, upper);
}

Corners<3> corners_around(const HexahedralMesh &mesh)
{
  Point<3> lower = mesh.corners.front(), upper = lower;
  const auto take = [&](const Point<3> &x)
  {
    for (unsigned int d = 0; d < 3; ++d)
    {
      lower[d] = std::min(lower[d], x[d]);
      upper[d] = std::max(upper[d], x[d]);
    }
  };
  std::for_each(mesh.corners.begin(), mesh.corners.end(), take);
  for (const auto &[cell, nodes] : mesh.bent)
    std::for_each(nodes.begin(), nodes.end(), take);
  return box_corners(lower, upper);
}
} // namespace

template <int dim>
SideNames names_of_sides(const ParameterFile &file, const std::string &section)
{
  std::map<std::string, std::string> values;
  for (const Entry &entry : geometry_entries<dim>())
    values[entry.name] = entry.default_value;
  std::map<std::string, std::string> curves; // of boundaries, without the name of the body
  const std::string own = section == "Geometry" ? "" : section.substr(section.find(' ') + 1) + ".";
  std::vector<std::string> opened; // sections of boundaries
  const std::string boundary = "Boundary ";
  for (const Assignment &one : file.assignments)
    if (one.section == section)
      values[one.name] = one.value;
    else if (one.section.rfind(boundary, 0) == 0 && one.name != "On")
    {
      opened.push_back(one.section.substr(boundary.size()));
      if (one.name == "Curves" && one.section.compare(boundary.size(), own.size(), own) == 0)
        curves[one.section.substr(boundary.size() + own.size())] = one.value;
    }
  for (const auto &[name, numbers] : curves)
    values["Curves of all"] += name + "=" + numbers + ";";
  std::sort(opened.begin(), opened.end());
  opened.erase(std::unique(opened.begin(), opened.end()), opened.end());
  if (const std::string prefix = section.substr(section.find(' ') + 1) + "."; section != "Geometry")
  {
    // Of one of several bodies, without its name.
    std::vector<std::string> own;
    for (const std::string &name : opened)
      if (name.rfind(prefix, 0) == 0)
        own.push_back(name.substr(prefix.size()));
    opened = own;
  }
  const ShapeKind<dim> *const kind = shape_called<dim>(values["Shape"]);
  if (kind == nullptr || (kind->shape == Shape::file && values["File"].empty()))
    return {opened, {}, true}; // Shape or File is what is wrong
  if (!kind->boundaries)
    return {boundary_names(dim)};
  try
  {
    return kind->boundaries(
        [&](const std::string &entry)
        { return entry == "File" ? beside(file.name, values[entry]) : values[entry]; });
  }
  catch (const InputError &error) // of a mesh, whose file it names
  {
    throw InputError(display_name(file.name) + ": " + section + "/File: " + error.what());
  }
}

Geometry<2> geometry_of(const Shape shape, const CoarseMesh &mesh)
{
  Geometry<2> geometry;
  geometry.shape = shape;
  geometry.mesh = std::make_shared<const CoarseMesh>(mesh);
  geometry.corners = corners_around(mesh);
  return geometry;
}

void lay_on_axis(Geometry<2> &geometry)
{
  const double near = 1e-10 * geometry.diameter();
  const auto lay = [near](Point<2> &x)
  {
    if (std::abs(x[0]) <= near)
      x[0] = 0;
  };
  std::for_each(geometry.corners.begin(), geometry.corners.end(), lay);
  if (!geometry.mesh)
    return;
  auto mesh = std::make_shared<CoarseMesh>(*geometry.mesh);
  std::for_each(mesh->vertices.begin(), mesh->vertices.end(), lay);
  geometry.mesh = mesh;
}

template <int dim>
Geometry<dim> read_geometry(const Parameters &parameters)
{
  const ShapeKind<dim> &kind = *shape_called<dim>(parameters.text("Geometry", "Shape"));
  Geometry<dim> geometry;
  geometry.shape = kind.shape;
  const std::vector<int> subdivisions = Utilities::string_to_int(
      Utilities::split_string_list(parameters.text("Geometry", "Subdivisions"), ','));
  std::copy(subdivisions.begin(), subdivisions.end(), geometry.subdivisions.begin());
  kind.read(parameters, geometry);
  reject_others(parameters, kind);
  if constexpr (dim == 2)
    if (geometry.mesh)
      geometry.corners = corners_around(*geometry.mesh);
  if constexpr (dim == 3)
    if (geometry.mesh)
      geometry.corners = corners_around(*hexahedra_of(geometry));
  geometry.graded_towards = parameters.points<dim>("Geometry", "Graded towards");
  return geometry;
}

template const std::vector<ShapeKind<2>> &shapes<2>();
template const std::vector<ShapeKind<3>> &shapes<3>();
template const ShapeKind<2> *find_shape(Shape);
template const ShapeKind<3> *find_shape(Shape);
template std::string name_of_shape<2>(Shape);
template std::string name_of_shape<3>(Shape);
template std::shared_ptr<const Patterns::PatternBase> point_pattern<2>();
template std::shared_ptr<const Patterns::PatternBase> point_pattern<3>();
template Entry lower_corner_entry<2>();
template Entry lower_corner_entry<3>();
template Entry upper_corner_entry<2>();
template Entry upper_corner_entry<3>();
template SideNames names_of_sides<2>(const ParameterFile &, const std::string &);
template SideNames names_of_sides<3>(const ParameterFile &, const std::string &);
template std::vector<Entry> geometry_entries<2>();
template std::vector<Entry> geometry_entries<3>();
template Geometry<2> read_geometry(const Parameters &);
template Geometry<3> read_geometry(const Parameters &);
} // namespace hpvi
