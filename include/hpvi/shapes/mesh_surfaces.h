// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_mesh_surfaces_h
#define hpvi_mesh_surfaces_h

#include <hpvi/scene/coarse_mesh.h>

#include <string>
#include <vector>

namespace hpvi
{
/**
 * Of @p mesh the cells of these surfaces, as a body by itself: a curve with a name between them and other cells is a boundary of
 * this name, one without a boundary without a name. All surfaces where @p surfaces is empty.
 */
CoarseMesh surfaces_of(const CoarseMesh &mesh, const std::vector<std::string> &surfaces);

/** How many parts its cells make that no edge connects. */
unsigned int n_parts(const CoarseMesh &mesh);
} // namespace hpvi

#endif
