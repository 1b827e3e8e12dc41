// SPDX-License-Identifier: LGPL-2.1-or-later
// A thousand scenes in one process, on both paths, one after the other and two at a time, and a load history of 2000
// steps: the memory that it uses does not grow, and each result has the bytes of a fresh process's. ./run long.
#include <deal.II/base/mpi.h>
#include <hpvi/driver/adaptive_solver.h>
#include <hpvi/driver/load_history.h>
#include <hpvi/reader/scene_reader.h>

#include <malloc.h>

#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <thread>
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

/** MPI belongs to one thread, and the primal path to MPI. */
bool takes_primal_path(const unsigned int number)
{
  return number % 5 == 0;
}

/** A box on the primal path, in the plane or in space. */
template <int dim>
Scene<dim> primal_scene(const unsigned int number)
{
  std::mt19937 random(number);
  std::vector<std::pair<std::string, std::string>> overrides = {
      {"Adaptivity/Method", random() % 2 == 0 ? "hup2" : "hap2"},
      {"Adaptivity/Start degree", "0"},
      {"Adaptivity/Maximum steps", std::to_string(1 + random() % 2)},
      {"Adaptivity/Maximum unknowns", "3000"},
      {"Material/Poisson's ratio", "0." + std::to_string(random() % 5)},
      {"Boundary bottom/Friction bound", std::to_string(random() % 5) + "*(1 + x)"}};
  if (dim == 2)
    overrides.emplace_back("Solver/Path", "primal");
  return read_scene<dim>(dim == 2 ? "prm/han-6-12.prm" : "prm/slab.prm", overrides);
}

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
      {"Adaptivity/Method", chosen({"hup2", "hup3", "hup4", "hap2", "hap3", "hap4", "pu", "hpa1",
                                    "hpa2", "hpa3", "hpa4"})},
      {"Adaptivity/Start degree", "0"},
      {"Adaptivity/Maximum steps", std::to_string(1 + random() % 10)},
      {"Adaptivity/Maximum unknowns", "1000"},
      {"Material/Poisson's ratio", "0." + std::to_string(random() % 5)},
      {"Solver/QP solver", chosen({"mprgp", "active set"})},
      {"Solver/Threads", chosen({"1", "2", "3"})},
      {"Solver/Condition number", chosen({"true", "false"})}};
  if (!has_own_bound)
    overrides.emplace_back("Boundary bottom/Friction bound",
                           chosen({"0.01", "0.1", "1", "10"}) + "*(1 + x^2*(sin(x) > 0))");
  return read_scene<2>("prm/" + name + ".prm", overrides);
}

/** Digest and count of steps. */
struct Seen
{
  Digest digest;
  unsigned int n_steps = 0;

  template <int dim>
  void add(const StepReport<dim> &step)
  {
    ++n_steps;
    for (const double value :
         {step.scaled_estimate, step.energies.energy, step.energies.lagrangian, step.energies.norm})
      digest.add(&value, &value + 1);
  }

  void add_reduced(const StepReport<2> &step)
  {
    add(step);
    digest.add(step.solution().u.begin(), step.solution().u.end());
    for (const double value : {step.reduced->condition_raw, step.reduced->condition_scaled})
      digest.add(&value, &value + 1);
  }
};

template <int dim>
void solve_primal(const unsigned int number, Seen &seen)
{
  const Scene<dim> own = primal_scene<dim>(number);
  AdaptiveSolver<dim>(own, MPI_COMM_SELF).run([&](const StepReport<dim> &step) { seen.add(step); });
}

/** Of all numbers that scene @p number gives, and of the words with which it is refused or gives up. */
std::string result(const unsigned int number)
{
  Seen seen;
  std::string end = "ok";
  try
  {
    if (takes_primal_path(number))
      number % 2 == 0 ? solve_primal<2>(number, seen) : solve_primal<3>(number, seen);
    else
    {
      const Scene<2> own = scene(number);
      AdaptiveSolver<2>(own).run([&](const StepReport<2> &step) { seen.add_reduced(step); });
    }
  }
  catch (const std::exception &error)
  {
    end = error.what();
  }
  return seen.digest.text() + ' ' + std::to_string(seen.n_steps) + ' ' + end;
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

/** How many of @p results two threads get otherwise, each with every other scene. */
unsigned int n_different_in_threads(const std::vector<std::string> &results)
{
  unsigned int n_different[2] = {0, 0};
  const auto work = [&](const unsigned int thread)
  {
    for (unsigned int k = thread; k < n_scenes; k += 2)
      if (!takes_primal_path(k))
        n_different[thread] += result(k) != results[k];
  };
  std::thread other(work, 1);
  work(0);
  other.join();
  return n_different[0] + n_different[1];
}

/** A block that is pressed and moved to and fro 2000 times, twice: memory after 200 steps and at the end, and the same bytes. */
bool history_stays()
{
  std::string texts[2];
  bool grows = false;
  for (std::string &text : texts)
  {
    const Scene<2> own = read_scene<2>("prm/fretting.prm",
                                       {{"Loading/Steps", "2000"},
                                        {"Loading/Adapt", "first step"},
                                        {"Geometry/Grading levels", "0"},
                                        {"Geometry/Subdivisions", "4, 1"},
                                        {"Adaptivity/Maximum steps", "1"},
                                        {"Boundary top/Displacement", "0.012*sin(80*pi*t); free"}});
    Seen seen;
    double heap = 0, resident = 0;
    LoadHistory<2>(own).run(
        [&](const StepReport<2> &step)
        {
          seen.add_reduced(step);
          if (seen.n_steps == 200)
          {
            heap = heap_in_use();
            resident = resident_set();
          }
          else if (seen.n_steps == 2000)
          {
            std::cout << "history: heap in use grows by " << heap_in_use() - heap
                      << " bytes, resident set by " << resident_set() - resident << std::endl;
            grows = grows || heap_in_use() - heap > heap_noise ||
                    resident_set() - resident > resident_noise;
          }
        });
    text = seen.digest.text() + ' ' + std::to_string(seen.n_steps);
  }
  std::cout << "history: " << texts[0] << (texts[0] == texts[1] ? " twice" : ", then " + texts[1])
            << std::endl;
  return !grows && texts[0] == texts[1] && texts[0].substr(17) == "2000";
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
    n_different += round == 0 ? n_different_in_threads(results) : 0;
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
  const bool stays = history_stays();
  return n_different > 0 || grows || !stays || n_failures > n_scenes / 2 ? 1 : 0;
}
} // namespace

/** Without an argument all is done; with a number the scene of that number is solved, with `history` the load history. */
int main(int argc, char *argv[])
{
  const std::string word = argc > 1 ? argv[1] : "";
  const bool one = argc > 1 && word != "history";
  std::optional<dealii::Utilities::MPI::MPI_InitFinalize> mpi; // which takes its time
  if (!one || takes_primal_path(std::stoul(word)))
    mpi.emplace(argc, argv, 1);
  if (word == "history")
    return history_stays() ? 0 : 1;
  if (!one)
    return solve_all();
  std::cout << result(std::stoul(word)) << std::endl;
}
