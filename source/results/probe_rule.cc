// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/processes.h>
#include <hpvi/plane/cell_map.h>
#include <hpvi/plane/disc_rule.h>
#include <hpvi/plane/given_data.h>
#include <hpvi/plane/load_quadrature.h>
#include <hpvi/results/field.h>
#include <hpvi/results/probe_rule.h>

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

/** The pieces of a straight cell between which initial strains jump or bend, and stresses with them, in reference coordinates. */
std::vector<BoundingBox<2>> smooth_pieces(const DoFHandler<2>::active_cell_iterator &cell,
                                          const CellMap<2> &map, const Scene<2> &scene,
                                          const ShapeTables<2> &tables)
{
  if (scene.has_initial_strain() && !map.is_curved() &&
      given_data(scene, cell, inside, Datum::initial_strain).varies())
    return cut_data(scene, cell, inside, Datum::initial_strain, tables, 1).boxes;
  return {create_unit_bounding_box<2>()};
}

Point<2> in_box(const BoundingBox<2> &box, const Point<2> &unit)
{
  const auto &[low, high] = box.get_boundary_points();
  return Point<2>(low[0] + unit[0] * (high[0] - low[0]), low[1] + unit[1] * (high[1] - low[1]));
}

/** disc_rule() on each of these pieces: a box in a cell with straight edges has straight ones. */
DiscRule disc_rule_in(const std::vector<BoundingBox<2>> &pieces, const CellMap<2> &map,
                      const Probe<2> &probe, const unsigned int n_points)
{
  DiscRule result;
  for (const BoundingBox<2> &box : pieces)
  {
    CellMap<2>::Vertices vertices;
    for (unsigned int v = 0; v < vertices.size(); ++v)
      vertices[v] = map.point(in_box(box, GeometryInfo<2>::unit_cell_vertex(v)));
    const DiscRule part = disc_rule(CellMap<2>(vertices), probe.at, probe.size, n_points);
    for (const Point<2> &point : part.points)
      result.points.push_back(in_box(box, point));
    result.areas.insert(result.areas.end(), part.areas.begin(), part.areas.end());
  }
  return result;
}

ProbeRule<2> disc_rule_of(const Probe<2> &probe, const Scene<2> &scene,
                          const DoFHandler<2> &dof_handler, const ShapeTables<2> &tables)
{
  ProbeRule<2> rule;
  double area = 0;
  for (const auto &cell : dof_handler.active_cell_iterators())
  {
    if (!cell->is_locally_owned())
      continue;
    const CellMap<2> map = map_of<2>(cell);
    const unsigned int n_points = n_gauss<2>(cell->get_fe().degree, map);
    DiscRule part = disc_rule(map, probe.at, probe.size, n_points);
    if (part.points.empty())
      continue;
    if (const auto pieces = smooth_pieces(cell, map, scene, tables); pieces.size() > 1)
      part = disc_rule_in(pieces, map, probe, n_points);
    for (unsigned int q = 0; q < part.points.size(); ++q)
    {
      area += part.areas[q];
      part.areas[q] *= scene.circumference(map.point(part.points[q]));
    }
    rule.push_back({cell, part.points, part.areas});
  }
  const double whole = numbers::PI * probe.size * probe.size;
  const bool is_covered =
      std::abs(Utilities::MPI::sum(area, dof_handler.get_communicator()) / whole - 1) < 1e-6;
  return is_covered ? rule : ProbeRule<2>();
}

/** Space has no discs. */
ProbeRule<3> disc_rule_of(const Probe<3> &, const Scene<3> &, const DoFHandler<3> &,
                          const ShapeTables<3> &)
{
  return {};
}

/** A Gauss rule on a face, in the plane on each part of it in one of the smooth pieces. */
Quadrature<2> face_rule(const DoFHandler<3>::active_cell_iterator &, unsigned int,
                        const CellMap<3> &, const Scene<3> &, const ShapeTables<3> &,
                        const unsigned int n_points)
{
  return QGauss<2>(n_points);
}

