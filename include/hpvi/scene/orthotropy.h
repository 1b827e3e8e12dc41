// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_orthotropy_h
#define hpvi_orthotropy_h

#include <deal.II/base/tensor.h>

#include <array>
#include <optional>
#include <string>

namespace hpvi
{
enum class PlaneModel;

/**
 * A symmetric matrix that acts on components xx, yy, xy of the plane, or xx, yy, zz, xy, xz, yz of space; of strains the shears
 * are `2 eps_ij`.
 */
template <int dim>
using Voigt = std::array<std::array<double, dim *(dim + 1) / 2>, dim *(dim + 1) / 2>;
using VoigtMatrix = Voigt<2>;

/** The place of a component in it. */
template <int dim>
constexpr unsigned int voigt(const unsigned int i, const unsigned int j)
{
  return dim == 2 ? (i == j ? i % 2 : 2) : (i == j ? i % 3 : (i + j + 2) % 6);
}

/**
 * The engineering constants of a material with three axes at right angles, in the plane the third across it:
 * `eps_i = sigma_i/E_i - sum_j nu_ji sigma_j/E_j`, `nu_ij/E_i = nu_ji/E_j` and `2 eps_ij = sigma_ij/G_ij`.
 */
struct Orthotropy
{
  std::array<double, 3> young{{1, 1, 1}};         ///< E_1, E_2, E_3 [stress]
  std::array<double, 3> poisson{{0.3, 0.3, 0.3}}; ///< nu_12, nu_13, nu_23
  double shear = 1;                               ///< G_12 [stress], all that a plane asks for
  double angle = 0; ///< in the plane, of axis 1 against x, counterclockwise [degrees]
  std::array<double, 2> shear_across{{1, 1}}; ///< in space, G_13, G_23 [stress]
  /** In space: axis 1, and a vector in the plane of axes 1 and 2, on the side of axis 2; of any length. */
  std::array<dealii::Tensor<1, 3>, 2> axes{
      {dealii::Tensor<1, 3>({1, 0, 0}), dealii::Tensor<1, 3>({0, 1, 0})}};

  /** The compliance of the plane in x and y: `(eps_xx, eps_yy, 2 eps_xy) = S (s_xx, s_yy, s_xy)` [1/stress]. */
  VoigtMatrix compliance(PlaneModel plane) const;

  /** In the axes of the material: `eps_i = sum_j S_ij sigma_j` of the normal components [1/stress]. */
  VoigtMatrix normal_compliance() const;

  /** In space, in x, y and z: `s = C (eps_xx, eps_yy, eps_zz, 2 eps_xy, 2 eps_xz, 2 eps_yz)` [stress]. */
  Voigt<3> stiffness_in_space() const;

  /** Its inverse [1/stress]. */
  Voigt<3> compliance_in_space() const;

  /**
   * The factors a of `s_zz = a . s - E_3 e_33` in plane strain, with s = (s_xx, s_yy, s_xy) and an initial strain e_33 across
   * the plane.
   */
  std::array<double, 3> transverse() const;

  /** Why there is no such material: a Poisson's ratio too large, in words. */
  std::optional<std::string> flaw(PlaneModel plane) const;

  /** Have the vectors of `axes` a length and two directions? */
  bool has_axes() const;

private:
  dealii::Tensor<2, 3> frame() const;
};

/** The inverse of a positive definite one. */
VoigtMatrix inverse(const VoigtMatrix &matrix);
} // namespace hpvi

#endif
