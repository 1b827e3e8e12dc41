// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_colour_bands_h
#define hpvi_colour_bands_h

#include <hpvi/output/drawing.h>
#include <hpvi/output/raster.h>

#include <string>
#include <vector>

namespace hpvi
{
/** Colours of values between two, in bands that the colour-blind tell apart: light for low values, dark for high ones. */
struct Bands
{
  static constexpr unsigned int number = 24, shades = 3;

  double low, high;
  bool is_cut; ///< are there larger values?

  unsigned int operator()(double value) const; ///< the band of a value, from 0

  /** Colour 0 is nothing, then come the bands, in each shade, and at last that of outlines. */
  static std::vector<Colour> palette();

  /** A bar right of @p left, from the top of the page down to @p height, with round numbers. */
  void draw_bar(Drawing &drawing, double left, double height, const std::string &label) const;
};

/** A number of two digits that is no less than @p value; 1 where that is not positive. */
double rounded_up(double value);

/** A name with a unit, as in "pressure [MPa]". */
std::string with_unit_of(const std::string &name, const std::string &unit);

/** Colours of the states of contact, by their names. */
std::string state_colour(const std::string &state);
} // namespace hpvi

#endif
