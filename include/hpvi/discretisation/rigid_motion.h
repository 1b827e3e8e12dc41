// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_rigid_motion_h
#define hpvi_rigid_motion_h

#include <hpvi/discretisation/elastic_system.h>

namespace hpvi
{
/**
 * A motion R that strains nothing and that no support resists. Contact that sees it, B R != 0, holds
 * the body by forces in balance with the loads, `R'(f - B' z) = 0`; then A is stabilised by
 * `c P P'`, where P'u is the mean displacement along R over the contact. A motion that no contact sees is an unknown of its own: A is
 * stabilised by a spring at one unknown, which carries no force, and u is not unique.
 */
template <int dim>
struct RigidMotion
{
  dealii::Tensor<1, dim> direction; ///< of the translation, a unit vector
  dealii::Vector<double> R;         ///< at the unknowns, dimensionless
  dealii::Vector<double> G;         ///< B R, by multiplier
  Stabilisation stabilisation;
  double load = 0; ///< R'f: how hard loads push the body along R [stress length^(dim-1)]

  bool is_seen() const; ///< by any contact

  /**
   * S contains `penalty G G'` and d `penalty load G`, because A^-1 contains `penalty R R'`: the
   * inverse of c (P'R)^2.
   */
  double penalty() const;
};

/**
 * The translation along @p direction; @p weights are those of the multipliers. Throws NumericalFailure where the loads push the body along it
 * and no contact sees it.
 */
template <int dim>
RigidMotion<dim>
make_translation(const dealii::Tensor<1, dim> &direction, const DisplacementSpace<dim> &space,
                 const Unknowns<dim> &unknowns, const ConditionRows &rows,
                 const std::vector<double> &weights, const ElasticSystem<dim> &system);
} // namespace hpvi

#endif
