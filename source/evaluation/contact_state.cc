// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/quadrature_lib.h>
#include <hpvi/evaluation/contact_state.h>
#include <hpvi/evaluation/contact_traces.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Slip in one direction next to slip in the other differs; without friction any slip goes on. */
template <int dim>
bool differ(const ContactPoint<dim> &a, const ContactPoint<dim> &b)
{
  return a.slips != b.slips ||
         (a.slips && a.friction_bound != 0. && b.friction_bound != 0. && a.lambda * b.lambda < 0.);
}

/**
 * Where the exact multiplier only just reaches 1, states may alternate from point to point: an odd
 * number of changes within two edges counts as one, in their middle, an even one as none.
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
        if (n_changes > 0 && points[i].x.distance(points[last].x) >
                                 2 * std::max(points[i].face_length, points[last].face_length))
          break;
        sum += 0.5 * (points[i - 1].x + Tensor<1, dim>(points[i].x));
        ++n_changes;
        last = i;
      }
    if (n_changes == 0)
      break;
    if (n_changes % 2 == 1)
      result.push_back(sum / n_changes);
    k = last + 1;
  }
  return result;
}

/** The Gauss points of a face's multiplier, along the tangent. */
template <int dim>
std::vector<ContactPoint<dim>> points_of(const ContactFace<dim> &face,
                                         const Solution<dim> &solution)
{
  const bool has_friction = face.n_multipliers > 0;
  const unsigned int n = std::max(face.n_points, 1U);
  const ContactTraces<dim> traces(face, n, solution);
  std::vector<ContactPoint<dim>> points;
  for (unsigned int q = 0; q < n; ++q)
  {
    const ContactFrame<dim> frame = face.frame(solution.tables.gauss(n).point(q)[0]);
    const Tensor<1, dim> u = traces.displacement(q);
    const double g = has_friction ? face.friction_bound(frame.x) : 0.;
    const double z = has_friction ? solution.z[face.first_multiplier + q] : 0.;
    const double lambda = g == 0. ? 0. : z / g;
    points.push_back({frame.x, face.length, g, lambda,
                      g == 0. || std::abs(lambda) >= 1. - slip_tolerance, frame.normal * u,
                      frame.tangent * u, traces.normal_traction(q), 0. - z}); // never -0
  }
  if (face.frame(0.5).tangent * (face.point(1.) - face.point(0.)) < 0)
    std::reverse(points.begin(), points.end());
  return points;
}

/** T_n is a polynomial of degree p on an affine cell. */
template <int dim>
void add_normal_traction(const ContactFace<dim> &face, const Solution<dim> &solution,
                         ContactState<dim> &state)
{
  const QGauss<1> &gauss = solution.tables.gauss(face.degree + 1);
  const ContactTraces<dim> traces(face, gauss.size(), solution);
  for (unsigned int q = 0; q < gauss.size(); ++q)
  {
    const double weight = gauss.weight(q) * face.frame(gauss.point(q)[0]).measure;
    const double traction = traces.normal_traction(q);
    state.normal_resultant += weight * traction;
    state.tension += weight * std::max(traction, 0.);
    if (traction > state.highest_tension)
    {
      state.highest_tension = traction;
      state.highest_tension_point = face.point(gauss.point(q)[0]);
    }
  }
}

template <int dim>
void add_friction(const ContactFace<dim> &face, const Solution<dim> &solution,
                  ContactState<dim> &state)
{
  for (unsigned int i = 0; i < face.n_multipliers; ++i)
  {
    const double force = solution.contact_space.weights()[face.first_multiplier + i] *
                         solution.z[face.first_multiplier + i];
    state.friction_resultant -= force;
    state.friction_force -=
        force * face.frame(solution.tables.gauss(face.n_points).point(i)[0]).tangent;
  }
}
} // namespace

template <int dim>
std::vector<ContactState<dim>> contact_states(const Solution<dim> &solution)
{
  std::vector<ContactState<dim>> states;
  for (const ContactFace<dim> &face : solution.contact_space.faces())
  {
    if (states.empty() || states.back().boundary != face.condition->id)
      states.emplace_back().boundary = face.condition->id;
    ContactState<dim> &state = states.back();
    state.length += face.length;
    for (const ContactPoint<dim> &point : points_of(face, solution))
      state.points.push_back(point);
    add_normal_traction(face, solution, state);
    add_friction(face, solution, state);
  }
  for (ContactState<dim> &state : states)
    state.transitions = transitions_between(state.points);
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
