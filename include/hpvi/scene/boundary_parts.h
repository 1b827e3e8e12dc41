// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_boundary_parts_h
#define hpvi_boundary_parts_h

#include <hpvi/scene/scene.h>

#include <vector>

namespace hpvi
{
/** The boundary that holds the point @p x of the side number @p side: a part where its `where` is positive, else the side. */
template <int dim>
dealii::types::boundary_id boundary_at(const Scene<dim> &scene, unsigned int side,
                                       const dealii::Point<dim> &x);

/** A face of the coarse mesh, before it is graded, along a side of the body. */
template <int dim>
struct CoarseFace
{
  typename Side<dim>::Piece corners;
  dealii::Point<dim> inside;              ///< the centre of its cell
  typename Side<dim>::Curve curve = {};   ///< where it is curved
  unsigned int cell = CoarseMesh::inside; ///< of a mesh, its cell
};

/** Its middle, along its curve; in space that of a plane one is the mean of its corners. */
template <int dim>
dealii::Point<dim> middle_of(const CoarseFace<dim> &face);

template <int dim>
std::vector<CoarseFace<dim>> coarse_faces(const Geometry<dim> &geometry, unsigned int side);

/**
 * By boundary id, the sides of the body without their parts and then these: in the plane each consists of its
 * longest segments, in space and of a mesh of faces of the coarse mesh. Without parts as sides_of() of the geometry.
 */
template <int dim>
std::vector<Side<dim>> sides_of(const Scene<dim> &scene);

/** The outer normal that all of the side has, in one plane or not, without the round-off of components; 0: it has several. */
template <int dim>
dealii::Tensor<1, dim> common_normal(const Side<dim> &side);

/** Its name, in space with its place where it lies across an axis, as in "bottom (y = 0)": which is down is not said by a name. */
template <int dim>
std::string name_and_place(const Scene<dim> &scene, const BoundaryCondition<dim> &boundary);

/** Does it lie on x = 0, all of it? */
template <int dim>
bool lies_on_axis(const Side<dim> &side);
} // namespace hpvi

#endif
