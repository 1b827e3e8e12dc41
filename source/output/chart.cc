// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/output/chart.h>
#include <hpvi/output/chart_axes.h>
#include <hpvi/output/drawing.h>
#include <hpvi/output/scene_sheet.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hpvi
{
namespace
{
constexpr double width = 400., height = 230.; // of the field [pixels]

struct Range
{
  double low = std::numeric_limits<double>::infinity(),
         high = -std::numeric_limits<double>::infinity();

  void include(const double value)
  {
    if (!std::isfinite(value))
      return;
    low = std::min(low, value);
    high = std::max(high, value);
  }

  bool is_empty() const
  {
    return !(low <= high);
  }

  /** So that lines do not lie on the frame, and a constant has a place. */
  Range widened(const double share) const
  {
    const double size = std::max(high - low, 1e-9 * std::max(std::abs(low), std::abs(high))),
                 margin = size > 0 ? share * size : 1.;
    return {low - margin, high + margin};
  }
};

/** A chart on its page. */
class ChartSheet
{
public:
  explicit ChartSheet(const Chart &chart);
  std::string svg();

private:
  double scaled(double value) const; ///< of the vertical axis
  PagePoint page(double x, double y) const;
  void draw_bands();
  void draw_x_axis();
  void draw_y_axis();
  void draw_grid_line(double y, const std::string &label);
  void draw_lines();
  void draw_key();

  const Chart &chart;
  Range x_range, y_range;
  Drawing drawing;
};

ChartSheet::ChartSheet(const Chart &chart) : chart(chart)
{
  for (const ChartLine &line : chart.lines)
    for (const auto &[x, y] : line.points)
      if (std::isfinite(y))
      {
        x_range.include(x);
        y_range.include(scaled(y));
      }
  for (const ChartBand &band : chart.bands)
  {
    x_range.include(band.begin);
    x_range.include(band.end);
  }
  if (!chart.is_logarithmic)
    y_range.include(0.);
  if (x_range.is_empty())
    x_range = {0, 1};
  if (y_range.is_empty())
    y_range = {0, 1};
  x_range = x_range.widened(chart.bands.empty() ? 0.03 : 0.);
  y_range = y_range.widened(0.05);
}

double ChartSheet::scaled(const double value) const
{
  if (chart.is_logarithmic)
    return value > 0 ? std::log10(value) : std::numeric_limits<double>::quiet_NaN();
  return std::clamp(value, chart.lowest.value_or(value), chart.highest.value_or(value));
}

PagePoint ChartSheet::page(const double x, const double y) const
{
  return {width * (x - x_range.low) / (x_range.high - x_range.low),
          height * (y_range.high - y) / (y_range.high - y_range.low)};
}

void ChartSheet::draw_bands()
{
  constexpr double thickness = 9.;
  for (const auto &[begin, end, colour] : chart.bands)
  {
    const double left = page(begin, 0)[0], right = page(end, 0)[0];
    drawing.area(
        {{left, height}, {right, height}, {right, height + thickness}, {left, height + thickness}},
        "fill=\"" + colour + '"');
  }
}

void ChartSheet::draw_x_axis()
{
  const double offset = axis_offset(x_range.low, x_range.high), below = chart.bands.empty() ? 0 : 9;
  for (const double x : tick_marks(x_range.low - offset, x_range.high - offset, 7.))
  {
    const double at = page(offset + x, 0)[0];
    drawing.line({{at, height + below}, {at, height + below + 5}}, stroke("#000", 1.));
    drawing.text_at({at, height + below + 18}, {text(x, 6)}, "middle");
  }
  drawing.text_at({width / 2, height + below + 34}, {axis_label(chart.x_label, offset, "")},
                  "middle");
}

void ChartSheet::draw_grid_line(const double y, const std::string &label)
{
  const double at = page(0, y)[1];
  drawing.line({{0., at}, {width, at}}, stroke("#ddd", 1.));
  drawing.text_at({-6., at + 4}, {label}, "end");
}

void ChartSheet::draw_y_axis()
{
  double widest = 0;
  const auto label = [&](const double y, const std::string &words)
  {
    draw_grid_line(y, words);
    widest = std::max(widest, text_width(words, Drawing::font_size, false));
  };
  const double n_decades = chart.is_logarithmic ? y_range.high - y_range.low : 0;
  if (n_decades > 1.2)
  {
    // Of few decades 2 and 5 have labels, too.
    const int apart = std::ceil(n_decades / 8), factors[] = {1, 2, 5};
    for (int k = std::floor(y_range.low); k <= y_range.high; k += apart)
      for (const int factor : factors)
        if (const double y = k + std::log10(factor);
            y >= y_range.low && y <= y_range.high && (factor == 1 || n_decades < 3))
          label(y, text(factor * std::pow(10., k), 3));
  }
  else if (chart.is_logarithmic)
    for (const double y : tick_marks(std::pow(10., y_range.low), std::pow(10., y_range.high), 6.))
      label(std::log10(y), text(y, 6));
  else
    for (const double y : tick_marks(y_range.low, y_range.high, 7.))
      label(y, text(y, 6));
  drawing.text_upwards({-widest - 16, height / 2}, chart.y_label);
}

void ChartSheet::draw_lines()
{
  for (const ChartLine &line : chart.lines)
  {
    const std::string style =
        stroke(line.colour, 1.8) +
        (line.dashes.empty() ? "" : " stroke-dasharray=\"" + line.dashes + '"');
    std::vector<PagePoint> piece;
    const auto draw = [&]()
    {
      if (piece.size() > 1)
        drawing.line(piece, style);
      piece.clear();
    };
    for (const auto &[x, y] : line.points)
      if (const double level = scaled(y); std::isfinite(x) && std::isfinite(level))
      {
        piece.push_back(page(x, level));
        if (line.has_marks)
          drawing.circle(piece.back(), 2.4, "fill=\"" + line.colour + '"');
      }
      else
        draw();
    draw();
  }
}

/** Above the field, from left to right; where a line is full the next begins. */
void ChartSheet::draw_key()
{
  std::vector<std::pair<std::string, const ChartLine *>> entries;
  std::vector<std::string> colours;
  for (const ChartLine &line : chart.lines)
    if (!line.name.empty())
    {
      entries.emplace_back(line.name, &line);
      colours.push_back(line.colour);
    }
  for (const auto &[name, colour] : chart.names)
  {
    entries.emplace_back(name, nullptr);
    colours.push_back(colour);
  }
  double x = 0, y = -12;
  for (std::size_t k = 0; k < entries.size(); ++k)
  {
    const auto &[name, line] = entries[k];
    const double size = 40 + text_width(name, Drawing::font_size, false);
    if (x > 0 && x + size > width)
    {
      x = 0;
      y -= 16;
    }
    if (line)
      drawing.line({{x, y - 4}, {x + 22, y - 4}},
                   stroke(colours[k], 1.8) +
                       (line->dashes.empty() ? "" : " stroke-dasharray=\"" + line->dashes + '"'));
    else
      drawing.area({{x, y - 8}, {x + 22, y - 8}, {x + 22, y}, {x, y}},
                   "fill=\"" + colours[k] + '"');
    drawing.text_at({x + 27, y}, {name});
    x += size;
  }
  if (!chart.title.empty())
    drawing.text_at({0., y - 20}, {chart.title, true});
}

std::string ChartSheet::svg()
{
  draw_y_axis();
  draw_x_axis();
  if (const double zero = page(0, 0)[1]; !chart.is_logarithmic && zero > 0 && zero < height)
    drawing.line({{0., zero}, {width, zero}}, stroke("#888", 1.));
  drawing.line({{0., 0.}, {width, 0.}, {width, height}, {0., height}, {0., 0.}},
               stroke("#333", 1.));
  draw_bands();
  draw_lines();
  draw_key();
  return drawing.svg("chart");
}
} // namespace

std::string Chart::svg() const
{
  return ChartSheet(*this).svg();
}

double cut_off(std::vector<double> values)
{
  values.erase(std::remove_if(values.begin(), values.end(),
                              [](const double value) { return !std::isfinite(value); }),
               values.end());
  if (values.empty())
    return 0;
  std::sort(values.begin(), values.end());
  const double almost_all = values[(values.size() - 1) * 97 / 100];
  return values.back() > 2 * almost_all && almost_all > 0 ? 1.3 * almost_all : values.back();
}
} // namespace hpvi
