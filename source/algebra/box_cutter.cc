// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/box_cutter.h>
#include <hpvi/base/tolerances.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr unsigned int most_pieces = 64;

/** Every other one between the first and the last. */
void thin_out(std::vector<double> &lines)
{
  std::vector<double> kept;
  for (std::size_t k = 0; k + 1 < lines.size(); k += 2)
    kept.push_back(lines[k]);
  kept.push_back(lines.back());
  lines = kept;
}

double distance(const std::array<BoxCutter::Value, 4> &a, const std::array<BoxCutter::Value, 4> &b)
{
  double result = 0;
  for (unsigned int k = 0; k < 4; ++k)
    result = std::max(result, (a[k] - b[k]).norm());
  return result;
}
} // namespace

BoxCutter::BoxCutter(Function function, const QGauss<1> &gauss,
                     const std::array<unsigned int, 2> &n_parts,
                     std::array<std::vector<double>, 2> lines)
    : f(std::move(function)), gauss(gauss), n_parts(n_parts)
{
  while ((lines[0].size() - 1) * (lines[1].size() - 1) > most_pieces / 2)
    thin_out(lines[lines[1].size() > lines[0].size()]);
  for (unsigned int j = 0; j + 1 < lines[1].size(); ++j)
    for (unsigned int i = 0; i + 1 < lines[0].size(); ++i)
    {
      Piece piece{BoundingBox<2>({Point<2>(lines[0][i], lines[1][j]),
                                  Point<2>(lines[0][i + 1], lines[1][j + 1])}),
                  {},
                  {},
                  0.};
      measure(piece);
      pieces.push_back(piece);
    }
}

BoxCutter::Grid BoxCutter::sample(const BoundingBox<2> &box, const unsigned int n_x,
                                  const unsigned int n_y, Moments &moments)
{
  Grid grid;
  std::array<std::vector<double>, 2> weights;
  for (unsigned int d = 0; d < 2; ++d)
    for (unsigned int part = 0, n = d == 0 ? n_x : n_y; part < n; ++part)
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const double width = box.side_length(d) / n;
        grid.coordinates[d].push_back(box.lower_bound(d) + width * (part + gauss.point(q)[0]));
        weights[d].push_back(width * gauss.weight(q));
      }
  moments = {};
  for (unsigned int b = 0; b < weights[1].size(); ++b)
    for (unsigned int a = 0; a < weights[0].size(); ++a)
    {
      const Point<2> x(grid.coordinates[0][a], grid.coordinates[1][b]);
      grid.values.push_back(f(x));
      largest = std::max(largest, grid.values.back().norm());
      const BoxCutter::Value part = weights[0][a] * weights[1][b] * grid.values.back();
      for (unsigned int k = 0; k < 4; ++k)
        moments[k] += (k % 2 ? x[0] : 1.) * (k / 2 ? x[1] : 1.) * part;
    }
  return grid;
}

/** Of the whole, as many as lie in a box; no fewer than two per direction. */
std::array<unsigned int, 2> BoxCutter::parts_of(const BoundingBox<2> &box) const
{
  const auto n = [&](const unsigned int d)
  { return std::max(2U, static_cast<unsigned int>(std::ceil(n_parts[d] * box.side_length(d)))); };
  return {{n(0), n(1)}};
}

void BoxCutter::measure(Piece &piece)
{
  Moments own, finer, finest;
  sample(piece.box, 1, 1, own);
  sample(piece.box, 2, 2, finer);
  const std::array<unsigned int, 2> n = parts_of(piece.box);
  if (n[0] * n[1] > 4)
    sample(piece.box, n[0], n[1], finest);
  else
    finest = finer;
  piece.integral = own[0];
  piece.finer = finest[0];
  piece.deviation = std::max(distance(own, finest), distance(finer, finest));
}

