// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/reader/shapes/curve_fit.h>
#include <hpvi/scene/spline.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/tensor.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace hpvi
{
using namespace dealii;

bool EdgeChain::is_closed() const
{
  return vertices.front() == vertices.back();
}

std::vector<EdgeChain> chains_of(const CoarseMesh &mesh, const std::vector<unsigned int> &edges)
{
  std::map<unsigned int, unsigned int> starting;
  std::set<unsigned int> ends;
  for (const unsigned int e : edges)
  {
    starting[mesh.edges[e].vertices[0]] = e;
    ends.insert(mesh.edges[e].vertices[1]);
  }
  std::vector<EdgeChain> result;
  std::set<unsigned int> done;
  for (const bool closed : {false, true})
    for (const unsigned int first : edges)
    {
      if (done.count(first) || (!closed && ends.count(mesh.edges[first].vertices[0])))
        continue;
      EdgeChain chain{{}, {mesh.edges[first].vertices[0]}};
      for (auto next = starting.find(chain.vertices[0]);
           next != starting.end() && done.insert(next->second).second;
           next = starting.find(chain.vertices.back()))
      {
        chain.edges.push_back(next->second);
        chain.vertices.push_back(mesh.edges[next->second].vertices[1]);
      }
      if (!chain.edges.empty())
        result.push_back(chain);
    }
  return result;
}

namespace
{
/** Between the chords that meet at a vertex inside a chain [degrees]; at ends of an open one 180. */
double turn_at(const CoarseMesh &mesh, const EdgeChain &chain, const unsigned int k)
{
  const unsigned int n = chain.edges.size();
  if ((k == 0 || k == n) && !chain.is_closed())
    return 180;
  const Point<2> &here = mesh.vertices[chain.vertices[k]];
  const Tensor<1, 2> in = here - mesh.vertices[chain.vertices[k == 0 ? n - 1 : k - 1]],
                     out = mesh.vertices[chain.vertices[k == n ? 1 : k + 1]] - here;
  return std::abs(std::atan2(in[0] * out[1] - in[1] * out[0], in * out)) * 180 / numbers::PI;
}

/** The pieces of a chain between its corners; a closed one without corners stays whole. */
std::vector<EdgeChain> pieces_of(const CoarseMesh &mesh, const EdgeChain &chain,
                                 const double corner)
{
  std::vector<unsigned int> cuts;
  for (unsigned int k = 0; k < chain.edges.size(); ++k)
    if (turn_at(mesh, chain, k) >= corner)
      cuts.push_back(k);
  if (cuts.empty())
    return {chain};
  std::vector<EdgeChain> result;
  const unsigned int n = chain.edges.size();
  for (unsigned int c = 0; c < cuts.size(); ++c)
  {
    const unsigned int end = c + 1 < cuts.size() ? cuts[c + 1] : cuts[0] + n;
    EdgeChain piece;
    for (unsigned int k = cuts[c]; k < end && (chain.is_closed() || k < n); ++k)
    {
      piece.edges.push_back(chain.edges[k % n]);
      piece.vertices.push_back(chain.vertices[k % n]);
    }
    piece.vertices.push_back(chain.is_closed() ? chain.vertices[end % n]
                                               : chain.vertices[end < n ? end : n]);
    result.push_back(piece);
  }
  return result;
}

std::vector<Point<2>> points_of(const CoarseMesh &mesh, const EdgeChain &chain)
{
  std::vector<Point<2>> points;
  for (const unsigned int v : chain.vertices)
    points.push_back(mesh.vertices[v]);
  return points;
}

constexpr double fits = 1e-6; ///< as deviation: what files with few digits leave

void bend(CoarseMesh &mesh, const EdgeChain &chain, const CircleFit &fit)
{
  const auto circle = std::make_shared<const Circle>(fit.centre, fit.radius);
  for (const unsigned int e : chain.edges)
  {
    CoarseMesh::Edge &edge = mesh.edges[e];
    const auto angle = [&](const unsigned int end)
    {
      const Tensor<1, 2> arm = mesh.vertices[edge.vertices[end]] - fit.centre;
      return std::atan2(arm[1], arm[0]);
    };
    const double from = angle(0);
    edge.curve = {circle, from, from + std::remainder(angle(1) - from, 2 * numbers::PI)};
  }
}

std::string about(const std::vector<Point<2>> &points)
{
  return "from " + to_string(points.front()) + " to " + to_string(points.back());
}
} // namespace

std::optional<CircleFit> fit_circle(const std::vector<Point<2>> &points)
{
  Point<2> mean;
  for (const Point<2> &x : points)
    mean += x / double(points.size());
  // Normal equations of 2 c.x + d = |x|^2 about the mean, where d = mean |x|^2.
  double size = 0, xx = 0, xy = 0, yy = 0;
  Tensor<1, 2> right;
  for (const Point<2> &point : points)
    size += point.distance_square(mean) / points.size();
  for (const Point<2> &point : points)
  {
    const Tensor<1, 2> x = point - mean;
    xx += x[0] * x[0];
    xy += x[0] * x[1];
    yy += x[1] * x[1];
    right += (x * x - size) / 2 * x;
  }
  const double det = xx * yy - xy * xy;
  if (!(det > 1e-12 * std::pow(xx + yy, 2)))
    return std::nullopt;
  const Tensor<1, 2> c(
      {(yy * right[0] - xy * right[1]) / det, (xx * right[1] - xy * right[0]) / det});
  CircleFit fit{mean + c, std::sqrt(size + c * c), 0};
  for (const Point<2> &x : points)
    fit.deviation = std::max(fit.deviation, std::abs(x.distance(fit.centre) / fit.radius - 1));
  return fit;
}

std::string bend_to_circles(CoarseMesh &mesh, const std::vector<unsigned int> &edges)
{
  for (const EdgeChain &chain : chains_of(mesh, edges))
  {
    const auto whole = fit_circle(points_of(mesh, chain));
    if (whole && whole->deviation <= fits)
    {
      bend(mesh, chain, *whole);
      continue;
    }
    for (const EdgeChain &piece : pieces_of(mesh, chain, 30))
    {
      const std::vector<Point<2>> points = points_of(mesh, piece);
      const auto fit = fit_circle(points);
      if (points.size() < 3)
        return "has " + std::to_string(points.size()) + " vertices " + about(points) +
               ", and a circle needs three";
      if (!fit)
        return "is straight " + about(points);
      if (fit->deviation > fits)
        return "has points up to " + text(fit->deviation, 3) +
               " of the radius away from the circle of best fit " + about(points);
      bend(mesh, piece, *fit);
    }
  }
  return "";
}

std::string bend_to_splines(CoarseMesh &mesh, const std::vector<unsigned int> &edges)
{
  for (const EdgeChain &chain : chains_of(mesh, edges))
    for (const EdgeChain &piece : pieces_of(mesh, chain, 45))
    {
      const std::vector<Point<2>> points = points_of(mesh, piece);
      if (points.size() < 4)
        return "has " + std::to_string(points.size()) + " vertices between corners " +
               about(points) + ", and a spline needs four";
      const auto spline = std::make_shared<const Spline>(points);
      for (unsigned int k = 0; k < piece.edges.size(); ++k)
        mesh.edges[piece.edges[k]].curve = {spline, spline->knots()[k], spline->knots()[k + 1]};
    }
  return "";
}

std::optional<CircleFit> polygon_for_circle(const CoarseMesh &mesh,
                                            const std::vector<unsigned int> &edges)
{
  for (const EdgeChain &chain : chains_of(mesh, edges))
  {
    std::vector<Point<2>> points = points_of(mesh, chain);
    for (const unsigned int e : chain.edges)
      if (mesh.edges[e].curve)
        points.push_back(mesh.edges[e].curve.point(0.5));
    if (points.size() < 5)
      continue;
    bool is_smooth = true;
    for (unsigned int k = 1; k < chain.edges.size(); ++k)
      is_smooth = is_smooth && (mesh.edges[chain.edges[k]].curve || turn_at(mesh, chain, k) < 45);
    auto fit = fit_circle(points);
    if (!is_smooth || !fit || !(fit->deviation <= 1e-10))
      continue;
    for (unsigned int d = 0; d < 2; ++d)
      if (std::abs(fit->centre[d]) <= 1e-12 * fit->radius) // round-off, for words
        fit->centre[d] = 0;
    return fit;
  }
  return std::nullopt;
}

std::string polygon_words(const std::string &boundary, const CircleFit &fit,
                          const bool is_quadratic)
{
  return "boundary " + (boundary.empty() ? "without a name" : boundary) +
         (is_quadratic ? " has edges of second order with their nodes"
                       : " is a polygon with its vertices") +
         " on a circle of radius " + text(fit.radius, 6) + " around " + to_string(fit.centre) +
         (is_quadratic ? ", and the body parabolas with corners between them"
                       : ", and the body a polygon with corners there") +
         (boundary.empty() ? ": give it a name and set its Curve = circle if that is meant"
                           : ": set Boundary " + boundary + "/Curve = circle if that is meant");
}
} // namespace hpvi
