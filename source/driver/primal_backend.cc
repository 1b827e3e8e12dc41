// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/input_error.h>
#include <hpvi/base/memory.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/base/processes.h>
#include <hpvi/base/text.h>
#include <hpvi/driver/primal_backend.h>
#include <hpvi/plane/global_cell_indices.h>
#include <hpvi/plane/matching.h>
#include <hpvi/plane/mesh.h>
#include <hpvi/reader/checks/checks.h>
#include <hpvi/reader/scene_entries.h>
#include <hpvi/space/box_bound.h>
#include <hpvi/space/load_check.h>
#include <hpvi/space/newton_matrix.h>
#include <hpvi/space/nodal_forces.h>
#include <hpvi/space/primal_field.h>
#include <hpvi/space/proximal_point.h>
#include <hpvi/space/stored_values.h>
#include <hpvi/space/transfer.h>
#include <hpvi/space/upper_energy.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
/** The coarse mesh of @p scene over all processes. Throws InputError where it has fewer cells, or the path refuses the scene. Collective. */
template <int dim>
std::shared_ptr<typename PrimalSpace<dim>::Mesh> spread_mesh(const Scene<dim> &scene,
                                                             MPI_Comm communicator)
{
  collectively(communicator, [&]() { check_primal_path(scene); });
  const auto mesh = std::make_shared<typename PrimalSpace<dim>::Mesh>(communicator);
  make_mesh(scene, static_cast<Triangulation<dim> &>(*mesh));
  const auto n = hpvi::n_processes(communicator);
  if (mesh->n_global_active_cells() < n)
    throw InputError(printable(scene.origin(), 400) +
                     ": Geometry/Subdivisions: makes fewer cells, " +
                     std::to_string(mesh->n_global_active_cells()) + ", than the " +
                     std::to_string(n) + " processes; start fewer of them or take more cells");
  return mesh;
}

/** What a machine that has the memory for the matrix of @p space should know before all of it is taken. Collective. */
template <int dim>
std::string memory_note(const PrimalSpace<dim> &space)
{
  const double bytes = Utilities::MPI::sum(expected_bytes(space), space.communicator());
  if (bytes < 1e9)
    return {};
  return matrix_name(space) + " take " + bytes_text(bytes) +
         " of memory; Adaptivity/Maximum unknowns ends a run before";
}

/** What Newton's method leaves, as a part of the estimated error. */
constexpr double algebraic_part = 1e-2;

/** Of the residual relative to the load vector: Newton's method has no less to reach. */
constexpr double round_off = 1e-11;
} // namespace

template <int dim>
PrimalBackend<dim>::PrimalBackend(const Scene<dim> &scene, MPI_Comm communicator,
                                  std::shared_ptr<typename PrimalSpace<dim>::Mesh> all_cells)
    : Backend<dim>(scene, communicator), mesh(std::move(all_cells)), tables(scene)
{
}

template <int dim>
PrimalBackend<dim>::PrimalBackend(const Scene<dim> &scene, MPI_Comm communicator)
    : PrimalBackend(scene, communicator, spread_mesh(scene, communicator))
{
}

template <int dim>
std::unique_ptr<Backend<dim>> PrimalBackend<dim>::next_load_step(const Scene<dim> &next,
                                                                 const PastSlip<dim> &)
{
  std::unique_ptr<PrimalBackend> result(new PrimalBackend(next, this->communicator, mesh));
  result->u = u;
  result->lambda = lambda;
  result->has_start = has_start;
  result->past = end_state();
  result->refined = this->refined;
  return result;
}

/** From where the next load step counts. */
template <int dim>
PastState<dim> PrimalBackend<dim>::end_state() const
{
  return hpvi::end_state(*space, u, lambda, hpvi::nodal_forces(*space, *system, u, lambda));
}

template <int dim>
void PrimalBackend<dim>::number()
{
  begin("numbering the unknowns of " + std::to_string(mesh->n_global_active_cells()) + " elements");
  StageTimer timer(times.setup);
  space = std::make_unique<PrimalSpace<dim>>(scene, *mesh, tables);
}

