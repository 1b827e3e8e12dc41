// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_coulomb_coupling_h
#define hpvi_coulomb_coupling_h

#include <hpvi/bound/localised_coupling.h>

#include <memory>
#include <string>
#include <vector>

namespace hpvi
{
/** The coupling above which a bound is finite and of no use. */
constexpr double largest_coupling = 1.8;

/** theta of an elastic half plane for mu_f chi = 1: `(1 - beta^2)^{-1/2}`, `beta = (kappa - 1)/(kappa + 1)` with Kolosov's kappa; orthotropic ones: 1. */
double half_plane_coupling(const Material &material);

/**
 * theta for mu_f chi = 1 at the tip of a wedge of @p angle [rad] with contact on one side and nothing on the other, for displacements that
 * hardly vary: `M_nn/(M_tt M_nn - M_tn^2)^{1/2}`, `M = int_0^angle d d'`, d = (cos, sin), t along the side. A lower bound of that of the
 * wedge: 1.2967 at 90 degrees, whatever the material. Contact is along the outer normal turned by @p turn towards the side.
 */
double free_wedge_coupling(double angle, double turn = 0.);

/**
 * The same where the other side of the wedge is clamped: `N_tt/(N_tt N_nn - N_tn^2)^{1/2}`,
 * `N = int_0^angle e e'/(lambda + 2 mu) + d d'/mu`, e = (-sin, cos). 1.069 at 90 degrees for nu = 0.3 in plane strain, where the half
 * plane has 1.044; orthotropic ones: 1.
 */
double clamped_wedge_coupling(double angle, const Material &material, double turn = 0.);

/**
 * How strongly friction couples back: theta = |T|, T v the displacement of least energy with `X_n = mu_f chi v_t`, `X_t = 0` along contact,
 * X = 0 where v is. With the compliance S of all multipliers, of friction (F) with their pressures (P), and those whose trace v
 * has not (b: bilateral, tied, and where v sticks),
 *
 *     theta^2 = lambda_max(D [S_FF - S_Fb S_bb^-1 S_bF] D (S^-1)_PP),     D = diag(mu_f chi),
 *
 * by Lanczos' method, in a space of CouplingSpaces, times 1.05, and at least that of the half plane, of free and of clamped wedges. An
 * estimate: not enclosed from above.
 */
class CoulombCoupling
{
public:
  /** @p spaces: kept from step to step. Both must outlive this object. */
  CoulombCoupling(const Solution<2> &solution, CouplingSpaces &spaces);
  ~CoulombCoupling();

  /**
   * For chi of a stress; with @p sticks, by face, for displacements that stick there. Throws NumericalFailure where S is not
   * regular, or the space does not see all of the friction.
   */
  double operator()(const SlipDirection &chi, const std::vector<bool> &sticks = {}) const;

  /** Of the matrices alone, without factor and closed forms. */
  double of_matrices(const SlipDirection &chi, const std::vector<bool> &sticks = {}) const;

  /** theta from above. */
  struct Localised
  {
    double above =
        0; ///< theta is no more, as far as the finite matrix has all that is not on the complement
    double kappa =
        0; ///< |T y| <= kappa |y| for all y on the complement: their moments on cells vanish
    double on_complement = 0; ///< of the matrix there, which is no more than kappa
    unsigned int n_cells = 0;
  };

  /** Where contact is a strip; no less than the estimate, and this alone where it is too large for a bound. */
  Localised localised(const ContactStrip &strip, const SlipDirection &chi,
                      const std::vector<bool> &sticks = {}) const;

  /**
   * Where theta is infinite although matrices need not show it, in words: contact ends where a support holds u_n and leaves u_t, or at
   * another contact side that does; mu_f chi jumps; empty: nowhere.
   */
  std::string unbounded_at(const SlipDirection &chi, const std::vector<bool> &sticks = {}) const;

private:
  struct Unknowns;
  struct Boundary;
  Unknowns unknowns(const ContactCompliance &compliance, const FrictionAlong &friction) const;
  static dealii::FullMatrix<double> moment_columns(ContactCompliance &compliance,
                                                   const Unknowns &all,
                                                   const CouplingMatrices &matrices,
                                                   const dealii::Vector<double> &D,
                                                   const std::vector<std::vector<double>> &rows);
  double closed_forms(const SlipDirection &chi, const std::vector<bool> &sticks) const;

  const Solution<2> &solution;
  CouplingSpaces &spaces;
  const std::unique_ptr<Boundary> boundary;
};
} // namespace hpvi

#endif
