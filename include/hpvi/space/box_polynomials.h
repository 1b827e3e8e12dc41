// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_box_polynomials_h
#define hpvi_box_polynomials_h

#include <hpvi/bound/legendre.h>
#include <hpvi/space/box_equilibration.h>

#include <deal.II/base/quadrature_lib.h>

#include <array>
#include <cmath>
#include <vector>

namespace hpvi
{
/** Bernstein's polynomials of degree @p p at @p s in [0,1]. */
std::vector<double> bernstein(unsigned int p, double s);

/** Their values at points: by point and polynomial. */
dealii::FullMatrix<double> bernstein_at(const std::vector<double> &points, unsigned int p);

/** Matrices between what represents a polynomial of degree p in one variable. */
struct Representations
{
  explicit Representations(unsigned int p);

  LegendreTables tables;
  const dealii::QGauss<1> gauss, fine, finer;
  std::vector<double> nodes;                     ///< of Gauss and Lobatto
  const dealii::FullMatrix<double> to_gauss;     ///< values of modes at gauss
  dealii::FullMatrix<double> from_gauss;         ///< Bernstein coefficients of values at gauss
  const dealii::FullMatrix<double> gauss_values; ///< the other way
  dealii::FullMatrix<double> nodal;              ///< Bernstein coefficients of values at nodes
  dealii::FullMatrix<double> to_nodes;           ///< the other way
  const dealii::FullMatrix<double> &modes;       ///< of values at nodes
  dealii::FullMatrix<double> modes_transposed;
  const dealii::FullMatrix<double> to_fine;       ///< values at #fine of Bernstein coefficients
  const dealii::FullMatrix<double> modes_to_fine; ///< of modes
  const dealii::FullMatrix<double> to_finer;      ///< values at #finer of Bernstein coefficients
};

/** Values of f at tensor products of @p rule on a face or, @p face invalid, in a cell. */
template <class F>
void at_points(const dealii::QGauss<1> &rule, const unsigned int n_axes, const F &f)
{
  const unsigned int n = rule.size(), n_points = std::pow(n, n_axes);
  for (unsigned int q = 0; q < n_points; ++q)
  {
    std::array<double, 3> x{};
    double weight = 1;
    for (unsigned int d = 0, rest = q; d < n_axes; ++d, rest /= n)
    {
      x[d] = rule.point(rest % n)[0];
      weight *= rule.weight(rest % n);
    }
    f(q, x, weight);
  }
}

dealii::Point<3> on_cell_face(unsigned int face, const std::array<double, 3> &x);

/** Values of a polynomial on a face, by Bernstein coefficients; none: of zero. */
BoxModes at(const dealii::FullMatrix<double> &values, const BoxModes &coefficients);
} // namespace hpvi

#endif
