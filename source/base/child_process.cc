// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/child_process.h>
#include <hpvi/base/input_error.h>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>

namespace hpvi
{
namespace
{
/** Variables of this process but for libraries that are to be loaded into it. */
std::vector<char *> environment()
{
  std::vector<char *> result;
  for (char **variable = environ; variable != nullptr && *variable != nullptr; ++variable)
    if (std::strncmp(*variable, "LD_PRELOAD=", 11) != 0)
      result.push_back(*variable);
  result.push_back(nullptr);
  return result;
}

/** A child in a group of its own, so that those it starts end with it. */
class Child
{
public:
  explicit Child(const std::vector<std::string> &command)
  {
    std::array<int, 2> ends;
    if (pipe2(ends.data(), O_CLOEXEC) != 0)
      throw InputError("hpvi: no pipe to " + command.front() + ": " + std::strerror(errno) +
                       "; let the process open more files");
    std::vector<char *> words;
    for (const std::string &word : command)
      words.push_back(const_cast<char *>(word.c_str()));
    words.push_back(nullptr);
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&files, ends[1], 1);
    posix_spawn_file_actions_addopen(&files, 2, "/dev/null", O_WRONLY, 0);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
    posix_spawnattr_setpgroup(&attributes, 0);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    const int error =
        posix_spawn(&process, words[0], &files, &attributes, words.data(), environment().data());
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
    close(ends[1]);
    pipe_end = ends[0];
    if (error == 0)
      return;
    close(pipe_end);
    throw InputError("hpvi: " + command.front() + " cannot be started: " + std::strerror(error) +
                     "; install hpvi anew");
  }

  Child(const Child &) = delete;
  Child &operator=(const Child &) = delete;

  ~Child()
  {
    close(pipe_end);
  }

  /** False where the time is over before it closes its output. */
  bool read(const double seconds, std::string &output) const
  {
    using Clock = std::chrono::steady_clock;
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    std::array<char, 1 << 16> buffer;
    for (;;)
    {
      const double left = std::chrono::duration<double>(end - Clock::now()).count();
      pollfd watched = {pipe_end, POLLIN, 0};
      const int ready = left > 0 ? poll(&watched, 1, static_cast<int>(1000 * left) + 1) : 0;
      if (ready < 0 && errno == EINTR)
        continue;
      if (ready <= 0)
        return false;
      const ssize_t n = ::read(pipe_end, buffer.data(), buffer.size());
      if (n < 0 && errno == EINTR)
        continue;
      if (n <= 0)
        return true;
      output.append(buffer.data(), n);
    }
  }

  void end_all() const
  {
    kill(-process, SIGKILL);
  }

  int wait() const
  {
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR)
      continue;
    return status;
  }

private:
  pid_t process = 0;
  int pipe_end = -1;
};
} // namespace

ChildEnd run_child(const std::vector<std::string> &command, const double seconds)
{
  const Child child(command);
  ChildEnd end;
  end.is_late = !child.read(seconds, end.output);
  if (end.is_late)
    child.end_all();
  const int status = child.wait();
  child.end_all(); // what it has started
  if (WIFEXITED(status))
    end.status = WEXITSTATUS(status);
  else if (WIFSIGNALED(status))
    end.signal = WTERMSIG(status);
  return end;
}
} // namespace hpvi