template <int dim>
void PrimalBackend<dim>::discretise()
{
  if (!space)
  {
    number();
    if (past)
      space->count_slip_from(past->u);
  }
  if (!system) // else prepare() has been here
    assemble();
  if (space->rests_on_contact)
    reach_loads();
}

template <int dim>
void PrimalBackend<dim>::assemble()
{
  require_room(*space);
  begin("assembling " + std::to_string(mesh->n_global_active_cells()) + " elements",
        memory_note(*space));
  StageTimer timer(times.assemble);
  system = std::make_unique<PrimalSystem<dim>>(*space);
}

/**
 * Where contact alone holds the body, statics has a say before anything is solved. Loads that pass between the last Gauss
 * point and an edge ask for smaller cells there, as on the reduced path.
 */
template <int dim>
void PrimalBackend<dim>::reach_loads()
{
  if constexpr (dim == 3)
    for (unsigned int levels_left = 4;; --levels_left)
    {
      statics = std::make_unique<const ContactStatics>(*space, system->f);
      statics->require_static_admissibility();
      const auto missing = statics->missing();
      if (!missing)
        return;
      if (levels_left == 0 || missing->n_cells == 0)
        throw NumericalFailure(missing->why);
      const auto ranks = global_cell_indices(static_cast<const Triangulation<dim> &>(*mesh));
      std::vector<unsigned int> mine(mesh->n_global_active_cells()), all(mine.size());
      for (const auto &cell : missing->cells)
        mine[ranks[cell->active_cell_index()]] = 1;
      Utilities::MPI::max(mine, this->communicator, all); // states keep the marks of all processes
      refine({std::vector<bool>(all.begin(), all.end()), degrees()});
      assemble();
    }
}

/** The only long stage: it is spoken of, and may be interrupted, in each step of conjugate gradients. */
template <int dim>
void PrimalBackend<dim>::iterate(FrictionIteration<dim> &friction, NewtonMatrix<dim> &matrix,
                                 DistributedVector &v, const NewtonSettings &settings)
{
  const unsigned int steps_before = matrix.n_steps;
  std::string place;
  matrix.before_step = [&]()
  {
    begin("finding stick and slip: " + place + std::to_string(matrix.n_steps - steps_before) +
          " steps of conjugate gradients");
  };
  const auto heard = [&](const NewtonReport &sofar)
  {
    place = sofar.augmented_steps > 0 ? "augmented Lagrangian, step " : "Newton step ";
    place += std::to_string(sofar.steps + sofar.augmented_steps + 1) + ", ";
  };
  const auto solve = [&](const NewtonSettings &inner)
  { return friction.solve(v, lambda, inner, heard); };
  if constexpr (dim == 3)
    if (space->rests_on_contact)
    {
      report += ProximalPoint(*space, *system, matrix, *statics).solve(v, lambda, settings, solve);
      return;
    }
  report += solve(settings);
}

/** Before the error of this mesh is estimated, as if it were half of that before. */
template <int dim>
NewtonSettings PrimalBackend<dim>::first_settings() const
{
  NewtonSettings settings;
  if (scene.solver.primal_tolerance > 0)
    settings.residual = scene.solver.primal_tolerance;
  else if (error > 0)
    settings = {round_off, 0.5 * algebraic_part * error, settings.maximum_steps};
  return settings;
}

/** Is the algebraic error small enough beside the estimated one? If not, what Newton's method is to reach. */
template <int dim>
bool PrimalBackend<dim>::is_exact(NewtonSettings &settings) const
{
  if (scene.solver.primal_tolerance > 0 || report.residual <= round_off ||
      report.error <= algebraic_part * error)
    return true;
  settings = {round_off, 0.5 * algebraic_part * error, settings.maximum_steps};
  return false;
}

/** The field of u and lambda, and its estimated error. */
template <int dim>
void PrimalBackend<dim>::take()
{
  known_energies.reset();
  values_at_points = std::make_unique<const PrimalField<dim>>(*space, shape_tables, u, lambda);
  begin("estimating the error");
  StageTimer timer(times.estimate);
  collectively(space->communicator(), [&]() { estimated = estimate_error(*values_at_points); });
  error = norms(estimated, space->communicator()).total / std::sqrt(scene.reference_coercivity());
}

