// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/output/chart.h>
#include <hpvi/output/colour_bands.h>
#include <hpvi/output/contact_picture.h>
#include <hpvi/output/run_files.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hpvi
{
namespace
{
struct Spot
{
  std::array<double, 3> x;
  double pressure;
  unsigned char state; ///< its number in state_names
};

constexpr const char *state_names[] = {"open", "slip", "stick"};

std::vector<Spot> spots_of(const std::vector<Record> &contact)
{
  std::vector<Spot> spots;
  for (const Record &row : contact)
  {
    const auto field = [&](const char *const column) { return number_of(row, column).value_or(0); };
    const std::string state = words_of(row, "state");
    spots.push_back({{{field("x"), field("y"), field("z")}},
                     -field("normal_traction"),
                     static_cast<unsigned char>(state == "open"   ? 0
                                                : state == "slip" ? 1
                                                                  : 2)});
  }
  return spots;
}

/** The two axes in which they extend most. */
struct Frame
{
  explicit Frame(const std::vector<Spot> &spots);

  RasterPoint page(const Spot &spot) const
  {
    return {radius + scale * (spot.x[across] - low[across]),
            radius + scale * (high[up] - spot.x[up])};
  }

  unsigned int across = 0, up = 1;
  std::array<double, 3> low, high;
  double scale, radius; ///< of a spot [pixels]
  unsigned int width, height;
};

Frame::Frame(const std::vector<Spot> &spots)
{
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  for (const Spot &spot : spots)
    for (unsigned int d = 0; d < 3; ++d)
    {
      low[d] = std::min(low[d], spot.x[d]);
      high[d] = std::max(high[d], spot.x[d]);
    }
  const auto size = [&](const unsigned int d) { return high[d] - low[d]; };
  const unsigned int least = size(2) <= size(0) && size(2) <= size(1) ? 2
                             : size(1) <= size(0)                     ? 1
                                                                      : 0;
  across = least == 0 ? 1 : 0;
  up = least == 2 ? 1 : 2;
  constexpr double longest = 400.;
  scale = longest / std::max({size(across), size(up), 1e-300});
  radius = std::clamp(1.1 * scale * std::sqrt(size(across) * size(up) / spots.size()), 1.5, 40.);
  width = static_cast<unsigned int>(std::ceil(scale * size(across) + 2 * radius));
  height = static_cast<unsigned int>(std::ceil(scale * size(up) + 2 * radius));
}

std::string png_of_states(const std::vector<Spot> &spots, const Frame &frame)
{
  Raster raster(frame.width, frame.height);
  for (const Spot &spot : spots)
    raster.dot(frame.page(spot), frame.radius, 1 + spot.state);
  return raster.png_base64({{255, 255, 255}, {154, 154, 154}, {224, 123, 0}, {31, 95, 168}});
}

std::string png_of_pressure(const std::vector<Spot> &spots, const Frame &frame, const Bands &bands)
{
  Raster raster(frame.width, frame.height);
  for (const Spot &spot : spots)
    raster.dot(frame.page(spot), frame.radius,
               static_cast<unsigned char>(1 + bands(spot.pressure)));
  return raster.png_base64(Bands::palette());
}
} // namespace

std::string contact_picture(const std::vector<Record> &contact, const std::string &unit)
{
  const std::vector<Spot> spots = spots_of(contact);
  const Frame frame(spots);
  std::vector<double> pressures;
  double lowest = 0;
  for (const Spot &spot : spots)
  {
    pressures.push_back(spot.pressure);
    lowest = std::min(lowest, spot.pressure);
  }
  const double highest = cut_off(pressures);
  const Bands bands{lowest, rounded_up(highest),
                    *std::max_element(pressures.begin(), pressures.end()) > rounded_up(highest)};
  constexpr double size = 210. / 400.; // of the page
  const double width = size * frame.width, height = size * frame.height, second = width + 30;
  Drawing drawing;
  drawing.image({0, 0, width, height}, png_of_states(spots, frame));
  drawing.image({second, 0, second + width, height}, png_of_pressure(spots, frame, bands));
  bands.draw_bar(drawing, second + width + 16, height, with_unit_of("pressure", unit));
  double x = 0;
  for (const char *const state : state_names)
  {
    drawing.area({{x, height + 12}, {x + 18, height + 12}, {x + 18, height + 24}, {x, height + 24}},
                 "fill=\"" + state_colour(state) + '"');
    drawing.text_at({x + 23, height + 23}, {state});
    x += 64;
  }
  drawing.text_at({second, height + 23},
                  {std::string("across: ") + "xyz"[frame.across] + ", up: " + "xyz"[frame.up]});
  return drawing.svg("contact");
}
} // namespace hpvi
