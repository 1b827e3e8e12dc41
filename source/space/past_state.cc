// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/processes.h>
#include <hpvi/space/load_work.h>
#include <hpvi/space/past_state.h>

#include <algorithm>
#include <map>
#include <vector>

namespace hpvi
{
using namespace dealii;

template <int dim>
PastState<dim> end_state(const PrimalSpace<dim> &space, const DistributedVector &u,
                         const std::vector<ContactVector<dim>> &lambda,
                         const NodalForces<dim> &forces)
{
  PastState<dim> result{std::make_shared<const Scene<dim>>(space.scene), u, {}, {}};
  result.u.update_ghost_values(); // copies have none
  for (unsigned int k = 0; k < space.contact.size(); ++k)
    result.traction.push_back(space.contact[k].bound_by(lambda) * lambda[k]);
  for (const auto &reaction : forces.reactions)
    if (const auto &boundary = space.scene.boundaries[reaction.boundary];
        !reaction.is_of_springs && (boundary.has_displacement() || boundary.plate))
      result.supports.push_back(reaction);
  return result;
}

namespace
{
/** What the supports of a scene prescribe, none at rest. */
template <int dim>
class Prescribed
{
public:
  explicit Prescribed(const Scene<dim> *const scene) : scene(scene)
  {
    if (scene)
      for (const BoundaryCondition<dim> &boundary : scene->boundaries)
        if (boundary.plate)
          plates.emplace(boundary.id, PlateMotion<dim>(*scene, boundary));
  }

  /** Zero for a component that is free. */
  Tensor<1, dim> at(const unsigned int boundary, const Point<dim> &x) const
  {
    Tensor<1, dim> u;
    if (const auto plate = plates.find(boundary); plate != plates.end())
      return plate->second.prescribed(x);
    for (unsigned int c = 0; scene && c < dim; ++c)
      if (const Expression<dim> &function = scene->boundaries[boundary].displacement[c])
        u[c] = function->value(x);
    return u;
  }

private:
  const Scene<dim> *const scene;
  std::map<unsigned int, PlateMotion<dim>> plates;
};

/** Of the reactions of one state on the increments of prescribed displacements; @p last is null at rest. */
template <int dim>
double work_of_supports(const PastState<dim> &state, const Scene<dim> *const last,
                        const Scene<dim> &next)
{
  const Prescribed<dim> before(last), after(&next);
  double sum = 0;
  for (const auto &reaction : state.supports)
    sum += reaction.force *
           (after.at(reaction.boundary, reaction.x) - before.at(reaction.boundary, reaction.x));
  return sum;
}

/** By how much the gaps of pressures grow, by contact dof. */
template <int dim>
std::vector<double> growth_of_gaps(const PastState<dim> *const last, const PrimalSpace<dim> &space)
{
  std::vector<double> result(space.contact.size(), 0.);
  if (space.n_pressures == 0)
    return result;
  std::vector<ContactDof<dim>> before;
  if (last)
    before = PrimalSpace<dim>(*last->scene,
                              dynamic_cast<const typename PrimalSpace<dim>::Mesh &>(
                                  space.dof_handler.get_triangulation()),
                              space.tables)
                 .contact;
  for (unsigned int k = 0; k < result.size(); ++k)
    if (!space.contact[k].is_tangential())
      result[k] =
          last ? space.contact[k].gap[0] - before[k].gap[0] : std::min(space.contact[k].gap[0], 0.);
  return result;
}

/** What acts in one state while the body moves by du. */
struct Acting
{
  double outside = 0, friction = 0, pressure = 0, elsewhere = 0;
};

/** @p sums: own parts of the work of supports, of friction, of pressures on m(du), and on the growth of gaps. */
Acting acting(const double loads, const double inside, const std::vector<double> &sums)
{
  return {loads + sums[0] - sums[3], sums[1], sums[2] - sums[3],
          inside + sums[1] + sums[2] - loads - sums[0]};
}
} // namespace

template <int dim>
Work work(const PastState<dim> *const last, const PastState<dim> &next,
          const PrimalSpace<dim> &space, const PrimalSystem<dim> &system)
{
  DistributedVector du = next.u;
  if (last)
  {
    DistributedVector own = space.owned_vector(), before = space.owned_vector();
    own.copy_locally_owned_data_from(next.u);
    before.copy_locally_owned_data_from(last->u);
    own -= before;
    du = space.ghosted_vector();
    du.copy_locally_owned_data_from(own);
  }
  du.update_ghost_values(); // copies have none
  const DistributedVector contact_dofs = space.in_contact_dofs(du);
  const std::vector<double> growth = growth_of_gaps(last, space);
  const auto in_state = [&](const PastState<dim> &state)
  {
    std::vector<double> sums(4, 0.), all(4);
    collectively(space.communicator(),
                 [&]() {
                   sums[0] = work_of_supports<dim>(state, last ? last->scene.get() : nullptr,
                                                   *next.scene);
                 });
    for (unsigned int k = 0; k < space.contact.size(); ++k)
    {
      const ContactVector<dim> force = space.contact[k].area * state.traction[k];
      sums[space.contact[k].is_friction() ? 1 : 2] += force * space.contact_value(contact_dofs, k);
      sums[3] += force[0] * growth[k];
    }
    Utilities::MPI::sum(sums, space.communicator(), all);
    const auto internal = system.nodal_forces(state.u).internal;
    DistributedVector own = space.owned_vector(), own_du = space.owned_vector();
    own.copy_locally_owned_data_from(internal);
    own_du.copy_locally_owned_data_from(du);
    return acting(load_work(*state.scene, space, du, 1), own * own_du, all);
  };
  const Acting before = last ? in_state(*last) : Acting(), after = in_state(next);
  return {0.5 * (before.outside + after.outside),
          after.friction,
          0.5 * (before.friction - after.friction + before.pressure + after.pressure),
          -0.5 * before.elsewhere,
          0.5 * (before.friction + after.friction),
          system.initial_energy(next.u)};
}

template PastState<2> end_state(const PrimalSpace<2> &, const DistributedVector &,
                                const std::vector<ContactVector<2>> &, const NodalForces<2> &);
template PastState<3> end_state(const PrimalSpace<3> &, const DistributedVector &,
                                const std::vector<ContactVector<3>> &, const NodalForces<3> &);
template Work work(const PastState<2> *, const PastState<2> &, const PrimalSpace<2> &,
                   const PrimalSystem<2> &);
template Work work(const PastState<3> *, const PastState<3> &, const PrimalSpace<3> &,
                   const PrimalSystem<3> &);
} // namespace hpvi
