// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/tolerances.h>
#include <hpvi/output/arrow_rows.h>
#include <hpvi/output/scene_words.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Vectors along a part, drawn as arrows. */
struct ArrowRow
{
  std::string classes, colour, unit;
  ArrowHead head;
  std::function<Tensor<1, 2>(const Point<2> &)> value;
  double pixels;  ///< per unit
  double spacing; ///< of arrows, at least
};

/** Its tail and its head; what is pushed is at the head, what is pulled at the tail. */
struct PlacedArrow
{
  PagePoint tail, head;
  double normal_share; ///< of its length, outwards
};

PlacedArrow place_arrow(const Station &place, const PageVector &arrow, const double band)
{
  const double normal_share = arrow * place.normal / arrow.norm();
  if (std::abs(normal_share) < 0.2)
  {
    const PagePoint middle = place.at + (band + 8.) * place.normal;
    return {middle - 0.5 * arrow, middle + 0.5 * arrow, normal_share};
  }
  const PagePoint at = place.at + (band + 3.) * place.normal;
  return normal_share < 0 ? PlacedArrow{at - arrow, at, normal_share}
                          : PlacedArrow{at, at + arrow, normal_share};
}

/** The vectors of a row where they are looked at: many, so that a narrow one is seen. */
struct RowSample
{
  double largest = 0, along = 0; ///< of all sizes, of components along the part
  Station where;
  bool is_constant = true;
};

RowSample sample(const SceneSheet &sheet, const OutlinePart &part, const ArrowRow &row)
{
  const std::vector<Station> places = sheet.sample(part);
  RowSample result{0., 0., places[places.size() / 2], true};
  const Tensor<1, 2> first = row.value(places[0].x), middle = row.value(result.where.x);
  result.largest = middle.norm();
  for (const Station &place : places)
  {
    const Tensor<1, 2> vector = row.value(place.x);
    result.is_constant =
        result.is_constant && (vector - first).norm() <= unseen_in_picture * first.norm();
    result.along = std::max(result.along, std::abs(sheet.direction(vector) * place.along));
    if (vector.norm() > (1 + unseen_in_picture) * result.largest)
    {
      result.largest = vector.norm();
      result.where = place;
    }
  }
  return result;
}

/** A line through tails or heads of neighbours, beside which distributed loads are read. */
void join(Drawing &drawing, const PlacedArrow &one, const PlacedArrow &next, const ArrowRow &row)
{
  const PageVector way = one.head - one.tail, next_way = next.head - next.tail;
  const bool are_alike = way * next_way > 0.8 * way.norm() * next_way.norm();
  if (!are_alike || one.normal_share * next.normal_share <= 0.04)
    return;
  const bool are_pushing = one.normal_share < 0;
  drawing.line({are_pushing ? one.tail : one.head, are_pushing ? next.tail : next.head},
               "class=\"envelope\" " + stroke(row.colour, 0.8));
}

/** The size of the largest arrow beyond it. */
void draw_size(SceneSheet &sheet, const MarkedPart &marked, const ArrowRow &row,
               const RowSample &seen, const PlacedArrow &largest)
{
  const bool is_pushing = largest.normal_share < 0;
  const PageVector way = largest.head - largest.tail;
  const PagePoint end = is_pushing ? largest.tail : largest.head;
  const bool is_beside = std::abs(largest.normal_share) < 0.2;
  const PagePoint from = is_beside ? largest.tail + 0.5 * way : end;
  sheet.drawing.add({from,
                     seen.where.normal,
                     0.3 * sheet.length(marked.part),
                     {{(seen.is_constant ? "" : "up to ") + with_unit(seen.largest, row.unit, 4),
                       false, row.colour}},
                     "size",
                     marked.condition.name});
}

/** Where its arrows stand: farther from each other where they lie along the boundary; where the largest is narrow, there too. */
std::vector<Station> places_of(const SceneSheet &sheet, const OutlinePart &part,
                               const ArrowRow &row, const RowSample &seen, const double pixels)
{
  const double lying = seen.along * pixels;
  std::vector<Station> places =
      sheet.stations(part, std::max(row.spacing, lying > 12. ? 1.2 * lying : 0.), lying <= 12.);
  const bool shows_largest = std::any_of(
      places.begin(), places.end(),
      [&](const Station &place) { return row.value(place.x).norm() > 0.9 * seen.largest; });
  if (!shows_largest)
    places.push_back(seen.where);
  return places;
}

