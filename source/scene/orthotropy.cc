// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/scene/material.h>
#include <hpvi/scene/orthotropy.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Of stresses in x and y those in the axes of the material, at @p degrees. */
VoigtMatrix to_axes(const double degrees)
{
  // Exact where an axis of the material lies along one of the body.
  const double quarters = degrees / 90, angle = degrees * numbers::PI / 180;
  const bool is_straight = quarters == std::floor(quarters);
  const bool is_even = std::fmod(quarters, 2.) == 0.;
  const double c = is_straight ? double(is_even) : std::cos(angle),
               s = is_straight ? double(!is_even) : std::sin(angle);
  return {{{{c * c, s * s, 2 * c * s}},
           {{s * s, c * c, -2 * c * s}},
           {{-c * s, c * s, c * c - s * s}}}};
}

/** Of stresses s those in another frame, `R s R'`. */
Voigt<3> turning(const Tensor<2, 3> &R)
{
  Voigt<3> T{};
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = i; j < 3; ++j)
      for (unsigned int a = 0; a < 3; ++a)
        for (unsigned int b = a; b < 3; ++b)
          T[voigt<3>(i, j)][voigt<3>(a, b)] = R[i][a] * R[j][b] + (a == b ? 0. : R[i][b] * R[j][a]);
  return T;
}

/** `T A T'` of a matrix that couples normal components by @p normal and each shear with itself. */
Voigt<3> turned(const Voigt<3> &T, const VoigtMatrix &normal, const std::array<double, 3> &shears)
{
  Voigt<3> AT{}, result{};
  for (unsigned int j = 0; j < 6; ++j)
    for (unsigned int k = 0; k < 3; ++k)
    {
      for (unsigned int l = 0; l < 3; ++l)
        AT[k][j] += normal[k][l] * T[j][l];
      AT[3 + k][j] = shears[k] * T[j][3 + k];
    }
  for (unsigned int i = 0; i < 6; ++i)
    for (unsigned int j = 0; j < 6; ++j)
      for (unsigned int k = 0; k < 6; ++k)
        result[i][j] += T[i][k] * AT[k][j];
  return result;
}

Tensor<1, 3> of_length_one(const Tensor<1, 3> &vector)
{
  const double scale = std::max(
      {std::abs(vector[0]), std::abs(vector[1]), std::abs(vector[2])}); // no square overflows
  return vector / scale / (vector / scale).norm();
}
} // namespace

/** In the axes of the material first. In plane strain sigma_3 is what eps_3 = 0 asks for. */
VoigtMatrix Orthotropy::compliance(const PlaneModel plane) const
{
  VoigtMatrix own{};
  own[0][0] = 1 / young[0];
  own[1][1] = 1 / young[1];
  own[0][1] = own[1][0] = -poisson[0] / young[0];
  own[2][2] = 1 / shear;
  if (plane == PlaneModel::strain)
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int j = 0; j < 2; ++j)
        own[i][j] -= poisson[1 + i] / young[i] * poisson[1 + j] / young[j] * young[2];
  const VoigtMatrix T = to_axes(angle);
  VoigtMatrix result{};
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int l = 0; l < 3; ++l)
          result[i][j] += T[k][i] * own[k][l] * T[l][j];
  return result;
}

VoigtMatrix Orthotropy::normal_compliance() const
{
  VoigtMatrix result;
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      result[i][j] = i == j ? 1 / young[i] : -poisson[i + j - 1] / young[std::min(i, j)];
  return result;
}

/** Its columns are the axes. */
Tensor<2, 3> Orthotropy::frame() const
{
  const Tensor<1, 3> first = of_length_one(axes[0]),
                     third = of_length_one(cross_product_3d(first, of_length_one(axes[1]))),
                     second = cross_product_3d(third, first);
  Tensor<2, 3> result;
  for (unsigned int d = 0; d < 3; ++d)
  {
    result[d][0] = first[d];
    result[d][1] = second[d];
    result[d][2] = third[d];
  }
  return result;
}

bool Orthotropy::has_axes() const
{
  return cross_product_3d(of_length_one(axes[0]), of_length_one(axes[1])).norm() > 1e-6;
}

Voigt<3> Orthotropy::stiffness_in_space() const
{
  return turned(turning(frame()), inverse(normal_compliance()),
                {{shear, shear_across[0], shear_across[1]}});
}

/** Stresses are turned into the axes, strains back: `T' S T`. */
Voigt<3> Orthotropy::compliance_in_space() const
{
  const Voigt<3> T = turning(transpose(frame()));
  Voigt<3> transposed;
  for (unsigned int i = 0; i < 6; ++i)
    for (unsigned int j = 0; j < 6; ++j)
      transposed[i][j] = T[j][i];
  return turned(transposed, normal_compliance(),
                {{1 / shear, 1 / shear_across[0], 1 / shear_across[1]}});
}

/** `s_3 = E_3 (nu_13/E_1 s_1 + nu_23/E_2 s_2)` where eps_3 = 0. */
std::array<double, 3> Orthotropy::transverse() const
{
  const VoigtMatrix T = to_axes(angle);
  std::array<double, 3> result{};
  for (unsigned int j = 0; j < 3; ++j)
    for (unsigned int k = 0; k < 2; ++k)
      result[j] += young[2] * poisson[1 + k] / young[k] * T[k][j];
  return result;
}

/** Positive definite compliances have positive leading minors. */
std::optional<std::string> Orthotropy::flaw(const PlaneModel plane) const
{
  const double n12 = poisson[0], n13 = poisson[1], n23 = poisson[2], E1 = young[0], E2 = young[1],
               E3 = young[2];
  const auto is_too_large = [](const double nu, const double E, const double F)
  { return !(nu * nu < E / F); };
  const std::string energy = "; the material would give energy away";
  if (is_too_large(n12, E1, E2))
    return "has nu12^2 = " + text(n12 * n12) +
           ", which must be less than E1/E2 = " + text(E1 / E2) + energy;
  if (plane == PlaneModel::stress)
    return std::nullopt;
  if (is_too_large(n13, E1, E3))
    return "has nu13^2 = " + text(n13 * n13) +
           ", which must be less than E1/E3 = " + text(E1 / E3) + energy;
  if (is_too_large(n23, E2, E3))
    return "has nu23^2 = " + text(n23 * n23) +
           ", which must be less than E2/E3 = " + text(E2 / E3) + energy;
  const double determinant = 1 - n12 * n12 * E2 / E1 - n13 * n13 * E3 / E1 - n23 * n23 * E3 / E2 -
                             2 * n12 * n23 * n13 * E3 / E1;
  if (!(determinant > 0))
    return "is not positive definite: 1 - nu12^2 E2/E1 - nu13^2 E3/E1 - nu23^2 E3/E2 - 2 nu12 nu23 "
           "nu13 E3/E1 = " +
           text(determinant) + " must be positive; the material would give energy away";
  return std::nullopt;
}

VoigtMatrix inverse(const VoigtMatrix &matrix)
{
  const double scale =
      std::max({matrix[0][0], matrix[1][1], matrix[2][2]}); // no cube over- or underflows
  Tensor<2, 3> full;
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      full[i][j] = matrix[i][j] / scale;
  full = invert(full);
  VoigtMatrix result;
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      result[i][j] = full[i][j] / scale;
  return result;
}
} // namespace hpvi
