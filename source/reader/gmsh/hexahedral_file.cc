// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/gmsh/cell_faces.h>
#include <hpvi/reader/gmsh/curve_numbers.h>
#include <hpvi/reader/gmsh/gmsh_file.h>
#include <hpvi/reader/gmsh/hexahedra.h>
#include <hpvi/reader/gmsh/hexahedral_file.h>
#include <hpvi/reader/gmsh/mesh_groups.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr std::int64_t hexahedron = 5, quadrilateral = 3;

/** Elements that a body in space cannot have: how many of which kind, and what to do. */
void check_hexahedra(const GmshFile &file, const MeshComplaint &complain)
{
  const auto is_unfit = [](const GmshFile::Element &element)
  {
    const unsigned int dim = element_kind(element.type).dim;
    return dim == 3 ? element.type != hexahedron
                    : dim != 1 && (dim != 2 || element.group != 0) && element.type != quadrilateral;
  };
  const auto found = std::find_if(file.elements.begin(), file.elements.end(), is_unfit);
  if (found == file.elements.end())
    return;
  const ElementKind kind = element_kind(found->type);
  const std::string name =
      kind.name == nullptr ? "elements of type " + std::to_string(found->type) : kind.name;
  complain.of(found->number,
              "the mesh has " + name + " (" +
                  std::to_string(std::count_if(file.elements.begin(), file.elements.end(),
                                               [&](const GmshFile::Element &element)
                                               { return element.type == found->type; })) +
                  "); a body in space has hexahedra, tetrahedra and prisms: make transfinite "
                  "volumes, or extrude a surface with Recombine and Layers");
}

class HexahedraMaker
{
public:
  HexahedraMaker(const GmshFile &file, const std::vector<std::string> &volumes,
                 const MeshComplaint &complain)
      : file(file), wanted(volumes), complain(complain),
        corner_of(file.nodes.size(), CoarseMesh::inside)
  {
  }

  HexahedralMesh make()
  {
    take_cells();
    if (mesh.cells.empty())
      return std::move(mesh);
    check_places();
    orient_cells();
    check_planes();
    const CellFaces faces(mesh, numbers_of_cells, complain);
    faces.check_connection();
    take_faces(faces);
    order_corners();
    return std::move(mesh);
  }

private:
  /** Gmsh goes around the bottom and then around the top. */
  static constexpr std::array<unsigned int, 8> place{{0, 1, 3, 2, 4, 5, 7, 6}};

  /** All volumes have numbers, those too that are left out. */
  void take_cells()
  {
    std::vector<std::int64_t> tags;
    for (const GmshFile::Element &element : file.elements)
      if (element.type == hexahedron)
      {
        if (element.group == 0)
          complain.of(element.number,
                      "the cell is in no physical volume; give each volume one in the drawing, as "
                      "in Physical Volume(\"block\") = {1};");
        tags.push_back(element.group);
      }
    if (tags.empty())
      complain("has no hexahedra; mesh the drawing with gmsh -3, and give its volumes physical "
               "groups");
    const GroupNumbers numbers(file, 3, tags, complain);
    mesh.surfaces = numbers.names();
    for (const GmshFile::Element &element : file.elements)
      if (element.type == hexahedron && !is_wanted(numbers.number(element.group)))
        leave_out(element);
      else if (element.type == hexahedron)
      {
        mesh.hexahedra.emplace_back();
        auto &corners = mesh.hexahedra.back();
        for (unsigned int v = 0; v < corners.size(); ++v)
          corners[place[v]] = take_node(element.nodes[v]);
        for (const unsigned int v : corners)
          if (std::count(corners.begin(), corners.end(), v) > 1)
            complain.of(element.number, "the cell has the node at " + to_string(mesh.corners[v]) +
                                            " twice; write the file anew");
        mesh.cells.emplace_back();
        mesh.cells.back().surface = numbers.number(element.group);
        numbers_of_cells.push_back(element.number);
      }
  }

  bool is_wanted(const unsigned int volume) const
  {
    return wanted.empty() ||
           std::find(wanted.begin(), wanted.end(), mesh.surfaces[volume]) != wanted.end();
  }

  /** By nodes in ascending order, as faces of what is left out are known. */
  static std::array<unsigned int, 4> sorted(std::array<unsigned int, 4> nodes)
  {
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  }

