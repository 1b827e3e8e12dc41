// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/disjoint_sets.h>
#include <hpvi/base/text.h>
#include <hpvi/reader/gmsh/cell_faces.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hpvi
{
using namespace dealii;

namespace
{
Side<3>::Piece places(const HexahedralMesh &mesh, const std::array<unsigned int, 4> &corners)
{
  Side<3>::Piece result;
  for (unsigned int v = 0; v < 4; ++v)
    result[v] = mesh.corners[corners[v]];
  return result;
}

/** On which side of a face a cell lies. */
double side_of(const HexahedralMesh &mesh, const CellFace &face, const unsigned int cell)
{
  const Side<3>::Piece piece = places(mesh, face.corners);
  return (centre_of(mesh.corners_of(cell)) - piece[0]) * normal_of(piece);
}
} // namespace

CellFaces::CellFaces(const HexahedralMesh &mesh, const std::vector<std::size_t> &numbers_in_file,
                     const MeshComplaint &complain)
    : mesh(mesh), numbers_in_file(numbers_in_file), complain(complain)
{
  for (unsigned int c = 0; c < mesh.hexahedra.size(); ++c)
    for (unsigned int f = 0; f < GeometryInfo<3>::faces_per_cell; ++f)
    {
      CellFace face{{}, {{c, CoarseMesh::inside}}};
      for (unsigned int v = 0; v < 4; ++v)
        face.corners[v] = mesh.hexahedra[c][GeometryInfo<3>::face_to_cell_vertices(f, v)];
      if (side_of(mesh, face, c) > 0)
        std::swap(face.corners[1], face.corners[2]);
      std::array<unsigned int, 4> key = face.corners;
      std::sort(key.begin(), key.end());
      const auto [known, is_new] = numbers.insert({key, faces.size()});
      if (is_new)
      {
        faces.push_back(face);
        continue;
      }
      CellFace &other = faces[known->second];
      const std::string place = "the face at " + to_string(mesh.corners[face.corners[0]]);
      if (!other.is_on_boundary())
        complain.of(numbers_in_file[c],
                    place + " belongs to three cells; two bodies that touch there have "
                            "one mesh in common, or a cell is there twice");
      other.cells[1] = c;
      if (side_of(mesh, other, c) < 0)
        complain.of(numbers_in_file[c],
                    "the cell lies on the same side of " + place + " as " +
                        (numbers_in_file[other.cells[0]] == 0
                             ? "another"
                             : "element " + std::to_string(numbers_in_file[other.cells[0]])) +
                        ", and cells may not overlap; mesh anew");
    }
}

const std::vector<CellFace> &CellFaces::all() const
{
  return faces;
}

unsigned int CellFaces::find(std::array<unsigned int, 4> corners) const
{
  std::sort(corners.begin(), corners.end());
  const auto found = numbers.find(corners);
  return found == numbers.end() ? CoarseMesh::inside : found->second;
}

unsigned int CellFaces::n_parts() const
{
  DisjointSets parts(mesh.hexahedra.size());
  for (const CellFace &face : faces)
    if (!face.is_on_boundary())
      parts.join(face.cells[0], face.cells[1]);
  return parts.n_sets();
}

/** Corners sorted by x: few of them lie beside a face. */
void CellFaces::check_hanging() const
{
  std::vector<unsigned int> order;
  std::vector<bool> is_there(mesh.corners.size(), false);
  for (const CellFace &face : faces)
    for (const unsigned int v : face.corners)
      if (face.is_on_boundary() && !is_there[v])
      {
        is_there[v] = true;
        order.push_back(v);
      }
  const auto x = [this](const unsigned int v) { return mesh.corners[v][0]; };
  std::sort(order.begin(), order.end(),
            [&](const unsigned int v, const unsigned int w) { return x(v) < x(w); });
  for (const CellFace &face : faces)
  {
    if (!face.is_on_boundary())
      continue;
    const Side<3>::Piece piece = places(mesh, face.corners);
    const double hair = 1e-8 * piece[0].distance(piece[3]);
    const auto [low, high] = std::minmax_element(face.corners.begin(), face.corners.end(),
                                                 [&](const unsigned int v, const unsigned int w)
                                                 { return x(v) < x(w); });
    for (auto v = std::lower_bound(order.begin(), order.end(), x(*low) - hair,
                                   [&](const unsigned int w, const double least)
                                   { return x(w) < least; });
         v != order.end() && x(*v) <= x(*high) + hair; ++v)
      if (std::find(face.corners.begin(), face.corners.end(), *v) == face.corners.end() &&
          distance(piece, mesh.corners[*v]) <= hair)
        complain.of(numbers_in_file[face.cells[0]],
                    "a face of the cell has the node of another cell at " +
                        to_string(mesh.corners[*v]) +
                        " on it, a hanging node; let cells meet in whole faces, as by transfinite "
                        "surfaces with the same numbers on both sides");
  }
}

void CellFaces::check_connection() const
{
  check_hanging();
  if (const unsigned int n = n_parts(); n > 1)
    complain("the cells make " + std::to_string(n) +
             " parts that no face connects, and a body in space is one part; let volumes share a "
             "surface, Coherence in the drawing makes it, or open a subsection Body NAME for each "
             "with its Surfaces");
}
} // namespace hpvi
