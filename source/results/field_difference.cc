// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/mpi.h>
#include <hpvi/results/field_difference.h>

namespace hpvi
{
using namespace dealii;

template <int dim>
std::vector<FieldValues<dim>> LocalField<dim>::at(const BoundingBox<dim> &box,
                                                  const Quadrature<dim> &gauss) const
{
  std::vector<Point<dim>> points;
  for (const Point<dim> &q : gauss.get_points())
    points.push_back(box.unit_to_real(q));
  const ShapeTable<dim> table = tabulate<dim>(degree, points, gauss.get_weights(), false);
  const std::vector<double> u = evaluate(table.values, coefficients);
  const std::vector<double> derivatives = evaluate(table.derivatives, coefficients);
  std::vector<FieldValues<dim>> result(points.size());
  for (unsigned int q = 0; q < points.size(); ++q)
  {
    const Tensor<2, dim> inverse = invert(map.jacobian(points[q]));
    for (unsigned int c = 0; c < dim; ++c)
      result[q].u[c] = u[c * points.size() + q];
    result[q].gradient = physical_gradient<dim>(derivatives, q * dim, points.size() * dim, inverse);
  }
  return result;
}

template <int dim>
LocalField<dim> local_field(const Field<dim> &field, const typename Field<dim>::Cell &cell)
{
  return {field.degree(cell), field.coefficients(cell), map_of<dim>(cell)};
}

DifferenceSquares &DifferenceSquares::operator+=(const DifferenceSquares &other)
{
  energy += other.energy;
  l2 += other.l2;
  norm += other.norm;
  return *this;
}

DifferenceSquares total(const DifferenceSquares &own, MPI_Comm communicator)
{
  return {Utilities::MPI::sum(own.energy, communicator), Utilities::MPI::sum(own.l2, communicator),
          Utilities::MPI::sum(own.norm, communicator)};
}

template struct LocalField<2>;
template struct LocalField<3>;
template LocalField<2> local_field(const Field<2> &, const Field<2>::Cell &);
template LocalField<3> local_field(const Field<3> &, const Field<3>::Cell &);
} // namespace hpvi
