// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/base/tolerances.h>
#include <hpvi/scene/contact_search.h>
#include <hpvi/scene/edge_projection.h>
#include <hpvi/scene/spline.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr unsigned int n_samples = 32; ///< of an edge, and both of its ends
constexpr double
    near =
        0.02, ///< of the size, or the radius: what hangs over at a larger distance touches nobody
    smooth = 1 - 1e-10; ///< cosine between edges that meet: a spline in pieces is smooth to less

/** What the normals of one edge meet. */
struct Projection
{
  unsigned int n_met = 0;
  std::set<unsigned int> edges; ///< of the other side
  double least = std::numeric_limits<double>::max(),
         largest = std::numeric_limits<double>::lowest(), ///< distances
      least_for_sure = least, doubt = 0;
  Point<2> at_least;
  double length = 0;                   ///< of what meets it
  std::array<double, 2> turn{{1, -1}}; ///< least and largest angle between normals of both sides

  /** Of the relative curvature, 1/R = 1/R_1 + 1/R_2, by which distances grow, x^2/2R: contact of half width 0.2 R reaches 0.02 R. */
  double radius() const
  {
    return turn[1] > turn[0] ? length / (turn[1] - turn[0]) : std::numeric_limits<double>::max();
  }

  bool is_whole() const
  {
    return n_met == n_samples + 1;
  }
};

/** A side as a slave. */
struct Candidate
{
  std::vector<Projection> projections;
  std::optional<Point<2>> hangs_over; ///< the middle of an edge that does, near to the other side
  std::optional<Point<2>> corner;     ///< between two of its edges: no normal there

  bool is_whole(const unsigned int edge) const
  {
    return projections[edge].is_whole();
  }

  bool is_empty() const
  {
    return std::none_of(projections.begin(), projections.end(),
                        [](const Projection &projection) { return projection.is_whole(); });
  }

  bool is_fit() const
  {
    return !is_empty() && !hangs_over && !corner;
  }
};

Projection projection_of(const EdgePath &path, const ExactSide &other)
{
  Projection result;
  const double own_doubt = doubt_of(path.curve);
  Point<2> before;
  for (unsigned int k = 0; k <= n_samples; ++k)
  {
    const double s = std::clamp(double(k) / n_samples, same_end, 1 - same_end);
    const Point<2> x = path.point(s);
    const Tensor<1, 2> n = path.normal(s);
    const auto there = other.opposite(x, n);
    if (!there)
      continue;
    const Tensor<1, 2> opposite = other.edges()[there->edge].normal(there->place.s);
    const double angle = std::asin(n[1] * opposite[0] - n[0] * opposite[1]);
    result.turn = {{std::min(result.turn[0], angle), std::max(result.turn[1], angle)}};
    if (result.n_met++ > 0)
      result.length += x.distance(before);
    before = x;
    if (there->place.s > same_end && there->place.s < 1 - same_end) // a vertex belongs to two edges
      result.edges.insert(there->edge);
    if (there->place.distance < result.least)
      result.least = there->place.distance, result.at_least = x;
    const double doubt = own_doubt + doubt_of(other.edges()[there->edge].curve);
    result.doubt = std::max(result.doubt, doubt);
    result.least_for_sure = std::min(result.least_for_sure, there->place.distance + doubt);
    result.largest = std::max(result.largest, there->place.distance);
  }
  return result;
}

Candidate candidate(const ExactSide &own, const ExactSide &other, const double size)
{
  Candidate result;
  const std::vector<EdgePath> &edges = own.edges();
  for (const EdgePath &path : edges)
  {
    result.projections.push_back(projection_of(path, other));
    const Projection &projection = result.projections.back();
    if (projection.n_met > 1 && !projection.is_whole() &&
        projection.least <= near * std::min(size, projection.radius()))
      result.hangs_over = path.point(0.5);
  }
  for (unsigned int a = 0; a < edges.size(); ++a)
    for (unsigned int b = 0; b < edges.size(); ++b)
      if (a != b && result.is_whole(a) && result.is_whole(b) &&
          edges[a].ends[1].distance(edges[b].ends[0]) <= same_place * size &&
          edges[a].normal(1) * edges[b].normal(0) < smooth)
        result.corner = edges[a].ends[1];
  return result;
}

