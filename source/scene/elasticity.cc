// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/reader/input/parameters.h>
#include <hpvi/scene/elasticity.h>

#include <deal.II/base/utilities.h>

#include <memory>

namespace hpvi
{
using namespace dealii;

namespace
{
const std::string isotropic = "isotropic", orthotropic = "orthotropic", moduli = "Young's moduli",
                  ratios = "Poisson's ratios", shear_moduli = "Shear moduli";

/** The section of one material. */
class SectionReader
{
public:
  SectionReader(const Parameters &parameters, const Material &material)
      : parameters(parameters), section(section_of_material(material.name)),
        needed_by(material.plane == PlaneModel::stress ? "plane stress" : "plane strain")
  {
  }

  /** Its own, or else that of the unnamed material. */
  std::string text(const std::string &entry) const
  {
    const std::string own = parameters.text(section, entry);
    return own.empty() ? parameters.text(section_of_material(""), entry) : own;
  }

  /** What is inherited contradicts nothing. */
  void forbid(const std::vector<std::string> &entries, const std::string &kind) const
  {
    for (const std::string &entry : entries)
      if (parameters.is_named(section, entry) && !parameters.text(section, entry).empty())
        parameters.reject(section, entry,
                          "contradicts Elasticity = " + kind +
                              " of this material; remove it or set " + section +
                              "/Elasticity = " + (kind == isotropic ? orthotropic : isotropic));
  }

  /** The number with this @p index, which messages know as @p symbol. */
  double number(const std::string &entry, const unsigned int index, const std::string &symbol) const
  {
    const std::vector<std::string> parts = Utilities::split_string_list(text(entry), ',');
    if (index >= parts.size())
      parameters.reject(section, entry,
                        "lacks " + symbol + ", which an orthotropic material needs in " +
                            needed_by + "; give " +
                            (entry == moduli   ? "E1, E2, E3"
                             : entry == ratios ? "nu12, nu13, nu23"
                                               : "G12"));
    return Utilities::string_to_double(parts[index]);
  }

  /** @p wanted: a number in words. */
  void require(const std::string &entry, const std::string &wanted) const
  {
    if (text(entry).empty())
      parameters.reject(section, entry,
                        "is not accepted here, an isotropic material needs it; give " + wanted +
                            " or set " + section + "/Elasticity = " + orthotropic);
  }

private:
  const Parameters &parameters;
  const std::string section, needed_by;
};
} // namespace

std::vector<Entry> elasticity_entries()
{
  const auto list = [](const double least, const double most, const unsigned int fewest)
  { return word_or("", Patterns::List(Patterns::Double(least, most), fewest, 3)); };
  const std::string ignored = " G13 and G23 may stand behind it, and no plane asks for them.";
  return {
      {"", "Elasticity", isotropic,
       std::make_shared<Patterns::Selection>(isotropic + '|' + orthotropic),
       isotropic + " or " + orthotropic,
       "isotropic: Young's modulus and Poisson's ratio. orthotropic: three axes at right angles, "
       "the third across "
       "the plane, with Young's moduli, Poisson's ratios, Shear moduli and Angle in their place."},
      {"", moduli, "", list(1e-100, 1e100, 2), "E1, E2 or E1, E2, E3, numbers from 1e-100 to 1e100",
       "E1, E2, E3 > 0 of an orthotropic material [stress]; plane stress needs no E3."},
      {"", ratios, "", list(-1e100, 1e100, 1), "nu12 or nu12, nu13, nu23",
       "nu12, nu13, nu23 of an orthotropic material [-]: nu_ij = -eps_j/eps_i where sigma_i acts "
       "alone, and "
       "nu_ij/E_i = nu_ji/E_j. Plane stress needs nu12 alone."},
      {"", shear_moduli, "", list(1e-100, 1e100, 1), "G12, a number from 1e-100 to 1e100",
       "G12 > 0 of an orthotropic material [stress]." + ignored},
      {"", "Angle", "", word_or("", Patterns::Double(-360, 360)), "degrees from -360 to 360",
       "Of axis 1 of an orthotropic material against x, counterclockwise [degrees]; empty: 0."}};
}

void read_elasticity(const Parameters &parameters, Material &material)
{
  const std::vector<std::string> of_isotropic = {"Young's modulus", "Poisson's ratio"};
  const SectionReader section(parameters, material);
  if (section.text("Elasticity") == isotropic)
  {
    section.forbid({moduli, ratios, shear_moduli, "Angle"}, isotropic);
    section.require(of_isotropic[0], "a number E > 0");
    section.require(of_isotropic[1], "a number nu with -1 < nu < 1/2");
    return;
  }
  section.forbid(of_isotropic, orthotropic);
  material.young = Material().young; // nobody's, but a number
  material.poisson = Material().poisson;
  Orthotropy result;
  const bool is_strain = material.plane == PlaneModel::strain;
  for (unsigned int i = 0; i < (is_strain ? 3 : 2); ++i)
    result.young[i] = section.number(moduli, i, "E" + std::to_string(i + 1));
  const char *const symbols[] = {"nu12", "nu13", "nu23"};
  for (unsigned int i = 0; i < (is_strain ? 3 : 1); ++i)
    result.poisson[i] = section.number(ratios, i, symbols[i]);
  result.shear = section.number(shear_moduli, 0, "G12");
  if (const std::string angle = section.text("Angle"); !angle.empty())
    result.angle = Utilities::string_to_double(angle);
  material.orthotropy = result;
}

std::string elasticity_in_words(const Material &material, const std::string &unit)
{
  const std::string stress = unit.empty() ? "" : " " + unit;
  if (!material.orthotropy)
    return "Young's modulus " + to_string(material.young) + stress + ", Poisson's ratio " +
           text(material.poisson, 6);
  const Orthotropy &own = *material.orthotropy;
  const bool is_strain = material.plane == PlaneModel::strain;
  std::string words = orthotropic;
  for (unsigned int i = 0; i < (is_strain ? 3 : 2); ++i)
    words += ", E" + std::to_string(i + 1) + " = " + text(own.young[i], 6);
  words += ", G12 = " + text(own.shear, 6) + stress;
  const char *const symbols[] = {"nu12", "nu13", "nu23"};
  for (unsigned int i = 0; i < (is_strain ? 3 : 1); ++i)
    words += std::string(", ") + symbols[i] + " = " + text(own.poisson[i], 6);
  return words + ", axis 1 at " + text(own.angle, 6) + " degrees";
}
} // namespace hpvi
