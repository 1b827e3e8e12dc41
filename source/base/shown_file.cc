// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/shown_file.h>
#include <hpvi/base/text.h>

namespace hpvi
{
std::string shown_file(const std::string &file)
{
  return file.empty() ? "scene" : printable(file, 400);
}
} // namespace hpvi
