// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/lac/lapack_templates.h>
#include <hpvi/base/thread_pool.h>
#include <hpvi/plane/element_matrices.h>
#include <hpvi/plane/internal_forces.h>
#include <hpvi/plane/springs.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
/** C := op(A) B by BLAS, all matrices by columns. */
void multiply(const char *transpose, const unsigned int rows, const unsigned int columns,
              const unsigned int inner, const double *A, const unsigned int A_rows,
              const std::vector<double> &B, std::vector<double> &C)
{
  const types::blas_int m = rows, n = columns, k = inner, lda = A_rows;
  const double one = 1., zero = 0.;
  C.resize(static_cast<std::size_t>(rows) * columns);
  gemm(transpose, "N", &m, &n, &k, &one, A, &lda, B.data(), &k, &zero, C.data(), &m);
}

/** Some cells of one batch: one matrix product serves all. */
template <int dim>
struct Part
{
  std::vector<unsigned int> cells;
  std::vector<CellMap<dim>> maps;
  std::vector<double> forces, energies; ///< by cell; forces component by component
};

/** The cells of one material, one degree and one quadrature. */
template <int dim>
class Batch
{
public:
  Batch(const Material &material, const DisplacementSpace<dim> &space,
        const ShapeTables<dim> &tables, const unsigned int degree, const unsigned int n_gauss,
        const Volume volume)
      : law(material), space(space), table(tables.gradients(degree, n_gauss)),
        numbering(tables.numbering(degree)), n_rows(table.derivatives.m())
  {
    if (volume == Volume::projected && material.is_nearly_incompressible(dim))
      modes = oscillating_modes(table, degree);
  }

  /** Of some cells. */
  void set(const Vector<double> &u, Part<dim> &part) const
  {
    const std::size_t n = table.n_shapes;
    // deal.II's matrix by rows is its transpose by columns.
    const double *const D = &table.derivatives(0, 0);
    std::vector<double> values;
    part.forces.resize(part.cells.size() * dim * n);
    for (unsigned int k = 0; k < part.cells.size(); ++k)
    {
      const auto dofs = space.cell_dofs(part.cells[k]);
      double *const local = &part.forces[k * dim * n];
      for (unsigned int i = 0; i < dofs.size(); ++i)
        local[numbering.component[i] * n + numbering.shape[i]] = u[dofs[i]];
    }
    const unsigned int columns = dim * part.cells.size();
    multiply("T", n_rows, columns, n, D, n, part.forces, values);
    for (unsigned int k = 0; k < part.cells.size(); ++k)
      part.energies.push_back(
          strains_to_stresses(part.maps[k], &values[std::size_t(k) * dim * n_rows]));
    multiply("N", n, columns, n_rows, D, n, values, part.forces);
  }

  void add(const Part<dim> &part, InternalForces &sum) const
  {
    const std::size_t n = table.n_shapes;
    for (unsigned int k = 0; k < part.cells.size(); ++k)
    {
      const auto dofs = space.cell_dofs(part.cells[k]);
      const double *const local = &part.forces[k * dim * n];
      sum.energy_product += part.energies[k];
      for (unsigned int i = 0; i < dofs.size(); ++i)
        sum.forces[dofs[i]] += local[numbering.component[i] * n + numbering.shape[i]];
    }
  }

private:
  /**
   * Reference gradients at all points of a cell become `J^-1 sigma |det J| w`, what reference
   * gradients of test functions are multiplied with. Returns the cell's part of a(u,u).
   */
  double strains_to_stresses(const CellMap<dim> &map, double *const value) const
  {
    double energy = 0;
    Tensor<2, dim> J, inverse;
    const std::vector<double> oscillating = oscillating_volume(map, value);
    for (unsigned int q = 0; q < table.points.size(); ++q)
    {
      if (q == 0 || !map.is_affine())
      {
        J = map.jacobian(table.points[q]);
        inverse = invert(J);
      }
      Tensor<2, dim> reference;
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int r = 0; r < dim; ++r)
          reference[c][r] = value[c * n_rows + q * dim + r];
      const Tensor<2, dim> gradient = reference * inverse;
      const double weight = table.weights[q] * std::abs(determinant(J));
      Tensor<2, dim> sigma = weight * Tensor<2, dim>(law.stress(gradient));
      if (!oscillating.empty())
        sigma -= weight * law.volume_modulus() * oscillating[q] *
                 Tensor<2, dim>(unit_symmetric_tensor<dim>());
      energy += scalar_product(sigma, gradient);
      const Tensor<2, dim> pulled = sigma * transpose(inverse);
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int r = 0; r < dim; ++r)
          value[c * n_rows + q * dim + r] = pulled[c][r];
    }
    return energy;
  }

  /** What the projection takes away from div u at the points of a cell; empty: nothing. */
  std::vector<double> oscillating_volume(const CellMap<dim> &map, const double *const value) const
  {
    if (modes.m() == 0)
      return {};
    const Tensor<2, dim> inverse = invert(map.jacobian(table.points[0]));
    Vector<double> weighted(table.points.size()), result(weighted), amplitudes(modes.m());
    for (unsigned int q = 0; q < weighted.size(); ++q)
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int r = 0; r < dim; ++r)
          weighted[q] += table.weights[q] * value[c * n_rows + q * dim + r] * inverse[r][c];
    modes.vmult(amplitudes, weighted);
    modes.Tvmult(result, amplitudes);
    return {result.begin(), result.end()};
  }

  const HookesLaw<dim> law;
  const DisplacementSpace<dim> &space;
  const ShapeTable<dim> &table;
  const LocalNumbering &numbering;
  const unsigned int n_rows; ///< of the table of derivatives, points times dim
  FullMatrix<double> modes;  ///< that are projected away
};
} // namespace

