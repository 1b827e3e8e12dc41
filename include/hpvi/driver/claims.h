// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_claims_h
#define hpvi_claims_h

#include <hpvi/driver/step_report.h>
#include <hpvi/results/warnings/claim.h>

namespace hpvi
{
/**
 * All that a step guarantees, of its thickness: the least energy, forces, mean displacements. What both sides of a pair exert on each
 * other is one number, of which each side has a claim. @p displacement is the largest of u_N.
 */
template <int dim>
Claims claims_of(const StepReport<dim> &step, double displacement);

/** Takes all claims of a step away, because of @p why. */
template <int dim>
void withdraw_claims(StepReport<dim> &step, const std::string &why);
} // namespace hpvi

#endif
