// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_display_name_h
#define hpvi_display_name_h

#include <string>

namespace hpvi
{
/** @p file as messages name it; "scene" where that is empty, for a scene of overrides alone has none. */
std::string display_name(const std::string &file);
} // namespace hpvi

#endif
