// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/processes.h>
#include <hpvi/body/cell_map.h>
#include <hpvi/body/disc_rule.h>
#include <hpvi/evaluation/field.h>
#include <hpvi/evaluation/probe_rule.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Points of a Gauss rule in each direction: exact for u_N times what a map of straight edges brings along. */
template <int dim>
unsigned int n_gauss(const unsigned int degree, const CellMap<dim> &map)
{
  return degree + (map.is_curved() ? 6 : 3);
}

template <int dim>
ProbeRule<dim> point_rule(const Point<dim> &x, const DoFHandler<dim> &dof_handler)
{
  ProbeRule<dim> rule;
  for (const auto &cell : dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      if (const auto reference = reference_of<dim>(cell, x))
        rule.push_back({cell, {*reference}, {1.}});
  return rule;
}

ProbeRule<2> disc_rule_of(const Probe<2> &probe, const Scene<2> &scene,
                          const DoFHandler<2> &dof_handler)
{
  ProbeRule<2> rule;
  double area = 0;
  for (const auto &cell : dof_handler.active_cell_iterators())
  {
    if (!cell->is_locally_owned())
      continue;
    const CellMap<2> map = map_of<2>(cell);
    DiscRule part = disc_rule(map, probe.at, probe.size, n_gauss<2>(cell->get_fe().degree, map));
    for (unsigned int q = 0; q < part.points.size(); ++q)
    {
      area += part.areas[q];
      part.areas[q] *= scene.turn(map.point(part.points[q]));
    }
    if (!part.points.empty())
      rule.push_back({cell, part.points, part.areas});
  }
  const double whole = numbers::PI * probe.size * probe.size;
  const bool is_covered =
      std::abs(Utilities::MPI::sum(area, dof_handler.get_communicator()) / whole - 1) < 1e-6;
  return is_covered ? rule : ProbeRule<2>();
}

/** Space has no discs. */
ProbeRule<3> disc_rule_of(const Probe<3> &, const Scene<3> &, const DoFHandler<3> &)
{
  return {};
}

template <int dim>
ProbeRule<dim> boundary_rule(const std::vector<types::boundary_id> &on, const Scene<dim> &scene,
                             const DoFHandler<dim> &dof_handler)
{
  ProbeRule<dim> rule;
  for (const auto &cell : dof_handler.active_cell_iterators())
    for (const unsigned int face : cell->face_indices())
    {
      if (!cell->is_locally_owned() || !cell->at_boundary(face) ||
          std::find(on.begin(), on.end(), cell->face(face)->boundary_id()) == on.end())
        continue;
      const CellMap<dim> map = map_of<dim>(cell);
      const QGauss<dim - 1> gauss(n_gauss<dim>(cell->get_fe().degree, map));
      WeightedPoints<dim> part{cell, {}, {}};
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        part.points.push_back(point_on_face<dim>(face, gauss.point(q)));
        part.weights.push_back(gauss.weight(q) * map.face_measure(face, part.points.back()) *
                               scene.turn(map.point(part.points.back())));
      }
      rule.push_back(part);
    }
  return rule;
}
} // namespace

template <int dim>
ProbeRule<dim> probe_rule(const Probe<dim> &probe, const Scene<dim> &scene,
                          const DoFHandler<dim> &dof_handler)
{
  Assert(probe.kind != ProbeKind::line, ExcMessage("A line has no single value."));
  ProbeRule<dim> rule = probe.kind == ProbeKind::point ? point_rule(probe.at, dof_handler)
                        : probe.kind == ProbeKind::disc
                            ? disc_rule_of(probe, scene, dof_handler)
                            : boundary_rule(probe.on, scene, dof_handler);
  double sum = 0;
  for (const WeightedPoints<dim> &part : rule)
    for (const double weight : part.weights)
      sum += weight;
  sum = Utilities::MPI::sum(sum, dof_handler.get_communicator());
  for (WeightedPoints<dim> &part : rule)
    for (double &weight : part.weights)
      weight /= sum;
  return rule;
}

template ProbeRule<2> probe_rule(const Probe<2> &, const Scene<2> &, const DoFHandler<2> &);
template ProbeRule<3> probe_rule(const Probe<3> &, const Scene<3> &, const DoFHandler<3> &);
} // namespace hpvi
