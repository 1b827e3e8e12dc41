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

/** As JSON, where nothing and no words are null. */
std::string json_value(const Value &value);

/** Names and values, which are JSON themselves. */
using JsonMembers = std::vector<std::pair<std::string, std::string>>;

/** Arrays and objects. @p indent: that of their items, each on a line of its own; 0: all on one line. */
std::string json_list(const std::vector<std::string> &items, unsigned int indent = 0);
std::string json_members(const JsonMembers &members, unsigned int indent = 0);

/** An array of these texts. */
std::string json_strings(std::vector<std::string> words, unsigned int indent = 0);

/** As an object of JSON. */
std::string json_object(const Record &record);

/** A whole file of JSON: an object of these members. */
std::string json_file(const JsonMembers &members);
} // namespace hpvi

#endif
