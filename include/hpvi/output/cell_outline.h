// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_cell_outline_h
#define hpvi_cell_outline_h

#include <hpvi/plane/cell_map.h>

#include <vector>

namespace hpvi
{
/** Points along a face, its first vertex to its second: of a straight one both, of a curved one enough to look smooth. */
std::vector<dealii::Point<2>> face_line(const CellMap<2> &map, unsigned int face);

/** Around the cell counterclockwise, each point once. */
std::vector<dealii::Point<2>> cell_outline(const CellMap<2> &map);
} // namespace hpvi

#endif
