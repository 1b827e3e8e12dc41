// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_mooring_h
#define hpvi_mooring_h

#include <hpvi/primal/moment_matrix.h>
#include <hpvi/primal/moment_newton.h>

#include <functional>
#include <vector>

namespace hpvi
{
/**
 * Holds a body that contact alone holds while Newton's method looks for stick and slip: soft springs along its contact add
 * `1/2 sum_k s_k |m_k - a_k|^2` to the energy, with anchors a_k where the moments were before. That is strictly convex, and
 * solved again and again from where it has ended, Rockafellar's proximal point method, the springs carry nothing in the end.
 */
template <int dim>
class Mooring
{
public:
  using Solve = std::function<NewtonReport(const NewtonSettings &)>;

  /** All of them live as long as this, which changes the f of @p system. */
  Mooring(const MomentSpace<dim> &space, PrimalSystem<dim> &system, MomentMatrix<dim> &matrix);

  ~Mooring();
  Mooring(const Mooring &) = delete;
  Mooring &operator=(const Mooring &) = delete;

  /**
   * Calls @p inner, which moves @p v and @p lambda, until @p settings are met, springs included, and forces and moments
   * balance. Where supports hold the body that is once. Collective. Throws NumericalFailure with the motion that does not
   * end, and the forces along it.
   */
  NewtonReport solve(const DistributedVector &v, const std::vector<ContactVector<dim>> &lambda,
                     const NewtonSettings &settings, const Solve &inner);

private:
  void drop_anchors(const DistributedVector &v);
  double pull(const DistributedVector &v, double &energy) const;
  double imbalance(const std::vector<ContactVector<dim>> &lambda, std::string &words) const;

  const MomentSpace<dim> &space;
  PrimalSystem<dim> &system;
  const DistributedVector loads;
  std::vector<double> springs;
  std::vector<ContactVector<dim>> anchors;
};
} // namespace hpvi

#endif
