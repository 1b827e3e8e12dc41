// SPDX-License-Identifier: LGPL-2.1-or-later
#include "random_scene.h"
#include "dice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace metamorphic
{
namespace
{
/** What random functions hold that is no polynomial. */
const std::vector<std::string> transcendental = {"cos(", "exp(", "max(", "if("};

void choose_body(RandomScene &scene, Dice &dice)
{
  const double a = dice.number(0.5, 3), b = dice.number(0.5, 3);
  scene.is_box = dice.happens(0.4);
  const double shear = scene.is_box ? 0. : dice.number(-0.6, 0.6) * b;
  scene.corners = {{{0, 0}, {a, 0}, {a + shear, b}, {shear, b}}};
  if (!scene.is_box && dice.happens(0.3)) // no parallelogram
    scene.corners[2] += Tensor<1, 2>({dice.number(-0.2, 0.2) * a, dice.number(-0.2, 0.2) * b});
  for (unsigned int &n : scene.subdivisions)
    n = static_cast<unsigned int>(dice.number(1, 4));
  scene.young = std::pow(10, dice.number(-1, 2));
  scene.poisson = dice.happens(0.1) ? 0.49 : dice.number(-0.2, 0.42);
  scene.plane = dice.chosen({"stress", "strain"});
}

/** Bounds, gaps and loads that move the body by a hundredth of its size. */
void choose_contact(RandomScene &scene, Side &side, const bool interferes, Dice &dice)
{
  side.contact = dice.chosen({"bilateral", "unilateral", "unilateral", "tangential"});
  if (side.contact == "unilateral" && dice.happens(0.6))
    side.gap = interferes && dice.happens(0.5) ? dice.function(0.01) : dice.positive(0.02);
  if (side.contact != "tangential" && dice.happens(0.25))
    side.coefficient = dice.happens(0.7)   ? text(dice.number(0.05, 0.4))
                       : dice.happens(0.5) ? "0.1 + 0.2*X*Y"
                                           : "0.3/(1 + P/" + text(0.02 * scene.young) + ")";
  else if (side.contact == "tangential" || dice.happens(0.8))
    side.bound = dice.positive(0.02 * scene.young * std::pow(10, dice.number(-1, 0.5)));
}

void choose_loads(RandomScene &scene, Dice &dice)
{
  for (Side &side : scene.sides)
    if (side.displacement[0].empty() && side.displacement[1].empty() && side.contact.empty() &&
        dice.happens(0.5))
      side.traction = {{dice.function(0.01 * scene.young), dice.function(0.01 * scene.young)}};
  if (dice.happens(0.3))
    scene.body_force = {{dice.function(0.01 * scene.young), dice.function(0.01 * scene.young)}};
}

/** One, two or no side but the contact's holds the body. */
void choose_sides(RandomScene &scene, Dice &dice)
{
  const unsigned int kind = dice.number(0, 6);
  choose_contact(scene, scene.sides[0], kind < 2, dice);
  switch (kind)
  {
  case 0: // pressed from above
  case 1:
    scene.sides[2].displacement = {
        {dice.function(0.02), // tilted: a symmetric scene ties cells, and its mesh is not unique
         "-0.02*(" + text(dice.number(0, 1)) + " + 0.2*X + " + dice.positive(1) + ")"}};
    break;
  case 2: // held beside it
    scene.sides[1].displacement = {{"0", "0"}};
    break;
  case 3: // moved beside it, away from the corner
    scene.sides[1].displacement = {
        {"0.02*Y*(" + dice.function(1) + ")", "-0.02*Y*(" + dice.positive(1) + ")"}};
    break;
  case 4: // between two planes
    choose_contact(scene, scene.sides[3], false, dice);
    scene.sides[2].displacement = {
        {"0.02*X*(" + dice.function(1) + ")", "0.02*X*(" + dice.function(1) + ")"}};
    if (scene.sides[3].coefficient.empty() != scene.sides[0].coefficient.empty())
      scene.sides[3] = {};
    break;
  default:
    if (scene.is_box && dice.happens(0.5)) // one component
      scene.sides[2].displacement = {
          {dice.happens(0.5) ? "" : dice.function(0.02), "-0.01*(1 + 0.2*X)"}};
    else // by contact alone
      scene.sides[2].traction = {{text(dice.number(-0.001, 0.001) * scene.young),
                                  text(-0.01 * scene.young) + "*(1 + 0.1*X)"}};
  }
  choose_loads(scene, dice);
}

void choose_method(RandomScene &scene, Dice &dice)
{
  auto &settings = scene.settings;
  settings["Adaptivity/Method"] =
      dice.chosen({"hup2", "hup3", "hap2", "hap3", "pu", "hpa1", "hpa2", "hpa3"});
  settings["Adaptivity/Smoothness reading"] = "joint";
  settings["Adaptivity/Indicator"] = "residual";
  settings["Adaptivity/Start degree"] = "0";
  settings["Adaptivity/Maximum steps"] = dice.chosen({"1", "2", "3"});
  settings["Adaptivity/Maximum unknowns"] = "400";
  settings["Adaptivity/Tolerance"] = "0";
  settings["Solver/Path"] = "reduced";
  settings["Solver/Coulomb solver"] = "newton";
  settings["Solver/QP solver"] = dice.chosen({"active set", "mprgp"});
  settings["Solver/Multiplier degree offset"] = "-2";
  settings["Solver/Normal contact"] =
      scene.has(&Side::coefficient) ? "multiplier" : dice.chosen({"nodes", "multiplier"});
}

// ---------------------------------------------------------------- materials and parts

/** Positive beyond or before a grid line that divides @p n cells along @p v. */
std::string beyond_a_line(const std::string &v, const unsigned int n, Dice &dice)
{
  const std::string line =
      text(static_cast<unsigned int>(dice.number(1, n)) / static_cast<double>(n));
  return dice.happens(0.5) ? v + " - " + line : line + " - " + v;
}

/** Layers across X or Y, or cells of the one and the other around a vertex: stiffer than the first, whose loads move it by a hundredth. */
void choose_materials(RandomScene &scene, Dice &dice)
{
  std::vector<unsigned int> divided; // directions with an inner grid line
  for (unsigned int d = 0; d < 2; ++d)
    if (scene.subdivisions[d] > 1)
      divided.push_back(d);
  if (divided.empty())
    return;
  const std::array<std::string, 2> variables = {{"X", "Y"}};
  const auto along = [&](const unsigned int d)
  { return beyond_a_line(variables[d], scene.subdivisions[d], dice); };
  const auto other = [&](const std::string &where)
  {
    scene.materials.push_back({where, scene.young * std::pow(10, dice.number(0, 4)),
                               dice.number(-0.2, 0.42), dice.number(0, 2)});
  };
  if (divided.size() == 2 && dice.happens(0.4))
    other("(" + along(0) + ")*(" + along(1) + ")");
  else
  {
    const unsigned int d = divided[static_cast<unsigned int>(dice.number(0, divided.size()))];
    other(along(d));
    if (scene.subdivisions[d] == 3 && dice.happens(0.5)) // one for each layer
    {
      scene.materials[0].where = variables[d] + " - " + text(2. / 3);
      other(text(1. / 3) + " - " + variables[d]);
    }
  }
}

/** Loads of a free side, or contact and friction of a contact side, that differ along it. */
void choose_part(RandomScene &scene, const unsigned int k, Dice &dice)
{
  const unsigned int n = scene.subdivisions[k % 2];
  const Side side = scene.sides[k];
  if (n < 2 || !side.displacement[0].empty() || !side.displacement[1].empty())
    return;
  Side part;
  part.on = k;
  part.where = beyond_a_line(k % 2 == 0 ? "X" : "Y", n, dice);
  if (side.contact.empty())
  {
    if (dice.happens(0.7))
      part.pressure = dice.function(0.01 * scene.young);
    if (dice.happens(0.5))
      part.shear = dice.function(0.01 * scene.young);
  }
  else if (!side.coefficient.empty())
  {
    part = side;
    part.where = beyond_a_line(k % 2 == 0 ? "X" : "Y", n, dice);
    part.coefficient = text(dice.number(0.05, 0.4));
  }
  else
  {
    part.contact = dice.happens(0.5) ? side.contact : "tangential";
    part.gap = part.contact == "unilateral" ? side.gap : "";
    part.bound = dice.positive(0.02 * scene.young * std::pow(10, dice.number(-1, 0.5)));
  }
  scene.sides.push_back(part);
}

void choose_weight(RandomScene &scene, Dice &dice)
{
  scene.gravity = {{dice.function(0.01 * scene.young), text(-0.01 * scene.young)}};
  scene.density = dice.number(0, 1);
}

/** What needs whole cells; on a body that is no parallelogram their lines are no functions of X or Y alone. */
void divide(RandomScene &scene, Dice &dice)
{
  const bool is_parallelogram =
      (scene.corners[2] - scene.corners[1] - (scene.corners[3] - scene.corners[0])).norm() < 1e-12;
  if (is_parallelogram && dice.happens(0.4))
    choose_materials(scene, dice);
  for (unsigned int k = 0; k < 4 && is_parallelogram; ++k)
    if (dice.happens(0.2))
      choose_part(scene, k, dice);
  for (unsigned int k = 0; k < 4; ++k)
  {
    Side &side = scene.sides[k];
    if (side.contact.empty() && side.displacement[0].empty() && side.displacement[1].empty() &&
        dice.happens(0.2))
      (dice.happens(0.5) ? side.pressure : side.shear) = dice.function(0.01 * scene.young);
  }
  if (dice.happens(0.3))
    choose_weight(scene, dice);
  if (dice.happens(0.3))
    scene.thickness = std::pow(10, dice.number(-1, 1));
  if (scene.materials.size() == 1 && dice.happens(0.5))
    scene.exchange_materials();
}

/** Now and then contact is askew, or the normal is written down; less askew where friction could jam. */
void choose_directions(RandomScene &scene, std::mt19937 random)
{
  std::mt19937 own(random()); // so that all else of a seed stays as it was
  Dice dice(own);
  for (Side &side : scene.sides)
    if (!side.contact.empty() && dice.happens(0.1))
      side.turn =
          dice.happens(0.2) ? 0. : dice.number(-1, 1) * (side.coefficient.empty() ? 0.6 : 0.2);
}

/** Each interval of a mean solves two problems more. */
void choose_probe(RandomScene &scene, std::mt19937 random)
{
  std::mt19937 own(random() + 2);
  scene.has_probe = Dice(own).happens(0.25);
}

/** From a copy of @p random: what else is drawn stays as it was. */
void choose_fibres(RandomScene &scene, std::mt19937 random)
{
  std::mt19937 own(random() + 1);
  Dice dice(own);
  if (!dice.happens(0.25))
    return;
  if (dice.happens(0.7) || scene.materials.empty())
    scene.fibres = random_fibres(100, own);
  for (OtherMaterial &other : scene.materials)
    if (dice.happens(0.7))
      other.fibres = random_fibres(100, own);
}

/** A free side between sides that hold nothing is glued to a plate now and then. */
void choose_plates(RandomScene &scene, std::mt19937 random)
{
  std::mt19937 own(random() + 2);
  Dice dice(own);
  const auto is_free = [](const Side &side)
  { return side.displacement[0].empty() && side.displacement[1].empty(); };
  for (unsigned int k = 0; k < 4 && scene.is_held(); ++k)
  {
    Side &side = scene.sides[k];
    const bool is_whole = std::none_of(scene.sides.begin() + 4, scene.sides.end(),
                                       [&](const Side &part) { return part.on == k; });
    const bool stands_alone = std::all_of(
        scene.sides.begin(), scene.sides.end(),
        [&](const Side &other)
        {
          return &other == &side || other.on == (k + 2) % 4 ||
                 (is_free(other) && other.contact != "bilateral" && other.moment.empty());
        });
    if (!is_free(side) || !side.contact.empty() || !is_whole || !stands_alone || !dice.happens(0.3))
      continue;
    const double size = 0.01 * scene.young;
    const std::string in_time = scene.settings.count("Loading/Steps") ? "*sin(4*t)" : "";
    side.traction = {};
    side.pressure = side.shear = "";
    for (std::string &component : side.force)
      component = text(size * dice.number(-1, 1)) + in_time;
    side.moment = text(0.1 * size * dice.number(-1, 1)) + in_time;
  }
}

/** A free side that no plate holds stands on an elastic foundation now and then. */
void choose_springs(RandomScene &scene, std::mt19937 random)
{
  std::mt19937 own(random() + 4);
  Dice dice(own);
  for (Side &side : scene.sides)
    if (side.displacement[0].empty() && side.displacement[1].empty() && side.contact.empty() &&
        side.moment.empty() && side.where.empty() && dice.happens(0.1))
    {
      side.spring = {{dice.positive(scene.young), dice.positive(0.3 * scene.young)}};
      if (dice.happens(0.4))
        side.spring[0] = dice.strip(side.on % 2 == 0 ? "X" : "Y", 10 * scene.young);
    }
}

/** Friction that is both Coulomb's and Tresca's. */
void choose_laws(RandomScene &scene, std::mt19937 random)
{
  std::mt19937 own(random() + 5);
  Dice dice(own);
  if (dice.happens(0.5))
    return;
  const std::string law = dice.chosen({"limited", "cohesive"}),
                    bound = text(0.01 * scene.young * dice.number(0.2, 1));
  for (Side &side : scene.sides)
    if (!side.coefficient.empty())
    {
      side.law = law;
      side.bound = bound;
    }
}

void choose_initial_strain(RandomScene &scene, std::mt19937 random)
{
  std::mt19937 own(random() + 3);
  Dice dice(own);
  if (!dice.happens(0.2))
    return;
  if (dice.happens(0.6))
  {
    scene.expansion = 0.01;
    scene.temperature = dice.function(1.);
    if (dice.happens(0.4))
      scene.temperature += " + " + dice.strip(dice.chosen({"X", "Y"}), 1.);
  }
  else
    for (double &component : scene.initial_strain)
      component = 0.01 * dice.number(-1, 1);
}

// ---------------------------------------------------------------- files

/** The file, with sections and entries in an order of their own. */
std::string written(std::vector<Section> sections, const unsigned int order)
{
  if (order > 0)
  {
    std::mt19937 random(order);
    std::shuffle(sections.begin(), sections.end(), random);
    for (auto &section : sections)
      std::shuffle(section.second.begin(), section.second.end(), random);
  }
  std::string result = "set Dimension = 2\n";
  for (const auto &[name, entries] : sections)
  {
    if (entries.empty())
      continue;
    result += "subsection " + name + "\n";
    for (const auto &[entry, value] : entries)
      result += "  set " + entry + " = " + value + "\n";
    result += "end\n";
  }
  return result;
}

/** A vector of the body in the axes of the frame; components that are not given are @p missing. */
std::string vector_text(const std::array<std::string, 2> &components, const Frame &frame,
                        const double factor, const std::string &missing)
{
  std::string result;
  for (unsigned int c = 0; c < 2; ++c)
  {
    std::string sum;
    for (unsigned int j = 0; j < 2; ++j)
      if (frame.Q[c][j] != 0. && !components[j].empty())
        sum += (sum.empty() ? "" : " + ") + frame.function(components[j], factor * frame.Q[c][j]);
    result += (c == 0 ? "" : "; ") + (sum.empty() ? missing : sum);
  }
  return result;
}

bool is_given(const std::array<std::string, 2> &components)
{
  return !components[0].empty() || !components[1].empty();
}
} // namespace

RandomScene::RandomScene(std::mt19937 &random) : sides(4)
{
  for (unsigned int k = 0; k < 4; ++k)
    sides[k].on = k;
  Dice dice(random);
  choose_body(*this, dice);
  choose_sides(*this, dice);
  choose_method(*this, dice);
  divide(*this, dice);
  if (dice.happens(0.15)) // a load that comes and turns around
  {
    settings["Loading/Steps"] = dice.chosen({"2", "3"});
    settings["Loading/Adapt"] = dice.chosen({"first step", "every step"});
    for (Side &side : sides)
      for (std::string *component :
           {&side.displacement[0], &side.displacement[1], &side.traction[0], &side.traction[1],
            &side.pressure, &side.shear})
        if (!component->empty() && *component != "0")
          *component = "(" + *component + ")*sin(4*t)";
  }
  choose_directions(*this, random);
  choose_fibres(*this, random);
  choose_probe(*this, random);
  choose_plates(*this, random);
  choose_initial_strain(*this, random);
  choose_springs(*this, random);
  choose_laws(*this, random);
}

Frame RandomScene::own_frame() const
{
  Frame frame;
  frame.writes_box = is_box;
  frame.origin = corners[0];
  for (unsigned int d = 0; d < 2; ++d)
  {
    frame.edges[d][0] = corners[1][d] - corners[0][d];
    frame.edges[d][1] = corners[3][d] - corners[0][d];
  }
  return frame;
}

bool RandomScene::needs_axes() const
{
  return std::any_of(sides.begin(), sides.end(),
                     [](const Side &side)
                     { return side.displacement[0].empty() != side.displacement[1].empty(); });
}

bool RandomScene::is_held() const
{
  return std::any_of(sides.begin(), sides.end(),
                     [](const Side &side)
                     { return !side.displacement[0].empty() && !side.displacement[1].empty(); });
}

bool RandomScene::has_polynomial_data() const
{
  const std::string all = text(own_frame());
  return std::all_of(transcendental.begin(), transcendental.end(),
                     [&](const std::string &word) { return all.find(word) == std::string::npos; });
}

bool RandomScene::is_isotropic() const
{
  return !fibres && std::none_of(materials.begin(), materials.end(),
                                 [](const OtherMaterial &other) { return bool(other.fibres); });
}

bool RandomScene::has(std::string Side::*const entry) const
{
  return std::any_of(sides.begin(), sides.end(),
                     [&](const Side &side) { return !(side.*entry).empty(); });
}

bool RandomScene::has_plates() const
{
  return has(&Side::moment);
}

bool RandomScene::has_springs() const
{
  return std::any_of(sides.begin(), sides.end(),
                     [](const Side &side) { return !side.spring[0].empty(); });
}

bool RandomScene::has_initial_strain() const
{
  return !temperature.empty() || initial_strain != std::array<double, 3>{};
}

bool RandomScene::has_direction() const
{
  return std::any_of(sides.begin(), sides.end(),
                     [](const Side &side) { return side.turn.has_value(); });
}

Tensor<1, 2> RandomScene::contact_direction(const Side &side) const
{
  const Tensor<1, 2> along = corners[(side.on + 1) % 4] - corners[side.on];
  const Tensor<1, 2> normal = cross_product_2d(along) / along.norm();
  const double angle = side.turn.value_or(0.);
  return std::cos(angle) * normal - std::sin(angle) * cross_product_2d(normal);
}

Section RandomScene::geometry(const Frame &frame) const
{
  using metamorphic::text;
  const auto corner = [&](const unsigned int k)
  {
    const Point<2> x = frame.point(corners[frame.corner(k)]);
    return text(x[0]) + ", " + text(x[1]);
  };
  const bool is_across = frame.side(0) % 2 == 1;
  Section section{"Geometry",
                  {{"Subdivisions", std::to_string(subdivisions[is_across ? 1 : 0]) + ", " +
                                        std::to_string(subdivisions[is_across ? 0 : 1])},
                   {"Shape", frame.writes_box ? "box" : "quadrilateral"}}};
  if (frame.writes_box)
  {
    section.second.emplace_back("Lower corner", corner(0));
    section.second.emplace_back("Upper corner", corner(2));
  }
  else
    section.second.emplace_back("Corners",
                                corner(0) + "; " + corner(1) + "; " + corner(2) + "; " + corner(3));
  return section;
}

/** The mean over a disc in the middle, half as wide as there is room. */
Section RandomScene::probe(const Frame &frame) const
{
  using metamorphic::text;
  Point<2> middle;
  for (const Point<2> &corner : corners)
    middle += corner / 4.;
  double room = std::numeric_limits<double>::max();
  for (unsigned int k = 0; k < 4; ++k)
  {
    const Tensor<1, 2> way = corners[(k + 1) % 4] - corners[k], out = middle - corners[k];
    room = std::min(room, std::abs(way[0] * out[1] - way[1] * out[0]) / way.norm());
  }
  const Point<2> x = frame.point(middle);
  return {"Probe core",
          {{"At", text(x[0]) + ", " + text(x[1])}, {"Size", text(0.5 * room * frame.length)}}};
}

Section RandomScene::boundary(const unsigned int k, const Frame &frame) const
{
  const std::array<std::string, 4> names = {{"bottom", "right", "top", "left"}};
  const bool is_part = k >= 4;
  const Side &side = sides[is_part ? k : frame.side(k)];
  const double u = frame.amplitude * frame.length, traction = frame.amplitude * frame.stress;
  Section section{"Boundary " + (is_part ? "part" + std::to_string(k) : names[k]), {}};
  const auto add = [&](const std::string &entry, const std::string &value)
  {
    if (!value.empty())
      section.second.emplace_back(entry, value);
  };
  if (is_part)
    for (unsigned int on = 0; on < 4; ++on)
      if (frame.side(on) == side.on)
        add("On", names[on]);
  add("Where", frame.function(side.where, 1));
  if (is_given(side.displacement))
    add("Displacement", vector_text(side.displacement, frame, u, "free"));
  if (is_given(side.traction))
    add("Traction", vector_text(side.traction, frame, traction, "0"));
  add("Pressure", frame.function(side.pressure, traction));
  add("Shear", frame.function(side.shear, frame.is_mirrored() ? -traction : traction));
  if (!side.spring[0].empty())
    add("Spring", frame.function(side.spring[0], frame.stress / frame.length) + "; " +
                      frame.function(side.spring[1], frame.stress / frame.length));
  if (!side.moment.empty())
  {
    const double force = traction * frame.length * frame.thickness;
    add("Rigid", "true");
    add("Force", vector_text(side.force, frame, force, "free"));
    add("Moment", frame.function(side.moment, frame.is_mirrored() ? -force * frame.length
                                                                  : force * frame.length));
  }
  add("Contact", side.contact);
  add("Gap", frame.function(side.gap, u));
  if (side.turn)
  {
    const Tensor<1, 2> d = frame.Q * contact_direction(side);
    add("Contact direction", metamorphic::text(d[0]) + "; " + metamorphic::text(d[1]));
  }
  add("Friction bound", frame.function(side.bound, traction));
  add("Friction coefficient", frame.function(side.coefficient, 1));
  add("Friction law", side.law);
  return section;
}

void RandomScene::exchange_materials()
{
  OtherMaterial &other = materials.at(0);
  std::swap(young, other.young);
  std::swap(poisson, other.poisson);
  std::swap(density, other.density);
  std::swap(fibres, other.fibres);
  other.where = "-(" + other.where + ")";
}

void RandomScene::add_initial_strain(const Frame &frame, Section &material) const
{
  using metamorphic::text;
  if (!temperature.empty())
    material.second.emplace_back("Thermal expansion", text(expansion));
  else if (has_initial_strain())
  {
    const auto &e = initial_strain;
    const Tensor<2, 2> turned =
        frame.amplitude * frame.Q * Tensor<2, 2>({{e[0], e[2]}, {e[2], e[1]}}) * transpose(frame.Q);
    material.second.emplace_back("Initial strain", text(turned[0][0]) + "; " + text(turned[1][1]) +
                                                       "; " + text(turned[0][1]));
  }
}

std::vector<Section> RandomScene::material_sections(const Frame &frame) const
{
  using metamorphic::text;
  if (materials.size() == 1 && frame.order % 2 == 1)
  {
    RandomScene other = *this;
    other.exchange_materials();
    Frame same = frame;
    same.order = 0;
    return other.material_sections(same);
  }
  std::vector<OtherMaterial> all = {{"", young, poisson, density, fibres}};
  all.insert(all.end(), materials.begin(), materials.end());
  std::vector<Section> result;
  for (const OtherMaterial &material : all)
  {
    const std::string number = std::to_string(result.size());
    Section section{result.empty() ? "Material" : "Material m" + number, {}};
    if (material.fibres)
      for (const auto &entry : entries(*material.fibres, material.young, frame))
        section.second.push_back(entry);
    else
    {
      section.second.emplace_back("Young's modulus", text(material.young * frame.stress));
      section.second.emplace_back("Poisson's ratio", text(material.poisson));
      if (!is_isotropic())
        section.second.emplace_back("Elasticity", "isotropic");
    }
    section.second.emplace_back("Density", text(material.density));
    if (result.empty())
    {
      add_initial_strain(frame, section);
      section.second.emplace_back("Plane", plane);
      section.second.emplace_back("Thickness", text(thickness * frame.thickness));
    }
    else
      section.second.emplace_back("Where", frame.function(material.where, 1));
    result.push_back(section);
  }
  return result;
}

std::string RandomScene::text(const Frame &frame) const
{
  using metamorphic::text;
  std::vector<Section> sections = material_sections(frame);
  sections.push_back(geometry(frame));
  Section forces{"Body force", {}};
  const auto add_force = [&](const std::string &entry, const std::array<std::string, 2> &components)
  {
    if (is_given(components))
      forces.second.emplace_back(
          entry,
          vector_text(components, frame, frame.amplitude * frame.stress / frame.length, "0"));
  };
  add_force("Expression", body_force);
  add_force("Gravity", gravity);
  sections.push_back(forces);
  if (!temperature.empty())
    sections.push_back(
        {"Temperature", {{"Expression", frame.function(temperature, frame.amplitude)}}});
  for (unsigned int k = 0; k < sides.size(); ++k)
    sections.push_back(boundary(k, frame));
  if (has_probe)
    sections.push_back(probe(frame));
  for (const auto &[path, value] : settings)
  {
    const std::string section = path.substr(0, path.find('/'));
    if (sections.back().first != section)
      sections.push_back({section, {}});
    sections.back().second.emplace_back(path.substr(path.find('/') + 1), value);
  }
  return written(sections, frame.order);
}
} // namespace metamorphic
