// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/adaptivity/load_history.h>
#include <hpvi/base/input_error.h>
#include <hpvi/base/text.h>
#include <hpvi/contact/tangential_trace.h>
#include <hpvi/discretisation/interpolation.h>
#include <hpvi/scene/data_scale.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <set>
#include <vector>

namespace hpvi
{
using namespace dealii;

namespace
{
/** What a warning says before its first number or place. */
std::string kind(const std::string &warning)
{
  return warning.substr(0, warning.find_first_of("(0123456789"));
}

/** The first number of a warning outside its parentheses, where places stand: how bad it is; without one 0. */
double severity(const std::string &warning)
{
  unsigned int depth = 0;
  for (std::size_t k = 0; k < warning.size(); ++k)
    if (depth == 0 && std::isdigit(static_cast<unsigned char>(warning[k])))
      return std::strtod(&warning[k], nullptr);
    else
      depth += warning[k] == '(' ? 1 : warning[k] == ')' ? -1 : 0;
  return 0.;
}

/** The end of a load step: the mesh and the slip with which the next begins. */
template <int dim>
struct Past
{
  std::shared_ptr<const Scene<dim>> scene; ///< of the solution, which it has to outlive
  Solution<dim> solution;
  typename AdaptiveSolver<dim>::Start start;
};
} // namespace

template <int dim>
struct LoadHistory<dim>::Evolution
{
  const Scene<dim> &scene;
  std::shared_ptr<const Scene<dim>> current; ///< the scene of the load step
  std::unique_ptr<AdaptiveSolver<dim>> solver;
  std::optional<Past<dim>> past;
  LoadStep load;
  unsigned int n_steps = 0; ///< of finished load steps
  double seconds = 0;       ///< likewise
  unsigned int first = 0;   ///< load step with an error; 0: none yet
  double tolerance = 0;     ///< that it sets for those after it
  std::vector<std::string> warnings;

  explicit Evolution(const Scene<dim> &scene);

