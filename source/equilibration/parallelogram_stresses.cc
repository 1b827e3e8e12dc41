// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/common_table.h>
#include <hpvi/equilibration/parallelogram_stresses.h>
#include <hpvi/equilibration/stable_modes.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hpvi
{
using namespace dealii;

namespace
{
/** psi = c + c_x xi + c_y eta + c_xy xi eta from its values at the vertices. */
std::array<double, 4> bilinear(const std::array<double, 4> &v)
{
  return {{(v[0] + v[1] + v[2] + v[3]) / 4, (-v[0] + v[1] - v[2] + v[3]) / 4,
           (-v[0] - v[1] + v[2] + v[3]) / 4, (v[0] - v[1] - v[2] + v[3]) / 4}};
}
} // namespace

ParallelogramStresses::ParallelogramStresses(const Solution<2> &solution,
                                             const VertexPatches &patches,
                                             const std::vector<unsigned int> &marked_corners,
                                             const Volume volume, EquilibrationCache &cache)
    : solution(solution), patches(patches), volume(volume), cache(cache)
{
  set_cells(marked_corners);
  set_data();
}

Tensor<2, 2> ParallelogramStresses::frame(const unsigned int cell) const
{
  const Tensor<2, 2> J = map_of<2>(patches.cells()[cell].iterator).jacobian({0.5, 0.5});
  return J / std::sqrt(determinant(J));
}

/** Elements are found in order, for the first cell of each class makes its element; what is long is done by all threads. */
void ParallelogramStresses::set_cells(const std::vector<unsigned int> &marked)
{
  cells.resize(marked.size());
  std::vector<EquilibrationCache::Signature> keys(cells.size());
  const auto place = [&](const unsigned int index)
  {
    Cell &cell = cells[index];
    const auto &iterator = patches.cells()[index].iterator;
    cell.B = frame(index);
    cell.h = std::sqrt(determinant(map_of<2>(iterator).jacobian({0.5, 0.5}))) / 2;
    unsigned int m = 0;
    for (const unsigned int edge : patches.cells()[index].edges)
      m = std::max(m, patches.edges()[edge].degree);
    keys[index] = {m, iterator->material_id(), marked[index]};
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int j = 0; j < 2; ++j)
        keys[index].push_back(std::lround(1e11 * cell.B[i][j]));
  };
  for_all(cells.size(), 32, place);
  const auto elements =
      ordered_values(cache.elements, keys,
                     [&](const unsigned int index)
                     {
                       const Material &material =
                           solution.scene.material_of(patches.cells()[index].iterator);
                       return std::make_unique<const StressElement>(keys[index][0], cells[index].B,
                                                                    material, marked[index]);
                     });
  const auto fill = [&](const unsigned int index)
  {
    cells[index].element = elements[index]->get();
    set_stress(index, solution);
    if (solution.scene.has_body_force())
      set_force(index);
  };
  for_all(cells.size(), 16, fill);
  for (unsigned int index = 0; index < cells.size(); ++index)
  {
    Cell &cell = cells[index];
    Batch &batch = batches[cell.element];
    cell.place = batch.cells.size();
    cell.first_hat = batch.n_hats;
    batch.cells.push_back(index);
    batch.n_hats += patches.cells()[index].hats.size();
  }
}

/** sigma(u_N) = B S B' and F = B f/h in the frame of the cell. */
void ParallelogramStresses::set_stress(const unsigned int index, const Solution<2> &of)
{
  Cell &cell = cells[index];
  const auto &iterator = patches.cells()[index].iterator;
  const unsigned int p = solution.displacement_space.degrees()[index];
  const HookesLaw<2> law(solution.scene.material_of(iterator));
  const Tensor<2, 2> inverse = invert(cell.B);
  cell.sigma = Modes<3>(cell.element->m + 1);
  const std::vector<double> coefficients = of.coefficients(index);
  for (unsigned int c = 0; c < 2; ++c)
  {
    const FullMatrix<double> U = cache.legendre.displacement_modes(coefficients, c, p);
    for (unsigned int d = 0; d < 2; ++d)
    {
      Tensor<2, 2> reference;
      reference[c][d] = 1 / cell.h;
      const Tensor<2, 2> s =
          inverse * Tensor<2, 2>(law.stress(reference * inverse)) * transpose(inverse);
      const std::array<double, 3> weights{{s[0][0], s[1][1], s[0][1]}};
      for (unsigned int b = 0; b <= p; ++b)
      {
        std::array<double, 2> sums{{0., 0.}}; // L_i' = root(i) sum root(a) L_a, a = i-1, i-3, ...
        for (unsigned int i = p; i > 0; --i)
        {
          const unsigned int a = i - 1;
          sums[i % 2] += legendre::root(i) * (d == 0 ? U(i, b) : U(b, i));
          for (unsigned int k = 0; k < 3; ++k)
            cell.sigma(k, d == 0 ? a : b, d == 0 ? b : a) +=
                weights[k] * legendre::root(a) * sums[i % 2];
        }
      }
    }
  }
  if (solution.scene.has_initial_strain())
    subtract_initial_stress(index);
}

