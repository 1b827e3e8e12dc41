// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_rigid_motions_h
#define hpvi_rigid_motions_h

#include <hpvi/space/primal_space.h>

#include <vector>

namespace hpvi
{
/** Of a body: translations and rotations. */
template <int dim>
constexpr unsigned int n_motions = dim *(dim + 1) / 2;

/** A translation or a rotation at @p arm from the centre, the rotation for a unit angle. */
template <int dim>
dealii::Tensor<1, dim> rigid_motion(unsigned int motion, const dealii::Tensor<1, dim> &arm);

/** Of the unknowns of this process, one motion after the other: at nodes the motion there, at contact dofs that at their Gauss point. */
template <int dim>
std::vector<double> rigid_motions(const PrimalSpace<dim> &space);
} // namespace hpvi

#endif
