// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_traction_energy_h
#define hpvi_traction_energy_h

#include <hpvi/algebra/dense_algebra.h>

namespace hpvi
{
/** What a patch sees of an element: energy and conditions of the tractions on its faces. */
struct TractionEnergy
{
  unsigned int n_normal, n_tangential, n_conditions;
  DensePart G, N; ///< n_edges() x n_edges(), n_edges() x n_conditions

  unsigned int n_edges() const
  {
    return 4 * (n_normal + n_tangential);
  }

  /** Place of a coefficient of the traction of @p face among those of all faces. */
  unsigned int edge_entry(const unsigned int face, const unsigned int tangential) const
  {
    return face * (n_normal + n_tangential) + tangential * n_normal;
  }
};
} // namespace hpvi

#endif
