// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_global_cell_indices_h
#define hpvi_global_cell_indices_h

#include <deal.II/grid/tria.h>

#include <vector>

namespace hpvi
{
/**
 * By active_cell_index, of the cells of this process: which one each is of all active cells, by coarse cell and then child
 * by child, however many processes share them. (global_active_cell_index counts process by process.) On a mesh of one
 * process alone active_cell_index itself. Collective.
 */
template <int dim>
std::vector<dealii::types::global_cell_index>
global_cell_indices(const dealii::Triangulation<dim> &mesh);
} // namespace hpvi

#endif
