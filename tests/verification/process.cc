// SPDX-License-Identifier: LGPL-2.1-or-later
// What the library does to the process of its user: nothing that stays, and runs do not meet.
#include "discretisation.h"

#include <deal.II/base/function_parser.h>
#include <deal.II/base/mu_parser_internal.h>
#include <deal.II/base/multithread_info.h>
#include <hpvi/output/output.h>
#include <hpvi/results/inf_sup.h>

#include <sys/stat.h>

#include <cfenv>
#include <clocale>
#include <csignal>
#include <iostream>
#include <locale>
#include <new>
#include <thread>

// Present where OpenBLAS is the BLAS in use and where CHOLMOD was built with OpenMP.
extern "C"
{
  int openblas_get_num_threads() __attribute__((weak));
  void openblas_set_num_threads(int) __attribute__((weak));
  int omp_get_max_active_levels() __attribute__((weak));
  void omp_set_max_active_levels(int) __attribute__((weak));
  int omp_get_max_threads() __attribute__((weak));
}

namespace
{
using namespace verification;

/** What belongs to the process and not to a scene, one line each. */
std::string process_state()
{
  std::ostringstream state;
  if (openblas_get_num_threads)
    state << "BLAS threads " << openblas_get_num_threads() << '\n';
  if (omp_get_max_active_levels)
    state << "OpenMP levels " << omp_get_max_active_levels() << ", threads "
          << omp_get_max_threads() << '\n';
  state << "deal.II threads " << MultithreadInfo::n_threads() << '\n';
  for (const std::ostream *const stream : {&std::cout, &std::cerr, &std::clog})
    state << "stream buffer " << stream->rdbuf() << ", state " << stream->rdstate() << ", flags "
          << stream->flags() << ", precision " << stream->precision() << ", exceptions "
          << stream->exceptions() << ", locale " << stream->getloc().name() << '\n';
  state << "locale " << std::locale().name() << ' ' << std::setlocale(LC_ALL, nullptr) << '\n';
  state << "terminate " << reinterpret_cast<void *>(std::get_terminate()) << ", new "
        << reinterpret_cast<void *>(std::get_new_handler()) << '\n';
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ, SIGABRT, SIGFPE, SIGSEGV})
  {
    struct sigaction action = {};
    sigaction(signal, nullptr, &action);
    state << "signal " << signal << ' ' << reinterpret_cast<void *>(action.sa_handler) << '\n';
  }
  state << "rounding " << std::fegetround() << ", traps " << fegetexcept() << '\n';
  const mode_t mask = umask(0);
  umask(mask);
  state << "directory " << std::filesystem::current_path() << ", mask " << mask << '\n';
  return state.str();
}

/** Wherever it comes from: no byte of this process may go to standard error. */
class CaughtStderr
{
public:
  CaughtStderr()
  {
    ::testing::internal::CaptureStderr();
  }
  ~CaughtStderr()
  {
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  }
};

/** Every number of every step, bit by bit. */
std::vector<double> numbers(const std::string &name, const Overrides &overrides)
{
  std::vector<double> result;
  const Scene<2> scene = shipped_scene(name, overrides);
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        result.insert(result.end(), step.solution().u.begin(), step.solution().u.end());
        for (const double value : {step.scaled_estimate, step.energies.energy,
                                   step.energies.lagrangian, step.errors.energy})
          if (!std::isnan(value))
            result.push_back(value);
      });
  return result;
}

TEST(Process, IsAsItWasAfterARun)
{
  if (openblas_set_num_threads)
    openblas_set_num_threads(3);
  if (omp_set_max_active_levels)
    omp_set_max_active_levels(5);
  const CaughtStderr caught;
  const std::string before = process_state();
  const Scene<2> scene = shipped_scene("han-6-12", {{"Adaptivity/Maximum steps", "4"}});
  EXPECT_EQ(process_state(), before);
  const auto directory = std::filesystem::path(::testing::TempDir()) /
                         ("hpvi-" + std::to_string(std::random_device()()));
  {
    AdaptiveSolver<2> solver(scene);
    Output<2> output(scene, directory.string());
    solver.run(
        [&](const StepReport<2> &step)
        {
          output.write_step(step);
          if (openblas_get_num_threads)
          {
            EXPECT_EQ(openblas_get_num_threads(), 1);
          }
        });
    output.finish();
  }
  std::filesystem::remove_all(directory);
  EXPECT_EQ(process_state(), before);
  Triangulation<2> mesh;
  make_mesh(scene, mesh);
  measure_inf_sup(scene, mesh, Degrees(mesh.n_active_cells(), 3));
  EXPECT_EQ(process_state(), before);
}

