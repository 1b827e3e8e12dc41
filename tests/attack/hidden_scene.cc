// SPDX-License-Identifier: LGPL-2.1-or-later
#include "hidden_scene.h"

#include "../metamorphic/dice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <sstream>
#include <utility>

namespace attack
{
using namespace metamorphic;

namespace
{
using Entries = std::vector<std::pair<std::string, std::string>>;
using Section = std::pair<std::string, Entries>;

enum Place : unsigned int
{
  bottom,
  right,
  top,
  left
};

const std::array<std::string, 4> names{{"bottom", "right", "top", "left"}};

/** Equal boxes of width 1 in columns and rows, in any frame; X and Y are coordinates along them. */
class Patchwork
{
public:
  Patchwork(const std::string &kind, std::mt19937 &random);

  DrawnScene told() const
  {
    const bool are_apart = n_blocks(0, true) == n_bodies[0] && n_blocks(1, true) == n_bodies[1];
    return {text(false), text(true), finer == cells && are_apart};
  }

private:
  /** A short part of a side. */
  struct Spot
  {
    double centre, half_width;
  };

  void draw_strips();
  void draw_springs();
  void draw_gaps();
  void draw_falls();
  void draw_joints();
  void draw_vertex();
  void draw_plates();
  void draw_method();

  void resize(unsigned int columns, unsigned int rows);
  void add(Place place, const std::string &entry, const std::string &value);
  void hold(Place place, const std::string &x, const std::string &y);
  void load(Place place, double magnitude);
  void join(unsigned int d, const std::vector<std::string> &laws);
  void choose_probe();
  std::string smooth_and(const std::string &hidden, double magnitude);
  std::string strip(unsigned int d, double value);
  Spot spot(unsigned int d, double from, double to, double offset);
  static std::string inside(unsigned int d, const Spot &spot, double value);
  void set_contact(const std::string &law, const Entries &contact);
  std::string pad(double stress);

  std::string text(bool is_reference) const;
  std::vector<Section> bodies(bool is_reference) const;
  std::vector<Section> boundaries(bool is_reference) const;
  unsigned int n_blocks(unsigned int d, bool is_reference) const;
  std::string block(unsigned int column, unsigned int row, bool is_reference) const;
  std::string point(double x, double y) const;
  std::string between(unsigned int d, unsigned int from, unsigned int to) const;
  std::string in_frame(const std::string &expression) const;
  std::string vector(const std::string &x, const std::string &y) const;

