// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_record_h
#define hpvi_record_h

#include <hpvi/base/formatting.h>

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace hpvi
{
/** Names and values of one row of a table; an empty value is an empty field. */
using Record = std::vector<std::pair<std::string, std::string>>;

/** A field; empty where @p value is infinite or NaN. */
std::string known(double value);

/** Of a column; empty where there is none. */
std::string value_of(const Record &record, const std::string &column);

/** Comma-separated, with the names of the last record as head. */
std::string csv(const std::vector<Record> &records);

/** The rows below the head of what csv() wrote; one that is not whole is none. */
std::vector<Record> records(const std::string &csv);

/** A file that grows with every step, and how many of its first bytes the last change has left. */
struct GrowingText
{
  std::string text;
  std::size_t same = 0;
};

/** Add a line to a table, the first below a head. */
void add_row(GrowingText &table, const Record &row);

/** Add several at once. */
void add_rows(GrowingText &table, const std::vector<Record> &rows);

/** An array of JSON, each item on a line of its own. */
template <class Lines>
std::string json_lines(const Lines &lines)
{
  std::string list;
  for (const std::string &line : lines)
    list += (list.empty() ? "\n    " : ",\n    ") + json_string(line);
  return "[" + list + (list.empty() ? "]" : "\n  ]");
}

/** As JSON, which knows neither infinity nor NaN: there it has null. */
std::string json_number(double value);

/** As an object of JSON, with null for an empty field and for what json_number() has no digits for. */
std::string json_object(const Record &record);

/** A whole file of JSON: an object of these members, whose values are JSON themselves. */
std::string json_file(const Record &members);
} // namespace hpvi

#endif
