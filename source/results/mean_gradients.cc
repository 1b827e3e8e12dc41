// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/quadrature_lib.h>
#include <hpvi/plane/cell_map.h>
#include <hpvi/results/mean_gradients.h>
#include <hpvi/results/probe_value.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

template <int dim>
double MeanGradient<dim>::largest_strain() const
{
  const auto principal = [strain = symmetrize(value)]()
  {
    if constexpr (dim == 2)
      return principal_values(strain);
    else
      return eigenvalues(strain);
  }();
  return std::max(std::abs(principal.front()), std::abs(principal.back()));
}

template <int dim>
double MeanGradient<dim>::rotation() const
{
  double curl_square = 0;
  for (unsigned int i = 1; i < dim; ++i)
    for (unsigned int j = 0; j < i; ++j)
      curl_square += (value[i][j] - value[j][i]) * (value[i][j] - value[j][i]);
  return 0.5 * std::sqrt(curl_square);
}

namespace
{
/** Of a triquadratic map, whose det J has the degree 5 along each axis. */
template <int dim>
double volume_of(const CellMap<dim> &map)
{
  const QGauss<dim> rule(3);
  double result = 0;
  for (unsigned int q = 0; q < rule.size(); ++q)
    result += rule.weight(q) * determinant(map.jacobian(rule.point(q)));
  return result;
}
} // namespace

template <int dim>
std::vector<MeanGradient<dim>> mean_gradients(const Field<dim> &field)
{
  const Triangulation<dim> &mesh = field.dof_handler.get_triangulation();
  std::vector<MeanGradient<dim>> result(mesh.n_cells(0));
  constexpr unsigned int n = dim * dim + 1;
  std::vector<double> sums(n * result.size()); // int grad u, then the area, of each coarse cell
  for (const auto &cell : field.dof_handler.active_cell_iterators())
  {
    if (!cell->is_locally_owned())
      continue;
    auto coarse = typename Triangulation<dim>::cell_iterator(cell);
    while (coarse->level() > 0)
      coarse = coarse->parent();
    double *const sum = &sums[n * coarse->index()];
    const unsigned int p = field.degree(cell);
    const std::vector<double> coefficients = field.coefficients(cell);
    const CellMap<dim> map = map_of<dim>(cell);
    sum[n - 1] += dim == 3 && map.is_curved() ? volume_of(map) : cell->measure();
    for (const unsigned int f : cell->face_indices())
    {
      const ShapeTable<dim> &table = field.tables.face(p, f, p + 1);
      const std::vector<double> u = evaluate(table.values, coefficients);
      for (unsigned int q = 0; q < table.points.size(); ++q)
      {
        const Tensor<1, dim> n_ds = table.weights[q] * map.face_measure(f, table.points[q]) *
                                    map.normal(f, table.points[q]);
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            sum[c * dim + d] += u[c * table.points.size() + q] * n_ds[d];
      }
    }
  }
  std::vector<double> all(sums.size());
  Utilities::MPI::sum(sums, field.communicator(), all);
  for (const auto &coarse : mesh.cell_iterators_on_level(0))
  {
    const double *const sum = &all[n * coarse->index()];
    MeanGradient<dim> &mean = result[coarse->index()];
    mean.centre = coarse->center();
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int d = 0; d < dim; ++d)
        mean.value[c][d] = sum[c * dim + d] / sum[n - 1];
    if constexpr (dim == 2)
      if (!field.scene.initial_strains.empty())
        if (const auto &jump = field.scene.initial_strains.at(coarse->material_id()).shortening)
          mean.value -= Tensor<2, 2>({{(*jump)[0], (*jump)[2]}, {(*jump)[2], (*jump)[1]}});
  }
  return result;
}

template struct MeanGradient<2>;
template struct MeanGradient<3>;
template std::vector<MeanGradient<2>> mean_gradients(const Field<2> &);
template std::vector<MeanGradient<3>> mean_gradients(const Field<3> &);
} // namespace hpvi
