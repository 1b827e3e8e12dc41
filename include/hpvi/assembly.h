// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_assembly_h
#define hpvi_assembly_h

#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/sparsity_pattern.h>
#include <hpvi/contact_space.h>
#include <hpvi/displacement_space.h>
#include <hpvi/element_stiffness.h>

#include <memory>
#include <vector>

namespace hpvi
{
/**
 * The discrete problem `A u + B' lambda = f` of (5.1)-(5.3). The unknowns inside the cells are
 * eliminated cell by cell (static condensation), so A and f couple unknowns on vertices and edges
 * only; constraints are eliminated too, with prescribed displacements moved to f.
 */
template <int dim>
class ElasticSystem
{
public:
  /** Assemble; @p stiffnesses remembers element matrices from step to step. */
  ElasticSystem(const Scene<dim> &scene, const DisplacementSpace<dim> &displacement_space,
                const ContactSpace<dim> &contact_space, const ShapeTables<dim> &tables,
                ElementStiffnesses<dim> &stiffnesses);

  dealii::SparseMatrix<double> A; ///< numbered like the displacement space; stress length^(dim-2)
  dealii::Vector<double> f;       ///< right-hand side for A
  std::vector<dealii::types::global_dof_index> unknowns; ///< rows of A that are unknown, ascending

  /** Unknowns with a tangential part on the contact boundary; the columns of B. */
  std::vector<dealii::types::global_dof_index> contact_unknowns;
  dealii::FullMatrix<double> B;        ///< B_mk = b(v_k, w_m), n_multipliers x contact_unknowns
  dealii::Vector<double> B_prescribed; ///< b(u_D, w_m), the part of prescribed displacements

  /** Given values at the unknowns, fill in constrained and interior ones. */
  void recover(dealii::Vector<double> &u) const;

  double energy_product(const dealii::Vector<double> &u) const; ///< a(u,u)
  double work(const dealii::Vector<double> &u) const;           ///< L(u)

private:
  void assemble_stiffness(ElementStiffnesses<dim> &stiffnesses);
  void assemble_loads(const Scene<dim> &scene, const ShapeTables<dim> &tables);
  void assemble_contact(const ContactSpace<dim> &contact_space, const ShapeTables<dim> &tables);

  const DisplacementSpace<dim> &space;
  dealii::SparsityPattern pattern;
  dealii::Vector<double> load; ///< L(v_i) for every displacement unknown
  bool interior_loads;         ///< does any load act inside a cell?
  std::vector<std::shared_ptr<const ElementStiffness>> elements; ///< by active cell index
};
} // namespace hpvi

#endif
