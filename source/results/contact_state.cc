// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/mpi.h>
#include <hpvi/base/processes.h>
#include <hpvi/results/contact_state.h>
#include <hpvi/results/contact_traces.h>
#include <hpvi/results/contact_zones.h>
#include <hpvi/scene/boundary_parts.h>
#include <hpvi/scene/contact_axes.h>
#include <hpvi/scene/data_scale.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
/** A pressure that is round-off beside the largest of all, or beside the data, is none. */
template <int dim>
double negligible_pressure(const Field<dim> &field, const DataScale &data)
{
  double largest = 0;
  for (const FieldFace<dim> &face : field.faces())
    for (const PressureValue<dim> &unknown : field.pressures(face))
      largest = std::max(largest, unknown.pressure);
  return std::max(1e-10 * Utilities::MPI::max(largest, field.communicator()),
                  round_off_of_data * data.stress);
}

/** Do the coordinates of a face in the plane run against the tangent? */
bool runs_backwards(const FieldFace<2> &face)
{
  const auto at = [&](const double s) { return point_on_face<2>(face.face_no, Point<1>(s)); };
  return face.frame(at(0.5)).tangents[0] * (face.map.point(at(1.)) - face.map.point(at(0.))) < 0;
}

/** The larger principal stress along the surface with @p normal. */
template <int dim>
double surface_stress(const SymmetricTensor<2, dim> &sigma, const Tensor<1, dim> &normal)
{
  if constexpr (dim == 2)
  {
    const Tensor<1, 2> t = cross_product_2d(normal);
    return t * (sigma * t);
  }
  else
  {
    const ContactAxes<dim> axes = contact_axes(normal);
    const double a = axes.tangents[0] * (sigma * axes.tangents[0]),
                 b = axes.tangents[1] * (sigma * axes.tangents[1]),
                 c = axes.tangents[0] * (sigma * axes.tangents[1]);
    return (a + b) / 2 + std::hypot((a - b) / 2, c);
  }
}

/** What happens on the faces of this process. */
template <int dim>
class OwnContact
{
public:
  OwnContact(const Field<dim> &field, const DataScale &data)
      : field(field), data(data), negligible(negligible_pressure(field, data))
  {
  }

  std::vector<ContactState<dim>> states() const;

private:
  void add_points(const FieldFace<dim> &face, ContactState<dim> &state) const;
  void add_normal_traction(const FieldFace<dim> &face, ContactState<dim> &state) const;

  const Field<dim> &field;
  const DataScale data;
  const double negligible;
};

/** The points of the face's multipliers, and the friction that they carry. */
template <int dim>
void OwnContact<dim>::add_points(const FieldFace<dim> &face, ContactState<dim> &state) const
{
  const ContactTraces<dim> traces(face, field.multiplier_table(face), field);
  const std::vector<MultiplierPoint<dim>> multipliers = field.multiplier_points(face, negligible);
  const double area = face.area();
  std::vector<ContactPoint<dim>> points;
  for (unsigned int q = 0; q < multipliers.size(); ++q)
  {
    const MultiplierPoint<dim> &multiplier = multipliers[q];
    const FaceFrame<dim> frame = face.frame(multiplier.reference);
    const Tensor<1, dim> u = traces.displacement(q),
                         u_opposite = field.opposite(face, multiplier.reference),
                         jump = u - u_opposite;
    // Jumps and tractions are the same from either side; the displacement is that of the first.
    const bool is_first = state.boundary == face.condition->id;
    const double g = multiplier.bound, way = dim == 3 && !is_first ? -1 : 1; // a vector has no side
    const Tangential<dim> z = way * frame.tangential(multiplier.traction.friction);
    ContactPoint<dim> point;
    point.x = frame.x;
    point.area = multiplier.area;
    point.face_length = dim == 2 ? area : std::sqrt(area);
    point.friction_bound = g;
    point.lambda = g == 0. ? Tangential<dim>() : Tangential<dim>(z / g);
    point.slips =
        !face.condition->is_tied() && (g == 0. || size_of(point.lambda) >= 1. - slip_tolerance);
    point.is_open = multiplier.is_open;
    point.gap = face.condition->gap_at(frame.x) - frame.normal * jump;
    point.normal_displacement = frame.normal * (is_first ? u : -u_opposite);
    point.tangential_displacement = way * frame.tangential(is_first ? u : -u_opposite);
    point.normal_jump = frame.normal * jump;
    point.tangential_jump = way * frame.tangential(jump);
    point.normal_traction = face.condition->has_pressure() ? 0. - multiplier.traction.pressure
                                                           : traces.normal_traction(q);
    point.tangential_traction = Tangential<dim>() - z; // never -0
    point.slip = point.tangential_jump - way * field.past_slip(face, frame.x);
    point.surface_stress =
        surface_stress<dim>(traces.sigma(q), face.map.normal(face.face_no, multiplier.reference));
    points.push_back(point);

    const Tangential<dim> force = multiplier.area * z;
    state.friction_resultant -= force;
    for (unsigned int s = 0; s < dim - 1; ++s)
      state.friction_force -= (is_first ? 1 : -1) * multiplier.area *
                              multiplier.traction.friction[s] * frame.tangents[s];
    state.absolute_friction += size_of(force);
    state.open_friction += point.is_open ? size_of(force) : 0.;
    state.open_area += point.mode() == ContactMode::open ? point.area : 0.;
    state.slipping_area += point.mode() == ContactMode::slip ? point.area : 0.;
  }
  if constexpr (dim == 2)
    if (runs_backwards(face))
      std::reverse(points.begin(), points.end());
  state.points.insert(state.points.end(), points.begin(), points.end());
}

