// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_augmented_lagrangian_h
#define hpvi_augmented_lagrangian_h

#include <hpvi/space/newton_matrix.h>

#include <algorithm>
#include <vector>

namespace hpvi
{
/**
 * Minimises `1/2 v'A v - f'v + sum_k G_k |m_k|`, m_k the contact dofs of v at disc k, under `m_k <= u_0` where a
 * pressure acts, from wherever it starts: each update minimises the smooth, strictly convex function
 *
 *     1/2 v'A v - f'v + sum_k G_k/c_k h(lambda_k + c_k (m_k - u_0)),
 *
 * `h(z) = |z|^2/2 or, outside the unit disc, |z| - 1/2` of friction and `h(z) = max(0, z)^2/2` of a pressure,
 * by Newton's method with a line search, then sets `lambda_k = P(lambda_k + c_k (m_k - u_0))`, P the projection onto
 * disc or half line, the derivative of h. That is the
 * proximal point method for the dual problem (Rockafellar 1976, doi:10.1137/0314056): it converges for any c, the
 * faster the larger c; c grows fourfold with each update. Slower than Newton's method on stick and slip themselves.
 */
template <int dim>
class AugmentedLagrangian
{
public:
  /** Starts with @p lambda; @p weights, G_k, live as long as this. */
  AugmentedLagrangian(const PrimalSpace<dim> &space, const PrimalSystem<dim> &system,
                      NewtonMatrix<dim> &matrix, const std::vector<double> &weights,
                      const std::vector<ContactVector<dim>> &lambda);

  /** One minimisation from @p v and one update of lambda; returns the steps. Collective. Throws NumericalFailure. */
  unsigned int update(DistributedVector &v);

private:
  double stiffness(unsigned int k) const;
  ContactVector<dim> argument(const DistributedVector &v, unsigned int k) const;
  double contact_forces() const;
  DistributedVector gradient(const DistributedVector &v) const;
  double change(const DistributedVector &v) const;
  std::vector<ContactDofState<dim>> states(const DistributedVector &v) const;
  double work_of_contact(const DistributedVector &v, const DistributedVector &step,
                         double length) const;
  double length_of(const DistributedVector &v, const DistributedVector &step,
                   const DistributedVector &gradient) const;

  const PrimalSpace<dim> &space;
  const PrimalSystem<dim> &system;
  NewtonMatrix<dim> &matrix;
  const std::vector<double> &weights;
  std::vector<ContactVector<dim>> lambda;
  double growth; ///< of c_k [stress/length]
};
} // namespace hpvi

#endif
