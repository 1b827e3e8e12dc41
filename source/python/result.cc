// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/file_format.h>
#include <hpvi/base/text.h>
#include <hpvi/driver/load_history.h>
#include <hpvi/output/contact_table.h>
#include <hpvi/output/forces_table.h>
#include <hpvi/output/output.h>
#include <hpvi/output/probe_table.h>
#include <hpvi/output/result_directory.h>
#include <hpvi/plane/cell_map.h>
#include <hpvi/plane/mesh.h>
#include <hpvi/program/failure.h>
#include <hpvi/python/result.h>
#include <hpvi/reader/deck/deck_mesh.h>
#include <hpvi/reader/gmsh/given_mesh.h>
#include <hpvi/reader/scene_reader.h>
#include <hpvi/results/values_at.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/vector_memory.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <mutex>
#include <optional>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Where deal.II counts along the axes, others go around: the vertices of a cell in their order. */
template <int dim>
constexpr std::array<unsigned int, 1 << dim> around()
{
  if constexpr (dim == 2)
    return {{0, 1, 3, 2}};
  else
    return {{0, 1, 3, 2, 4, 5, 7, 6}};
}

/** Behind those that are there; without @p value, outside the body, NaN. */
template <int dim>
void append(PointArrays &arrays, const Point<dim> &x, const std::optional<PointValue<dim>> &value)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (unsigned int d = 0; d < dim; ++d)
  {
    arrays.x.push_back(x[d]);
    arrays.u.push_back(value ? value->displacement[d] : nan);
  }
  const auto component = [&](const unsigned int i, const unsigned int j)
  {
    if (i < dim && j < dim)
      return value->stress[i][j];
    return i == j ? value->across : 0.;
  };
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      arrays.stress.push_back(value ? component(i, j) : nan);
}

/** The end of MPI empties deal.II's pools of vectors. What is made before it ends after it. */
const GrowingVectorMemory<LinearAlgebra::distributed::Vector<float>> pool_of_floats;
const GrowingVectorMemory<LinearAlgebra::distributed::Vector<double>> pool_of_doubles;
/**
 * Runs of the primal path use MPI, which knows no threads: one at a time. These end with the process, after all that Python
 * has and before what they depend on.
 */
std::recursive_mutex mpi_turn;
std::unique_ptr<Utilities::MPI::MPI_InitFinalize> mpi;
/** What Python let go of while another thread had its turn; ends with that. */
std::mutex left_mutex;
std::vector<std::shared_ptr<const void>> left;

void end_what_is_left()
{
  std::vector<std::shared_ptr<const void>> ending;
  const std::lock_guard<std::mutex> lock(left_mutex);
  ending.swap(left);
}

/** As long as a run lasts that needs it. */
class MpiTurn
{
public:
  explicit MpiTurn(const bool is_needed) : lock(mpi_turn, std::defer_lock)
  {
    if (is_needed)
      lock.lock();
  }

  ~MpiTurn()
  {
    if (lock.owns_lock())
      end_what_is_left();
  }

private:
  std::unique_lock<std::recursive_mutex> lock;
};

/** On one thread: those of Python may have a scene each. */
template <int dim>
std::shared_ptr<const Scene<dim>> scene_of(const ParameterFile &file)
{
  auto scene = std::make_shared<Scene<dim>>(read_scene<dim>(file));
  scene->solver.threads = 1;
  return scene;
}

template <int dim>
class RunOf : public Result
{
public:
  explicit RunOf(const ParameterFile &file)
      : scene_read(scene_of<dim>(file)), scene(*scene_read), needs_mpi(takes_primal_path(scene, 1))
  {
    length_unit = scene.length_unit;
    stress_unit = scene.stress_unit;
  }

  /** It may be another thread's turn, for which the interpreter must not wait. */
  ~RunOf() override
  {
    last.reset();
    std::shared_ptr<const void> ending(solver.release(),
                                       [scene = scene_read](LoadHistory<dim> *run) { delete run; });
    if (const std::unique_lock<std::recursive_mutex> turn(mpi_turn, std::try_to_lock);
        !needs_mpi || turn.owns_lock())
    {
      ending.reset();
      return;
    }
    const std::lock_guard<std::mutex> lock(left_mutex);
    left.push_back(std::move(ending));
  }

  unsigned int dimension() const override
  {
    return dim;
  }

  std::vector<Record> contact() const override
  {
    return contact_rows(scene, step().contact);
  }

