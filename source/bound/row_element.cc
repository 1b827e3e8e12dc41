// SPDX-License-Identifier: LGPL-2.1-or-later

// Rows of a stress are fields of Raviart and Thomas, each for itself. The contravariant map keeps divergences and tractions, whatever
// the cell looks like; what it does not keep, symmetry, the bound pays for (doc/bound.md).
#include <hpvi/algebra/triangular.h>
#include <hpvi/bound/corner_stress.h>
#include <hpvi/bound/legendre.h>
#include <hpvi/bound/row_element.h>
#include <hpvi/scene/scene.h>

#include <deal.II/base/polynomial.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr char cells[] = "the rows of stresses";

/** At x: L_i for i <= k; N_i, the integral of L_i from -1, for 0 < i <= k, then (1 - x)/2 and (1 + x)/2. */
struct Values
{
  Values(const unsigned int k, const double x) : L(legendre::values(k + 2, x))
  {
    for (unsigned int i = 1; i <= k; ++i) // P_{i+1} - P_{i-1} = (2i + 1) int P_i
      own.push_back(legendre::root(i) *
                    (L[i + 1] / legendre::root(i + 1) - L[i - 1] / legendre::root(i - 1)) /
                    (2 * i + 1));
    own.insert(own.end(), {(1 - x) / 2, (1 + x) / 2});
    L.pop_back();
  }

  std::vector<double> L, own;
};
} // namespace

RowTable::RowTable(const unsigned int degree, const unsigned int n_gauss,
                   const unsigned int marked_corners)
    : k(degree), n_gauss(n_gauss)
{
  set_products();
  const QGauss<1> gauss(n_gauss);
  const QGauss<2> rule(n_gauss);
  points = rule.get_points();
  for (const double weight : rule.get_weights())
    weights.push_back(4 * weight);
  for (const Point<1> &point : gauss.get_points())
  {
    const Values at_point(k, 2 * point[0] - 1);
    own.insert(own.end(), at_point.own.begin(), at_point.own.end());
    other.insert(other.end(), at_point.L.begin(), at_point.L.end());
  }
  for (unsigned int corner = 0; corner < 4; ++corner)
    if (marked_corners & (1u << corner))
      corners.push_back(corner);
  if (!corners.empty())
    set_corners(gauss);
}

void RowTable::set_corners(const QGauss<1> &gauss)
{
  constexpr unsigned int further = 8; // arctan and its slopes, pole at i
  at_corners = corner_quadrature(corners, n_gauss + further);
  const auto basis = Polynomials::generate_complete_Lagrange_basis(gauss.get_points());
  for (unsigned int d = 0; d < 2; ++d)
  {
    interpolation[d].reinit(at_corners.size(), n_gauss);
    for (unsigned int q = 0; q < at_corners.size(); ++q)
      for (unsigned int i = 0; i < n_gauss; ++i)
        interpolation[d](q, i) = basis[i].value(at_corners.point(q)[d]);
  }
  for (const unsigned int corner : corners)
  {
    corner_stresses.emplace_back();
    for (const Point<2> &point : at_corners.get_points())
      corner_stresses.back().push_back(
          corner_stress(k + 1, corner, 2 * point[0] - 1, 2 * point[1] - 1));
  }
}

void RowTable::set_products()
{
  const double one = std::sqrt(2.); // over L_0
  const auto product = [this](const unsigned int x, const unsigned int l, const double factor) {
    return Product{x * (k + 1) + l, factor};
  };
  const auto add = [this](const Product &xi, const Product &eta, const Product &div = Product())
  {
    products[0].push_back(xi);
    products[1].push_back(eta);
    products[divergence].push_back(div);
  };
  for (unsigned int i = 1; i <= k; ++i)
    for (unsigned int j = 1; j <= k; ++j)
      add(product(i - 1, j, 1.), product(j - 1, i, -1.));
  for (unsigned int face = 0; face < 4; ++face)
    for (unsigned int i = 0; i <= k; ++i)
    {
      const Product across = product(k + face % 2, i, 1.),
                    along = i > 0 ? product(i - 1, 0, (face % 2 ? -0.5 : 0.5) * one) : Product(),
                    div = i > 0 ? Product() : product(0, 0, (face % 2 ? 0.5 : -0.5) * one);
      face < 2 ? add(across, along, div) : add(along, across, div);
    }
  for (unsigned int i = 0; i <= k; ++i)
    for (unsigned int j = 0; j <= k; ++j)
      i > 0   ? add(product(i - 1, j, 1.), Product(), product(i, j, 1.))
      : j > 0 ? add(Product(), product(j - 1, 0, 1.), product(0, j, 1.))
              : add(Product(), Product());
}

