// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_curved_face_h
#define hpvi_curved_face_h

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <memory>

namespace hpvi
{
/**
 * A face of second order in space: `x(xi) = sum_k phi_k(xi) a_k`, xi in [0,1]^2, of Lagrange's biquadratics and nodes a_k at {0, 1/2, 1}^2, x
 * fastest; `x_1 x x_2` of the derivatives points outwards. Without nodes nothing, as a CurvePiece without a curve.
 */
class CurvedFace
{
public:
  using Nodes = std::array<dealii::Point<3>, 9>;

  CurvedFace() = default;
  explicit CurvedFace(const Nodes &nodes);

  explicit operator bool() const
  {
    return bool(shape);
  }

  const Nodes &nodes() const;

  dealii::Point<3> point(const dealii::Point<2> &xi) const;
  dealii::Tensor<1, 3> normal(const dealii::Point<2> &xi) const; ///< of unit length

  /** xi of the point that is nearest to @p x, which is on the face or not far from it. */
  dealii::Point<2> nearest(const dealii::Point<3> &x) const;

  double distance(const dealii::Point<3> &x) const;

  double area() const;                 ///< to the 15th degree in each coordinate
  dealii::Point<3> mean_point() const; ///< likewise

  bool is_plane() const; ///< to 1e-8 of its size

  const dealii::BoundingBox<3> &box() const; ///< which holds it

private:
  struct Shape
  {
    Nodes nodes;
    dealii::BoundingBox<3> box;
  };

  std::shared_ptr<const Shape> shape;
};
} // namespace hpvi

#endif
