// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/scene/space_motion.h>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Components that are round-off beside the largest are none. */
Tensor<1, 3> unit(Tensor<1, 3> direction)
{
  direction /= direction.norm();
  for (unsigned int d = 0; d < 3; ++d)
    if (std::abs(direction[d]) < 1e-8)
      direction[d] = 0;
  return direction / direction.norm();
}
} // namespace

Tensor<1, 3> SpaceMotion::at(const Point<3> &x) const
{
  return translation + cross_product_3d(rotation, x - centre);
}

bool SpaceMotion::turns() const
{
  return rotation.norm() > 0 &&
         std::abs(rotation * translation) <= 0.1 * rotation.norm() * translation.norm();
}

std::string SpaceMotion::in_words() const
{
  if (!turns())
    return "along " + to_string(Point<3>(unit(translation)));
  Point<3> on_axis = centre + cross_product_3d(rotation, translation) / rotation.norm_square();
  const double size = (on_axis - Point<3>()).norm();
  for (unsigned int d = 0; d < 3; ++d)
    if (std::abs(on_axis[d]) < 1e-8 * size)
      on_axis[d] = 0;
  return "about an axis along " + to_string(Point<3>(unit(rotation))) + " through " +
         to_string(on_axis);
}

void SpaceMotion::add(const double factor, const SpaceMotion &other)
{
  translation += factor * other.translation;
  rotation += factor * other.rotation;
}

template <int dim>
bool rests_on_contact(const Scene<dim> &scene)
{
  if constexpr (dim == 3)
    return !free_motions_in_space(scene).empty();
  else
    return false;
}

template bool rests_on_contact(const Scene<2> &);
template bool rests_on_contact(const Scene<3> &);
} // namespace hpvi
