// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/plane/contact_space.h>

#include <algorithm>
#include <vector>

namespace hpvi
{
using namespace dealii;

template <int dim>
ContactFrame<dim> ContactFace<dim>::frame(const double s) const
{
  ContactFrame<dim> result = contact_frame<dim>(map, face_no, Point<dim - 1>(s));
  result.normal = condition->held_direction(result.normal);
  result.tangent = -cross_product_2d(result.normal);
  if (is_axisymmetric)
    result.measure *= full_turn(result.x);
  return result;
}

template <int dim>
ContactFrame<dim> ContactFace<dim>::node_frame(const double s) const
{
  ContactFrame<dim> result = frame(s);
  if (map.is_curved())
  {
    result.normal = condition->held_direction(
        map.curve_normal(face_no, point_on_face<dim>(face_no, Point<dim - 1>(s))));
    result.tangent = -cross_product_2d(result.normal);
  }
  return result;
}

template <int dim>
Point<dim> ContactFace<dim>::point(const double s) const
{
  return map.point(point_on_face<dim>(face_no, Point<dim - 1>(s)));
}

/** Along a curve ds varies, and a finer rule takes it as rows of B do. */
template <int dim>
double ContactFace<dim>::basis_integral(const QGauss<1> &points, const unsigned int i) const
{
  if (!map.is_curved())
    return points.weight(i) * frame(points.point(i)[0]).measure;
  std::vector<double> nodes;
  for (const Point<1> &point : points.get_points())
    nodes.push_back(point[0]);
  const QGauss<1> gauss(std::max(degree, n_points) + 1);
  double result = 0;
  for (unsigned int q = 0; q < gauss.size(); ++q)
    result += gauss.weight(q) * frame(gauss.point(q)[0]).measure *
              lagrange_basis(nodes, gauss.point(q)[0])[i];
  return result;
}

template <int dim>
const ContactSegment<dim> &ContactFace<dim>::segment(const double s) const
{
  const auto last = std::find_if(segments.begin(), segments.end() - 1,
                                 [s](const ContactSegment<dim> &one) { return s <= one.end; });
  return *last;
}

template <int dim>
double ContactFace<dim>::limit_at(const double s) const
{
  return limit ? limit(s) : friction_bound(point(s));
}

template <int dim>
double ContactFace<dim>::friction_bound(const Point<dim> &x) const
{
  return condition->friction.bound_at(x);
}

template <int dim>
double ContactFace<dim>::friction_coefficient(const Point<dim> &x) const
{
  return condition->friction.coefficient_at(x);
}

template <int dim>
double ContactFace<dim>::friction_without_pressure() const
{
  double sum = 0;
  for (const PointLimit &point : limits)
    sum += point.weight * point.friction.limit(0.);
  return length * sum;
}

template <int dim>
double ContactFace<dim>::past_slip(const Point<dim> &x) const
{
  return past ? past->value(x) : 0.;
}

std::vector<double> lagrange_basis(const std::vector<double> &points, const double s)
{
  std::vector<double> values(points.size(), 1.);
  for (unsigned int i = 0; i < values.size(); ++i)
    for (unsigned int k = 0; k < values.size(); ++k)
      if (k != i)
        values[i] *= (s - points[k]) / (points[i] - points[k]);
  return values;
}

template struct ContactFace<2>;
} // namespace hpvi
