// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_arrow_rows_h
#define hpvi_arrow_rows_h

#include <hpvi/output/scene_sheet.h>

#include <vector>

namespace hpvi
{
/**
 * Arrows of the traction along a part of a boundary, to scale with all others, and the size of the largest. What pushes
 * has its head at the body, what pulls its tail. They begin @p band pixels outside the body; returns where they end.
 */
double draw_tractions(SceneSheet &sheet, const MarkedPart &marked, double band);

/** The same of prescribed displacements that are not 0, with open heads. */
double draw_displacements(SceneSheet &sheet, const MarkedPart &marked, double band);

/** One arrow from the centre of the body, for the mean body force at @p points, with its size. */
void draw_body_force(SceneSheet &sheet, const dealii::Triangulation<2> &mesh);
} // namespace hpvi

#endif
