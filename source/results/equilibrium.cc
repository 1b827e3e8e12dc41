// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/mpi.h>
#include <hpvi/base/processes.h>
#include <hpvi/base/thread_pool.h>
#include <hpvi/plane/edge_constraints.h>
#include <hpvi/plane/internal_forces.h>
#include <hpvi/plane/mesh.h>
#include <hpvi/plane/plates.h>
#include <hpvi/plane/springs.h>
#include <hpvi/results/equilibrium.h>
#include <hpvi/results/field.h>
#include <hpvi/scene/data_scale.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

namespace hpvi
{
using namespace dealii;

namespace
{
/** The sum over all processes of each number of a vector, or of the one that it is. */
template <class Numbers>
Numbers total(Numbers numbers, MPI_Comm communicator)
{
  if constexpr (std::is_same_v<Numbers, double>)
    return Utilities::MPI::sum(numbers, communicator);
  else
    for (unsigned int d = 0; d < Numbers::dimension; ++d)
      numbers[d] = Utilities::MPI::sum(numbers[d], communicator);
  return numbers;
}

/** Adds up forces by boundary, and their absolute values. */
template <int dim>
struct Resultants
{
  const Point<dim> centre;
  const bool is_axisymmetric; ///< what is radial balances itself, and turns nothing
  BoundaryForce<dim> loads{"loads", {}, {}};
  std::vector<BoundaryForce<dim>> reactions; ///< by boundary id
  double absolute_force = 0, absolute_moment = 0;

  struct OfBody
  {
    BoundaryForce<dim> sum{};
    double absolute_force = 0, absolute_moment = 0;
  };
  std::vector<OfBody> bodies; ///< where there are several

  explicit Resultants(const Scene<dim> &scene)
      : centre(scene.geometry.centre()), is_axisymmetric(scene.is_axisymmetric()),
        bodies(scene.geometry.bodies.size())
  {
    for (const BoundaryCondition<dim> &boundary : scene.boundaries)
      reactions.push_back({boundary.name, {}, {}, boundary.id});
  }

  void add(BoundaryForce<dim> &sum, Tensor<1, dim> force, const Point<dim> &x,
           const unsigned int body)
  {
    Tensor<1, dim> arm = x - centre;
    if (is_axisymmetric)
    {
      force[0] = 0;
      arm = 0;
    }
    sum.force += force;
    sum.moment += moment_of(arm, force);
    absolute_force += force.norm();
    absolute_moment += arm.norm() * force.norm();
    if (body >= bodies.size())
      return;
    OfBody &own = bodies[body];
    own.sum.force += force;
    own.sum.moment += moment_of(arm, force);
    own.absolute_force += force.norm();
    own.absolute_moment += arm.norm() * force.norm();
  }

