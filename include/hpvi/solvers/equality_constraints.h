// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_equality_constraints_h
#define hpvi_equality_constraints_h

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>
#include <hpvi/solvers/feasible_set.h>

#include <optional>

namespace hpvi
{
/** `G'z = e`: up to three equations of each of eight bodies, whose columns of G may have different units. */
struct EqualityConstraints
{
  dealii::FullMatrix<double> G;          ///< n x m
  dealii::Vector<double> e;              ///< m
  dealii::Vector<double> round_off = {}; ///< of e, a sum of loads that may cancel; empty: 0

  /** `e - G'z`, what z leaves of the loads. */
  dealii::Vector<double> gap(const dealii::Vector<double> &z) const;

  /**
   * The largest `|e - G'z|_j / (|G_j| f + sum_i |G_ij| noise_i + round_off_j / tolerance)` of the columns
   * of G, where f is the largest `(sum_i |G_ij z_i| + |e_j|) / |G_j|` of all: what the balance misses, in
   * parts of the forces. Where these vanish, or are but round-off, the other terms say what counts:
   * the @p noise that z has, and the loads whose sum is e.
   */
  double imbalance(const dealii::Vector<double> &z, const dealii::Vector<double> &noise,
                   double tolerance) const;

  /** `G x` */
  dealii::Vector<double> along(const dealii::Vector<double> &x) const;
};

/**
 * What round-off and the tolerance of a quadratic program leave in z, relative to a tolerance of the balance
 * that is a hundred times larger: `D |D d| / 100` with the @p scale `D = diag(S)^-1/2`.
 */
dealii::Vector<double> noise_of(const dealii::Vector<double> &d,
                                const dealii::Vector<double> &scale);

/** L of a symmetric positive definite `Gamma = L L'`; nothing for nothing. */
dealii::FullMatrix<double> root_of(const dealii::FullMatrix<double> &Gamma);

/** Why no z of a feasible set has `G'z = e`. */
struct Imbalance
{
  /** alpha; its largest component is +-1 once columns of G are scaled to the same length. */
  dealii::Vector<double> motion;
  double load;       ///< `alpha.e`, how hard loads push along the motion
  double resistance; ///< the largest `alpha.G'z` in the set, less than the load
};

/**
 * Nothing where the set holds a z with `G'z = e` to 1e-12 of e. Otherwise the residual of the nearest
 * point, `r = e - G'z*` with z* the minimiser of `|e - G'z|`, columns of G scaled to length one: it
 * separates e from all G'z, for `r.G'z <= r.G'z* = r.e - |r|^2`. The set must not be empty.
 */
std::optional<Imbalance> find_imbalance(const FeasibleSet &feasible_set,
                                        const EqualityConstraints &constraints);
} // namespace hpvi

#endif
