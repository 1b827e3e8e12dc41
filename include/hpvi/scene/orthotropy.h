// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_orthotropy_h
#define hpvi_orthotropy_h

#include <array>
#include <optional>
#include <string>

namespace hpvi
{
enum class PlaneModel;

/** A symmetric 3 x 3 matrix that acts on components xx, yy, xy; of strains the last one is `2 eps_xy`. */
using VoigtMatrix = std::array<std::array<double, 3>, 3>;

/**
 * The engineering constants of a material with three axes at right angles, the third across the plane:
 * `eps_i = sigma_i/E_i - sum_j nu_ji sigma_j/E_j`, `nu_ij/E_i = nu_ji/E_j` and `2 eps_12 = sigma_12/G_12`.
 */
struct Orthotropy
{
  std::array<double, 3> young{{1, 1, 1}};         ///< E_1, E_2, E_3 [stress]
  std::array<double, 3> poisson{{0.3, 0.3, 0.3}}; ///< nu_12, nu_13, nu_23
  double shear = 1;                               ///< G_12 [stress], all that a plane asks for
  double angle = 0; ///< of axis 1 against x, counterclockwise [degrees]

  /** The compliance of the plane in x and y: `(eps_xx, eps_yy, 2 eps_xy) = S (s_xx, s_yy, s_xy)` [1/stress]. */
  VoigtMatrix compliance(PlaneModel plane) const;

  /**
   * The factors a of `s_zz = a . s - E_3 e_33` in plane strain, with s = (s_xx, s_yy, s_xy) and an initial strain e_33 across
   * the plane.
   */
  std::array<double, 3> transverse() const;

  /** Why there is no such material: a Poisson's ratio too large, in words. */
  std::optional<std::string> flaw(PlaneModel plane) const;
};

/** The inverse of a positive definite one. */
VoigtMatrix inverse(const VoigtMatrix &matrix);
} // namespace hpvi

#endif
