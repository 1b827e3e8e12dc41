// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_report_plots_h
#define hpvi_report_plots_h

#include <hpvi/output/run_files.h>
#include <hpvi/scene/scene.h>

#include <string>

namespace hpvi
{
/** Error, bound and indicator over free unknowns; over load steps where those of a history are many. HTML. */
std::string convergence_plot(const RunFiles &files);

/** Tractions and states of each contact over its arc length, in space on its surface. HTML; empty: there is no contact. */
template <int dim>
std::string contact_plots(const Scene<dim> &scene, const RunFiles &files);

/** Force over displacement of boundaries that are moved, and what becomes of energies and contact over t. HTML. */
template <int dim>
std::string loading_plots(const Scene<dim> &scene, const RunFiles &files);
} // namespace hpvi

#endif
