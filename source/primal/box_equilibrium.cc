// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/primal/box_equilibrium.h>

#include <deal.II/dofs/dof_tools.h>

#include <algorithm>
#include <set>

namespace hpvi
{
using namespace dealii;

namespace
{
/** `G lambda` at Gauss point @p k of a face, along the axes of the body. */
template <int dim>
Tensor<1, dim> force_at(const MomentSpace<dim> &space, const MomentFace<dim> &face,
                        const unsigned int k, const std::vector<ContactVector<dim>> &lambda)
{
  Tensor<1, dim> result;
  for (unsigned int s = 0; face.has_friction() && s < dim - 1; ++s)
    result[tangents<dim>(face.face)[s]] =
        space.contact[face.friction + k].weight * lambda[face.friction + k][s];
  if (face.has_pressure())
  {
    const ContactMoment<dim> &pressure = space.contact[face.pressure + k];
    result[face.face / 2] = pressure.sign * pressure.weight * lambda[face.pressure + k][0];
  }
  return result;
}

/** What this process knows of nodes and of the forces there. */
template <int dim>
class NodalReactions
{
public:
  using Cell = typename MomentSpace<dim>::Cell;

  NodalReactions(const MomentSpace<dim> &space, const PrimalSystem<dim> &system,
                 const DistributedVector &u, const std::vector<ContactVector<dim>> &lambda);
  void add_to(Resultants<dim> &resultants) const;

private:
  void find_nodes();
  void find_contact_forces(const std::vector<ContactVector<dim>> &lambda);
  void carry_to_masters();

