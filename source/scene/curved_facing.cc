// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/curved_facing.h>
#include <hpvi/scene/face_derivatives.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr double least_cosine = 0.1, ///< cosine of the angle between both faces, at least
    on_rim = 1e-6; ///< of the coordinates of a face: round-off, and parabolas beside each other

double beyond_unit(const Point<2> &xi)
{
  return std::max({-xi[0], xi[0] - 1, -xi[1], xi[1] - 1});
}

/** Of a face in the coordinates of another one: its edges, cut where they bend. */
class Shadow
{
public:
  Shadow(const CurvedFace &face, const CurvedFace &on) : face(face), on(on)
  {
  }

  /** Counterclockwise; empty where feet are missing, and of a face that looks the same way. */
  ConvexPolygon polygon()
  {
    constexpr std::array<std::array<double, 2>, 4> corners{
        {{{0., 0.}}, {{1., 0.}}, {{1., 1.}}, {{0., 1.}}}};
    std::array<std::optional<Point<2>>, 4> ends;
    for (unsigned int v = 0; v < 4; ++v)
      ends[v] = foot_of(Point<2>(corners[v][0], corners[v][1]));
    if (std::any_of(ends.begin(), ends.end(), [](const auto &end) { return !end; }))
      return {};
    for (unsigned int v = 0; v < 4; ++v)
    {
      const unsigned int w = (v + 1) % 4;
      result.push_back(*ends[v]);
      add(Point<2>(corners[v][0], corners[v][1]), *ends[v], Point<2>(corners[w][0], corners[w][1]),
          *ends[w], 0);
    }
    if (area_of(result) >= 0)
      return {};
    std::reverse(result.begin(), result.end());
    return result;
  }

private:
  std::optional<Point<2>> foot_of(const Point<2> &xi) const
  {
    return foot(on, face.point(xi));
  }

  /** What lies between both ends of an edge. */
  void add(const Point<2> &a, const Point<2> &foot_a, const Point<2> &b, const Point<2> &foot_b,
           const unsigned int depth)
  {
    constexpr unsigned int most = 6;
    constexpr double bend = 3e-5;
    const Point<2> middle = a + (b - a) / 2.;
    const std::optional<Point<2>> at = foot_of(middle);
    const Tensor<1, 2> way = foot_b - foot_a;
    const double length = way.norm();
    if (!at || depth == most || length == 0 || is_far(foot_a, foot_b))
      return;
    const double off = std::abs(way[0] * (*at - foot_a)[1] - way[1] * (*at - foot_a)[0]) / length;
    if (off <= bend * std::min(1., length))
      return;
    add(a, foot_a, middle, *at, depth + 1);
    result.push_back(*at);
    add(middle, *at, b, foot_b, depth + 1);
  }

  /** Does it lie beside the unit square, whatever it does between its ends? */
  static bool is_far(const Point<2> &a, const Point<2> &b)
  {
    for (unsigned int d = 0; d < 2; ++d)
      if (std::max(a[d], b[d]) < -0.5 || std::min(a[d], b[d]) > 1.5)
        return true;
    return false;
  }

  const CurvedFace &face, &on;
  ConvexPolygon result;
};

std::vector<BoundingBox<3>> boxes_of(const std::vector<CurvedFace> &faces)
{
  std::vector<BoundingBox<3>> result;
  for (const CurvedFace &face : faces)
    result.push_back(face.box());
  return result;
}

bool meet(const BoundingBox<3> &one, const BoundingBox<3> &other, const double margin)
{
  for (unsigned int d = 0; d < 3; ++d)
    if (one.lower_bound(d) > other.upper_bound(d) + margin ||
        other.lower_bound(d) > one.upper_bound(d) + margin)
      return false;
  return true;
}

const std::array<Point<2>, 5> corners_and_middle{
    {Point<2>(0, 0), Point<2>(1, 0), Point<2>(0, 1), Point<2>(1, 1), Point<2>(0.5, 0.5)}};
} // namespace

CurvedFace flat_face(const Side<3>::Piece &p)
{
  const auto between = [](const Point<3> &a, const Point<3> &b) { return a + (b - a) / 2.; };
  const Point<3> low = between(p[0], p[1]), high = between(p[2], p[3]);
  const CurvedFace::Nodes nodes{{p[0], low, p[1], between(p[0], p[2]), between(low, high),
                                 between(p[1], p[3]), p[2], high, p[3]}};
  return CurvedFace(nodes);
}

