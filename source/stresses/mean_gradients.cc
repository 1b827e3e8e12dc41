// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/body/cell_map.h>
#include <hpvi/stresses/mean_gradients.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

template <int dim>
double MeanGradient<dim>::largest_strain() const
{
  const auto principal = eigenvalues(symmetrize(value));
  return std::max(std::abs(principal.front()), std::abs(principal.back()));
}

template <int dim>
double MeanGradient<dim>::rotation() const
{
  static_assert(dim == 2, "one rotation");
  return 0.5 * std::abs(value[1][0] - value[0][1]);
}

template <int dim>
std::vector<MeanGradient<dim>> mean_gradients(const DisplacementSpace<dim> &space,
                                              const ShapeTables<dim> &tables,
                                              const Vector<double> &u)
{
  static_assert(dim == 2, "edges");
  std::vector<MeanGradient<dim>> result(space.triangulation().n_cells(0));
  std::vector<double> area(result.size());
  for (const auto &cell : space.dof_handler().active_cell_iterators())
  {
    auto coarse = typename Triangulation<dim>::cell_iterator(cell);
    while (coarse->level() > 0)
      coarse = coarse->parent();
    MeanGradient<dim> &mean = result[coarse->index()];
    mean.centre = coarse->center();
    area[coarse->index()] += cell->measure();
    const unsigned int p = space.degrees()[cell->active_cell_index()];
    const auto dofs = space.cell_dofs(cell->active_cell_index());
    const CellMap<dim> map = map_of<dim>(cell);
    const QGaussLobatto<1> &rule = tables.gauss_lobatto(p + 1); // its points are the nodes
    for (const unsigned int f : cell->face_indices())
    {
      const std::vector<unsigned int> &on_edge = tables.numbering(p).edge[f];
      const Point<dim> middle = point_on_face<dim>(f, Point<1>(0.5));
      const Tensor<1, dim> n_ds = map.face_measure(f, middle) * map.normal(f, middle);
      for (unsigned int k = 0; k <= p; ++k)
        for (unsigned int c = 0; c < dim; ++c)
          mean.value[c] += rule.weight(k) * u[dofs[on_edge[c * (p + 1) + k]]] * n_ds;
    }
  }
  for (unsigned int k = 0; k < result.size(); ++k)
    result[k].value /= area[k];
  return result;
}

template struct MeanGradient<2>;
template std::vector<MeanGradient<2>>
mean_gradients(const DisplacementSpace<2> &, const ShapeTables<2> &, const Vector<double> &);
} // namespace hpvi
