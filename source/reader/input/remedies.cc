// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/input/remedies.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <regex>

namespace hpvi
{
using namespace dealii;

namespace
{
std::string quoted(const std::string &name)
{
  return "\"" + name + "\"";
}

/** May @p written be a slip of the pen for @p known? Word by word, for "Boundary low" is not meant for "Boundary top". */
bool is_near(const std::string &written, const std::string &known)
{
  const unsigned int distance = edit_distance(written, known);
  if (distance <= 1)
    return known.size() > 2;
  const std::vector<std::string> a = Utilities::split_string_list(written, ' '),
                                 b = Utilities::split_string_list(known, ' ');
  if (distance > 3 || a.size() != b.size())
    return false;
  for (std::size_t k = 0; k < a.size(); ++k)
    if (3 * edit_distance(a[k], b[k]) > std::max(a[k].size(), b[k].size()))
      return false;
  return true;
}

/** The one of @p names that @p written may be meant for; empty: none. */
std::string nearest(const std::string &written, const std::vector<std::string> &names)
{
  std::string result;
  for (const std::string &name : names)
    if (is_near(written, name) &&
        (result.empty() || edit_distance(written, name) < edit_distance(written, result)))
      result = name;
  return result;
}
} // namespace

bool Alias::is_for(const std::string &section) const
{
  const bool is_kind = !in.empty() && in.back() == ' ';
  return in.empty() || section == in || (is_kind && section.rfind(in, 0) == 0);
}

Remedies::Remedies(const std::vector<Entry> &entries, const std::vector<Alias> &aliases)
    : entries(entries), aliases(aliases)
{
}

bool Remedies::knows_section(const std::string &section) const
{
  return std::any_of(entries.begin(), entries.end(),
                     [&](const Entry &entry) { return entry.section == section; });
}

void Remedies::refuse(const Assignment &assignment) const
{
  if (!knows_section(assignment.section))
    fail(assignment.where, assignment.section,
         "is an unknown subsection; " + instead_of_section(assignment.section));
  const Entry written{assignment.section, assignment.name, "", nullptr, "", ""};
  fail(assignment.where, written.path() + " = " + assignment.value,
       "is an unknown entry; " + instead_of_entry(assignment.section, assignment.name));
}

std::vector<std::string> Remedies::sections() const
{
  std::vector<std::string> result;
  for (const Entry &entry : entries)
    if (!entry.section.empty() &&
        std::find(result.begin(), result.end(), entry.section) == result.end())
      result.push_back(entry.section);
  return result;
}

std::vector<std::string> Remedies::names_in(const std::string &section) const
{
  std::vector<std::string> result;
  for (const Entry &entry : entries)
    if (entry.section == section)
      result.push_back(entry.name);
  return result;
}

std::string Remedies::entries_called(const std::string &name) const
{
  std::vector<std::string> result;
  for (const Entry &entry : entries)
    if (lower_case(entry.name) == lower_case(name))
      result.push_back(quoted(entry.path()));
  return listed(result, "or");
}

std::string Remedies::hint(const std::string &section, const std::string &word) const
{
  for (const Alias &hint : aliases)
    if (hint.is_for(section) &&
        (hint.words.empty() ||
         std::find(hint.words.begin(), hint.words.end(), lower_case(word)) != hint.words.end()))
      return of_this_scene(hint.remedy, section);
  return {};
}

/** With the entries of @p section in the place of those of others, or where there are none with those that the scene has. */
std::string Remedies::of_this_scene(const std::string &remedy, const std::string &section) const
{
  static const std::regex path("\"([^\"/]+)/([^\"/]+)\"");
  std::string result;
  auto rest = remedy.begin();
  for (std::sregex_iterator found(remedy.begin(), remedy.end(), path), end; found != end; ++found)
  {
    std::string own = (*found)[1];
    const std::string name = (*found)[2], kind = own.substr(0, own.find(' ') + 1);
    const auto take = [&](const auto &is_meant)
    {
      const auto entry =
          std::find_if(entries.begin(), entries.end(),
                       [&](const Entry &one) { return one.name == name && is_meant(one.section); });
      own = entry == entries.end() ? own : entry->section;
      return entry != entries.end();
    };
    take([&](const std::string &one) { return one == section; }) ||
        take([&](const std::string &one) { return one == own; }) ||
        take([&](const std::string &one) { return !kind.empty() && one.rfind(kind, 0) == 0; }) ||
        take([](const std::string &) { return true; });
    result.append(rest, remedy.begin() + found->position());
    result += quoted(own + "/" + name);
    rest = remedy.begin() + found->position() + found->length();
  }
  return result.append(rest, remedy.end());
}

/** Of several sections that begin with the same word as @p section: "left" and "top" of "Boundary left", "Boundary top". */
std::string Remedies::names_of_kind(const std::string &section) const
{
  const std::string kind = section.substr(0, section.find(' ') + 1);
  std::vector<std::string> names;
  for (const std::string &known : sections())
    if (!kind.empty() && known.rfind(kind, 0) == 0)
      names.push_back(known.substr(kind.size()));
  return names.size() > 1 ? listed(names, "and") : "";
}

std::string Remedies::instead_of_section(const std::string &section) const
{
  if (const std::string remedy = hint("", section); !remedy.empty())
    return remedy;
  if (const std::string entry = entries_called(section); !entry.empty())
    return "this is an entry: set " + entry;
  if (const std::string near = nearest(section, sections()); !near.empty())
    return "the nearest known one is " + quoted(near);
  if (const std::string names = names_of_kind(section); !names.empty())
    return "this scene has: " + names;
  return "there are " + listed(sections(), "and");
}

std::string Remedies::instead_of_entry(const std::string &section, const std::string &name) const
{
  if (const std::string remedy = hint(section, name); !remedy.empty())
    return remedy;
  const std::vector<std::string> all = sections(), here = names_in(section);
  if (const std::string near = nearest(name, here); !near.empty())
    return "the nearest known one is " + quoted(section.empty() ? near : section + "/" + near);
  if (std::find(all.begin(), all.end(), name) != all.end())
    return "this is a subsection, which has " + listed(names_in(name), "and");
  if (const std::string elsewhere = entries_called(name); !elsewhere.empty())
    return "set " + elsewhere;
  if (!section.empty())
    return section + " has " + listed(here, "and");
  return listed(here, "and") + " stand outside of subsections, all other entries in " +
         listed(all, "or");
}

} // namespace hpvi
