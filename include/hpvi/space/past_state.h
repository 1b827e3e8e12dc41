// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_past_state_h
#define hpvi_past_state_h

#include <hpvi/results/energies.h>
#include <hpvi/results/equilibrium.h>
#include <hpvi/space/primal_system.h>

#include <memory>
#include <vector>

namespace hpvi
{
/** Where a load step of the primal path has ended, on the mesh at hand: from where the next one counts slip and work. */
template <int dim>
struct PastState
{
  std::shared_ptr<const Scene<dim>> scene;
  DistributedVector u;                      ///< with those of neighbours
  std::vector<ContactVector<dim>> traction; ///< of each contact dof [stress]
  std::vector<typename NodalForces<dim>::Reaction>
      supports; ///< of this process, on the mesh of its own
};

/** Of a solution with the nodal @p forces. Collective. */
template <int dim>
PastState<dim> end_state(const PrimalSpace<dim> &space, const DistributedVector &u,
                         const std::vector<ContactVector<dim>> &lambda,
                         const NodalForces<dim> &forces);

/**
 * From @p last, which is none at rest, to @p next on the same mesh of @p space and @p system, those of the scene of
 * next. Of prescribed displacements the work is that of the reactions at the nodes of either end on their
 * increments there. Collective.
 */
template <int dim>
Work work(const PastState<dim> *last, const PastState<dim> &next, const PrimalSpace<dim> &space,
          const PrimalSystem<dim> &system);
} // namespace hpvi

#endif
