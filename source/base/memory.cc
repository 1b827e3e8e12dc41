// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/lac/lapack_full_matrix.h>
#include <hpvi/base/memory.h>
#include <hpvi/base/numbers.h>

#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>
#include <mutex>
#include <sstream>
#include <vector>

// Present where OpenBLAS is the BLAS in use.
extern "C" int openblas_get_num_threads() __attribute__((weak));

namespace hpvi
{
namespace
{
namespace fs = std::filesystem;

/** The numbers of a file with lines "NAME NUMBER" or "NAME: NUMBER kB", in bytes. */
std::map<std::string, double> read_numbers(const fs::path &path)
{
  std::map<std::string, double> result;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
  {
    std::istringstream words(line);
    std::string name, unit;
    double number;
    if (words >> name >> number)
    {
      words >> unit;
      result[name] = unit == "kB" ? 1024 * number : number;
    }
  }
  return result;
}

/** The one number of a file; infinity where there is none, as in "max". */
double read_number(const fs::path &path)
{
  double number;
  return std::ifstream(path) >> number ? number : infinity;
}

/** What is left of @p limit; a limit that does not exist leaves everything. */
AvailableMemory left_of(const double limit, const double used, const std::string &name)
{
  return {limit == infinity ? infinity : std::max(0., limit - used), name};
}

/** Of one control group of either version. Files that the kernel would give up first are free. */
AvailableMemory left_in_group(const fs::path &group)
{
  std::map<std::string, double> statistics = read_numbers(group / "memory.stat");
  if (fs::exists(group / "memory.max"))
    return left_of(read_number(group / "memory.max"),
                   read_number(group / "memory.current") - statistics["inactive_file"],
                   "the control group");
  return left_of(read_number(group / "memory.limit_in_bytes"),
                 read_number(group / "memory.usage_in_bytes") - statistics["total_inactive_file"],
                 "the control group");
}

/**
 * Of the groups that the process is in. Inside a container its own group may be mounted as the
 * root, so that the path does not exist there; then its parents lead to the root all the same.
 */
void add_groups(const fs::path &root, std::vector<AvailableMemory> &limits)
{
  std::ifstream file(root / "proc/self/cgroup");
  for (std::string line; std::getline(file, line);)
  {
    std::istringstream fields(line);
    std::string number, controllers, path;
    std::getline(std::getline(std::getline(fields, number, ':'), controllers, ':'), path);
    if (!controllers.empty() && controllers != "memory")
      continue;
    const fs::path home = root / "sys/fs/cgroup" / controllers;
    fs::path group = fs::path(path).relative_path();
    for (limits.push_back(left_in_group(home)); !group.empty(); group = group.parent_path())
      limits.push_back(left_in_group(home / group));
  }
}

double limit_of(const decltype(RLIMIT_AS) resource)
{
  rlimit limit;
  return getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY ? limit.rlim_cur
                                                                             : infinity;
}
} // namespace

std::string bytes_text(double bytes)
{
  const char *unit = "B";
  for (const char *next : {"kB", "MB", "GB", "TB"})
    if (bytes >= 999.5)
    {
      bytes /= 1000;
      unit = next;
    }
  std::ostringstream text;
  text.precision(3);
  text << bytes << ' ' << unit;
  return text.str();
}

AvailableMemory available_memory(const fs::path &root)
{
  std::map<std::string, double> process = read_numbers(root / "proc/self/status");
  std::vector<AvailableMemory> limits = {
      left_of(limit_of(RLIMIT_AS), process["VmSize:"], "the address space (ulimit -v)"),
      left_of(limit_of(RLIMIT_DATA), process["VmData:"], "the data segment (ulimit -d)")};
  std::map<std::string, double> machine = read_numbers(root / "proc/meminfo");
  if (machine.count("MemAvailable:"))
    limits.push_back(
        left_of(machine["MemAvailable:"] + machine["SwapFree:"], 0, "the machine's memory"));
  add_groups(root, limits);
  return *std::min_element(limits.begin(), limits.end(),
                           [](const auto &a, const auto &b) { return a.bytes < b.bytes; });
}

namespace
{
std::mutex claims_mutex;
double all_claims = 0; ///< of all threads

/** What one thread has asked for last. */
struct Claim
{
  double bytes = 0;

