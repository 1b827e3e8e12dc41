// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_tolerances_h
#define hpvi_tolerances_h

namespace hpvi
{
/**
 * What counts as the same wherever it is asked for. Where an iteration ends, a search begins or a sum is round-off is said
 * where it is done, and data beside others in scene/data_scale.h.
 */
constexpr double same_place = 1e-9, ///< of the size of bodies: no distance
    same_on_edge = 1e-9,            ///< of an edge or a cell: round-off of ends that meet
    on_body = 2e-10,                ///< of its radius: what lies no more outside of a body is on it
    same_cut = 1e-12,               ///< of the unit interval: cuts of a rule that are one
    same_box = 1e-12,               ///< of its size
    same_normal = 1e-9,             ///< of unit vectors: what is straight or parallel as drawn
    same_direction = 1e-12,         ///< of unit vectors: as round-off leaves them
    repeated_direction = 1e-6,      ///< of unit vectors: conditions along them say the same
    shown_as_zero = 1e-12,          ///< of what stands beside it in words and tables
    unseen_in_picture = 1e-9;       ///< of what a picture shows
} // namespace hpvi

#endif
