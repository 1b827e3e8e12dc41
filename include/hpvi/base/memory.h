// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_memory_h
#define hpvi_memory_h

#include <hpvi/base/numerical_failure.h>

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

/** There is too little memory. */
class MemoryFailure : public NumericalFailure
{
public:
  using NumericalFailure::NumericalFailure;
};

/**
 * Throws MemoryFailure where @p bytes for @p purpose are more than what is available, before
 * they are asked for: Linux grants what it does not have, and ends the process when it is used. What another thread has asked
 * for last counts as not yet taken: some of it counts twice then, and none is granted twice.
 */
void require_memory(double bytes, const std::string &purpose);

/** The calling thread has given back what it asked for; the end of a thread says the same. */
void forget_memory_claim();

/** What the process has had at most so far [bytes]. */
double peak_memory();

constexpr std::size_t large_page = std::size_t(1) << 21;

/** Ask the kernel for large pages under @p bytes of memory that nobody has touched yet; it may decline. */
void want_large_pages(void *memory, std::size_t bytes);

/**
 * For a program, not for a library: 512 MB of addresses for the heap at once, in large pages, and what is given back stays there.
 * A run asks for memory in each step that it has given back in the last, and the kernel clears each page that is asked for. Does
 * nothing where the mapping of memory is limited.
 */
void reserve_heap();

/** Does RLIMIT_AS or RLIMIT_DATA limit the memory that the process may map? */
bool mapping_is_limited();

/**
 * Make OpenBLAS take the buffer of the calling thread. It takes it at the first product and tries
 * for ever where it gets none. Throws MemoryFailure where there is no room for it.
 */
void prepare_blas();
} // namespace hpvi

#endif
