// SPDX-License-Identifier: LGPL-2.1-or-later
#include "touching_scene.h"

#include "../metamorphic/dice.h"

#include <array>
#include <sstream>

namespace attack
{
using namespace metamorphic;

namespace
{
/** A box in the frame of the scene, cut into equal cells. */
struct Box
{
  std::array<double, 2> lower, upper;
  std::array<unsigned int, 2> cells;
  unsigned int first_corner = 0; ///< in the order in which the file lists them
  double young = 1;
};

class TouchingScene
{
public:
  TouchingScene(std::mt19937 &random, const bool matches)
      : random(random), dice(random), matches(matches),
        angle(dice.happens(0.3) ? 0. : dice.number(-3, 3))
  {
    boxes.push_back(
        {{{0, -0.8}}, {{2, 0}}, {{4, 1 + static_cast<unsigned int>(dice.number(0, 2))}}});
    const unsigned int n = dice.happens(0.3) ? 3 : 2;
    while (boxes.size() < n)
      add_box();
    for (Box &box : boxes)
    {
      box.young = std::pow(10, dice.number(-1.5, 1.5));
      box.first_corner = static_cast<unsigned int>(dice.number(0, 4));
    }
  }

  std::string text();

private:
  void add_box();
  void write_body(unsigned int b);
  void write_joint(unsigned int above);
  void write_sides();
  std::string side(unsigned int b, unsigned int place) const;
  std::string place(double x, double y) const;
  std::string in_frame(std::string expression) const;
  std::string vector(const std::string &x, const std::string &y) const;

