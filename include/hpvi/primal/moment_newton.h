// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_moment_newton_h
#define hpvi_moment_newton_h

#include <hpvi/moments/moment_matrix.h>

#include <functional>
#include <vector>

namespace hpvi
{
/** What Newton's method did. */
struct NewtonReport
{
  unsigned int steps = 0;
  unsigned int cg_steps = 0;      ///< of conjugate gradients in all of them
  unsigned int setups = 0;        ///< of multigrid
  bool fell_back = false;         ///< multigrid broke down, and a factorisation took its place
  unsigned int line_searches = 0; ///< steps that had to be shortened
  unsigned int n_slipping = 0;    ///< discs, of all processes
  double residual = 0;            ///< relative to the load vector
  double error = 0;               ///< estimated, in the energy norm
};

/**
 * Minimises `1/2 v'A v - f'v + sum_k G_k |m_k|` over v, m_k its moments at disc k, by a semismooth
 * Newton method: with `r = f - A v`, `lambda_k = r_k/G_k` and `z_k = lambda_k + c_k m_k` the
 * condition is `lambda = P(z)`, P the projection onto unit discs. Where |z| <= 1 a disc
 * sticks, m = 0; elsewhere with n = z/|z| the next v solves
 *
 *     (A + sum_k H_k) v = f - sum_k G_k n_k,    H_k = G_k c_k/(|z_k| - 1) (I - n_k n_k'),
 *
 * symmetric and positive. A step that raises the energy is shortened to its minimum along the step.
 * Hueber, Stadler and Wohlmuth (2008) have the same function of lambda and u with multipliers as unknowns;
 * here they are gone, because moments make the matrix of contact diagonal.
 */
template <int dim>
class MomentNewton
{
public:
  MomentNewton(const MomentSpace<dim> &space, const PrimalSystem<dim> &system,
               MomentMatrix<dim> &matrix);

  /**
   * Starts where v and lambda are, or where @p lambda is empty with all discs sticking, and stops where the residual
   * is below @p tolerance times the load vector; @p heard is told the steps so far. Collective. Throws
   * NumericalFailure after fifty steps.
   */
  NewtonReport solve(
      DistributedVector &v, std::vector<Tangential<dim>> &lambda, double tolerance,
      const std::function<void(const NewtonReport &)> &heard = [](const NewtonReport &) {});

private:
  struct Residual
  {
    double norm = 0, energy = 0, gap = 0;
  };

  Tangential<dim> at(const DistributedVector &x, unsigned int disc) const;
  bool acts(unsigned int disc) const; ///< no friction acts where g = 0
  Residual residual(const DistributedVector &v, bool keep_lambda);
  DistributedVector off_discs() const;
  std::vector<DiscState<dim>> states(bool all_stick) const;
  DistributedVector right_hand_side(const std::vector<DiscState<dim>> &states) const;
  double friction(const DistributedVector &v, const DistributedVector &step, double length) const;
  bool shorten(DistributedVector &v, const DistributedVector &old) const;
  double error(double gap);
  unsigned int n_slipping(const std::vector<DiscState<dim>> &states) const;

  const MomentSpace<dim> &space;
  const PrimalSystem<dim> &system;
  MomentMatrix<dim> &matrix;
  std::vector<double> c; ///< of each disc [1/length]
  std::vector<Tangential<dim>> lambda, z;
  DistributedVector r; ///< f - A v of the last residual()
};
} // namespace hpvi

#endif
