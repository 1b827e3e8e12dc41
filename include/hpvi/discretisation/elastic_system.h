// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_elastic_system_h
#define hpvi_elastic_system_h

#include <hpvi/body/displacement_space.h>
#include <hpvi/body/element_matrices.h>
#include <hpvi/contact/contact_space.h>
#include <hpvi/solver/symmetric_matrix.h>

#include <map>
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
  /** The factored blocks K_ii by element. */
  using Interiors = std::map<const ElementStiffness *, dealii::LAPACKFullMatrix<double>>;

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

  double work(const dealii::Vector<double> &u) const; ///< L(u)

  /** L(v_i) for every displacement unknown, constrained or not. */
  const dealii::Vector<double> &loads() const;

  /** b(v_i, lambda), likewise; of one contact boundary where it is named. */
  dealii::Vector<double>
  friction_forces(const dealii::Vector<double> &lambda,
                  dealii::types::boundary_id only = dealii::numbers::invalid_boundary_id) const;

  /** b(u, w_m) for every multiplier. */
  dealii::Vector<double> tangential_moments(const dealii::Vector<double> &u) const;

  /** Forces on all displacement unknowns as forces on the unknowns of A: what f is to L. */
  dealii::Vector<double> reduce(const dealii::Vector<double> &forces) const;

  /**
   * The displacement under homogeneous constraints that has the values @p x at the unknowns of A
   * and @p forces inside the cells: with `x = A^-1 reduce(forces)` the answer of the body to them.
   */
  dealii::Vector<double> respond(const dealii::Vector<double> &x,
                                 const dealii::Vector<double> &forces,
                                 const Interiors &interiors) const;

  /** What respond() wants of each class of elements. */
  Interiors interiors(const ElementStiffnesses<dim> &stiffnesses) const;

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
  void assemble_contact(const ShapeTables<dim> &tables);
  void hold(const dealii::Tensor<1, dim> &free_translation);
  void extend(unsigned int cell, dealii::Vector<double> &interior, dealii::Vector<double> &u) const;
  dealii::Vector<double> inside(unsigned int cell, const dealii::Vector<double> &values) const;

  const DisplacementSpace<dim> &space;
  const ContactSpace<dim> &contact_space;
  dealii::Vector<double> load;                           ///< L(v_i) for every displacement unknown
  bool interior_loads;                                   ///< does any load act inside a cell?
  std::vector<dealii::types::global_dof_index> unknowns; ///< their number in the space
  std::vector<unsigned int> number;                      ///< the inverse of unknowns
  std::vector<std::shared_ptr<const ElementStiffness>> elements; ///< by active cell index
  std::vector<dealii::FullMatrix<double>> couplings; ///< rows of B on each face, by local unknown
  std::vector<std::shared_ptr<const dealii::FullMatrix<double>>>
      constrained; ///< kept for the next step
};
} // namespace hpvi

#endif
