// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_slip_correction_h
#define hpvi_slip_correction_h

#include <hpvi/discretisation/discretisation.h>
#include <hpvi/equilibration/admissible_friction.h>

#include <vector>

namespace hpvi
{
/**
 * What friction adds to the bound of the error,
 *
 *     |u - u_N|_a^2 <= |s - sigma(u_N)|^2 + 2 gap(u_N - w) + |w|_a^2,   gap(v) = int g (|v_t| - l* v_t),
 *
 * for a stress s in balance with the admissible friction g l*, and any w in V_N that vanishes where
 * displacements are prescribed, with w_n = 0 on contact. gap(u_N) alone would be of first order in u_Nt
 * where the body sticks and u_Nt oscillates.
 *
 * Here w_t = u_Nt on faces that stick, and elsewhere w is one of these, whichever gives least: it has the
 * least energy; or it makes `2 gap + |w|_a^2` least while u_Nt - w_t keeps the direction of slip on faces
 * with both stick and slip and on slipping ones nearby. Or w = 0. It lives in the cells at the contact
 * boundary.
 */
template <int dim>
class SlipCorrection
{
public:
  SlipCorrection(const Solution<dim> &solution, const Discretisation<dim> &discretisation,
                 const AdmissibleFriction<dim> &friction);

  const std::vector<double> &gap() const; ///< of u_N - w, by contact face [stress length^dim]
  const std::vector<double> &uncorrected_gap() const; ///< of u_N
  const std::vector<double> &energy() const;          ///< |w|_a^2 by cell [stress length^dim]
  const dealii::Vector<double> &unknowns() const;     ///< w, as Unknowns counts them

  double total() const; ///< `2 gap(u_N - w) + |w|_a^2`

private:
  std::vector<double> face_gaps, uncorrected, cell_energies;
  dealii::Vector<double> w;
};
} // namespace hpvi

#endif
