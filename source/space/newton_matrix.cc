// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/memory.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/base/processes.h>
#include <hpvi/space/algebraic_multigrid.h>
#include <hpvi/space/newton_matrix.h>
#include <hpvi/space/rigid_motions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr double held_factor = 1e4;
constexpr unsigned int amg_steps = 300, multigrid_steps = 100;
} // namespace

template <int dim>
LinearMethod linear_method(const PrimalSpace<dim> &space)
{
  if constexpr (dim == 3)
    if (const LinearMethod wanted = space.scene.solver.linear; wanted != LinearMethod::automatic)
      return wanted;
    else
      return Multigrid::is_for(space) ? LinearMethod::multigrid : LinearMethod::amg;
  else
    return LinearMethod::direct;
}

template <int dim>
double expected_bytes(const PrimalSpace<dim> &space)
{
  const auto &mesh = space.dof_handler.get_triangulation();
  const double share = double(space.owned.n_elements()) / space.dof_handler.n_dofs();
  if (linear_method(space) == LinearMethod::multigrid)
    return 520. * space.owned.n_elements() + 7500. * share * mesh.n_global_coarse_cells();
  double entries = 0;
  for (const auto &cell : mesh.active_cell_iterators())
    if (cell->is_locally_owned())
      entries += std::pow(space.tables.of(cell).fe.dofs_per_cell, 2);
  return 19 * entries;
}

template <int dim>
std::string matrix_name(const PrimalSpace<dim> &space)
{
  return (linear_method(space) == LinearMethod::multigrid ? "the levels of multigrid for "
                                                          : "the matrix and its multigrid for ") +
         std::to_string(space.dof_handler.n_dofs()) + " unknowns";
}

