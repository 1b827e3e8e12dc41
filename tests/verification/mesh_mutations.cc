// SPDX-License-Identifier: LGPL-2.1-or-later
#include "mesh_texts.h"

#include <hpvi/base/input_error.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <random>
#include <sstream>

using namespace hpvi;

namespace
{
using Random = std::mt19937;

std::size_t below(Random &random, const std::size_t n)
{
  return random() % n; // distributions differ between libraries
}

std::vector<std::string> lines_of(const std::string &text)
{
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);)
    lines.push_back(line);
  return lines;
}

std::string joined(const std::vector<std::string> &lines)
{
  std::string text;
  for (const std::string &line : lines)
    text += line + "\n";
  return text;
}

/** A word of the text with something else in its place. */
std::string with_word(const std::string &text, Random &random, const std::string &word)
{
  const std::size_t begin = text.find_first_not_of(" \n", below(random, text.size()));
  if (begin == std::string::npos)
    return text;
  const std::size_t end = std::min(text.find_first_of(" \n", begin), text.size());
  return text.substr(0, begin) + word + text.substr(end);
}

std::string cut(const std::string &text, Random &random)
{
  return text.substr(0, below(random, text.size()));
}

std::string with_bytes(std::string text, Random &random)
{
  for (std::size_t n = 1 + below(random, 4); n > 0; --n)
    text[below(random, text.size())] = char(below(random, 256));
  return text;
}

std::string with_part_removed(std::string text, Random &random)
{
  const std::size_t begin = below(random, text.size());
  return text.erase(begin, 1 + below(random, 60));
}

std::string with_lines_swapped(const std::string &text, Random &random)
{
  std::vector<std::string> lines = lines_of(text);
  std::swap(lines[below(random, lines.size())], lines[below(random, lines.size())]);
  return joined(lines);
}

std::string with_line_repeated(const std::string &text, Random &random)
{
  std::vector<std::string> lines = lines_of(text);
  const std::string line = lines[below(random, lines.size())];
  lines.insert(lines.begin() + below(random, lines.size()), line);
  return joined(lines);
}

std::string with_line_removed(const std::string &text, Random &random)
{
  std::vector<std::string> lines = lines_of(text);
  lines.erase(lines.begin() + below(random, lines.size()));
  return joined(lines);
}

std::string renumbered(const std::string &text, Random &random)
{
  return with_word(text, random, std::to_string(below(random, 20)));
}

std::string with_wild_number(const std::string &text, Random &random)
{
  static const std::vector<std::string> numbers = {"-1",
                                                   "0",
                                                   "1e300",
                                                   "-1e308",
                                                   "nan",
                                                   "inf",
                                                   "2147483648",
                                                   "4294967295",
                                                   "1e-320",
                                                   "1e99999",
                                                   "0x10",
                                                   "9223372036854775807",
                                                   "18446744073709551616",
                                                   "1.5",
                                                   "",
                                                   "+1",
                                                   "-9223372036854775808",
                                                   "99999999",
                                                   "1e-9",
                                                   "1,5"};
  return with_word(text, random, numbers[below(random, numbers.size())]);
}

std::string without_section(const std::string &text, Random &random)
{
  static const std::vector<std::string> names = {"MeshFormat", "PhysicalNames", "Entities", "Nodes",
                                                 "Elements"};
  const std::string name = names[below(random, names.size())];
  const std::size_t begin = text.find("$" + name), end = text.find("$End" + name);
  return begin == std::string::npos || end == std::string::npos || end < begin
             ? text
             : text.substr(0, begin) + text.substr(end + name.size() + 5);
}

/** What binary files hold between their section marks. */
std::string as_binary(const std::string &text, Random &random)
{
  std::string bytes(8 * (1 + below(random, 40)), '\0');
  for (char &byte : bytes)
    byte = char(below(random, 3) == 0 ? below(random, 256) : 0);
  const std::size_t nodes = text.find("$Nodes\n");
  return nodes == std::string::npos ? bytes
                                    : text.substr(0, nodes + 7) + bytes + text.substr(nodes + 7);
}

const std::vector<std::function<std::string(const std::string &, Random &)>> mutations = {
    cut,
    with_bytes,
    with_part_removed,
    with_lines_swapped,
    with_line_repeated,
    with_line_removed,
    renumbered,
    with_wild_number,
    without_section,
    as_binary};

/** Either a body, or one line that names the file. */
void expect_mesh_or_line(const std::string &text)
{
  try
  {
    const CoarseMesh mesh = read_text(text);
    EXPECT_GE(mesh.edges.size(), 4);
    EXPECT_FALSE(mesh.cells.empty());
  }
  catch (const InputError &error)
  {
    const std::string message = error.what();
    EXPECT_EQ(message.find_first_of(std::string("\n\r\0\t", 4)), std::string::npos) << message;
    EXPECT_NE(message.find(".msh:"), std::string::npos) << message;
    EXPECT_LT(message.size(), 600) << message;
  }
}
} // namespace

/** Of a file that is cut short all is there, or nothing. */
TEST(MeshMutations, CutSomewhere)
{
  for (const std::string &text : {two_squares_22, two_squares_41, curved_cell_41})
    for (std::size_t length = 5; length < text.size(); length += 61)
      EXPECT_EQ(message_of(text.substr(0, length)).empty(), length > text.find("$EndElements"))
          << text.substr(0, length);
}

TEST(MeshMutations, GiveABodyOrOneLine)
{
  Random random(29);
  const char *const number = std::getenv("HPVI_DAMAGED");
  for (int n = 0; n < (number == nullptr ? 50 : std::atoi(number)); ++n)
  {
    const std::vector<std::string> texts = {two_squares_22, two_squares_40, two_squares_41,
                                            curved_cell_22, curved_cell_41};
    std::string mutated = texts[n % texts.size()];
    for (std::size_t k = 1 + below(random, 3); k > 0 && mutated.size() > 1; --k)
      mutated = mutations[n / texts.size() % mutations.size()](mutated, random);
    expect_mesh_or_line(mutated);
  }
}