  void sum_up(MPI_Comm communicator)
  {
    std::vector<BoundaryForce<dim> *> sums{&loads};
    for (BoundaryForce<dim> &reaction : reactions)
      sums.push_back(&reaction);
    for (BoundaryForce<dim> *const sum : sums)
    {
      sum->force = total(sum->force, communicator);
      sum->moment = total(sum->moment, communicator);
    }
    absolute_force = total(absolute_force, communicator);
    absolute_moment = total(absolute_moment, communicator);
    for (OfBody &body : bodies)
    {
      body.sum.force = total(body.sum.force, communicator);
      body.sum.moment = total(body.sum.moment, communicator);
      body.absolute_force = total(body.absolute_force, communicator);
      body.absolute_moment = total(body.absolute_moment, communicator);
    }
  }
};

/** Without the boundaries that carry nothing. */
template <int dim>
Equilibrium<dim> balance_of(const Resultants<dim> &sums, const Scene<dim> &scene)
{
  Equilibrium<dim> result;
  result.centre = sums.centre;
  result.loads = sums.loads;
  Tensor<1, dim> force = sums.loads.force;
  Moment<dim> moment = sums.loads.moment;
  for (const BoundaryCondition<dim> &boundary : scene.boundaries)
  {
    const BoundaryForce<dim> &reaction = sums.reactions[boundary.id];
    force += reaction.force;
    moment += reaction.moment;
    if (boundary.exerts_forces())
      result.reactions.push_back(reaction);
  }
  const double size = scene.geometry.diameter(),
               none = round_off_of_data * data_scale(scene).stress * std::pow(size, dim - 1);
  result.force_imbalance = sums.absolute_force > none ? force.norm() / sums.absolute_force : 0.;
  result.moment_imbalance =
      sums.absolute_moment > none * size ? size_of(moment) / sums.absolute_moment : 0.;
  for (unsigned int b = 0; b < sums.bodies.size(); ++b)
  {
    const auto &own = sums.bodies[b];
    result.bodies.push_back(
        {scene.geometry.bodies[b].name,
         own.absolute_force > none ? own.sum.force.norm() / own.absolute_force : 0.,
         own.absolute_moment > none * size ? size_of(own.sum.moment) / own.absolute_moment : 0.});
  }
  return result;
}

/** What an axisymmetric body has not is no zero. */
void forget_radial(BoundaryForce<2> &force)
{
  force.force[0] = force.moment = std::numeric_limits<double>::quiet_NaN();
}

/** What is loaded where: tractions boundary by boundary, and of @p loads what they leave, which is the body force. */
template <int dim>
std::vector<BoundaryForce<dim>>
parts_of_loads(const Scene<dim> &scene, const std::vector<typename NodalForces<dim>::Traction> &own,
               const BoundaryForce<dim> &loads, MPI_Comm communicator)
{
  std::vector<BoundaryForce<dim>> result;
  BoundaryForce<dim> rest{"body force", loads.force, loads.moment};
  for (const BoundaryCondition<dim> &boundary : scene.boundaries)
    if (boundary.has_traction())
    {
      BoundaryForce<dim> sum{boundary.name, {}, {}, boundary.id};
      for (const auto &traction : own)
        if (traction.boundary == boundary.id)
        {
          sum.force += traction.force;
          sum.moment += traction.moment;
        }
      sum.force = total(sum.force, communicator);
      sum.moment = total(sum.moment, communicator);
      rest.force -= sum.force;
      rest.moment -= sum.moment;
      result.push_back(sum);
    }
  if (scene.has_body_force())
    result.push_back(rest);
  return result;
}
} // namespace

template <int dim>
Equilibrium<dim> equilibrium(const Scene<dim> &scene, const NodalForces<dim> &forces,
                             MPI_Comm communicator)
{
  Resultants<dim> sums(scene);
  for (const auto &load : forces.loads)
  {
    Tensor<1, dim> force;
    force[load.component] = load.value;
    sums.add(sums.loads, force, load.x, load.body);
  }
  for (const auto &reaction : forces.reactions)
    sums.add(sums.reactions[reaction.boundary], reaction.force, reaction.x, reaction.body);
  sums.sum_up(communicator);
  Equilibrium<dim> result;
  collectively(communicator, [&]() { result = balance_of(sums, scene); });
  result.parts_of_loads = parts_of_loads<dim>(scene, forces.tractions, result.loads, communicator);
  result.plates = forces.plates;
  for (PlateState<dim> &plate : result.plates)
  {
    const BoundaryForce<dim> &reaction = sums.reactions[plate.boundary];
    plate.moment = reaction.moment - moment_of(plate.centre - sums.centre, reaction.force);
  }
  if constexpr (dim == 2)
    if (scene.is_axisymmetric())
    {
      forget_radial(result.loads);
      for (BoundaryForce<dim> &load : result.parts_of_loads)
        forget_radial(load);
      for (BoundaryForce<dim> &reaction : result.reactions)
        forget_radial(reaction);
      for (PlateState<dim> &plate : result.plates)
        plate.moment = result.loads.moment;
    }
  return result;
}

namespace
{
/** Where every displacement unknown has its node, which component it is, and of which body. */
template <int dim>
struct Nodes
{
  std::vector<Point<dim>> x;
  std::vector<unsigned int> component, body;

