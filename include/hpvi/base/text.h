// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_text_h
#define hpvi_text_h

#include <deal.II/base/point.h>

#include <cstddef>
#include <exception>
#include <string>
#include <vector>

namespace hpvi
{
/** A character of a text in UTF-8 and the number of its bytes, 0 where there is none. */
struct Character
{
  char32_t code;
  std::size_t length;
};

/** The character that begins at byte @p start. */
Character character_at(const std::string &text, std::size_t start);

/**
 * @p text fit for one line of a message: white space is a blank; what is no UTF-8, control
 * characters and those that break or turn lines are '?'; no more than @p limit bytes.
 */
std::string printable(const std::string &text, std::size_t limit = 120);

std::string lower_case(std::string text);

/** Trim, and make every run of white space one blank, as in names of entries. */
std::string single_spaced(const std::string &text);

/** The parts of @p text between semicolons, trimmed; empty parts are kept. */
std::vector<std::string> split_components(const std::string &text);

/** "a, b and c" with "and" as the @p conjunction. */
std::string listed(const std::vector<std::string> &names, const std::string &conjunction);

/** Number of insertions, deletions and replacements between two words, case ignored. */
unsigned int edit_distance(const std::string &left, const std::string &right);

/** "(x, y)" */
template <int dim>
std::string to_string(const dealii::Point<dim> &x);

/** With six digits at most. */
std::string to_string(double value);

/** What an exception says, on one line: what() of deal.II's fills a page. */
std::string one_line(const std::exception &error);
} // namespace hpvi

#endif
