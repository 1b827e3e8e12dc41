// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_assembly_h
#define hpvi_assembly_h

#include <hpvi/contact_space.h>
#include <hpvi/displacement_space.h>
#include <hpvi/element_stiffness.h>
#include <hpvi/symmetric_matrix.h>

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
  /**
   * Assemble; @p stiffnesses remembers element matrices from step to step. Throws NumericalFailure
   * where nothing on this mesh resists the scene's free translation.
   */
  ElasticSystem(const Scene<dim> &scene, const DisplacementSpace<dim> &displacement_space,
                const ContactSpace<dim> &contact_space, const ShapeTables<dim> &tables,
                ElementStiffnesses<dim> &stiffnesses);

  SymmetricMatrix A;        ///< over the unknowns; stress length^(dim-2)
  dealii::Vector<double> f; ///< right-hand side over the unknowns

  /** Unknowns with a tangential part on the contact boundary, ascending; the columns of B. */
  std::vector<unsigned int> contact_unknowns;
  dealii::FullMatrix<double> B;        ///< B_mk = b(v_k, w_m), n_multipliers x contact_unknowns
  dealii::Vector<double> B_prescribed; ///< b(u_D, w_m), the part of prescribed displacements

  /**
   * Where the scene leaves a translation free, its values R at the unknowns; else empty. A is then
   * regularised by a spring at one contact unknown, stiffness @p spring for the translation R. It
   * carries no force where R'(f - B' lambda) = 0, so that A^-1 is a generalised inverse of the true
   * stiffness.
   */
  dealii::Vector<double> translation;
  double spring = 0;

  /** All displacement unknowns from values at the unknowns of A. */
  dealii::Vector<double> recover(const dealii::Vector<double> &x) const;

  double energy_product(const dealii::Vector<double> &u) const; ///< a(u,u)
  double work(const dealii::Vector<double> &u) const;           ///< L(u)

private:
  /** What one cell adds to the unknowns that its boundary depends on. */
  struct Contribution
  {
    std::vector<unsigned int> targets;
    const dealii::FullMatrix<double> *matrix = nullptr; ///< targets x targets

    unsigned int add_target(unsigned int unknown); ///< its place among the targets
  };

  void number_unknowns();
  void assemble_loads(const Scene<dim> &scene, const ShapeTables<dim> &tables);
  Contribution reduce(unsigned int cell, ElementStiffnesses<dim> &stiffnesses);
  void sum_up(const std::vector<Contribution> &contributions);
  void assemble_contact(const ContactSpace<dim> &contact_space, const ShapeTables<dim> &tables);
  void hold(const dealii::Tensor<1, dim> &free_translation);
  dealii::Vector<double> interior_load(unsigned int cell) const;

  const DisplacementSpace<dim> &space;
  dealii::Vector<double> load;                           ///< L(v_i) for every displacement unknown
  bool interior_loads;                                   ///< does any load act inside a cell?
  std::vector<dealii::types::global_dof_index> unknowns; ///< their number in the space
  std::vector<unsigned int> number;                      ///< the inverse of unknowns
  std::vector<std::shared_ptr<const ElementStiffness>> elements; ///< by active cell index
  std::vector<std::shared_ptr<const dealii::FullMatrix<double>>>
      constrained; ///< kept for the next step
};
} // namespace hpvi

#endif
