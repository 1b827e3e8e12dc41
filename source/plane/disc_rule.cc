// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/tolerances.h>
#include <hpvi/plane/disc_rule.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr double longest_arc = 0.25;                           ///< [rad]
constexpr std::array<double, 3> samples = {{0.31, 0.5, 0.77}}; ///< of a piece between crossings

double cross(const Tensor<1, 2> &a, const Tensor<1, 2> &b)
{
  return a[0] * b[1] - a[1] * b[0];
}

/** The corners of the unit cell, counterclockwise. */
Point<2> corner(const unsigned int k)
{
  return {k % 4 == 1 || k % 4 == 2 ? 1. : 0., k % 4 >= 2 ? 1. : 0.};
}

/** A piece of the boundary of the part, from s = 0 to 1, counterclockwise around it. */
struct Piece
{
  std::function<Point<2>(double)> point;     ///< of the unit cell
  std::function<Tensor<1, 2>(double)> along; ///< its derivative
};

/** Finds the part of one cell in the disc. */
class CutCell
{
public:
  CutCell(const CellMap<2> &map, const Point<2> &centre, const double radius)
      : map(map), centre(centre), radius(radius)
  {
    for (unsigned int k = 0; k < 4; ++k)
      find_edge(k);
    find_arcs();
  }

  bool is_whole() const
  {
    return n_whole_edges == 4 && !has_arcs;
  }

  const std::vector<Piece> &pieces() const
  {
    return all;
  }

private:
  /** Negative inside the disc, of the size of 1 at its centre. */
  double level(const Point<2> &reference) const
  {
    return map.point(reference).distance_square(centre) / (radius * radius) - 1.;
  }

  Point<2> on_edge(const unsigned int k, const double s) const
  {
    return corner(k) + s * (corner(k + 1) - corner(k));
  }

  void find_edge(unsigned int k);
  std::vector<double> roots_on(unsigned int k) const;
  void find_arcs();
  std::optional<Point<2>> reference(const Point<2> &x, Point<2> start) const;
  void add_arc(double begin, double end, const Point<2> &start);

  const CellMap<2> &map;
  const Point<2> centre;
  const double radius;
  std::vector<double> angles; ///< where the circle crosses an edge [rad]
  unsigned int n_whole_edges = 0;
  bool has_arcs = false;
  std::vector<Piece> all;
};

/** Of the level, in [0,1], ascending: of a straight edge by a quadratic equation, of a curved one between samples. */
std::vector<double> CutCell::roots_on(const unsigned int k) const
{
  std::vector<double> roots;
  const auto value = [&](const double s) { return level(on_edge(k, s)); };
  if (!map.is_curved())
  {
    const Tensor<1, 2> from = map.point(corner(k)) - centre,
                       way = map.point(corner(k + 1)) - map.point(corner(k));
    const double a = way.norm_square(), b = from * way, c = from.norm_square() - radius * radius,
                 discriminant = b * b - a * c;
    if (discriminant > 0)
    {
      const double q = -(b + std::copysign(std::sqrt(discriminant), b));
      for (const double root : {q / a, q == 0 ? 0. : c / q})
        if (root > -same_on_edge && root < 1 + same_on_edge)
          roots.push_back(std::clamp(root, 0., 1.));
    }
  }
  else
  {
    constexpr unsigned int n = 64;
    for (unsigned int i = 0; i < n; ++i)
    {
      double low = double(i) / n, high = double(i + 1) / n;
      const bool begins_inside = value(low) < 0;
      if (begins_inside == (value(high) < 0))
        continue;
      while (high - low > 1e-16)
      {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high)
          break;
        ((value(middle) < 0) == begins_inside ? low : high) = middle;
      }
      roots.push_back(0.5 * (low + high));
    }
  }
  std::sort(roots.begin(), roots.end());
  return roots;
}

/** What of it is inside; an edge on the circle counts where its cell is inside. */
void CutCell::find_edge(const unsigned int k)
{
  std::vector<double> ends{0.};
  for (const double root : roots_on(k))
  {
    const Tensor<1, 2> out = map.point(on_edge(k, root)) - centre;
    angles.push_back(std::atan2(out[1], out[0]));
    if (root > ends.back() + same_on_edge)
      ends.push_back(root);
  }
  if (1 - ends.back() > same_on_edge)
    ends.push_back(1.);
  const Point<2> inwards = Point<2>(0.5, 0.5);
  for (unsigned int i = 0; i + 1 < ends.size(); ++i)
  {
    const double begin = ends[i], end = ends[i + 1];
    double here = 0;
    for (const double share : samples) // the circle may touch the edge at one of them
      if (const double value = level(on_edge(k, begin + share * (end - begin)));
          std::abs(value) > std::abs(here))
        here = value;
    if (const Point<2> middle = on_edge(k, 0.5 * (begin + end)); std::abs(here) < same_on_edge)
      here = level(middle + 1e-3 * (inwards - middle));
    if (here > 0)
      continue;
    n_whole_edges += end - begin > 1 - 2 * same_on_edge ? 1 : 0;
    const Point<2> a = on_edge(k, begin), b = on_edge(k, end);
    all.push_back({[a, b](const double s) { return a + s * (b - a); },
                   [a, b](const double) -> Tensor<1, 2> { return b - a; }});
  }
}

