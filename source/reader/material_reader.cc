// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/material_reader.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <memory>

namespace hpvi
{
using namespace dealii;

namespace
{
const std::string isotropic = "isotropic", orthotropic = "orthotropic", moduli = "Young's moduli",
                  ratios = "Poisson's ratios", shear_moduli = "Shear moduli";
const std::string plane_stress = "stress", plane_strain = "strain", axisymmetric = "axisymmetric",
                  range = "from 1e-100 to 1e100",
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
    const bool may_be_empty = words.find("or nothing") != std::string::npos;
    return words + (is_named && !may_be_empty ? ", or nothing" : "");
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

/** The section of one material. */
class SectionReader
{
public:
  SectionReader(const Parameters &parameters, const int dim, const Material &material)
      : parameters(parameters), section(section_of_material(material.name)),
        needed_by(dim == 3                               ? "space"
                  : material.plane == PlaneModel::stress ? "plane stress"
                                                         : "plane strain"),
        shears(dim == 3 ? "G12, G13, G23" : "G12")
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
                                               : shears));
    return Utilities::string_to_double(parts[index]);
  }

  /** The two vectors of Axes. */
  std::array<Tensor<1, 3>, 2> axes() const
  {
    std::array<Tensor<1, 3>, 2> result;
    const std::vector<std::string> vectors = Utilities::split_string_list(text("Axes"), ';');
    for (unsigned int k = 0; k < 2; ++k)
    {
      const auto components =
          Utilities::string_to_double(Utilities::split_string_list(vectors[k], ','));
      std::copy(components.begin(), components.end(), result[k].begin_raw());
    }
    return result;
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
  const std::string section, needed_by, shears;
};

/** Of orthotropy, without section. */
std::vector<Entry> elasticity_entries(const int dim)
{
  const bool is_plane = dim == 2;
  const auto list = [&](const double least, const double most, const unsigned int fewest)
  { return word_or("", Patterns::List(Patterns::Double(least, most), is_plane ? fewest : 3, 3)); };
  const auto wanted = [&](const std::string &plane, const std::string &all)
  { return (is_plane ? plane + " or " : "") + all; };
  const auto in_plane = [&](const std::string &words) { return is_plane ? words : ""; };
  const Patterns::List vectors(Patterns::List(Patterns::Double(-1e100, 1e100), 3, 3, ","), 2, 2,
                               ";");
  return {
      {"", "Elasticity", isotropic,
       std::make_shared<Patterns::Selection>(isotropic + '|' + orthotropic),
       isotropic + " or " + orthotropic,
       "isotropic: Young's modulus and Poisson's ratio. orthotropic: three axes at right angles, " +
           in_plane("the third across the plane, ") +
           "with Young's moduli, Poisson's ratios, Shear moduli and " +
           (is_plane ? "Angle" : "Axes") + " in their place."},
      {"", moduli, "", list(1e-100, 1e100, 2),
       wanted("E1, E2", "E1, E2, E3") + ", numbers from 1e-100 to 1e100",
       "E1, E2, E3 > 0 of an orthotropic material [stress]" +
           in_plane("; plane stress needs no E3") + "."},
      {"", ratios, "", list(-1e100, 1e100, 1), wanted("nu12", "nu12, nu13, nu23"),
       "nu12, nu13, nu23 of an orthotropic material [-]: nu_ij = -eps_j/eps_i where sigma_i acts "
       "alone, and "
       "nu_ij/E_i = nu_ji/E_j." +
           in_plane(" Plane stress needs nu12 alone.")},
      {"", shear_moduli, "", list(1e-100, 1e100, 1),
       is_plane ? "G12, a number from 1e-100 to 1e100"
                : "G12, G13, G23, numbers from 1e-100 to 1e100",
       is_plane ? "G12 > 0 of an orthotropic material [stress]. G13 and G23 may stand behind it, "
                  "and no plane asks for them."
                : "G12, G13, G23 > 0 of an orthotropic material [stress]."},
      is_plane
          ? Entry{"", "Angle", "", word_or("", Patterns::Double(-360, 360)),
                  "degrees from -360 to 360",
                  "Of axis 1 of an orthotropic material against x, counterclockwise [degrees]; "
                  "empty: 0."}
          : Entry{"", "Axes", "", word_or("", vectors), "two vectors x1, y1, z1; x2, y2, z2",
                  "Of an orthotropic material: a vector along axis 1, and one in the plane of "
                  "axes 1 and 2, on the side of axis 2. Their lengths mean nothing; axis 3 is at "
                  "right angles to both. Empty: x and y."}};
}
} // namespace

