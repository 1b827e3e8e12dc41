// SPDX-License-Identifier: LGPL-2.1-or-later
// Random scenes, each told in several ways and solved by several methods that must agree: turned, mirrored, scaled,
// shifted, in other units, with sides named from another corner and sections in another order; by both solvers of
// quadratic programs, both paths, both solvers of Coulomb's law, as a history of one load step, with data that say
// nothing. Energies, indicators, meshes, forces, zones are compared, and intervals of energy of different methods meet.
//
//     metamorphic SECONDS SEED       as many scenes as fit
//     metamorphic --scenes N SEED    that many
//     metamorphic --scene K SEED     one of them again
#include "relations.h"

#include <deal.II/base/mpi.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>

#include <unistd.h>

namespace
{
using namespace metamorphic;

/** Solves texts, each once. */
class Runs
{
public:
  explicit Runs(const std::string &file) : file(file)
  {
  }

  const Outcome &of(const std::string &text, const Frame &frame, const bool primal = false)
  {
    const auto known = outcomes.find(text);
    if (known != outcomes.end())
      return known->second;
    std::ofstream(file) << text;
    return outcomes[text] = primal ? solve_primal(file, frame) : solve(file, frame);
  }

private:
  const std::string file;
  std::map<std::string, Outcome> outcomes;
};

/** What all scenes together came to. */
struct Score
{
  unsigned int n_passed = 0, n_failed = 0, n_refused = 0;
};

/** One scene and all that must agree with it. */
void try_scene(const unsigned int number, const unsigned int seed, const std::string &file,
               Score &score)
{
  std::mt19937 random(seed + 1000003 * number);
  const RandomScene scene(random);
  Runs runs(file);
  for (const Relation &relation : relations(scene, random))
  {
    const Frame own = relation.one.own_frame();
    const std::string one = relation.one.text(own), other = relation.other.text(relation.frame);
    const Outcome &first = runs.of(one, own),
                  &second = runs.of(other, relation.frame,
                                    relation.claim == Relation::Claim::same_primal);
    const std::vector<std::string> flaws = relation.flaws(first, second);
    if (flaws.empty())
      ++(first.refusal.empty() ? score.n_passed : score.n_refused);
    else
    {
      ++score.n_failed;
      std::cout << "scene " << number << ", " << relation.name << ":\n";
      for (const std::string &flaw : flaws)
        std::cout << "  " << flaw << '\n';
      std::cout << "# one:\n" << one << "# other:\n" << other << std::endl;
    }
  }
}
} // namespace

int main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string word = argc > 1 ? argv[1] : "";
  const bool counts = word == "--scenes", one = word == "--scene";
  if (argc != (counts || one ? 4 : 3))
  {
    std::cerr << "metamorphic: wants SECONDS SEED, or --scenes N SEED, or --scene K SEED\n";
    return 1;
  }
  const double limit = std::atof(argv[argc - 2]);
  const unsigned int seed = std::atoi(argv[argc - 1]);
  const auto begin = std::chrono::steady_clock::now();
  const auto file =
      std::filesystem::temp_directory_path() / ("metamorphic-" + std::to_string(getpid()) + ".prm");
  unsigned int number = one ? limit : 0;
  const auto goes_on = [&]
  {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
    return one ? number == limit : counts ? number < limit : passed.count() < limit;
  };
  Score score;
  for (; goes_on(); ++number)
    try_scene(number, seed, file.string(), score);
  std::filesystem::remove(file);
  std::cout << number << " scenes; " << score.n_refused << " pairs refused alike\n"
            << score.n_passed << " passed, " << score.n_failed << " failed" << std::endl;
  return score.n_failed > 0 || score.n_passed == 0 ? 1 : 0;
}
