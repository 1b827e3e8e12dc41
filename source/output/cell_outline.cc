// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/output/cell_outline.h>

namespace hpvi
{
using namespace dealii;

std::vector<Point<2>> face_line(const CellMap<2> &map, const unsigned int face)
{
  const unsigned int n = map.is_curved() && map.blends()[face] ? 16 : 1;
  std::vector<Point<2>> result;
  for (unsigned int k = 0; k <= n; ++k)
    if (k == 0 || k == n)
      result.push_back(map.vertices()[GeometryInfo<2>::face_to_cell_vertices(face, k / n)]);
    else
      result.push_back(map.point(point_on_face<2>(face, Point<1>(double(k) / n))));
  return result;
}

std::vector<Point<2>> cell_outline(const CellMap<2> &map)
{
  std::vector<Point<2>> result;
  for (const unsigned int face : {2, 1, 3, 0})
  {
    std::vector<Point<2>> line = face_line(map, face);
    if (face == 3 || face == 0)
      line = {line.rbegin(), line.rend()};
    result.insert(result.end(), line.begin(), line.end() - 1);
  }
  return result;
}
} // namespace hpvi