double draw_row(SceneSheet &sheet, const MarkedPart &marked, const ArrowRow &row, const double band)
{
  const RowSample seen = sample(sheet, marked.part, row);
  if (!(seen.largest > 0))
    return band;
  // what is small beside other boundaries is longer than to scale: its size stands beside it
  const double pixels = std::max(row.pixels, 16. / seen.largest);
  double deepest = band, size_of_largest = 0;
  PlacedArrow largest{}, before{}; // none is before the first
  sheet.drawing.begin(row.classes, marked.condition.name);
  for (const Station &place : places_of(sheet, marked.part, row, seen, pixels))
  {
    const Tensor<1, 2> value = row.value(place.x);
    if (value.norm() * pixels < 2.5)
    {
      before = {};
      continue;
    }
    const PlacedArrow arrow = place_arrow(place, pixels * sheet.direction(value), band);
    sheet.drawing.arrow(arrow.tail, arrow.head, row.head, row.colour);
    for (const PagePoint &end : {arrow.tail, arrow.head})
      deepest = std::max(deepest, (end - place.at) * place.normal);
    join(sheet.drawing, before, arrow, row);
    before = arrow;
    if (value.norm() > (1 + unseen_in_picture) * size_of_largest)
    {
      size_of_largest = value.norm();
      largest = arrow;
    }
  }
  sheet.drawing.end();
  if (marked.has_words || !seen.is_constant)
    draw_size(sheet, marked, row, seen, largest);
  return deepest + 3.;
}
} // namespace

double draw_tractions(SceneSheet &sheet, const MarkedPart &marked, const double band)
{
  const auto value = [&](const Point<2> &x) { return value_of(marked.condition.traction, x); };
  return draw_row(sheet, marked,
                  {"traction", mark_colours::load, sheet.scene.stress_unit, ArrowHead::filled,
                   value, 60. / sheet.largest_traction, 26.},
                  band);
}

double draw_displacements(SceneSheet &sheet, const MarkedPart &marked, const double band)
{
  const auto value = [&](const Point<2> &x) { return value_of(marked.condition.displacement, x); };
  return draw_row(sheet, marked,
                  {"displacement", mark_colours::displacement, sheet.scene.length_unit,
                   ArrowHead::open, value, 44. / sheet.largest_displacement, 48.},
                  band);
}

void draw_body_force(SceneSheet &sheet, const Triangulation<2> &mesh)
{
  if (!sheet.scene.has_body_force())
    return;
  Tensor<1, 2> mean;
  std::vector<double> sizes;
  double area = 0;
  PagePoint centre;
  for (const auto &cell : mesh.active_cell_iterators())
  {
    const Tensor<1, 2> force = value_of(sheet.scene.body_force_in(cell), cell->center());
    mean += cell->measure() * force;
    sizes.push_back(force.norm());
    area += cell->measure();
    centre += cell->measure() * sheet.page(cell->center());
  }
  mean /= area;
  centre = centre / area;
  const std::string size = range_in_words(sizes, body_force_unit(sheet.scene));
  PageVector along({0., 1.});
  sheet.drawing.begin("body-force");
  if (mean.norm() > unseen_in_picture * *std::max_element(sizes.begin(), sizes.end()))
  {
    along = sheet.direction(mean / mean.norm());
    sheet.drawing.circle(centre, 3., std::string("fill=\"") + mark_colours::load + '"');
    sheet.drawing.arrow(centre, centre + 60. * along, ArrowHead::filled, mark_colours::load);
  }
  sheet.drawing.end();
  const PageVector beyond(
      {0., along[1] > 0 ? -1. : 1.}); // the tail: there a line of text finds room
  sheet.drawing.add(
      {centre, beyond, 60., {{"body force " + size, false, mark_colours::load}}, "size", ""});
}

} // namespace hpvi
