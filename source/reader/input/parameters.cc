// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/reader/input/parameters.h>

#include <hpvi/base/display_name.h>
#include <hpvi/base/input_error.h>
#include <hpvi/base/text.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <sstream>

namespace hpvi
{
using namespace dealii;

std::string Entry::path() const
{
  return section.empty() ? name : section + "/" + name;
}

std::string Entry::objection(const std::string &value) const
{
  return pattern->match(value) ? "" : "is not accepted here; give " + wanted;
}

namespace
{
class WordOr : public Patterns::PatternBase
{
public:
  WordOr(const std::string &word, const Patterns::PatternBase &other)
      : word(word), other(other.clone())
  {
  }

  bool match(const std::string &text) const override
  {
    return text == word || other->match(text);
  }

  std::string description(const OutputStyle style) const override
  {
    return (word.empty() ? "nothing" : word) + " or " + other->description(style);
  }

  std::unique_ptr<Patterns::PatternBase> clone() const override
  {
    return std::make_unique<WordOr>(*this);
  }

private:
  std::string word;
  std::shared_ptr<const Patterns::PatternBase> other;
};
} // namespace

std::shared_ptr<const Patterns::PatternBase> one_of(const std::vector<std::string> &words)
{
  std::string all;
  for (const std::string &word : words)
    all += (all.empty() ? "" : "|") + word;
  return std::make_shared<Patterns::Selection>(all);
}

std::shared_ptr<const Patterns::PatternBase> word_or(const std::string &word,
                                                     const Patterns::PatternBase &other)
{
  return std::make_shared<WordOr>(word, other);
}

template <typename Action>
void Parameters::in_section(const std::string &section, const Action &action)
{
  if (!section.empty())
    prm.enter_subsection(section);
  action();
  if (!section.empty())
    prm.leave_subsection();
}

Parameters::Parameters(std::vector<Entry> all_entries, std::vector<Alias> all_aliases,
                       const std::string &file)
    : entries(std::move(all_entries)), aliases(std::move(all_aliases)), file(file),
      shown(display_name(file))
{
  for (const Entry &entry : entries)
    in_section(entry.section,
               [&]()
               {
                 prm.declare_entry(entry.name, entry.default_value, *entry.pattern,
                                   entry.documentation + " Accepts " + entry.wanted + ".");
               });
}

void Parameters::read(const std::vector<Assignment> &assignments)
{
  for (const Assignment &assignment : assignments)
    assign(assignment);
}

void Parameters::assign(const Assignment &assignment)
{
  const Entry *entry = known_entry(assignment);
  if (entry == nullptr)
    return;
  std::string value = assignment.value;
  std::replace_if( // deal.II's lists trim nothing but blanks
      value.begin(), value.end(), [](const unsigned char c) { return std::isspace(c); }, ' ');
  if (const std::string objection = entry->objection(value); !objection.empty())
    fail(assignment.where, entry->path() + " = " + value, objection);
  origins[entry->path()] = assignment.where;
  set(entry->section, entry->name, value);
}

void Parameters::set(const std::string &section, const std::string &name, const std::string &value)
{
  in_section(section, [&]() { prm.set(name, value); });
}

const std::string &Parameters::file_name() const
{
  return file;
}

bool Parameters::is_named(const std::string &section, const std::string &name) const
{
  return origins.count(section.empty() ? name : own(section) + "/" + name) > 0;
}

std::string Parameters::text(const std::string &section, const std::string &name) const
{
  return section.empty() ? prm.get(name) : prm.get({own(section)}, name);
}

namespace
{
/** As the patterns read it: deal.II's conversion throws where a number is below the normal ones. */
double to_number(const std::string &text)
{
  double value = 0;
  std::istringstream(text) >> value;
  return value;
}
} // namespace

double Parameters::number(const std::string &section, const std::string &name) const
{
  return to_number(text(section, name));
}

unsigned int Parameters::integer(const std::string &section, const std::string &name) const
{
  return prm.get_integer({own(section)}, name);
}

bool Parameters::boolean(const std::string &section, const std::string &name) const
{
  return prm.get_bool({own(section)}, name);
}

std::vector<std::string> Parameters::sections_with(const std::string &name) const
{
  std::vector<std::string> result;
  for (const Entry &entry : entries)
    if (entry.name == name && !text(entry.section, name).empty())
      result.push_back(entry.section);
  return result;
}

bool Parameters::has(const std::string &section, const std::string &name) const
{
  return std::any_of(entries.begin(), entries.end(),
                     [&](const Entry &entry)
                     { return entry.section == own(section) && entry.name == name; });
}

const std::string &Parameters::own(const std::string &section) const
{
  return section == replaced.first ? replaced.second : section;
}

std::string Parameters::standing_for(const std::string &section) const
{
  return section == replaced.first ? replaced.second : "";
}

std::shared_ptr<const Parameters> Parameters::with_section(const std::string &section,
                                                           const std::string &other) const
{
  const auto result = std::make_shared<Parameters>(entries, aliases, file);
  for (const Entry &entry : entries)
    result->set(entry.section, entry.name, text(entry.section, entry.name));
  result->origins = origins;
  result->replaced = {section, other};
  return result;
}

template <int dim>
std::vector<Point<dim>> Parameters::points(const std::string &section,
                                           const std::string &name) const
{
  std::vector<Point<dim>> result;
  for (const std::string &point : Utilities::split_string_list(text(section, name), ';'))
  {
    const std::vector<std::string> x = Utilities::split_string_list(point, ',');
    result.emplace_back();
    std::transform(x.begin(), x.end(), result.back().begin_raw(), to_number);
  }
  return result;
}

std::string Parameters::place(const std::string &section, const std::string &name) const
{
  const std::string path = section.empty() ? name : own(section) + "/" + name;
  const auto origin = origins.find(path);
  return (origin == origins.end() ? shown : origin->second) + ": " +
         printable(path + " = " + text(section, name));
}

void Parameters::reject(const std::string &section, const std::string &name,
                        const std::string &problem) const
{
  const std::string path = section.empty() ? name : own(section) + "/" + name;
  const auto origin = origins.find(path);
  fail(origin == origins.end() ? shown : origin->second, path + " = " + text(section, name),
       problem);
}

std::string Parameters::print(const bool documented) const
{
  std::ostringstream out;
  const auto style = documented ? ParameterHandler::PRM : ParameterHandler::ShortPRM;
  prm.print_parameters(
      out, ParameterHandler::OutputStyle(style | ParameterHandler::KeepDeclarationOrder));
  return out.str();
}

const Entry *Parameters::known_entry(const Assignment &assignment) const
{
  const auto is_there = [&](const Entry &entry)
  { return entry.section == assignment.section && entry.name == assignment.name; };
  const auto entry = std::find_if(entries.begin(), entries.end(), is_there);
  if (entry != entries.end())
    return &*entry;
  const Remedies remedies(entries, aliases);
  if (!assignment.name.empty() || !remedies.knows_section(assignment.section))
    remedies.refuse(assignment);
  return nullptr;
}

template std::vector<Point<2>> Parameters::points<2>(const std::string &,
                                                     const std::string &) const;
template std::vector<Point<3>> Parameters::points<3>(const std::string &,
                                                     const std::string &) const;
} // namespace hpvi
