// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_load_quadrature_h
#define hpvi_load_quadrature_h

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/quadrature.h>
#include <hpvi/plane/shape_tables.h>
#include <hpvi/scene/scene.h>

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

/** A part of [0,1]^d with its own Gauss rule, of n points per direction. */
template <int d>
struct RulePart
{
  dealii::BoundingBox<d> box;
  unsigned int n;
};

/** Points and weights for data on a face (d = 1) or in a cell (d = 2), on [0,1]^d. */
template <int d>
struct LoadRule
{
  std::vector<RulePart<d>> parts;
  unsigned int n_gauss;     ///< it is the Gauss rule of so many points per direction; 0: it is cut
  unsigned int most_points; ///< of the Gauss rule on any part, per direction
  dealii::Quadrature<d> quadrature;
  std::vector<double> cuts; ///< of a face: 0, where pieces meet, 1
};

/** A Gauss rule on each of @p parts. */
template <int d>
LoadRule<d> rule_on(const std::vector<RulePart<d>> &parts, const ShapeTables<2> &tables);

/** Shape functions of one degree at the points of a rule, in a cell or on a face of it: those of @p tables unless the rule is cut. */
class ShapesOfRule
{
public:
  ShapesOfRule(const LoadRule<2> &rule, unsigned int degree, const ShapeTables<2> &tables);
  ShapesOfRule(const LoadRule<1> &rule, unsigned int face, unsigned int degree,
               const ShapeTables<2> &tables);

  ShapesOfRule(const ShapesOfRule &) = delete; // members refer to one another

private:
  const ShapeTable<2> own; ///< of a rule that is cut

public:
  const ShapeTable<2> &table;
};

/**
 * How many points each of some boxes needs for some functions on [0,1]^d: as many per direction, at least @p degree + 2, as give moments with
 * polynomials of degree 2 to round-off.
 */
template <int d>
std::vector<RulePart<d>>
rule_parts(const std::vector<dealii::BoundingBox<d>> &boxes, unsigned int degree,
           const std::vector<std::function<double(const dealii::Point<d> &)>> &functions,
           const ShapeTables<2> &tables);
} // namespace hpvi

#endif
