// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_record_h
#define hpvi_record_h

#include <hpvi/base/formatting.h>

#include <string>
#include <utility>
#include <vector>

namespace hpvi
{
/** Names and values of one row of a table; an empty value is an empty field. */
using Record = std::vector<std::pair<std::string, std::string>>;

/** Comma-separated, with the names of the last record as head. */
std::string csv(const std::vector<Record> &records);

/** An array of JSON, each item on a line of its own. */
template <class Lines>
std::string json_lines(const Lines &lines)
{
  std::string list;
  for (const std::string &line : lines)
    list += (list.empty() ? "\n    " : ",\n    ") + json_string(line);
  return "[" + list + (list.empty() ? "]" : "\n  ]");
}

/** As an object of JSON, which knows neither empty fields nor infinity: there it has null. */
std::string json_object(const Record &record);
} // namespace hpvi

#endif
