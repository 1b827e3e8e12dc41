// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_bound_words_h
#define hpvi_bound_words_h

#include <string>

namespace hpvi
{
/** A number of few digits that is no less: what is guaranteed stays so. */
std::string at_most(double value);

/**
 * What is known of the error, as in "at most 0.31 % of the solution, guaranteed". @p kind: text(BoundKind); @p size: of the error with its
 * unit, as at_most() has it; @p coupling and @p zones as in ErrorBound. Never that a bound is one without the coupling that it needs.
 */
std::string error_in_words(const std::string &kind, const std::string &size, double coupling,
                           const std::string &zones);

/** What an interval rests on, as in "guaranteed" or "bounded, coupling at most 1.4". @p kind and @p coupling likewise. */
std::string terms_in_words(const std::string &kind, double coupling);
} // namespace hpvi

#endif
