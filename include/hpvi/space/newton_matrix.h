// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_newton_matrix_h
#define hpvi_newton_matrix_h

#include <hpvi/algebra/linear_solver.h>
#include <hpvi/space/contact_dof_state.h>
#include <hpvi/space/multigrid.h>
#include <hpvi/space/primal_system.h>

#include <deal.II/lac/trilinos_precondition.h>
#include <deal.II/lac/trilinos_solver.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace hpvi
{
/** What the scene names; `automatic`: multigrid where it is on offer, else amg; in the plane direct. */
template <int dim>
LinearMethod linear_method(const PrimalSpace<dim> &space);

/**
 * Of a process: matrix, its pattern, the levels of algebraic multigrid; or without a matrix vectors, unknowns and constraints of
 * all levels, and degree one on the coarsest mesh with its algebraic multigrid. Measured to a quarter, without a matrix to a tenth.
 */
template <int dim>
double expected_bytes(const PrimalSpace<dim> &space);

template <int dim>
std::string matrix_name(const PrimalSpace<dim> &space); ///< in messages about these

/** Throws MemoryFailure on all processes where those of one machine need more than it has. Collective. */
template <int dim>
void require_room(const PrimalSpace<dim> &space);

/**
 * All that Newton's method asks of the matrix: products with A, its blocks at the contact dofs, and
 * solutions of `(A + H) v = b` in the unknowns that are not held, by conjugate gradients. In space they have one of three
 * preconditioners, each of which takes over where the one before breaks down:
 *
 * - Multigrid, geometric and without a matrix, whose products A then are; it gives way after a hundred steps;
 * - the algebraic multigrid of ML on the assembled matrix: it sees A + H with 1e4-fold diagonals where contact dofs are held, and
 *   rigid body motions that vanish there. It is set up anew only where more than a fiftieth of the contact dofs has changed
 *   its state; until then what is held is masked, and what moves now gets its own block as a correction;
 * - a factorisation anew for each linearisation, which the plane always has: LinearSolver's on one process, MUMPS's on several.
 */
template <int dim>
class NewtonMatrix
{
public:
  using Block = dealii::SymmetricTensor<2, dim - 1>;

  /** Takes changes of the entries of @p system.matrix() at contact dofs for its own. Collective. */
  NewtonMatrix(const PrimalSpace<dim> &space, PrimalSystem<dim> &system);

  /** With @p method, because the first choice has broken down on another mesh. */
  NewtonMatrix(const PrimalSpace<dim> &space, PrimalSystem<dim> &system, LinearMethod method);

  /** y = A x */
  void multiply(DistributedVector &y, const DistributedVector &x) const;

  /** Of A at the contact dofs of PrimalSpace::contact; of a pressure, which has one, a multiple of the unit matrix. */
  const Block &block(unsigned int k) const;

  /**
   * From here on A has a spring of so much [force/length] at each contact dof, of PrimalSpace::contact, in the unknowns that are not
   * held; before the first linearise().
   */
  void add_springs(const std::vector<double> &stiffness);

  /** From here on solve() knows @p states; @p anew: multigrid too. Collective. */
  void linearise(const std::vector<ContactDofState<dim>> &states, bool anew = false);

  /**
   * Improves @p v until the residual r is below @p tolerance, or the error in the energy norm below @p error, taken for
   * `(r' M r)^1/2` with the preconditioner M; what is held stays as it is in v. Collective. Where
   * multigrid takes too many steps the next method takes its place from here on. Throws
   * NumericalFailure where that does not help.
   */
  void solve(DistributedVector &v, const DistributedVector &b, double tolerance, double error = 0);

  /** An approximate solution of `(A + H) z = r`. */
  void precondition(DistributedVector &z, const DistributedVector &r) const;

  /** Called before each step of conjugate gradients; may throw where it does so on all processes. */
  std::function<void()> before_step = []() {};
  unsigned int n_steps = 0;  ///< of conjugate gradients so far
  unsigned int n_setups = 0; ///< of multigrid, or factorisations, so far
  double setup_seconds = 0;  ///< which these took
  bool fell_back = false;    ///< has a method broken down?
  LinearMethod method;       ///< in use

private:
  void mask(DistributedVector &x) const;
  void begin();
  void assemble();
  void prepare(bool anew);
  void give_way();
  void set_up();
  void factor();
  void factor_alone();
  void factor_together();
  bool iterate(DistributedVector &v, const DistributedVector &b, double tolerance, double error);
  void set_block(unsigned int k, const Block &block);
  void multiply_linearised(DistributedVector &y, const DistributedVector &x) const;

  const PrimalSpace<dim> &space;
  PrimalSystem<dim> &system;
  std::vector<Block> blocks, inserted; ///< of A; what set_up() has added to them in the matrix
  std::vector<ContactDofState<dim>> states, known; ///< now, with springs; when multigrid was set up
  std::vector<double> motions;                     ///< rigid_motions(), one after the other
  dealii::TrilinosWrappers::SparseMatrix *A = nullptr; ///< of the system; null: there is none
  std::unique_ptr<Multigrid> multigrid;
  std::unique_ptr<dealii::TrilinosWrappers::PreconditionAMG> amg;
  dealii::SolverControl control;
  dealii::TrilinosWrappers::SparseMatrix
      factored; ///< A + H with rows of the unit matrix where contact dofs are held
  std::unique_ptr<dealii::TrilinosWrappers::SolverDirect> factors; ///< of several processes
  std::unique_ptr<LinearSolver> own_factors;                       ///< of one
  std::vector<double> springs;                                     ///< of each contact dof
};
} // namespace hpvi

#endif
