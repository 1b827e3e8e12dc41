// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_cell_faces_h
#define hpvi_cell_faces_h

#include <hpvi/reader/gmsh/mesh_complaint.h>
#include <hpvi/scene/hexahedral_mesh.h>

#include <map>
#include <vector>

namespace hpvi
{
/** A face with the cells beside it. */
struct CellFace
{
  std::array<unsigned int, 4>
      corners;                       ///< lexicographic, (1-0) x (2-0) points out of the first cell
  std::array<unsigned int, 2> cells; ///< the second is CoarseMesh::inside on the boundary

  bool is_on_boundary() const
  {
    return cells[1] == CoarseMesh::inside;
  }
};

/** All faces of hexahedra whose corners stand in deal.II's order. */
class CellFaces
{
public:
  /**
   * Throws InputError where more than two cells have one face, or two lie on the same side of it. Messages name cells by
   * their @p numbers_in_file.
   */
  CellFaces(const HexahedralMesh &mesh, const std::vector<std::size_t> &numbers_in_file,
            const MeshComplaint &complain);

  const std::vector<CellFace> &all() const;

  /** The number of the face with these corners, in any order; CoarseMesh::inside where there is none. */
  unsigned int find(std::array<unsigned int, 4> corners) const;

  /** Throws InputError where cells make several parts that share no face, or a corner lies on a face of the boundary that has it not. */
  void check_connection() const;

private:
  void check_hanging() const;
  unsigned int n_parts() const;

  const HexahedralMesh &mesh;
  const std::vector<std::size_t> &numbers_in_file;
  const MeshComplaint &complain;
  std::vector<CellFace> faces; ///< in the order in which cells have them first
  std::map<std::array<unsigned int, 4>, unsigned int> numbers; ///< by ascending corners
};
} // namespace hpvi

#endif
