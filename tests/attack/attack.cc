// SPDX-License-Identifier: LGPL-2.1-or-later
// A random attack on the guaranteed bound: scenes with rough data, long and skew cells and any method, each beside a finer
// run. The distance of both solutions is at most the sum of their bounds; and all steps of both have an interval for the
// least energy, of which any two meet, and for each force and mean displacement. A scene in which they do not is kept, to be repeated.
//
//     attack SECONDS SEED DIRECTORY       as many scenes as fit
//     attack --scenes N SEED DIRECTORY    that many
//     attack --scene K SEED DIRECTORY     one of them again
//     attack --bodies ...                 of these bodies that touch each other
#include "rough_scene.h"
#include "touching_scene.h"

#include <deal.II/base/mpi.h>
#include <hpvi/adaptivity/adaptive_solver.h>
#include <hpvi/base/input_error.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/evaluation/solution_field.h>
#include <hpvi/evaluation/stored_solution.h>
#include <hpvi/reader/scene_reader.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <sstream>

#include <unistd.h>

namespace
{
using namespace hpvi;
using Overrides = std::vector<std::pair<std::string, std::string>>;

/** Of a relative error, and of energies beside the square of the norm: round-off. */
constexpr double floor_of_errors = 1e-9, floor_of_energies = 1e-10;

/** What a step with a bound says. */
struct Step
{
  unsigned int number;
  double norm, bound, low, high;
  double error; ///< distance from the reference; NaN where there is none
  std::map<std::string, Interval> intervals; ///< of forces and mean displacements
};

/** What a step guarantees of forces and probes, by name. */
std::map<std::string, Interval> intervals_of(const StepReport<2> &step)
{
  std::map<std::string, Interval> result;
  const auto add = [&](const std::string &name, const Measured &number)
  {
    if (number.interval)
      result[name] = *number.interval;
  };
  for (const Resultant<2> &row : step.forces)
  {
    add("force x on " + row.name, row.force[0]);
    add("force y on " + row.name, row.force[1]);
    add("moment on " + row.name, row.moment[0]);
    add("normal force on " + row.name, row.normal);
    add("friction on " + row.name, row.friction);
  }
  for (const ProbeValue<2> &probe : step.probes)
    for (unsigned int c = 0; c < 2; ++c)
      add("probe " + step.scene.probes[probe.probe].name + " " + "xy"[c], probe.displacement[c]);
  return result;
}

/** A run of a scene, and how it ended where it was not done. */
struct Run
{
  std::vector<Step> steps;
  std::vector<std::string> reasons; ///< of steps without a bound
  std::string refusal, surprise;
};

/** @p finished is called with each step that has a bound. */
Run solve(const std::string &file, const Overrides &overrides,
          const std::function<void(const StepReport<2> &)> &finished = {})
{
  Run run;
  try
  {
    const Scene<2> scene = read_scene<2>(file, overrides);
    AdaptiveSolver<2>(scene).run(
        [&](const StepReport<2> &step)
        {
          if (!step.bound)
          {
            run.reasons.push_back(step.no_bound);
            return;
          }
          const double energy = step.energies.energy;
          run.steps.push_back({step.number, step.energies.norm, step.bound->total,
                               energy - step.bound->energy_below, energy + step.bound->energy_above,
                               step.errors.energy, intervals_of(step)});
          if (finished)
            finished(step);
        });
  }
  catch (const InputError &error)
  {
    run.refusal = error.what();
  }
  catch (const NumericalFailure &failure)
  {
    run.refusal = failure.what();
  }
  catch (const std::exception &error)
  {
    run.surprise = error.what();
  }
  return run;
}

/** What all scenes together came to. */
struct Score
{
  unsigned int n_scenes = 0, n_bounds = 0, n_compared = 0, n_violations = 0, n_intervals = 0;
  std::map<std::string, unsigned int> refusals, reasons;  ///< how often, by their first words
  double least = std::numeric_limits<double>::infinity(); ///< of bound/error
  std::string where;                                      ///< the step with it
};

/** What is the same in all scenes: a message up to its first number. */
std::string first_words(const std::string &message)
{
  return message.substr(0, std::min<std::size_t>(message.find_first_of("(0123456789"), 70));
}

class Attack
{
public:
  Attack(const unsigned int seed, const std::filesystem::path &directory, const bool has_bodies)
      : seed(seed), directory(directory), has_bodies(has_bodies),
        stem((directory / ("running-" + std::to_string(getpid()))).string())
  {
    std::filesystem::create_directories(directory);
  }

