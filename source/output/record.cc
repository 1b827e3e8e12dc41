// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/output/record.h>

namespace hpvi
{
std::string csv(const std::vector<Record> &records)
{
  std::string table;
  const auto add_line = [&table](const Record &record, const auto &field)
  {
    for (std::size_t i = 0; i < record.size(); ++i)
      table += (i > 0 ? "," : "") + field(record[i]);
    table += '\n';
  };
  if (!records.empty())
    add_line(records.back(), [](const auto &entry) { return entry.first; });
  for (const Record &record : records)
    add_line(record, [](const auto &entry) { return entry.second; });
  return table;
}

namespace
{
std::string json_value(const std::string &field)
{
  if (field.empty() || field.find_first_of("infa") != std::string::npos)
    return "null";
  return field.find_first_of("/ ") != std::string::npos ? json_string(field) : field;
}
} // namespace

std::string json_object(const Record &record)
{
  std::string list;
  for (const auto &[name, value] : record)
    list += (list.empty() ? "\n    " : ",\n    ") + json_string(name) + ": " + json_value(value);
  return "{" + list + "\n  }";
}
} // namespace hpvi
