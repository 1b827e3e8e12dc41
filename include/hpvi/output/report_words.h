// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_report_words_h
#define hpvi_report_words_h

#include <hpvi/output/run_files.h>
#include <hpvi/scene/scene.h>

#include <string>

namespace hpvi
{
/** How the run ended, before all else; what was not done does not look like a result. HTML, as all that follows. */
std::string ending_words(const JsonTree &summary, const Adaptivity &adaptivity);

/** The answer: error, forces and zones of each contact, largest displacement and stress with their places, probes. */
template <int dim>
std::string answer_words(const Scene<dim> &scene, const RunFiles &files);
} // namespace hpvi

#endif
