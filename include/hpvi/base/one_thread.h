// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_one_thread_h
#define hpvi_one_thread_h

namespace hpvi
{
/**
 * Dense algebra of the calling thread uses one thread as long as this lives: OpenBLAS and OpenMP's
 * thread pools, which CHOLMOD opens with four threads whatever the environment says, cost more than they
 * bring for matrices of this size, and sums would depend on their number. Both are given back as
 * they were, OpenMP for the calling thread, to which it belongs. OpenBLAS has one number for the
 * whole process: the first guard of all threads sets it, and the last one gives it back.
 */
class OneThread
{
public:
  OneThread();
  ~OneThread();

  OneThread(const OneThread &) = delete;
  OneThread &operator=(const OneThread &) = delete;

private:
  int openmp_levels, openmp_threads; ///< of the calling thread, before
};
} // namespace hpvi

#endif
