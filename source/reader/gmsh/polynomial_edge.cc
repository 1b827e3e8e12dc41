// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/reader/gmsh/polynomial_edge.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

std::vector<double> equidistant_places(const unsigned int n)
{
  std::vector<double> result(n + 1);
  for (unsigned int k = 0; k <= n; ++k)
    result[k] = double(k) / n;
  return result;
}

std::vector<double> chebyshev_places(const unsigned int n)
{
  std::vector<double> result(n + 1);
  for (unsigned int k = 0; k <= n; ++k)
    result[k] = (1 - std::cos(numbers::PI * k / n)) / 2;
  return result;
}

PolynomialEdge::PolynomialEdge(const std::vector<double> &places, std::vector<Panel> panels)
    : places(places), weights(places.size(), 1.)
{
  for (unsigned int j = 0; j < places.size(); ++j)
    for (unsigned int k = 0; k < places.size(); ++k)
      if (k != j)
        weights[j] /= 4 * (places[j] - places[k]); // 4: the capacity of [0,1] is 1/4
  for (const Panel &panel : panels)
  {
    Piece piece{panel.begin, panel.end, {}, {}, {}};
    for (const Point<2> &x : panel.points)
      piece.values.push_back(x);
    piece.slopes = derivatives(piece.values, panel.end - panel.begin);
    piece.bends = derivatives(piece.slopes, panel.end - panel.begin);
    pieces.push_back(piece);
  }
}

/** p'(t_j) = sum over k of (w_k/w_j) (p_k - p_j)/(t_j - t_k). */
PolynomialEdge::Values PolynomialEdge::derivatives(const Values &values, const double length) const
{
  Values result(values.size());
  for (unsigned int j = 0; j < values.size(); ++j)
    for (unsigned int k = 0; k < values.size(); ++k)
      if (k != j)
        result[j] +=
            weights[k] / weights[j] / (places[j] - places[k]) / length * (values[k] - values[j]);
  return result;
}

const PolynomialEdge::Piece &PolynomialEdge::piece_at(const double t) const
{
  unsigned int k = 0;
  while (k + 1 < pieces.size() && t >= pieces[k].end)
    ++k;
  return pieces[k];
}

Tensor<1, 2> PolynomialEdge::value(const Piece &piece, const Values &values, const double t) const
{
  const double s = (t - piece.begin) / (piece.end - piece.begin);
  Tensor<1, 2> above;
  double below = 0;
  for (unsigned int k = 0; k < places.size(); ++k)
  {
    const double offset = s - places[k];
    if (offset == 0)
      return values[k];
    above += weights[k] / offset * values[k];
    below += weights[k] / offset;
  }
  return above / below;
}

Point<2> PolynomialEdge::point(const double t) const
{
  const Piece &piece = piece_at(t);
  return Point<2>(value(piece, piece.values, t));
}

Tensor<1, 2> PolynomialEdge::derivative(const double t) const
{
  const Piece &piece = piece_at(t);
  return value(piece, piece.slopes, t);
}

/** From the best of some places by Newton's method, which stays in the interval. */
double PolynomialEdge::nearest(const Point<2> &x, const double from, const double to) const
{
  constexpr unsigned int n_places = 16;
  double best = from;
  for (unsigned int k = 1; k <= n_places; ++k)
    if (const double t = from + (to - from) * k / n_places;
        point(t).distance(x) < point(best).distance(x))
      best = t;
  for (unsigned int step = 0; step < 20; ++step)
  {
    const Piece &piece = piece_at(best);
    const Tensor<1, 2> rest = point(best) - x, way = derivative(best);
    const double curvature = way * way + rest * value(piece, piece.bends, best);
    if (!(curvature > 0))
      break;
    const double next =
        std::clamp(best - rest * way / curvature, std::min(from, to), std::max(from, to));
    if (std::abs(next - best) < 1e-16)
      break;
    best = next;
  }
  return best;
}

bool PolynomialEdge::is_regular() const
{
  const Tensor<1, 2> chord = point(1) - point(0);
  for (unsigned int k = 0; k <= 32; ++k)
    if (!(derivative(k / 32.) * chord > 0))
      return false;
  return true;
}

double PolynomialEdge::bow() const
{
  const Tensor<1, 2> chord = point(1) - point(0);
  double result = 0;
  for (const Piece &piece : pieces)
    for (const Tensor<1, 2> &x : piece.values)
    {
      const Tensor<1, 2> arm = x - Tensor<1, 2>(point(0));
      result = std::max(result, std::abs(chord[0] * arm[1] - chord[1] * arm[0]) / (chord * chord));
    }
  return result;
}
} // namespace hpvi
