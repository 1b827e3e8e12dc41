// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/output/sweep_table.h>

#include <algorithm>
#include <set>
#include <sstream>

namespace hpvi
{
namespace
{
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

std::vector<std::string> columns_of(const std::vector<Record> &runs)
{
  std::vector<std::string> columns;
  std::set<std::string> known;
  for (const Record &run : runs)
    for (const auto &field : run)
      if (known.insert(field.first).second)
        columns.push_back(field.first);
  return columns;
}

std::string line_of(const std::vector<std::string> &fields)
{
  std::string line;
  for (std::size_t k = 0; k < fields.size(); ++k)
    line += (k > 0 ? "," : "") + quoted(fields[k]);
  return line + '\n';
}
} // namespace

std::string sweep_csv(const std::vector<Record> &runs)
{
  const std::vector<std::string> columns = columns_of(runs);
  std::string table = line_of(columns);
  for (const Record &run : runs)
  {
    std::vector<std::string> fields;
    for (const std::string &column : columns)
    {
      const auto field = std::find_if(run.begin(), run.end(),
                                      [&](const auto &one) { return one.first == column; });
      fields.push_back(field == run.end() ? "" : field->second);
    }
    table += line_of(fields);
  }
  return table;
}

std::vector<std::string> swept_directories(const std::string &sweep_csv)
{
  std::istringstream lines(sweep_csv);
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> columns = fields_of(line);
  const std::size_t column =
      std::find(columns.begin(), columns.end(), "directory") - columns.begin();
  std::vector<std::string> names;
  while (column < columns.size() && std::getline(lines, line))
    if (const std::vector<std::string> fields = fields_of(line); column < fields.size())
      names.push_back(fields[column]);
  return names;
}
} // namespace hpvi
