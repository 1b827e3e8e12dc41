// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_step_ahead_h
#define hpvi_step_ahead_h

#include <hpvi/driver/backend.h>

#include <exception>
#include <functional>
#include <memory>

namespace hpvi
{
/**
 * The next step, solved while the team still finds out what is to be told of this one: the bound needs this mesh and its
 * solution, the next solution neither, so that two threads have work all the time.
 */
template <int dim>
class StepAhead
{
public:
  /**
   * Solves @p next on the calling thread, which is the one that hears of stages, beside @p tell of @p here, whose own stages are silent.
   * Seconds of both are shares of the time that they take together. Throws what tell() throws.
   */
  StepAhead(std::unique_ptr<Backend<dim>> next, Backend<dim> &here,
            const std::function<void()> &tell);

  /** The next step in the place of this one; throws what solving it has thrown. */
  std::unique_ptr<Backend<dim>> take();

private:
  std::unique_ptr<Backend<dim>> next;
  std::exception_ptr failure; ///< of the next step, which must not keep this one from being told
};
} // namespace hpvi

#endif
