// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_memory_h
#define hpvi_memory_h

#include <cstddef>
#include <filesystem>
#include <string>

namespace hpvi
{
/** As in 800 B, 2 kB, 512 MB, 4.2 GB: powers of 1000, three digits at most. */
std::string bytes_text(double bytes);

/** How much memory is left, and what sets that limit. */
struct AvailableMemory
{
  double bytes; ///< infinity where the system names no limit
  std::string limit;
};

/**
 * What the process may still get: the least that is left of the machine's memory (MemAvailable and
 * SwapFree of /proc/meminfo), of its control groups, and of RLIMIT_AS and RLIMIT_DATA. /proc and
 * /sys are those below @p root. Pages that are mapped but not touched count for the last two alone.
 */
AvailableMemory available_memory(const std::filesystem::path &root = "/");

/**
 * Throws NumericalFailure where @p bytes for @p purpose are more than what is available, before
 * they are asked for: Linux grants what it does not have, and ends the process when it is used.
 */
void require_memory(double bytes, const std::string &purpose);

constexpr std::size_t large_page = std::size_t(1) << 21;

/** Ask the kernel for large pages under @p bytes of memory that nobody has touched yet; it may decline. */
void want_large_pages(void *memory, std::size_t bytes);

/** Does RLIMIT_AS or RLIMIT_DATA limit the memory that the process may map? */
bool mapping_is_limited();

/**
 * Make OpenBLAS take the buffer of the calling thread. It takes it at the first product and tries
 * for ever where it gets none. Throws NumericalFailure where there is no room for it.
 */
void prepare_blas();
} // namespace hpvi

#endif
