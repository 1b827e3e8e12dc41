// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/numerical_failure.h>
#include <hpvi/base/text.h>
#include <hpvi/plane/cell_map.h>
#include <hpvi/plane/folded_cell.h>

#include <deal.II/base/quadrature_lib.h>

namespace hpvi
{
using namespace dealii;

std::optional<Point<2>> folded_cell(const Triangulation<2> &mesh)
{
  const QGauss<2> gauss(6);
  for (const auto &cell : mesh.active_cell_iterators())
    if (const CellMap<2> map = map_of<2>(cell); map.is_curved())
      for (const Point<2> &point : gauss.get_points())
        if (!(determinant(map.jacobian(point)) > 0))
          return map.point(point);
  return std::nullopt;
}

void require_no_folds(const Triangulation<2> &mesh)
{
  if (const auto folded = folded_cell(mesh))
    throw NumericalFailure("a cell folds over itself at " + to_string(*folded) +
                           ": a straight edge crosses the curve beside it; take more cells along "
                           "the curve, or fewer layers beside it");
}
} // namespace hpvi
