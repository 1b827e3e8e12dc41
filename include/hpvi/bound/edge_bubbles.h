// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_edge_bubbles_h
#define hpvi_edge_bubbles_h

#include <hpvi/plane/condensation.h>
#include <hpvi/plane/contact_space.h>

#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace hpvi
{
/**
 * Displacements beyond those of the space: in one cell at a contact face, or at two, of degree q > p, with given traces on one
 * face, zero on the other edges of the cell, and with the least energy. Cells of one class share their matrices.
 */
class EdgeBubbles
{
public:
  struct Energies
  {
    dealii::FullMatrix<double> own; ///< a(b_i, b_j)
    /** a(phi_i, b_j) with the shape functions of degree p on the boundary of the cell; those inside have none. */
    dealii::FullMatrix<double> with_shapes;
  };

  /**
   * Column j of a matrix holds b_j at the q + 1 Gauss-Lobatto nodes along its face, component by component; it vanishes
   * at the ends. The faces are of one cell, and j counts through their columns.
   */
  using Traces = std::vector<std::pair<const ContactFace<2> *, dealii::FullMatrix<double>>>;

  Energies energies(const Traces &traces, const Scene<2> &scene, const ShapeTables<2> &tables);

private:
  std::map<ElementMatrices<2>::Class, std::shared_ptr<const CondensedElement>> elements;
};
} // namespace hpvi

#endif
