// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/tolerances.h>
#include <hpvi/plane/coarse_cuts.h>

#include <algorithm>

namespace hpvi::coarse_cuts
{
using namespace dealii;

bool varies(const Expression<2> &component)
{
  return component && !is_constant<2>(component);
}

unsigned int coarse_index(Cell cell)
{
  while (cell->level() > 0)
    cell = cell->parent();
  return cell->index();
}

BoundingBox<2> part_of_coarse(Cell cell)
{
  Point<2> lower;
  double width = 1;
  for (; cell->level() > 0; cell = cell->parent())
  {
    unsigned int child = 0;
    while (cell->parent()->child(child) != cell)
      ++child;
    for (unsigned int d = 0; d < 2; ++d)
      lower[d] = (lower[d] + (child >> d & 1)) / 2;
    width /= 2;
  }
  return BoundingBox<2>({lower, lower + Point<2>(width, width)});
}

std::optional<BoundingBox<2>> seen_from(const BoundingBox<2> &part, const BoundingBox<2> &box)
{
  Point<2> lower, upper;
  for (unsigned int d = 0; d < 2; ++d)
  {
    const auto in_part = [&](const double x)
    {
      const double s = (x - part.lower_bound(d)) / part.side_length(d);
      return std::min(std::max(s, 0.), 1.);
    };
    lower[d] = in_part(box.lower_bound(d));
    upper[d] = in_part(box.upper_bound(d));
    if (upper[d] - lower[d] < same_cut)
      return {};
  }
  return BoundingBox<2>({lower, upper});
}

std::vector<double> seen_from(const double lower, const double width,
                              const std::vector<double> &cuts)
{
  std::vector<double> result{0.};
  for (const double cut : cuts)
    if (const double s = (cut - lower) / width; s > result.back() + same_cut && s < 1 - same_cut)
      result.push_back(s);
  result.push_back(1.);
  return result;
}

unsigned int n_parts(const Cell &cell, const unsigned int of_side, const unsigned int n_cells,
                     const unsigned int least)
{
  const unsigned int per_cell = 1U << std::min(cell->level(), 30); // of a coarse one
  return std::max(least, (of_side - 1) / n_cells / per_cell + 1);
}

CutRule cut_edge(const Function<2> &f, const Cell &cell, const unsigned int face,
                 const Scene<2> &scene, const QGauss<1> &gauss, const unsigned int finer)
{
  const CellMap<2> map = map_of<2>(cell);
  return make_cut_rule(
      [&](const double s) { return f.value(map.point(point_on_face<2>(face, Point<1>(s)))); },
      gauss, {0, 1, 2}, n_parts(cell, 32 * finer, scene.geometry.n_cells(1 - face / 2), 4));
}
} // namespace hpvi::coarse_cuts