std::array<std::vector<double>, 3> RowTable::at(const Point<2> &reference) const
{
  const Values xi(k, 2 * reference[0] - 1), eta(k, 2 * reference[1] - 1);
  const std::array<const std::vector<double> *, 3> own{{&xi.own, &eta.own, &xi.L}},
      other{{&eta.L, &xi.L, &eta.L}};
  std::array<std::vector<double>, 3> result;
  for (unsigned int d = 0; d < 3; ++d)
    for (const auto &[number, factor] : products[d])
      result[d].push_back(factor * (*own[d])[number / (k + 1)] * (*other[d])[number % (k + 1)]);
  return result;
}

// @sect3{At points}
namespace
{
/** L of C^-1 = L L' in the components of a plane stress, and of one around the axis. */
std::array<std::array<double, 4>, 4> compliance_of(const Material &material,
                                                   const bool is_axisymmetric)
{
  const unsigned int n = is_axisymmetric ? 4 : 3;
  std::array<SymmetricTensor<2, 3>, 4> unit;
  unit[0][0][0] = unit[1][1][1] = unit[2][0][1] = unit[3][2][2] = 1.;
  const auto in_plane = [](const SymmetricTensor<2, 3> &s)
  {
    SymmetricTensor<2, 2> result;
    result[0][0] = s[0][0];
    result[1][1] = s[1][1];
    result[0][1] = s[0][1];
    return result;
  };
  const HookesLaw<2> law(material);
  std::vector<double> product(n * n);
  for (unsigned int a = 0; a < n; ++a)
    for (unsigned int b = 0; b < n; ++b)
      product[n * a + b] = is_axisymmetric
                               ? HookesLaw<3>(material).complementary_product(unit[a], unit[b])
                               : law.complementary_product(in_plane(unit[a]), in_plane(unit[b]));
  require_regular(cholesky(n, product.data(), n), cells);
  std::array<std::array<double, 4>, 4> result{};
  for (unsigned int a = 0; a < n; ++a)
    for (unsigned int b = a; b < n; ++b)
      result[b][a] = product[n * a + b];
  return result;
}
} // namespace

RowValues::RowValues(const RowTable &table, const RowShape &shape)
    : table(table), is_axisymmetric(shape.is_axisymmetric()), n_parts(is_axisymmetric ? 5 : 4),
      n_weighted(n_parts - (shape.has_slices() ? 0 : 1)),
      antisymmetry(std::sqrt(theta) * shape.antisymmetry),
      compliance(compliance_of(*shape.law, is_axisymmetric))
{
  for (unsigned int q = 0; q < table.points.size(); ++q)
  {
    const Tensor<2, 2> J = shape.map.jacobian(table.points[q]) / (2 * shape.h);
    require_regular(determinant(J) > 0, cells);
    const Point<2> x = shape.map.point(table.points[q]);
    turns.push_back(is_axisymmetric ? full_turn(x) : 1.);
    roots.push_back(std::sqrt(table.weights[q] * determinant(J)));
    auto both = frames_at(J, x[0] / shape.h);
    for (unsigned int row = 0; row < 2; ++row)
    {
      for (unsigned int part = 0; part < n_parts; ++part)
        for (double &value : both[row][part])
          value *= roots[q] / (part < n_weighted ? std::sqrt(turns[q]) : 1.);
      frames[row].push_back(both[row]);
    }
  }
  if (!table.corners.empty())
    set_corners(shape);
}

unsigned int RowValues::n_components(const unsigned int row) const
{
  return is_axisymmetric && row == 0 ? 3 : 2;
}

/** Of the Jacobian in units of h: what unit components of either row, and its divergence, are in energy per area. */
std::array<RowValues::Frame, 2> RowValues::frames_at(const Tensor<2, 2> &J,
                                                     const double radius) const
{
  const double det = determinant(J);
  std::array<Frame, 2> result{};
  for (unsigned int row = 0; row < 2; ++row)
    for (unsigned int d = 0; d < n_components(row); ++d)
    {
      std::array<double, 2> s{}; // (s_row,1, s_row,2)
      std::array<double, 4> symmetric{};
      if (d == RowTable::divergence)
        symmetric[3] = radius / det;
      else
      {
        s = {{J[0][d] / det, J[1][d] / det}};
        symmetric[row] = s[row];
        symmetric[2] = s[1 - row] / 2;
      }
      for (unsigned int a = 0; a + 1 < n_parts; ++a)
        for (unsigned int b = a; b + 1 < n_parts; ++b)
          result[row][a][d] += compliance[b][a] * symmetric[b];
      result[row][n_parts - 1][d] = antisymmetry * (row == 0 ? s[1] : -s[0]);
    }
  return result;
}

Tensor<2, 2> corner_frame(const RowShape &shape, const unsigned int corner)
{
  return shape.map.jacobian(Point<2>(corner % 2, corner / 2)) / shape.h;
}

