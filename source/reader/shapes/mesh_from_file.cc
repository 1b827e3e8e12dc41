// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/disjoint_sets.h>
#include <hpvi/base/formatting.h>
#include <hpvi/base/input_error.h>
#include <hpvi/base/text.h>
#include <hpvi/reader/gmsh/drawing_kind.h>
#include <hpvi/reader/gmsh/mesh_file.h>
#include <hpvi/reader/gmsh/quadratic_edge.h>
#include <hpvi/reader/shapes/curve_fit.h>
#include <hpvi/reader/shapes/mesh_from_file.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <functional>
#include <map>

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

using Ends = std::array<unsigned int, 2>;

/** The cell that has each edge counterclockwise. */
std::map<Ends, unsigned int> cells_by_edge(const CoarseMesh &mesh)
{
  std::map<Ends, unsigned int> result;
  for (unsigned int c = 0; c < mesh.cells.size(); ++c)
    for (unsigned int v = 0; v < 4; ++v)
      result[{{mesh.cells[c].vertices[v], mesh.cells[c].vertices[(v + 1) % 4]}}] = c;
  return result;
}

/** How many parts the cells make that no edge connects. */
unsigned int n_parts(const CoarseMesh &mesh)
{
  DisjointSets parts(mesh.cells.size());
  const std::map<Ends, unsigned int> cells = cells_by_edge(mesh);
  for (const auto &[ends, cell] : cells)
    if (const auto other = cells.find({{ends[1], ends[0]}}); other != cells.end())
      parts.join(cell, other->second);
  return parts.n_sets();
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

/** Numbers that its entry `Curves` has. */
void take_curves(const std::string &name, const std::string &numbers, DrawingRequest &request)
{
  for (const std::string &word : words_in(numbers))
    if (!word.empty() && word.size() < 10 &&
        word.find_first_not_of("0123456789") == std::string::npos)
      request.curves[std::stoi(word)] = name;
}

/** Those of the body whose boundaries begin with @p prefix. */
DrawingRequest request_of(const Parameters &parameters, const std::string &prefix)
{
  DrawingRequest request =
      drawing_request([&](const std::string &entry) { return parameters.text("Geometry", entry); });
  const std::string start = "Boundary " + prefix;
  for (const std::string &section : parameters.sections_with("Curves"))
    if (section.compare(0, start.size(), start) == 0)
      take_curves(section.substr(start.size()), parameters.text(section, "Curves"), request);
  for (const std::string &section : parameters.sections_with("Curve"))
    if (const std::string curve = parameters.text(section, "Curve");
        !curve.empty() && section.compare(0, start.size(), start) == 0)
      request.bent[section.substr(start.size())] = curve;
  return request;
}

void read_file(const Parameters &parameters, Geometry<2> &geometry)
{
  const std::string file = parameters.text("Geometry", "File");
  if (file.empty())
    parameters.reject("Geometry", "File",
                      "names no mesh; give a drawing or a mesh, as body.step or body.msh");
  const std::string path = beside(parameters.file_name(), file),
                    body = parameters.standing_for("Geometry");
  const auto prefix = body.empty() ? "" : body.substr(body.find(' ') + 1) + ".";
  const std::vector<std::string> surfaces = surfaces_of_body(parameters);
  CoarseMesh mesh = read_mesh_file(path, surfaces, request_of(parameters, prefix));
  check_surfaces(surfaces, mesh,
                 [&](const std::string &problem)
                 { parameters.reject("Geometry", "Surfaces", problem); });
  if (const unsigned int n = n_parts(mesh); n > 1)
    throw InputError(printable(path, 400) + ": the cells make " + std::to_string(n) +
                     " parts that no edge connects, and a body is one part; save a file for each, "
                     "let them share a curve, or open a subsection Body NAME for each with its "
                     "Surfaces");
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

std::vector<std::string> words_in(const std::string &list)
{
  return Utilities::split_string_list(list, ',');
}

void check_surfaces(const std::vector<std::string> &wanted, const CoarseMesh &mesh,
                    const std::function<void(const std::string &)> &reject)
{
  for (const std::string &surface : wanted)
    if (std::find(mesh.surfaces.begin(), mesh.surfaces.end(), surface) == mesh.surfaces.end())
      reject("names " + printable(surface) + ", which the mesh has not; it has " +
             listed(mesh.surfaces, "and"));
}

std::vector<std::string> surfaces_of_body(const Parameters &parameters)
{
  return parameters.has("Geometry", "Surfaces") ? words_in(parameters.text("Geometry", "Surfaces"))
                                                : std::vector<std::string>();
}

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

std::vector<Entry> curve_entries(const std::string &name)
{
  return {{"Boundary " + name, "Curve", "", std::make_shared<Patterns::Selection>("|circle|spline"),
           "circle, spline or nothing",
           "What the edges of a mesh file follow here: circle: the circle of best fit through "
           "their "
           "vertices, from corner to corner; spline: a cubic spline through them; empty: straight "
           "edges, or the curves that the file has."},
          {"Boundary " + name, "Curves", "",
           std::make_shared<Patterns::List>(Patterns::Integer(1, 99999999), 0,
                                            Patterns::List::max_int_value, ","),
           "numbers of curves \"3, 5\" or nothing",
           "The curves of a drawing that have this name, by the numbers that --validate and "
           "--picture tell; of a mesh without curves those of the parts of its boundary between "
           "corners of more than 30 degrees; empty: those of the physical group of this name."}};
}

std::vector<std::string> remarks_on_polygons(const CoarseMesh &mesh)
{
  std::vector<std::string> result;
  for (unsigned int b = 0; b < mesh.boundaries.size(); ++b)
  {
    std::vector<unsigned int> of_file; // what Curve has bent follows circles and splines
    bool is_quadratic = false;
    for (const unsigned int e : edges_of(mesh, &CoarseMesh::Edge::boundary, b))
    {
      const bool is_of_second_order =
          dynamic_cast<const QuadraticEdge *>(mesh.edges[e].curve.curve.get()) != nullptr;
      if (is_of_second_order || !mesh.edges[e].curve)
        of_file.push_back(e);
      is_quadratic = is_quadratic || is_of_second_order;
    }
    if (const auto fit = polygon_for_circle(mesh, of_file))
      result.push_back(polygon_words(mesh.boundaries[b], *fit, is_quadratic));
  }
  return result;
}

DrawingRequest drawing_request(const GeometryText &text)
{
  DrawingRequest request;
  const auto number = [&](const std::string &entry, const double otherwise)
  {
    const std::string value = text(entry);
    return value.empty() || value.find_first_not_of("0123456789.eE+-") != std::string::npos
               ? otherwise
               : std::strtod(value.c_str(), nullptr);
  };
  request.size = number("Mesh size", 0);
  request.curvature = number("Mesh size from curvature", request.curvature);
  request.unit = text("Length unit");
  return request;
}

std::vector<Entry> drawing_entries(const unsigned int dim)
{
  return {{"Geometry", "File", "", std::make_shared<Patterns::Anything>(), "a file name or nothing",
           std::string(
               "A drawing: STEP, IGES, BREP or a script .geo of Gmsh, which is run as such; or a "
               "mesh: .msh, .unv, .bdf, .vtk or a deck .inp, of ") +
               (dim == 2 ? "triangles, quadrilaterals or both"
                         : "tetrahedra, prisms and hexahedra with plane faces") +
               "; a path relative to that of the scene."},
          {"Geometry", "Length unit", "",
           std::make_shared<Patterns::Selection>("|mm|cm|m|um|km|inch|ft"),
           std::string(length_units) + ", or nothing",
           "Lengths of a STEP or IGES file are turned into this unit; empty: they stay in that of "
           "the file."},
          {"Geometry", "Mesh size", "", word_or("", Patterns::Double(1e-100)),
           "a positive number or nothing",
           "Size of the largest cells of a drawing [length]; empty: a tenth of the diagonal of its "
           "box, or what a script says."},
          {"Geometry", "Mesh size from curvature", "12",
           std::make_shared<Patterns::Double>(0, 1000), "a number from 0 to 1000",
           "How many cells of a drawing there are along curves at least, per full turn; 0: no "
           "matter how they turn."}};
}
ShapeKind<2> mesh_from_file()
{
  return {Shape::file,
          "file",
          "file: what a drawing or a mesh file has, given by File; its boundaries are the physical "
          "curves, or the curves by their numbers.",
          drawing_entries(2),
          "File",
          read_file,
          nullptr,
          [](const GeometryText &text)
          {
            const std::string file = text("File");
            if (file.empty())
              return SideNames();
            DrawingRequest request = drawing_request(text);
            for (const std::string &line : Utilities::split_string_list(text("Curves of all"), ';'))
              if (const std::size_t equals = line.find('='); equals != std::string::npos)
                take_curves(line.substr(0, equals), line.substr(equals + 1), request);
            const std::vector<std::string> surfaces = words_in(text("Surfaces"));
            const CoarseMesh mesh = read_mesh_file(file, surfaces, request);
            if (mesh.cells.empty()) // else the entry is refused where the body is read
              check_surfaces(surfaces, mesh,
                             [&](const std::string &problem)
                             { throw InputError(printable(file, 400) + ": Surfaces " + problem); });
            require_names(mesh.boundaries, file, "curve");
            return SideNames{mesh.boundaries, mesh.interfaces, true};
          },
          false};
}
} // namespace hpvi
