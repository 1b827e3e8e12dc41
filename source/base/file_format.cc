// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/file_format.h>
#include <hpvi/base/input_error.h>
#include <hpvi/base/text.h>

#include <boost/crc.hpp>

#include <algorithm>
#include <fstream>
#include <iomanip>
#include <istream>
#include <iterator>
#include <sstream>

namespace hpvi
{
namespace
{
std::string checksum(const std::string &content)
{
  boost::crc_32_type crc;
  crc.process_bytes(content.data(), content.size());
  std::ostringstream out;
  out << "checksum " << std::hex << std::setw(8) << std::setfill('0') << crc.checksum();
  return out.str();
}

} // namespace

FileFormat::FileFormat(std::string name, const unsigned int number, std::string remedy)
    : name(std::move(name)),
      first_line("hpvi " + this->name + ", format " + std::to_string(number)),
      remedy(std::move(remedy))
{
}

void FileFormat::write(std::ostream &out, const std::string &content) const
{
  out << first_line << '\n' << checksum(content) << '\n' << content;
}

std::string FileFormat::read(std::istream &in, const std::string &file) const
{
  std::string format, sum;
  if (!std::getline(in, format) || format != first_line)
  {
    const std::string any_format = first_line.substr(0, first_line.rfind(' '));
    reject(file, "does not begin with \"" + first_line + "\"" +
                     (format.rfind(any_format, 0) == 0 ? ": another version of hpvi has written it"
                                                       : ""));
  }
  std::getline(in, sum);
  const std::string content{std::istreambuf_iterator<char>(in), {}};
  if (sum != checksum(content))
    reject(file, "the " + name + " is cut short or altered, its content has " + checksum(content));
  return content;
}

void FileFormat::check_entries(const std::string &file, const std::vector<std::string> &there,
                               const std::vector<std::string> &here) const
{
  const auto without_blanks = [](std::string text)
  {
    text.erase(std::remove(text.begin(), text.end(), ' '), text.end());
    return text;
  };
  const auto value = [](const std::string &entry)
  {
    const std::string text = entry.substr(entry.find('=') + 1);
    return text.empty() ? " nothing" : printable(text);
  };
  for (std::size_t k = 0; k < std::max(there.size(), here.size()); ++k)
  {
    const std::string theirs = k < there.size() ? there[k] : "",
                      ours = k < here.size() ? here[k] : "";
    if (theirs.substr(0, theirs.find(" =")) != ours.substr(0, ours.find(" =")))
      reject(file, "the " + name + " knows other entries than this program");
    if (without_blanks(theirs) != without_blanks(ours))
      reject(file, "is the " + name +
                       " of another problem: " + theirs.substr(0, theirs.find(" =") + 2) +
                       value(theirs) + " there," + value(ours) + " here");
  }
}

void FileFormat::reject(const std::string &file, const std::string &what) const
{
  throw InputError(printable(file) + ": " + what + "; " + remedy);
}

std::string content_of(const std::filesystem::path &file)
{
  std::ifstream in(file, std::ios::binary);
  std::ostringstream content;
  content << in.rdbuf();
  return content.str();
}

namespace
{
/** Of the content of a file; "missing" where there is none. */
std::string fingerprint(const std::string &file)
{
  return std::ifstream(file) ? "content " + checksum(content_of(file)) : "missing";
}

/** Of a file that a scene reads counts what is in it, not where it lies. */
std::string without_path(const std::string &section, const std::string &setting)
{
  const bool is_of_body = section == "Geometry" || section.rfind("Body ", 0) == 0;
  const std::string file = is_of_body ? "File = " : "Reference solution = ";
  return (is_of_body || section == "Error") && setting.rfind(file, 0) == 0
             ? file + fingerprint(setting.substr(file.size()))
             : setting;
}
} // namespace

std::vector<std::string>
entries_of(const std::string &scene_prm,
           const std::function<bool(const std::string &section, const std::string &entry)> &counts)
{
  std::vector<std::string> result;
  std::istringstream lines(scene_prm);
  std::string section;
  for (std::string line; std::getline(lines, line);)
  {
    const std::string statement = single_spaced(line), opening = "subsection ", setting = "set ";
    if (statement.rfind(opening, 0) == 0)
      section = statement.substr(opening.size());
    if (statement == "end")
      section.clear();
    const std::size_t equals = statement.find(" =");
    if (statement.rfind(setting, 0) == 0 && equals != std::string::npos &&
        counts(section, statement.substr(setting.size(), equals - setting.size())))
      result.push_back((section.empty() ? "" : section + "/") +
                       without_path(section, statement.substr(setting.size())));
  }
  return result;
}
} // namespace hpvi
