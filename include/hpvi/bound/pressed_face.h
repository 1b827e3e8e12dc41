// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_pressed_face_h
#define hpvi_pressed_face_h

#include <hpvi/bound/edge_polynomial.h>
#include <hpvi/bound/legendre.h>
#include <hpvi/plane/solution.h>

#include <array>
#include <cmath>

namespace hpvi
{
/** `int_0^1 t` and `int_0^1 t s` of t with coefficients c are `mean_factor c_0` and `(mean_factor c_0 + slope_factor c_1)/2`. */
inline const double mean_factor = std::sqrt(0.5), slope_factor = std::sqrt(1. / 6.);

/** One face of AdmissiblePressure: the data of its two polynomials, and these. */
struct PressedFace
{
  unsigned int n; ///< coefficients: p + 1
  double length, weight;
  bool is_skew;                            ///< do shears at corners depend on the normal traction?
  double origin, step;                     ///< place `origin + step s` along the boundary
  dealii::Vector<double> openness;         ///< of u_0 - u_Nn
  std::array<double, 2> force{}, moment{}; ///< <z_n, psi_a>, <z_n, psi_a s>
  std::array<dealii::Vector<double>, 2> wanted, t; ///< psi_a z_n; t_a
  std::array<unsigned int, 2> vertices;
  const void *boundary;
  bool is_balanced = true; ///< has pi the moments of z_n, or its force alone?

  EdgePolynomial pressure() const; ///< t_a + t_b
  double least() const;            ///< of the pressure

  /** t_a := the projection of psi_a z_n, with its moments and without a value at the other end of a skew face. */
  void take_own_parts();
};

/** Of a contact face that has pressures, with its own parts. */
PressedFace pressed_face(const ContactFace<2> &face, const Solution<2> &solution,
                         const LegendreTables &legendre);

/** z_N along the normal, or z of friction, as a polynomial of degree p; zero where there is none. */
EdgePolynomial discrete_traction(const ContactFace<2> &face, const Solution<2> &solution,
                                 bool is_pressure);
} // namespace hpvi

#endif
