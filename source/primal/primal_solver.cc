// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/adaptivity/warnings.h>
#include <hpvi/base/memory.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/base/one_thread.h>
#include <hpvi/base/text.h>
#include <hpvi/body/deformation.h>
#include <hpvi/body/mesh.h>
#include <hpvi/checks/checks.h>
#include <hpvi/primal/load_check.h>
#include <hpvi/primal/primal_solver.h>
#include <hpvi/primal/transfer.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
/** What Newton's method leaves, as a part of the estimated error. */
constexpr double algebraic_part = 1e-2;

/** Of the residual relative to the load vector: Newton's method has no less to reach. */
constexpr double round_off = 1e-11;

/** Of a process: matrix, its pattern, the levels of multigrid; measured to a quarter. */
template <int dim>
double expected_bytes(const MomentSpace<dim> &space)
{
  const double n_cells = space.dof_handler.get_triangulation().n_global_active_cells() *
                         (double(space.owned.n_elements()) / space.dof_handler.n_dofs()),
               n = space.tables.fe.dofs_per_cell;
  return 19 * n_cells * n * n;
}

/** How far u_N moves the nodes of the body, its nearest rigid motion aside; collective. */
template <int dim>
double deformation(const MomentSpace<dim> &space, const DistributedVector &u)
{
  Deformation<dim> deformation;
  const auto &nodes = space.tables.fe.base_element(0).get_unit_support_points();
  for (const auto &cell : space.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const CellField<dim> field = space.field(cell, u);
      for (unsigned int i = 0; i < nodes.size(); ++i)
        deformation.add(MomentSpace<dim>::point_of(cell, nodes[i]), field[i]);
    }
  return deformation.largest(space.communicator());
}

/** What in the last step asks for care, one line each; collective, of the contact on the first process. */
template <int dim>
std::vector<std::string> warnings(const PrimalReport<dim> &step)
{
  std::vector<std::string> result;
  const Adaptivity &adaptivity = step.space.scene.adaptivity;
  if (adaptivity.tolerance > 0 && adaptivity.tolerance_on == Indicator::bound)
    result.push_back("the primal path has no guaranteed bound of the error: Adaptivity/Tolerance "
                     "was held against the indicator, which is a measure and no bound");
  const auto add = [&](const std::string &warning)
  {
    if (!warning.empty())
      result.push_back(warning);
  };
  together(step.space.communicator(),
           [&]() { add(LoadCheck<dim>(step.space.scene).warning(step.equilibrium.loads)); });
  if (step.newton.is_cut_off)
    result.push_back("Newton's method did not find stick and slip in " +
                     to_string(step.newton.steps) +
                     " steps, and the augmented Lagrangian took its place");
  if (step.newton.fell_back)
    result.push_back("multigrid broke down, and a sparse factorisation took its place; "
                     "Solver/Linear = direct begins with it");
  double pull = 0, press = 0, friction = 0, open = 0;
  for (const MomentPoint<dim> &point : step.contact)
  {
    const double force = point.area * point.bound * point.lambda.norm();
    friction += force;
    open += point.mode() == ContactMode::open ? force : 0.;
    if (step.space.scene.boundaries[point.boundary].contact == Contact::bilateral)
      (point.normal_traction > 0 ? pull : press) += point.area * std::abs(point.normal_traction);
  }
  if (pull > 1e-3 * (pull + press))
    result.push_back("bilateral contact pulls with a force of " + to_string(pull) +
                     " where it presses with " + to_string(press) +
                     ": a body free to lift off needs unilateral contact");
  add(friction_without_contact(open, friction));
  const auto deepest =
      std::max_element(step.penetrations.begin(), step.penetrations.end(),
                       [](const auto &a, const auto &b) { return a.depth < b.depth; });
  if (deepest->depth > 0)
    add(deep_penetration(step.space.scene, deepest - step.penetrations.begin(), deepest->depth,
                         deepest->x, deformation(step.space, step.u)));
  return result;
}

