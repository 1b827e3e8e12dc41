// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/dense_algebra.h>
#include <hpvi/base/memo_table.h>
#include <hpvi/bound/force_modes.h>
#include <hpvi/bound/parallelogram_stresses.h>
#include <hpvi/plane/initial_stress.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hpvi
{
using namespace dealii;

namespace
{
/** A symmetric matrix by xx, yy, xy. */
Tensor<2, 2> symmetric(const double xx, const double yy, const double xy)
{
  Tensor<2, 2> result;
  result[0][0] = xx;
  result[1][1] = yy;
  result[0][1] = result[1][0] = xy;
  return result;
}

/**
 * Modes of `B^-1 C eps_0 B^-T` in a parallelogram, of degrees below @p n_whole; room for @p n. They are those of the polynomials
 * through the values at the points of the discrete equations, on each part of their rule, which is what these know; what of it is left out is orthogonal to
 * the strains of hat functions times rigid motions.
 */
InitialModes initial_modes(const Solution<2> &solution,
                           const DoFHandler<2>::active_cell_iterator &cell, const Tensor<2, 2> &B,
                           const unsigned int n_whole, const unsigned int n)
{
  InitialModes result{Modes<3>(n), 0.};
  if (!solution.scene.initial_strains[cell->material_id()])
    return result;
  const unsigned int degree = solution.displacement_space.degrees()[cell->active_cell_index()];
  const LoadRule<2> rule = solution.spaces->loads->initial_strain(cell, degree);
  unsigned int known = n_whole;
  for (const RulePart<2> &part : rule.parts) // beyond these the polynomials on parts know nothing
    known = std::min(known, part.n);
  const CellMap<2> map = map_of<2>(cell);
  const HookesLaw<2> law(solution.scene.material_of(cell));
  const Tensor<2, 2> inverse = invert(B);
  const std::vector<Point<2>> &points = rule.quadrature.get_points();
  std::vector<Tensor<2, 2>> stresses;
  FullMatrix<double> L_x(points.size(), known), L_y(L_x);
  for (unsigned int q = 0; q < points.size(); ++q)
  {
    const auto of_x = legendre::values(known, 2 * points[q][0] - 1),
               of_y = legendre::values(known, 2 * points[q][1] - 1);
    std::copy(of_x.begin(), of_x.end(), &L_x(q, 0));
    std::copy(of_y.begin(), of_y.end(), &L_y(q, 0));
    stresses.emplace_back(law.stress(solution.scene.initial_strain_in(cell, map.point(points[q]))));
    const Tensor<2, 2> s =
        4 * rule.quadrature.weight(q) * (inverse * stresses[q] * transpose(inverse));
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int i = 0; i < known; ++i)
        for (unsigned int j = 0; j < known; ++j)
          result.modes(k, i, j) += s[k == 1][k != 0] * L_x(q, i) * L_y(q, j);
  }
  // By quadrature at the points of the discrete equations, which is exact for the polynomials that these know.
  double missed = 0, whole = 0;
  for (unsigned int q = 0; q < points.size(); ++q)
  {
    std::array<double, 3> seen{};
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int i = 0; i < known; ++i)
        for (unsigned int j = 0; j < known; ++j)
          seen[k] += result.modes(k, i, j) * L_x(q, i) * L_y(q, j);
    const Tensor<2, 2> left = stresses[q] - B * symmetric(seen[0], seen[1], seen[2]) * transpose(B);
    missed += rule.quadrature.weight(q) * law.complementary_product(left, left);
    whole += rule.quadrature.weight(q) * law.complementary_product(stresses[q], stresses[q]);
  }
  if (missed > 1e-26 * whole) // or round-off
    result.missed = std::sqrt(std::abs(determinant(map.jacobian(Point<2>(0.5, 0.5)))) * missed);
  return result;
}

/**
 * The stress of a displacement of degree @p p whose discrete equations know but the projection of div u (Volume::projected), in the frame B of
 * a parallelogram, from its stress @p sigma.
 */
