// SPDX-License-Identifier: LGPL-2.1-or-later
#include <cholmod.h>
#include <hpvi/base/dense_work.h>
#include <hpvi/base/memory.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/base/one_thread.h>
#include <hpvi/solver/linear_solver.h>

#include <algorithm>
#include <string>

namespace hpvi
{
using namespace dealii;

/** CHOLMOD's objects, released with their owner, and the trailing block of the factor. */
struct SchurComplement::Factor
{
  cholmod_common common;
  cholmod_factor *L = nullptr;
  std::vector<int> permutation; ///< position in the factorisation -> number of the unknown
  Vector<double> y;             ///< L^-1 P f

  Factor()
  {
    cholmod_start(&common);
    common.print = 0;
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.final_ll = true;
  }

  ~Factor()
  {
    cholmod_free_factor(&L, &common);
    cholmod_finish(&common);
  }

  Factor(const Factor &) = delete;
  Factor &operator=(const Factor &) = delete;

  void compute(cholmod_sparse *matrix, const std::vector<int> &is_contact, double dense_bytes);
  void check() const;
  LAPACKFullMatrix<double> trailing_block(unsigned int n_trailing) const;
  Vector<double> solve(int system, const Vector<double> &right_hand_side);
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

/** @p dense_bytes are those that the reduction to the contact unknowns will need beside L. */
void SchurComplement::Factor::compute(cholmod_sparse *matrix, const std::vector<int> &is_contact,
                                      const double dense_bytes)
{
  permutation.resize(matrix->nrow);
  std::vector<int> groups(is_contact);
  cholmod_camd(matrix, nullptr, 0, groups.data(), permutation.data(), &common);
  check();

  // The order is taken as it is: a postordering could move contact unknowns away from the end.
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_GIVEN;
  common.postorder = false;
  L = cholmod_analyze_p(matrix, permutation.data(), nullptr, 0, &common);
  check();

  // L, the largest update of a supernode, and A in the order of L.
  const double bytes = sizeof(double) * (double(L->xsize) + double(L->maxcsize)) +
                       (sizeof(double) + sizeof(int)) * double(matrix->nzmax);
  require_memory(bytes + dense_bytes, "the factorisation of " + std::to_string(L->n) + " unknowns");
  cholmod_factorize(matrix, L, &common);
  check();
}

/** Throws NumericalFailure unless CHOLMOD's last work succeeded. */
void SchurComplement::Factor::check() const
{
  const std::string remedy =
      "; lower Adaptivity/Maximum unknowns or take fewer Geometry/Subdivisions";
  if (L && L->minor < L->n)
    throw NumericalFailure("the stiffness matrix is not positive definite: a rigid-body motion is "
                           "free or elements are degenerate");
  if (common.status == CHOLMOD_TOO_LARGE)
    throw NumericalFailure("the factor of the stiffness matrix (" +
                           std::to_string(permutation.size()) +
                           " unknowns) has more entries than its indices can count" + remedy);
  if (common.status == CHOLMOD_OUT_OF_MEMORY)
    throw NumericalFailure(
        "the factorisation of " + std::to_string(permutation.size()) +
        " unknowns is out of memory: it holds " + bytes_text(common.memory_inuse) +
        (L ? " and asked for up to " + bytes_text(sizeof(double) * double(L->xsize)) : "") +
        remedy + " or allow more memory");
  if (common.status != CHOLMOD_OK)
    throw NumericalFailure("the factorisation of " + std::to_string(permutation.size()) +
                           " unknowns failed: CHOLMOD's status is " +
                           std::to_string(common.status));
}

LAPACKFullMatrix<double>
SchurComplement::Factor::trailing_block(const unsigned int n_trailing) const
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

Vector<double> SchurComplement::Factor::solve(const int system,
                                              const Vector<double> &right_hand_side)
{
  cholmod_dense dense{};
  dense.nrow = dense.nzmax = dense.d = right_hand_side.size();
  dense.ncol = 1;
  dense.x = const_cast<double *>(right_hand_side.begin());
  dense.xtype = CHOLMOD_REAL;
  dense.dtype = CHOLMOD_DOUBLE;
  cholmod_dense *result = cholmod_solve(system, L, &dense, &common);
  check();
  const double *values = static_cast<const double *>(result->x);
  const Vector<double> solution(values, values + right_hand_side.size());
  cholmod_free_dense(&result, &common);
  return solution;
}

SchurComplement::SchurComplement(const SymmetricMatrix &A, const Vector<double> &f,
                                 const std::vector<unsigned int> &contact,
                                 const FullMatrix<double> &B)
    : factor(std::make_unique<Factor>())
{
  const OneThread one_thread;
  const unsigned int n = A.n(), n_contact = contact.size();
  if (n == 0)
    return;
  std::vector<int> is_contact(n, 0);
  if (n_contact < n) // else all are in one group, and CAMD wants its number to be below n
    for (const unsigned int unknown : contact)
      is_contact[unknown] = 1;
  cholmod_sparse matrix = as_cholmod(A);
  factor->compute(&matrix, is_contact, n_contact > 0 ? DenseWork{n_contact, B.m()}.bytes() : 0.);

  Vector<double> permuted(n);
  for (unsigned int i = 0; i < n; ++i)
    permuted[i] = f[factor->permutation[i]];
  factor->y = factor->solve(CHOLMOD_L, permuted);
  if (n_contact == 0)
    return;

  const LAPACKFullMatrix<double> L_cc = factor->trailing_block(n_contact);
  Y.reinit(n_contact, B.m());
  for (unsigned int k = 0; k < n_contact; ++k)
  {
    const unsigned int unknown = factor->permutation[n - n_contact + k];
    const unsigned int column =
        std::lower_bound(contact.begin(), contact.end(), unknown) - contact.begin();
    for (unsigned int m = 0; m < B.m(); ++m)
      Y(k, m) = B(m, column);
  }
  L_cc.solve(Y);
  schur_matrix.reinit(B.m(), B.m());
  Y.Tmmult(schur_matrix, Y);
  reduced_load.reinit(B.m());
  Vector<double> y_contact(factor->y.begin() + (n - n_contact), factor->y.end());
  Y.Tvmult(reduced_load, y_contact);
}

SchurComplement::~SchurComplement() = default;

const LAPACKFullMatrix<double> &SchurComplement::S() const
{
  return schur_matrix;
}

const Vector<double> &SchurComplement::d() const
{
  return reduced_load;
}

Vector<double> SchurComplement::displacement(const Vector<double> &lambda) const
{
  const OneThread one_thread;
  const unsigned int n = factor->permutation.size();
  Vector<double> x(n);
  if (n == 0)
    return x;
  Vector<double> y(factor->y);
  if (lambda.size() > 0)
  {
    Vector<double> correction(Y.m());
    Y.vmult(correction, lambda);
    for (unsigned int k = 0; k < correction.size(); ++k)
      y[n - correction.size() + k] -= correction[k];
  }
  const Vector<double> permuted = factor->solve(CHOLMOD_Lt, y);
  for (unsigned int i = 0; i < n; ++i)
    x[factor->permutation[i]] = permuted[i];
  return x;
}

Vector<double> SchurComplement::solve(const Vector<double> &f) const
{
  const OneThread one_thread;
  const std::vector<int> &permutation = factor->permutation;
  Vector<double> x(f.size()), permuted(f.size());
  if (f.size() == 0)
    return x;
  for (unsigned int i = 0; i < f.size(); ++i)
    permuted[i] = f[permutation[i]];
  permuted = factor->solve(CHOLMOD_Lt, factor->solve(CHOLMOD_L, permuted));
  for (unsigned int i = 0; i < f.size(); ++i)
    x[permutation[i]] = permuted[i];
  return x;
}

std::size_t SchurComplement::factor_entries() const
{
  return factor->L ? factor->L->xsize : 0;
}
} // namespace hpvi
