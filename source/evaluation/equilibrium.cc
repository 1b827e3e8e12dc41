// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/body/edge_constraints.h>
#include <hpvi/body/supports.h>
#include <hpvi/discretisation/internal_forces.h>
#include <hpvi/evaluation/equilibrium.h>
#include <hpvi/scene/data_scale.h>

#include <cmath>
#include <numeric>

namespace hpvi
{
using namespace dealii;

namespace
{
double moment_of(const Tensor<1, 2> &arm, const Tensor<1, 2> &force)
{
  return arm[0] * force[1] - arm[1] * force[0];
}

Tensor<1, 3> moment_of(const Tensor<1, 3> &arm, const Tensor<1, 3> &force)
{
  return cross_product_3d(arm, force);
}

double size_of(const double moment)
{
  return std::abs(moment);
}

double size_of(const Tensor<1, 3> &moment)
{
  return moment.norm();
}

/** The numbers of a vector, or the one that it is. */
template <class Numbers>
void replace_all(Numbers &numbers, const std::function<double(double)> &total)
{
  if constexpr (std::is_same_v<Numbers, double>)
    numbers = total(numbers);
  else
    for (unsigned int d = 0; d < Numbers::dimension; ++d)
      numbers[d] = total(numbers[d]);
}
} // namespace

template <int dim>
Resultants<dim>::Resultants(const Scene<dim> &scene, const Point<dim> &centre) : scene(scene)
{
  result.centre = centre;
  result.loads.boundary = "loads";
  for (const BoundaryCondition<dim> &boundary : scene.boundaries)
    result.reactions.push_back({boundary.name, {}, {}});
}

template <int dim>
void Resultants<dim>::add(BoundaryForce<dim> &sum, const Tensor<1, dim> &force, const Point<dim> &x)
{
  const Tensor<1, dim> arm = x - result.centre;
  sum.force += force;
  sum.moment += moment_of(arm, force);
  absolute_force += force.norm();
  absolute_moment += arm.norm() * force.norm();
}

template <int dim>
void Resultants<dim>::add_load(const unsigned int component, const double value,
                               const Point<dim> &x)
{
  Tensor<1, dim> force;
  force[component] = value;
  add(result.loads, force, x);
}

template <int dim>
void Resultants<dim>::add_reaction(const types::boundary_id boundary, const Tensor<1, dim> &force,
                                   const Point<dim> &x)
{
  add(result.reactions[boundary], force, x);
}

template <int dim>
void Resultants<dim>::replace(const std::function<double(double)> &total)
{
  std::vector<BoundaryForce<dim> *> sums{&result.loads};
  for (BoundaryForce<dim> &reaction : result.reactions)
    sums.push_back(&reaction);
  for (BoundaryForce<dim> *const sum : sums)
  {
    replace_all(sum->force, total);
    replace_all(sum->moment, total);
  }
  absolute_force = total(absolute_force);
  absolute_moment = total(absolute_moment);
}

template <int dim>
Equilibrium<dim> Resultants<dim>::finish()
{
  Tensor<1, dim> force = result.loads.force;
  Moment<dim> moment = result.loads.moment;
  std::vector<BoundaryForce<dim>> supporting;
  for (const BoundaryCondition<dim> &boundary : scene.boundaries)
  {
    const BoundaryForce<dim> &reaction = result.reactions[boundary.id];
    force += reaction.force;
    moment += reaction.moment;
    if (boundary.has_displacement() || boundary.has_contact())
      supporting.push_back(reaction);
  }
  result.reactions = supporting;
  const Corners<dim> &corners = scene.geometry.corners;
  const double size = corners.front().distance(corners.back()),
               none = round_off_of_data * data_scale(scene).stress * std::pow(size, dim - 1);
  result.force_imbalance = absolute_force > none ? force.norm() / absolute_force : 0.;
  result.moment_imbalance = absolute_moment > none * size ? size_of(moment) / absolute_moment : 0.;
  return result;
}

namespace
{
/** Where every displacement unknown has its node, and which component it is. */
template <int dim>
struct Nodes
{
  std::vector<Point<dim>> x;
  std::vector<unsigned int> component;

