// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/plane/mesh.h>
#include <hpvi/results/elastic_strain.h>
#include <hpvi/results/values_at.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
/** The least and largest x at which reference_of() may find a point in @p cell. */
template <int dim>
std::pair<double, double> reach(const typename Field<dim>::Cell &cell)
{
  const CellMap<dim> map = map_of<dim>(cell);
  double least = map.point(Point<dim>())[0], largest = least;
  for (const unsigned int k : cell->vertex_indices())
  {
    least = std::min(least, cell->vertex(k)[0]);
    largest = std::max(largest, cell->vertex(k)[0]);
  }
  // A hair for round-off; an edge that is curved may lie beside its vertices.
  const double beside = (map.is_curved() ? 1. : 1e-8) * map.longest_edge();
  return {least - beside, largest + beside};
}
} // namespace

template <int dim>
std::vector<PointValue<dim>> values_at(const Field<dim> &field,
                                       const typename Field<dim>::Cell &cell,
                                       const ShapeTable<dim> &table)
{
  const std::vector<double> coefficients = field.coefficients(cell),
                            u = evaluate(table.values, coefficients),
                            derivatives = evaluate(table.derivatives, coefficients);
  const Scene<dim> &scene = field.scene;
  const CellMap<dim> map = map_of<dim>(cell);
  const Material &material = scene.material_of(cell);
  const HookesLaw<dim> law(material);
  std::vector<PointValue<dim>> result(table.points.size());
  for (unsigned int q = 0; q < result.size(); ++q)
  {
    PointValue<dim> &value = result[q];
    Tensor<2, dim> gradient;
    for (unsigned int c = 0; c < dim; ++c)
    {
      value.displacement[c] = u[c * result.size() + q];
      for (unsigned int j = 0; j < dim; ++j)
        gradient[c][j] = derivatives[c * table.derivatives.m() + q * table.rows_per_point + j];
    }
    gradient = gradient * invert(map.jacobian(table.points[q]));
    const ElasticStrain<dim> strain = elastic_strain(scene, cell->material_id(), map,
                                                     table.points[q], value.displacement, gradient);
    value.stress = law.stress(strain.in_plane, strain.hoop);
    if constexpr (dim == 2)
      value.across = material.transverse_stress(value.stress, strain.across);
  }
  return result;
}

template <int dim>
std::vector<std::optional<PointValue<dim>>> values_at(const Field<dim> &field,
                                                      const std::vector<Point<dim>> &points,
                                                      const std::optional<unsigned int> body)
{
  std::vector<std::size_t> order(points.size()); // by x
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](const std::size_t a, const std::size_t b) { return points[a][0] < points[b][0]; });
  std::vector<std::optional<PointValue<dim>>> result(points.size());
  for (const auto &cell : field.dof_handler.active_cell_iterators())
  {
    if (body && body_of<dim>(field.scene.geometry, cell) != *body)
      continue;
    const auto [least, largest] = reach<dim>(cell);
    std::vector<std::size_t> found;
    std::vector<Point<dim>> references;
    for (auto k = std::lower_bound(order.begin(), order.end(), least,
                                   [&](const std::size_t a, const double x)
                                   { return points[a][0] < x; });
         k != order.end() && points[*k][0] <= largest; ++k)
      if (!result[*k])
        if (const auto reference = reference_of<dim>(cell, points[*k]))
        {
          found.push_back(*k);
          references.push_back(*reference);
        }
    if (found.empty())
      continue;
    const std::vector<PointValue<dim>> values = field.values(cell, references);
    for (std::size_t k = 0; k < found.size(); ++k)
      result[found[k]] = values[k];
  }
  return result;
}

template std::vector<PointValue<2>> values_at(const Field<2> &, const Field<2>::Cell &,
                                              const ShapeTable<2> &);
template std::vector<std::optional<PointValue<2>>>
values_at(const Field<2> &, const std::vector<Point<2>> &, std::optional<unsigned int>);
template std::vector<PointValue<3>> values_at(const Field<3> &, const Field<3>::Cell &,
                                              const ShapeTable<3> &);
template std::vector<std::optional<PointValue<3>>>
values_at(const Field<3> &, const std::vector<Point<3>> &, std::optional<unsigned int>);
} // namespace hpvi
