// SPDX-License-Identifier: LGPL-2.1-or-later
#include "box_scene.h"

#include "../metamorphic/dice.h"

#include <array>
#include <sstream>
#include <vector>

namespace attack
{
using namespace metamorphic;

namespace
{
constexpr std::array<const char *, 6> sides{{"left", "right", "bottom", "top", "front", "back"}};

class Box
{
public:
  explicit Box(std::mt19937 &random) : dice(random)
  {
    for (unsigned int d = 0; d < 3; ++d)
    {
      cells[d] = 1 + static_cast<unsigned int>(dice.number(0, 3));
      size[d] = cells[d] * std::pow(3, dice.number(-0.5, 0.5));
    }
    young = std::pow(10, dice.number(-1, 3));
  }

  std::string text();

private:
  std::string function(double magnitude);
  std::string positive(double magnitude);
  std::string three(double magnitude, double probability);
  void materials(std::ostream &out);
  void contact(std::ostream &out);
  void other_sides(std::ostream &out);

  std::string own(const unsigned int d) const
  {
    return "(" + std::string(1, "xyz"[d]) + "/" + metamorphic::text(size[d]) + ")";
  }

  std::string own()
  {
    return own(static_cast<unsigned int>(dice.number(0, 3)));
  }

  Dice dice;
  std::array<unsigned int, 3> cells{};
  std::array<double, 3> size{};
  double young;
};

std::string Box::function(const double magnitude)
{
  const std::string v = own(), w = own();
  switch (static_cast<unsigned int>(dice.number(0, 4)))
  {
  case 0:
    return dice.about(magnitude);
  case 1:
    return dice.about(magnitude) + "*" + v + "*" + w + " + " + dice.about(magnitude);
  case 2:
    return dice.about(magnitude) + "*cos(3*" + v + ") + " + dice.about(magnitude) + "*" + w;
  default:
    return dice.about(magnitude) + "*exp(-((" + v + " - 0.4)/0.3)^2)";
  }
}

std::string Box::positive(const double magnitude)
{
  const std::string largest = metamorphic::text(magnitude * dice.number(0.1, 1)), v = own();
  return dice.happens(0.5)   ? largest
         : dice.happens(0.5) ? largest + "*(0.2 + " + v + "^2)"
                             : largest + "*max(0, 1 - " + v + ")";
}

std::string Box::three(const double magnitude, const double probability)
{
  std::string result;
  for (unsigned int c = 0; c < 3; ++c)
    result += (c == 0 ? "" : "; ") + (dice.happens(probability) ? function(magnitude) : "0");
  return result;
}

void Box::materials(std::ostream &out)
{
  const auto constants = [&](const double factor)
  {
    out << "  set Young's modulus = " << young * factor
        << "\n  set Poisson's ratio = " << (dice.happens(0.1) ? 0.4999 : dice.number(0, 0.45))
        << "\nend\n";
  };
  out << "subsection Material\n";
  constants(1);
  if (cells[0] == 1 || dice.happens(0.7))
    return;
  out << "subsection Material other\n  set Where = " << metamorphic::text(size[0] / cells[0])
      << " - x\n";
  constants(std::pow(10, dice.number(-3, 3)));
}

void Box::contact(std::ostream &out)
{
  out << "subsection Boundary bottom\n";
  const bool opens = dice.happens(0.6);
  if (dice.happens(0.8))
  {
    out << "  set Contact = " << (opens ? "unilateral" : "bilateral") << "\n";
    if (opens && dice.happens(0.7))
      out << "  set Gap = " << positive(0.02) << " + " << function(0.005) << "\n";
    if (opens && dice.happens(0.5))
      out << "  set Friction coefficient = " << positive(1.2) << "\n";
    else if (!opens || dice.happens(0.6))
      out << "  set Friction bound = " << positive(0.02 * young) << "\n";
  }
  out << "end\n";
}

void Box::other_sides(std::ostream &out)
{
  for (unsigned int side = 0; side < sides.size(); ++side)
  {
    if (side == 2)
      continue;
    out << "subsection Boundary " << sides[side] << "\n";
    if (side == 3)
    {
      out << "  set Displacement = ";
      for (unsigned int c = 0; c < 3; ++c)
        out << (c == 0 ? "" : "; ")
            << (c == 1 ? metamorphic::text(-0.03 * dice.number(0, 1)) : dice.about(0.01));
      out << "\n";
    }
    else if (dice.happens(0.5))
      out << "  set Traction = " << three(0.02 * young, 0.6) << "\n";
    out << "end\n";
  }
}

std::string Box::text()
{
  std::ostringstream out;
  out << "set Dimension = 3\nsubsection Geometry\n  set Lower corner = 0, 0, 0\n  set Upper corner "
         "= "
      << metamorphic::text(size[0]) << ", " << metamorphic::text(size[1]) << ", "
      << metamorphic::text(size[2]) << "\n  set Subdivisions = " << cells[0] << ", " << cells[1]
      << ", " << cells[2] << "\nend\n";
  materials(out);
  contact(out);
  other_sides(out);
  out << "subsection Body force\n  set Expression = " << three(0.02 * young, 0.6) << "\nend\n";
  out << "subsection Adaptivity\n  set Method = "
      << dice.chosen({"hup2", "hap2", "hap2", "hap3", "hup3"})
      << "\n  set Maximum steps = 2\n  set Maximum unknowns = 1500\nend\nsubsection Error\n"
         "  set Bound = true\nend\n";
  return out.str();
}
} // namespace

std::string box_scene(std::mt19937 &random)
{
  return Box(random).text();
}
} // namespace attack
