// SPDX-License-Identifier: LGPL-2.1-or-later
#include "rough_scene.h"

#include "../metamorphic/dice.h"

namespace attack
{
using namespace metamorphic;

namespace
{
/** A function of X or Y with values in [0,1]: narrow, or it oscillates. */
std::string smooth(const std::string &v, Dice &dice)
{
  const std::string a = text(dice.number(0, 1)), width = text(std::pow(10, dice.number(-1.5, 0))),
                    waves = text(std::pow(10, dice.number(0, 1.3)));
  return dice.happens(0.5) ? "exp(-((" + v + " - " + a + ")/" + width + ")^2)"
                           : "(0.5 + 0.5*sin(" + waves + "*" + v + " + " + a + "))";
}

/** One that may also jump or bend. */
std::string rough(const std::string &v, Dice &dice)
{
  const std::string a = text(dice.number(0, 1)), b = text(dice.number(0, 1)),
                    width = text(std::pow(
                        10, dice.number(-2, -0.5))); // what is narrower may be missed inside
  switch (static_cast<unsigned int>(dice.number(0, 8)))
  {
  case 0:
    return "if(" + v + " < " + a + ", " + b + ", 1)";
  case 1:
    return "if(abs(" + v + " - " + a + ") < " + width + ", 1, 0)";
  case 2:
    return "max(0, 1 - abs(" + v + " - " + a + ")/" + width + ")";
  case 3:
    return "abs(" + v + " - " + a + ")";
  default:
    return smooth(v, dice);
  }
}

/** As a load: its sign may change. */
std::string load(const double magnitude, const std::string &v, Dice &dice)
{
  const std::string whole = dice.happens(0.5) ? dice.about(magnitude) + " + " : "";
  return whole + dice.about(magnitude) + "*" + rough(v, dice);
}

/** Long and skew, in few cells. */
void stretch(RandomScene &scene, Dice &dice)
{
  const bool is_long = dice.happens(0.3), is_skew = dice.happens(0.3);
  const double thickness = is_long ? std::pow(10, dice.number(-2, 0)) : 1;
  for (unsigned int k = 0; k < 4; ++k)
    scene.corners[k][1] *= thickness;
  if (!is_skew)
    return;
  const double shear = dice.number(-1.5, 1.5) * scene.corners[3][1];
  for (const unsigned int k : {2, 3})
    scene.corners[k][0] += shear;
  scene.is_box = false;
}

/** Tresca's; or Coulomb's on contact that opens. */
void choose_friction(RandomScene &scene, const bool is_coulomb, Dice &dice)
{
  for (Side &side : scene.sides)
    if (is_coulomb && !side.contact.empty())
    {
      side.contact = "unilateral";
      side.law.clear();
      side.bound.clear();
      side.coefficient = text(std::pow(10, dice.number(-1.5, 0)));
    }
    else if (!side.coefficient.empty())
    {
      side.coefficient.clear();
      side.bound = dice.positive(0.02 * scene.young);
    }
}

/** None that would leave the scene without a bound, or with another one for each load step: one load step, no bend in a gap. */
void simplify(RandomScene &scene, Dice &dice)
{
  for (const char *const entry : {"Loading/Steps", "Loading/Adapt"})
    scene.settings.erase(entry);
  for (Side &side : scene.sides)
    if (side.turn) // what is left is the normal, written down
      side.turn = 0.;
  const std::string in_time = "*sin(4*t)";
  for (Side &side : scene.sides)
    for (std::string *component : {&side.displacement[0], &side.displacement[1], &side.traction[0],
                                   &side.traction[1], &side.pressure, &side.shear})
      if (const std::size_t place = component->rfind(in_time); place != std::string::npos)
        component->erase(place, in_time.size());
  for (Side &side : scene.sides)
    if (side.gap.find("if(") != std::string::npos || side.gap.find("max(") != std::string::npos)
      side.gap = dice.about(0.02);
}

void roughen(RandomScene &scene, Dice &dice)
{
  for (unsigned int k = 0; k < 4; ++k)
  {
    Side &side = scene.sides[k];
    const std::string v = k % 2 == 0 ? "X" : "Y";
    for (std::string &component : side.traction)
      if (!component.empty() && dice.happens(0.5))
        component = load(0.02 * scene.young, v, dice);
    for (std::string &component : side.displacement)
      if (!component.empty() && dice.happens(0.3)) // zero at the corners, which other sides share
        component = "(" + component + ") + " + dice.about(std::pow(10, dice.number(-6, -2))) + "*" +
                    v + "*(1 - " + v + ")*" + smooth(v, dice);
    if (!side.gap.empty() && dice.happens(0.4))
      side.gap = "(" + side.gap + ") + " + dice.about(std::pow(10, dice.number(-6, -2))) + "*" +
                 smooth(v, dice);
    if (!side.bound.empty() && dice.happens(0.4))
      side.bound = text(0.02 * scene.young) + "*" + rough(v, dice);
  }
  if (dice.happens(0.2))
    scene.body_force = {{load(0.02 * scene.young, dice.chosen({"X", "Y"}), dice),
                         load(0.02 * scene.young, dice.chosen({"X", "Y"}), dice)}};
}

void choose_method(RandomScene &scene, Dice &dice)
{
  auto &settings = scene.settings;
  settings["Adaptivity/Method"] =
      dice.chosen({"hup2", "hup3", "hup4", "hap2", "hap3", "hap4", "pu", "hpa1", "hpa2", "hpa3"});
  settings["Adaptivity/Indicator"] = dice.chosen({"residual", "bound"});
  settings["Adaptivity/Maximum steps"] = dice.chosen({"2", "4", "6"});
  settings["Adaptivity/Maximum unknowns"] = "1500";
  settings["Error/Bound"] = "true";
  settings["Solver/Normal contact"] =
      scene.has(&Side::coefficient) ? "multiplier" : dice.chosen({"nodes", "multiplier"});
  if (dice.happens(0.1))
  {
    scene.poisson = 0.4999;
    scene.plane = "strain";
  }
}

/** Up to ten thousand times as stiff in one direction as in another; @p random is a copy. */
void stiffen(RandomScene &scene, std::mt19937 random)
{
  std::mt19937 own(random() + 1);
  if (scene.fibres)
    scene.fibres = random_fibres(1e4, own);
  for (OtherMaterial &other : scene.materials)
    if (other.fibres)
      other.fibres = random_fibres(1e4, own);
}
} // namespace

std::string rough_scene(std::mt19937 &random, const bool is_coulomb)
{
  RandomScene scene(random);
  stiffen(scene, random);
  Dice dice(random);
  stretch(scene, dice);
  choose_friction(scene, is_coulomb, dice);
  simplify(scene, dice);
  roughen(scene, dice);
  choose_method(scene, dice);
  return scene.text(scene.own_frame());
}
} // namespace attack
