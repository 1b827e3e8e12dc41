// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_hexahedral_mesh_h
#define hpvi_hexahedral_mesh_h

#include <hpvi/scene/geometry.h>

#include <map>
#include <optional>

namespace hpvi
{
/** Of a hexahedron of second order, at the places {0, 1/2, 1}^3 of the reference cell, x fastest. */
using HexahedronNodes = std::array<dealii::Point<3>, 27>;

/** `sum_k phi_k(xi) a_k` of Lagrange's triquadratics there, or of their derivatives of this order per direction. */
dealii::Tensor<1, 3> triquadratic(const std::array<dealii::Tensor<1, 3>, 27> &a,
                                  const dealii::Point<3> &xi,
                                  const std::array<unsigned int, 3> &order = {});

/**
 * A point at which the determinant of the triquadratic map, over the product of the lengths of its columns, is at most @p least; null: there is none
 * among the vertices, middles and quarters of edges, faces and cell.
 */
std::optional<dealii::Point<3>> folded_at(const HexahedronNodes &nodes, double least);

/**
 * Hexahedra and names along the boundary, in the place of the quadrilaterals of a CoarseMesh: a body in space
 * that is no box. It has the names of that, #boundaries and, of its volumes, #surfaces, and a cell for each of its own with the
 * number of its volume; the vertices and edges of that it has not.
 */
struct HexahedralMesh : CoarseMesh
{
  static constexpr unsigned int n_corners = 8;

  struct Face ///< on the boundary
  {
    std::array<unsigned int, 4> vertices; ///< lexicographic, (1-0) x (2-0) points outwards
    unsigned int boundary;                ///< index into #boundaries
    unsigned int cell;                    ///< index into #hexahedra
  };

  std::vector<dealii::Point<3>> corners;
  std::vector<std::array<unsigned int, n_corners>>
      hexahedra; ///< of corners, lexicographic as deal.II's
  std::vector<Face> faces;

  /** Of cells of which faces are not plane, by index into #hexahedra. */
  std::map<unsigned int, HexahedronNodes> bent;

  Corners<3> corners_of(unsigned int cell) const;
  Side<3>::Piece corners_of(const Face &face) const;
  CurvedFace curve_of(const Face &face) const; ///< of a cell that is bent
};

/** That of a body in space; null: it is a box. */
const HexahedralMesh *hexahedra_of(const Geometry<3> &geometry);

/** The mean of its corners. */
dealii::Point<3> centre_of(const Corners<3> &cell);

/** The outer unit normal of a face, plane to round-off. */
dealii::Tensor<1, 3> normal_of(const Side<3>::Piece &piece);

/** Likewise its area. */
double area_of(const Side<3>::Piece &piece);

double area_of(const HexahedralMesh &mesh, const HexahedralMesh::Face &face);

/** Of a cell with plane faces, which are bases of pyramids. */
double volume_of(const Corners<3> &cell);

double volume_of(const HexahedralMesh &mesh, unsigned int cell);

/** By boundary, face by face. */
std::vector<Side<3>> sides_of_mesh(const HexahedralMesh &mesh);

/** Is @p x in @p cell, which is convex, or not more than @p hair outside of it? */
bool contains(const Corners<3> &cell, const dealii::Point<3> &x, double hair);

/** Likewise in a cell of second order. */
bool contains(const HexahedronNodes &cell, const dealii::Point<3> &x, double hair);

/** Likewise in one of the cells. */
bool contains(const HexahedralMesh &mesh, const dealii::Point<3> &x, double hair);

/** Points all over the cells, some hundred in all; of thousands of cells every so many. */
std::vector<dealii::Point<3>> sample(const HexahedralMesh &mesh);

/** The distance of @p x from a convex face. */
double distance(const Side<3>::Piece &piece, const dealii::Point<3> &x);

/** The outer normals at @p x of @p side, more than one where faces that differ meet there; in the plane one. */
template <int dim>
std::vector<dealii::Tensor<1, dim>> normals_at(const Side<dim> &side, const dealii::Point<dim> &x);
} // namespace hpvi

#endif