  Nodes(const DisplacementSpace<dim> &space, const Geometry<dim> &geometry)
      : x(space.n_dofs()), component(space.n_dofs()), body(space.n_dofs())
  {
    for (const auto &cell : space.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
      {
        const CellMap<dim> map = map_of<dim>(cell);
        const auto dofs = space.cell_dofs(cell->active_cell_index());
        const unsigned int number = geometry.bodies.empty() ? 0 : body_of<dim>(geometry, cell);
        const auto &support_points = cell->get_fe().get_unit_support_points();
        for (unsigned int i = 0; i < dofs.size(); ++i)
        {
          x[dofs[i]] = map.point(support_points[i]);
          component[dofs[i]] = cell->get_fe().system_to_component_index(i).first;
          body[dofs[i]] = number;
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
/** What balances at nodes: forces of the strained body, and how hanging nodes depend on others. */
struct Balance
{
  Vector<double> internal;
  AffineConstraints<double> hanging;

  /** @p beside: what may be done meanwhile. */
  template <int dim>
  explicit Balance(
      const Solution<dim> &of, const std::function<void()> &beside = []() {})
  {
    const DisplacementSpace<dim> &space = of.displacement_space;
    const auto part = [&](const unsigned int k)
    {
      if (k == 0)
      {
        constrain_hanging_nodes(space.numbering(), of.tables, hanging);
        hanging.close();
      }
      else if (k == 1)
        internal = internal_forces(of.scene, space, of.tables, of.u).forces;
      else
        beside();
    };
    parallel_for_each(3, 1, part);
  }
};

/** `a(u_N, v_i) + b(v_i, z_N) - L(v_i)`: what supports do, on nodes that do not hang. */
template <int dim>
Vector<double> support_reactions(const Solution<dim> &solution, const Vector<double> &loads,
                                 const Balance &balance)
{
  Vector<double> reactions = balance.internal;
  reactions -= loads;
  for (const BoundaryCondition<dim> &boundary : solution.scene.boundaries)
    if (boundary.has_contact() && solution.z.size() > 0)
      reactions += solution.spaces->contact_operator.forces(solution.z, boundary.id);
  carry_to_masters(balance.hanging, reactions);
  return reactions;
}
} // namespace

template <int dim>
ReactionWork reaction_work(const Solution<dim> &solution, const Vector<double> &loads,
                           const Vector<double> &v)
{
  const Vector<double> reactions = support_reactions(solution, loads, Balance(solution));
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
NodalForces<dim> nodal_forces(const Solution<dim> &solution, const ElasticSystem<dim> &system)
{
  const DisplacementSpace<dim> &space = solution.displacement_space;
  const ShapeTables<dim> &tables = solution.tables;
  std::optional<Nodes<dim>> all_nodes;
  std::vector<SupportedNode<dim>> supported;
  const Balance balance(solution,
                        [&]()
                        {
                          all_nodes.emplace(space, solution.scene.geometry);
                          supported = supported_nodes(solution.scene, space.numbering(), tables);
                        });
  const Nodes<dim> &nodes = *all_nodes;
  NodalForces<dim> result;
  // What presses a plate is the force that the plate exerts, and initial strains balance themselves.
  Vector<double> loads = system.loads(), reacting(loads);
  if (solution.scene.has_plates())
    reacting -= plate_loads(solution.scene, space, tables);
  loads = reacting;
  if (solution.scene.has_initial_strain())
    loads -= system.strain_loads();
  for (types::global_dof_index dof = 0; dof < space.n_dofs(); ++dof)
    if (loads[dof] != 0.)
      result.loads.push_back({nodes.component[dof], loads[dof], nodes.x[dof], nodes.body[dof]});

  for (const auto &[boundary, sum] : solution.spaces->loads->sums_by_boundary(space.dof_handler()))
    result.tractions.push_back({boundary, sum.force, sum.moment});

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
          result.reactions.push_back({boundary.id, force, nodes.x[dof], nodes.body[dof]});
        }
    }

  const std::vector<SpringFace> springs = spring_faces(solution.scene, space, tables);
  for (const BoundaryCondition<dim> &boundary : solution.scene.boundaries)
    if (boundary.spring)
    {
      Vector<double> forces(space.n_dofs());
      add_spring_forces(springs, solution.u, forces, boundary.id);
      for (types::global_dof_index dof = 0; dof < space.n_dofs(); ++dof)
        if (forces[dof] != 0.)
        {
          Tensor<1, dim> force;
          force[nodes.component[dof]] = -forces[dof];
          result.reactions.push_back({boundary.id, force, nodes.x[dof], nodes.body[dof]});
        }
    }

  const Vector<double> reactions = support_reactions(solution, reacting, balance);
  for (const Plate &plate : plates_of(solution.scene, supported))
  {
    const auto q = plate.amounts(solution.u);
    result.plates.push_back(
        {plate.boundary(), plate.motion().centre(), Tensor<1, dim>({q[0], q[1]}), q[2]});
  }
  for (const SupportedNode<dim> &node : supported)
  {
    Tensor<1, dim> force;
    for (unsigned int c = 0; c < dim; ++c)
      force[c] = reactions[node.dofs[c]];
    const std::vector<double> shares = node.split(force);
    for (unsigned int k = 0; k < shares.size(); ++k)
      result.reactions.push_back({node.conditions[k].boundary,
                                  shares[k] * node.conditions[k].direction, node.x,
                                  nodes.body[node.dofs[0]]});
  }
  return result;
}

template Equilibrium<2> equilibrium(const Scene<2> &, const NodalForces<2> &, MPI_Comm);
template Equilibrium<3> equilibrium(const Scene<3> &, const NodalForces<3> &, MPI_Comm);
template NodalForces<2> nodal_forces(const Solution<2> &, const ElasticSystem<2> &);
template ReactionWork reaction_work(const Solution<2> &, const Vector<double> &,
                                    const Vector<double> &);
} // namespace hpvi
