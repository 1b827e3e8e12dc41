// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/plane/cell_map.h>
#include <hpvi/plane/load_quadrature.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Gauss points at most: on each of several pieces, on a single one. */
constexpr unsigned int most_on_pieces = 16, most = 64;

/** Moments with 1, s, s^2 in each of d directions, largest value and smallest. */
struct Sample
{
  std::array<double, 9> moments{}; ///< three in one dimension
  double largest = -1e300, smallest = 1e300;

  template <int d, class Load>
  static Sample take(const QGauss<1> &gauss, const Load &load)
  {
    Sample result;
    const unsigned int n = gauss.size();
    for (unsigned int a = 0; a < n; ++a)
      for (unsigned int b = 0; b < (d == 1 ? 1 : n); ++b)
      {
        Point<d> s;
        s[0] = gauss.point(a)[0];
        if (d == 2)
          s[d - 1] = gauss.point(b)[0];
        const double value = load(s);
        result.largest = std::max(result.largest, value);
        result.smallest = std::min(result.smallest, value);
        double across = gauss.weight(a) * (d == 1 ? 1. : gauss.weight(b)) * value;
        for (unsigned int j = 0; j < (d == 1 ? 1 : 3); ++j, across *= s[d - 1])
        {
          double moment = across;
          for (unsigned int i = 0; i < 3; ++i, moment *= s[0])
            result.moments[3 * j + i] += moment;
        }
      }
    return result;
  }
};

/** Round-off of the load itself can be above that of its moments, as in 1 - x near x = 1: more points stop where they no longer help. */
template <int d, class Load>
unsigned int points_for(unsigned int n, const unsigned int most, const Load &load,
                        const ShapeTables<2> &tables)
{
  double before = 1e300;
  for (Sample here = Sample::take<d>(tables.gauss(n), load);
       here.largest != here.smallest && n < most;)
  {
    const unsigned int more = std::min(n + 4, most);
    const Sample there = Sample::take<d>(tables.gauss(more), load);
    const double scale = std::max(std::abs(there.largest), std::abs(there.smallest));
    double change = 0;
    for (unsigned int k = 0; k < here.moments.size(); ++k)
      change = std::max(change, std::abs(here.moments[k] - there.moments[k]) / scale);
    if (change <= 1e-15 || (change <= 1e-12 && change >= before / 2))
      break;
    n = more;
    here = there;
    before = change;
  }
  return n;
}

template <int d>
Point<d> point_in(const BoundingBox<d> &box, const Point<d> &unit)
{
  Point<d> result;
  for (unsigned int c = 0; c < d; ++c)
    result[c] = box.lower_bound(c) + box.side_length(c) * unit[c];
  return result;
}
} // namespace

template <int d>
std::vector<RulePart<d>>
rule_parts(const std::vector<BoundingBox<d>> &boxes, const unsigned int degree,
           const std::vector<std::function<double(const Point<d> &)>> &functions,
           const ShapeTables<2> &tables)
{
  std::vector<RulePart<d>> result;
  for (const BoundingBox<d> &box : boxes)
  {
    unsigned int n = degree + 2;
    for (const auto &function : functions)
      n = points_for<d>(
          n, boxes.size() == 1 ? most : most_on_pieces,
          [&](const Point<d> &unit) { return function(point_in(box, unit)); }, tables);
    result.push_back({box, n});
  }
  return result;
}

template <int d>
LoadRule<d> rule_on(const std::vector<RulePart<d>> &parts, const ShapeTables<2> &tables)
{
  LoadRule<d> result{parts, parts.size() == 1 ? parts[0].n : 0, 0, Quadrature<d>(), {}};
  std::vector<Point<d>> points;
  std::vector<double> weights;
  for (const auto &[box, n] : parts)
  {
    const Quadrature<d> gauss(tables.gauss(n));
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      points.push_back(point_in(box, gauss.point(q)));
      weights.push_back(box.volume() * gauss.weight(q));
    }
    result.most_points = std::max(result.most_points, n);
  }
  result.quadrature = Quadrature<d>(points, weights);
  return result;
}

namespace
{
std::vector<Point<2>> points_on(const unsigned int face, const Quadrature<1> &rule)
{
  std::vector<Point<2>> result;
  for (const Point<1> &s : rule.get_points())
    result.push_back(point_on_face<2>(face, s));
  return result;
}
} // namespace

ShapesOfRule::ShapesOfRule(const LoadRule<2> &rule, const unsigned int degree,
                           const ShapeTables<2> &tables)
    : own(rule.n_gauss > 0 ? ShapeTable<2>()
                           : tabulate<2>(degree, rule.quadrature.get_points(),
                                         rule.quadrature.get_weights(), false)),
      table(rule.n_gauss > 0 ? tables.gradients(degree, rule.n_gauss) : own)
{
}

ShapesOfRule::ShapesOfRule(const LoadRule<1> &rule, const unsigned int face,
                           const unsigned int degree, const ShapeTables<2> &tables)
    : own(rule.n_gauss > 0 ? ShapeTable<2>()
                           : tabulate<2>(degree, points_on(face, rule.quadrature),
                                         rule.quadrature.get_weights(), false)),
      table(rule.n_gauss > 0 ? tables.face(degree, face, rule.n_gauss) : own)
{
}

template std::vector<RulePart<1>>
rule_parts(const std::vector<BoundingBox<1>> &, unsigned int,
           const std::vector<std::function<double(const Point<1> &)>> &, const ShapeTables<2> &);
template std::vector<RulePart<2>>
rule_parts(const std::vector<BoundingBox<2>> &, unsigned int,
           const std::vector<std::function<double(const Point<2> &)>> &, const ShapeTables<2> &);
template LoadRule<1> rule_on(const std::vector<RulePart<1>> &, const ShapeTables<2> &);
template LoadRule<2> rule_on(const std::vector<RulePart<2>> &, const ShapeTables<2> &);
} // namespace hpvi
