// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_adaptive_solver_h
#define hpvi_adaptive_solver_h

#include <hpvi/adaptivity/checkpoint.h>
#include <hpvi/adaptivity/progress.h>
#include <hpvi/adaptivity/step_report.h>
#include <hpvi/algebra/factored_system.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/contact/multiplier_trace.h>

#include <functional>
#include <memory>

namespace hpvi
{
/**
 * SOLVE => ESTIMATE => MARK => REFINE (thesis, Section 4.3) for one scene. Owns the stages; prints
 * nothing and writes no file: each finished step goes to a callback.
 */
template <int dim>
class AdaptiveSolver
{
public:
  /** Where a run begins that takes over the mesh of another one. */
  struct Start
  {
    std::shared_ptr<const dealii::Triangulation<dim>> mesh;
    Degrees degrees;
    MultiplierTrace<dim> multiplier;                ///< a guess; zero unless it is wanted
    dealii::Vector<double> motion;                  ///< likewise, of the free motions of the scene
    std::shared_ptr<const ShapeTables<dim>> tables; ///< of both
    std::shared_ptr<FactoredSystem> factored; ///< used where the new system is the same; or null
  };

  /**
   * Throws InputError where the scene does not pass Scene::check(), or has a load history, which is for
   * LoadHistory.
   */
  explicit AdaptiveSolver(const Scene<dim> &scene);

  /** The same from @p start, of a scene of the same body. */
  AdaptiveSolver(const Scene<dim> &scene, const Start &start);

  /**
   * Goes on after the step in which @p state was taken, to the same numbers as if the run had not been
   * broken off. Throws InputError where @p scene is not that of the state, limits, output and labels
   * aside, or where its limits leave no step to take.
   */
  AdaptiveSolver(const Scene<dim> &scene, const RunState &state);

  ~AdaptiveSolver();

  /**
   * The beginning of run(), up to the last that the first step asks the functions of the scene for. Throws
   * InputError where they are no good between the points at which Scene::check() has tried them.
   */
  void prepare(const std::function<void(const Progress &)> &about_to = [](const Progress &) {});

  /**
   * Runs until a limit of the scene is reached; @p about_to hears of every stage before it begins, and
   * may throw to give up the step. Until it returns, in the callbacks too, dense algebra has
   * OneThread. Throws NumericalFailure.
   */
  void run(
      const std::function<void(const StepReport<dim> &)> &finished_step,
      const std::function<void(const Progress &)> &about_to = [](const Progress &) {});

  /** What it takes to go on after @p step; to be asked while its callback lasts. */
  RunState state(const StepReport<dim> &step) const;

  /** For a run that takes over from the step at hand; to be asked while its callback lasts. */
  Start end() const;

private:
  struct Stages;
  std::unique_ptr<Stages> stages;
};
} // namespace hpvi

#endif
