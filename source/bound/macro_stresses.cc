// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/memo_table.h>
#include <hpvi/base/text.h>
#include <hpvi/bound/macro_stresses.h>
#include <hpvi/plane/element_matrices.h>
#include <hpvi/plane/initial_stress.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/**
 * Reference coordinates in [0,1]^2 of a point x of a cell, `x = a + b xi + c eta + e xi eta`: xi solves
 * `(x - a - b xi) x (c + e xi) = 0`, with slope -det J.
 */
Point<2> reference_point(const CellMap<2>::Vertices &v, const Point<2> &x)
{
  const Tensor<1, 2> b = v[1] - v[0], c = v[2] - v[0], e = (v[3] - v[1]) - c, d = x - v[0];
  const double two = -cross(b, e), one = cross(d, e) - cross(b, c), zero = cross(d, c);
  const double root = std::sqrt(std::max(0., one * one - 4 * two * zero));
  const double xi = one < 0 ? 2 * zero / (root - one) : -(one + root) / (2 * two);
  const Tensor<1, 2> across = c + xi * e;
  return {xi, ((d - xi * b) * across) / across.norm_square()};
}

/** u_N on one cell in Legendre polynomials: both derivatives of both components. */
class Gradient
{
public:
  Gradient(const Solution<2> &solution, const unsigned int cell, const LegendreTables &legendre)
      : n(solution.displacement_space.degrees()[cell] + 1)
  {
    const std::vector<double> coefficients = solution.coefficients(cell);
    for (unsigned int c = 0; c < 2; ++c)
    {
      const FullMatrix<double> U = legendre.displacement_modes(coefficients, c, n - 1);
      for (auto &modes : slopes[c])
        modes.reinit(n, n);
      for (unsigned int i = 1; i < n; ++i)
        for (int a = static_cast<int>(i) - 1; a >= 0; a -= 2)
          for (unsigned int b = 0; b < n; ++b)
          {
            slopes[c][0](a, b) += 2 * legendre::derivative(i, a) * U(i, b);
            slopes[c][1](b, a) += 2 * legendre::derivative(i, a) * U(b, i);
          }
    }
  }

  /** d u_c / d xi_d at points. */
  std::vector<Tensor<2, 2>> at(const std::vector<Point<2>> &points) const
  {
    const unsigned int n_points = points.size();
    std::vector<double> x, y, half(n * n_points);
    for (const Point<2> &point : points)
    {
      const auto Lx = legendre::values(n, 2 * point[0] - 1),
                 Ly = legendre::values(n, 2 * point[1] - 1);
      x.insert(x.end(), Lx.begin(), Lx.end());
      y.insert(y.end(), Ly.begin(), Ly.end());
    }
    std::vector<Tensor<2, 2>> result(n_points);
    for (unsigned int c = 0; c < 2; ++c)
      for (unsigned int d = 0; d < 2; ++d)
      {
        // matrices of deal.II are transposed, by columns
        multiply('N', 'N', n, n_points, n, 1., {&slopes[c][d](0, 0), n}, {x.data(), n}, 0.,
                 half.data(), n);
        for (unsigned int q = 0; q < n_points; ++q)
          for (unsigned int j = 0; j < n; ++j)
            result[q][c][d] += half[q * n + j] * y[q * n + j];
      }
    return result;
  }

private:
  const unsigned int n;
  std::array<std::array<FullMatrix<double>, 2>, 2> slopes;
};

/** What a triangle is given at its points. */
struct Fields
{
  std::vector<Point<2>> reference, points;
  std::vector<std::array<double, 3>> sigma; ///< xx, yy, xy
  std::vector<Tensor<1, 2>> force;          ///< F, or empty
};

