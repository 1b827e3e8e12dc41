// SPDX-License-Identifier: LGPL-2.1-or-later
// A random attack on the guaranteed bound: scenes with rough data, long and skew cells, bodies that touch, and what is hidden
// between the points of coarse meshes, by any method, each beside a finer run, whose mesh knows where that is hidden. The distance
// of both solutions is at most the sum of their bounds; and all steps of both have an interval for the least energy, of which any
// two meet, and for each force and mean displacement; so has either body of a pair. What is exact to round-off without a
// warning is in the intervals of the reference. A scene in which this does not hold is kept beside its reference, to be repeated.
// Under Coulomb's law no two steps may be farther apart than the sum of their bounds, for each holds for all solutions; none has an
// energy, and a bound that assumes zones counts as none. Boxes in space have an interval of the energy alone.
//
//     attack SECONDS SEED DIRECTORY       as many scenes as fit, of one kind after the other
//     attack --scenes N SEED DIRECTORY    that many
//     attack --scene K SEED DIRECTORY     one of them again
//     attack --kind KIND ...              of one kind alone
#include "box_scene.h"
#include "curved_scene.h"
#include "hidden_scene.h"
#include "rough_scene.h"
#include "touching_scene.h"

#include <deal.II/base/mpi.h>
#include <hpvi/base/input_error.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/driver/adaptive_solver.h>
#include <hpvi/reader/scene_reader.h>
#include <hpvi/results/solution_field.h>
#include <hpvi/results/stored_solution.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include <unistd.h>

