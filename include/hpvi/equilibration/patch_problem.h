// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_patch_problem_h
#define hpvi_patch_problem_h

#include <hpvi/algebra/dense_algebra.h>
#include <hpvi/equilibration/legendre.h>
#include <hpvi/equilibration/stress_element.h>
#include <hpvi/equilibration/vertex_patches.h>

#include <map>
#include <memory>
#include <vector>

namespace hpvi
{
/** What a patch problem depends on besides its data: its matrices, factored. */
struct PatchFactor
{
  unsigned int n = 0, n_conditions = 0;
  std::vector<double> H;          ///< n x n: L of the energy of the unknown tractions
  std::vector<double> conditions; ///< n x n_conditions: columns C
  std::vector<double> W;          ///< L^-1 C
  PivotedCholesky S;              ///< W'W
};

/** What a run keeps from step to step: elements by class, patches by signature. */
struct EquilibrationCache
{
  using Signature = std::vector<long>;
  LegendreTables legendre;
  std::map<Signature, std::unique_ptr<const StressElement>> elements;
  std::map<Signature, PatchFactor> patches;
};

/** Of one cell with one hat function: data without tractions, seen by its element. */
struct PatchCell
{
  const StressElement *element;
  double area;            ///< h^2 of the element
  const double *gradient; ///< G r on the edges, n_edges
  const double *defect;   ///< N' r
  const VertexPatches::Cell *cell;
};

/** A traction on one edge of a patch. */
struct PatchEdge
{
  const StressEdge *edge;
  /** Coefficients of both components: given, or to be found. */
  std::array<std::vector<double>, 2> traction;
};

/**
 * Tractions on the edges of a patch such that `sum_K h_K^2 r_K' G_K r_K` is least subject to
 * `N_K' r_K = 0` in each cell, where r_K are the data of @p cells and the tractions. Those of components that are
 * unknown are found. Returns the largest |N'r| that is left.
 */
double solve_patch(const std::vector<PatchCell> &cells, std::map<unsigned int, PatchEdge> &edges,
                   EquilibrationCache &cache);
} // namespace hpvi

#endif