/** Do the normals of the edges that take part meet edges alone that take part on the other side? */
bool meets_its_like(const Candidate &one, const Candidate &other)
{
  return std::all_of(one.projections.begin(), one.projections.end(),
                     [&](const Projection &projection)
                     {
                       return !projection.is_whole() ||
                              std::all_of(projection.edges.begin(), projection.edges.end(),
                                          [&](const unsigned int e) { return other.is_whole(e); });
                     });
}

std::string why_not(const Candidate &one, const Candidate &other, const bool is_asked)
{
  if (one.corner)
    return "have a corner at " + to_string(*one.corner) +
           " where they should be smooth, for it has no normal";
  if (one.hangs_over && is_asked)
    return "have an edge of the slave, at " + to_string(*one.hangs_over) +
           ", that hangs over the end of the other side";
  if (one.hangs_over)
    return "have edges of both sides that hang over the end of the other, at " +
           to_string(*one.hangs_over) +
           (other.hangs_over ? " and " + to_string(*other.hangs_over) : "");
  return "do not face each other: on neither is there an edge whose normals all meet the other "
         "side at 60 degrees or less to its own";
}
} // namespace

bool ProjectedEdges::is_empty() const
{
  return in_pair[0].empty();
}

ProjectedEdges edge_projection(const std::array<ExactSide, 2> &sides,
                               const std::optional<unsigned int> asked, const double size,
                               std::string &problem)
{
  const std::array<Candidate, 2> candidates{
      {candidate(sides[0], sides[1], size), candidate(sides[1], sides[0], size)}};
  ProjectedEdges result;
  const unsigned int slave = asked ? *asked : candidates[0].is_fit() ? 0 : 1;
  const Candidate &chosen = candidates[slave];
  if (!chosen.is_fit())
  {
    const bool first_says_more = !asked && !candidates[0].is_empty();
    const unsigned int teller = first_says_more ? 0 : slave;
    problem = why_not(candidates[teller], candidates[1 - teller], asked.has_value());
    return result;
  }
  const bool is_either = candidates[0].is_fit() && candidates[1].is_fit() &&
                         meets_its_like(candidates[0], candidates[1]) &&
                         meets_its_like(candidates[1], candidates[0]);
  if (asked || !is_either)
    result.slave = slave;
  for (const unsigned int k : {0, 1})
    result.in_pair[k].resize(sides[k].edges().size());
  result.least = result.least_for_sure = std::numeric_limits<double>::max();
  result.largest = std::numeric_limits<double>::lowest();
  for (unsigned int e = 0; e < chosen.projections.size(); ++e)
    if (chosen.is_whole(e))
    {
      result.in_pair[slave][e] = true;
      for (const unsigned int other : chosen.projections[e].edges)
        result.in_pair[1 - slave][other] = true;
      if (chosen.projections[e].least < result.least)
        result.least = chosen.projections[e].least,
        result.at_least = chosen.projections[e].at_least;
      result.least_for_sure = std::min(result.least_for_sure, chosen.projections[e].least_for_sure);
      result.doubt = std::max(result.doubt, chosen.projections[e].doubt);
      result.largest = std::max(result.largest, chosen.projections[e].largest);
    }
    else if (const Projection &projection = chosen.projections[e]; projection.n_met > 1)
    {
      if (result.left_out.number++ == 0 || projection.least < result.left_out.distance)
        result.left_out.distance = projection.least,
        result.left_out.at = sides[slave].edges()[e].point(0.5);
    }
  return result;
}
} // namespace hpvi
