// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/output/boundary_words.h>
#include <hpvi/output/chart_axes.h>
#include <hpvi/output/colour_bands.h>
#include <hpvi/output/scene_sheet.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
namespace
{
/** Viridis, from its light end to its dark one. */
Colour band_colour(const unsigned int band)
{
  static constexpr Colour stops[] = {{253, 231, 37}, {173, 220, 48}, {94, 201, 98},
                                     {40, 174, 128}, {33, 145, 140}, {44, 114, 142},
                                     {59, 82, 139},  {71, 45, 123},  {68, 1, 84}};
  const double at = 8 * (band + 0.5) / Bands::number;
  const unsigned int k = std::min(7U, static_cast<unsigned int>(at));
  const auto between = [&](unsigned char Colour::*const part)
  {
    const double from = stops[k].*part, to = stops[k + 1].*part;
    return static_cast<unsigned char>(std::lround(from + (at - k) * (to - from)));
  };
  return {between(&Colour::red), between(&Colour::green), between(&Colour::blue)};
}

std::string web_colour(const Colour &colour)
{
  constexpr const char *digits = "0123456789abcdef";
  std::string word = "#";
  for (const unsigned int part : {colour.red, colour.green, colour.blue})
  {
    word += digits[part / 16];
    word += digits[part % 16];
  }
  return word;
}
} // namespace

unsigned int Bands::operator()(const double value) const
{
  const double share = (value - low) / (high - low);
  return static_cast<unsigned int>(std::clamp(number * share, 0., number - 1.));
}

double rounded_up(const double value)
{
  if (!(value > 0) || !std::isfinite(value))
    return 1;
  const double unit = std::pow(10., std::floor(std::log10(value)) - 1);
  return unit * std::ceil(value / unit - 1e-9);
}

std::string with_unit_of(const std::string &name, const std::string &unit)
{
  return name + (unit_name(unit).empty() ? "" : " [" + legible(unit_name(unit)) + "]");
}

std::string state_colour(const std::string &state)
{
  return state == "open" ? "#9a9a9a" : state == "slip" ? "#e07b00" : "#1f5fa8";
}

std::vector<Colour> Bands::palette()
{
  std::vector<Colour> palette{{255, 255, 255}};
  for (unsigned int darkness = 0; darkness < shades; ++darkness)
    for (unsigned int band = 0; band < number; ++band)
    {
      Colour colour = band_colour(band);
      for (unsigned char *const part : {&colour.red, &colour.green, &colour.blue})
        *part = static_cast<unsigned char>(*part * (1 - 0.17 * darkness));
      palette.push_back(colour);
    }
  palette.push_back({40, 40, 40});
  return palette;
}

void Bands::draw_bar(Drawing &drawing, const double left, const double height,
                     const std::string &label) const
{
  constexpr double thickness = 16.;
  const double size = std::max(height, 150.), right = left + thickness;
  for (unsigned int band = 0; band < number; ++band)
  {
    const double bottom = size * (number - band) / number, top = bottom - size / number;
    drawing.area({{left, bottom}, {right, bottom}, {right, top}, {left, top}},
                 "fill=\"" + web_colour(band_colour(band)) + '"');
  }
  drawing.line({{left, 0.}, {right, 0.}, {right, size}, {left, size}, {left, 0.}},
               stroke("#333", 0.8));
  double widest = 0;
  for (const double value : tick_marks(low, high, std::max(3., size / 30)))
  {
    const double y = size * (high - value) / (high - low);
    const std::string words = text(value, 6);
    drawing.line({{right, y}, {right + 5, y}}, stroke("#333", 0.8));
    drawing.text_at({right + 8, y + 4}, {words});
    widest = std::max(widest, text_width(words, Drawing::font_size, false));
  }
  drawing.text_upwards({right + 24 + widest, size / 2}, label);
  if (is_cut)
    drawing.text_at({left, -8.}, {"more"});
}
} // namespace hpvi