/** By Newton's method from @p start; none outside the cell, of which a hair counts as outside. */
std::optional<Point<2>> CutCell::reference(const Point<2> &x, Point<2> start) const
{
  const double size = map.longest_edge();
  for (unsigned int step = 0; step < 30; ++step)
  {
    const Tensor<1, 2> rest = x - map.point(start);
    if (rest.norm() <= 1e-15 * size)
      break;
    const Tensor<2, 2> J = map.jacobian(start);
    if (!(std::abs(determinant(J)) > 1e-12 * size * size))
      return std::nullopt;
    start += invert(J) * rest;
    if (start.norm() > 10)
      return std::nullopt;
  }
  if (x.distance(map.point(start)) > same_on_edge * size)
    return std::nullopt;
  for (const double coordinate : {start[0], start[1]})
    if (coordinate < same_on_edge || coordinate > 1 - same_on_edge)
      return std::nullopt;
  return start;
}

/** Between crossings the circle is inside the cell as a whole or not at all. */
void CutCell::find_arcs()
{
  if (angles.empty())
    angles.push_back(0.);
  std::sort(angles.begin(), angles.end());
  angles.push_back(angles.front() + 2 * numbers::PI);
  for (unsigned int i = 0; i + 1 < angles.size(); ++i)
  {
    const double begin = angles[i], end = angles[i + 1];
    if (end - begin < same_on_edge)
      continue;
    for (const double share : samples) // it may touch an edge at one of them
    {
      const double angle = begin + share * (end - begin);
      const Point<2> x = centre + radius * Tensor<1, 2>({std::cos(angle), std::sin(angle)});
      if (const auto inside = reference(x, {0.5, 0.5}))
      {
        has_arcs = true;
        add_arc(begin, end, *inside);
        break;
      }
    }
  }
}

/** In short pieces. */
void CutCell::add_arc(const double begin, const double end, const Point<2> &start)
{
  const unsigned int n = std::ceil((end - begin) / longest_arc);
  for (unsigned int k = 0; k < n; ++k)
  {
    const double angle = begin + k * (end - begin) / n, width = (end - begin) / n;
    const auto at = [this, angle, width](const double s) -> Tensor<1, 2> {
      return Tensor<1, 2>({std::cos(angle + s * width), std::sin(angle + s * width)});
    };
    const auto point = [this, at, start](const double s)
    {
      const Point<2> x = centre + radius * at(s);
      Point<2> result = start;
      for (unsigned int step = 0; step < 30; ++step)
      {
        const Tensor<1, 2> rest = x - map.point(result);
        result += invert(map.jacobian(result)) * rest;
        if (rest.norm() <= 1e-15 * map.longest_edge())
          break;
      }
      return GeometryInfo<2>::project_to_unit_cell(result);
    };
    all.push_back({point, [this, at, point, width](const double s)
                   {
                     const Tensor<1, 2> e = at(s);
                     const Tensor<1, 2> turned({-e[1], e[0]});
                     return invert(map.jacobian(point(s))) * (radius * width * turned);
                   }});
  }
}
} // namespace

DiscRule disc_rule(const CellMap<2> &map, const Point<2> &centre, const double radius,
                   const unsigned int n_gauss)
{
  DiscRule rule;
  const Point<2> middle(0.5, 0.5);
  if (map.point(middle).distance(centre) > radius + 2 * map.longest_edge())
    return rule;
  const CutCell cut(map, centre, radius);
  const auto add = [&](const Point<2> &reference, const double weight)
  {
    rule.points.push_back(reference);
    rule.areas.push_back(weight * determinant(map.jacobian(reference)));
  };
  if (cut.is_whole())
  {
    const QGauss<2> gauss(n_gauss);
    for (unsigned int q = 0; q < gauss.size(); ++q)
      add(gauss.point(q), gauss.weight(q));
    return rule;
  }
  if (cut.pieces().empty())
    return rule;
  Point<2>
      from; // any point of the cell will do, this one makes no sector negative where none has to be
  for (const Piece &piece : cut.pieces())
    from += piece.point(0.) / double(cut.pieces().size());
  const QGauss<1> gauss(n_gauss);
  for (const Piece &piece : cut.pieces())
    for (unsigned int i = 0; i < n_gauss; ++i)
    {
      const double s = gauss.point(i)[0];
      const Tensor<1, 2> out = piece.point(s) - from;
      const double width = cross(out, piece.along(s));
      for (unsigned int j = 0; j < n_gauss; ++j)
      {
        const double t = gauss.point(j)[0];
        add(from + t * out, gauss.weight(i) * gauss.weight(j) * t * width);
      }
    }
  return rule;
}
} // namespace hpvi
