// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/plane/displacement_cuts.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;
using namespace coarse_cuts;

namespace
{
constexpr unsigned int along = 16; ///< Gauss points of a piece

/** What an edge prescribes, by name. */
std::vector<std::pair<std::string, const Function<2> *>>
prescribed(const BoundaryCondition<2> &condition)
{
  std::vector<std::pair<std::string, const Function<2> *>> result;
  for (const auto &component : condition.displacement)
    if (varies(component))
      result.emplace_back("Displacement on " + condition.name, component.get());
  if (condition.is_unilateral() && varies(condition.gap))
    result.emplace_back("Gap on " + condition.name, condition.gap.get());
  return result;
}

/** The polynomial through @p values at @p nodes, at s. */
double interpolated(const std::vector<Point<1>> &nodes, const std::vector<double> &values,
                    const double s)
{
  double sum = 0;
  for (unsigned int i = 0; i < nodes.size(); ++i)
  {
    double basis = values[i];
    for (unsigned int k = 0; k < nodes.size(); ++k)
      if (k != i)
        basis *= (s - nodes[k][0]) / (nodes[i][0] - nodes[k][0]);
    sum += basis;
  }
  return sum;
}

struct Range
{
  double least = 1e300, largest = -1e300;

  void take(const double value)
  {
    least = std::min(least, value);
    largest = std::max(largest, value);
  }
};

/** The point where a component differs most from its interpolant; its values, too, join @p range. */
MissedDisplacement<2> worst_point(const Function<2> &component, const CellMap<2> &map,
                                  const unsigned int face, const std::vector<Point<1>> &nodes,
                                  const std::vector<double> &points, Range &range)
{
  const auto x = [&](const double s) { return map.point(point_on_face<2>(face, Point<1>(s))); };
  std::vector<double> at_nodes;
  for (const Point<1> &s : nodes)
    range.take(at_nodes.emplace_back(component.value(x(s[0]))));
  MissedDisplacement<2> result{{}, false, 0, x(0.5), 0., 0.};
  for (const double s : points)
  {
    const double value = component.value(x(s)), seen = interpolated(nodes, at_nodes, s);
    range.take(value);
    if (std::abs(value - seen) > std::abs(result.value - result.interpolated))
    {
      result.where = x(s);
      result.value = value;
      result.interpolated = seen;
    }
  }
  return result;
}
} // namespace

template <int dim>
DisplacementCuts<dim>::DisplacementCuts(const Scene<dim> &scene, const Triangulation<dim> &mesh,
                                        std::shared_ptr<const ShapeTables<dim>> shape_tables)
    : scene(scene), tables(std::move(shape_tables))
{
  for (const auto &cell : mesh.cell_iterators_on_level(0))
    for (const unsigned int face : cell->face_indices())
      if (cell->at_boundary(face))
        cut(cell, face);
}

template <int dim>
void DisplacementCuts<dim>::cut(const Cell &cell, const unsigned int face)
{
  std::vector<double> found;
  for (const auto &[name, component] :
       prescribed(scene.boundaries[cell->face(face)->boundary_id()]))
  {
    const CutRule rule = cut_edge(*component, cell, face, scene, tables->gauss(along));
    if (rule.cuts.size() > 2)
      found.insert(found.end(), rule.cuts.begin(), rule.cuts.end());
  }
  std::sort(found.begin(), found.end());
  if (!found.empty())
    cuts[{coarse_index(cell), face}] = found;
}

template <int dim>
std::vector<double> DisplacementCuts<dim>::displacement_points(const Cell &cell,
                                                               const unsigned int face) const
{
  const auto known = cuts.find({coarse_index(cell), face});
  if (known == cuts.end())
    return {};
  const BoundingBox<dim> part = part_of_coarse(cell);
  const unsigned int d = 1 - face / 2;
  const std::vector<double> here =
      seen_from(part.lower_bound(d), part.side_length(d), known->second);
  std::vector<double> result;
  for (unsigned int k = 0; k + 1 < here.size(); ++k)
    for (const Point<1> &s : tables->gauss(along).get_points())
      result.push_back(here[k] + (here[k + 1] - here[k]) * s[0]);
  return result;
}

template <int dim>
std::vector<MissedDisplacement<dim>>
DisplacementCuts<dim>::missed_displacements(const Triangulation<dim> &mesh,
                                            const Degrees &degrees) const
{
  std::vector<std::pair<MissedDisplacement<dim>, const Function<dim> *>> edges;
  std::map<const Function<dim> *, Range> ranges;
  if (cuts.empty())
    return {};
  for (const auto &cell : mesh.active_cell_iterators())
    for (const unsigned int face : cell->face_indices())
      if (cell->at_boundary(face))
        for (const auto &[name, component] :
             prescribed(scene.boundaries[cell->face(face)->boundary_id()]))
        {
          const unsigned int index = cell->active_cell_index();
          edges.emplace_back(worst_point(*component, map_of<dim>(cell), face,
                                         tables->gauss_lobatto(degrees[index] + 1).get_points(),
                                         displacement_points(cell, face), ranges[component]),
                             component);
          edges.back().first.name = name;
          edges.back().first.is_gap = name[0] == 'G';
          edges.back().first.cell = index;
        }
  std::vector<MissedDisplacement<dim>> result;
  for (const auto &[worst, component] : edges)
  {
    const Range &range = ranges.at(component);
    // What does not vary along the side does so by round-off.
    const double round_off = 1e-10 * std::max(std::abs(range.largest), std::abs(range.least));
    if (std::abs(worst.value - worst.interpolated) >
        0.05 * (range.largest - range.least) + round_off)
      result.push_back(worst);
  }
  return result;
}

template class DisplacementCuts<2>;
} // namespace hpvi
