// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_stable_modes_h
#define hpvi_stable_modes_h

#include <hpvi/bound/modes.h>
#include <hpvi/scene/material.h>

#include <deal.II/base/tensor.h>

namespace hpvi
{
/**
 * The stress of a displacement of degree @p p whose discrete equations know but the projection of div u (Volume::projected), in the frame B of
 * a parallelogram, from its stress @p sigma.
 */
Modes<3> without_oscillating_pressure(Modes<3> sigma, unsigned int p, const dealii::Tensor<2, 2> &B,
                                      const Material &material);
} // namespace hpvi

#endif
