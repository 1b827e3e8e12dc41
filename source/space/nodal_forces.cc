// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/space/elastic_foundation.h>
#include <hpvi/space/nodal_forces.h>

#include <hpvi/base/processes.h>
#include <hpvi/plane/cell_map.h>
#include <hpvi/plane/load_quadrature.h>
#include <hpvi/plane/mesh.h>
#include <hpvi/space/support_constraints.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>

#include <algorithm>

namespace hpvi
{
using namespace dealii;

namespace
{
/** `G lambda` at Gauss point @p k of a face, along the axes of the body. */
template <int dim>
Tensor<1, dim> force_at(const PrimalSpace<dim> &space, const ContactDofFace<dim> &face,
                        const unsigned int k, const std::vector<ContactVector<dim>> &lambda)
{
  Tensor<1, dim> result;
  for (unsigned int s = 0; face.has_friction() && s < dim - 1; ++s)
    result += space.contact[face.friction + k].area *
              space.contact[face.friction + k].bound_by(lambda) * lambda[face.friction + k][s] *
              face.axes_at(k).tangents[s];
  if (face.has_pressure())
    result += space.contact[face.pressure + k].weight * lambda[face.pressure + k][0] *
              face.axes_at(k).normal;
  return result;
}

/** On the nodes of a curved face by `m = M u_inner + W u_rim`: one component after the other, of the matrix that is asked for. */
template <int dim>
Vector<double> forces_on_curved(const PrimalSpace<dim> &space, const ContactDofFace<dim> &face,
                                const FullMatrix<double> &moments,
                                const std::vector<ContactVector<dim>> &lambda)
{
  const unsigned int n = space.tables.of(face.cell).n_contact_dofs();
  Vector<double> of_contact(dim * n), result(moments.n());
  for (unsigned int k = 0; k < n; ++k)
  {
    const Tensor<1, dim> force = force_at(space, face, k, lambda);
    for (unsigned int own = 0; own < dim; ++own)
      of_contact[own * n + k] = force * face.direction(own, k);
  }
  moments.Tvmult(result, of_contact);
  return result;
}

/** What this process knows of nodes and of the forces there. */
template <int dim>
class NodalReactions
{
public:
  using Cell = typename PrimalSpace<dim>::Cell;

  NodalReactions(const PrimalSpace<dim> &space, const PrimalSystem<dim> &system,
                 const DistributedVector &u, const std::vector<ContactVector<dim>> &lambda);
  NodalForces<dim> forces() const; ///< collective

private:
  void find_nodes();
  void add_supports(NodalForces<dim> &result) const;
  void find_contact_forces(const std::vector<ContactVector<dim>> &lambda);
  void add_forces_opposite(const std::vector<ContactVector<dim>> &lambda, DistributedVector &sum);
  unsigned int body_of_boundary(const types::boundary_id boundary) const
  {
    return space.scene.geometry.body_of_side(space.scene.boundaries[boundary].side);
  }
  void carry_to_masters();

