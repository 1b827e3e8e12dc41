// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_cell_basis_h
#define hpvi_cell_basis_h

#include <hpvi/space/primal_space.h>

#include <utility>
#include <vector>

namespace hpvi
{
/**
 * What nodal values of a cell are made of, `u_i = sum_J w_iJ v_J + u_0i`, J unconstrained unknowns of any process: nodes and contact
 * dofs, and where a face is one of a slave nodes of the master opposite, as in ContactDofTransform.
 */
struct CellBasis
{
  using Dof = dealii::types::global_dof_index;

  std::vector<Dof> unknowns; ///< ascending
  /** By unknown: numbers of FESystem and weights. */
  std::vector<std::vector<std::pair<unsigned int, double>>> columns;

  /** `sum_ij w_iJ K_ij w_jI` in these unknowns. */
  dealii::FullMatrix<double> transformed(const dealii::FullMatrix<double> &K) const;

  /** The diagonal of that. */
  std::vector<double> diagonal(const dealii::FullMatrix<double> &K) const;
};

/** Has a face of @p cell, of this process, another body opposite, and the contact dofs? */
bool has_opposite(const PrimalSpace<3> &space, const PrimalSpace<3>::Cell &cell);

CellBasis cell_basis(const PrimalSpace<3> &space, const PrimalSpace<3>::Cell &cell);
} // namespace hpvi

#endif
