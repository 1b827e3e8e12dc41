// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/memo_table.h>
#include <hpvi/base/text.h>
#include <hpvi/bound/cell_constants.h>
#include <hpvi/bound/corner_stress.h>
#include <hpvi/bound/row_stresses.h>
#include <hpvi/plane/element_matrices.h>
#include <hpvi/plane/initial_stress.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

namespace hpvi
{
using namespace dealii;

namespace
{
/** psi of vertex v, its slopes by the reference coordinates in [0,1]. */
struct Bilinear
{
  Bilinear(const unsigned int v, const Point<2> &reference)
  {
    const double x = v % 2 ? reference[0] : 1 - reference[0],
                 y = v / 2 ? reference[1] : 1 - reference[1];
    value = x * y;
    slope = Tensor<1, 2>({v % 2 ? y : -y, v / 2 ? x : -x});
  }

  double value;
  Tensor<1, 2> slope;
};

/** Points per direction for energies: all that sees the map converges as the stiffness does. */
unsigned int energy_points(const CellMap<2> &map, const unsigned int k)
{
  return map.is_affine() ? k + 2 : map.is_curved() ? k + 6 : stiffness_points(map, k + 2);
}

/**
 * Corners of the body that are corners of one cell, by bits: two edges prescribe shears there that may contradict each other, and stresses
 * may be singular.
 */
unsigned int outer_corners(const DoFHandler<2>::active_cell_iterator &cell)
{
  unsigned int result = 0;
  for (unsigned int corner = 0; corner < 4; ++corner)
    if (cell->at_boundary(corner % 2) && cell->at_boundary(2 + corner / 2))
      result |= 1u << corner;
  return result;
}

/** h: its square is a quarter of the area of the quadrilateral. */
double size_of(const CellMap<2> &map)
{
  const CellMap<2>::Vertices &v = map.vertices();
  const Tensor<1, 2> a = v[3] - v[0], b = v[2] - v[1];
  return std::sqrt(std::abs(a[0] * b[1] - a[1] * b[0]) / 8);
}

/** A rotation about the centre of a cell. */
Tensor<1, 2> rotation(const Tensor<1, 2> &x)
{
  return Tensor<1, 2>({-x[1], x[0]});
}

/**
 * Along a curved edge psi z, z a rotation, is of one degree more than V_N: what the interpolation I there lacks of it, E = psi z - I psi z, for
 * the four psi of a cell. I has the nodes of the cell, on edges those of the displacement, of the whole where an edge is half of another.
 */
class BeyondSpace
{
public:
  BeyondSpace(const Solution<2> &solution, const VertexPatches::Cell &cell, const CellMap<2> &map)
      : map(map), centre(map.point({0.5, 0.5})),
        degree(solution.displacement_space.degrees()[cell.iterator->active_cell_index()])
  {
    const auto &points =
        solution.tables.elements(degree)[degree - 1].base_element(0).get_unit_support_points();
    for (unsigned int v = 0; v < 4; ++v)
    {
      for (const Point<2> &node : points)
        nodal[v].push_back(at(v, node));
      for (const unsigned int face : cell.iterator->face_indices())
        if (map.blends()[face])
          interpolate(solution, cell, face, v, points);
    }
    for (const auto &[vertex, node, value] : on_edges)
      nodal[vertex][node] = value;
  }

  /** E at a point of a table of the cell's degree. */
  Tensor<1, 2> value(const unsigned int v, const ShapeTable<2> &table, const unsigned int q) const
  {
    Tensor<1, 2> result = at(v, table.points[q]);
    for (unsigned int i = 0; i < nodal[v].size(); ++i)
      result -= table.values(q, i) * nodal[v][i];
    return result;
  }