/** sigma -= C eps_0, as far as the element has its modes whole. */
void ParallelogramStresses::subtract_initial_stress(const unsigned int index)
{
  Cell &cell = cells[index];
  cell.initial = initial_modes(solution, patches.cells()[index].iterator, cell.B,
                               cell.element->m - 1, cell.sigma.n, cache.legendre);
  for (unsigned int k = 0; k < cell.initial.modes.coefficients.size(); ++k)
    cell.sigma.coefficients[k] -= cell.initial.modes.coefficients[k];
}

/**
 * Interpolated at the points of the loads, so that psi F has the moments with rigid motions that the discrete
 * equations have.
 */
void ParallelogramStresses::set_force(const unsigned int index)
{
  Cell &cell = cells[index];
  const CellMap<2> map = map_of<2>(patches.cells()[index].iterator);
  const LoadRule<2> rule = solution.spaces->loads->body_force(
      patches.cells()[index].iterator, solution.displacement_space.degrees()[index]);
  const unsigned int n = rule.n_gauss;
  if (n == 0)
    return set_force(index, rule.quadrature);
  const QGauss<1> &gauss = solution.tables.gauss(n);
  const Tensor<2, 2> inverse = invert(cell.B);
  std::array<FullMatrix<double>, 2> values{{FullMatrix<double>(n, n), FullMatrix<double>(n, n)}};
  for (unsigned int a = 0; a < n; ++a)
    for (unsigned int b = 0; b < n; ++b)
    {
      const Tensor<1, 2> F =
          load_at<2>(solution.scene.body_force_in(patches.cells()[index].iterator),
                     map.point(Point<2>(gauss.point(a)[0], gauss.point(b)[0])));
      const Tensor<1, 2> f = -cell.h * (inverse * F);
      for (unsigned int k = 0; k < 2; ++k)
        values[k](a, b) = f[k];
    }
  const FullMatrix<double> &project = cache.legendre.projection(n, n);
  FullMatrix<double> half(n, n), modes(n, n);
  cell.force = Modes<2>(n);
  for (unsigned int k = 0; k < 2; ++k)
  {
    project.mmult(half, values[k]);
    half.mTmult(modes, project);
    std::copy(&modes(0, 0), &modes(0, 0) + n * n, &cell.force.coefficients[k * n * n]);
  }
}

/** The same by any other rule: moments with polynomials as high as the element and psi take. */
void ParallelogramStresses::set_force(const unsigned int index, const Quadrature<2> &rule)
{
  Cell &cell = cells[index];
  const CellMap<2> map = map_of<2>(patches.cells()[index].iterator);
  const unsigned int n = cell.element->m + 2;
  const Tensor<2, 2> inverse = invert(cell.B);
  cell.force = Modes<2>(n);
  for (unsigned int q = 0; q < rule.size(); ++q)
  {
    const Tensor<1, 2> f =
        -4 * rule.weight(q) * cell.h *
        (inverse * load_at<2>(solution.scene.body_force_in(patches.cells()[index].iterator),
                              map.point(rule.point(q))));
    const auto L_x = legendre::values(n, 2 * rule.point(q)[0] - 1),
               L_y = legendre::values(n, 2 * rule.point(q)[1] - 1);
    for (unsigned int k = 0; k < 2; ++k)
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          cell.force(k, i, j) += f[k] * L_x[i] * L_y[j];
  }
}

/**
 * Columns of data of one cell: of `psi sigma` with divergence `sigma grad psi - psi F` for the bilinear
 * functions psi.
 */
