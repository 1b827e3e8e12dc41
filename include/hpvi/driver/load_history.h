// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_load_history_h
#define hpvi_load_history_h

#include <hpvi/driver/adaptive_solver.h>

#include <functional>
#include <memory>
#include <optional>

namespace hpvi
{
/**
 * Quasi-static evolution: one AdaptiveSolver for each load step of a scene. The displacement u^k of load
 * step k satisfies, with du = u - u^(k-1),
 *
 *     a(u, v - u) + int g_k |du_t + v_t - u_t| - int g_k |du_t| >= L_k(v - u)   for all v,
 *
 * which is the problem without history but for the past slip u_t^(k-1), an argument of its spaces. Meshes are
 * nested, so that it is handed on without error. A scene without history is one load step.
 */
template <int dim>
class LoadHistory
{
public:
  /** Throws InputError where the scene or that of a load step does not pass check(). */
  explicit LoadHistory(const Scene<dim> &scene, MPI_Comm communicator = MPI_COMM_SELF);

  /** Goes on as AdaptiveSolver does, in a history of loads after its last finished load step. Throws InputError likewise. */
  LoadHistory(const Scene<dim> &scene, const RunState<dim> &state,
              MPI_Comm communicator = MPI_COMM_SELF);

  ~LoadHistory();

  /** AdaptiveSolver::state(); in a history of loads at the end of a load step alone. */
  std::optional<RunState<dim>> state() const;

  /** AdaptiveSolver::prepare(), of the first load step, for what is refused before anything is written; run() says what fails. */
  void prepare(const std::function<void(const Progress &)> &on_stage = [](const Progress &) {});

  /**
   * As AdaptiveSolver::run(), for all load steps in turn: StepReport::number counts on, and
   * StepReport::stopped_by says of each load step why it is done: as AdaptiveSolver does, or
   * Stop::load_step, as small as whose error those after it are where the scene names no tolerance, or
   * Stop::first_step. The last one has the warnings of all, of each kind the worst with its load step.
   * Throws NumericalFailure and InputError, which name the load step.
   */
  void run(
      const std::function<void(const StepReport<dim> &)> &finished_step,
      const std::function<void(const Progress &)> &on_stage = [](const Progress &) {});

private:
  struct Evolution;
  std::unique_ptr<Evolution> evolution;
};
} // namespace hpvi

#endif
