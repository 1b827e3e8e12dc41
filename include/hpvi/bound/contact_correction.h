// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_contact_correction_h
#define hpvi_contact_correction_h

#include <hpvi/bound/admissible_friction.h>
#include <hpvi/bound/admissible_pressure.h>
#include <hpvi/bound/edge_bubbles.h>
#include <hpvi/plane/discretisation.h>

#include <vector>

namespace hpvi
{
/**
 * What contact adds to the bound of the error,
 *
 *     |u - u_N|_a^2 <= |s - sigma(u_N)|^2 + 2 gap(u_N - w) + |w|_a^2,
 *     gap(v) = int g (|v_t| - l* v_t) + int pi (u_0 - v_n),
 *
 * for a stress s in balance with the admissible friction g l* and pressure pi, and any w that vanishes where
 * displacements are prescribed, with w_n = 0 on bilateral contact and u_Nn - w_n <= u_0 on unilateral. gap(u_N)
 * alone would be of first order in u_Nt where the body sticks and u_Nt oscillates.
 *
 * Here w is in V_N. Where stick and slip, or contact and gap, share an edge, no polynomial of V_N has one sign and is near
 * zero on a part of it: there EdgeBubbles of four degrees more, eight near
 * incompressibility, are added. The end of slip or contact may also be on the first
 * face that sticks or presses. w_t = u_Nt on the other faces that stick, w_n = u_Nn - u_0 on those that press, and elsewhere w
 * is one of these, whichever gives least: it has the least energy; or it makes `2 gap + |w|_a^2` least while u_Nt - w_t
 * keeps the direction of slip on faces with both stick and slip and on slipping ones nearby, and u_Nn - w_n stays
 * below u_0. Or w = 0. What of u_Nn - w_n still exceeds u_0, read at the nodes of the faces (what it does between them is for
 * DataError), goes by a piecewise linear w_n. w lives in the cells at the contact boundary, near
 * incompressibility in their neighbours as well, and is zero along faces that slip everywhere, from the third on beside
 * others.
 */
template <int dim>
class ContactCorrection
{
public:
  /** @p bubbles: their matrices; nullptr leaves w in V_N. */
  ContactCorrection(const Solution<dim> &solution, const Discretisation<dim> &discretisation,
                    const AdmissibleFriction<dim> &friction,
                    const AdmissiblePressure<dim> &pressure, EdgeBubbles *bubbles);

  const std::vector<double> &gap() const; ///< of u_N - w, by contact face [stress length^dim]
  const std::vector<double> &uncorrected_gap() const; ///< of u_N
  const std::vector<double> &
  energy() const; ///< |w|_a^2 by cell and its springs [stress length^dim]

  /** w, as Unknowns counts them; behind those the coefficients of edge bubbles. */
  const dealii::Vector<double> &unknowns() const;

  /** Along a face U_t, and U_n - u_0 where contact is unilateral, for U = u_N - w [length]. */
  const EdgePolynomial &slip(unsigned int face) const;
  const EdgePolynomial &penetration_along(unsigned int face) const;

  /** How far u_N - w passes through the foundation because supports keep it there [length]; else 0. */
  double penetration() const;

  /** How far joints that must not open do so in u_N - w, since what meets at one of their vertices contradicts [length]; else 0. */
  double opening() const;

  double total() const; ///< `2 gap(u_N - w) + |w|_a^2`

private:
  std::vector<double> face_gaps, uncorrected, cell_energies;
  dealii::Vector<double> w;
  std::vector<EdgePolynomial> slips, penetrations; ///< by face
  double depth = 0, jump = 0;
};

/**
 * J(u_N + v) - J(u_N) [stress length^dim], v by its unknowns: u_N solves the discrete problem, where
 * `a(u_N, v) - L(v) = -<z_N, v>`.
 */
template <int dim>
double energy_change(const Solution<dim> &solution, const Discretisation<dim> &discretisation,
                     const dealii::Vector<double> &v);
} // namespace hpvi

#endif