Modes<3> without_oscillating_pressure(Modes<3> sigma, const unsigned int p, const Tensor<2, 2> &B,
                                      const Material &material)
{
  const HookesLaw<2> law(material);
  const Tensor<2, 2> to_trace = transpose(B) * B, unit = invert(to_trace);
  for (unsigned int i = 0; i < sigma.n; ++i)
    for (unsigned int j = 0; j < sigma.n; ++j)
      if (i + j >= p)
      {
        const double trace = sigma(0, i, j) * to_trace[0][0] + sigma(1, i, j) * to_trace[1][1] +
                             2 * sigma(2, i, j) * to_trace[0][1];
        const double pressure = law.volumetric_stress(trace);
        sigma(0, i, j) -= pressure * unit[0][0];
        sigma(1, i, j) -= pressure * unit[1][1];
        sigma(2, i, j) -= pressure * unit[0][1];
      }
  return sigma;
}

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
    : solution(solution), measured(&solution), patches(patches),
      is_projected(volume == Volume::projected), cache(cache)
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
  parallel_for_each(cells.size(), 32, place);
  const auto elements =
      ordered_values(cache.elements, keys,
                     [&](const unsigned int index)
                     {
                       const Material &material =
                           solution.scene.material_of(patches.cells()[index].iterator);
                       return std::make_unique<const StressElement>(keys[index][0], cells[index].B,
                                                                    material, marked[index]);
                     });
  const auto add_loads = [&](const unsigned int index)
  {
    cells[index].element = elements[index]->get();
    if (solution.scene.has_initial_strain())
      cells[index].initial =
          initial_modes(solution, patches.cells()[index].iterator, cells[index].B,
                        cells[index].element->m - 1, cells[index].element->m + 1);
    if (solution.scene.has_body_force())
      cells[index].force = force_modes(solution, patches.cells()[index].iterator, cells[index].B,
                                       cells[index].h, cells[index].element->m, cache.legendre);
  };
  parallel_for_each(cells.size(), 16, add_loads);
  for (unsigned int index = 0; index < cells.size(); ++index)
  {
    Cell &cell = cells[index];
    const unsigned int p = solution.displacement_space.degrees()[index];
    cell.batch = &batches[{cell.element, {{p, cell.force.n}}}];
    cell.place = cell.batch->cells.size();
    cell.first_hat = cell.batch->n_hats;
    cell.batch->cells.push_back(index);
    cell.batch->n_hats += patches.cells()[index].hats.size();
  }
}

CellLaw ParallelogramStresses::law(const unsigned int index) const
{
  const Cell &cell = cells[index];
  return {solution.displacement_space.degrees()[index], cell.B, cell.h,
          &solution.scene.material_of(patches.cells()[index].iterator)};
}

/** Of u_N alone, not projected. */
Modes<3> ParallelogramStresses::displacement_stress(const unsigned int index) const
{
  return stress_modes(law(index), measured->coefficients(index), cells[index].element->m + 1,
                      cache.legendre);
}

/** As the discrete equations see it. */
Modes<3> ParallelogramStresses::seen(const unsigned int index, Modes<3> sigma) const
{
  const CellLaw cell = law(index);
  if (!is_projected || !cell.material->is_nearly_incompressible(2))
    return sigma;
  return without_oscillating_pressure(std::move(sigma), cell.degree, cell.B, *cell.material);
}

CellStress ParallelogramStresses::cell_stress(const unsigned int index) const
{
  const Modes<3> &initial = cells[index].initial.modes;
  Modes<3> sigma = displacement_stress(index);
  for (unsigned int k = 0; k < initial.coefficients.size(); ++k)
    sigma.coefficients[k] -= initial.coefficients[k];
  return {seen(index, std::move(sigma)), cells[index].force};
}

/** Some cells of one batch at a time: what they need on the way stays in the cache. */
std::vector<ParallelogramStresses::Part> ParallelogramStresses::parts()
{
  constexpr std::size_t grain = 64;
  std::vector<Part> result;
  for (auto &[key, batch] : batches)
    for (std::size_t first = 0; first < batch.cells.size(); first += grain)
      result.push_back({&batch,
                        {batch.cells.begin() + first,
                         batch.cells.begin() + std::min(first + grain, batch.cells.size())}});
  return result;
}

