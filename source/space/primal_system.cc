// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/space/cell_basis.h>
#include <hpvi/space/primal_system.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/lac/sparsity_tools.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Adds the integrals of @p load against the shape functions of @p table, `measure(x)` being dx over that of the reference. */
template <int dim, class Measure>
void integrate(const Load<dim> &load, const BoxTable<dim> &table, const CellMap<dim> &map,
               const Measure &measure, CellField<dim> &result)
{
  double ds = 0;
  for (unsigned int q = 0; q < table.points.size(); ++q)
  {
    const Point<dim> x = map.point(table.points[q]);
    if (q == 0 || !map.is_affine())
      ds = measure(table.points[q]);
    for (unsigned int c = 0; c < dim; ++c)
      if (load[c])
      {
        const double weighted = table.weights[q] * ds * load[c]->value(x);
        for (unsigned int i = 0; i < result.size(); ++i)
          result[i][c] += weighted * table.values(q, i);
      }
  }
}
} // namespace

template <int dim>
PrimalSystem<dim>::PrimalSystem(const PrimalSpace<dim> &space)
    : f(space.ghosted_vector()), space(space), stiffness(space)
{
  if (space.scene.has_initial_strain())
    strains = std::make_unique<const StrainLoads<dim>>(space.scene, space, 1);
  std::vector<double> far; // what acts on nodes opposite
  if (space.opposite)
  {
    far.resize(space.opposite->unknowns().size());
    lifted = std::make_unique<DistributedVector>(space.displacement(space.owned_vector()));
  }
  collectively(space.communicator(), [&]() { assemble_loads(far); });
  lifted.reset();
  f.compress(VectorOperation::add);
  if (space.opposite)
    space.opposite->unknowns().add(far, f.begin());
  DistributedVector owned_part = space.owned_vector();
  owned_part.copy_locally_owned_data_from(f);
  f.swap(owned_part);
  add_plate_loads();
}

/** Forces and moments act on the masters, each on the process that has it. */
template <int dim>
void PrimalSystem<dim>::add_plate_loads()
{
  for (const PlateOnMesh<dim> &plate : space.plates)
  {
    const auto &force = space.scene.boundaries[plate.boundary].plate->force;
    const PlateMasters<dim> &by = plate.masters;
    for (unsigned int i = 0; i < by.masters.size(); ++i)
      for (unsigned int k = 0; k < by.motions.size(); ++k)
        if (space.owned.is_element(by.masters[i].dof))
          f(by.masters[i].dof) += force[by.motions[k]] * by.share(k, i);
  }
}

