// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/one_thread.h>

#include <cstdlib>
#include <mutex>
#include <string>

// Present where OpenBLAS is the BLAS in use and where CHOLMOD was built with OpenMP.
extern "C"
{
  char *openblas_get_corename() __attribute__((weak));
  void gotoblas_dynamic_quit() __attribute__((weak));
  void gotoblas_dynamic_init() __attribute__((weak));
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

#ifdef __x86_64__
/**
 * OpenBLAS 0.3.21 takes a processor that is younger than itself for the oldest that it knows: a bound takes 1.7 times as long. It
 * chooses when it is loaded, by a variable of the environment if there is one, and chooses again here. No other thread may use it meanwhile.
 */
struct KernelsOfThisProcessor
{
  KernelsOfThisProcessor()
  {
    const char *const variable = "OPENBLAS_CORETYPE";
    if (!openblas_get_corename || !gotoblas_dynamic_quit || !gotoblas_dynamic_init ||
        std::getenv(variable) || openblas_get_corename() != std::string("Prescott") ||
        !__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma"))
      return;
    const bool is_wide = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                         __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
    setenv(variable, is_wide ? "SkylakeX" : "Haswell", 1);
    gotoblas_dynamic_quit();
    gotoblas_dynamic_init();
    unsetenv(variable);
  }
};

const KernelsOfThisProcessor when_loaded;
#endif
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
