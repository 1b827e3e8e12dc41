// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/output/colour_bands.h>
#include <hpvi/output/drawing.h>
#include <hpvi/output/field_picture.h>
#include <hpvi/output/outline_part.h>
#include <hpvi/output/raster.h>
#include <hpvi/output/run_files.h>
#include <hpvi/output/scene_sheet.h>
#include <hpvi/plane/mesh.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr double page_size = 440.; ///< of the longer side on the page

/** The same in pixels: in space most of what is painted lies behind something. */
template <int dim>
constexpr double pixel_size = dim == 2 ? 880. : 600.;

/** Weighed by the areas of the quads: what a few small ones at a singularity exceed is cut off. */
Bands bands_of(const SampledField &field)
{
  std::vector<std::pair<double, double>> values; // and areas
  double total = 0, lowest = std::numeric_limits<double>::infinity(), highest = 0;
  for (const auto &quad : field.quads)
  {
    std::array<Tensor<1, 3>, 2> diagonals;
    double mean = 0;
    for (unsigned int d = 0; d < 3; ++d)
      for (unsigned int k = 0; k < 2; ++k)
        diagonals[k][d] = field.points[quad[k + 2]][d] - field.points[quad[k]][d];
    for (const unsigned int corner : quad)
    {
      const double value = field.von_mises[corner];
      mean += value / 4;
      lowest = std::min(lowest, value);
      highest = std::max(highest, value);
    }
    values.emplace_back(mean, cross_product_3d(diagonals[0], diagonals[1]).norm() / 2);
    total += values.back().second;
  }
  std::sort(values.begin(), values.end());
  double sum = 0, almost_all = highest;
  for (const auto &[value, area] : values)
    if ((sum += area) > 0.995 * total)
    {
      almost_all = value;
      break;
    }
  const bool is_cut = highest > 1.5 * almost_all && almost_all > 0;
  const double high = rounded_up(is_cut ? almost_all : highest);
  // Where stress is uniform only round-off would differ between its least and its largest value.
  const bool is_uniform = highest - lowest < 1e-6 * highest;
  return {lowest < 0.3 * high || is_uniform ? 0. : lowest, high, is_cut};
}

/** From the body to a page. */
template <int dim>
class View
{
public:
  View(const SampledField &field, const double magnification);

  RasterPoint page(const std::array<double, 3> &x) const; ///< [pixels of the raster]
  PagePoint on_drawing(const std::array<double, 3> &x) const;
  RasterPoint direction(const std::array<double, 3> &x) const; ///< not scaled

  std::vector<RasterPoint> points; ///< those of the field, displaced
  unsigned int width, height;

private:
  double scale = 1, left = 0, top = 0;
};

template <int dim>
RasterPoint View<dim>::direction(const std::array<double, 3> &x) const
{
  if (dim == 2)
    return {x[0], -x[1], 0};
  // 25 degrees to the side, and as many from below: the contact at low z is seen
  constexpr double right[] = {0.906, 0.423, 0.}, up[] = {0.179, -0.383, 0.906},
                   forward[] = {-0.383, 0.821, 0.423};
  double r = 0, u = 0, f = 0;
  for (unsigned int d = 0; d < 3; ++d)
  {
    r += right[d] * x[d];
    u += up[d] * x[d];
    f += forward[d] * x[d];
  }
  return {r, -u, f};
}

template <int dim>
View<dim>::View(const SampledField &field, const double magnification)
{
  double right = -std::numeric_limits<double>::infinity(), bottom = right;
  left = top = -right;
  for (std::size_t k = 0; k < field.points.size(); ++k)
  {
    std::array<double, 3> x = field.points[k];
    for (unsigned int d = 0; d < 3; ++d)
      x[d] += magnification * field.displacements[k][d];
    points.push_back(direction(x));
    left = std::min(left, points.back().x);
    right = std::max(right, points.back().x);
    top = std::min(top, points.back().y);
    bottom = std::max(bottom, points.back().y);
  }
  scale = pixel_size<dim> / std::max(right - left, bottom - top);
  for (RasterPoint &point : points)
    point = {scale * (point.x - left), scale * (point.y - top), scale * point.depth};
  width = std::max(1., std::ceil(scale * (right - left)));
  height = std::max(1., std::ceil(scale * (bottom - top)));
}

template <int dim>
RasterPoint View<dim>::page(const std::array<double, 3> &x) const
{
  const RasterPoint point = direction(x);
  return {scale * (point.x - left), scale * (point.y - top), scale * point.depth};
}

template <int dim>
PagePoint View<dim>::on_drawing(const std::array<double, 3> &x) const
{
  const RasterPoint point = page(x);
  return page_size / pixel_size<dim> * PagePoint(point.x, point.y);
}

