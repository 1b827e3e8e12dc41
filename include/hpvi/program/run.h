// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_run_h
#define hpvi_run_h

#include <hpvi/scene/scene.h>

#include <string>

namespace hpvi
{
/**
 * Runs a scene on all processes that were started: a row for each step, then what became of contact, supports and
 * balance; files into @p directory. Throws InputError, NumericalFailure, OutputFailure or Interruption.
 */
template <int dim>
void run(const Scene<dim> &scene, const std::string &directory);

/** Goes on after the last step whose state @p directory has. */
template <int dim>
void resume(const Scene<dim> &scene, const std::string &directory);
} // namespace hpvi

#endif