void ParallelogramStresses::set_data(const unsigned int index, double *const r) const
{
  const StressElement &element = *cells[index].element;
  const Material &material = solution.scene.material_of(patches.cells()[index].iterator);
  Modes<3> stable;
  const bool is_projected = volume == Volume::projected && material.is_nearly_incompressible(2);
  if (is_projected)
    stable = without_oscillating_pressure(
        cells[index].sigma, solution.displacement_space.degrees()[index], cells[index].B, material);
  const Modes<3> &sigma = is_projected ? stable : cells[index].sigma;
  const Modes<3> times_xi = times(0, sigma), times_eta = times(1, sigma);
  const Modes<2> &force = cells[index].force, force_xi = times(0, force);
  const auto add_column =
      [&](const unsigned int k, const Modes<3> &product, Modes<2> divergence, const Modes<2> &load)
  {
    add(divergence, load);
    element.residual(product, divergence, r + std::size_t(k) * element.n_data);
  };
  add_column(0, sigma, Modes<2>(sigma.n), force);
  add_column(1, times_xi, row(0, sigma), force_xi);
  add_column(2, times_eta, row(1, sigma), times(1, force));
  Modes<2> both = row(0, times_eta);
  add(both, row(1, times_xi));
  add_column(3, times(1, times_xi), both, times(1, force_xi));
}

/** result := `matrix' r` for each hat function of some cells, from r for each of the bilinear functions. */
void ParallelogramStresses::set_hats(const std::vector<unsigned int> &some_cells,
                                     const std::vector<double> &matrix,
                                     const std::vector<double> &r, double *result) const
{
  const unsigned int n_columns = n_bilinear * some_cells.size(), n_data = r.size() / n_columns,
                     n_rows = matrix.size() / n_data;
  std::vector<double> products(std::size_t(n_rows) * n_columns);
  multiply('T', 'N', n_rows, n_columns, n_data, 1., {matrix.data(), n_data}, {r.data(), n_data}, 0.,
           products.data(), n_rows);
  const double *product = products.data();
  for (const unsigned int index : some_cells)
  {
    for (const VertexPatches::Hat &hat : patches.cells()[index].hats)
    {
      const std::array<double, n_bilinear> c = bilinear(hat.values);
      for (unsigned int i = 0; i < n_rows; ++i)
        *result++ = c[0] * product[i] + c[1] * product[n_rows + i] +
                    c[2] * product[2 * n_rows + i] + c[3] * product[3 * n_rows + i];
    }
    product += std::size_t(n_bilinear) * n_rows;
  }
}

/** Some cells of one element at a time: what they need on the way stays in the cache. */
std::vector<ParallelogramStresses::Part> ParallelogramStresses::parts() const
{
  constexpr std::size_t at_once = 64;
  std::vector<Part> result;
  for (const auto &[element, batch] : batches)
    for (std::size_t first = 0; first < batch.cells.size(); first += at_once)
      result.push_back({element,
                        {batch.cells.begin() + first,
                         batch.cells.begin() + std::min(first + at_once, batch.cells.size())}});
  return result;
}

void ParallelogramStresses::set_data()
{
  for (auto &[element, batch] : batches)
  {
    batch.r.reset(new double[std::size_t(element->n_data) * batch.cells.size()]);
    batch.gradients.reset(new double[std::size_t(element->n_edges) * batch.n_hats]);
    batch.defects.reset(new double[std::size_t(element->n_conditions()) * batch.n_hats]);
  }
  const std::vector<Part> all = parts();
  const auto set_part = [&](const unsigned int number)
  {
    const auto &[element, some_cells] = all[number];
    Batch &batch = batches.at(element);
    const std::size_t n = element->n_data, column = n * n_bilinear;
    std::vector<double> r(column * some_cells.size());
    for (unsigned int k = 0; k < some_cells.size(); ++k)
    {
      set_data(some_cells[k], &r[column * k]);
      std::copy(&r[column * k], &r[column * k] + n, &batch.r[n * cells[some_cells[k]].place]);
    }
    const std::size_t first_hat = cells[some_cells[0]].first_hat;
    set_hats(some_cells, element->edge_energy(), r, &batch.gradients[first_hat * element->n_edges]);
    set_hats(some_cells, element->conditions(), r,
             &batch.defects[first_hat * element->n_conditions()]);
  };
  for_all(all.size(), 1, set_part);
}

