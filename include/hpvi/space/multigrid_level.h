// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_multigrid_level_h
#define hpvi_multigrid_level_h

#include <hpvi/space/box_stiffness.h>
#include <hpvi/space/cell_operator.h>
#include <hpvi/space/contact_dof_state.h>
#include <hpvi/space/contact_dof_transform.h>

#include <deal.II/base/subscriptor.h>

namespace hpvi
{
/**
 * `A + H` on one mesh in the basis of contact dofs, `A = T'KT`, without a matrix: what is held or constrained is zero in all
 * results. Of blocks at contact dofs and the diagonal there are entries, exact ones, hanging nodes included.
 */
template <typename Number>
class MultigridLevel : public dealii::Subscriptor
{
public:
  using Vector = typename CellOperator<Number>::Vector;
  using Block = dealii::SymmetricTensor<2, 2>;

  /** @p space must outlive it. Collective. */
  explicit MultigridLevel(const PrimalSpace<3> &space);

  void reinit(Vector &v) const;                    ///< zero, as products want it
  void multiply(Vector &y, const Vector &x) const; ///< y = A x; x may lack neighbours
  void
  linearise(const std::vector<ContactDofState<3>> &states); ///< what is held, and H, from here on
  void vmult(Vector &y, const Vector &x) const;             ///< y = (A + H) x
  void mask(Vector &x) const; ///< zero where it is held or constrained

  /** z = D^-1 r with the diagonal, and 2x2 blocks of `A + H` at friction that slips; of floats alone. */
  void precondition(Vector &z, const Vector &r) const;

  const PrimalSpace<3> &space;
  std::vector<Block> blocks; ///< of A at contact dofs; of a pressure a multiple of the unit matrix
  std::vector<ContactDofState<3>> states; ///< as last linearised
  const ContactDofTransform<Number> &transform() const
  {
    return *contact_dofs;
  }
  const dealii::Utilities::MPI::Partitioner &partitioner() const
  {
    return *scratch.get_partitioner();
  }
  /** Local elements and weights that make up the value at @p dof, if it is constrained. */
  void resolve(dealii::types::global_dof_index dof,
               const std::function<void(unsigned int, double)> &take) const
  {
    ContactDofTransform<Number>::resolve(space, scratch, dof, take);
  }

private:
  void find_springs();
  void add_springs(Vector &y, Vector &x) const;
  void find_entries(const BoxStiffness<3> &stiffness);
  void add_diagonal(const PrimalSpace<3>::Cell &cell, const dealii::FullMatrix<double> &K,
                    std::vector<Number> &far);
  void set_blocks(const PrimalSpace<3>::Cell &cell, const dealii::FullMatrix<double> &K);

  dealii::AffineConstraints<Number> constraints; ///< as of the space, in its own numbers
  std::unique_ptr<CellOperator<Number>> cells;
  std::unique_ptr<ContactDofTransform<Number>> contact_dofs;
  /** Springs of a face, between local elements and their weights at the nodes of the face, component by component of each. */
  struct Springs
  {
    SpringsOfFace<3> of_face;
    std::vector<std::vector<std::pair<unsigned int, Number>>> nodes;
  };
  std::vector<Springs> springs;          ///< of this process
  Vector inverse_diagonal;               ///< of floats alone
  std::vector<unsigned int> constrained; ///< of this process
  mutable std::vector<Number> kept;
  mutable Vector scratch;
};

/** The preconditioner of Chebyshev's smoother. */
template <typename Number>
class BlockJacobi
{
public:
  explicit BlockJacobi(const MultigridLevel<Number> &level) : level(level)
  {
  }

  void vmult(typename MultigridLevel<Number>::Vector &z,
             const typename MultigridLevel<Number>::Vector &r) const
  {
    level.precondition(z, r);
  }

private:
  const MultigridLevel<Number> &level;
};
} // namespace hpvi

#endif
