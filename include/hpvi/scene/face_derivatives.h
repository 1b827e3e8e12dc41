// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_face_derivatives_h
#define hpvi_face_derivatives_h

#include <hpvi/base/quadratics.h>
#include <hpvi/scene/curved_face.h>

#include <array>

namespace hpvi
{
/**
 * Of a face of second order at xi: `x - a_0`, which keeps its digits far from the origin, and its derivatives, of which the second ones are
 * by 11, 12, 22.
 */
struct FaceDerivatives
{
  FaceDerivatives(const CurvedFace::Nodes &nodes, const dealii::Point<2> &xi)
  {
    std::array<std::array<double, 3>, 3> a, b; // by order
    for (unsigned int order = 0; order < 3; ++order)
    {
      a[order] = quadratics(xi[0], order);
      b[order] = quadratics(xi[1], order);
    }
    for (unsigned int k = 1; k < nodes.size(); ++k)
    {
      const dealii::Tensor<1, 3> node = nodes[k] - nodes[0];
      const unsigned int i = k % 3, j = k / 3;
      from_first += a[0][i] * b[0][j] * node;
      along[0] += a[1][i] * b[0][j] * node;
      along[1] += a[0][i] * b[1][j] * node;
      second[0] += a[2][i] * b[0][j] * node;
      second[1] += a[1][i] * b[1][j] * node;
      second[2] += a[0][i] * b[2][j] * node;
    }
  }

  dealii::Tensor<1, 3> area_vector() const ///< n ds over that of the unit square
  {
    return dealii::cross_product_3d(along[0], along[1]);
  }

  dealii::Tensor<1, 3> from_first;
  std::array<dealii::Tensor<1, 3>, 2> along;
  std::array<dealii::Tensor<1, 3>, 3> second;
};
} // namespace hpvi

#endif