Fields fields_of(const MacroStressElement &element, const unsigned int f, const double h,
                 const CellMap<2> &map, const TriangleTable &table, const Gradient &gradient,
                 const HookesLaw<2> &law, const Load<2> *const load,
                 const std::function<Tensor<2, 2>(const Point<2> &)> &initial_strain)
{
  Fields result;
  const auto &piece = element.piece(f);
  for (const auto &xy : table.points)
  {
    result.points.push_back(
        map.vertices()[0] +
        h * (element.crossing + piece.scale * (piece.B * Tensor<1, 2>({xy[0], xy[1]}))));
    result.reference.push_back(reference_point(map.vertices(), result.points.back()));
  }
  const std::vector<Tensor<2, 2>> slopes = gradient.at(result.reference);
  for (unsigned int q = 0; q < slopes.size(); ++q)
  {
    const Tensor<2, 2> s = law.stress(slopes[q] * invert(map.jacobian(result.reference[q])) -
                                      initial_strain(result.points[q]));
    result.sigma.push_back({{s[0][0], s[1][1], s[0][1]}});
  }
  if (load)
    for (const Point<2> &x : result.points)
      result.force.push_back(load_at<2>(*load, x));
  return result;
}

/**
 * Moments of `psi sigma` and of `h (sigma grad psi - psi F)` with the basis of a triangle, n x 5 for each of
 * the four bilinear psi.
 */
std::vector<double> moments_of(const Fields &fields, const CellMap<2> &map, const double h,
                               const TriangleTable &table)
{
  const unsigned int n_points = table.points.size(), n = table.values.size() / n_points;
  std::vector<double> values(20 * n_points), result(20 * n);
  for (unsigned int q = 0; q < n_points; ++q)
  {
    const double xi = fields.reference[q][0], eta = fields.reference[q][1];
    const Tensor<2, 2> inverse = invert(map.jacobian(fields.reference[q]));
    const auto &s = fields.sigma[q];
    for (unsigned int v = 0; v < 4; ++v)
    {
      const double x = v % 2 ? xi : 1 - xi, y = v / 2 ? eta : 1 - eta, psi = x * y;
      const Tensor<1, 2> slope =
          Tensor<1, 2>({v % 2 ? y : -y, v / 2 ? x : -x}) * inverse; // in x and y
      Tensor<1, 2> divergence{
          {s[0] * slope[0] + s[2] * slope[1], s[2] * slope[0] + s[1] * slope[1]}};
      if (!fields.force.empty())
        divergence -= psi * fields.force[q];
      for (unsigned int k = 0; k < 5; ++k)
        values[(5 * v + k) * n_points + q] =
            table.weights[q] * (k < 3 ? psi * s[k] : h * divergence[k - 3]);
    }
  }
  multiply('N', 'N', n, 20, n_points, 1., {table.values.data(), n}, {values.data(), n_points}, 0.,
           result.data(), n);
  return result;
}

/** Stress and divergence of one column in the frame of a triangle, from moments n x 5. */
void append(const MacroStressElement &element, const unsigned int f, const double *const moments,
            MacroStressElement::Data &data)
{
  const unsigned int n = element.triangle.n, n_lower = element.triangle.n_divergence / 2;
  const Tensor<2, 2> inverse = invert(element.piece(f).B);
  std::vector<double> stress(3 * n), divergence(2 * n_lower);
  for (unsigned int l = 0; l < n; ++l)
  {
    Tensor<2, 2> s;
    s[0][0] = moments[l];
    s[1][1] = moments[n + l];
    s[0][1] = s[1][0] = moments[2 * n + l];
    s = inverse * s * transpose(inverse);
    stress[l] = s[0][0];
    stress[n + l] = s[1][1];
    stress[2 * n + l] = s[0][1];
  }
  for (unsigned int l = 0; l < n_lower; ++l)
    for (unsigned int c = 0; c < 2; ++c)
      divergence[c * n_lower + l] = element.piece(f).scale * (inverse[c][0] * moments[3 * n + l] +
                                                              inverse[c][1] * moments[4 * n + l]);
  data.stress[f].insert(data.stress[f].end(), stress.begin(), stress.end());
  data.divergence[f].insert(data.divergence[f].end(), divergence.begin(), divergence.end());
}