/** Where f jumps between the samples i and its next one in direction d; not, where bisection flattens it. */
std::optional<double> BoxCutter::jump(const Grid &grid, const unsigned int d,
                                      const std::array<unsigned int, 2> &i) const
{
  std::array<unsigned int, 2> next = i;
  ++next[d];
  Point<2> left(grid.coordinates[0][i[0]], grid.coordinates[1][i[1]]), right = left;
  right[d] = grid.coordinates[d][next[d]];
  BoxCutter::Value before = grid.at(i), behind = grid.at(next);
  const double half_change = 0.5 * (behind - before).norm();
  while ((behind - before).norm() > half_change)
  {
    Point<2> middle = left;
    middle[d] = 0.5 * (left[d] + right[d]);
    if (!(left[d] < middle[d] && middle[d] < right[d]))
      return middle[d];
    const BoxCutter::Value value = f(middle);
    if ((value - before).norm() > (behind - value).norm())
    {
      right = middle;
      behind = value;
    }
    else
    {
      left = middle;
      before = value;
    }
  }
  return {};
}

/** A jump across direction d that is seen at the same place from far apart. */
std::optional<double> BoxCutter::common_jump(const Grid &grid, const unsigned int d) const
{
  const unsigned int e = 1 - d;
  const auto change = [&](std::array<unsigned int, 2> i)
  {
    const BoxCutter::Value before = grid.at(i);
    ++i[d];
    return (grid.at(i) - before).norm();
  };
  std::array<unsigned int, 2> steepest{{0, 0}}, i;
  for (i[e] = 0; i[e] < grid.coordinates[e].size(); ++i[e])
    for (i[d] = 0; i[d] + 1 < grid.coordinates[d].size(); ++i[d])
      if (change(i) > change(steepest))
        steepest = i;
  const auto far = [&](const unsigned int k)
  { return std::abs(static_cast<int>(k) - static_cast<int>(steepest[e])); };
  std::array<unsigned int, 2> farthest = steepest;
  i = steepest;
  for (i[e] = 0; i[e] < grid.coordinates[e].size(); ++i[e])
    if (far(i[e]) > far(farthest[e]) && change(i) > 0.5 * change(steepest))
      farthest = i;
  if (farthest == steepest)
    return {};
  const std::optional<double> here = jump(grid, d, steepest),
                              there = here ? jump(grid, d, farthest) : std::nullopt;
  return there && std::abs(*here - *there) < same_cut ? here : std::nullopt;
}

/** Direction and place: at such a jump, else in the middle, across the direction that gains more. */
std::pair<unsigned int, double> BoxCutter::find_cut(const BoundingBox<2> &box)
{
  Moments own, along_x, along_y, all;
  sample(box, 1, 1, own);
  sample(box, 2, 1, along_x);
  sample(box, 1, 2, along_y);
  const unsigned int d = distance(own, along_x) >= distance(own, along_y) ? 0 : 1;
  const std::array<unsigned int, 2> n = parts_of(box);
  const Grid grid = sample(box, n[0], n[1], all);
  for (const unsigned int e : {d, 1 - d})
    if (const auto jump = common_jump(grid, e))
      return {e, *jump};
  return {d, 0.5 * (box.lower_bound(d) + box.upper_bound(d))};
}

const std::vector<BoxCutter::Piece> &BoxCutter::cut()
{
  while (pieces.size() < most_pieces)
  {
    const auto worst =
        std::max_element(pieces.begin(), pieces.end(),
                         [](const Piece &a, const Piece &b) { return a.deviation < b.deviation; });
    if (!(worst->deviation > 1e-13 * largest))
      break;
    const auto [d, s] = find_cut(worst->box);
    auto [lower, upper] = worst->box.get_boundary_points();
    Point<2> corner = lower, opposite = upper;
    corner[d] = opposite[d] = s;
    Piece right{BoundingBox<2>({corner, upper}), {}, {}, 0.};
    worst->box = BoundingBox<2>({lower, opposite});
    measure(*worst);
    measure(right);
    pieces.push_back(right);
  }
  return pieces;
}
} // namespace hpvi
