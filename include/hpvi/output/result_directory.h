// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_result_directory_h
#define hpvi_result_directory_h

#include <hpvi/base/input_error.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <system_error>
#include <tuple>
#include <vector>

namespace hpvi
{
/** Regular expressions of the names that results have; no other file is ever touched. */
namespace results
{
inline const std::string
    always = "scene\\.prm|convergence\\.csv|degrees\\.csv|forces\\.csv|summary\\.json|state\\.dat",
    loading = "loading\\.csv|contact-history\\.csv|cycles\\.csv",
    contact = "contact-[0-9]{2,}\\.csv", mesh = "mesh-[0-9]{2,}\\.svg",
    vtu = "solution-[0-9]{2,}\\.vtu|solution\\.pvd",
    pieces = "solution-[0-9]{2,}\\.(pvtu|[0-9]+\\.vtu)|solution\\.pvd",
    contact_line = "contact-[0-9]{2,}\\.vtu|contact\\.pvd", reference = "reference\\.dat",
    picture = "scene\\.svg", report = "report\\.html|scene\\.json", pdf = "report\\.pdf",
    probe = "probe-[A-Za-z0-9_ -]+-[0-9]{2,}\\.csv";

/**
 * The words with which a picture of the scene, scene.json and a report begin: they are known by them, for no summary.json lists what other
 * commands than a run have made.
 */
inline const std::string picture_head = "the scene, drawn by hpvi",
                         report_head = "the run, told by hpvi",
                         scene_head = "{\n  \"program\": \"hpvi ";
} // namespace results

/** NAME-NN.SUFFIX; the number grows beyond two digits where it has to. */
std::string numbered(const std::string &name, unsigned int step, const std::string &suffix);

/**
 * The file appears under its name only when it is whole: it is renamed from @p partial, a name in the same
 * directory, where a link is not followed.
 */
std::error_code write_whole(const std::filesystem::path &file, const std::string &content,
                            const std::string &partial);

/**
 * Names of files. Those that differ in the number of a step alone are ranges, so that thousands take one line,
 * which a shell reads as well: `contact-{01..17}.csv`.
 */
class FileNames
{
public:
  /** A name, or a range as list() has it; was any of it unknown? */
  bool add(const std::string &name);

  void remove(const std::string &name);
  bool contains(const std::string &name) const;
  std::vector<std::string> list() const;

private:
  using Series = std::tuple<std::string, unsigned int, std::string>; ///< head, digits, tail
  struct Span;
  static Span span_of(const std::string &name);

  std::map<Series, std::map<unsigned int, unsigned int>> series; ///< first and last numbers
};

/**
 * The directory in which a run leaves its files. A second run that wants it is refused while the
 * first one lasts, and what this program has not written is neither overwritten nor removed: the
 * program's own files are those that `summary.json` lists under "files", or, where it was written
 * before there was such a list, those of a result's name; and a picture of the scene or a report, which say so themselves.
 * The picture stays when a run replaces the results: it was drawn by another command.
 */
class ResultDirectory
{
public:
  using KeptSteps = std::function<bool(unsigned int)>;

  /**
   * Create @p path with its parents, or none of them, and lock it; the lock ends with the process.
   * Throws InputError, before anything is changed, where another run has the lock, and where a file
   * whose name matches @p writes, of hpvi::results, is not the program's own or is one of the files of @p reads.
   */
  ResultDirectory(const std::string &path, const std::string &writes,
                  const std::vector<std::string> &reads);

  /** FileNames::list() of the program's own files: what there is of them, and what add() announced. */
  std::vector<std::string> files() const;

  /** The scene file whose results were there, as its user named it; empty where it is @p scene_file or unknown. */
  std::string other_scene(const std::string &scene_file) const;

  /** Announce a file; was it unknown? A list of files() must be written before the file itself. */
  bool add(const std::string &name);

  /** Remove what earlier runs have left, but not what this one reads. Throws InputError. */
  void remove_earlier();

  /**
   * For a run that goes on after @p step: remove the files of each step that is not @p kept; returns the names of those with
   * the number of the step. Throws InputError.
   */
  std::vector<std::string> remove_after(unsigned int step, const KeptSteps &kept);

  /** Remove one of the program's own files; where that fails it stays one. */
  void remove(const std::string &name);

  /** The file appears under its name only when it is whole. */
  std::error_code write(const std::string &name, const std::string &content) const;

  /**
   * Bring a file up to date whose first @p same bytes stand there already, by one write of the others that
   * is undone where it fails; whole, where the file is not what the last update() left.
   */
  std::error_code update(const std::string &name, const std::string &content, std::size_t same);

  /** "output directory 'PATH'" for messages. */
  std::string name() const;

  /** Has it vanished from its place, or is there another one? */
  bool is_gone() const;

  [[noreturn]] void reject(const std::string &reason) const;

private:
  /** An open directory; closing it ends the lock. */
  struct Descriptor
  {
    int number = -1;
    ~Descriptor();
  };

  void create() const;
  void take_lock();

  const std::filesystem::path path;
  Descriptor lock;
  FileNames own;                            ///< files()
  std::set<std::string> stale;              ///< those of earlier runs that this one does not read
  std::string earlier_scene;                ///< whose results they are
  std::map<std::string, std::size_t> sizes; ///< of the files that update() wrote
};
} // namespace hpvi

#endif
