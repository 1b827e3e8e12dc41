// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/reader/input/parameters.h>
#include <hpvi/scene/elasticity.h>

#include <algorithm>
#include <cmath>
#include <memory>
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
std::array<double, 2> stiffnesses_of(const Orthotropy &orthotropy, const PlaneModel plane)
{
  const VoigtMatrix S = orthotropy.compliance(plane);
  return {
      {largest_eigenvalue(inverse(S), std::sqrt(2.)), 1 / largest_eigenvalue(S, std::sqrt(0.5))}};
}

/** What a file could not say in the first place, then what no elastic material has. */
std::optional<Material::Flaw> flaw_of(const Orthotropy &orthotropy, const PlaneModel plane)
{
  const auto is_modulus = [](const double value) { return value >= 1e-100 && value <= 1e100; };
  const std::string remedy = "has no modulus here; give numbers from 1e-100 to 1e100";
  for (unsigned int i = 0; i < (plane == PlaneModel::strain ? 3 : 2); ++i)
    if (!is_modulus(orthotropy.young[i]))
      return Material::Flaw{"Young's moduli", remedy, text(orthotropy.young[i])};
  if (!is_modulus(orthotropy.shear))
    return Material::Flaw{"Shear moduli", remedy, text(orthotropy.shear)};
  if (!(std::abs(orthotropy.angle) <= 360))
    return Material::Flaw{"Angle", "is no angle; give degrees from -360 to 360",
                          text(orthotropy.angle)};
  if (const auto problem = orthotropy.flaw(plane))
    return Material::Flaw{"Poisson's ratios", *problem, text(orthotropy.poisson[0])};
  return std::nullopt;
}

const std::string unnamed = "Material", plane_stress = "stress", plane_strain = "strain",
                  axisymmetric = "axisymmetric", range = "from 1e-100 to 1e100",
                  number_words = "a number E > 0 (a stress) " + range;
const Patterns::Double young_pattern(1e-100, 1e100);

using Pattern = std::shared_ptr<const Patterns::PatternBase>;

/** An entry of a named material may be left out: it is that of the unnamed one then. */
struct Inheritance
{
  bool is_named;

  std::string value(const std::string &value) const
  {
    return is_named ? "" : value;
  }

  std::string words(const std::string &words) const
  {
    return words + (is_named ? ", or nothing" : "");
  }

  std::string documentation(const std::string &text) const
  {
    return is_named ? text + " Empty: as of the unnamed Material." : text;
  }

  Pattern pattern(const Patterns::PatternBase &wanted) const
  {
    return is_named ? word_or("", wanted) : Pattern(wanted.clone());
  }
};
} // namespace

std::string section_of_material(const std::string &name)
{
  return name.empty() ? unnamed : unnamed + " " + name;
}

