// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_cell_map_h
#define hpvi_cell_map_h

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <hpvi/plane/curved_edges.h>

#include <array>
#include <memory>

namespace hpvi
{
/**
 * The map from the reference cell: d-linear where edges are straight; in the plane the blend of four edges (W. J. Gordon,
 * C. A. Hall, DOI 10.1007/BF01436298) where one is curved.
 */
template <int dim>
class CellMap
{
public:
  using Vertices = std::array<dealii::Point<dim>, dealii::GeometryInfo<dim>::vertices_per_cell>;

  /** @p blends: of curved edges, in the plane; null: all are straight. */
  explicit CellMap(const Vertices &vertices, std::shared_ptr<const EdgeBlends> blends = nullptr);

  const Vertices &vertices() const; ///< in deal.II's order

  bool is_curved() const; ///< is any edge?

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
  std::shared_ptr<const EdgeBlends> curved;
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

/** The map of a triangulation's cell. */
template <int dim, class CellIterator>
CellMap<dim> map_of(const CellIterator &cell)
{
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
