// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/body/load_points.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr unsigned int most = 64;

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
unsigned int points_for(unsigned int n, const Load &load, const ShapeTables<2> &tables)
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
} // namespace

template <>
unsigned int traction_points(const BoundaryCondition<2> &condition, const CellMap<2> &map,
                             const unsigned int face, const unsigned int degree,
                             const ShapeTables<2> &tables)
{
  unsigned int n = degree + 2;
  for (const auto &component : condition.traction)
    if (component)
      n = points_for<1>(
          n,
          [&](const Point<1> &s) { return component->value(map.point(point_on_face<2>(face, s))); },
          tables);
  return n;
}

template <>
unsigned int body_force_points(const Scene<2> &scene, const CellMap<2> &map,
                               const unsigned int degree, const ShapeTables<2> &tables)
{
  unsigned int n = degree + 2;
  for (const auto &component : scene.body_force)
    if (component)
      n = points_for<2>(
          n, [&](const Point<2> &s) { return component->value(map.point(s)); }, tables);
  return n;
}
} // namespace hpvi
