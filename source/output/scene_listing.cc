// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/output/html.h>
#include <hpvi/output/scene_listing.h>
#include <hpvi/reader/bodies_reader.h>
#include <hpvi/reader/probe_reader.h>
#include <hpvi/reader/scene_entries.h>

#include <map>
#include <sstream>
#include <utility>

namespace hpvi
{
namespace
{
/** By kind of section and name of entry: a Boundary has the same wherever it is. */
using Defaults = std::map<std::pair<std::string, std::string>, std::string>;

std::string kind_of(const std::string &section)
{
  return section == "Body force" ? section : section.substr(0, section.find(' '));
}

Defaults defaults_of(const int dim)
{
  Defaults defaults;
  std::vector<Entry> entries = scene_entries(dim, {{"NAME"}, {}});
  for (const auto &some : {body_entries("NAME"), pair_entries("NAME"), probe_entries(dim, "NAME")})
    entries.insert(entries.end(), some.begin(), some.end());
  for (const Entry &entry : entries)
    defaults[{kind_of(entry.section), entry.name}] = entry.default_value;
  return defaults;
}

std::string trimmed(const std::string &text)
{
  const std::size_t begin = text.find_first_not_of(' '), end = text.find_last_not_of(' ');
  return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

bool is_default(const Defaults &defaults, const std::string &section, const std::string &line)
{
  const std::size_t set = line.find("set "), equals = line.find('=');
  if (set == std::string::npos || equals == std::string::npos)
    return false;
  const std::string value = trimmed(line.substr(equals + 1));
  const auto found =
      defaults.find({kind_of(section), trimmed(line.substr(set + 4, equals - set - 4))});
  // What a further material leaves open is that of elsewhere.
  return value.empty() || (found != defaults.end() && found->second == value);
}
} // namespace

std::string scene_listing(const std::string &scene_prm, const int dim)
{
  const Defaults defaults = defaults_of(dim);
  std::string listing, lines, section, line;
  bool says_nothing = true;
  const auto marked = [](const std::string &text, const bool is_at_default)
  { return is_at_default ? "<span class=\"default\">" + text + "</span>" : text; };
  std::istringstream in(scene_prm);
  while (std::getline(in, line))
  {
    const bool opens = line.rfind("subsection ", 0) == 0, closes = line == "end";
    if (opens)
    {
      section = line.substr(11);
      says_nothing = true;
    }
    const bool is_at_default = is_default(defaults, section, line);
    if (!opens && !closes)
      says_nothing = says_nothing && is_at_default;
    lines += marked(xml_text(line) + "\n", is_at_default);
    if (section.empty() || closes)
    {
      listing += says_nothing && closes ? marked(lines, true) : lines;
      lines.clear();
      section.clear();
    }
  }
  return "<pre>" + listing + lines + "</pre>\n";
}
} // namespace hpvi
