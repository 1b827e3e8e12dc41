// SPDX-License-Identifier: LGPL-2.1-or-later
// Histories of loads on the primal path: those of the plane, and slabs that are as they are.
#include "runs.h"

#include <hpvi/driver/load_history.h>

namespace
{
using namespace space;

/** What a load step leaves. */
struct State
{
  double lagrangian, norm;
  LoadStep load;
  std::size_t n_free;
};

template <int dim>
std::vector<State> evolution(
    const Scene<dim> &scene, MPI_Comm communicator = MPI_COMM_SELF,
    const Look<dim> &look = [](const StepReport<dim> &) {})
{
  std::vector<State> states;
  LoadHistory<dim>(scene, communicator)
      .run(
          [&](const StepReport<dim> &step)
          {
            look(step);
            if (!step.stopped_by.empty())
              states.push_back(
                  {step.energies.lagrangian, step.energies.norm, step.load, step.size.n_free});
          });
  return states;
}

void expect_equal(const std::vector<State> &one, const std::vector<State> &other,
                  const double thickness = 1)
{
  ASSERT_EQ(one.size(), other.size());
  const double size = other.back().load.stored + other.back().load.dissipated;
  for (unsigned int k = 0; k < one.size(); ++k)
  {
    const auto expect_near = [&](const double a, const double b)
    { EXPECT_NEAR(a / thickness, b, 1e-8 * size) << "load step " << k + 1; };
    expect_near(one[k].lagrangian, other[k].lagrangian);
    expect_near(one[k].load.work, other[k].load.work);
    expect_near(one[k].load.stored, other[k].load.stored);
    expect_near(one[k].load.dissipated, other[k].load.dissipated);
    expect_near(one[k].load.released, other[k].load.released);
    expect_near(one[k].load.unbalanced, other[k].load.unbalanced);
  }
}

/** external = stored + dissipated + released + unbalanced */
void expect_balance(const std::vector<State> &states)
{
  for (const State &state : states)
    EXPECT_NEAR(state.load.work,
                state.load.stored + state.load.dissipated + state.load.released +
                    state.load.unbalanced,
                1e-8 * (state.load.stored + state.load.dissipated));
}

/** A block that its top presses down and moves to and fro, once: stick in the middle, slip at the ends. */
Overrides fretting(const unsigned int dim, const std::string &law, const Overrides &more = {})
{
  const std::string motion = "0.02*sin(2*pi*t)", press = "-0.02";
  Overrides result{{"Units/Length", ""},
                   {"Units/Stress", ""},
                   given::elastic("10", "0.3"),
                   {"Boundary left/Traction", ""},
                   {"Boundary right/Displacement", ""},
                   given::rough("bottom", "unilateral", law == "tresca" ? "0.03" : ""),
                   {"Boundary bottom/Friction coefficient", law == "tresca" ? "" : "0.4"},
                   {"Solver/Normal contact", "multiplier"},
                   {"Solver/Primal tolerance", "1e-11"},
                   given::steps("hap2", "2"),
                   {"Loading/Steps", "6"},
                   {"Boundary top/Displacement",
                    dim == 2 ? motion + "; " + press : motion + "; " + press + "; 0"}};
  if (dim == 2)
  {
    result.emplace_back("Geometry/Upper corner", "4, 2");
    result.emplace_back("Geometry/Subdivisions", "4, 2");
    result.emplace_back("Material/Plane", "strain");
  }
  result.insert(result.end(), more.begin(), more.end());
  return result;
}

Scene<2> in_plane(const std::string &law, const Overrides &more = {})
{
  return read_scene<2>("prm/han-6-12.prm", fretting(2, law, more));
}

Scene<3> in_space(const std::string &law, const Overrides &more = {})
{
  return read_scene<3>("prm/slab.prm", fretting(3, law, more));
}

Scene<3> layer(const std::string &law, const Overrides &more = {})
{
  Overrides all{given::box("4, 2, 0.5", "4, 2, 1"),
                {"Boundary front/Displacement", "free; free; 0"},
                {"Boundary back/Displacement", "free; free; 0"}};
  all.insert(all.end(), more.begin(), more.end());
  return in_space(law, all);
}

TEST(History, BothPathsAgreeInThePlane)
{
  for (const char *const law : {"tresca", "coulomb"})
  {
    const auto reduced = evolution<2>(in_plane(law, {{"Solver/Path", "reduced"}})),
               primal = evolution<2>(in_plane(law, {{"Solver/Path", "primal"}}));
    expect_equal(primal, reduced);
    expect_balance(reduced);
    expect_balance(primal);
    for (unsigned int k = 0; k < primal.size(); ++k)
      EXPECT_EQ(primal[k].n_free, reduced[k].n_free);
    EXPECT_GT(reduced.back().load.dissipated, 1e-3 * reduced.back().load.stored);
  }
}

/** Each load step refines once: past slip goes to its new mesh. */
TEST(History, BothPathsAgreeOnMeshesThatAreRefined)
{
  for (const char *const law : {"tresca", "coulomb"})
  {
    const auto run = [&](const char *const path)
    {
      return evolution<2>(in_plane(law, {{"Adaptivity/Method", "hup2"},
                                         {"Adaptivity/Tolerance", "1e-6"},
                                         {"Adaptivity/Tolerance on", "residual"},
                                         {"Loading/Steps", "4"},
                                         {"Loading/Adapt", "every step"},
                                         {"Solver/Path", path}}));
    };
    auto reduced = run("reduced"), primal = run("primal");
    expect_balance(primal);
    for (auto *const states : {&reduced, &primal}) // reactions of the past act on either mesh
      for (State &state : *states)
      {
        state.load.work -= state.load.unbalanced;
        state.load.unbalanced = 0;
      }
    expect_equal(primal, reduced);
    EXPECT_GT(primal.back().n_free, 16 * primal.front().n_free);
  }
}

/** A cycle of a slab of one layer with u_z = 0 on both sides. */
TEST(History, SlabIsPlaneStrain)
{
  for (const char *const law : {"tresca", "coulomb"})
  {
    const Overrides uniform{given::steps("hup2", "1")};
    expect_equal(evolution<3>(layer(law, uniform)), evolution<2>(in_plane(law, uniform)), 0.5);
  }
}

/** Meshes refined from load step to load step carry the past slip and what has no balance on them. */
TEST(History, EnergyIsBalancedOnRefinedMeshes)
{
  for (const char *const law : {"tresca", "coulomb"})
  {
    const auto states = evolution<3>(layer(law, {{"Loading/Adapt", "every step"},
                                                 {"Loading/Steps", "2"},
                                                 {"Geometry/Subdivisions", "4, 1, 1"},
                                                 {"Adaptivity/Tolerance", "1e-6"},
                                                 {"Adaptivity/Tolerance on", "residual"},
                                                 {"Boundary bottom/Gap", "0.01*x*t"}}));
    expect_balance(states);
    EXPECT_GT(states.back().n_free, states.front().n_free);
    EXPECT_NE(states.back().load.unbalanced, 0);
  }
}

/** Under a bound that stays, what moves back and forth between two ends goes round the same loop. */
TEST(History, LoopsClose)
{
  const Scene<3> scene =
      layer("tresca", {given::steps("hup2", "1"),
                       {"Loading/Steps", "18"},
                       {"Boundary top/Displacement", "0.03*cos(6*pi*t); free; free"},
                       {"Boundary bottom/Contact", "bilateral"}});
  const auto states = evolution<3>(scene);
  const LoadStep &first = states[11].load, &second = states[17].load;
  EXPECT_NEAR(first.stored, second.stored, 1e-8 * second.stored);
  const double cycle = second.work - first.work;
  EXPECT_GT(cycle, 1e-3 * second.stored);
  EXPECT_NEAR(cycle, second.dissipated - first.dissipated + second.released - first.released,
              1e-8 * second.work);
}

/** What sticks does not move while the rest slips back. */
TEST(History, SlipIsCountedFromTheLoadStepBefore)
{
  evolution<3>(in_space("coulomb", {given::box("4, 2, 2", "4, 1, 2"),
                                    given::steps("hup2", "1"),
                                    {"Loading/Steps", "3"}}),
               MPI_COMM_SELF,
               [](const StepReport<3> &step)
               {
                 const PrimalSpace<3> &space = step.primal->space;
                 const DistributedVector v = space.in_contact_dofs(step.primal->u);
                 unsigned int n_moved = 0, n_sticking = 0;
                 for (unsigned int k = 0; k < space.contact.size(); ++k)
                 {
                   const ContactDof<3> &contact_dof = space.contact[k];
                   if (!contact_dof.is_friction())
                     continue;
                   const double slip = (space.contact_value(v, k) - contact_dof.gap).norm();
                   n_sticking += slip < 1e-14;
                   n_moved += contact_dof.gap.norm() > 1e-4;
                 }
                 EXPECT_EQ(n_moved > 0, step.load.number > 1);
                 EXPECT_GT(n_sticking, 0u);
               });
}

/** Loads that come back to zero take the body back with them. */
TEST(History, LoadsMayVanish)
{
  const auto states = evolution<3>(slab({given::coulomb("0.3"),
                                         given::steps("hup2", "1"),
                                         {"Boundary bottom/Contact", "unilateral"},
                                         {"Boundary left/Traction", "0.4*(1 - t)*t; 0; 0"},
                                         {"Loading/Steps", "2"}}));
  ASSERT_EQ(states.size(), 2);
  EXPECT_LT(states[1].norm, 1e-6 * states[0].norm);
}

/** A disc at the edge of its limit has a stiffness that single precision does not hold. */
TEST(History, MultigridKnowsDiscsAtTheEdgeOfSlip)
{
  const Scene<3> scene = read_scene<3>(
      "prm/fretting-dome.prm", {{"Adaptivity/Maximum unknowns", "8000"}, {"Loading/Steps", "4"}});
  const auto states =
      evolution<3>(scene, MPI_COMM_SELF,
                   [](const StepReport<3> &step) { EXPECT_FALSE(step.primal->newton.fell_back); });
  EXPECT_EQ(states.size(), 4);
}
} // namespace