void RowValues::set_corners(const RowShape &shape)
{
  const unsigned int n_corners = table.corners.size(), n = table.n_gauss,
                     n_points = table.points.size();
  corner_moments.assign(n_corners, std::vector<double>(n_parts * n_points));
  corner_products.fill(std::vector<double>(n_corners * n_corners));
  std::vector<std::array<double, 5>> at_point(n_corners);
  std::vector<Tensor<2, 2>> B;
  for (const unsigned int corner : table.corners)
    B.push_back(corner_frame(shape, corner));
  for (unsigned int q = 0; q < table.at_corners.size(); ++q)
  {
    const Tensor<2, 2> J = shape.map.jacobian(table.at_corners.point(q)) / (2 * shape.h);
    const double weight = 4 * table.at_corners.weight(q) * determinant(J),
                 turn =
                     is_axisymmetric ? full_turn(shape.map.point(table.at_corners.point(q))) : 1.;
    const std::array<Frame, 2> both = frames_at(J, 0.);
    for (unsigned int c = 0; c < n_corners; ++c)
    {
      const auto [xx, yy, xy] = table.corner_stresses[c][q];
      for (unsigned int part = 0; part < n_parts; ++part)
      {
        at_point[c][part] = 0;
        for (unsigned int row = 0; row < 2; ++row)
          at_point[c][part] += both[row][part][0] * (B[c][row][0] * xx + B[c][row][1] * xy) +
                               both[row][part][1] * (B[c][row][0] * xy + B[c][row][1] * yy);
        if (part < n_weighted)
          at_point[c][part] /= std::sqrt(turn);
        for (unsigned int b = 0; b < n; ++b)
          for (unsigned int a = 0; a < n; ++a)
            corner_moments[c][part * n_points + b * n + a] += weight * at_point[c][part] *
                                                              table.interpolation[0](q, a) *
                                                              table.interpolation[1](q, b);
      }
    }
    for (unsigned int c = 0; c < n_corners; ++c)
      for (unsigned int e = 0; e < n_corners; ++e)
        for (unsigned int part = 0; part < n_parts; ++part)
          corner_products[part == n_parts - 1][c * n_corners + e] +=
              weight * at_point[c][part] * at_point[e][part];
  }
  for (std::vector<double> &moments : corner_moments)
    for (unsigned int i = 0; i < moments.size(); ++i)
      moments[i] /= roots[i % n_points];
}

// Products of functions of one variable are summed one variable after the other.
/** One component of a row at all points. */
std::vector<double> RowValues::at_points(const double *const coefficients,
                                         const unsigned int d) const
{
  const bool is_divergence = d == RowTable::divergence;
  const unsigned int n = table.n_gauss, k = table.k, n_own = k + (is_divergence ? 1 : 2);
  const std::vector<double> &own_functions = is_divergence ? table.other : table.own;
  std::vector<double> result(table.points.size());
  std::vector<double> modes((k + 1) * n_own), half(n * n_own);
  for (unsigned int m = 0; m < table.products[d].size(); ++m)
    modes[table.products[d][m].number] += table.products[d][m].factor * coefficients[m];
  multiply('T', 'N', n, n_own, k + 1, 1., {table.other.data(), k + 1}, {modes.data(), k + 1}, 0.,
           half.data(), n);
  if (d != 1)
    multiply('T', 'T', n, n, n_own, 1., {own_functions.data(), n_own}, {half.data(), n}, 0.,
             result.data(), n);
  else
    multiply('N', 'N', n, n, n_own, 1., {half.data(), n}, {own_functions.data(), n_own}, 0.,
             result.data(), n);
  return result;
}

/** The transposed, added. */
void RowValues::add_moments(const std::vector<double> &values, const unsigned int d,
                            double *const result) const
{
  const bool is_divergence = d == RowTable::divergence;
  const unsigned int n = table.n_gauss, k = table.k, n_own = k + (is_divergence ? 1 : 2);
  const std::vector<double> &own_functions = is_divergence ? table.other : table.own;
  std::vector<double> modes((k + 1) * n_own), half(n_own * n);
  if (d != 1)
  {
    multiply('N', 'N', n_own, n, n, 1., {own_functions.data(), n_own}, {values.data(), n}, 0.,
             half.data(), n_own);
    multiply('N', 'T', k + 1, n_own, n, 1., {table.other.data(), k + 1}, {half.data(), n_own}, 0.,
             modes.data(), k + 1);
  }
  else
  {
    multiply('N', 'N', k + 1, n, n, 1., {table.other.data(), k + 1}, {values.data(), n}, 0.,
             half.data(), k + 1);
    multiply('N', 'T', k + 1, n_own, n, 1., {half.data(), k + 1}, {own_functions.data(), n_own}, 0.,
             modes.data(), k + 1);
  }
  for (unsigned int m = 0; m < table.products[d].size(); ++m)
    result[m] += table.products[d][m].factor * modes[table.products[d][m].number];
}

void RowValues::add(const RowFields &fields, Stress &stress) const
{
  const unsigned int n_points = table.points.size();
  for (unsigned int row = 0; row < 2; ++row)
    for (unsigned int d = 0; d < n_components(row); ++d)
    {
      const std::vector<double> field = at_points(&fields.fields[row * table.n_fields()], d);
      for (unsigned int part = 0; part < n_parts; ++part)
        for (unsigned int q = 0; q < n_points; ++q)
          stress.values[part * n_points + q] += frames[row][q][part][d] * field[q];
    }
  for (unsigned int c = 0; c < stress.corners.size(); ++c)
    stress.corners[c] += fields.corners[c];
}

