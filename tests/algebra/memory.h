// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_algebra_memory_h
#define hpvi_algebra_memory_h

#include <sys/resource.h>

#include <fstream>

namespace algebra
{
/** For its own life, no more than @p bytes of address space beyond what is mapped already. */
class AddressSpaceLimit
{
public:
  explicit AddressSpaceLimit(const double bytes)
  {
    getrlimit(RLIMIT_AS, &before);
    double pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    rlimit limit = before;
    limit.rlim_cur = pages * 4096 + bytes;
    setrlimit(RLIMIT_AS, &limit);
  }
  ~AddressSpaceLimit()
  {
    setrlimit(RLIMIT_AS, &before);
  }

  /** The address sanitizer ends a program whose memory ends. */
  static bool can_be_tested()
  {
#ifdef __SANITIZE_ADDRESS__
    return false;
#else
    return true;
#endif
  }

private:
  rlimit before;
};
} // namespace algebra

#endif
