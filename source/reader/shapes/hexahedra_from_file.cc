// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/input_error.h>
#include <hpvi/base/memo_table.h>
#include <hpvi/base/text.h>
#include <hpvi/reader/gmsh/hexahedral_file.h>
#include <hpvi/reader/shapes/curve_fit.h>
#include <hpvi/reader/shapes/hexahedra_from_file.h>
#include <hpvi/reader/shapes/mesh_from_file.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <tuple>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
using Faces = std::vector<const HexahedralMesh::Face *>;

/** Of a boundary, as they hang together along edges in turns below 45 degrees. */
std::vector<Faces> smooth_parts(const HexahedralMesh &mesh, const unsigned int boundary)
{
  std::map<std::pair<unsigned int, unsigned int>, Faces> at_edges;
  const auto edges_of = [](const HexahedralMesh::Face &face)
  {
    std::vector<std::pair<unsigned int, unsigned int>> result;
    for (const auto &[a, b] : {std::pair(0, 1), {1, 3}, {3, 2}, {2, 0}})
      result.push_back(std::minmax(face.vertices[a], face.vertices[b]));
    return result;
  };
  const auto counts = [&](const HexahedralMesh::Face &face) // of second order it is no polygon
  { return face.boundary == boundary && mesh.bent.count(face.cell) == 0; };
  for (const HexahedralMesh::Face &face : mesh.faces)
    if (counts(face))
      for (const auto &edge : edges_of(face))
        at_edges[edge].push_back(&face);
  std::vector<Faces> parts;
  std::map<const HexahedralMesh::Face *, bool> is_taken;
  for (const HexahedralMesh::Face &first : mesh.faces)
  {
    if (!counts(first) || std::exchange(is_taken[&first], true))
      continue;
    parts.push_back({&first});
    for (unsigned int k = 0; k < parts.back().size(); ++k)
    {
      const HexahedralMesh::Face &face = *parts.back()[k];
      for (const auto &edge : edges_of(face))
        for (const HexahedralMesh::Face *const other : at_edges[edge])
          if (normal_of(mesh.corners_of(face)) * normal_of(mesh.corners_of(*other)) >
                  std::sqrt(0.5) &&
              !std::exchange(is_taken[other], true))
            parts.back().push_back(other);
    }
  }
  return parts;
}

/** Those with different ones. */
std::vector<Tensor<1, 3>> normals_of(const HexahedralMesh &mesh, const Faces &faces)
{
  std::vector<Tensor<1, 3>> result;
  for (const HexahedralMesh::Face *const face : faces)
    if (const Tensor<1, 3> normal = normal_of(mesh.corners_of(*face));
        std::none_of(result.begin(), result.end(),
                     [&](const Tensor<1, 3> &other) { return (normal - other).norm() < 1e-9; }))
      result.push_back(normal);
  return result;
}

/** What to say of faces that stand around an axis, four or more, their vertices on a cylinder to 1e-10; else nothing. */
std::string facets_in_words(const HexahedralMesh &mesh, const Faces &faces)
{
  const std::vector<Tensor<1, 3>> normals = normals_of(mesh, faces);
  if (normals.size() < 4)
    return {};
  Tensor<1, 3> axis;
  for (const Tensor<1, 3> &normal : normals)
    if (const Tensor<1, 3> across = cross_product_3d(normals[0], normal);
        across.norm() > axis.norm())
      axis = across;
  axis /= axis.norm();
  const Tensor<1, 3> e = normals[0] - (normals[0] * axis) * axis, f = cross_product_3d(axis, e);
  std::vector<Point<2>> across;
  for (const HexahedralMesh::Face *const face : faces)
    for (const Point<3> &corner : mesh.corners_of(*face))
      across.emplace_back(corner * e, corner * f);
  const auto fit = fit_circle(across);
  const bool is_around =
      std::all_of(normals.begin(), normals.end(),
                  [&](const Tensor<1, 3> &normal) { return std::abs(normal * axis) < 1e-8; });
  if (!is_around || !fit || fit->deviation > 1e-10)
    return {};
  const auto rounded = [&](Tensor<1, 3> x, const double size)
  {
    for (unsigned int d = 0; d < 3; ++d)
      x[d] = std::abs(x[d]) < 1e-9 * size ? 0. : x[d];
    return to_string(Point<3>(x));
  };
  return "is a polygon of " + std::to_string(normals.size()) +
         " plane faces with their vertices on a cylinder of radius " + text(fit->radius, 6) +
         " around " + rounded(fit->centre[0] * e + fit->centre[1] * f, fit->radius) + " along " +
         rounded(axis, 1);
}

