// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_raster_h
#define hpvi_raster_h

#include <array>
#include <string>
#include <vector>

namespace hpvi
{
/** A colour of a screen. */
struct Colour
{
  unsigned char red, green, blue;
};

/** A place on a picture, y down [pixels], and how far behind the page it is. */
struct RasterPoint
{
  double x, y, depth = 0;
};

/** A picture of cells: what is nearest is seen. */
class Raster
{
public:
  Raster(unsigned int width, unsigned int height);

  /** Linear between three values; each pixel has what @p colour_of makes of its value, from 1 on. */
  template <class ColourOf>
  void triangle(const std::array<RasterPoint, 3> &corners, const std::array<float, 3> &values,
                const ColourOf &colour_of);

  void dot(const RasterPoint &centre, double radius, unsigned char colour);

  /** Pixels with nothing beside them get @p colour. */
  void draw_outline(unsigned char colour);

  /** As PNG, ready to stand in a page as `data:image/png;base64,`; colour k is palette[k], 0 nothing. */
  std::string png_base64(const std::vector<Colour> &palette) const;

  const unsigned int width, height;

private:
  std::vector<unsigned char> pixels;
  std::vector<float> depths;
};
} // namespace hpvi

#include <algorithm>
#include <cmath>

namespace hpvi
{
template <class ColourOf>
void Raster::triangle(const std::array<RasterPoint, 3> &p, const std::array<float, 3> &values,
                      const ColourOf &colour_of)
{
  const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
  const auto [top, bottom] = std::minmax({p[0].y, p[1].y, p[2].y});
  const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
  // pixels whose centres lie within
  const int x_begin = std::max(0., std::ceil(left - 0.5)),
            x_end = std::min(width - 1., std::floor(right - 0.5)),
            y_begin = std::max(0., std::ceil(top - 0.5)),
            y_end = std::min(height - 1., std::floor(bottom - 0.5));
  if (!(std::abs(area) > 0) || x_begin > x_end)
    return;
  const double inverse = 1 / area;
  for (int y = y_begin; y <= y_end; ++y)
    for (int x = x_begin; x <= x_end; ++x)
    {
      const double dx = x + 0.5 - p[0].x, dy = y + 0.5 - p[0].y;
      const double b = (dx * (p[2].y - p[0].y) - (p[2].x - p[0].x) * dy) * inverse,
                   c = ((p[1].x - p[0].x) * dy - dx * (p[1].y - p[0].y)) * inverse, a = 1 - b - c;
      if (a < -1e-9 || b < -1e-9 || c < -1e-9)
        continue;
      const auto depth = static_cast<float>(a * p[0].depth + b * p[1].depth + c * p[2].depth);
      const std::size_t at = std::size_t(y) * width + x;
      if (pixels[at] != 0 && depth > depths[at])
        continue;
      depths[at] = depth;
      pixels[at] = colour_of(a * values[0] + b * values[1] + c * values[2]);
    }
}
} // namespace hpvi

#endif
