// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_result_directory_h
#define hpvi_result_directory_h

#include <hpvi/base/input_error.h>

#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <system_error>
#include <vector>

namespace hpvi
{
/**
 * The directory in which a run leaves its files. A second run that wants it is refused while the
 * first one lasts, and what this program has not written is neither overwritten nor removed: the
 * program's own files are those that `summary.json` lists under "files", or, where it was written
 * before there was such a list, those of a result's name.
 */
class ResultDirectory
{
public:
  /**
   * Create @p path with its parents, or none of them, and lock it; the lock ends with the process.
   * Throws InputError, before anything is changed, where another run has the lock, and where a file
   * whose name satisfies @p writes is not the program's own or is one of the files of @p reads.
   */
  ResultDirectory(const std::string &path, const std::function<bool(const std::string &)> &writes,
                  const std::vector<std::string> &reads);

  /** Names of the program's own files: what there is of them, and what add() announced. */
  const std::set<std::string> &files() const;

  /** Announce a file; was it unknown? A list of files() must be written before the file itself. */
  bool add(const std::string &name);

  /** Remove what earlier runs have left, but not what this one reads. Throws InputError. */
  void remove_earlier();

  /** The file appears under its name only when it is whole. */
  std::error_code write(const std::string &name, const std::string &content) const;

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
  std::set<std::string> own;   ///< files()
  std::set<std::string> stale; ///< those of earlier runs that this one does not read
};
} // namespace hpvi

#endif
