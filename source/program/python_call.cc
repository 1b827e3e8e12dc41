// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/child_process.h>
#include <hpvi/base/text.h>
#include <hpvi/output/output.h>
#include <hpvi/program/python_call.h>

#include <filesystem>

namespace hpvi
{
namespace
{
namespace fs = std::filesystem;

constexpr const char *interpreter = "/usr/bin/python3";
constexpr double most_seconds = 600;

/** Beside the program where it was built, or where packages of Python are in the prefix in which it is installed; empty: nowhere. */
fs::path package()
{
  std::error_code error;
  const fs::path home = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path &at :
       {home / "python", home / ".." / HPVI_DIST_PACKAGES, home / "../lib/python3/dist-packages"})
    if (fs::exists(at / "hpvi/__main__.py", error))
      return at / "hpvi/__main__.py";
  return {};
}

[[noreturn]] void fail(const std::string &what, const std::string &reason)
{
  throw OutputFailure("hpvi: the " + what + " cannot be made: " + reason);
}
} // namespace

void call_python(const std::string &what, const std::vector<std::string> &words)
{
  std::error_code error;
  if (!fs::exists(interpreter, error))
    fail(what, std::string("there is no ") + interpreter + "; install python3-hpvi");
  const fs::path main = package();
  if (main.empty())
    fail(what, "hpvi's package of Python is missing; install python3-hpvi");
  std::vector<std::string> command{interpreter, "-I", "-B", main};
  command.insert(command.end(), words.begin(), words.end());
  const ChildEnd end = run_child(command, most_seconds);
  if (end.is_late)
    fail(what, "Python took more than ten minutes; take a smaller run");
  if (end.signal != 0)
    fail(what, "Python was ended by signal " + std::to_string(end.signal) +
                   "; install python3-hpvi and python3-matplotlib anew");
  if (end.status != 0)
    fail(what, end.output.empty() ? "Python failed; install python3-hpvi anew"
                                  : one_line(std::runtime_error(end.output)));
}
} // namespace hpvi
