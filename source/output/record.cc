// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/output/record.h>

#include <charconv>
#include <cmath>
#include <sstream>

namespace hpvi
{
namespace
{
using NameOrValue = std::string Record::value_type::*;

void add_line(std::string &table, const Record &record, const NameOrValue part)
{
  for (std::size_t i = 0; i < record.size(); ++i)
    table += (i > 0 ? "," : "") + record[i].*part;
  table += '\n';
}
} // namespace

std::string known(const double value)
{
  return std::isfinite(value) ? text(value) : "";
}

std::string value_of(const Record &record, const std::string &column)
{
  for (const auto &[name, value] : record)
    if (name == column)
      return value;
  return {};
}

std::string csv(const std::vector<Record> &records)
{
  std::string table;
  if (!records.empty())
    add_line(table, records.back(), &Record::value_type::first);
  for (const Record &record : records)
    add_line(table, record, &Record::value_type::second);
  return table;
}

std::vector<Record> records(const std::string &csv)
{
  const auto fields = [](const std::string &line)
  {
    std::vector<std::string> result(1);
    for (const char c : line)
      if (c == ',')
        result.emplace_back();
      else
        result.back() += c;
    return result;
  };
  std::vector<Record> result;
  std::istringstream in(csv.substr(0, csv.rfind('\n') + 1));
  std::string line;
  std::getline(in, line);
  const std::vector<std::string> names = fields(line);
  while (std::getline(in, line))
  {
    const std::vector<std::string> values = fields(line);
    if (values.size() != names.size())
      return result;
    result.emplace_back();
    for (std::size_t k = 0; k < names.size(); ++k)
      result.back().emplace_back(names[k], values[k]);
  }
  return result;
}

void add_row(GrowingText &table, const Record &row)
{
  table.same = table.text.size();
  if (table.text.empty())
    add_line(table.text, row, &Record::value_type::first);
  add_line(table.text, row, &Record::value_type::second);
}

void add_rows(GrowingText &table, const std::vector<Record> &rows)
{
  const std::size_t same = table.text.size();
  for (const Record &row : rows)
    add_row(table, row);
  table.same = same;
}

std::string json_number(const double value)
{
  return std::isfinite(value) ? text(value) : "null";
}

namespace
{
/** A field is a number that text() wrote, or words. */
std::string json_value(const std::string &field)
{
  double number = 0;
  const char *const end = field.data() + field.size();
  const bool is_number = std::from_chars(field.data(), end, number).ptr == end && !field.empty();
  if (field.empty() || (is_number && !std::isfinite(number)))
    return "null";
  return is_number ? field : json_string(field);
}
} // namespace

std::string json_object(const Record &record)
{
  std::string list;
  for (const auto &[name, value] : record)
    list += (list.empty() ? "\n    " : ",\n    ") + json_string(name) + ": " + json_value(value);
  return "{" + list + "\n  }";
}

std::string json_file(const Record &members)
{
  std::string list;
  for (const auto &[name, value] : members)
    list += (list.empty() ? "\n  " : ",\n  ") + json_string(name) + ": " + value;
  return "{" + list + "\n}\n";
}
} // namespace hpvi
