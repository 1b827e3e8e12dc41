// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/grid/grid_tools.h>
#include <hpvi/base/formatting.h>
#include <hpvi/output/cell_outline.h>
#include <hpvi/output/chart_axes.h>
#include <hpvi/output/mesh_picture.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Light for low degrees, dark for high ones; the same in every picture, so that steps compare. */
const char *colour(const unsigned int degree)
{
  static const char *const colours[] = {"#fffde0", "#fdf3a0", "#e6e66a", "#b4d857",
                                        "#78c664", "#3fab78", "#1f8c86", "#276f8e",
                                        "#33538f", "#443a85", "#471b6d", "#2d0a44"};
  return colours[std::clamp(degree, 1U, 12U) - 1];
}

const char *text_colour(const unsigned int degree)
{
  return degree < 7 ? "#000" : "#fff";
}

/**
 * The mesh as scalable vector graphics. Digits and lines shrink with the cells, so that zooming in
 * shows a graded corner as clearly as the rest. Lengths on the page are pixels.
 */
class MeshPicture
{
public:
  MeshPicture(const StepReport<2> &step);
  std::string svg();

private:
  using Cell = DoFHandler<2>::active_cell_iterator;

  Point<2> page(const Point<2> &x) const; ///< from the plane to the page
  std::string coordinates(const Point<2> &x) const;
  void draw_label(double x, double y, const std::string &label, const std::string &style = "");
  void draw_line(double x1, double y1, double x2, double y2);
  void draw_cells();
  void draw_cell(const Cell &cell, double size);
  void draw_contact();
  void draw_axes();
  void draw_legend();

  const StepReport<2> &step;
  const Triangulation<2> &mesh;
  const BoundingBox<2> box;
  const double scale; ///< pixels per length
  const double width, height, bottom;
  const unsigned int p_min, p_max;
  std::ostringstream out;

  static constexpr double longest = 800., left = 80., top = 64., right = 30., below = 112.;
  static constexpr double swatch = 30.;
};

MeshPicture::MeshPicture(const StepReport<2> &step)
    : step(step), mesh(step.field.dof_handler.get_triangulation()),
      box(GridTools::compute_bounding_box(mesh)),
      scale(longest / std::max(box.side_length(0), box.side_length(1))),
      width(scale * box.side_length(0)), height(scale * box.side_length(1)), bottom(top + height),
      p_min(step.size.p_min()), p_max(step.size.p_max())
{
}

Point<2> MeshPicture::page(const Point<2> &x) const
{
  return {left + scale * (x[0] - box.lower_bound(0)), bottom - scale * (x[1] - box.lower_bound(1))};
}

std::string MeshPicture::coordinates(const Point<2> &x) const
{
  return text(x[0], 10) + ' ' + text(x[1], 10);
}

void MeshPicture::draw_label(const double x, const double y, const std::string &label,
                             const std::string &style)
{
  out << "<text x=\"" << text(x, 6) << "\" y=\"" << text(y, 6) << '"' << style << '>'
      << xml_text(label) << "</text>\n";
}

void MeshPicture::draw_line(const double x1, const double y1, const double x2, const double y2)
{
  out << "<path d=\"M" << text(x1, 6) << ' ' << text(y1, 6) << 'L' << text(x2, 6) << ' '
      << text(y2, 6) << "\" stroke=\"#000\"/>\n";
}

/** A cell in its colour and its degree in the middle; @p size is the shorter side on the page. */
void MeshPicture::draw_cell(const Cell &cell, const double size)
{
  const unsigned int degree = step.field.degree(cell);
  std::string path;
  for (const Point<2> &x : cell_outline(map_of<2>(cell)))
    path += (path.empty() ? "M" : "L") + coordinates(page(x));
  out << "<path d=\"" << path << "Z\" fill=\"" << colour(degree) << "\" stroke-width=\""
      << text(std::min(0.8, 0.03 * size), 4) << "\"/>\n";
  // a scaled text of ordinary size: renderers round tiny font sizes
  out << "<text y=\"3.5\" transform=\"translate(" << coordinates(page(cell->center())) << ") scale("
      << text(0.05 * std::min(size, 80.), 4) << ")\" fill=\"" << text_colour(degree)
      << "\" stroke=\"none\">" << degree << "</text>\n";
}

