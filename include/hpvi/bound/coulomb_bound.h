// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_coulomb_bound_h
#define hpvi_coulomb_bound_h

#include <hpvi/bound/coulomb_coupling.h>
#include <hpvi/bound/error_bound.h>

#include <optional>

namespace hpvi
{
/** What theorem (C) makes a bound of. */
struct CoulombTerms
{
  double A;   ///< (sum_K (eta_K + O_K)^2)^{1/2}
  double gap; ///< int pi (u_0 - U_n + M') and what friction without pressure adds
  double b;   ///< no less than |d - w|_a
  double
      lift; ///< x_M = |X'|_a, X'_n = M' >= (mu_f (|U_t| - chi U_t) - (u_0 - U_n))_+ and X'_t = 0 along contact
};

/**
 * Theorem (C) of doc/coulomb.md: with k = coupling/2, nu = lambda k + (lambda^2 k^2 + (1 - lambda)^2)^{1/2},
 * c = lambda ((k + (1 + k^2)^{1/2}) b + x_M), every solution of Coulomb's law is within
 *
 *     min over lambda with nu < 1 of  [nu c + (nu^2 c^2 + (1 - nu^2)(A^2 + 2 lambda gap + c^2))^{1/2}]/(1 - nu^2)
 *
 * of u_N. Infinite from coupling 2 on.
 */
double coulomb_bound(double coupling, const CoulombTerms &terms);

/**
 * The limit of friction that an admissible pressure allows, g + mu_f pi, in the place of the law: the solution of a problem of Tresca's
 * law that has the same stress, friction and pressure. Nothing where no friction knows the pressure.
 */
std::optional<Solution<2>> under_admissible_limit(const Solution<2> &solution,
                                                  const AdmissiblePressure<2> &pressure);

/** Bounds under Coulomb's law, step by step. */
class CoulombBounds
{
public:
  /**
   * Sets total, kind, coupling, zones and why of @p result, whose total is Tresca's for the same stress. @p solution:
   * under_admissible_limit(); @p A and @p b as in CoulombTerms.
   */
  void set(ErrorBound &result, const Solution<2> &solution, const AdmissibleContact &contact,
           double A, double b);

private:
  void set_coupling(ErrorBound &result, const CoulombCoupling &couple, const Scene<2> &scene,
                    const SlipDirection &chi, const std::vector<bool> &sticks);

  CouplingSpaces spaces;
  std::optional<ContactStrip> strip; ///< of the scene, where it asks for one
};
} // namespace hpvi

#endif
