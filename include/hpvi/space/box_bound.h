// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_box_bound_h
#define hpvi_box_bound_h

#include <hpvi/bound/error_bound.h>
#include <hpvi/space/newton_matrix.h>

#include <string>
#include <vector>

namespace hpvi
{
/** Why box_bound() has none of this discrete problem; empty: it has. Collective. */
std::string no_box_bound(const PrimalSpace<3> &space, const DistributedVector &u);

/**
 * The bound of ErrorBound for one body of boxes in space that supports hold, frictionless or under Tresca's law, on one process. Contact exerts tractions
 * that obey its law at every point: pi >= 0 and g lam*, |lam*| <= 1, polynomials on each face with the means of the multiplier.
 * u_N + x in V_N is in balance with them; rows of BoxStress near its stress are the s of the theorem. w in V_N takes
 * away what penetrates, by Bernstein coefficients. @p matrix solves for x; @p work is L(u_N) of the discrete problem. Where that fails ErrorBound::flaw says so.
 */
ErrorBound box_bound(const PrimalSpace<3> &space, NewtonMatrix<3> &matrix,
                     const DistributedVector &u, const std::vector<ContactVector<3>> &lambda,
                     double work);
} // namespace hpvi

#endif
