// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_edge_traction_h
#define hpvi_edge_traction_h

#include <hpvi/bound/equilibrated_stress.h>

#include <deal.II/grid/tria.h>

#include <array>
#include <vector>

namespace hpvi
{
/** s n of an equilibrated stress on a straight edge of a body's boundary, n its outer normal. */
struct EdgeTraction
{
  dealii::Triangulation<2>::cell_iterator cell; ///< of the body on which s n acts
  unsigned int face;
  dealii::types::boundary_id boundary;
  dealii::Point<2> begin, end;
  std::array<std::vector<double>, 2>
      components; ///< x and y: Legendre coefficients from begin to end

  dealii::Point<2> point(double s) const;     ///< s in [0,1]
  dealii::Tensor<1, 2> value(double s) const; ///< [stress]
  unsigned int n_coefficients() const;        ///< of the longer component
};

/** On all edges of all bodies; where two of them touch once for either, where meshes do not match by parts of the master's edges. */
std::vector<EdgeTraction> edge_tractions(const EquilibratedStress &stress);
} // namespace hpvi

#endif