RowFields RowValues::derivatives(const Stress &stress) const
{
  const unsigned int n_points = table.points.size(), n_corners = table.corners.size();
  std::vector<double> values = stress.values, field(n_points);
  for (unsigned int c = 0; c < n_corners; ++c)
    for (unsigned int i = 0; i < values.size(); ++i)
      values[i] += stress.corners[c] * corner_moments[c][i];
  RowFields result(table);
  for (unsigned int row = 0; row < 2; ++row)
    for (unsigned int d = 0; d < n_components(row); ++d)
    {
      std::fill(field.begin(), field.end(), 0.);
      for (unsigned int part = 0; part < n_parts; ++part)
        for (unsigned int q = 0; q < n_points; ++q)
          field[q] += frames[row][q][part][d] * values[part * n_points + q];
      add_moments(field, d, &result.fields[row * table.n_fields()]);
    }
  for (unsigned int c = 0; c < n_corners; ++c)
  {
    result.corners[c] = std::inner_product(stress.values.begin(), stress.values.end(),
                                           corner_moments[c].begin(), 0.);
    for (unsigned int e = 0; e < n_corners; ++e)
      for (const std::vector<double> &products : corner_products)
        result.corners[c] += products[c * n_corners + e] * stress.corners[e];
  }
  return result;
}

double RowValues::square(const Stress &stress, const bool is_antisymmetric) const
{
  const unsigned int n_points = table.points.size(), n_corners = table.corners.size(),
                     first = is_antisymmetric ? (n_parts - 1) * n_points : 0,
                     end = is_antisymmetric ? n_parts * n_points : (n_parts - 1) * n_points;
  double sum = 0;
  for (unsigned int i = first; i < end; ++i)
  {
    double twice = stress.values[i];
    for (unsigned int c = 0; c < n_corners; ++c)
      twice += 2 * stress.corners[c] * corner_moments[c][i];
    sum += stress.values[i] * twice;
  }
  for (unsigned int c = 0; c < n_corners; ++c)
    for (unsigned int e = 0; e < n_corners; ++e)
      sum += stress.corners[c] * stress.corners[e] *
             corner_products[is_antisymmetric][c * n_corners + e];
  return std::max(0., sum); // round-off
}

std::array<double, 2> RowValues::squares(const RowShape &shape, const RowFields &fields,
                                         const Quadrature<2> &rule,
                                         const std::vector<Components> &sigma) const
{
  std::array<double, 2> result{};
  for (unsigned int q = 0; q < rule.size(); ++q)
  {
    const Point<2> &at = rule.point(q), x = shape.map.point(at);
    const Tensor<2, 2> J = shape.map.jacobian(at) / (2 * shape.h);
    const double turn = is_axisymmetric ? full_turn(x) : 1.;
    const std::array<std::vector<double>, 3> fields_at = table.at(at);
    std::array<std::array<double, 3>, 2> components{};
    for (unsigned int row = 0; row < 2; ++row)
      for (unsigned int d = 0; d < n_components(row); ++d)
        components[row][d] = std::inner_product(fields_at[d].begin(), fields_at[d].end(),
                                                &fields.fields[row * table.n_fields()], 0.);
    for (unsigned int c = 0; c < table.corners.size(); ++c)
    {
      const auto [xx, yy, xy] =
          corner_stress(table.k + 1, table.corners[c], 2 * at[0] - 1, 2 * at[1] - 1);
      const Tensor<2, 2> B = fields.corners[c] * corner_frame(shape, table.corners[c]);
      for (unsigned int row = 0; row < 2; ++row)
      {
        components[row][0] += B[row][0] * xx + B[row][1] * xy;
        components[row][1] += B[row][0] * xy + B[row][1] * yy;
      }
    }
    const std::array<Frame, 2> both = frames_at(J, x[0] / shape.h);
    for (unsigned int part = 0; part < n_parts; ++part)
    {
      double value = 0;
      for (unsigned int row = 0; row < 2; ++row)
        for (unsigned int d = 0; d < n_components(row); ++d)
          value += both[row][part][d] * components[row][d];
      for (unsigned int b = part; b + 1 < n_parts; ++b)
        value -= turn * compliance[b][part] * sigma[q][b];
      result[part == n_parts - 1] +=
          4 * rule.weight(q) * determinant(J) * value * value / (part < n_weighted ? turn : 1.);
    }
  }
  return result;
}

void RowValues::subtract(const unsigned int q, const SymmetricTensor<2, 2> &sigma, const double psi,
                         Stress &stress, const double around) const
{
  const std::array<double, 4> components{
      {psi * sigma[0][0], psi * sigma[1][1], psi * sigma[0][1], around}};
  for (unsigned int a = 0; a + 1 < n_parts; ++a)
    for (unsigned int b = a; b + 1 < n_parts; ++b)
      stress.values[a * table.points.size() + q] -=
          roots[q] * std::sqrt(turns[q]) * compliance[b][a] * components[b];
}