/** Throws on all processes where those of one machine need more than it has. */
template <int dim>
void require_room(const MomentSpace<dim> &space)
{
  MPI_Comm machine;
  MPI_Comm_split_type(space.communicator(), MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  const double bytes = Utilities::MPI::sum(expected_bytes(space), machine);
  MPI_Comm_free(&machine);
  together(space.communicator(),
           [&]()
           {
             require_memory(bytes, "the matrix and its multigrid for " +
                                       std::to_string(space.dof_handler.n_dofs()) + " unknowns");
           });
}
} // namespace

template <int dim>
struct PrimalSolver<dim>::Stages
{
  const Scene<dim> &scene;
  typename MomentSpace<dim>::Mesh mesh;
  const BoxTables<dim> tables;
  std::unique_ptr<const MomentSpace<dim>> space;
  DistributedVector u;                    ///< on the current mesh, from the one before
  std::vector<ContactVector<dim>> lambda; ///< likewise; empty before the first step
  StageTimes times;                       ///< of the current step
  History history;                        ///< of the finished steps
  std::function<void(const Progress &)> about_to = [](const Progress &) {};

  Stages(const Scene<dim> &scene, MPI_Comm communicator)
      : scene(scene), mesh(communicator), tables(scene.adaptivity.start_degree)
  {
    make_mesh(scene, static_cast<Triangulation<dim> &>(mesh));
    const auto n = Utilities::MPI::n_mpi_processes(communicator);
    if (mesh.n_global_active_cells() < n)
      throw InputError(printable(scene.origin(), 400) +
                       ": Geometry/Subdivisions: makes fewer cells, " +
                       std::to_string(mesh.n_global_active_cells()) + ", than the " +
                       std::to_string(n) + " processes; start fewer of them or take more cells");
  }

  void begin(const std::string &stage) const;
  NewtonReport solve();
  NewtonReport iterate(MomentNewton<dim> &newton, MomentMatrix<dim> &matrix, DistributedVector &v,
                       const NewtonSettings &settings);
  NewtonSettings first_settings() const;
  bool is_exact(const NewtonReport &newton, NewtonSettings &settings) const;
  void estimate_error();
  Energies energies(const PrimalSystem<dim> &system, const DistributedVector &v) const;
  PrimalReport<dim> report(const NewtonReport &newton);
  std::vector<bool> mark() const;
  double total_estimate() const;
  std::string limit() const;
  void refine(const std::vector<bool> &marked);

  ErrorEstimate estimate; ///< of the current step, as the next
  Energies step_energies;
  Equilibrium<dim> balance;
};

template <int dim>
void PrimalSolver<dim>::Stages::begin(const std::string &stage) const
{
  about_to({static_cast<unsigned int>(history.size()) + 1, stage, ""});
}

/** The only long stage: it is spoken of, and may be interrupted, in each step of conjugate gradients. */
template <int dim>
NewtonReport PrimalSolver<dim>::Stages::iterate(MomentNewton<dim> &newton,
                                                MomentMatrix<dim> &matrix, DistributedVector &v,
                                                const NewtonSettings &settings)
{
  const unsigned int steps_before = matrix.n_steps;
  std::string place;
  matrix.before_step = [&]()
  {
    begin("finding stick and slip: " + place + std::to_string(matrix.n_steps - steps_before) +
          " steps of conjugate gradients");
  };
  return newton.solve(v, lambda, settings,
                      [&](const NewtonReport &sofar)
                      {
                        place =
                            std::string(sofar.augmented_steps > 0 ? "augmented Lagrangian, step "
                                                                  : "Newton step ") +
                            std::to_string(sofar.steps + sofar.augmented_steps + 1) + ", ";
                      });
}

/** Before the error of this mesh is estimated: as if it were half of that before. */
template <int dim>
NewtonSettings PrimalSolver<dim>::Stages::first_settings() const
{
  NewtonSettings settings;
  if (scene.solver.primal_tolerance > 0)
    settings.residual = scene.solver.primal_tolerance;
  else if (!history.empty())
  {
    settings.residual = round_off;
    settings.error = 0.5 * algebraic_part * history.back().estimate / std::sqrt(scene.coercivity());
  }
  return settings;
}

/** Is the algebraic error small enough beside the estimated one? If not, what Newton's method is to reach. */
template <int dim>
bool PrimalSolver<dim>::Stages::is_exact(const NewtonReport &newton, NewtonSettings &settings) const
{
  const double error = algebraic_part * total_estimate() / std::sqrt(scene.coercivity());
  if (scene.solver.primal_tolerance > 0 || newton.residual <= round_off || newton.error <= error)
    return true;
  settings.residual = round_off;
  settings.error = 0.5 * error;
  return false;
}

