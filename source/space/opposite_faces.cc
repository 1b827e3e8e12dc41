// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/numerical_failure.h>
#include <hpvi/base/processes.h>
#include <hpvi/base/text.h>
#include <hpvi/base/tolerances.h>
#include <hpvi/plane/face_axes.h>
#include <hpvi/scene/curved_facing.h>
#include <hpvi/scene/faces_across.h>
#include <hpvi/scene/hexahedral_mesh.h>
#include <hpvi/scene/slave_side.h>
#include <hpvi/space/opposite_faces.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>

#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace hpvi
{
using namespace dealii;

namespace
{
using Cell = DoFHandler<3>::active_cell_iterator;

constexpr double beyond_part =
    0.5; ///< of the coordinates of a face, which chords of its edges leave

/** With its outer normal. */
Side<3>::Piece piece_of(const CellMap<3> &map, const unsigned int face)
{
  Side<3>::Piece result;
  for (unsigned int v = 0; v < 4; ++v)
    result[v] = map.vertices()[GeometryInfo<3>::face_to_cell_vertices(face, v)];
  if (face % 2 == 0)
    std::swap(result[1], result[2]);
  return result;
}

/** Are the coordinates of the unit cell along a face in the other order, for `x_1 x x_2` to point outwards? */
bool is_exchanged(const unsigned int face)
{
  return (face % 2 == 0) != (face / 2 == 1);
}

/** Of a point of a CurvedFace that curve_of() makes. */
Point<3> on_cell(const unsigned int face, const Point<2> &xi)
{
  return point_on_face<3>(face, is_exchanged(face) ? Point<2>(xi[1], xi[0]) : xi);
}

Point<2> on_curve(const unsigned int face, const Point<3> &reference)
{
  const auto axes = tangents<3>(face);
  const unsigned int first = is_exchanged(face) ? 1 : 0;
  return {reference[axes[first]], reference[axes[1 - first]]};
}

CurvedFace curve_of(const CellMap<3> &map, const unsigned int face)
{
  CurvedFace::Nodes nodes;
  for (unsigned int k = 0; k < nodes.size(); ++k)
    nodes[k] = map.point(on_cell(face, Point<2>(k % 3 / 2., k / 3 / 2.)));
  return CurvedFace(nodes);
}

CurvedFace curve_of(const MasterFace &master)
{
  CurvedFace::Nodes nodes;
  if (master.curve.empty())
    return {};
  std::copy(master.curve.begin(), master.curve.end(), nodes.begin());
  return CurvedFace(nodes);
}

/** By boundary id: does it lie on a side of a curved pair? */
std::vector<bool> on_curved_pairs(const Scene<3> &scene)
{
  const std::vector<bool> curved = curved_pairs(scene);
  std::vector<bool> result(scene.boundaries.size(), false);
  for (unsigned int p = 0; p < curved.size(); ++p)
    for (const BoundaryCondition<3> &boundary : scene.boundaries)
      if (curved[p] &&
          (boundary.side == scene.pairs[p].sides[0] || boundary.side == scene.pairs[p].sides[1]))
        result[boundary.id] = true;
  return result;
}

FacesFromAll pieces_of(const std::vector<MasterFace> &masters)
{
  std::vector<Side<3>::Piece> result;
  for (const MasterFace &master : masters)
    result.push_back(piece_of(master.map(), master.face));
  return FacesFromAll(std::move(result));
}

OppositeNode node_at(const Point<3> &x, const types::global_dof_index first,
                     const AffineConstraints<double> &constraints)
{
  OppositeNode node{x, first, {}};
  for (unsigned int c = 0; c < 3; ++c)
    if (!constraints.is_constrained(first + c))
      node.entries[c] = {{first + c, 1.}};
    else
      node.entries[c] = *constraints.get_constraint_entries(first + c);
  return node;
}

std::vector<unsigned int> shapes_on(const BoxTables<3> &tables, const unsigned int face)
{
  std::vector<unsigned int> result = tables.rim[face];
  result.insert(result.end(), tables.inner[face].begin(), tables.inner[face].end());
  return result;
}

/** Of this process. */
std::vector<MasterFace> own_masters(const Scene<3> &scene, const DoFHandler<3> &dof_handler,
                                    const DegreeTables<3> &all_tables,
                                    const AffineConstraints<double> &constraints,
                                    const std::vector<bool> &is_master)
{
  std::vector<MasterFace> result;
  const std::vector<bool> is_curved = on_curved_pairs(scene);
  std::vector<types::global_dof_index> dofs;
  const unsigned int rank = rank_of(dof_handler.get_communicator());
  for (const Cell &cell : dof_handler.active_cell_iterators())
    for (const unsigned int face : cell->face_indices())
    {
      if (!cell->is_locally_owned() || !cell->at_boundary(face) ||
          !is_master[cell->face(face)->boundary_id()])
        continue;
      const CellMap<3> map = map_of<3>(cell);
      MasterFace master{{map.vertices().begin(), map.vertices().end()},
                        face,
                        cell->face(face)->boundary_id(),
                        cell->material_id(),
                        rank,
                        cell->active_cell_index(),
                        all_tables.number_of(cell),
                        {},
                        {}};
      if (is_curved[master.boundary])
      {
        const CurvedFace curve = curve_of(map, face);
        master.curve.assign(curve.nodes().begin(), curve.nodes().end());
      }
      const BoxTables<3> &tables = all_tables.take_dofs(cell, dofs);
      for (const unsigned int shape : shapes_on(tables, face))
      {
        const unsigned int number = tables.numbers[shape][0];
        master.nodes.push_back(
            node_at(map.point(tables.fe.unit_support_point(number)), dofs[number], constraints));
      }
      result.push_back(master);
    }
  return result;
}

/** Lagrange's polynomials at the nodes of a cell, by shape function and axis. */
class NodalPolynomials
{
public:
  explicit NodalPolynomials(const BoxTables<3> &tables)
      : basis(Polynomials::generate_complete_Lagrange_basis(
            QGaussLobatto<1>(tables.degree + 1).get_points())),
        of_axis(tables.n_shapes)
  {
    const std::vector<Point<1>> nodes = QGaussLobatto<1>(tables.degree + 1).get_points();
    for (unsigned int shape = 0; shape < tables.n_shapes; ++shape)
    {
      const Point<3> x = tables.fe.unit_support_point(tables.numbers[shape][0]);
      for (unsigned int d = 0; d < 3; ++d)
        for (unsigned int i = 0; i < nodes.size(); ++i)
          if (std::abs(nodes[i][0] - x[d]) < 1e-10)
            of_axis[shape][d] = i;
    }
  }

  unsigned int degree() const
  {
    return basis.size() - 1;
  }

  /** The values of @p shapes at a point of the unit cell, on @p face. */
  std::vector<double> values(const std::vector<unsigned int> &shapes, const unsigned int face,
                             const Point<3> &x) const
  {
    const auto axes = tangents<3>(face);
    std::array<std::vector<double>, 2> along;
    for (unsigned int s = 0; s < 2; ++s)
      for (const auto &polynomial : basis)
        along[s].push_back(polynomial.value(x[axes[s]]));
    std::vector<double> result;
    for (const unsigned int shape : shapes)
      result.push_back(along[0][of_axis[shape][axes[0]]] * along[1][of_axis[shape][axes[1]]]);
    return result;
  }

private:
  std::vector<Polynomials::Polynomial<double>> basis;
  std::vector<std::array<unsigned int, 3>> of_axis;
};

/** The point of the unit cell at a point @p x of a face of it, or of what lies above the face along @p n. */
Point<3> reference_on(const CellMap<3> &map, const unsigned int face, const Point<3> &x,
                      const Tensor<1, 3> &n)
{
  Point<3> reference(0.5, 0.5, 0.5);
  reference[face / 2] = face % 2;
  const auto axes = tangents<3>(face);
  for (unsigned int step = 0; step < 30; ++step)
  {
    // x + h n = point(reference), h and both coordinates along the face unknown
    const Tensor<2, 3> J = map.jacobian(reference);
    Tensor<2, 3> system;
    for (unsigned int d = 0; d < 3; ++d)
    {
      system[d][0] = J[d][axes[0]];
      system[d][1] = J[d][axes[1]];
      system[d][2] = -n[d];
    }
    const Tensor<1, 3> change = invert(system) * (x - map.point(reference));
    reference[axes[0]] += change[0];
    reference[axes[1]] += change[1];
    // The offset along n is linear: a face that is a parallelogram is done at once.
    if (std::abs(change[0]) + std::abs(change[1]) < 1e-14 || (step == 0 && map.is_affine()))
      break;
  }
  return reference;
}

/**
 * Points a direction that a Gauss rule on a face needs beside those that polynomials do, for 1e-12: the inverse of a bilinear map has a
 * branch point where its determinant vanishes, which is linear along a line. At r times the least on the face the largest one leaves it at
 * z = 1 + 2/(r^2 - 1) of half its width from its middle, and n points have an error like (z + (z^2 - 1)^1/2)^-2n.
 */
unsigned int more_points(const CellMap<3> &map, const unsigned int face)
{
  constexpr double digits = 28; // 2 ln 1e6
  constexpr unsigned int most = 20;
  double least = std::numeric_limits<double>::max(), largest = 0;
  for (unsigned int v = 0; v < 4; ++v)
  {
    const double measure = map.face_measure(
        face, GeometryInfo<3>::unit_cell_vertex(GeometryInfo<3>::face_to_cell_vertices(face, v)));
    least = std::min(least, measure);
    largest = std::max(largest, measure);
  }
  if (largest <= (1 + 1e-12) * least)
    return 0;
  const double r = largest / least, z = 1 + 2 / (r * r - 1);
  return std::min<double>(most, std::ceil(digits / 2 / std::log(z + std::sqrt(z * z - 1))));
}

[[noreturn]] void throw_uncovered(const ContactDofFace<3> &slave, const bool lacks_any)
{
  throw NumericalFailure("a face of a body at " +
                         to_string(slave.cell->face(slave.face)->center()) + " lies opposite to " +
                         (lacks_any ? "no" : "more than one") +
                         " face of the other one along a part of it; give both bodies cells that "
                         "end where the other one does");
}

/** Puts together what lies opposite to one face after the other. */
class Search
{
public:
  Search(const Scene<3> &scene, const DegreeTables<3> &tables,
         const std::vector<MasterFace> &masters)
      : scene(scene), tables(tables), masters(masters), pieces(pieces_of(masters))
  {
    for (const BoxTables<3> &own : tables.all)
      polynomials.emplace_back(own);
    std::vector<CurvedFace> curved;
    for (unsigned int m = 0; m < masters.size(); ++m)
    {
      shapes.push_back(shapes_on(tables.all[masters[m].tables], masters[m].face));
      if (masters[m].curve.empty())
        continue;
      curved.push_back(curve_of(masters[m]));
      of_surfaces.push_back(m);
    }
    if (!curved.empty())
      surfaces = std::make_unique<const CurvedFaces>(std::move(curved));
  }

  /** Rows have numbers of nodes `node_of(master, i)`. */
  template <class NodeOf>
  OppositeFaces::Opposite opposite(const ContactDofFace<3> &slave, const NodeOf &node_of);

  /** The same in a curved pair. */
  template <class NodeOf>
  OppositeFaces::Opposite opposite_on_curve(const ContactDofFace<3> &slave, const NodeOf &node_of);

private:
  void integrate(const ContactDofFace<3> &slave, const CellMap<3> &map, const FacePlane &plane,
                 const ConvexPolygon &polygon, unsigned int master);

  const Scene<3> &scene;
  const DegreeTables<3> &tables;
  const std::vector<MasterFace> &masters;
  const FacesFromAll pieces;                     ///< by master
  std::vector<NodalPolynomials> polynomials;     ///< by number of tables
  std::vector<std::vector<unsigned int>> shapes; ///< by master
  std::map<std::pair<unsigned int, unsigned int>, std::vector<double>>
      integrals;                               ///< of psi_k phi_d, by master and node
  std::vector<double> areas;                   ///< int psi_k by the same rule
  std::unique_ptr<const CurvedFaces> surfaces; ///< of curved pairs
  std::vector<unsigned int> of_surfaces;       ///< numbers of masters
};

/** Of a face of a curved pair: all integrals by one rule, summed point by point. */
class CurvedMoments
{
public:
  CurvedMoments(const BoxTables<3> &tables, const NodalPolynomials &polynomials,
                const ContactDofFace<3> &slave, const BoundaryCondition<3> &boundary)
      : tables(tables), polynomials(polynomials), slave(slave), boundary(boundary),
        map(map_of<3>(slave.cell)), n(tables.n_contact_dofs()), areas(n), centroids(n), psi(n)
  {
    const unsigned int n_inner = tables.inner[slave.face].size(),
                       n_rim = tables.rim[slave.face].size();
    moments.M.reinit(3 * n, 3 * n_inner);
    moments.W.reinit(3 * n, 3 * n_rim);
  }

  /** By the part of the face that is @p polygon; @p shapes are those of the master. */
  void integrate(const ConvexPolygon &polygon, const CurvedFace &surface, const MasterFace &master,
                 const NodalPolynomials &of_master, const std::vector<unsigned int> &shapes,
                 const std::function<std::vector<Tensor<1, 3>> &(unsigned int)> &row);

  /** Divides by `int psi_k`. */
  void finish();

  const BoxTables<3> &tables;
  const NodalPolynomials &polynomials;
  const ContactDofFace<3> &slave;
  const BoundaryCondition<3> &boundary;
  const CellMap<3> map;
  const unsigned int n;
  FaceContactDofs moments;
  std::vector<double> areas;
  std::vector<Tensor<1, 3>> centroids;
  double covered = 0;

private:
  void add(FullMatrix<double> &matrix, const std::vector<unsigned int> &shapes, const Point<3> &own,
           const ContactAxes<3> &axes) const;

  std::vector<double> psi;
};

Tensor<1, 3> direction(const ContactAxes<3> &axes, const unsigned int own)
{
  return own == 2 ? axes.normal : axes.tangents[own];
}

/** `w psi_k phi_j e_own` of the slave's own functions. */
void CurvedMoments::add(FullMatrix<double> &matrix, const std::vector<unsigned int> &shapes,
                        const Point<3> &own, const ContactAxes<3> &axes) const
{
  const std::vector<double> phi = polynomials.values(shapes, slave.face, own);
  for (unsigned int d = 0; d < 3; ++d)
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int j = 0; j < phi.size(); ++j)
          matrix(d * n + k, c * phi.size() + j) += psi[k] * phi[j] * direction(axes, d)[c];
}

void CurvedMoments::integrate(const ConvexPolygon &polygon, const CurvedFace &surface,
                              const MasterFace &master, const NodalPolynomials &of_master,
                              const std::vector<unsigned int> &shapes,
                              const std::function<std::vector<Tensor<1, 3>> &(unsigned int)> &row)
{
  Point<2> start(0.5, 0.5);
  for (const WeightedPoint &point :
       rule_on(polygon, tables.degree + std::max(tables.degree, of_master.degree())))
  {
    const Point<3> own = on_cell(slave.face, point.x);
    const ContactAxes<3> axes = axes_of_face(map, slave.face, own, boundary);
    const std::optional<FaceMeeting> at =
        meeting(surface, map.point(own), axes.normal, beyond_part, start);
    if (!at)
      continue;
    start = at->xi;
    covered += point.weight;
    const double weight = point.weight * map.face_measure(slave.face, own);
    for (unsigned int k = 0; k < n; ++k)
    {
      psi[k] = weight * tables.psi(k, slave.face, own);
      areas[k] += psi[k];
      centroids[k] += psi[k] * (map.point(own) - Point<3>());
    }
    add(moments.M, tables.inner[slave.face], own, axes);
    add(moments.W, tables.rim[slave.face], own, axes);
    const std::vector<double> phi =
        of_master.values(shapes, master.face, on_cell(master.face, at->xi));
    for (unsigned int j = 0; j < phi.size(); ++j)
    {
      std::vector<Tensor<1, 3>> &sums = row(j);
      sums.resize(3 * n);
      for (unsigned int d = 0; d < 3; ++d)
        for (unsigned int k = 0; k < n; ++k)
          sums[d * n + k] += psi[k] * phi[j] * direction(axes, d);
    }
  }
}

void CurvedMoments::finish()
{
  for (unsigned int row = 0; row < 3 * n; ++row)
  {
    for (unsigned int j = 0; j < moments.M.n(); ++j)
      moments.M(row, j) /= areas[row % n];
    for (unsigned int j = 0; j < moments.W.n(); ++j)
      moments.W(row, j) /= areas[row % n];
  }
  for (unsigned int k = 0; k < n; ++k)
    centroids[k] /= areas[k];
  moments.areas = areas;
  moments.M_inverse.reinit(moments.M.m(), moments.M.n());
  moments.M_inverse.invert(moments.M);
}

void Search::integrate(const ContactDofFace<3> &slave, const CellMap<3> &map,
                       const FacePlane &plane, const ConvexPolygon &polygon,
                       const unsigned int master)
{
  const CellMap<3> other = masters[master].map();
  const BoxTables<3> &own_tables = tables.of(slave.cell);
  const NodalPolynomials &of_master = polynomials[masters[master].tables];
  const unsigned int n = own_tables.degree + of_master.degree() - 1 +
                         std::max(more_points(map, slave.face),
                                  more_points(other, masters[master].face)),
                     n_dofs = own_tables.n_contact_dofs();
  std::vector<double> psi(n_dofs);
  for (const WeightedPoint &point : rule_on(polygon, n))
  {
    const Point<3> x = plane.point(point.x);
    const Point<3> own = reference_on(map, slave.face, x, slave.axes.normal),
                   there = reference_on(other, masters[master].face, x, slave.axes.normal);
    for (unsigned int k = 0; k < n_dofs; ++k)
    {
      psi[k] = point.weight * own_tables.psi(k, slave.face, own);
      areas[k] += psi[k];
    }
    const std::vector<double> phi = of_master.values(shapes[master], masters[master].face, there);
    for (unsigned int d = 0; d < phi.size(); ++d)
    {
      std::vector<double> &sums = integrals[{master, d}];
      sums.resize(n_dofs);
      for (unsigned int k = 0; k < n_dofs; ++k)
        sums[k] += psi[k] * phi[d];
    }
  }
}

template <class NodeOf>
OppositeFaces::Opposite Search::opposite(const ContactDofFace<3> &slave, const NodeOf &node_of)
{
  const CellMap<3> map = map_of<3>(slave.cell);
  const Side<3>::Piece piece = piece_of(map, slave.face);
  const FacesAcross &view = pieces.across(slave.axes);
  const FacePlane plane = view.plane_of(piece);
  const auto &pair =
      scene.pairs[*scene.boundaries[slave.cell->face(slave.face)->boundary_id()].pair];
  OppositeFaces::Opposite result;
  integrals.clear();
  areas.assign(tables.of(slave.cell).n_contact_dofs(), 0.);
  const double area = area_of(piece);
  double covered = 0;
  for (const FacesAcross::Part &part : view.opposite(piece,
                                                     [&](const unsigned int m) {
                                                       return masters[m].boundary ==
                                                                  pair.parts[0] ||
                                                              masters[m].boundary == pair.parts[1];
                                                     }))
  {
    covered += area_of(part.polygon);
    integrate(slave, map, plane, part.polygon, part.opposite);
    result.parts.push_back({part.opposite, {}, {}});
    for (const Point<2> &x : part.polygon)
      result.parts.back().corners.push_back(plane.point(x));
  }
  if (std::abs(covered / area - 1) > uncovered_share)
    throw_uncovered(slave, covered < area);
  std::map<unsigned int, unsigned int> rows; // by node
  for (const auto &[place, sums] : integrals)
  {
    const unsigned int node = node_of(place.first, place.second);
    const auto [row, is_new] = rows.emplace(node, result.rows.size());
    if (is_new)
      result.rows.push_back({node, std::vector<double>(areas.size(), 0.), {}});
    for (unsigned int k = 0; k < areas.size(); ++k)
      result.rows[row->second].moments[k] += sums[k] / areas[k];
  }
  return result;
}

template <class NodeOf>
OppositeFaces::Opposite Search::opposite_on_curve(const ContactDofFace<3> &slave,
                                                  const NodeOf &node_of)
{
  constexpr double least_covered = 0.9, most_covered = 1.01;
  const BoundaryCondition<3> &boundary =
      scene.boundaries[slave.cell->face(slave.face)->boundary_id()];
  const auto &sides = scene.pairs[*boundary.pair].sides;
  const unsigned int other = sides[sides[0] == boundary.side ? 1 : 0];
  OppositeFaces::Opposite result;
  CurvedMoments moments(tables.of(slave.cell), polynomials[tables.number_of(slave.cell)], slave,
                        boundary);
  std::map<unsigned int, unsigned int> rows; // by node
  if (surfaces)
    for (const FacesAcross::Part &part : surfaces->parts(
             curve_of(moments.map, slave.face), [&](const unsigned int f)
             { return scene.boundaries[masters[of_surfaces[f]].boundary].side == other; }))
    {
      const unsigned int m = of_surfaces[part.opposite];
      moments.integrate(part.polygon, (*surfaces)[part.opposite], masters[m],
                        polynomials[masters[m].tables], shapes[m],
                        [&](const unsigned int j) -> std::vector<Tensor<1, 3>> &
                        {
                          const unsigned int node = node_of(m, j);
                          const auto [row, is_new] = rows.emplace(node, result.rows.size());
                          if (is_new)
                            result.rows.push_back({node, {}, {}});
                          return result.rows[row->second].turned;
                        });
      result.parts.push_back({m, {}, part.polygon});
    }
  if (moments.covered < least_covered || moments.covered > most_covered)
    throw_uncovered(slave, moments.covered < 1);
  moments.finish();
  for (OppositeFaces::Row &row : result.rows)
    for (unsigned int i = 0; i < row.turned.size(); ++i)
      row.turned[i] /= moments.areas[i % moments.n];
  result.own.contact_dofs = std::make_shared<const FaceContactDofs>(moments.moments);
  for (const Tensor<1, 3> &x : moments.centroids)
    result.own.centroids.emplace_back(x);
  return result;
}
} // namespace