/** Takes the place of @p largest where it is larger and no round-off. */
template <int dim>
void compare(const double value, const Point<dim> &x, const double round_off, double &largest,
             Point<dim> &where)
{
  if (value > std::max(largest, round_off))
  {
    largest = value;
    where = x;
  }
}

/** Resultant and largest values of T_n and u_n - u_0, as far as they exceed the round-off of the data. */
template <int dim>
void OwnContact<dim>::add_normal_traction(const FieldFace<dim> &face,
                                          ContactState<dim> &state) const
{
  const ShapeTable<dim> &table = field.tables.face(face.degree(), face.face_no, face.degree() + 1);
  const ContactTraces<dim> traces(face, table, field);
  const std::vector<PressurePoint<dim>> pressures = pressure_points(face, field);
  const double no_stress = round_off_of_data * data.stress;
  for (unsigned int q = 0; q < table.points.size(); ++q)
  {
    const FaceFrame<dim> frame = face.frame(table.points[q]);
    const double traction = -pressures[q].pressure;
    state.normal_resultant += table.weights[q] * frame.measure * traction;
    state.tension += table.weights[q] * frame.measure * std::max(traction, 0.);
    compare(traction, frame.x, no_stress, state.highest_tension, state.highest_tension_point);
    const double u_n = frame.normal *
                       (traces.displacement(q) - field.opposite(face, table.points[q])),
                 depth = face.condition->is_unilateral()  ? u_n - face.condition->gap_at(frame.x)
                         : face.condition->has_pressure() ? std::abs(u_n)
                                                          : 0.;
    compare(depth, frame.x, round_off_of_data * data.displacement, state.deepest_penetration,
            state.deepest_penetration_point);
  }
  for (const PressurePoint<dim> &point : pressures)
    compare(point.pressure, point.x, no_stress, state.highest_pressure,
            state.highest_pressure_point);
}

/** The same in the order in which it is met along the other side. */
template <int dim>
void turn_round(ContactState<dim> &state)
{
  std::reverse(state.points.begin(), state.points.end());
  std::swap(state.begin, state.end);
  std::reverse(state.chains.begin(), state.chains.end());
  for (ContactChain<dim> &chain : state.chains)
  {
    const unsigned int n_points = state.points.size(), last = n_points - chain.first_point;
    chain = {chain.end, chain.begin, n_points - chain.last_point, last};
  }
}

/** One for each boundary that this process has faces of. */
template <int dim>
std::vector<ContactState<dim>> OwnContact<dim>::states() const
{
  std::vector<ContactState<dim>> states;
  for (const FieldFace<dim> &face : field.faces())
  {
    const bool is_new = states.empty() || states.back().slave != face.condition->id;
    if (is_new)
    {
      states.emplace_back().slave = face.condition->id;
      states.back().boundary = face.condition->pair
                                   ? field.scene.pairs[*face.condition->pair].parts[0]
                                   : face.condition->id;
    }
    ContactState<dim> &state = states.back();
    if constexpr (dim == 2)
    {
      const bool backwards = runs_backwards(face);
      const auto end = [&](const double s)
      { return face.map.point(point_on_face<2>(face.face_no, Point<1>(s))); };
      const Point<dim> begin = end(backwards ? 1. : 0.);
      if (is_new)
        state.begin = begin;
      state.end = end(backwards ? 0. : 1.);
      const unsigned int n_points = state.points.size();
      if (is_new || state.chains.back().end.distance(begin) > 1e-6 * face.area())
        state.chains.push_back({begin, state.end, n_points, n_points});
      state.chains.back().end = state.end;
    }
    Point<dim - 1> middle;
    for (unsigned int s = 0; s < dim - 1; ++s)
      middle[s] = 0.5;
    state.area += face.area() * field.scene.circumference(
                                    face.map.point(point_on_face<dim>(face.face_no, middle)));
    add_points(face, state);
    if (dim == 2)
      state.chains.back().last_point = state.points.size();
    add_normal_traction(face, state);
  }
  for (ContactState<dim> &state : states)
    if (state.slave != state.boundary)
      turn_round(state);
  return states;
}

