// SPDX-License-Identifier: LGPL-2.1-or-later
#include "outcome.h"

#include <hpvi/base/input_error.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/driver/adaptive_solver.h>
#include <hpvi/driver/load_history.h>
#include <hpvi/reader/scene_reader.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace metamorphic
{
using namespace hpvi;

namespace
{
/** The number of a side by its name in the frame, or of a part by its own: part4 and so on. */
unsigned int number_of(const std::string &name, const Frame &frame)
{
  const std::array<std::string, 4> names = {{"bottom", "right", "top", "left"}};
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? std::stoi(name.substr(4)) : frame.side(found - names.begin());
}

StepOutcome outcome_of(const StepReport<2> &step, const Frame &frame)
{
  StepOutcome result;
  const DisplacementSpace<2> &space = step.solution().displacement_space;
  for (const unsigned int degree : space.degrees())
    ++result.cells[degree];
  result.n_unknowns = space.n_free_dofs();
  result.n_multipliers = step.solution().z.size();
  result.energy = step.energies.energy / frame.energy();
  result.lagrangian = step.energies.lagrangian / frame.energy();
  result.norm = step.energies.norm / std::sqrt(frame.energy());
  result.estimate = step.scaled_estimate / std::sqrt(frame.energy());
  result.bound = step.bound ? step.bound->total / std::sqrt(frame.energy()) : unknown;
  result.low = step.bound ? result.energy - step.bound->energy_below / frame.energy() : unknown;
  result.high = step.bound ? result.energy + step.bound->energy_above / frame.energy() : unknown;
  for (const ProbeValue<2> &probe : step.probes)
  {
    result.mises = von_mises(probe.stress) / (frame.amplitude * frame.stress);
    result.across = probe.stress[2][2] / (frame.amplitude * frame.stress);
  }
  result.misses_load =
      std::any_of(step.warnings.begin(), step.warnings.end(),
                  [](const Warning &warning) { return warning.kind == WarningKind::load; });
  const Spaces<2> &spaces = *step.solution().spaces;
  for (const UnresolvedLoad<2> &load : spaces.loads->unresolved(*spaces.mesh))
    result.missed += load.part;
  result.t = step.load.t;
  if (step.load.number > 0 && !step.stopped_by.empty())
  {
    // What an old step leaves unbalanced on a refined mesh is counted by nodes, and hanging ones depend on the frame.
    result.work = (step.load.work - step.load.unbalanced) / frame.energy();
    result.dissipated = step.load.dissipated / frame.energy();
  }
  return result;
}

/** Zones as the body counts them: a mirror turns the tangent around. */
std::vector<Zone> zones_of(const ContactState<2> &state, const Frame &frame)
{
  std::vector<Zone> zones;
  for (const ContactZone<2> &zone : state.zones)
    zones.push_back({zone.mode, frame.point_back(zone.begin), frame.point_back(zone.end)});
  if (frame.is_mirrored())
  {
    std::reverse(zones.begin(), zones.end());
    for (Zone &zone : zones)
      std::swap(zone.begin, zone.end);
  }
  return zones;
}

void add_sides(const StepReport<2> &step, const Frame &frame, Outcome &outcome)
{
  const double sign = frame.is_mirrored() ? -1. : 1.;
  for (const BoundaryForce<2> &reaction : step.equilibrium.reactions)
  {
    SideOutcome &side = outcome.sides.at(number_of(reaction.boundary, frame));
    side.force = transpose(frame.Q) * reaction.force / frame.force();
    side.moment = sign * reaction.moment / frame.force() / frame.length;
    outcome.all_forces += side.force.norm();
  }
  outcome.all_forces += step.equilibrium.loads.force.norm() / frame.force();
  for (const ContactState<2> &state : step.contact)
  {
    SideOutcome &side =
        outcome.sides.at(number_of(step.solution().scene.boundaries[state.boundary].name, frame));
    side.pressure = state.highest_pressure / (frame.amplitude * frame.stress);
    side.friction = sign * state.friction_resultant / frame.force();
    side.zones = zones_of(state, frame);
  }
}

/** Runs @p solve and keeps what it throws. */
template <class Solve>
Outcome caught(const Solve &solve)
{
  Outcome outcome;
  try
  {
    solve(outcome);
  }
  catch (const InputError &error)
  {
    outcome.refusal = "InputError";
    outcome.words = error.what();
  }
  catch (const NumericalFailure &failure)
  {
    outcome.refusal = "NumericalFailure";
    outcome.words = failure.what();
  }
  return outcome;
}
} // namespace

Outcome solve(const std::string &file, const Frame &frame)
{
  return caught(
      [&](Outcome &outcome)
      {
        const Scene<2> scene = read_scene<2>(file);
        for (const Material &material : scene.materials)
          outcome.stiffness = std::max(outcome.stiffness, material.modulus(2) / frame.stress);
        LoadHistory<2>(scene).run(
            [&](const StepReport<2> &step)
            {
              outcome.steps.push_back(outcome_of(step, frame));
              if (step.stopped_by.empty())
                return;
              outcome.sides = {};
              outcome.all_forces = 0;
              add_sides(step, frame, outcome);
            });
      });
}

Outcome solve_primal(const std::string &file, const Frame &frame)
{
  return caught(
      [&](Outcome &outcome)
      {
        Scene<2> scene = read_scene<2>(file);
        scene.solver.path = SolutionPath::primal;
        scene.solver.primal_tolerance = 1e-11;
        AdaptiveSolver<2>(scene, MPI_COMM_SELF)
            .run(
                [&](const StepReport<2> &step)
                {
                  StepOutcome result;
                  result.energy = unknown; // it integrates |u_t| across its kink
                  result.lagrangian = step.energies.lagrangian / frame.energy();
                  result.norm = step.energies.norm / std::sqrt(frame.energy());
                  result.estimate = step.scaled_estimate / std::sqrt(frame.energy());
                  outcome.steps.push_back(result);
                });
      });
}

namespace
{
/** Collects lines about numbers that differ. */
class Comparison
{
public:
  std::vector<std::string> lines;

  /** NaN on one side says that nothing is known. */
  void near(const std::string &what, const double one, const double other, const double tolerance)
  {
    if (!(std::abs(one - other) <= tolerance) && !std::isnan(one) && !std::isnan(other))
      lines.push_back(what + ": " + text(one) + " and " + text(other));
  }

  void same(const std::string &what, const double one, const double other)
  {
    if (one != other)
      lines.push_back(what + ": " + text(one) + " and " + text(other));
  }
};

void compare_ends(const Outcome &one, const Outcome &other, Comparison &comparison)
{
  const auto end = [](const Outcome &outcome)
  { return outcome.refusal.empty() ? "done" : outcome.refusal + ": " + outcome.words; };
  if (one.refusal != other.refusal)
    comparison.lines.push_back("end: " + end(one) + " and " + end(other));
  comparison.same("steps", one.steps.size(), other.steps.size());
}

void compare_meshes(const StepOutcome &one, const StepOutcome &other, const Tolerances &tolerances,
                    const std::string &place, Comparison &comparison)
{
  for (unsigned int p = 0; p < one.cells.size(); ++p)
    comparison.same(place + "cells of degree " + std::to_string(p), one.cells[p], other.cells[p]);
  comparison.same(place + "unknowns", one.n_unknowns, other.n_unknowns);
  if (tolerances.same_multipliers)
    comparison.same(place + "multipliers", one.n_multipliers, other.n_multipliers);
}

/** Beside @p norm, the largest energy norm of the run so far. */
void compare_energies(const StepOutcome &one, const StepOutcome &other, const double norm,
                      const Tolerances &tolerances, const std::string &place,
                      Comparison &comparison)
{
  // Jumps inside cells that are no parallelograms are cut along straight lines of the reference cell, which depend on the frame.
  const double factor = (one.misses_load || other.misses_load ? 100 : 1) +
                        10 * std::max(one.missed, other.missed) / tolerances.energy,
               energy = factor * tolerances.energy * norm * norm;
  comparison.near(place + "energy", one.energy, other.energy, tolerances.friction * norm * norm);
  comparison.near(place + "Lagrangian", one.lagrangian, other.lagrangian, energy);
  comparison.near(place + "energy norm", one.norm, other.norm, factor * tolerances.energy * norm);
  comparison.near(place + "indicator", one.estimate, other.estimate,
                  100 * tolerances.energy * (norm + one.estimate));
  comparison.near(place + "work", one.work, other.work, 10 * energy);
  comparison.near(place + "dissipated", one.dissipated, other.dissipated, 10 * energy);
}

void compare_bounds(const StepOutcome &one, const StepOutcome &other, const double norm,
                    const Tolerances &tolerances, const std::string &place, Comparison &comparison)
{
  if (tolerances.same_bounds && std::isnan(one.bound) != std::isnan(other.bound))
    comparison.lines.push_back(place + "bound of one alone: " + text(one.bound) + " and " +
                               text(other.bound));
  comparison.near(place + "bound", one.bound, other.bound,
                  tolerances.bound * std::min(one.bound, other.bound) + 1e-8 * norm);
}

void compare_zones(const std::vector<Zone> &one, const std::vector<Zone> &other,
                   const double distance, const std::string &place, Comparison &comparison)
{
  comparison.same(place + "zones", one.size(), other.size());
  for (unsigned int k = 0; k < std::min(one.size(), other.size()); ++k)
  {
    if (one[k].mode != other[k].mode)
      comparison.lines.push_back(place + "zone " + std::to_string(k) + ": " +
                                 mode_name(one[k].mode) + " and " + mode_name(other[k].mode));
    comparison.near(place + "distance of the ends of zone " + std::to_string(k), 0,
                    one[k].end.distance(other[k].end), distance);
  }
}
} // namespace

std::vector<std::string> differences(const Outcome &one, const Outcome &other,
                                     const Tolerances &tolerances)
{
  Comparison comparison;
  compare_ends(one, other, comparison);
  double norm = 1e-5 * std::sqrt(one.stiffness);
  for (unsigned int k = 0; k < std::min(one.steps.size(), other.steps.size()); ++k)
  {
    const StepOutcome &a = one.steps[k], &b = other.steps[k];
    const std::string place = "step " + std::to_string(k + 1) + ", ";
    norm = std::max({norm, a.norm, b.norm});
    compare_meshes(a, b, tolerances, place, comparison);
    compare_energies(a, b, norm, tolerances, place, comparison);
    compare_bounds(a, b, norm, tolerances, place, comparison);
    const double stress = 10 * tolerances.friction * norm * std::sqrt(one.stiffness);
    comparison.near(place + "stress of the disc", a.mises, b.mises, stress);
    comparison.near(place + "stress of the disc across", a.across, b.across, stress);
  }
  for (unsigned int k = 0; k < one.sides.size(); ++k)
  {
    const SideOutcome &a = one.sides[k], &b = other.sides[k];
    const std::string place = "side " + std::to_string(k) + ", ";
    const double force = tolerances.force * std::max(one.all_forces, 1e-6 * one.stiffness);
    comparison.near(place + "force", 0, (a.force - b.force).norm(), force);
    comparison.near(place + "moment", a.moment, b.moment, force);
    comparison.near(place + "friction", a.friction, b.friction, force);
    if (one.all_forces < 1e-6 * one.stiffness) // nothing presses: round-off alone decides on zones
      continue;
    if (!tolerances.same_multipliers && (a.zones.empty() || b.zones.empty()))
      continue;
    comparison.near(place + "largest pressure", a.pressure, b.pressure,
                    100 * (force + tolerances.force * a.pressure));
    compare_zones(a.zones, b.zones, tolerances.place, place, comparison);
  }
  return comparison.lines;
}

std::vector<std::string> energy_differences(const Outcome &one, const Outcome &other,
                                            const Tolerances &tolerances)
{
  Comparison comparison;
  compare_ends(one, other, comparison);
  for (unsigned int k = 0; k < std::min(one.steps.size(), other.steps.size()); ++k)
    compare_energies(one.steps[k], other.steps[k], one.steps[k].norm, tolerances,
                     "step " + std::to_string(k + 1) + ", ", comparison);
  return comparison.lines;
}

std::vector<std::string> disjoint_intervals(const Outcome &one, const Outcome &other)
{
  for (const StepOutcome &a : one.steps)
    for (const StepOutcome &b : other.steps)
      if (a.t == b.t)
      {
        const double round_off = 1e-10 * (a.norm * a.norm + b.norm * b.norm);
        if (a.low > b.high + round_off || b.low > a.high + round_off)
          return {"intervals of energy do not meet: [" + text(a.low) + ", " + text(a.high) +
                  "] and [" + text(b.low) + ", " + text(b.high) + "]"};
      }
  return {};
}
} // namespace metamorphic