Quadrature<1> face_rule(const DoFHandler<2>::active_cell_iterator &cell, const unsigned int face,
                        const CellMap<2> &map, const Scene<2> &scene, const ShapeTables<2> &tables,
                        const unsigned int n_points)
{
  const auto measure = [&](const Point<1> &s)
  { return map.face_measure(face, point_on_face<2>(face, s)); };
  const unsigned int degree = cell->get_fe().degree;
  const auto times_shapes = [&](const Point<1> &s)
  { return measure(s) * std::legendre(degree, 2 * s[0] - 1); };
  const QGauss<1> gauss(map.is_curved() && map.blends()[face] // |x'| is no polynomial
                            ? rule_parts<1>({create_unit_bounding_box<1>()}, n_points - 2,
                                            {measure, times_shapes}, tables)[0]
                                  .n
                            : n_points);
  std::vector<Point<1>> points;
  std::vector<double> weights;
  const unsigned int across = face / 2, along = 1 - across;
  for (const BoundingBox<2> &box : smooth_pieces(cell, map, scene, tables))
    if (face % 2 == 0 ? box.lower_bound(across) == 0. : box.upper_bound(across) == 1.)
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        points.emplace_back(box.lower_bound(along) + gauss.point(q)[0] * box.side_length(along));
        weights.push_back(gauss.weight(q) * box.side_length(along));
      }
  return Quadrature<1>(points, weights);
}

template <int dim>
ProbeRule<dim> boundary_rule(const std::vector<types::boundary_id> &on, const Scene<dim> &scene,
                             const DoFHandler<dim> &dof_handler, const ShapeTables<dim> &tables)
{
  ProbeRule<dim> rule;
  for (const auto &cell : dof_handler.active_cell_iterators())
    for (const unsigned int face : cell->face_indices())
    {
      if (!cell->is_locally_owned() || !cell->at_boundary(face) ||
          std::find(on.begin(), on.end(), cell->face(face)->boundary_id()) == on.end())
        continue;
      const CellMap<dim> map = map_of<dim>(cell);
      const Quadrature<dim - 1> gauss =
          face_rule(cell, face, map, scene, tables, n_gauss<dim>(cell->get_fe().degree, map));
      WeightedPoints<dim> part{cell, {}, {}};
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        part.points.push_back(point_on_face<dim>(face, gauss.point(q)));
        part.weights.push_back(gauss.weight(q) * map.face_measure(face, part.points.back()) *
                               scene.circumference(map.point(part.points.back())));
      }
      rule.push_back(part);
    }
  return rule;
}
} // namespace

template <int dim>
double boundary_size(const types::boundary_id id, const Scene<dim> &scene,
                     const DoFHandler<dim> &dof_handler, const ShapeTables<dim> &tables)
{
  double result = 0;
  for (const WeightedPoints<dim> &part : boundary_rule<dim>({id}, scene, dof_handler, tables))
    for (const double weight : part.weights)
      result += weight;
  return Utilities::MPI::sum(result, dof_handler.get_communicator());
}

template <int dim>
ProbeRule<dim> probe_rule(const Probe<dim> &probe, const Scene<dim> &scene,
                          const DoFHandler<dim> &dof_handler, const ShapeTables<dim> &tables)
{
  Assert(probe.kind != ProbeKind::line, ExcMessage("A line has no single value."));
  ProbeRule<dim> rule = probe.kind == ProbeKind::point ? point_rule(probe.at, dof_handler)
                        : probe.kind == ProbeKind::disc
                            ? disc_rule_of(probe, scene, dof_handler, tables)
                            : boundary_rule(probe.on, scene, dof_handler, tables);
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

template double boundary_size(types::boundary_id, const Scene<2> &, const DoFHandler<2> &,
                              const ShapeTables<2> &);
template ProbeRule<2> probe_rule(const Probe<2> &, const Scene<2> &, const DoFHandler<2> &,
                                 const ShapeTables<2> &);
template ProbeRule<3> probe_rule(const Probe<3> &, const Scene<3> &, const DoFHandler<3> &,
                                 const ShapeTables<3> &);
} // namespace hpvi
