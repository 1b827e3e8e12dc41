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

template Expression<2> expression<2>(double);
template Expression<2> expression<2>(const std::function<double(const Point<2> &)> &);
template Expression<3> expression<3>(double);
template Expression<3> expression<3>(const std::function<double(const Point<3> &)> &);
} // namespace hpvi