  const MomentSpace<dim> &space;
  DistributedVector loads, reactions;
  struct Node
  {
    Point<dim> x;
    unsigned int component = 0;
    std::set<types::boundary_id> holds; ///< whose conditions hold it
  };
  std::vector<Node> nodes; ///< of the unknowns of this process
  struct ContactForce
  {
    types::boundary_id boundary;
    Tensor<1, dim> force;
    Point<dim> x;
  };
  std::vector<ContactForce> contact_forces; ///< of nodes of faces of this process
};

template <int dim>
NodalReactions<dim>::NodalReactions(const MomentSpace<dim> &space, const PrimalSystem<dim> &system,
                                    const DistributedVector &u,
                                    const std::vector<ContactVector<dim>> &lambda)
    : space(space), nodes(space.owned.n_elements())
{
  auto forces = system.nodal_forces(u);
  loads.swap(forces.loads);
  reactions.swap(forces.internal);
  reactions -= loads;
  find_contact_forces(lambda);
  carry_to_masters();
  find_nodes();
}

/** `-sum_k G_k lambda_k m_k(phi_i)`: on inner and rim nodes of contact faces what no support exerts. */
template <int dim>
void NodalReactions<dim>::find_contact_forces(const std::vector<ContactVector<dim>> &lambda)
{
  const BoxTables<dim> &tables = space.tables;
  DistributedVector sum = space.ghosted_vector();
  std::vector<types::global_dof_index> dofs(tables.fe.dofs_per_cell);
  for (const MomentFace<dim> &face : space.faces)
  {
    face.cell->get_dof_indices(dofs);
    const auto add = [&](const FullMatrix<double> &moments, const std::vector<unsigned int> &shapes)
    {
      for (unsigned int j = 0; j < shapes.size(); ++j)
      {
        Tensor<1, dim> force;
        for (unsigned int k = 0; k < tables.n_moments(); ++k)
          force -= moments(k, j) * force_at(space, face, k, lambda);
        for (const unsigned int axis : face.axes())
          sum(dofs[tables.fe.component_to_system_index(axis, shapes[j])]) += force[axis];
        const unsigned int node = tables.fe.component_to_system_index(0, shapes[j]);
        contact_forces.push_back(
            {face.cell->face(face.face)->boundary_id(), force,
             MomentSpace<dim>::point_of(face.cell, tables.fe.unit_support_point(node))});
      }
    };
    add(tables.M, tables.inner[face.face]);
    add(tables.W, tables.rim[face.face]);
  }
  sum.compress(VectorOperation::add);
  reactions -= sum;
}

/** What acts on a hanging node acts on those that it depends on. */
template <int dim>
void NodalReactions<dim>::carry_to_masters()
{
  AffineConstraints<double> hanging(space.relevant);
  DoFTools::make_hanging_node_constraints(space.dof_handler, hanging);
  hanging.close();
  DistributedVector carried = space.ghosted_vector();
  for (const auto dof : space.owned)
    if (const auto *const entries = hanging.get_constraint_entries(dof))
    {
      for (const auto &[master, weight] : *entries)
        carried(master) += weight * reactions(dof);
      carried(dof) -= reactions(dof);
    }
  carried.compress(VectorOperation::add);
  for (const auto dof : space.owned)
    reactions(dof) += carried(dof);
}

template <int dim>
void NodalReactions<dim>::find_nodes()
{
  const FESystem<dim> &fe = space.tables.fe;
  std::vector<types::global_dof_index> dofs(fe.dofs_per_cell);
  for (const Cell &cell : space.dof_handler.active_cell_iterators())
  {
    if (cell->is_artificial())
      continue;
    cell->get_dof_indices(dofs);
    for (unsigned int i = 0; i < dofs.size(); ++i)
    {
      if (!space.owned.is_element(dofs[i]))
        continue;
      Node &node = nodes[space.owned.index_within_set(dofs[i])];
      node.x = MomentSpace<dim>::point_of(cell, fe.unit_support_point(i));
      node.component = fe.system_to_component_index(i).first;
      for (const unsigned int face : cell->face_indices())
        if (cell->at_boundary(face) && fe.has_support_on_face(i, face))
        {
          const BoundaryCondition<dim> &condition = space.condition(cell, face);
          if (condition.displacement[node.component] ||
              (condition.holds_normal() && node.component == face / 2))
            node.holds.insert(condition.id);
        }
    }
  }
}

/** Where several boundaries hold a node they share the reaction. */
template <int dim>
void NodalReactions<dim>::add_to(Resultants<dim> &resultants) const
{
  for (unsigned int i = 0; i < nodes.size(); ++i)
  {
    const Node &node = nodes[i];
    if (const double load = loads.local_element(i); load != 0)
      resultants.add_load(node.component, load, node.x);
    Tensor<1, dim> force;
    force[node.component] =
        reactions.local_element(i) / std::max<std::size_t>(1, node.holds.size());
    for (const types::boundary_id boundary : node.holds)
      resultants.add_reaction(boundary, force, node.x);
  }
  for (const ContactForce &part : contact_forces)
    resultants.add_reaction(part.boundary, part.force, part.x);
}
} // namespace

template <int dim>
Equilibrium<dim> equilibrium(const MomentSpace<dim> &space, const PrimalSystem<dim> &system,
                             const DistributedVector &u,
                             const std::vector<ContactVector<dim>> &lambda)
{
  const Corners<dim> &corners = space.scene.geometry.corners;
  Resultants<dim> resultants(space.scene,
                             corners.front() + 0.5 * (corners.back() - corners.front()));
  NodalReactions<dim>(space, system, u, lambda).add_to(resultants);
  resultants.replace([&space](const double mine)
                     { return Utilities::MPI::sum(mine, space.communicator()); });
  Equilibrium<dim> result;
  together(space.communicator(), [&]() { result = resultants.finish(); });
  return result;
}

template Equilibrium<2> equilibrium(const MomentSpace<2> &, const PrimalSystem<2> &,
                                    const DistributedVector &,
                                    const std::vector<ContactVector<2>> &);
template Equilibrium<3> equilibrium(const MomentSpace<3> &, const PrimalSystem<3> &,
                                    const DistributedVector &,
                                    const std::vector<ContactVector<3>> &);
} // namespace hpvi
