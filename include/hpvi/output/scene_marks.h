// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_scene_marks_h
#define hpvi_scene_marks_h

#include <hpvi/output/scene_sheet.h>

#include <vector>

namespace hpvi
{
/**
 * One kind of mark along a part of a boundary. It begins @p band pixels outside the body, where other marks end, and
 * returns where it ends itself; what the part does not have takes no room.
 */
using BoundaryMark = double (*)(SceneSheet &sheet, const MarkedPart &marked, double band);

/** Hatching where all components are held; rollers along the component that is held where one is free. */
double draw_support(SceneSheet &sheet, const MarkedPart &marked, double band);

/** A dashed axis along the boundary, and short pairs of strokes across it. */
double draw_symmetry(SceneSheet &sheet, const MarkedPart &marked, double band);

/** A thick bar, with force and moment at the mean point of the boundary. */
double draw_plate(SceneSheet &sheet, const MarkedPart &marked, double band);

/** Zigzags from the body to a line of ground. */
double draw_springs(SceneSheet &sheet, const MarkedPart &marked, double band);

/**
 * The foundation at the distance of the gap, hatched: on rollers where it holds the body both ways, dashed where friction
 * alone acts.
 */
double draw_foundation(SceneSheet &sheet, const MarkedPart &marked, double band);

/** Arrows along `Contact direction`, from the foundation on. */
double draw_contact_direction(SceneSheet &sheet, const MarkedPart &marked, double band);

/** The name of a boundary and what it has, in words. */
double draw_words(SceneSheet &sheet, const MarkedPart &marked, double band);

/** All but the words, in the order in which they stand from the body outwards. */
extern const std::vector<BoundaryMark> boundary_marks;

/** How many times wider than the body the gap of @p marked is drawn: 1 where it can be seen as it is. */
double gap_magnification(const SceneSheet &sheet, const MarkedPart &marked);
} // namespace hpvi

#endif
