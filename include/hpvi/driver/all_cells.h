// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_all_cells_h
#define hpvi_all_cells_h

#include <hpvi/results/field.h>
#include <hpvi/results/residual_estimator.h>

#include <vector>

namespace hpvi
{
/** eta_K by cell_ranks(): the same cells are marked on any number of processes. Collective. */
template <int dim>
std::vector<double> of_all_cells(const ErrorEstimate &estimate, const Field<dim> &field);
} // namespace hpvi

#endif
