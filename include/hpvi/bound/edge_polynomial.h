// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_edge_polynomial_h
#define hpvi_edge_polynomial_h

#include <hpvi/plane/contact_space.h>

#include <vector>

namespace hpvi
{
/**
 * A polynomial of s in [0,1], in the Legendre basis L_i(2s - 1) that is orthonormal on [-1,1]:
 * `int_{-1}^1 L_i L_j = delta_ij`.
 */
class EdgePolynomial
{
public:
  EdgePolynomial() = default; ///< zero

  explicit EdgePolynomial(const std::vector<double> &coefficients);

  static EdgePolynomial constant(double value);

  /** The one of least degree with @p values at the points of @p gauss. */
  static EdgePolynomial through(const std::vector<double> &values, const dealii::QGauss<1> &gauss);

  double operator()(double s) const;

  EdgePolynomial operator+(const EdgePolynomial &other) const;

  std::vector<double> coefficients() const;

  double largest() const; ///< no less than the largest of its absolute values over [0,1]

  /**
   * Numbers between which all its values over [0,1] are, from those at m = 4n Chebyshev points: in between, a polynomial of
   * degree below n is less than `1/cos(n pi/(2 m))` times larger (Ehlich and Zeller, DOI 10.1007/BF01111276).
   */
  std::pair<double, double> enclosure() const;

  /** Where it changes sign in (0,1), ascending: between those of its derivative, so that none is missed. */
  std::vector<double> zeros() const;

  /** Where its largest and least values over [0,1] can be: both ends and the zeros of its derivative. */
  std::vector<double> extremes() const;

  EdgePolynomial derivative() const; ///< by s

private:
  double zero_between(double left, double right, double at_left, double at_right) const;

  std::vector<double> terms; ///< coefficients of P_i(2s - 1), P_i(1) = 1
};

/** L_0 to L_{n-1} at s. */
dealii::Vector<double> legendre_basis(unsigned int n, double s);

/** Is g another number elsewhere on the face? */
bool varies(const FrictionRule &friction);

/** 1 or -1 where the multiplier @p i of friction is at its bound; 0: elsewhere, and where that is zero and says nothing. */
template <int dim>
double slip_at(unsigned int i, const dealii::Vector<double> &z, const ContactSpace<dim> &space);

/** Are there both points that stick and points that slip? */
template <int dim>
bool has_transition(const ContactFace<dim> &face, const dealii::Vector<double> &z,
                    const ContactSpace<dim> &space);

/**
 * The same; but one Gauss point slips or sticks as a whole, so that the end of slip may be on either of two such faces that
 * differ.
 */
template <int dim>
bool may_have_transition(unsigned int number, const dealii::Vector<double> &z,
                         const ContactSpace<dim> &space);

/**
 * Degree of friction and pressure of an equilibrated stress on a contact face: p, and more where stick and slip, or
 * contact and gap, share it, because no polynomial within its bounds is near what tractions do there, and where g varies.
 */
template <int dim>
unsigned int traction_degree(const ContactFace<dim> &face, const dealii::Vector<double> &z,
                             const ContactSpace<dim> &space);

/** The rule of the face for integrals of g, with as many points as polynomials of that degree take. */
template <int dim>
FrictionRule traction_rule(const ContactFace<dim> &face, unsigned int degree,
                           const ShapeTables<dim> &tables);

/** v in one direction along a contact face, for displacement unknowns v of the space; between bodies that match their jump. */
template <int dim>
EdgePolynomial edge_trace(const ContactFace<dim> &face, const dealii::Tensor<1, dim> &direction,
                          const DisplacementSpace<dim> &space, const ShapeTables<dim> &tables,
                          const dealii::Vector<double> &v);

/** What friction counts of v: v_t less the past slip of the face, a polynomial of its degree. */
template <int dim>
EdgePolynomial slip_trace(const ContactFace<dim> &face, const DisplacementSpace<dim> &space,
                          const ShapeTables<dim> &tables, const dealii::Vector<double> &v);

/** The past slip with a sign, to add, by as many points as the degree of the face asks for; zero: none. */
template <int dim>
EdgePolynomial less_past(const ContactFace<dim> &face, const ShapeTables<dim> &tables);
} // namespace hpvi

#endif
