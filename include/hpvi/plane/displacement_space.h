// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_displacement_space_h
#define hpvi_displacement_space_h

#include <deal.II/lac/affine_constraints.h>
#include <hpvi/plane/dof_numbering.h>
#include <hpvi/plane/load_rule.h>
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
   * are those of @p tables, the rules for data of the scene @p rules, which must outlive the space.
   */
  DisplacementSpace(const Scene<dim> &scene, const dealii::Triangulation<dim> &triangulation,
                    const Degrees &degrees, const ShapeTables<dim> &tables,
                    const LoadRules<dim> *rules = nullptr);

  const DofNumbering<dim> &numbering() const;
  const dealii::Triangulation<dim> &triangulation() const;
  const dealii::DoFHandler<dim> &dof_handler() const;
  const dealii::AffineConstraints<double> &constraints() const;
  const Degrees &degrees() const;

  unsigned int n_dofs() const;      ///< before constraints are eliminated (`dofs`)
  unsigned int n_free_dofs() const; ///< after (`dofs_free`, the N of every rate)

  /** As in DofNumbering. */
  dealii::ArrayView<const dealii::types::global_dof_index> cell_dofs(unsigned int cell) const;

  /** To be asked only where the space has been given some. */
  const LoadRules<dim> &rules() const;

private:
  const DofNumbering<dim> dof_numbering;
  const dealii::AffineConstraints<double> affine_constraints;
  const LoadRules<dim> *const load_rules;
};
} // namespace hpvi

#endif
