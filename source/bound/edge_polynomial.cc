// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/bound/edge_polynomial.h>
#include <hpvi/bound/legendre.h>
#include <hpvi/plane/matching.h>

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** `|P_i|` over [-1,1] is `(i + 1/2)^{-1/2}`. */
double normalisation(const unsigned int i)
{
  return std::sqrt(i + 0.5);
}
} // namespace

/** Where it passes zero between two points with values of different signs. */
double EdgePolynomial::zero_between(const double left, const double right, const double at_left,
                                    const double at_right) const
{
  const double on_chord = left + (right - left) * at_left / (at_left - at_right);
  if (terms.size() == 2)
    return on_chord;
  const auto with_slope = [this](const double s)
  {
    const double t = 2. * s - 1.;
    double value = 0., slope = 0., before = 0., last = 1., slope_before = 0., last_slope = 0.;
    for (unsigned int i = 0; i < terms.size(); ++i)
    {
      value += terms[i] * last;
      slope += terms[i] * last_slope;
      const double next = legendre::recurrences[i].up * t * last -
                          legendre::recurrences[i].down * before,
                   next_slope = legendre::recurrences[i].up * (t * last_slope + last) -
                                legendre::recurrences[i].down * slope_before;
      before = last;
      last = next;
      slope_before = last_slope;
      last_slope = next_slope;
    }
    return std::make_pair(value, 2. * slope);
  };
  constexpr int bits = 26; // Newton's last step doubles them
  std::uintmax_t patience = 100;
  try
  {
    return boost::math::tools::newton_raphson_iterate(with_slope, on_chord, left, right, bits,
                                                      patience);
  }
  catch (const boost::math::evaluation_error &)
  {
    // Beside a double zero slopes are round-off, and may lead away from it.
    const auto [low, high] = boost::math::tools::toms748_solve(
        *this, left, right, at_left, at_right, boost::math::tools::eps_tolerance<double>(2 * bits),
        patience = 100);
    return 0.5 * (low + high);
  }
}

EdgePolynomial::EdgePolynomial(const std::vector<double> &coefficients) : terms(coefficients)
{
  for (unsigned int i = 0; i < terms.size(); ++i)
    terms[i] *= normalisation(i);
}

EdgePolynomial EdgePolynomial::constant(const double value)
{
  EdgePolynomial result;
  result.terms = {value};
  return result;
}

EdgePolynomial EdgePolynomial::through(const std::vector<double> &values, const QGauss<1> &gauss)
{
  // n Gauss points integrate the products of two polynomials of degree n - 1.
  std::vector<double> coefficients(values.size()), L(values.size());
  for (unsigned int q = 0; q < values.size(); ++q)
  {
    legendre::set_values(L.size(), 2. * gauss.point(q)[0] - 1., L.data());
    for (unsigned int i = 0; i < L.size(); ++i)
      coefficients[i] += 2. * gauss.weight(q) * values[q] * L[i];
  }
  return EdgePolynomial(coefficients);
}

double EdgePolynomial::operator()(const double s) const
{
  const double t = 2. * s - 1.;
  double sum = 0., before = 0., last = 1.;
  for (unsigned int i = 0; i < terms.size(); ++i)
  {
    sum += terms[i] * last;
    const double next =
        legendre::recurrences[i].up * t * last - legendre::recurrences[i].down * before;
    before = last;
    last = next;
  }
  return sum;
}

EdgePolynomial EdgePolynomial::operator+(const EdgePolynomial &other) const
{
  EdgePolynomial result(*this);
  result.terms.resize(std::max(terms.size(), other.terms.size()));
  for (unsigned int i = 0; i < other.terms.size(); ++i)
    result.terms[i] += other.terms[i];
  return result;
}

std::vector<double> EdgePolynomial::coefficients() const
{
  std::vector<double> result(terms);
  for (unsigned int i = 0; i < result.size(); ++i)
    result[i] /= normalisation(i);
  return result;
}

double EdgePolynomial::largest() const
{
  double sum = 0; // |P_i| <= 1
  for (const double coefficient : terms)
    sum += std::abs(coefficient);
  return sum;
}

