// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_legendre_h
#define hpvi_legendre_h

#include <deal.II/lac/full_matrix.h>

#include <array>
#include <map>
#include <vector>

namespace hpvi
{
/**
 * Orthonormal Legendre polynomials on [-1,1], `int L_i L_j = delta_ij`: the basis of all equilibrated
 * stresses. L_i has degree i; a polynomial is the vector of its coefficients.
 */
namespace legendre
{
/** L_0 to L_{n-1} at @p x. */
std::vector<double> values(unsigned int n, double x);
void set_values(unsigned int n, double x, double *L);

constexpr unsigned int n_roots = 128;
extern const std::array<double, n_roots> roots;

/** (2i + 1)^{1/2} */
inline double root(const unsigned int i)
{
  return roots[i];
}

/** `P_{i+1} = up x P_i - down P_{i-1}` of Legendre polynomials with P_i(1) = 1: a table, because divisions are slow. */
struct Recurrence
{
  double up, down;
};
extern const std::array<Recurrence, n_roots> recurrences;

/** `L_i' = sum_j derivative(i, j) L_j`; not zero for j = i-1, i-3, ... alone. */
inline double derivative(const unsigned int i, const unsigned int j)
{
  return j < i && (i - j) % 2 == 1 ? root(i) * root(j) : 0.;
}

/** `x L_i = shift(i+1) L_{i+1} + shift(i) L_{i-1}`. */
double shift(unsigned int i);

/** L_i(-1) or L_i(1). */
inline double at_end(const unsigned int i, const bool right)
{
  return (right || i % 2 == 0 ? 1 : -1) * root(i) * 0.70710678118654752440;
}

/** n x n: coefficients on [begin, end] of a polynomial on [0,1] by those there. */
dealii::FullMatrix<double> restriction(unsigned int n, double begin, double end);

/** Value of the polynomial with @p coefficients at @p x. */
double evaluate(const std::vector<double> &coefficients, double x);
} // namespace legendre

/** Matrices between Legendre coefficients and what elements have, each computed when first asked for. */
class LegendreTables
{
public:
  /** n x n: coefficients on the first (0) or second (1) half of an interval from those on the whole; or (2) on the whole, the other way. */
  const dealii::FullMatrix<double> &part(unsigned int n, unsigned int part) const;

  /** (p+1) x (p+1): coefficients from values at the Gauss-Lobatto nodes of FE_Q(p). */
  const dealii::FullMatrix<double> &from_nodes(unsigned int degree) const;

  /** n x n_gauss: `w_q L_i(x_q)`, which turns values at Gauss points into coefficients. */
  const dealii::FullMatrix<double> &projection(unsigned int n, unsigned int n_gauss) const;

  /** Coefficients (row xi, column eta) of one component of u_N on a cell, as Solution gives it. */
  dealii::FullMatrix<double> displacement_modes(const std::vector<double> &coefficients,
                                                unsigned int component, unsigned int degree) const;

private:
  using Matrices = std::map<std::array<unsigned int, 2>, dealii::FullMatrix<double>>;
  mutable Matrices parts, projections;
  mutable std::map<unsigned int, dealii::FullMatrix<double>> nodal;
  mutable std::map<unsigned int, std::vector<unsigned int>>
      numberings; ///< lexicographic, by degree
};
} // namespace hpvi

#endif
