// SPDX-License-Identifier: LGPL-2.1-or-later

// Rows of a stress are fields of Raviart and Thomas, each for itself. The contravariant map keeps divergences and tractions, whatever
// the cell looks like; what it does not keep, symmetry, the bound pays for (doc/bound.md).
#include <hpvi/algebra/triangular.h>
#include <hpvi/bound/corner_stress.h>
#include <hpvi/bound/legendre.h>
#include <hpvi/bound/row_element.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr char cells[] = "the rows of stresses";

/** L_i, and N_i, the integral of L_i from -1, for i <= k at x. */
struct Values
{
  Values(const unsigned int k, const double x) : L(legendre::values(k + 2, x)), N(k + 1)
  {
    N[0] = (1 + x) * L[0];
    for (unsigned int i = 1; i <= k; ++i) // P_{i+1} - P_{i-1} = (2i + 1) int P_i
      N[i] = legendre::root(i) *
             (L[i + 1] / legendre::root(i + 1) - L[i - 1] / legendre::root(i - 1)) / (2 * i + 1);
  }

  std::vector<double> L, N;
};
} // namespace

RowTable::RowTable(const unsigned int degree, const unsigned int n_gauss,
                   const unsigned int marked_corners)
    : k(degree), n_gauss(n_gauss)
{
  for (unsigned int corner = 0; corner < 4; ++corner)
    if (marked_corners & (1u << corner))
      corners.push_back(corner);
  const Quadrature<2> rule = corners.empty() ? QGauss<2>(n_gauss) : corner_quadrature(n_gauss);
  points = rule.get_points();
  for (unsigned int q = 0; q < points.size(); ++q)
  {
    weights.push_back(4 * rule.weight(q));
    const auto values = at(points[q]);
    for (unsigned int d = 0; d < 2; ++d)
      fields[d].insert(fields[d].end(), values[d].begin(), values[d].end());
  }
}

std::array<std::vector<double>, 2> RowTable::at(const Point<2> &reference) const
{
  const Values x(k, 2 * reference[0] - 1), y(k, 2 * reference[1] - 1);
  std::array<std::vector<double>, 2> result;
  const auto add = [&](const double xi, const double eta)
  {
    result[0].push_back(xi);
    result[1].push_back(eta);
  };
  for (unsigned int i = 1; i <= k; ++i)
    for (unsigned int j = 1; j <= k; ++j)
      add(x.N[i] * y.L[j], -x.L[i] * y.N[j]);
  for (unsigned int face = 0; face < 4; ++face)
  {
    const double s = reference[face / 2], near = face % 2 ? s : 1 - s, turn = face % 2 ? -0.5 : 0.5;
    const Values &along = face < 2 ? y : x;
    for (unsigned int i = 0; i <= k; ++i)
    {
      const double own = near * along.L[i], other = i > 0 ? turn * along.N[i] : 0.;
      face < 2 ? add(own, other) : add(other, own);
    }
  }
  for (unsigned int i = 0; i <= k; ++i)
    for (unsigned int j = 0; j <= k; ++j)
      i > 0 ? add(x.N[i] * y.L[j], 0.) : add(0., j > 0 ? std::sqrt(0.5) * y.N[j] : 0.);
  for (const unsigned int corner : corners)
  {
    const auto [xx, yy, xy] =
        corner_stress(k + 1, corner, 2 * reference[0] - 1, 2 * reference[1] - 1);
    add(xx, xy);
    add(xy, yy);
  }
  return result;
}

