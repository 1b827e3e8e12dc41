// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_vtu_h
#define hpvi_vtu_h

#include <hpvi/adaptivity/step_report.h>
#include <hpvi/primal/primal_solver.h>

#include <string>
#include <utility>
#include <vector>

namespace hpvi
{
/**
 * `solution-NN.vtu`: displacement, stress, degree and eta_K on linear cells, subdivided as finely as
 * the highest degree asks for, up to a readable file.
 */
template <int dim>
std::string vtu(const StepReport<dim> &step);

/** One step of the primal path. */
struct PrimalVtu
{
  std::string piece; ///< `solution-NN.RANK.vtu`, the cells of this process
  std::string index; ///< `solution-NN.pvtu`, which names all pieces
};

/** The same fields of the primal path, the names of its @p pieces by rank. */
template <int dim>
PrimalVtu vtu(const PrimalReport<dim> &step, const std::vector<std::string> &pieces);

/** `solution.pvd`: pairs of step, or time, and file name in order, to be opened at once. */
std::string pvd(const std::vector<std::pair<double, std::string>> &files);
} // namespace hpvi

#endif
