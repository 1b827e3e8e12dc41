// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/bound/cell_constants.h>
#include <hpvi/bound/edge_polynomial.h>
#include <hpvi/bound/vertex_patches.h>
#include <hpvi/plane/matching.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Has it right angles, and edges along xi that are so for its neighbours, too? */
bool is_in_rows_of_rectangles(const DoFHandler<2>::active_cell_iterator &cell)
{
  const Tensor<2, 2> J = map_of<2>(cell).jacobian({0.5, 0.5});
  if (std::abs(J[0][0] * J[0][1] + J[1][0] * J[1][1]) > 1e-10 * J.norm_square())
    return false;
  for (const unsigned int f : cell->face_indices())
    if (!cell->at_boundary(f) &&
        (f < 2) != ((cell->neighbor_is_coarser(f) ? cell->neighbor_of_coarser_neighbor(f).first
                                                  : cell->neighbor_face_no(f)) < 2))
      return false;
  return true;
}
} // namespace

bool has_distorted_cells(const Solution<2> &solution)
{
  // Stresses of parallelograms share shears at corners, and know rows and columns of them alone; those of two bodies have
  // no angle in common but the right one.
  const Geometry<2> &geometry = solution.scene.geometry;
  if (geometry.has_mesh() && geometry.bodies.empty())
    return true;
  for (const auto &cell : solution.displacement_space.dof_handler().active_cell_iterators())
    if (!map_of<2>(cell).is_affine() || (geometry.has_mesh() && !is_in_rows_of_rectangles(cell)))
      return true;
  return false;
}

bool has_long_cells(const Solution<2> &solution)
{
  constexpr double longest = 4 * (1 + 1e-6); // the same for 4 : 1 in all frames
  for (const auto &cell : solution.displacement_space.dof_handler().active_cell_iterators())
  {
    const Tensor<2, 2> J = map_of<2>(cell).jacobian({0.5, 0.5});
    // With singular values a and b: (a^2 + b^2)/(a b)
    if (J.norm_square() > (longest + 1 / longest) * std::abs(determinant(J)))
      return true;
  }
  return false;
}

namespace
{
const BoundaryCondition<2> &condition_of(const StressEdge &edge, const Solution<2> &solution)
{
  return solution.scene.boundaries[edge.boundary];
}

/** Of the cell of the body opposite: which way its edge runs, and how its own normal is turned. */
std::pair<unsigned int, double> placed(const StressEdge &edge, const ContactSegment<2> &opposite)
{
  const auto face = opposite.cell->face(opposite.face_no);
  const Tensor<1, 2> along = face->vertex(1) - face->vertex(0);
  const double turn = opposite.face_no < 2 ? 1. : -1.;
  const bool is_reversed = along * edge.tangent < 0.,
             is_turned = Tensor<1, 2>({turn * along[1], -turn * along[0]}) * edge.normal < 0.;
  return {is_reversed ? reversed_edge : whole_edge, is_reversed == is_turned ? 1. : -1.};
}
} // namespace

VertexPatches::VertexPatches(const Solution<2> &solution, const bool has_rows,
                             const JointTractions *const joints)
    : has_rows(has_rows)
{
  collect_edges(solution, joints);
  for (StressEdge &edge : all_edges)
    set_components(solution.scene, edge);
  join_vertices();
  set_hats(solution);
}

