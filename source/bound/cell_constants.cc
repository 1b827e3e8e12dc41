// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/bound/cell_constants.h>
#include <hpvi/bound/edge_polynomial.h>
#include <hpvi/scene/scene.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hpvi
{
using namespace dealii;

namespace
{
unsigned int start(const unsigned int face) ///< first vertex
{
  return face < 2 ? face : 2 * (face - 2);
}

/**
 * Numbers between which polynomials on the unit cell are, of degree @p n in each variable, from Chebyshev points as EdgePolynomial::enclosure()
 * is; @p function has all of them at a point.
 */
template <std::size_t n_functions, class Function>
std::array<std::pair<double, double>, n_functions> enclosures(const unsigned int n,
                                                              const Function &function)
{
  const unsigned int m = 3 * n;
  std::array<std::pair<double, double>, n_functions> result;
  std::array<double, n_functions> values = function(Point<2>(0.5, 0.5));
  for (unsigned int k = 0; k < n_functions; ++k)
    result[k] = {values[k], values[k]};
  const auto place = [m](const unsigned int i)
  { return 0.5 - 0.5 * std::cos((i + 0.5) * numbers::PI / m); };
  for (unsigned int a = 0; a < m; ++a)
    for (unsigned int b = 0; b < m; ++b)
    {
      values = function(Point<2>(place(a), place(b)));
      for (unsigned int k = 0; k < n_functions; ++k)
        result[k] = {std::min(result[k].first, values[k]), std::max(result[k].second, values[k])};
    }
  const double wider = 1 / std::pow(std::cos(numbers::PI / 6), 2);
  for (auto &[low, high] : result)
  {
    const double middle = (low + high) / 2, half = wider * (high - low) / 2;
    low = middle - half;
    high = middle + half;
  }
  return result;
}

bool lies_on_axis(const CellMap<2> &map, const unsigned int vertex)
{
  return std::abs(map.vertices()[vertex][0]) < 1e-12 * map.longest_edge();
}

/** Of the map in each variable. */
unsigned int degree_of(const CellMap<2> &map)
{
  unsigned int result = 1;
  if (!map.is_curved())
    return result;
  for (const EdgeBlend &blend : map.blends())
    if (blend)
      result = std::max(result, blend.degree());
  return result;
}
} // namespace

CellConstants::CellConstants(const CellMap<2> &map)
    : map(map), centre(map.point({0.5, 0.5})), least_x(centre[0])
{
  const CellMap<2>::Vertices &v = map.vertices();
  for (unsigned int i = 0; i < 4; ++i)
  {
    outer = std::max(outer, centre.distance(v[i]));
    least_x = std::min(least_x, v[i][0]);
    for (unsigned int j = 0; j < i; ++j)
      diameter = std::max(diameter, v[i].distance(v[j]));
  }
  for (unsigned int face = 0; face < 4; ++face)
    if (map.is_curved() && map.blends()[face])
      look_at(face);
    else
      inner[face] = distance(centre, face);
}

/** A curved edge in sixteen pieces, on each of which `((x - c) x x')^2/|x'|^2` has the least of one over the largest of the other. */
void CellConstants::look_at(const unsigned int face)
{
  constexpr unsigned int n_pieces = 16;
  const unsigned int degree = map.blends()[face].degree();
  const QGauss<1> gauss(2 * degree + 1);
  inner[face] = diameter;
  for (unsigned int piece = 0; piece < n_pieces; ++piece)
  {
    std::vector<double> cross_product, speed, distances, radii;
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const Point<2> at = point_on_face<2>(face, Point<1>((piece + gauss.point(q)[0]) / n_pieces));
      const Tensor<1, 2> x = map.point(at) - centre,
                         along = map.jacobian(at) *
                                 Tensor<1, 2>({face < 2 ? 0. : 1., face < 2 ? 1. : 0.});
      const double turn = face == 1 || face == 2 ? 1. : -1.;
      cross_product.push_back(turn * (x[0] * along[1] - x[1] * along[0]));
      speed.push_back(along.norm_square());
      distances.push_back(x.norm_square());
      radii.push_back(centre[0] + x[0]);
    }
    const auto through = [&](const std::vector<double> &values)
    { return EdgePolynomial::through(values, gauss).enclosure(); };
    inner[face] =
        std::min(inner[face], through(cross_product).first / std::sqrt(through(speed).second));
    outer = std::max(outer, std::sqrt(through(distances).second));
    least_x = std::min(least_x, through(radii).first);
  }
}

