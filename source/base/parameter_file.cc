// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/parameter_file.h>

#include <hpvi/base/display_name.h>
#include <hpvi/base/input_error.h>
#include <hpvi/base/text.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace hpvi
{
using namespace dealii;

namespace
{
class FileScanner
{
public:
  explicit FileScanner(const std::string &file) : file(file), shown(display_name(file))
  {
  }

  std::vector<Assignment> scan()
  {
    std::istringstream stream(content());
    for (std::string line; next_line(stream, line);)
      if (!line.empty())
        read_statement(line);
    if (!section.empty())
      fail(section_start, "subsection " + section, "is never closed; add the line \"end\"");
    return std::move(assignments);
  }

private:
  /** A device or a picture would be read for ever. */
  std::string content() const
  {
    std::error_code error;
    if (std::filesystem::is_directory(file, error))
      throw InputError(shown + ": is a directory; name a scene file (.prm)");
    std::ifstream stream(file, std::ios::binary);
    const std::size_t limit = 1 << 20;
    std::string text(limit + 1, '\0');
    stream.read(text.data(), text.size());
    if (stream.bad() || !stream.is_open())
      throw InputError(shown + ": cannot be read; check the name and the permissions of the file");
    text.resize(stream.gcount());
    if (text.size() > limit)
      throw InputError(shown + ": is larger than a megabyte; name a scene file (.prm)");
    const std::string begin = text.substr(0, 2);
    if (begin == "\xFF\xFE" || begin == "\xFE\xFF" || begin.find('\0') != std::string::npos)
      throw InputError(shown + ": is written in UTF-16; save it as UTF-8");
    return text;
  }

  /** Without comment and surrounding blanks; lines that end in a backslash are joined. */
  bool next_line(std::istream &stream, std::string &line)
  {
    line.clear();
    bool continued = true, any = false;
    for (std::string part; continued && std::getline(stream, part); any = true)
    {
      ++line_number;
      if (line_number == 1 && part.compare(0, 3, "\xEF\xBB\xBF") == 0) // byte order mark
        part.erase(0, 3);
      part = Utilities::trim(part.substr(0, part.find('#')));
      continued = !part.empty() && part.back() == '\\';
      if (continued)
        part.pop_back();
      line += part;
    }
    line = Utilities::trim(line);
    return any;
  }

  void read_statement(const std::string &line)
  {
    const std::string where = shown + ":" + std::to_string(line_number);
    const std::size_t gap = std::min(line.find_first_of(" \t"), line.size());
    const std::string keyword = lower_case(line.substr(0, gap));
    const std::string rest = Utilities::trim(line.substr(gap));
    if (keyword == "set" && rest.find('=') != std::string::npos)
      assignments.push_back({section, single_spaced(rest.substr(0, rest.find('='))),
                             Utilities::trim(rest.substr(rest.find('=') + 1)), where});
    else if (keyword == "subsection" && !rest.empty())
      open_section(single_spaced(rest), where);
    else if (keyword == "end" && rest.empty())
      close_section(where);
    else if (keyword == "include")
      fail(where, line, "include is not supported; write all entries into one file");
    else
      fail(where, line,
           "is not a statement; write \"set Entry = value\", \"subsection Name\" or \"end\"");
  }

  void open_section(const std::string &name, const std::string &where)
  {
    if (!section.empty())
      fail(where, "subsection " + name,
           "stands inside subsection " + printable(section) + " of " + section_start +
               "; close that one with \"end\" first");
    section = name;
    section_start = where;
    assignments.push_back({section, "", "", where}); // lets an empty section be checked by name
  }

  void close_section(const std::string &where)
  {
    if (section.empty())
      fail(where, "end", "no subsection is open here; remove this line");
    section.clear();
  }

  const std::string file, shown;
  unsigned int line_number = 0;
  std::string section, section_start;
  std::vector<Assignment> assignments;
};
} // namespace

std::string storable(std::string text)
{
  std::replace_if(
      text.begin(), text.end(), [](const char c) { return c == '#' || c == '\n' || c == '\r'; },
      '_');
  if (!text.empty() && text.back() == '\\')
    text.back() = '_';
  return text;
}

ParameterFile::ParameterFile(const std::string &name,
                             const std::vector<std::pair<std::string, std::string>> &overrides)
    : name(name)
{
  if (!name.empty())
    assignments = FileScanner(name).scan();
  const std::string where = display_name(name) + " (--set)";
  for (const auto &[path, text] : overrides)
  {
    const std::string value = Utilities::trim(text);
    const std::size_t slash = path.rfind('/');
    const bool top = slash == std::string::npos;
    if (value != storable(value)) // it must survive a round trip through a parameter file
      fail(where, path + " = " + value,
           "holds a character that no parameter file can; remove '#', '\\' and line breaks");
    const std::string entry = single_spaced(top ? path : path.substr(slash + 1));
    if (entry.empty())
      fail(where, path + " = " + value, "names no entry; write Section/Entry=value");
    assignments.push_back({top ? "" : single_spaced(path.substr(0, slash)), entry, value, where});
  }
}

namespace
{
/** Characters that editors and word processors put in the place of others, which look the same. */
struct LookAlike
{
  char32_t code;
  const char *name, *remedy;
};

constexpr LookAlike look_alikes[] = {{0xA0, "no-break space (U+00A0)", "a blank"},
                                     {0x202F, "narrow no-break space (U+202F)", "a blank"},
                                     {0x2009, "thin space (U+2009)", "a blank"},
                                     {0x200B, "zero-width space (U+200B)", "nothing"},
                                     {0xFEFF, "byte order mark (U+FEFF)", "nothing"},
                                     {0x2212, "minus sign (U+2212)", "-"},
                                     {0x2010, "hyphen (U+2010)", "-"},
                                     {0x2011, "no-break hyphen (U+2011)", "-"},
                                     {0x2013, "dash (U+2013)", "-"},
                                     {0x2014, "dash (U+2014)", "-"},
                                     {0x2018, "quotation mark (U+2018)", "'"},
                                     {0x2019, "quotation mark (U+2019)", "'"},
                                     {0xB4, "acute accent (U+00B4)", "'"},
                                     {0xD7, "multiplication sign (U+00D7)", "*"},
                                     {0xB7, "middle dot (U+00B7)", "*"},
                                     {0xB2, "superscript (U+00B2)", "^2"}};

/** What the reader of @p text cannot see; empty without one of them. */
std::string name_look_alike(const std::string &text)
{
  for (std::size_t i = 0; i < text.size();)
  {
    const Character character = character_at(text, i);
    for (const LookAlike &other : look_alikes)
      if (character.length > 0 && character.code == other.code)
        return std::string("; it holds a ") + other.name + ": write " + other.remedy;
    i += std::max<std::size_t>(character.length, 1);
  }
  return {};
}
} // namespace

void fail(const std::string &where, const std::string &what, const std::string &problem_and_remedy)
{
  throw InputError(where + ": " + printable(what) + ": " + problem_and_remedy +
                   name_look_alike(what));
}
} // namespace hpvi
