// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_probe_rule_h
#define hpvi_probe_rule_h

#include <hpvi/plane/shape_tables.h>
#include <hpvi/scene/scene.h>

#include <deal.II/dofs/dof_handler.h>

#include <vector>

namespace hpvi
{
/** Points of the unit cell, on one cell of this process, with their weights. */
template <int dim>
struct WeightedPoints
{
  typename dealii::DoFHandler<dim>::active_cell_iterator cell;
  std::vector<dealii::Point<dim>> points;
  std::vector<double> weights;
};

/** On cells of this process. */
template <int dim>
using ProbeRule = std::vector<WeightedPoints<dim>>;

/**
 * What @p probe, which is no line, asks of a field v, as `sum of weights times v` over all processes: the value at a point,
 * where cells meet the mean of theirs; the mean over a disc or along a boundary, of axisymmetric bodies that of the full turn.
 * Exact for u_N on straight cells; cut where initial strains jump or bend inside one. The weights sum to 1; there are none where no cell has the point, or cells do not cover
 * the disc. Collective.
 */
template <int dim>
ProbeRule<dim> probe_rule(const Probe<dim> &probe, const Scene<dim> &scene,
                          const dealii::DoFHandler<dim> &dof_handler,
                          const ShapeTables<dim> &tables);

/** Of a boundary as it is meshed: its length, of an axisymmetric body what it turns into. Collective. */
template <int dim>
double boundary_size(dealii::types::boundary_id id, const Scene<dim> &scene,
                     const dealii::DoFHandler<dim> &dof_handler, const ShapeTables<dim> &tables);
} // namespace hpvi

#endif
