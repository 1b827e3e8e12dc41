// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_cores_h
#define hpvi_cores_h

#include <functional>

namespace hpvi
{
/** Those that this process may use, which a machine may have more of; 1 at least. */
unsigned int n_usable_cores();

/**
 * work(k) for k = 0, ..., n - 1, begun in this order, on @p n_threads threads at once; on the calling one alone where that is 1.
 * Throws what the call of the lowest k threw, when all are over: one that throws does not end the others.
 */
void on_threads(unsigned int n_threads, unsigned int n,
                const std::function<void(unsigned int)> &work);
} // namespace hpvi

#endif
