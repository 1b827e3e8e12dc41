// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_material_h
#define hpvi_material_h

namespace hpvi
{
/** Which plane problem Section 2.1.3 of the thesis reduces Hooke's law to. */
enum class PlaneModel
{
  stress,
  strain
};

/** Isotropic linear elasticity, `sigma = lambda tr(eps) I + 2 mu eps` (thesis, Section 2.1). */
struct Material
{
  double young;     ///< Young's modulus E > 0, a stress
  double poisson;   ///< Poisson's ratio nu in (-1, 1/2), dimensionless
  PlaneModel plane; ///< used in two dimensions only

  /** Shear modulus `mu = E/(2(1+nu))`; (2.9) prints E/(1+nu), which contradicts Hooke's law. */
  double mu() const;

  /**
   * First Lame parameter `E nu/((1+nu)(1-2nu))`; plane stress replaces it by
   * `2 lambda mu/(lambda + 2 mu)`. @p dim selects whether the plane model applies.
   */
  double lambda(int dim) const;

  /**
   * The largest c with `c eps : eps <= sigma(eps) : eps`, the smallest eigenvalue of Hooke's law on
   * symmetric tensors: 2 mu without, `2 mu + dim lambda` with change of volume, which is the
   * smaller one where nu < 0.
   */
  double coercivity(int dim) const;

  /**
   * Kolosov's constant of plane elasticity, `(lambda + 3 mu)/(lambda + mu)`: 3 - 4 nu in plane
   * strain, (3 - nu)/(1 + nu) in plane stress.
   */
  double kolosov() const;
};
} // namespace hpvi

#endif
