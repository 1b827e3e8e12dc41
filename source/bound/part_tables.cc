// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/memo_table.h>
#include <hpvi/bound/part_tables.h>

#include <vector>

namespace hpvi
{
using namespace dealii;

const ShapeTable<2> &PartTables::in(const BoundingBox<2> &box, const unsigned int degree,
                                    const unsigned int n_gauss, const ShapeTables<2> &tables)
{
  const ShapeTable<2> &whole = tables.gradients(degree, n_gauss);
  if (box.volume() == 1.)
    return whole;
  const Point<2> &corner = box.get_boundary_points().first;
  const auto make = [&]()
  {
    std::vector<Point<2>> points;
    for (const Point<2> &q : whole.points)
      points.push_back(box.unit_to_real(q));
    return tabulate<2>(degree, points, whole.weights, false);
  };
  return memoised(known, {degree, n_gauss, corner[0], corner[1], box.side_length(0)}, make);
}

void PartTables::limit()
{
  if (known.size() > 4000)
    known.clear();
}
} // namespace hpvi