/** Large cells first, so that their thicker lines do not cover small neighbours. */
void MeshPicture::draw_cells()
{
  std::vector<std::pair<double, Cell>> cells;
  for (const auto &cell : step.field.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      cells.emplace_back(scale * cell->measure() / map_of<2>(cell).longest_edge(), cell);
  std::stable_sort(cells.begin(), cells.end(),
                   [](const auto &a, const auto &b) { return a.first > b.first; });
  out << "<g stroke=\"#333\" stroke-linejoin=\"round\" font-size=\"10\" text-anchor=\"middle\">\n";
  for (const auto &[size, cell] : cells)
    draw_cell(cell, size);
  out << "</g>\n";
}

/** A thick line beside the boundary, where it hides no cell. */
void MeshPicture::draw_contact()
{
  std::string path;
  for (const auto &face : step.field.faces())
  {
    const std::vector<Point<2>> line = face_line(face.map, face.face_no);
    for (unsigned int k = 0; k < line.size(); ++k)
    {
      const Point<1> s(double(k) / (line.size() - 1));
      const Tensor<1, 2> outward =
          4. / scale * face.map.normal(face.face_no, point_on_face<2>(face.face_no, s));
      path += (k == 0 ? 'M' : 'L') + coordinates(page(line[k] + outward));
    }
  }
  if (!path.empty())
    out << "<path d=\"" << path << "\" stroke=\"#c4161c\" stroke-width=\"4\" fill=\"none\"/>\n";
}

/** Axes a little off the mesh with round numbers; the label names the unit. */
void MeshPicture::draw_axes()
{
  constexpr double gap = 14., tick = 5.;
  const std::string unit = step.scene.length_unit;
  const Point<2> offset(axis_offset(box.lower_bound(0), box.upper_bound(0)),
                        axis_offset(box.lower_bound(1), box.upper_bound(1)));
  draw_line(left, bottom + gap, left + width, bottom + gap);
  for (const double x :
       tick_marks(box.lower_bound(0) - offset[0], box.upper_bound(0) - offset[0], width / 60.))
  {
    const double at = page({offset[0] + x, 0})[0];
    draw_line(at, bottom + gap, at, bottom + gap + tick);
    draw_label(at, bottom + gap + 18, text(x, 6), " text-anchor=\"middle\"");
  }
  draw_label(left + width / 2, bottom + gap + 36, axis_label("x", offset[0], unit),
             " text-anchor=\"middle\"");
  draw_line(left - gap, top, left - gap, bottom);
  for (const double y :
       tick_marks(box.lower_bound(1) - offset[1], box.upper_bound(1) - offset[1], height / 60.))
  {
    const double at = page({0, offset[1] + y})[1];
    draw_line(left - gap, at, left - gap - tick, at);
    draw_label(left - gap - tick - 3, at + 4, text(y, 6), " text-anchor=\"end\"");
  }
  const std::string place = text(top + height / 2, 6);
  draw_label(18, top + height / 2, axis_label("y", offset[1], unit),
             " text-anchor=\"middle\" transform=\"rotate(-90 18 " + place + ")\"");
}

/** One swatch per degree of this mesh in a row, then the line of the contact boundary. */
void MeshPicture::draw_legend()
{
  const double y = bottom + 72;
  double x = left;
  draw_label(x, y + 15, "degree");
  x += 56;
  for (unsigned int p = p_min; p <= p_max; ++p, x += swatch)
  {
    out << "<rect x=\"" << text(x, 6) << "\" y=\"" << text(y, 6) << "\" width=\"" << swatch
        << "\" height=\"22\" fill=\"" << colour(p) << "\" stroke=\"#333\" stroke-width=\"0.8\"/>\n";
    draw_label(x + swatch / 2, y + 15, text(p),
               std::string(" text-anchor=\"middle\" fill=\"") + text_colour(p) + '"');
  }
  if (!step.field.faces().empty())
  {
    out << "<path d=\"M" << text(x + 24, 6) << ' ' << text(y + 11, 6)
        << "h30\" stroke=\"#c4161c\" stroke-width=\"4\"/>\n";
    draw_label(x + 62, y + 15, "contact boundary");
  }
}

std::string MeshPicture::svg()
{
  const std::string title = step.scene.title;
  // as wide as its widest line: a bold letter of this size takes about 9 pixels
  const double legend = 56 + swatch * (p_max - p_min + 1) + 190;
  const double page_width = left + std::max({width, legend, 9. * title.size(), 7. * 50}) + right;
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << text(page_width, 6)
      << "\" height=\"" << text(bottom + below, 6) << "\" viewBox=\"0 0 " << text(page_width, 6)
      << ' ' << text(bottom + below, 6) << "\" font-family=\"sans-serif\" font-size=\"13\">\n"
      << "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
  draw_label(left, 24, title, " font-size=\"15\" font-weight=\"bold\"");
  draw_label(left, 44,
             "step " + text(step.number) + ": " + text(step.size.n_cells) + " elements, " +
                 text(step.size.n_free) + " free unknowns");
  draw_cells();
  draw_contact();
  draw_axes();
  draw_legend();
  out << "</svg>\n";
  return out.str();
}
} // namespace

std::string mesh_picture(const StepReport<2> &step)
{
  return MeshPicture(step).svg();
}
} // namespace hpvi