void read_elasticity(const Parameters &parameters, const int dim, Material &material)
{
  const std::vector<std::string> of_isotropic = {"Young's modulus", "Poisson's ratio"};
  const std::string direction = dim == 3 ? "Axes" : "Angle";
  const SectionReader section(parameters, dim, material);
  if (section.text("Elasticity") == isotropic)
  {
    section.forbid({moduli, ratios, shear_moduli, direction}, isotropic);
    section.require(of_isotropic[0], "a number E > 0");
    section.require(of_isotropic[1], "a number nu with -1 < nu < 1/2");
    return;
  }
  section.forbid(of_isotropic, orthotropic);
  material.young = Material().young; // nobody's, but a number
  material.poisson = Material().poisson;
  Orthotropy result;
  const bool is_full = dim == 3 || material.plane == PlaneModel::strain;
  for (unsigned int i = 0; i < (is_full ? 3 : 2); ++i)
    result.young[i] = section.number(moduli, i, "E" + std::to_string(i + 1));
  const char *const symbols[] = {"nu12", "nu13", "nu23"};
  for (unsigned int i = 0; i < (is_full ? 3 : 1); ++i)
    result.poisson[i] = section.number(ratios, i, symbols[i]);
  result.shear = section.number(shear_moduli, 0, "G12");
  for (unsigned int i = 0; dim == 3 && i < 2; ++i)
    result.shear_across[i] = section.number(shear_moduli, 1 + i, i == 0 ? "G13" : "G23");
  if (!section.text(direction).empty() && dim == 3)
    result.axes = section.axes();
  else if (!section.text(direction).empty())
    result.angle = Utilities::string_to_double(section.text(direction));
  material.orthotropy = result;
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
  if (inherited.is_named && dim == 2)
    entries.push_back({section_of_material(name), "Surfaces", "",
                       std::make_shared<Patterns::Anything>(),
                       "names or numbers of surfaces \"1, 2\" or nothing",
                       "The surfaces of a drawing or a mesh file that are made of this material; "
                       "empty: that of the same name."});
  // Nothing, as scene.prm has them, is for orthotropic materials alone.
  add("Young's modulus", "1", *word_or("", young_pattern), number_words,
      "E > 0 [stress]; constant E in expressions.");
  add("Poisson's ratio", "0.3", *word_or("", Patterns::Double()), "a number nu with -1 < nu < 1/2",
      "nu in (-1, 1/2); constant nu in expressions, as is mu = E/(2(1+nu)).");
  add("Density", "0", Patterns::Double(0), "a number >= 0",
      "Mass per volume: Body force/Gravity times it is a force per volume [stress/length].");
  add("Initial strain", "", Patterns::Anything(),
      dim == 2 ? "e1; e2; e12 or e1; e2; e12; e33 or nothing"
               : "e1; e2; e3; e12; e13; e23 or nothing",
      "Strain eps_0 that carries no stress: tensor components (e12 is half the angle) as "
      "expressions of x and y; " +
          std::string(dim == 2 ? "the fourth, across the plane, presses in plane strain. "
                               : "e1, e2, e3 along the axes, then the shears. ") +
          "Stresses are C : (eps - eps_0).");
  add("Thermal expansion", "0", Patterns::Double(), "a number",
      "Coefficient of expansion alpha, in all three directions: Temperature/Expression times it "
      "is added to "
      "eps_0 [1/temperature].");
  if (dim == 2)
  {
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
  }
  for (const Entry &entry : elasticity_entries(dim))
    add(entry.name, entry.default_value, *entry.pattern, entry.wanted, entry.documentation);
  return entries;
}

Material read_material(const Parameters &parameters, const int dim, const std::string &name)
{
  const auto section_with = [&](const std::string &entry)
  {
    return parameters.text(section_of_material(name), entry).empty() ? section_of_material("")
                                                                     : section_of_material(name);
  };
  const auto value_of = [&](const std::string &entry)
  { return parameters.number(section_with(entry), entry); };
  Material material;
  material.name = name;
  material.young = value_of("Young's modulus");
  material.poisson = value_of("Poisson's ratio");
  material.density = value_of("Density");
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

} // namespace hpvi