// How exact is enough depends on the error of the mesh, which is estimated in between.
template <int dim>
void PrimalBackend<dim>::solve()
{
  Timer timer;
  NewtonMatrix<dim> matrix(*space, *system, given_way.value_or(linear_method(*space)));
  times.qp += timer.wall_time();
  SemismoothNewton<dim> newton(*space, *system, matrix);
  FrictionIteration<dim> friction(*space, newton);
  DistributedVector v = has_start ? space->in_contact_dofs(u) : space->owned_vector();
  NewtonSettings settings = first_settings();
  report = {};
  has_start = true;
  do
  {
    timer.restart();
    iterate(friction, matrix, v, settings);
    times.qp += timer.wall_time();
    u = space->displacement(v);
    take();
  } while (!is_exact(settings));
  if (matrix.fell_back) // on other meshes of this run it would as well
    given_way = matrix.method;
  times.factor += matrix.setup_seconds;
  times.qp -= matrix.setup_seconds;
}

template <int dim>
const Field<dim> &PrimalBackend<dim>::field() const
{
  return *values_at_points;
}

template <int dim>
ProblemSize PrimalBackend<dim>::size() const
{
  ProblemSize result{mesh->n_global_active_cells(),
                     space->dof_handler.n_dofs(),
                     space->n_free,
                     space->n_multipliers(),
                     {}};
  result.count(degrees());
  return result;
}

template <int dim>
ErrorEstimate PrimalBackend<dim>::estimate()
{
  return estimated;
}

template <int dim>
Energies PrimalBackend<dim>::energies()
{
  if (!known_energies)
    known_energies = hpvi::energies(field(), system->energy_product(u), system->work(u));
  return *known_energies;
}

template <int dim>
NodalForces<dim> PrimalBackend<dim>::nodal_forces()
{
  return hpvi::nodal_forces(*space, *system, u, lambda);
}

template <int dim>
std::optional<PrimalPart<dim>> PrimalBackend<dim>::primal() const
{
  return PrimalPart<dim>{*space, u, report, [this]() {
                           return work(past ? &*past : nullptr, end_state(), *space, *system);
                         }};
}

template <int dim>
double PrimalBackend<dim>::energy_high()
{
  return upper_energy(*space, u, energies(), system->work(u));
}

template <int dim>
BoundOfStep PrimalBackend<dim>::bound(double)
{
  BoundOfStep result;
  if constexpr (dim == 2)
    result.missing = "the primal path has no guaranteed bound of the error in the plane";
  else
  {
    result.missing = scene.error_bound ? no_error_bound(scene) : "Error/Bound = false";
    if (result.missing.empty())
      result.missing = no_box_bound(*space, u);
    if (result.missing.empty() && !resolves_data())
      result.missing = "the rule of its loads misses a part of them";
    if (!result.missing.empty())
      return result;
    begin("bounding the error of " + std::to_string(mesh->n_global_active_cells()) + " elements");
    StageTimer timer(times.bound);
    NewtonMatrix<dim> matrix(*space, *system, given_way.value_or(linear_method(*space)));
    result.take(box_bound(*space, matrix, u, lambda, system->work(u)));
  }
  return result;
}

/** Degrees stay: nobody asks. */
template <int dim>
double PrimalBackend<dim>::decay_rate(unsigned int) const
{
  return 0.;
}

/** Where Newton's method has no less to reach, also a few times what it has left. */
template <int dim>
double PrimalBackend<dim>::round_off_estimate() const
{
  const double norm = std::sqrt(std::max(system->energy_product(u), 0.)),
               left = 5 * report.residual * norm * std::sqrt(scene.reference_coercivity());
  return std::max(Backend<dim>::round_off_estimate(), report.residual <= round_off ? left : 0.);
}

template <int dim>
bool PrimalBackend<dim>::resolves_data()
{
  const Warnings all = warnings({}, equilibrium(scene, nodal_forces(), space->communicator()));
  return std::none_of(all.begin(), all.end(),
                      [](const Warning &warning) { return warning.kind == WarningKind::load; });
}

