// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_chart_h
#define hpvi_chart_h

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace hpvi
{
/** One line of a chart. It breaks where a coordinate is no number. */
struct ChartLine
{
  std::string name, colour;
  std::string dashes; ///< as SVG has them; empty: drawn through
  bool has_marks = false;
  std::vector<std::array<double, 2>> points;
};

/** A part of the horizontal axis in a colour, with a name that the key tells. */
struct ChartBand
{
  double begin, end;
  std::string colour;
};

/** Lines over one axis. */
struct Chart
{
  std::string title, x_label, y_label;
  bool is_logarithmic = false; ///< the vertical axis
  std::vector<ChartLine> lines;
  std::vector<ChartBand> bands;                           ///< below the lines
  std::vector<std::pair<std::string, std::string>> names; ///< of colours of bands
  std::optional<double> lowest, highest;                  ///< where values are cut off

  /** As scalable vector graphics. */
  std::string svg() const;
};

/**
 * The largest of @p values, or where a few of them, as near a singularity, stand far above all others, what
 * these few exceed.
 */
double cut_off(std::vector<double> values);
} // namespace hpvi

#endif
