// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/results/contact_zones.h>

#include <algorithm>
#include <array>
#include <vector>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Slip in one direction next to slip in the other differs; without friction any slip goes on. */
bool differ(const ContactPoint<2> &a, const ContactPoint<2> &b)
{
  return a.mode() != b.mode() || (a.mode() == ContactMode::slip && a.friction_bound != 0. &&
                                  b.friction_bound != 0. && a.lambda * b.lambda < 0.);
}

/** Does contact end between the two? */
bool opens(const ContactPoint<2> &a, const ContactPoint<2> &b)
{
  return a.is_open != b.is_open;
}

/**
 * Where the exact multiplier only just reaches 1, stick and slip may alternate from point to point: an
 * odd number of changes within two edges counts as one, in their middle, an even one as none. Each end
 * of contact counts, however small the contact.
 */
std::vector<Point<2>> transitions_between(const std::vector<ContactPoint<2>> &points)
{
  std::vector<Point<2>> result;
  for (unsigned int k = 1; k < points.size();)
  {
    Point<2> sum;
    unsigned int n_changes = 0, last = k;
    for (unsigned int i = k; i < points.size(); ++i)
      if (differ(points[i - 1], points[i]))
      {
        if (n_changes > 0 &&
            (opens(points[i - 1], points[i]) ||
             points[i].x.distance(points[last].x) >
                 (2 + 1e-6) * std::max(points[i].face_length, points[last].face_length)))
          break;
        sum += 0.5 * (points[i - 1].x + Tensor<1, 2>(points[i].x));
        ++n_changes;
        last = i;
        if (opens(points[i - 1], points[i]))
          break;
      }
    if (n_changes == 0)
      break;
    if (n_changes % 2 == 1)
      result.push_back(sum / n_changes);
    k = last + 1;
  }
  return result;
}

/** What most points between two places do, for those near a cut may still alternate: of equally many the first mode. */
ContactMode mode_between(const std::vector<ContactPoint<2>> &points, const Point<2> &begin,
                         const Point<2> &end)
{
  std::array<unsigned int, 3> n_points{}; // by mode
  for (const ContactPoint<2> &point : points)
    if ((point.x - begin) * (end - point.x) > 0)
      ++n_points[static_cast<unsigned int>(point.mode())];
  return static_cast<ContactMode>(std::max_element(n_points.begin(), n_points.end()) -
                                  n_points.begin());
}

/** From end to end of a piece of the boundary, cut at its transitions; points and transitions follow the tangent. */
std::vector<ContactZone<2>> zones_of(const std::array<Point<2>, 2> &piece,
                                     const std::vector<ContactPoint<2>> &points,
                                     const std::vector<Point<2>> &transitions)
{
  std::vector<Point<2>> cuts = {piece[0]};
  cuts.insert(cuts.end(), transitions.begin(), transitions.end());
  cuts.push_back(piece[1]);
  std::vector<ContactZone<2>> zones;
  for (unsigned int k = 0; k + 1 < cuts.size(); ++k)
  {
    const ContactMode mode = mode_between(points, cuts[k], cuts[k + 1]);
    if (!zones.empty() && zones.back().mode == mode) // slip that turns around is slip
      zones.back().end = cuts[k + 1];
    else
      zones.push_back({mode, cuts[k], cuts[k + 1], 0.});
  }
  for (ContactZone<2> &zone : zones)
    zone.length = zone.begin.distance(zone.end);
  return zones;
}

/** Likewise along a chain of edges, where what lies between is counted and not measured. */
void find_zones_along(const ContactChain<2> &chain, const Scene<2> &scene, ContactState<2> &state)
{
  const std::vector<ContactPoint<2>> points(state.points.begin() + chain.first_point,
                                            state.points.begin() + chain.last_point);
  const std::vector<Point<2>> transitions = transitions_between(points);
  std::vector<std::size_t> cuts{0};
  for (const Point<2> &transition : transitions)
  {
    // The point behind the transition is the second of the two that are nearest to it in a row.
    std::size_t behind = cuts.back() + 1;
    const auto way = [&](const std::size_t k)
    { return points[k - 1].x.distance(transition) + points[k].x.distance(transition); };
    for (std::size_t k = behind; k < points.size(); ++k)
      if (way(k) < way(behind))
        behind = k;
    cuts.push_back(std::min(behind, points.size()));
  }
  cuts.push_back(points.size());
  const std::size_t first_zone = state.zones.size();
  for (unsigned int k = 0; k + 1 < cuts.size(); ++k)
  {
    std::array<unsigned int, 3> n_points{};
    double length = 0;
    for (std::size_t i = cuts[k]; i < cuts[k + 1]; ++i)
    {
      ++n_points[static_cast<unsigned int>(points[i].mode())];
      length += points[i].area / scene.circumference(points[i].x);
    }
    const auto mode = static_cast<ContactMode>(std::max_element(n_points.begin(), n_points.end()) -
                                               n_points.begin());
    const Point<2> begin = k == 0 ? chain.begin : transitions[k - 1],
                   end = k < transitions.size() ? transitions[k] : chain.end;
    if (state.zones.size() > first_zone && state.zones.back().mode == mode)
    {
      state.zones.back().end = end;
      state.zones.back().length += length;
    }
    else
      state.zones.push_back({mode, begin, end, length});
  }
  state.transitions.insert(state.transitions.end(), transitions.begin(), transitions.end());
}

/** What contact that has ended in one piece does in the next is another zone. */
void find_zones_on_line(std::vector<std::array<Point<2>, 2>> pieces, ContactState<2> &state)
{
  const Tensor<1, 2> along = state.end - state.begin;
  for (auto &piece : pieces)
    if ((piece[1] - piece[0]) * along < 0)
      std::swap(piece[0], piece[1]);
  std::sort(pieces.begin(), pieces.end(),
            [&](const auto &a, const auto &b) { return (b[0] - a[0]) * along > 0; });
  for (const auto &piece : pieces)
  {
    std::vector<ContactPoint<2>> points;
    for (const ContactPoint<2> &point : state.points)
      if ((point.x - piece[0]) * (piece[1] - point.x) > 0)
        points.push_back(point);
    const std::vector<Point<2>> transitions = transitions_between(points);
    const std::vector<ContactZone<2>> zones = zones_of(piece, points, transitions);
    state.transitions.insert(state.transitions.end(), transitions.begin(), transitions.end());
    state.zones.insert(state.zones.end(), zones.begin(), zones.end());
  }
}
} // namespace

void find_zones(const Scene<2> &scene, const Side<2> &side, ContactState<2> &state)
{
  if (state.points.empty())
    return;
  if (scene.geometry.has_mesh())
    for (const ContactChain<2> &chain : state.chains)
      find_zones_along(chain, scene, state);
  else
    find_zones_on_line(scene.has_parts() ? side.pieces
                                         : std::vector<Side<2>::Piece>{{{state.begin, state.end}}},
                       state);
}
} // namespace hpvi
