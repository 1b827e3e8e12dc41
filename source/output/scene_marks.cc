// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/output/arrow_rows.h>
#include <hpvi/output/scene_marks.h>
#include <hpvi/output/scene_words.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Short lines that lean, on the outer side of a foundation or a clamp. */
void hatch(Drawing &drawing, const std::vector<PagePoint> &line,
           const std::vector<PageVector> &normals)
{
  constexpr double spacing = 8., size = 8.;
  double until_next = spacing / 2;
  std::vector<std::pair<PagePoint, PagePoint>> strokes;
  for (std::size_t k = 1; k < line.size(); ++k)
  {
    const PageVector way = line[k] - line[k - 1];
    const double length = way.norm();
    for (; until_next <= length; until_next += spacing)
    {
      const PagePoint at = line[k - 1] + until_next / length * way;
      const PageVector along({-normals[k][1], normals[k][0]});
      strokes.emplace_back(at, at + 0.75 * size * normals[k] + 0.6 * size * along);
    }
    until_next -= length;
  }
  drawing.strokes(strokes, "class=\"hatch\" " + stroke(mark_colours::ground, 0.8));
}
} // namespace

// ---------------------------------------------------------------- supports

namespace
{
void draw_clamp(SceneSheet &sheet, const OutlinePart &part, const double band)
{
  std::vector<PagePoint> line;
  std::vector<PageVector> normals;
  for (const Station &place : sheet.stations(part, 4., true))
  {
    line.push_back(place.at + (band + 2.) * place.normal);
    normals.push_back(place.normal);
  }
  sheet.drawing.line(line, "class=\"clamp\" " + stroke(mark_colours::ground, 2.2));
  hatch(sheet.drawing, line, normals);
}

/** A triangle on two wheels that stands on the ground: its axis is the component that is held. */
void draw_roller(Drawing &drawing, const PagePoint &tip, const PageVector &axis)
{
  const PageVector across({-axis[1], axis[0]});
  const PagePoint base = tip + 10. * axis, ground = tip + 16. * axis;
  drawing.line({tip, base + 6. * across, base - 6. * across, tip},
               "class=\"roller\" " + stroke(mark_colours::ground, 1.1));
  for (const double side : {-3.5, 3.5})
    drawing.circle(base + 3. * axis + side * across, 2.2,
                   "fill=\"#fff\" " + stroke(mark_colours::ground, 0.9));
  drawing.line({ground - 9. * across, ground + 9. * across}, stroke(mark_colours::ground, 1.1));
}

/** Where the component is one along the boundary, its rollers stand beside the body. */
double draw_rollers(SceneSheet &sheet, const OutlinePart &part, const unsigned int component,
                    const double band)
{
  Tensor<1, 2> unit;
  unit[component] = 1.;
  double deepest = band;
  const double spacing = std::min(60., 0.5 * sheet.length(part));
  for (const Station &place : sheet.stations(part, spacing, false))
  {
    PageVector axis = sheet.direction(unit);
    if (axis * place.normal < -1e-9)
      axis = -axis;
    const bool is_beside = axis * place.normal < 0.5;
    const double away = band + (is_beside ? 10. : 1.);
    draw_roller(sheet.drawing, place.at + away * place.normal, axis);
    deepest = std::max(deepest, band + (is_beside ? 21. : 18.));
  }
  return deepest;
}
} // namespace

double draw_symmetry(SceneSheet &sheet, const MarkedPart &marked, const double band)
{
  if (!marked.condition.symmetry)
    return band;
  Drawing &drawing = sheet.drawing;
  drawing.begin("symmetry", marked.condition.name);
  std::vector<PagePoint> line;
  for (const Station &place : sheet.stations(marked.part, 4., true))
    line.push_back(place.at + (band + 4.) * place.normal);
  drawing.line(line, "class=\"axis\" " + stroke(mark_colours::ground, 1.2) +
                         " stroke-dasharray=\"12 3 3 3\"");
  std::vector<std::pair<PagePoint, PagePoint>> strokes;
  for (const Station &place : sheet.stations(marked.part, 60., false))
  {
    const PageVector along({-place.normal[1], place.normal[0]});
    for (const double side : {-1.5, 1.5})
      strokes.emplace_back(place.at + (band + 1.) * place.normal + side * along,
                           place.at + (band + 11.) * place.normal + side * along);
  }
  drawing.strokes(strokes, stroke(mark_colours::ground, 1.2));
  drawing.end();
  return band + 13.;
}