void VertexPatches::collect_edges(const Solution<2> &solution, const JointTractions *const joints)
{
  const Degrees &degrees = solution.displacement_space.degrees();
  all_cells.resize(degrees.size());
  all_edges.reserve(3 * degrees.size());
  std::map<std::pair<unsigned int, unsigned int>, unsigned int> contact;
  const auto &contact_faces = solution.contact_space.faces();
  std::set<std::pair<unsigned int, unsigned int>>
      opposite; // faces that others have as their second side
  for (unsigned int f = 0; f < contact_faces.size(); ++f)
  {
    contact[{contact_faces[f].cell->active_cell_index(), contact_faces[f].face_no}] = f;
    for (const ContactSegment<2> &segment : contact_faces[f].segments)
      if (!joints)
        opposite.insert({segment.cell->active_cell_index(), segment.face_no});
  }
  for (const auto &cell : solution.displacement_space.dof_handler().active_cell_iterators())
    for (unsigned int f = 0; f < 4; ++f)
    {
      const unsigned int index = cell->active_cell_index();
      const bool at_boundary = cell->at_boundary(f);
      if (at_boundary
              ? opposite.count({index, f}) > 0
              : cell->neighbor_is_coarser(f) || (!cell->face(f)->has_children() &&
                                                 cell->neighbor(f)->active_cell_index() < index))
        continue; // seen from the other side
      StressEdge edge;
      edge.vertices = {{cell->face(f)->vertex_index(0), cell->face(f)->vertex_index(1)}};
      edge.sides.push_back({index, f, whole_edge});
      if (at_boundary)
      {
        edge.boundary = cell->face(f)->boundary_id();
        const auto found = contact.find({index, f});
        if (found != contact.end())
        {
          edge.contact_face = found->second;
          edge.degree =
              traction_degree(contact_faces[found->second], solution.z, solution.contact_space) + 2;
        }
        if (const JointEdge *const joint = joints ? joints->edge(index, f) : nullptr)
        {
          // where V holds the normal displacement there is no multiplier along it
          edge.is_given = !condition_of(edge, solution).holds_normal();
          // with hat functions and the radius, since its ends on an axis have to be met exactly
          edge.degree = std::max(edge.degree, joints->degree(*joint) +
                                                  (solution.scene.is_axisymmetric() ? 3 : 2));
        }
      }
      else if (cell->face(f)->has_children())
      {
        for (unsigned int part = 0; part < 2; ++part)
          edge.sides.push_back({cell->neighbor_child_on_subface(f, part)->active_cell_index(),
                                cell->neighbor_face_no(f), part});
        hanging[cell->face(f)->child(0)->vertex_index(1)] = edge.vertices;
      }
      else
        edge.sides.push_back(
            {cell->neighbor(f)->active_cell_index(), cell->neighbor_face_no(f), whole_edge});
      const Tensor<1, 2> along = cell->face(f)->vertex(1) - cell->face(f)->vertex(0);
      edge.length = along.norm();
      const CellMap<2> map = map_of<2>(cell);
      edge.is_curved = map.is_curved() && map.blends()[f];
      edge.is_on_axis = solution.scene.is_axisymmetric() && axis_face(map) == f;
      edge.tangent = along / edge.length;
      const double turn = f < 2 ? 1. : -1.;
      edge.normal[0] = turn * edge.tangent[1];
      edge.normal[1] = -turn * edge.tangent[0];
      const Tensor<1, 2> across = cell->vertex(f < 2 ? 1 : 2) - cell->vertex(0);
      if (!has_rows && std::abs(across * edge.tangent) >
                           1e-10 * across.norm()) // or round-off, far from the origin
        edge.skew = (across * edge.tangent) / (across * edge.normal);
      if (!joints && edge.contact_face != numbers::invalid_unsigned_int)
        if (const ContactSegment<2> *const other =
                whole_face_opposite(contact_faces[edge.contact_face]))
        {
          const auto [part, turn] = placed(edge, *other);
          edge.sides.push_back({other->cell->active_cell_index(), other->face_no, part});
          for (unsigned int end = 0; end < 2; ++end)
            edge.vertices_opposite[end] = other->cell->face(other->face_no)
                                              ->vertex_index(part == reversed_edge ? 1 - end : end);
          all_cells[edge.sides[1].cell].turns[other->face_no] = turn;
        }
      for (const StressEdge::Side &side : edge.sides)
      {
        edge.degree = std::max(edge.degree, degrees[side.cell] + 2);
        all_cells[side.cell].edges[side.face] = all_edges.size();
        all_cells[side.cell].parts[side.face] = side.part;
        if (!at_boundary)
          all_cells[side.cell].turns[side.face] = (side.face < 2) == (f < 2) ? 1. : -1.;
      }
      all_edges.push_back(edge);
    }
}

/** Along normal and tangent, but along x and y where one of these displacements alone is prescribed. */
void VertexPatches::set_directions(const Scene<2> &scene, StressEdge &edge) const
{
  auto &[one, other] = edge.components;
  one = {edge.normal, 0, true};
  other = {edge.tangent, 0, true};
  if (!edge.at_boundary())
    return;
  const BoundaryCondition<2> &condition = scene.boundaries[edge.boundary];
  if (edge.is_on_axis)
  {
    one.is_unknown = other.is_unknown = false;
    return;
  }
  if (edge.is_given)
    one.is_unknown = other.is_unknown = false;
  else if (condition.has_contact())
  {
    one.is_unknown = condition.contact == Contact::bilateral || condition.is_tied();
    other.is_unknown = condition.is_tied();
  }
  if (edge.is_given || condition.has_contact() || condition.plate)
    return;
  if (condition.symmetry)
  {
    other.is_unknown = false;
    return;
  }
  const std::array<bool, 2> held{
      {bool(condition.displacement[0]), bool(condition.displacement[1])}};
  const bool axis_parallel = std::min(std::abs(edge.normal[0]), std::abs(edge.normal[1])) < 1e-12;
  if (edge.is_curved || (held[0] != held[1] && !axis_parallel))
  {
    one = {Tensor<1, 2>({1., 0.}), 0, held[0]};
    other = {Tensor<1, 2>({0., 1.}), 0, held[1]};
    return;
  }
  for (auto &component : edge.components)
    component.is_unknown = held[std::abs(component.direction[1]) > 0.5];
}

