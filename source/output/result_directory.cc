// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/output/result_directory.h>

#define BOOST_BIND_GLOBAL_PLACEHOLDERS // as the parser still does; silences its note
#include <boost/property_tree/json_parser.hpp>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <regex>

namespace hpvi
{
namespace fs = std::filesystem;

namespace
{
/** Lists the program's files. */
constexpr const char *summary_name = "summary.json";

/** What is not yet whole. */
constexpr const char *partial_name = ".hpvi.tmp";

/** Is this the name of a file that a run may leave? Nothing else is ever touched. */
bool is_result(const std::string &name)
{
  static const std::regex pattern(
      "(contact-[0-9]{2,}\\.csv|solution-[0-9]{2,}\\.vtu|"
      "mesh-[0-9]{2,}\\.svg|solution\\.pvd|convergence\\.csv|loading\\.csv|"
      "degrees\\.csv|reference\\.dat|summary\\.json|scene\\.prm)(\\.tmp)?");
  return std::regex_match(name, pattern);
}

std::set<std::string> results_in(const fs::path &directory, std::error_code &error)
{
  std::set<std::string> names;
  for (fs::directory_iterator entry(directory, error), end; !error && entry != end;
       entry.increment(error))
    if (is_result(entry->path().filename()))
      names.insert(entry->path().filename());
  return names;
}

/** Which of @p names has this program written, as far as summary.json says so? */
std::set<std::string> own_files(const fs::path &directory, const std::set<std::string> &names)
{
  boost::property_tree::ptree summary;
  std::error_code ignored;
  if (!fs::is_regular_file(directory / summary_name, ignored))
    return {};
  try
  {
    std::ifstream file(directory / summary_name);
    boost::property_tree::read_json(file, summary);
  }
  catch (const boost::property_tree::ptree_error &)
  {
    return {};
  }
  if (summary.get<std::string>("program", "").rfind("hpvi ", 0) != 0)
    return {};
  const auto list = summary.get_child_optional("files");
  if (!list)
    return names;
  std::set<std::string> own;
  for (const auto &file : *list)
    if (names.count(file.second.data()) > 0)
      own.insert(file.second.data());
  return own;
}
} // namespace

ResultDirectory::ResultDirectory(const std::string &directory,
                                 const std::function<bool(const std::string &)> &writes,
                                 const std::vector<std::string> &reads)
    : path(directory)
{
  create();
  take_lock();
  std::error_code error;
  const std::set<std::string> names = results_in(path, error);
  if (error)
    reject(error.message());
  own = own_files(path, names);
  for (const std::string &name : names)
  {
    std::error_code ignored;
    const bool is_read =
        std::any_of(reads.begin(), reads.end(),
                    [&](const auto &file) { return fs::equivalent(path / name, file, ignored); });
    if (writes(name) && is_read)
      reject("the run reads its " + name + ", which would be overwritten");
    if (writes(name) && own.count(name) == 0)
      reject("its " + name +
             " would be overwritten, and no summary.json says that it is a result of hpvi");
    if (!is_read && own.count(name) > 0 && name != summary_name)
      stale.insert(name);
  }
  own.insert(summary_name);
}

/** With all its parents, or none of them. */
void ResultDirectory::create() const
{
  std::error_code error, ignored;
  std::vector<fs::path> missing;
  for (fs::path parent = fs::absolute(path, ignored).lexically_normal();
       parent.has_relative_path() && !fs::exists(fs::symlink_status(parent, ignored));
       parent = parent.parent_path())
    missing.push_back(parent);
  fs::create_directories(path, error);
  if (!error && fs::is_directory(path, ignored))
    return;
  for (const fs::path &parent : missing)
    fs::remove(parent, ignored);
  reject(error ? error.message() : "it is not a directory");
}

/** On the directory itself: a file would outlive a kill. Where there are no locks, go without. */
void ResultDirectory::take_lock()
{
  lock.number = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock.number < 0)
    reject(std::generic_category().message(errno));
  if (flock(lock.number, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    reject("another run of hpvi is writing there");
}

ResultDirectory::Descriptor::~Descriptor()
{
  if (number >= 0)
    close(number);
}

const std::set<std::string> &ResultDirectory::files() const
{
  return own;
}

bool ResultDirectory::add(const std::string &name)
{
  return own.insert(name).second;
}

void ResultDirectory::remove_earlier()
{
  for (const std::string &name : stale)
  {
    std::error_code error;
    fs::remove(path / name, error);
    if (error)
      reject("its " + name + " of an earlier run cannot be removed: " + error.message());
    own.erase(name);
  }
}

std::error_code ResultDirectory::write(const std::string &name, const std::string &content) const
{
  const fs::path partial = path / partial_name;
  std::error_code error, ignored;
  if (is_gone())
    return std::make_error_code(std::errc::no_such_file_or_directory);
  fs::remove(partial, ignored); // a link there must not be followed
  errno = 0;
  std::ofstream file(partial, std::ios::binary);
  file << content;
  file.close();
  if (!file)
    error.assign(errno != 0 ? errno : EIO, std::generic_category());
  else
    fs::rename(partial, path / name, error);
  if (error)
    fs::remove(partial, ignored);
  return error;
}

std::string ResultDirectory::name() const
{
  return "output directory '" + printable(path.string()) + "'";
}

bool ResultDirectory::is_gone() const
{
  struct stat locked, named;
  return fstat(lock.number, &locked) != 0 || stat(path.c_str(), &named) != 0 ||
         locked.st_dev != named.st_dev || locked.st_ino != named.st_ino;
}

void ResultDirectory::reject(const std::string &reason) const
{
  throw InputError(name() + " cannot be used: " + reason + "; choose another one with --output");
}
} // namespace hpvi
