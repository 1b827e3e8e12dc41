// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/scene/material.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace hpvi
{
using namespace dealii;

namespace
{
/** The largest of a matrix on symmetric tensors; @p shear: what makes its third component one of length 1. */
double largest_eigenvalue(const VoigtMatrix &matrix, const double shear)
{
  SymmetricTensor<2, 3> result; // xx, yy, sqrt(2) xy
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = i; j < 3; ++j)
      result[i][j] = matrix[i][j] * (i == 2 ? shear : 1.) * (j == 2 ? shear : 1.);
  // Roots of the characteristic polynomial would lose half of the digits where two are equal.
  const double scale = result.norm();
  return scale * eigenvectors(result / scale, SymmetricTensorEigenvectorMethod::jacobi)[0].first;
}

/** Largest and least of C on symmetric tensors [stress], each from the matrix in which it is the largest. */
std::array<double, 2> stiffnesses_of(const Orthotropy &orthotropy, const PlaneModel plane,
                                     const int dim)
{
  if (dim == 3) // in its axes the shears stand alone
  {
    const VoigtMatrix S = orthotropy.normal_compliance();
    const auto [least, most] =
        std::minmax({orthotropy.shear, orthotropy.shear_across[0], orthotropy.shear_across[1]});
    return {{std::max(largest_eigenvalue(inverse(S), 1.), 2 * most),
             std::min(1 / largest_eigenvalue(S, 1.), 2 * least)}};
  }
  const VoigtMatrix S = orthotropy.compliance(plane);
  return {
      {largest_eigenvalue(inverse(S), std::sqrt(2.)), 1 / largest_eigenvalue(S, std::sqrt(0.5))}};
}

std::string in_words(const std::array<Tensor<1, 3>, 2> &axes)
{
  std::string words;
  for (unsigned int k = 0; k < 6; ++k)
    words += (k == 0 ? "" : k == 3 ? "; " : ", ") + text(axes[k / 3][k % 3], 6);
  return words;
}

/** What a file could not say in the first place, then what no elastic material has. */
std::optional<Material::Flaw> flaw_of(const Orthotropy &orthotropy, const PlaneModel plane)
{
  const auto is_modulus = [](const double value) { return value >= 1e-100 && value <= 1e100; };
  const std::string remedy = "has no modulus here; give numbers from 1e-100 to 1e100";
  for (unsigned int i = 0; i < (plane == PlaneModel::strain ? 3 : 2); ++i)
    if (!is_modulus(orthotropy.young[i]))
      return Material::Flaw{"Young's moduli", remedy, text(orthotropy.young[i])};
  for (const double shear :
       {orthotropy.shear, orthotropy.shear_across[0], orthotropy.shear_across[1]})
    if (!is_modulus(shear))
      return Material::Flaw{"Shear moduli", remedy, text(shear)};
  if (!(std::abs(orthotropy.angle) <= 360))
    return Material::Flaw{"Angle", "is no angle; give degrees from -360 to 360",
                          text(orthotropy.angle)};
  if (!orthotropy.has_axes())
    return Material::Flaw{"Axes",
                          "are no two directions; give axis 1 and a vector in the plane of axes 1 "
                          "and 2 that is not along it, x1, y1, z1; x2, y2, z2",
                          in_words(orthotropy.axes)};
  if (const auto problem = orthotropy.flaw(plane))
    return Material::Flaw{"Poisson's ratios", *problem, text(orthotropy.poisson[0])};
  return std::nullopt;
}

const std::string unnamed = "Material", orthotropic = "orthotropic";
} // namespace

std::string section_of_material(const std::string &name)
{
  return name.empty() ? unnamed : unnamed + " " + name;
}

std::optional<Material::Flaw> Material::flaw() const
{
  if (orthotropy)
  {
    if (auto flaw = flaw_of(*orthotropy, plane))
      return flaw;
  }
  else if (!(young >= 1e-100 && young <= 1e100))
    return Flaw{"Young's modulus",
                "is not accepted here; give a number E > 0 (a stress) from 1e-100 to 1e100",
                text(young)};
  else if (!(poisson > -1 && poisson < 0.5))
    return Flaw{"Poisson's ratio", "is outside (-1, 1/2); an elastic material has -1 < nu < 1/2",
                text(poisson)};
  if (!(density >= 0 && std::isfinite(density)))
    return Flaw{"Density", "is no mass per volume; give a number >= 0", text(density)};
  return std::nullopt;
}

std::map<std::string, double> Material::constants() const
{
  if (orthotropy)
    return {};
  return {{"E", young}, {"nu", poisson}, {"mu", mu()}};
}

