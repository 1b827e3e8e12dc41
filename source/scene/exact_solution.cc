// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/exact_solution.h>

#include <algorithm>
#include <utility>

namespace hpvi
{
using namespace dealii;

template <int dim>
double ExactSolution<dim>::multiplier(const Point<dim> &) const
{
  return 0.;
}

template <int dim>
double ExactSolution<dim>::pressure(const Point<dim> &) const
{
  return 0.;
}

template <int dim>
std::vector<Point<dim>> ExactSolution<dim>::singularities() const
{
  return {};
}

template <int dim>
std::vector<Point<dim>> ExactSolution<dim>::transitions() const
{
  return {};
}

template <int dim>
ExactDisplacement<dim>::ExactDisplacement(std::shared_ptr<const ExactSolution<dim>> solution,
                                          const unsigned int component)
    : solution(std::move(solution)), direction(component)
{
}

template <int dim>
double ExactDisplacement<dim>::value(const Point<dim> &x, unsigned int) const
{
  return solution->displacement(x)[direction];
}

template <int dim>
ExactTraction<dim>::ExactTraction(std::shared_ptr<const ExactSolution<dim>> solution,
                                  const Material &material, const Side<dim> &side,
                                  const unsigned int component)
    : solution(std::move(solution)), material(material), side(side), direction(component)
{
}

template <int dim>
double ExactTraction<dim>::value(const Point<dim> &x, unsigned int) const
{
  return HookesLaw<dim>(material).traction(solution->gradient(x), side.normal(x))[direction];
}

template class ExactSolution<2>;
template class ExactSolution<3>;
template class ExactDisplacement<2>;
template class ExactDisplacement<3>;
template class ExactTraction<2>;
template class ExactTraction<3>;
} // namespace hpvi
