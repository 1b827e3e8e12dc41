// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/display_name.h>
#include <hpvi/base/text.h>

namespace hpvi
{
std::string display_name(const std::string &file)
{
  return file.empty() ? "scene" : printable(file, 400);
}
} // namespace hpvi
