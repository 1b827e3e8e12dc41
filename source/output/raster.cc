// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/output/raster.h>

#include <deal.II/base/exceptions.h>

#include <zlib.h>

namespace hpvi
{
namespace
{
using Bytes = std::vector<unsigned char>;

void add_number(Bytes &bytes, const unsigned long number)
{
  for (const unsigned int shift : {24, 16, 8, 0})
    bytes.push_back(number >> shift & 255U);
}

/** Length, kind, content, checksum of the last two. */
void add_chunk(Bytes &file, const std::string &kind, const Bytes &content)
{
  add_number(file, content.size());
  const std::size_t begin = file.size();
  file.insert(file.end(), kind.begin(), kind.end());
  file.insert(file.end(), content.begin(), content.end());
  add_number(file, crc32(0, file.data() + begin, file.size() - begin));
}

Bytes compressed(const Bytes &content)
{
  uLongf size = compressBound(content.size());
  Bytes result(size);
  const int status = compress2(result.data(), &size, content.data(), content.size(), 2);
  AssertThrow(status == Z_OK, dealii::ExcInternalError());
  result.resize(size);
  return result;
}
} // namespace

Raster::Raster(const unsigned int width, const unsigned int height)
    : width(width), height(height), pixels(std::size_t(width) * height),
      depths(std::size_t(width) * height)
{
}

void Raster::dot(const RasterPoint &centre, const double radius, const unsigned char colour)
{
  for (int y = std::max(0., std::ceil(centre.y - radius - 0.5));
       y <= std::min(height - 1., std::floor(centre.y + radius - 0.5)); ++y)
    for (int x = std::max(0., std::ceil(centre.x - radius - 0.5));
         x <= std::min(width - 1., std::floor(centre.x + radius - 0.5)); ++x)
      if (std::hypot(x + 0.5 - centre.x, y + 0.5 - centre.y) <= radius)
        pixels[std::size_t(y) * width + x] = colour;
}

void Raster::draw_outline(const unsigned char colour)
{
  const std::vector<unsigned char> before = pixels;
  const auto is_empty = [&](const long x, const long y)
  { return x < 0 || y < 0 || x >= long(width) || y >= long(height) || before[y * width + x] == 0; };
  for (long y = 0; y < long(height); ++y)
    for (long x = 0; x < long(width); ++x)
      if (!is_empty(x, y) &&
          (is_empty(x - 1, y) || is_empty(x + 1, y) || is_empty(x, y - 1) || is_empty(x, y + 1)))
        pixels[y * width + x] = colour;
}

std::string Raster::png_base64(const std::vector<Colour> &palette) const
{
  Bytes file{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'}, head, colours, rows;
  add_number(head, width);
  add_number(head, height);
  head.insert(head.end(), {8, 3, 0, 0, 0}); // bits, palette, and the only ways to pack
  add_chunk(file, "IHDR", head);
  for (const Colour &colour : palette)
    colours.insert(colours.end(), {colour.red, colour.green, colour.blue});
  add_chunk(file, "PLTE", colours);
  add_chunk(file, "tRNS", {0}); // colour 0
  rows.reserve(std::size_t(width + 1) * height);
  for (std::size_t y = 0; y < height; ++y)
  {
    rows.push_back(0); // as they are
    rows.insert(rows.end(), pixels.begin() + y * width, pixels.begin() + (y + 1) * width);
  }
  add_chunk(file, "IDAT", compressed(rows));
  add_chunk(file, "IEND", {});
  return base64({file.begin(), file.end()});
}
} // namespace hpvi
