// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/output/record.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

namespace hpvi
{
namespace
{
/** One that all of @p text is. */
template <class Number>
std::optional<Number> parsed(const std::string &text)
{
  Number number{};
  const char *const end = text.data() + text.size();
  if (text.empty() || std::from_chars(text.data(), end, number).ptr != end)
    return std::nullopt;
  return number;
}

std::string quoted(const std::string &field)
{
  if (field.find_first_of(",\"\n\r") == std::string::npos)
    return field;
  std::string result = "\"";
  for (const char c : field)
    result += c == '"' ? "\"\"" : std::string(1, c);
  return result + '"';
}

/** The inverse, of a whole line. */
std::vector<std::string> fields_of(const std::string &line)
{
  std::vector<std::string> fields(1);
  bool is_quoted = false;
  for (std::size_t k = 0; k < line.size(); ++k)
    if (line[k] == '"' && is_quoted && k + 1 < line.size() && line[k + 1] == '"')
      fields.back() += line[++k];
    else if (line[k] == '"')
      is_quoted = !is_quoted;
    else if (line[k] == ',' && !is_quoted)
      fields.emplace_back();
    else
      fields.back() += line[k];
  return fields;
}

/** Names or values: @p of says which. */
template <class Fields, class Text>
void add_line(std::string &table, const Fields &fields, const Text &of)
{
  std::string separator;
  for (const auto &field : fields)
    table += std::exchange(separator, ",") + quoted(of(field));
  table += '\n';
}

/** Items between what opens and closes their list. */
std::string enclosed(const std::string &ends, const std::vector<std::string> &items,
                     const unsigned int indent)
{
  const std::string line = indent == 0 ? "" : "\n" + std::string(indent, ' ');
  std::string list;
  for (const std::string &item : items)
    list += (list.empty() ? line : indent == 0 ? ", " : "," + line) + item;
  return ends[0] + list + (list.empty() || indent == 0 ? "" : "\n" + std::string(indent - 2, ' ')) +
         ends[1];
}
} // namespace

std::string text(const Value &value)
{
  if (const std::string *const words = std::get_if<std::string>(&value))
    return *words;
  if (const std::uint64_t *const count = std::get_if<std::uint64_t>(&value))
    return std::to_string(*count);
  const std::optional<double> finite = number(value);
  return finite ? text(*finite) : "";
}

Value value_from(const std::string &field)
{
  const auto count = parsed<std::uint64_t>(field);
  const auto number = parsed<double>(field);
  for (const Value &value : {count ? Value(*count) : Value(), number ? Value(*number) : Value()})
    if (text(value) == field)
      return value;
  return field;
}

std::optional<double> number(const Value &value)
{
  if (const std::uint64_t *const count = std::get_if<std::uint64_t>(&value))
    return *count;
  if (const std::string *const words = std::get_if<std::string>(&value))
    return parsed<double>(*words);
  const double *const number = std::get_if<double>(&value);
  return number && std::isfinite(*number) ? std::optional(*number) : std::nullopt;
}

Value value_of(const Record &record, const std::string &column)
{
  for (const auto &[name, value] : record)
    if (name == column)
      return value;
  return {};
}

std::string words_of(const Record &record, const std::string &column)
{
  return text(value_of(record, column));
}

std::optional<double> number_of(const Record &record, const std::string &column)
{
  return number(value_of(record, column));
}

std::string csv(const std::vector<Record> &records)
{
  std::vector<std::string> columns; // of most tables those of each row
  for (const Record &record : records)
    for (std::size_t k = 0; k < record.size(); ++k)
      if (const std::string &name = record[k].first;
          (k >= columns.size() || columns[k] != name) &&
          std::find(columns.begin(), columns.end(), name) == columns.end())
        columns.push_back(name);
  std::string table;
  if (!records.empty())
    add_line(table, columns, [](const std::string &column) { return column; });
  for (const Record &record : records)
  {
    std::size_t k = 0;
    add_line(table, columns,
             [&](const std::string &column)
             {
               const bool is_next = k < record.size() && record[k].first == column;
               return is_next ? text(record[k++].second) : words_of(record, column);
             });
  }
  return table;
}

std::vector<Record> records(const std::string &csv)
{
  std::vector<Record> result;
  std::istringstream in(csv.substr(0, csv.rfind('\n') + 1));
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> names = fields_of(line);
  while (std::getline(in, line))
  {
    const std::vector<std::string> fields = fields_of(line);
    if (fields.size() != names.size())
      return result;
    result.emplace_back();
    for (std::size_t k = 0; k < names.size(); ++k)
      result.back().emplace_back(names[k], value_from(fields[k]));
  }
  return result;
}

void GrowingTable::add(const std::vector<Record> &rows)
{
  same = text.size();
  for (const Record &row : rows)
  {
    if (text.empty())
      add_line(text, row, [](const auto &field) { return field.first; });
    add_line(text, row, [](const auto &field) { return hpvi::text(field.second); });
    last = row;
  }
}

std::string json_value(const Value &value)
{
  const std::string field = text(value);
  return field.empty()                                ? "null"
         : std::holds_alternative<std::string>(value) ? json_string(field)
                                                      : field;
}

std::string json_list(const std::vector<std::string> &items, const unsigned int indent)
{
  return enclosed("[]", items, indent);
}

std::string json_members(const JsonMembers &members, const unsigned int indent)
{
  std::vector<std::string> items;
  for (const auto &[name, value] : members)
    items.push_back(json_string(name) + ": " + value);
  return enclosed("{}", items, indent);
}

std::string json_strings(std::vector<std::string> words, const unsigned int indent)
{
  std::transform(words.begin(), words.end(), words.begin(), json_string);
  return json_list(words, indent);
}

std::string json_object(const Record &record)
{
  JsonMembers members;
  for (const auto &[name, value] : record)
    members.emplace_back(name, json_value(value));
  return json_members(members, 4);
}

std::string json_file(const JsonMembers &members)
{
  return json_members(members, 2) + "\n";
}
} // namespace hpvi