RowFields RowValues::antisymmetric_mean() const
{
  Stress unit(*this);
  for (unsigned int q = 0; q < roots.size(); ++q)
    unit.values[(n_parts - 1) * roots.size() + q] = roots[q] / antisymmetry;
  return derivatives(unit);
}

std::vector<RowFields> RowValues::along(const unsigned int face, const unsigned int row) const
{
  std::vector<RowFields> result(table.k, RowFields(table));
  const unsigned int d = 1 - face / 2, n = table.k + 1;
  const std::vector<double> L = legendre::values(n, face % 2 ? 1. : -1.);
  for (unsigned int m = 0; m < table.n_fields(); ++m)
    if (const auto &[number, factor] = table.products[d][m]; number / n < table.k)
      result[number / n].fields[row * table.n_fields() + m] = factor * L[number % n];
  return result;
}

std::vector<RowValues::Column> RowValues::bubbles() const
{
  std::vector<Column> result;
  for (unsigned int row = 0; row < 2; ++row)
    for (unsigned int m = 0; m < table.k * table.k; ++m)
      result.push_back({row, m, 1.});
  for (unsigned int m = table.of_divergence() + 1; is_axisymmetric && m < table.n_fields(); ++m)
    result.push_back({0, m, 1.});
  return result;
}

std::vector<RowValues::Column> RowValues::columns(const std::array<double, 4> &scale) const
{
  std::vector<Column> result = bubbles();
  for (unsigned int face = 0; face < 4; ++face)
    for (unsigned int row = 0; row < 2; ++row)
      for (unsigned int i = 0; i <= table.k; ++i)
        result.push_back({row, table.of_face(face) + i, scale[face]});
  return result;
}

/** What stands beside the product of component d of a row and component e of another. */
std::vector<double> RowValues::weight(const unsigned int row, const unsigned int d,
                                      const unsigned int other_row, const unsigned int e) const
{
  std::vector<double> result(table.points.size());
  for (unsigned int q = 0; q < result.size(); ++q)
    for (unsigned int part = 0; part < n_parts; ++part)
      result[q] += frames[row][q][part][d] * frames[other_row][q][part][e];
  return result;
}

namespace
{
/** f_i g_j at Gauss points, j fastest, from tables of one variable. */
std::vector<double> pairs(const std::vector<double> &f, const unsigned int n_f,
                          const std::vector<double> &g, const unsigned int n_g,
                          const unsigned int n_points)
{
  std::vector<double> result;
  result.reserve(std::size_t(n_f) * n_g * n_points);
  for (unsigned int q = 0; q < n_points; ++q)
    for (unsigned int i = 0; i < n_f; ++i)
      for (unsigned int j = 0; j < n_g; ++j)
        result.push_back(f[q * n_f + i] * g[q * n_g + j]);
  return result;
}
} // namespace

std::vector<double> RowValues::products(const std::vector<RowFields> &corners,
                                        const std::array<double, 4> &scale) const
{
  const std::vector<Column> all = columns(scale);
  const unsigned int n_bubbles = all.size() - 8 * (table.k + 1), n_corners = corners.size(),
                     stride = all.size() + n_corners;
  const auto place = [&](const unsigned int column)
  { return column < n_bubbles ? column : column + n_corners; };
  std::vector<double> result(std::size_t(stride) * stride);
  add_products(all, stride, n_corners, result);
  for (unsigned int c = 0; c < n_corners; ++c)
  {
    Stress stress(*this);
    add(corners[c], stress);
    const RowFields by_fields = derivatives(stress);
    const auto set = [&](const unsigned int row, const double value)
    {
      result[std::size_t(n_bubbles + c) * stride + row] = value;
      result[std::size_t(row) * stride + n_bubbles + c] = value;
    };
    for (unsigned int column = 0; column < all.size(); ++column)
      set(place(column),
          all[column].factor *
              by_fields.fields[all[column].row * table.n_fields() + all[column].field]);
    for (unsigned int e = 0; e <= c; ++e)
      set(n_bubbles + e, std::inner_product(by_fields.fields.begin(), by_fields.fields.end(),
                                            corners[e].fields.begin(), by_fields.corners[e]));
  }
  return result;
}

