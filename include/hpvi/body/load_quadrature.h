// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_load_quadrature_h
#define hpvi_load_quadrature_h

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/quadrature.h>
#include <hpvi/body/shape_tables.h>
#include <hpvi/scene/scene.h>

#include <array>
#include <functional>
#include <vector>

namespace hpvi
{
/** A load at a point; components without an expression are zero. */
template <int dim>
dealii::Tensor<1, dim> load_at(const Load<dim> &load, const dealii::Point<dim> &x)
{
  dealii::Tensor<1, dim> result;
  for (unsigned int c = 0; c < dim; ++c)
    if (load[c])
      result[c] = load[c]->value(x);
  return result;
}

/** Points and weights for a load on a face (d = 1) or in a cell (d = 2), on [0,1]^d. */
template <int d>
struct LoadRule
{
  unsigned int n_gauss;     ///< it is the Gauss rule of so many points per direction; 0: it is cut
  unsigned int most_points; ///< of the Gauss rule on any piece, per direction
  dealii::Quadrature<d> quadrature;
  std::vector<double> cuts; ///< of a face: 0, where pieces meet, 1
};

/**
 * A Gauss rule on each of some boxes, for the components of a load, whose @p value is asked for at points of [0,1]^d: as
 * many points per direction, at least @p degree + 2, as give moments with polynomials of degree 2 to round-off.
 */
template <int d>
LoadRule<d>
rule_on(const std::vector<dealii::BoundingBox<d>> &boxes, unsigned int degree,
        const std::array<Expression<2>, 2> &components,
        const std::function<double(const dealii::Function<2> &, const dealii::Point<d> &)> &value,
        const ShapeTables<2> &tables);
} // namespace hpvi

#endif