std::optional<FaceMeeting> meeting(const CurvedFace &face, const Point<3> &x, const Tensor<1, 3> &n,
                                   const double beyond, const Point<2> &start)
{
  constexpr unsigned int most_steps = 30;
  constexpr double far = 4; // where no face is near
  Point<2> xi = start;
  const Tensor<1, 3> from_first = x - face.nodes()[0];
  double h = 0;
  for (unsigned int step = 0; step < most_steps; ++step)
  {
    const FaceDerivatives here(face.nodes(), xi);
    Tensor<2, 3> system;
    for (unsigned int d = 0; d < 3; ++d)
    {
      system[d][0] = here.along[0][d];
      system[d][1] = here.along[1][d];
      system[d][2] = -n[d];
    }
    const double volume = determinant(system);
    if (std::abs(volume) <= 1e-6 * here.along[0].norm() * here.along[1].norm())
      return std::nullopt; // the line is along the face
    const Tensor<1, 3> change = invert(system) * (from_first - here.from_first);
    xi += Tensor<1, 2>({change[0], change[1]});
    h = change[2];
    if (beyond_unit(xi) > far)
      return std::nullopt;
    if (std::abs(change[0]) + std::abs(change[1]) < 1e-13)
      break;
  }
  if (beyond_unit(xi) > beyond)
    return std::nullopt;
  return FaceMeeting{xi, h};
}

std::optional<Point<2>> foot(const CurvedFace &face, const Point<3> &y)
{
  constexpr unsigned int most_steps = 40;
  constexpr double far = 1e3;
  Point<2> xi(0.5, 0.5);
  const Tensor<1, 3> from_first = y - face.nodes()[0];
  for (unsigned int step = 0; step < most_steps; ++step)
  {
    const FaceDerivatives here(face.nodes(), xi);
    const Tensor<1, 3> rest = from_first - here.from_first;
    Tensor<2, 2> gauss, newton;
    Tensor<1, 2> right;
    for (unsigned int a = 0; a < 2; ++a)
    {
      right[a] = here.along[a] * rest;
      for (unsigned int b = 0; b < 2; ++b)
      {
        gauss[a][b] = here.along[a] * here.along[b];
        newton[a][b] = gauss[a][b] - rest * here.second[a + b];
      }
    }
    // Far from the face the method of Gauss and Newton goes there.
    const bool is_near = determinant(newton) > 0.1 * determinant(gauss) && newton[0][0] > 0;
    const Tensor<1, 2> change = invert(is_near ? newton : gauss) * right;
    xi += change;
    if (!(xi.norm() < far))
      return std::nullopt;
    if (change.norm() < 1e-13 * std::max(1., xi.norm()))
      return xi;
  }
  return std::nullopt;
}

CurvedFaces::CurvedFaces(std::vector<CurvedFace> all) : faces(std::move(all)), tree(boxes_of(faces))
{
}

unsigned int CurvedFaces::nearest(const Point<3> &x) const
{
  return tree.nearest(x, [&](const unsigned int f) { return faces[f].distance(x); });
}

std::optional<CurvedFaces::Opposite> CurvedFaces::opposite(const Point<3> &x, const Tensor<1, 3> &n,
                                                           const Counts &counts) const
{
  std::optional<Opposite> result;
  for (const unsigned int f : tree.along(x, n))
  {
    if (!counts(f))
      continue;
    const std::optional<FaceMeeting> at = meeting(faces[f], x, n, on_rim);
    if (at && faces[f].normal(at->xi) * n < -least_cosine &&
        (!result || std::abs(at->distance) < std::abs(result->at.distance)))
      result = {f, *at};
  }
  return result;
}

