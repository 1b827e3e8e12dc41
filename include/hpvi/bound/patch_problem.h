// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_patch_problem_h
#define hpvi_patch_problem_h

#include <hpvi/algebra/dense_algebra.h>
#include <hpvi/bound/equilibration_cache.h>
#include <hpvi/bound/vertex_patches.h>

#include <array>
#include <vector>

namespace hpvi
{
/** What a patch sees of an element: energy and conditions of the tractions on its faces. */
struct TractionEnergy
{
  unsigned int n_normal, n_tangential, n_conditions;
  DensePart G, N; ///< n_edges() x n_edges(), n_edges() x n_conditions

  unsigned int n_edges() const
  {
    return 4 * (n_normal + n_tangential);
  }

  /** Place of a coefficient of the traction of @p face among those of all faces. */
  unsigned int edge_entry(const unsigned int face, const unsigned int tangential) const
  {
    return face * (n_normal + n_tangential) + tangential * n_normal;
  }
};

TractionEnergy traction_energy(const StressElement &element);
TractionEnergy traction_energy(const MacroStressElement &element);

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