// @sect3{At points}
RowValues::RowValues(const RowTable &table, const RowShape &shape) : table(table), compliance()
{
  const HookesLaw<2> law(*shape.law);
  std::array<SymmetricTensor<2, 2>, 3> unit;
  for (unsigned int a = 0; a < 3; ++a)
    unit[a].access_raw_entry(a) = 1.;
  std::vector<double> product(9);
  for (unsigned int a = 0; a < 3; ++a)
    for (unsigned int b = 0; b < 3; ++b)
      product[3 * a + b] = law.complementary_product(unit[a], unit[b]);
  require_regular(cholesky(3, product.data(), 3), cells);
  for (unsigned int a = 0; a < 3; ++a)
    for (unsigned int b = a; b < 3; ++b)
      compliance[b][a] = product[3 * a + b];
  for (unsigned int q = 0; q < table.points.size(); ++q)
  {
    const Tensor<2, 2> J = shape.map.jacobian(table.points[q]) / (2 * shape.h);
    const double det = determinant(J);
    require_regular(det > 0, cells);
    roots.push_back(std::sqrt(table.weights[q] * det));
    for (unsigned int row = 0; row < 2; ++row)
    {
      Frame frame;
      for (unsigned int d = 0; d < 2; ++d)
      {
        // of a unit component along d: (s_row,0, s_row,1)
        const std::array<double, 2> s{{J[0][d] / det, J[1][d] / det}};
        const std::array<double, 3> symmetric = row == 0
                                                    ? std::array<double, 3>{{s[0], 0., s[1] / 2}}
                                                    : std::array<double, 3>{{0., s[1], s[0] / 2}};
        for (unsigned int a = 0; a < 3; ++a)
        {
          frame[a][d] = 0;
          for (unsigned int b = a; b < 3; ++b)
            frame[a][d] += roots[q] * compliance[b][a] * symmetric[b];
        }
        frame[3][d] = roots[q] * std::sqrt(RowElement::theta) * shape.antisymmetry *
                      (row == 0 ? s[1] : -s[0]);
      }
      frames[row].push_back(frame);
    }
  }
}

void RowValues::add(const std::vector<double> &coefficients, std::vector<double> &values) const
{
  const unsigned int n = table.n_fields(), n_points = table.points.size();
  std::vector<double> field(n_points);
  for (unsigned int row = 0; row < 2; ++row)
    for (unsigned int d = 0; d < 2; ++d)
    {
      multiply('T', 'N', n_points, 1, n, 1., {table.fields[d].data(), n},
               {&coefficients[row * n], n}, 0., field.data(), n_points);
      for (unsigned int part = 0; part < n_parts; ++part)
        for (unsigned int q = 0; q < n_points; ++q)
          values[part * n_points + q] += frames[row][q][part][d] * field[q];
    }
}

std::vector<double> RowValues::derivatives(const std::vector<double> &values) const
{
  const unsigned int n = table.n_fields(), n_points = table.points.size();
  std::vector<double> result(2 * n), field(n_points);
  for (unsigned int row = 0; row < 2; ++row)
    for (unsigned int d = 0; d < 2; ++d)
    {
      std::fill(field.begin(), field.end(), 0.);
      for (unsigned int part = 0; part < n_parts; ++part)
        for (unsigned int q = 0; q < n_points; ++q)
          field[q] += frames[row][q][part][d] * values[part * n_points + q];
      multiply('N', 'N', n, 1, n_points, 1., {table.fields[d].data(), n}, {field.data(), n_points},
               1., &result[row * n], n);
    }
  return result;
}

void RowValues::subtract(const unsigned int q, const SymmetricTensor<2, 2> &sigma, const double psi,
                         std::vector<double> &values) const
{
  for (unsigned int a = 0; a < 3; ++a)
    for (unsigned int b = a; b < 3; ++b)
      values[a * table.points.size() + q] -=
          roots[q] * psi * compliance[b][a] * sigma.access_raw_entry(b);
}

/** So many fields of one row, from the first on. */
void RowValues::append(const unsigned int row, const unsigned int first, const unsigned int count,
                       const double factor, std::vector<double> &columns) const
{
  const unsigned int n = table.n_fields(), n_points = table.points.size();
  for (unsigned int m = first; m < first + count; ++m)
    for (unsigned int part = 0; part < n_parts; ++part)
      for (unsigned int q = 0; q < n_points; ++q)
      {
        const auto &frame = frames[row][q][part];
        columns.push_back(factor * (frame[0] * table.fields[0][std::size_t(q) * n + m] +
                                    frame[1] * table.fields[1][std::size_t(q) * n + m]));
      }
}

std::vector<double> RowValues::bubbles() const
{
  std::vector<double> result;
  for (unsigned int row = 0; row < 2; ++row)
    append(row, 0, table.k * table.k, 1., result);
  return result;
}