  std::mt19937 &random;
  Dice dice;
  const bool matches;
  const double angle;
  std::vector<Box> boxes;
  std::ostringstream out;
};

/** Upon the last one, over some of its cells, which it halves, doubles or takes over. */
void TouchingScene::add_box()
{
  const Box &below = boxes.back();
  const double step = (below.upper[0] - below.lower[0]) / below.cells[0];
  const unsigned int last = below.cells[0] - 1,
                     from = dice.happens(0.4) ? 0 : static_cast<unsigned int>(dice.number(0, last)),
                     to = dice.happens(0.4)
                              ? below.cells[0]
                              : from + 1 +
                                    static_cast<unsigned int>(dice.number(0, last + 1. - from));
  const unsigned int n = to - from;
  Box box{{{below.lower[0] + from * step, below.upper[1]}},
          {{below.lower[0] + to * step, below.upper[1] + dice.number(0.3, 1)}},
          {{n, 1 + static_cast<unsigned int>(dice.number(0, 2))}}};
  if (dice.happens(0.2))
    box.cells[0] = 2 * n;
  else if (n % 2 == 0 && dice.happens(0.3))
    box.cells[0] = n / 2;
  if (!matches)
  {
    box.cells[0] = 1 + static_cast<unsigned int>(dice.number(0, 7));
    for (double *const end : {&box.lower[0], &box.upper[0]})
      if (dice.happens(0.5))
        *end += (end == &box.lower[0] ? 1 : -1) * dice.number(0.01, 0.45) * step;
  }
  boxes.push_back(box);
}

std::string TouchingScene::place(const double x, const double y) const
{
  return metamorphic::text(std::cos(angle) * x - std::sin(angle) * y) + ", " +
         metamorphic::text(std::sin(angle) * x + std::cos(angle) * y);
}

/** Of X and Y, the coordinates of the boxes. */
std::string TouchingScene::in_frame(std::string expression) const
{
  const std::string c = metamorphic::text(std::cos(angle)), s = metamorphic::text(std::sin(angle));
  const std::array<std::string, 2> values{
      {"(" + c + "*x + (" + s + ")*y)", "(" + c + "*y - (" + s + ")*x)"}};
  std::string result;
  for (const char letter : expression)
    result += letter == 'X' ? values[0] : letter == 'Y' ? values[1] : std::string(1, letter);
  return result;
}

/** Components along x and y of one with components along the sides of the boxes. */
std::string TouchingScene::vector(const std::string &x, const std::string &y) const
{
  const std::string c = metamorphic::text(std::cos(angle)), s = metamorphic::text(std::sin(angle));
  return in_frame("(" + c + ")*(" + x + ") - (" + s + ")*(" + y + "); (" + s + ")*(" + x + ") + (" +
                  c + ")*(" + y + ")");
}

/** 0 below, 1 to the right, 2 above, 3 to the left. */
std::string TouchingScene::side(const unsigned int b, const unsigned int place) const
{
  static const std::array<std::string, 4> names{{"bottom", "right", "top", "left"}};
  return "b" + std::to_string(b) + "." + names[(place + 4 - boxes[b].first_corner) % 4];
}

void TouchingScene::write_body(const unsigned int b)
{
  const Box &box = boxes[b];
  const std::array<std::string, 4> corners{
      {place(box.lower[0], box.lower[1]), place(box.upper[0], box.lower[1]),
       place(box.upper[0], box.upper[1]), place(box.lower[0], box.upper[1])}};
  out << "subsection Body b" << b << "\n  set Shape = quadrilateral\n  set Corners = ";
  for (unsigned int k = 0; k < 4; ++k)
    out << (k == 0 ? "" : "; ") << corners[(k + box.first_corner) % 4];
  const bool is_turned = box.first_corner % 2;
  out << "\n  set Subdivisions = " << box.cells[is_turned] << ", " << box.cells[!is_turned]
      << "\n  set Material = m" << b << "\nend\n";
  out << "subsection Material m" << b << "\n  set Young's modulus = " << box.young
      << "\n  set Poisson's ratio = " << dice.number(0, 0.45) << "\nend\n";
}

void TouchingScene::write_joint(const unsigned int above)
{
  std::array<std::string, 2> sides{{side(above, 0), side(above - 1, 2)}};
  if (dice.happens(0.5))
    std::swap(sides[0], sides[1]);
  const double soft = std::min(boxes[above].young, boxes[above - 1].young);
  const std::string law =
      dice.chosen({"unilateral", "unilateral", "bilateral", "tied", "tangential"});
  // Without friction what contact alone holds would be free.
  const bool rubs = boxes.size() > 2 || law == "tangential" || dice.happens(0.6);
  out << "subsection Contact c" << above << "\n  set Between = " << sides[0] << ", " << sides[1]
      << "\n  set Law = " << law << '\n';
  if (law != "tied" && rubs)
    out << "  set Friction bound = "
        << in_frame(dice.happens(0.6) ? metamorphic::text(soft * dice.number(0.001, 0.02))
                                      : dice.positive(0.02 * soft))
        << '\n';
  if (law == "unilateral" && dice.happens(0.5))
    out << "  set Gap = "
        << in_frame(dice.about(0.01) + " + " + metamorphic::text(dice.number(0, 0.03)) + "*(X - " +
                    metamorphic::text(dice.number(0, 2)) + ")^2")
        << '\n';
  out << "end\n";
}

void TouchingScene::write_sides()
{
  const unsigned int last = boxes.size() - 1;
  out << "subsection Boundary " << side(0, 0) << "\n  set Displacement = 0; 0\nend\n"
      << "subsection Boundary " << side(last, 2) << "\n  set Displacement = "
      << vector(dice.about(0.03), metamorphic::text(-dice.number(0.002, 0.03)) +
                                      (dice.happens(0.3) ? " + " + dice.about(0.01) + "*X" : ""))
      << "\nend\n";
  for (unsigned int b = 0; b <= last; ++b)
    for (const unsigned int place : {1, 3})
      if (dice.happens(0.3))
        out << "subsection Boundary " << side(b, place) << "\n  set Traction = "
            << vector(dice.function(0.01 * boxes[b].young), dice.function(0.01 * boxes[b].young))
            << "\nend\n";
}

std::string TouchingScene::text()
{
  out.precision(17);
  out << "set Dimension = 2\n";
  for (unsigned int b = 0; b < boxes.size(); ++b)
    write_body(b);
  for (unsigned int b = 1; b < boxes.size(); ++b)
    write_joint(b);
  write_sides();
  out << "subsection Material\n  set Plane = " << dice.chosen({"stress", "strain"}) << "\nend\n";
  if (dice.happens(0.2))
    out << "subsection Body force\n  set Expression = "
        << vector(dice.function(0.02), dice.function(0.02)) << "\nend\n";
  out << "subsection Adaptivity\n  set Method = "
      << dice.chosen({"hup2", "hup3", "hap2", "hap3", "hap4", "pu", "hpa1", "hpa2", "hpa3"})
      << "\n  set Indicator = " << dice.chosen({"residual", "bound"})
      << "\n  set Maximum steps = " << dice.chosen({"2", "4", "6"})
      << "\n  set Maximum unknowns = 1500\nend\n"
      << "subsection Error\n  set Bound = true\nend\n"
      << "subsection Output\n  set VTU = false\nend\n";
  if (dice.happens(0.5))
  {
    const unsigned int b = static_cast<unsigned int>(dice.number(0, boxes.size()));
    const Box &box = boxes[b];
    out << "subsection Probe attacked\n  set ";
    if (dice.happens(0.5))
      out << "On = " << side(b, static_cast<unsigned int>(dice.number(0, 4)));
    else
      out << "At = " << place((box.lower[0] + box.upper[0]) / 2, (box.lower[1] + box.upper[1]) / 2)
          << "\n  set Size = "
          << 0.2 * std::min(box.upper[0] - box.lower[0], box.upper[1] - box.lower[1]);
    out << "\nend\n";
  }
  return out.str();
}
} // namespace

std::string touching_scene(std::mt19937 &random, const bool matches)
{
  return TouchingScene(random, matches).text();
}
} // namespace attack
