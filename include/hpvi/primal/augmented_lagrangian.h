// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_augmented_lagrangian_h
#define hpvi_augmented_lagrangian_h

#include <hpvi/moments/moment_matrix.h>

#include <algorithm>
#include <vector>

namespace hpvi
{
/** The projection onto the unit disc. */
template <int rank>
dealii::Tensor<1, rank> projected(const dealii::Tensor<1, rank> &z)
{
  return z / std::max(1., z.norm());
}

/**
 * Minimises `1/2 v'A v - f'v + sum_k G_k |m_k|`, m_k the moments of v at disc k, from wherever it
 * starts: each update minimises the smooth, strictly convex function
 *
 *     1/2 v'A v - f'v + sum_k G_k/c_k h(lambda_k + c_k m_k),    h(z) = |z|^2/2 or, outside the unit disc, |z| - 1/2,
 *
 * by Newton's method with a line search, then sets `lambda_k = P(lambda_k + c_k m_k)`. That is the
 * proximal point method for the dual problem (Rockafellar 1976, doi:10.1137/0314056): it converges for any c, the
 * faster the larger c; c grows fourfold with each update. Slower than Newton's method on stick and slip themselves.
 */
template <int dim>
class AugmentedLagrangian
{
public:
  /** Starts with @p lambda. */
  AugmentedLagrangian(const MomentSpace<dim> &space, const PrimalSystem<dim> &system,
                      MomentMatrix<dim> &matrix, const std::vector<Tangential<dim>> &lambda);

  /** One minimisation from @p v and one update of lambda; returns the steps. Collective. Throws NumericalFailure. */
  unsigned int update(DistributedVector &v);

private:
  double stiffness(unsigned int disc) const;
  Tangential<dim> argument(const DistributedVector &v, unsigned int disc) const;
  DistributedVector gradient(const DistributedVector &v) const;
  double change(const DistributedVector &v) const;
  std::vector<DiscState<dim>> states(const DistributedVector &v) const;
  double work_of_friction(const DistributedVector &v, const DistributedVector &step,
                          double length) const;
  double length_of(const DistributedVector &v, const DistributedVector &step,
                   const DistributedVector &gradient) const;

  const MomentSpace<dim> &space;
  const PrimalSystem<dim> &system;
  MomentMatrix<dim> &matrix;
  std::vector<Tangential<dim>> lambda;
  double growth; ///< of c_k [stress/length]
};
} // namespace hpvi

#endif
