// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_equality_constraints_h
#define hpvi_equality_constraints_h

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>
#include <hpvi/solver/feasible_set.h>

#include <optional>

namespace hpvi
{
/** `G'z = e`: one to three equations, whose columns of G may have different units. */
struct EqualityConstraints
{
  dealii::FullMatrix<double> G; ///< n x m
  dealii::Vector<double> e;     ///< m

  /** `e - G'z`, what z leaves of the loads. */
  dealii::Vector<double> gap(const dealii::Vector<double> &z) const;

  /** `G x` */
  dealii::Vector<double> along(const dealii::Vector<double> &x) const;
};

/** Why no z of a feasible set has `G'z = e`. */
struct Imbalance
{
  /** alpha; its largest component is +-1 once columns of G are scaled to the same length. */
  dealii::Vector<double> motion;
  double load;       ///< `alpha.e`, how hard loads push along the motion
  double resistance; ///< the largest `alpha.G'z` in the set, less than the load
};

/**
 * Nothing where the set holds a z with `G'z = e` to 1e-10 of e. Otherwise the residual of the nearest
 * point, `r = e - G'z*` with z* the minimiser of `|e - G'z|`, columns of G scaled to length one: it
 * separates e from all G'z, for `r.G'z <= r.G'z* = r.e - |r|^2`. The set must not be empty.
 */
std::optional<Imbalance> find_imbalance(const FeasibleSet &feasible_set,
                                        const EqualityConstraints &constraints);
} // namespace hpvi

#endif