/** Of a cell of a slave: what is left of its loads under u_0, which prescribed displacements alone make. */
template <int dim>
void PrimalSystem<dim>::assemble_with_opposite(const Cell &cell, std::vector<double> &far)
{
  if constexpr (dim == 3)
  {
    const BoxTables<dim> &tables = space.tables.of(cell);
    const unsigned int n = tables.fe.dofs_per_cell;
    Vector<double> u(n), internal(n);
    cell->get_dof_values(*lifted, u);
    stiffness.multiply(cell, internal, u);
    const CellField<dim> loads = load(cell);
    for (unsigned int i = 0; i < loads.size(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        internal[tables.numbers[i][c]] -= loads[i][c];
    const CellBasis basis = cell_basis(space, cell);
    for (unsigned int j = 0; j < basis.unknowns.size(); ++j)
    {
      double sum = 0;
      for (const auto &[i, weight] : basis.columns[j])
        sum -= weight * internal[i];
      if (const auto unknown = basis.unknowns[j]; space.relevant.is_element(unknown))
        f(unknown) += sum;
      else
        far[space.opposite->unknowns().place(unknown)] += sum;
    }
  }
}

/** With what prescribed displacements do to the unknowns beside them. */
template <int dim>
void PrimalSystem<dim>::assemble_loads(std::vector<double> &far)
{
  std::vector<types::global_dof_index> dofs;
  for (const Cell &cell : space.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      if (is_slave_cell(cell))
      {
        assemble_with_opposite(cell, far);
        continue;
      }
      const BoxTables<dim> &tables = space.tables.take_dofs(cell, dofs);
      const CellField<dim> loads = load(cell);
      Vector<double> nodal(dofs.size()), F(dofs.size());
      for (unsigned int i = 0; i < loads.size(); ++i)
        for (unsigned int c = 0; c < dim; ++c)
          nodal[tables.numbers[i][c]] = loads[i][c];
      if (any(space.moment_components(cell)))
        basis_of_moments(space, cell).Tvmult(F, nodal);
      else
        F = nodal;
      const bool needs_matrix = std::any_of(
          dofs.begin(), dofs.end(),
          [this](const auto dof) { return space.constraints.is_inhomogeneously_constrained(dof); });
      needs_matrix ? space.constraints.distribute_local_to_global(F, dofs, f, stiffness(cell))
                   : space.constraints.distribute_local_to_global(F, dofs, f);
    }
}

template <int dim>
bool PrimalSystem<dim>::is_slave_cell(const Cell &cell) const
{
  if constexpr (dim == 3)
    return has_opposite(space, cell);
  else
    return false;
}

/** Where bodies touch with rows of what is opposite, and the entries of cells of slaves; @p rows are those that it has. */
template <int dim>
DynamicSparsityPattern PrimalSystem<dim>::sparsity(IndexSet &rows) const
{
  rows = space.relevant;
  if (space.opposite)
    for (const OppositeNode &node : space.opposite->nodes)
      for (const auto &component : node.entries)
        for (const auto &entry : component)
          rows.add_index(entry.first);
  rows.compress();
  DynamicSparsityPattern pattern(rows);
  DoFTools::make_sparsity_pattern(space.dof_handler, pattern, space.constraints, false);
  if constexpr (dim == 3)
    for (const Cell &cell : space.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() && has_opposite(space, cell))
      {
        const std::vector<types::global_dof_index> unknowns = cell_basis(space, cell).unknowns;
        for (const auto row : unknowns)
          pattern.add_entries(row, unknowns.begin(), unknowns.end(), /*indices_are_sorted=*/true);
      }
  return pattern;
}

/** The entries of a cell of a slave, and of what it has prescribed those on the diagonal. */
template <int dim>
void PrimalSystem<dim>::add_with_opposite(const Cell &cell)
{
  if constexpr (dim == 3)
  {
    const FullMatrix<double> &K = stiffness.nodal(cell);
    const CellBasis basis = cell_basis(space, cell);
    A.add(basis.unknowns, basis.transformed(K));
    std::vector<types::global_dof_index> dofs;
    space.tables.take_dofs(cell, dofs);
    for (unsigned int i = 0; i < dofs.size(); ++i)
      if (space.constraints.is_constrained(dofs[i]))
        A.add(dofs[i], dofs[i], K(i, i));
  }
}

template <int dim>
TrilinosWrappers::SparseMatrix &PrimalSystem<dim>::matrix()
{
  if (A.m() > 0)
    return A;
  {
    IndexSet rows;
    DynamicSparsityPattern pattern = sparsity(rows);
    SparsityTools::distribute_sparsity_pattern(pattern, space.owned, space.communicator(), rows);
    A.reinit(space.owned, space.owned, pattern, space.communicator());
  }
  std::vector<types::global_dof_index> dofs;
  for (const Cell &cell : space.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned() && is_slave_cell(cell))
      add_with_opposite(cell);
    else if (cell->is_locally_owned())
    {
      space.tables.take_dofs(cell, dofs);
      space.constraints.distribute_local_to_global(stiffness(cell), dofs, A);
    }
  A.compress(VectorOperation::add);
  return A;
}

template <int dim>
CellField<dim> PrimalSystem<dim>::body_load(const Cell &cell) const
{
  CellField<dim> result(space.tables.of(cell).n_shapes);
  if (space.scene.has_body_force())
  {
    const CellMap<dim> map = map_of<dim>(cell);
    integrate<dim>(
        space.scene.body_force_in(cell), space.tables.of(cell).cell, map,
        [&](const Point<dim> &x) { return std::abs(determinant(map.jacobian(x))); }, result);
  }
  return result;
}

template <int dim>
CellField<dim> PrimalSystem<dim>::side_load(const Cell &cell, const unsigned int face) const
{
  CellField<dim> result(space.tables.of(cell).n_shapes);
  if (cell->at_boundary(face) && space.condition(cell, face).has_traction())
  {
    const CellMap<dim> map = map_of<dim>(cell);
    integrate<dim>(
        space.condition(cell, face).traction, space.tables.of(cell).faces[face], map,
        [&](const Point<dim> &x) { return map.face_measure(face, x); }, result);
  }
  return result;
}

template <int dim>
CellField<dim> PrimalSystem<dim>::load(const Cell &cell) const
{
  CellField<dim> result = body_load(cell);
  const auto add = [&](const CellField<dim> &more)
  {
    for (unsigned int i = 0; i < more.size(); ++i)
      result[i] += more[i];
  };
  if (strains)
    add(strains->load(cell));
  for (const unsigned int face : cell->face_indices())
    if (cell->at_boundary(face))
      add(side_load(cell, face));
  return result;
}

template <int dim>
double PrimalSystem<dim>::energy_product(const DistributedVector &u) const
{
  double sum = 0;
  for (const Cell &cell : space.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const unsigned int n = space.tables.of(cell).fe.dofs_per_cell;
      Vector<double> local(n), internal(n);
      cell->get_dof_values(u, local);
      stiffness.multiply(cell, internal, local);
      sum += internal * local;
    }
  return Utilities::MPI::sum(sum, space.communicator());
}

template <int dim>
double PrimalSystem<dim>::work(const DistributedVector &u) const
{
  const auto of_cells = [&]()
  {
    double sum = 0;
    for (const Cell &cell : space.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() &&
          (space.scene.has_body_force() || strains || cell->at_boundary()))
        sum += product<dim>(load(cell), space.field(cell, u));
    return sum;
  };
  return sum_collectively(space.communicator(), of_cells) +
         plate_work(space.scene, space.plates, u);
}

template <int dim>
typename PrimalSystem<dim>::NodalForces
PrimalSystem<dim>::nodal_forces(const DistributedVector &u) const
{
  NodalForces forces{space.ghosted_vector(), space.ghosted_vector()};
  collectively(space.communicator(), [&]() { add_nodal_forces(u, forces); });
  for (DistributedVector *const vector : {&forces.internal, &forces.loads})
  {
    vector->compress(VectorOperation::add);
    vector->update_ghost_values();
  }
  return forces;
}

template <int dim>
DistributedVector PrimalSystem<dim>::strain_loads() const
{
  DistributedVector result = space.ghosted_vector();
  std::vector<types::global_dof_index> dofs;
  collectively(space.communicator(),
               [&]()
               {
                 for (const Cell &cell : space.dof_handler.active_cell_iterators())
                   if (cell->is_locally_owned() && strains)
                   {
                     const BoxTables<dim> &tables = space.tables.take_dofs(cell, dofs);
                     const CellField<dim> loads = strains->load(cell);
                     for (unsigned int i = 0; i < loads.size(); ++i)
                       for (unsigned int c = 0; c < dim; ++c)
                         result(dofs[tables.numbers[i][c]]) += loads[i][c];
                   }
               });
  result.compress(VectorOperation::add);
  result.update_ghost_values();
  return result;
}

template <int dim>
Tensor<2, dim> PrimalSystem<dim>::initial_stress() const
{
  return strains ? strains->stress() : Tensor<2, dim>();
}

template <int dim>
Tensor<1, 2> PrimalSystem<dim>::spring_stiffness() const
{
  Tensor<1, 2> sum;
  if (!space.scene.has_springs())
    return sum;
  const ElasticFoundation<dim> foundation(space.scene, space.tables);
  collectively(space.communicator(),
               [&]()
               {
                 for (const Cell &cell : space.dof_handler.active_cell_iterators())
                   if (cell->is_locally_owned() && foundation.holds(cell))
                     for (const SpringsOfFace<dim> &springs : foundation.below(cell))
                       sum += springs.sums;
               });
  for (unsigned int k = 0; k < 2; ++k)
    sum[k] = Utilities::MPI::sum(sum[k], space.communicator());
  return sum;
}

template <int dim>
double PrimalSystem<dim>::initial_energy(const DistributedVector &u) const
{
  return strains ? strains->energy(u) : 0.;
}

/** Of the cells of this process. */
template <int dim>
void PrimalSystem<dim>::add_nodal_forces(const DistributedVector &u, NodalForces &forces) const
{
  std::vector<types::global_dof_index> dofs;
  for (const Cell &cell : space.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const FESystem<dim> &fe = space.tables.take_dofs(cell, dofs).fe;
      Vector<double> local(dofs.size()), internal(dofs.size());
      cell->get_dof_values(u, local);
      stiffness.multiply(cell, internal, local);
      const CellField<dim> loads = load(cell);
      for (unsigned int i = 0; i < dofs.size(); ++i)
      {
        const auto [component, shape] = fe.system_to_component_index(i);
        forces.internal(dofs[i]) += internal[i];
        forces.loads(dofs[i]) += loads[shape][component];
      }
    }
}

template class PrimalSystem<2>;
template class PrimalSystem<3>;
} // namespace hpvi