  /** The slopes of E by reference coordinates that strains see, at a point of a table of the cell's degree: those of z are antisymmetric. */
  Tensor<2, 2> slopes(const unsigned int v, const ShapeTable<2> &table, const unsigned int q) const
  {
    const Tensor<1, 2> z = rotation(map.point(table.points[q]) - centre),
                       slope = Bilinear(v, table.points[q]).slope;
    Tensor<2, 2> result = outer_product(z, slope);
    for (unsigned int i = 0; i < nodal[v].size(); ++i)
      for (unsigned int d = 0; d < 2; ++d)
        for (unsigned int c = 0; c < 2; ++c)
          result[c][d] -= nodal[v][i][c] * table.derivatives(q * table.rows_per_point + d, i);
    return result;
  }

private:
  Tensor<1, 2> at(const unsigned int v, const Point<2> &reference) const
  {
    return Bilinear(v, reference).value * rotation(map.point(reference) - centre);
  }

  /** Nodes on an edge have what the polynomial of the edge's degree has there. */
  void interpolate(const Solution<2> &solution, const VertexPatches::Cell &cell,
                   const unsigned int face, const unsigned int v,
                   const std::vector<Point<2>> &points)
  {
    const unsigned int p = map.blends()[face].degree();
    const auto &iterator = cell.iterator;
    const bool is_half = !iterator->at_boundary(face) && iterator->neighbor_is_coarser(face);
    if (p == degree && !is_half)
      return;
    const auto psi = [&](const double s)
    { return Bilinear(v, point_on_face<2>(face, Point<1>(s))).value; };
    // Of the whole edge, whose half this is: x, and psi beyond this half.
    const unsigned int part = is_half ? iterator->neighbor_of_coarser_neighbor(face).second : 0;
    const double begin = is_half ? -double(part) : 0., length = is_half ? 2. : 1.;
    const QGaussLobatto<1> &rule = solution.tables.gauss_lobatto(p + 1);
    std::vector<Tensor<1, 2>> values;
    const auto whole = [&](const double s)
    {
      if (!is_half)
        return map.point(point_on_face<2>(face, Point<1>(s)));
      const CellMap<2> other = map_of<2>(iterator->neighbor(face));
      return other.point(point_on_face<2>(iterator->neighbor_of_coarser_neighbor(face).first,
                                          Point<1>((s - begin) / length)));
    };
    for (unsigned int i = 0; i <= p; ++i)
    {
      const double s = begin + length * rule.point(i)[0];
      const double value = psi(0.) + s * (psi(1.) - psi(0.));
      values.push_back(value * rotation(whole(s) - centre));
    }
    const auto basis = Polynomials::generate_complete_Lagrange_basis(rule.get_points());
    const auto interpolated = [&](const double s)
    {
      Tensor<1, 2> result;
      for (unsigned int i = 0; i <= p; ++i)
        result += basis[i].value((s - begin) / length) * values[i];
      return result;
    };
    // The vertex in the middle of an edge moves, and takes the straight edge with it that begins there, whatever its degree.
    for (const unsigned int end : {0, 1})
    {
      const unsigned int vertex = GeometryInfo<2>::face_to_cell_vertices(face, end);
      const Tensor<1, 2> change =
          interpolated(end) - at(v, GeometryInfo<2>::unit_cell_vertex(vertex));
      for (unsigned int n = 0; n < points.size(); ++n)
        nodal[v][n] += Bilinear(vertex, points[n]).value * change;
    }
    for (unsigned int n = 0; n < points.size(); ++n)
      if (points[n][face / 2] == double(face % 2))
        on_edges.push_back({v, n, interpolated(points[n][1 - face / 2])});
  }

  /** A node of psi of a vertex on a curved edge, and what it has there. */
  struct EdgeNode
  {
    unsigned int vertex, node;
    Tensor<1, 2> value;
  };

