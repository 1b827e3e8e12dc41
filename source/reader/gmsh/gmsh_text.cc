// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/file_format.h>
#include <hpvi/base/text.h>
#include <hpvi/reader/gmsh/gmsh_text.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace hpvi
{
namespace
{
constexpr std::string_view blanks = " \t\r\v\f";

std::string_view trimmed(const std::string_view line)
{
  const std::size_t begin = line.find_first_not_of(blanks);
  return begin == std::string_view::npos
             ? std::string_view()
             : line.substr(begin, line.find_last_not_of(blanks) - begin + 1);
}

void split_words(const std::string_view line, std::vector<std::string_view> &words)
{
  words.clear();
  for (std::size_t begin = line.find_first_not_of(blanks); begin != std::string_view::npos;)
  {
    const std::size_t end = std::min(line.find_first_of(blanks, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(blanks, end);
  }
}

std::string in_quotes(const std::string_view text)
{
  return '"' + printable(std::string(text), 40) + '"';
}

/** A device would be read for ever. */
std::string checked_content(const std::string &path, const MeshComplaint &complain)
{
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    complain("is a directory; name a mesh file of Gmsh (.msh)");
  const bool is_file = std::filesystem::is_regular_file(path, error);
  if (!is_file || !std::ifstream(path))
    complain("cannot be read; check the name and the permissions of the file");
  const std::uintmax_t limit = 1 << 30, size = std::filesystem::file_size(path, error);
  if (error || size > limit)
    complain(
        "is larger than a gigabyte; name a coarse mesh, cells are bisected where they need it");
  return content_of(path);
}

bool ends_with(const std::string &text, const std::string &end)
{
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}
} // namespace

GmshText::GmshText(const std::string &path)
    : complain(path), content(checked_content(path, complain))
{
  if (content.find_first_not_of(" \t\r\n") == std::string::npos)
    complain("is empty; write it anew with Gmsh");
  if (ends_with(path, ".geo"))
    complain("is a drawing, no mesh; mesh it with gmsh -2 -format msh41 " + printable(path, 400));
  read_format();
  split();
}

/** Before all else: a binary file has no lines. */
void GmshText::read_format()
{
  const std::string start = "$MeshFormat";
  std::size_t begin = content.find(start); // a comment may speak of it before
  while (begin != std::string::npos && begin > 0 && content[begin - 1] != '\n' && begin != 3)
    begin = content.find(start, begin + 1);
  if (begin == std::string::npos)
    complain(
        "is no mesh file of Gmsh in format 4.1 or 2.2: $MeshFormat is not in it; name a .msh file");
  begin = std::min(content.find_first_not_of(" \t\r\n", begin + start.size()), content.size());
  const std::size_t end = std::min(content.find('\n', begin), content.size());
  std::vector<std::string_view> words;
  split_words(std::string_view(content).substr(begin, end - begin), words);
  if (words.size() != 3)
    complain("has no format below $MeshFormat, as in 4.1 0 8; write it anew with Gmsh");
  if (words[1] == "1")
    complain("is a binary file; write it as text: " + complain.rewriting());
  format = std::string(words[0]);
  const auto known = {"4.1", "4.0", "4", "2.2", "2.1", "2.0", "2"};
  if (std::find(known.begin(), known.end(), format) == known.end())
    complain("is in format " + in_quotes(format) +
             " of Gmsh, and 4.1 and 2.2 are read; write it anew: " + complain.rewriting());
  if (content.find('\0') != std::string::npos)
    complain("holds bytes that are no text; write it anew with Gmsh");
}

void GmshText::split()
{
  std::string_view rest(content);
  if (rest.substr(0, 3) == "\xEF\xBB\xBF") // byte order mark
    rest.remove_prefix(3);
  while (!rest.empty())
  {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    lines.push_back(trimmed(rest.substr(0, end)));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (!lines[i].empty())
      i = read_section(i);
}

/** Returns the line that ends it. What is skipped may hold anything, in other sections a dollar is out of place. */
std::size_t GmshText::read_section(const std::size_t line)
{
  if (lines[line].front() != '$')
    complain.damaged(line + 1, in_quotes(lines[line]) + " stands in no section");
  const std::string name(lines[line].substr(1)), ending = "$End" + name;
  if (name.substr(0, 3) == "End")
    complain.damaged(line + 1, in_quotes(lines[line]) + " ends a section that has not begun");
  const auto names = {"MeshFormat", "PhysicalNames", "Entities", "Nodes", "Elements"};
  const bool is_read = std::find(names.begin(), names.end(), name) != names.end();
  const auto leaves = [&](const std::string_view text)
  { return text == ending || (is_read && !text.empty() && text.front() == '$'); };
  const std::size_t end =
      std::find_if(lines.begin() + line + 1, lines.end(), leaves) - lines.begin();
  if (end == lines.size())
    complain("ends within section " + in_quotes(lines[line]) + " of line " +
             std::to_string(line + 1) + "; the file is cut short, write it anew with Gmsh");
  if (lines[end] != ending)
    complain.damaged(end + 1, in_quotes(lines[end]) + " stands within section $" + name);
  if (!sections.insert({name, {line + 1, end}}).second && is_read)
    complain.damaged(line + 1, "the file has a second section $" + name);
  return end;
}

bool GmshText::has(const std::string &section) const
{
  return sections.find(section) != sections.end();
}

const std::string &GmshText::version() const
{
  return format;
}

GmshRecords::GmshRecords(const GmshText &text, const std::string &section)
    : text(text), name(section), position(0), end(0), current(0)
{
  const auto found = text.sections.find(section);
  if (found == text.sections.end())
    text.complain("has no section $" + section + "; write it anew with Gmsh");
  position = found->second.begin;
  end = found->second.end;
  skip_empty();
}

void GmshRecords::skip_empty()
{
  while (position < end && text.lines[position].empty())
    ++position;
}

bool GmshRecords::is_at_end() const
{
  return position == end;
}

void GmshRecords::next(const std::string &what, const std::size_t least)
{
  current = position;
  if (is_at_end())
    damaged("$" + name + " ends where " + what + " is due");
  split_words(text.lines[current], words);
  if (words.size() < least)
    damaged(in_quotes(line()) + " is not " + what + ", which has " + std::to_string(least) +
            " numbers" + " or more");
  ++position;
  skip_empty();
}

std::string_view GmshRecords::line() const
{
  return text.lines[current];
}

std::size_t GmshRecords::line_number() const
{
  return current + 1;
}

std::size_t GmshRecords::n_words() const
{
  return words.size();
}

void GmshRecords::damaged(const std::string &problem) const
{
  text.complain.damaged(line_number(), problem);
}

std::int64_t GmshRecords::integer(const std::size_t word) const
{
  const std::string_view digits = words[word];
  std::int64_t value = 0;
  const auto [rest, error] = std::from_chars(digits.begin(), digits.end(), value);
  if (error != std::errc() || rest != digits.end() || std::abs(double(value)) > 1e18)
    damaged(in_quotes(digits) + " in " + in_quotes(line()) + " is no integer");
  return value;
}

double GmshRecords::real(const std::size_t word) const
{
  const std::string_view digits = words[word];
  double value = 0;
  const auto [rest, error] = std::from_chars(digits.begin(), digits.end(), value);
  const bool tiny = error == std::errc::result_out_of_range &&
                    digits.find_first_of("eE") != std::string_view::npos &&
                    digits.substr(digits.find_first_of("eE") + 1, 1) == "-";
  if (tiny)
    return 0;
  if (error != std::errc() || rest != digits.end() || !std::isfinite(value))
    damaged(in_quotes(digits) + " in " + in_quotes(line()) + " is no finite number");
  return value;
}

std::int64_t GmshRecords::tag(const std::size_t word) const
{
  const std::int64_t value = integer(word);
  if (value < 1)
    damaged(in_quotes(words[word]) + " in " + in_quotes(line()) +
            " is no number of a node, element or curve");
  return value;
}

std::size_t GmshRecords::count(const std::size_t word, const std::string &what) const
{
  const std::int64_t value = integer(word);
  if (value < 0 || std::uint64_t(value) > end - position)
    damaged("announces " + std::to_string(value) + " " + what + ", and " +
            std::to_string(end - position) + " lines of $" + name + " are left");
  return value;
}

void GmshRecords::finish()
{
  if (is_at_end())
    return;
  current = position;
  damaged(in_quotes(line()) + " stands in $" + name + " after all that was announced");
}
} // namespace hpvi
