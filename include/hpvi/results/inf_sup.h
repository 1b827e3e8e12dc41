// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_inf_sup_h
#define hpvi_inf_sup_h

#include <hpvi/plane/mesh.h>
#include <hpvi/scene/scene.h>

namespace hpvi
{
/** The discrete inf-sup constant of one pair of spaces, and what Theorem 3.33 says about it. */
struct InfSup
{
  double
      beta; ///< in [0,1] up to round-off; infinity, the infimum over nothing, without multipliers
  unsigned int n_multipliers;
  unsigned int lowest_degree;  ///< min p_K over the contact edges with multipliers, or 0
  unsigned int highest_degree; ///< max p_K over them, or 0

  /** `1/(p^1/2 log^3/2 p)` of (3.184), p the highest degree, without its constant; NaN for p < 2. */
  double bound() const;
};

/**
 * Measures the constant of (3.184) in the energy norm, for V_N and W_N on @p triangulation with
 * @p degrees (by active cell index) and the scene's offset of the multiplier:
 *
 *     beta = min_z max_v b(v,z) / (|v|_a |z|_*),   |z|_* = max_w b(w,z) / |w|_a,
 *
 * v in V_N, and w in a space V_* that stands for V: degree p + 4 on the mesh bisected once. The
 * maxima are z'S_N z and z'S_* z with `S = B A^-1 B'`, both over the unknowns z of W_N, so beta^2 is
 * the smallest eigenvalue of `S_N z = beta^2 S_* z`. The norm |.|_* is equivalent to that of
 * W_N in the dual of the traces of V, with constants that depend on material and body only; as
 * V_N is a part of V_*, beta <= 1. Throws NumericalFailure where S_* is not positive definite.
 */
template <int dim>
InfSup measure_inf_sup(const Scene<dim> &scene, const dealii::Triangulation<dim> &triangulation,
                       const Degrees &degrees);
} // namespace hpvi

#endif