  /** With the mutex held. */
  void set(const double new_bytes)
  {
    all_claims += new_bytes - bytes;
    bytes = new_bytes;
  }

  ~Claim()
  {
    forget_memory_claim();
  }
};
thread_local Claim claim;
} // namespace

double peak_memory()
{
  dealii::Utilities::System::MemoryStats memory;
  dealii::Utilities::System::get_memory_stats(memory);
  return 1024. * memory.VmHWM;
}

void forget_memory_claim()
{
  const std::lock_guard<std::mutex> lock(claims_mutex);
  claim.set(0);
}

void require_memory(const double bytes, const std::string &purpose)
{
  const std::lock_guard<std::mutex> lock(claims_mutex);
  const double others = all_claims - claim.bytes;
  claim.set(bytes);
  // To read what is left takes as long as a small factorisation; no machine is that short of memory.
  if (bytes < (1 << 26) && !mapping_is_limited())
    return;
  AvailableMemory available = available_memory();
  available.bytes = std::max(0., available.bytes - others);
  if (bytes <= available.bytes)
    return;
  claim.set(0);
  throw MemoryFailure(purpose + " needs " + bytes_text(bytes) + " of memory, " +
                      bytes_text(available.bytes) + " are left of " + available.limit +
                      "; lower Adaptivity/Maximum unknowns, take fewer Geometry/Subdivisions "
                      "or allow more memory");
}

void want_large_pages(void *const memory, const std::size_t bytes)
{
#ifdef MADV_HUGEPAGE
  const std::uintptr_t begin = reinterpret_cast<std::uintptr_t>(memory),
                       first = (begin + large_page - 1) / large_page * large_page,
                       last = (begin + bytes) / large_page * large_page;
  if (first < last)
    madvise(reinterpret_cast<void *>(first), last - first, MADV_HUGEPAGE);
#else
  (void)memory;
  (void)bytes;
#endif
}

void reserve_heap()
{
#ifdef __GLIBC__
  if (mapping_is_limited())
    return;
  mallopt(M_MMAP_THRESHOLD, 1 << 25); // the largest that there is
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  mallopt(M_MXFAST, 0); // else each large block that is given back looks through all small ones
  constexpr int bytes = 1 << 29, usual = 1 << 17;
  mallopt(M_TOP_PAD, bytes);
  // More than is left at the top, and less than what is mapped on its own.
  if (void *const begin = std::malloc(1 << 24))
  {
    want_large_pages(begin, bytes);
    std::free(begin);
  }
  mallopt(M_TOP_PAD, usual);
#endif
}

bool mapping_is_limited()
{
  return limit_of(RLIMIT_AS) < infinity || limit_of(RLIMIT_DATA) < infinity;
}

void prepare_blas()
{
  thread_local bool has_buffer = false; // OpenBLAS keeps it for whoever comes next
  if (!openblas_get_num_threads || has_buffer)
    return;
  // The largest of its buffers: 32 MB times 4, and a page.
  const double buffer = 128. * (1 << 20) + (1 << 12);
  const AvailableMemory available = available_memory();
  if (mapping_is_limited() && available.bytes < buffer)
    throw MemoryFailure("OpenBLAS needs " + bytes_text(buffer) + " of memory for its buffer, " +
                        bytes_text(available.bytes) + " are left of " + available.limit +
                        "; allow more memory");
  const unsigned int n = 128; // on some machines smaller products go without a buffer
  dealii::LAPACKFullMatrix<double> factor(n, n), product(n, n);
  factor.mmult(product, factor);
  has_buffer = true;
}
} // namespace hpvi