/** Of sigma with divergence -F. */
void ParallelogramStresses::set_own_data(const unsigned int index)
{
  const Cell &cell = cells[index];
  const std::size_t n = cell.element->n_data;
  cell.element->residual(cell.sigma, cell.force, &batches.at(cell.element).r[n * cell.place]);
}

PatchCell ParallelogramStresses::patch_cell(const unsigned int index, const unsigned int hat) const
{
  const Cell &cell = cells[index];
  const Batch &batch = batches.at(cell.element);
  const std::size_t column = cell.first_hat + hat;
  return {traction_energy(*cell.element), cell.h * cell.h,
          &batch.gradients[column * cell.element->n_edges],
          &batch.defects[column * cell.element->n_conditions()], &patches.cells()[index]};
}

double ParallelogramStresses::missed_force(const unsigned int index) const
{
  if (cells[index].force.n == 0)
    return 0.;
  const unsigned int number =
      1000 * cells[index].element->m + solution.displacement_space.degrees()[index];
  return common_value(cache.missed_forces, cell_key(patches.cells()[index].iterator, number),
                      [&]() { return look_at_missed_force(index); });
}

double ParallelogramStresses::look_at_missed_force(const unsigned int index) const
{
  const Cell &cell = cells[index];
  const Modes<2> &modes = cell.force;
  const unsigned int m = cell.element->m;
  const auto &iterator = patches.cells()[index].iterator;
  const CellMap<2> map = map_of<2>(iterator);
  const auto &loads = *solution.spaces->loads;
  const LoadRule<2> own = loads.body_force(iterator, solution.displacement_space.degrees()[index]);
  const Quadrature<2> rule = own.n_gauss > 0 ? Quadrature<2>(solution.tables.gauss(modes.n + 2))
                                             : loads.body_force(iterator, m).quadrature;
  double sum = 0;
  for (unsigned int q = 0; q < rule.size(); ++q)
  {
    const auto L_x = legendre::values(modes.n, 2 * rule.point(q)[0] - 1),
               L_y = legendre::values(modes.n, 2 * rule.point(q)[1] - 1);
    Tensor<1, 2> projected;
    for (unsigned int k = 0; k < 2; ++k)
      for (unsigned int i = 0; i < std::min(modes.n, m - k); ++i)
        for (unsigned int j = 0; j < std::min(modes.n, m - 1 + k); ++j)
          projected[k] -= modes(k, i, j) * L_x[i] * L_y[j];
    const Tensor<1, 2> missed =
        load_at<2>(solution.scene.body_force_in(iterator), map.point(rule.point(q))) -
        cell.B * projected / cell.h;
    sum += rule.weight(q) * missed.norm_square();
  }
  return std::sqrt(sum) * 2 * cell.h;
}

std::vector<double> ParallelogramStresses::data(const unsigned int index) const
{
  const Cell &cell = cells[index];
  const std::size_t n = cell.element->n_data;
  const double *const column = &batches.at(cell.element).r[n * cell.place];
  return std::vector<double>(column, column + n);
}

void ParallelogramStresses::measure_from(const Solution<2> &other)
{
  for_all(cells.size(), 16,
          [&](const unsigned int index)
          {
            set_stress(index, other);
            set_own_data(index);
          });
}

std::vector<double> ParallelogramStresses::squares(const WithTractions &with_tractions) const
{
  std::vector<double> result(cells.size());
  const std::vector<Part> all = parts();
  const auto measure = [&](const unsigned int number)
  {
    const auto &[element, some_cells] = all[number];
    std::vector<double> R;
    R.reserve(std::size_t(element->n_data) * some_cells.size());
    for (const unsigned int index : some_cells)
      for (const double value : with_tractions(index))
        R.push_back(value);
    element->half_energy(R, some_cells.size());
    for (unsigned int k = 0; k < some_cells.size(); ++k)
    {
      const double *const y = &R[std::size_t(k) * element->n_data];
      result[some_cells[k]] =
          std::pow(cells[some_cells[k]].h, 2) * std::inner_product(y, y + element->n_data, y, 0.);
    }
  };
  for_all(all.size(), 1, measure);
  return result;
}

StressElement::Stress ParallelogramStresses::stress(const unsigned int cell,
                                                    const std::vector<double> &data) const
{
  return cells[cell].element->stress(cells[cell].sigma, data.data());
}
} // namespace hpvi
