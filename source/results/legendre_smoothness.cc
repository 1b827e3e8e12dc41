// SPDX-License-Identifier: LGPL-2.1-or-later

// Bisect or raise $p$? If $u$ is analytic in a cell its Legendre coefficients decay like (4.81),
//
// $$|u_{ij}| \le C\exp(-b(i+j)),$$
//
// the faster, the further away its singularities are in units of the cell: $b = \ln(1 + \sigma/h)$.
// Around a singularity they decay only algebraically, and a fitted $b$ is small. So $b$ of the
// discrete solution tells in which of both cases a cell is; the strategies compare it with a
// number, 1 in the thesis.
#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_tools.h>
#include <hpvi/results/legendre_smoothness.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace hpvi
{
using namespace dealii;

// @sect3{A line through logarithms}
//
// $\ln|u_{ij}| = \ln C - b(i+j)$ is a straight line. Points are coefficients; those that are zero
// by symmetry, or round-off, are left out, and a fit may have too few points to exist.
namespace
{
/** Least-squares line through the points that were added. */
class Regression
{
public:
  void add(const double x, const double y)
  {
    ++n;
    sum_x += x;
    sum_y += y;
    sum_xx += x * x;
    sum_xy += x * y;
  }

  /** Minus the slope; nothing where fewer than two different x leave it undefined. */
  std::optional<double> decay() const
  {
    const double spread = n * sum_xx - sum_x * sum_x; // integers: exactly 0 where x never changes
    if (spread <= 0.)
      return std::nullopt;
    return -(n * sum_xy - sum_x * sum_y) / spread;
  }

private:
  double n = 0, sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
};

/** i + j (+ k) of a lexicographic mode number. */
template <int dim>
std::array<unsigned int, dim> orders(unsigned int mode, const unsigned int degree)
{
  std::array<unsigned int, dim> order;
  for (unsigned int d = 0; d < dim; ++d, mode /= degree + 1)
    order[d] = mode % (degree + 1);
  return order;
}
} // namespace

// @sect3{Coefficients from nodal values}
//
// The polynomial is known by its values at tensor products of Gauss-Lobatto points. One small
// matrix, applied in one direction after the other, makes Legendre coefficients of them: $(p+1)^3$
// operations in place of $(p+1)^4$.
template <int dim>
LegendreSmoothness<dim>::LegendreSmoothness(const SmoothnessReading reading) : reading(reading)
{
}

template <int dim>
const typename LegendreSmoothness<dim>::Projection &
LegendreSmoothness<dim>::projection(const unsigned int degree) const
{
  auto found = projections.find(degree);
  if (found == projections.end())
  {
    const auto lagrange =
        Polynomials::generate_complete_Lagrange_basis(QGaussLobatto<1>(degree + 1).get_points());
    const QGauss<1> gauss(degree + 1);
    Projection result{FullMatrix<double>(degree + 1, degree + 1),
                      FETools::hierarchic_to_lexicographic_numbering<dim>(degree)};
    for (unsigned int k = 0; k <= degree; ++k)
      for (unsigned int i = 0; i <= degree; ++i)
        for (unsigned int q = 0; q < gauss.size(); ++q)
        {
          const double x = gauss.point(q)[0];
          result.matrix(k, i) +=
              (2 * k + 1) * gauss.weight(q) * std::legendre(k, 2 * x - 1) * lagrange[i].value(x);
        }
    found = projections.emplace(degree, std::move(result)).first;
  }
  return found->second;
}

template <int dim>
std::vector<double> LegendreSmoothness<dim>::legendre_coefficients(const double *nodal,
                                                                   const unsigned int degree) const
{
  const Projection &to_legendre = projection(degree);
  const unsigned int n = degree + 1, n_modes = to_legendre.lexicographic.size();
  std::vector<double> current(n_modes), next(n_modes);
  for (unsigned int i = 0; i < n_modes; ++i)
    current[to_legendre.lexicographic[i]] = nodal[i];
  // One direction after the other; each pass moves its direction to the slowest place, so that
  // after dim passes all are back where they were.
  for (unsigned int d = 0; d < dim; ++d)
  {
    const unsigned int n_lines = n_modes / n;
    for (unsigned int line = 0; line < n_lines; ++line)
      for (unsigned int k = 0; k < n; ++k)
      {
        double sum = 0;
        for (unsigned int i = 0; i < n; ++i)
          sum += to_legendre.matrix(k, i) * current[line * n + i];
        next[k * n_lines + line] = sum;
      }
    current.swap(next);
  }
  return current;
}

// @sect3{The decay rate}
//
// The thesis does not say what is fitted when a displacement has two components, and its tables can
// be followed longest, if not to the end, with the <i>joint</i> reading: one fit of the Euclidean
// norm over components, scaled to the $L^2$ norms of the polynomials. The <i>plain</i> reading fits
// each component and takes the smaller rate, so that a singularity of either is seen. The constant
// is not fitted: it says how large $u$ is.
template <int dim>
double LegendreSmoothness<dim>::decay_rate(const std::vector<double> &coefficients,
                                           const unsigned int degree) const
{
  const unsigned int n_modes = coefficients.size() / dim;
  std::array<std::vector<double>, dim> c;
  double largest = 0;
  for (unsigned int component = 0; component < dim; ++component)
  {
    c[component] = legendre_coefficients(&coefficients[component * n_modes], degree);
    for (const double value : c[component])
      largest = std::max(largest, std::abs(value));
  }
  const double floor = relative_floor * largest;

  std::array<Regression, dim> single;
  Regression joint;
  for (unsigned int mode = 1; mode < n_modes; ++mode)
  {
    double order = 0, factor = 1, square = 0;
    for (const unsigned int k : orders<dim>(mode, degree))
    {
      order += k;
      factor *= 2 * k + 1;
    }
    for (unsigned int component = 0; component < dim; ++component)
    {
      const double value = std::abs(c[component][mode]);
      square += value * value;
      if (value > floor)
        single[component].add(order, std::log(value));
    }
    if (std::sqrt(square) > floor)
      joint.add(order, std::log(std::sqrt(factor * square)));
  }
  if (reading == SmoothnessReading::joint)
    return joint.decay().value_or(0.);
  std::optional<double> smallest;
  for (const Regression &fit : single)
    if (const auto decay = fit.decay())
      smallest = std::min(*decay, smallest.value_or(*decay));
  return smallest.value_or(0.);
}

template <int dim>
double LegendreSmoothness<dim>::decay_rate(const Solution<dim> &solution,
                                           const unsigned int cell) const
{
  const unsigned int degree = solution.displacement_space.degrees()[cell];
  return decay_rate(solution.coefficients(cell), degree);
}

template class LegendreSmoothness<2>;
} // namespace hpvi