/** Of the columns, with room for corners behind the bubbles. */
void RowValues::add_products(const std::vector<Column> &all, const unsigned int stride,
                             const unsigned int n_corners, std::vector<double> &result) const
{
  const unsigned int n_bubbles = all.size() - 8 * (table.k + 1);
  const auto place_of = [&](const unsigned int column)
  { return column < n_bubbles ? column : column + n_corners; };
  const unsigned int n = table.n_gauss, n_other = table.k + 1, n_columns = all.size();
  // Functions of xi and of eta, and which of them a product has.
  const auto is_own = [](const unsigned int d, const unsigned int variable)
  { return d == variable; };
  std::array<std::array<std::vector<double>, 2>, 2> both;
  for (const bool first : {false, true})
    for (const bool second : {false, true})
      both[first][second] = pairs(first ? table.own : table.other, n_other + first,
                                  second ? table.own : table.other, n_other + second, n);
  const auto functions_of = [&](const unsigned int d, const unsigned int number)
  {
    const unsigned int x = number / n_other, l = number % n_other;
    return d == 1 ? std::array<unsigned int, 2>{{l, x}} : std::array<unsigned int, 2>{{x, l}};
  };
  std::vector<double> half, M;
  // w is n x n, xi fastest: sums over one variable, then over the other
  const auto sum = [&](const std::vector<double> &of_xi, const std::vector<double> &w,
                       const std::vector<double> &of_eta)
  {
    const unsigned int n_xi = of_xi.size() / n, n_eta = of_eta.size() / n;
    half.resize(n_xi * n);
    M.resize(std::size_t(n_xi) * n_eta);
    multiply('N', 'N', n_xi, n, n, 1., {of_xi.data(), n_xi}, {w.data(), n}, 0., half.data(), n_xi);
    multiply('N', 'T', n_xi, n_eta, n, 1., {half.data(), n_xi}, {of_eta.data(), n_eta}, 0.,
             M.data(), n_xi);
    return n_xi;
  };
  for (unsigned int r = 0; r < 2; ++r)
    for (unsigned int s = 0; s <= r; ++s)
      for (unsigned int d = 0; d < n_components(r); ++d)
        for (unsigned int e = 0; e < n_components(s); ++e)
        {
          const unsigned int n_xi = sum(both[is_own(d, 0)][is_own(e, 0)], weight(r, d, s, e),
                                        both[is_own(d, 1)][is_own(e, 1)]);
          const std::array<unsigned int, 2> n_second{
              {n_other + is_own(e, 0), n_other + is_own(e, 1)}};
          for (unsigned int a = 0; a < n_columns; ++a)
          {
            const RowTable::Product &first = table.products[d][all[a].field];
            if (all[a].row != r || first.factor == 0.)
              continue;
            const auto [x, y] = functions_of(d, first.number);
            for (unsigned int b = 0; b < n_columns; ++b)
            {
              const RowTable::Product &second = table.products[e][all[b].field];
              if (all[b].row != s || second.factor == 0. || (r == s && b > a))
                continue;
              const auto [u, v] = functions_of(e, second.number);
              const std::size_t place =
                  std::size_t(y * n_second[1] + v) * n_xi + x * n_second[0] + u;
              result[std::size_t(place_of(b)) * stride + place_of(a)] +=
                  all[a].factor * all[b].factor * first.factor * second.factor * M[place];
            }
          }
        }
  for (unsigned int a = 0; a < n_columns; ++a)
    for (unsigned int b = 0; b < a; ++b)
    {
      double &one = result[std::size_t(place_of(b)) * stride + place_of(a)],
             &other = result[std::size_t(place_of(a)) * stride + place_of(b)];
      one = other = one + other; // of two rows either stands in one of them
    }
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

/** Of `det DF s` and of sigma(u_N), of bodies of revolution times w, with constant loads; k is above the degrees of u_N and of the map, g. */
EnergyDegrees degrees_of(const RowTable &table, const RowShape &shape)
{
  const unsigned int k = table.k, g = map_degree(shape.map);
  if (!shape.is_axisymmetric())
    return {k + g, false};
  return {std::max(k + 2 * g - 1, 4 * g - 1), true};
}
} // namespace

RowElement::RowElement(const RowTable &table, const RowShape &shape)
    : table(table), values(table, shape), face_on_axis(shape.face_on_axis()),
      n_conditions(face_on_axis             ? 5
                   : values.is_axisymmetric ? 1
                                            : 3),
      scale(over(shape.densities, shape.h)),
      rule(shape.map, degrees_of(table, shape), table.n_gauss), bubbles(values.bubbles())
{
  add_corners(shape);
  const std::vector<double> H = values.products(corners, scale);
  const unsigned int n = n_bubbles(), m = n_edges(), stride = n + m;
  for (unsigned int column = 0; column < stride; ++column)
  {
    const double *const first = &H[std::size_t(column) * stride];
    if (column < n)
      L.insert(L.end(), first, first + n);
    else
    {
      W.insert(W.end(), first, first + n);
      G.insert(G.end(), first + n, first + stride);
    }
  }
  require_regular(cholesky(n, L.data(), n), cells);
  solve_triangular('N', n, m, {L.data(), n}, W.data(), n);
  multiply('T', 'N', m, m, n, -1., {W.data(), n}, {W.data(), n}, 1., G.data(), m);
  if (values.is_axisymmetric)
    set_constraints(shape);
  set_conditions(shape);
}

