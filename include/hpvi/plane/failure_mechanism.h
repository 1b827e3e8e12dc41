// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_failure_mechanism_h
#define hpvi_failure_mechanism_h

#include <hpvi/plane/static_admissibility.h>

namespace hpvi
{
/** Which entry of the scene sets what friction of @p contact_space resists with, as in "raise Friction bound"; or empty. */
template <int dim>
std::string friction_entry(const ContactSpace<dim> &contact_space);

/**
 * The failure mechanism of a body, or of several that move as one, whose loads exceed what contact can carry, in the words of statics and
 * with its numbers, a force N = L(n), T = L(t) and moments about the ends of a boundary:
 *
 *     lifting off it,  N < 0;   sliding along it,  |T| > int g or mu_f N;   toppling about an end,
 *
 * where the resultant meets the boundary beyond that end. Where mu_f varies it is the largest that pressures
 * with this resultant can have together. Empty where it is none of these, as where two boundaries press.
 */
template <int dim>
std::string failure_mechanism(const ContactSpace<dim> &contact_space,
                              const LoadedMotions<dim> &loaded);
} // namespace hpvi

#endif
