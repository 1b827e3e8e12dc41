// SPDX-License-Identifier: LGPL-2.1-or-later

// One sparse Cholesky factorisation per step, by CHOLMOD, is most of the work of a run. It does two
// things at once: it solves with $A$, and it reduces $A$ to the contact. If the contact unknowns
// come last in the order of elimination, then
//
// $$\begin{aligned}
//   A &= \begin{pmatrix} A_{11} & A_{12} \\ A_{21} & A_{22}\end{pmatrix}, \;
//   L = \begin{pmatrix} L_{11} & \\ L_{21} & C \end{pmatrix},
//   \\ CC^T &= A_{22} - A_{21} A_{11}^{-1} A_{12}:
// \end{aligned}$$
//
// the trailing block $C$ of the factor <i>is</i> the factor of the Schur complement on them. No
// solution with $A$ per multiplier, as (5.6) seems to ask for, is needed.
#include <cholmod.h>
#include <hpvi/algebra/elimination.h>
#include <hpvi/algebra/linear_solver.h>
#include <hpvi/algebra/supernodal_solve.h>
#include <hpvi/algebra/supervariables.h>
#include <hpvi/base/memory.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/base/one_thread.h>
#include <hpvi/base/thread_pool.h>

#include <algorithm>
#include <string>

namespace hpvi
{
using namespace dealii;

/** CHOLMOD's objects, released with their owner, and the trailing block of the factor. */
struct LinearSolver::Factor
{
  cholmod_common common, other; ///< the other for what is done beside the analysis
  cholmod_factor *L = nullptr;
  std::unique_ptr<Elimination> elimination; ///< until it has been analysed
  std::vector<int> permutation; ///< position in the factorisation -> number of the unknown
  SharedSupernodes shared;
  LAPACKFullMatrix<double> C; ///< its copies would forget that it is a triangle
  std::vector<unsigned int> order;

  Factor()
  {
    cholmod_start(&common);
    cholmod_start(&other);
    common.print = other.print = 0;
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.final_ll = true;
  }

  ~Factor()
  {
    cholmod_free_factor(&L, &common);
    cholmod_finish(&common);
    cholmod_finish(&other);
  }

  Factor(const Factor &) = delete;
  Factor &operator=(const Factor &) = delete;

