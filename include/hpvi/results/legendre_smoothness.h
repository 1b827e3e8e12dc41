// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_legendre_smoothness_h
#define hpvi_legendre_smoothness_h

#include <deal.II/lac/full_matrix.h>
#include <hpvi/plane/solution.h>

#include <map>
#include <vector>

namespace hpvi
{
/**
 * How smooth is a polynomial on [0,1]^dim? The Legendre coefficients of an analytic function decay
 * like `|u_ij| ~ C exp(-b (i+j))` (4.81); b is found by linear regression over all modes but the
 * mean.
 *
 * Coefficients are those of the standard Legendre polynomials (L_k(1) = 1),
 * `c_ij = (2i+1)(2j+1)/4 int u L_i L_j` over the reference square. Modes below
 * @ref relative_floor times the largest coefficient of the cell (all components, mean included)
 * are round-off and left out, so that neither units nor exact zeros matter. A component of which
 * fewer than two different orders i+j remain has no say; where none has, b = 0 and the cell is
 * bisected, which is safe for any function.
 */
template <int dim>
class LegendreSmoothness
{
public:
  static constexpr double relative_floor = 1e-12;

  explicit LegendreSmoothness(SmoothnessReading reading);

  /** Decay rate b of the cell @p cell of @p solution. */
  double decay_rate(const Solution<dim> &solution, unsigned int cell) const;

  /**
   * Decay rate of vector-valued nodal coefficients, component by component in deal.II's numbering
   * of FE_Q(degree).
   */
  double decay_rate(const std::vector<double> &coefficients, unsigned int degree) const;

  /**
   * Legendre coefficients of scalar nodal coefficients, lexicographic: i + (p+1) j.
   */
  std::vector<double> legendre_coefficients(const double *nodal, unsigned int degree) const;

private:
  /** Projection of the 1D nodal basis, and deal.II's numbering as a lexicographic one. */
  struct Projection
  {
    dealii::FullMatrix<double> matrix;
    std::vector<unsigned int> lexicographic;
  };
  const Projection &projection(unsigned int degree) const;

  const SmoothnessReading reading;
  mutable std::map<unsigned int, Projection> projections;
};
} // namespace hpvi

#endif
