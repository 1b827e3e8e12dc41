// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/boundary_parts.h>
#include <hpvi/scene/plate_motion.h>

#include <algorithm>
#include <cmath>

#include <deal.II/base/quadrature_lib.h>

namespace hpvi
{
using namespace dealii;

namespace
{
/** `int x ds` and `int ds` over a boundary. */
template <int dim>
struct SizeAndMoment
{
  Tensor<1, dim> moment;
  double size = 0;

  void add(const double own, const Tensor<1, dim> &x)
  {
    moment += own * x;
    size += own;
  }
};

SizeAndMoment<2> integrals(const Side<2> &side)
{
  SizeAndMoment<2> result;
  const QGauss<1> gauss(16);
  for (unsigned int k = 0; k < side.pieces.size(); ++k)
    if (const CurvePiece curve = side.curve(k))
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const double s = gauss.point(q)[0];
        result.add(gauss.weight(q) * curve.derivative(s).norm(), curve.point(s));
      }
    else
      result.add(side.pieces[k][0].distance(side.pieces[k][1]), centre_of<2>(side.pieces[k]));
  return result;
}

/** A plane piece is two triangles. */
SizeAndMoment<3> integrals(const Side<3> &side)
{
  SizeAndMoment<3> result;
  for (unsigned int k = 0; k < side.pieces.size(); ++k)
    if (const CurvedFace curve = side.curve(k))
      result.add(curve.area(), curve.mean_point());
    else
      for (const unsigned int last : {0, 3})
      {
        const Point<3> &a = side.pieces[k][1], &b = side.pieces[k][2], &c = side.pieces[k][last];
        result.add(cross_product_3d(b - a, c - a).norm() / 2, a + ((b - a) + (c - a)) / 3.);
      }
  return result;
}
} // namespace

template <int dim>
PlateMotion<dim>::PlateMotion(const Scene<dim> &scene, const BoundaryCondition<dim> &boundary)
    : plate(*boundary.plate)
{
  const Side<dim> side = sides_of(scene)[boundary.id];
  const SizeAndMoment<dim> all = integrals(side);
  if (all.size > 0) // parts have left something of the side
    mean = Point<dim>(all.moment / all.size);
  for (const auto &piece : side.pieces)
    for (const Point<dim> &end : piece)
      radius = std::max(radius, mean.distance(end));
}

template <int dim>
const Point<dim> &PlateMotion<dim>::centre() const
{
  return mean;
}

template <int dim>
double PlateMotion<dim>::reach() const
{
  return radius;
}

template <int dim>
Tensor<1, dim> PlateMotion<dim>::motion(const unsigned int m, const Point<dim> &x) const
{
  Tensor<1, dim> result;
  if (m < dim)
    result[m] = 1.;
  else
  {
    const unsigned int a = dim == 2 ? 0 : (m - dim + 1) % dim, b = (a + 1) % dim;
    result[a] = -(x - mean)[b];
    result[b] = (x - mean)[a];
  }
  return result;
}

template <int dim>
std::vector<unsigned int> PlateMotion<dim>::free_motions() const
{
  std::vector<unsigned int> result;
  for (unsigned int m = 0; m < n_motions; ++m)
    if (plate.is_free(m))
      result.push_back(m);
  return result;
}

template <int dim>
Tensor<1, dim> PlateMotion<dim>::prescribed(const Point<dim> &x) const
{
  Tensor<1, dim> u;
  for (unsigned int m = 0; m < n_motions; ++m)
    u += plate.displacement[m].value_or(0.) * motion(m, x);
  return u;
}

template <int dim>
std::optional<double> PlateMotion<dim>::held(const Tensor<1, dim> &direction,
                                             const Point<dim> &x) const
{
  for (const unsigned int m : free_motions())
    if (std::abs(direction * motion(m, x)) > 1e-9 * (m < dim ? 1. : radius))
      return std::nullopt;
  return direction * prescribed(x);
}

template class PlateMotion<2>;
template class PlateMotion<3>;
} // namespace hpvi
