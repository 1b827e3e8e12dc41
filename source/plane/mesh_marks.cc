// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/plane/mesh_marks.h>

namespace hpvi
{
MeshMarks::MeshMarks(const Refinement &refinement, const Degrees &degrees) : n_cells(degrees.size())
{
  for (unsigned int cell = 0; cell < n_cells; ++cell)
    if (refinement.bisect[cell])
      changed.emplace_back(cell, 0);
    else if (refinement.degrees[cell] != degrees[cell])
      changed.emplace_back(cell, refinement.degrees[cell]);
}

bool MeshMarks::fits(const Degrees &degrees) const
{
  return n_cells == degrees.size() && (changed.empty() || changed.back().first < n_cells);
}

Refinement MeshMarks::refinement(const Degrees &degrees) const
{
  Refinement result{std::vector<bool>(degrees.size()), degrees};
  for (const auto &[cell, degree] : changed)
    if (degree == 0)
      result.bisect[cell] = true;
    else
      result.degrees[cell] = degree;
  return result;
}
} // namespace hpvi
