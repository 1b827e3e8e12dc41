// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_metamorphic_frame_h
#define hpvi_metamorphic_frame_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <random>
#include <string>

namespace metamorphic
{
using namespace dealii;

/** All digits of a number. */
std::string text(double value);

/**
 * How one and the same problem may be told: `x' = length Q x + shift` with an orthogonal Q, stresses times
 * `stress`, displacements in lengths times `amplitude`, the body `thickness` times as thick, sides named from another
 * corner on.
 */
struct Frame
{
  Tensor<2, 2> Q = Tensor<2, 2>({{1, 0}, {0, 1}});
  Tensor<1, 2> shift;
  double length = 1, stress = 1, amplitude = 1, thickness = 1;
  unsigned int first = 0;  ///< the corner that begins the list of corners
  bool writes_box = false; ///< by two corners, where the body is a box; sets `first`
  unsigned int order = 0;  ///< seeds the order of sections and entries; 0: as they are made
  Point<2> origin;         ///< the body's corner 0 and edges, which span its own coordinates X, Y
  Tensor<2, 2> edges = Tensor<2, 2>({{1, 0}, {0, 1}}); ///< columns: along side 0, along side 3

  bool is_mirrored() const
  {
    return determinant(Q) < 0;
  }

  /** Along axes, so that a component of u is one of u'. */
  bool keeps_axes() const;

  /** The side of the body that carries the name number @p k of bottom, right, top, left. */
  unsigned int side(unsigned int k) const;

  /** The corner at which that side begins. */
  unsigned int corner(const unsigned int k) const
  {
    return (side(k) + (is_mirrored() ? 1 : 0)) % 4;
  }

  Point<2> point(const Point<2> &x) const;
  Point<2> point_back(const Point<2> &x) const;

  /** @p function of X, Y and the pressure P as one of x, y and p, times @p factor. */
  std::string function(const std::string &function, double factor) const;

  double energy() const
  {
    return amplitude * amplitude * stress * length * length * thickness;
  }

  double force() const
  {
    return amplitude * stress * length * thickness;
  }
};

/** The numbers of @p frame with another Q, shift, units, order; quarter turns alone if @p along_axes. */
Frame random_frame(Frame frame, bool along_axes, std::mt19937 &random);
} // namespace metamorphic

#endif
