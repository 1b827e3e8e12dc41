// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_expression_h
#define hpvi_expression_h

#include <deal.II/base/function.h>

#include <array>
#include <functional>
#include <memory>

namespace hpvi
{
/** A function of x, y and in space z; null where there is none. */
template <int dim>
using Expression = std::shared_ptr<const dealii::Function<dim>>;

/** Components of a load or a displacement; null: none. */
template <int dim>
using Load = std::array<Expression<dim>, dim>;

/** The same @p value everywhere, for scenes built by code. */
template <int dim>
Expression<dim> expression(double value);

/** Any function of a point. */
template <int dim>
Expression<dim> expression(const std::function<double(const dealii::Point<dim> &)> &function);
/** @p one + @p factor @p other; null where both terms are, a constant where both are. */
template <int dim>
Expression<dim> sum(const Expression<dim> &one, double factor, const Expression<dim> &other);

/** Is it the same everywhere, as a number in a file? */
template <int dim>
bool is_constant(const Expression<dim> &function);
} // namespace hpvi

#endif
