// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/processes.h>
#include <hpvi/plane/cell_map.h>
#include <hpvi/space/load_work.h>
#include <hpvi/space/upper_energy.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hpvi
{
using namespace dealii;

namespace
{
/** By how much u misses a prescribed displacement between its nodes on one face. */
template <int dim>
double missed_on(const typename PrimalSpace<dim>::Cell &cell, const unsigned int face,
                 const PrimalSpace<dim> &space, const DistributedVector &u)
{
  const BoundaryCondition<dim> &condition = space.condition(cell, face);
  const BoxTables<dim> &tables = space.tables.of(cell);
  const QGauss<dim - 1> points(tables.degree + 2);
  const CellField<dim> field = space.field(cell, u);
  const CellMap<dim> map = map_of<dim>(cell);
  double largest = 0;
  for (const Point<dim - 1> &point : points.get_points())
  {
    const Point<dim> reference = point_on_face<dim>(face, point), x = map.point(reference);
    Tensor<1, dim> value;
    for (unsigned int i = 0; i < field.size(); ++i)
      value += tables.fe.shape_value(tables.numbers[i][0], reference) * field[i];
    for (unsigned int c = 0; c < dim; ++c)
      if (condition.displacement[c])
        largest = std::max(largest, std::abs(value[c] - condition.displacement[c]->value(x)));
    if (condition.holds_normal())
      largest = std::max(largest, std::abs(value * map.normal(face, reference)));
  }
  return largest;
}
} // namespace

template <int dim>
double missed_displacement(const PrimalSpace<dim> &space, const DistributedVector &u)
{
  double largest = 0;
  collectively(space.communicator(),
               [&]()
               {
                 for (const auto &cell : space.dof_handler.active_cell_iterators())
                   for (const unsigned int face : cell->face_indices())
                     if (cell->is_locally_owned() && cell->at_boundary(face) &&
                         (space.condition(cell, face).has_displacement() ||
                          space.condition(cell, face).holds_normal()))
                       largest = std::max(largest, missed_on<dim>(cell, face, space, u));
               });
  return Utilities::MPI::max(largest, space.communicator());
}

template <int dim>
double upper_energy(const PrimalSpace<dim> &space, const DistributedVector &u,
                    const Energies &energies, const double work)
{
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const Scene<dim> &scene = space.scene;
  const bool springs_vary =
      std::any_of(scene.boundaries.begin(), scene.boundaries.end(),
                  [](const BoundaryCondition<dim> &boundary) { return boundary.spring.varies(); });
  if (springs_vary || scene.has_unilateral_contact() || scene.has_pairs() ||
      scene.has_coulomb_friction() ||
      missed_displacement(space, u) > round_off_of_supports * u.linfty_norm())
    return none;
  const double finer = load_work(scene, space, u, 2), difference = std::abs(finer - work);
  return difference > 1e-3 * std::abs(finer) ? none : energies.energy + work - finer + difference;
}

template double missed_displacement(const PrimalSpace<2> &, const DistributedVector &);
template double missed_displacement(const PrimalSpace<3> &, const DistributedVector &);
template double upper_energy(const PrimalSpace<2> &, const DistributedVector &, const Energies &,
                             double);
template double upper_energy(const PrimalSpace<3> &, const DistributedVector &, const Energies &,
                             double);
} // namespace hpvi