/**
 * A component of degree 2 has three coefficients. Where one is unknown and the other is not, and shears depend on more than
 * the tangential one, four are needed: for force and moment, and for both ends.
 */
void VertexPatches::set_components(const Scene<2> &scene, StressEdge &edge) const
{
  set_directions(scene, edge);
  auto &[one, other] = edge.components;
  const bool along_edge = one.direction == edge.normal;
  if (!has_rows && one.is_unknown != other.is_unknown && (edge.skew != 0. || !along_edge))
    edge.degree = std::max(edge.degree, 5U);
  one.n = has_rows ? edge.degree : edge.degree - 1;
  other.n = along_edge ? edge.degree : one.n;
}

/** Where an unknown traction goes from one body to the other, both have the hat functions of the same vertices. */
void VertexPatches::join_vertices()
{
  const auto first_of = [&](unsigned int vertex)
  {
    for (auto next = joined.find(vertex); next != joined.end(); next = joined.find(vertex))
      vertex = next->second;
    return vertex;
  };
  for (const StressEdge &edge : all_edges)
    if (edge.joins_bodies())
      for (unsigned int end = 0; end < 2; ++end)
      {
        const unsigned int own = first_of(edge.vertices[end]),
                           other = first_of(edge.vertices_opposite[end]);
        if (own != other)
          joined[other] = own;
      }
}

const std::map<unsigned int, double> &VertexPatches::expand(const unsigned int vertex)
{
  if (const auto one = joined.find(vertex); one != joined.end())
    return expand(one->second);
  const auto known = values.find(vertex);
  if (known != values.end())
    return known->second;
  std::map<unsigned int, double> result;
  const auto found = hanging.find(vertex);
  if (found == hanging.end())
    result[vertex] = 1.;
  else
    for (const unsigned int end : found->second)
      for (const auto &[a, value] : expand(end))
        result[a] += 0.5 * value;
  return values[vertex] = result;
}

void VertexPatches::set_hats(const Solution<2> &solution)
{
  all_hats.reserve(5 * all_cells.size());
  std::vector<std::size_t> first; // hat of a cell
  const auto add = [&](const unsigned int a, const unsigned int v, const double value)
  {
    auto hat = std::find_if(all_hats.begin() + first.back(), all_hats.end(),
                            [a](const Hat &other) { return other.vertex == a; });
    if (hat == all_hats.end())
      hat = all_hats.insert(hat, {a, {{0., 0., 0., 0.}}});
    hat->values[v] = value;
  };
  for (const auto &cell : solution.displacement_space.dof_handler().active_cell_iterators())
  {
    all_cells[cell->active_cell_index()].iterator = cell;
    all_cells[cell->active_cell_index()].has_rows = has_rows;
    first.push_back(all_hats.size());
    for (unsigned int v = 0; v < 4; ++v)
      if (const unsigned int vertex = cell->vertex_index(v);
          hanging.count(vertex) == 0 && joined.count(vertex) == 0)
        add(vertex, v, 1.);
      else
        for (const auto &[a, value] : expand(vertex))
          add(a, v, value);
  }
  first.push_back(all_hats.size());
  for (unsigned int k = 0; k < all_cells.size(); ++k)
    all_cells[k].hats = {all_hats.data() + first[k], first[k + 1] - first[k]};
  set_patches(solution.displacement_space.triangulation().n_vertices());
}

/** Those of the hats that there are. */
void VertexPatches::set_patches(const unsigned int n_vertices)
{
  std::vector<unsigned int> first(n_vertices + 1, 0);
  for (const Hat &hat : all_hats)
    ++first[hat.vertex + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  cells_of_patches.resize(all_hats.size());
  for (unsigned int vertex = 0; vertex < n_vertices; ++vertex)
    if (first[vertex] < first[vertex + 1])
      all_patches.push_back(
          {vertex, {cells_of_patches.data() + first[vertex], first[vertex + 1] - first[vertex]}});
  for (unsigned int cell = 0; cell < all_cells.size(); ++cell)
    for (unsigned int hat = 0; hat < all_cells[cell].hats.size(); ++hat)
      cells_of_patches[first[all_cells[cell].hats[hat].vertex]++] = {cell, hat};
}

const std::vector<StressEdge> &VertexPatches::edges() const
{
  return all_edges;
}

const std::vector<VertexPatches::Cell> &VertexPatches::cells() const
{
  return all_cells;
}

const std::vector<VertexPatches::Patch> &VertexPatches::patches() const
{
  return all_patches;
}
} // namespace hpvi
