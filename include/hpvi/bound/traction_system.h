// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_traction_system_h
#define hpvi_traction_system_h

#include <hpvi/bound/patch_problem.h>

#include <vector>

namespace hpvi
{
/** The largest |N'r| that is left: of which cell, and at which of its corners, or none where it is about equilibrium. */
struct WorstCondition
{
  double missed = 0;
  unsigned int cell = 0, corner = dealii::numbers::invalid_unsigned_int;
};

/**
 * The problem of a patch, PatchProblem, for all cells and edges of a mesh at once, with one sparse factorisation: the nearest
 * stress to sigma(u_N), without hat functions. @p cells have the data of sigma(u_N) itself, @p edges stand in the order of
 * VertexPatches. Throws NumericalFailure.
 */
WorstCondition solve_all(const std::vector<PatchCell> &cells, const std::vector<PatchEdge> &edges,
                         const LegendreTables &legendre);
} // namespace hpvi

#endif
