// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_cell_map_h
#define hpvi_cell_map_h

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <hpvi/plane/curved_edges.h>

#include <array>
#include <functional>
#include <memory>
#include <type_traits>

namespace hpvi
{
/**
 * Of a hexahedron of second order in space: how far its 27 nodes, lexicographic, lie from where the trilinear map of its
 * vertices has them [length].
 */
using QuadraticDepartures = std::array<dealii::Tensor<1, 3>, 27>;

/**
 * The map from the reference cell: d-linear where edges are straight; in the plane the blend of four edges (W. J. Gordon,
 * C. A. Hall, DOI 10.1007/BF01436298) where one is curved; in space triquadratic where the cell of the coarse mesh is so.
 */
template <int dim>
class CellMap
{
public:
  using Vertices = std::array<dealii::Point<dim>, dealii::GeometryInfo<dim>::vertices_per_cell>;
  using Bend = std::conditional_t<dim == 3, QuadraticDepartures, EdgeBlends>;

  /** @p bend: of curved edges and faces; null: all are straight. */
  explicit CellMap(const Vertices &vertices, std::shared_ptr<const Bend> bend = nullptr);

  const Vertices &vertices() const; ///< in deal.II's order

  bool is_curved() const; ///< is any edge, in space any face of the cell from which it comes?

  /** Of a curved cell in the plane, by face; none of the others. */
  const EdgeBlends &blends() const;

  /** Is the map affine, so that every derivative of it is constant? */
  bool is_affine() const;

  dealii::Point<dim> point(const dealii::Point<dim> &reference) const;

  /** J_ij = d x_i / d xi_j. */
  dealii::Tensor<2, dim> jacobian(const dealii::Point<dim> &reference) const;

  /** H_ijk = d^2 x_i / (d xi_j d xi_k). */
  dealii::Tensor<3, dim> hessian(const dealii::Point<dim> &reference) const;

  /** Outer unit normal of a face at a point of it. */
  dealii::Tensor<1, dim> normal(unsigned int face_no, const dealii::Point<dim> &reference) const;

  /**
   * That of the curve that an edge follows, at a Gauss-Lobatto parameter of the edge, where it meets the curve; of a straight edge
   * as normal(). Between cells edges have a kink, which gets smaller with their degree; the curve has none.
   */
  dealii::Tensor<1, dim> curve_normal(unsigned int face_no,
                                      const dealii::Point<dim> &reference) const;

  /** ds of a face over that of the reference face, at a point of it: the length of a straight edge. */
  double face_measure(unsigned int face_no, const dealii::Point<dim> &reference) const;

  /** The area of a face [length^(dim-1)], in the plane its length along the curve. */
  double face_area(unsigned int face_no) const;

  double longest_edge() const; ///< h_K, along chords [length]
  double shortest_edge() const;

private:
  Vertices corners;
  std::shared_ptr<const Bend> curved;
  bool affine;
  dealii::Tensor<2, dim> constant_jacobian; ///< at the centre
};

/** The point of the reference cell at @p s of the reference face @p face_no. */
template <int dim>
dealii::Point<dim> point_on_face(const unsigned int face_no, const dealii::Point<dim - 1> &s)
{
  dealii::Point<dim> result;
  for (unsigned int d = 0, k = 0; d < dim; ++d)
    result[d] = d == face_no / 2 ? face_no % 2 : s[k++];
  return result;
}

/**
 * The quadratic through nodes, `node(xi)` at the 27 places xi of {0, 1/2, 1}^3, as departures from the trilinear map of
 * @p vertices.
 */
std::shared_ptr<const QuadraticDepartures>
departures_of(const CellMap<3>::Vertices &vertices,
              const std::function<dealii::Point<3>(const dealii::Point<3> &)> &node);

/** Says of a cell of the coarse mesh that it is of second order, and of the cells that come of it; see curved_map(). */
class HexahedronManifold : public dealii::FlatManifold<3>
{
public:
  explicit HexahedronManifold(const CellMap<3> &map);

  std::unique_ptr<dealii::Manifold<3>> clone() const override;

  const CellMap<3> map; ///< of the cell of the coarse mesh
};

/**
 * That of a cell in space whose coarse cell has a HexahedronManifold: children are images of parts of the reference cell under
 * its polynomial, so that spaces are nested whatever deal.II takes for their vertices.
 */
CellMap<3> curved_map(const dealii::Triangulation<3>::cell_iterator &cell);

/** The map of a triangulation's cell. */
template <int dim, class CellIterator>
CellMap<dim> map_of(const CellIterator &cell)
{
  if constexpr (dim == 3)
    if (cell->manifold_id() != dealii::numbers::flat_manifold_id)
      return curved_map(cell);
  typename CellMap<dim>::Vertices vertices;
  for (const unsigned int v : dealii::GeometryInfo<dim>::vertex_indices())
    vertices[v] = cell->vertex(v);
  if constexpr (dim == 2)
    return CellMap<dim>(vertices, blends_of(cell));
  else
    return CellMap<dim>(vertices);
}
} // namespace hpvi

#endif
