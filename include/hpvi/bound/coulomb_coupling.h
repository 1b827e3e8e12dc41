// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_coulomb_coupling_h
#define hpvi_coulomb_coupling_h

#include <hpvi/bound/slip_direction.h>

#include <deal.II/lac/full_matrix.h>

#include <memory>
#include <string>
#include <vector>

namespace hpvi
{
/** theta of an elastic half plane for mu_f chi = 1: `(1 - beta^2)^{-1/2}`, `beta = (kappa - 1)/(kappa + 1)` with Kolosov's kappa; orthotropic ones: 1. */
double half_plane_coupling(const Material &material);

/**
 * theta for mu_f chi = 1 at the tip of a wedge of @p angle [rad] with contact on one side and nothing on the other, for displacements that
 * hardly vary: `M_nn/(M_tt M_nn - M_tn^2)^{1/2}`, `M = int_0^angle d d'`, d = (cos, sin), t along the side. A lower bound of that of the
 * wedge: 1.2967 at 90 degrees, whatever the material.
 */
double free_wedge_coupling(double angle);

/**
 * How strongly friction couples back: theta = |T|, T v the displacement of least energy with `X_n = mu_f chi v_t`, `X_t = 0` along contact,
 * X = 0 where v is. With the compliance S of all multipliers, of friction (F) with their pressures (P), and those whose trace v
 * has not (b: bilateral, tied, and where v sticks),
 *
 *     theta^2 = lambda_max(D [S_FF - S_Fb S_bb^-1 S_bF] D (S^-1)_PP),     D = diag(mu_f chi),
 *
 * by Lanczos' method, in the space of degrees p + 1, times 1.05, and at least that of the half plane and of free wedges. An estimate:
 * not enclosed from above.
 */
class CoulombCoupling
{
public:
  /** Throws NumericalFailure where S is not regular. @p elements of the scene, kept from step to step. */
  CoulombCoupling(const Solution<2> &solution, CondensedElements<2> &elements);

  /** For chi of a stress; with @p sticks, by face, for displacements that stick there. */
  double operator()(const SlipDirection &chi, const std::vector<bool> &sticks = {}) const;

  /** Of the matrices alone, without factor and closed forms. */
  double of_matrices(const SlipDirection &chi, const std::vector<bool> &sticks = {}) const;

  /**
   * Where theta is infinite although matrices do not show it, in words: contact ends where a support holds u_n and leaves u_t, or at
   * another contact side that does; empty: nowhere.
   */
  std::string unbounded_at(const SlipDirection &chi, const std::vector<bool> &sticks = {}) const;

private:
  double closed_forms(const SlipDirection &chi, const std::vector<bool> &sticks) const;

  const Solution<2> &solution;
  std::shared_ptr<const Spaces<2>> spaces;
  dealii::FullMatrix<double> S;
};

/** The largest eigenvalue of `C D Y D`, C and Y symmetric positive semidefinite, D diagonal: by Lanczos' method, to 1e-8. */
double largest_eigenvalue(const dealii::FullMatrix<double> &C, const dealii::Vector<double> &D,
                          const dealii::FullMatrix<double> &Y);
} // namespace hpvi

#endif
