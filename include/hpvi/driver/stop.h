// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_stop_h
#define hpvi_stop_h

#include <iosfwd>
#include <string>

namespace hpvi
{
/** What makes a step the last one: its last bits, entries of Adaptivity, or a history of loads. */
enum class Stop
{
  none,
  round_off, ///< the indicator is that of the last bits of u_N
  tolerance,
  maximum_steps,
  maximum_unknowns,
  maximum_seconds,
  maximum_degree,
  hap_threshold,
  hpa1_bisected,
  hpa2_marked,
  hpa3_threshold,
  first_step, ///< Loading/Adapt
  load_step   ///< an error as small as that of this load step
};

struct StopReason
{
  Stop stop = Stop::none;
  unsigned int load_step = 0; ///< of Stop::load_step

  bool empty() const
  {
    return stop == Stop::none;
  }
};

/** As in files: the name of an entry of Adaptivity, "round-off", "Adapt = first step", "error of load step 2" or nothing. */
std::string text(const StopReason &reason);
std::ostream &operator<<(std::ostream &out, const StopReason &reason); ///< text(reason)

/** Of such words. */
StopReason stop_reason_from(const std::string &words);
} // namespace hpvi

#endif