/** The least energy under conditions on bubbles has as many terms more as there are conditions. */
void RowElement::set_constraints(const RowShape &shape)
{
  if (face_on_axis)
    for (unsigned int row = 0; row < 2; ++row)
      for (RowFields &of : values.along(*face_on_axis, row))
        constraints.push_back(std::move(of));
  else if (!shape.has_slices())
    constraints.push_back(values.antisymmetric_mean());
  if (constraints.empty())
    return;
  const unsigned int n = n_bubbles(), m = n_edges(), k = constraints.size();
  for (const RowFields &of : constraints)
  {
    const std::vector<double> bubbles_of = by_bubbles(of), edges_of = by_edges(of);
    by_bubbles_of.insert(by_bubbles_of.end(), bubbles_of.begin(), bubbles_of.end());
    by_edges_of.insert(by_edges_of.end(), edges_of.begin(), edges_of.end());
  }
  solve_triangular('N', n, k, {L.data(), n}, by_bubbles_of.data(), n);
  multiply('T', 'N', m, k, n, -1., {W.data(), n}, {by_bubbles_of.data(), n}, 1., by_edges_of.data(),
           m);
  inverse.reinit(k, k);
  for (unsigned int i = 0; i < k; ++i)
    for (unsigned int j = 0; j < k; ++j)
      inverse(i, j) = std::inner_product(&by_bubbles_of[i * n], &by_bubbles_of[i * n] + n,
                                         &by_bubbles_of[j * n], 0.);
  inverse.gauss_jordan();
  std::vector<double> half(m * k);
  multiply('N', 'N', m, k, k, 1., {by_edges_of.data(), m}, {&inverse(0, 0), k}, 0., half.data(), m);
  multiply('N', 'T', m, m, k, 1., {half.data(), m}, {by_edges_of.data(), m}, 1., G.data(), m);
}

/** The multipliers of constraints that @p fields with the best bubbles for @p of_bubbles miss, L^-1 of derivatives. */
std::vector<double> RowElement::missing(const std::vector<double> &of_bubbles,
                                        const RowFields &fields) const
{
  if (constraints.empty())
    return {};
  const unsigned int n = n_bubbles();
  Vector<double> missed(constraints.size()), result(constraints.size());
  for (unsigned int i = 0; i < constraints.size(); ++i)
    missed[i] = std::inner_product(fields.fields.begin(), fields.fields.end(),
                                   constraints[i].fields.begin(), 0.) -
                std::inner_product(of_bubbles.begin(), of_bubbles.end(), &by_bubbles_of[i * n], 0.);
  inverse.vmult(result, missed);
  return {result.begin(), result.end()};
}

/** On the faces beside the axis tractions of both rows vanish at the end that is on it. */
void RowElement::set_ends()
{
  const unsigned int n = table.k + 1, m = n_edges();
  const std::vector<double> L = legendre::values(n, *face_on_axis % 2 ? 1. : -1.);
  for (unsigned int c = 1; c < n_conditions; ++c)
  {
    const unsigned int face = face_of_end(c), row = (c - 1) % 2;
    lengths[c] = std::sqrt(std::inner_product(L.begin(), L.end(), L.begin(), 0.));
    for (unsigned int i = 0; i < n; ++i)
      N[c * m + (2 * face + row) * n + i] = L[i] / lengths[c];
  }
}

/** Forces along x and y and the moment about the middle, of tractions less divergences; those of tractions have length 1. In a body of revolution the force along y. */
void RowElement::set_conditions(const RowShape &shape)
{
  const unsigned int k = table.k, n = k + 1, m = n_edges();
  const Point<2> centre = shape.map.point({0.5, 0.5});
  const auto motion = [&](const unsigned int z, const Point<2> &reference)
  {
    const Tensor<1, 2> x = (shape.map.point(reference) - centre) / shape.h;
    return z < 2 ? Tensor<1, 2>({z == 0 ? 1. : 0., z == 1 ? 1. : 0.}) : Tensor<1, 2>({-x[1], x[0]});
  };
  N.assign(n_conditions * m, 0.);
  N_divergence.assign(std::size_t(2) * n_conditions * n * n, 0.);
  const QGauss<1> gauss(table.n_gauss);
  if (face_on_axis)
    set_ends();
  for (unsigned int c = 0; c < n_motions(); ++c)
  {
    const unsigned int z = values.is_axisymmetric ? 1 : c;
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const std::vector<double> along = legendre::values(n, 2 * gauss.point(q)[0] - 1);
      for (unsigned int face = 0; face < 4; ++face)
      {
        const Tensor<1, 2> v = motion(z, point_on_face<2>(face, gauss.point(q)));
        for (unsigned int row = 0; row < 2; ++row)
          for (unsigned int i = 0; i < n; ++i)
            N[c * m + (2 * face + row) * n + i] +=
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
            N_divergence[((2 * c + row) * n + i) * n + j] +=
                table.weights[q] * v[row] * L_x[i] * L_y[j];
    }
    double &length = lengths[c];
    length = 0;
    for (unsigned int i = 0; i < m; ++i)
      length += N[c * m + i] * N[c * m + i];
    length = std::sqrt(length);
    for (unsigned int i = 0; i < m; ++i)
      N[c * m + i] /= length;
    for (unsigned int i = 0; i < 2 * n * n; ++i)
      N_divergence[2 * c * n * n + i] /= length;
  }
}