  std::vector<Record> forces() const override
  {
    return forces_rows(step());
  }

  std::vector<Record> loading() const override
  {
    return loads;
  }

  std::vector<Record> contact_history() const override
  {
    return contact_history_rows(scene, history.contact);
  }

  std::vector<Record> cycles() const override
  {
    return cycle_rows(history.cycles);
  }

  std::vector<std::pair<std::string, std::vector<Record>>> probe_lines() const override
  {
    std::vector<std::pair<std::string, std::vector<Record>>> lines;
    for (const ProbeLine<dim> &line : step().probe_lines)
      lines.emplace_back(scene.probes[line.probe].name, probe_rows(line));
    return lines;
  }

  std::vector<double> bound_by_cell() const override
  {
    return step().bound ? step().bound->indicators() : std::vector<double>();
  }

  std::vector<double> indicator_by_cell() const override
  {
    std::vector<double> eta = step().estimate.indicators();
    for (double &one : eta)
      one *= std::sqrt(scene.thickness);
    return eta;
  }

  std::string no_bound() const override
  {
    return step().bound ? "" : step().no_bound;
  }

  MeshArrays mesh() const override;
  PointArrays at(const std::vector<double> &points, const std::string &body) const override;
  PointArrays grid(unsigned int n) const override;

  void take(const StepReport<dim> &step);

  const std::shared_ptr<const Scene<dim>> scene_read; ///< outlives the solver
  const Scene<dim> &scene;
  const bool needs_mpi;
  std::unique_ptr<LoadHistory<dim>> solver;
  std::optional<StepReport<dim>> last; ///< as long as what it refers to

private:
  const StepReport<dim> &step() const
  {
    if (!last)
      throw NotAtHand("the solution of the last step is at hand in the callback and after "
                      "solve() alone; ask it there");
    return *last;
  }

  Tables<dim> tables;
  std::vector<Record> loads;
  HistorySoFar history; ///< up to the last load step that is over
};

template <int dim>
void RunOf<dim>::take(const StepReport<dim> &step)
{
  last.emplace(step);
  tables.add(step);
  steps.push_back(tables.convergence.last);
  if (step.load.number > 0 && !step.stopped_by.empty())
  {
    loads.push_back(tables.loading.last);
    history = step.history;
  }
  stopped_by = text(step.stopped_by);
  warnings = texts(step.warnings);
}

template <int dim>
MeshArrays RunOf<dim>::mesh() const
{
  MeshArrays mesh;
  std::map<unsigned int, long> numbers; // by that of the triangulation, which has unused ones
  for (const auto &cell : step().field.dof_handler.active_cell_iterators())
  {
    for (const unsigned int k : around<dim>())
    {
      const auto [vertex, is_new] = numbers.emplace(cell->vertex_index(k), numbers.size());
      for (unsigned int d = 0; is_new && d < dim; ++d)
        mesh.vertices.push_back(cell->vertex(k)[d]);
      mesh.cells.push_back(vertex->second);
    }
    mesh.degrees.push_back(cell->get_fe().degree);
    mesh.bodies.push_back(body_of<dim>(scene.geometry, cell));
  }
  return mesh;
}

/** Its number; of no name none. */
template <int dim>
std::optional<unsigned int> number_of_body(const Scene<dim> &scene, const std::string &name)
{
  if (name.empty())
    return std::nullopt;
  std::vector<std::string> names;
  for (const Body<dim> &body : scene.geometry.bodies)
    if (names.push_back(body.name); body.name == name)
      return names.size() - 1;
  throw std::invalid_argument(
      "body: there is none called " + printable(name) + "; " +
      (names.empty() ? "this scene has one body without a name" : "give " + listed(names, "or")));
}

template <int dim>
PointArrays RunOf<dim>::at(const std::vector<double> &points, const std::string &body) const
{
  std::vector<Point<dim>> places(points.size() / dim);
  for (std::size_t k = 0; k < places.size(); ++k)
    for (unsigned int d = 0; d < dim; ++d)
      places[k][d] = points[dim * k + d];
  PointArrays arrays;
  const auto values = values_at(step().field, places, number_of_body(scene, body));
  for (std::size_t k = 0; k < places.size(); ++k)
    append(arrays, places[k], values[k]);
  return arrays;
}

