// SPDX-License-Identifier: LGPL-2.1-or-later
// A thousand scenes in one process: the memory that it uses does not grow, and each result has the
// bytes of a fresh process's. ./run long.
#include <hpvi/adaptivity/adaptive_solver.h>
#include <hpvi/reader/scene_reader.h>

#include <malloc.h>

#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <unistd.h>

namespace
{
using namespace hpvi;

/** So many scenes, each solved once in every round. */
constexpr unsigned int n_scenes = 250, n_rounds = 4;

/**
 * What a process may use more after the last round than after the first, in bytes. The heap in use
 * depends on nothing but on what is kept: a leak of 100 bytes a scene passes this. The resident set
 * has holes as well, whose number settles slowly.
 */
constexpr double heap_noise = 1 << 16, resident_noise = 16. * (1 << 20);

/** FNV-1a of bytes. */
class Digest
{
public:
  template <class Value>
  void add(const Value *const begin, const Value *const end)
  {
    for (auto byte = reinterpret_cast<const unsigned char *>(begin);
         byte != reinterpret_cast<const unsigned char *>(end); ++byte)
      state = (state ^ *byte) * 1099511628211U;
  }

  std::string text() const
  {
    std::ostringstream out;
    out << std::hex << std::setw(16) << std::setfill('0') << state;
    return out.str();
  }

private:
  std::uint64_t state = 14695981039346656037U;
};

/** Varied by its number, and small. Some are refused, and some have no equilibrium. */
Scene<2> scene(const unsigned int number)
{
  std::mt19937 random(number);
  const auto chosen = [&random](const std::vector<std::string> &choices)
  { return choices[random() % choices.size()]; };
  const std::string name = chosen({"han-6-12", "han-6-13", "stick-slip", "plane-strain",
                                   "semicoercive", "smooth", "threshold"});
  const bool has_own_bound = name == "stick-slip" || name == "plane-strain" || name == "smooth";
  std::vector<std::pair<std::string, std::string>> overrides = {
      {"Adaptivity/Method",
       chosen({"hup2", "hup3", "hup4", "hap2", "hap3", "hap4", "pu", "hpa1", "hpa2", "hpa3"})},
      {"Adaptivity/Start degree", "0"},
      {"Adaptivity/Maximum steps", std::to_string(1 + random() % 10)},
      {"Adaptivity/Maximum unknowns", "1000"},
      {"Material/Poisson's ratio", "0." + std::to_string(random() % 5)},
      {"Solver/QP solver", chosen({"mprgp", "active set"})},
      {"Solver/Condition number", chosen({"true", "false"})}};
  if (!has_own_bound)
    overrides.emplace_back("Boundary bottom/Friction bound",
                           chosen({"0.01", "0.1", "1", "10"}) + "*(1 + x^2*(sin(x) > 0))");
  return read_scene<2>("prm/" + name + ".prm", overrides);
}

/** Of all numbers that scene @p number gives, and of the words with which it is refused or gives up. */
std::string result(const unsigned int number)
{
  Digest digest;
  unsigned int n_steps = 0;
  std::string end = "ok";
  try
  {
    const Scene<2> own = scene(number);
    AdaptiveSolver<2>(own).run(
        [&](const StepReport<2> &step)
        {
          ++n_steps;
          digest.add(step.solution().u.begin(), step.solution().u.end());
          for (const double value :
               {step.scaled_estimate, step.energies.energy, step.energies.lagrangian,
                step.energies.norm, step.reduced->condition_raw, step.reduced->condition_scaled})
            digest.add(&value, &value + 1);
        });
  }
  catch (const std::exception &error)
  {
    end = error.what();
  }
  return digest.text() + ' ' + std::to_string(n_steps) + ' ' + end;
}

/** A process that solves one scene, while this one does something else. */
class FreshProcess
{
public:
  explicit FreshProcess(const unsigned int number)
      : pipe(popen(
            ("exec /proc/" + std::to_string(getpid()) + "/exe " + std::to_string(number)).c_str(),
            "r"))
  {
  }

  ~FreshProcess()
  {
    pclose(pipe);
  }

  FreshProcess(const FreshProcess &) = delete;
  FreshProcess &operator=(const FreshProcess &) = delete;

  std::string result()
  {
    std::string text;
    for (int c; (c = std::fgetc(pipe)) != EOF && c != '\n';)
      text += static_cast<char>(c);
    return text;
  }

private:
  std::FILE *const pipe;
};

double heap_in_use()
{
  const struct mallinfo2 heap = mallinfo2();
  return double(heap.uordblks) + double(heap.hblkhd);
}

double resident_set()
{
  double pages, resident = 0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  return resident * sysconf(_SC_PAGESIZE);
}

int solve_all()
{
  std::vector<std::string> results;
  unsigned int n_different = 0, n_failures = 0;
  double heap = 0, resident = 0;
  for (unsigned int round = 0; round < n_rounds; ++round)
  {
    for (unsigned int k = 0; k < n_scenes; ++k)
      if (round == 0)
      {
        FreshProcess fresh(k);
        results.push_back(result(k));
        n_failures += results[k].substr(results[k].size() - 3) != " ok";
        const std::string other = fresh.result();
        if (other != results[k])
          std::cout << "scene " << k << ": " << results[k] << "\n  fresh: " << other << '\n';
        n_different += other != results[k];
      }
      else
      {
        // Every other round goes backwards: each scene comes after another one than before.
        const unsigned int number = round % 2 == 1 ? n_scenes - 1 - k : k;
        n_different += result(number) != results[number];
      }
    if (round == 0)
    {
      heap = heap_in_use();
      resident = resident_set();
    }
    std::cout << "round " << round + 1 << ": heap in use " << std::setprecision(6)
              << heap_in_use() / 1e6 << " MB, resident set " << resident_set() / 1e6 << " MB"
              << std::endl;
  }
  const bool grows =
      heap_in_use() - heap > heap_noise || resident_set() - resident > resident_noise;
  std::cout << n_scenes * n_rounds << " scenes solved, " << n_failures << " of " << n_scenes
            << " refused or given up as in a fresh process, " << n_different << " different"
            << (grows ? ", memory grows" : "") << std::endl;
  return n_different > 0 || grows || n_failures > n_scenes / 2 ? 1 : 0;
}
} // namespace

/** Without an argument all scenes are solved; with one the scene of that number. */
int main(int argc, char *argv[])
{
  if (argc == 1)
    return solve_all();
  std::cout << result(std::stoul(argv[1])) << std::endl;
}
