// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/tolerances.h>
#include <hpvi/output/arrow_rows.h>
#include <hpvi/output/cell_outline.h>
#include <hpvi/output/chart_axes.h>
#include <hpvi/output/probe_marks.h>
#include <hpvi/output/result_directory.h>
#include <hpvi/output/scene_marks.h>
#include <hpvi/output/scene_picture.h>
#include <hpvi/output/scene_words.h>
#include <hpvi/plane/mesh.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Light, and told apart by lightness as well as hue. */
std::string material_colour(const types::material_id id)
{
  static const char *const colours[] = {"#e6edf5", "#f6d9a8", "#b5d6c3", "#d9c3e0",
                                        "#a9c4e6", "#efe98f", "#c9c9c9", "#f2bfb4"};
  return colours[id % 8];
}

/** Each cell in the colour of its material; lines of small cells are thin. */
void draw_body(SceneSheet &sheet, const Triangulation<2> &mesh)
{
  sheet.drawing.begin("body");
  for (const auto &cell : mesh.active_cell_iterators())
  {
    std::vector<PagePoint> corners;
    for (const Point<2> &x : cell_outline(map_of<2>(cell)))
      corners.push_back(sheet.page(x));
    const double size = sheet.scale * cell->minimum_vertex_distance();
    sheet.drawing.area(corners, "class=\"cell\" fill=\"" + material_colour(cell->material_id()) +
                                    "\" " + stroke("#8a97a6", std::min(0.8, 0.06 * size)));
  }
  sheet.drawing.end();
}

/** A cross along the axes of one material, axis 1 the longer one, with @p number where it ends. */
void draw_material_axes(SceneSheet &sheet, const Point<2> &centre, const double reach,
                        const double degrees, const std::string &number)
{
  const double angle = degrees * numbers::PI / 180;
  const PagePoint at = sheet.page(centre);
  const PageVector one = sheet.direction(Tensor<1, 2>({std::cos(angle), std::sin(angle)})),
                   two = sheet.direction(Tensor<1, 2>({-std::sin(angle), std::cos(angle)}));
  sheet.drawing.strokes({{at - reach * one, at + reach * one}}, stroke("#55606e", 1.4));
  sheet.drawing.strokes({{at - 0.4 * reach * two, at + 0.4 * reach * two}}, stroke("#55606e", 0.8));
  if (!number.empty())
    sheet.drawing.text_at(at + (reach + 7.) * one + PageVector({0., 4.}),
                          {number, false, "#55606e"}, "middle");
}

/** Of orthotropic materials, so far from each other that they are told apart. */
void draw_material_axes(SceneSheet &sheet, const Triangulation<2> &mesh)
{
  constexpr double apart = 40.; // pixels
  std::map<types::material_id, std::vector<PagePoint>> drawn;
  sheet.drawing.begin("axes-of-materials");
  for (const auto &cell : mesh.active_cell_iterators())
  {
    const std::optional<Orthotropy> &own = sheet.scene.material_of(cell).orthotropy;
    if (!own)
      continue;
    const PagePoint at = sheet.page(cell->center());
    std::vector<PagePoint> &others = drawn[cell->material_id()];
    if (std::any_of(others.begin(), others.end(),
                    [&](const PagePoint &other) { return other.distance(at) < apart; }))
      continue;
    const double size = sheet.scale * cell->minimum_vertex_distance();
    draw_material_axes(sheet, cell->center(), std::clamp(0.3 * size, 5., 20.), own->angle,
                       others.empty() ? "1" : "");
    others.push_back(at);
  }
  sheet.drawing.end();
}

/** The longest part of each boundary has the words. */
std::vector<MarkedPart> marked_parts(const Scene<2> &scene, const std::vector<OutlinePart> &parts)
{
  std::vector<MarkedPart> marked;
  for (const OutlinePart &part : parts)
  {
    const bool is_longest = std::none_of(
        parts.begin(), parts.end(),
        [&](const OutlinePart &other)
        {
          return other.boundary == part.boundary &&
                 (other.length() > (1 + unseen_in_picture) * part.length() ||
                  (&other < &part && other.length() > (1 - unseen_in_picture) * part.length()));
        });
    marked.push_back({part, scene.boundaries[part.boundary], is_longest, {}});
    for (const OutlinePart &other : parts)
      if (other.boundary == part.boundary)
        marked.back().pieces.push_back(&other);
  }
  return marked;
}

void draw_outline(SceneSheet &sheet, const std::vector<OutlinePart> &parts)
{
  sheet.drawing.begin("outline");
  for (const OutlinePart &part : parts)
  {
    std::vector<PagePoint> line;
    for (const Point<2> &x : part.points())
      line.push_back(sheet.page(x));
    sheet.drawing.line(line, stroke("#333", 1.4));
  }
  sheet.drawing.end();
}

/** Arrows of all boundaries have one scale. */
void find_largest(SceneSheet &sheet, const std::vector<MarkedPart> &parts)
{
  for (const MarkedPart &marked : parts)
    for (const Station &place : sheet.sample(marked.part))
    {
      sheet.largest_traction =
          std::max(sheet.largest_traction, value_of(marked.condition.traction, place.x).norm());
      sheet.largest_displacement = std::max(
          sheet.largest_displacement, value_of(marked.condition.displacement, place.x).norm());
    }
}