template <int dim>
PointArrays RunOf<dim>::grid(const unsigned int n) const
{
  std::vector<Point<dim>> references(std::pow(n, dim) + 0.5);
  for (std::size_t k = 0; k < references.size(); ++k)
    for (std::size_t d = dim, rest = k; d-- > 0; rest /= n)
      references[k][d] = rest % n / (n - 1.);
  PointArrays arrays;
  for (const auto &cell : step().field.dof_handler.active_cell_iterators())
  {
    const CellMap<dim> map = map_of<dim>(cell);
    const auto values = step().field.values(cell, references);
    for (std::size_t k = 0; k < references.size(); ++k)
      append<dim>(arrays, map.point(references[k]), values[k]);
  }
  return arrays;
}

/** Only the primal path needs it. */
void start_mpi()
{
  if (mpi)
    return;
  if (Utilities::MPI::job_supports_mpi())
    throw NotAtHand(
        "hpvi: MPI has been started by another module; import hpvi first and solve one scene, or "
        "set mpi4py.rc.initialize = False before mpi4py.MPI is imported");
  static int argc = 0;
  static char **argv = nullptr;
  mpi = std::make_unique<Utilities::MPI::MPI_InitFinalize>(argc, argv, 1);
}

/** The listener has had enough after a step that is whole. */
struct Enough
{
};

template <int dim>
std::shared_ptr<Result> run(const ParameterFile &file, const std::string &directory,
                            const Listener &listener)
{
  const auto result = std::make_shared<RunOf<dim>>(file);
  const MpiTurn turn(result->needs_mpi);
  if (result->needs_mpi)
    start_mpi();
  const auto announce = [&](const Progress &) { listener.between(); };
  result->solver = std::make_unique<LoadHistory<dim>>(result->scene);
  result->solver->prepare(announce);
  std::unique_ptr<Output<dim>> output;
  if (!directory.empty())
    output = std::make_unique<Output<dim>>(result->scene, directory);
  const auto finished = [&](const StepReport<dim> &step)
  {
    result->take(step);
    if (output)
      output->write_step(step, result->solver.get());
    if (!listener.finished(result))
      throw Enough();
    if (step.stopped_by.empty() || (result->scene.has_load_history() && !step.load.is_last))
      result->last.reset();
  };
  try
  {
    result->solver->run(finished, announce);
    if (output)
      output->finish();
  }
  catch (const Enough &)
  {
    result->stopped_by = "callback";
    if (output)
      output->give_up(RunStatus::interrupted, "hpvi: stopped by the callback");
  }
  catch (const BrokenOff &end)
  {
    result->last.reset();
    if (output)
      output->give_up(RunStatus::interrupted, end.what());
    throw;
  }
  catch (const std::exception &error)
  {
    result->last.reset();
    if (output)
      output->give_up(RunStatus::failed, failure_line(error));
    throw;
  }
  return result;
}

/** Beside the results, whose scene.prm names it. Not before the scene is known to be one, and not over what is another's. */
std::string written_mesh(const SceneText &scene, const std::string &directory)
{
  scene.title();
  const std::filesystem::path path = std::filesystem::absolute(directory) / "mesh.msh";
  const std::string mesh = mesh_text(scene.mesh->file);
  std::error_code error;
  if (std::filesystem::exists(path, error) && content_of(path) != mesh)
    throw InputError("output directory '" + printable(directory, 400) +
                     "': has another mesh.msh; choose another one");
  std::filesystem::create_directories(path.parent_path(), error);
  if (!error)
    error = write_whole(path, mesh, "mesh.msh.part");
  if (error)
    throw OutputFailure("output directory '" + printable(directory, 400) +
                        "': mesh.msh cannot be written: " + error.message());
  return path.lexically_normal().string();
}
} // namespace

std::shared_ptr<Result> solve(const SceneText &scene, const std::string &directory,
                              const Listener &listener)
{
  SceneText own = scene;
  if (own.mesh && !directory.empty())
    own.mesh_file = written_mesh(own, directory);
  const ParameterFile file = own.read();
  return (scene_dimension(file) == 3 ? run<3> : run<2>)(file, directory, listener);
}

std::string exception_name(const std::exception &error)
{
  if (dynamic_cast<const InputError *>(&error))
    return "InputError";
  if (dynamic_cast<const NumericalFailure *>(&error))
    return "NumericalFailure";
  if (dynamic_cast<const OutputFailure *>(&error))
    return "OutputFailure";
  return failure_line(error).rfind("hpvi: out of memory", 0) == 0 ? "MemoryError" : "RuntimeError";
}

std::string line_of(const std::exception &error)
{
  return failure_line(error);
}
} // namespace hpvi