namespace
{
/** The same of one cell of an axisymmetric body, whose displacement strains it around the axis, too. */
template <int dim>
void add_turned_cell(const Scene<dim> &scene, const typename DoFHandler<dim>::cell_iterator &cell,
                     const ArrayView<const types::global_dof_index> dofs,
                     const LocalNumbering &numbering, const ShapeTable<dim> &table,
                     const Vector<double> &u, InternalForces &sum)
{
  const CellMap<dim> map = map_of<dim>(cell);
  const HookesLaw<dim> law(scene.material_of(cell));
  const unsigned int n = table.n_shapes, n_points = table.points.size();
  std::vector<double> coefficients(dim * n);
  for (unsigned int i = 0; i < dofs.size(); ++i)
    coefficients[numbering.component[i] * n + numbering.shape[i]] = u[dofs[i]];
  const std::vector<double> values = evaluate(table.values, coefficients),
                            derivatives = evaluate(table.derivatives, coefficients);
  std::vector<double> forces(dim * n);
  for (unsigned int q = 0; q < n_points; ++q)
  {
    const Tensor<2, dim> J = map.jacobian(table.points[q]), inverse = invert(J);
    const double radius = map.point(table.points[q])[0], hoop = values[q] / radius,
                 weight = table.weights[q] * std::abs(determinant(J)) *
                          full_turn(map.point(table.points[q]));
    const Tensor<2, dim> gradient = physical_gradient<dim>(derivatives, q * table.rows_per_point,
                                                           table.derivatives.m(), inverse);
    const Tensor<2, dim> sigma = weight * Tensor<2, dim>(law.stress(gradient, hoop));
    const double around = weight * law.hoop_stress(gradient, hoop);
    sum.energy_product += scalar_product(sigma, gradient) + around * hoop;
    const Tensor<2, dim> pulled = sigma * transpose(inverse);
    for (unsigned int i = 0; i < n; ++i)
    {
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int r = 0; r < dim; ++r)
          forces[c * n + i] += pulled[c][r] * table.derivatives(q * table.rows_per_point + r, i);
      forces[i] += around / radius * table.values(q, i);
    }
  }
  for (unsigned int i = 0; i < dofs.size(); ++i)
    sum.forces[dofs[i]] += forces[numbering.component[i] * n + numbering.shape[i]];
}
} // namespace

template <int dim>
InternalForces internal_forces(const Scene<dim> &scene, const DisplacementSpace<dim> &space,
                               const ShapeTables<dim> &tables, const Vector<double> &u,
                               const Volume volume)
{
  InternalForces result;
  result.forces.reinit(space.n_dofs());
  std::map<std::array<unsigned int, 3>, std::pair<Batch<dim>, Part<dim>>> batches;
  std::vector<std::pair<const Batch<dim> *, Part<dim>>> parts; // in the order of the sum
  for (const auto &cell : space.dof_handler().active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const unsigned int index = cell->active_cell_index(), p = space.degrees()[index];
      const CellMap<dim> map = map_of<dim>(cell);
      const unsigned int n_gauss = stiffness_points(scene, map, p);
      if (scene.is_axisymmetric())
      {
        const auto dofs = space.cell_dofs(index);
        add_turned_cell<dim>(scene, cell, {dofs.data(), dofs.size()}, tables.numbering(p),
                             tables.gradients(p, n_gauss), u, result);
        continue;
      }
      const std::array<unsigned int, 3> key{{cell->material_id(), p, n_gauss}};
      auto found = batches.find(key);
      if (found == batches.end())
        found = batches
                    .emplace(key, std::make_pair(Batch<dim>(scene.material_of(cell), space, tables,
                                                            p, n_gauss, volume),
                                                 Part<dim>()))
                    .first;
      auto &[batch, part] = found->second;
      part.cells.push_back(index);
      part.maps.push_back(map);
      if (part.cells.size() == 64)
        parts.emplace_back(&batch, std::exchange(part, {}));
    }
  for (auto &[key, last] : batches)
    parts.emplace_back(&last.first, std::move(last.second));
  parallel_for_each(parts.size(), 1,
                    [&](const unsigned int k) { parts[k].first->set(u, parts[k].second); });
  for (const auto &[batch, part] : parts)
    batch->add(part, result);
  result.energy_product += add_spring_forces(spring_faces(scene, space, tables), u, result.forces);
  return result;
}

template InternalForces internal_forces(const Scene<2> &, const DisplacementSpace<2> &,
                                        const ShapeTables<2> &, const Vector<double> &, Volume);
} // namespace hpvi
