// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_version_h
#define hpvi_version_h

#include <string>

namespace hpvi
{
/** Of this library, as in 0.3.0. */
std::string version();

/** Release, or Debug with all of deal.II's assertions: of the library, whatever its user builds. */
std::string build_type();
} // namespace hpvi

#endif
