// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_bent_lines_h
#define hpvi_bent_lines_h

#include <hpvi/reader/gmsh/drawing_file.h>

namespace hpvi
{
/**
 * Lines of the groups that `Curve` bends get circles or splines before cells are cut, so that new vertices lie on them. What does not
 * fit stays straight. A group of straight edges on a circle that no `Curve` names is told, if there are triangles, for later its vertices
 * are on none.
 */
void bend_lines(GmshFile &file, const DrawingRequest &request);
} // namespace hpvi

#endif
