// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_turned_divergence_h
#define hpvi_turned_divergence_h

#include <hpvi/plane/initial_stress.h>
#include <hpvi/scene/scene.h>

namespace hpvi
{
/** At point @p q of @p n_points, of values that stand component by component. */
template <int dim>
dealii::Tensor<1, dim> vector_at(const std::vector<double> &values, const unsigned int n_points,
                                 const unsigned int q)
{
  dealii::Tensor<1, dim> result;
  for (unsigned int c = 0; c < dim; ++c)
    result[c] = values[c * n_points + q];
  return result;
}

/**
 * What the divergence of sigma has beside HookesLaw::divergence_of_stress() in an axisymmetric body [stress/length]: the
 * stress around the axis presses inwards, and the hoop strain `h = u_x/x - e33` is part of the stress in the plane,
 *
 * `((s_xx - s_tt)/x, s_xy/x) + lambda grad h`.
 */
template <int dim, class Cell>
dealii::Tensor<1, dim>
turned_divergence(const Scene<dim> &scene, const Cell &cell, const CellMap<dim> &map,
                  const dealii::Point<dim> &reference, const dealii::Tensor<1, dim> &u,
                  const dealii::Tensor<2, dim> &gradient)
{
  const dealii::Point<dim> x = map.point(reference);
  const HookesLaw<dim> law(scene.material_of(cell));
  const dealii::Tensor<2, dim> strain = gradient - scene.initial_strain_in(cell, x);
  const double hoop = scene.hoop_strain(cell->material_id(), u, gradient, x);
  const dealii::SymmetricTensor<2, dim> sigma = law.stress(strain, hoop);
  dealii::Tensor<1, dim> slope = gradient[0] / x[0]; // of u_x/x
  slope[0] -= u[0] / (x[0] * x[0]);
  const dealii::Tensor<2, dim> inverse = dealii::invert(map.jacobian(reference));
  for (unsigned int r = 0; r < dim && scene.has_initial_strain(); ++r)
  {
    const double difference =
        difference_along([&](const dealii::Point<dim> &at)
                         { return initial_strain_across<dim>(scene, cell, map.point(at)); },
                         reference, r);
    for (unsigned int d = 0; d < dim; ++d)
      slope[d] -= difference * inverse[r][d];
  }
  dealii::Tensor<1, dim> result = law.volume_modulus() * slope;
  result[0] += (sigma[0][0] - law.hoop_stress(strain, hoop)) / x[0];
  for (unsigned int d = 1; d < dim; ++d)
    result[d] += sigma[0][d] / x[0];
  return result;
}
} // namespace hpvi

#endif
