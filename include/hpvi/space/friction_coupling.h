// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_friction_coupling_h
#define hpvi_friction_coupling_h

#include <hpvi/space/newton_matrix.h>

#include <vector>

namespace hpvi
{
/**
 * How strongly friction couples back into pressure: theta of CoulombCoupling, in the space of the discrete problem,
 *
 *     theta^2 = lambda_max(D' S_FF D (S^-1)_PP),     D = mu_f chi,
 *
 * S the compliance of friction (F) and pressures (P) at contact dofs. @p mu_chi: by contact dof of PrimalSpace::contact, mu_f chi at those of
 * friction with a partner [-], elsewhere zero. @p sticks: those of friction at which v has no moments; none: no such. By Lanczos' method to 1e-3, two solutions with @p matrix a step; a lower bound of that of
 * the body. Changes the states of @p matrix.
 */
double friction_coupling(const PrimalSpace<3> &space, NewtonMatrix<3> &matrix,
                         const std::vector<ContactVector<3>> &mu_chi,
                         const std::vector<bool> &sticks = {});
} // namespace hpvi

#endif
