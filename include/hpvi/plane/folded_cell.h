// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_folded_cell_h
#define hpvi_folded_cell_h

#include <deal.II/base/point.h>
#include <deal.II/grid/tria.h>

#include <optional>

namespace hpvi
{
/** A Gauss point at which det J of a curved cell is not positive; nothing: all maps are one to one there. */
std::optional<dealii::Point<2>> folded_cell(const dealii::Triangulation<2> &mesh);

void require_no_folds(const dealii::Triangulation<2> &mesh); ///< else NumericalFailure
} // namespace hpvi

#endif
