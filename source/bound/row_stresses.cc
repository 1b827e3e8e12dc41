// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/memo_table.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/base/text.h>
#include <hpvi/bound/cell_constants.h>
#include <hpvi/bound/corner_stress.h>
#include <hpvi/bound/row_stresses.h>
#include <hpvi/plane/element_matrices.h>
#include <hpvi/plane/initial_stress.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

namespace hpvi
{
using namespace dealii;

namespace
{
/** psi of vertex v of a cell, its slopes by the reference coordinates in [0,1]. */
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

/** Around the axis of a body of revolution. */
double initial_strain_around(const Scene<2> &scene, const DoFHandler<2>::active_cell_iterator &cell,
                             const Point<2> &x)
{
  return scene.is_axisymmetric() ? initial_strain_across<2>(scene, cell, x) : 0.;
}

/** A rotation about the centre of a cell. */
Tensor<1, 2> rotation(const Tensor<1, 2> &x)
{
  return Tensor<1, 2>({-x[1], x[0]});
}

} // namespace

/**
 * Along a curved edge psi z, z a rotation, is of one degree more than V_N: what the interpolation I there lacks of it, E = psi z - I psi z, for
 * the four psi of a cell. I has the nodes of the cell, on edges those of the displacement, of the whole where an edge is half of another.
 */
class RowStresses::BeyondSpace
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

namespace
{
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
  const LoadRules<2> &rules = *solution.spaces->loads;
  for (const auto &cell : solution.displacement_space.dof_handler().active_cell_iterators())
    for (const Datum datum : {Datum::initial_strain, Datum::load})
    {
      if (datum == Datum::load && !solution.scene.is_axisymmetric())
        continue;
      const GivenData given = given_data(solution.scene, cell, inside, datum);
      const unsigned int p = solution.displacement_space.degrees()[cell->active_cell_index()];
      if (given.varies() &&
          (datum == Datum::load ? rules.body_force(cell, p) : rules.initial_strain(cell, p))
                  .n_gauss == 0)
        return given.name + " is cut inside the cell at " + to_string(cell->center()) +
               ", and a stress by rows does not know its pieces";
    }
  return {};
}

RowStresses::RowStresses(const Solution<2> &solution, const VertexPatches &patches,
                         const BoundaryTractions &boundary, const JointTractions *const joints,
                         EquilibrationCache &cache)
    : solution(solution), patches(patches), boundary(boundary), joints(joints), cache(cache),
      cells(patches.cells().size())
{
  std::vector<Part *> parts;
  for (unsigned int cell = 0; cell < cells.size(); ++cell)
    cut(cell);
  for (Cell &cell : cells)
  {
    for (Part &part : cell.parts)
      parts.push_back(&part);
    if (cell.whole)
      parts.push_back(&*cell.whole);
  }
  std::vector<EquilibrationCache::Signature> keys(parts.size());
  parallel_for_each(parts.size(), 8, [&](const unsigned int k) { keys[k] = key(*parts[k]); });
  using Kept = decltype(cache.row_elements)::mapped_type;
  const auto elements =
      ordered_values(cache.row_elements, keys,
                     [&](const unsigned int k)
                     {
                       const EquilibrationCache::Signature &of = keys[k];
                       return Kept{std::make_unique<const RowElement>(
                                       cache.row_table(of[0], of[3], of[2]), shape_of(*parts[k])),
                                   false};
                     });
  for (unsigned int k = 0; k < parts.size(); ++k)
  {
    elements[k]->is_used = true;
    parts[k]->element = elements[k]->value.get();
  }
  join_parts();
  parallel_for_each(cells.size(), 4, [&](const unsigned int cell) { set_cell(cell); });
}

namespace
{
/** The map of a box of a cell: a blend of its edges, as that of the cell is, with polynomials of the same degrees. */
CellMap<2> map_of_part(const CellMap<2> &map, const BoundingBox<2> &box)
{
  CellMap<2>::Vertices corners;
  for (const unsigned int v : GeometryInfo<2>::vertex_indices())
    corners[v] = map.point(box.unit_to_real(GeometryInfo<2>::unit_cell_vertex(v)));
  if (!map.is_curved())
    return CellMap<2>(corners);
  const auto blends = std::make_shared<EdgeBlends>();
  for (unsigned int face = 0; face < 4; ++face)
  {
    unsigned int degree = 0;
    for (const EdgeBlend &blend : {map.blends()[face], map.blends()[face ^ 1]})
      degree = std::max(degree, blend ? blend.degree() : 0);
    if (degree > 1)
      (*blends)[face] = EdgeBlend(
          CurvePiece(),
          [&](const double s)
          { return map.point(box.unit_to_real(point_on_face<2>(face, Point<1>(s)))); },
          corners[GeometryInfo<2>::face_to_cell_vertices(face, 0)],
          corners[GeometryInfo<2>::face_to_cell_vertices(face, 1)], degree);
  }
  return CellMap<2>(corners, blends);
}
} // namespace

bool RowStresses::is_whole(const Part &part)
{
  return part.box.side_length(0) == 1. && part.box.side_length(1) == 1.;
}

/** Does Lemma 4 of doc/bound.md add one? No motion of a body of revolution turns it in the plane. */
bool RowStresses::has_moment(const Part &part) const
{
  return part.map.is_curved() && is_whole(part) && !solution.scene.is_axisymmetric();
}

/** Where edges of the other body end, and so what that exerts may jump. */
void RowStresses::cut(const unsigned int index)
{
  const auto &iterator = patches.cells()[index].iterator;
  const CellMap<2> map = map_of<2>(iterator);
  std::array<std::vector<double>, 2> cuts{{{0., 1.}, {0., 1.}}};
  for (unsigned int face = 0; face < 4; ++face)
    if (const JointEdge *const edge = cut_edge(index, face))
      for (const JointPiece &piece : edge->pieces)
        for (const double end : {piece.begin, piece.end})
        {
          std::vector<double> &along = cuts[1 - face / 2];
          if (std::none_of(along.begin(), along.end(),
                           [&](const double other) { return std::abs(end - other) < 1e-9; }))
            along.push_back(end);
        }
  for (std::vector<double> &along : cuts)
    std::sort(along.begin(), along.end());
  const BoundingBox<2> unit(std::pair<Point<2>, Point<2>>({0., 0.}, {1., 1.}));
  for (unsigned int y = 0; y + 1 < cuts[1].size(); ++y)
    for (unsigned int x = 0; x + 1 < cuts[0].size(); ++x)
    {
      const BoundingBox<2> box(std::pair<Point<2>, Point<2>>({cuts[0][x], cuts[1][y]},
                                                             {cuts[0][x + 1], cuts[1][y + 1]}));
      Part part{index, box, map, nullptr, 0., {}, 0.};
      if (cuts[0].size() > 2 || cuts[1].size() > 2)
      {
        part.map = map_of_part(map, box);
        if (map.is_curved())
          cells[index].whole = Part{index, unit, map, nullptr, size_of(map), {}, 0.};
      }
      part.h = size_of(part.map);
      cells[index].parts.push_back(part);
    }
  cells[index].n_xi = cuts[0].size() - 1;
}

/** Has it a part of a face of the cell? */
bool RowStresses::is_on(const Part &part, const unsigned int face) const
{
  return part.box.vertex(face % 2 ? 3 : 0)[face / 2] == double(face % 2);
}

/** The edge of a face on which tau has pieces, or null. */
const JointEdge *RowStresses::cut_edge(const unsigned int cell, const unsigned int face) const
{
  const JointEdge *const edge = joints ? joints->edge(cell, face) : nullptr;
  return edge && edge->is_cut ? edge : nullptr;
}

/** Degree, material, corners and points; then what the map is. */
EquilibrationCache::Signature RowStresses::key(const Part &part) const
{
  const VertexPatches::Cell &cell = patches.cells()[part.cell];
  const RowShape shape = shape_of(part);
  unsigned int degree = 0;
  for (const unsigned int edge : cell.edges)
    degree = std::max(degree, patches.edges()[edge].degree - 1);
  unsigned int points = energy_points(shape.map, degree), corners = 0;
  if (shape.is_axisymmetric())
    points = std::max(points, stiffness_points(solution.scene, shape.map, degree + 2));
  if (shape.is_axisymmetric() && solution.scene.has_body_force())
    points = std::max(points, solution.spaces->loads
                                      ->body_force(cell.iterator,
                                                   solution.displacement_space.degrees()[part.cell])
                                      .most_points +
                                  2);
  if (solution.scene.has_initial_strain()) // which is no polynomial of the cell's degree
    points =
        std::max(points, solution.spaces->loads
                                 ->initial_strain(cell.iterator,
                                                  solution.displacement_space.degrees()[part.cell])
                                 .most_points +
                             2);
  // None knows to vanish on an axis.
  for (unsigned int corner = 0; corner < 4 && !shape.face_on_axis(); ++corner)
    if ((outer_corners(cell.iterator) & (1u << corner)) &&
        part.box.unit_to_real(GeometryInfo<2>::unit_cell_vertex(corner)) ==
            GeometryInfo<2>::unit_cell_vertex(corner))
      corners |= 1u << corner;
  EquilibrationCache::Signature result = {degree, shape.material, corners, points,
                                          std::lround(std::log2(shape.antisymmetry) * 1e9)};
  const auto add = [&](const Tensor<1, 2> &x)
  {
    for (unsigned int d = 0; d < 2; ++d)
      result.push_back(std::lround(x[d] / shape.h * 1e11));
  };
  for (const double density : shape.densities)
    result.push_back(std::lround(density / shape.h * 1e11));
  if (shape.is_axisymmetric())
  {
    result.push_back(shape.has_slices());
    result.push_back(std::lround(std::log2(shape.h) * 1e9));
    result.push_back(std::lround(shape.map.vertices()[0][0] / shape.h * 1e11));
  }
  for (const Point<2> &v : shape.map.vertices())
    add(v - shape.map.vertices()[0]);
  for (unsigned int face = 0; shape.map.is_curved() && face < 4; ++face)
    if (const EdgeBlend &blend = shape.map.blends()[face])
    {
      result.push_back(4 * blend.degree() + face);
      for (unsigned int i = 1; i <= blend.degree(); ++i)
        add(blend(i / (blend.degree() + 1.))[0]);
    }
  return result;
}

/** Constants are those of the whole cell: what has mean zero in each part has it in the cell. */
RowShape RowStresses::shape_of(const Part &part) const
{
  const VertexPatches::Cell &cell = patches.cells()[part.cell];
  const Material &material = solution.scene.material_of(cell.iterator);
  RowShape result{cell.iterator->material_id(), &material, part.map, part.h, {}, 0.};
  for (unsigned int face = 0; face < 4; ++face)
  {
    const double side = part.box.side_length(1 - face / 2);
    result.densities[face] =
        is_on(part, face)
            ? side * patches.edges()[cell.edges[face]].length / (cell.parts[face] < 2 ? 4 : 2)
            : size_of(map_of<2>(cell.iterator)) / 2; // between parts
  }
  const CellMap<2> whole = map_of<2>(cell.iterator);
  result.antisymmetry = CellConstants(whole).antisymmetry(material);
  result.is_in_cell_on_axis = result.is_axisymmetric() && axis_face(whole);
  return result;
}

/** psi at a point of a part, its slopes by the part's reference coordinates. */
RowStresses::Hat RowStresses::hat(const Part &part, const unsigned int v, const Point<2> &at) const
{
  const Bilinear psi(v, part.box.unit_to_real(at));
  return {psi.value, Tensor<1, 2>({psi.slope[0] * part.box.side_length(0),
                                   psi.slope[1] * part.box.side_length(1)})};
}

/** Of the cell's shape functions at points of a part. */
ShapeTable<2> RowStresses::table_in(const Part &part, const Quadrature<2> &rule) const
{
  std::vector<Point<2>> points;
  for (const Point<2> &point : rule.get_points())
    points.push_back(part.box.unit_to_real(point));
  return tabulate<2>(solution.displacement_space.degrees()[part.cell], points, rule.get_weights(),
                     false);
}

/** sigma(u_N) at points of a part, without initial strains. */
std::vector<RowStresses::PointStress> RowStresses::sigma(const Part &part,
                                                         const unsigned int n_gauss) const
{
  return cells[part.cell].parts.size() > 1
             ? sigma_at(part, table_in(part, QGauss<2>(n_gauss)))
             : sigma_at(part, solution.tables.gradients(
                                  solution.displacement_space.degrees()[part.cell], n_gauss));
}

std::vector<RowStresses::PointStress> RowStresses::sigma_at(const Part &part,
                                                            const ShapeTable<2> &table) const
{
  const auto &iterator = patches.cells()[part.cell].iterator;
  const CellMap<2> map = map_of<2>(iterator);
  const std::vector<double> derivatives =
      evaluate(table.derivatives, solution.coefficients(part.cell));
  const bool is_axisymmetric = solution.scene.is_axisymmetric();
  const std::vector<double> values = is_axisymmetric
                                         ? evaluate(table.values, solution.coefficients(part.cell))
                                         : std::vector<double>();
  const HookesLaw<2> law(solution.scene.material_of(iterator));
  std::vector<PointStress> result;
  for (unsigned int q = 0; q < table.points.size(); ++q)
  {
    const Tensor<2, 2> gradient =
        physical_gradient<2>(derivatives, q * table.rows_per_point, table.derivatives.m(),
                             invert(map.jacobian(table.points[q])));
    const double hoop = is_axisymmetric ? values[q] / map.point(table.points[q])[0] : 0.;
    result.push_back(
        {law.stress(gradient, hoop), is_axisymmetric ? law.hoop_stress(gradient, hoop) : 0.});
  }
  return result;
}

/** What `w s_tt` is to be near less what the first row has for it besides its divergence, over w. */
double RowStresses::around(const Part &part, const PointStress &stress, const Point<2> &reference,
                           const Hat &psi) const
{
  const Scene<2> &scene = solution.scene;
  if (!scene.is_axisymmetric())
    return 0.;
  const Point<2> x = part.map.point(reference);
  const Tensor<1, 2> slope = psi.slope * invert(part.map.jacobian(reference));
  const double force =
      scene.has_body_force()
          ? load_at<2>(scene.body_force_in(patches.cells()[part.cell].iterator), x)[0]
          : 0.;
  return psi.value * stress.around + x[0] * ((stress.in_plane * slope)[0] - psi.value * force);
}

/** Those by which divergences know sigma: of the stiffness where its map is no polynomial, else as many as projections need. */
unsigned int RowStresses::data_points(const Part &part) const
{
  const unsigned int p = solution.displacement_space.degrees()[part.cell],
                     k = part.element->table.k;
  return part.map.is_curved() && is_whole(part)
             ? stiffness_points(solution.scene, part.map, p)
             : std::max(stiffness_points(solution.scene, part.map, k), k + 1);
}

/** `det DF (sigma grad psi)` by the points of the stiffness, where the discrete equations know sigma. */
void RowStresses::add_stress(const Part &part, OfVertices &result) const
{
  const unsigned int p = solution.displacement_space.degrees()[part.cell],
                     k = part.element->table.k, n_gauss = data_points(part),
                     n_modes = std::min(k + 1, n_gauss);
  const std::vector<PointStress> stress = sigma(part, n_gauss);
  const std::vector<Point<2>> &points = solution.tables.gradients(p, n_gauss).points;
  const FullMatrix<double> &project = cache.legendre.projection(n_modes, n_gauss);
  std::vector<Tensor<2, 2>>
      fluxes; // det DF sigma DF^-T in units of h: sigma grad psi from reference slopes
  for (unsigned int q = 0; q < points.size(); ++q)
  {
    const Tensor<2, 2> J = part.map.jacobian(points[q]);
    fluxes.push_back(determinant(J) / (4 * part.h) *
                     solution.scene.circumference(part.map.point(points[q])) *
                     Tensor<2, 2>(stress[q].in_plane) * transpose(invert(J)));
  }
  FullMatrix<double> values(n_gauss, n_gauss), half(n_modes, n_gauss), modes(n_modes, n_modes);
  for (unsigned int v = 0; v < 4; ++v)
    for (unsigned int row = part.element->first_row(); row < 2; ++row)
    {
      for (unsigned int b = 0; b < n_gauss; ++b)
        for (unsigned int a = 0; a < n_gauss; ++a)
          values(a, b) = fluxes[b * n_gauss + a][row] * hat(part, v, points[b * n_gauss + a]).slope;
      project.mmult(half, values);
      half.mTmult(modes, project);
      for (unsigned int i = 0; i < n_modes; ++i)
        for (unsigned int j = 0; j < n_modes; ++j)
          result.divergence[v][(row * (k + 1) + i) * (k + 1) + j] += modes(i, j);
    }
  if (!has_moment(part))
    return;
  const BeyondSpace beyond(solution, patches.cells()[part.cell], part.map);
  const ShapeTable<2> &table = solution.tables.gradients(p, n_gauss);
  for (unsigned int v = 0; v < 4; ++v)
    for (unsigned int q = 0; q < table.points.size(); ++q)
      result.moment[v] -=
          table.weights[q] * 4 * part.h * scalar_product(fluxes[q], beyond.slopes(v, table, q));
}

/** Body forces and initial strains by the points of their rules, where the discrete equations know them. */
void RowStresses::add_loads(Part &part, OfVertices &result)
{
  const Scene<2> &scene = solution.scene;
  const auto &iterator = patches.cells()[part.cell].iterator;
  const unsigned int p = solution.displacement_space.degrees()[part.cell];
  std::optional<BeyondSpace> beyond;
  if (has_moment(part))
    beyond.emplace(solution, patches.cells()[part.cell], part.map);
  const HookesLaw<2> law(scene.material_of(iterator));
  const auto force = [&](const Point<2> &x)
  { return std::pair(load_at<2>(scene.body_force_in(iterator), x), SymmetricTensor<2, 2>()); };
  const auto initial = [&](const Point<2> &x)
  {
    return std::pair(Tensor<1, 2>(), law.stress(scene.initial_strain_in(iterator, x),
                                                initial_strain_around(scene, iterator, x)));
  };
  if (scene.has_body_force())
    add_load(part, solution.spaces->loads->body_force(iterator, p), force,
             beyond ? &*beyond : nullptr, &part.divergence, result);
  if (scene.has_initial_strain())
    add_load(part, solution.spaces->loads->initial_strain(iterator, p), initial,
             beyond ? &*beyond : nullptr, nullptr, result);
  for (unsigned int face = 0; beyond && face < 4; ++face)
    if (part.map.blends()[face] && iterator->at_boundary(face))
      add_work_beyond(part, face, *beyond, result);
}

/** Of what loads and contact exert on a curved edge, on what V_N lacks of each psi z. */
void RowStresses::add_work_beyond(const Part &part, const unsigned int face,
                                  const BeyondSpace &beyond, OfVertices &result) const
{
  const unsigned int p = solution.displacement_space.degrees()[part.cell];
  std::map<double, ShapeTable<2>> at; // of all four psi
  const auto lacking = [&](const unsigned int v, const double s)
  {
    auto found = at.find(s);
    if (found == at.end())
      found =
          at.emplace(s, tabulate<2>(p, {point_on_face<2>(face, Point<1>(s))}, {1.}, false)).first;
    return beyond.value(v, found->second, 0);
  };
  const JointEdge *const joint = joints ? joints->edge(part.cell, face) : nullptr;
  for (unsigned int v = 0; v < 4; ++v)
  {
    result.moment[v] += boundary.work_of_loads(patches.cells()[part.cell].edges[face],
                                               [&](const double s) { return lacking(v, s); });
    for (unsigned int k = 0; joint && k < joint->pieces.size(); ++k)
    {
      const JointPiece &piece = joint->pieces[k];
      for (const auto &[s, weight] : joints->points(piece, piece.begin, piece.end, p + 1))
        result.moment[v] +=
            (joint->is_slave ? -weight : weight) * (joints->density(piece, s) * lacking(v, s));
    }
  }
}

/** Of a force and an initial stress, which @p load gives; @p of_force: what is to have the divergence of the force without psi. */
template <class Load>
void RowStresses::add_load(const Part &part, const LoadRule<2> &rule, const Load &load,
                           const BeyondSpace *const beyond, std::vector<double> *const of_force,
                           OfVertices &result) const
{
  const Quadrature<2> &points = rule.quadrature;
  const unsigned int p = solution.displacement_space.degrees()[part.cell],
                     n = part.element->table.k + 1,
                     n_modes = std::min(n, rule.most_points); // no more than its points tell
  const ShapeTable<2> table =
      tabulate<2>(beyond ? p : 1, points.get_points(), points.get_weights(), false);
  for (unsigned int q = 0; q < points.size(); ++q)
  {
    const Tensor<2, 2> J = part.map.jacobian(points.point(q));
    const auto L_x = legendre::values(n, 2 * points.point(q)[0] - 1),
               L_y = legendre::values(n, 2 * points.point(q)[1] - 1);
    const auto [F, stress] = load(part.map.point(points.point(q)));
    const Tensor<2, 2> flux = Tensor<2, 2>(stress) * transpose(invert(J));
    const double weight = points.weight(q) * determinant(J) *
                          solution.scene.circumference(part.map.point(points.point(q)));
    const auto add = [&](const Tensor<1, 2> &d, std::vector<double> &target)
    {
      for (unsigned int row = part.element->first_row(); row < 2; ++row)
        for (unsigned int i = 0; i < n_modes; ++i)
          for (unsigned int j = 0; j < n_modes; ++j)
            target[(row * n + i) * n + j] -= weight / part.h * d[row] * L_x[i] * L_y[j];
    };
    if (of_force)
      add(F, *of_force);
    for (unsigned int v = 0; v < 4; ++v)
    {
      const Hat psi = hat(part, v, points.point(q));
      add(psi.value * F + flux * psi.slope, result.divergence[v]);
      if (beyond)
        result.moment[v] += weight * (F * beyond->value(v, table, q) +
                                      scalar_product(flux, beyond->slopes(v, table, q)));
    }
  }
}

namespace
{
/** As BoundaryTractions has it, by the highest mode. */
void vanish_on_axis(const RowElement &element, std::array<std::vector<double>, 4> &tractions)
{
  const unsigned int n = element.table.k + 1;
  for (std::vector<double> &of_vertex : tractions)
    for (unsigned int c = element.n_motions(); c < element.n_conditions; ++c)
    {
      double *const own = &of_vertex[(2 * element.face_of_end(c) + (c - 1) % 2) * n];
      const bool is_end = *element.face_on_axis % 2;
      double value = 0;
      for (unsigned int i = 0; i < n; ++i)
        value += own[i] * legendre::at_end(i, is_end);
      own[n - 1] -= value / legendre::at_end(n - 1, is_end);
    }
}
} // namespace

/** What the slave exerts on the faces of a part in a joint, for each psi: tractions in the order of TractionEnergy. */
void RowStresses::add_joints(const Part &part, OfVertices &result) const
{
  const unsigned int n = part.element->table.k + 1;
  for (unsigned int face = 0; face < 4; ++face)
  {
    const JointEdge *const edge = cut_edge(part.cell, face);
    if (!edge || !is_on(part, face))
      continue;
    const unsigned int along = 1 - face / 2;
    const double begin = part.box.lower_bound(along), length = part.box.side_length(along);
    const double turn = ((face % 2 == 1) != edge->is_slave ? 1. : -1.) /
                        patches.edges()[patches.cells()[part.cell].edges[face]].length;
    for (const JointPiece &piece : edge->pieces)
    {
      if (piece.begin > begin + length / 2 || piece.end < begin + length / 2)
        continue;
      for (const auto &[at, weight] : joints->points(piece, begin, begin + length, n))
      {
        const Tensor<1, 2> T = turn * joints->density(piece, at);
        const double s = (at - begin) / length;
        const std::vector<double> L = legendre::values(n, 2 * s - 1);
        for (unsigned int v = 0; v < 4; ++v)
        {
          const double psi = hat(part, v, point_on_face<2>(face, Point<1>(s))).value;
          for (unsigned int row = 0; row < 2; ++row)
            for (unsigned int i = 0; i < n; ++i)
              result.tractions[v][(2 * face + row) * n + i] +=
                  2 * weight / length * psi * T[row] * L[i];
        }
      }
    }
  }
  if (part.element->face_on_axis)
    vanish_on_axis(*part.element, result.tractions);
}

/** Data of each psi: divergences, and tractions that the slave exerts. */
RowStresses::OfVertices RowStresses::data_of(Part &part)
{
  const RowElement &element = *part.element;
  const unsigned int n = element.table.k + 1;
  part.divergence.assign(2 * n * n, 0.);
  OfVertices result;
  for (unsigned int v = 0; v < 4; ++v)
  {
    result.divergence[v].assign(2 * n * n, 0.);
    result.tractions[v].assign(8 * n, 0.);
  }
  add_stress(part, result);
  add_loads(part, result);
  if (joints)
    add_joints(part, result);
  if (!has_moment(part))
    return result;
  const std::vector<double> moment =
      unit_moment(element, part.map, part.h, std::min(n, data_points(part)));
  for (unsigned int v = 0; v < 4; ++v)
    for (unsigned int i = 0; i < moment.size(); ++i)
      result.divergence[v][i] += result.moment[v] / (part.h * part.h) * moment[i];
  return result;
}

/**
 * The discrete equations know a curved cell by the points of its stiffness, and its parts by others: the first part takes the difference, three
 * numbers for each psi, that sum to zero.
 */
void RowStresses::balance_parts(Cell &cell, std::vector<OfVertices> &data)
{
  const OfVertices whole = data_of(*cell.whole);
  const RowElement &element = *cell.parts[0].element, &of_whole = *cell.whole->element;
  const unsigned int n = element.table.k + 1;
  const unsigned int n_conditions = element.n_motions();
  std::array<std::vector<double>, 3> fields; // of two forces and a moment
  FullMatrix<double> work(n_conditions, n_conditions);
  for (unsigned int z = 0; z < n_conditions; ++z)
  {
    fields[z].assign(2 * n * n, 0.);
    if (z < 2)
      fields[z][(z + element.first_row()) * n * n] = 1.;
    else
      fields[z] = unit_moment(element, cell.parts[0].map, cell.parts[0].h, n);
    const RowElement::Conditions of_field =
        cell.joined->of_cell(0, element.moments(fields[z].data()));
    for (unsigned int c = 0; c < n_conditions; ++c)
      work(c, z) = of_field[c];
  }
  work.gauss_jordan();
  for (unsigned int v = 0; v < 4; ++v)
  {
    const RowElement::Conditions wanted = of_whole.moments(whole.divergence[v].data());
    Vector<double> missing(n_conditions), amounts(n_conditions);
    for (unsigned int z = 0; z < n_conditions; ++z)
      missing[z] = of_whole.lengths[z] / cell.joined->lengths()[z] * wanted[z];
    for (unsigned int k = 0; k < cell.parts.size(); ++k)
    {
      const RowElement::Conditions there =
          cell.joined->of_cell(k, cell.parts[k].element->moments(data[k].divergence[v].data()));
      for (unsigned int z = 0; z < n_conditions; ++z)
        missing[z] -= there[z];
    }
    work.vmult(amounts, missing);
    for (unsigned int z = 0; z < n_conditions; ++z)
      for (unsigned int i = 0; i < fields[z].size(); ++i)
        data[0].divergence[v][i] += amounts[z] * fields[z][i];
  }
}

/** Of the energy by tractions of faces, and what is missing of equilibrium. */
void RowStresses::set_gradients(const Part &part, OfVertices &data) const
{
  const RowElement &element = *part.element;
  const unsigned int n = element.table.k + 1, n_edges = 8 * n;
  const std::vector<PointStress> stress = stress_at_points(part, element.table);
  const TractionEnergy energy = element.energy();
  for (unsigned int v = 0; v < 4; ++v)
  {
    const std::vector<double> &divergence = data.divergence[v];
    RowFields fields(element.table);
    for (unsigned int row = 0; row < 2; ++row)
      std::copy(&divergence[row * n * n], &divergence[row * n * n] + n * n,
                &fields.fields[row * element.table.n_fields() + element.table.of_divergence()]);
    RowValues::Stress difference(element.values);
    element.values.add(fields, difference);
    for (unsigned int q = 0; q < stress.size(); ++q)
    {
      const Hat psi = hat(part, v, element.table.points[q]);
      element.values.subtract(q, stress[q].in_plane, psi.value, difference,
                              around(part, stress[q], element.table.points[q], psi));
    }
    data.gradients[v] = element.reduced(element.values.derivatives(difference), fields);
    data.defects[v] = element.moments(divergence.data());
    for (double &defect : data.defects[v])
      defect = -defect;
    if (std::all_of(data.tractions[v].begin(), data.tractions[v].end(),
                    [](const double value) { return value == 0.; }))
      continue;
    multiply('N', 'N', n_edges, 1, n_edges, 1., energy.G, {data.tractions[v].data(), n_edges}, 1.,
             data.gradients[v].data(), n_edges);
    multiply('T', 'N', energy.n_conditions, 1, n_edges, 1., energy.N,
             {data.tractions[v].data(), n_edges}, 1., data.defects[v].data(), energy.n_conditions);
  }
}

TractionEnergy RowStresses::energy_of(const Cell &cell)
{
  return cell.joined ? cell.joined->energy() : cell.parts[0].element->energy();
}

void RowStresses::set_cell(const unsigned int index)
{
  Cell &cell = cells[index];
  std::array<CutElement::Data, 4> data; // by vertex
  std::array<std::vector<double>, 4> gradients;
  std::array<RowElement::Conditions, 4> defects;
  std::vector<OfVertices> of_parts;
  for (Part &part : cell.parts)
    of_parts.push_back(data_of(part));
  if (cell.whole)
    balance_parts(cell, of_parts);
  for (unsigned int k = 0; k < cell.parts.size(); ++k)
  {
    Part &part = cell.parts[k];
    OfVertices &own = of_parts[k];
    set_gradients(part, own);
    part.tractions = own.tractions[0];
    for (unsigned int v = 0; v < 4; ++v)
    {
      data[v].gradients.push_back(own.gradients[v]);
      data[v].defects.push_back(own.defects[v]);
      for (unsigned int i = 0; v > 0 && i < part.tractions.size(); ++i)
        part.tractions[i] += own.tractions[v][i];
    }
    set_missed_force(part);
  }
  for (unsigned int v = 0; v < 4; ++v)
  {
    gradients[v] = cell.joined ? cell.joined->gradient(data[v]) : data[v].gradients[0];
    defects[v] = cell.joined ? cell.joined->defect(data[v]) : data[v].defects[0];
  }
  cell.data = data[0];
  for (unsigned int v = 1; cell.joined && v < 4; ++v)
    for (unsigned int part = 0; part < cell.parts.size(); ++part)
    {
      for (unsigned int i = 0; i < gradients[0].size(); ++i)
        cell.data.gradients[part][i] += data[v].gradients[part][i];
      for (unsigned int i = 0; i < cell.data.defects[part].size(); ++i)
        cell.data.defects[part][i] += data[v].defects[part][i];
    }
  for (const VertexPatches::Hat &hat : patches.cells()[index].hats)
  {
    const auto of_hat = [&](const auto &by_vertex, const unsigned int i)
    {
      double sum = 0;
      for (unsigned int v = 0; v < 4; ++v)
        sum += hat.values[v] * by_vertex[v][i];
      return sum;
    };
    for (unsigned int i = 0; i < gradients[0].size(); ++i)
      cell.gradients.push_back(of_hat(gradients, i));
    for (unsigned int i = 0; i < energy_of(cell).n_conditions; ++i)
      cell.defects.push_back(of_hat(defects, i));
  }
}

/** One element of all parts of a cell; none where there is one. */
void RowStresses::join_parts()
{
  std::vector<EquilibrationCache::Signature> keys;
  std::vector<Cell *> cut;
  std::vector<std::vector<CutElement::Part>> parts;
  std::vector<Point<2>> centres;
  for (unsigned int index = 0; index < cells.size(); ++index)
  {
    Cell &cell = cells[index];
    const CellMap<2> map = map_of<2>(patches.cells()[index].iterator);
    cell.h = size_of(map);
    if (cell.parts.size() == 1)
      continue;
    cut.push_back(&cell);
    centres.push_back(map.point({0.5, 0.5}));
    parts.emplace_back();
    keys.push_back({long(cell.n_xi)});
    const auto add = [&](const double value) { keys.back().push_back(std::lround(1e11 * value)); };
    for (const Part &part : cell.parts)
    {
      const Point<2> centre = part.map.point({0.5, 0.5});
      parts.back().push_back({part.box, part.element, part.h, centre});
      keys.back().push_back(reinterpret_cast<long>(part.element));
      for (unsigned int d = 0; d < 2; ++d)
      {
        add(part.box.lower_bound(d));
        add(part.box.upper_bound(d));
        add((centre[d] - centres.back()[d]) / cell.h);
      }
      add(part.h / cell.h);
    }
  }
  using Kept = decltype(cache.cut_elements)::mapped_type;
  const auto elements =
      ordered_values(cache.cut_elements, keys,
                     [&](const unsigned int k)
                     {
                       return Kept{std::make_unique<const CutElement>(parts[k], cut[k]->n_xi,
                                                                      cut[k]->h, centres[k]),
                                   false};
                     });
  for (unsigned int k = 0; k < cut.size(); ++k)
  {
    elements[k]->is_used = true;
    cut[k]->joined = elements[k]->value.get();
  }
}

/** The initial stress at reference coordinates of a part. */
void RowStresses::subtract_initial(const Part &part, const std::vector<Point<2>> &points,
                                   std::vector<PointStress> &stress) const
{
  if (!solution.scene.has_initial_strain())
    return;
  const auto &iterator = patches.cells()[part.cell].iterator;
  const HookesLaw<2> law(solution.scene.material_of(iterator));
  for (unsigned int q = 0; q < stress.size(); ++q)
  {
    const Point<2> x = part.map.point(points[q]);
    const Tensor<2, 2> initial = solution.scene.initial_strain_in(iterator, x);
    const double across = initial_strain_around(solution.scene, iterator, x);
    stress[q].in_plane -= law.stress(initial, across);
    if (solution.scene.is_axisymmetric())
      stress[q].around -= law.hoop_stress(initial, across);
  }
}

/** sigma(u_N) at the points of a table, less the initial stress there. */
std::vector<RowStresses::PointStress> RowStresses::stress_at_points(const Part &part,
                                                                    const RowTable &table) const
{
  std::vector<PointStress> result = sigma(part, table.n_gauss);
  subtract_initial(part, table.points, result);
  return result;
}

void RowStresses::set_missed_force(Part &part)
{
  if (!solution.scene.has_body_force())
    return;
  const auto &iterator = patches.cells()[part.cell].iterator;
  const unsigned int n = part.element->table.k + 1;
  const LoadRule<2> rule = solution.spaces->loads->body_force(iterator, n + 1);
  double sum = 0, all = 0;
  for (unsigned int q = 0; q < rule.quadrature.size(); ++q)
  {
    const Point<2> &reference = rule.quadrature.point(q);
    const double det = determinant(part.map.jacobian(reference));
    const auto L_x = legendre::values(n, 2 * reference[0] - 1),
               L_y = legendre::values(n, 2 * reference[1] - 1);
    const Tensor<1, 2> of_force =
        solution.scene.circumference(part.map.point(reference)) *
        load_at<2>(solution.scene.body_force_in(iterator), part.map.point(reference));
    Tensor<1, 2> missed(of_force);
    if (solution.scene.is_axisymmetric())
      missed[0] = 0.; // the stress around the axis bears it
    for (unsigned int row = part.element->first_row(); row < 2; ++row)
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          missed[row] +=
              4 * part.h / det * part.divergence[(row * n + i) * n + j] * L_x[i] * L_y[j];
    sum += rule.quadrature.weight(q) * det * missed.norm_square();
    all += rule.quadrature.weight(q) * det * of_force.norm_square();
  }
  part.missed_force = std::sqrt(sum);
  if (solution.scene.is_axisymmetric() && axis_face(map_of<2>(iterator))) // round-off, or anything
    part.missed_force = sum <= 1e-22 * all ? 0. : std::numeric_limits<double>::infinity();
}

PatchCell RowStresses::patch_cell(const unsigned int index, const unsigned int hat) const
{
  const Cell &cell = cells[index];
  const TractionEnergy energy = energy_of(cell);
  return {energy, cell.h * cell.h, &cell.gradients[hat * energy.n_edges()],
          &cell.defects[hat * energy.n_conditions], &patches.cells()[index]};
}

/** Of each part, what it has in joints included. */
std::vector<std::vector<double>>
RowStresses::tractions_of_parts(const unsigned int index,
                                const std::vector<double> &tractions) const
{
  const Cell &cell = cells[index];
  std::vector<std::vector<double>> result{tractions};
  if (cell.joined)
    result = cell.joined->tractions(tractions, cell.data);
  for (unsigned int part = 0; part < result.size(); ++part)
    for (unsigned int i = 0; i < tractions.size(); ++i)
      result[part][i] += cell.parts[part].tractions[i];
  return result;
}

/** s - sigma(u_N) by the fields of s. */
RowValues::Stress RowStresses::difference(const Part &part, const RowValues &values,
                                          const RowFields &fields) const
{
  RowValues::Stress result(values);
  values.add(fields, result);
  const std::vector<PointStress> stress = stress_at_points(part, values.table);
  for (unsigned int q = 0; q < stress.size(); ++q)
    values.subtract(q, stress[q].in_plane, 1., result,
                    around(part, stress[q], values.table.points[q], {1., {}}));
  return result;
}

/** The same, and s by its fields. */
RowValues::Stress RowStresses::residual(const Part &part, const std::vector<double> &tractions,
                                        RowFields &fields) const
{
  const RowTable &table = part.element->table;
  const RowValues &values = part.element->values;
  const unsigned int n = table.k + 1;
  for (unsigned int row = 0; row < 2; ++row)
  {
    double *const own = &fields.fields[row * table.n_fields()];
    for (unsigned int face = 0; face < 4; ++face)
      for (unsigned int i = 0; i < n; ++i)
        own[table.of_face(face) + i] =
            part.element->scale[face] * tractions[(2 * face + row) * n + i];
    std::copy(&part.divergence[row * n * n], &part.divergence[row * n * n] + n * n,
              own + table.of_divergence());
  }
  RowValues::Stress result = difference(part, values, fields);
  const RowFields change = part.element->best_bubbles(values.derivatives(result), fields);
  values.add(change, result);
  for (unsigned int i = 0; i < fields.fields.size(); ++i)
    fields.fields[i] += change.fields[i];
  fields.corners = change.corners;
  return result;
}

/** As squares(), with the stresses of corners at points that their singularities are integrated by. */
std::array<double, 2> RowStresses::squares_at_corners(const Part &part,
                                                      const RowFields &fields) const
{
  const RowElement &element = *part.element;
  const Quadrature<2> rule = corner_quadrature(element.table.corners, element.rule.n_corner);
  std::vector<PointStress> stress = sigma_at(part, table_in(part, rule));
  subtract_initial(part, rule.get_points(), stress);
  std::vector<RowValues::Components> components;
  for (unsigned int q = 0; q < stress.size(); ++q)
  {
    const SymmetricTensor<2, 2> &s = stress[q].in_plane;
    components.push_back(
        {{s[0][0], s[1][1], s[0][1], around(part, stress[q], rule.point(q), {1., {}})}});
  }
  return element.values.squares(shape_of(part), fields, rule, components);
}

/** Of s - sigma(u_N) and of what is antisymmetric, times theta C_K^2, per h^2: no less than they are, by EnergyRule. */
std::array<double, 2> RowStresses::squares(const Part &part,
                                           const std::vector<double> &tractions) const
{
  const RowElement &element = *part.element;
  const RowTable &table = element.table;
  RowFields fields(table);
  const RowValues::Stress missed = residual(part, tractions, fields);
  std::array<double, 2> result{
      {element.values.square(missed, false), element.values.square(missed, true)}};
  if (element.rule.factor == 1.)
    return result;
  if (!table.corners.empty())
    result = squares_at_corners(part, fields);
  else if (element.rule.n_gauss > table.n_gauss)
  {
    const RowValues finer(cache.row_table(table.k, element.rule.n_gauss, 0), shape_of(part));
    const RowValues::Stress seen = difference(part, finer, fields);
    result = {{finer.square(seen, false), finer.square(seen, true)}};
  }
  for (double &square : result)
    square *= element.rule.factor;
  return result;
}

RowStresses::Distance RowStresses::distance(const unsigned int index,
                                            const std::vector<double> &tractions) const
{
  Distance result{0., 0.};
  const std::vector<std::vector<double>> by_part = tractions_of_parts(index, tractions);
  for (unsigned int k = 0; k < by_part.size(); ++k)
  {
    const Part &part = cells[index].parts[k];
    const auto [symmetric, antisymmetric] = squares(part, by_part[k]);
    const double area = part.h * part.h;
    result.square += area * symmetric;
    result.antisymmetry += area * antisymmetric / RowValues::theta;
  }
  result.antisymmetry = std::sqrt(result.antisymmetry);
  return result;
}

Tensor<2, 2> RowStresses::value(const unsigned int index, const std::vector<double> &tractions,
                                const Point<2> &at) const
{
  const std::vector<Part> &parts = cells[index].parts;
  const auto found = std::find_if(parts.begin(), parts.end(),
                                  [&](const Part &part) { return part.box.point_inside(at); });
  const Part &part = *found;
  const Point<2> reference = part.box.real_to_unit(at);
  const RowTable &table = part.element->table;
  const RowShape shape = shape_of(part);
  RowFields fields(table);
  residual(part, tractions_of_parts(index, tractions)[found - parts.begin()], fields);
  const std::array<std::vector<double>, 3> fields_at = table.at(reference);
  Tensor<2, 2> flux;
  for (unsigned int row = 0; row < 2; ++row)
    for (unsigned int d = 0; d < 2; ++d)
      flux[row][d] = std::inner_product(fields_at[d].begin(), fields_at[d].end(),
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
  return flux * transpose(J) /
         (determinant(J) * solution.scene.circumference(shape.map.point(reference)));
}

double RowStresses::missed_force(const unsigned int index) const
{
  double square = 0;
  for (const Part &part : cells[index].parts)
    square += part.missed_force * part.missed_force;
  return std::sqrt(square);
}

std::vector<RowStresses::JointPart> RowStresses::joint_parts(const unsigned int index,
                                                             const unsigned int face) const
{
  std::vector<JointPart> result;
  for (const Part &part : cells[index].parts)
    if (cut_edge(index, face) && is_on(part, face))
    {
      const unsigned int along = 1 - face / 2, n = part.element->table.k + 1;
      const auto first = part.tractions.begin() + 2 * face * n;
      result.push_back({part.box.lower_bound(along),
                        part.box.upper_bound(along),
                        {{{first, first + n}, {first + n, first + 2 * n}}}});
    }
  return result;
}

double RowStresses::missed_traction(const unsigned int index, const unsigned int face) const
{
  const unsigned int number = patches.cells()[index].edges[face];
  const StressEdge &edge = patches.edges()[number];
  const auto &iterator = patches.cells()[index].iterator;
  const CellMap<2> map = map_of<2>(iterator);
  const bool is_on_axis = CellConstants(map).is_on_axis(solution.scene.material_of(iterator));
  double square = 0;
  for (const auto &[begin, end, components] : joint_parts(index, face))
    for (const JointPiece &piece : cut_edge(index, face)->pieces)
      if (const double middle = (begin + end) / 2; piece.begin < middle && piece.end > middle)
        for (const auto &[s, weight] : joints->points(piece, begin, end, 2 * components[0].size()))
        {
          const Tensor<1, 2> exact = ((face % 2 == 1) != piece.is_slave ? 1. : -1.) / edge.length *
                                     joints->density(piece, s);
          for (unsigned int row = 0; row < 2; ++row)
          {
            const double missed =
                legendre::evaluate(components[row], 2 * (s - begin) / (end - begin) - 1) -
                exact[row];
            square += edge.length / boundary.stretch(edge, s) * weight * missed * missed /
                      (is_on_axis ? full_turn(map.point(point_on_face<2>(face, Point<1>(s)))) : 1.);
          }
        }
  return std::sqrt(square);
}
} // namespace hpvi
