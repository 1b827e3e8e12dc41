// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_friction_check_h
#define hpvi_friction_check_h

#include <hpvi/results/field.h>

namespace hpvi
{
/**
 * Laws of friction whose coefficient depends on the pressure have been tried under pressures as large as the loads.
 * InputError with boundary, pressures and place where one falls, or bends upwards, below the pressures that @p field
 * has. Collective.
 */
template <int dim>
void check_friction_by_pressure(const Field<dim> &field);
} // namespace hpvi

#endif
