// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_dissection_h
#define hpvi_dissection_h

#include <deal.II/grid/tria.h>

#include <utility>
#include <vector>

namespace hpvi
{
/**
 * Nested dissection by the tree of cells, which refinement has grown: what lies between the halves of a cell separates all that is in them
 * (A. George, doi:10.1137/0710032). Only halves of some hundred cells and more are told apart, as minimum degree does better inside.
 */
class Dissection
{
public:
  Dissection(const dealii::Triangulation<2> &triangulation, unsigned int n_unknowns);

  /** The active cell @p cell has all of @p unknowns. */
  void add(unsigned int cell, const std::vector<unsigned int> &unknowns);

  /** By unknown: when it is eliminated, 0 first; empty for a mesh of few cells. */
  std::vector<unsigned int> stages() const;

private:
  using Cell = dealii::Triangulation<2>::cell_iterator;

  /** A part of the mesh; those inside come before it. */
  struct Part
  {
    unsigned int n_cells,
        end; ///< behind the last of its cells, as the tree has them one after the other
    unsigned int parent;
  };

  unsigned int part_of(const Cell &cell);
  unsigned int part_of(const Cell &cell, unsigned int first_child, unsigned int n_children);
  unsigned int join(const std::vector<unsigned int> &inside);

  std::vector<Part> parts;
  std::vector<unsigned int> leaf;  ///< by cell, as the tree has them: its part
  std::vector<unsigned int> place; ///< by active cell: where the tree has it
  std::vector<std::pair<unsigned int, unsigned int>>
      range; ///< by unknown: the first and the last of its cells
};
} // namespace hpvi

#endif