  void order_unknowns(const cholmod_sparse &matrix, const EliminationHints &hints,
                      const std::vector<unsigned int> &interface);
  void analyse(const cholmod_sparse &matrix, double more_bytes);
  void compute(const SymmetricMatrix &A, const std::vector<unsigned int> &interface,
               double more_bytes, const std::vector<Stabilisation> &stabilisation,
               const EliminationHints &hints);
  void check(const cholmod_common &of) const;
  void check() const
  {
    check(common);
  }
  LAPACKFullMatrix<double> trailing_block(unsigned int n_trailing) const;
};

namespace
{
/** A view of @p A as CHOLMOD knows it. CHOLMOD does not write to it. */
cholmod_sparse as_cholmod(const SymmetricMatrix &A)
{
  cholmod_sparse matrix{};
  matrix.nrow = matrix.ncol = A.n();
  matrix.nzmax = A.row.size();
  matrix.p = const_cast<int *>(A.column_start.data());
  matrix.i = const_cast<int *>(A.row.data());
  matrix.x = const_cast<double *>(A.value.data());
  matrix.stype = 1;
  matrix.itype = CHOLMOD_INT;
  matrix.xtype = CHOLMOD_REAL;
  matrix.dtype = CHOLMOD_DOUBLE;
  matrix.sorted = false;
  matrix.packed = true;
  return matrix;
}
} // namespace

// @sect3{Analysis and factorisation}
//
// <code>Elimination</code> finds an order that fills in little and takes the interface dofs last.
// Dense blocks of columns, supernodes, make the factorisation one of dense algebra. Its size is
// known after the symbolic analysis, and is compared with what memory is left before anything is
// allocated. Another matrix on the same mesh needs none of that again.
void LinearSolver::Factor::order_unknowns(const cholmod_sparse &matrix,
                                          const EliminationHints &hints,
                                          const std::vector<unsigned int> &interface)
{
  permutation.resize(matrix.ncol); // for what check() says
  elimination = std::make_unique<Elimination>(matrix, hints, interface, common);
  check();
  permutation = std::move(elimination->permutation);
  for (std::size_t k = permutation.size() - interface.size(); k < permutation.size(); ++k)
    order.push_back(std::lower_bound(interface.begin(), interface.end(), permutation[k]) -
                    interface.begin());
}

void LinearSolver::Factor::analyse(const cholmod_sparse &matrix, const double more_bytes)
{
  L = elimination->analyse(common);
  check();
  elimination.reset();

  // L, the largest update of a supernode, and A in the order of L.
  const double bytes = sizeof(double) * (double(L->xsize) + double(L->maxcsize)) +
                       (sizeof(double) + sizeof(int)) * double(matrix.nzmax);
  require_memory(bytes + more_bytes, "the factorisation of " + std::to_string(L->n) + " unknowns");
}

// @sect3{When it fails}
//
// A factorisation fails in few ways, each with its own remedy. A pivot that is not positive says
// that the body can move without strain.
/** Throws NumericalFailure unless the last work of CHOLMOD with it succeeded. */
void LinearSolver::Factor::check(const cholmod_common &of) const
{
  const std::string remedy =
      "; lower Adaptivity/Maximum unknowns or take fewer Geometry/Subdivisions";
  if (L && L->minor < L->n)
    throw NumericalFailure("the stiffness matrix is not positive definite: a rigid-body motion is "
                           "free or elements are degenerate");
  if (of.status == CHOLMOD_TOO_LARGE)
    throw NumericalFailure("the factor of the stiffness matrix (" +
                           std::to_string(permutation.size()) +
                           " unknowns) has more entries than its indices can count" + remedy);
  if (of.status == CHOLMOD_OUT_OF_MEMORY)
    throw MemoryFailure(
        "the factorisation of " + std::to_string(permutation.size()) +
        " unknowns is out of memory: it holds " + bytes_text(of.memory_inuse) +
        (L ? " and asked for up to " + bytes_text(sizeof(double) * double(L->xsize)) : "") +
        remedy + " or allow more memory");
  if (of.status != CHOLMOD_OK)
    throw NumericalFailure("the factorisation of " + std::to_string(permutation.size()) +
                           " unknowns failed: CHOLMOD's status is " + std::to_string(of.status));
}

// @sect3{The trailing block}
//
// Supernodes are stored densely, column by column. Those that reach into the trailing block give it
// up entry by entry.
LAPACKFullMatrix<double> LinearSolver::Factor::trailing_block(const unsigned int n_trailing) const
{
  LAPACKFullMatrix<double> block(n_trailing, n_trailing);
  const int first = static_cast<int>(L->n - n_trailing);
  const int *super = static_cast<const int *>(L->super), *pi = static_cast<const int *>(L->pi),
            *px = static_cast<const int *>(L->px), *s = static_cast<const int *>(L->s);
  const double *x = static_cast<const double *>(L->x);
  for (unsigned int k = 0; k < L->nsuper; ++k)
    for (int column = std::max(super[k], first); column < super[k + 1]; ++column)
    {
      const int n_supernode_rows = pi[k + 1] - pi[k];
      for (int r = column - super[k]; r < n_supernode_rows; ++r)
        block(s[pi[k] + r] - first, column - first) =
            x[px[k] + (column - super[k]) * n_supernode_rows + r];
    }
  block.set_property(LAPACKSupport::lower_triangular);
  return block;
}

// @sect3{Bodies that can move}
//
// If contact alone holds the body, $A$ is singular along its free motions. $A + c\,PP^T$ is not,
// with $P^Tu$ the mean displacement along a motion, and where the balance of forces is asked for as
// a constraint the term changes no solution. $P$ has entries on the contact alone, so that little
// is filled in.
namespace
{
/** P P', the upper triangle of n x n. */
SymmetricMatrix square(const std::vector<std::pair<unsigned int, double>> &P, const unsigned int n)
{
  SymmetricMatrix PP;
  PP.resize(P.size() * (P.size() + 1) / 2);
  int end = 0;
  auto column_entry = P.begin();
  for (unsigned int column = 0; column < n; ++column)
  {
    if (column_entry != P.end() && column_entry->first == column)
    {
      for (auto row_entry = P.begin(); row_entry <= column_entry; ++row_entry, ++end)
      {
        PP.row[end] = row_entry->first;
        PP.value[end] = row_entry->second * column_entry->second;
      }
      ++column_entry;
    }
    PP.column_start.push_back(end);
  }
  return PP;
}

/** Kept unknowns and those that a term couples are not like others. */
EliminationHints hints_with(EliminationHints hints, const std::vector<unsigned int> &interface,
                            const std::vector<Stabilisation> &stabilisation)
{
  if (hints.supervariables.empty())
    return hints;
  Supervariables supervariables(std::move(hints.supervariables));
  supervariables.split(interface);
  for (const Stabilisation &term : stabilisation)
  {
    std::vector<unsigned int> coupled;
    for (const auto &entry : term.P)
      coupled.push_back(entry.first);
    supervariables.split(coupled);
  }
  hints.supervariables = supervariables.numbers();
  return hints;
}

/** A sparse matrix of CHOLMOD's, released with its owner. */
struct SparseMatrix
{
  explicit SparseMatrix(cholmod_common &common) : common(common)
  {
  }
  ~SparseMatrix()
  {
    cholmod_free_sparse(&matrix, &common);
  }
  SparseMatrix(const SparseMatrix &) = delete;
  SparseMatrix &operator=(const SparseMatrix &) = delete;

