// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/input_error.h>
#include <hpvi/base/processes.h>
#include <hpvi/base/text.h>
#include <hpvi/driver/primal_backend.h>
#include <hpvi/driver/reduced_backend.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

void ProblemSize::count(const Degrees &degrees)
{
  for (const unsigned int degree : degrees)
  {
    cells_of_degree.resize(std::max<std::size_t>(cells_of_degree.size(), degree + 1));
    ++cells_of_degree[degree];
  }
}

unsigned int ProblemSize::p_min() const
{
  return std::find_if(cells_of_degree.begin(), cells_of_degree.end(),
                      [](const auto n) { return n > 0; }) -
         cells_of_degree.begin();
}

unsigned int ProblemSize::p_max() const
{
  return cells_of_degree.size() - 1;
}

void BoundOfStep::take(const ErrorBound &computed)
{
  missing = std::isfinite(computed.total) ? computed.flaw : "it is not finite";
  imbalance = computed.imbalance;
  if (missing.empty() && computed.kind == BoundKind::estimate)
  {
    missing = computed.why;
    estimate = computed;
  }
  else if (missing.empty())
    bound = computed;
}

template <int dim>
Backend<dim>::Backend(const Scene<dim> &scene, MPI_Comm communicator)
    : scene(scene), communicator(communicator)
{
}

template <int dim>
void Backend<dim>::begin(const std::string &stage, const std::string &note) const
{
  if (on_stage)
    on_stage(stage, note);
}

template <int dim>
std::string Backend<dim>::bound_forces(const ErrorBound &, std::vector<Resultant<dim>> &)
{
  return {};
}

template <int dim>
std::unique_ptr<Backend<dim>> Backend<dim>::ahead(const Refinement &)
{
  return nullptr;
}

template <int dim>
double Backend<dim>::round_off_estimate() const
{
  return round_off_of_estimate(field());
}

template <int dim>
bool Backend<dim>::follow(const std::vector<MeshMarks> &marks)
{
  for (const MeshMarks &mark : marks)
  {
    const Degrees before = degrees();
    if (!mark.fits(before))
      return false;
    refine(mark.refinement(before));
  }
  return true;
}

template <int dim>
bool Backend<dim>::restore_end(const std::vector<MeshMarks> &marks, const SolutionValues &values)
{
  if (!follow(marks))
    return false;
  discretise();
  return restore(values);
}

template <int dim>
std::optional<ReducedPart<dim>> Backend<dim>::reduced() const
{
  return std::nullopt;
}

template <int dim>
double Backend<dim>::energy_high()
{
  return std::numeric_limits<double>::quiet_NaN();
}

template <int dim>
std::optional<PrimalPart<dim>> Backend<dim>::primal() const
{
  return std::nullopt;
}

template <int dim>
bool takes_primal_path(const Scene<dim> &scene, const unsigned int n)
{
  if (scene.solver.path == SolutionPath::reduced && n > 1)
    throw InputError(printable(scene.origin(), 400) +
                     ": Solver/Path = reduced: works on one process, and " + std::to_string(n) +
                     " were started; start one or set Path = primal");
  return dim == 3 || scene.solver.path == SolutionPath::primal || n > 1;
}

template <int dim>
std::unique_ptr<Backend<dim>> make_backend(const Scene<dim> &scene, MPI_Comm communicator)
{
  const bool has_mpi = Utilities::MPI::job_supports_mpi(),
             needs_mpi = dim == 3 || scene.solver.path == SolutionPath::primal;
  if (needs_mpi && !has_mpi)
    throw InputError(printable(scene.origin(), 400) +
                     ": the primal path needs MPI; make a dealii::Utilities::MPI::MPI_InitFinalize "
                     "before the solver");
  if (has_mpi && takes_primal_path(scene, hpvi::n_processes(communicator)))
    return std::make_unique<PrimalBackend<dim>>(scene, communicator);
  if constexpr (dim == 2)
    return std::make_unique<ReducedBackend<dim>>(scene);
  Assert(false, ExcInternalError());
  return nullptr;
}

template class Backend<2>;
template class Backend<3>;
template bool takes_primal_path(const Scene<2> &, unsigned int);
template bool takes_primal_path(const Scene<3> &, unsigned int);
template std::unique_ptr<Backend<2>> make_backend(const Scene<2> &, MPI_Comm);
template std::unique_ptr<Backend<3>> make_backend(const Scene<3> &, MPI_Comm);
} // namespace hpvi