std::vector<double> RowValues::edges(const std::array<double, 4> &scale) const
{
  std::vector<double> result;
  for (unsigned int face = 0; face < 4; ++face)
    for (unsigned int row = 0; row < 2; ++row)
      append(row, table.of_face(face), table.k + 1, scale[face], result);
  return result;
}

// @sect3{The element}
namespace
{
std::array<double, 4> over(const std::array<double, 4> &densities, const double h)
{
  std::array<double, 4> result = densities;
  for (double &value : result)
    value /= h;
  return result;
}
} // namespace

RowElement::RowElement(const RowTable &table, const RowShape &shape)
    : table(table), scale(over(shape.densities, shape.h))
{
  const RowValues values(table, shape);
  std::vector<double> B = values.bubbles();
  add_corners(shape, values, B);
  const std::vector<double> of_edges = values.edges(scale);
  const unsigned int n_rows = RowValues::n_parts * table.points.size(), n = n_bubbles(),
                     m = n_edges();
  L.resize(std::size_t(n) * n);
  W.resize(std::size_t(n) * m);
  G.resize(std::size_t(m) * m);
  const DensePart bubbles{B.data(), n_rows}, edges{of_edges.data(), n_rows};
  multiply('T', 'N', n, n, n_rows, 1., bubbles, bubbles, 0., L.data(), n);
  multiply('T', 'N', n, m, n_rows, 1., bubbles, edges, 0., W.data(), n);
  multiply('T', 'N', m, m, n_rows, 1., edges, edges, 0., G.data(), m);
  require_regular(cholesky(n, L.data(), n), cells);
  solve_triangular('N', n, m, {L.data(), n}, W.data(), n);
  multiply('T', 'N', m, m, n, -1., {W.data(), n}, {W.data(), n}, 1., G.data(), m);
  set_conditions(shape);
}

/** Forces along x and y and the moment about the middle, of tractions less divergences; those of tractions have length 1. */
void RowElement::set_conditions(const RowShape &shape)
{
  const unsigned int k = table.k, n = k + 1, m = n_edges();
  const Point<2> centre = shape.map.point({0.5, 0.5});
  const auto motion = [&](const unsigned int z, const Point<2> &reference)
  {
    const Tensor<1, 2> x = (shape.map.point(reference) - centre) / shape.h;
    return z < 2 ? Tensor<1, 2>({z == 0 ? 1. : 0., z == 1 ? 1. : 0.}) : Tensor<1, 2>({-x[1], x[0]});
  };
  N.assign(3 * m, 0.);
  N_divergence.assign(std::size_t(6) * n * n, 0.);
  const QGauss<1> gauss(table.n_gauss);
  for (unsigned int z = 0; z < 3; ++z)
  {
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const std::vector<double> along = legendre::values(n, 2 * gauss.point(q)[0] - 1);
      for (unsigned int face = 0; face < 4; ++face)
      {
        const Tensor<1, 2> v = motion(z, point_on_face<2>(face, gauss.point(q)));
        for (unsigned int row = 0; row < 2; ++row)
          for (unsigned int i = 0; i < n; ++i)
            N[z * m + (2 * face + row) * n + i] +=
                (face % 2 ? 2. : -2.) * scale[face] * gauss.weight(q) * v[row] * along[i];
      }
    }
    for (unsigned int q = 0; q < table.points.size(); ++q)
    {
      const Tensor<1, 2> v = motion(z, table.points[q]);
      const auto L_x = legendre::values(n, 2 * table.points[q][0] - 1),
                 L_y = legendre::values(n, 2 * table.points[q][1] - 1);
      for (unsigned int row = 0; row < 2; ++row)
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < n; ++j)
            N_divergence[((2 * z + row) * n + i) * n + j] +=
                table.weights[q] * v[row] * L_x[i] * L_y[j];
    }
    double length = 0;
    for (unsigned int i = 0; i < m; ++i)
      length += N[z * m + i] * N[z * m + i];
    length = std::sqrt(length);
    for (unsigned int i = 0; i < m; ++i)
      N[z * m + i] /= length;
    for (unsigned int i = 0; i < 2 * n * n; ++i)
      N_divergence[2 * z * n * n + i] /= length;
  }
}

TractionEnergy RowElement::energy() const
{
  const unsigned int n = table.k + 1;
  return {n, n, n_conditions, {G.data(), n_edges()}, {N.data(), n_edges()}};
}