TractionEnergy RowElement::energy() const
{
  const unsigned int n = table.k + 1;
  return {n, n, n_conditions, {G.data(), n_edges()}, {N.data(), n_edges()}};
}

RowElement::Conditions RowElement::moments(const double *const divergence) const
{
  const unsigned int n = 2 * (table.k + 1) * (table.k + 1);
  Conditions result{};
  for (unsigned int c = 0; c < n_conditions; ++c)
    for (unsigned int i = 0; i < n; ++i)
      result[c] += N_divergence[c * n + i] * divergence[i];
  return result;
}

/** Fluxes of a corner's stress are polynomials; fields of edges take them away. */
void RowElement::add_corners(const RowShape &shape)
{
  const unsigned int n_fields = table.n_fields(), n = table.k + 1;
  const QGauss<1> gauss(n + 2);
  for (unsigned int c = 0; c < table.corners.size(); ++c)
  {
    const unsigned int corner = table.corners[c];
    const Tensor<2, 2> B = corner_frame(shape, corner);
    RowFields bubble(table);
    bubble.corners[c] = 1.;
    for (unsigned int face = 0; face < 4; ++face)
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const Point<2> at = point_on_face<2>(face, gauss.point(q));
        const auto [xx, yy, xy] = corner_stress(n, corner, 2 * at[0] - 1, 2 * at[1] - 1);
        const Tensor<1, 2> flux = B * (face < 2 ? Tensor<1, 2>({xx, xy}) : Tensor<1, 2>({xy, yy}));
        const std::vector<double> along = legendre::values(n, 2 * gauss.point(q)[0] - 1);
        for (unsigned int row = 0; row < 2; ++row)
          for (unsigned int i = 0; i < n; ++i)
            bubble.fields[row * n_fields + table.of_face(face) + i] -=
                2 * gauss.weight(q) * flux[row] * along[i];
      }
    corners.push_back(std::move(bubble));
  }
}

std::vector<double> RowElement::by_bubbles(const RowFields &derivatives) const
{
  std::vector<double> result;
  for (const RowValues::Column &bubble : bubbles)
    result.push_back(derivatives.fields[bubble.row * table.n_fields() + bubble.field]);
  for (unsigned int c = 0; c < corners.size(); ++c)
    result.push_back(std::inner_product(corners[c].fields.begin(), corners[c].fields.end(),
                                        derivatives.fields.begin(), derivatives.corners[c]));
  return result;
}

std::vector<double> RowElement::by_edges(const RowFields &derivatives) const
{
  std::vector<double> result;
  for (unsigned int face = 0; face < 4; ++face)
    for (unsigned int row = 0; row < 2; ++row)
      for (unsigned int i = 0; i <= table.k; ++i)
        result.push_back(scale[face] *
                         derivatives.fields[row * table.n_fields() + table.of_face(face) + i]);
  return result;
}

RowFields RowElement::best_bubbles(const RowFields &derivatives, const RowFields &fields) const
{
  const unsigned int n = n_bubbles();
  std::vector<double> y = by_bubbles(derivatives);
  solve_triangular('N', n, 1, {L.data(), n}, y.data(), n);
  const std::vector<double> multipliers = missing(y, fields);
  for (unsigned int c = 0; c < multipliers.size(); ++c)
    for (unsigned int i = 0; i < n; ++i)
      y[i] += multipliers[c] * by_bubbles_of[c * n + i];
  solve_triangular('T', n, 1, {L.data(), n}, y.data(), n);
  RowFields result(table);
  for (unsigned int i = 0; i < bubbles.size(); ++i)
    result.fields[bubbles[i].row * table.n_fields() + bubbles[i].field] = -y[i];
  for (unsigned int c = 0; c < corners.size(); ++c)
  {
    result.corners[c] = -y[bubbles.size() + c];
    for (unsigned int i = 0; i < result.fields.size(); ++i)
      result.fields[i] -= y[bubbles.size() + c] * corners[c].fields[i];
  }
  return result;
}

std::vector<double> RowElement::reduced(const RowFields &derivatives, const RowFields &fields) const
{
  const unsigned int n = n_bubbles(), m = n_edges();
  std::vector<double> of_bubbles = by_bubbles(derivatives), result = by_edges(derivatives);
  solve_triangular('N', n, 1, {L.data(), n}, of_bubbles.data(), n);
  multiply('T', 'N', m, 1, n, -1., {W.data(), n}, {of_bubbles.data(), n}, 1., result.data(), m);
  const std::vector<double> multipliers = missing(of_bubbles, fields);
  for (unsigned int c = 0; c < multipliers.size(); ++c)
    for (unsigned int i = 0; i < m; ++i)
      result[i] += multipliers[c] * by_edges_of[c * m + i];
  return result;
}
} // namespace hpvi
