// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_cell_edges_h
#define hpvi_cell_edges_h

#include <hpvi/reader/gmsh/mesh_complaint.h>
#include <hpvi/scene/coarse_mesh.h>

namespace hpvi
{
/** An edge with the cells beside it. */
struct CellEdge
{
  std::array<unsigned int, 2> vertices; ///< counterclockwise around the first cell
  std::array<unsigned int, 2> cells;    ///< the second is CoarseMesh::inside on the boundary

  bool is_on_boundary() const
  {
    return cells[1] == CoarseMesh::inside;
  }
};

/** All edges of cells that are counterclockwise. */
class CellEdges
{
public:
  /**
   * Throws InputError where three cells have one edge, or two lie on the same side of it. Messages name cells by
   * their @p numbers_in_file.
   */
  CellEdges(const CoarseMesh &mesh, const std::vector<std::size_t> &numbers_in_file,
            const MeshComplaint &complain);

  const std::vector<CellEdge> &all() const;

  /** The number of the edge between two vertices; CoarseMesh::inside where there is none. */
  unsigned int find(unsigned int vertex, unsigned int other) const;

  /** Numbers of all edges on the boundary, loop by loop, each followed by the one that begins where it ends. */
  const std::vector<unsigned int> &loops() const;

private:
  void check_pair(const CellEdge &one, const CellEdge &two) const;
  std::string as_element(unsigned int cell) const; ///< for messages about two
  void find_loops();

  const CoarseMesh &mesh;
  const std::vector<std::size_t> &numbers_in_file;
  const MeshComplaint &complain;
  std::vector<CellEdge> edges; ///< sorted by the smaller vertex, then by the larger
  std::vector<unsigned int> boundary;
};

/** As in "from (0, 0) to (1, 0)". */
std::string edge_in_words(const CoarseMesh &mesh, const std::array<unsigned int, 2> &vertices);
} // namespace hpvi

#endif