TEST(Process, IsAsItWasAfterFailures)
{
  const CaughtStderr caught;
  const std::string before = process_state();
  EXPECT_THROW(shipped_scene("han-6-12", {{"Body force/Expression", "0; 2*q"}}), InputError);
  const Scene<2> scene = shipped_scene("han-6-12");
  EXPECT_THROW(AdaptiveSolver<2>(scene).run([](const StepReport<2> &)
                                            { throw NumericalFailure("the user has enough"); }),
               NumericalFailure);
  EXPECT_EQ(process_state(), before);
}

/** An expression may call the functions that deal.II's parser knows, apart from random ones. */
TEST(Process, HearsOfUnknownFunctionsByExceptions)
{
  const auto is_known = [](const std::string &expression)
  {
    ::testing::internal::CaptureStderr(); // deal.II prints before it throws
    FunctionParser<2> parser(1);
    bool known = true;
    try
    {
      parser.initialize("x,y", expression, {});
      known = std::isfinite(parser.value(Point<2>()));
    }
    catch (const std::exception &)
    {
      known = false;
    }
    ::testing::internal::GetCapturedStderr();
    return known;
  };
  unsigned int n_known = 0;
  for (const std::string &name : internal::FunctionParser::get_function_names())
    for (const char *const arguments : {"(0.5)", " (0.5)", "(0.5, 1)", "(0.5, 1, 2)"})
      if (name.substr(0, 4) != "rand")
      {
        const std::string expression = name + arguments;
        const Overrides overrides = {{"Body force/Expression", "0; " + expression}};
        const bool known = is_known(expression);
        n_known += known;
        const CaughtStderr caught;
        if (known)
        {
          EXPECT_NO_THROW(shipped_scene("han-6-12", overrides)) << expression;
        }
        else
        {
          EXPECT_THROW(shipped_scene("han-6-12", overrides), InputError) << expression;
        }
      }
  EXPECT_GT(n_known, 50U);
}

TEST(Threads, DoNotMeet)
{
  const std::vector<std::pair<std::string, Overrides>> scenes = {
      {"han-6-12", {{"Adaptivity/Maximum steps", "12"}}},
      {"stick-slip", {{"Adaptivity/Maximum steps", "12"}}},
      {"han-6-13", {given::steps("hup2", "5")}}};
  std::vector<std::vector<double>> alone(scenes.size()), together(scenes.size());
  for (unsigned int k = 0; k < scenes.size(); ++k)
    alone[k] = numbers(scenes[k].first, scenes[k].second);
  for (unsigned int repetition = 0; repetition < 3; ++repetition)
  {
    std::vector<std::thread> threads;
    for (unsigned int k = 0; k < scenes.size(); ++k)
      threads.emplace_back([&, k] { together[k] = numbers(scenes[k].first, scenes[k].second); });
    for (std::thread &thread : threads)
      thread.join();
    EXPECT_EQ(together, alone);
  }
}

/** A step copies the elements up to its highest degree while the bound of another one asks for more. */
TEST(Threads, MakeElementsOfHigherDegreesBesideReaders)
{
  const ShapeTables<2> tables;
  const hp::FECollection<2> &first = tables.elements(2);
  const FiniteElement<2> *const quadratic = &first[1];
  std::thread reader(
      [&]
      {
        for (unsigned int k = 0; k < 2000; ++k)
          EXPECT_EQ(hp::FECollection<2>(tables.elements(2))[1].degree, 2u);
      });
  for (unsigned int degree = 3; degree <= 9; ++degree)
    EXPECT_EQ(tables.elements(degree).size(), degree);
  reader.join();
  EXPECT_EQ(first.size(), 2u);
  EXPECT_EQ(&tables.elements(9)[1], quadratic) << "what is there is shared";
}

/** The parser is silent without touching a stream that other threads write to. */
TEST(Threads, ReadWrongScenesTogether)
{
  const CaughtStderr caught;
  const std::string before = process_state();
  std::vector<std::thread> threads;
  for (unsigned int k = 0; k < 4; ++k)
    threads.emplace_back(
        []
        {
          for (unsigned int repetition = 0; repetition < 50; ++repetition)
            EXPECT_THROW(shipped_scene("han-6-12", {{"Body force/Expression", "0; 2*q"}}),
                         InputError);
        });
  for (std::thread &thread : threads)
    thread.join();
  EXPECT_EQ(process_state(), before);
}
} // namespace
