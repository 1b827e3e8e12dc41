// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/processes.h>
#include <hpvi/base/thread_pool.h>
#include <hpvi/results/contact_traces.h>
#include <hpvi/results/elastic_strain.h>
#include <hpvi/results/probe_value.h>
#include <hpvi/results/stress_extrema.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
template <int dim>
StressSample<dim> largest_pressure(const FieldFace<dim> &face, const Field<dim> &field)
{
  const auto points = pressure_points(face, field);
  const auto &largest =
      *std::max_element(points.begin(), points.end(),
                        [](const auto &a, const auto &b) { return a.pressure < b.pressure; });
  return {face.condition->id, largest.pressure, largest.x,
          dim == 2 ? face.area() : std::sqrt(face.area())};
}

template <int dim>
StressSample<dim> largest_von_mises(const typename Field<dim>::Cell &cell, const Field<dim> &field)
{
  const unsigned int degree = field.degree(cell);
  const Material &material = field.scene.material_of(cell);
  const HookesLaw<dim> law(material);
  const CellMap<dim> map = map_of<dim>(cell);
  const ShapeTable<dim> &table = field.tables.gradients(degree, degree / 2 + 2);
  const std::vector<double> coefficients = field.coefficients(cell),
                            derivatives = evaluate(table.derivatives, coefficients),
                            values = field.scene.is_axisymmetric()
                                         ? evaluate(table.values, coefficients)
                                         : std::vector<double>();
  StressSample<dim> largest{numbers::invalid_boundary_id, -1., {}, map.longest_edge()};
  for (unsigned int q = 0; q < table.points.size(); ++q)
  {
    Tensor<2, dim> reference;
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int j = 0; j < dim; ++j)
        reference[c][j] = derivatives[c * table.derivatives.m() + q * table.rows_per_point + j];
    const Tensor<2, dim> gradient = reference * invert(map.jacobian(table.points[q]));
    Tensor<1, dim> u;
    for (unsigned int c = 0; c < dim && !values.empty(); ++c)
      u[c] = values[c * table.points.size() + q];
    const ElasticStrain<dim> strain =
        elastic_strain(field.scene, cell->material_id(), map, table.points[q], u, gradient);
    const double value =
        von_mises<dim>(material, law.stress(strain.in_plane, strain.hoop), strain.across);
    if (value > largest.value)
    {
      largest.value = value;
      largest.where = map.point(table.points[q]);
    }
  }
  return largest;
}

template <int dim>
std::vector<StressSample<dim>> own_stress_samples(const Field<dim> &field)
{
  std::vector<StressSample<dim>> result;
  for (const FieldFace<dim> &face : field.faces())
    if (const StressSample<dim> sample = largest_pressure(face, field); sample.value > 0)
      result.push_back(sample);
  std::vector<typename Field<dim>::Cell> cells;
  for (const auto &cell : field.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
      cells.push_back(cell);
  const std::size_t first = result.size();
  result.resize(first + cells.size());
  parallel_for_each(cells.size(), 16,
                    [&](const unsigned int k)
                    { result[first + k] = largest_von_mises<dim>(cells[k], field); });
  return result;
}

constexpr unsigned int most_peaks = 3;
} // namespace

template <int dim>
double von_mises(const Material &material, const SymmetricTensor<2, dim> &sigma, const double e33)
{
  FullStress full;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = i; j < dim; ++j)
      full[i][j] = sigma[i][j];
  if constexpr (dim == 2)
    full[2][2] = material.transverse_stress(sigma, e33);
  return von_mises(full);
}

template <int dim>
std::vector<StressSample<dim>> stress_samples(const Field<dim> &field)
{
  std::vector<StressSample<dim>> result;
  collectively(field.communicator(), [&]() { result = own_stress_samples(field); });
  if (n_processes(field.communicator()) == 1)
    return result;
  const auto all =
      Utilities::MPI::all_gather(field.communicator(), stress_extrema(result, field.scene));
  for (unsigned int rank = 0; rank < all.size(); ++rank)
    if (rank != rank_of(field.communicator()))
      result.insert(result.end(), all[rank].begin(), all[rank].end());
  return result;
}

template <int dim>
double reach(const StressSample<dim> &peak, const Scene<dim> &scene)
{
  return std::max(0.01 * scene.geometry.diameter(), 2 * peak.length);
}

template <int dim>
std::vector<StressSample<dim>> stress_extrema(const std::vector<StressSample<dim>> &samples,
                                              const Scene<dim> &scene)
{
  std::vector<StressSample<dim>> sorted = samples, result;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto &a, const auto &b) { return a.value > b.value; });
  for (const StressSample<dim> &sample : sorted)
  {
    const auto is_known = [&](const StressSample<dim> &peak)
    {
      return peak.boundary == sample.boundary &&
             peak.where.distance(sample.where) < reach(peak, scene);
    };
    const auto n =
        std::count_if(result.begin(), result.end(),
                      [&](const auto &peak) { return peak.boundary == sample.boundary; });
    if (n < most_peaks && std::none_of(result.begin(), result.end(), is_known))
      result.push_back(sample);
  }
  return result;
}

template double von_mises(const Material &, const SymmetricTensor<2, 2> &, double);
template double von_mises(const Material &, const SymmetricTensor<2, 3> &, double);
template std::vector<StressSample<2>> stress_samples(const Field<2> &);
template std::vector<StressSample<3>> stress_samples(const Field<3> &);
template double reach(const StressSample<2> &, const Scene<2> &);
template double reach(const StressSample<3> &, const Scene<3> &);
template std::vector<StressSample<2>> stress_extrema(const std::vector<StressSample<2>> &,
                                                     const Scene<2> &);
template std::vector<StressSample<3>> stress_extrema(const std::vector<StressSample<3>> &,
                                                     const Scene<3> &);
} // namespace hpvi
