// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/schur_complement.h>

namespace hpvi
{
using namespace dealii;

SchurComplement::SchurComplement(const LinearSolver &solver, const Vector<double> &f,
                                 const ConditionRows &rows)
    : solver(solver), y(solver.forward(f)), schur_matrix(rows.n_rows()),
      reduced_load(rows.prescribed)
{
  const unsigned int n_kept = rows.kept.size();
  if (n_kept == 0)
    return;
  std::vector<unsigned int> row_of(n_kept); // of C and Y, by place in kept
  for (unsigned int k = 0; k < n_kept; ++k)
    row_of[solver.kept_order()[k]] = k;
  Y.reinit(n_kept, rows.n_rows());
  for (unsigned int i = 0; i < rows.n_rows(); ++i)
    for (const auto &[place, weight] : rows.B[i])
      Y(row_of[place], i) = weight;
  solver.kept_factor().solve(Y);
  Y.Tmmult(schur_matrix, Y);
  const Vector<double> kept(y.end() - n_kept, y.end());
  Y.Tvmult(reduced_load, kept, /*adding=*/true);
}

const LAPACKFullMatrix<double> &SchurComplement::S() const
{
  return schur_matrix;
}

const Vector<double> &SchurComplement::d() const
{
  return reduced_load;
}

Vector<double> SchurComplement::displacement(const Vector<double> &z) const
{
  Vector<double> rest(y);
  if (Y.m() > 0)
  {
    Vector<double> change(Y.m());
    Y.vmult(change, z);
    for (unsigned int k = 0; k < change.size(); ++k)
      rest[rest.size() - change.size() + k] -= change[k];
  }
  return solver.backward(rest);
}
} // namespace hpvi
