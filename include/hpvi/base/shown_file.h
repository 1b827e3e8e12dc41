// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_shown_file_h
#define hpvi_shown_file_h

#include <string>

namespace hpvi
{
/** @p file as messages name it; "scene" where that is empty, for a scene of overrides alone has none. */
std::string shown_file(const std::string &file);
} // namespace hpvi

#endif
