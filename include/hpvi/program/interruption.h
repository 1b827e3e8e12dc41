// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_interruption_h
#define hpvi_interruption_h

#include <stdexcept>
#include <string>

namespace hpvi
{
/** The user or the system asks the run to end: what() is one line. Exit status 128 + signal. */
class Interruption : public std::runtime_error
{
public:
  /** @p left completes the line: what is left of the run. */
  explicit Interruption(int signal, const std::string &left = "");

  const int signal;
};

/**
 * From here on SIGINT and SIGTERM only leave a note for stop_if_interrupted(), and a second one
 * ends the process at once. A signal that the process was started to ignore stays ignored.
 */
void note_interruptions();

/** Throws Interruption where there is such a note. */
void stop_if_interrupted();

/** A pipe whose reader is gone and a file that has grown too large are errors, not the end. */
void survive_failed_writes();
} // namespace hpvi

#endif
