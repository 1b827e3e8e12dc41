// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_friction_cones_h
#define hpvi_friction_cones_h

#include <deal.II/lac/vector.h>
#include <hpvi/solver/feasible_set.h>

#include <vector>

namespace hpvi
{
/**
 * Intervals and half lines, and Coulomb's cones `|z_t| <= mu max(0, z_n)` of tangential components,
 * whose normal partner z_n is one of the others: it may have either sign where contact is bilateral.
 */
struct FrictionCones
{
  struct Cone
  {
    unsigned int tangential, normal; ///< components
    double mu;                       ///< coefficient of friction, at least 0
  };

  FeasibleSet fixed; ///< intervals alone; without sides for tangential components
  std::vector<Cone> cones;

  /** Tresca's set: the sides of tangential components are those of their cones at @p z. */
  FeasibleSet at(const dealii::Vector<double> &z) const;
};
} // namespace hpvi

#endif