CellMap<3> MasterFace::map() const
{
  CellMap<3>::Vertices vertices;
  std::copy(corners.begin(), corners.end(), vertices.begin());
  return CellMap<3>(vertices);
}

OppositeFaces::OppositeFaces(const Scene<3> &scene, const DoFHandler<3> &dof_handler,
                             const DegreeTables<3> &tables,
                             const AffineConstraints<double> &constraints,
                             const std::vector<ContactDofFace<3>> &slaves,
                             const std::vector<bool> &master_boundaries)
    : tables(tables)
{
  MPI_Comm communicator = dof_handler.get_communicator();
  std::vector<MasterFace> all;
  for (auto &part : Utilities::MPI::all_gather(
           communicator, own_masters(scene, dof_handler, tables, constraints, master_boundaries)))
    all.insert(all.end(), part.begin(), part.end());
  collectively(communicator,
               [&]()
               {
                 std::map<types::global_dof_index, unsigned int> numbers; // of nodes
                 const auto node_of = [&](const unsigned int master, const unsigned int i)
                 {
                   const OppositeNode &node = all[master].nodes[i];
                   const auto [known, is_new] = numbers.emplace(node.first, nodes.size());
                   if (is_new)
                     nodes.push_back(node);
                   return known->second;
                 };
                 Search search(scene, tables, all);
                 std::map<unsigned int, unsigned int> kept; // of all masters
                 for (const ContactDofFace<3> &slave : slaves)
                 {
                   const auto &condition =
                       scene.boundaries[slave.cell->face(slave.face)->boundary_id()];
                   faces.emplace_back();
                   if (!condition.pair)
                     continue;
                   faces.back() = slave.is_curved() ? search.opposite_on_curve(slave, node_of)
                                                    : search.opposite(slave, node_of);
                   for (Part &part : faces.back().parts)
                   {
                     const auto [known, is_new] = kept.emplace(part.master, masters.size());
                     if (is_new)
                       masters.push_back(all[part.master]);
                     part.master = known->second;
                   }
                 }
               });
  number_nodes(dof_handler.locally_owned_dofs(), communicator);
}

