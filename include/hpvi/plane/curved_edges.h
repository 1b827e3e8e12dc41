// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_curved_edges_h
#define hpvi_curved_edges_h

#include <hpvi/plane/edge_blend.h>
#include <hpvi/scene/coarse_mesh.h>

#include <deal.II/grid/manifold.h>
#include <deal.II/grid/tria.h>

#include <array>
#include <map>
#include <memory>
#include <vector>

namespace hpvi
{
/**
 * An edge of the coarse mesh that follows a curve, and all edges that come of it: new vertices halve the curve's
 * parameter, not its length, so that halves of halves lie on the curve where those of others do.
 */
class CurveManifold : public dealii::Manifold<2>
{
public:
  /** @p piece runs as the edge of the triangulation does. */
  explicit CurveManifold(const CurvePiece &piece);

  std::unique_ptr<dealii::Manifold<2>> clone() const override;

  dealii::Point<2> get_new_point(const dealii::ArrayView<const dealii::Point<2>> &points,
                                 const dealii::ArrayView<const double> &weights) const override;

  const CurvePiece piece;
};

/** Hands the curves of @p coarse over to the edges of @p triangulation, whose cells and vertices have its numbers. */
void attach_curves(const CoarseMesh &coarse, dealii::Triangulation<2> &triangulation);

/**
 * Curved edges get the degree of the displacement along them: @p degrees by active cell index, the lowest one at an edge.
 * Cells keep it as their user index, until the mesh is refined. The middle of a longer edge moves onto its polynomial.
 */
void set_edge_degrees(dealii::Triangulation<2> &triangulation,
                      const std::vector<unsigned int> &degrees);

/** Null where all edges of @p cell are straight. */
std::shared_ptr<const EdgeBlends> blends_of(const dealii::Triangulation<2>::cell_iterator &cell);

/** @p s of the edge @p face of @p cell, as that of the edge of the coarse cell from which it comes. */
double on_coarse_edge(dealii::Triangulation<2>::cell_iterator cell, unsigned int face, double s);

/** Where an edge of the mesh lies on one of the coarse mesh, from 0 to 1 along the latter in its own direction. */
struct EdgePlace
{
  unsigned int edge = CoarseMesh::inside; ///< index into CoarseMesh::edges
  double from = 0, to = 0;                ///< of the first and the last point of the face
};

/** Of edges on the boundary; made once for all. */
class EdgePlaces
{
public:
  EdgePlaces(const CoarseMesh &coarse);

  EdgePlace operator()(const dealii::Triangulation<2>::cell_iterator &cell,
                       unsigned int face) const;

private:
  std::map<std::array<unsigned int, 2>, unsigned int> edges; ///< by vertices
};
} // namespace hpvi

#endif
