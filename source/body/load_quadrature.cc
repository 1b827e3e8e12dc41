// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/body/load_quadrature.h>

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

template <int d, class Load>
unsigned int points_for(unsigned int n, const unsigned int most, const Load &load,
                        const ShapeTables<2> &tables)
{
  for (Sample here = Sample::take<d>(tables.gauss(n), load);
       here.largest != here.smallest && n < most;)
  {
    const unsigned int more = std::min(n + 4, most);
    const Sample there = Sample::take<d>(tables.gauss(more), load);
    const double scale = std::max(std::abs(there.largest), std::abs(there.smallest));
    bool same = true;
    for (unsigned int k = 0; k < here.moments.size(); ++k)
      same = same && std::abs(here.moments[k] - there.moments[k]) <= 1e-15 * scale;
    if (same)
      break;
    n = more;
    here = there;
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
LoadRule<d> rule_on(const std::vector<BoundingBox<d>> &boxes, const unsigned int degree,
                    const std::array<Expression<2>, 2> &components,
                    const std::function<double(const Function<2> &, const Point<d> &)> &value,
                    const ShapeTables<2> &tables)
{
  LoadRule<d> result{0, 0, Quadrature<d>(), {}};
  std::vector<Point<d>> points;
  std::vector<double> weights;
  for (const BoundingBox<d> &box : boxes)
  {
    unsigned int n = degree + 2;
    for (const auto &component : components)
      if (component)
        n = points_for<d>(
            n, boxes.size() == 1 ? most : most_on_pieces,
            [&](const Point<d> &unit) { return value(*component, point_in(box, unit)); }, tables);
    const Quadrature<d> gauss(tables.gauss(n));
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      points.push_back(point_in(box, gauss.point(q)));
      weights.push_back(box.volume() * gauss.weight(q));
    }
    result.n_gauss = boxes.size() == 1 ? n : 0;
    result.most_points = std::max(result.most_points, n);
  }
  result.quadrature = Quadrature<d>(points, weights);
  return result;
}

template LoadRule<1> rule_on(const std::vector<BoundingBox<1>> &, unsigned int,
                             const std::array<Expression<2>, 2> &,
                             const std::function<double(const Function<2> &, const Point<1> &)> &,
                             const ShapeTables<2> &);
template LoadRule<2> rule_on(const std::vector<BoundingBox<2>> &, unsigned int,
                             const std::array<Expression<2>, 2> &,
                             const std::function<double(const Function<2> &, const Point<2> &)> &,
                             const ShapeTables<2> &);
} // namespace hpvi