std::vector<Entry> material_entries(const int dim, const std::string &name)
{
  const Inheritance inherited{!name.empty()};
  std::vector<Entry> entries;
  const auto add = [&](const std::string &entry, const std::string &value,
                       const Patterns::PatternBase &pattern, const std::string &words,
                       const std::string &documentation)
  {
    entries.push_back({section_of_material(name), entry, inherited.value(value),
                       inherited.pattern(pattern), inherited.words(words),
                       inherited.documentation(documentation)});
  };
  if (inherited.is_named)
    entries.push_back({section_of_material(name), "Where", "",
                       std::make_shared<Patterns::Anything>(), "one expression of x and y",
                       "Positive where the body is made of this material, at the centre of each "
                       "cell of the coarse mesh; materials are tried in the order of the file, the "
                       "unnamed one is the rest. A box gets a grid line where a side of the "
                       "material has none."});
  // Nothing, as scene.prm has them, is for orthotropic materials alone.
  const auto number_or_nothing = [dim](const Patterns::Double &number)
  { return dim == 2 ? word_or("", number) : Pattern(number.clone()); };
  add("Young's modulus", "1", *number_or_nothing(young_pattern), number_words,
      "E > 0 [stress]; constant E in expressions.");
  add("Poisson's ratio", "0.3", *number_or_nothing(Patterns::Double()),
      "a number nu with -1 < nu < 1/2",
      "nu in (-1, 1/2); constant nu in expressions, as is mu = E/(2(1+nu)).");
  add("Density", "0", Patterns::Double(0), "a number >= 0",
      "Mass per volume: Body force/Gravity times it is a force per volume [stress/length].");
  if (dim == 2)
  {
    add("Initial strain", "", Patterns::Anything(), "e1; e2; e12 or e1; e2; e12; e33 or nothing",
        "Strain eps_0 that carries no stress: tensor components (e12 is half the angle) as "
        "expressions of x and y; "
        "the fourth, across the plane, presses in plane strain. Stresses are C : (eps - eps_0).");
    add("Thermal expansion", "0", Patterns::Double(), "a number",
        "Coefficient of expansion alpha, in all three directions: Temperature/Expression times it "
        "is added to "
        "eps_0 [1/temperature].");
    add("Plane", plane_strain,
        Patterns::Selection(plane_stress + '|' + plane_strain + '|' + axisymmetric),
        plane_stress + ", " + plane_strain + " or " + axisymmetric,
        "Plane stress or plane strain (thesis, Section 2.1.3), or a body of revolution: x >= 0 is "
        "the radius, y the axis, forces and energies are those of the full turn. One for the whole "
        "body.");
    add("Thickness", "1", Patterns::Double(1e-100, 1e100), "a number > 0 from 1e-100 to 1e100",
        "Thickness b of the body [length], one for the whole of it: forces, moments, works and "
        "energies are b times those of a unit, norms and bounds of the error b^(1/2) times; "
        "tractions, stresses and relative errors stay.");
    for (const Entry &entry : elasticity_entries())
      add(entry.name, entry.default_value, *entry.pattern, entry.wanted, entry.documentation);
  }
  return entries;
}

Material read_material(const Parameters &parameters, const int dim, const std::string &name)
{
  const auto section_with = [&](const std::string &entry)
  {
    return parameters.text(section_of_material(name), entry).empty() ? unnamed
                                                                     : section_of_material(name);
  };
  const auto number = [&](const std::string &entry)
  { return parameters.number(section_with(entry), entry); };
  Material material;
  material.name = name;
  material.young = number("Young's modulus");
  material.poisson = number("Poisson's ratio");
  material.density = number("Density");
  if (dim == 2)
    material.plane = plane_model(parameters.text(section_with("Plane"), "Plane"));
  return material;
}

PlaneModel plane_model(const std::string &word)
{
  return word == plane_stress   ? PlaneModel::stress
         : word == axisymmetric ? PlaneModel::axisymmetric
                                : PlaneModel::strain;
}

std::optional<Material::Flaw> Material::flaw() const
{
  if (orthotropy)
  {
    if (auto flaw = flaw_of(*orthotropy, plane))
      return flaw;
  }
  else if (!young_pattern.match(text(young)))
    return Flaw{"Young's modulus", "is not accepted here; give " + number_words, text(young)};
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
    return stiffnesses_of(*orthotropy, plane).back();
  return 2 * mu() + std::min(dim * lambda(dim), 0.);
}

double Material::modulus() const
{
  return orthotropy ? std::max(orthotropy->young[0], orthotropy->young[1]) : young;
}

double Material::locking_ratio(const int dim) const
{
  if (!orthotropy)
    return lambda(dim) / mu();
  const auto values = stiffnesses_of(*orthotropy, plane);
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

std::string Material::stiffness_in_words() const
{
  if (orthotropy)
    return "Young's moduli " + to_string(orthotropy->young[0]) + ", " +
           to_string(orthotropy->young[1]);
  return "Young's modulus " + to_string(young);
}

double Material::kolosov() const
{
  return (lambda(2) + 3 * mu()) / (lambda(2) + mu());
}
} // namespace hpvi
