// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_vtu_h
#define hpvi_vtu_h

#include <hpvi/adaptivity/step_report.h>
#include <hpvi/output/record.h>
#include <hpvi/primal/primal_solver.h>

#include <string>
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

/** Name a file in `solution.pvd`, by which ParaView opens all of them; @p time is the step, or the time of a history. */
void add_to_pvd(GrowingText &pvd, double time, const std::string &file);
} // namespace hpvi

#endif
