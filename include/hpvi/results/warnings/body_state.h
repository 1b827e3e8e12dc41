// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_body_state_h
#define hpvi_body_state_h

#include <hpvi/results/field.h>
#include <hpvi/results/mean_gradients.h>

#include <vector>

namespace hpvi
{
/** What u_N does to the body as a whole, and how it is cut: what warnings ask beside the contact, of all processes. */
template <int dim>
struct BodyState
{
  double displacement = 0;                  ///< the largest component of u_N at a node [length]
  double deformation = 0;                   ///< Deformation::largest() of the nodes [length]
  std::vector<MeanGradient<dim>> gradients; ///< of every coarse cell
  double elongation = 1;                    ///< longest by shortest edge, the largest of all cells
  dealii::Point<dim> elongated;             ///< the centre of that cell
  std::vector<unsigned int> degrees;        ///< by material: the lowest of its cells
};

/** Collective. */
template <int dim>
BodyState<dim> body_state(const Field<dim> &field);
} // namespace hpvi

#endif
