// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_vertex_patches_h
#define hpvi_vertex_patches_h

#include <deal.II/base/array_view.h>
#include <hpvi/bound/joint_tractions.h>

#include <boost/container/static_vector.hpp>

#include <array>
#include <map>
#include <vector>

namespace hpvi
{
/** Are there cells that are no parallelograms? */
bool has_distorted_cells(const Solution<2> &solution);

/**
 * Is the largest stretch of the map of any cell more than four times the smallest? A hat function times a bent
 * displacement has up to (L/t)^2 times its energy: doc/bound.md.
 */
bool has_long_cells(const Solution<2> &solution);

/** The part of an edge that a cell of the body opposite has, whose reference coordinate runs the other way. */
constexpr unsigned int reversed_edge = 2;

/**
 * One edge of the mesh with the traction `s n` of an equilibrated stress on it; where bodies touch one of both. Along a curved edge x(s) it is
 * `s n |x'(s)|/length`, a polynomial of s where the stress is by rows.
 */
struct StressEdge
{
  /** A cell at the edge; the smaller ones at a hanging node see a half of it; at the boundary that of the body opposite. */
  struct Side
  {
    unsigned int cell, face;
    unsigned int part; ///< 0, 1, whole_edge or reversed_edge
  };

  /** The traction in one direction: a polynomial with @p n coefficients. */
  struct Component
  {
    dealii::Tensor<1, 2> direction;
    unsigned int n;
    bool is_unknown; ///< else loads or contact prescribe it
  };

  std::array<unsigned int, 2> vertices; ///< along the reference coordinate
  std::array<unsigned int, 2>
      vertices_opposite{}; ///< likewise those of the body opposite, if there is one
  boost::container::static_vector<Side, 3> sides; ///< that of the whole edge first
  unsigned int degree = 0; ///< m: normal part in P_{m-2}, tangential part in P_{m-1}
  double length;           ///< between its ends [length]
  bool is_curved = false;
  bool is_on_axis = false; ///< of a body of revolution: without tractions
  dealii::Tensor<1, 2>
      normal; ///< of the traction and the line between the ends: towards growing xi or eta
  dealii::Tensor<1, 2> tangent;
  double skew =
      0; ///< of a parallelogram's sides: the shear in its frame is `S_xy = T_t - skew T_n`
  dealii::types::boundary_id boundary = dealii::numbers::invalid_boundary_id;
  unsigned int contact_face = dealii::numbers::invalid_unsigned_int; ///< of ContactSpace::faces()
  bool is_given = false;                                             ///< by JointTractions
  std::array<Component, 2> components;                               ///< orthogonal directions

  bool at_boundary() const
  {
    return boundary != dealii::numbers::invalid_boundary_id;
  }

  /** Do both bodies that touch along it have a part of the traction in common that is unknown? */
  bool joins_bodies() const
  {
    return at_boundary() && sides.size() == 2 &&
           (components[0].is_unknown || components[1].is_unknown);
  }

  /** Weight of a component in S_xy, which corners have from both of their edges. */
  double weight_in_shear(const Component &component) const
  {
    return component.direction * tangent - skew * (component.direction * normal);
  }
};

/**
 * The edges of a mesh and the hat functions psi_a of its regular vertices: bilinear on each cell,
 * continuous, so that a hanging node has the mean of the ends of its edge. `sum_a psi_a = 1`, and the
 * patch of a is where psi_a does not vanish.
 *
 * Two bodies that touch have whole edges opposite to each other. Where they hand over an unknown traction
 * their vertices are one, psi_a is continuous from body to body, and so are patches. With JointTractions each body is for itself.
 */
class VertexPatches
{
public:
  /**
   * For stresses by rows both parts are in P_{m-1}, and corners ask for nothing. @p joints: tractions along all contacts are given by
   * these; null: they are not.
   */
  VertexPatches(const Solution<2> &solution, bool has_rows, const JointTractions *joints);

  VertexPatches(const VertexPatches &) = delete; // cells and patches refer to hats
  VertexPatches &operator=(const VertexPatches &) = delete;

  const bool has_rows;

  /** psi_a on one cell. */
  struct Hat
  {
    unsigned int vertex;          ///< a
    std::array<double, 4> values; ///< at the vertices of the cell
  };

  struct Cell
  {
    dealii::DoFHandler<2>::active_cell_iterator iterator;
    std::array<unsigned int, 4> edges, parts; ///< by face
    dealii::ArrayView<const Hat> hats;
    bool has_rows =
        false; ///< are components of its tractions along x and y, in place of normal and tangential ones?
    /** 1, or -1 where one of the cells at an edge has it along xi and the other along eta: its own normal is that of the edge turned. */
    std::array<double, 4> turns{{1., 1., 1., 1.}};

    /** Of a component in the normal (0) or tangential (1) traction in the cell's own frame, or along x or y; a turned normal turns the traction, too. */
    double weight(unsigned int face, const StressEdge &edge, const StressEdge::Component &component,
                  unsigned int row) const
    {
      if (has_rows)
        return turns[face] * component.direction[row];
      return row == 0 ? component.direction * edge.normal
                      : turns[face] * (component.direction * edge.tangent);
    }
  };

  /** Where psi_a does not vanish. */
  struct Patch
  {
    unsigned int vertex; ///< a
    dealii::ArrayView<const std::pair<unsigned int, unsigned int>>
        cells; ///< index, and number of the hat in it
  };

  const std::vector<StressEdge> &edges() const;
  const std::vector<Cell> &cells() const; ///< by active cell index

  const std::vector<Patch> &patches() const; ///< by vertex

private:
  void collect_edges(const Solution<2> &solution, const JointTractions *joints);
  void join_vertices();
  void set_directions(const Scene<2> &scene, StressEdge &edge) const;
  void set_components(const Scene<2> &scene, StressEdge &edge) const;
  void set_hats(const Solution<2> &solution);
  void set_patches(unsigned int n_vertices);
  const std::map<unsigned int, double> &expand(unsigned int vertex);

  std::vector<StressEdge> all_edges;
  std::vector<Cell> all_cells;
  std::map<unsigned int, std::array<unsigned int, 2>> hanging; ///< vertex: ends of its edge
  std::map<unsigned int, unsigned int> joined; ///< vertex: that which it is one with
  std::map<unsigned int, std::map<unsigned int, double>>
      values;                ///< by vertex v, if it hangs or is joined, then a
  std::vector<Hat> all_hats; ///< cell by cell
  std::vector<std::pair<unsigned int, unsigned int>> cells_of_patches; ///< one after the other
  std::vector<Patch> all_patches;
};
} // namespace hpvi

#endif