void OppositeFaces::number_nodes(const IndexSet &owned, MPI_Comm communicator)
{
  std::set<types::global_dof_index> components, free;
  for (const OppositeNode &node : nodes)
    for (unsigned int c = 0; c < 3; ++c)
    {
      components.insert(node.first + c);
      for (const auto &[unknown, weight] : node.entries[c])
        free.insert(unknown);
    }
  of_nodes = std::make_unique<const FarValues>(
      owned, std::vector<types::global_dof_index>(components.begin(), components.end()),
      communicator);
  of_unknowns = std::make_unique<const FarValues>(
      owned, std::vector<types::global_dof_index>(free.begin(), free.end()), communicator);
  for (const MasterFace &master : masters)
  {
    maps.push_back(master.map());
    surfaces.push_back(curve_of(master));
    places.emplace_back();
    for (const OppositeNode &node : master.nodes)
      places.back().push_back(of_nodes->place(node.first));
  }
}

unsigned int OppositeFaces::nodal_place(const unsigned int node, const unsigned int component) const
{
  return of_nodes->place(nodes[node].first + component);
}

/** By the part in which x lies, or beside which by round-off. */
OppositeFaces::Place OppositeFaces::place(const unsigned int face, const Point<3> &x,
                                          const Tensor<1, 3> &normal) const
{
  const Part *nearest = nullptr;
  double outside = std::numeric_limits<double>::max();
  for (const Part &part : faces[face].parts)
  {
    // The corners go round the normal, or the other way round: the first turn says which.
    double beyond = 0, area = 0;
    const std::size_t n = part.corners.size();
    for (std::size_t k = 0; k < n; ++k)
      area += cross_product_3d(part.corners[k] - part.corners[0],
                               part.corners[(k + 1) % n] - part.corners[0]) *
              normal;
    for (std::size_t k = 0; k < n; ++k)
    {
      const Tensor<1, 3> edge = part.corners[(k + 1) % n] - part.corners[k];
      const double inside = cross_product_3d(edge, x - part.corners[k]) * normal;
      if (edge.norm() > 0)
        beyond = std::max(beyond, (area > 0 ? -inside : inside) / edge.norm());
    }
    if (beyond < outside)
    {
      outside = beyond;
      nearest = &part;
    }
  }
  AssertThrow(nearest, ExcMessage("Nothing lies opposite to a face of a slave."));
  const unsigned int master = nearest->master;
  return {master, reference_on(maps[master], masters[master].face, x, normal)};
}

