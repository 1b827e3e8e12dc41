// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_second_derivatives_h
#define hpvi_second_derivatives_h

#include <deal.II/base/tensor.h>

#include <vector>

namespace hpvi
{
/**
 * d_a d_b u_c at a point, by the chain rule `D^2 u = J^-T (D_xi^2 u - grad u . D_xi^2 x) J^-1`: second derivatives on the
 * reference cell stand in the dim^2 rows behind those of physical_gradient(), @p hessian is that of the map.
 */
template <int dim>
dealii::Tensor<3, dim> second_derivatives(const std::vector<double> &derivatives,
                                          const unsigned int first_row, const unsigned int n_rows,
                                          const dealii::Tensor<2, dim> &gradient,
                                          const dealii::Tensor<3, dim> &hessian,
                                          const dealii::Tensor<2, dim> &inverse_jacobian)
{
  dealii::Tensor<3, dim> second;
  for (unsigned int c = 0; c < dim; ++c)
  {
    dealii::Tensor<2, dim> reference;
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int b = 0; b < dim; ++b)
      {
        reference[a][b] = derivatives[c * n_rows + first_row + dim + a * dim + b];
        for (unsigned int k = 0; k < dim; ++k)
          reference[a][b] -= gradient[c][k] * hessian[k][a][b];
      }
    second[c] = transpose(inverse_jacobian) * reference * inverse_jacobian;
  }
  return second;
}
} // namespace hpvi

#endif
