// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

namespace hpvi
{
using namespace dealii;

Character character_at(const std::string &text, const std::size_t start)
{
  const unsigned char first = text[start];
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xC0 ? 0
                             : first < 0xE0 ? 2
                             : first < 0xF0 ? 3
                             : first < 0xF8 ? 4
                                            : 0;
  char32_t code = length < 2 ? first : first & (0x7F >> length);
  for (std::size_t i = start + 1; i < start + length; ++i)
  {
    if (i == text.size() || (text[i] & 0xC0) != 0x80)
      return {0, 0};
    code = code << 6 | (text[i] & 0x3F);
  }
  constexpr char32_t smallest[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  return code < smallest[length] || code > 0x10FFFF || surrogate ? Character{0, 0}
                                                                 : Character{code, length};
}

namespace
{
bool is_control(const char32_t code)
{
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || (code >= 0x2028 && code <= 0x202E) ||
         (code >= 0x2066 && code <= 0x2069);
}
} // namespace

std::string printable(const std::string &text, const std::size_t limit)
{
  std::string result;
  for (std::size_t i = 0; i < text.size();)
  {
    const Character character = character_at(text, i);
    const std::size_t length = std::max<std::size_t>(character.length, 1);
    if (result.size() + length > limit)
      return result + "...";
    if (std::isspace(static_cast<unsigned char>(text[i])))
      result += ' ';
    else if (character.length == 0 || is_control(character.code))
      result += '?';
    else
      result.append(text, i, length);
    i += length;
  }
  return result;
}

std::string lower_case(std::string text)
{
  for (char &c : text)
    c = std::tolower(static_cast<unsigned char>(c));
  return text;
}

std::string single_spaced(const std::string &text)
{
  std::istringstream words(text);
  std::string word, result;
  while (words >> word)
    result += (result.empty() ? "" : " ") + word;
  return result;
}

std::vector<std::string> split_components(const std::string &text)
{
  std::vector<std::string> parts;
  std::istringstream stream(text + ";");
  for (std::string part; std::getline(stream, part, ';');)
    parts.push_back(Utilities::trim(part));
  return parts;
}

std::string listed(const std::vector<std::string> &names, const std::string &conjunction)
{
  std::string result;
  for (std::size_t k = 0; k < names.size(); ++k)
    result += (k == 0 ? "" : k + 1 == names.size() ? " " + conjunction + " " : ", ") + names[k];
  return result;
}

unsigned int edit_distance(const std::string &left, const std::string &right)
{
  const std::string a = lower_case(left), b = lower_case(right);
  std::vector<unsigned int> row(b.size() + 1);
  for (unsigned int j = 0; j <= b.size(); ++j)
    row[j] = j;
  for (unsigned int i = 1; i <= a.size(); ++i)
  {
    unsigned int diagonal = row[0];
    row[0] = i;
    for (unsigned int j = 1; j <= b.size(); ++j)
    {
      const unsigned int replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

template <int dim>
std::string to_string(const Point<dim> &x)
{
  std::ostringstream out;
  out << "(";
  for (unsigned int d = 0; d < dim; ++d)
    out << (d > 0 ? ", " : "") << (std::abs(x[d]) < 1e-300 ? 0. : x[d]);
  out << ")";
  return out.str();
}

std::string to_string(const double value)
{
  std::ostringstream out;
  out << value;
  return out.str();
}

std::string one_line(const std::exception &error)
{
  const std::size_t limit = 1000;
  const auto *dealii_error = dynamic_cast<const ExceptionBase *>(&error);
  if (dealii_error == nullptr)
    return printable(error.what(), limit);
  std::ostringstream text;
  dealii_error->print_info(text);
  return printable(single_spaced(text.str()), limit);
}

template std::string to_string(const Point<2> &);
template std::string to_string(const Point<3> &);
} // namespace hpvi
