// SPDX-License-Identifier: LGPL-2.1-or-later

// With moments as unknowns and the contact last, the quadratic program (5.7) is read off the
// factor. $B$ has entries on the interface dofs only, so with $Y = C^{-1}B^T$ and the forward
// solution $y = L^{-1}f$
//
// $$S = BA^{-1}B^T = Y^TY, \qquad d = BA^{-1}f = Y^T y_{\text{last}}.$$
//
// As a product of a matrix with its transpose $S$ is symmetric, and positive semidefinite up to the
// rounding of one product.
#include <hpvi/algebra/dense_algebra.h>
#include <hpvi/algebra/schur_complement.h>
#include <hpvi/algebra/triangular.h>
#include <hpvi/base/thread_pool.h>

namespace hpvi
{
using namespace dealii;

// @sect3{S and d}
//
// One triangular solution with a dense matrix of the size of the contact, and one product. Both are
// done by BLAS, some columns at a time, as many whatever the number of threads.
namespace
{
/** Y := C^-1 Y, S := Y'Y */
void reduce(const LAPACKFullMatrix<double> &C, LAPACKFullMatrix<double> &Y,
            LAPACKFullMatrix<double> &S)
{
  const unsigned int n = Y.m(), n_columns = Y.n(), grain = 64;
  if (n_columns == 0)
    return;
  double *const y = &Y(0, 0), *const s = &S(0, 0);
  parallel_for(
      n_columns, grain,
      [&](const unsigned int begin, const unsigned int end) {
        solve_triangular('N', n, end - begin, {&C(0, 0), n}, y + std::size_t(begin) * n, n);
      });
  parallel_for(n_columns, grain,
               [&](const unsigned int begin, const unsigned int end)
               {
                 double *const columns = s + std::size_t(begin) * n_columns;
                 multiply('T', 'N', end, end - begin, n, 1., {y, n},
                          {y + std::size_t(begin) * n, n}, 0., columns, n_columns);
               });
  for (unsigned int j = 0; j < n_columns; ++j)
    for (unsigned int i = j + 1; i < n_columns; ++i)
      S(i, j) = S(j, i);
}
} // namespace

SchurComplement::SchurComplement(const LinearSolver &solver, const Vector<double> &f,
                                 const ConditionRows &rows)
    : solver(solver), schur_matrix(rows.n_rows())
{
  const unsigned int n_kept = rows.interface.size();
  if (n_kept == 0)
  {
    set_load(f, rows.prescribed);
    return;
  }
  std::vector<unsigned int> row_of(n_kept); // of C and Y, by place in interface
  for (unsigned int k = 0; k < n_kept; ++k)
    row_of[solver.interface_order()[k]] = k;
  Y.reinit(n_kept, rows.n_rows());
  for (unsigned int i = 0; i < rows.n_rows(); ++i)
    for (const auto &[place, weight] : rows.B[i])
      Y(row_of[place], i) = weight;
  reduce(solver.kept_factor(), Y, schur_matrix);
  set_load(f, rows.prescribed);
}

void SchurComplement::set_load(const Vector<double> &f, const Vector<double> &prescribed)
{
  y = solver.forward(f);
  reduced_load = prescribed;
  if (Y.m() == 0)
    return;
  const Vector<double> interface(y.end() - Y.m(), y.end());
  Y.Tvmult(reduced_load, interface, /*adding=*/true);
}

const LAPACKFullMatrix<double> &SchurComplement::S() const
{
  return schur_matrix;
}

const Vector<double> &SchurComplement::d() const
{
  return reduced_load;
}

// @sect3{The displacement}
//
// From (5.3), $x = A^{-1}(f - B^Tz) = L^{-T}(y - (0, Yz))$: the multiplier changes the last part of
// the forward solution, and one backward substitution is all that the displacement costs.
Vector<double> SchurComplement::displacement(const Vector<double> &z) const
{
  return backward(y, z);
}

Vector<double> SchurComplement::response(const Vector<double> &z) const
{
  return backward(Vector<double>(y.size()), z);
}

Vector<double> SchurComplement::backward(Vector<double> right_hand_side,
                                         const Vector<double> &z) const
{
  if (Y.m() > 0)
  {
    Vector<double> change(Y.m());
    Y.vmult(change, z);
    for (unsigned int k = 0; k < change.size(); ++k)
      right_hand_side[right_hand_side.size() - change.size() + k] -= change[k];
  }
  return solver.backward(right_hand_side);
}
} // namespace hpvi