  explicit Nodes(const DisplacementSpace<dim> &space) : x(space.n_dofs()), component(space.n_dofs())
  {
    for (const auto &cell : space.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
      {
        const CellMap<dim> map = map_of<dim>(cell);
        const auto dofs = space.cell_dofs(cell->active_cell_index());
        const auto &support_points = cell->get_fe().get_unit_support_points();
        for (unsigned int i = 0; i < dofs.size(); ++i)
        {
          x[dofs[i]] = map.point(support_points[i]);
          component[dofs[i]] = cell->get_fe().system_to_component_index(i).first;
        }
      }
  }
};

/** Forces on hanging nodes act on the nodes that these depend on. */
void carry_to_masters(const AffineConstraints<double> &hanging, Vector<double> &forces)
{
  for (types::global_dof_index dof = 0; dof < forces.size(); ++dof)
    if (const auto *entries = hanging.get_constraint_entries(dof))
    {
      for (const auto &[master, weight] : *entries)
        forces[master] += weight * forces[dof];
      forces[dof] = 0.;
    }
}
/** `a(u_N, v_i) + b(v_i, z_N) - L(v_i)`: what supports do, on nodes that do not hang. */
template <int dim>
Vector<double> support_reactions(const Solution<dim> &solution, const Vector<double> &loads)
{
  const DisplacementSpace<dim> &space = solution.displacement_space;
  const ShapeTables<dim> &tables = solution.tables;
  Vector<double> reactions = internal_forces(solution.scene, space, tables, solution.u).forces;
  reactions -= loads;
  for (const BoundaryCondition<dim> &boundary : solution.scene.boundaries)
    if (boundary.has_contact() && solution.z.size() > 0)
      reactions += solution.spaces->contact_operator.forces(solution.z, boundary.id);
  AffineConstraints<double> hanging;
  constrain_hanging_nodes(space.numbering(), tables, hanging);
  hanging.close();
  carry_to_masters(hanging, reactions);
  return reactions;
}
} // namespace

template <int dim>
ReactionWork reaction_work(const Solution<dim> &solution, const Vector<double> &loads,
                           const Vector<double> &v)
{
  const Vector<double> reactions = support_reactions(solution, loads);
  ReactionWork work;
  for (const SupportedNode<dim> &node :
       supported_nodes(solution.scene, solution.displacement_space.numbering(), solution.tables))
  {
    Tensor<1, dim> force, at_node;
    for (unsigned int c = 0; c < dim; ++c)
    {
      force[c] = reactions[node.dofs[c]];
      at_node[c] = v[node.dofs[c]];
    }
    const std::vector<double> shares = node.split(force); // of what supports can exert there
    for (unsigned int k = 0; k < shares.size(); ++k)
      work.supports += shares[k] * (node.conditions[k].direction * at_node);
  }
  work.elsewhere =
      std::inner_product(reactions.begin(), reactions.end(), v.begin(), -work.supports);
  return work;
}

template <int dim>
Equilibrium<dim> equilibrium(const Solution<dim> &solution, const ElasticSystem<dim> &system)
{
  const DisplacementSpace<dim> &space = solution.displacement_space;
  const ShapeTables<dim> &tables = solution.tables;
  const Nodes<dim> nodes(space);
  Resultants<dim> resultants(solution.scene, centre_of(solution.scene.geometry));
  for (types::global_dof_index dof = 0; dof < space.n_dofs(); ++dof)
    if (system.loads()[dof] != 0.)
      resultants.add_load(nodes.component[dof], system.loads()[dof], nodes.x[dof]);

  for (const BoundaryCondition<dim> &boundary : solution.scene.boundaries)
    if (boundary.has_contact() && solution.z.size() > 0)
    {
      const Vector<double> friction =
          solution.spaces->contact_operator.forces(solution.z, boundary.id);
      for (types::global_dof_index dof = 0; dof < space.n_dofs(); ++dof)
        if (friction[dof] != 0.)
        {
          Tensor<1, dim> force;
          force[nodes.component[dof]] = -friction[dof];
          resultants.add_reaction(boundary.id, force, nodes.x[dof]);
        }
    }

  const Vector<double> reactions = support_reactions(solution, system.loads());
  for (const SupportedNode<dim> &node : supported_nodes(solution.scene, space.numbering(), tables))
  {
    Tensor<1, dim> force;
    for (unsigned int c = 0; c < dim; ++c)
      force[c] = reactions[node.dofs[c]];
    const std::vector<double> shares = node.split(force);
    for (unsigned int k = 0; k < shares.size(); ++k)
      resultants.add_reaction(node.conditions[k].boundary, shares[k] * node.conditions[k].direction,
                              node.x);
  }
  return resultants.finish();
}

template class Resultants<2>;
template class Resultants<3>;
template Equilibrium<2> equilibrium(const Solution<2> &, const ElasticSystem<2> &);
template ReactionWork reaction_work(const Solution<2> &, const Vector<double> &,
                                    const Vector<double> &);
} // namespace hpvi
