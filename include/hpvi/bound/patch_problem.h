// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_patch_problem_h
#define hpvi_patch_problem_h

#include <hpvi/bound/equilibration_cache.h>
#include <hpvi/bound/traction_energy.h>
#include <hpvi/bound/vertex_patches.h>

#include <array>
#include <vector>

namespace hpvi
{
TractionEnergy traction_energy(const StressElement &element);

/** Of one cell with one hat function: data without tractions, seen by its element. */
struct PatchCell
{
  TractionEnergy element;
  double area;            ///< h^2 of the element
  const double *gradient; ///< G r on the edges, n_edges
  const double *defect;   ///< N' r
  const VertexPatches::Cell *cell;
};

/** One edge of a patch: coefficients of both components of tractions. */
struct PatchEdge
{
  unsigned int index; ///< of the edge
  const StressEdge *edge;
  const std::array<std::vector<double>, 2> *known; ///< at the boundary: the components given there
  std::array<std::vector<double>, 2>
      *sum; ///< tractions that are unknown are added; holds the others
};

/** What tractions miss of the conditions |N'r| of a patch: in equilibrium, and at corners where two edges ask for one shear. */
struct PatchDefect
{
  double equilibrium = 0, corners = 0;
};
} // namespace hpvi

#endif
