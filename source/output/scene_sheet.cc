// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/output/scene_sheet.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

SceneSheet::SceneSheet(const Scene<2> &scene, const BoundingBox<2> &body)
    : scene(scene), body(body), scale(longest / std::max(body.side_length(0), body.side_length(1)))
{
}

PagePoint SceneSheet::page(const Point<2> &x) const
{
  return {scale * (x[0] - body.lower_bound(0)), -scale * (x[1] - body.lower_bound(1))};
}

PageVector SceneSheet::direction(const Tensor<1, 2> &vector) const
{
  return PageVector({vector[0], -vector[1]});
}

double SceneSheet::length(const OutlinePart &part) const
{
  return scale * part.length();
}

Station SceneSheet::station(const OutlinePart &part, const double share) const
{
  const OutlinePlace place = part.at(share * part.length());
  const PageVector normal = direction(place.normal);
  return {place.x, page(place.x), normal, PageVector({-normal[1], normal[0]})};
}

std::vector<Station> SceneSheet::stations(const OutlinePart &part, const double spacing,
                                          const bool with_ends) const
{
  const double number = length(part) / spacing;
  const unsigned int n = std::max(1., with_ends ? std::round(number) : std::floor(number));
  std::vector<Station> result;
  for (unsigned int k = 0; k < n + (with_ends ? 1 : 0); ++k)
    result.push_back(station(part, (k + (with_ends ? 0. : 0.5)) / n));
  return result;
}

std::vector<Station> SceneSheet::sample(const OutlinePart &part) const
{
  return stations(part, length(part) / 500., true);
}

Tensor<1, 2> value_of(const std::array<Expression<2>, 2> &components, const Point<2> &x)
{
  Tensor<1, 2> value;
  for (unsigned int c = 0; c < 2; ++c)
    value[c] = components[c] ? components[c]->value(x) : 0.;
  return value;
}

std::string stroke(const std::string &colour, const double width)
{
  return "stroke=\"" + colour + "\" stroke-width=\"" + text(width, 3) + '"';
}
} // namespace hpvi