std::vector<OppositeFaces::PartPoint> OppositeFaces::points_of(const Part &part,
                                                               const ContactDofFace<3> &slave,
                                                               const unsigned int n) const
{
  if (slave.is_curved())
    return points_on_curve(part, slave, n);
  const FacePlane plane{part.corners[0], slave.axes};
  const Tensor<1, 3> &normal = slave.axes.normal;
  const CellMap<3> own = map_of<3>(slave.cell);
  ConvexPolygon polygon;
  for (const Point<3> &corner : part.corners)
    polygon.push_back(plane.at(corner));
  std::vector<PartPoint> result;
  for (const WeightedPoint &point : rule_on(polygon, n))
  {
    const Point<3> x = plane.point(point.x);
    result.push_back({reference_on(own, slave.face, x, normal), std::abs(point.weight),
                      reference_on(maps[part.master], masters[part.master].face, x, normal)});
  }
  return result;
}

std::vector<OppositeFaces::PartPoint> OppositeFaces::points_on_curve(const Part &part,
                                                                     const ContactDofFace<3> &slave,
                                                                     const unsigned int n) const
{
  const CellMap<3> map = map_of<3>(slave.cell);
  std::vector<PartPoint> result;
  for (const WeightedPoint &point : rule_on(part.polygon, n))
  {
    const Point<3> own = on_cell(slave.face, point.x);
    if (const auto at = meeting(surfaces[part.master], map.point(own), map.normal(slave.face, own),
                                beyond_part))
      result.push_back({own, point.weight * map.face_measure(slave.face, own),
                        on_cell(masters[part.master].face, at->xi)});
  }
  return result;
}

