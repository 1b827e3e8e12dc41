// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/quadrature_lib.h>
#include <hpvi/evaluation/contact_state.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** How near to 1 |lambda| counts as slip: the QP puts what slips on the wall up to round-off. */
constexpr double slip_tolerance = 1e-8;

/** A Gauss point and the length of its edge. */
template <int dim>
struct PlacedPoint
{
  ContactPoint<dim> point;
  double size;
};

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
void add_transitions(const std::vector<PlacedPoint<dim>> &points, std::vector<Point<dim>> &result)
{
  for (unsigned int k = 1; k < points.size();)
  {
    Point<dim> sum;
    unsigned int n_changes = 0, last = k;
    for (unsigned int i = k; i < points.size(); ++i)
      if (differ(points[i - 1].point, points[i].point))
      {
        if (n_changes > 0 && points[i].point.x.distance(points[last].point.x) >
                                 2 * std::max(points[i].size, points[last].size))
          break;
        sum += 0.5 * (points[i - 1].point.x + Tensor<1, dim>(points[i].point.x));
        ++n_changes;
        last = i;
      }
    if (n_changes == 0)
      break;
    if (n_changes % 2 == 1)
      result.push_back(sum / n_changes);
    k = last + 1;
  }
}
} // namespace

template <int dim>
std::vector<ContactPoint<dim>> contact_points(const ContactFace<dim> &face,
                                              const Solution<dim> &solution)
{
  const bool has_friction = face.n_multipliers > 0;
  const QGauss<1> gauss(std::max(face.n_points, 1U));
  std::vector<ContactPoint<dim>> points;
  for (unsigned int q = 0; q < gauss.size(); ++q)
  {
    const Point<dim> x = face.point(gauss.point(q)[0]);
    const double g = has_friction ? face.friction_bound(x) : 0.;
    const double z = has_friction ? solution.z[face.first_multiplier + q] : 0.;
    const double lambda = g == 0. ? 0. : z / g;
    points.push_back({q, x, g, lambda, g == 0. || std::abs(lambda) >= 1. - slip_tolerance});
  }
  if (face.frame(0.5).tangent * (face.point(1.) - face.point(0.)) < 0)
    std::reverse(points.begin(), points.end());
  return points;
}

template <int dim>
std::vector<Point<dim>> transitions(const Solution<dim> &solution)
{
  const std::vector<ContactFace<dim>> &faces = solution.contact_space.faces();
  std::vector<Point<dim>> result;
  std::vector<PlacedPoint<dim>> points; // of one boundary
  for (auto face = faces.begin(); face != faces.end(); ++face)
  {
    for (const ContactPoint<dim> &point : contact_points(*face, solution))
      points.push_back({point, face->length});
    const auto next = std::next(face);
    if (next == faces.end() || next->condition->id != face->condition->id)
    {
      add_transitions(points, result);
      points.clear();
    }
  }
  return result;
}

template std::vector<ContactPoint<2>> contact_points(const ContactFace<2> &, const Solution<2> &);
template std::vector<Point<2>> transitions(const Solution<2> &);
} // namespace hpvi
