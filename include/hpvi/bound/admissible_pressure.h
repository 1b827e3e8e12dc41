// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_admissible_pressure_h
#define hpvi_admissible_pressure_h

#include <hpvi/bound/edge_polynomial.h>
#include <hpvi/bound/legendre.h>
#include <hpvi/plane/solution.h>

#include <array>
#include <vector>

namespace hpvi
{
/**
 * Pressure near that of the discrete solution which unilateral contact admits at every point, `pi >= 0`,
 * and which is in balance patch by patch: the datum of an equilibrated stress. The discrete pressure is
 * not negative at its points, but can be between them.
 *
 * On each face, for each of its ends a, there is a polynomial t_a of traction_degree(), psi_a included, with
 *
 *     sum_f int t_a (alpha + beta s) = <z_n, psi_a (alpha + beta s)>_N   for all alpha and beta,
 *     pi = t_a + t_b >= 0,
 *
 * over the one or two faces f at a that lie on one straight boundary, where < >_N is the product of the discrete
 * equations. Where z_n allows it, t_a is the projection of psi_a z_n with these moments face by face. Else
 * the faces of a neighbourhood, which grows until it is possible, share a quadratic program: least
 *
 *     h/(2 mu p) sum_a |t_a - psi_a z_n|^2 + 2 int pi (u_0 - u_Nn).
 *
 * Where no neighbourhood has one, as beside a force in a corner of the body, whose moment no pressure has, the faces with a
 * negative z_n take the least of the same over all `t_a = psi_a pi` with their force alone: forces are missing then.
 */
template <int dim>
class AdmissiblePressure
{
public:
  explicit AdmissiblePressure(const Solution<dim> &solution);

  /** t_a at end 0 or 1 of a face of ContactSpace::faces() [stress]; zero where none can press. */
  const EdgePolynomial &part(unsigned int face, unsigned int end) const;

  EdgePolynomial value(unsigned int face) const; ///< pi

  /** How far below zero pi is somewhere, over the largest pressure, because no admissible one is found; else 0. */
  double tension() const;

  /** Has pi the force and moment of z_n on each patch? If not, no stress near sigma(u_N) is in balance with it. */
  bool is_balanced() const;

  /** Forces on the displacement unknowns that do the work which pi leaves undone, `<z_n, v_n>_N - int pi v_n`. */
  dealii::Vector<double> missing_forces(const Solution<dim> &solution) const;

private:
  std::vector<std::array<EdgePolynomial, 2>> parts; ///< by face and end
  std::vector<unsigned int> redistributed;          ///< faces whose pi has the force of z_n alone
  double largest_tension = 0;
};

/** u_0 at s in [0,1] of a contact face; at an end where it jumps that of the face's own side [length]. */
template <int dim>
double gap_on_face(const ContactFace<dim> &face, double s);

/** u_0 on a contact face, read at the Gauss-Lobatto nodes of its displacement [length]. */
template <int dim>
EdgePolynomial gap_at_nodes(const ContactFace<dim> &face, const ShapeTables<dim> &tables,
                            const LegendreTables &legendre);
} // namespace hpvi

#endif