/** Along the contact of @p state, whose boundary is straight. */
bool is_before(const Point<2> &a, const Point<2> &b, const ContactState<2> &state)
{
  return (b - a) * (state.end - state.begin) > 0;
}

bool is_before(const Point<3> &a, const Point<3> &b, const ContactState<3> &)
{
  return std::lexicographical_compare(a.begin_raw(), a.end_raw(), b.begin_raw(), b.end_raw());
}

/** Adds what another process knows of the same boundary. */
template <int dim>
void add(const ContactState<dim> &other, ContactState<dim> &state)
{
  if (is_before(other.begin, state.begin, state))
    state.begin = other.begin;
  if (is_before(state.end, other.end, state))
    state.end = other.end;
  for (const auto sum :
       {&ContactState<dim>::area, &ContactState<dim>::open_area, &ContactState<dim>::slipping_area,
        &ContactState<dim>::normal_resultant, &ContactState<dim>::absolute_friction,
        &ContactState<dim>::open_friction, &ContactState<dim>::tension})
    state.*sum += other.*sum;
  state.friction_resultant += other.friction_resultant;
  state.friction_force += other.friction_force;
  compare(other.highest_tension, other.highest_tension_point, 0., state.highest_tension,
          state.highest_tension_point);
  compare(other.highest_pressure, other.highest_pressure_point, 0., state.highest_pressure,
          state.highest_pressure_point);
  compare(other.deepest_penetration, other.deepest_penetration_point, 0., state.deepest_penetration,
          state.deepest_penetration_point);
  state.points.insert(state.points.end(), other.points.begin(), other.points.end());
}

/** Those of all processes as one, by boundary; points are known to the first process alone. */
template <int dim>
std::vector<ContactState<dim>> gathered(std::vector<ContactState<dim>> own, MPI_Comm communicator)
{
  std::vector<std::vector<ContactPoint<dim>>> points;
  for (ContactState<dim> &state : own)
    points.push_back(std::exchange(state.points, {}));
  const auto all = Utilities::MPI::all_gather(communicator, own);
  const auto all_points = n_processes(communicator) == 1
                              ? std::vector<std::vector<std::vector<ContactPoint<dim>>>>{points}
                              : Utilities::MPI::gather(communicator, points);
  std::map<types::boundary_id, ContactState<dim>> by_boundary;
  for (unsigned int rank = 0; rank < all.size(); ++rank)
    for (unsigned int k = 0; k < all[rank].size(); ++k)
    {
      ContactState<dim> state = all[rank][k];
      if (!all_points.empty())
        state.points = all_points[rank][k];
      const auto [known, is_new] = by_boundary.emplace(state.boundary, state);
      if (!is_new)
        add(state, known->second);
    }
  std::vector<ContactState<dim>> states;
  for (auto &[boundary, state] : by_boundary)
  {
    if (dim == 3 || all.size() > 1)
      std::sort(state.points.begin(), state.points.end(),
                [&state = state](const ContactPoint<dim> &a, const ContactPoint<dim> &b)
                { return is_before(a.x, b.x, state); });
    states.push_back(std::move(state));
  }
  return states;
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
std::vector<ContactState<dim>> contact_states(const Field<dim> &field)
{
  DataScale data;
  collectively(field.communicator(), [&]() { data = data_scale(field.scene); });
  const OwnContact<dim> contact(field, data);
  std::vector<ContactState<dim>> own;
  collectively(field.communicator(), [&]() { own = contact.states(); });
  std::vector<ContactState<dim>> states = gathered(std::move(own), field.communicator());
  if constexpr (dim == 2)
  {
    std::vector<Side<2>> sides;
    collectively(field.communicator(), [&]() { sides = sides_of(field.scene); });
    for (ContactState<2> &state : states)
      find_zones(field.scene, sides[state.boundary], state);
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

template std::vector<ContactState<2>> contact_states(const Field<2> &);
template std::vector<ContactState<3>> contact_states(const Field<3> &);
template std::vector<Point<2>> transitions(const std::vector<ContactState<2>> &);
template std::vector<Point<3>> transitions(const std::vector<ContactState<3>> &);
} // namespace hpvi
