// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_contact_residuals_h
#define hpvi_contact_residuals_h

#include <hpvi/results/field.h>

#include <functional>
#include <vector>

namespace hpvi
{
/**
 * `weight^2 |max(u_n - u_0, 0)|^2 c_0/c`, seen at twice as many points in a direction as u_N has nodes: of jumps between bodies,
 * weighted for the softer one, which gives way; of glued ones with what is left along the tangent.
 */
template <int dim>
double penetration(const FieldFace<dim> &face, const Field<dim> &field);

/** What the traction of a cell of the body opposite misses of the multiplier, squares over a part of its edge. */
struct OppositeResidual
{
  unsigned int cell; ///< its active cell index
  double tangential,
      normal; ///< `int (sigma n - z)^2` along the tangent and the normal [stress^2 length]
};

/** sigma(u_N) times normals at the points of a table on a cell. */
template <int dim>
using Tractions =
    std::function<std::vector<dealii::Tensor<1, dim>>(const typename Field<dim>::Cell &,
                                                      const ShapeTable<dim> &,
                                                      const std::vector<dealii::Tensor<1, dim>> &)>;

/** One of each segment of @p face; none opposite to a rigid foundation. */
template <int dim>
std::vector<OppositeResidual> opposite_residuals(const FieldFace<dim> &face,
                                                 const Field<dim> &field,
                                                 const Tractions<dim> &tractions);
/** In space one of each part of a face of a master, Field::exerted(). */
template <int dim>
std::vector<OppositeResidual> exerted_residuals(const Field<dim> &field,
                                                const Tractions<dim> &tractions);

/** Likewise sigma n where an edge of a master reaches beyond the other body. */
template <int dim>
std::vector<OppositeResidual> free_residuals(const Field<dim> &field,
                                             const Tractions<dim> &tractions);
} // namespace hpvi

#endif
