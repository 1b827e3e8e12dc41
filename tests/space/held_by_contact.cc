// SPDX-License-Identifier: LGPL-2.1-or-later
// Bodies in space that contact alone holds: exact fields, balance, the plane, and what no contact can hold.
#include "runs.h"

#include <hpvi/base/numerical_failure.h>
#include <hpvi/driver/load_history.h>

#include <array>

namespace
{
using namespace space;

/** The block of prm/block-space.prm, 2 x 1 x 2 with the weight 4, solved until Newton's method stands still. */
Scene<3> block(const Overrides &overrides)
{
  Scene<3> scene = read_scene<3>(
      "prm/block-space.prm",
      with({{"Geometry/Subdivisions", "2, 1, 2"}, {"Adaptivity/Maximum steps", "2"}}, overrides));
  scene.solver.primal_tolerance = 1e-11;
  return scene;
}

const Overrides frictionless{{"Boundary bottom/Friction coefficient", ""}};

Overrides tresca(const std::string &bound)
{
  return with(frictionless, {{"Boundary bottom/Friction bound", bound}});
}

Overrides body_force(const std::string &force)
{
  return {{"Body force/Expression", force}};
}

/** The force of the floor, and what all supports and contacts leave. */
struct Outcome
{
  Tensor<1, 3> force;
  double force_imbalance, moment_imbalance;
  std::size_t n_cells;
};

std::vector<Outcome> outcomes(const Scene<3> &scene)
{
  std::vector<Outcome> result;
  steps_of<3>(scene,
              [&](const StepReport<3> &step)
              {
                for (const BoundaryForce<3> &reaction : step.equilibrium.reactions)
                  if (reaction.boundary == "bottom")
                    result.push_back({reaction.force, step.equilibrium.force_imbalance,
                                      step.equilibrium.moment_imbalance, step.size.n_cells});
              });
  return result;
}

std::string failure_of(const Scene<3> &scene)
{
  return ::failure_of<NumericalFailure>([&] { steps_of<3>(scene); });
}

/** Where forces are out of balance by little the residual falls by as little: else two more steps on this mesh, and ten on others. */
TEST(HeldByContact, BalanceTakesNoMoreThanItNeeds)
{
  Scene<3> scene = block(with(body_force("0.3; -1; 0"), {{"Geometry/Subdivisions", "5, 3, 4"},
                                                         {"Adaptivity/Maximum steps", "1"}}));
  scene.solver.primal_tolerance = 0;
  steps_of<3>(scene,
              [](const StepReport<3> &step)
              {
                EXPECT_LE(step.primal->newton.cg_steps, 8u);
                EXPECT_LE(step.equilibrium.force_imbalance, 1e-9);
              });
}

// ---------------------------------------------------------------- what holds

struct Held
{
  std::string name;
  Overrides overrides;
  Tensor<1, 3> force; ///< of the floor
};

const std::vector<Held> held{
    {"weight on a smooth floor", with(frictionless, body_force("0; -1; 0")),
     Tensor<1, 3>({0, 4, 0})},
    {"weight on a rough floor", body_force("0; -1; 0"), Tensor<1, 3>({0, 4, 0})},
    {"a slope", {}, Tensor<1, 3>({-2, 4, 0})},
    {"a slope just below the angle of friction",
     {{"Boundary bottom/Friction coefficient", "0.5002"}},
     Tensor<1, 3>({-2, 4, 0})},
    {"a floor whose normal is along a direction",
     with(body_force("0; -1; 0"), {{"Boundary bottom/Contact direction", "1; -2; 0"}}),
     Tensor<1, 3>({0, 4, 0})},
    {"a slope aslant", body_force("0.3; -1; -0.4"), Tensor<1, 3>({-1.2, 4, 1.6})},
    {"Tresca's friction", with(tresca("0.6"), body_force("0.5; -1; 0.2")),
     Tensor<1, 3>({-2, 4, -0.8})},
    {"limited friction",
     {{"Boundary bottom/Friction bound", "0.55"},
      {"Boundary bottom/Friction law", "limited"},
      {"Boundary bottom/Friction coefficient", "2"}},
     Tensor<1, 3>({-2, 4, 0})},
    {"cohesive friction",
     {{"Boundary bottom/Friction bound", "0.1"},
      {"Boundary bottom/Friction law", "cohesive"},
      {"Boundary bottom/Friction coefficient", "0.45"}},
     Tensor<1, 3>({-2, 4, 0})},
    {"friction alone",
     with(tresca("1"), {{"Boundary bottom/Contact", "tangential"},
                        {"Boundary top/Displacement", "free; 0; free"},
                        {"Body force/Expression", "0.5; 0; 0.2"}}),
     Tensor<1, 3>({-2, 0, -0.8})},
    {"a floor that pulls",
     {{"Boundary bottom/Contact", "bilateral"}, {"Body force/Expression", "0.2; -1; 0.2"}},
     Tensor<1, 3>({-0.8, 4, -0.8})},
    {"a ceiling that pulls",
     {{"Boundary bottom/Contact", "bilateral"}, {"Body force/Expression", "0; 1; 0"}},
     Tensor<1, 3>({0, -4, 0})},
    {"loads that cancel but for round-off",
     with(frictionless, {{"Body force/Expression", "-0.1*exp(y); 0; 0"},
                         {"Boundary left/Traction", "0.2*exp(y); 0; 0"}}),
     Tensor<1, 3>()},
    {"a smooth slope with a support beside it",
     with(frictionless, {{"Boundary left/Displacement", "0; free; free"},
                         {"Boundary front/Displacement", "free; free; 0"}}),
     Tensor<1, 3>({0, 4, 0})},
    {"a resultant between the last Gauss point and the edge",
     with(tresca("4"),
          {{"Body force/Expression", "1.8; -1; 0"}, {"Adaptivity/Maximum steps", "1"}}),
     Tensor<1, 3>({-7.2, 4, 0})}};

TEST(HeldByContact, ForcesAndMomentsBalance)
{
  for (const Held &row : held)
  {
    SCOPED_TRACE(row.name);
    const std::vector<Outcome> steps = outcomes(block(row.overrides));
    EXPECT_EQ(steps.at(0).n_cells > 4, &row == &held.back()); // which is bisected at the edge
    for (const Outcome &outcome : steps)
    {
      EXPECT_LT((outcome.force - row.force).norm(), 1e-8 * 4);
      EXPECT_LT(outcome.force_imbalance, 1e-8);
      EXPECT_LT(outcome.moment_imbalance, 1e-8);
    }
  }
}

/** Where the error of the mesh says how exact is enough forces balance nevertheless, and the springs leave the loads as they were. */
TEST(HeldByContact, ForcesBalanceOnCoarseMeshes)
{
  Scene<3> scene = block({});
  scene.solver.primal_tolerance = 0;
  for (const Outcome &outcome : outcomes(scene))
    EXPECT_LT((outcome.force - Tensor<1, 3>({-2, 4, 0})).norm(), 1e-8 * 4);
}

/** Whatever solves the linear systems. */
TEST(HeldByContact, AllSolversAgree)
{
  for (const Overrides &entries :
       {Overrides(), with(tresca("0.51"), {}),
        Overrides{{"Geometry/Subdivisions", "6, 3, 6"}, {"Adaptivity/Maximum steps", "1"}}})
  {
    std::vector<double> energies;
    for (const LinearMethod linear :
         {LinearMethod::multigrid, LinearMethod::amg, LinearMethod::direct})
    {
      Scene<3> scene = block(entries);
      scene.solver.linear = linear;
      steps_of<3>(scene,
                  [&](const StepReport<3> &step)
                  {
                    EXPECT_FALSE(step.primal->newton.fell_back);
                    EXPECT_EQ(step.primal->newton.linear, linear);
                    if (!step.stopped_by.empty())
                      energies.push_back(step.energies.lagrangian);
                  });
    }
    for (const double energy : energies)
      EXPECT_NEAR(energy, energies[0], 1e-9 * std::abs(energies[0]));
  }
}

/** Near its angle of friction a body takes few steps more. */
TEST(HeldByContact, FewStepsLeadToTheLimit)
{
  for (const char *const coefficient : {"0.6", "0.51"})
    steps_of<3>(block({{"Boundary bottom/Friction coefficient", coefficient}}),
                [&](const StepReport<3> &step) // they are 58 to 62, by the width of vectors
                { EXPECT_LE(step.primal->newton.steps, 70U) << coefficient; });
}

// ---------------------------------------------------------------- closed forms

/** Pressed by p, free to widen: u = (p/E) (nu x, -y, nu z), with supports beside it or anywhere along the floor. */
TEST(HeldByContact, PressingIsExact)
{
  const double strain = 2.5 / 1000;
  const KnownField<3> exact{[=](const Point<3> &x)
                            { return strain * Point<3>(0.3 * x[0], -x[1], 0.3 * x[2]); },
                            [=](const Point<3> &) {
                              return strain * Tensor<2, 3>({{0.3, 0, 0}, {0, -1, 0}, {0, 0, 0.3}});
                            }};
  for (const bool is_supported : {true, false})
    for (const char *const method : {"hap2", "hap3"})
    {
      Overrides entries = with(frictionless, {{"Body force/Expression", ""},
                                              {"Boundary top/Traction", "0; -2.5; 0"},
                                              given::graded("Geometry", "0, 0, 0", "1"),
                                              given::steps(method, "1")});
      if (is_supported)
        entries = with(entries, {{"Boundary left/Displacement", "0; free; free"},
                                 {"Boundary front/Symmetry", "true"}});
      steps_of<3>(block(entries),
                  [&](const StepReport<3> &step)
                  {
                    EXPECT_LT(energy_error(step, exact), 1e-9);
                    EXPECT_LT(step.norms.total, 1e-8);
                    for (const ContactPoint<3> &point : step.contact.at(0).points)
                      EXPECT_NEAR(point.normal_traction, -2.5, 1e-9);
                  });
    }
}

// ---------------------------------------------------------------- the plane

/** prm/resting.prm by degree two, with a law and a way to load it. */
Overrides resting(const Overrides &law)
{
  return with({{"Material/Young's modulus", "100"},
               {"Solver/Normal contact", "multiplier"},
               given::steps("hup2", "2", "2")},
              law);
}

Scene<3> layer(const Overrides &law)
{
  return block(with(with(frictionless, {given::box("2, 2, 0.5", "4, 4, 1"),
                                        {"Body force/Expression", "0; -1; 0"},
                                        {"Boundary front/Displacement", "free; free; 0"},
                                        {"Boundary back/Displacement", "free; free; 0"}}),
                    resting(law)));
}

const std::vector<Overrides> plane_laws{{{"Boundary bottom/Friction bound", "1.5"}},
                                        {given::coulomb("0.6")}};

TEST(HeldByContact, ALayerIsPlaneStrain)
{
  for (const Overrides &law : plane_laws)
  {
    std::vector<double> flat;
    AdaptiveSolver<2>(read_scene<2>("prm/resting.prm", resting(law)))
        .run([&](const StepReport<2> &step) { flat.push_back(step.energies.lagrangian); });
    const auto thick = steps_of<3>(layer(with(law, {{"Boundary left/Traction", "1; 0; 0"}})));
    ASSERT_EQ(thick.size(), flat.size());
    for (unsigned int k = 0; k < flat.size(); ++k)
      EXPECT_NEAR(thick[k].lagrangian / 0.5, flat[k], 1e-8 * std::abs(flat[k]));
  }
}

/** Of each load step J, work, stored and dissipated energy. */
template <int dim>
std::vector<std::array<double, 4>> energies_of(const Scene<dim> &scene)
{
  std::vector<std::array<double, 4>> result;
  LoadHistory<dim>(scene).run(
      [&](const StepReport<dim> &step)
      {
        if (!step.stopped_by.empty())
          result.push_back(
              {{step.energies.lagrangian, step.load.work, step.load.stored, step.load.dissipated}});
      });
  return result;
}

/** The push comes and goes: slip that stays, and what it took. */
TEST(HeldByContact, ALoadHistoryIsThatOfThePlane)
{
  const auto push = [](const std::string &zero) { return "1.1*sin(pi*t/2)^2; 0" + zero; };
  for (const Overrides &law : plane_laws)
  {
    const Overrides entries =
        with(law, {{"Loading/Steps", "4"}, {"Adaptivity/Maximum steps", "1"}});
    const auto flat = energies_of<2>(read_scene<2>(
        "prm/resting.prm", with(resting(entries), {{"Boundary left/Traction", push("")}})));
    const auto thick =
        energies_of<3>(layer(with(entries, {{"Boundary left/Traction", push("; 0")}})));
    ASSERT_EQ(flat.size(), thick.size());
    for (unsigned int k = 0; k < flat.size(); ++k)
      for (unsigned int i = 0; i < 4; ++i)
        EXPECT_NEAR(thick[k][i] / 0.5, flat[k][i], 1e-8 * std::abs(flat[k][0])) << k << " " << i;
  }
}

// ---------------------------------------------------------------- what does not hold

TEST(HeldByContact, WhatSetsInIsNamedWithItsForces)
{
  const std::string slides =
                        "no equilibrium: sliding: the loads push the body along (1, 0, 0) with 2, "
                        "contact can resist with ",
                    topples =
                        "no equilibrium: toppling: the loads turn the body about an axis along ",
                    add = "; add a support, raise ";
  const std::vector<std::pair<Overrides, std::string>> rows{
      {{{"Boundary bottom/Friction coefficient", "0.49999"}},
       slides + "1.99996 at most" + add + "Friction coefficient or lower the loads"},
      {frictionless, slides + "0 at most; add a support or change the loads"},
      {tresca("0.49"), slides + "1.96 at most" + add + "Friction bound or lower the loads"},
      {body_force("0; 1; 0"),
       "no equilibrium: lifting off: the loads push the body along (0, 1, 0) with 4, "
       "contact can resist with 0"},
      {with(body_force("3; -1; 0"), {{"Boundary bottom/Friction coefficient", "5"}}),
       topples + "(0, 0, -1) through (2, 0, "},
      {with(body_force("0; -1; -2.2"), {{"Boundary bottom/Friction coefficient", "5"}}),
       topples + "(-1, 0, 0) through ("},
      {body_force("3*(z - 1); -1; 0"), "no equilibrium: sliding: the loads turn the body about an "
                                       "axis along (0, 1, 0) through (1"},
      // Beyond the last Gauss point of the finest of these meshes, and before the edge.
      {with(body_force("1.999; -1; 0"), {{"Boundary bottom/Friction coefficient", "5"}}),
       "no equilibrium on this mesh, whose pressures act inside of its faces: toppling: "},
      {with(frictionless, {{"Boundary left/Displacement", "0; free; free"},
                           {"Body force/Expression", "0.5; -1; 0.1"}}),
       "no equilibrium: sliding: the loads push the body along (0, 0, 1) with 0.4, contact can "
       "resist with 0"}};
  for (const auto &[overrides, words] : rows)
    EXPECT_EQ(failure_of(block(overrides)).rfind(words, 0), 0U)
        << failure_of(block(overrides)) << "\n  is not\n"
        << words;
}
} // namespace
