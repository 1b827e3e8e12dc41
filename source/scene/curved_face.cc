// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/curved_face.h>
#include <hpvi/scene/face_derivatives.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Of its Bezier points, of which in each direction the middle is twice a node less the mean of its ends: the face is in their hull. */
BoundingBox<3> box_around(const CurvedFace::Nodes &nodes)
{
  CurvedFace::Nodes points = nodes;
  for (const auto &[along, across] : {std::pair(1, 3), {3, 1}})
    for (unsigned int line = 0; line < 3; ++line)
    {
      Point<3> *const p = &points[across * line];
      p[along] = p[along] + ((p[along] - p[0]) + (p[along] - p[2 * along])) / 2.;
    }
  BoundingBox<3> result(std::vector<Point<3>>(points.begin(), points.end()));
  result.extend(1e-9 * nodes[0].distance(nodes[8]));
  return result;
}
} // namespace

CurvedFace::CurvedFace(const Nodes &nodes)
    : shape(std::make_shared<const Shape>(Shape{nodes, box_around(nodes)}))
{
}

const CurvedFace::Nodes &CurvedFace::nodes() const
{
  return shape->nodes;
}

Point<3> CurvedFace::point(const Point<2> &xi) const
{
  return nodes()[0] + FaceDerivatives(nodes(), xi).from_first;
}

Tensor<1, 3> CurvedFace::normal(const Point<2> &xi) const
{
  const Tensor<1, 3> n = FaceDerivatives(nodes(), xi).area_vector();
  return n / n.norm();
}

/** By the method of Gauss and Newton, which for points on it is Newton's. */
Point<2> CurvedFace::nearest(const Point<3> &x) const
{
  Point<2> xi(0.5, 0.5);
  for (unsigned int step = 0; step < 30; ++step)
  {
    const FaceDerivatives here(nodes(), xi);
    const Tensor<1, 3> rest = (x - nodes()[0]) - here.from_first;
    Tensor<2, 2> normal;
    Tensor<1, 2> right;
    for (unsigned int a = 0; a < 2; ++a)
    {
      right[a] = here.along[a] * rest;
      for (unsigned int b = 0; b < 2; ++b)
        normal[a][b] = here.along[a] * here.along[b];
    }
    const Point<2> old = xi;
    const Tensor<1, 2> change = invert(normal) * right;
    for (unsigned int a = 0; a < 2; ++a)
      xi[a] = std::clamp(xi[a] + change[a], 0., 1.);
    if (xi.distance(old) < 1e-9) // Newton's next step would be its square
      break;
  }
  return xi;
}

double CurvedFace::distance(const Point<3> &x) const
{
  return (x - nodes()[0] - FaceDerivatives(nodes(), nearest(x)).from_first).norm();
}

double CurvedFace::area() const
{
  const QGauss<2> rule(8);
  double result = 0;
  for (unsigned int q = 0; q < rule.size(); ++q)
    result += rule.weight(q) * FaceDerivatives(nodes(), rule.point(q)).area_vector().norm();
  return result;
}

Point<3> CurvedFace::mean_point() const
{
  const QGauss<2> rule(8);
  double size = 0;
  Tensor<1, 3> moment;
  for (unsigned int q = 0; q < rule.size(); ++q)
  {
    const FaceDerivatives here(nodes(), rule.point(q));
    const double ds = rule.weight(q) * here.area_vector().norm();
    size += ds;
    moment += ds * here.from_first;
  }
  return nodes()[0] + moment / size;
}

bool CurvedFace::is_plane() const
{
  const Tensor<1, 3> n = normal(Point<2>(0.5, 0.5));
  const double hair = 1e-8 * nodes()[0].distance(nodes()[8]);
  return std::all_of(nodes().begin(), nodes().end(),
                     [&](const Point<3> &a) { return std::abs((a - nodes()[4]) * n) <= hair; });
}

const BoundingBox<3> &CurvedFace::box() const
{
  return shape->box;
}
} // namespace hpvi
