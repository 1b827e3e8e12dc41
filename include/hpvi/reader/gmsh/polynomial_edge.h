// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_polynomial_edge_h
#define hpvi_polynomial_edge_h

#include <hpvi/scene/curve.h>

#include <vector>

namespace hpvi
{
/**
 * Polynomials through points of a curve, one panel after the other, by t in [0,1]: an edge of a mesh of higher order, whose
 * points are equidistant, or a curve of a drawing at Chebyshev's points. Values and derivatives are those of the second barycentric
 * formula (J.-P. Berrut, L. N. Trefethen, DOI 10.1137/S0036144502417715).
 */
class PolynomialEdge : public Curve
{
public:
  struct Panel
  {
    double begin, end;                    ///< of t
    std::vector<dealii::Point<2>> points; ///< at #places of the panel
  };

  /** @p places lie in [0,1], from 0 to 1. */
  PolynomialEdge(const std::vector<double> &places, std::vector<Panel> panels);

  dealii::Point<2> point(double t) const override;
  dealii::Tensor<1, 2> derivative(double t) const override;
  double nearest(const dealii::Point<2> &x, double from, double to) const override;

  /** Does it run forward along its chord everywhere, as a few points say? */
  bool is_regular() const;

  /** How far from the chord, over the length of the chord. */
  double bow() const;

private:
  using Values = std::vector<dealii::Tensor<1, 2>>;

  struct Piece
  {
    double begin, end;
    Values values, slopes, bends; ///< of the curve and its derivatives by t at #places
  };

  const Piece &piece_at(double t) const;
  dealii::Tensor<1, 2> value(const Piece &piece, const Values &values, double t) const;
  Values derivatives(const Values &values, double length) const;

  std::vector<double> places, weights;
  std::vector<Piece> pieces;
};

/** k/n, k = 0..n. */
std::vector<double> equidistant_places(unsigned int n);

/** (1 - cos(pi k/n))/2. */
std::vector<double> chebyshev_places(unsigned int n);
} // namespace hpvi

#endif
