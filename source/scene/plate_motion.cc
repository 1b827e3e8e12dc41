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
constexpr unsigned int rotation = 2;

/** e_z x v */
Tensor<1, 2> turned(const Tensor<1, 2> &v)
{
  return Tensor<1, 2>({-v[1], v[0]});
}
} // namespace

PlateMotion::PlateMotion(const Scene<2> &scene, const BoundaryCondition<2> &boundary)
    : plate(*boundary.plate)
{
  const Side<2> side = sides_of(scene)[boundary.id];
  double length = 0;
  const QGauss<1> gauss(16);
  for (unsigned int k = 0; k < side.pieces.size(); ++k)
    if (!side.curves.empty() && side.curves[k])
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const double s = gauss.point(q)[0],
                     own = gauss.weight(q) * side.curves[k].derivative(s).norm();
        mean += own * side.curves[k].point(s);
        length += own;
      }
    else
    {
      const double own = side.pieces[k][0].distance(side.pieces[k][1]);
      mean += own * centre_of<2>(side.pieces[k]);
      length += own;
    }
  if (length > 0) // parts have left something of the side
    mean /= length;
  for (const Side<2>::Piece &piece : side.pieces)
    for (const Point<2> &end : piece)
      radius = std::max(radius, mean.distance(end));
}

const Point<2> &PlateMotion::centre() const
{
  return mean;
}

double PlateMotion::reach() const
{
  return radius;
}

Tensor<1, 2> PlateMotion::motion(const unsigned int m, const Point<2> &x) const
{
  if (m == rotation)
    return turned(x - mean);
  Tensor<1, 2> unit;
  unit[m] = 1.;
  return unit;
}

std::vector<unsigned int> PlateMotion::free_motions() const
{
  std::vector<unsigned int> result;
  for (unsigned int m = 0; m < n_motions; ++m)
    if (plate.is_free(m))
      result.push_back(m);
  return result;
}

Tensor<1, 2> PlateMotion::prescribed(const Point<2> &x) const
{
  Tensor<1, 2> u;
  for (unsigned int m = 0; m < n_motions; ++m)
    u += plate.displacement[m].value_or(0.) * motion(m, x);
  return u;
}

std::optional<double> PlateMotion::held(const Tensor<1, 2> &direction, const Point<2> &x) const
{
  for (const unsigned int m : free_motions())
    if (std::abs(direction * motion(m, x)) > 1e-9 * (m == rotation ? radius : 1.))
      return std::nullopt;
  return direction * prescribed(x);
}

/** The rotation by what both ends do across the line between them, U at their middle. */
std::array<double, PlateMotion::n_motions>
PlateMotion::amounts(const std::array<Point<2>, 2> &ends,
                     const std::array<Tensor<1, 2>, 2> &u) const
{
  const Tensor<1, 2> way = ends[1] - ends[0];
  const double angle = (u[1] - u[0]) * turned(way) / way.norm_square();
  const Tensor<1, 2> U = (u[0] + u[1]) / 2. - angle * turned((ends[0] - mean) + way / 2.);
  return {{U[0], U[1], angle}};
}
} // namespace hpvi
