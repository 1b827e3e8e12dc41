// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_primal_solver_h
#define hpvi_primal_solver_h

#include <hpvi/adaptivity/history.h>
#include <hpvi/adaptivity/progress.h>
#include <hpvi/adaptivity/stage_times.h>
#include <hpvi/evaluation/energies.h>
#include <hpvi/primal/box_equilibrium.h>
#include <hpvi/primal/box_estimate.h>
#include <hpvi/primal/contact_points.h>
#include <hpvi/primal/moment_newton.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace hpvi
{
/**
 * Everything known after one step of the primal path; numbers are those of all processes and the same on each
 * of them, unless it says otherwise. References live until the next step begins.
 */
template <int dim>
struct PrimalReport
{
  unsigned int number = 0; ///< from 1
  const MomentSpace<dim> &space;
  const DistributedVector &u;
  const ErrorEstimate &estimate; ///< of the cells of this process
  dealii::types::global_dof_index n_cells = 0;
  double estimate_volume = 0, estimate_jumps = 0, estimate_neumann = 0, estimate_contact = 0;
  double estimate_normal = 0, estimate_penetration = 0, estimate_tension = 0;
  double total_estimate = 0;  ///< eta
  double scaled_estimate = 0; ///< as StepReport has it, like the next
  double relative_estimate = 0;
  Energies energies{};
  Equilibrium<dim> equilibrium{};
  double peak_memory = 0; ///< that the processes have had so far, their sum [bytes]
  std::vector<MomentPoint<dim>> contact{};      ///< on the first process alone
  std::vector<Penetration<dim>> penetrations{}; ///< by boundary
  NewtonReport newton{};
  StageTimes times{};                  ///< of the first process
  double seconds = 0;                  ///< since the start of the run, without output
  std::string stopped_by{};            ///< empty, or the limit that makes this the last step
  std::vector<std::string> warnings{}; ///< of the last step, complete on the first process
};

/**
 * SOLVE => ESTIMATE => MARK => REFINE on a distributed mesh of boxes, of one degree, by the primal path: Newton's
 * method on displacements and moments of contact, started from the solution on the mesh before.
 * Prints nothing and writes no file.
 */
template <int dim>
class PrimalSolver
{
public:
  /** Collective, as all its functions. Throws InputError where the path does not offer what the scene asks for. */
  PrimalSolver(const Scene<dim> &scene, MPI_Comm communicator);

  ~PrimalSolver();

  /**
   * Runs until a limit of the scene is reached; @p about_to hears of every stage before it begins.
   * Throws NumericalFailure.
   */
  void run(
      const std::function<void(const PrimalReport<dim> &)> &finished_step,
      const std::function<void(const Progress &)> &about_to = [](const Progress &) {});

private:
  struct Stages;
  std::unique_ptr<Stages> stages;
};
} // namespace hpvi

#endif
