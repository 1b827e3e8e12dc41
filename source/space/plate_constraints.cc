// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/gathered.h>
#include <hpvi/space/plate_constraints.h>
#include <hpvi/space/support_constraints.h>

#include <algorithm>
#include <numeric>

namespace hpvi
{
using namespace dealii;

namespace
{
template <int dim>
constexpr unsigned int n_motions = PlateMotion<dim>::n_motions;

/** As it goes to other processes. */
template <int dim>
struct PlainNode
{
  std::array<types::global_dof_index, dim> dofs;
  std::array<double, dim> x;
};

/**
 * Nodes of any process, the same on all, that determine the motions of a plate: of each process those that it would take
 * itself.
 */
template <int dim>
std::vector<SupportedNode<dim>>
candidates(const PlateMotion<dim> &plate, const std::vector<SupportedNode<dim>> &own,
           const std::vector<unsigned int> &motions, MPI_Comm communicator)
{
  std::vector<PlainNode<dim>> best;
  for (const auto &master : PlateMasters<dim>(plate, motions, own).masters)
  {
    const auto node = std::find_if(own.begin(), own.end(),
                                   [&](const SupportedNode<dim> &one)
                                   { return one.dofs[master.component] == master.dof; });
    best.push_back({node->dofs, {}});
    for (unsigned int d = 0; d < dim; ++d)
      best.back().x[d] = node->x[d];
  }
  std::vector<SupportedNode<dim>> result;
  for (const PlainNode<dim> &plain : gathered(best, communicator))
    if (std::none_of(result.begin(), result.end(),
                     [&](const SupportedNode<dim> &known) { return known.dofs == plain.dofs; }))
    {
      result.emplace_back();
      result.back().dofs = plain.dofs;
      for (unsigned int d = 0; d < dim; ++d)
        result.back().x[d] = plain.x[d];
    }
  return result;
}
} // namespace

template <int dim>
std::array<double, PlateMotion<dim>::n_motions>
PlateOnMesh<dim>::amounts(const DistributedVector &u) const
{
  std::array<double, n_motions<dim>> result{};
  for (unsigned int m = 0; m < result.size(); ++m)
    for (unsigned int i = 0; i < gauges.masters.size(); ++i)
      result[m] += gauges.share(m, i) * u(gauges.masters[i].dof);
  return result;
}

template <int dim>
std::vector<SupportedNode<dim>> plate_nodes(const Scene<dim> &scene,
                                            const DoFHandler<dim> &dof_handler,
                                            const DegreeTables<dim> &tables)
{
  std::vector<SupportedNode<dim>> result;
  if (!scene.has_plates())
    return result;
  for (SupportedNode<dim> &node : supported_nodes(scene, dof_handler, tables))
    if (node.is_on_plate)
      result.push_back(std::move(node));
  return result;
}

template <int dim>
std::vector<PlateOnMesh<dim>> constrain_plates(const Scene<dim> &scene,
                                               const DoFHandler<dim> &dof_handler,
                                               const DegreeTables<dim> &tables, IndexSet &relevant,
                                               AffineConstraints<double> &constraints)
{
  std::vector<PlateOnMesh<dim>> result;
  if (!scene.has_plates())
    return result;
  MPI_Comm communicator = dof_handler.get_communicator();
  std::vector<SupportedNode<dim>> nodes;
  std::vector<std::pair<types::boundary_id, PlateMotion<dim>>> plates;
  collectively(communicator,
               [&]()
               {
                 nodes = plate_nodes(scene, dof_handler, tables);
                 for (const BoundaryCondition<dim> &boundary : scene.boundaries)
                   if (boundary.plate)
                     plates.emplace_back(boundary.id, PlateMotion<dim>(scene, boundary));
               });
  // A hanging node depends on nodes of the same plate.
  const auto hangs = [&](const SupportedNode<dim> &node)
  { return constraints.is_constrained(node.dofs[0]); };
  nodes.erase(std::remove_if(nodes.begin(), nodes.end(), hangs), nodes.end());
  for (const auto &[boundary, motion] : plates)
  {
    std::vector<SupportedNode<dim>> on_plate, own;
    for (const SupportedNode<dim> &node : nodes)
      if (node.is_on(boundary))
      {
        on_plate.push_back(node);
        if (dof_handler.locally_owned_dofs().is_element(node.dofs[0]))
          own.push_back(node);
      }
    std::vector<unsigned int> all(n_motions<dim>);
    std::iota(all.begin(), all.end(), 0);
    const auto free = motion.free_motions();
    result.push_back({boundary,
                      motion,
                      {motion, free, candidates(motion, own, free, communicator)},
                      {motion, all, candidates(motion, own, all, communicator)}});
    const PlateOnMesh<dim> &plate = result.back();
    AssertThrow(plate.gauges.masters.size() == all.size(),
                ExcMessage("The faces of a rigid plate do not determine how it turns."));
    for (const auto *const some : {&plate.masters, &plate.gauges})
      for (const auto &master : some->masters)
        relevant.add_index(master.dof);
    for (const SupportedNode<dim> &node : on_plate)
      plate.masters.constrain(motion, node, constraints);
  }
  relevant.compress();
  return result;
}

template <int dim>
double plate_work(const Scene<dim> &scene, const std::vector<PlateOnMesh<dim>> &plates,
                  const DistributedVector &u)
{
  double sum = 0;
  for (const PlateOnMesh<dim> &plate : plates)
  {
    const auto q = plate.amounts(u);
    for (unsigned int m = 0; m < q.size(); ++m)
      sum += scene.boundaries[plate.boundary].plate->force[m] * q[m];
  }
  return sum;
}

template struct PlateOnMesh<2>;
template struct PlateOnMesh<3>;
template std::vector<SupportedNode<2>> plate_nodes(const Scene<2> &, const DoFHandler<2> &,
                                                   const DegreeTables<2> &);
template std::vector<SupportedNode<3>> plate_nodes(const Scene<3> &, const DoFHandler<3> &,
                                                   const DegreeTables<3> &);
template std::vector<PlateOnMesh<2>> constrain_plates(const Scene<2> &, const DoFHandler<2> &,
                                                      const DegreeTables<2> &, IndexSet &,
                                                      AffineConstraints<double> &);
template std::vector<PlateOnMesh<3>> constrain_plates(const Scene<3> &, const DoFHandler<3> &,
                                                      const DegreeTables<3> &, IndexSet &,
                                                      AffineConstraints<double> &);
template double plate_work(const Scene<2> &, const std::vector<PlateOnMesh<2>> &,
                           const DistributedVector &);
template double plate_work(const Scene<3> &, const std::vector<PlateOnMesh<3>> &,
                           const DistributedVector &);
} // namespace hpvi
