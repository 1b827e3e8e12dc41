// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_remedies_h
#define hpvi_remedies_h

#include <hpvi/base/parameter_file.h>

#include <deal.II/base/patterns.h>

#include <memory>
#include <string>
#include <vector>

namespace hpvi
{
/** One entry of a parameter file. */
struct Entry
{
  std::string section; ///< empty: top level
  std::string name;
  std::string default_value;
  std::shared_ptr<const dealii::Patterns::PatternBase> pattern;
  std::string wanted; ///< completes "give ..." in an error message
  std::string documentation;

  std::string path() const;
  /** "is not accepted here; give ..." where @p value does not match; else empty. */
  std::string objection(const std::string &value) const;
};

/** What to write in the place of names that people try first and no file has. */
struct Alias
{
  std::vector<std::string> words; ///< of entries and subsections, in lower case; none: any entry
  std::string remedy;             ///< completes "is unknown; ..."
  std::string in =
      ""; ///< the section that it is for, or with a blank at its end their kind; empty: all

  bool is_for(const std::string &section) const;
};

/** What to write in the place of unknown names: a hint, an entry of this name, a name that differs in few letters, or all that there are. */
class Remedies
{
public:
  /** Both live at least as long as this. */
  Remedies(const std::vector<Entry> &entries, const std::vector<Alias> &aliases);

  bool knows_section(const std::string &section) const;

  /** Throws InputError: an unknown section, or an unknown entry of a known one. */
  [[noreturn]] void refuse(const Assignment &assignment) const;

private:
  std::string instead_of_section(const std::string &section) const;
  std::string instead_of_entry(const std::string &section, const std::string &name) const;
  std::string names_of_kind(const std::string &section) const;
  /** What is known of @p word, an entry of @p section or, of no entry, that itself; empty: nothing. */
  std::string hint(const std::string &section, const std::string &word) const;
  std::string of_this_scene(const std::string &remedy, const std::string &section) const;
  std::vector<std::string> sections() const;
  std::vector<std::string> names_in(const std::string &section) const;
  /** The quoted paths of all entries called @p name, "a", "b" or "c". */
  std::string entries_called(const std::string &name) const;

  const std::vector<Entry> &entries;
  const std::vector<Alias> &aliases;
};
} // namespace hpvi

#endif