  void begin(unsigned int number);
  bool keeps_mesh() const;
  StepReport<dim> report(const StepReport<dim> &step) const;
  std::string reason(const std::string &stopped_by) const;
  void conclude(StepReport<dim> &report);
  void collect(StepReport<dim> &report);
  std::string place() const;
};

template <int dim>
LoadHistory<dim>::Evolution::Evolution(const Scene<dim> &scene) : scene(scene)
{
  if (scene.has_load_history())
  {
    scene.check();
    begin(1);
  }
  else
    solver = std::make_unique<AdaptiveSolver<dim>>(scene);
}

template <int dim>
void LoadHistory<dim>::Evolution::begin(const unsigned int number)
{
  load.number = number;
  load.t = scene.loading.time(number);
  const auto next = std::make_shared<Scene<dim>>(
      load_step(scene, number, current ? data_scale(*current) : DataScale()));
  if (!past)
  {
    current = next;
    solver = std::make_unique<AdaptiveSolver<dim>>(*current);
    return;
  }
  const Solution<dim> &last = past->solution;
  for (BoundaryCondition<dim> &boundary : next->boundaries)
    if (boundary.has_contact() && boundary.friction)
      boundary.friction.past = std::make_shared<const TangentialTrace<dim>>(
          last.contact_space, last.displacement_space, last.tables, last.u, boundary.id);
  if (keeps_mesh())
    next->adaptivity.maximum_steps = 1;
  if (next->adaptivity.tolerance == 0)
  {
    next->adaptivity.tolerance = tolerance;
    next->adaptivity.tolerance_on = Indicator::residual;
  }
  current = next;
  solver = std::make_unique<AdaptiveSolver<dim>>(*current, past->start);
}

/** What is exact on the coarse mesh, as no load at all, says nothing of the mesh that others need. */
template <int dim>
bool LoadHistory<dim>::Evolution::keeps_mesh() const
{
  return scene.loading.adapt == LoadAdaptivity::first_step && first > 0 && first < load.number;
}

/** Why the load step is done, where that is no limit that the scene names. */
template <int dim>
std::string LoadHistory<dim>::Evolution::reason(const std::string &stopped_by) const
{
  if (stopped_by == "Tolerance" && scene.adaptivity.tolerance == 0)
    return "error of load step " + std::to_string(first);
  return stopped_by == "Maximum steps" && keeps_mesh() ? "Adapt = first step" : stopped_by;
}

/** @p step, one of the load step, as one of the whole run. */
template <int dim>
StepReport<dim> LoadHistory<dim>::Evolution::report(const StepReport<dim> &step) const
{
  StepReport<dim> result = step;
  result.number += n_steps;
  result.seconds += seconds;
  result.load = load;
  return result;
}

/** The last step of a load step: what the load step did, and what the next one starts from. */
template <int dim>
void LoadHistory<dim>::Evolution::conclude(StepReport<dim> &report)
{
  const Solution<dim> &solution = report.solution;
  const Vector<double> &loads = report.system.loads();
  const Work done = past ? work(carry(past->solution, *solution.spaces), solution, loads)
                         : work_from_rest(solution, loads);
  load.work += done.external;
  load.dissipated += done.dissipated;
  load.released += done.released;
  load.unbalanced += done.unbalanced;
  load.stored = 0.5 * report.energies.norm * report.energies.norm;
  report.load = load;
  n_steps = report.number;
  seconds = report.seconds;
  report.stopped_by = reason(report.stopped_by);
  if (first == 0 && report.stopped_by != "round-off")
  {
    first = load.number;
    tolerance = 1.2 * report.relative_estimate;
  }
  past.emplace(Past<dim>{current, solution, solver->end()});
  collect(report);
}

/** The last load step says what there was to say of all, each with the numbers of the worst. */
template <int dim>
void LoadHistory<dim>::Evolution::collect(StepReport<dim> &report)
{
  const bool is_last = load.number == scene.loading.steps;
  for (const std::string &warning : report.warnings)
  {
    const auto known =
        std::find_if(warnings.begin(), warnings.end(),
                     [&](const std::string &other) { return kind(other) == kind(warning); });
    const std::string line = warning + " (" + place() + ")";
    if (known == warnings.end())
      warnings.push_back(line);
    else if (severity(warning) > severity(*known))
      *known = line;
  }
  if (is_last)
    report.warnings = warnings;
}

/** As in "load step 3, t = 0.15", for messages. */
template <int dim>
std::string LoadHistory<dim>::Evolution::place() const
{
  return "load step " + std::to_string(load.number) + ", t = " + to_string(load.t);
}

template <int dim>
LoadHistory<dim>::LoadHistory(const Scene<dim> &scene)
    : evolution(std::make_unique<Evolution>(scene))
{
}

template <int dim>
LoadHistory<dim>::~LoadHistory() = default;

template <int dim>
void LoadHistory<dim>::prepare(const std::function<void(const Progress &)> &about_to)
{
  evolution->solver->prepare(about_to);
}

template <int dim>
void LoadHistory<dim>::run(const std::function<void(const StepReport<dim> &)> &finished_step,
                           const std::function<void(const Progress &)> &about_to)
{
  if (!evolution->scene.has_load_history())
  {
    evolution->solver->run(finished_step, about_to);
    return;
  }
  const auto take = [&](const StepReport<dim> &step)
  {
    StepReport<dim> report = evolution->report(step);
    if (!step.stopped_by.empty())
      evolution->conclude(report);
    finished_step(report);
  };
  const auto announce = [&](const Progress &progress)
  {
    about_to({progress.step + evolution->n_steps, evolution->place() + ": " + progress.stage,
              progress.note});
  };
  try
  {
    for (unsigned int k = 1; k <= evolution->scene.loading.steps; ++k)
    {
      if (k > 1)
        evolution->begin(k);
      evolution->solver->run(take, announce);
    }
  }
  catch (const NumericalFailure &failure)
  {
    throw NumericalFailure(evolution->place() + ": " + failure.what());
  }
  catch (const InputError &error)
  {
    const std::string line = error.what();
    const bool says_when = line.find(" t = ") != std::string::npos;
    throw InputError(line + (says_when ? "" : " (" + evolution->place() + ")"));
  }
}

template class LoadHistory<2>;
} // namespace hpvi
