// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/dense_algebra.h>
#include <hpvi/plane/face_axes.h>
#include <hpvi/space/box_polynomials.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_tools.h>

namespace hpvi
{
using namespace dealii;

std::vector<double> bernstein(const unsigned int p, const double s)
{
  std::vector<double> result(p + 1);
  double binomial = 1;
  for (unsigned int i = 0; i <= p; binomial *= double(p - i) / (i + 1), ++i)
    result[i] = binomial * std::pow(s, i) * std::pow(1 - s, p - i);
  return result;
}

FullMatrix<double> bernstein_at(const std::vector<double> &points, const unsigned int p)
{
  FullMatrix<double> result(points.size(), p + 1);
  for (unsigned int q = 0; q < points.size(); ++q)
  {
    const std::vector<double> values = bernstein(p, points[q]);
    for (unsigned int j = 0; j <= p; ++j)
      result(q, j) = values[j];
  }
  return result;
}

namespace
{
FullMatrix<double> values_at(const QGauss<1> &rule, const unsigned int p)
{
  std::vector<double> points;
  for (const Point<1> &x : rule.get_points())
    points.push_back(x[0]);
  return bernstein_at(points, p);
}

/** Values of modes. */
FullMatrix<double> modes_at(const QGauss<1> &rule, const unsigned int p)
{
  FullMatrix<double> result(rule.size(), p + 1);
  for (unsigned int q = 0; q < rule.size(); ++q)
  {
    const std::vector<double> L = legendre::values(p + 1, 2 * rule.point(q)[0] - 1);
    for (unsigned int j = 0; j <= p; ++j)
      result(q, j) = L[j];
  }
  return result;
}
} // namespace

Representations::Representations(const unsigned int p)
    : gauss(p + 1), fine(p + 6), finer(2 * p + 12), nodes(p + 1), to_gauss(modes_at(gauss, p)),
      from_gauss(p + 1, p + 1), gauss_values(values_at(gauss, p)), nodal(p + 1, p + 1),
      to_nodes(p + 1, p + 1), modes(tables.from_nodes(p)), modes_transposed(p + 1, p + 1),
      to_fine(values_at(fine, p)), modes_to_fine(modes_at(fine, p)), to_finer(values_at(finer, p))
{
  const FE_Q<1> element(p);
  const std::vector<unsigned int> numbers = FETools::hierarchic_to_lexicographic_numbering<1>(p);
  FullMatrix<double> at_nodes(p + 1, p + 1);
  for (unsigned int i = 0; i <= p; ++i)
  {
    nodes[numbers[i]] = element.get_unit_support_points()[i][0];
    const std::vector<double> of_node = bernstein(p, nodes[numbers[i]]);
    for (unsigned int j = 0; j <= p; ++j)
      at_nodes(numbers[i], j) = of_node[j];
  }
  to_nodes = at_nodes;
  nodal.invert(at_nodes);
  from_gauss.invert(gauss_values);
  modes_transposed.copy_transposed(modes);
}

Point<3> on_cell_face(const unsigned int face, const std::array<double, 3> &x)
{
  const auto axes = tangents<3>(face);
  Point<3> result;
  result[axes[0]] = x[0];
  result[axes[1]] = x[1];
  result[face / 2] = face % 2;
  return result;
}

BoxModes at(const FullMatrix<double> &values, const BoxModes &coefficients)
{
  return coefficients.empty() ? BoxModes(values.m() * values.m())
                              : along_axes(values, coefficients, 2);
}
} // namespace hpvi
