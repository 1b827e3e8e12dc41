// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_probe_marks_h
#define hpvi_probe_marks_h

#include <hpvi/output/scene_sheet.h>

#include <string>
#include <vector>

namespace hpvi
{
/** As in "probe tip: at (1, 0)", "probe core: mean over the disc of radius 0.1 mm about (1, 0)"; a line each. */
template <int dim>
std::string probes_in_words(const Scene<dim> &scene);

/** A cross at a point, a disc as it is, a line along a boundary inside of the body, a row of dots; each with its name. */
void draw_probes(SceneSheet &sheet, const std::vector<OutlinePart> &parts);
} // namespace hpvi

#endif