std::pair<double, double> EdgePolynomial::enclosure() const
{
  const double n_points = 4. * terms.size();
  double least = 0., most = 0.;
  for (unsigned int k = 0; k < n_points; ++k)
  {
    const double value = (*this)(0.5 - 0.5 * std::cos(numbers::PI * (k + 0.5) / n_points));
    least = k == 0 ? value : std::min(least, value);
    most = k == 0 ? value : std::max(most, value);
  }
  const double centre = (least + most) / 2.,
               reach = (most - least) / 2. / std::cos(numbers::PI / 8.);
  return {centre - reach, centre + reach};
}

/** With respect to s, from `(2i + 1) P_i = P_{i+1}' - P_{i-1}'`. */
EdgePolynomial EdgePolynomial::derivative() const
{
  EdgePolynomial result;
  if (terms.size() < 2)
    return result;
  result.terms.resize(terms.size() - 1);
  std::array<double, 2> sums{}; // of the coefficients above, those of either parity
  for (unsigned int i = terms.size() - 1; i-- > 0;)
  {
    sums[(i + 1) % 2] += terms[i + 1];
    result.terms[i] = 2. * (2. * i + 1.) * sums[(i + 1) % 2];
  }
  return result;
}

std::vector<double> EdgePolynomial::extremes() const
{
  std::vector<double> result = {0.};
  if (terms.size() > 2)
  {
    const std::vector<double> inside = derivative().zeros();
    result.insert(result.end(), inside.begin(), inside.end());
  }
  result.push_back(1.);
  return result;
}

std::vector<double> EdgePolynomial::zeros() const
{
  std::vector<double> result;
  if (terms.empty() || 2. * std::abs(terms[0]) > largest())
    return result; // the mean outweighs all the rest
  double left = 0., at_left = 0.;
  for (const double right : extremes()) // in between it is monotonic
  {
    const double at_right = (*this)(right);
    if ((at_left < 0. && at_right > 0.) || (at_left > 0. && at_right < 0.)) // products underflow
      result.push_back(zero_between(left, right, at_left, at_right));
    if (at_right != 0.)
    {
      left = right;
      at_left = at_right;
    }
  }
  return result;
}

Vector<double> legendre_basis(const unsigned int n, const double s)
{
  Vector<double> result(n);
  legendre::set_values(n, 2. * s - 1., result.begin());
  return result;
}

bool varies(const FrictionRule &friction)
{
  const std::vector<double> &g = friction.values;
  return std::any_of(g.begin(), g.end(),
                     [&](const double value)
                     { return std::abs(value - g[0]) > 1e-10 * std::abs(g[0]); });
}

template <int dim>
double slip_at(const unsigned int i, const Vector<double> &z, const ContactSpace<dim> &space)
{
  const double bound = space.multipliers()[i].friction.limit(0.);
  return bound == 0. || std::abs(z[i]) < (1. - 1e-10) * bound ? 0. : z[i] < 0. ? -1. : 1.;
}

namespace
{
template <int dim>
unsigned int n_slipping(const ContactFace<dim> &face, const Vector<double> &z,
                        const ContactSpace<dim> &space)
{
  unsigned int result = 0;
  for (unsigned int i = face.first_multiplier; i < face.first_multiplier + face.n_multipliers; ++i)
    result += space.multipliers()[i].friction.vanishes() || slip_at(i, z, space) != 0.;
  return result;
}
} // namespace

template <int dim>
bool has_transition(const ContactFace<dim> &face, const Vector<double> &z,
                    const ContactSpace<dim> &space)
{
  const unsigned int n = n_slipping(face, z, space);
  return n > 0 && n < face.n_multipliers;
}

template <int dim>
bool may_have_transition(const unsigned int number, const Vector<double> &z,
                         const ContactSpace<dim> &space)
{
  const std::vector<ContactFace<dim>> &faces = space.faces();
  if (faces[number].n_multipliers != 1)
    return has_transition(faces[number], z, space);
  const auto slips = [&](const unsigned int k) { return n_slipping(faces[k], z, space) > 0; };
  const auto differs = [&](const unsigned int k) // unsigned: there may be none before the first
  {
    return k < faces.size() && faces[k].condition == faces[number].condition &&
           slips(k) != slips(number);
  };
  return differs(number - 1) || differs(number + 1);
}

