// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_mesh_marks_h
#define hpvi_mesh_marks_h

#include <hpvi/plane/mesh.h>

#include <utility>
#include <vector>

namespace hpvi
{
/** A Refinement by what it changes: no larger than its marks are, and told without the mesh. */
struct MeshMarks
{
  unsigned int n_cells = 0; ///< of the mesh that is refined
  /** Cells in the order of their indices with their new degrees, 0 where they are bisected. */
  std::vector<std::pair<unsigned int, unsigned int>> changed;

  MeshMarks() = default;
  MeshMarks(const Refinement &refinement, const Degrees &degrees);

  /** Is it one of a mesh with these degrees? */
  bool fits(const Degrees &degrees) const;

  /** The whole of it, on a mesh that it fits. */
  Refinement refinement(const Degrees &degrees) const;
};
} // namespace hpvi

#endif
