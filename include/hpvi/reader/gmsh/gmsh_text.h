// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_gmsh_text_h
#define hpvi_gmsh_text_h

#include <hpvi/reader/gmsh/mesh_complaint.h>

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace hpvi
{
/** A mesh file of Gmsh in ASCII as lines in sections, `$Name` to `$EndName`. */
class GmshText
{
public:
  /** Throws InputError for a file that cannot be read, is none of Gmsh's, is binary or cut. */
  explicit GmshText(const std::string &path);
  GmshText(const GmshText &) = delete; // lines look into content

  bool has(const std::string &section) const;

  /** As in "4.1". */
  const std::string &version() const;

  const MeshComplaint complain;

private:
  friend class GmshRecords;

  struct Section
  {
    std::size_t begin, end; ///< its first line, and the one that ends it, counted from 0
  };

  void read_format();
  void split();
  std::size_t read_section(std::size_t line);

  const std::string content;
  std::vector<std::string_view> lines;
  std::map<std::string, Section> sections; ///< without the dollar
  std::string format;
};

/** The lines of a section but for empty ones, each of some words; complains about what does not belong there. */
class GmshRecords
{
public:
  /** Throws InputError where there is no such section. */
  GmshRecords(const GmshText &text, const std::string &section);

  bool is_at_end() const;

  /** Go to the next line, which is to hold @p what, as in "a node", in at least @p least words. */
  void next(const std::string &what, std::size_t least);

  std::string_view line() const;   ///< all of it
  std::size_t line_number() const; ///< from 1
  std::size_t n_words() const;

  /** A word as a number. */
  std::int64_t integer(std::size_t word) const;
  double real(std::size_t word) const; ///< a finite one

  std::int64_t tag(std::size_t word) const; ///< an integer from 1

  /** How many lines of @p what follow: no more than are there, so memory may be asked for. */
  std::size_t count(std::size_t word, const std::string &what) const;

  /** Throws it of the line. */
  [[noreturn]] void damaged(const std::string &problem) const;

  /** Complains unless all lines have been read. */
  void finish();

private:
  void skip_empty();

  const GmshText &text;
  const std::string name;
  std::size_t position, end,
      current; ///< the line to read next, the one after the last, the one that is read
  std::vector<std::string_view> words;
};
} // namespace hpvi

#endif
