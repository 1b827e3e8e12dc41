// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_friction_cones_h
#define hpvi_friction_cones_h

#include <deal.II/lac/vector.h>
#include <hpvi/scene/friction_limit.h>
#include <hpvi/solvers/feasible_set.h>

#include <vector>

namespace hpvi
{
/**
 * Intervals and half lines, and the cones `|z_t| <= limit(z_n)` of tangential components, Coulomb's or another
 * FrictionLimit, whose normal partner z_n is one of the others: it may have either sign where contact is
 * bilateral.
 */
struct FrictionCones
{
  struct Cone
  {
    unsigned int tangential, normal; ///< components
    FrictionLimit friction;
  };

  FeasibleSet fixed; ///< intervals alone; without sides for tangential components
  std::vector<Cone> cones;

  /** Tresca's set: the sides of tangential components are those of their cones at @p z. */
  FeasibleSet at(const dealii::Vector<double> &z) const;
};
} // namespace hpvi

#endif
