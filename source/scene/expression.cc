// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/expression.h>

namespace hpvi
{
using namespace dealii;

template <int dim>
Expression<dim> expression(const double value)
{
  return std::make_shared<Functions::ConstantFunction<dim>>(value);
}

template <int dim>
Expression<dim> expression(const std::function<double(const Point<dim> &)> &function)
{
  return std::make_shared<ScalarFunctionFromFunctionObject<dim>>(function);
}

template <int dim>
bool is_constant(const Expression<dim> &function)
{
  return dynamic_cast<const Functions::ConstantFunction<dim> *>(function.get()) != nullptr;
}

template <int dim>
Expression<dim> sum(const Expression<dim> &one, const double factor, const Expression<dim> &other)
{
  if (!other || factor == 0)
    return one;
  const auto value = [one, factor, other](const Point<dim> &x)
  { return (one ? one->value(x) : 0.) + factor * other->value(x); };
  if (is_constant<dim>(other) && (!one || is_constant<dim>(one)))
    return expression<dim>(value(Point<dim>()));
  return expression<dim>(std::function<double(const Point<dim> &)>(value));
}

template Expression<2> sum(const Expression<2> &, double, const Expression<2> &);
template Expression<3> sum(const Expression<3> &, double, const Expression<3> &);
template bool is_constant(const Expression<2> &);
template bool is_constant(const Expression<3> &);
template Expression<2> expression<2>(double);
template Expression<2> expression<2>(const std::function<double(const Point<2> &)> &);
template Expression<3> expression<3>(double);
template Expression<3> expression<3>(const std::function<double(const Point<3> &)> &);
} // namespace hpvi
