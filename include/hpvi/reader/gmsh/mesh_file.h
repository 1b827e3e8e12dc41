// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_mesh_file_h
#define hpvi_mesh_file_h

#include <hpvi/reader/gmsh/drawing_file.h>
#include <hpvi/scene/coarse_mesh.h>

#include <string>
#include <vector>

namespace hpvi
{
/**
 * The body in the drawing or mesh file @p path: cells in a plane z = const, whatever their kind, which make_quadrilaterals() cuts
 * where they have to be. Boundaries, interfaces and surfaces are physical groups in the order of their tags; one without a name
 * is called by its tag. Where a file has no physical curves, each curve is called by its number; where it has no lines either, edges
 * are numbered from one corner of more than 30 degrees to the next. Curves that the request names are called so.
 *
 * Where @p surfaces are named, the body consists of these, and the file counts as if it had no others: a curve between one of
 * them and another is a boundary, and nodes of others may lie where these have theirs. CoarseMesh::surfaces still names all of the
 * file; where it has none of those that are named, there are no cells.
 *
 * Edges of the boundary stand loop by loop, each where the one before it ends, and a loop begins where a boundary
 * begins. Those inside run counterclockwise around the cell of the surface with the lower number. Curves are those of the drawing,
 * and of middle nodes off the chord by more than 1e-10 of its length, on the boundary, on named curves and between surfaces;
 * middles of other edges, and centres, are ignored.
 *
 * Of cells and edges in several physical groups the smallest counts.
 *
 * Throws InputError of one line (file, element where it has a number, problem, remedy) for all else: a file that is
 * missing or damaged; cells that are in no group beside others that are, folded, or not one part connected
 * through edges; nodes outside the plane, twice at one place (to 1e-12 of the size) or hanging; edges in a group
 * and of no cell; a group that lies on the boundary and inside; names that a scene cannot write.
 */
CoarseMesh read_mesh_file(const std::string &path, const std::vector<std::string> &surfaces = {},
                          const DrawingRequest &request = {});
} // namespace hpvi

#endif
