// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/plane/face_axes.h>

namespace hpvi
{
using namespace dealii;

template <int dim>
ContactAxes<dim> axes_of_face(const CellMap<dim> &map, const unsigned int face,
                              const Point<dim> &reference, const BoundaryCondition<dim> &boundary)
{
  if constexpr (dim == 3)
    if (map.is_curved()) // where no `Contact direction` is offered
    {
      ContactAxes<3> result;
      const Tensor<1, 3> along =
          map.jacobian(reference) * GeometryInfo<3>::unit_tangential_vectors[face][0];
      result.normal = map.normal(face, reference);
      result.tangents[0] = along / along.norm();
      result.tangents[1] = cross_product_3d(result.normal, result.tangents[0]);
      return result;
    }
  return contact_axes(boundary.held_direction(map.normal(face, reference)));
}

template ContactAxes<2> axes_of_face(const CellMap<2> &, unsigned int, const Point<2> &,
                                     const BoundaryCondition<2> &);
template ContactAxes<3> axes_of_face(const CellMap<3> &, unsigned int, const Point<3> &,
                                     const BoundaryCondition<3> &);
} // namespace hpvi
