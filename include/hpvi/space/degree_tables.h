// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_degree_tables_h
#define hpvi_degree_tables_h

#include <hpvi/scene/scene.h>
#include <hpvi/space/box_tables.h>

#include <deal.II/dofs/dof_handler.h>

#include <deque>
#include <vector>

namespace hpvi
{
/** The BoxTables of a mesh: those of one degree, or where bodies have degrees of their own one for each of these. */
template <int dim>
class DegreeTables
{
public:
  using Cell = typename dealii::Triangulation<dim>::cell_iterator;

  explicit DegreeTables(unsigned int degree);     ///< of all cells
  explicit DegreeTables(const Scene<dim> &scene); ///< which must outlive it
  DegreeTables(const DegreeTables &) = delete;

  /** Number in #all of the tables of @p cell, active or not. */
  unsigned int number_of(const Cell &cell) const;

  const BoxTables<dim> &of(const Cell &cell) const
  {
    return all[number_of(cell)];
  }

  /** Of the only degree. */
  const BoxTables<dim> &only() const;

  /** Puts the unknowns on @p cell, in the numbering of its tables, which it returns, into @p dofs. */
  template <class DofCell>
  const BoxTables<dim> &take_dofs(const DofCell &cell,
                                  std::vector<dealii::types::global_dof_index> &dofs) const
  {
    const BoxTables<dim> &own = of(cell);
    dofs.resize(own.fe.dofs_per_cell);
    cell->get_dof_indices(dofs);
    return own;
  }

  /** Collective. */
  void distribute_dofs(dealii::DoFHandler<dim> &dof_handler) const;

  std::deque<BoxTables<dim>> all; ///< in the order of the first bodies that have them

private:
  const Geometry<dim> *geometry = nullptr; ///< null: there is one degree
  std::vector<unsigned int> of_body;       ///< numbers in #all, where there are several
};
} // namespace hpvi

#endif
