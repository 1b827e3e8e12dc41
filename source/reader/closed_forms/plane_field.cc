// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/reader/closed_forms/plane_field.h>

#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
Point<2> projected(const Point<3> &x)
{
  return {x[0], x[1]};
}
} // namespace

PlaneField::PlaneField(std::shared_ptr<const ExactSolution<2>> in_plane)
    : in_plane(std::move(in_plane))
{
}

Tensor<1, 3> PlaneField::displacement(const Point<3> &x) const
{
  const Tensor<1, 2> u = in_plane->displacement(projected(x));
  return Tensor<1, 3>({u[0], u[1], 0});
}

Tensor<2, 3> PlaneField::gradient(const Point<3> &x) const
{
  const Tensor<2, 2> slope = in_plane->gradient(projected(x));
  Tensor<2, 3> result;
  for (unsigned int i = 0; i < 2; ++i)
    for (unsigned int j = 0; j < 2; ++j)
      result[i][j] = slope[i][j];
  return result;
}

double PlaneField::multiplier(const Point<3> &x) const
{
  return in_plane->multiplier(projected(x));
}

double PlaneField::pressure(const Point<3> &x) const
{
  return in_plane->pressure(projected(x));
}

std::vector<Point<3>> PlaneField::singularities() const
{
  std::vector<Point<3>> result;
  for (const Point<2> &x : in_plane->singularities())
    result.emplace_back(x[0], x[1], 0.);
  return result;
}
} // namespace hpvi