template <int dim>
void PrimalSolver<dim>::Stages::estimate_error()
{
  begin("estimating the error");
  StageTimer timer(times.estimate);
  together(space->communicator(), [&]() { estimate = hpvi::estimate_error(*space, u, lambda); });
}

template <int dim>
NewtonReport PrimalSolver<dim>::Stages::solve()
{
  begin("assembling " + std::to_string(mesh.n_global_active_cells()) + " elements");
  require_room(*space);
  std::unique_ptr<PrimalSystem<dim>> system;
  {
    StageTimer timer(times.assemble);
    system = std::make_unique<PrimalSystem<dim>>(*space);
  }
  Timer timer;
  MomentMatrix<dim> matrix(*space, *system);
  MomentNewton<dim> newton(*space, *system, matrix);
  DistributedVector v = history.empty() ? space->owned_vector() : space->moments(u);
  NewtonSettings settings = first_settings();
  NewtonReport report;
  do
  {
    timer.restart();
    report += iterate(newton, matrix, v, settings);
    times.qp += timer.wall_time();
    u = space->displacement(v);
    estimate_error();
  } while (!is_exact(report, settings));
  times.factor += matrix.setup_seconds;
  times.qp -= matrix.setup_seconds;
  StageTimer recovery(times.recover);
  step_energies = energies(*system, v);
  balance = equilibrium(*space, *system, u, lambda);
  return report;
}

template <int dim>
Energies PrimalSolver<dim>::Stages::energies(const PrimalSystem<dim> &system,
                                             const DistributedVector &v) const
{
  double coupling = 0;
  for (unsigned int k = 0; k < space->contact.size(); ++k)
    coupling +=
        space->contact[k].weight * lambda[k] * (space->moment(v, k) - space->contact[k].gap);
  coupling = Utilities::MPI::sum(coupling, space->communicator());
  const double a = system.energy_product(u), potential = 0.5 * a - system.work(u),
               friction = friction_work(*space, u);
  check_finite("the energy", potential + friction);
  return {potential + coupling, potential + friction, std::sqrt(std::max(a, 0.)),
          friction - coupling};
}

/** The root of the sum over all processes. */
double root_of_sum(const std::vector<double> &squares, MPI_Comm communicator)
{
  return std::sqrt(
      Utilities::MPI::sum(std::accumulate(squares.begin(), squares.end(), 0.), communicator));
}

template <int dim>
double PrimalSolver<dim>::Stages::total_estimate() const
{
  return std::sqrt(Utilities::MPI::sum(std::pow(estimate.total(), 2), space->communicator()));
}

template <int dim>
PrimalReport<dim> PrimalSolver<dim>::Stages::report(const NewtonReport &newton)
{
  PrimalReport<dim> step{static_cast<unsigned int>(history.size()) + 1, *space, u, estimate};
  step.n_cells = mesh.n_global_active_cells();
  step.estimate_volume = root_of_sum(estimate.volume, space->communicator());
  step.estimate_jumps = root_of_sum(estimate.jumps, space->communicator());
  step.estimate_neumann = root_of_sum(estimate.neumann, space->communicator());
  step.estimate_contact = root_of_sum(estimate.contact, space->communicator());
  step.estimate_normal = root_of_sum(estimate.normal, space->communicator());
  step.estimate_penetration = root_of_sum(estimate.penetration, space->communicator());
  step.estimate_tension = root_of_sum(estimate.tension, space->communicator());
  step.total_estimate = total_estimate();
  check_finite("the error indicator", step.total_estimate);
  step.energies = step_energies;
  step.equilibrium = balance;
  Utilities::System::MemoryStats memory;
  Utilities::System::get_memory_stats(memory);
  step.peak_memory = Utilities::MPI::sum(1024. * memory.VmHWM, space->communicator());
  step.scaled_estimate = step.total_estimate / std::sqrt(scene.coercivity());
  step.relative_estimate =
      step.scaled_estimate == 0 ? 0. : step.scaled_estimate / step.energies.norm;
  {
    StageTimer timer(times.recover);
    step.contact = contact_points(*space, u, lambda);
    step.penetrations = penetrations(*space, u);
  }
  step.newton = newton;
  step.times = std::exchange(times, {});
  step.seconds = (history.empty() ? 0. : history.back().seconds) +
                 Utilities::MPI::max(step.times.total(), space->communicator());
  const double no_bound = std::numeric_limits<double>::quiet_NaN();
  history.push_back({step.total_estimate, step.relative_estimate, no_bound, step.seconds});
  return step;
}

