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
  explicit CurvedScene(std::mt19937 &random) : dice(random)
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

  Dice dice;
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
    return "  set Shape = ring sector\n  set Radii = " + radii +
           "\n  set Angles = " + metamorphic::text(begin) + ", " +
           metamorphic::text(begin + width) + "\n  set Subdivisions = 1, " +
           std::to_string((is_whole ? 9 : 3) + static_cast<unsigned int>(dice.number(0, 3))) + "\n";
  };
  const std::string gap = metamorphic::text(-deep) + " + " + dice.about(deep / 2) + "*x*y + " +
                          dice.about(deep / 2) + "*y^2";
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

std::string CurvedScene::text()
{
  out << "set Dimension = 2\n";
  if (dice.happens(0.5))
    discs();
  else
    rings();
  section("Material", "  set Plane = " + dice.chosen({"stress", "strain"}) + "\n");
  section("Adaptivity", "  set Method = " + dice.chosen({"hup2", "hap2", "hpa2", "hpa3"}) +
                            "\n  set Start degree = " + dice.chosen({"7", "8", "9"}) +
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
  return CurvedScene(random).text();
}
} // namespace attack
