// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_curve_fit_h
#define hpvi_curve_fit_h

#include <hpvi/scene/coarse_mesh.h>

#include <optional>
#include <string>
#include <vector>

namespace hpvi
{
/** Edges that follow each other, by index into CoarseMesh::edges; the last vertex is the first one where it is closed. */
struct EdgeChain
{
  std::vector<unsigned int> edges, vertices;

  bool is_closed() const;
};

/** Those of @p edges: each as long as can be. */
std::vector<EdgeChain> chains_of(const CoarseMesh &mesh, const std::vector<unsigned int> &edges);

/** A circle near points. */
struct CircleFit
{
  dealii::Point<2> centre;
  double radius;
  double deviation; ///< of the farthest point from it, over the radius
};

/** By least squares, `2 c.x + d = |x|^2`; nothing for points on a line. */
std::optional<CircleFit> fit_circle(const std::vector<dealii::Point<2>> &points);

/**
 * Bends @p edges of the mesh to circles: each chain to one, or where its points lie on several, each piece between corners of
 * more than 30 degrees. Returns what stands against that, in words; else nothing.
 */
std::string bend_to_circles(CoarseMesh &mesh, const std::vector<unsigned int> &edges);

/** Likewise to splines, each chain between corners of 45 degrees or more. */
std::string bend_to_splines(CoarseMesh &mesh, const std::vector<unsigned int> &edges);

/**
 * Edges of one boundary, straight or of second order, that look like a circle: five nodes or more lie on it to 1e-10, and straight
 * ones turn by less than 45 degrees. Whose middles are on it, too, is no polygon.
 */
std::optional<CircleFit> polygon_for_circle(const CoarseMesh &mesh,
                                            const std::vector<unsigned int> &edges);

/** The remark on it. */
std::string polygon_words(const std::string &boundary, const CircleFit &fit, bool is_quadratic);
} // namespace hpvi

#endif
