// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/quadrature_lib.h>
#include <hpvi/evaluation/contact_state.h>
#include <hpvi/evaluation/contact_traces.h>
#include <hpvi/scene/data_scale.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Slip in one direction next to slip in the other differs; without friction any slip goes on. */
template <int dim>
bool differ(const ContactPoint<dim> &a, const ContactPoint<dim> &b)
{
  return a.mode() != b.mode() || (a.mode() == ContactMode::slip && a.friction_bound != 0. &&
                                  b.friction_bound != 0. && a.lambda * b.lambda < 0.);
}

/** Does contact end between the two? */
template <int dim>
bool opens(const ContactPoint<dim> &a, const ContactPoint<dim> &b)
{
  return a.is_open != b.is_open;
}

/**
 * Where the exact multiplier only just reaches 1, stick and slip may alternate from point to point: an
 * odd number of changes within two edges counts as one, in their middle, an even one as none. Each end
 * of contact counts, however small the contact.
 */
template <int dim>
std::vector<Point<dim>> transitions_between(const std::vector<ContactPoint<dim>> &points)
{
  std::vector<Point<dim>> result;
  for (unsigned int k = 1; k < points.size();)
  {
    Point<dim> sum;
    unsigned int n_changes = 0, last = k;
    for (unsigned int i = k; i < points.size(); ++i)
      if (differ(points[i - 1], points[i]))
      {
        if (n_changes > 0 && (opens(points[i - 1], points[i]) ||
                              points[i].x.distance(points[last].x) >
                                  2 * std::max(points[i].face_length, points[last].face_length)))
          break;
        sum += 0.5 * (points[i - 1].x + Tensor<1, dim>(points[i].x));
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
template <int dim>
ContactMode mode_between(const std::vector<ContactPoint<dim>> &points, const Point<dim> &begin,
                         const Point<dim> &end)
{
  std::array<unsigned int, 3> n_points{}; // by mode
  for (const ContactPoint<dim> &point : points)
    if ((point.x - begin) * (end - point.x) > 0)
      ++n_points[static_cast<unsigned int>(point.mode())];
  return static_cast<ContactMode>(std::max_element(n_points.begin(), n_points.end()) -
                                  n_points.begin());
}

/** From end to end of the boundary, cut at its transitions; points and transitions follow the tangent. */
template <int dim>
std::vector<ContactZone<dim>> zones_of(const ContactState<dim> &state, const Point<dim> &begin,
                                       const Point<dim> &end)
{
  std::vector<Point<dim>> cuts = {begin};
  cuts.insert(cuts.end(), state.transitions.begin(), state.transitions.end());
  cuts.push_back(end);
  std::vector<ContactZone<dim>> zones;
  for (unsigned int k = 0; k + 1 < cuts.size(); ++k)
  {
    const ContactMode mode = mode_between(state.points, cuts[k], cuts[k + 1]);
    if (!zones.empty() && zones.back().mode == mode) // slip that turns around is slip
      zones.back().end = cuts[k + 1];
    else
      zones.push_back({mode, cuts[k], cuts[k + 1]});
  }
  return zones;
}

/** Is there no pressure at s in [0,1]: of the unknown there, or of those on both sides of it? */
template <int dim>
bool is_open(const ContactFace<dim> &face, const Vector<double> &z, const double s,
             const double negligible)
{
  if (!face.condition->is_unilateral())
    return false;
  const std::vector<double> &points = face.normal_points;
  const unsigned int after =
      std::lower_bound(points.begin(), points.end(), s - 1e-12) - points.begin();
  const auto presses = [&](const unsigned int k)
  { return k < points.size() && z[face.pressures[k]] > negligible; };
  if (after < points.size() && std::abs(points[after] - s) <= 1e-12)
    return !presses(after);
  return !presses(after) && !(after > 0 && presses(after - 1));
}

/** A pressure that is round-off beside the largest of all, or beside the data, is none. */
template <int dim>
double negligible_pressure(const Solution<dim> &solution, const DataScale &data)
{
  double largest = 0;
  for (const ContactFace<dim> &face : solution.contact_space.faces())
    for (const unsigned int unknown : face.pressures)
      largest = std::max(largest, solution.z[unknown]);
  return std::max(1e-10 * largest, round_off_of_data * data.stress);
}

/** The Gauss points of a face's multiplier, along the tangent. */
template <int dim>
std::vector<ContactPoint<dim>> points_of(const ContactFace<dim> &face,
                                         const Solution<dim> &solution, const double negligible)
{
  const bool has_friction = face.n_multipliers > 0, has_pressure = face.condition->has_pressure();
  const unsigned int n = std::max(face.n_points, 1U);
  const ContactTraces<dim> traces(face, n, solution);
  std::vector<ContactPoint<dim>> points;
  for (unsigned int q = 0; q < n; ++q)
  {
    const double s = solution.tables.gauss(n).point(q)[0];
    const ContactFrame<dim> frame = face.frame(s);
    const Tensor<1, dim> u = traces.displacement(q);
    const double g =
        has_friction ? solution.contact_space.bound(face.first_multiplier + q, solution.z) : 0.;
    const double z = has_friction ? solution.z[face.first_multiplier + q] : 0.;
    const double lambda = g == 0. ? 0. : z / g;
    points.push_back(
        {frame.x, face.length, g, lambda, g == 0. || std::abs(lambda) >= 1. - slip_tolerance,
         is_open(face, solution.z, s, negligible),
         face.condition->gap_at(frame.x) - frame.normal * u, frame.normal * u, frame.tangent * u,
         has_pressure ? 0. - solution.contact_space.pressure(face, solution.z, s)
                      : traces.normal_traction(q),
         0. - z, // never -0
         frame.tangent * u - face.past_slip(frame.x)});
  }
  if (face.frame(0.5).tangent * (face.point(1.) - face.point(0.)) < 0)
    std::reverse(points.begin(), points.end());
  return points;
}

/** Resultant and largest values of T_n and u_n - u_0, as far as they exceed the round-off of @p data. */
template <int dim>
void add_normal_traction(const ContactFace<dim> &face, const Solution<dim> &solution,
                         const DataScale &data, ContactState<dim> &state)
{
  const QGauss<1> &gauss = solution.tables.gauss(face.degree + 1);
  const bool has_pressure = face.condition->has_pressure();
  const ContactTraces<dim> traces(face, gauss.size(), solution);
  const std::vector<PressurePoint<dim>> pressures = pressure_points(face, solution);
  for (unsigned int q = 0; q < gauss.size(); ++q)
  {
    const double s = gauss.point(q)[0];
    const ContactFrame<dim> frame = face.frame(s);
    const double traction = -pressures[q].pressure;
    state.normal_resultant += gauss.weight(q) * frame.measure * traction;
    state.tension += gauss.weight(q) * frame.measure * std::max(traction, 0.);
    if (traction > std::max(state.highest_tension, round_off_of_data * data.stress))
    {
      state.highest_tension = traction;
      state.highest_tension_point = frame.x;
    }
    const double u_n = frame.normal * traces.displacement(q),
                 depth = face.condition->is_unilateral() ? u_n - face.condition->gap_at(frame.x)
                         : has_pressure                  ? std::abs(u_n)
                                                         : 0.;
    if (depth > std::max(state.deepest_penetration, round_off_of_data * data.displacement))
    {
      state.deepest_penetration = depth;
      state.deepest_penetration_point = frame.x;
    }
  }
  for (const PressurePoint<dim> &point : pressures)
    if (point.pressure > std::max(state.highest_pressure, round_off_of_data * data.stress))
    {
      state.highest_pressure = point.pressure;
      state.highest_pressure_point = point.x;
    }
}

template <int dim>
void add_friction(const ContactFace<dim> &face, const Solution<dim> &solution,
                  const double negligible, ContactState<dim> &state)
{
  for (unsigned int i = 0; i < face.n_multipliers; ++i)
  {
    const double s = solution.tables.gauss(face.n_multipliers).point(i)[0];
    const unsigned int unknown = face.first_multiplier + i;
    const ContactMultiplier<dim> &multiplier = solution.contact_space.multipliers()[unknown];
    const double force = multiplier.weight * solution.z[unknown];
    state.friction_resultant -= force;
    state.friction_force -= force * multiplier.direction;
    state.absolute_friction += std::abs(force);
    if (is_open(face, solution.z, s, negligible))
      state.open_friction += std::abs(force);
  }
}

/** The ends of a face, along the tangent. */
template <int dim>
std::pair<Point<dim>, Point<dim>> ends_of(const ContactFace<dim> &face)
{
  std::pair<Point<dim>, Point<dim>> ends(face.point(0.), face.point(1.));
  if (face.frame(0.5).tangent * (ends.second - ends.first) < 0)
    std::swap(ends.first, ends.second);
  return ends;
}
} // namespace

std::string mode_name(const ContactMode mode)
{
  switch (mode)
  {
  case ContactMode::open:
    return "open";
  case ContactMode::slip:
    return "slip";
  default:
    return "stick";
  }
}

template <int dim>
std::vector<ContactState<dim>> contact_states(const Solution<dim> &solution)
{
  const DataScale data = data_scale(solution.scene);
  const double negligible = negligible_pressure(solution, data);
  std::vector<ContactState<dim>> states;
  std::vector<std::pair<Point<dim>, Point<dim>>> ends;
  for (const ContactFace<dim> &face : solution.contact_space.faces())
  {
    const auto [begin, end] = ends_of(face);
    if (states.empty() || states.back().boundary != face.condition->id)
    {
      states.emplace_back().boundary = face.condition->id;
      ends.emplace_back(begin, end);
    }
    ends.back().second = end;
    ContactState<dim> &state = states.back();
    state.length += face.length;
    for (const ContactPoint<dim> &point : points_of(face, solution, negligible))
      state.points.push_back(point);
    add_normal_traction(face, solution, data, state);
    add_friction(face, solution, negligible, state);
  }
  for (unsigned int k = 0; k < states.size(); ++k)
  {
    states[k].transitions = transitions_between(states[k].points);
    states[k].zones = zones_of(states[k], ends[k].first, ends[k].second);
  }
  return states;
}

template <int dim>
std::vector<Point<dim>> transitions(const std::vector<ContactState<dim>> &states)
{
  std::vector<Point<dim>> result;
  for (const ContactState<dim> &state : states)
    result.insert(result.end(), state.transitions.begin(), state.transitions.end());
  return result;
}

template std::vector<ContactState<2>> contact_states(const Solution<2> &);
template std::vector<Point<2>> transitions(const std::vector<ContactState<2>> &);
} // namespace hpvi
