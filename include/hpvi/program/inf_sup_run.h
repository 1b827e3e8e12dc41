// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_inf_sup_run_h
#define hpvi_inf_sup_run_h

#include <hpvi/scene/scene.h>

namespace hpvi
{
/** `hpvi --inf-sup`: measure_inf_sup() on the mesh of each step of a run, a row for each. Throws as run(). */
void print_inf_sup(const Scene<2> &scene);
} // namespace hpvi

#endif