template <int dim>
unsigned int traction_degree(const ContactFace<dim> &face, const Vector<double> &z,
                             const ContactSpace<dim> &space)
{
  // Measured: four more bring the bound down by a sixth where the end of contact, or of slip, lies inside
  // an edge, eight more by another twentieth.
  constexpr unsigned int more = 4;
  const auto presses = [&](const unsigned int i) { return z[i] > 0.; };
  const auto n_pressing = std::count_if(face.pressures.begin(), face.pressures.end(), presses);
  const bool ends = n_pressing > 0 && n_pressing < std::ptrdiff_t(face.pressures.size());
  return face.degree + (ends || varies(face.friction) || has_transition(face, z, space) ? more : 0);
}

template <int dim>
FrictionRule traction_rule(const ContactFace<dim> &face, const unsigned int degree,
                           const ShapeTables<dim> &tables)
{
  if (degree == face.degree || face.friction.vanishes())
    return face.friction;
  const QGauss<1> &gauss = tables.gauss(degree + 2);
  FrictionRule result;
  result.cuts = face.friction.cuts;
  for (unsigned int k = 0; k + 1 < result.cuts.size(); ++k)
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const double width = result.cuts[k + 1] - result.cuts[k];
      result.points.push_back(result.cuts[k] + width * gauss.point(q)[0]);
      result.weights.push_back(width * gauss.weight(q));
      result.values.push_back(face.limit_at(result.points.back()));
    }
  return result;
}

template <int dim>
EdgePolynomial edge_trace(const ContactFace<dim> &face, const Tensor<1, dim> &direction,
                          const DisplacementSpace<dim> &space, const ShapeTables<dim> &tables,
                          const Vector<double> &v)
{
  const unsigned int p = face.degree, n = p + 1;
  const FaceDofs<dim> dofs(face, space, tables);
  const FullMatrix<double> &shapes = tables.edge(p, face.n_points, n).shapes;
  std::vector<double> values(n);
  for (unsigned int q = 0; q < n; ++q)
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int j = 0; j < n; ++j)
        values[q] += shapes(q, j) * direction[c] * dofs.jump(v, c * n + j);
  return EdgePolynomial::through(values, tables.gauss(n));
}

template <int dim>
EdgePolynomial less_past(const ContactFace<dim> &face, const ShapeTables<dim> &tables)
{
  if (!face.past)
    return {};
  const QGauss<1> &gauss = tables.gauss(face.degree + 1);
  std::vector<double> values;
  for (const Point<1> &s : gauss.get_points())
    values.push_back(-face.past_slip(face.point(s[0])));
  return EdgePolynomial::through(values, gauss);
}

template <int dim>
EdgePolynomial slip_trace(const ContactFace<dim> &face, const DisplacementSpace<dim> &space,
                          const ShapeTables<dim> &tables, const Vector<double> &v)
{
  return edge_trace(face, face.frame(0.5).tangent, space, tables, v) + less_past(face, tables);
}

template EdgePolynomial less_past(const ContactFace<2> &, const ShapeTables<2> &);
template EdgePolynomial slip_trace(const ContactFace<2> &, const DisplacementSpace<2> &,
                                   const ShapeTables<2> &, const Vector<double> &);
template double slip_at(unsigned int, const Vector<double> &, const ContactSpace<2> &);
template bool has_transition(const ContactFace<2> &, const Vector<double> &,
                             const ContactSpace<2> &);
template bool may_have_transition(unsigned int, const Vector<double> &, const ContactSpace<2> &);
template unsigned int traction_degree(const ContactFace<2> &, const Vector<double> &,
                                      const ContactSpace<2> &);
template FrictionRule traction_rule(const ContactFace<2> &, unsigned int, const ShapeTables<2> &);
template EdgePolynomial edge_trace(const ContactFace<2> &, const Tensor<1, 2> &,
                                   const DisplacementSpace<2> &, const ShapeTables<2> &,
                                   const Vector<double> &);
} // namespace hpvi