double CellConstants::distance(const Point<2> &x, const unsigned int face) const
{
  const Point<2> &a = map.vertices()[start(face)],
                 &b = map.vertices()[start(face) + (face < 2 ? 2 : 1)];
  return std::abs((b[0] - a[0]) * (x[1] - a[1]) - (b[1] - a[1]) * (x[0] - a[0])) / a.distance(b);
}

bool CellConstants::is_star_shaped(const Material &material) const
{
  return is_on_axis(material) ? std::isfinite(on_axis())
                              : *std::min_element(inner.begin(), inner.end()) > 0;
}

std::optional<unsigned int> axis_face(const CellMap<2> &map)
{
  for (unsigned int face = 0; face < 4; ++face)
    if (lies_on_axis(map, GeometryInfo<2>::face_to_cell_vertices(face, 0)) &&
        lies_on_axis(map, GeometryInfo<2>::face_to_cell_vertices(face, 1)))
      return face;
  return std::nullopt;
}

bool CellConstants::is_on_axis(const Material &material) const
{
  bool result = false;
  for (unsigned int v = 0; v < 4; ++v)
    result |= lies_on_axis(map, v);
  return result && material.plane == PlaneModel::axisymmetric;
}

/** By pieces of the edges but that on the axis, between which numbers are: r, r z', -(z - z_c) r', r'^2, z'^2. */
std::vector<CellConstants::Piece> CellConstants::pieces(const unsigned int face_on_axis) const
{
  constexpr unsigned int n_pieces = 16;
  const Point<2> middle = map.point(point_on_face<2>(face_on_axis, Point<1>(0.5)));
  std::vector<Piece> result;
  for (unsigned int face = 0; face < 4; ++face)
  {
    const bool is_curved = map.is_curved() && map.blends()[face];
    const QGauss<1> gauss(2 * (is_curved ? map.blends()[face].degree() : 1) + 1);
    const double turn = face == 1 || face == 2 ? 1. : -1.;
    for (unsigned int piece = 0; piece < n_pieces && face != face_on_axis; ++piece)
    {
      std::array<std::vector<double>, 5> values;
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const Point<2> at =
                           point_on_face<2>(face, Point<1>((piece + gauss.point(q)[0]) / n_pieces)),
                       x = map.point(at);
        const Tensor<1, 2> along =
            turn * (map.jacobian(at) * Tensor<1, 2>({face < 2 ? 0. : 1., face < 2 ? 1. : 0.}));
        const std::array<double, 5> of_point{{x[0], x[0] * along[1], -(x[1] - middle[1]) * along[0],
                                              along[0] * along[0], along[1] * along[1]}};
        for (unsigned int i = 0; i < 5; ++i)
          values[i].push_back(of_point[i]);
      }
      Piece &ranges = result.emplace_back();
      for (unsigned int i = 0; i < 5; ++i)
        ranges[i] = EdgePolynomial::through(values[i], gauss).enclosure();
    }
  }
  return result;
}

/**
 * The slice of the solid at the distance x from the axis has the boundary (y, z) = ((r^2 - x^2)^{1/2}, z), its tangents the distance
 * `(m r z' - (z - z_c) r')/(r'^2 + m z'^2)^{1/2}` from the middle of the axis, m = 1 - x^2/r^2: no less than what this gives for x^2 <= @p most.
 */
double CellConstants::inner_of_slices(const std::vector<Piece> &all, const double most) const
{
  constexpr unsigned int n_shares = 32;
  double result = diameter;
  for (const auto &[radius, outward, upward, across, along] : all)
  {
    const double r = std::max(radius.first, 0.),
                 least = r > 0 ? std::max(0., 1 - most / (r * r)) : 0.;
    for (unsigned int k = 0; k < n_shares; ++k)
    {
      const double low = least + (1 - least) * k / n_shares, high = low + (1 - least) / n_shares;
      result =
          std::min(result, (std::min(low * outward.first, high * outward.first) + upward.first) /
                               std::sqrt(across.second + high * along.second));
    }
  }
  return result;
}

double CellConstants::largest_radius() const
{
  double result = 0;
  for (unsigned int v = 0; v < 4; ++v)
    result = std::max(result, map.vertices()[v][0]);
  return map.is_curved() ? centre[0] + outer : result;
}

/**
 * Of Poincare in the solid that a cell with an edge on the axis is a slice of, `(5^{1/2}/pi) (max(g det F) max |F|^2/min(g det F))^{1/2}`: F maps
 * a cylinder of radius and height 1 to it, whose diameter is 5^{1/2}, and r is g times the radius there.
 */