/** 1, 2, 5, 10, ... times: the largest displacement is a twelfth of the body at most, or as large as it is. */
double magnification_of(const SampledField &field)
{
  double largest = 0;
  std::array<double, 3> low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < field.points.size(); ++k)
  {
    const auto &u = field.displacements[k];
    largest = std::max(largest, double(std::hypot(u[0], u[1], u[2])));
    for (unsigned int d = 0; d < 3; ++d)
    {
      low[d] = std::min(low[d], field.points[k][d]);
      high[d] = std::max(high[d], field.points[k][d]);
    }
  }
  const double size = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]}),
               wanted = size / 12 / largest;
  if (!(wanted > 1) || !std::isfinite(wanted))
    return 1;
  const double decade = std::pow(10., std::floor(std::log10(wanted)));
  return decade * (wanted >= 5 * decade ? 5 : wanted >= 2 * decade ? 2 : 1);
}

/** In space a face is the darker the more it is turned away from the light. */
template <int dim>
unsigned int shade(const std::array<RasterPoint, 4> &p)
{
  if (dim == 2)
    return 0;
  Tensor<1, 3> one({p[2].x - p[0].x, p[2].y - p[0].y, p[2].depth - p[0].depth}),
      other({p[3].x - p[1].x, p[3].y - p[1].y, p[3].depth - p[1].depth});
  Tensor<1, 3> normal = cross_product_3d(one, other);
  const double norm = normal.norm();
  if (!(norm > 0))
    return 0;
  normal *= (normal[2] > 0 ? -1 : 1) / norm; // towards the eye
  const double light = -0.35 * normal[0] - 0.45 * normal[1] - 0.82 * normal[2];
  return light > 0.75 ? 0 : light > 0.4 ? 1 : 2;
}

/** All quads with a number at each of their corners; @p colour_of as Raster::triangle() wants it, given the shade. */
template <int dim, class ColourOf>
Raster painted(const SampledField &field, const View<dim> &view, const ColourOf &colour_of)
{
  Raster raster(view.width, view.height);
  for (std::size_t k = 0; k < field.quads.size(); ++k)
  {
    const auto &quad = field.quads[k];
    std::array<RasterPoint, 4> p;
    for (unsigned int corner = 0; corner < 4; ++corner)
      p[corner] = view.points[quad[corner]];
    const unsigned int darkness = shade<dim>(p);
    const auto of = [&](const double value) { return colour_of(k, value, darkness); };
    const auto value = [&](const unsigned int corner) { return field.von_mises[quad[corner]]; };
    constexpr double reach =
        dim == 2 ? 0.5 : 0.; // in space faces that are hidden would come to light
    raster.triangle({{p[0], p[1], p[2]}}, {{value(0), value(1), value(2)}}, of, reach);
    raster.triangle({{p[0], p[2], p[3]}}, {{value(0), value(2), value(3)}}, of, reach);
  }
  return raster;
}

} // namespace

namespace
{
/** Before its displacement, dashed. */
void draw_undeformed(Drawing &drawing, const Scene<2> &scene, const View<2> &view)
{
  Triangulation<2> mesh;
  make_mesh(scene, mesh);
  for (const OutlinePart &part : boundary_parts(mesh))
  {
    std::vector<PagePoint> line;
    for (const Point<2> &x : part.points())
      line.push_back(view.on_drawing({{x[0], x[1], 0.}}));
    drawing.line(line, stroke("#777", 0.8) + " stroke-dasharray=\"4 3\"");
  }
}

/** The place of the field's point that is nearest. */
PagePoint displaced(const Point<2> &x, const SampledField &field, const View<2> &view)
{
  std::size_t nearest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < field.points.size(); ++k)
  {
    const double dx = field.points[k][0] - x[0], dy = field.points[k][1] - x[1],
                 square = dx * dx + dy * dy;
    nearest = square < least ? k : nearest;
    least = std::min(least, square);
  }
  return page_size / pixel_size<2> * PagePoint(view.points[nearest].x, view.points[nearest].y);
}