/**
 * Those of modes are worth having for all cells of a batch where it has a few, as more steps will use them; this step alone decides.
 * In a batch of fewer, or with initial stresses, whose modes are more, each cell has its own.
 */
void ParallelogramStresses::set_data_of_modes()
{
  std::vector<Batch *> large;
  std::vector<EquilibrationCache::Signature> keys;
  for (auto &[key, batch] : batches)
  {
    const auto &[element, numbers] = key;
    const auto [p, n_force] = numbers;
    if (6 * batch.cells.size() < n_modes(p, n_force) || solution.scene.has_initial_strain())
      continue;
    large.push_back(&batch);
    keys.push_back({reinterpret_cast<long>(element), p, n_force});
  }
  const auto make = [&](const unsigned int k)
  {
    return data_of_modes(*reinterpret_cast<const StressElement *>(keys[k][0]), keys[k][1],
                         keys[k][2]);
  };
  const auto data = ordered_values(cache.data_of_modes, keys, make);
  for (unsigned int k = 0; k < large.size(); ++k)
    large[k]->of_modes = data[k];
}

/** n_modes x cells. */
std::vector<double> ParallelogramStresses::modes(const Part &part) const
{
  std::vector<double> result;
  for (const unsigned int index : part.some_cells)
    append_modes(cell_stress(index), solution.displacement_space.degrees()[index], result);
  return result;
}

/** What products of stress and hat functions, and of loads and hat functions, have. */
void ParallelogramStresses::set_part(const Part &part)
{
  const Batch &batch = *part.batch;
  const StressElement &element = *cells[part.some_cells[0]].element;
  double *const r = &batch.r[std::size_t(element.n_data) * cells[part.some_cells[0]].place];
  if (!batch.of_modes)
  {
    std::vector<CellStress> stresses;
    for (const unsigned int index : part.some_cells)
      stresses.push_back(cell_stress(index));
    const PatchData data = patch_data(element, stresses);
    std::copy(data.r.begin(), data.r.end(), r);
    return set_hats(part, data.sides);
  }
  const unsigned int n_data = element.n_data, n_cells = part.some_cells.size(),
                     n_sides = PatchData::n_bilinear * (element.n_edges + element.n_conditions());
  const std::vector<double> of_cells = modes(part);
  const unsigned int n = of_cells.size() / n_cells;
  std::vector<double> sides(std::size_t(n_sides) * n_cells);
  multiply('N', 'N', n_data, n_cells, n, 1., {batch.of_modes->r.data(), n_data},
           {of_cells.data(), n}, 0., r, n_data);
  multiply('N', 'N', n_sides, n_cells, n, 1., {batch.of_modes->sides.data(), n_sides},
           {of_cells.data(), n}, 0., sides.data(), n_sides);
  set_hats(part, sides);
}

/** For each hat function of some cells, from what there is for each of the bilinear functions. */
void ParallelogramStresses::set_hats(const Part &part, const std::vector<double> &sides)
{
  const Batch &batch = *part.batch;
  const StressElement &element = *cells[part.some_cells[0]].element;
  const unsigned int n_edges = element.n_edges, n_conditions = element.n_conditions(),
                     n_sides = n_edges + n_conditions;
  const std::size_t first = cells[part.some_cells[0]].first_hat;
  double *gradient = &batch.gradients[first * n_edges],
         *defect = &batch.defects[first * n_conditions];
  const double *side = sides.data();
  for (const unsigned int index : part.some_cells)
  {
    for (const VertexPatches::Hat &hat : patches.cells()[index].hats)
    {
      const std::array<double, 4> c = bilinear(hat.values);
      const auto combine = [&](const unsigned int i)
      {
        return c[0] * side[i] + c[1] * side[n_sides + i] + c[2] * side[2 * n_sides + i] +
               c[3] * side[3 * n_sides + i];
      };
      for (unsigned int i = 0; i < n_edges; ++i)
        *gradient++ = combine(i);
      for (unsigned int i = n_edges; i < n_sides; ++i)
        *defect++ = combine(i);
    }
    side += std::size_t(PatchData::n_bilinear) * n_sides;
  }
}

