// SPDX-License-Identifier: LGPL-2.1-or-later
// A run that is broken off, written, read and continued gives what the whole run gives.
#include "discretisation.h"
#include "mesh_texts.h"

#include <hpvi/base/input_error.h>
#include <hpvi/output/summary.h>
#include <hpvi/output/tables.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <random>

namespace
{
using namespace verification;

/** All digits of what a step leaves, times aside. */
std::string digits_of(const StepReport<2> &step)
{
  std::ostringstream out;
  out << std::hexfloat << step.number << ' ' << step.estimate.total() << ' '
      << step.relative_estimate << ' ' << step.energies.lagrangian << ' ' << step.energies.energy
      << ' ' << step.energies.norm << ' ' << step.energies.slack << ' ' << step.errors.energy << ' '
      << step.reduced->qp.multiplications << ' ' << text(step.stopped_by);
  for (const unsigned int p : step.solution().displacement_space.degrees())
    out << ' ' << p;
  for (const double value : step.solution().u)
    out << ' ' << value;
  for (const double value : step.solution().z)
    out << ' ' << value;
  for (const ContactState<2> &state : step.contact)
    out << ' ' << state.normal_resultant << ' ' << state.friction_resultant;
  for (const std::string &warning : texts(step.warnings))
    out << ' ' << warning;
  return out.str();
}

Overrides steps(const unsigned int n, const Overrides &more = {})
{
  Overrides result = more;
  result.emplace_back("Adaptivity/Maximum steps", std::to_string(n));
  return result;
}

/** What is written of the last step. */
std::string written_state(const Scene<2> &scene)
{
  std::ostringstream out;
  AdaptiveSolver<2> solver(scene);
  solver.run(
      [&](const StepReport<2> &step)
      {
        if (!step.stopped_by.empty())
          solver.state().write(out);
      });
  return out.str();
}

RunState<2> read_state(const std::string &text)
{
  std::istringstream in(text);
  return RunState<2>::read(in, "state.dat");
}

struct Run
{
  std::string name, scene;
  Overrides overrides;
  unsigned int half = 3; ///< steps before it is broken off
};

using BrokenOff = ::testing::TestWithParam<Run>;

TEST_P(BrokenOff, GoesOnToTheLastBit)
{
  const auto scene = [](const unsigned int n)
  { return shipped_scene(GetParam().scene, steps(n, GetParam().overrides)); };
  const Scene<2> whole = scene(6), half = scene(GetParam().half);
  std::vector<std::string> expected;
  std::vector<double> bounds;
  double seconds = 0;
  AdaptiveSolver<2>(whole).run(
      [&](const StepReport<2> &step)
      {
        expected.push_back(digits_of(step));
        bounds.push_back(step.bound ? step.bound->total : 0.);
      });
  ASSERT_EQ(expected.size(), 6U);
  const RunState<2> state = read_state(written_state(half));
  seconds = state.history.back().seconds;
  unsigned int k = GetParam().half;
  AdaptiveSolver<2>(whole, state)
      .run(
          [&](const StepReport<2> &step)
          {
            ASSERT_LT(k, 6U);
            EXPECT_TRUE(digits_of(step) == expected[k]) << "step " << k + 1; // pages of digits
            // Which of some congruent patches is solved for all of them is not kept.
            EXPECT_NEAR(step.bound ? step.bound->total : 0., bounds[k],
                        1e-9 * bounds[k] + 1e-13 * step.energies.norm);
            EXPECT_GT(step.seconds, seconds); // those of the first half count
            ++k;
          });
  EXPECT_EQ(k, 6U);
}

INSTANTIATE_TEST_SUITE_P(
    , BrokenOff,
    ::testing::Values(
        Run{"block", "han-6-12", {}}, Run{"bar", "han-6-13", {}},
        Run{"exact", "stick-slip", {{"Exact solution/Transition", "0.1"}}},
        Run{"strain", "plane-strain", {}}, Run{"free", "semicoercive", {}},
        Run{"mprgp", "han-6-12", {{"Solver/QP solver", "mprgp"}, {"Adaptivity/Method", "hpa3"}}},
        Run{"strides", "hertz", {{"Adaptivity/Method", "hpa4"}}},
        Run{"cold", "han-6-12", {{"Solver/QP warm start", "false"}, {"Adaptivity/Method", "hap2"}}},
        // Which stress the bound is made of depends on the steps before.
        Run{"incompressible",
            "plane-strain",
            {{"Material/Poisson's ratio", "0.4999"},
             {"Adaptivity/Method", "hap4"},
             {"Adaptivity/Start degree", "0"},
             {"Adaptivity/Indicator", "bound"}},
            4},
        // Large enough for several threads, whose number decides about the last bit.
        Run{"highDegrees",
            "plane-strain",
            {{"Adaptivity/Method", "hpa3"}, {"Adaptivity/Start degree", "7"}}},
        // Cells that are congruent up to round-off: which one stands for its class is history.
        Run{"uneven",
            "han-6-12",
            {given::box("0.1, 0.3", "3.4, 2.9", "3, 3"), {"Adaptivity/Method", "hap3"}}},
        Run{"skew",
            "han-6-12",
            {given::quadrilateral("Geometry", "0, 0; 4.1, 0.3; 3.7, 4; -0.5, 3.3"),
             {"Geometry/Lower corner", "0, 0"},
             {"Geometry/Upper corner", "1, 1"},
             given::graded("Geometry", "0, 0", "2")}}),
    [](const auto &info) { return info.param.name; });

/** A scene without friction has no multiplier, and one that is refined by p alone has one mesh. */
TEST(RunState, KeepsWhatThereIs)
{
  const Overrides overrides = {{"Boundary bottom/Friction bound", ""}, {"Adaptivity/Method", "pu"}};
  const std::string text = written_state(shipped_scene("han-6-12", steps(2, overrides)));
  const RunState<2> state = read_state(text);
  EXPECT_EQ(state.values.z.size(), 0U);
  EXPECT_EQ(state.history.size(), 2U);
  EXPECT_EQ(state.refinements.size(), 1U);
  std::ostringstream again;
  state.write(again);
  EXPECT_EQ(again.str(), text);
  unsigned int first = 0;
  AdaptiveSolver<2>(shipped_scene("han-6-12", steps(3, overrides)), state)
      .run([&](const StepReport<2> &step) { first = step.number; });
  EXPECT_EQ(first, 3U);
}

template <class Action>
std::string refusal(const Action &action)
{
  const std::string line = failure_of<InputError>(action);
  EXPECT_FALSE(says(line, "\n"));
  EXPECT_TRUE(line.empty() || says(line, "begin a new one")) << line;
  return line;
}

std::string refusal_to_go_on(const RunState<2> &state, const Overrides &overrides)
{
  return refusal([&] { AdaptiveSolver<2>(shipped_scene("han-6-12", overrides), state); });
}

TEST(RunState, OfAnotherSceneIsRefusedWithWhatDiffers)
{
  const RunState<2> state = read_state(written_state(shipped_scene("han-6-12", steps(2))));
  const auto other = [&](const std::string &entry, const std::string &value) {
    return refusal_to_go_on(state, steps(4, {{entry, value}}));
  };
  const std::string line = other("Material/Poisson's ratio", "0.3");
  EXPECT_EQ(line.find("state.dat: is the run state of another problem: "
                      "Material/Poisson's ratio = 0.4 there, 0.3 here; "),
            0U)
      << line;
  for (const auto &[entry, value] : Overrides{{"Boundary bottom/Friction bound", "4"},
                                              {"Geometry/Subdivisions", "2, 2"},
                                              {"Geometry/Graded towards", "0, 0"},
                                              {"Adaptivity/Method", "hup2"},
                                              {"Adaptivity/Maximum degree", "11"},
                                              {"Adaptivity/hpa2 decay threshold", "2"},
                                              {"Solver/QP tolerance", "1e-8"}})
    EXPECT_NE(other(entry, value).find(entry + " = "), std::string::npos) << entry;
  for (const auto &[entry, value] : Overrides{{"Title", "another"},
                                              {"Units/Length", "m"},
                                              {"Output/VTU", "false"},
                                              {"Adaptivity/Tolerance", "1e-9"},
                                              {"Adaptivity/Maximum seconds", "1e9"}})
    EXPECT_EQ(other(entry, value), "") << entry;
}

/** The mesh by what is in its file: not by its path, nor by what was in it once. */
TEST(RunState, OfAnotherMeshFileIsRefused)
{
  const auto home = std::filesystem::path(::testing::TempDir()) /
                    ("hpvi-" + std::to_string(std::random_device()()));
  std::filesystem::create_directory(home);
  const auto scene = [&](const std::string &name, const std::string &text, const unsigned int n)
  {
    std::ofstream(home / name) << text;
    return scene_of(steps(n, {{"Geometry/Shape", "file"},
                              {"Geometry/File", (home / name).string()},
                              {"Boundary bottom/Displacement", "0; 0"},
                              {"Body force/Expression", "0; -1"},
                              {"Adaptivity/Method", "hup2"}}));
  };
  const RunState<2> state = read_state(written_state(scene("one.msh", curved_cell_22, 1)));
  const auto refusal_of = [&](const std::string &name, const std::string &text)
  { return refusal([&] { AdaptiveSolver<2>(scene(name, text, 2), state); }); };
  EXPECT_EQ(refusal_of("other.msh", curved_cell_22), "");
  const std::string altered = replaced(curved_cell_22, "1 0 0 0\n", "1 0 0.125 0\n");
  for (const std::string name : {"other.msh", "one.msh"})
    EXPECT_NE(refusal_of(name, altered).find("Geometry/File = content "), std::string::npos);
  std::filesystem::remove_all(home);
}

TEST(RunState, AtItsEndIsRefused)
{
  const RunState<2> state = read_state(written_state(shipped_scene("han-6-12", steps(2))));
  EXPECT_NE(refusal_to_go_on(state, steps(2)).find("after step 2: Adaptivity/Maximum steps"),
            std::string::npos);
  EXPECT_NE(refusal_to_go_on(state, steps(4, {{"Adaptivity/Tolerance", "0.9"}}))
                .find("Adaptivity/Tolerance"),
            std::string::npos);
  EXPECT_EQ(refusal_to_go_on(state, steps(3)), "");
}

TEST(RunState, ThatIsNotWholeIsRefused)
{
  const std::string text = written_state(shipped_scene("han-6-12", steps(2)));
  const auto damaged = [](const std::string &content)
  { return refusal([&] { read_state(content); }); };
  for (unsigned int part = 1; part < 4; ++part)
    EXPECT_NE(
        damaged(text.substr(0, part * text.size() / 4)).find("state.dat: the run state is cut"),
        std::string::npos);
  EXPECT_NE(damaged("").find("does not begin with \"hpvi run state, format 10\""),
            std::string::npos);
  std::string altered = text;
  char &digit = altered[altered.find_last_of("12345678")];
  ++digit;
  EXPECT_NE(damaged(altered).find("cut short or altered"), std::string::npos);
  EXPECT_EQ(damaged(text), "");
}

/** With a checksum of its own. */
TEST(RunState, WithoutSenseIsRefused)
{
  for (const std::string content : {"", "entries 0\nsteps 1\n1 1 x 0\n", "entries 0\nsteps -1\n",
                                    "entries 0\nsteps 0\nrefinements 0\nkept 0\nloads 1\n"})
  {
    std::ostringstream out;
    RunState<2>::format().write(out, content);
    EXPECT_NE(refusal([&] { read_state(out.str()); }).find("state.dat: not a run state"),
              std::string::npos)
        << content;
  }
  RunState<2> state = read_state(written_state(shipped_scene("han-6-12", steps(2))));
  const RunState<2> whole = state;
  state.values.u.reinit(3);
  EXPECT_NE(refusal_to_go_on(state, steps(3)).find("number of steps or unknowns"),
            std::string::npos);
  state = whole;
  state.history.clear();
  EXPECT_NE(refusal_to_go_on(state, steps(3)).find("number of steps or unknowns"),
            std::string::npos);
  state = whole;
  state.refinements[0].n_cells = 3;
  EXPECT_NE(refusal_to_go_on(state, steps(3)).find("another coarse mesh"), std::string::npos);
}

/** Both sides of a pair, a probe and a support: all that a step may guarantee. */
Scene<2> scene_with_claims(const unsigned int n)
{
  return scene_of({{"Body low/Upper corner", "1, 1"},
                   {"Body up/Lower corner", "0, 1"},
                   {"Body up/Upper corner", "1, 2"},
                   {"Boundary low.bottom/Displacement", "0; 0"},
                   {"Boundary up.top/Traction", "0.001; -0.01"},
                   {"Boundary up.right/Displacement", "0; free"},
                   given::joint("joint", "up.bottom, low.top", "bilateral"),
                   {"Contact joint/Friction bound", "0.002"},
                   {"Probe tip/On", "low.bottom"},
                   {"Adaptivity/Tolerance", "0"},
                   {"Adaptivity/Maximum steps", std::to_string(n)}});
}

/** Numbers of steps before that contradict those of steps to come take all guarantees from these. */
TEST(RunState, KeepsWhatIsGuaranteed)
{
  const RunState<2> whole = read_state(written_state(scene_with_claims(2)));
  ASSERT_EQ(whole.history.size(), 2U);
  const Claims &claims = whole.history[0].claims;
  std::map<std::string, unsigned int> n_claims;
  for (const Claim &claim : claims)
    ++n_claims[claim.what];
  EXPECT_EQ(n_claims["the least energy"], 1U);
  EXPECT_EQ(n_claims["friction between up.bottom and low.top"], 2U);
  EXPECT_EQ(n_claims["force y between up.bottom and low.top"], 2U);
  EXPECT_EQ(n_claims["force y on low.bottom"], 1U);
  EXPECT_EQ(n_claims["mean uy of the probe tip"], 1U);
  const auto go_on = [](const RunState<2> &state, Summary &summary)
  {
    const Scene<2> scene = scene_with_claims(4);
    unsigned int n_intervals = 0;
    std::vector<std::string> contradictions;
    AdaptiveSolver<2>(scene, state)
        .run(
            [&](const StepReport<2> &step)
            {
              Tables<2> tables;
              tables.add(step);
              summary.add(step, tables.convergence.last);
              contradictions.push_back(step.contradiction);
              EXPECT_EQ(bool(step.bound), step.contradiction.empty());
              EXPECT_EQ(step.bound ? "" : no_guarantee(step.contradiction), step.no_bound);
              for (const Resultant<2> &row : step.forces)
                for (const Measured *const number :
                     {&row.force[0], &row.force[1], &row.moment[0], &row.normal, &row.friction})
                  n_intervals += bool(number->interval);
              for (const ProbeValue<2> &probe : step.probes)
                n_intervals += bool(probe.displacement[1].interval);
            });
    EXPECT_EQ(contradictions.size(), 2U);
    EXPECT_EQ(n_intervals == 0, !contradictions[0].empty());
    return std::pair(contradictions, summary.json(scene, {}));
  };
  Summary clean;
  const auto [nothing, json] = go_on(whole, clean);
  EXPECT_EQ(nothing, std::vector<std::string>(2));
  EXPECT_NE(json.find("\"guaranteed\": true"), std::string::npos);
  for (unsigned int k = 0; k < claims.size(); ++k)
  {
    RunState<2> state = whole;
    Claim &claim = state.history[0].claims[k];
    const double width = claim.high - claim.low;
    claim.low += 3 * width + 1e-4;
    claim.high += 3 * width + 1e-4;
    std::ostringstream out;
    state.write(out);
    Summary summary;
    const auto [contradictions, told] = go_on(read_state(out.str()), summary);
    EXPECT_EQ(contradictions[0].rfind(claim.what + " is in [", 0), 0U) << contradictions[0];
    EXPECT_NE(contradictions[0].find("in step 1"), std::string::npos) << contradictions[0];
    EXPECT_EQ(contradictions[1], contradictions[0]); // the first one is kept
    EXPECT_EQ(told.find("\"guaranteed\": true"), std::string::npos);
    EXPECT_NE(told.find("please send scene.prm"), std::string::npos);
    EXPECT_NE(told.find("\"contradiction\": "), std::string::npos);
  }
}
} // namespace
