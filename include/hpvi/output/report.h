// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_report_h
#define hpvi_report_h

#include <hpvi/scene/scene.h>

#include <string>

namespace hpvi
{
/**
 * What `report.html` says of a run, one page that needs neither a network nor scripts, to be read and printed: how the run ended, the
 * answer, the scene, stress on the deformed body, contact, convergence, mesh, forces, warnings, and what repeats it. All but
 * the scene comes from the files in @p directory and from @p summary, the text of its summary.json; where one of them
 * was switched off, its part says so. Reports of equal runs are equal but for the line of seconds. Throws InputError where these are no
 * results of a run.
 */
template <int dim>
std::string report(const Scene<dim> &scene, const std::string &directory,
                   const std::string &summary);
} // namespace hpvi

#endif