/** States of contact along the body, each in its colour; of many points some, and all where the state changes. */
void draw_states(Drawing &drawing, const SampledField &field, const View<2> &view,
                 const std::vector<Record> &contact)
{
  std::vector<PagePoint> line;
  std::string state, side;
  const auto finish = [&]()
  {
    if (line.size() > 1)
      drawing.line(line, stroke("#fff", 6.) + " stroke-linecap=\"round\"");
    if (line.size() > 1)
      drawing.line(line, stroke(state_colour(state), 4.) + " stroke-linecap=\"round\"");
  };
  const std::size_t stride = 1 + contact.size() / 60;
  for (std::size_t k = 0; k < contact.size(); ++k)
  {
    const Record &row = contact[k];
    const std::string own = words_of(row, "state"),
                      its_side = words_of(row, "contact") + words_of(row, "boundary");
    const bool changes = own != state || its_side != side,
               ends = k + 1 == contact.size() || words_of(contact[k + 1], "state") != own;
    if (!changes && !ends && k % stride != 0)
      continue;
    const PagePoint at =
        displaced({number_of(row, "x").value_or(0), number_of(row, "y").value_or(0)}, field, view);
    const bool is_far = !line.empty() && line.back().distance(at) > page_size / 4;
    if (changes || is_far)
    {
      const bool hangs_together = its_side == side && !line.empty() && !is_far;
      const PagePoint last = line.empty() ? at : line.back();
      finish();
      line.clear();
      if (hangs_together)
        line.push_back(last);
    }
    line.push_back(at);
    state = own;
    side = its_side;
  }
  finish();
}

void draw_more(Drawing &drawing, const Scene<2> &scene, const SampledField &field,
               const View<2> &view, const std::vector<Record> &contact)
{
  draw_undeformed(drawing, scene, view);
  draw_states(drawing, field, view, contact);
  if (contact.empty())
    return;
  double x = 0;
  const double y = page_size / pixel_size<2> * view.height + 26.;
  for (const std::string state : {"open", "slip", "stick"})
  {
    drawing.line({{x, y - 4}, {x + 22, y - 4}}, stroke(state_colour(state), 4.));
    drawing.text_at({x + 27, y}, {state});
    x += 70;
  }
}

/** Which way the axes go. */
void draw_more(Drawing &drawing, const Scene<3> &, const SampledField &, const View<3> &view,
               const std::vector<Record> &)
{
  const PagePoint origin(16., page_size / pixel_size<3> * view.height + 50.);
  for (unsigned int d = 0; d < 3; ++d)
  {
    std::array<double, 3> axis{};
    axis[d] = 1;
    const RasterPoint way = view.direction(axis);
    const PagePoint end = origin + 32. * PageVector({way.x, way.y});
    drawing.arrow(origin, end, ArrowHead::filled, "#333");
    drawing.text_at(end + PageVector({5., 4.}), {std::string(1, "xyz"[d])});
  }
}
} // namespace

template <int dim>
FieldPicture stress_picture(const Scene<dim> &scene, const SampledField &field,
                            const std::vector<Record> &contact)
{
  const double magnification = magnification_of(field);
  const View<dim> view(field, magnification);
  const Bands bands = bands_of(field);
  Raster raster = painted(field, view,
                          [&](std::size_t, const double value, const unsigned int darkness)
                          { return 1U + bands(value) + Bands::number * darkness; });
  const std::vector<Colour> palette = Bands::palette();
  raster.draw_outline(palette.size() - 1);
  const double scale = page_size / pixel_size<dim>;
  Drawing drawing;
  drawing.image({0, 0, scale * view.width, scale * view.height}, raster.png_base64(palette));
  draw_more(drawing, scene, field, view, contact);
  bands.draw_bar(drawing, drawing.extent().right + 24., scale * view.height,
                 with_unit_of("von Mises stress", scene.stress_unit));
  return {drawing.svg("stress"),
          "von Mises stress on the deformed body, displacements drawn " +
              (magnification == 1 ? std::string("as large as they are")
                                  : text(magnification, 6) + " times larger than they are") +
              (dim == 2 ? "; dashed: the body before" : "; seen from below") +
              (bands.is_cut ? "; the darkest colour stands for all that is more, too" : "") +
              (magnification > 1 && (scene.has_pairs() || scene.has_unilateral_contact())
                   ? "; gaps are drawn as they are, so that bodies may seem to overlap"
                   : "")};
}

std::string degree_picture(const SampledField &field)
{
  const View<2> view(field, 0.);
  float highest = 1;
  for (const float degree : field.degrees)
    highest = std::max(highest, degree);
  const Bands bands{1., highest + 1., false};
  Raster raster = painted(field, view,
                          [&](const std::size_t quad, double, unsigned int)
                          { return 1 + bands(field.degrees[quad] + 0.5); });
  const std::vector<Colour> palette = Bands::palette();
  raster.draw_outline(palette.size() - 1);
  const double scale = page_size / pixel_size<2>;
  Drawing drawing;
  drawing.image({0, 0, scale * view.width, scale * view.height}, raster.png_base64(palette));
  bands.draw_bar(drawing, drawing.extent().right + 24., scale * view.height, "polynomial degree");
  return drawing.svg("degrees");
}

template FieldPicture stress_picture(const Scene<2> &, const SampledField &,
                                     const std::vector<Record> &);
template FieldPicture stress_picture(const Scene<3> &, const SampledField &,
                                     const std::vector<Record> &);
} // namespace hpvi
