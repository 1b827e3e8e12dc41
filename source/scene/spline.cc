// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/spline.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace hpvi
{
using namespace dealii;

namespace
{
/** The equations of slopes m_i: continuous second derivatives at knots inside, and conditions at the ends. */
class SlopeEquations
{
public:
  SlopeEquations(const std::vector<Point<2>> &points, const std::vector<double> &t,
                 const bool is_periodic)
      : points(points), t(t), n(is_periodic ? points.size() - 1 : points.size())
  {
    for (unsigned int i = is_periodic ? 0 : 1; i < (is_periodic ? n : n - 1); ++i)
      add_knot(i);
    if (!is_periodic)
      for (const unsigned int i : {0U, n - 3}) // not-a-knot at t_1 and t_{n-2}
        add_equal_cubics(i);
  }

  std::vector<Tensor<1, 2>> solve() const
  {
    DynamicSparsityPattern dynamic(n, n);
    for (const auto &[place, value] : entries)
      dynamic.add(place.first, place.second);
    SparsityPattern pattern;
    pattern.copy_from(dynamic);
    SparseMatrix<double> matrix(pattern);
    for (const auto &[place, value] : entries)
      matrix.add(place.first, place.second, value);
    SparseDirectUMFPACK solver;
    solver.initialize(matrix);
    std::vector<Tensor<1, 2>> slopes(n);
    for (unsigned int d = 0; d < 2; ++d)
    {
      Vector<double> solution(n);
      for (const auto &[row, value] : right)
        solution[row] = value[d];
      solver.solve(solution);
      for (unsigned int i = 0; i < n; ++i)
        slopes[i][d] = solution[i];
    }
    return slopes;
  }

private:
  double length(const unsigned int i) const
  {
    return t[i + 1] - t[i];
  }

  Tensor<1, 2> slope(const unsigned int i) const ///< of the chord
  {
    return (points[i + 1] - points[i]) / length(i);
  }

  void add_knot(const unsigned int i)
  {
    const unsigned int before = (i + n - 1) % n;
    const double h = length(before), k = length(i);
    entries[{i, before}] += k;
    entries[{i, i}] += 2 * (h + k);
    entries[{i, (i + 1) % n}] += h;
    right[i] = 3 * (k * slope(before) + h * slope(i));
  }

  /** (m_i + m_{i+1} - 2 d_i)/h_i^2 is the same on intervals i and i + 1. */
  void add_equal_cubics(const unsigned int i)
  {
    const unsigned int row = i == 0 && right.count(0) == 0 ? 0 : n - 1;
    const double h = std::pow(length(i + 1) / length(i), 2);
    entries[{row, i}] += h;
    entries[{row, i + 1}] += h - 1;
    entries[{row, i + 2}] += -1;
    right[row] = 2 * (h * slope(i) - slope(i + 1));
  }

  const std::vector<Point<2>> &points;
  const std::vector<double> &t;
  const unsigned int n;
  std::map<std::pair<unsigned int, unsigned int>, double> entries;
  std::map<unsigned int, Tensor<1, 2>> right;
};
} // namespace

Spline::Spline(const std::vector<Point<2>> &points)
    : points(points), is_periodic(points.front() == points.back()), parameters{0.}
{
  AssertThrow(points.size() >= 4, ExcMessage("A spline needs four points."));
  for (unsigned int i = 1; i < points.size(); ++i)
    parameters.push_back(parameters.back() + points[i].distance(points[i - 1]));
  slopes = SlopeEquations(points, parameters, is_periodic).solve();
  if (is_periodic)
    slopes.push_back(slopes.front());
}

const std::vector<double> &Spline::knots() const
{
  return parameters;
}

double Spline::into(const double t) const
{
  const double length = parameters.back();
  return is_periodic ? t - length * std::floor(t / length) : t;
}

unsigned int Spline::interval(const double t) const
{
  const auto after = std::upper_bound(parameters.begin() + 1, parameters.end() - 1, t);
  return after - parameters.begin() - 1;
}

Point<2> Spline::point(const double t) const
{
  const double place = into(t);
  const unsigned int i = interval(place);
  const double h = parameters[i + 1] - parameters[i], s = (place - parameters[i]) / h, r = 1 - s;
  const Tensor<1, 2> chord = points[i + 1] - points[i];
  return points[i] + s * s * (3 - 2 * s) * chord + h * s * r * (r * slopes[i] - s * slopes[i + 1]);
}

Tensor<1, 2> Spline::derivative(const double t) const
{
  const double place = into(t);
  const unsigned int i = interval(place);
  const double h = parameters[i + 1] - parameters[i], s = (place - parameters[i]) / h;
  const Tensor<1, 2> chord = (points[i + 1] - points[i]) / h;
  return 6 * s * (1 - s) * chord + (1 - s) * (1 - 3 * s) * slopes[i] +
         s * (3 * s - 2) * slopes[i + 1];
}

Tensor<1, 2> Spline::second_derivative(const double t) const
{
  const double place = into(t);
  const unsigned int i = interval(place);
  const double h = parameters[i + 1] - parameters[i], s = (place - parameters[i]) / h;
  const Tensor<1, 2> chord = (points[i + 1] - points[i]) / h;
  return ((6 - 12 * s) * chord + (6 * s - 4) * slopes[i] + (6 * s - 2) * slopes[i + 1]) / h;
}

Tensor<1, 2> Spline::third_derivative(const unsigned int interval) const
{
  const double h = parameters[interval + 1] - parameters[interval];
  const Tensor<1, 2> chord = (points[interval + 1] - points[interval]) / h;
  return 6 / (h * h) * (slopes[interval] + slopes[interval + 1] - 2. * chord);
}

// At the second knot and the last but one of an open spline nothing jumps, whatever the curve is: those beside them tell.
double Spline::doubt(const double from, const double to) const
{
  constexpr int near = 2;
  const int n = parameters.size() - 1, i = interval(into((from + to) / 2));
  double jump = 0;
  for (int k = i - near; k <= i + 1 + near; ++k)
    if (is_periodic || (k > 0 && k < n))
      jump = std::max(
          jump, (third_derivative((k + 2 * n) % n) - third_derivative((k - 1 + 2 * n) % n)).norm());
  return std::pow(parameters[i + 1] - parameters[i], 3) * jump / 24;
}

double doubt_of(const CurvePiece &piece)
{
  const auto *const spline = dynamic_cast<const Spline *>(piece.curve.get());
  return spline ? spline->doubt(piece.from, piece.to) : 0;
}

/** From the best of some places by Newton's method, which stays in the interval. */
double Spline::nearest(const Point<2> &x, const double from, const double to) const
{
  constexpr unsigned int n_places = 16;
  double best = from;
  for (unsigned int k = 0; k <= n_places; ++k)
    if (const double t = from + (to - from) * k / n_places;
        point(t).distance(x) < point(best).distance(x))
      best = t;
  for (unsigned int step = 0; step < 20; ++step)
  {
    const Tensor<1, 2> rest = point(best) - x, way = derivative(best);
    const double curvature = way * way + rest * second_derivative(best);
    if (!(curvature > 0))
      break;
    best = std::clamp(best - rest * way / curvature, std::min(from, to), std::max(from, to));
  }
  return best;
}
} // namespace hpvi