/** |sigma - q|^2 and |F - Pi F|^2 on a triangle, over its area in the reference triangle, from moments n x 5. */
std::array<double, 2> missed(const Fields &fields, const TriangleTable &table,
                             const std::vector<double> &moments, const double h,
                             const unsigned int n_lower, const HookesLaw<2> &law)
{
  const unsigned int n_points = table.points.size(), n = table.values.size() / n_points;
  std::vector<double> values(5 * n_points);
  multiply('T', 'N', n_points, 3, n, 1., {table.values.data(), n}, {moments.data(), n}, 0.,
           values.data(), n_points);
  multiply('T', 'N', n_points, 2, n_lower, 1., {table.values.data(), n}, {&moments[3 * n], n}, 0.,
           &values[3 * n_points], n_points);
  std::array<double, 2> result{};
  for (unsigned int q = 0; q < n_points; ++q)
  {
    SymmetricTensor<2, 2> s; // by xx, yy, xy
    for (unsigned int k = 0; k < 3; ++k)
      s.access_raw_entry(k) = fields.sigma[q][k] - values[k * n_points + q];
    result[0] += table.weights[q] * law.complementary_product(s, s);
    for (unsigned int c = 0; c < 2 && !fields.force.empty(); ++c)
      result[1] +=
          table.weights[q] * std::pow(fields.force[q][c] + values[(3 + c) * n_points + q] / h, 2);
  }
  return result;
}

/** Congruent cells of one material share an element. */
EquilibrationCache::Signature class_of(const VertexPatches &patches, const unsigned int cell)
{
  const auto &iterator = patches.cells()[cell].iterator;
  unsigned int m = 0;
  for (const unsigned int edge : patches.cells()[cell].edges)
    m = std::max(m, patches.edges()[edge].degree);
  const CellMap<2>::Vertices vertices = map_of<2>(iterator).vertices();
  double size = 0;
  for (const Point<2> &v : vertices)
    size = std::max(size, (v - vertices[0]).norm());
  EquilibrationCache::Signature key = {m, iterator->material_id()};
  for (const Point<2> &v : vertices)
    for (unsigned int d = 0; d < 2; ++d)
      key.push_back(std::lround((v[d] - vertices[0][d]) / size * 1e11));
  return key;
}
} // namespace

std::string cut_inside_distorted_cell(const Solution<2> &solution)
{
  const LoadRules<2> &rules = *solution.spaces->loads;
  for (const auto &cell : solution.displacement_space.dof_handler().active_cell_iterators())
  {
    const unsigned int degree = solution.displacement_space.degrees()[cell->active_cell_index()];
    for (const Datum datum : {Datum::load, Datum::initial_strain})
      if (const GivenData given = given_data(solution.scene, cell, inside, datum);
          given.varies() && (datum == Datum::load ? rules.body_force(cell, degree)
                                                  : rules.initial_strain(cell, degree))
                                    .n_gauss == 0)
        return given.name + " is cut inside the cell at " + to_string(cell->center()) +
               ", and a stress in cells that are no parallelograms does not know its pieces";
  }
  return {};
}

MacroStresses::MacroStresses(const Solution<2> &solution, const VertexPatches &patches,
                             EquilibrationCache &cache)
    : solution(solution), patches(patches), cache(cache), cells(patches.cells().size())
{
  std::vector<EquilibrationCache::Signature> keys(cells.size());
  parallel_for_each(cells.size(), 32,
                    [&](const unsigned int cell) { keys[cell] = class_of(patches, cell); });
  using Kept = decltype(cache.macro_elements)::mapped_type;
  const auto elements = ordered_values(
      cache.macro_elements, keys,
      [&](const unsigned int cell)
      {
        const auto &iterator = patches.cells()[cell].iterator;
        return Kept{std::make_unique<const MacroStressElement>(
                        cache.triangles.triangle(keys[cell][0] - 1), map_of<2>(iterator).vertices(),
                        solution.scene.material_of(iterator)),
                    false};
      });
  for (unsigned int cell = 0; cell < cells.size(); ++cell)
  {
    elements[cell]->is_used = true;
    cells[cell].element = elements[cell]->value.get();
  }
  parallel_for_each(cells.size(), 4, [&](const unsigned int cell) { set_cell(cell); });
}