namespace
{
/** Half a circle with a head, from where the plate is pushed on one side to the other. */
void draw_turn(Drawing &drawing, const Station &place, const double away,
               const bool is_counterclockwise)
{
  constexpr double radius = 16.;
  const PageVector along({-place.normal[1], place.normal[0]});
  const PagePoint middle = place.at + away * place.normal;
  std::vector<PagePoint> arc;
  for (unsigned int k = 0; k <= 20; ++k)
  {
    const double angle = numbers::PI * k / 20.;
    arc.push_back(middle + radius * std::cos(angle) * along +
                  radius * std::sin(angle) * place.normal);
  }
  // y grows downwards on the page: counterclockwise from the one end or from the other
  const bool is_from_begin =
      (along[0] * place.normal[1] - along[1] * place.normal[0] < 0) == is_counterclockwise;
  if (!is_from_begin)
    std::reverse(arc.begin(), arc.end());
  drawing.line(arc, "class=\"moment\" " + stroke(mark_colours::load, 1.4));
  drawing.arrow(arc[arc.size() - 4], arc.back(), ArrowHead::filled, mark_colours::load);
}
} // namespace

/** A thick bar, with its force and moment at the mean point. */
double draw_plate(SceneSheet &sheet, const MarkedPart &marked, const double band)
{
  if (!marked.condition.plate)
    return band;
  constexpr double thickness = 9.;
  const RigidPlate<2> &plate = *marked.condition.plate;
  Drawing &drawing = sheet.drawing;
  drawing.begin("plate", marked.condition.name);
  std::vector<PagePoint> line;
  for (const Station &place : sheet.stations(marked.part, 4., true))
    line.push_back(place.at + (band + 1. + thickness / 2) * place.normal);
  drawing.line(line, "class=\"plate\" stroke-linecap=\"butt\" " +
                         stroke(mark_colours::ground, thickness));
  double deepest = band + thickness + 2.;
  const Station middle = sheet.station(marked.part, 0.5);
  const Tensor<1, 2> force({plate.force[0], plate.force[1]});
  if (force.norm() > 0)
  {
    const PageVector way = 34. * sheet.direction(force / force.norm());
    const bool pushes = way * middle.normal < 0;
    const PagePoint tip = middle.at + deepest * middle.normal;
    drawing.arrow(pushes ? tip - way : tip, pushes ? tip : tip + way, ArrowHead::filled,
                  mark_colours::load);
    deepest += std::max(4., std::abs(way * middle.normal));
  }
  if (plate.force[2] != 0)
  {
    draw_turn(drawing, middle, deepest, plate.force[2] > 0);
    deepest += 20.;
  }
  drawing.end();
  return deepest + 2.;
}

double draw_springs(SceneSheet &sheet, const MarkedPart &marked, const double band)
{
  if (!marked.condition.spring)
    return band;
  Drawing &drawing = sheet.drawing;
  drawing.begin("spring", marked.condition.name);
  const double length = 22.;
  std::vector<PagePoint> ground;
  std::vector<PageVector> normals;
  for (const Station &place : sheet.stations(marked.part, 4., true))
  {
    ground.push_back(place.at + (band + length) * place.normal);
    normals.push_back(place.normal);
  }
  for (const Station &place : sheet.stations(marked.part, 30., false))
  {
    const PageVector along({-place.normal[1], place.normal[0]});
    std::vector<PagePoint> zigzag{place.at + band * place.normal};
    for (unsigned int k = 0; k < 6; ++k)
      zigzag.push_back(place.at + (band + 4. + 2.8 * k) * place.normal +
                       (k % 2 == 0 ? 4. : -4.) * along);
    zigzag.push_back(place.at + (band + length) * place.normal);
    drawing.line(zigzag, "class=\"coil\" " + stroke(mark_colours::ground, 1.1));
  }
  drawing.line(ground, stroke(mark_colours::ground, 1.6));
  hatch(drawing, ground, normals);
  drawing.end();
  return band + length + 9.;
}

double draw_support(SceneSheet &sheet, const MarkedPart &marked, double band)
{
  if (!marked.condition.has_displacement())
    return band;
  sheet.drawing.begin("support", marked.condition.name);
  const auto &held = marked.condition.displacement;
  if (held[0] && held[1])
  {
    draw_clamp(sheet, marked.part, band);
    band += 11.;
  }
  else
    band = draw_rollers(sheet, marked.part, held[0] ? 0 : 1, band);
  sheet.drawing.end();
  return band;
}

// ---------------------------------------------------------------- contact

double gap_magnification(const SceneSheet &sheet, const MarkedPart &marked)
{
  double widest = 0;
  if (marked.condition.is_unilateral() && !marked.condition.pair)
    for (const Station &place : sheet.stations(marked.part, 2., true))
      widest = std::max(widest, sheet.scale * std::abs(marked.condition.gap_at(place.x)));
  const double wanted = widest == 0 || (widest >= 12. && widest <= 90.) ? 1.
                        : widest < 12.                                  ? 30. / widest
                                                                        : 90. / widest;
  const double decade = std::pow(10., std::floor(std::log10(wanted)));
  return wanted == 1 ? 1. : decade * std::floor(wanted / decade); // a round number
}

