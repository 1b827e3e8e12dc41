// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/program/interruption.h>

#include <csignal>

namespace hpvi
{
namespace
{
/** The one thing that a signal can reach. */
volatile std::sig_atomic_t noted = 0;

extern "C" void note(const int signal)
{
  if (noted != 0) // delivered again as soon as this function is left, and then not caught
  {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
  noted = signal;
}

std::string name(const int signal)
{
  return signal == SIGINT ? "SIGINT" : "SIGTERM";
}
} // namespace

Interruption::Interruption(const int signal, const std::string &left)
    : std::runtime_error("hpvi: interrupted by " + name(signal) + left), signal(signal)
{
}

void note_interruptions()
{
  for (const int signal : {SIGINT, SIGTERM})
  {
    struct sigaction action = {}, before = {};
    action.sa_handler = note;
    action.sa_flags = SA_RESTART; // no write is cut short
    sigemptyset(&action.sa_mask);
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN)
      sigaction(signal, &action, nullptr);
  }
}

void stop_if_interrupted()
{
  if (noted != 0)
    throw Interruption(noted);
}

void survive_failed_writes()
{
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}
} // namespace hpvi
