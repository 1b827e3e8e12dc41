// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_adaptive_solver_h
#define hpvi_adaptive_solver_h

#include <hpvi/adaptivity/progress.h>
#include <hpvi/adaptivity/step_report.h>
#include <hpvi/base/numerical_failure.h>

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
  /** Throws InputError where the scene does not pass Scene::check(). */
  explicit AdaptiveSolver(const Scene<dim> &scene);
  ~AdaptiveSolver();

  /**
   * Runs until a limit of the scene is reached; @p about_to hears of every stage before it begins, and
   * may throw to give up the step. Until it returns, in the callbacks too, dense algebra has
   * OneThread. Throws NumericalFailure.
   */
  void run(
      const std::function<void(const StepReport<dim> &)> &finished_step,
      const std::function<void(const Progress &)> &about_to = [](const Progress &) {});

private:
  struct Stages;
  std::unique_ptr<Stages> stages;
};
} // namespace hpvi

#endif
