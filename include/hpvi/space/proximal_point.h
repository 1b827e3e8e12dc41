// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_proximal_point_h
#define hpvi_proximal_point_h

#include <hpvi/space/contact_statics.h>
#include <hpvi/space/newton_matrix.h>
#include <hpvi/space/semismooth_newton.h>

#include <functional>
#include <vector>

namespace hpvi
{
/**
 * Holds a body that contact alone holds while Newton's method looks for stick and slip: soft springs along its contact add
 * `1/2 sum_k s_k |m_k - a_k|^2` to the energy, with centres a_k where the contact dofs were before. That is strictly convex, and
 * solved again and again from where it has ended, the proximal point method (Rockafellar 1976, doi:10.1137/0314056), the
 * springs carry nothing in the end.
 */
class ProximalPoint
{
public:
  using Solve = std::function<NewtonReport(const NewtonSettings &)>;

  /** All of them live as long as this, which changes the f of @p system; @p statics are of that f. */
  ProximalPoint(const PrimalSpace<3> &space, PrimalSystem<3> &system, NewtonMatrix<3> &matrix,
                const ContactStatics &statics);

  ~ProximalPoint();
  ProximalPoint(const ProximalPoint &) = delete;
  ProximalPoint &operator=(const ProximalPoint &) = delete;

  /**
   * Calls @p inner, which moves @p v and @p lambda, until @p settings are met, springs included, and forces and moments
   * balance to 1e-9 of them. Collective. Throws NumericalFailure with the motion that does not end, and the forces along it.
   */
  NewtonReport solve(const DistributedVector &v, const std::vector<ContactVector<3>> &lambda,
                     const NewtonSettings &settings, const Solve &inner);

private:
  void drop_anchors(const DistributedVector &v);
  double regularise(const DistributedVector &v, double &energy) const;

  const PrimalSpace<3> &space;
  PrimalSystem<3> &system;
  const DistributedVector loads;
  const ContactStatics &statics;
  std::vector<double> springs; ///< [force/length]
  std::vector<ContactVector<3>> centres;
};
} // namespace hpvi

#endif