  void leave_out(const GmshFile::Element &cell)
  {
    for (unsigned int f = 0; f < GeometryInfo<3>::faces_per_cell; ++f)
    {
      std::array<unsigned int, 4> nodes;
      for (unsigned int v = 0; v < 4; ++v)
        nodes[v] = cell.nodes[place[GeometryInfo<3>::face_to_cell_vertices(f, v)]];
      left_out.insert(sorted(nodes));
    }
  }

  unsigned int take_node(const unsigned int node)
  {
    if (corner_of[node] == CoarseMesh::inside)
    {
      corner_of[node] = mesh.corners.size();
      mesh.corners.push_back(file.nodes[node].at);
    }
    return corner_of[node];
  }

  /** Of two corners at one place volumes that touch there know nothing of each other. */
  void check_places() const
  {
    const auto &x = mesh.corners;
    double size = 0, largest = 0;
    for (unsigned int d = 0; d < 3; ++d)
    {
      const auto [low, high] = std::minmax_element(
          x.begin(), x.end(), [d](const auto &a, const auto &b) { return a[d] < b[d]; });
      size = std::max(size, (*high)[d] - (*low)[d]);
      largest = std::max({largest, std::abs((*high)[d]), std::abs((*low)[d])});
    }
    if (!(size >= 1e-100 && largest <= 1e100))
      complain("the body is " + to_string(size) + " wide and reaches to " + to_string(largest) +
               ", and lengths must lie between 1e-100 and 1e100; choose another unit");
    const double hair = 1e-12 * size;
    std::vector<unsigned int> order(x.size());
    std::iota(order.begin(), order.end(), 0);
    // Runs of coordinates that round-off alone makes differ, one direction after the other.
    const std::function<void(unsigned int, unsigned int, unsigned int)> look =
        [&](const unsigned int begin, const unsigned int end, const unsigned int d)
    {
      if (d == 3 && end - begin > 1)
        complain(
            "two nodes are at " + to_string(x[order[begin]]) +
            "; give volumes that touch one surface there, Coherence in the drawing makes it, or "
            "a subsection Body NAME for each with its Surfaces, if they are bodies of their "
            "own");
      if (d == 3 || end - begin < 2)
        return;
      std::sort(order.begin() + begin, order.begin() + end,
                [&](const unsigned int v, const unsigned int w) { return x[v][d] < x[w][d]; });
      for (unsigned int first = begin, k = begin + 1; k <= end; ++k)
        if (k == end || x[order[k]][d] - x[order[k - 1]][d] > hair)
        {
          look(first, k, d + 1);
          first = k;
        }
    };
    look(0, order.size(), 0);
  }

  /** The determinant at a corner of the edges that leave it, over their lengths. */
  double determinant_at(const unsigned int cell, const unsigned int v) const
  {
    std::array<Tensor<1, 3>, 3> edges;
    for (unsigned int d = 0; d < 3; ++d)
    {
      const double sign = (v >> d) & 1U ? -1. : 1.;
      edges[d] = sign * (mesh.corners[mesh.hexahedra[cell][v ^ (1U << d)]] -
                         mesh.corners[mesh.hexahedra[cell][v]]);
      edges[d] /= edges[d].norm();
    }
    return cross_product_3d(edges[0], edges[1]) * edges[2];
  }

  /** Inside out ones are turned; of plane faces a cell is convex that is so at its corners. */
  void orient_cells()
  {
    for (unsigned int c = 0; c < mesh.hexahedra.size(); ++c)
    {
      double least = 1, most = -1;
      for (unsigned int v = 0; v < 8; ++v)
      {
        least = std::min(least, determinant_at(c, v));
        most = std::max(most, determinant_at(c, v));
      }
      if (most < 0)
      {
        for (unsigned int v = 0; v < 4; ++v)
          std::swap(mesh.hexahedra[c][v], mesh.hexahedra[c][v + 4]);
        least = -most;
      }
      if (!(least > 1e-3))
        complain.of(numbers_of_cells[c],
                    "the cell about " + to_string(centre_of(mesh.corners_of(c))) +
                        " is folded or flat at a corner, where its edges span a volume of " +
                        to_string(least) +
                        " of a cube's; give cells corners of less than 179.9 degrees");
    }
  }

