// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_moment_matrix_h
#define hpvi_moment_matrix_h

#include <hpvi/algebra/linear_solver.h>
#include <hpvi/moments/primal_system.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_solver.h>

#include <functional>
#include <memory>
#include <vector>

namespace hpvi
{
/** What Newton's method makes of a moment of the contact: no motion, or a stiffness H. */
template <int dim>
struct MomentState
{
  bool is_held = false; ///< it sticks, or a pressure acts
  dealii::SymmetricTensor<2, dim - 1> stiffness;
};

/**
 * All that Newton's method asks of the matrix: products with A, its blocks at the moments of contact, and
 * solutions of `(A + H) v = b` in the unknowns that are not held, by conjugate gradients with the algebraic
 * multigrid of ML. Multigrid sees A + H with 1e4-fold diagonals where moments are held, and rigid body
 * motions that vanish there. It is set up anew only where more than a fiftieth of the moments has changed
 * its state; until then what is held is masked, and what moves now gets its own block as a
 * correction. In the plane, where the scene wants that, or where multigrid breaks down, a factorisation
 * anew for each linearisation stands in its place: LinearSolver's on one process, MUMPS's on several. Behind this interface the matrix could as well be free of entries.
 */
template <int dim>
class MomentMatrix
{
public:
  using Block = dealii::SymmetricTensor<2, dim - 1>;

  /** Takes changes of the entries of @p system.A at moments of contact for its own. */
  MomentMatrix(const MomentSpace<dim> &space, PrimalSystem<dim> &system);

  /** y = A x */
  void multiply(DistributedVector &y, const DistributedVector &x) const;

  /** Of A at the moments of MomentSpace::contact; of a pressure, which has one, a multiple of the unit matrix. */
  const Block &block(unsigned int k) const;

  /** From here on solve() knows @p states; @p anew: multigrid too. Collective. */
  void linearise(const std::vector<MomentState<dim>> &states, bool anew = false);

  /**
   * Improves @p v until the residual is below @p tolerance; what is held stays as it is in v. Collective. Where
   * multigrid takes more than three hundred steps a factorisation takes its place from here on. Throws
   * NumericalFailure where that does not help.
   */
  void solve(DistributedVector &v, const DistributedVector &b, double tolerance);

  /** An approximate solution of `(A + H) z = r`. */
  void precondition(DistributedVector &z, const DistributedVector &r) const;

  /** Called before each step of conjugate gradients; may throw where it does so on all processes. */
  std::function<void()> before_step = []() {};
  unsigned int n_steps = 0;  ///< of conjugate gradients so far
  unsigned int n_setups = 0; ///< of multigrid, or factorisations, so far
  double setup_seconds = 0;  ///< which these took
  bool fell_back = false;    ///< has multigrid broken down?

private:
  void mask(DistributedVector &x) const;
  void set_up();
  void factor();
  void factor_alone();
  void factor_together();
  bool iterate(DistributedVector &v, const DistributedVector &b, double tolerance);
  std::vector<double> rigid_motions() const;
  void set_block(unsigned int k, const Block &block);
  void multiply_linearised(DistributedVector &y, const DistributedVector &x) const;

  const MomentSpace<dim> &space;
  PrimalSystem<dim> &system;
  std::vector<Block> blocks, inserted; ///< of A; what set_up() has added to them in the matrix
  std::vector<MomentState<dim>> states, known; ///< now; when multigrid was set up
  std::vector<double> motions;                 ///< rigid_motions(), one after the other
  std::unique_ptr<dealii::TrilinosWrappers::PreconditionAMG> amg;
  bool is_direct;
  dealii::SolverControl control;
  dealii::TrilinosWrappers::SparseMatrix
      factored; ///< A + H with rows of the unit matrix where moments are held
  std::unique_ptr<dealii::TrilinosWrappers::SolverDirect> factors; ///< of several processes
  std::unique_ptr<LinearSolver> own_factors;                       ///< of one
};
} // namespace hpvi

#endif