/** As far away as what the normals of @p own meet, and a little more. */
std::vector<unsigned int> CurvedFaces::candidates(const CurvedFace &own, const Counts &counts) const
{
  constexpr unsigned int n = 4;
  double reach = -1;
  for (unsigned int k = 0; k <= n * (n + 2); ++k)
  {
    const Point<2> xi((k % (n + 1) + 0.01) / (n + 0.02), (k / (n + 1) + 0.01) / (n + 0.02));
    if (const auto at = opposite(own.point(xi), own.normal(xi), counts))
      reach = std::max(reach, std::abs(at->at.distance));
  }
  std::vector<unsigned int> result;
  if (reach < 0)
    return result;
  const double margin = 1.1 * reach + 0.1 * own.nodes()[0].distance(own.nodes()[8]);
  const Tensor<1, 3> normal = own.normal(Point<2>(0.5, 0.5));
  for (unsigned int f = 0; f < faces.size(); ++f)
    if (meet(faces[f].box(), own.box(), margin) && counts(f) &&
        std::any_of(corners_and_middle.begin(), corners_and_middle.end(),
                    [&](const Point<2> &xi) { return faces[f].normal(xi) * normal < 0; }))
      result.push_back(f);
  return result;
}

std::vector<FacesAcross::Part> CurvedFaces::parts(const CurvedFace &own, const Counts &counts) const
{
  const ConvexPolygon unit{Point<2>(0, 0), Point<2>(1, 0), Point<2>(1, 1), Point<2>(0, 1)};
  constexpr double no_part = 1e-12;
  std::vector<FacesAcross::Part> result;
  for (const unsigned int f : candidates(own, counts))
  {
    const ConvexPolygon shadow = Shadow(faces[f], own).polygon();
    if (shadow.empty())
      continue;
    ConvexPolygon part = common_part(shadow, unit);
    if (!part.empty() && area_of(part) > no_part)
      result.push_back({f, std::move(part)});
  }
  return result;
}

namespace
{
/** The least distance on a face, from a point of a grid on, by finer and finer grids around the best point. */
void refine_least(const CurvedFace &face, const CurvedFaces &other, Point<2> best, double width,
                  CurvedFacing::Face &facing)
{
  constexpr unsigned int n_levels = 12;
  for (unsigned int level = 0; level < n_levels; ++level, width /= 2)
  {
    const Point<2> centre = best;
    for (int k = 0; k < 9; ++k)
    {
      const Point<2> xi(std::clamp(centre[0] + (k % 3 - 1) * width / 2, 0., 1.),
                        std::clamp(centre[1] + (k / 3 - 1) * width / 2, 0., 1.));
      if (const auto there = other.opposite(face.point(xi), face.normal(xi));
          there && there->at.distance < facing.least)
      {
        best = xi;
        facing.least = there->at.distance;
        facing.at_least = face.point(xi);
      }
    }
  }
}
} // namespace

CurvedFacing::CurvedFacing(const CurvedFaces &own, const CurvedFaces &other)
    : faces(own.size()), is_seen(other.size(), false)
{
  // Beside the rim, where parabolas that end on one plane may look past each other, and on it, where corners may touch.
  constexpr std::array<double, 7> grid{{0., 0.02, 0.25, 0.5, 0.75, 0.98, 1.}};
  for (unsigned int f = 0; f < own.size(); ++f)
  {
    Face &face = faces[f];
    unsigned int n_inside = 0;
    for (const double a : grid)
      for (const double b : grid)
      {
        const bool is_inside = a > 0 && a < 1 && b > 0 && b < 1;
        n_inside += is_inside;
        const Point<3> x = own[f].point(Point<2>(a, b));
        const auto there = other.opposite(x, own[f].normal(Point<2>(a, b)));
        if (!there)
          continue;
        face.covered += is_inside;
        is_seen[there->face] = true;
        face.largest = std::max(face.largest, there->at.distance);
        if (there->at.distance < face.least)
        {
          face.least = there->at.distance;
          face.at_least = x;
        }
      }
    face.covered /= n_inside;
  }
  const auto nearest = std::min_element(
      faces.begin(), faces.end(), [](const Face &a, const Face &b) { return a.least < b.least; });
  if (any())
  {
    const unsigned int f = nearest - faces.begin();
    refine_least(own[f], other, own[f].nearest(nearest->at_least), 0.25, *nearest);
  }
}

bool CurvedFacing::any() const
{
  return std::any_of(faces.begin(), faces.end(), [](const Face &face) { return face.covered > 0; });
}
} // namespace hpvi
