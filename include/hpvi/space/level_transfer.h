// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_level_transfer_h
#define hpvi_level_transfer_h

#include <hpvi/space/multigrid_level.h>

namespace hpvi
{
/**
 * Between a mesh and the one with all its cells coarsened once: `P = T_f^-1 I T_c` with the interpolation I of nodal values,
 * and P'. Each node of the fine mesh takes its value from one coarse cell; the process of that cell has the list of its
 * nodes, whoever owns the cells on the fine mesh. Memory grows with the number of cells, not with depth.
 */
class LevelTransfer
{
public:
  using Vector = MultigridLevel<float>::Vector;

  /** Both levels must outlive it. Collective. */
  LevelTransfer(const MultigridLevel<float> &coarse, const MultigridLevel<float> &fine);

  void prolongate(Vector &fine_v, Vector &coarse_v) const;  ///< P; coarse_v is lost
  void restrict_to(Vector &coarse_r, Vector &fine_r) const; ///< P'; fine_r is lost

  /**
   * Of coarse contact dofs what fine ones are: one is held where all of those in its square of the face are, and its H is the sum
   * of theirs that slip. Collective.
   */
  std::vector<ContactDofState<3>> coarse_states() const;

private:
  struct Link ///< of a coarse contact dof to a fine one
  {
    unsigned int coarse;              ///< number in PrimalSpace::contact
    std::array<unsigned int, 2> fine; ///< local elements
  };
  struct Piece ///< what a fine cell takes from a coarse one
  {
    unsigned int coarse;     ///< first of its nodes in #nodes
    unsigned int tables;     ///< of both, see DegreeTables::number_of()
    unsigned int child;      ///< or n_children: the same cell
    unsigned int first, end; ///< of its rows
  };
  struct Row
  {
    unsigned int fine;   ///< local element of the first component
    unsigned short node; ///< of the fine cell
    float weight;        ///< one, or one over the number of processes that add to it
  };
  struct Assembly;

  void build_matrices(const BoxTables<3> &tables);
  void add_piece(Assembly &assembly, const typename PrimalSpace<3>::Cell &coarse,
                 unsigned int child, const std::vector<dealii::types::global_dof_index> &bases);
  void add_links(const typename PrimalSpace<3>::Cell &coarse, unsigned int child,
                 const std::vector<dealii::types::global_dof_index> &bases);
  unsigned int coarse_nodes(const typename PrimalSpace<3>::Cell &cell);
  void share_rows();

  const MultigridLevel<float> &coarse, &fine;
  /** By child and node of the child: nodes of the parent and weights. */
  using Interpolation = std::vector<std::vector<std::vector<std::pair<unsigned int, float>>>>;
  std::vector<Interpolation> interpolations; ///< by degree
  std::vector<Piece> pieces;
  std::vector<Row> rows;
  std::vector<Link> links;
  /** By cell and node: a local element of the coarse mesh, or n - 1 - r with r a row of #hanging. */
  std::vector<int> nodes;
  std::vector<std::array<std::vector<std::pair<unsigned int, float>>, 3>> hanging;
  mutable Vector buffer; ///< of the fine mesh, with all nodes of the rows
};
} // namespace hpvi

#endif
