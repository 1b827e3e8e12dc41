// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/input/parameters.h>
#include <hpvi/scene/material.h>

#include <algorithm>
#include <sstream>

namespace hpvi
{
using namespace dealii;

namespace
{
const std::string section = "Material", plane_stress = "stress", plane_strain = "strain";
} // namespace

std::vector<Entry> material_entries(const int dim)
{
  std::vector<Entry> entries{
      {section, "Young's modulus", "1", std::make_shared<Patterns::Double>(1e-100, 1e100),
       "a number E > 0 (a stress) from 1e-100 to 1e100",
       "E > 0 [stress]; constant E in expressions."},
      {section, "Poisson's ratio", "0.3", std::make_shared<Patterns::Double>(),
       "a number nu with -1 < nu < 1/2",
       "nu in (-1, 1/2); constant nu in expressions, as is mu = E/(2(1+nu))."}};
  if (dim == 2)
    entries.push_back({section, "Plane", plane_strain,
                       std::make_shared<Patterns::Selection>(plane_stress + '|' + plane_strain),
                       plane_stress + " or " + plane_strain,
                       "Plane stress or plane strain (thesis, Section 2.1.3)."});
  return entries;
}

Material read_material(const Parameters &parameters, const int dim)
{
  Material material{parameters.number(section, "Young's modulus"),
                    parameters.number(section, "Poisson's ratio")};
  if (dim == 2 && parameters.text(section, "Plane") == plane_stress)
    material.plane = PlaneModel::stress;
  return material;
}

std::optional<Material::Flaw> Material::flaw() const
{
  const Entry modulus = material_entries(3).front();
  if (const std::string objection = modulus.objection(text(young)); !objection.empty())
    return Flaw{modulus.name, objection, text(young)};
  if (!(poisson > -1 && poisson < 0.5))
    return Flaw{"Poisson's ratio", "is outside (-1, 1/2); an elastic material has -1 < nu < 1/2",
                text(poisson)};
  return std::nullopt;
}

std::map<std::string, double> Material::constants() const
{
  return {{"E", young}, {"nu", poisson}, {"mu", mu()}};
}

/**
 * The smallest eigenvalue of Hooke's law on symmetric tensors: 2 mu without, `2 mu + dim lambda`
 * with change of volume, which is the smaller one where nu < 0.
 */
double Material::coercivity(const int dim) const
{
  return 2 * mu() + std::min(dim * lambda(dim), 0.);
}

std::string Material::locking_in_words(const int dim) const
{
  std::ostringstream words;
  words.precision(3);
  words << "Poisson's ratio " << text(poisson) << " is near 1/2 (lambda/mu = " << locking_ratio(dim)
        << ')';
  return words.str();
}

std::string Material::stiffness_in_words() const
{
  return "Young's modulus " + to_string(young);
}

double Material::kolosov() const
{
  return (lambda(2) + 3 * mu()) / (lambda(2) + mu());
}
} // namespace hpvi
