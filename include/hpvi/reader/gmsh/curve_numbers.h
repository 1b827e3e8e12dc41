// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_curve_numbers_h
#define hpvi_curve_numbers_h

#include <hpvi/reader/gmsh/cell_edges.h>
#include <hpvi/reader/gmsh/drawing_file.h>

namespace hpvi
{
/**
 * Put what is in no physical group into groups by number: of a file in which no cell of @p dim dimensions has one, surfaces or
 * volumes; of one in which nothing on their boundary has one, curves or surfaces. Curves that @p request names get groups of these names. Throws InputError where the drawing lacks one.
 */
void number_groups(GmshFile &file, unsigned int dim, const DrawingRequest &request,
                   const MeshComplaint &complain);

/**
 * Groups of edges on the boundary in a file without lines: from one corner of more than 30 degrees to the next, from 1 on, by edge of
 * @p edges; @p curves are those of edges, in their own direction.
 */
std::vector<std::int64_t> groups_between_corners(const CoarseMesh &mesh, const CellEdges &edges,
                                                 const std::vector<CurvePiece> &curves,
                                                 const DrawingRequest &request,
                                                 const MeshComplaint &complain);
} // namespace hpvi

#endif