template <int dim>
void require_room(const PrimalSpace<dim> &space)
{
  MPI_Comm machine;
  MPI_Comm_split_type(space.communicator(), MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  const double bytes = Utilities::MPI::sum(expected_bytes(space), machine);
  MPI_Comm_free(&machine);
  collectively(space.communicator(), [&]() { require_memory(bytes, matrix_name(space)); });
}

template <int dim>
NewtonMatrix<dim>::NewtonMatrix(const PrimalSpace<dim> &space, PrimalSystem<dim> &system)
    : NewtonMatrix(space, system, linear_method(space))
{
}

template <int dim>
NewtonMatrix<dim>::NewtonMatrix(const PrimalSpace<dim> &space, PrimalSystem<dim> &system,
                                const LinearMethod method)
    : method(method), space(space), system(system), blocks(space.contact.size()),
      inserted(space.contact.size()), states(space.contact.size()), springs(space.contact.size())
{
  begin();
}

/** What #method wants. */
template <int dim>
void NewtonMatrix<dim>::begin()
{
  const Timer timer;
  if constexpr (dim == 3)
    if (method == LinearMethod::multigrid)
    {
      multigrid = std::make_unique<Multigrid>(space);
      blocks = multigrid->blocks();
      setup_seconds += timer.wall_time();
      return;
    }
  multigrid.reset();
  if (!A) // else its entries at contact dofs are no longer those of the body alone
    assemble();
  setup_seconds += timer.wall_time();
}

template <int dim>
void NewtonMatrix<dim>::assemble()
{
  A = &system.matrix();
  for (unsigned int k = 0; k < blocks.size(); ++k)
    for (unsigned int s = 0; s < dim - 1; ++s)
      for (unsigned int t = 0; t <= s; ++t)
        if (const auto &contact_dof = space.contact[k]; contact_dof.is_tangential() || s == t)
          blocks[k][s][t] = A->el(space.owned.nth_index_in_set(contact_dof.unknowns[s]),
                                  space.owned.nth_index_in_set(contact_dof.unknowns[t]));
  motions = hpvi::rigid_motions(space);
}

template <int dim>
const typename NewtonMatrix<dim>::Block &NewtonMatrix<dim>::block(const unsigned int k) const
{
  return blocks[k];
}

/** What is held is no unknown. */
template <int dim>
void NewtonMatrix<dim>::mask(DistributedVector &x) const
{
  for (unsigned int k = 0; k < states.size(); ++k)
    if (states[k].is_held)
      space.set_contact_value(x, k, {});
}

template <int dim>
void NewtonMatrix<dim>::multiply(DistributedVector &y, const DistributedVector &x) const
{
  if constexpr (dim == 3)
    if (multigrid)
      multigrid->multiply(y, x);
  if (!multigrid)
    A->vmult(y, x);
  for (unsigned int k = 0; k < springs.size(); ++k)
  {
    const ContactVector<dim> m = space.contact_value(x, k);
    space.add_contact_value(y, k,
                            springs[k] * m - (multigrid ? ContactVector<dim>() : inserted[k] * m));
  }
}

template <int dim>
void NewtonMatrix<dim>::multiply_linearised(DistributedVector &y, const DistributedVector &x) const
{
  if constexpr (dim == 3)
    if (multigrid)
    {
      multigrid->multiply_linearised(y, x);
      return;
    }
  A->vmult(y, x);
  for (unsigned int k = 0; k < states.size(); ++k)
    space.add_contact_value(y, k, (states[k].stiffness - inserted[k]) * space.contact_value(x, k));
  mask(y);
}

template <int dim>
void NewtonMatrix<dim>::set_block(const unsigned int k, const Block &block)
{
  const auto &unknowns = space.contact[k].unknowns;
  const unsigned int n = space.contact[k].n_unknowns();
  for (unsigned int s = 0; s < n; ++s)
    for (unsigned int t = 0; t < n; ++t)
      A->set(space.owned.nth_index_in_set(unknowns[s]), space.owned.nth_index_in_set(unknowns[t]),
             block[s][t]);
}

template <int dim>
void NewtonMatrix<dim>::set_up()
{
  const Timer timer;
  amg.reset();
  std::vector<double> free_motions = motions;
  const unsigned int n = space.owned.n_elements();
  for (unsigned int k = 0; k < states.size(); ++k)
  {
    inserted[k] = states[k].stiffness;
    if (states[k].is_held)
      for (unsigned int s = 0; s < dim - 1; ++s)
      {
        inserted[k][s][s] += (held_factor - 1) * blocks[k][s][s];
        for (unsigned int m = 0; m < n_motions<dim>; ++m)
          free_motions[m * n + space.contact[k].unknowns[s]] = 0;
      }
    set_block(k, blocks[k] + inserted[k]);
  }
  A->compress(VectorOperation::insert);
  Teuchos::ParameterList parameters = algebraic_multigrid<dim>(free_motions);
  amg = std::make_unique<TrilinosWrappers::PreconditionAMG>();
  amg->initialize(*A, parameters);
  known = states;
  ++n_setups;
  setup_seconds += timer.wall_time();
}

/** By CHOLMOD, without what is held. */
template <int dim>
void NewtonMatrix<dim>::factor_alone()
{
  std::vector<char> is_held(space.owned.n_elements(), 0);
  for (unsigned int k = 0; k < states.size(); ++k)
    for (const unsigned int unknown : space.contact[k].unknowns)
      is_held[unknown] = states[k].is_held;
  SymmetricMatrix upper; // its column j is what row j has up to the diagonal
  upper.resize((A->n_nonzero_elements() + is_held.size()) / 2);
  int n_entries = 0;
  for (unsigned int j = 0; j < is_held.size(); ++j)
  {
    int n = 0, *columns = nullptr;
    double *values = nullptr;
    A->trilinos_matrix().ExtractMyRowView(j, n, values, columns);
    for (int e = 0; e < n; ++e)
    {
      const unsigned int i = columns[e]; // numbered alike on one process
      if (i > j || (i < j && (values[e] == 0 || is_held[i] || is_held[j])))
        continue;
      upper.row[n_entries] = i;
      upper.value[n_entries++] = i == j && is_held[j] ? 1. : values[e];
    }
    upper.column_start.push_back(n_entries);
  }
  upper.resize(n_entries);
  own_factors = std::make_unique<LinearSolver>(upper, std::vector<unsigned int>());
}

/** By MUMPS. */
template <int dim>
void NewtonMatrix<dim>::factor_together()
{
  std::vector<types::global_dof_index> held;
  for (unsigned int k = 0; k < states.size(); ++k)
    for (unsigned int s = 0; states[k].is_held && s < space.contact[k].n_unknowns(); ++s)
      held.push_back(space.owned.nth_index_in_set(space.contact[k].unknowns[s]));
  factored.reinit(*A);
  factored.copy_from(*A);
  factored.clear_rows(held, 1.);
  using Factors = TrilinosWrappers::SolverDirect;
  factors = std::make_unique<Factors>(control, Factors::AdditionalData(false, "Amesos_Mumps"));
  factors->initialize(factored);
}

template <int dim>
void NewtonMatrix<dim>::factor()
{
  const Timer timer;
  amg.reset();
  factors.reset();
  own_factors.reset();
  for (unsigned int k = 0; k < states.size(); ++k)
  {
    inserted[k] = states[k].stiffness;
    set_block(k, blocks[k] + inserted[k]);
  }
  A->compress(VectorOperation::insert);
  if (Utilities::MPI::n_mpi_processes(space.communicator()) == 1)
    factor_alone();
  else
    factor_together();
  ++n_setups;
  setup_seconds += timer.wall_time();
}

template <int dim>
void NewtonMatrix<dim>::add_springs(const std::vector<double> &stiffness)
{
  springs = stiffness;
}

template <int dim>
void NewtonMatrix<dim>::linearise(const std::vector<ContactDofState<dim>> &new_states,
                                  const bool anew)
{
  types::global_dof_index changed = 0;
  for (unsigned int k = 0; k < states.size(); ++k)
    changed += states[k].is_held != new_states[k].is_held;
  states = new_states;
  for (unsigned int k = 0; k < states.size(); ++k)
    if (!states[k].is_held)
      states[k].stiffness += springs[k] * unit_symmetric_tensor<dim - 1>();
  prepare(anew || 50 * Utilities::MPI::sum(changed, space.communicator()) >
                      space.n_discs + space.n_pressures);
}

/** Multigrid or factors for the states; that of ML where it is wanted @p anew or missing. */
template <int dim>
void NewtonMatrix<dim>::prepare(const bool anew)
{
  if constexpr (dim == 3)
    if (multigrid)
    {
      const Timer timer;
      try
      {
        multigrid->linearise(states);
      }
      catch (const NumericalFailure &) // of the coarsest matrix, which all processes factorise
      {
        give_way();
        return;
      }
      n_setups = std::max(n_setups, 1u);
      setup_seconds += timer.wall_time();
      return;
    }
  if (method == LinearMethod::direct)
    factor();
  else if (anew || !amg)
    set_up();
}

/** The next method takes the place of this one. */
template <int dim>
void NewtonMatrix<dim>::give_way()
{
  if (method == LinearMethod::direct)
    throw NumericalFailure("neither conjugate gradients with multigrid nor a factorisation solve "
                           "for the displacement; keep Poisson's ratio away from 1/2, take a mesh "
                           "of less slender cells or raise Solver/Primal tolerance");
  fell_back = true;
  method = method == LinearMethod::multigrid ? LinearMethod::amg : LinearMethod::direct;
  begin();
  prepare(/*anew=*/true);
}

template <int dim>
void NewtonMatrix<dim>::precondition(DistributedVector &z, const DistributedVector &r) const
{
  if constexpr (dim == 3)
    if (multigrid)
    {
      multigrid->precondition(z, r);
      mask(z);
      return;
    }
  if (own_factors)
  {
    const Vector<double> solution = own_factors->solve(Vector<double>(r.begin(), r.end()));
    std::copy(solution.begin(), solution.end(), z.begin());
    mask(z);
    return;
  }
  if (factors)
  {
    factors->solve(z, r);
    mask(z);
    return;
  }
  amg->vmult(z, r);
  for (unsigned int k = 0; k < states.size(); ++k)
    if (!states[k].is_held && known[k].is_held)
      space.add_contact_value(z, k,
                              invert(blocks[k] + states[k].stiffness) * space.contact_value(r, k));
  mask(z);
}

/**
 * Conjugate gradients; false where they break down. Multigrid of single precision is no symmetric operator to the last bits: the
 * next direction is made orthogonal to the last one by its own product (Polak and Ribiere).
 */
template <int dim>
bool NewtonMatrix<dim>::iterate(DistributedVector &v, const DistributedVector &b,
                                const double tolerance, const double error)
{
  DistributedVector r = b, z = b, p, q = b;
  multiply_linearised(q, v);
  mask(r);
  r -= q;
  double rho = 0, length = 0;
  const unsigned int most = method == LinearMethod::multigrid ? multigrid_steps : amg_steps;
  for (unsigned int step = 0; !(r.l2_norm() <= tolerance); ++step, ++n_steps)
  {
    before_step();
    precondition(z, r);
    const double next = r * z;
    if (next > 0 && next <= error * error)
      break;
    if (step == 0)
      p = z;
    else
      p.sadd(method == LinearMethod::multigrid ? -length * (z * q) / rho : next / rho, 1., z);
    rho = next;
    multiply_linearised(q, p);
    const double curvature = p * q;
    if (!(rho > 0 && curvature > 0 && std::isfinite(rho / curvature)) || step == most)
      return false;
    length = rho / curvature;
    v.add(length, p);
    r.add(-length, q);
  }
  return true;
}

template <int dim>
void NewtonMatrix<dim>::solve(DistributedVector &v, const DistributedVector &b,
                              const double tolerance, const double error)
{
  const DistributedVector start = v;
  while (!iterate(v, b, tolerance, error))
  {
    give_way();
    v = start;
  }
}

template LinearMethod linear_method(const PrimalSpace<2> &);
template LinearMethod linear_method(const PrimalSpace<3> &);
template double expected_bytes(const PrimalSpace<2> &);
template double expected_bytes(const PrimalSpace<3> &);
template std::string matrix_name(const PrimalSpace<2> &);
template std::string matrix_name(const PrimalSpace<3> &);
template void require_room(const PrimalSpace<2> &);
template void require_room(const PrimalSpace<3> &);
template class NewtonMatrix<2>;
template class NewtonMatrix<3>;
} // namespace hpvi