void draw_boundaries(SceneSheet &sheet, const std::vector<MarkedPart> &parts)
{
  std::vector<double> bands;
  for (const MarkedPart &marked : parts)
  {
    double band = 0;
    for (const BoundaryMark mark : boundary_marks)
      band = mark(sheet, marked, band);
    bands.push_back(band);
  }
  for (std::size_t k = 0; k < parts.size(); ++k)
    draw_words(sheet, parts[k], bands[k]);
}

void draw_x_axis(SceneSheet &sheet, const double y)
{
  Drawing &drawing = sheet.drawing;
  const double low = sheet.body.lower_bound(0), high = sheet.body.upper_bound(0),
               offset = axis_offset(low, high);
  const auto at = [&](const double x) { return sheet.page({x, sheet.body.lower_bound(1)})[0]; };
  drawing.line({{at(low), y}, {at(high), y}}, stroke("#000", 1.));
  for (const double x : tick_marks(low - offset, high - offset, (at(high) - at(low)) / 60.))
  {
    drawing.line({{at(offset + x), y}, {at(offset + x), y + 5}}, stroke("#000", 1.));
    drawing.text_at({at(offset + x), y + 18}, {text(x, 6)}, "middle");
  }
  drawing.text_at({(at(low) + at(high)) / 2, y + 34},
                  {axis_label("x", offset, legible(sheet.scene.length_unit))}, "middle");
}

void draw_y_axis(SceneSheet &sheet, const double x)
{
  Drawing &drawing = sheet.drawing;
  const double low = sheet.body.lower_bound(1), high = sheet.body.upper_bound(1),
               offset = axis_offset(low, high);
  const auto at = [&](const double y) { return sheet.page({sheet.body.lower_bound(0), y})[1]; };
  drawing.line({{x, at(low)}, {x, at(high)}}, stroke("#000", 1.));
  double widest = 0;
  for (const double y : tick_marks(low - offset, high - offset, (at(low) - at(high)) / 40.))
  {
    drawing.line({{x, at(offset + y)}, {x - 5, at(offset + y)}}, stroke("#000", 1.));
    drawing.text_at({x - 8, at(offset + y) + 4}, {text(y, 6)}, "end");
    widest = std::max(widest, text_width(text(y, 6), Drawing::font_size, false));
  }
  drawing.text_upwards({x - widest - 18, (at(low) + at(high)) / 2},
                       axis_label("y", offset, legible(sheet.scene.length_unit)));
}

/** Below and to the left of all that is drawn. */
void draw_axes(SceneSheet &sheet)
{
  const PageBox extent = sheet.drawing.extent();
  sheet.drawing.begin("axes");
  draw_x_axis(sheet, extent.bottom + 14.);
  draw_y_axis(sheet, extent.left - 14.);
  sheet.drawing.end();
}

/** Which material has which colour, where there are several. */
void draw_key(SceneSheet &sheet, const Triangulation<2> &mesh)
{
  const Scene<2> &scene = sheet.scene;
  if (scene.materials.size() < 2)
    return;
  Drawing &drawing = sheet.drawing;
  const double left = 0;
  double y = drawing.extent().bottom + 12.;
  drawing.begin("key");
  for (const std::size_t k : materials_of(mesh))
  {
    drawing.area({{left, y}, {left + 24., y}, {left + 24., y + 14.}, {left, y + 14.}},
                 "fill=\"" + material_colour(k) + "\" " + stroke("#333", 0.8));
    drawing.text_at({left + 32., y + 11.}, {name_in_words(scene, k) + ": " +
                                            material_in_words(scene, scene.materials[k])});
    y += 20.;
  }
  drawing.end();
}

void draw_title(SceneSheet &sheet, const unsigned int n_cells, const bool has_history)
{
  Drawing &drawing = sheet.drawing;
  const double left = drawing.extent().left, top = drawing.extent().top;
  const Scene<2> &scene = sheet.scene;
  const std::string cells = text(n_cells) + (n_cells == 1 ? " coarse cell" : " coarse cells");
  const std::string temperature = temperature_in_words(scene);
  drawing.begin("title");
  drawing.text_at({left, top - 46.}, {legible(scene.title), true}, "start", 15.);
  drawing.text_at(
      {left, top - 27.},
      {cells +
       (scene.materials.size() == 1 ? ", " + material_in_words(scene, scene.materials[0]) : "") +
       (temperature.empty() ? "" : ", " + temperature)});
  if (has_history)
    drawing.text_at({left, top - 11.},
                    {"load history: loads, displacements and gaps are those at its end, t = 1"});
  drawing.end();
}
} // namespace

std::string scene_picture(const Scene<2> &scene)
{
  const Scene<2> last = at_the_end(scene);
  Triangulation<2> mesh;
  make_mesh(last, mesh);
  SceneSheet sheet(last, GridTools::compute_bounding_box(mesh));
  const std::vector<OutlinePart> parts = boundary_parts(mesh);
  const std::vector<MarkedPart> marked = marked_parts(last, parts);
  find_largest(sheet, marked);
  draw_body(sheet, mesh);
  draw_material_axes(sheet, mesh);
  draw_outline(sheet, parts);
  draw_boundaries(sheet, marked);
  draw_body_force(sheet, mesh);
  draw_probes(sheet, parts);
  sheet.drawing.write_notes();
  draw_axes(sheet);
  draw_key(sheet, mesh);
  draw_title(sheet, mesh.n_active_cells(), scene.has_load_history());
  return sheet.drawing.svg(results::picture_head);
}
} // namespace hpvi
