// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/body/cell_map.h>
#include <hpvi/body/load_quadrature.h>
#include <hpvi/body/strain_points.h>

#include <algorithm>

namespace hpvi
{
using namespace dealii;

CellKey cell_key(const Triangulation<2>::cell_iterator &cell, const unsigned int number)
{
  const CellId::binary_type id = cell->id().to_binary<2>();
  return {{id[0], id[1], id[2], id[3], number}};
}

unsigned int strain_points(const Scene<2> &scene, const Triangulation<2>::cell_iterator &cell,
                           const unsigned int degree, const ShapeTables<2> &tables)
{
  const InitialStrain<2> &initial = scene.initial_strains[cell->material_id()];
  const CellMap<2> map = map_of<2>(cell);
  const auto value = [&](const Function<2> &component, const Point<2> &s)
  { return component.value(map.point(s)); };
  unsigned int n = degree + 3;
  for (const std::array<Expression<2>, 2> &pair :
       {std::array<Expression<2>, 2>{{initial.components[0], initial.components[1]}},
        {{initial.components[2], initial.components[3]}},
        {{initial.temperature, nullptr}}})
    n = std::max(n, rule_on<2>({BoundingBox<2>({Point<2>(), Point<2>(1., 1.)})}, degree + 1, pair,
                               value, tables)
                        .n_gauss);
  return n;
}
} // namespace hpvi
