// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_outline_part_h
#define hpvi_outline_part_h

#include <deal.II/grid/tria.h>

#include <vector>

namespace hpvi
{
/** A place on a boundary and the outer unit normal there. */
struct OutlinePlace
{
  dealii::Point<2> x;
  dealii::Tensor<1, 2> normal;
};

/**
 * Edges of one boundary that follow each other without a corner, the body on their left. A boundary may have several
 * parts: its edges need not hang together, and it may go round a corner.
 */
class OutlinePart
{
public:
  OutlinePart(dealii::types::boundary_id boundary, const std::vector<dealii::Point<2>> &points);

  dealii::types::boundary_id boundary;

  double length() const;                  ///< along its edges [length]
  OutlinePlace at(double distance) const; ///< from its beginning [length]
  const std::vector<dealii::Point<2>> &points() const;

private:
  std::vector<dealii::Point<2>> vertices;
  std::vector<double> distances; ///< of the vertices from the first
};

/** All parts of the boundary of @p mesh, found by the boundary ids of its faces. */
std::vector<OutlinePart> boundary_parts(const dealii::Triangulation<2> &mesh);
} // namespace hpvi

#endif
