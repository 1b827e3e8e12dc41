// SPDX-License-Identifier: LGPL-2.1-or-later

// In an hp space two things break continuity. Neighbours of different degree have different
// polynomials on their common edge; and where one cell has been bisected and its neighbour has not,
// two short edges face a long one, whose polynomial does not have a node at their middle. The
// remedy is the <i>minimum rule</i>: along such an edge, the trace is one polynomial of the lowest
// degree that any cell at the edge has, and all else follows.
//
// deal.II has constraints for this. They describe the same space, but when the larger cell has the
// higher degree they extrapolate from the halves to the whole, with weights that reach thousands at
// $p = 14$ and lift round-off accordingly. Here the master is the whole edge, which leaves weights
// near one.
#include <hpvi/plane/edge_constraints.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
using Unknowns = std::vector<types::global_dof_index>;

// @sect3{One edge after the other}
//
// Three cases. The neighbour is refined: a hanging edge, seen from the larger cell. The neighbour
// is of the same size and of a lower degree: it is the master, and this cell follows. Else nothing
// is to be done here: the edge conforms, or is looked at from the other side.
/** Adds the constraints of one edge after the other. */
class EdgeConstraints
{
public:
  EdgeConstraints(const DofNumbering<2> &numbering, const ShapeTables<2> &tables,
                  AffineConstraints<double> &constraints)
      : numbering(numbering), tables(tables), constraints(constraints)
  {
  }

  using Cell = Triangulation<2>::active_cell_iterator;

  void add(const Cell &cell, const unsigned int face)
  {
    const auto neighbor = cell->neighbor(face);
    if (neighbor->has_children())
      add_hanging(cell, face);
    else if (!cell->neighbor_is_coarser(face) && degree(neighbor) < degree(cell))
      bind(cell, face, whole_edge, unknowns(neighbor, cell->neighbor_face_no(face)),
           degree(neighbor), degree(neighbor));
  }

private:
  unsigned int degree(const Cell &cell) const
  {
    return numbering.degrees()[cell->active_cell_index()];
  }

  /** Unknowns of one edge, component by component, each in the direction of the edge. */
  Unknowns unknowns(const Cell &cell, const unsigned int face) const
  {
    const auto dofs = numbering.cell_dofs(cell->active_cell_index());
    Unknowns result;
    for (const unsigned int i : tables.numbering(degree(cell)).edge[face])
      result.push_back(dofs[i]);
    return result;
  }

  /** The larger cell and its two smaller neighbours follow one polynomial along the whole edge. */
  void add_hanging(const Cell &cell, const unsigned int face)
  {
    const unsigned int neighbor_face = cell->neighbor_face_no(face);
    unsigned int lowest = degree(cell);
    for (unsigned int half = 0; half < 2; ++half)
      lowest = std::min(lowest, degree(cell->neighbor_child_on_subface(face, half)));
    const Unknowns all = unknowns(cell, face);
    if (lowest < degree(cell))
      bind(cell, face, whole_edge, all, degree(cell), lowest);
    for (unsigned int half = 0; half < 2; ++half)
      bind(cell->neighbor_child_on_subface(face, half), neighbor_face, half, all, degree(cell),
           lowest);
  }

  /**
   * Express the unknowns of @p cell on @p face, which is @p part of the edge with unknowns
   * @p sources of degree @p source_degree, by the polynomial of degree @p trace_degree there.
   */
  void bind(const Cell &cell, const unsigned int face, const unsigned int part,
            const Unknowns &sources, const unsigned int source_degree,
            const unsigned int trace_degree)
  {
    const EdgeInterpolation &interpolation =
        tables.edge_interpolation(source_degree, trace_degree, degree(cell), part);
    const Unknowns targets = unknowns(cell, face);
    const unsigned int n_targets = targets.size() / 2, n_sources = sources.size() / 2;
    for (unsigned int c = 0; c < 2; ++c)
      for (unsigned int i = 0; i < n_targets; ++i)
      {
        const types::global_dof_index target = targets[c * n_targets + i];
        // Ends of the edge and coinciding nodes are one unknown for both cells, and the node in
        // the middle of a hanging edge belongs to two smaller cells.
        if (constraints.is_constrained(target) ||
            is_source(target, c * n_sources, sources, interpolation))
          continue;
        constraints.add_line(target);
        for (unsigned int j = 0; j < interpolation.nodes.size(); ++j)
          if (std::abs(interpolation.weights(i, j)) > 1e-15)
            constraints.add_entry(target, sources[c * n_sources + interpolation.nodes[j]],
                                  interpolation.weights(i, j));
      }
  }

  static bool is_source(const types::global_dof_index unknown, const unsigned int first,
                        const Unknowns &sources, const EdgeInterpolation &interpolation)
  {
    return std::any_of(interpolation.nodes.begin(), interpolation.nodes.end(),
                       [&](const unsigned int node) { return sources[first + node] == unknown; });
  }

  const DofNumbering<2> &numbering;
  const ShapeTables<2> &tables;
  AffineConstraints<double> &constraints;
};
} // namespace

// @sect3{All edges}
//
// Nothing depends on the order in which cells are visited, except which of several equivalent
// unknowns is called the free one.
void constrain_hanging_nodes(const DofNumbering<2> &numbering, const ShapeTables<2> &tables,
                             AffineConstraints<double> &constraints)
{
  EdgeConstraints edges(numbering, tables, constraints);
  for (const auto &cell : numbering.dof_handler().get_triangulation().active_cell_iterators())
    if (!cell->is_artificial())
      for (const unsigned int face : cell->face_indices())
        if (!cell->at_boundary(face))
          edges.add(cell, face);
}
} // namespace hpvi
