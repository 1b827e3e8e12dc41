// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/plane/cell_map.h>
#include <hpvi/space/strain_loads.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <cmath>

namespace hpvi
{
using namespace dealii;

template <int dim>
StrainLoads<dim>::StrainLoads(const Scene<dim> &scene, const PrimalSpace<dim> &space,
                              const unsigned int finer)
    : scene(scene), space(space)
{
  for (const BoxTables<dim> &own : space.tables.all)
  {
    const QGauss<dim> rule(finer * (own.degree + 1));
    tables.push_back(tabulate<dim>(own.degree, rule.get_points(), rule.get_weights(), false));
  }
}

template <int dim>
const ShapeTable<dim> &StrainLoads<dim>::table_on(const Cell &cell) const
{
  return tables[space.tables.number_of(cell)];
}

template <int dim>
bool StrainLoads<dim>::is_strained(const Cell &cell) const
{
  return scene.has_initial_strain() && scene.initial_strains[cell->material_id()];
}

/** Calls @p take with the number of each point of @p cell, eps_0, dx times C eps_0, and the inverse of the map's Jacobian. */
template <int dim>
template <class Take>
void StrainLoads<dim>::for_each_point(const Cell &cell, const Take &take) const
{
  const CellMap<dim> map = map_of<dim>(cell);
  const ShapeTable<dim> &table = table_on(cell);
  const HookesLaw<dim> law(scene.material_of(cell));
  for (unsigned int q = 0; q < table.points.size(); ++q)
  {
    const Tensor<2, dim> J = map.jacobian(table.points[q]),
                         strain = scene.initial_strain_in(cell, map.point(table.points[q]));
    const double volume = table.weights[q] * std::abs(determinant(J));
    take(q, strain, volume * Tensor<2, dim>(law.stress(strain)), invert(J));
  }
}

template <int dim>
CellField<dim> StrainLoads<dim>::load(const Cell &cell) const
{
  CellField<dim> result(space.tables.of(cell).n_shapes);
  if (!is_strained(cell))
    return result;
  const ShapeTable<dim> &table = table_on(cell);
  for_each_point(cell,
                 [&](const unsigned int q, const Tensor<2, dim> &, const Tensor<2, dim> &stress,
                     const Tensor<2, dim> &inverse)
                 {
                   // C eps_0 : grad v = (C eps_0 J^-T) : reference gradient of v
                   const Tensor<2, dim> pulled = stress * transpose(inverse);
                   for (unsigned int i = 0; i < result.size(); ++i)
                     for (unsigned int r = 0; r < dim; ++r)
                     {
                       const double slope = table.derivatives(q * table.rows_per_point + r, i);
                       for (unsigned int c = 0; c < dim; ++c)
                         result[i][c] += pulled[c][r] * slope;
                     }
                 });
  return result;
}

template <int dim>
Tensor<2, dim> StrainLoads<dim>::stress() const
{
  Tensor<2, dim> sum, all;
  collectively(space.communicator(),
               [&]()
               {
                 for (const Cell &cell : space.dof_handler.active_cell_iterators())
                   if (cell->is_locally_owned() && is_strained(cell))
                     for_each_point(cell, [&](unsigned int, const Tensor<2, dim> &,
                                              const Tensor<2, dim> &stress, const Tensor<2, dim> &)
                                    { sum += stress; });
               });
  for (unsigned int c = 0; c < dim; ++c)
    for (unsigned int d = 0; d < dim; ++d)
      all[c][d] = Utilities::MPI::sum(sum[c][d], space.communicator());
  return all;
}

template <int dim>
double StrainLoads<dim>::energy(const DistributedVector &u) const
{
  return sum_collectively(space.communicator(),
                          [&]()
                          {
                            double sum = 0;
                            for (const Cell &cell : space.dof_handler.active_cell_iterators())
                            {
                              if (!cell->is_locally_owned() || !is_strained(cell))
                                continue;
                              for_each_point(cell, [&](unsigned int, const Tensor<2, dim> &strain,
                                                       const Tensor<2, dim> &stress,
                                                       const Tensor<2, dim> &)
                                             { sum += 0.5 * scalar_product(stress, strain); });
                              sum -= product<dim>(load(cell), space.field(cell, u));
                            }
                            return sum;
                          });
}

template class StrainLoads<2>;
template class StrainLoads<3>;
} // namespace hpvi
