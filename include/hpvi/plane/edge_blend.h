// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_edge_blend_h
#define hpvi_edge_blend_h

#include <hpvi/scene/curve.h>

#include <array>
#include <functional>
#include <vector>

namespace hpvi
{
/**
 * How far a curved edge departs from its chord: the polynomial of degree p through the curve at the
 * Gauss-Lobatto parameters, less `a + s (b - a)` [length]. With p that of the displacement along the edge
 * the map of a cell is one of its displacements, and a rigid motion strains nothing.
 */
class EdgeBlend
{
public:
  EdgeBlend() = default; ///< of a straight edge

  /** @p way(s), s in [0,1], at its ends @p a and @p b; @p curve: what the edge follows. */
  EdgeBlend(const CurvePiece &curve, const std::function<dealii::Point<2>(double)> &way,
            const dealii::Point<2> &a, const dealii::Point<2> &b, unsigned int degree);

  explicit operator bool() const; ///< is the edge curved?

  unsigned int degree() const ///< of a curved edge: p
  {
    return coefficients.size() - 1;
  }

  /** At s in [0,1], with the derivatives by s up to @p order <= 2. */
  std::array<dealii::Tensor<1, 2>, 3> operator()(double s, unsigned int order = 0) const;

  const CurvePiece &curve() const; ///< along the edge

private:
  CurvePiece piece;
  std::vector<dealii::Tensor<1, 2>> coefficients; ///< of Legendre's polynomials in 2 s - 1
};

/** Those of a cell by face number; all run with the coordinates of the unit cell. */
using EdgeBlends = std::array<EdgeBlend, 4>;
} // namespace hpvi

#endif