/**
 * By read_hexahedral_file(). The names of the sides are asked for before the mesh: what was made of a file that has not changed is kept.
 */
std::shared_ptr<const HexahedralMesh> mesh_of(const std::string &path,
                                              const std::vector<std::string> &volumes,
                                              const DrawingRequest &request)
{
  using Key = std::tuple<std::string, std::filesystem::file_time_type, std::uintmax_t,
                         std::vector<std::string>, double, double, std::string,
                         std::map<std::int64_t, std::string>>;
  static std::map<Key, std::shared_ptr<const HexahedralMesh>> known;
  const auto make = [&]()
  { return std::make_shared<const HexahedralMesh>(read_hexahedral_file(path, volumes, request)); };
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) // given by code, or to be refused
    return make();
  const Key key(std::filesystem::absolute(path).lexically_normal().string(),
                std::filesystem::last_write_time(path), std::filesystem::file_size(path), volumes,
                request.size, request.curvature, request.unit, request.curves);
  return memoised(known, key, make);
}
} // namespace

std::vector<std::string> remarks_on_facets(const HexahedralMesh &mesh)
{
  std::vector<std::string> result;
  for (unsigned int b = 0; b < mesh.boundaries.size(); ++b)
    for (const Faces &faces : smooth_parts(mesh, b))
      if (const std::string words = facets_in_words(mesh, faces); !words.empty())
        result.push_back(
            "boundary " + (mesh.boundaries[b].empty() ? "without a name" : mesh.boundaries[b]) +
            " " + words +
            ", and the body has edges there however fine its cells become; draw more of them, or "
            "give hexahedra of second order, if that matters");
  return result;
}

ShapeKind<3> hexahedra_from_file()
{
  return {
      Shape::file,
      "file",
      "file: what a drawing or a mesh file has, given by File; its boundaries are the physical "
      "surfaces, or the surfaces by their numbers.",
      drawing_entries(3),
      "File",
      [](const Parameters &parameters, Geometry<3> &geometry)
      {
        const std::string file = parameters.text("Geometry", "File");
        if (file.empty())
          parameters.reject("Geometry", "File",
                            "names no mesh; give a drawing or a mesh, as body.step or body.msh");
        const std::vector<std::string> volumes = surfaces_of_body(parameters);
        const auto mesh = mesh_of(beside(parameters.file_name(), file), volumes,
                                  drawing_request([&](const std::string &entry)
                                                  { return parameters.text("Geometry", entry); }));
        check_surfaces(volumes, *mesh,
                       [&](const std::string &problem)
                       { parameters.reject("Geometry", "Surfaces", problem); });
        geometry.mesh = mesh;
      },
      nullptr,
      [](const GeometryText &text)
      {
        const std::string file = text("File");
        if (file.empty())
          return SideNames();
        const std::vector<std::string> volumes = words_in(text("Surfaces"));
        const auto mesh = mesh_of(file, volumes, drawing_request(text));
        if (mesh->cells.empty()) // else the entry is refused where the body is read
          check_surfaces(volumes, *mesh,
                         [&](const std::string &problem)
                         { throw InputError(printable(file, 400) + ": Surfaces " + problem); });
        require_names(mesh->boundaries, file, "surface");
        return SideNames{mesh->boundaries, {}, /*is_from_file=*/true};
      },
      false};
}
} // namespace hpvi