std::array<double, 3> RowElement::moments(const double *const divergence) const
{
  const unsigned int n = 2 * (table.k + 1) * (table.k + 1);
  std::array<double, 3> result{};
  for (unsigned int z = 0; z < 3; ++z)
    for (unsigned int i = 0; i < n; ++i)
      result[z] += N_divergence[z * n + i] * divergence[i];
  return result;
}

/** A corner's stress is symmetric where its rows meet, at the corner: s = B S B'. Its fluxes are polynomials, whatever B is. */
void RowElement::add_corners(const RowShape &shape, const RowValues &values,
                             std::vector<double> &columns)
{
  const unsigned int n_fields = table.n_fields(), n = table.k + 1;
  const QGauss<1> gauss(n + 2);
  for (unsigned int c = 0; c < table.corners.size(); ++c)
  {
    const unsigned int corner = table.corners[c];
    const Tensor<2, 2> B = shape.map.jacobian(Point<2>(corner % 2, corner / 2)) / shape.h;
    std::vector<double> field(2 * n_fields);
    for (unsigned int row = 0; row < 2; ++row)
      for (unsigned int j = 0; j < 2; ++j)
        field[row * n_fields + table.of_corner(c) + j] = B[row][j];
    for (unsigned int face = 0; face < 4; ++face)
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const Point<2> at = point_on_face<2>(face, gauss.point(q));
        const auto [xx, yy, xy] = corner_stress(n, corner, 2 * at[0] - 1, 2 * at[1] - 1);
        const Tensor<1, 2> flux = B * (face < 2 ? Tensor<1, 2>({xx, xy}) : Tensor<1, 2>({xy, yy}));
        const std::vector<double> along = legendre::values(n, 2 * gauss.point(q)[0] - 1);
        for (unsigned int row = 0; row < 2; ++row)
          for (unsigned int i = 0; i < n; ++i)
            field[row * n_fields + table.of_face(face) + i] -=
                2 * gauss.weight(q) * flux[row] * along[i];
      }
    std::vector<double> column(RowValues::n_parts * table.points.size());
    values.add(field, column);
    columns.insert(columns.end(), column.begin(), column.end());
    corners.push_back(std::move(field));
  }
}

std::vector<double> RowElement::by_bubbles(const std::vector<double> &derivatives) const
{
  std::vector<double> result;
  for (unsigned int row = 0; row < 2; ++row)
    result.insert(result.end(), &derivatives[row * table.n_fields()],
                  &derivatives[row * table.n_fields()] + table.k * table.k);
  for (const std::vector<double> &corner : corners)
    result.push_back(std::inner_product(corner.begin(), corner.end(), derivatives.begin(), 0.));
  return result;
}

std::vector<double> RowElement::best_bubbles(const std::vector<double> &derivatives) const
{
  const unsigned int n = table.k * table.k, n_fields = table.n_fields();
  std::vector<double> y = by_bubbles(derivatives), result(2 * n_fields);
  solve_by_cholesky(n_bubbles(), L, y.data());
  for (unsigned int row = 0; row < 2; ++row)
    for (unsigned int i = 0; i < n; ++i)
      result[row * n_fields + i] = -y[row * n + i];
  for (unsigned int c = 0; c < corners.size(); ++c)
    for (unsigned int i = 0; i < result.size(); ++i)
      result[i] -= y[2 * n + c] * corners[c][i];
  return result;
}

std::vector<double> RowElement::reduced(const std::vector<double> &derivatives) const
{
  const unsigned int n = n_bubbles(), m = n_edges();
  std::vector<double> of_bubbles = by_bubbles(derivatives), result;
  solve_triangular('N', n, 1, {L.data(), n}, of_bubbles.data(), n);
  for (unsigned int face = 0; face < 4; ++face)
    for (unsigned int row = 0; row < 2; ++row)
      for (unsigned int i = 0; i <= table.k; ++i)
        result.push_back(scale[face] *
                         derivatives[row * table.n_fields() + table.of_face(face) + i]);
  multiply('T', 'N', m, 1, n, -1., {W.data(), n}, {of_bubbles.data(), n}, 1., result.data(), m);
  return result;
}
} // namespace hpvi