  void check_planes() const
  {
    for (unsigned int c = 0; c < mesh.hexahedra.size(); ++c)
      for (unsigned int f = 0; f < GeometryInfo<3>::faces_per_cell; ++f)
      {
        Side<3>::Piece face;
        for (unsigned int v = 0; v < 4; ++v)
          face[v] = mesh.corners_of(c)[GeometryInfo<3>::face_to_cell_vertices(f, v)];
        const double size = face[0].distance(face[3]),
                     off = std::abs((face[1] - face[0]) * normal_of(face)) / size;
        if (!(off <= 1e-8))
          complain.of(numbers_of_cells[c],
                      "the face at " + to_string(face[0]) + " of the cell is not plane, by " +
                          to_string(off) +
                          " of its size; curved faces are not offered in space, give cells "
                          "plane ones");
      }
  }

  /** The tag of the physical surface on each face; 0: none. */
  std::vector<std::int64_t> groups_of(const CellFaces &faces) const
  {
    std::vector<std::int64_t> groups(faces.all().size(), 0);
    for (const GmshFile::Element &element : file.elements)
    {
      if (element.type != quadrilateral || element.group == 0)
        continue;
      std::array<unsigned int, 4> corners, nodes;
      for (unsigned int k = 0; k < 4; ++k)
        corners[k] = corner_of[nodes[k] = element.nodes[k]];
      const unsigned int face = faces.find(corners);
      if (face == CoarseMesh::inside && left_out.count(sorted(nodes)) > 0)
        continue;
      if (face == CoarseMesh::inside)
        complain.of(element.number, "the physical " + file.words({2, element.group}) +
                                        " has a face of no cell here, at " +
                                        to_string(file.nodes[element.nodes[0]].at) +
                                        "; let it be a surface of a volume, or remove it");
      groups[face] = element.group;
    }
    return groups;
  }

  /** Names inside the body mean nothing; one both there and on the boundary would mislead. */
  void take_faces(const CellFaces &faces)
  {
    const std::vector<std::int64_t> groups = groups_of(faces);
    std::vector<std::int64_t> outside, inside;
    for (unsigned int f = 0; f < groups.size(); ++f)
      (faces.all()[f].is_on_boundary() ? outside : inside).push_back(groups[f]);
    for (const std::int64_t tag : inside)
      if (tag != 0 && std::find(outside.begin(), outside.end(), tag) != outside.end())
        complain("the physical " + file.words({2, tag}) +
                 " has faces on the boundary and between cells; give those inside a group of their "
                 "own, or none");
    const GroupNumbers numbers(file, 2, outside, complain);
    mesh.boundaries = numbers.names();
    for (unsigned int f = 0; f < groups.size(); ++f)
      if (faces.all()[f].is_on_boundary())
        mesh.faces.push_back(
            {faces.all()[f].corners, numbers.number(groups[f]), faces.all()[f].cells[0]});
  }

  /** Edges of all cells are to run the same way. */
  void order_corners()
  {
    std::vector<CellData<3>> cells;
    for (const auto &corners : mesh.hexahedra)
    {
      cells.emplace_back();
      cells.back().vertices.assign(corners.begin(), corners.end());
    }
    try
    {
      GridTools::consistently_order_cells(cells);
    }
    catch (const ExceptionBase &)
    {
      complain("the cells go around a ring or a band that is twisted, so that their edges cannot "
               "all run the same way; mesh the body in another way");
    }
    for (unsigned int c = 0; c < cells.size(); ++c)
    {
      std::copy(cells[c].vertices.begin(), cells[c].vertices.end(), mesh.hexahedra[c].begin());
      AssertThrow(determinant_at(c, 0) > 0, ExcMessage("Ordering has turned a cell inside out."));
    }
  }

  const GmshFile &file;
  const std::vector<std::string> &wanted;
  const MeshComplaint &complain;
  HexahedralMesh mesh;
  std::set<std::array<unsigned int, 4>> left_out; ///< faces of other volumes, by nodes
  std::vector<unsigned int> corner_of;            ///< by node; CoarseMesh::inside: not used
  std::vector<std::size_t> numbers_of_cells;      ///< in the file
};
} // namespace

HexahedralMesh read_hexahedral_file(const std::string &path,
                                    const std::vector<std::string> &volumes,
                                    const DrawingRequest &request)
{
  GmshFile file = read_drawing(path, 3, request);
  const MeshComplaint complain(path);
  file.take_smallest_groups();
  number_groups(file, 3, request, complain);
  make_hexahedra(file);
  check_hexahedra(file, complain);
  HexahedralMesh mesh = HexahedraMaker(file, volumes, complain).make();
  mesh.origin = file.origin;
  mesh.is_numbered = file.is_numbered;
  mesh.remarks = file.remarks;
  return mesh;
}
} // namespace hpvi
