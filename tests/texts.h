// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_tests_texts_h
#define hpvi_tests_texts_h

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

/** What @p action fails with; empty: it does not. */
template <class Failure, class Action>
std::string failure_of(const Action &action)
{
  try
  {
    action();
  }
  catch (const Failure &failure)
  {
    return failure.what();
  }
  return {};
}

/** All digits of a number, for entries and expressions. */
inline std::string in_digits(const double value)
{
  std::ostringstream out;
  out << std::setprecision(17) << value;
  return out.str();
}

inline bool says(const std::string &text, const std::string &words)
{
  return text.find(words) != std::string::npos;
}

/** Does any of the texts hold these words? */
inline bool mentions(const std::vector<std::string> &texts, const std::string &words)
{
  return std::any_of(texts.begin(), texts.end(),
                     [&](const std::string &text) { return says(text, words); });
}

#endif
