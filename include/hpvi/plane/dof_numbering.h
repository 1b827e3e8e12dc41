// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_dof_numbering_h
#define hpvi_dof_numbering_h

#include <deal.II/base/array_view.h>
#include <deal.II/dofs/dof_handler.h>
#include <hpvi/plane/mesh.h>
#include <hpvi/plane/shape_tables.h>

#include <vector>

namespace hpvi
{
/** The unknowns of vector-valued FE_Q of degree p_K on a mesh, before any of them is constrained. */
template <int dim>
class DofNumbering
{
public:
  /**
   * @p degrees by active cell index; the triangulation must outlive the numbering. The finite elements
   * are those of @p tables.
   */
  DofNumbering(const dealii::Triangulation<dim> &triangulation, const Degrees &degrees,
               const ShapeTables<dim> &tables);

  const dealii::DoFHandler<dim> &dof_handler() const;
  const Degrees &degrees() const;

  /**
   * The unknowns of one cell in deal.II's local order: first those on its boundary, then those of
   * its interior. deal.II's own look-up is slow for hp and several stages need it, so it is stored.
   */
  dealii::ArrayView<const dealii::types::global_dof_index> cell_dofs(unsigned int cell) const;

private:
  void store_cell_dofs();

  Degrees cell_degrees;
  dealii::DoFHandler<dim> dofs;
  std::vector<dealii::types::global_dof_index> stored_dofs; ///< of all cells, one after the other
  std::vector<std::size_t> first_stored_dof;
};
} // namespace hpvi

#endif
