// SPDX-License-Identifier: LGPL-2.1-or-later
#include "curved_scene.h"

#include "../metamorphic/dice.h"

#include <sstream>

namespace attack
{
using namespace metamorphic;

namespace
{
class CurvedScene
{
public:
  CurvedScene(std::mt19937 &random, const bool is_turned) : dice(random), is_turned(is_turned)
  {
    out.precision(17);
  }

  std::string text();

private:
  void section(const std::string &name, const std::string &entries);
  void material(const std::string &name);
  void press(const std::string &section_name, const std::string &between, const std::string &gap,
             double scale);
  void discs();
  void rings();
  void tubes();

  Dice dice;
  const bool is_turned; ///< around an axis
  std::ostringstream out;
  double soft = 1;
};

void CurvedScene::section(const std::string &name, const std::string &entries)
{
  out << "subsection " << name << '\n' << entries << "end\n";
}

void CurvedScene::material(const std::string &name)
{
  const double young = std::pow(10, dice.number(-1, 1));
  soft = std::min(soft, young);
  section("Material " + name,
          "  set Young's modulus = " + metamorphic::text(young) +
              "\n  set Poisson's ratio = " + metamorphic::text(dice.number(0, 0.4)) + "\n");
}

/** Contact of a boundary or a pair, the deformation being of the size @p scale. */
void CurvedScene::press(const std::string &section_name, const std::string &between,
                        const std::string &gap, const double scale)
{
  std::string entries = between.empty() ? "" : "  set Between = " + between + "\n";
  entries += std::string("  set ") + (between.empty() ? "Contact" : "Law") +
             " = unilateral\n  set Gap = " + gap + "\n";
  if (dice.happens(0.6))
    entries +=
        "  set Friction bound = " + metamorphic::text(soft * scale * dice.number(0.02, 0.3)) +
        (dice.happens(0.3) ? "*(1.2 + sin(x + y))" : "") + "\n";
  section(section_name, entries);
}

/** A disc that is pressed down by its flat side. */
void CurvedScene::discs()
{
  const double down = dice.number(0.005, 0.04);
  const std::string
      disc = "  set Shape = half disc\n  set Centre = 0, 1\n  set Radius = 1\n  set Angle = 180\n",
      move = "  set Displacement = " + (dice.happens(0.5) ? "0" : dice.about(down)) + "; " +
             metamorphic::text(-down) + "\n";
  if (dice.happens(0.3))
  {
    section("Geometry", disc);
    section("Boundary flat", move);
    section("Boundary rim", "  set On = arc\n  set Where = 0.29289 - y\n");
    press("Boundary rim", "", "y/(1 - y) + " + metamorphic::text(dice.number(0, down / 2)), down);
    section("Material", "  set Young's modulus = 1\n  set Poisson's ratio = 0.3\n");
    return;
  }
  section("Body disc", disc + "  set Material = a\n");
  material("a");
  material("b");
  section("Boundary disc.flat", move);
  const bool is_disc = dice.happens(0.4);
  if (is_disc)
    section("Body below",
            "  set Shape = half disc\n  set Centre = 0, -20\n  set Radius = 20\n  set "
            "Angle = 0\n  set Graded towards = 0, 0\n  set Grading levels = 4\n  set "
            "Material = b\n");
  else
    section("Body below", "  set Lower corner = -2, -1\n  set Upper corner = 2, 0\n  set "
                          "Subdivisions = " +
                              dice.chosen({"4", "5", "8"}) + ", 2\n  set Material = b\n");
  section(is_disc ? "Boundary below.flat" : "Boundary below.bottom", "  set Displacement = 0; 0\n");
  const std::string below = is_disc ? "below.arc" : "below.top";
  press("Contact line", dice.happens(0.5) ? "disc.arc, " + below : below + ", disc.arc",
        metamorphic::text(dice.number(-down / 2, down / 2)), down);
}

/** A quarter between planes of symmetry, or a whole ring that is held around. */
void CurvedScene::rings()
{
  const bool is_whole = dice.happens(0.3), is_pair = dice.happens(0.7);
  const double deep = dice.number(0.005, 0.04), begin = is_whole ? 0. : dice.number(-180, 180),
               width = is_whole ? 360. : dice.number(60, 120);
  const auto ring = [&](const std::string &radii)
  {
    return std::string("  set Shape = ring sector\n") + (is_turned ? "  set Centre = 3, 0\n" : "") +
           "  set Radii = " + radii + "\n  set Angles = " + metamorphic::text(begin) + ", " +
           metamorphic::text(begin + width) + "\n  set Subdivisions = 1, " +
           std::to_string((is_whole ? 9 : 3) + static_cast<unsigned int>(dice.number(0, 3))) + "\n";
  };
  const std::string x = is_turned ? "(x - 3)" : "x", gap = metamorphic::text(-deep) + " + " +
                                                           dice.about(deep / 2) + "*" + x +
                                                           "*y + " + dice.about(deep / 2) + "*y^2";
  const auto hold = [&](const std::string &body)
  {
    for (const char *const end : {"start", "end"})
      if (!is_whole)
        section("Boundary " + body + end, "  set Symmetry = true\n");
  };
  if (!is_pair)
  {
    section("Geometry", ring("0.6, 1"));
    section("Material", "  set Young's modulus = 1\n  set Poisson's ratio = 0.3\n");
    hold("");
    section("Boundary inner", is_whole ? "  set Spring = 0.1; 0.1\n"
                                       : "  set Pressure = " + metamorphic::text(deep) + "\n");
    press("Boundary outer", "", gap, deep);
    return;
  }
  section("Body in", ring("0.6, 1") + "  set Material = a\n");
  section("Body out", ring("1, 1.5") + "  set Material = b\n");
  material("a");
  material("b");
  hold("in.");
  hold("out.");
  if (is_whole)
  {
    section("Boundary in.inner", "  set Spring = 0.01; 0.01\n");
    section("Boundary out.outer", "  set Displacement = 0; 0\n");
  }
  press("Contact fit", dice.happens(0.5) ? "in.outer, out.inner" : "out.inner, in.outer", gap,
        deep);
}

/** Straight or conical, the inner one solid or not, with any law between them. */
void CurvedScene::tubes()
{
  const bool is_solid = dice.happens(0.4);
  const double deep = dice.number(0.005, 0.04), r = is_solid ? 0. : dice.number(0.1, 2),
               cone = dice.number(-0.3, 0.3);
  const auto at = [](const double x, const double y)
  { return metamorphic::text(x) + ", " + metamorphic::text(y); };
  const auto tube = [&](const std::string &corners, const std::string &material_name)
  {
    return "  set Shape = quadrilateral\n  set Corners = " + corners + "\n  set Subdivisions = " +
           (is_solid ? dice.chosen({"2, 2", "2, 3"}) : dice.chosen({"1, 2", "2, 2", "1, 3"})) +
           "\n  set Material = " + material_name + "\n";
  };
  const auto wall = [&](const double y) { return at(r + 1 + cone * (y - 0.5), y); };
  section("Body in", tube(at(r, 0) + "; " + wall(0) + "; " + wall(1) + "; " + at(r, 1), "a"));
  const double low = dice.number(-0.4, 0), high = dice.number(1, 1.4);
  section(
      "Body out",
      tube(wall(low) + "; " + at(r + 2, low) + "; " + at(r + 2, high) + "; " + wall(high), "b"));
  material("a");
  material("b");
  section("Boundary out.bottom", "  set Displacement = free; 0\n");
  section(is_solid ? "Boundary in.top" : "Boundary in.left",
          "  set Pressure = " + metamorphic::text(soft * deep * dice.number(-0.3, 1)) +
              (is_solid ? "*(1 + x^2)\n" : "*(1 + y^2)\n"));
  section("Boundary in.bottom",
          dice.happens(0.5) ? "  set Spring = 0.2; 0.1\n" : "  set Displacement = free; 0\n");
  if (dice.happens(0.4))
    section("Body force",
            "  set Expression = " + dice.about(soft * deep) + "*y; " + dice.about(soft * deep) +
                (is_solid ? "" : "*exp(x - " + metamorphic::text(r + 1) + ")") + "\n");
  const std::string between = dice.happens(0.5) ? "in.right, out.left" : "out.left, in.right";
  if (dice.happens(0.3))
    section("Contact fit", "  set Between = " + between + "\n  set Law = tied\n");
  else
    press("Contact fit", between, metamorphic::text(-deep) + " + " + dice.about(deep) + "*y^2",
          deep);
}

std::string CurvedScene::text()
{
  out << "set Dimension = 2\n";
  const bool is_first = dice.happens(0.5);
  if (is_first && is_turned)
    tubes();
  else if (is_first)
    discs();
  else
    rings();
  section("Material", "  set Plane = " +
                          (is_turned ? "axisymmetric" : dice.chosen({"stress", "strain"})) + "\n");
  section("Adaptivity", "  set Method = " + dice.chosen({"hup2", "hap2", "hpa2", "hpa3"}) +
                            "\n  set Start degree = " +
                            (is_turned && is_first ? dice.chosen({"2", "3", "5"})
                                                   : dice.chosen({"7", "8", "9"})) +
                            "\n  set Indicator = " + dice.chosen({"residual", "bound"}) +
                            "\n  set Maximum steps = " + dice.chosen({"1", "2", "4"}) +
                            "\n  set Maximum unknowns = 4000\n");
  section("Error", "  set Bound = true\n");
  section("Output", "  set VTU = false\n");
  return out.str();
}
} // namespace

std::string curved_scene(std::mt19937 &random)
{
  return CurvedScene(random, /*is_turned=*/false).text();
}

std::string turned_scene(std::mt19937 &random)
{
  return CurvedScene(random, /*is_turned=*/true).text();
}
} // namespace attack
