// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/file_format.h>
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/output/json_tree.h>
#include <hpvi/output/result_directory.h>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <regex>
#include <utility>

namespace hpvi
{
namespace fs = std::filesystem;

namespace
{
/** Lists the program's files. */
constexpr const char *summary_name = "summary.json";

/** What is not yet whole. */
constexpr const char *partial_name = ".hpvi.tmp";

/** Is this the name of a file that a run may leave? */
bool is_result(const std::string &name)
{
  namespace r = results;
  static const std::regex pattern("(" + r::always + "|" + r::loading + "|" + r::contact + "|" +
                                  r::mesh + "|" + r::vtu + "|" + r::pieces + "|" + r::contact_line +
                                  "|" + r::reference + "|" + r::picture + "|" + r::probe + "|" +
                                  r::report + "|" + r::pdf + ")(\\.tmp)?");
  return std::regex_match(name, pattern);
}

/** By another command. */
bool tells_of_run(const std::string &name)
{
  return name == "report.html" || name == "report.pdf" || name == "scene.json";
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

/** What summary.json says of an earlier run. */
struct EarlierRun
{
  FileNames files;
  std::string scene; ///< its file
};

/** Is it a picture, its data or a report that says that this program has made it? A PDF says so where it ends. */
bool names_its_maker(const fs::path &file)
{
  std::error_code ignored;
  std::string begin(40, '\0');
  if (!fs::is_regular_file(fs::symlink_status(file, ignored)))
    return false;
  if (const std::string end = "% " + results::report_head + "\n"; file.extension() == ".pdf")
  {
    const std::string content = content_of(file);
    return content.size() >= end.size() &&
           content.compare(content.size() - end.size(), end.size(), end) == 0;
  }
  std::ifstream(file, std::ios::binary).read(begin.data(), begin.size());
  return begin.rfind("<!-- " + results::picture_head, 0) == 0 ||
         begin.rfind("<!-- " + results::report_head, 0) == 0 ||
         begin.rfind(results::scene_head, 0) == 0;
}

/** Which of @p names has this program written, and for which scene? */
EarlierRun earlier_run(const fs::path &directory, const std::set<std::string> &names)
{
  std::error_code ignored;
  if (!fs::is_regular_file(directory / summary_name, ignored))
    return {};
  const JsonTree summary = json_tree(content_of(directory / summary_name)).value_or(JsonTree());
  if (words_of(summary, "program").rfind("hpvi ", 0) != 0)
    return {};
  const JsonTree *const list = member(summary, "files");
  FileNames listed;
  if (list)
    for (const auto &file : *list)
      listed.add(file.second.data());
  EarlierRun run{{}, words_of(summary, "scene_file")};
  for (const std::string &name : names)
    if (!list || listed.contains(name))
      run.files.add(name);
  return run;
}

/** Replace what follows the first @p same bytes of a file of @p size, or leave it as it was. */
std::error_code replace_end(const int file, const std::string &content, const std::size_t same,
                            const std::size_t size)
{
  std::string before(size - same, '\0');
  bool done = pread(file, before.data(), before.size(), same) == ssize_t(before.size());
  for (std::size_t at = same; done && at < content.size();) // once, but where a disk is full
  {
    const ssize_t n = pwrite(file, content.data() + at, content.size() - at, at);
    done = n > 0;
    at += std::max<ssize_t>(n, 0);
  }
  const std::error_code error(done ? 0 : errno, std::generic_category());
  if (error && pwrite(file, before.data(), before.size(), same) >= 0)
    std::ignore = ftruncate(file, size);
  return error;
}
} // namespace

std::string numbered(const std::string &name, const unsigned int step, const std::string &suffix)
{
  return name + (step < 10 ? "-0" : "-") + std::to_string(step) + suffix;
}

std::error_code write_whole(const fs::path &file, const std::string &content,
                            const std::string &partial_name)
{
  const fs::path partial = fs::path(file).replace_filename(partial_name);
  std::error_code error, ignored;
  fs::remove(partial, ignored); // a link there must not be followed
  errno = 0;
  std::ofstream stream(partial, std::ios::binary);
  stream << content;
  stream.close();
  if (!stream)
    error.assign(errno != 0 ? errno : EIO, std::generic_category());
  else
    fs::rename(partial, file, error);
  if (error)
    fs::remove(partial, ignored);
  return error;
}

// ---------------------------------------------------------------- names

struct FileNames::Span
{
  Series series;
  unsigned int first, last;
};

/** HEAD-NN.TAIL or HEAD-{NN..MM}.TAIL; any other name is a series of its own. */
FileNames::Span FileNames::span_of(const std::string &name)
{
  static const std::regex pattern(
      "(probe-[A-Za-z0-9_ "
      "-]+-|[a-z]+-)(?:([0-9]{2,9})|\\{([0-9]{2,9})\\.\\.([0-9]{2,9})\\})(\\.[0-9a-z.]+)");
  std::smatch match;
  if (name.size() > 60 || !std::regex_match(name, match, pattern))
    return {{name, 0, ""}, 0, 0};
  const std::string first = match[2].str() + match[3].str(), last = match[2].str() + match[4].str();
  if (first.size() != last.size())
    return {{name, 0, ""}, 0, 0};
  const unsigned int digits = first.size();
  return {{match[1], digits, match[5]},
          static_cast<unsigned int>(std::stoul(first)),
          static_cast<unsigned int>(std::stoul(last))};
}

bool FileNames::add(const std::string &name)
{
  const Span span = span_of(name);
  std::map<unsigned int, unsigned int> &ranges = series[span.series];
  const auto next = ranges.upper_bound(span.first);
  if (next == ranges.begin() || std::prev(next)->second + 1 < span.first)
    return ranges.emplace(span.first, span.last).second;
  unsigned int &last = std::prev(next)->second;
  const bool is_new = last < span.last;
  last = std::max(last, span.last);
  return is_new;
}

void FileNames::remove(const std::string &name)
{
  if (!contains(name))
    return;
  const Span span = span_of(name);
  std::map<unsigned int, unsigned int> &ranges = series[span.series];
  const auto found = std::prev(ranges.upper_bound(span.first));
  if (span.first < found->second)
    ranges.emplace(span.first + 1, found->second);
  if (found->first < span.first)
    found->second = span.first - 1;
  else
    ranges.erase(found);
}

bool FileNames::contains(const std::string &name) const
{
  const Span span = span_of(name);
  const auto found = series.find(span.series);
  if (found == series.end())
    return false;
  const auto next = found->second.upper_bound(span.first);
  return next != found->second.begin() && std::prev(next)->second >= span.first;
}

std::vector<std::string> FileNames::list() const
{
  std::vector<std::string> names;
  for (const auto &[parts, ranges] : series)
  {
    const auto &[head, digits, tail] = parts;
    const auto padded = [digits = digits](const unsigned int number)
    {
      const std::string text = std::to_string(number);
      return std::string(digits - text.size(), '0') + text;
    };
    for (const auto &[first, last] : ranges)
      names.push_back(digits == 0 ? head
                      : first == last
                          ? head + padded(first) + tail
                          : head + "{" + padded(first) + ".." + padded(last) + "}" + tail);
  }
  return names;
}

ResultDirectory::ResultDirectory(const std::string &directory, const std::string &writes,
                                 const std::vector<std::string> &reads)
    : path(directory)
{
  create();
  take_lock();
  std::error_code error;
  const std::set<std::string> names = results_in(path, error);
  if (error)
    reject(error.message());
  const std::regex written(writes), picture(results::picture);
  const EarlierRun earlier = earlier_run(path, names);
  own = earlier.files;
  earlier_scene = earlier.scene;
  for (const std::string &name : names)
  {
    const bool is_picture = std::regex_match(name, picture),
               says_so = is_picture || tells_of_run(name);
    if (says_so && names_its_maker(path / name))
      own.add(name);
    else if (says_so)
      own.remove(name);
    const bool writes_it = std::regex_match(name, written);
    std::error_code ignored;
    const bool is_read =
        std::any_of(reads.begin(), reads.end(),
                    [&](const auto &file) { return fs::equivalent(path / name, file, ignored); });
    if (writes_it && is_read)
      reject("the run reads its " + name + ", which would be overwritten");
    if (writes_it && !own.contains(name))
      reject("its " + name + " would be overwritten, and " +
             (says_so ? "it does not say that hpvi has made it"
                      : "no summary.json says that it is a result of hpvi"));
    if (!is_read && !is_picture && own.contains(name) && name != summary_name)
      stale.insert(name);
  }
  own.add(summary_name);
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

std::vector<std::string> ResultDirectory::files() const
{
  return own.list();
}

std::string ResultDirectory::other_scene(const std::string &scene_file) const
{
  if (earlier_scene.empty() || earlier_scene == legible(scene_file))
    return {};
  std::error_code ignored;
  const bool is_same = fs::equivalent(earlier_scene, scene_file, ignored);
  return is_same ? "" : earlier_scene;
}

bool ResultDirectory::add(const std::string &name)
{
  return own.add(name);
}

void ResultDirectory::remove_earlier()
{
  for (const std::string &name : stale)
  {
    std::error_code error;
    fs::remove(path / name, error);
    if (error)
      reject("its " + name + " of an earlier run cannot be removed: " + error.message());
    own.remove(name);
  }
}

std::vector<std::string> ResultDirectory::remove_after(const unsigned int step,
                                                       const KeptSteps &kept)
{
  static const std::regex pattern(".*-([0-9]{2,9})\\.[0-9a-z.]+");
  std::vector<std::string> of_step;
  for (const std::string &name : std::exchange(stale, {}))
  {
    std::smatch match;
    const unsigned long number = std::regex_match(name, match, pattern) ? std::stoul(match[1]) : 0;
    if (number > 0 ? !kept(number) : name == "reference.dat" || tells_of_run(name))
      stale.insert(name);
    else if (number == step)
      of_step.push_back(name);
  }
  remove_earlier();
  return of_step;
}

void ResultDirectory::remove(const std::string &name)
{
  std::error_code error;
  if (!is_gone())
    fs::remove(path / name, error);
  if (!error)
    own.remove(name);
}

std::error_code ResultDirectory::write(const std::string &name, const std::string &content) const
{
  return is_gone() ? std::make_error_code(std::errc::no_such_file_or_directory)
                   : write_whole(path / name, content, partial_name);
}

std::error_code ResultDirectory::update(const std::string &name, const std::string &content,
                                        const std::size_t same)
{
  std::size_t &size = sizes[name];
  struct stat found;
  const Descriptor file{open((path / name).c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC)};
  // Another name of the same file would be another's copy of it.
  const bool is_ours = !is_gone() && fstat(file.number, &found) == 0 && S_ISREG(found.st_mode) &&
                       found.st_nlink == 1 && std::size_t(found.st_size) == size;
  const std::error_code error = is_ours && same > 0 && same <= size
                                    ? replace_end(file.number, content, same, size)
                                    : write(name, content);
  size = error ? size : content.size();
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