  ~Attack()
  {
    for (const char *const ending : {".prm", ".reference"})
      std::filesystem::remove(stem + ending);
  }

  Attack(const Attack &) = delete;
  Attack &operator=(const Attack &) = delete;

  void try_scene(unsigned int number);
  Score score;

private:
  Run solve_reference(double &bound) const;
  std::vector<std::string> flaws(const Run &run, const Run &reference, double of_reference,
                                 unsigned int number);
  void compare_intervals(const std::vector<Step> &all, std::vector<std::string> &result);
  void keep(unsigned int number, const std::vector<std::string> &flaws) const;

  const unsigned int seed;
  const std::filesystem::path directory;
  const bool has_bodies;
  const std::string stem; ///< of the files of the scene that is tried
};

/** Many steps of a method of its own; stored is the one with the least bound. */
Run Attack::solve_reference(double &bound) const
{
  bound = std::numeric_limits<double>::infinity();
  return solve(stem + ".prm",
               {{"Adaptivity/Method", "hpa3"},
                {"Adaptivity/Start degree", "0"},
                {"Adaptivity/Indicator", "bound"},
                {"Adaptivity/Maximum steps", "12"},
                {"Adaptivity/Maximum unknowns", "2500"}},
               [&](const StepReport<2> &step)
               {
                 if (!(step.bound->total < bound))
                   return;
                 bound = step.bound->total;
                 std::ofstream file(stem + ".reference");
                 write_solution(file, step.field, step.energies.energy);
               });
}

/** What contradicts the theorems; the score takes in how near the bounds are. */
std::vector<std::string> Attack::flaws(const Run &run, const Run &reference,
                                       const double of_reference, const unsigned int number)
{
  std::vector<std::string> result;
  for (const Step &step : run.steps)
  {
    const std::string place = "step " + std::to_string(step.number);
    const double round_off = floor_of_errors * step.norm;
    if (step.bound + of_reference + round_off < step.error)
      result.push_back(place + ": bound " + std::to_string(step.bound / step.error) +
                       " times the distance from the reference, whose bound is " +
                       std::to_string(of_reference / step.error) + " of it");
    if (10 * of_reference < step.error && step.error > round_off)
    {
      ++score.n_compared;
      if (step.bound / step.error < score.least)
      {
        score.least = step.bound / step.error;
        score.where = "scene " + std::to_string(number) + ", " + place;
      }
    }
  }
  std::vector<Step> all(run.steps);
  all.insert(all.end(), reference.steps.begin(), reference.steps.end());
  for (const Step &one : all)
    for (const Step &other : all)
      if (one.low >
          other.high + floor_of_energies * (std::pow(one.norm, 2) + std::pow(other.norm, 2)))
      {
        std::ostringstream line;
        line.precision(12);
        line << "intervals of energy do not meet: [" << one.low << ", " << one.high << "] in step "
             << one.number << " and [" << other.low << ", " << other.high << "] in step "
             << other.number
             << (&one >= &all[0] + run.steps.size() ? ", of the reference and"
                                                    : ", of the scene and")
             << (&other >= &all[0] + run.steps.size() ? " of the reference" : " of the scene");
        result.push_back(line.str());
      }
  compare_intervals(all, result);
  return result;
}

/** Intervals of forces and means of any two steps meet. */
void Attack::compare_intervals(const std::vector<Step> &all, std::vector<std::string> &result)
{
  struct Ends
  {
    double low = -std::numeric_limits<double>::infinity(), high = -low, size = 0;
    unsigned int step_of_low = 0, step_of_high = 0;
  };
  std::map<std::string, Ends> ends;
  for (const Step &step : all)
    for (const auto &[name, interval] : step.intervals)
    {
      ++score.n_intervals;
      Ends &known = ends[name];
      if (interval.centre - interval.half_width > known.low)
      {
        known.low = interval.centre - interval.half_width;
        known.step_of_low = step.number;
      }
      if (interval.centre + interval.half_width < known.high)
      {
        known.high = interval.centre + interval.half_width;
        known.step_of_high = step.number;
      }
      known.size = std::max(known.size, std::abs(interval.centre));
    }
  for (const auto &[name, known] : ends)
    if (known.low > known.high + floor_of_errors * known.size)
    {
      std::ostringstream line;
      line.precision(12);
      line << "intervals of " << name << " do not meet: above " << known.low << " in step "
           << known.step_of_low << ", below " << known.high << " in step " << known.step_of_high;
      result.push_back(line.str());
    }
}

/** The scene, with what it contradicts. */
void Attack::keep(const unsigned int number, const std::vector<std::string> &flaws) const
{
  const auto file =
      directory / ("scene-" + std::to_string(seed) + "-" + std::to_string(number) + ".prm");
  std::ofstream out(file);
  std::cout << file.string() << ":\n";
  for (const std::string &flaw : flaws)
  {
    out << "# " << flaw << '\n';
    std::cout << "  " << flaw << std::endl;
  }
  out << std::ifstream(stem + ".prm").rdbuf();
}

void Attack::try_scene(const unsigned int number)
{
  std::mt19937 random(seed + 1000003 * number);
  std::ofstream(stem + ".prm") << (has_bodies ? attack::touching_scene(random)
                                              : attack::rough_scene(random));
  if (!has_bodies)
    std::ofstream(stem + ".prm", std::ios::app)
        << "subsection Probe attacked\n  set On = "
        << std::array<const char *, 4>{{"left", "right", "bottom", "top"}}[random() % 4]
        << "\nend\n";
  ++score.n_scenes;
  double of_reference;
  const Run reference = solve_reference(of_reference);
  Overrides against;
  if (std::isfinite(of_reference))
    against.emplace_back("Error/Reference solution", stem + ".reference");
  const Run run = solve(stem + ".prm", against);
  std::vector<std::string> found = flaws(run, reference, of_reference, number);
  for (const std::string &surprise : {run.surprise, reference.surprise})
    if (!surprise.empty())
      found.push_back("no error that the program knows: " + surprise);
  if (!run.refusal.empty())
    ++score.refusals[first_words(run.refusal.substr(run.refusal.find(": ") + 2))];
  for (const std::string &reason : run.reasons)
    ++score.reasons[first_words(reason)];
  score.n_bounds += run.steps.size();
  score.n_violations += !found.empty();
  if (!found.empty())
    keep(number, found);
}
} // namespace

