// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/plane/deformation.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>

namespace hpvi
{
using namespace dealii;

template <int dim>
void Deformation<dim>::add(const Point<dim> &x, const Tensor<1, dim> &u)
{
  Vector point, displacement;
  for (unsigned int d = 0; d < dim; ++d)
  {
    point[d] = x[d];
    displacement[d] = u[d];
  }
  displacements.emplace_back(point, displacement);
}

template <int dim>
double Deformation<dim>::largest(const MPI_Comm communicator) const
{
  const auto sum = [&](const auto &term)
  {
    auto result = term(Vector(), Vector()) * 0.;
    for (const auto &[x, u] : displacements)
      result += term(x, u);
    return Utilities::MPI::sum(result, communicator);
  };
  const double n = Utilities::MPI::sum(double(displacements.size()), communicator);
  if (n == 0)
    return 0;
  const Vector centre = sum([](const Vector &x, const Vector &) { return x; }) / n,
               mean = sum([](const Vector &, const Vector &u) { return u; }) / n;
  // (tr M I - M) w = sum (x - c) x (u - a), M = sum (x - c)(x - c)'
  const Tensor<2, 3> M =
      sum([&](const Vector &x, const Vector &) { return outer_product(x - centre, x - centre); });
  const Vector moment =
      sum([&](const Vector &x, const Vector &u) { return cross_product_3d(x - centre, u - mean); });
  const Tensor<2, 3> inertia = Tensor<2, 3>(unit_symmetric_tensor<3>()) - M / trace(M);
  const Vector rotation = invert(inertia) * moment / trace(M); // points on one line make no body
  double largest = 0;
  for (const auto &[x, u] : displacements)
    largest = std::max(
        {largest, 1e-8 * u.norm(), (u - mean - cross_product_3d(rotation, x - centre)).norm()});
  return Utilities::MPI::max(largest, communicator);
}

template class Deformation<2>;
template class Deformation<3>;
} // namespace hpvi