namespace
{
using namespace hpvi;
using Overrides = std::vector<std::pair<std::string, std::string>>;

/** Of a relative error, and of energies beside the square of the norm: round-off. What is exact has this of all forces, or means. */
constexpr double floor_of_errors = 1e-9, floor_of_energies = 1e-10, floor_of_exact = 1e-7;

constexpr double infinity = std::numeric_limits<double>::infinity(),
                 none = std::numeric_limits<double>::quiet_NaN();

/** Where a number of the exact solution lies, up to @p round_off. */
struct Range
{
  double low, high, round_off;
};

/** What a step says of the exact solution. */
struct Step
{
  std::string name;
  double norm, bound;     ///< NaN: has none
  double error;           ///< distance from the reference; NaN where there is none
  double of_rigid_motion; ///< what round-off of it strains
  std::vector<std::pair<std::string, Range>> ranges; ///< of energy, forces and mean displacements
};

/** Forces and probes by name; both sides of a pair have the same resultants. */
template <int dim>
std::vector<std::pair<std::string, Measured>> numbers_of(const StepReport<dim> &step)
{
  std::vector<std::pair<std::string, Measured>> result;
  if constexpr (dim == 3)
    return result; // none has an interval
  for (const Resultant<dim> &row : step.forces)
  {
    const auto &all = step.scene.boundaries;
    const auto pair = row.boundary < all.size() ? all[row.boundary].pair : std::nullopt;
    const std::string part = pair ? "pair " + step.scene.pairs[*pair].name : row.name;
    result.insert(result.end(), {{"force x on " + row.name, row.force[0]},
                                 {"force y on " + row.name, row.force[1]},
                                 {"moment on " + row.name, row.moment[0]},
                                 {"normal force on " + part, row.normal},
                                 {"friction on " + part, row.friction}});
  }
  for (const ProbeValue<dim> &probe : step.probes)
    for (unsigned int c = 0; c < dim; ++c)
      result.emplace_back("probe " + step.scene.probes[probe.probe].name + " " + "xyz"[c],
                          probe.displacement[c]);
  return result;
}

/** Beside the square of the norm, and of what round-off of a rigid motion strains, in the last step. */
template <int dim>
double round_off_of_energy(const StepReport<dim> &step, const double floor)
{
  const double largest = step.largest_displacement.value; // NaN: not the last one
  return floor * std::pow(step.energies.norm, 2) +
         (largest > 0 ? step.scene.reference_coercivity() * std::pow(1e-13 * largest, 2) : 0.);
}

/** Has it a bound that assumes nothing of the solution? */
template <int dim>
bool is_known(const StepReport<dim> &step)
{
  return step.bound && step.bound->kind != BoundKind::zones;
}

/** What is guaranteed: without a bound no more than an energy above the least one. */
template <int dim>
Step guaranteed(const StepReport<dim> &step)
{
  Step result{"step " + std::to_string(step.number),
              step.energies.norm,
              none,
              none,
              std::sqrt(round_off_of_energy(step, 0.)),
              {}};
  const double energy = step.energies.energy,
               round_off = round_off_of_energy(step, floor_of_energies);
  if (!is_known(step))
  {
    if (!std::isnan(step.energy_high))
      result.ranges = {{"energy", {-infinity, step.energy_high, round_off}}};
    return result;
  }
  result.bound = step.bound->total;
  result.error = step.errors.energy;
  if (step.bound->kind == BoundKind::energy)
    result.ranges = {
        {"energy",
         {energy - step.bound->energy_below, energy + step.bound->energy_above, round_off}}};
  for (const auto &[name, number] : numbers_of(step))
    if (const auto &interval = number.interval)
      result.ranges.push_back(
          {name,
           {interval->centre - interval->half_width, interval->centre + interval->half_width,
            floor_of_errors * std::abs(interval->centre)}});
  return result;
}

/** What is said of numbers that are exact to round-off. */
template <int dim>
Step exact(const StepReport<dim> &step)
{
  const auto numbers = numbers_of(step);
  const double displacement = step.largest_displacement.value;
  std::map<bool, double> largest{// of probes and of all else, which round-off of a rigid motion has
                                 {true, displacement},
                                 {false, 1e-6 * step.scene.reference_coercivity() * displacement}};
  const auto is_probe = [](const std::string &name) { return name.rfind("probe", 0) == 0; };
  for (const auto &[name, number] : numbers)
    if (!std::isnan(number.value))
      largest[is_probe(name)] = std::max(largest[is_probe(name)], std::abs(number.value));
  const double energy = step.energies.energy;
  Step result{"step " + std::to_string(step.number) + ", exact to round-off",
              step.energies.norm,
              none,
              none,
              0.,
              {{"energy", {energy, energy, round_off_of_energy(step, floor_of_exact)}}}};
  for (const auto &[name, number] : numbers)
    if (!std::isnan(number.value))
      result.ranges.push_back(
          {name, {number.value, number.value, floor_of_exact * largest[is_probe(name)]}});
  return result;
}

/** A run of a scene, and how it ended where it was not done. */
struct Run
{
  std::vector<Step> steps;
  std::vector<std::string> reasons; ///< of steps without a bound
  std::string refusal, surprise;
};

/** Of steps before the last one: is said to have missed what acts? */
template <int dim>
bool takes_back(const StepReport<dim> &step)
{
  return std::any_of(step.warnings.begin(), step.warnings.end(),
                     [](const Warning &warning) {
                       return warning.text.find("steps before knew nothing") != std::string::npos;
                     });
}

/** @p finished is called with each step that has a bound. */
template <int dim>
Run solve(const std::string &file, const Overrides &overrides,
          const std::function<void(const StepReport<dim> &)> &finished = {})
{
  Run run;
  try
  {
    const Scene<dim> scene = read_scene<dim>(file, overrides);
    AdaptiveSolver<dim>(scene).run(
        [&](const StepReport<dim> &step)
        {
          if (takes_back(step))
            run.steps.clear();
          run.steps.push_back(guaranteed(step));
          if (!is_known(step))
            run.reasons.push_back(step.bound ? "zones are assumed" : step.no_bound);
          else if (finished)
            finished(step);
          if (text(step.stopped_by) == "round-off" && step.warnings.empty())
            run.steps.push_back(exact(step));
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

/** What scenes of one kind came to, or all. */
struct Score
{
  unsigned int n_scenes = 0, n_bounds = 0, n_compared = 0, n_ranges = 0, n_violations = 0;
  double least = infinity; ///< of bound/error
  std::string where;       ///< the step with it

  void add(const Score &other)
  {
    n_scenes += other.n_scenes;
    n_bounds += other.n_bounds;
    n_compared += other.n_compared;
    n_ranges += other.n_ranges;
    n_violations += other.n_violations;
    if (other.least < least)
      where = other.where;
    least = std::min(least, other.least);
  }

  bool is_empty() const ///< are scenes enough to say something, and say nothing?
  {
    return n_scenes >= 4 && n_ranges + n_compared == 0;
  }
};

std::ostream &operator<<(std::ostream &out, const Score &score)
{
  return out << score.n_scenes << " scenes, " << score.n_bounds << " steps with a bound, "
             << score.n_ranges << " ranges of energies, forces and means, least bound/error of "
             << score.n_compared << " steps: " << score.least
             << (score.where.empty() ? "" : " (" + score.where + ")") << "; " << score.n_violations
             << " scenes contradict";
}

/** What is the same in all scenes: a message up to its first number. */
std::string first_words(const std::string &message)
{
  return message.substr(0, std::min<std::size_t>(message.find_first_of("(0123456789"), 70));
}

/** Of a refusal: what follows "FILE: " and, where there is one, "Entry = VALUE: ". */
std::string reason_of(const std::string &refusal)
{
  const std::size_t value = refusal.find(" = "), from = value == std::string::npos ? 0 : value;
  return refusal.substr(refusal.find(": ", from) + 2);
}

/** Kinds that are tried under Coulomb's law, too. */
const std::array<std::string, 3> coulomb_geometries{{"curved", "turned", "unmatched"}};

/** All kinds of scenes, in the order in which they take turns. */
std::vector<std::string> all_kinds()
{
  std::vector<std::string> result{"rough", "bodies", "unmatched", "curved", "turned"};
  result.insert(result.end(), attack::hidden_kinds.begin(), attack::hidden_kinds.end());
  result.insert(result.end(), {"coulomb", "boxes"});
  for (const std::string &geometry : coulomb_geometries)
    result.push_back("coulomb " + geometry);
  return result;
}

/** Of bodies that are polynomials. */
bool has_curves(const std::string &kind)
{
  return kind.find("curved") != std::string::npos || kind.find("turned") != std::string::npos;
}

/** All friction is Coulomb's, and contact may open everywhere. */
std::string under_coulombs_law(const std::string &text, std::mt19937 &random)
{
  std::uniform_real_distribution<double> exponent(-1.5, 0.);
  std::istringstream in(text);
  std::ostringstream out;
  for (std::string line; std::getline(in, line);)
    if (line.rfind("  set Friction bound", 0) == 0)
      out << "  set Friction coefficient = " << std::pow(10, exponent(random)) << '\n';
    else if (line == "  set Law = bilateral" || line == "  set Law = tangential")
      out << "  set Law = unilateral\n";
    else
      out << line << '\n';
  return out.str();
}

attack::DrawnScene draw(const std::string &kind, std::mt19937 &random)
{
  for (const std::string &geometry : coulomb_geometries)
    if (kind == "coulomb " + geometry)
    {
      attack::DrawnScene result = draw(geometry, random);
      result.text = result.reference = under_coulombs_law(result.text, random);
      return result;
    }
  if (has_curves(kind))
  {
    const std::string text =
        kind == "curved" ? attack::curved_scene(random) : attack::turned_scene(random);
    return {text, text, /*shares_mesh=*/false};
  }
  if (kind == "boxes")
  {
    const std::string text = attack::box_scene(random);
    return {text, text, true};
  }
  const bool is_rough = kind == "rough" || kind == "coulomb";
  if (!is_rough && kind != "bodies" && kind != "unmatched")
    return attack::hidden_scene(kind, random);
  const std::string text = is_rough ? attack::rough_scene(random, /*is_coulomb=*/kind == "coulomb")
                                    : attack::touching_scene(random, /*matches=*/kind == "bodies");
  return {text, text, true};
}

class Attack
{
public:
  Attack(const unsigned int seed, const std::filesystem::path &directory,
         std::vector<std::string> kinds)
      : seed(seed), directory(directory), kinds(std::move(kinds)),
        stem((directory / ("running-" + std::to_string(getpid()))).string())
  {
    std::filesystem::create_directories(directory);
  }

  ~Attack()
  {
    for (const char *const ending : {".prm", "-reference.prm", ".reference"})
      std::filesystem::remove(stem + ending);
  }

  Attack(const Attack &) = delete;
  Attack &operator=(const Attack &) = delete;

  void try_scene(unsigned int number);
  std::map<std::string, Score> scores;                   ///< by the kind of the scene
  std::map<std::string, unsigned int> refusals, reasons; ///< how often, by their first words

private:
  const std::string &kind(const unsigned int number) const
  {
    return kinds[number % kinds.size()];
  }

  Run solve_reference(double &bound, unsigned int number) const;
  std::vector<std::string> flaws(const Run &run, const Run &reference, double of_reference,
                                 unsigned int number);
  static void compare_ranges(const Run &run, const Run &reference, double of_bodies,
                             unsigned int &n_ranges, std::vector<std::string> &result);
  void keep(unsigned int number, const std::vector<std::string> &flaws) const;

  const unsigned int seed;
  const std::filesystem::path directory;
  const std::vector<std::string> kinds; ///< that take turns
  const std::string stem;               ///< of the files of the scene that is tried
};

/** A method of its own. */
const Overrides of_reference_run{{"Adaptivity/Method", "hpa3"},
                                 {"Adaptivity/Start degree", "0"},
                                 {"Adaptivity/Indicator", "bound"},
                                 {"Adaptivity/Maximum steps", "12"},
                                 {"Adaptivity/Maximum unknowns", "2500"}};

const Overrides of_reference_in_space{{"Adaptivity/Method", "hap3"},
                                      {"Adaptivity/Maximum steps", "3"},
                                      {"Adaptivity/Maximum unknowns", "4000"}};

/** Many steps; stored is the one with the least bound. */
Run Attack::solve_reference(double &bound, const unsigned int number) const
{
  bound = infinity;
  const auto keep_nearest = [&](const auto &step)
  {
    if (!(step.bound->total < bound))
      return;
    bound = step.bound->total;
    std::ofstream file(stem + ".reference");
    write_solution(file, step.field, step.energies.energy);
  };
  if (kind(number) == "boxes")
    return solve<3>(stem + "-reference.prm", of_reference_in_space, keep_nearest);
  Overrides entries = of_reference_run;
  if (has_curves(kind(number))) // polynomials of low degree make another body
    entries[1].second = "7";
  return solve<2>(stem + "-reference.prm", entries, keep_nearest);
}

/** What contradicts the theorems; the score takes in how near the bounds are. */
std::vector<std::string> Attack::flaws(const Run &run, const Run &reference,
                                       const double of_reference, const unsigned int number)
{
  std::vector<std::string> result;
  Score &score = scores[kind(number)];
  for (const Step &step : run.steps)
  {
    const double round_off = floor_of_errors * step.norm + step.of_rigid_motion;
    if (step.bound + of_reference + round_off < step.error)
      result.push_back(step.name + ": bound " + std::to_string(step.bound / step.error) +
                       " times the distance from the reference, whose bound is " +
                       std::to_string(of_reference / step.error) + " of it");
    if (10 * of_reference < step.error && step.error > round_off)
    {
      ++score.n_compared;
      if (step.bound / step.error < score.least)
      {
        score.least = step.bound / step.error;
        score.where = "scene " + std::to_string(number) + ", " + step.name;
      }
    }
  }
  compare_ranges(run, reference, has_curves(kind(number)) ? 1e-7 : 0., score.n_ranges, result);
  return result;
}

/** Ranges of any two steps meet, but for what bodies of two meshes differ by; of each of both runs the highest low end and the lowest high one tell. */
void Attack::compare_ranges(const Run &run, const Run &reference, const double of_bodies,
                            unsigned int &n_ranges, std::vector<std::string> &result)
{
  struct End
  {
    double value, round_off = 0;
    std::string step{};
  };
  struct Ends
  {
    End low{-infinity}, high{infinity};
  };
  std::map<std::string, std::array<Ends, 2>> ends;
  for (const Run *const one : {&run, &reference})
    for (const Step &step : one->steps)
      for (const auto &[name, range] : step.ranges)
      {
        ++n_ranges;
        const bool of_reference = one == &reference;
        Ends &known = ends[name][of_reference];
        const std::string words = step.name + (of_reference ? " of the reference" : "");
        if (range.low > known.low.value)
          known.low = {range.low, range.round_off, words};
        if (range.high < known.high.value)
          known.high = {range.high, range.round_off, words};
      }
  for (const auto &[name, both] : ends)
    for (const Ends &one : both)
      for (const Ends &other : both)
      {
        const End &low = one.low, &high = other.high;
        if (low.value >
            high.value + low.round_off + high.round_off + of_bodies * std::abs(high.value))
        {
          std::ostringstream line;
          line.precision(12);
          line << name << " is at least " << low.value << " in " << low.step << ", at most "
               << high.value << " in " << high.step;
          result.push_back(line.str());
        }
      }
}

/** The scene, with what it contradicts, and its reference. */
void Attack::keep(const unsigned int number, const std::vector<std::string> &flaws) const
{
  const std::string file =
      (directory / ("scene-" + std::to_string(seed) + "-" + std::to_string(number))).string();
  std::ofstream out(file + ".prm"), reference(file + "-reference.prm");
  std::cout << file << ".prm (" << kind(number) << "):\n";
  for (const std::string &flaw : flaws)
  {
    out << "# " << flaw << '\n';
    std::cout << "  " << flaw << std::endl;
  }
  out << std::ifstream(stem + ".prm").rdbuf();
  reference << "# hpvi";
  for (const auto &[entry, value] :
       kind(number) == "boxes" ? of_reference_in_space : of_reference_run)
    reference << " --set \"" << entry << "=" << value << '"';
  reference << '\n' << std::ifstream(stem + "-reference.prm").rdbuf();
}

void Attack::try_scene(const unsigned int number)
{
  std::mt19937 random(seed + 1000003 * number);
  attack::DrawnScene scene = draw(kind(number), random);
  if (kind(number) == "rough")
  {
    const std::string probe =
        std::string("subsection Probe attacked\n  set On = ") +
        std::array<const char *, 4>{{"left", "right", "bottom", "top"}}[random() % 4] + "\nend\n";
    scene.text += probe;
    scene.reference += probe;
  }
  std::ofstream(stem + ".prm") << scene.text;
  std::ofstream(stem + "-reference.prm") << scene.reference;
  Score &score = scores[kind(number)];
  ++score.n_scenes;
  double of_reference;
  const Run reference = solve_reference(of_reference, number);
  Overrides against;
  if (scene.shares_mesh && std::isfinite(of_reference))
    against.emplace_back("Error/Reference solution", stem + ".reference");
  const Run run =
      kind(number) == "boxes" ? solve<3>(stem + ".prm", against) : solve<2>(stem + ".prm", against);
  std::vector<std::string> found = flaws(run, reference, of_reference, number);
  for (const std::string &surprise : {run.surprise, reference.surprise})
    if (!surprise.empty())
      found.push_back("no error that the program knows: " + surprise);
  for (const std::string &refusal : {run.refusal, reference.refusal})
    if (!refusal.empty())
      ++refusals[first_words(reason_of(refusal))];
  for (const std::string &reason : run.reasons)
    ++reasons[first_words(reason)];
  score.n_bounds += std::count_if(run.steps.begin(), run.steps.end(),
                                  [](const Step &step) { return !std::isnan(step.bound); });
  if (!found.empty())
  {
    ++score.n_violations;
    keep(number, found);
  }
}
} // namespace

int main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::vector<std::string> kinds = all_kinds();
  bool is_known = true;
  if (argc > 2 && std::string(argv[1]) == "--kind")
  {
    const std::string first_word = argv[2];
    kinds.erase(std::remove_if(kinds.begin(), kinds.end(),
                               [&](const std::string &kind) {
                                 return kind != first_word && kind.rfind(first_word + " ", 0) != 0;
                               }),
                kinds.end());
    is_known = !kinds.empty();
    argc -= 2;
    argv += 2;
  }
  const std::string word = argc > 1 ? argv[1] : "";
  const bool counts = word == "--scenes", one = word == "--scene";
  if (argc != (counts || one ? 5 : 4) || !is_known)
  {
    std::cerr
        << "attack: wants [--kind KIND] SECONDS SEED DIRECTORY, or --scenes N SEED DIRECTORY, "
           "or --scene K SEED DIRECTORY; kinds are";
    for (const std::string &kind : all_kinds())
      std::cerr << ' ' << kind;
    std::cerr << '\n';
    return 1;
  }
  const double limit = std::atof(argv[argc - 3]);
  Attack attack(std::atoi(argv[argc - 2]), argv[argc - 1], kinds);
  const auto begin = std::chrono::steady_clock::now();
  unsigned int number = one ? limit : 0;
  const auto goes_on = [&]
  {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
    return one ? number == limit : counts ? number < limit : passed.count() < limit;
  };
  for (; goes_on(); ++number)
    attack.try_scene(number);
  for (const auto &[words, n] : attack.refusals)
    std::cout << n << " runs given up: " << words << "...\n";
  for (const auto &[words, n] : attack.reasons)
    std::cout << n << " steps without a bound: " << words << "...\n";
  Score all;
  bool is_empty = false;
  for (const auto &[kind, score] : attack.scores)
  {
    std::cout << kind << ": " << score << (score.is_empty() ? "; NOTHING COMPARED" : "") << '\n';
    all.add(score);
    is_empty = is_empty || score.is_empty();
  }
  std::cout << "in all: " << all << std::endl;
  return all.n_violations > 0 || is_empty || all.n_ranges + all.n_compared == 0 ? 1 : 0;
}
