// SPDX-License-Identifier: LGPL-2.1-or-later
// The bound on cells that are no parallelograms: its processor time and its distance from the true error,
// as a table. ./run distorted.
#include <hpvi/driver/adaptive_solver.h>
#include <hpvi/reader/scene_reader.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace
{
using namespace hpvi;
using Overrides = std::vector<std::pair<std::string, std::string>>;

double processor_time()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/** A row for each step; seconds are the processor's, of the step with its true error and of the bound. */
void run(const std::string &name, const std::string &file, const Overrides &overrides)
{
  Overrides entries = {{"Error/Bound", "false"}, {"Adaptivity/Indicator", "residual"}};
  entries.insert(entries.end(), overrides.begin(), overrides.end());
  const Scene<2> scene = read_scene<2>("prm/" + file + ".prm", entries);
  const auto tables = std::make_shared<const ShapeTables<2>>();
  CondensedElements<2> elements(scene, *tables);
  ErrorBounds bounds;
  double last = processor_time();
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        const double seconds = processor_time() - last;
        const Discretisation<2> discretisation(scene, step.solution().spaces, elements);
        const double start = processor_time();
        const ErrorBound bound = bounds.compute(step.solution(), discretisation);
        const double seconds_bound = processor_time() - start;
        unsigned int p = 0;
        for (const unsigned int degree : step.solution().displacement_space.degrees())
          p = std::max(p, degree);
        std::printf("%s,%u,%u,%u,%.9e,%.9e,%.6f,%.6f\n", name.c_str(), step.number,
                    step.solution().displacement_space.n_free_dofs(), p, bound.total,
                    step.errors.energy, seconds, seconds_bound);
        last = processor_time();
      });
}
} // namespace

int main()
try
{
  std::printf("run,step,dofs_free,degree,bound,error,seconds,seconds_bound\n");
  const Overrides block = {{"Geometry/Shape", "quadrilateral"},
                           {"Geometry/Corners", "0, 0; 4, 0; 3.2, 4.5; 0.6, 3.4"},
                           {"Geometry/Subdivisions", "6, 6"}},
                  field = {{"Geometry/Shape", "quadrilateral"},
                           {"Geometry/Corners", "-1, 0; 1, 0; 0.8, 1.1; -1.1, 0.8"}};
  const auto with = [](Overrides entries, const Overrides &more)
  {
    entries.insert(entries.end(), more.begin(), more.end());
    return entries;
  };
  const Overrides raised = {{"Adaptivity/Method", "pu"},
                            {"Adaptivity/Start degree", "2"},
                            {"Adaptivity/Tolerance", "0"},
                            {"Adaptivity/Maximum unknowns", "1000000"},
                            {"Adaptivity/Maximum steps", "9"}};
  run("raised block", "han-6-12", with(block, raised));
  run("raised field", "stick-slip", with(with(field, {{"Geometry/Subdivisions", "6, 6"}}), raised));
  run("raised bracket", "bracket",
      with({{"Boundary fillet/Curve", ""},
            {"Boundary sole/Friction coefficient", "0"},
            {"Boundary sole/Friction bound", "12"}},
           raised));
  for (const std::string method : {"hup2", "hap4", "hpa3"})
  {
    const Overrides settings = {{"Adaptivity/Method", method},
                                {"Adaptivity/Start degree", "0"},
                                {"Adaptivity/Maximum unknowns", "4000"}};
    run("block " + method, "han-6-12", with(block, settings));
    run("field " + method, "stick-slip", with(field, settings));
    for (const auto &[name, scene, corners] :
         std::vector<std::tuple<std::string, std::string, std::string>>{
             {"Example 5.2", "han-6-12", "0, 0; 4, 0; 4, 4"},
             {"Stick-slip", "stick-slip", "-1, 0; 1, 0; 1, 1"}})
      for (const std::string moved : {"", "000001"})
        run(name + (moved.empty() ? " rectangles " : " rows ") + method, scene,
            with(settings,
                 {{"Geometry/Shape", "quadrilateral"},
                  {"Geometry/Corners", corners + (scene == "han-6-12" ? "; 0, 4" : "; -1, 1") +
                                           "." + (moved.empty() ? "0" : moved)}}));
  }
  return 0;
}
catch (const std::exception &error)
{
  std::fprintf(stderr, "distorted: %s\n", error.what());
  return 1;
}
