// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/one_thread.h>

#include <mutex>

// Present where OpenBLAS is the BLAS in use and where CHOLMOD was built with OpenMP.
extern "C"
{
  int openblas_get_num_threads() __attribute__((weak));
  void openblas_set_num_threads(int) __attribute__((weak));
  int omp_get_max_active_levels() __attribute__((weak));
  void omp_set_max_active_levels(int) __attribute__((weak));
  int omp_get_max_threads() __attribute__((weak));
  void omp_set_num_threads(int) __attribute__((weak));
}

namespace hpvi
{
namespace
{
std::mutex mutex;
unsigned int n_guards = 0; ///< of all threads
int blas_threads = 0;      ///< before the first of them
} // namespace

OneThread::OneThread()
    : openmp_levels(omp_get_max_active_levels ? omp_get_max_active_levels() : 0),
      openmp_threads(omp_get_max_threads ? omp_get_max_threads() : 0)
{
  {
    const std::lock_guard<std::mutex> lock(mutex);
    if (++n_guards == 1 && openblas_set_num_threads)
    {
      blas_threads = openblas_get_num_threads();
      openblas_set_num_threads(1);
    }
  }
  if (omp_set_max_active_levels)
  {
    omp_set_max_active_levels(0);
    omp_set_num_threads(1); // an OpenBLAS that is built with OpenMP goes by this number
  }
}

OneThread::~OneThread()
{
  {
    const std::lock_guard<std::mutex> lock(mutex);
    if (--n_guards == 0 && openblas_set_num_threads)
      openblas_set_num_threads(blas_threads);
  }
  if (omp_set_max_active_levels)
  {
    omp_set_max_active_levels(openmp_levels);
    omp_set_num_threads(openmp_threads);
  }
}
} // namespace hpvi