  Dice dice;
  double angle = 0, height = 1, young = 1;
  std::array<unsigned int, 2> n_bodies{}, cells{}, finer{}; ///< of each body; in the reference
  std::array<bool, 2> is_joined{
      {true, true}};                         ///< are tied bodies along X or Y one in the reference?
  std::array<std::vector<Entries>, 4> sides; ///< of each body there
  std::array<std::vector<std::vector<Entries>>, 2>
      joints;                    ///< across X or Y: of each line of joints those along it
  std::vector<Section> sections; ///< that are the same in both
  std::vector<std::array<double, 2>> graded; ///< towards these points, in the reference
  unsigned int levels = 0;
  std::vector<std::string> methods{"hup2", "hup3", "hap2", "hap3", "hap4",
                                   "pu",   "hpa1", "hpa2", "hpa3"},
      n_steps{"2", "4", "8"};
  std::string most_unknowns = "1500";
};

Patchwork::Patchwork(const std::string &kind, std::mt19937 &random)
    : dice(random), angle(dice.happens(0.5) ? 0. : dice.number(-3, 3)),
      height(dice.happens(0.5) ? 1. : dice.number(0.4, 1.5)),
      young(dice.happens(0.5) ? 1. : std::pow(10, dice.number(-1, 2)))
{
  const std::map<std::string, void (Patchwork::*)()> draw{
      {"strips", &Patchwork::draw_strips}, {"springs", &Patchwork::draw_springs},
      {"gaps", &Patchwork::draw_gaps},     {"falls", &Patchwork::draw_falls},
      {"joints", &Patchwork::draw_joints}, {"vertex", &Patchwork::draw_vertex},
      {"plates", &Patchwork::draw_plates}};
  sections.push_back({"Material",
                      {{"Young's modulus", metamorphic::text(young)},
                       {"Poisson's ratio", metamorphic::text(dice.number(0, 0.45))},
                       {"Plane", dice.chosen({"stress", "strain"})}}});
  (this->*draw.at(kind))();
  choose_probe();
  draw_method();
}

// ---------------------------------------------------------------- what is drawn

/** So many columns and rows of bodies, whose cells the reference halves. */
void Patchwork::resize(const unsigned int columns, const unsigned int rows)
{
  n_bodies = {{columns, rows}};
  for (unsigned int d = 0; d < 2; ++d)
  {
    cells[d] = dice.happens(0.5) ? 1 : 1 + static_cast<unsigned int>(dice.number(0, 3));
    finer[d] = 2 * cells[d];
    joints[d].assign(n_bodies[d] - 1, std::vector<Entries>(n_bodies[1 - d]));
    sides[d].resize(n_bodies[d]);
    sides[d + 2].resize(n_bodies[d]);
  }
}

void Patchwork::add(const Place place, const std::string &entry, const std::string &value)
{
  for (Entries &side : sides[place])
    side.emplace_back(entry, value);
}

void Patchwork::hold(const Place place, const std::string &x, const std::string &y)
{
  add(place, "Displacement", vector(x, y));
}

void Patchwork::load(const Place place, const double magnitude)
{
  add(place, "Traction",
      vector(dice.function(magnitude * young), dice.function(magnitude * young)));
}

/** One of the laws for each line of joints across direction @p d; where all are tied the bodies are one in the reference. */
void Patchwork::join(const unsigned int d, const std::vector<std::string> &laws)
{
  for (auto &line : joints[d])
  {
    const bool is_alike = line.size() == 1 || dice.happens(0.7);
    is_joined[1 - d] = is_joined[1 - d] && is_alike;
    for (Entries &joint : line)
      if (is_alike && &joint != &line.front())
        joint = line.front();
      else
      {
        const std::string law = dice.chosen(laws);
        joint = {{"Law", law}};
        if (law == "tangential" || (law != "tied" && dice.happens(0.3)))
          joint.emplace_back("Friction bound",
                             metamorphic::text(young * std::pow(10, dice.number(-4, -2))));
        is_joined[d] = is_joined[d] && law == "tied";
      }
  }
}

/** The mean over a disc somewhere, or over a side of a single body. */
void Patchwork::choose_probe()
{
  if (n_bodies[0] * n_bodies[1] == 1 && dice.happens(0.7))
    sections.push_back(
        {"Probe attacked", {{"On", names[static_cast<unsigned int>(dice.number(0, 4))]}}});
  else
  {
    const auto middle = [&](const unsigned int d)
    { return static_cast<unsigned int>(dice.number(0, n_bodies[d])) + dice.number(0.3, 0.7); };
    const double x = middle(0), y = height * middle(1);
    sections.push_back(
        {"Probe attacked",
         {{"At", point(x, y)},
          {"Size", metamorphic::text(dice.number(0.05, 0.3) * std::min(1., height))}}});
  }
}

/** What is hidden, now and then beside what is not. */
std::string Patchwork::smooth_and(const std::string &hidden, const double magnitude)
{
  return dice.happens(0.3) ? metamorphic::text(magnitude * dice.number(0, 1)) + "*(1 + X + " +
                                 metamorphic::text(1 / height) + "*Y) + " + hidden
                           : hidden;
}

/** @p value over one cell of the reference, across direction @p d, or over two of them. */
std::string Patchwork::strip(const unsigned int d, const double value)
{
  if (finer[d] <= 2 * cells[d])
    finer[d] = static_cast<unsigned int>(dice.number(5, n_bodies[d] == 1 ? 60 : 30));
  const double size = (d == 0 ? 1 : height) / finer[d];
  const unsigned int n = n_bodies[d] * finer[d];
  const std::string result =
      inside(d, {(std::floor(dice.number(0, n)) + 0.5) * size, 0.5 * size}, value);
  return dice.happens(0.2) ? result + " + " + strip(d, value) : result;
}

/** Strains or temperature in a strip through the body. */
void Patchwork::draw_strips()
{
  const unsigned int n = dice.happens(0.7) ? 1 : 2;
  const bool in_columns = dice.happens(0.5);
  resize(in_columns ? n : 1, in_columns ? 1 : n);
  for (unsigned int d = 0; d < 2; ++d)
    join(d, {"tied", "tied", "bilateral"});
  const unsigned int d = dice.happens(0.5) ? 0 : 1;
  const auto hidden = [&](const double size)
  { return in_frame(smooth_and(strip(d, size), 0.3 * size)); };
  if (dice.happens(0.6))
  {
    sections.front().second.emplace_back("Thermal expansion", "0.01");
    sections.push_back({"Temperature", {{"Expression", hidden(1)}}});
  }
  else
    sections.front().second.emplace_back(
        "Initial strain", hidden(0.01) + "; " + (dice.happens(0.5) ? "0" : hidden(0.01)) + "; 0");
  const bool is_upright = dice.happens(0.5);
  const Place first = is_upright ? bottom : left, last = is_upright ? top : right;
  hold(first, "0", "0");
  if (dice.happens(0.7))
    hold(last, dice.happens(0.5) ? "0" : dice.about(0.01), "0");
  else
    load(last, 0.01);
}

/** A place on a side, whose ends are vertices of the reference's mesh; @p offset is where the side lies. */
Patchwork::Spot Patchwork::spot(const unsigned int d, const double from, const double to,
                                const double offset)
{
  levels = static_cast<unsigned int>(dice.number(3, 9));
  while (cells[d] << levels > 400) // the program samples each side five hundred times
    --levels;
  const double length = d == 0 ? 1 : height, size = length / cells[d] / (1u << levels);
  const unsigned int n = cells[d] << levels;
  const unsigned int width = dice.happens(0.7) ? 1 : 2,
                     first = std::floor(dice.number(from, to) * (n - width));
  const Spot result{size * (first + 0.5 * width), 0.5 * size * width};
  for (const double end : {result.centre - result.half_width, result.centre + result.half_width})
    graded.push_back(d == 0 ? std::array<double, 2>{{end, offset}}
                            : std::array<double, 2>{{offset, end}});
  return result;
}

std::string Patchwork::inside(const unsigned int d, const Spot &spot, const double value)
{
  return "if(abs(" + std::string(d == 0 ? "X" : "Y") + " - " + metamorphic::text(spot.centre) +
         ") < " + metamorphic::text(spot.half_width) + ", " + metamorphic::text(value) + ", 0)";
}

/** Springs on a strip of a side. */
void Patchwork::draw_springs()
{
  const unsigned int n = dice.happens(0.7) ? 1 : 2;
  resize(1, n);
  join(1, {"tied", "bilateral", "unilateral"});
  finer = cells;
  const bool is_below = n > 1 || dice.happens(0.5);
  const Place place = is_below ? bottom : left;
  const unsigned int d = is_below ? 0 : 1;
  const Spot strip = spot(d, 0, 1, 0);
  const auto stiffness = [&]
  {
    return in_frame(
        smooth_and(inside(d, strip, young * std::pow(10, dice.number(-1, 3))), 0.1 * young));
  };
  const std::string normal = stiffness();
  add(place, "Spring", normal + "; " + (dice.happens(0.5) ? "0" : stiffness()));
  const Place held = n == 1 && dice.happens(0.5) ? (is_below ? left : bottom)
                     : is_below                  ? top
                                                 : right;
  hold(held, dice.about(0.01), dice.about(0.01));
  if (dice.happens(0.5))
    load(place, 0.01);
}

/** One body on a foundation, or on another one; @p contact follows the law. */
void Patchwork::set_contact(const std::string &law, const Entries &contact)
{
  Entries &entries = n_bodies[1] == 1 ? sides[bottom][0] : joints[1][0][0];
  entries = {{n_bodies[1] == 1 ? "Contact" : "Law", law}};
  entries.insert(entries.end(), contact.begin(), contact.end());
  if (n_bodies[1] > 1)
    hold(bottom, "0", "0");
}

/** A foundation, or another body, that is flat but for a narrow ridge or groove. */
void Patchwork::draw_gaps()
{
  resize(1, dice.happens(0.6) ? 1 : 2);
  is_joined[1] = n_bodies[1] == 1;
  finer = cells;
  const double offset = (n_bodies[1] - 1) * height;
  const Spot ridge = spot(0, 0.05, 0.95, offset);
  graded.push_back({{ridge.centre, offset}});
  ++levels; // half of its width
  Entries contact{
      {"Gap", in_frame(smooth_and(dice.about(std::pow(10, dice.number(-4, -2))) +
                                      "*max(0, 1 - abs(X - " + metamorphic::text(ridge.centre) +
                                      ")/" + metamorphic::text(ridge.half_width) + ")",
                                  0.003))}};
  if (dice.happens(0.5))
    contact.emplace_back("Friction bound", metamorphic::text(0.001 * young));
  set_contact("unilateral", contact);
  hold(top, dice.about(0.003), metamorphic::text(-dice.number(0, 0.01)));
  if (dice.happens(0.3))
    sides[left].back() = {{"Traction", vector(dice.function(0.01 * young), "0")}};
}

/** A friction bound that is narrow near a corner. */
std::string Patchwork::pad(const double stress)
{
  const double offset = (n_bodies[1] - 1) * height;
  if (dice.happens(0.7))
    return inside(0, spot(0, 0, 0.3, offset), stress);
  const double centre = std::pow(10, dice.number(-2.3, -0.5)),
               width = std::max(0.002, centre * std::pow(10, dice.number(-1.5, -0.3)));
  graded = {{{0, offset}}, {{centre, offset}}};
  levels = 2 + static_cast<unsigned int>(-std::log2(width));
  return metamorphic::text(stress) + "*exp(-((X - " + metamorphic::text(centre) + ")/" +
         metamorphic::text(width) + ")^2)";
}

/** Friction near a corner that is held, where its test function falls to zero. */
void Patchwork::draw_falls()
{
  resize(1, dice.happens(0.6) ? 1 : 2);
  is_joined[1] = n_bodies[1] == 1;
  finer = cells;
  set_contact(
      dice.chosen({"bilateral", "unilateral", "tangential"}),
      {{"Friction bound",
        in_frame(smooth_and(pad(young * std::pow(10, dice.number(-1, 1.3))), 0.001 * young))}});
  const std::string move = vector(metamorphic::text(dice.number(0.002, 0.02)), "0");
  sides[left].back() = {{"Displacement", move}};
  if (dice.happens(0.3))
    sides[right].back() = {{"Displacement", move}};
  if (dice.happens(0.7))
    add(top, "Traction",
        vector(dice.about(0.001 * young), metamorphic::text(-0.01 * young * dice.number(0, 1))));
  methods = {"hpa2", "hpa3", "hap3"};
  n_steps = {"10", "16"}; // only a small bound tells
  most_unknowns = "2500";
}

/** Springs, up to a million times as stiff as the body or much softer, on sides at which joints end. */
void Patchwork::draw_joints()
{
  resize(1 + static_cast<unsigned int>(dice.number(0, 3)),
         1 + static_cast<unsigned int>(dice.number(0, 2)));
  if (n_bodies[0] * n_bodies[1] == 1)
    resize(2, 1);
  for (unsigned int d = 0; d < 2; ++d)
    join(d, dice.happens(0.6) ? std::vector<std::string>{"tied"}
                              : std::vector<std::string>{"tied", "bilateral"});
  const auto stiffness = [&]
  { return metamorphic::text(young * std::pow(10, dice.number(-1, 6))); };
  const Place place = n_bodies[0] > 1 ? top : right, beside = place == top ? right : top;
  if (dice.happens(0.5))
    add(place, "Spring", stiffness() + "; " + stiffness());
  else // of one body
    sides[place][0] = {{"Spring", stiffness() + "; " + stiffness()}};
  const bool moves = dice.happens(0.3);
  if (moves)
    hold(beside, dice.about(0.01), dice.about(0.01));
  else
    load(beside, 0.01);
  if ((beside == top || !moves) && dice.happens(0.5)) // corners are held once
    hold(bottom, "0", "0");
}

/** Four bodies around a vertex, or six, that are pressed together or torn, mostly on soft springs. */
void Patchwork::draw_vertex()
{
  resize(dice.happens(0.8) ? 2 : 3, 2);
  if (dice.happens(0.7))
    cells = finer = {{1, 1}};
  const std::vector<std::string> laws{"unilateral", "bilateral", "tangential", "tied"};
  join(0, dice.happens(0.7) ? std::vector<std::string>{"tied"} : laws);
  join(1, dice.happens(0.7) ? std::vector<std::string>{"unilateral"} : laws);
  if (dice.happens(0.7))
    sections.push_back(
        {"Material other",
         {{"Where", in_frame("X - 1")},
          {"Young's modulus", metamorphic::text(young * std::pow(10, dice.number(-1, 1.7)))}}});
  const double softest = dice.number(-3, 1);
  const auto stiffness = [&]
  { return metamorphic::text(young * std::pow(10, dice.number(softest, softest + 0.5))); };
  hold(bottom, "0", "0");
  add(top, "Spring", stiffness() + "; " + stiffness());
  add(top, "Traction", vector(dice.about(0.01 * young), dice.about(0.01 * young)));
  add(right, "Traction", vector(dice.about(0.03 * young), dice.about(0.03 * young)));
  methods = {"hup2", "hup2", "hup3", "hap2", "hpa2", "hpa3"};
  n_steps = {"4", "8"};
}

/** A plate that is moved or pressed, with probes on it and beside it. */
void Patchwork::draw_plates()
{
  resize(1, 1);
  hold(left, "0", "0");
  add(right, "Rigid", "true");
  if (dice.happens(0.5))
  {
    add(right, "Force", vector(dice.about(0.01 * young), dice.about(0.01 * young)));
    add(right, "Moment", dice.about(0.002 * young));
  }
  else
    hold(right, dice.about(0.01), dice.about(0.01));
  if (dice.happens(0.5))
    load(top, 0.01);
  if (dice.happens(0.5))
    sides[bottom][0] = {{"Contact", dice.chosen({"unilateral", "tangential"})},
                        {"Friction bound", in_frame(dice.positive(0.02 * young))}};
  for (const Place place : {right, top, bottom})
    sections.push_back({"Probe " + names[place], {{"On", names[place]}}});
}

void Patchwork::draw_method()
{
  Entries entries{{"Method", dice.chosen(methods)},
                  {"Indicator", dice.chosen({"residual", "bound"})},
                  {"Maximum steps", dice.chosen(n_steps)},
                  {"Maximum unknowns", most_unknowns}};
  if (dice.happens(0.5))
    entries.emplace_back("Tolerance", "0");
  sections.push_back({"Adaptivity", entries});
  sections.push_back({"Output", {{"VTU", "false"}}});
}

// ---------------------------------------------------------------- files

std::string Patchwork::point(const double x, const double y) const
{
  return metamorphic::text(std::cos(angle) * x - std::sin(angle) * y) + ", " +
         metamorphic::text(std::sin(angle) * x + std::cos(angle) * y);
}

/** Positive between two lines of bodies. */
std::string Patchwork::between(const unsigned int d, const unsigned int from,
                               const unsigned int to) const
{
  const double size = d == 0 ? 1 : height;
  const std::string v = d == 0 ? "X" : "Y";
  return in_frame("min(" + v + " - " + metamorphic::text(from * size) + ", " +
                  metamorphic::text(to * size) + " - " + v + ")");
}

/** Of X and Y. */
std::string Patchwork::in_frame(const std::string &expression) const
{
  const std::string c = metamorphic::text(std::cos(angle)), s = metamorphic::text(std::sin(angle));
  const std::string x = angle == 0 ? "x" : "(" + c + "*x + (" + s + ")*y)",
                    y = angle == 0 ? "y" : "(" + c + "*y - (" + s + ")*x)";
  std::string result;
  for (const char letter : expression)
    result += letter == 'X' ? x : letter == 'Y' ? y : std::string(1, letter);
  return result;
}

/** Components along x and y of one with components along X and Y. */
std::string Patchwork::vector(const std::string &x, const std::string &y) const
{
  if (angle == 0)
    return in_frame(x + "; " + y);
  const std::string c = metamorphic::text(std::cos(angle)), s = metamorphic::text(std::sin(angle));
  return in_frame("(" + c + ")*(" + x + ") - (" + s + ")*(" + y + "); (" + s + ")*(" + x + ") + (" +
                  c + ")*(" + y + ")");
}

unsigned int Patchwork::n_blocks(const unsigned int d, const bool is_reference) const
{
  return is_reference && is_joined[d] ? 1 : n_bodies[d];
}

/** Its name: none where it is alone, and none of a body where it is several. */
std::string Patchwork::block(const unsigned int column, const unsigned int row,
                             const bool is_reference) const
{
  return (n_blocks(0, is_reference) > 1 ? "c" + std::to_string(column) : "") +
         (n_blocks(1, is_reference) > 1 ? "r" + std::to_string(row) : "");
}

std::vector<Section> Patchwork::bodies(const bool is_reference) const
{
  std::array<unsigned int, 2> n{}, n_cells{};
  std::array<double, 2> size{{1, height}};
  for (unsigned int d = 0; d < 2; ++d)
  {
    n[d] = n_blocks(d, is_reference);
    n_cells[d] = (is_reference ? finer[d] : cells[d]) * n_bodies[d] / n[d];
    size[d] *= n_bodies[d] / n[d];
  }
  std::vector<Section> result;
  for (unsigned int i = 0; i < n[0]; ++i)
    for (unsigned int j = 0; j < n[1]; ++j)
    {
      const double x = i * size[0], y = j * size[1];
      const std::string name = block(i, j, is_reference);
      Entries entries{
          {"Subdivisions", std::to_string(n_cells[0]) + ", " + std::to_string(n_cells[1])}};
      if (angle == 0)
        entries.insert(entries.end(), {{"Lower corner", point(x, y)},
                                       {"Upper corner", point(x + size[0], y + size[1])}});
      else
        entries.insert(entries.end(), {{"Shape", "quadrilateral"},
                                       {"Corners", point(x, y) + "; " + point(x + size[0], y) +
                                                       "; " + point(x + size[0], y + size[1]) +
                                                       "; " + point(x, y + size[1])}});
      std::string points;
      for (const auto &[px, py] : graded)
        if (px >= x && px <= x + size[0] && py >= y && py <= y + size[1])
          points += (points.empty() ? "" : "; ") + point(px, py);
      if (is_reference && !points.empty())
        entries.insert(entries.end(),
                       {{"Graded towards", points}, {"Grading levels", std::to_string(levels)}});
      result.push_back({name.empty() ? "Geometry" : "Body " + name, entries});
    }
  return result;
}

std::vector<Section> Patchwork::boundaries(const bool is_reference) const
{
  const std::array<unsigned int, 2> n{{n_blocks(0, is_reference), n_blocks(1, is_reference)}};
  const auto side = [&](const unsigned int i, const unsigned int j, const Place place)
  {
    const std::string name = block(i, j, is_reference);
    return name + (name.empty() ? "" : ".") + names[place];
  };
  std::vector<Section> result;
  for (const Place place : {bottom, right, top, left})
    for (unsigned int k = 0; k < n_bodies[place % 2]; ++k)
    {
      const unsigned int d = place % 2, of_block = k * n[d] / n_bodies[d],
                         end = place == bottom || place == left ? 0 : n[1 - d] - 1;
      const std::string on = d == 0 ? side(of_block, end, place) : side(end, of_block, place);
      const auto &all = sides[place];
      const bool is_whole =
          n[d] == n_bodies[d] || std::equal(all.begin() + 1, all.end(), all.begin());
      if (all[k].empty() || (is_whole && n[d] < n_bodies[d] && k > 0))
        continue;
      Entries entries = all[k];
      if (!is_whole)
        entries.insert(entries.begin(), {{"On", on}, {"Where", between(d, k, k + 1)}});
      result.push_back({"Boundary " + (is_whole ? on : "part" + std::to_string(k)), entries});
    }
  for (unsigned int d = 0; d < 2; ++d)
    for (unsigned int line = 0; line + 1 < n[d]; ++line)
      for (unsigned int k = 0; k < n[1 - d]; ++k)
      {
        Entries entries{{"Between", d == 0
                                        ? side(line, k, right) + ", " + side(line + 1, k, left)
                                        : side(k, line + 1, bottom) + ", " + side(k, line, top)}};
        entries.insert(entries.end(), joints[d][line][k].begin(), joints[d][line][k].end());
        result.push_back({"Contact " + std::string(d == 0 ? "v" : "h") + std::to_string(line) +
                              (n[1 - d] > 1 ? "at" + std::to_string(k) : ""),
                          entries});
      }
  return result;
}

std::string Patchwork::text(const bool is_reference) const
{
  std::vector<Section> all = bodies(is_reference);
  for (const std::vector<Section> &some : {boundaries(is_reference), sections})
    all.insert(all.end(), some.begin(), some.end());
  std::string result = "set Dimension = 2\n";
  for (const auto &[name, entries] : all)
  {
    result += "subsection " + name + "\n";
    for (const auto &[entry, value] : entries)
      result += "  set " + entry + " = " + value + "\n";
    result += "end\n";
  }
  return result;
}
} // namespace

const std::vector<std::string> hidden_kinds{"strips", "springs", "gaps",  "falls",
                                            "joints", "vertex",  "plates"};

DrawnScene hidden_scene(const std::string &kind, std::mt19937 &random)
{
  const Patchwork patchwork(kind, random);
  return patchwork.told();
}
} // namespace attack