double draw_contact_direction(SceneSheet &sheet, const MarkedPart &marked, const double band)
{
  if (!marked.condition.contact_direction || !marked.condition.has_contact())
    return band;
  const PageVector d = sheet.direction(*marked.condition.contact_direction);
  double deepest = band;
  sheet.drawing.begin("direction", marked.condition.name);
  for (const Station &place : sheet.stations(marked.part, 60., false))
  {
    const PagePoint tail = place.at + (band + 2.) * place.normal, head = tail + 20. * d;
    sheet.drawing.arrow(tail, head, ArrowHead::open, mark_colours::contact);
    deepest = std::max(deepest, (head - place.at) * place.normal + 2.);
  }
  sheet.drawing.end();
  return deepest;
}

double draw_foundation(SceneSheet &sheet, const MarkedPart &marked, double band)
{
  const BoundaryCondition<2> &condition = marked.condition;
  if (!condition.has_contact())
    return band;
  Drawing &drawing = sheet.drawing;
  if (condition.pair) // the other body takes the place of a foundation
  {
    drawing.begin("pair " + condition.pair_name, condition.name);
    std::vector<PagePoint> side;
    for (const Station &place : sheet.stations(marked.part, 3., true))
      side.push_back(place.at);
    drawing.line(side, "class=\"contact\" " + stroke(mark_colours::contact, 2.5));
    drawing.end();
    return band;
  }
  const bool is_bilateral = condition.contact == Contact::bilateral;
  const double clearance = band + (is_bilateral ? 8. : 4.),
               magnification = gap_magnification(sheet, marked);
  std::vector<PagePoint> side, line;
  std::vector<PageVector> normals;
  double deepest = clearance;
  for (const Station &place : sheet.stations(marked.part, 3., true))
  {
    const double gap =
        condition.is_unilateral() ? magnification * sheet.scale * condition.gap_at(place.x) : 0.;
    const PageVector along_contact =
        condition.contact_direction ? sheet.direction(*condition.contact_direction) : place.normal;
    side.push_back(place.at + 1. * place.normal);
    line.push_back(place.at + clearance * place.normal + gap * along_contact);
    normals.push_back(along_contact);
    deepest = std::max(deepest, clearance + gap * (along_contact * place.normal));
  }
  drawing.begin("foundation " + std::string(is_bilateral                ? "bilateral"
                                            : condition.is_unilateral() ? "unilateral"
                                                                        : "tangential"),
                condition.name);
  drawing.line(side, "class=\"contact\" " + stroke(mark_colours::contact, 2.5));
  drawing.line(line,
               "class=\"ground\" " + stroke(mark_colours::ground, 1.6) +
                   (condition.contact == Contact::tangential ? " stroke-dasharray=\"7 4\"" : ""));
  hatch(drawing, line, normals);
  if (is_bilateral)
    for (const Station &place : sheet.stations(marked.part, 24., false))
      drawing.circle(place.at + (band + 4.8) * place.normal, 2.4,
                     "class=\"roller\" fill=\"#fff\" " + stroke(mark_colours::ground, 0.9));
  drawing.end();
  return deepest + 8.;
}

// ---------------------------------------------------------------- words

namespace
{
/** The name, and below it what the marks do not say by themselves. */
std::vector<TextLine> words_of(const SceneSheet &sheet, const MarkedPart &marked)
{
  const BoundaryCondition<2> &condition = marked.condition;
  std::vector<TextLine> lines{{legible(condition.name), true}};
  if (!marked.has_words)
    return lines;
  std::vector<Point<2>> points;
  for (const OutlinePart *const piece : marked.pieces)
    for (const Station &place : sheet.sample(*piece))
      points.push_back(place.x);
  for (const std::string &phrase : support_phrases(sheet.scene, condition, points))
    lines.push_back({phrase, false, mark_colours::displacement});
  for (const std::string &phrase : contact_phrases(sheet.scene, condition, points))
    lines.push_back({phrase, false, mark_colours::contact});
  if (const double times = gap_magnification(sheet, marked); times != 1)
    lines.push_back({"(gap drawn " + text(times, 6) + " times as wide)", false, "#555"});
  const std::vector<std::string> tractions = traction_phrases(sheet.scene, condition, points);
  for (const std::string &phrase : tractions)
    lines.push_back({phrase, false, mark_colours::load});
  if (lines.size() == 1)
    lines.push_back({"free", false, "#777"});
  return lines;
}
} // namespace

double draw_words(SceneSheet &sheet, const MarkedPart &marked, const double band)
{
  const auto &pair = marked.condition.pair;
  if (pair && sheet.scene.pairs[*pair].parts[0] != marked.condition.id)
    return band; // what the first of two sides says holds for both
  const Station middle = sheet.station(marked.part, 0.5);
  sheet.drawing.add({middle.at + band * middle.normal, middle.normal,
                     0.4 * sheet.length(marked.part), words_of(sheet, marked), "boundary",
                     marked.condition.name});
  return band;
}

const std::vector<BoundaryMark> boundary_marks = {
    draw_support,           draw_plate,     draw_symmetry,     draw_springs, draw_foundation,
    draw_contact_direction, draw_tractions, draw_displacements};
} // namespace hpvi
