// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_cell_checks_h
#define hpvi_cell_checks_h

#include <hpvi/reader/gmsh/cell_edges.h>

namespace hpvi
{
/** The angle in degrees, in [0,360), to the left between two directions: from the first to the second. */
double degrees_between(const dealii::Tensor<1, 2> &one, const dealii::Tensor<1, 2> &two);

/**
 * Turn clockwise cells round. Throws InputError where one is no convex quadrilateral: corners with straight edges
 * must have more than 0.1 and less than 179.9 degrees. Messages name cells by their @p numbers in the file.
 */
void orient_cells(CoarseMesh &mesh, const std::vector<std::size_t> &numbers,
                  const MeshComplaint &complain);

/** Throws InputError where cells overlap, or have hanging nodes. */
void check_connection(const CoarseMesh &mesh, const CellEdges &edges,
                      const MeshComplaint &complain);
} // namespace hpvi

#endif