  const PrimalSpace<dim> &space;
  const DistributedVector &u;
  DistributedVector loads, reactions;
  struct Node
  {
    Point<dim> x;
    unsigned int component = 0, body = 0;
  };
  std::vector<Node> nodes; ///< of the unknowns of this process
  std::vector<typename NodalForces<dim>::Reaction>
      contact_forces; ///< of nodes of faces of this process
};

template <int dim>
NodalReactions<dim>::NodalReactions(const PrimalSpace<dim> &space, const PrimalSystem<dim> &system,
                                    const DistributedVector &u,
                                    const std::vector<ContactVector<dim>> &lambda)
    : space(space), u(u), nodes(space.owned.n_elements())
{
  auto forces = system.nodal_forces(u);
  loads.swap(forces.loads);
  reactions.swap(forces.internal);
  reactions -= loads;
  if (space.scene.has_initial_strain())
    loads -= system.strain_loads();
  find_contact_forces(lambda);
  carry_to_masters();
  find_nodes();
}

/** `-sum_k G_k lambda_k m_k(phi_i)`: on inner and rim nodes of contact faces, and on nodes opposite, what no support exerts. */
template <int dim>
void NodalReactions<dim>::find_contact_forces(const std::vector<ContactVector<dim>> &lambda)
{
  DistributedVector sum = space.ghosted_vector();
  std::vector<types::global_dof_index> dofs;
  for (const ContactDofFace<dim> &face : space.faces)
  {
    const BoxTables<dim> &tables = space.tables.take_dofs(face.cell, dofs);
    const CellMap<dim> map = map_of<dim>(face.cell);
    const types::boundary_id boundary = face.cell->face(face.face)->boundary_id();
    const auto add = [&](const FullMatrix<double> &moments, const std::vector<unsigned int> &shapes)
    {
      const Vector<double> on_curved =
          face.is_curved() ? forces_on_curved(space, face, moments, lambda) : Vector<double>();
      for (unsigned int j = 0; j < shapes.size(); ++j)
      {
        Tensor<1, dim> force;
        for (unsigned int c = 0; c < dim && face.is_curved(); ++c)
          force[c] = -on_curved[c * shapes.size() + j];
        for (unsigned int k = 0; k < tables.n_contact_dofs() && !face.is_curved(); ++k)
          force -= moments(k, j) * force_at(space, face, k, lambda);
        for (const unsigned int axis : face.components())
          sum(dofs[tables.numbers[shapes[j]][axis]]) += force[axis];
        const unsigned int node = tables.numbers[shapes[j]][0];
        contact_forces.push_back({boundary, force, map.point(tables.fe.unit_support_point(node)),
                                  body_of_boundary(boundary)});
      }
    };
    add(space.contact_dofs_on(face).M, tables.inner[face.face]);
    add(space.contact_dofs_on(face).W, tables.rim[face.face]);
  }
  sum.compress(VectorOperation::add);
  if (space.opposite)
    add_forces_opposite(lambda, sum);
  reactions -= sum;
}

/** `G_k lambda_k R_kd` on the masters. */
template <int dim>
void NodalReactions<dim>::add_forces_opposite(const std::vector<ContactVector<dim>> &lambda,
                                              DistributedVector &sum)
{
  const OppositeFaces &opposite = *space.opposite;
  std::vector<double> far(opposite.nodal().size());
  if constexpr (dim == 3)
    for (unsigned int number = 0; number < space.faces.size(); ++number)
    {
      const ContactDofFace<dim> &face = space.faces[number];
      const auto &pair = space.condition(face.cell, face.face).pair;
      if (!pair)
        continue;
      const auto &parts = space.scene.pairs[*pair].parts;
      const types::boundary_id master =
          parts[parts[0] == face.cell->face(face.face)->boundary_id() ? 1 : 0];
      for (const OppositeFaces::Row &row : opposite[number].rows)
      {
        Tensor<1, dim> force;
        const unsigned int n = space.tables.of(face.cell).n_contact_dofs();
        for (unsigned int k = 0; k < n; ++k)
        {
          const Tensor<1, dim> own = force_at(space, face, k, lambda);
          if (!face.is_curved())
            force += row.moments[k] * own;
          for (unsigned int d = 0; d < dim && face.is_curved(); ++d)
            force += own * face.direction(d, k) * row.turned[d * n + k];
        }
        for (const unsigned int axis : face.components())
          far[opposite.nodal_place(row.node, axis)] += force[axis];
        contact_forces.push_back(
            {master, force, opposite.nodes[row.node].x, body_of_boundary(master)});
      }
    }
  opposite.nodal().add(far, sum.begin());
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
  std::vector<types::global_dof_index> dofs;
  for (const Cell &cell : space.dof_handler.active_cell_iterators())
  {
    if (cell->is_artificial())
      continue;
    const FESystem<dim> &fe = space.tables.take_dofs(cell, dofs).fe;
    const CellMap<dim> map = map_of<dim>(cell);
    const unsigned int body = body_of<dim>(space.scene.geometry, cell);
    for (unsigned int i = 0; i < dofs.size(); ++i)
    {
      if (!space.owned.is_element(dofs[i]))
        continue;
      Node &node = nodes[space.owned.index_within_set(dofs[i])];
      node.x = map.point(fe.unit_support_point(i));
      node.body = body;
      node.component = fe.system_to_component_index(i).first;
    }
  }
}

/** What springs exert, which are a part of a(u, v_i) and no reaction there. */
template <int dim>
void add_springs(const PrimalSpace<dim> &space, const DistributedVector &u,
                 std::vector<typename NodalForces<dim>::Reaction> &reactions)
{
  const ElasticFoundation<dim> foundation(space.scene, space.tables);
  for (const auto &cell : space.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned() && foundation.holds(cell))
    {
      const BoxTables<dim> &tables = space.tables.of(cell);
      const CellMap<dim> map = map_of<dim>(cell);
      for (const SpringsOfFace<dim> &springs : foundation.below(cell))
      {
        const std::vector<Tensor<1, dim>> forces = springs.forces(space.field(cell, u));
        for (unsigned int i = 0; i < forces.size(); ++i)
        {
          const unsigned int node = tables.numbers[springs.shapes[i]][0];
          reactions.push_back({springs.boundary, -forces[i],
                               map.point(tables.fe.unit_support_point(node)),
                               body_of<dim>(space.scene.geometry, cell), true});
        }
      }
    }
}

/** By the rule of the path, face by face. */
template <int dim>
std::vector<typename NodalForces<dim>::Traction> tractions(const PrimalSpace<dim> &space)
{
  const Point<dim> centre = space.scene.geometry.centre();
  std::vector<typename NodalForces<dim>::Traction> result;
  for (const auto &cell : space.dof_handler.active_cell_iterators())
    for (const unsigned int face : cell->face_indices())
      if (cell->is_locally_owned() && cell->at_boundary(face) &&
          space.condition(cell, face).has_traction())
      {
        const BoundaryCondition<dim> &condition = space.condition(cell, face);
        const CellMap<dim> map = map_of<dim>(cell);
        const QGauss<dim - 1> rule(space.tables.of(cell).degree + 1);
        Tensor<1, dim> force;
        Moment<dim> moment{};
        for (unsigned int q = 0; q < rule.size(); ++q)
        {
          const Point<dim> s = point_on_face<dim>(face, rule.point(q)), x = map.point(s);
          const Tensor<1, dim> part =
              rule.weight(q) * map.face_measure(face, s) * load_at<dim>(condition.traction, x);
          force += part;
          moment += moment_of(x - centre, part);
        }
        result.push_back({condition.id, force, moment});
      }
  return result;
}

/** Where several boundaries hold a node they share the reaction. */
template <int dim>
void NodalReactions<dim>::add_supports(NodalForces<dim> &result) const
{
  for (const SupportedNode<dim> &supported :
       supported_nodes(space.scene, space.dof_handler, space.tables))
  {
    if (!space.owned.is_element(supported.dofs[0]))
      continue;
    Tensor<1, dim> force;
    for (unsigned int c = 0; c < dim; ++c)
      force[c] = reactions.local_element(space.owned.index_within_set(supported.dofs[c]));
    const Node &node = nodes[space.owned.index_within_set(supported.dofs[0])];
    const std::vector<double> shares = supported.split(force);
    for (unsigned int k = 0; k < shares.size(); ++k)
      result.reactions.push_back({supported.conditions[k].boundary,
                                  shares[k] * supported.conditions[k].direction, node.x,
                                  node.body});
  }
}

PlateState<3> state_of(const PlateOnMesh<3> &plate, const DistributedVector &u)
{
  const auto q = plate.amounts(u);
  return {plate.boundary, plate.motion.centre(), Tensor<1, 3>({q[0], q[1], q[2]}),
          Tensor<1, 3>({q[3], q[4], q[5]})};
}

PlateState<2> state_of(const PlateOnMesh<2> &plate, const DistributedVector &u)
{
  const auto q = plate.amounts(u);
  return {plate.boundary, plate.motion.centre(), Tensor<1, 2>({q[0], q[1]}), q[2]};
}

template <int dim>
NodalForces<dim> NodalReactions<dim>::forces() const
{
  NodalForces<dim> result;
  for (unsigned int i = 0; i < nodes.size(); ++i)
  {
    const Node &node = nodes[i];
    if (const double load = loads.local_element(i); load != 0)
      result.loads.push_back({node.component, load, node.x, node.body});
  }
  result.reactions.insert(result.reactions.end(), contact_forces.begin(), contact_forces.end());
  for (const PlateOnMesh<dim> &plate : space.plates)
    result.plates.push_back(state_of(plate, u));
  collectively(space.communicator(),
               [&]()
               {
                 add_supports(result);
                 result.tractions = tractions(space);
                 add_springs(space, u, result.reactions);
               });
  return result;
}
} // namespace

template <int dim>
NodalForces<dim> nodal_forces(const PrimalSpace<dim> &space, const PrimalSystem<dim> &system,
                              const DistributedVector &u,
                              const std::vector<ContactVector<dim>> &lambda)
{
  return NodalReactions<dim>(space, system, u, lambda).forces();
}

template NodalForces<2> nodal_forces(const PrimalSpace<2> &, const PrimalSystem<2> &,
                                     const DistributedVector &,
                                     const std::vector<ContactVector<2>> &);
template NodalForces<3> nodal_forces(const PrimalSpace<3> &, const PrimalSystem<3> &,
                                     const DistributedVector &,
                                     const std::vector<ContactVector<3>> &);
} // namespace hpvi
