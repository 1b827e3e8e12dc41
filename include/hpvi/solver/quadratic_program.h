// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_quadratic_program_h
#define hpvi_quadratic_program_h

#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

namespace hpvi
{
/**
 * The box `lower <= z <= upper`; sides may be infinite. Every question that an algorithm may ask
 * about the constraint set is answered here, so that solvers know nothing of its shape.
 */
class FeasibleSet
{
public:
  FeasibleSet() = default;

  /** Throws unless `lower <= upper` in every component; a lower side of +infinity is no side. */
  FeasibleSet(const dealii::Vector<double> &lower, const dealii::Vector<double> &upper);

  unsigned int size() const;
  const dealii::Vector<double> &lower() const;
  const dealii::Vector<double> &upper() const;

  /** z := the point of the box nearest to z, `z_i := min(u_i, max(l_i, z_i))`; NaN stays NaN. */
  void project(dealii::Vector<double> &z) const;

  /**
   * Largest alpha >= 0 with `z - alpha p` in the box (infinity if no wall is met). z must be
   * feasible.
   */
  double distance_to_wall(const dealii::Vector<double> &z, const dealii::Vector<double> &p) const;

  /**
   * Split the gradient `r = S z - d` at z into free part phi (5.9) and chopped part beta (5.8) of
   * the thesis; their sum is the projected gradient nu (5.10), which vanishes at the minimiser:
   *
   *     phi_i = r_i          where l_i < z_i < u_i,   else 0,
   *     beta_i = min(r_i, 0) where z_i = l_i,  max(r_i, 0) where z_i = u_i,   else 0,
   *
   * and both are 0 where l_i = u_i. NaN in r stays NaN where l_i < u_i.
   */
  void split_gradient(const dealii::Vector<double> &z, const dealii::Vector<double> &r,
                      dealii::Vector<double> &phi, dealii::Vector<double> &beta) const;

  /**
   * The box in the variables `y_i = z_i / scale_i`, scale_i > 0. A wall goes exactly to a wall:
   * the sides are divided just as a caller divides z.
   */
  FeasibleSet scaled(const dealii::Vector<double> &scale) const;

private:
  dealii::Vector<double> lower_bounds;
  dealii::Vector<double> upper_bounds;
};

/**
 * `min 1/2 z'Sz - d'z` over a box: the reduced problem (5.7) for the multiplier. A value: S dense
 * symmetric positive definite n x n, d of length n.
 */
struct QuadraticProgram
{
  dealii::LAPACKFullMatrix<double> S;
  dealii::Vector<double> d;
  FeasibleSet feasible_set;

  /** Asserts that S, d, the box and @p z have the same size. */
  void assert_size(const dealii::Vector<double> &z) const;
};

/**
 * `lambda_max / lambda_min` of a dense symmetric matrix: infinity if it is not positive definite to
 * round-off, NaN if the eigenvalues do not exist (NaN in S), one for n = 0. Costs O(n^3).
 */
double condition_number(const dealii::LAPACKFullMatrix<double> &S);

/**
 * The factors `S_ii^-1/2` of the diagonal scaling: `z_i = scale_i y_i`. A row whose diagonal is not
 * positive, or so small beside the largest that it is zero to round-off, keeps the factor one.
 */
dealii::Vector<double> diagonal_scale(const dealii::LAPACKFullMatrix<double> &S);

/** `D^-1/2 S D^-1/2` with D = diag(S); rows whose diagonal vanishes keep the factor one. */
dealii::LAPACKFullMatrix<double> scaled_by_diagonal(const dealii::LAPACKFullMatrix<double> &S);
} // namespace hpvi

#endif
