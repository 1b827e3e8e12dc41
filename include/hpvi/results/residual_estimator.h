// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_residual_estimator_h
#define hpvi_residual_estimator_h

#include <hpvi/results/error_estimate.h>
#include <hpvi/results/field.h>

namespace hpvi
{
/**
 * The residual error indicator (4.44)-(4.51) of u_N, lambda_N. The local degree and size of each
 * cell weigh its own residuals; a face with hanging nodes counts as its halves or quarters. Collective.
 */
template <int dim>
ErrorEstimate estimate_error(const Field<dim> &field);

/**
 * eta of round-off alone: of a displacement that is random and as large as the last bit of u_N on
 * each cell, without loads. No mesh brings the indicator below it. Collective.
 */
template <int dim>
double round_off_of_estimate(const Field<dim> &field);
} // namespace hpvi

#endif
