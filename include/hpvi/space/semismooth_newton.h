// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_semismooth_newton_h
#define hpvi_semismooth_newton_h

#include <hpvi/space/augmented_lagrangian.h>

#include <functional>
#include <vector>

namespace hpvi
{
/** What Newton's method did. */
struct NewtonReport
{
  unsigned int steps = 0;
  unsigned int cg_steps = 0; ///< of conjugate gradients in all of them
  unsigned int setups = 0;   ///< of multigrid
  bool fell_back = false; ///< a method for linear systems broke down, and the next took its place
  LinearMethod linear = LinearMethod::automatic; ///< that was used last
  unsigned int line_searches = 0;                ///< steps that had to be shortened
  unsigned int augmented_steps = 0;              ///< of the augmented Lagrangian
  bool is_cut_off = false;                       ///< Newton's method was, and that took its place
  unsigned int tresca_problems = 0; ///< of a law that knows the pressure, see FrictionIteration
  double contraction = 0;           ///< of these, as far as seen
  unsigned int n_slipping = 0;      ///< discs where contact is closed, of all processes
  unsigned int n_pressing = 0;      ///< contact dofs on which a pressure acts, likewise
  double residual = 0;              ///< relative to the load vector
  double error = 0;                 ///< estimated, in the energy norm

  /** Goes on where this one ended: counts add up. */
  NewtonReport &operator+=(const NewtonReport &next);
};

/** Where Newton's method may stop, and where it has to give way. */
struct NewtonSettings
{
  double residual = 1e-6;          ///< relative to the load vector
  double error = 0;                ///< or: estimated, in the energy norm [(stress length^dim)^1/2]
  unsigned int maximum_steps = 12; ///< then the augmented Lagrangian takes over
  bool wants_error =
      true; ///< NewtonReport::error where nothing asks for it so far: one more cycle of multigrid
};

/**
 * Minimises `1/2 v'A v - f'v + sum_k G_k |m_k|` over v, m_k its contact dofs at disc k, under `m_k <= u_0` where a
 * pressure acts, by a semismooth Newton method: with `r = f - A v`, `lambda_k = r_k/G_k` and
 * `z_k = lambda_k + c_k (m_k - u_0)` the condition is `lambda = P(z)`, P the projection onto unit
 * discs and half lines. Where |z| <= 1 a disc sticks, m = 0, and where z > 0 a pressure holds m = u_0 (the
 * primal-dual active set of Hintermueller, Ito and Kunisch 2002, doi:10.1137/S1052623401383558); elsewhere, with
 * n = z/|z| of a disc that slips and n = 0 where contact is open, the next v solves
 *
 *     (A + sum_k H_k) v = f - sum_k G_k n_k,    H_k = G_k c_k/(|z_k| - 1) (I - n_k n_k'),
 *
 * symmetric and positive; under a past slip H_k u_0 joins the right-hand side. A step between two admissible fields that raises the energy is shortened to its minimum along
 * the step; where one of them penetrates the foundation energies do not compare.
 * Hueber, Stadler and Wohlmuth (2008) have the same function of lambda and u with multipliers as unknowns;
 * here they are gone, because contact dofs make the matrix of contact diagonal.
 *
 * Where that takes too many steps, and where many discs have no start, AugmentedLagrangian takes over. What is
 * said of m_k under friction holds of `m_k - u_0`, u_0 the past slip.
 */
template <int dim>
class SemismoothNewton
{
public:
  SemismoothNewton(const PrimalSpace<dim> &space, const PrimalSystem<dim> &system,
                   NewtonMatrix<dim> &matrix);

  /**
   * Starts where v and lambda are, or where @p lambda is empty with all discs sticking and all contact closed, and stops where
   * @p settings are met; @p heard is told the steps so far. The error is estimated from the residual
   * rho of all equations under `lambda = P(z)` and the gap of friction, as of strongly convex functions:
   * `|v - u_N|_a^2 <= rho' A^-1 rho + 2 sum_k (G_k |m_k| - lambda_k m_k)`, with the preconditioner for A^-1. Contact
   * adds `2 G_k p_k |m_k - u_0|` with p = P(z), and where it is penetrated A's diagonal times the depth squared.
   * Collective. Throws NumericalFailure where the augmented Lagrangian gives up as well.
   */
  NewtonReport solve(
      DistributedVector &v, std::vector<ContactVector<dim>> &lambda, const NewtonSettings &settings,
      const std::function<void(const NewtonReport &)> &heard = [](const NewtonReport &) {});

  /** From here on G_k, of each contact dof; at first those of the space. */
  void take_weights(const std::vector<double> &weights);

  /** Where v and @p lambda are, in the words of solve(): its residual and its error. Collective. */
  NewtonReport measure(const DistributedVector &v, const std::vector<ContactVector<dim>> &lambda,
                       const NewtonSettings &settings);

private:
  struct Residual
  {
    double norm = 0, gap = 0;
    double load =
        0; ///< to which the norm is compared: the largest of the load vector's, of that of pressures' forces, and of a part of #internal
  };

  bool acts(unsigned int k) const; ///< no friction acts where g = 0
  double stiffness(unsigned int k) const;
  ContactVector<dim> distance(const DistributedVector &v, unsigned int k) const;
  ContactVector<dim> admissible(unsigned int k) const;
  double gap(const DistributedVector &v, unsigned int k) const;
  Residual residual(const DistributedVector &v, bool keep_lambda);
  DistributedVector off_contact() const;
  std::vector<ContactDofState<dim>> states(bool all_held) const;
  void hold(DistributedVector &v, const std::vector<ContactDofState<dim>> &states) const;
  bool penetrates(const DistributedVector &v, double force) const;
  DistributedVector right_hand_side(const std::vector<ContactDofState<dim>> &states) const;
  double friction(const DistributedVector &v, const DistributedVector &step, double length) const;
  bool shorten(DistributedVector &v, const DistributedVector &old, double load) const;
  double error(double gap);
  double linear_tolerance(const NewtonSettings &settings, const Residual &now,
                          unsigned int step) const;
  bool is_exact(const NewtonSettings &settings, const Residual &now, NewtonReport &report);
  Residual augment(DistributedVector &v, NewtonReport &report);
  void count(const std::vector<ContactDofState<dim>> &states, NewtonReport &report) const;

  const PrimalSpace<dim> &space;
  const PrimalSystem<dim> &system;
  NewtonMatrix<dim> &matrix;
  std::vector<double> weights; ///< G of each contact dof
  std::vector<double> c;       ///< of each contact dof [1/length; of a pressure stress/length]
  std::vector<ContactVector<dim>> lambda, z;
  double internal = 0; ///< the largest norm of A v so far: the size of forces where loads vanish
  double previous = 0; ///< norm of the residual before the last step
  DistributedVector r; ///< f - A v of the last residual()
  std::unique_ptr<AugmentedLagrangian<dim>> fallback; ///< where it is needed
};
} // namespace hpvi

#endif