void ParallelogramStresses::set_data()
{
  set_data_of_modes();
  for (auto &[key, batch] : batches)
  {
    const StressElement &element = *key.first;
    batch.r.reset(new double[std::size_t(element.n_data) * batch.cells.size()]);
    batch.gradients.reset(new double[std::size_t(element.n_edges) * batch.n_hats]);
    batch.defects.reset(new double[std::size_t(element.n_conditions()) * batch.n_hats]);
  }
  const std::vector<Part> all = parts();
  parallel_for_each(all.size(), 1, [&](const unsigned int k) { set_part(all[k]); });
}

/** Those of sigma and -F alone. */
void ParallelogramStresses::set_own_data(const Part &part)
{
  const Batch &batch = *part.batch;
  const StressElement &element = *cells[part.some_cells[0]].element;
  const unsigned int n_data = element.n_data, n_cells = part.some_cells.size();
  double *r = &batch.r[std::size_t(n_data) * cells[part.some_cells[0]].place];
  if (batch.of_modes)
  {
    const std::vector<double> of_cells = modes(part);
    const unsigned int n = of_cells.size() / n_cells;
    multiply('N', 'N', n_data, n_cells, n, 1., {batch.of_modes->r.data(), n_data},
             {of_cells.data(), n}, 0., r, n_data);
    return;
  }
  for (const unsigned int index : part.some_cells)
  {
    residual_of_one(element, cell_stress(index), r);
    r += n_data;
  }
}

PatchCell ParallelogramStresses::patch_cell(const unsigned int index, const unsigned int hat) const
{
  const Cell &cell = cells[index];
  const Batch &batch = *cell.batch;
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
  return memoised(cache.missed_forces, cell_key(patches.cells()[index].iterator, number),
                  [&]()
                  {
                    return hpvi::missed_force(solution, patches.cells()[index].iterator,
                                              cells[index].B, cells[index].h,
                                              cells[index].element->m, cells[index].force);
                  });
}

std::vector<double> ParallelogramStresses::data(const unsigned int index) const
{
  const Cell &cell = cells[index];
  const std::size_t n = cell.element->n_data;
  const double *const column = &cell.batch->r[n * cell.place];
  return std::vector<double>(column, column + n);
}

void ParallelogramStresses::measure_from(const Solution<2> &other)
{
  measured = &other;
  is_projected = false;
  const std::vector<Part> all = parts();
  parallel_for_each(all.size(), 1, [&](const unsigned int k) { set_own_data(all[k]); });
}

std::vector<double> ParallelogramStresses::squares(const WithTractions &with_tractions)
{
  std::vector<double> result(cells.size());
  const std::vector<Part> all = parts();
  const auto measure = [&](const unsigned int number)
  {
    const std::vector<unsigned int> &some_cells = all[number].some_cells;
    const StressElement &element = *cells[some_cells[0]].element;
    std::vector<double> R;
    R.reserve(std::size_t(element.n_data) * some_cells.size());
    for (const unsigned int index : some_cells)
      for (const double value : with_tractions(index))
        R.push_back(value);
    element.half_energy(R, some_cells.size());
    for (unsigned int k = 0; k < some_cells.size(); ++k)
    {
      const double *const y = &R[std::size_t(k) * element.n_data];
      result[some_cells[k]] =
          std::pow(cells[some_cells[k]].h, 2) * std::inner_product(y, y + element.n_data, y, 0.);
    }
  };
  parallel_for_each(all.size(), 1, measure);
  return result;
}

StressElement::Stress ParallelogramStresses::stress(const unsigned int cell,
                                                    const std::vector<double> &data) const
{
  return cells[cell].element->stress(cell_stress(cell).sigma, data.data());
}
} // namespace hpvi
