// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/input_error.h>
#include <hpvi/base/text.h>
#include <hpvi/gmsh/mesh_file.h>
#include <hpvi/shapes/curve_fit.h>
#include <hpvi/shapes/mesh_from_file.h>
#include <hpvi/shapes/mesh_surfaces.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <filesystem>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Edges that belong to one boundary, or to one interface. */
std::vector<unsigned int> edges_of(const CoarseMesh &mesh,
                                   unsigned int CoarseMesh::Edge::*const kind,
                                   const unsigned int number)
{
  std::vector<unsigned int> result;
  for (unsigned int e = 0; e < mesh.edges.size(); ++e)
    if (mesh.edges[e].*kind == number)
      result.push_back(e);
  return result;
}

/** As its entry `Curve` says. */
void bend(const Parameters &parameters, const std::string &name,
          const std::vector<unsigned int> &edges, CoarseMesh &mesh)
{
  const std::string section = "Boundary " + name, curve = parameters.text(section, "Curve");
  if (curve.empty())
    return;
  const std::string flaw =
      curve == "circle" ? bend_to_circles(mesh, edges) : bend_to_splines(mesh, edges);
  if (!flaw.empty())
    parameters.reject(section, "Curve",
                      flaw + (curve == "circle" ? "; set Curve = spline or remove it"
                                                : "; take more edges there, or remove it"));
}

std::vector<std::string> words_in(const std::string &list)
{
  return Utilities::split_string_list(list, ',');
}

/** Those that a body takes. */
std::vector<std::string> surfaces_in(const Parameters &parameters, const CoarseMesh &mesh)
{
  const std::vector<std::string> result = words_in(parameters.text("Geometry", "Surfaces"));
  for (const std::string &surface : result)
    if (std::find(mesh.surfaces.begin(), mesh.surfaces.end(), surface) == mesh.surfaces.end())
      parameters.reject("Geometry", "Surfaces",
                        "names " + printable(surface) + ", which the mesh has not; it has " +
                            listed(mesh.surfaces, "and"));
  return result;
}

void read_file(const Parameters &parameters, Geometry<2> &geometry)
{
  const std::string file = parameters.text("Geometry", "File");
  if (file.empty())
    parameters.reject("Geometry", "File", "names no mesh; give a file of Gmsh, as body.msh");
  const std::string path = beside(parameters.file_name(), file);
  CoarseMesh mesh = read_mesh_file(path);
  if (parameters.has("Geometry", "Surfaces"))
    mesh = surfaces_of(mesh, surfaces_in(parameters, mesh));
  if (const unsigned int n = n_parts(mesh); n > 1)
    throw InputError(printable(path, 400) + ": the cells make " + std::to_string(n) +
                     " parts that no edge connects, and a body is one part; save a file for each, "
                     "let them share a curve, or open a subsection Body NAME for each with its "
                     "Surfaces");
  const std::string body = parameters.standing_for("Geometry");
  const auto prefix = body.empty() ? "" : body.substr(body.find(' ') + 1) + ".";
  for (unsigned int b = 0; b < mesh.boundaries.size(); ++b)
    if (!mesh.boundaries[b].empty())
      bend(parameters, prefix + mesh.boundaries[b], edges_of(mesh, &CoarseMesh::Edge::boundary, b),
           mesh);
  for (unsigned int i = 0; i < mesh.interfaces.size(); ++i)
    bend(parameters, prefix + mesh.interfaces[i], edges_of(mesh, &CoarseMesh::Edge::interface, i),
         mesh);
  geometry.mesh = std::make_shared<const CoarseMesh>(std::move(mesh));
}
} // namespace

std::string beside(const std::string &scene, const std::string &name)
{
  return (std::filesystem::path(scene).parent_path() / name).string();
}

void require_names(const std::vector<std::string> &boundaries, const std::string &file,
                   const std::string &kind)
{
  const auto has_name = [](const std::string &name) { return !name.empty(); };
  if (std::none_of(boundaries.begin(), boundaries.end(), has_name))
    throw InputError(printable(file, 400) + ": the boundary of the body has no physical " + kind +
                     ", by whose name it is held, loaded or in contact; give it some in the "
                     "drawing, as in Physical " +
                     (kind == "curve" ? "Curve" : "Surface") + "(\"left\") = {4};");
}

Entry curve_entry(const std::string &name)
{
  return {"Boundary " + name,
          "Curve",
          "",
          std::make_shared<Patterns::Selection>("|circle|spline"),
          "circle, spline or nothing",
          "What the edges of a mesh file follow here: circle: the circle of best fit through their "
          "vertices, from corner to corner; spline: a cubic spline through them; empty: straight "
          "edges, or those of second order that the file has."};
}

std::vector<std::string> remarks_on_polygons(const CoarseMesh &mesh)
{
  std::vector<std::string> result;
  for (unsigned int b = 0; b < mesh.boundaries.size(); ++b)
  {
    std::vector<unsigned int> straight;
    for (const unsigned int e : edges_of(mesh, &CoarseMesh::Edge::boundary, b))
      if (!mesh.edges[e].curve)
        straight.push_back(e);
    if (const auto fit = polygon_for_circle(mesh, straight))
      result.push_back("boundary " +
                       (mesh.boundaries[b].empty() ? "without a name" : mesh.boundaries[b]) +
                       " is a polygon with its vertices on a circle of radius " +
                       text(fit->radius, 6) + " around " + to_string(fit->centre) +
                       ", and the body a polygon with corners there: set Boundary " +
                       mesh.boundaries[b] + "/Curve = circle if that is meant");
  }
  return result;
}

ShapeKind<2> mesh_from_file()
{
  return {
      Shape::file,
      "file",
      "file: quadrilaterals of a mesh file of Gmsh, given by File; its boundaries are the "
      "physical curves.",
      {{"Geometry", "File", "", std::make_shared<Patterns::Anything>(), "a file name or nothing",
        "Mesh file of Gmsh, format 4.1 or 2.2, ASCII, with quadrilaterals, physical curves and "
        "physical surfaces; a path relative to that of the scene."}},
      "File",
      read_file,
      nullptr,
      [](const GeometryText &text)
      {
        const std::string file = text("File");
        if (file.empty())
          return SideNames();
        CoarseMesh mesh = read_mesh_file(file);
        if (const std::string surfaces = text("Surfaces"); !surfaces.empty())
          mesh = surfaces_of(mesh, words_in(surfaces));
        require_names(mesh.boundaries, file, "curve");
        return SideNames{mesh.boundaries, mesh.interfaces, true};
      },
      false};
}
} // namespace hpvi
