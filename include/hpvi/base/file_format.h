// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_file_format_h
#define hpvi_file_format_h

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace hpvi
{
/**
 * A kind of text file that outlives its run: the first line names it, the second holds a checksum
 * (CRC-32) of all that follows. What is not whole, or does not fit, is refused with an InputError of one
 * line: file, what is wrong with it, remedy.
 */
class FileFormat
{
public:
  /** As in "reference solution", 1, "make the reference solution anew". */
  FileFormat(std::string name, unsigned int number, std::string remedy);

  void write(std::ostream &out, const std::string &content) const;

  /** The content of a file that messages call @p file. */
  std::string read(std::istream &in, const std::string &file) const;

  /** Refuse a file whose scene has the entries @p there, unless they are those @p here up to blanks. */
  void check_entries(const std::string &file, const std::vector<std::string> &there,
                     const std::vector<std::string> &here) const;

  [[noreturn]] void reject(const std::string &file, const std::string &what) const;

private:
  const std::string name, first_line, remedy;
};

/** Of a file; empty where there is none. */
std::string content_of(const std::filesystem::path &file);

/** The entries of a scene for which @p counts holds, as "Section/Entry = value", from scene.prm. */
std::vector<std::string>
entries_of(const std::string &scene_prm,
           const std::function<bool(const std::string &section, const std::string &entry)> &counts);
} // namespace hpvi

#endif
