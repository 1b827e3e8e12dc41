// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_tools.h>
#include <hpvi/base/memo_table.h>
#include <hpvi/bound/legendre.h>

#include <cmath>

namespace hpvi
{
using namespace dealii;

void legendre::set_values(const unsigned int n, const double x, double *const L)
{
  double before = 0, P = 1;
  for (unsigned int i = 0; i < n; ++i)
  {
    L[i] = P * at_end(i, true);
    const double next = recurrences[i].up * x * P - recurrences[i].down * before;
    before = P;
    P = next;
  }
}

std::vector<double> legendre::values(const unsigned int n, const double x)
{
  std::vector<double> L(n);
  set_values(n, x, L.data());
  return L;
}

const std::array<double, legendre::n_roots> legendre::roots = []
{
  std::array<double, n_roots> result;
  for (unsigned int i = 0; i < n_roots; ++i)
    result[i] = std::sqrt(2. * i + 1);
  return result;
}();

const std::array<legendre::Recurrence, legendre::n_roots> legendre::recurrences = []
{
  std::array<Recurrence, n_roots> result;
  for (unsigned int i = 0; i < n_roots; ++i)
    result[i] = {(2. * i + 1.) / (i + 1.), i / (i + 1.)};
  return result;
}();

double legendre::shift(const unsigned int i)
{
  return i == 0 ? 0. : i / (root(i) * root(i - 1));
}

FullMatrix<double> legendre::restriction(const unsigned int n, const double begin, const double end)
{
  FullMatrix<double> result(n, n);
  const QGauss<1> gauss(n);
  for (unsigned int q = 0; q < n; ++q)
  {
    const double s = gauss.point(q)[0];
    const std::vector<double> own = values(n, 2 * s - 1),
                              whole = values(n, 2 * (begin + s * (end - begin)) - 1);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        result(i, j) += 2 * gauss.weight(q) * own[i] * whole[j];
  }
  return result;
}

double legendre::evaluate(const std::vector<double> &coefficients, const double x)
{
  double sum = 0, P = 1, before = 0; // as in values()
  for (unsigned int i = 0; i < coefficients.size(); ++i)
  {
    sum += coefficients[i] * P * at_end(i, true);
    const double next = recurrences[i].up * x * P - recurrences[i].down * before;
    before = P;
    P = next;
  }
  return sum;
}

const FullMatrix<double> &LegendreTables::projection(const unsigned int n,
                                                     const unsigned int n_gauss) const
{
  const auto make = [&]()
  {
    const QGauss<1> gauss(n_gauss);
    FullMatrix<double> result(n, n_gauss);
    for (unsigned int q = 0; q < n_gauss; ++q)
    {
      const std::vector<double> L = legendre::values(n, 2 * gauss.point(q)[0] - 1);
      for (unsigned int i = 0; i < n; ++i)
        result(i, q) = 2 * gauss.weight(q) * L[i];
    }
    return result;
  };
  return memoised(projections, {{n, n_gauss}}, make);
}

const FullMatrix<double> &LegendreTables::part(const unsigned int n, const unsigned int part) const
{
  const auto turned = [&]()
  {
    FullMatrix<double> result(n, n);
    for (unsigned int i = 0; i < n; ++i)
      result(i, i) = i % 2 ? -1. : 1.;
    return result;
  };
  const auto half = [&]() { return legendre::restriction(n, 0.5 * part, 0.5 * (part + 1)); };
  const std::array<unsigned int, 2> key{{n, part}};
  return part == 2 ? memoised(parts, key, turned) : memoised(parts, key, half);
}

const FullMatrix<double> &LegendreTables::from_nodes(const unsigned int degree) const
{
  const auto make = [&]()
  {
    const unsigned int n = degree + 1;
    const QGauss<1> gauss(n);
    const auto basis =
        Polynomials::generate_complete_Lagrange_basis(QGaussLobatto<1>(n).get_points());
    FullMatrix<double> lagrange(n, n);
    for (unsigned int q = 0; q < n; ++q)
      for (unsigned int i = 0; i < n; ++i)
        lagrange(q, i) = basis[i].value(gauss.point(q)[0]);
    FullMatrix<double> result(n, n);
    projection(n, n).mmult(result, lagrange);
    return result;
  };
  return memoised(nodal, degree, make);
}

FullMatrix<double> LegendreTables::displacement_modes(const std::vector<double> &coefficients,
                                                      const unsigned int component,
                                                      const unsigned int degree) const
{
  const unsigned int n = degree + 1;
  const std::vector<unsigned int> &lexicographic =
      memoised(numberings, degree,
               [&]() { return FETools::hierarchic_to_lexicographic_numbering<2>(degree); });
  FullMatrix<double> values(n, n), half(n, n), result(n, n);
  for (unsigned int i = 0; i < n * n; ++i)
    values(lexicographic[i] % n, lexicographic[i] / n) = coefficients[component * n * n + i];
  from_nodes(degree).mmult(half, values);
  half.mTmult(result, from_nodes(degree));
  return result;
}
} // namespace hpvi