  cholmod_sparse *matrix = nullptr;
  cholmod_common &common;
};
} // namespace

/** Factors A with what stabilises it. */
void LinearSolver::Factor::compute(const SymmetricMatrix &A,
                                   const std::vector<unsigned int> &interface,
                                   const double more_bytes,
                                   const std::vector<Stabilisation> &stabilisation,
                                   const EliminationHints &hints)
{
  cholmod_sparse matrix = as_cholmod(A);
  SparseMatrix sum(common);
  for (const Stabilisation &term : stabilisation)
  {
    const SymmetricMatrix PP = square(term.P, A.n());
    cholmod_sparse last = sum.matrix ? *sum.matrix : matrix, added = as_cholmod(PP);
    double one[2] = {1., 0.}, stiffness[2] = {term.stiffness, 0.};
    cholmod_sparse *const next = cholmod_add(&last, &added, one, stiffness, /*values=*/true,
                                             /*sorted=*/false, &common);
    cholmod_free_sparse(&sum.matrix, &common);
    sum.matrix = next;
    check();
  }
  cholmod_sparse *const whole = sum.matrix ? sum.matrix : &matrix;
  SparseMatrix ordered(other);
  const bool is_new = !L;
  if (is_new)
    order_unknowns(*whole, hints_with(hints, interface, stabilisation), interface);
  parallel_for_each(2, 1,
                    [&](const unsigned int k)
                    {
                      if (k == 1)
                        ordered.matrix = cholmod_ptranspose(whole, /*values=*/1, permutation.data(),
                                                            nullptr, 0, &other);
                      else if (is_new)
                        analyse(*whole, more_bytes);
                    });
  check(other);
  if (L->xtype == CHOLMOD_PATTERN)
    cholmod_change_factor(CHOLMOD_REAL, /*to_ll=*/true, /*to_super=*/true, /*to_packed=*/true,
                          /*to_monotonic=*/true, L, &common);
  check();
  std::optional<SharedSupernodes> supernodes = factor_supernodes(*ordered.matrix, *L);
  L->minor = supernodes ? L->n : 0;
  check();
  shared = std::move(*supernodes);
  if (!order.empty())
    C = trailing_block(order.size());
}

// @sect3{The constructor}
//
// The solver is complete when it stands: ordering, factor, trailing block, and the order in which
// the interface dofs have come out.
LinearSolver::LinearSolver(const SymmetricMatrix &A, const std::vector<unsigned int> &interface,
                           const double more_bytes, const std::vector<Stabilisation> &stabilisation,
                           const EliminationHints &hints)
    : factor(std::make_unique<Factor>())
{
  const OneThread one_thread;
  if (A.n() > 0)
    factor->compute(A, interface, more_bytes, stabilisation, hints);
}

void LinearSolver::factor_again(const SymmetricMatrix &A,
                                const std::vector<Stabilisation> &stabilisation)
{
  const OneThread one_thread;
  AssertDimension(A.n(), factor->permutation.size());
  if (A.n() > 0)
    factor->compute(A, {}, 0., stabilisation, {});
}

LinearSolver::LinearSolver(LinearSolver &&) = default;
LinearSolver::~LinearSolver() = default;

// @sect3{Halves of a solution}
//
// Forward substitution $Ly = f$ once; its last part holds $BA^{-1}f$ in disguise. Backward
// substitution $L^Tx = y$ once per multiplier that is tried, which is once.
Vector<double> LinearSolver::forward(const Vector<double> &f) const
{
  if (f.size() == 0)
    return f;
  Vector<double> permuted(f.size());
  for (unsigned int i = 0; i < f.size(); ++i)
    permuted[i] = f[factor->permutation[i]];
  const OneThread one_thread;
  solve_forward(*factor->L, factor->shared, permuted.begin());
  return permuted;
}

Vector<double> LinearSolver::backward(const Vector<double> &y) const
{
  if (y.size() == 0)
    return y;
  const OneThread one_thread;
  Vector<double> permuted(y), x(y.size());
  solve_backward(*factor->L, factor->shared, permuted.begin());
  for (unsigned int i = 0; i < y.size(); ++i)
    x[factor->permutation[i]] = permuted[i];
  return x;
}

Vector<double> LinearSolver::solve(const Vector<double> &f) const
{
  return backward(forward(f));
}

const LAPACKFullMatrix<double> &LinearSolver::kept_factor() const
{
  return factor->C;
}

const std::vector<unsigned int> &LinearSolver::interface_order() const
{
  return factor->order;
}
} // namespace hpvi
