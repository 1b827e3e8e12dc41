// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/body_reader.h>
#include <hpvi/reader/input/expressions.h>
#include <hpvi/reader/input/parameters.h>
#include <hpvi/reader/strain_reader.h>

#include <algorithm>

namespace hpvi
{
using namespace dealii;

namespace
{
/** The section that says it: a named material inherits what it leaves out. */
std::string section_with(const Parameters &parameters, const Material &material,
                         const std::string &entry)
{
  const std::string own = section_of_material(material.name);
  return parameters.text(own, entry).empty() ? section_of_material("") : own;
}

/** Three components, or four, of which the last one is across the plane. */
std::array<Expression<2>, 4> read_components(const Parameters &parameters,
                                             const ExpressionReader<2> &expressions,
                                             const Material &material,
                                             const std::vector<Point<2>> &points)
{
  const std::string entry = "Initial strain", section = section_with(parameters, material, entry),
                    value = parameters.text(section, entry);
  if (std::count(value.begin(), value.end(), ';') != 3)
  {
    const auto in_plane = expressions.read<3>(section, entry, "0", points);
    return {{in_plane[0], in_plane[1], in_plane[2], nullptr}};
  }
  const auto all = expressions.read<4>(section, entry, "0", points);
  if (all[3] && material.plane == PlaneModel::stress)
    parameters.reject(section, entry,
                      "has a fourth component, and plane stress lets the body become thicker as it "
                      "likes; give e1; e2; e12");
  return all;
}
} // namespace

void read_initial_strains(const Parameters &parameters, const std::optional<double> t,
                          Scene<2> &scene)
{
  const std::string section = "Temperature", entry = "Expression";
  const std::vector<Point<2>> points = sample_body(scene.geometry);
  bool expands = false;
  for (const Material &material : scene.materials)
  {
    const ExpressionReader<2> expressions(parameters, constants_of(material, t),
                                          remark_on_constants(material));
    InitialStrain<2> strain;
    strain.components = read_components(parameters, expressions, material, points);
    strain.expansion = parameters.number(section_with(parameters, material, "Thermal expansion"),
                                         "Thermal expansion");
    strain.temperature = expressions.read<1>(section, entry, "0", points)[0];
    expands = expands || strain.expansion != 0.;
    scene.initial_strains.push_back(strain);
  }
  if (!parameters.text(section, entry).empty() && !expands)
    parameters.reject(section, entry,
                      "strains nothing; give Material/Thermal expansion or remove it");
  if (!scene.has_initial_strain())
    scene.initial_strains.clear();
}
} // namespace hpvi
