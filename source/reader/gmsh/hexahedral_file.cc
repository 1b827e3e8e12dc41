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
#include <functional>
#include <map>
#include <numeric>
#include <set>

namespace hpvi
{
using namespace dealii;

namespace
{
bool is_hexahedron(const GmshFile::Element &element)
{
  const ElementKind kind = element_kind(element.type);
  return kind.dim == 3 && kind.n_corners == 8;
}

bool is_quadrilateral(const GmshFile::Element &element)
{
  const ElementKind kind = element_kind(element.type);
  return kind.dim == 2 && kind.n_corners == 4;
}

/** Neighbours are to have the same nodes between them. */
void check_orders(const GmshFile &file, const MeshComplaint &complain)
{
  std::map<unsigned int, const GmshFile::Element *> kinds; // by nodes beside corners
  for (const GmshFile::Element &element : file.elements)
    if (const ElementKind kind = element_kind(element.type); kind.dim == 3 && kind.n_nodes > 0)
      kinds[kind.n_nodes - kind.n_corners] = &element;
  if (kinds.size() < 2)
    return;
  const GmshFile::Element &one = *kinds.begin()->second, &other = *kinds.rbegin()->second;
  const auto words = [](const GmshFile::Element &element)
  {
    const ElementKind kind = element_kind(element.type);
    return std::string(kind.name) + " of " + std::to_string(kind.n_nodes) + " nodes";
  };
  complain.of(one.number, "the mesh has " + words(one) + " beside " + words(other) +
                              "; mesh all of it by elements of one order");
}

/** Elements that a body in space cannot have: how many of which kind, and what to do. */
void check_hexahedra(const GmshFile &file, const MeshComplaint &complain)
{
  const auto is_unfit = [](const GmshFile::Element &element)
  {
    const unsigned int dim = element_kind(element.type).dim;
    return dim == 3 ? !is_hexahedron(element)
                    : dim != 1 && (dim != 2 || element.group != 0) && !is_quadrilateral(element);
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
    const CellFaces faces(mesh, numbers_of_cells, complain);
    faces.check_connection();
    take_faces(faces);
    order_corners();
    bend_cells();
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
      if (is_hexahedron(element))
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
      if (is_hexahedron(element) && !is_wanted(numbers.number(element.group)))
        leave_out(element);
      else if (is_hexahedron(element))
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
        read_corners.push_back(corners);
        read_nodes.push_back(lexicographic(element));
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

  /** Inside out ones are turned; of plane faces a cell is convex that is so at its corners, others are looked at once they are bent. */
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

  /** The nodes of Gmsh's order at the places {0, 1/2, 1}^3, x fastest; those that the element lacks by its others. */
  HexahedronNodes lexicographic(const GmshFile::Element &element) const
  {
    // Middles of edges, then of faces, then the centre: as the sum of twice the places of corners.
    static constexpr std::array<unsigned int, 27> from{{0,  8,  1,  9,  20, 11, 3,  13, 2,
                                                        10, 21, 12, 22, 26, 23, 15, 24, 14,
                                                        4,  16, 5,  17, 25, 18, 7,  19, 6}};
    const unsigned int n_nodes = element_kind(element.type).n_nodes;
    HexahedronNodes result;
    std::array<bool, 27> is_known;
    for (unsigned int k = 0; k < 27; ++k)
      if ((is_known[k] = from[k] < n_nodes))
        result[k] = file.nodes[element.nodes[from[k]]].at;
    complete(result, is_known);
    return result;
  }

  /** Middles of edges halfway between corners; of faces and of the cell by serendipity, which is linear where edges are. */
  static void complete(HexahedronNodes &nodes, const std::array<bool, 27> &is_known)
  {
    static constexpr std::array<unsigned int, 3> step{{1, 3, 9}};
    for (unsigned int n_middle = 1; n_middle <= 3; ++n_middle)
      for (unsigned int k = 0; k < 27; ++k)
      {
        std::vector<unsigned int> axes; // in which it lies halfway
        for (unsigned int d = 0; d < 3; ++d)
          if (k / step[d] % 3 == 1)
            axes.push_back(d);
        if (axes.size() != n_middle || is_known[k])
          continue;
        // Around it lie corners and, of more than one axis, middles of edges.
        Tensor<1, 3> corners, edges;
        unsigned int n_edges = 0;
        for (unsigned int number = 0; number < std::pow(3, n_middle); ++number)
        {
          unsigned int other = k, n_halves = 0;
          for (unsigned int a = 0, rest = number; a < n_middle; ++a, rest /= 3)
          {
            other += (rest % 3) * step[axes[a]] - step[axes[a]];
            n_halves += rest % 3 == 1;
          }
          if (n_halves == 0)
            corners += nodes[other];
          else if (n_halves == 1 && n_middle > 1)
          {
            edges += nodes[other];
            ++n_edges;
          }
        }
        const double share = n_middle == 1 ? 0.5 : -0.25;
        nodes[k] = Point<3>(share * corners +
                            (n_edges > 0 ? (n_middle == 2 ? 0.5 : 0.25) * edges : Tensor<1, 3>()));
      }
  }

  /** Where a corner of a cell, as it is now, was as it was read: of eight in {0, 1}^3. */
  unsigned int place_as_read(const unsigned int cell, const unsigned int corner) const
  {
    const auto &corners = read_corners[cell];
    return std::find(corners.begin(), corners.end(), mesh.hexahedra[cell][corner]) -
           corners.begin();
  }

  /** Keeps nodes of cells of which a face is not plane or a node is not where corners would have it. */
  void bend_cells()
  {
    for (unsigned int c = 0; c < mesh.hexahedra.size(); ++c)
    {
      const HexahedronNodes &read = read_nodes[c];
      HexahedronNodes nodes;
      const unsigned int origin = place_as_read(c, 0);
      for (unsigned int k = 0; k < 27; ++k)
      {
        const std::array<unsigned int, 3> halves{{k % 3, k / 3 % 3, k / 9}};
        unsigned int place = 0;
        for (unsigned int d = 0; d < 3; ++d) // of the cell as it was read
        {
          unsigned int half = origin >> d & 1 ? 2 : 0;
          for (unsigned int own = 0; own < 3; ++own)
            if (const unsigned int end = place_as_read(c, 1U << own); (end ^ origin) >> d & 1)
              half = origin >> d & 1 ? 2 - halves[own] : halves[own];
          place += half * (d == 0 ? 1 : d == 1 ? 3 : 9);
        }
        nodes[k] = read[place];
      }
      if (!is_bent(c, nodes))
        continue;
      if (const auto folded = folded_at(nodes, 1e-3))
        complain.of(numbers_of_cells[c],
                    "the cell folds over itself or is flat at " + to_string(*folded) +
                        "; give cells corners of less than 179.9 degrees and nodes near the "
                        "middles of edges");
      mesh.bent[c] = nodes;
    }
  }

  bool is_bent(const unsigned int cell, const HexahedronNodes &nodes) const
  {
    Geometry<3> straight;
    straight.corners = mesh.corners_of(cell);
    const double size = straight.corners[0].distance(straight.corners[7]);
    for (unsigned int k = 0; k < 27; ++k)
      if (straight.point({k % 3 / 2., k / 3 % 3 / 2., k / 9 / 2.}).distance(nodes[k]) >
          1e-10 * size)
        return true;
    for (unsigned int f = 0; f < GeometryInfo<3>::faces_per_cell; ++f)
    {
      Side<3>::Piece face;
      for (unsigned int v = 0; v < 4; ++v)
        face[v] = straight.corners[GeometryInfo<3>::face_to_cell_vertices(f, v)];
      if (std::abs((face[1] - face[0]) * normal_of(face)) > 1e-8 * face[0].distance(face[3]))
        return true;
    }
    return false;
  }

  /** The tag of the physical surface on each face; 0: none. */
  std::vector<std::int64_t> groups_of(const CellFaces &faces) const
  {
    std::vector<std::int64_t> groups(faces.all().size(), 0);
    for (const GmshFile::Element &element : file.elements)
    {
      if (!is_quadrilateral(element) || element.group == 0)
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
  std::set<std::array<unsigned int, 4>> left_out;        ///< faces of other volumes, by nodes
  std::vector<unsigned int> corner_of;                   ///< by node; CoarseMesh::inside: not used
  std::vector<std::size_t> numbers_of_cells;             ///< in the file
  std::vector<std::array<unsigned int, 8>> read_corners; ///< by cell, in the order of the file
  std::vector<HexahedronNodes> read_nodes;               ///< likewise
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
  check_orders(file, complain);
  make_hexahedra(file);
  check_hexahedra(file, complain);
  HexahedralMesh mesh = HexahedraMaker(file, volumes, complain).make();
  mesh.origin = file.origin;
  mesh.is_numbered = file.is_numbered;
  mesh.remarks = file.remarks;
  return mesh;
}
} // namespace hpvi
