// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_record_h
#define hpvi_record_h

#include <hpvi/base/formatting.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace hpvi
{
/** A field of a table: nothing, a whole number, a number, which is nothing where it is infinite or NaN, or words. */
using Value = std::variant<std::monostate, std::uint64_t, double, std::string>;

/** Names and values of one row of a table. */
using Record = std::vector<std::pair<std::string, Value>>;

/** As it stands in a file: that of nothing is empty. */
std::string text(const Value &value);

/** Of which text() makes @p field. */
Value value_from(const std::string &field);

/** None of nothing, and of words that are none. */
std::optional<double> number(const Value &value);

/** Of a column; nothing where there is none. */
Value value_of(const Record &record, const std::string &column);
std::string words_of(const Record &record, const std::string &column);
std::optional<double> number_of(const Record &record, const std::string &column);

/**
 * Comma-separated below a head. Columns of rows may differ: those of all are there, in the order in which they first come, with
 * empty fields where a row has none. Fields with commas or quotes stand in quotes.
 */
std::string csv(const std::vector<Record> &records);

/** The rows below the head of what csv() wrote, up to one that is not whole. */
std::vector<Record> records(const std::string &csv);

/** A file that grows with every step, and how many of its first bytes the last change has left. */
struct GrowingText
{
  std::string text;
  std::size_t same = 0;
};

/** A file of rows that all have the columns of the first one. */
struct GrowingTable : GrowingText
{
  Record last; ///< of its rows

  void add(const std::vector<Record> &rows);
};

/** An array of JSON, each item on a line of its own. */
template <class Lines>
std::string json_lines(const Lines &lines)
{
  std::string list;
  for (const std::string &line : lines)
    list += (list.empty() ? "\n    " : ",\n    ") + json_string(line);
  return "[" + list + (list.empty() ? "]" : "\n  ]");
}

/** As JSON, where nothing and no words are null. */
std::string json_value(const Value &value);

/** As an object of JSON. */
std::string json_object(const Record &record);

/** A whole file of JSON: an object of these members, whose values are JSON themselves. */
std::string json_file(const std::vector<std::pair<std::string, std::string>> &members);
} // namespace hpvi

#endif
