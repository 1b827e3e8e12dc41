// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_admissible_friction_h
#define hpvi_admissible_friction_h

#include <hpvi/bound/edge_polynomial.h>
#include <hpvi/plane/solution.h>

#include <array>
#include <vector>

namespace hpvi
{
/**
 * Friction near z_N that Tresca's law admits at every point, `tau = g l*` with |l*| <= 1, and that does
 * the same work as z_N on the hat functions psi_a of the contact vertices: the datum of an equilibrated
 * stress, patch by patch. z_N itself overshoots g between its Gauss points.
 *
 * On each contact face and for each of its ends a there is a polynomial l_a of traction_degree(),
 * and `l* = sum_a psi_a l_a`. For each vertex a, over the one or two faces of one contact boundary that
 * has no corner there,
 *
 *     sum_f int g psi_a l_a = sum_f int psi_a z_N,   |l_a| <= 1,   l_a continuous at a.
 *
 * The first is possible because z_N does no more work on psi_a than g where the Gauss points of z_N see
 * all of g: always for constant g. Faces that slip at all of them have l_a = +-1, with the same work where g is constant. Of
 * all others, l_a minimises
 *
 *     h/(2 mu p) int psi_a (g l_a - t)^2 - 2 int psi_a g l_a u_Nt,
 *
 * the second term on faces with both stick and slip alone: what a deviation of the friction costs in the
 * energy of the stress, up to a factor near 1, and what it spares in int g (|u_Nt| - l* u_Nt). t is z_N; where that is
 * one number on the face, for p = 2, t has its mean, and varies like -sigma_t(u_N). Tresca's law only.
 */
template <int dim>
class AdmissibleFriction
{
public:
  explicit AdmissibleFriction(const Solution<dim> &solution);

  /** l_a at end 0 or 1 of a face of ContactSpace::faces(). Zero where g vanishes on the face. */
  const EdgePolynomial &part(unsigned int face, unsigned int end) const;

  double value(unsigned int face, double s) const; ///< l* at s in [0,1]

  /**
   * The largest of `|sum_f int g psi_a l_a - int psi_a z_N|`, relative to int psi_a g: above round-off
   * only where z_N does other work than g, because that varies between the Gauss points. No stress
   * near sigma(u_N) is in balance with l* then.
   */
  double imbalance() const;

  /**
   * Forces on the displacement unknowns that do the work which g l* leaves undone,
   * `int psi_a z_N - sum_f int g psi_a l_a` along the tangent, on each hat function.
   */
  dealii::Vector<double> missing_forces(const Solution<dim> &solution) const;

private:
  std::vector<std::array<EdgePolynomial, 2>> parts; ///< by face and end
  std::vector<std::array<double, 2>> missing;       ///< work, likewise
  double largest_imbalance = 0;
};
} // namespace hpvi

#endif
