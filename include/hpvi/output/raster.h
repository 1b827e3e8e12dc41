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

  /**
   * Linear between three values; each pixel has what @p colour_of makes of its value, from 1 on. So many pixels beyond its edges as well as
   * @p reach says: where an edge is painted by polygons that differ from both sides half a pixel leaves no hole between them.
   */
  template <class ColourOf>
  void triangle(const std::array<RasterPoint, 3> &corners, const std::array<float, 3> &values,
                const ColourOf &colour_of, double reach);

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
                      const ColourOf &colour_of, const double reach)
{
  const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
  const auto [top, bottom] = std::minmax({p[0].y, p[1].y, p[2].y});
  const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
  // pixels whose centres lie within
  const int x_begin = std::max(0., std::ceil(left - reach - 0.5)),
            x_end = std::min(width - 1., std::floor(right + reach - 0.5)),
            y_begin = std::max(0., std::ceil(top - reach - 0.5)),
            y_end = std::min(height - 1., std::floor(bottom + reach - 0.5));
  if (!(std::abs(area) > 0) || x_begin > x_end)
    return;
  const double inverse = 1 / area;
  std::array<double, 3>
      least; // of the shares of the corners: zero on the edge opposite, one at the height above it
  for (unsigned int k = 0; k < 3; ++k)
    least[k] = -1e-9 - reach * std::abs(inverse) *
                           std::hypot(p[(k + 2) % 3].x - p[(k + 1) % 3].x,
                                      p[(k + 2) % 3].y - p[(k + 1) % 3].y);
  const auto [lowest, highest] = std::minmax({values[0], values[1], values[2]});
  for (int y = y_begin; y <= y_end; ++y)
    for (int x = x_begin; x <= x_end; ++x)
    {
      const double dx = x + 0.5 - p[0].x, dy = y + 0.5 - p[0].y;
      const double b = (dx * (p[2].y - p[0].y) - (p[2].x - p[0].x) * dy) * inverse,
                   c = ((p[1].x - p[0].x) * dy - dx * (p[1].y - p[0].y)) * inverse, a = 1 - b - c;
      if (a < least[0] || b < least[1] || c < least[2])
        continue;
      const auto depth = static_cast<float>(a * p[0].depth + b * p[1].depth + c * p[2].depth);
      const std::size_t at = std::size_t(y) * width + x;
      if (pixels[at] != 0 && depth > depths[at])
        continue;
      depths[at] = depth;
      pixels[at] = colour_of(std::clamp(a * values[0] + b * values[1] + c * values[2],
                                        double(lowest), double(highest)));
    }
}
} // namespace hpvi

#endif
