// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_expression_h
#define hpvi_expression_h

#include <deal.II/base/function.h>

#include <functional>
#include <memory>

namespace hpvi
{
/** A function of x, y and in space z; null where there is none. */
template <int dim>
using Expression = std::shared_ptr<const dealii::Function<dim>>;

/** The same @p value everywhere, for scenes built by code. */
template <int dim>
Expression<dim> expression(double value);

/** Any function of a point. */
template <int dim>
Expression<dim> expression(const std::function<double(const dealii::Point<dim> &)> &function);
} // namespace hpvi

#endif