template <int dim>
Warnings PrimalBackend<dim>::warnings(const std::vector<ContactState<dim>> &,
                                      const Equilibrium<dim> &balance) const
{
  Warnings result;
  const Tensor<2, dim> initial_stress = system->initial_stress();
  const Tensor<1, 2> springs = system->spring_stiffness();
  collectively(space->communicator(),
               [&]()
               {
                 for (const std::string &line :
                      {LoadCheck<dim>(scene, *mesh).warning(balance.loads),
                       strain_warning<dim>(scene, *mesh, initial_stress),
                       spring_warning<dim>(scene, *mesh, springs)})
                   if (!line.empty())
                     result.push_back({WarningKind::load, 0., line});
               });
  if (report.is_cut_off)
    result.push_back({WarningKind::cut_off, double(report.steps),
                      "Newton's method did not find stick and slip in " + to_string(report.steps) +
                          " steps, and the augmented Lagrangian took its place"});
  if (balance.force_imbalance > 1e-2)
    result.push_back({WarningKind::cut_off, balance.force_imbalance,
                      "forces are out of balance by " + text(balance.force_imbalance, 2) +
                          " of their absolute sums; lower Solver/Primal tolerance"});
  if (given_way)
    result.push_back({WarningKind::multigrid, 0.,
                      std::string("multigrid broke down, and Solver/Linear = ") +
                          linear_names[static_cast<unsigned int>(report.linear)] +
                          " took its place"});
  return result;
}

template <int dim>
Degrees PrimalBackend<dim>::degrees() const
{
  if (tables.all.size() == 1)
    return Degrees(mesh->n_global_active_cells(), tables.only().degree);
  const auto ranks = global_cell_indices(static_cast<const Triangulation<dim> &>(*mesh));
  Degrees own(mesh->n_global_active_cells(), 0), result(own.size());
  for (const auto &cell : mesh->active_cell_iterators())
    if (cell->is_locally_owned())
      own[ranks[cell->active_cell_index()]] = tables.of(cell).degree;
  Utilities::MPI::max(own, this->communicator, result);
  return result;
}

// The solution goes to the new mesh at once: there it is where the next one starts.
template <int dim>
void PrimalBackend<dim>::refine(const Refinement &refinement)
{
  begin("refining");
  this->refined.emplace_back(refinement, degrees());
  std::unique_ptr<Transfer<dim>> transfer, of_past;
  {
    StageTimer timer(times.refine);
    const auto ranks = global_cell_indices(static_cast<const Triangulation<dim> &>(*mesh));
    for (const auto &cell : mesh->active_cell_iterators())
      if (cell->is_locally_owned() && refinement.bisect[ranks[cell->active_cell_index()]])
        cell->set_refine_flag();
    mesh->prepare_coarsening_and_refinement();
    if (has_start)
      transfer = std::make_unique<Transfer<dim>>(*mesh, *space, u, lambda);
    if (past)
      of_past = std::make_unique<Transfer<dim>>(*mesh, *space, past->u, past->traction);
    mesh->execute_coarsening_and_refinement();
  }
  values_at_points.reset();
  statics.reset();
  system.reset();
  number();
  StageTimer timer(times.refine);
  if (transfer)
    transfer->unpack(*space, u, lambda);
  if (of_past)
  {
    of_past->unpack(*space, past->u, past->traction);
    space->count_slip_from(past->u);
  }
}

// @sect3{Going on}
//
template <int dim>
SolutionValues PrimalBackend<dim>::values() const
{
  const StoredValues stored = stored_values(*space, u, lambda);
  SolutionValues result{stored.u, stored.z, {}, {}, {}};
  if (given_way)
    result.kept.push_back(static_cast<unsigned int>(*given_way));
  return result;
}

template <int dim>
bool PrimalBackend<dim>::restore(const SolutionValues &values)
{
  if (values.motion.size() > 0 || values.kept.size() > 1 ||
      (!values.kept.empty() && values.kept.front() >= linear_names.size()) ||
      !take_stored(values.u, values.z, *space, u, lambda))
    return false;
  has_start = true;
  if (!values.kept.empty())
    given_way = static_cast<LinearMethod>(values.kept.front());
  take();
  return true;
}

template class PrimalBackend<2>;
template class PrimalBackend<3>;
} // namespace hpvi
