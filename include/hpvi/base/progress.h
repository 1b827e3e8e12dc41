// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_progress_h
#define hpvi_progress_h

#include <string>

namespace hpvi
{
/** What a run is about to do, for those who wait for it. */
struct Progress
{
  unsigned int step; ///< from 1
  std::string stage; ///< as in "factorising 120000 unknowns"
  std::string note;  ///< what to know before that, one line; mostly empty
};
} // namespace hpvi

#endif
