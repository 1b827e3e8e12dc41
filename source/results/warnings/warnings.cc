// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/results/warnings/line.h>
#include <hpvi/results/warnings/warnings.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
std::vector<std::string> texts(const Warnings &warnings)
{
  Warnings sorted = warnings;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const Warning &a, const Warning &b) { return a.kind < b.kind; });
  std::vector<std::string> result;
  for (const Warning &warning : sorted)
    result.push_back(warning.text);
  return result;
}

void keep_worst(Warnings &worst, const Warnings &found, const std::string &place)
{
  for (const Warning &warning : found)
  {
    const auto known =
        std::find_if(worst.begin(), worst.end(),
                     [&](const Warning &other) { return other.kind == warning.kind; });
    const Warning with_place{warning.kind, warning.size, warning.text + " (" + place + ")"};
    if (known == worst.end())
      worst.push_back(with_place);
    else if (warning.size > known->size)
      *known = with_place;
  }
}

Warnings tolerance_warnings(const Adaptivity &adaptivity, const double relative_half_width,
                            const std::string &no_interval)
{
  if (adaptivity.tolerance == 0 || adaptivity.tolerance_column.empty() ||
      !std::isnan(relative_half_width))
    return {};
  return {{WarningKind::no_interval, 0.,
           "Adaptivity/Tolerance was compared with nothing, and other limits ended the run: " +
               adaptivity.tolerance_column + " has no guaranteed interval, because " +
               no_interval}};
}

std::string no_guarantee(const std::string &contradiction)
{
  return "guaranteed intervals do not meet: " + contradiction;
}

Warnings contradiction_warnings(const std::string &contradiction)
{
  if (contradiction.empty())
    return {};
  return {{WarningKind::contradiction, 0.,
           no_guarantee(contradiction) +
               "; one of them is wrong, by a mistake of the program, and nothing of this run is "
               "guaranteed: please send scene.prm"}};
}

Warnings load_step_warnings(const double relative_estimate)
{
  if (!(relative_estimate > 0.1))
    return {};
  return {{WarningKind::load_step, relative_estimate,
           line("the error indicator of a load step is ", 100 * relative_estimate,
                " % of its solution, so that its numbers are rough; let it take more steps: "
                "Adaptivity/Maximum steps, Adaptivity/Tolerance, or Loading/Adapt = every step")}};
}

Warnings dissipation_warnings(const double at_ends, const double trapezoidal, const double energy)
{
  const double larger = std::max(std::abs(at_ends), std::abs(trapezoidal)),
               difference = std::abs(at_ends - trapezoidal);
  if (!(larger > 1e-6 * energy && difference > 0.05 * larger))
    return {};
  return {{WarningKind::dissipation, difference / larger,
           line("friction dissipates ", at_ends,
                " by its values at the end of each load step, which dissipated_energy counts, and ",
                trapezoidal, " by the trapezoidal rule, which work follows: ",
                100 * difference / larger, " % apart; take more Loading/Steps")}};
}

Warnings steady_warnings(const double change, const double asked_for)
{
  return {{WarningKind::unsteady, change,
           line("the energy that friction dissipates in the last cycle differs by ", 100 * change,
                " % from that in the one before, and Loading/Until steady asks for ",
                100 * asked_for, " %; raise Loading/Maximum cycles")}};
}

Warnings bound_warnings(const double relative, const double imbalance)
{
  if (!(relative < 1e-9 && relative > 1e-12)) // below that a run ends as exact to round-off
    return {};
  return {{WarningKind::bound_round_off, relative,
           line("the bound of the error is ", relative,
                " of the solution, where round-off counts: it leaves patches of cells out of "
                "balance by ",
                imbalance, " of their stresses")}};
}

template <int dim>
Warnings warnings(const Scene<dim> &scene, const std::vector<ContactState<dim>> &contact,
                  const BodyState<dim> &body, const History<dim> &history)
{
  return joined(contact_warnings(scene, contact, body), friction_warnings(scene, contact),
                mesh_warnings(scene, body), history_warnings(scene, history));
}

template Warnings warnings(const Scene<2> &, const std::vector<ContactState<2>> &,
                           const BodyState<2> &, const History<2> &);
template Warnings warnings(const Scene<3> &, const std::vector<ContactState<3>> &,
                           const BodyState<3> &, const History<3> &);
} // namespace hpvi
