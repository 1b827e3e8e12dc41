// SPDX-License-Identifier: LGPL-2.1-or-later

// A body may have curved edges: named ones of its boundary, and interfaces of materials. All other
// edges are straight, also those that bisection makes. A cell is the blend of its four edges after
// Gordon and Hall, the bilinear map and of each curved edge its departure from the chord, fading
// away linearly towards the edge opposite.
//
// A curved edge is the polynomial through its curve of the degree that the displacement has there,
// by the minimum rule. So each component of the map is a function of the space $V_N$: rigid motions
// are in it and strain nothing, and moments balance to round-off. A map of lower degree would spoil
// the order of convergence, an exact one would put a spurious spring on every rotation.
#include <hpvi/plane/curved_edges.h>

#include <algorithm>
#include <mutex>

namespace hpvi
{
using namespace dealii;

using Cell = Triangulation<2>::cell_iterator;

CurveManifold::CurveManifold(const CurvePiece &piece) : piece(piece)
{
}

std::unique_ptr<Manifold<2>> CurveManifold::clone() const
{
  return std::make_unique<CurveManifold>(piece);
}

Point<2> CurveManifold::get_new_point(const ArrayView<const Point<2>> &points,
                                      const ArrayView<const double> &weights) const
{
  double s = 0;
  for (unsigned int k = 0; k < points.size(); ++k)
    s += weights[k] * piece.nearest(points[k]);
  return piece.point(s);
}

// @sect3{From the coarse mesh to the triangulation}
//
// deal.II numbers the vertices of cells as it likes, but keeps the numbers of cells and vertices.
void attach_curves(const CoarseMesh &coarse, Triangulation<2> &triangulation)
{
  std::map<std::array<unsigned int, 2>, CurvePiece> curves;
  for (const CoarseMesh::Edge &edge : coarse.edges)
    if (edge.curve)
    {
      curves[edge.vertices] = edge.curve;
      curves[{{edge.vertices[1], edge.vertices[0]}}] = edge.curve.between(1, 0);
    }
  types::manifold_id id = 0;
  for (const auto &cell : triangulation.active_cell_iterators())
    for (const unsigned int f : cell->face_indices())
    {
      const auto found =
          curves.find({{cell->vertex_index(GeometryInfo<2>::face_to_cell_vertices(f, 0)),
                        cell->vertex_index(GeometryInfo<2>::face_to_cell_vertices(f, 1))}});
      if (found == curves.end() || cell->face(f)->manifold_id() != numbers::flat_manifold_id)
        continue;
      triangulation.set_manifold(id, CurveManifold(found->second));
      cell->face(f)->set_manifold_id(id++);
    }
}

// @sect3{One edge}
//
// Which part of the curve an edge has follows from its cell: each ancestor halves the parameter.
double on_coarse_edge(Cell cell, const unsigned int face, double s)
{
  for (; cell->level() > 0; cell = cell->parent())
  {
    unsigned int child = 0;
    while (cell->parent()->child(child) != cell)
      ++child;
    s = (s + (child >> (1 - face / 2) & 1)) / 2;
  }
  return s;
}

namespace
{
constexpr unsigned int without_degrees = 12; ///< of a mesh that is only looked at

/** Null where the edge is straight, or has a manifold of another kind. */
const CurveManifold *manifold_of(const Cell &cell, const unsigned int face)
{
  const types::manifold_id id = cell->face(face)->manifold_id();
  return id == numbers::flat_manifold_id
             ? nullptr
             : dynamic_cast<const CurveManifold *>(&cell->get_triangulation().get_manifold(id));
}

bool is_curved(const Cell &cell, const unsigned int face)
{
  return manifold_of(cell, face) != nullptr;
}

CurvePiece curve_along(const Cell &cell, const unsigned int face)
{
  return manifold_of(cell, face)
      ->piece.between(on_coarse_edge(cell, face, 0), on_coarse_edge(cell, face, 1));
}

/** deal.II takes down of what type user data are, also where they are read: one thread at a time. */
unsigned int degree_of(const Cell &cell)
{
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  return cell->user_index() > 0 && cell->is_active() ? cell->user_index() : without_degrees;
}

/** Of the displacement along the edge, seen from the larger of its cells. */
unsigned int edge_degree(const Cell &cell, const unsigned int face)
{
  unsigned int lowest = degree_of(cell);
  if (cell->at_boundary(face) || !cell->is_active())
    return lowest;
  const Cell neighbor = cell->neighbor(face);
  if (neighbor->is_active())
    return std::min(lowest, degree_of(neighbor));
  for (unsigned int half = 0; half < 2; ++half)
    lowest = std::min(lowest, degree_of(cell->neighbor_child_on_subface(face, half)));
  return lowest;
}

Point<2> end_of(const Cell &cell, const unsigned int face, const unsigned int end)
{
  return cell->vertex(GeometryInfo<2>::face_to_cell_vertices(face, end));
}

/** Of an edge that is no half of another one. */
EdgeBlend whole_blend(const Cell &cell, const unsigned int face)
{
  const CurvePiece curve = curve_along(cell, face);
  return EdgeBlend(
      curve, [&](const double s) { return curve.point(s); }, end_of(cell, face, 0),
      end_of(cell, face, 1), edge_degree(cell, face));
}

/** Of the point in the middle of a hanging edge, seen from its larger cell. */
Point<2> middle_of(const Cell &cell, const unsigned int face)
{
  return end_of(cell, face, 0) + (end_of(cell, face, 1) - end_of(cell, face, 0)) / 2. +
         whole_blend(cell, face)(0.5)[0];
}

bool is_half(const Cell &cell, const unsigned int face)
{
  return cell->is_active() && !cell->at_boundary(face) && cell->neighbor_is_coarser(face);
}

/** Of a half of a hanging edge: the polynomial is that of the whole. */
EdgeBlend half_blend(const Cell &cell, const unsigned int face)
{
  const Cell larger = cell->neighbor(face);
  const auto [other_face, half] = cell->neighbor_of_coarser_neighbor(face);
  const EdgeBlend whole = whole_blend(larger, other_face);
  const Point<2> begin = end_of(larger, other_face, 0);
  const Tensor<1, 2> chord = end_of(larger, other_face, 1) - begin;
  return EdgeBlend(
      curve_along(cell, face),
      [&, half = half](const double s)
      {
        const double t = (s + half) / 2;
        return begin + t * chord + whole(t)[0];
      },
      end_of(cell, face, 0), end_of(cell, face, 1), edge_degree(larger, other_face));
}
} // namespace

std::shared_ptr<const EdgeBlends> blends_of(const Cell &cell)
{
  std::shared_ptr<EdgeBlends> result;
  for (const unsigned int f : cell->face_indices())
    if (is_curved(cell, f))
    {
      if (!result)
        result = std::make_shared<EdgeBlends>();
      (*result)[f] = is_half(cell, f) ? half_blend(cell, f) : whole_blend(cell, f);
    }
  return result;
}

// @sect3{Degrees}
//
// They change from step to step, and the body with them, by as little as the curve differs from its
// polynomial. Vertices lie on the curve, but in the middle of a hanging edge.
void set_edge_degrees(Triangulation<2> &triangulation, const std::vector<unsigned int> &degrees)
{
  for (const auto &cell : triangulation.active_cell_iterators())
    cell->set_user_index(degrees[cell->active_cell_index()]);
  for (const bool hanging : {false, true})
    for (const auto &cell : triangulation.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
      {
        if (!is_curved(cell, f) || cell->at_boundary(f))
          continue;
        if (const CurvePiece curve = curve_along(cell, f); !hanging)
          for (const unsigned int end : {0, 1})
            cell->vertex(GeometryInfo<2>::face_to_cell_vertices(f, end)) = curve.point(end);
        else if (cell->face(f)->has_children())
          cell->face(f)->child(0)->vertex(1) = middle_of(cell, f);
      }
}

EdgePlaces::EdgePlaces(const CoarseMesh &coarse)
{
  for (unsigned int e = 0; e < coarse.edges.size(); ++e)
    edges[coarse.edges[e].vertices] = e;
}

EdgePlace EdgePlaces::operator()(const Cell &cell, const unsigned int face) const
{
  Cell coarse = cell;
  while (coarse->level() > 0)
    coarse = coarse->parent();
  const std::array<unsigned int, 2> ends{
      {coarse->vertex_index(GeometryInfo<2>::face_to_cell_vertices(face, 0)),
       coarse->vertex_index(GeometryInfo<2>::face_to_cell_vertices(face, 1))}};
  EdgePlace result;
  result.from = on_coarse_edge(cell, face, 0);
  result.to = on_coarse_edge(cell, face, 1);
  if (const auto along = edges.find(ends); along != edges.end())
    result.edge = along->second;
  else if (const auto against = edges.find({{ends[1], ends[0]}}); against != edges.end())
  {
    result.edge = against->second;
    result.from = 1 - result.from;
    result.to = 1 - result.to;
  }
  return result;
}
} // namespace hpvi