  const CellMap<2> &map;
  const Point<2> centre;
  const unsigned int degree;
  std::array<std::vector<Tensor<1, 2>>, 4> nodal;
  std::vector<EdgeNode> on_edges;
};

/** A field of force 0 and moment 1 about the centre in units of h: the rotation less its mean, by its Legendre coefficients. */
std::vector<double> unit_moment(const RowElement &element, const CellMap<2> &map, const double h,
                                const unsigned int n_modes)
{
  const unsigned int n = element.table.k + 1;
  std::vector<double> result(2 * n * n);
  const Point<2> centre = map.point({0.5, 0.5});
  for (unsigned int q = 0; q < element.table.points.size(); ++q)
  {
    const Tensor<1, 2> z = rotation((map.point(element.table.points[q]) - centre) / h);
    const auto L_x = legendre::values(n_modes, 2 * element.table.points[q][0] - 1),
               L_y = legendre::values(n_modes, 2 * element.table.points[q][1] - 1);
    for (unsigned int row = 0; row < 2; ++row)
      for (unsigned int i = 0; i < n_modes; ++i)
        for (unsigned int j = i == 0 ? 1 : 0; j < n_modes; ++j)
          result[(row * n + i) * n + j] += element.table.weights[q] * z[row] * L_x[i] * L_y[j];
  }
  double square = 0;
  for (const double value : result)
    square += value * value;
  for (double &value : result)
    value /= square;
  return result;
}
} // namespace

std::string cut_inside_cell(const Solution<2> &solution)
{
  for (const auto &cell : solution.displacement_space.dof_handler().active_cell_iterators())
    if (const GivenData given = given_data(solution.scene, cell, inside, Datum::initial_strain);
        given.varies() &&
        solution.spaces->loads
                ->initial_strain(cell,
                                 solution.displacement_space.degrees()[cell->active_cell_index()])
                .n_gauss == 0)
      return given.name + " is cut inside the cell at " + to_string(cell->center()) +
             ", and a stress in cells that are no parallelograms does not know its pieces";
  return {};
}

RowStresses::RowStresses(const Solution<2> &solution, const VertexPatches &patches,
                         const BoundaryTractions &boundary, EquilibrationCache &cache)
    : solution(solution), patches(patches), boundary(boundary), cache(cache),
      cells(patches.cells().size())
{
  std::vector<EquilibrationCache::Signature> keys(cells.size());
  std::vector<unsigned int> degrees(cells.size()), corners(cells.size()), points(cells.size());
  const auto set_key = [&](const unsigned int cell)
  {
    const RowShape shape = shape_of(cell);
    for (const unsigned int edge : patches.cells()[cell].edges)
      degrees[cell] = std::max(degrees[cell], patches.edges()[edge].degree - 1);
    const auto add = [&](const Tensor<1, 2> &x)
    {
      for (unsigned int d = 0; d < 2; ++d)
        keys[cell].push_back(std::lround(x[d] / shape.h * 1e11));
    };
    corners[cell] = outer_corners(patches.cells()[cell].iterator);
    points[cell] = energy_points(shape.map, degrees[cell]);
    if (solution.scene.has_initial_strain()) // which is no polynomial of the cell's degree
      points[cell] = std::max(points[cell],
                              solution.spaces->loads
                                      ->initial_strain(patches.cells()[cell].iterator,
                                                       solution.displacement_space.degrees()[cell])
                                      .most_points +
                                  2);
    keys[cell] = {degrees[cell], shape.material, corners[cell], points[cell]};
    for (const double density : shape.densities)
      keys[cell].push_back(std::lround(density / shape.h * 1e11));
    for (const Point<2> &v : shape.map.vertices())
      add(v - shape.map.vertices()[0]);
    for (unsigned int face = 0; shape.map.is_curved() && face < 4; ++face)
      if (const EdgeBlend &blend = shape.map.blends()[face])
      {
        keys[cell].push_back(4 * blend.degree() + face);
        for (unsigned int i = 1; i <= blend.degree(); ++i)
          add(blend(i / (blend.degree() + 1.))[0]);
      }
  };
  parallel_for_each(cells.size(), 8, set_key);
  using Kept = decltype(cache.row_elements)::mapped_type;
  const auto elements = ordered_values(
      cache.row_elements, keys,
      [&](const unsigned int cell)
      {
        const RowShape shape = shape_of(cell);
        return Kept{std::make_unique<const RowElement>(
                        cache.row_table(degrees[cell], points[cell], corners[cell]), shape),
                    false};
      });
  for (unsigned int cell = 0; cell < cells.size(); ++cell)
  {
    elements[cell]->is_used = true;
    cells[cell].element = elements[cell]->value.get();
  }
  parallel_for_each(cells.size(), 4, [&](const unsigned int cell) { set_cell(cell); });
}

RowShape RowStresses::shape_of(const unsigned int index) const
{
  const VertexPatches::Cell &cell = patches.cells()[index];
  const Material &material = solution.scene.material_of(cell.iterator);
  RowShape result{cell.iterator->material_id(), &material, map_of<2>(cell.iterator), 0., {}, 0.};
  result.h = size_of(result.map);
  for (unsigned int face = 0; face < 4; ++face)
    result.densities[face] =
        patches.edges()[cell.edges[face]].length / (cell.parts[face] < 2 ? 4 : 2);
  result.antisymmetry = CellConstants(result.map).antisymmetry(material);
  return result;
}

/** sigma(u_N) at points, without initial strains. */
std::vector<SymmetricTensor<2, 2>> RowStresses::sigma(const unsigned int index,
                                                      const ShapeTable<2> &table) const
{
  const auto &iterator = patches.cells()[index].iterator;
  const CellMap<2> map = map_of<2>(iterator);
  const std::vector<double> derivatives = evaluate(table.derivatives, solution.coefficients(index));
  const HookesLaw<2> law(solution.scene.material_of(iterator));
  std::vector<SymmetricTensor<2, 2>> result;
  for (unsigned int q = 0; q < table.points.size(); ++q)
    result.push_back(law.stress(physical_gradient<2>(derivatives, q * table.rows_per_point,
                                                     table.derivatives.m(),
                                                     invert(map.jacobian(table.points[q])))));
  return result;
}

/** `det DF (sigma grad psi)` by the points of the stiffness, where the discrete equations know sigma. */
void RowStresses::add_stress(const unsigned int index, OfVertices &result) const
{
  const Cell &cell = cells[index];
  const auto &iterator = patches.cells()[index].iterator;
  const CellMap<2> map = map_of<2>(iterator);
  const unsigned int p = solution.displacement_space.degrees()[index], k = cell.element->table.k,
                     n_gauss = map.is_curved() ? stiffness_points(map, p)
                                               : std::max(stiffness_points(map, k), k + 1),
                     n_modes = std::min(k + 1, n_gauss);
  const ShapeTable<2> &table = solution.tables.gradients(p, n_gauss);
  const std::vector<SymmetricTensor<2, 2>> stress = sigma(index, table);
  const FullMatrix<double> &project = cache.legendre.projection(n_modes, n_gauss);
  std::vector<Tensor<2, 2>>
      fluxes; // det DF sigma DF^-T in units of h: sigma grad psi from reference slopes
  for (unsigned int q = 0; q < table.points.size(); ++q)
  {
    const Tensor<2, 2> J = map.jacobian(table.points[q]);
    fluxes.push_back(determinant(J) / (4 * cell.h) * Tensor<2, 2>(stress[q]) *
                     transpose(invert(J)));
  }
  FullMatrix<double> values(n_gauss, n_gauss), half(n_modes, n_gauss), modes(n_modes, n_modes);
  for (unsigned int v = 0; v < 4; ++v)
    for (unsigned int row = 0; row < 2; ++row)
    {
      for (unsigned int b = 0; b < n_gauss; ++b)
        for (unsigned int a = 0; a < n_gauss; ++a)
          values(a, b) =
              fluxes[b * n_gauss + a][row] * Bilinear(v, table.points[b * n_gauss + a]).slope;
      project.mmult(half, values);
      half.mTmult(modes, project);
      for (unsigned int i = 0; i < n_modes; ++i)
        for (unsigned int j = 0; j < n_modes; ++j)
          result.divergence[v][(row * (k + 1) + i) * (k + 1) + j] += modes(i, j);
    }
  if (!map.is_curved())
    return;
  const BeyondSpace beyond(solution, patches.cells()[index], map);
  for (unsigned int v = 0; v < 4; ++v)
    for (unsigned int q = 0; q < table.points.size(); ++q)
      result.moment[v] -=
          table.weights[q] * 4 * cell.h * scalar_product(fluxes[q], beyond.slopes(v, table, q));
}

/** Body forces and initial strains by the points of their rules, where the discrete equations know them. */
void RowStresses::add_loads(const unsigned int index, OfVertices &result)
{
  Cell &cell = cells[index];
  const Scene<2> &scene = solution.scene;
  const auto &iterator = patches.cells()[index].iterator;
  const CellMap<2> map = map_of<2>(iterator);
  const unsigned int p = solution.displacement_space.degrees()[index],
                     n = cell.element->table.k + 1;
  const HookesLaw<2> law(scene.material_of(iterator));
  std::optional<BeyondSpace> beyond;
  if (map.is_curved())
    beyond.emplace(solution, patches.cells()[index], map);
  const auto add = [&](const LoadRule<2> &rule, const bool is_force)
  {
    const Quadrature<2> &points = rule.quadrature;
    const unsigned int n_modes = std::min(
        n, rule.most_points); // no more than its points tell, whatever a neighbour asks for
    const ShapeTable<2> table =
        tabulate<2>(beyond ? p : 1, points.get_points(), points.get_weights(), false);
    for (unsigned int q = 0; q < points.size(); ++q)
    {
      const Tensor<2, 2> J = map.jacobian(points.point(q));
      const Point<2> x = map.point(points.point(q));
      const auto L_x = legendre::values(n, 2 * points.point(q)[0] - 1),
                 L_y = legendre::values(n, 2 * points.point(q)[1] - 1);
      const Tensor<1, 2> F =
          is_force ? load_at<2>(scene.body_force_in(iterator), x) : Tensor<1, 2>();
      const Tensor<2, 2> flux =
          is_force ? Tensor<2, 2>()
                   : Tensor<2, 2>(law.stress(scene.initial_strain_in(iterator, x))) *
                         transpose(invert(J));
      for (unsigned int v = 0; v < 4; ++v)
      {
        const Bilinear psi(v, points.point(q));
        const Tensor<1, 2> d =
            -points.weight(q) * determinant(J) / cell.h * (psi.value * F + flux * psi.slope);
        for (unsigned int row = 0; row < 2; ++row)
          for (unsigned int i = 0; i < n_modes; ++i)
            for (unsigned int j = 0; j < n_modes; ++j)
            {
              result.divergence[v][(row * n + i) * n + j] += d[row] * L_x[i] * L_y[j];
              if (is_force)
                cell.divergence[(row * n + i) * n + j] += d[row] * L_x[i] * L_y[j];
            }
        if (beyond)
          result.moment[v] +=
              points.weight(q) * determinant(J) *
              (F * beyond->value(v, table, q) + scalar_product(flux, beyond->slopes(v, table, q)));
      }
    }
  };
  if (scene.has_body_force())
    add(solution.spaces->loads->body_force(iterator, p), true);
  if (scene.has_initial_strain())
    add(solution.spaces->loads->initial_strain(iterator, p), false);
  for (unsigned int face = 0; beyond && face < 4; ++face)
    if (map.blends()[face] && iterator->at_boundary(face))
    {
      std::map<double, ShapeTable<2>> at; // of all four psi
      for (unsigned int v = 0; v < 4; ++v)
        result.moment[v] += boundary.work_of_loads(
            patches.cells()[index].edges[face],
            [&](const double s)
            {
              auto found = at.find(s);
              if (found == at.end())
                found = at.emplace(
                              s, tabulate<2>(p, {point_on_face<2>(face, Point<1>(s))}, {1.}, false))
                            .first;
              return beyond->value(v, found->second, 0);
            });
    }
}

void RowStresses::set_cell(const unsigned int index)
{
  Cell &cell = cells[index];
  const RowElement &element = *cell.element;
  const unsigned int n = element.table.k + 1;
  const CellMap<2> map = map_of<2>(patches.cells()[index].iterator);
  cell.h = size_of(map);
  cell.divergence.assign(2 * n * n, 0.);
  OfVertices of_vertices;
  for (auto &divergence : of_vertices.divergence)
    divergence.assign(2 * n * n, 0.);
  add_stress(index, of_vertices);
  add_loads(index, of_vertices);
  const RowValues &values = element.values;
  const std::vector<SymmetricTensor<2, 2>> stress = stress_at_points(index);
  std::vector<double> moment;
  if (map.is_curved())
    moment = unit_moment(
        element, map, cell.h,
        std::min(n, stiffness_points(map, solution.displacement_space.degrees()[index])));
  std::array<std::vector<double>, 4> gradients;
  std::array<std::array<double, 3>, 4> defects;
  for (unsigned int v = 0; v < 4; ++v)
  {
    std::vector<double> &divergence = of_vertices.divergence[v];
    for (unsigned int i = 0; i < moment.size(); ++i)
      divergence[i] += of_vertices.moment[v] / (cell.h * cell.h) * moment[i];
    RowFields fields(element.table);
    for (unsigned int row = 0; row < 2; ++row)
      std::copy(&divergence[row * n * n], &divergence[row * n * n] + n * n,
                &fields.fields[row * element.table.n_fields() + element.table.of_divergence()]);
    RowValues::Stress difference(element.table);
    values.add(fields, difference);
    for (unsigned int q = 0; q < stress.size(); ++q)
      values.subtract(q, stress[q], Bilinear(v, element.table.points[q]).value, difference);
    gradients[v] = element.reduced(values.derivatives(difference));
    defects[v] = element.moments(divergence.data());
  }
  for (const VertexPatches::Hat &hat : patches.cells()[index].hats)
  {
    for (unsigned int i = 0; i < gradients[0].size(); ++i)
    {
      double sum = 0;
      for (unsigned int v = 0; v < 4; ++v)
        sum += hat.values[v] * gradients[v][i];
      cell.gradients.push_back(sum);
    }
    for (unsigned int i = 0; i < RowElement::n_conditions; ++i)
    {
      double sum = 0;
      for (unsigned int v = 0; v < 4; ++v)
        sum -= hat.values[v] * defects[v][i];
      cell.defects.push_back(sum);
    }
  }
  set_missed_force(index);
}

/** sigma(u_N) at the points of the element, less the initial stress there. */
std::vector<SymmetricTensor<2, 2>> RowStresses::stress_at_points(const unsigned int index) const
{
  const RowTable &table = cells[index].element->table;
  const unsigned int p = solution.displacement_space.degrees()[index];
  std::vector<SymmetricTensor<2, 2>> result =
      sigma(index, solution.tables.gradients(p, table.n_gauss));
  if (!solution.scene.has_initial_strain())
    return result;
  const auto &iterator = patches.cells()[index].iterator;
  const CellMap<2> map = map_of<2>(iterator);
  const HookesLaw<2> law(solution.scene.material_of(iterator));
  for (unsigned int q = 0; q < result.size(); ++q)
    result[q] -= law.stress(solution.scene.initial_strain_in(iterator, map.point(table.points[q])));
  return result;
}

void RowStresses::set_missed_force(const unsigned int index)
{
  if (!solution.scene.has_body_force())
    return;
  Cell &cell = cells[index];
  const auto &iterator = patches.cells()[index].iterator;
  const CellMap<2> map = map_of<2>(iterator);
  const unsigned int n = cell.element->table.k + 1;
  const LoadRule<2> rule = solution.spaces->loads->body_force(iterator, n + 1);
  double sum = 0;
  for (unsigned int q = 0; q < rule.quadrature.size(); ++q)
  {
    const Point<2> &reference = rule.quadrature.point(q);
    const double det = determinant(map.jacobian(reference));
    const auto L_x = legendre::values(n, 2 * reference[0] - 1),
               L_y = legendre::values(n, 2 * reference[1] - 1);
    Tensor<1, 2> missed = load_at<2>(solution.scene.body_force_in(iterator), map.point(reference));
    for (unsigned int row = 0; row < 2; ++row)
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          missed[row] +=
              4 * cell.h / det * cell.divergence[(row * n + i) * n + j] * L_x[i] * L_y[j];
    sum += rule.quadrature.weight(q) * det * missed.norm_square();
  }
  cell.missed_force = std::sqrt(sum);
}

PatchCell RowStresses::patch_cell(const unsigned int index, const unsigned int hat) const
{
  const Cell &cell = cells[index];
  const TractionEnergy energy = cell.element->energy();
  return {energy, cell.h * cell.h, &cell.gradients[hat * energy.n_edges()],
          &cell.defects[hat * energy.n_conditions], &patches.cells()[index]};
}

/** s - sigma(u_N), and s by its fields. */
RowValues::Stress RowStresses::residual(const unsigned int index,
                                        const std::vector<double> &tractions,
                                        RowFields &fields) const
{
  const Cell &cell = cells[index];
  const RowTable &table = cell.element->table;
  const RowValues &values = cell.element->values;
  const unsigned int n = table.k + 1;
  for (unsigned int row = 0; row < 2; ++row)
  {
    double *const own = &fields.fields[row * table.n_fields()];
    for (unsigned int face = 0; face < 4; ++face)
      for (unsigned int i = 0; i < n; ++i)
        own[table.of_face(face) + i] =
            cell.element->scale[face] * tractions[(2 * face + row) * n + i];
    std::copy(&cell.divergence[row * n * n], &cell.divergence[row * n * n] + n * n,
              own + table.of_divergence());
  }
  RowValues::Stress result(table);
  values.add(fields, result);
  const std::vector<SymmetricTensor<2, 2>> stress = stress_at_points(index);
  for (unsigned int q = 0; q < stress.size(); ++q)
    values.subtract(q, stress[q], 1., result);
  const RowFields change = cell.element->best_bubbles(values.derivatives(result));
  values.add(change, result);
  for (unsigned int i = 0; i < fields.fields.size(); ++i)
    fields.fields[i] += change.fields[i];
  fields.corners = change.corners;
  return result;
}

RowStresses::Distance RowStresses::distance(const unsigned int index,
                                            const std::vector<double> &tractions) const
{
  const Cell &cell = cells[index];
  const RowValues &values = cell.element->values;
  RowFields fields(cell.element->table);
  const RowValues::Stress missed = residual(index, tractions, fields);
  return {cell.h * cell.h * values.square(missed, false),
          cell.h * std::sqrt(values.square(missed, true) / RowValues::theta)};
}

Tensor<2, 2> RowStresses::value(const unsigned int index, const std::vector<double> &tractions,
                                const Point<2> &reference) const
{
  const RowTable &table = cells[index].element->table;
  const RowShape shape = shape_of(index);
  RowFields fields(table);
  residual(index, tractions, fields);
  const std::array<std::vector<double>, 2> at = table.at(reference);
  Tensor<2, 2> flux;
  for (unsigned int row = 0; row < 2; ++row)
    for (unsigned int d = 0; d < 2; ++d)
      flux[row][d] = std::inner_product(at[d].begin(), at[d].end(),
                                        &fields.fields[row * table.n_fields()], 0.);
  for (unsigned int c = 0; c < table.corners.size(); ++c)
  {
    const auto [xx, yy, xy] =
        corner_stress(table.k + 1, table.corners[c], 2 * reference[0] - 1, 2 * reference[1] - 1);
    Tensor<2, 2> S;
    S[0][0] = xx;
    S[1][1] = yy;
    S[0][1] = S[1][0] = xy;
    flux += fields.corners[c] * corner_frame(shape, table.corners[c]) * S;
  }
  const Tensor<2, 2> J = shape.map.jacobian(reference) / (2 * shape.h);
  return flux * transpose(J) / determinant(J);
}

double RowStresses::missed_force(const unsigned int cell) const
{
  return cells[cell].missed_force;
}
} // namespace hpvi
