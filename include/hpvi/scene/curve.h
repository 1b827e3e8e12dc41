// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_curve_h
#define hpvi_curve_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <memory>

namespace hpvi
{
/** A smooth curve in the plane by a parameter t, which need not be its length. */
class Curve
{
public:
  virtual ~Curve() = default;

  virtual dealii::Point<2> point(double t) const = 0;
  virtual dealii::Tensor<1, 2> derivative(double t) const = 0;

  /** Of the point in [@p from, @p to] that is nearest to @p x; from may exceed to. */
  virtual double nearest(const dealii::Point<2> &x, double from, double to) const = 0;
};

/** `centre + radius (cos t, sin t)`. */
class Circle : public Curve
{
public:
  Circle(const dealii::Point<2> &centre, double radius);

  dealii::Point<2> point(double t) const override;
  dealii::Tensor<1, 2> derivative(double t) const override;
  double nearest(const dealii::Point<2> &x, double from, double to) const override;

private:
  const dealii::Point<2> centre;
  const double radius;
};

/** Along an edge: of a curve what lies between two of its parameters, by s in [0,1]; without a curve nothing. */
struct CurvePiece
{
  std::shared_ptr<const Curve> curve;
  double from = 0, to = 0;

  explicit operator bool() const
  {
    return bool(curve);
  }

  dealii::Point<2> point(double s) const;
  dealii::Tensor<1, 2> derivative(double s) const; ///< by s
  double nearest(const dealii::Point<2> &x) const; ///< s of the point that is nearest to @p x

  /** The part between two values of s; to <= from turns it round. */
  CurvePiece between(double s, double t) const;
};
} // namespace hpvi

#endif
