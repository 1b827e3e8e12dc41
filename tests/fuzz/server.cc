// SPDX-License-Identifier: LGPL-2.1-or-later
// A library that is loaded before the program (LD_PRELOAD) and makes a server of it: what stands before main(), most of a
// short run, is done once, and each run is a fork of what stands then. One thread has to be all there is
// (OMP_NUM_THREADS=1). Requests come from the standard input, answers go to the standard output:
//
//     request   a number of texts and so many texts, each ended by a zero: directory, files of stdout and stderr,
//               megabytes of address space, seconds of CPU, arguments of the program from argv[0] on
//     answer    a line "pid P", and at the end a line "end STATUS KILOBYTES SECONDS", STATUS as of waitpid()
#ifndef _GNU_SOURCE
#define _GNU_SOURCE
#endif
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

namespace
{
using Main = int (*)(int, char **, char **);
Main program = nullptr;

/** @p file takes the place of @p descriptor. */
void redirect(const std::string &file, const int descriptor, const int flags)
{
  const int opened = open(file.c_str(), flags, 0644);
  if (opened < 0 || dup2(opened, descriptor) < 0)
    _exit(126);
  close(opened);
}

void limit(const int resource, const rlim_t most)
{
  const struct rlimit both = {most, most};
  if (setrlimit(resource, &both) != 0)
    _exit(126);
}

[[noreturn]] void run(std::vector<std::string> &request, char **environment)
{
  if (chdir(request.at(0).c_str()) != 0)
    _exit(126);
  redirect("/dev/null", STDIN_FILENO, O_RDONLY);
  redirect(request.at(1), STDOUT_FILENO, O_WRONLY | O_CREAT | O_TRUNC);
  redirect(request.at(2), STDERR_FILENO, O_WRONLY | O_CREAT | O_TRUNC);
  limit(RLIMIT_AS, std::stoull(request.at(3)) << 20);
  limit(RLIMIT_CPU, std::stoull(request.at(4)));
  limit(RLIMIT_CORE, 0);
  std::vector<char *> arguments;
  for (std::size_t k = 5; k < request.size(); ++k)
    arguments.push_back(request[k].data());
  arguments.push_back(nullptr);
  std::exit(program(arguments.size() - 1, arguments.data(), environment));
}

int serve(int, char **, char **environment)
{
  unsetenv("LD_PRELOAD");
  for (std::string text; std::getline(std::cin, text, '\0');)
  {
    std::vector<std::string> request(std::stoul(text));
    for (std::string &part : request)
      std::getline(std::cin, part, '\0');
    const pid_t child = fork();
    if (child == 0)
      run(request, environment);
    std::printf("pid %d\n", child);
    std::fflush(stdout);
    int status = 0;
    struct rusage usage = {};
    wait4(child, &status, 0, &usage);
    std::printf("end %d %ld %.3f\n", status, usage.ru_maxrss,
                double(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
                    1e-6 * double(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec));
    std::fflush(stdout);
  }
  return 0;
}
} // namespace

/** The C library calls it with main() when all that stands before is done. */
extern "C" int __libc_start_main(Main main, int argc, char **argv, void (*init)(), void (*fini)(),
                                 void (*loader_fini)(), void *stack_end)
{
  program = main;
  const auto next =
      reinterpret_cast<decltype(&__libc_start_main)>(dlsym(RTLD_NEXT, "__libc_start_main"));
  return next(serve, argc, argv, init, fini, loader_fini, stack_end);
}
