// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/processes.h>
#include <hpvi/plane/cell_map.h>
#include <hpvi/plane/load_quadrature.h>
#include <hpvi/plane/shape_tables.h>
#include <hpvi/space/load_work.h>
#include <hpvi/space/strain_loads.h>

#include <deal.II/base/quadrature_lib.h>

#include <cmath>
#include <vector>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Of the unit cell, then of its faces. */
template <int dim>
std::vector<ShapeTable<dim>> tables_of(const unsigned int degree, const unsigned int n_points)
{
  const QGauss<dim> cell(n_points);
  const QGauss<dim - 1> face(n_points);
  std::vector<ShapeTable<dim>> result{
      tabulate<dim>(degree, cell.get_points(), cell.get_weights(), false)};
  for (const unsigned int f : GeometryInfo<dim>::face_indices())
  {
    std::vector<Point<dim>> points;
    for (const Point<dim - 1> &point : face.get_points())
      points.push_back(point_on_face<dim>(f, point));
    result.push_back(tabulate<dim>(degree, points, face.get_weights(), false));
  }
  return result;
}

/** Of a load on a cell or face on which @p table has its points, `measure(x)` being dx over that of the reference. */
template <int dim, class Measure>
double work_on(const CellMap<dim> &map, const Load<dim> &load, const ShapeTable<dim> &table,
               const Measure &measure, const CellField<dim> &field)
{
  double sum = 0;
  for (unsigned int q = 0; q < table.points.size(); ++q)
  {
    Tensor<1, dim> u;
    for (unsigned int i = 0; i < field.size(); ++i)
      u += table.values(q, i) * field[i];
    sum += table.weights[q] * measure(table.points[q]) *
           (load_at<dim>(load, map.point(table.points[q])) * u);
  }
  return sum;
}
} // namespace

template <int dim>
double load_work(const Scene<dim> &scene, const PrimalSpace<dim> &space, const DistributedVector &u,
                 const unsigned int finer)
{
  std::vector<std::vector<ShapeTable<dim>>> of_degrees;
  for (const BoxTables<dim> &own : space.tables.all)
    of_degrees.push_back(tables_of<dim>(own.degree, finer * (own.degree + 1)));
  const StrainLoads<dim> strains(scene, space, finer);
  const bool has_inner_loads = scene.has_body_force() || scene.has_initial_strain();
  return sum_collectively(
             space.communicator(),
             [&]()
             {
               double sum = 0;
               for (const auto &cell : space.dof_handler.active_cell_iterators())
               {
                 if (!cell->is_locally_owned() || !(has_inner_loads || cell->at_boundary()))
                   continue;
                 const std::vector<ShapeTable<dim>> &tables =
                     of_degrees[space.tables.number_of(cell)];
                 const CellField<dim> field = space.field(cell, u);
                 if (scene.has_initial_strain())
                   sum += product<dim>(strains.load(cell), field);
                 const CellMap<dim> map = map_of<dim>(cell);
                 if (scene.has_body_force())
                   sum += work_on<dim>(
                       map, scene.body_force_in(cell), tables[0],
                       [&](const Point<dim> &x) { return std::abs(determinant(map.jacobian(x))); },
                       field);
                 for (const unsigned int f : cell->face_indices())
                   if (cell->at_boundary(f))
                     if (const BoundaryCondition<dim> &condition =
                             scene.boundaries[cell->face(f)->boundary_id()];
                         condition.has_traction())
                       sum += work_on<dim>(
                           map, condition.traction, tables[1 + f],
                           [&](const Point<dim> &x) { return map.face_measure(f, x); }, field);
               }
               return sum;
             }) +
         plate_work(scene, space.plates, u);
}

template double load_work(const Scene<2> &, const PrimalSpace<2> &, const DistributedVector &,
                          unsigned int);
template double load_work(const Scene<3> &, const PrimalSpace<3> &, const DistributedVector &,
                          unsigned int);
} // namespace hpvi