/**
 * The smallest eigenvalue of Hooke's law on symmetric tensors: 2 mu without, `2 mu + dim lambda`
 * with change of volume, which is the smaller one where nu < 0.
 */
double Material::coercivity(const int dim) const
{
  if (orthotropy)
    return stiffnesses_of(*orthotropy, plane, dim).back();
  return 2 * mu() + std::min(dim * lambda(dim), 0.);
}

double Material::modulus(const int dim) const
{
  if (!orthotropy)
    return young;
  return *std::max_element(orthotropy->young.begin(), orthotropy->young.begin() + dim);
}

double Material::locking_ratio(const int dim) const
{
  if (!orthotropy)
    return lambda(dim) / mu();
  const auto values = stiffnesses_of(*orthotropy, plane, dim);
  return values.front() / values.back() - 1;
}

double Material::transverse_stress(const SymmetricTensor<2, 2> &sigma, const double e33) const
{
  if (plane == PlaneModel::stress)
    return 0.;
  if (!orthotropy)
    return poisson * trace(sigma) - young * e33;
  const auto factor = orthotropy->transverse();
  return factor[0] * sigma[0][0] + factor[1] * sigma[1][1] + factor[2] * sigma[0][1] -
         orthotropy->young[2] * e33;
}

double Material::energy_across(const double e33) const
{
  return plane == PlaneModel::strain ? (orthotropy ? orthotropy->young[2] : young) * e33 * e33 / 2
                                     : 0.;
}

/** In plane strain `eps_zz = 0`: what e33 wants to expand is pressed back and widens the plane. */
SymmetricTensor<2, 2> Material::in_plane(const PlaneStrain &initial) const
{
  SymmetricTensor<2, 2> result;
  result[0][0] = initial[0];
  result[1][1] = initial[1];
  result[0][1] = initial[2];
  if (plane != PlaneModel::strain) // around an axis nothing holds the body
    return result;
  const std::array<double, 3> widening =
      orthotropy ? orthotropy->transverse() : std::array<double, 3>{{poisson, poisson, 0.}};
  result[0][0] += widening[0] * initial[3];
  result[1][1] += widening[1] * initial[3];
  result[0][1] += widening[2] / 2 * initial[3];
  return result;
}

SymmetricTensor<2, 3> Material::without_stress(const StrainComponents<3> &initial) const
{
  SymmetricTensor<2, 3> result;
  for (unsigned int d = 0; d < 3; ++d)
    result[d][d] = initial[d];
  result[0][1] = initial[3];
  result[0][2] = initial[4];
  result[1][2] = initial[5];
  return result;
}

std::string Material::locking_in_words(const int dim) const
{
  std::ostringstream words;
  words.precision(3);
  if (orthotropy)
  {
    words << "the material is " << locking_ratio(dim) + 1
          << " times as stiff against one strain as against another";
    return words.str();
  }
  words << "Poisson's ratio " << text(poisson) << " is near 1/2 (lambda/mu = " << locking_ratio(dim)
        << ')';
  return words.str();
}

std::string Material::stiffness_in_words(const int dim) const
{
  if (orthotropy)
    return "Young's moduli " + to_string(orthotropy->young[0]) + ", " +
           to_string(orthotropy->young[1]) +
           (dim == 3 ? ", " + to_string(orthotropy->young[2]) : "");
  return "Young's modulus " + to_string(young);
}

double Material::kolosov() const
{
  return (lambda(2) + 3 * mu()) / (lambda(2) + mu());
}

std::string Material::elasticity_in_words(const std::string &unit, const int dim) const
{
  const std::string stress = unit.empty() ? "" : " " + unit;
  if (!orthotropy)
    return "Young's modulus " + to_string(young) + stress + ", Poisson's ratio " + text(poisson, 6);
  const Orthotropy &own = *orthotropy;
  const bool is_full = dim == 3 || plane == PlaneModel::strain;
  std::string words = orthotropic;
  for (unsigned int i = 0; i < (is_full ? 3 : 2); ++i)
    words += ", E" + std::to_string(i + 1) + " = " + text(own.young[i], 6);
  words += ", G12 = " + text(own.shear, 6);
  if (dim == 3)
    words += ", G13 = " + text(own.shear_across[0], 6) + ", G23 = " + text(own.shear_across[1], 6);
  words += stress;
  const char *const symbols[] = {"nu12", "nu13", "nu23"};
  for (unsigned int i = 0; i < (is_full ? 3 : 1); ++i)
    words += std::string(", ") + symbols[i] + " = " + text(own.poisson[i], 6);
  return words + (dim == 3 ? ", axes 1 and 2 by " + in_words(own.axes)
                           : ", axis 1 at " + text(own.angle, 6) + " degrees");
}
} // namespace hpvi
