// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_supports_check_h
#define hpvi_supports_check_h

#include <hpvi/scene/scene.h>

#include <vector>

namespace hpvi
{
/** `direction . u = value` at one point, said by one boundary. */
template <int dim>
struct PointCondition
{
  dealii::Tensor<1, dim> direction; ///< unit vector
  double value;                     ///< [length]
  unsigned int boundary;
};

/** What a boundary with outer @p normal prescribes at @p point: displacements, and `u_n = 0` where it @p slides. */
template <int dim>
std::vector<PointCondition<dim>> conditions_at(const BoundaryCondition<dim> &boundary,
                                               const dealii::Tensor<1, dim> &normal, bool slides,
                                               const dealii::Point<dim> &point);

/** Where two boundaries meet their conditions can hold together, and `u_n <= u_0` with them: else InputError. */
template <int dim>
void check_supports(const Scene<dim> &scene);
} // namespace hpvi

#endif
