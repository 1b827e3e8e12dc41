// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/text.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

namespace hpvi
{
using namespace dealii;

std::string printable(std::string text)
{
  std::replace_if(
      text.begin(), text.end(),
      [](const char c) { return std::iscntrl(static_cast<unsigned char>(c)); }, '?');
  const std::size_t limit = 120;
  return text.size() <= limit ? text : text.substr(0, limit) + "...";
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
  std::ostringstream text;
  if (const auto *dealii_error = dynamic_cast<const ExceptionBase *>(&error))
    dealii_error->print_info(text);
  else
    text << error.what();
  return single_spaced(text.str());
}

template std::string to_string(const Point<2> &);
} // namespace hpvi