int main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const bool has_bodies = argc > 1 && std::string(argv[1]) == "--bodies";
  argc -= has_bodies;
  argv += has_bodies;
  const std::string word = argc > 1 ? argv[1] : "";
  const bool counts = word == "--scenes", one = word == "--scene";
  if (argc != (counts || one ? 5 : 4))
  {
    std::cerr
        << "attack: wants [--bodies] SECONDS SEED DIRECTORY, or --scenes N SEED DIRECTORY, or "
           "--scene K SEED DIRECTORY\n";
    return 1;
  }
  const double limit = std::atof(argv[argc - 3]);
  Attack attack(std::atoi(argv[argc - 2]), argv[argc - 1], has_bodies);
  const auto begin = std::chrono::steady_clock::now();
  unsigned int number = one ? limit : 0;
  const auto goes_on = [&]
  {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
    return one ? number == limit : counts ? number < limit : passed.count() < limit;
  };
  for (; goes_on(); ++number)
    attack.try_scene(number);
  const Score &score = attack.score;
  for (const auto &[words, n] : score.refusals)
    std::cout << n << " scenes given up: " << words << "...\n";
  for (const auto &[words, n] : score.reasons)
    std::cout << n << " steps without a bound: " << words << "...\n";
  std::cout << score.n_scenes << " scenes, " << score.n_bounds << " steps with a bound, "
            << score.n_intervals << " intervals of forces and means\n"
            << "least bound/error of " << score.n_compared << " steps: " << score.least
            << (score.where.empty() ? "" : " (" + score.where + ")") << "; " << score.n_violations
            << " scenes contradict" << std::endl;
  return score.n_violations > 0 || score.n_compared == 0 ? 1 : 0;
}
