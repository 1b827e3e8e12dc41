// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/version.h>

namespace hpvi
{
std::string version()
{
  return HPVI_VERSION;
}

std::string build_type()
{
#ifdef DEBUG
  return "Debug";
#else
  return "Release";
#endif
}
} // namespace hpvi
