// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/results/warnings/line.h>
#include <hpvi/results/warnings/warnings.h>

namespace hpvi
{
namespace
{
/** Three steps in a row that bring less than a tenth each. */
template <int dim>
Warnings stagnating_estimate(const History<dim> &history)
{
  const unsigned int n = history.size(), steps = 3;
  if (n <= steps)
    return {};
  for (unsigned int k = n - steps; k < n; ++k)
    if (!(history[k].estimate > 0.9 * history[k - 1].estimate))
      return {};
  return {{WarningKind::stagnation, history[n - 1].estimate / history[n - 1 - steps].estimate,
           line("the error indicator stagnates: ", history[n - 1 - steps].estimate,
                " three steps ago, ", history[n - 1].estimate,
                " now; the data may hold what no refinement resolves")}};
}

/** Refinement lowers the indicator of any load with finite energy; a factor 4 upwards is none. */
template <int dim>
Warnings rising_estimate(const History<dim> &history, const bool contact_opens)
{
  // Contact that is found late lifts the indicator once, and then it falls again.
  const auto falls_below = [&](const unsigned int k)
  { return contact_opens && history.back().estimate < history[k].estimate; };
  for (unsigned int k = 1, least = 0; k < history.size(); ++k)
  {
    if (history[k].estimate > 4 * history[least].estimate && !falls_below(least))
      return {{WarningKind::rise, history[k].estimate / history[least].estimate,
               line("the error indicator rose from ", history[least].estimate, " in step ",
                    least + 1, " to ", history[k].estimate, " in step ", k + 1,
                    ": a load or a prescribed displacement may be unbounded; look for poles",
                    contact_opens ? ", or for contact that coarse meshes missed" : "")}};
    if (history[k].estimate < history[least].estimate)
      least = k;
  }
  return {};
}

/** Empty fields of the table are explained once. */
template <int dim>
Warnings no_condition_number(const History<dim> &history)
{
  std::string list;
  unsigned int n = 0;
  for (unsigned int k = 0; k < history.size(); ++k)
    if (history[k].lacks_condition)
    {
      list += (list.empty() ? "" : ", ") + std::to_string(k + 1);
      ++n;
    }
  if (list.empty())
    return {};
  return {{WarningKind::condition_number, double(n),
           "S is singular up to round-off in step " + list +
               ": there the table has no condition number; Friction bound may differ too much "
               "from point to point, or a multiplier act nowhere"}};
}
} // namespace

template <int dim>
Warnings history_warnings(const Scene<dim> &scene, const History<dim> &history)
{
  return joined(stagnating_estimate(history),
                rising_estimate(history, scene.has_unilateral_contact()),
                no_condition_number(history));
}

template Warnings history_warnings(const Scene<2> &, const History<2> &);
template Warnings history_warnings(const Scene<3> &, const History<3> &);
} // namespace hpvi
