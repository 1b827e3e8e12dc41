// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_displacement_space_h
#define hpvi_displacement_space_h

#include <deal.II/base/array_view.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/lac/affine_constraints.h>
#include <hpvi/body/mesh.h>
#include <hpvi/body/shape_tables.h>
#include <hpvi/scene/scene.h>

namespace hpvi
{
/**
 * The space V_N of (3.57): vector-valued tensor-product polynomials of degree p_K, continuous by
 * the minimum rule. All of its side conditions are affine constraints: hanging nodes and jumps in
 * degree, prescribed displacements (any value), and `u_n = 0` under bilateral contact.
 */
template <int dim>
class DisplacementSpace
{
public:
  /**
   * @p degrees by active cell index; the triangulation must outlive the space. The finite elements
   * are those of @p tables.
   */
  DisplacementSpace(const Scene<dim> &scene, const dealii::Triangulation<dim> &triangulation,
                    const Degrees &degrees, const ShapeTables<dim> &tables);

  const dealii::Triangulation<dim> &triangulation() const;
  const dealii::DoFHandler<dim> &dof_handler() const;
  const dealii::AffineConstraints<double> &constraints() const;
  const Degrees &degrees() const;

  unsigned int n_dofs() const;      ///< before constraints are eliminated (`dofs`)
  unsigned int n_free_dofs() const; ///< after (`dofs_free`, the N of every rate)

  /**
   * The unknowns of one cell in deal.II's local order: first those on its boundary, then those of
   * its interior. deal.II's own look-up is slow for hp and several stages need it, so it is stored.
   */
  dealii::ArrayView<const dealii::types::global_dof_index> cell_dofs(unsigned int cell) const;

private:
  void make_constraints(const Scene<dim> &scene, const ShapeTables<dim> &tables);
  void store_cell_dofs();

  Degrees cell_degrees;
  dealii::DoFHandler<dim> dofs;
  dealii::AffineConstraints<double> affine_constraints;
  std::vector<dealii::types::global_dof_index> stored_dofs; ///< of all cells, one after the other
  std::vector<std::size_t> first_stored_dof;
};
} // namespace hpvi

#endif
