// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_parameters_h
#define hpvi_parameters_h

#include <hpvi/reader/input/remedies.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>
#include <deal.II/base/point.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace hpvi
{
/** One of @p words. */
std::shared_ptr<const dealii::Patterns::PatternBase> one_of(const std::vector<std::string> &words);

/** @p word, which may be empty, or what @p other accepts. */
std::shared_ptr<const dealii::Patterns::PatternBase>
word_or(const std::string &word, const dealii::Patterns::PatternBase &other);

/**
 * The values of all entries, and where each was set: deal.II's ParameterHandler with error messages
 * of one line that name file, line, entry, value and remedy.
 */
class Parameters
{
public:
  /** All entries have their defaults. @p aliases and @p file are for messages. */
  Parameters(std::vector<Entry> entries, std::vector<Alias> aliases, const std::string &file);

  /** Take them in turn. */
  void read(const std::vector<Assignment> &assignments);

  /** Give an entry its final value where the file leaves it to the program. */
  void set(const std::string &section, const std::string &name, const std::string &value);

  const std::string &file_name() const; ///< as the user wrote it

  /** Does the file or an override give the entry a value? */
  bool is_named(const std::string &section, const std::string &name) const;

  std::string text(const std::string &section, const std::string &name) const;
  double number(const std::string &section, const std::string &name) const;
  unsigned int integer(const std::string &section, const std::string &name) const;
  bool boolean(const std::string &section, const std::string &name) const;

  bool has(const std::string &section, const std::string &name) const; ///< is there such an entry?

  /** Sections in which an entry of this name has a value, in the order of the entries. */
  std::vector<std::string> sections_with(const std::string &name) const;

  /** The same with @p other wherever @p section is asked for: each body has a section with the entries of Geometry. */
  std::shared_ptr<const Parameters> with_section(const std::string &section,
                                                 const std::string &other) const;

  std::string standing_for(const std::string &section) const; ///< that @p other; empty: none

  /** Points "x, y; x, y; ..." */
  template <int dim>
  std::vector<dealii::Point<dim>> points(const std::string &section, const std::string &name) const;

  /** FILE:LINE: Section/Entry = value, where the line about a wrong value begins. */
  std::string place(const std::string &section, const std::string &name) const;

  /** The one line about an entry whose value is wrong. */
  [[noreturn]] void reject(const std::string &section, const std::string &name,
                           const std::string &problem_and_remedy) const;

  /** All entries with their values; @p documented: each below its documentation and default. */
  std::string print(bool documented) const;

private:
  template <typename Action>
  void in_section(const std::string &section, const Action &action);
  /** Checks name and form. */
  void assign(const Assignment &assignment);
  /** Null for the opening line of a known subsection. Throws where the name is unknown. */
  const Entry *known_entry(const Assignment &assignment) const;
  const std::string &own(const std::string &section) const; ///< with_section()

  const std::vector<Entry> entries;
  const std::vector<Alias> aliases;
  const std::string file, shown; ///< as it is, and as messages name it
  dealii::ParameterHandler prm;
  std::map<std::string, std::string> origins;
  std::pair<std::string, std::string> replaced; ///< a section and what stands in its place
};
} // namespace hpvi

#endif