void MacroStresses::set_cell(const unsigned int index)
{
  Cell &cell = cells[index];
  const auto &iterator = patches.cells()[index].iterator;
  const CellMap<2> map = map_of<2>(iterator);
  cell.h = MacroStressElement::size(map.vertices());
  const unsigned int p = solution.displacement_space.degrees()[index], k = cell.element->triangle.k,
                     n = cell.element->triangle.n;
  // Divergences keep the balance of the discrete equations; the degree of sigma phi_l grows by k.
  unsigned int n_gauss = stiffness_points(map, p) + k / 2 + 2;
  if (solution.scene.has_body_force())
    n_gauss = std::max(n_gauss, solution.spaces->loads->body_force(iterator, p).most_points + 2);
  if (solution.scene.has_initial_strain())
    n_gauss =
        std::max(n_gauss, solution.spaces->loads->initial_strain(iterator, p).most_points + 2);
  const TriangleTable &table = cache.triangles.table(k, n_gauss);
  const Gradient gradient(solution, index, cache.legendre);
  const HookesLaw<2> law(solution.scene.material_of(iterator));
  MacroStressElement::Data by_vertex(4);
  cell.data.columns = 1;
  const Load<2> *const force =
      solution.scene.has_body_force() ? &solution.scene.body_force_in(iterator) : nullptr;
  for (unsigned int f = 0; f < 4; ++f)
  {
    const Fields fields =
        fields_of(*cell.element, f, cell.h, map, table, gradient, law, force,
                  [&](const Point<2> &x) { return solution.scene.initial_strain_in(iterator, x); });
    const std::vector<double> moments = moments_of(fields, map, cell.h, table);
    std::vector<double> sum(5 * n);
    for (unsigned int i = 0; i < moments.size(); ++i)
      sum[i % (5 * n)] += moments[i];
    for (unsigned int v = 0; v < 4; ++v)
      append(*cell.element, f, &moments[5 * n * v], by_vertex);
    append(*cell.element, f, sum.data(), cell.data);
    const auto [stress, force] =
        missed(fields, table, sum, cell.h, cell.element->triangle.n_divergence / 2, law);
    const double area = std::pow(cell.element->piece(f).scale * cell.h, 2);
    cell.remainder += area * stress;
    cell.missed_force += area * force;
  }
  cell.missed_force = std::sqrt(cell.missed_force);
  set_hats(index, by_vertex);
}

/** What hat functions are given, from that of the bilinear ones of the vertices. */
void MacroStresses::set_hats(const unsigned int index, const MacroStressElement::Data &by_vertex)
{
  Cell &cell = cells[index];
  std::vector<double> gradients, defects;
  cell.element->reduce(by_vertex, gradients, defects);
  for (const VertexPatches::Hat &hat : patches.cells()[index].hats)
    for (auto [from, to] :
         {std::make_pair(&gradients, &cell.gradients), std::make_pair(&defects, &cell.defects)})
      for (unsigned int i = 0; i < from->size() / 4; ++i)
      {
        double value = 0;
        for (unsigned int v = 0; v < 4; ++v)
          value += hat.values[v] * (*from)[v * (from->size() / 4) + i];
        to->push_back(value);
      }
}

PatchCell MacroStresses::patch_cell(const unsigned int index, const unsigned int hat) const
{
  const Cell &cell = cells[index];
  const MacroStressElement &element = *cell.element;
  return {traction_energy(element), cell.h * cell.h, &cell.gradients[hat * element.n_edges],
          &cell.defects[hat * MacroStressElement::n_conditions], &patches.cells()[index]};
}

double MacroStresses::square(const unsigned int index, const std::vector<double> &tractions) const
{
  const Cell &cell = cells[index];
  return cell.remainder + cell.h * cell.h * cell.element->stress(cell.data, tractions).energy;
}

Tensor<2, 2> MacroStresses::value(const unsigned int index, const std::vector<double> &tractions,
                                  const Point<2> &reference) const
{
  const Cell &cell = cells[index];
  const CellMap<2> map = map_of<2>(patches.cells()[index].iterator);
  return cell.element->value(cell.element->stress(cell.data, tractions),
                             Point<2>((map.point(reference) - map.vertices()[0]) / cell.h));
}

double MacroStresses::missed_force(const unsigned int cell) const
{
  return cells[cell].missed_force;
}
} // namespace hpvi