template <int dim>
std::vector<bool> PrimalSolver<dim>::Stages::mark() const
{
  const Adaptivity &adaptivity = scene.adaptivity;
  const bool uniform = adaptivity.method <= Method::hup4;
  double sum = 0;
  for (const auto &cell : mesh.active_cell_iterators())
    if (cell->is_locally_owned())
      sum += estimate.indicator(cell->active_cell_index());
  const double mean =
      Utilities::MPI::sum(sum, mesh.get_communicator()) / mesh.n_global_active_cells();
  std::vector<bool> marked(mesh.n_active_cells(), false);
  for (const auto &cell : mesh.active_cell_iterators())
    if (cell->is_locally_owned())
      marked[cell->active_cell_index()] = uniform || estimate.indicator(cell->active_cell_index()) >
                                                         adaptivity.hap_threshold * mean;
  return marked;
}

/** Why there is no next step; empty: there is. */
template <int dim>
std::string PrimalSolver<dim>::Stages::limit() const
{
  const Adaptivity &limits = scene.adaptivity;
  const PastStep &last = history.back();
  if (last.relative_estimate < limits.tolerance)
    return "Tolerance";
  if (history.size() >= limits.maximum_steps)
    return "Maximum steps";
  if (space->n_free >= limits.maximum_unknowns)
    return "Maximum unknowns";
  if (limits.maximum_seconds > 0 && last.seconds >= limits.maximum_seconds)
    return "Maximum seconds";
  return {};
}

template <int dim>
void PrimalSolver<dim>::Stages::refine(const std::vector<bool> &marked)
{
  begin("refining");
  {
    StageTimer timer(times.refine);
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->is_locally_owned() && marked[cell->active_cell_index()])
        cell->set_refine_flag();
    mesh.prepare_coarsening_and_refinement();
  }
  std::unique_ptr<Transfer<dim>> transfer;
  {
    StageTimer timer(times.refine);
    transfer = std::make_unique<Transfer<dim>>(mesh, *space, u, lambda);
    mesh.execute_coarsening_and_refinement();
  }
  {
    StageTimer timer(times.setup);
    begin("numbering the unknowns of " + std::to_string(mesh.n_global_active_cells()) +
          " elements");
    space = std::make_unique<const MomentSpace<dim>>(scene, mesh, tables);
  }
  StageTimer timer(times.refine);
  transfer->unpack(*space, u, lambda);
}

template <int dim>
PrimalSolver<dim>::PrimalSolver(const Scene<dim> &scene, MPI_Comm communicator)
{
  together(communicator,
           [&]()
           {
             scene.check();
             check_primal_path(scene);
           });
  stages = std::make_unique<Stages>(scene, communicator);
}

template <int dim>
PrimalSolver<dim>::~PrimalSolver() = default;

template <int dim>
void PrimalSolver<dim>::run(const std::function<void(const PrimalReport<dim> &)> &finished_step,
                            const std::function<void(const Progress &)> &about_to)
{
  const OneThread one_thread;
  stages->about_to = about_to;
  {
    StageTimer timer(stages->times.setup);
    stages->begin("numbering the unknowns");
    stages->space =
        std::make_unique<const MomentSpace<dim>>(stages->scene, stages->mesh, stages->tables);
  }
  for (bool finished = false; !finished;)
  {
    PrimalReport<dim> step = stages->report(stages->solve());
    const std::vector<bool> marked = stages->mark();
    step.stopped_by = stages->limit();
    finished = !step.stopped_by.empty();
    if (finished)
      step.warnings = warnings(step);
    finished_step(step);
    if (!finished)
      stages->refine(marked);
  }
}

template class PrimalSolver<2>;
template class PrimalSolver<3>;
} // namespace hpvi