double CellConstants::poincare_on_axis(const unsigned int face_on_axis) const
{
  const auto [volume, xx, xy, yx, yy] = enclosures<5>(
      3 * degree_of(map),
      [&](const Point<2> &x)
      {
        const Tensor<2, 2> J = map.jacobian(x);
        const double radius = face_on_axis % 2 ? 1 - x[face_on_axis / 2] : x[face_on_axis / 2];
        return std::array<double, 5>{
            {determinant(J) * map.point(x)[0] / radius, J[0][0], J[0][1], J[1][0], J[1][1]}};
      });
  double norm = 0;
  for (const auto &[low, high] : {xx, xy, yx, yy})
    norm += std::pow(std::max(std::abs(low), std::abs(high)), 2);
  return std::sqrt(5 * volume.second / std::max(0., volume.first) * norm) / numbers::PI;
}

double CellConstants::trace_on_axis(const unsigned int face) const
{
  const std::optional<unsigned int> of_axis = axis_face(map);
  if (!of_axis || *std::min_element(inner.begin(), inner.end()) <= 0)
    return std::numeric_limits<double>::infinity();
  const double C = on_axis(), gradient = std::sqrt(1 + 2 * C * C),
               v = std::hypot(largest_radius(), poincare_on_axis(*of_axis) * gradient);
  // div(w (x - c)) <= 3 w, and (x - c) . n is not negative on other edges
  return std::sqrt((3 * v + 2 * outer * gradient) * v / inner[face]);
}

/** C without the material's coercivity; infinite: nothing is known. */
double CellConstants::on_axis() const
{
  double least = std::numeric_limits<double>::infinity(), a = 0, R = 0;
  const std::optional<unsigned int> face = axis_face(map);
  if (!face)
    return least;
  const std::vector<Piece> all = pieces(*face);
  const Point<2> middle = map.point(point_on_face<2>(*face, Point<1>(0.5)));
  for (const Piece &piece : all)
    a = std::max(a, piece[0].second);
  for (const Point<2> &v : map.vertices())
    R = std::max(R, middle.distance(v));
  if (map.is_curved())
    R = middle.distance(centre) + outer;
  for (double kappa = 0.3; kappa < 0.99; kappa += 0.02)
  {
    const double phi = std::acos(kappa), W = numbers::PI - 2 * phi + std::sin(2 * phi),
                 x = inner_of_slices(all, std::pow(kappa * a, 2)) / R;
    if (x > 0)
      least =
          std::min(least, 2 * numbers::PI / W * (2 / (x * x) * (1 + std::sqrt(1 - x * x)) - 0.5));
  }
  return std::sqrt(least);
}

double CellConstants::poincare() const
{
  if (!map.is_curved())
    return diameter / numbers::PI;
  const auto [det, xx, xy, yx, yy] = enclosures<5>(
      2 * degree_of(map),
      [&](const Point<2> &x)
      {
        const Tensor<2, 2> J = map.jacobian(x);
        return std::array<double, 5>{{determinant(J), J[0][0], J[0][1], J[1][0], J[1][1]}};
      });
  double norm = 0;
  for (const auto &[low, high] : {xx, xy, yx, yy})
    norm += std::pow(std::max(std::abs(low), std::abs(high)), 2);
  return 1 / numbers::PI * std::sqrt(det.second / std::max(0., det.first) * norm);
}

double CellConstants::korn() const
{
  const double x = *std::min_element(inner.begin(), inner.end()) / outer;
  return 2 / x * std::sqrt(1 + std::sqrt(std::max(0., 1 - x * x)));
}

double CellConstants::coercivity(const Material &material) const
{
  return material.plane == PlaneModel::axisymmetric
             ? std::max(0., full_turn<2>({least_x, 0.})) * material.coercivity(3)
             : material.coercivity(2);
}

double CellConstants::antisymmetry(const Material &material) const
{
  return is_on_axis(material) ? on_axis() / std::sqrt(material.coercivity(3))
                              : std::sqrt((korn() * korn() - 1) / 2 / coercivity(material));
}

double CellConstants::trace(const unsigned int face) const
{
  if (map.is_curved())
  {
    const double C = poincare();
    return std::sqrt(2 * C * (C + outer) / inner[face]);
  }
  const CellMap<2>::Vertices &v = map.vertices();
  const unsigned int a = start(face), step = face < 2 ? 1 : 2;
  if (map.is_affine())
  {
    const double across = v[0].distance(v[step]);
    return std::sqrt((poincare() + 2 * across) * poincare() / distance(v[start(face ^ 1)], face));
  }
  const Point<2> apex = point_on_face<2>(face ^ 1, Point<1>(0.5)), P = map.point(apex);
  const double reach = std::max(P.distance(v[a]), P.distance(v[a + 3 - step]));
  return std::sqrt(2 * (poincare() + reach) * poincare() / distance(P, face));
}
} // namespace hpvi
