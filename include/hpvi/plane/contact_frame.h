// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_contact_frame_h
#define hpvi_contact_frame_h

#include <hpvi/plane/cell_map.h>

namespace hpvi
{
/**
 * A contact face at one of its points: the one source of normals, tangents and lengths there. ContactFace::frame() has
 * `Contact direction` d in the place of the normal, and t = (-d_y, d_x).
 */
template <int dim>
struct ContactFrame
{
  dealii::Point<dim> x;
  dealii::Tensor<1, dim> normal;  ///< outer unit normal n, or d
  dealii::Tensor<1, dim> tangent; ///< t = (-n_y, n_x); in space the first of two
  double measure; ///< ds over ds of the reference face: the length of a straight edge
};

/** At @p s of face @p face_no in reference coordinates, in [0,1]^(dim-1). */
template <int dim>
ContactFrame<dim> contact_frame(const CellMap<dim> &map, const unsigned int face_no,
                                const dealii::Point<dim - 1> &s)
{
  static_assert(dim == 2, "one tangent");
  const dealii::Point<dim> reference = point_on_face<dim>(face_no, s);
  const dealii::Tensor<1, dim> normal = map.normal(face_no, reference);
  return {map.point(reference), normal, -dealii::cross_product_2d(normal),
          map.face_measure(face_no, reference)};
}
} // namespace hpvi

#endif
