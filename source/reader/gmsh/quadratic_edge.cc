// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/reader/gmsh/quadratic_edge.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace hpvi
{
using namespace dealii;

QuadraticEdge::QuadraticEdge(const Point<2> &a, const Point<2> &m, const Point<2> &b)
    : start(a), chord(b - a), bulge((m - a) - 0.5 * (b - a))
{
}

Point<2> QuadraticEdge::point(const double t) const
{
  return start + t * chord + 4 * t * (1 - t) * bulge;
}

Tensor<1, 2> QuadraticEdge::derivative(const double t) const
{
  return chord + 4 * (1 - 2 * t) * bulge;
}

double QuadraticEdge::slope(const Point<2> &x, const double t) const
{
  return (point(t) - x) * derivative(t);
}

namespace
{
/** The roots in (low, high), ascending, of `a t^2 + b t + c`: without cancellation. */
std::vector<double> quadratic_roots(const double a, const double b, const double c,
                                    const double low, const double high)
{
  const double discriminant = b * b - 4 * a * c;
  std::vector<double> roots;
  if (discriminant < 0)
    return roots;
  const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
  for (const double root : {a != 0 ? q / a : low, q != 0 ? c / q : low})
    if (root > low && root < high)
      roots.push_back(root);
  std::sort(roots.begin(), roots.end());
  return roots;
}
} // namespace

double QuadraticEdge::nearest(const Point<2> &x, const double from, const double to) const
{
  const double low = std::min(from, to), high = std::max(from, to);
  // The slope is a cubic; between the roots of its own derivative it is monotone.
  const Tensor<1, 2> tangent = chord + 4. * bulge, offset = start - x;
  std::vector<double> pieces = quadratic_roots(96 * (bulge * bulge), -24 * (tangent * bulge),
                                               tangent * tangent - 8 * (offset * bulge), low, high);
  pieces.insert(pieces.begin(), low);
  pieces.push_back(high);
  std::vector<double> candidates = {low, high};
  for (std::size_t k = 0; k + 1 < pieces.size(); ++k)
  {
    double left = pieces[k], right = pieces[k + 1];
    if (!(slope(x, left) < 0 && slope(x, right) > 0)) // no minimum of the distance
      continue;
    for (unsigned int i = 0; i < 200 && left < 0.5 * (left + right) && 0.5 * (left + right) < right;
         ++i)
      (slope(x, 0.5 * (left + right)) < 0 ? left : right) = 0.5 * (left + right);
    candidates.push_back(left);
  }
  return *std::min_element(candidates.begin(), candidates.end(),
                           [&](const double s, const double t)
                           { return (point(s) - x).norm() < (point(t) - x).norm(); });
}

bool QuadraticEdge::is_regular() const
{
  return 4 * std::abs(bulge * chord) < chord * chord;
}

double QuadraticEdge::bow() const
{
  return std::abs(chord[0] * bulge[1] - chord[1] * bulge[0]) / (chord * chord);
}
} // namespace hpvi