namespace
{
/** Of a point from a polygon: 0 inside. */
double distance(const ConvexPolygon &polygon, const Point<2> &x)
{
  bool is_inside = false;
  double result = std::numeric_limits<double>::max();
  for (unsigned int k = 0; k < polygon.size(); ++k)
  {
    const Point<2> &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    if ((a[1] > x[1]) != (b[1] > x[1]) &&
        x[0] < a[0] + (x[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
      is_inside = !is_inside;
    const Tensor<1, 2> way = b - a;
    const double s = way.norm() > 0 ? std::clamp((x - a) * way / way.norm_square(), 0., 1.) : 0.;
    result = std::min(result, (x - (a + s * way)).norm());
  }
  return is_inside ? 0 : result;
}
} // namespace

OppositeFaces::Place OppositeFaces::place_on_curve(const unsigned int face, const CellMap<3> &map,
                                                   const unsigned int face_no,
                                                   const Point<3> &own) const
{
  const Point<2> xi = on_curve(face_no, own);
  std::vector<std::pair<double, unsigned int>> nearest; // distance and part
  for (unsigned int p = 0; p < faces[face].parts.size(); ++p)
    nearest.emplace_back(distance(faces[face].parts[p].polygon, xi), p);
  std::sort(nearest.begin(), nearest.end());
  const Point<3> x = map.point(own);
  const Tensor<1, 3> normal = map.normal(face_no, own);
  for (const auto &[distance, p] : nearest)
  {
    const unsigned int master = faces[face].parts[p].master;
    if (const auto at = meeting(surfaces[master], x, normal, beyond_part))
      return {master, on_cell(masters[master].face, at->xi)};
  }
  AssertThrow(false, ExcMessage("Nothing lies opposite to a point of a face of a slave."));
  return {};
}

Tensor<1, 3> OppositeFaces::displacement(const Place &place,
                                         const std::vector<double> &values) const
{
  const unsigned int face = masters[place.master].face;
  const BoxTables<3> &tables = this->tables.all[masters[place.master].tables];
  Tensor<1, 3> result;
  unsigned int i = 0;
  for (const auto *const shapes : {&tables.rim[face], &tables.inner[face]}) // the order of nodes
    for (const unsigned int shape : *shapes)
    {
      const double phi = tables.fe.shape_value(tables.numbers[shape][0], place.reference);
      for (unsigned int c = 0; c < 3; ++c)
        result[c] += phi * values[places[place.master][i] + c];
      ++i;
    }
  return result;
}
} // namespace hpvi
