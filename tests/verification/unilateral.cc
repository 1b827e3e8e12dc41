// SPDX-License-Identifier: LGPL-2.1-or-later
// Contact that may open where the answer is known: patch tests, press fits, separation.
#include "opening_contact.h"

#include <hpvi/reader/checks/checks.h>
#include <hpvi/results/solution_field.h>

namespace
{
using namespace verification;

constexpr double young = 2.6, poisson = 0.3, mu = 1., lambda = 1.5; // plane strain

const std::vector<Turned> bodies = {
    {"Box", {{{0, 0}, {2, 0}, {2, 1}, {0, 1}}}, 0.},
    {"TurnedBox", {{{0, 0}, {2, 0}, {2, 1}, {0, 1}}}, numbers::PI / 6},
    {"UprightBox", {{{0, 0}, {2, 0}, {2, 1}, {0, 1}}}, numbers::PI / 2},
    {"Parallelogram", {{{0, 0}, {2, 0}, {2.4, 1}, {0.4, 1}}}, -0.4},
    {"Trapezium", {{{-0.3, 0}, {2.2, 0}, {1.8, 1.3}, {0.1, 0.9}}}, 2.}};

// ---------------------------------------------------------------- patch tests

/** `u = (foot + (tilt + shear) y, -depth - tilt x - strain y)` over the gap `depth + tilt x`. */
struct Patch
{
  std::string name;
  double foot, shear;
  double bound; ///< g; negative: no friction
  double depth = 0.02, tilt = -0.03, strain = 0.01;

  Tensor<1, 2> displacement(const Point<2> &x) const
  {
    return Point<2>(foot + (tilt + shear) * x[1], -depth - tilt * x[0] - strain * x[1]);
  }

  double pressure() const
  {
    return (lambda + 2 * mu) * strain;
  }

  double friction() const
  {
    return mu * shear;
  }

  SymmetricTensor<2, 2> stress() const
  {
    SymmetricTensor<2, 2> sigma;
    sigma[0][0] = -lambda * strain;
    sigma[1][1] = -pressure();
    sigma[0][1] = friction();
    return sigma;
  }
};

const std::vector<Patch> patches = {{"NoFriction", 0.04, 0., -1.},
                                    {"ZeroBound", -0.04, 0., 0.},
                                    {"Sticks", 0., 0.01, 0.03},
                                    {"SlipsForward", 0.04, 0.03, 0.03},
                                    {"SlipsBackward", -0.04, -0.03, 0.03}};

struct PatchScene
{
  Turned body;
  Patch patch;
  NormalContact normal;
  bool sides_are_held;    ///< else loaded
  unsigned int first = 0; ///< which boundary is the contact edge
};

std::ostream &operator<<(std::ostream &out, const PatchScene &s)
{
  return out << s.body.name << s.patch.name << name_of(s.normal)
             << (s.sides_are_held ? "Held" : "Loaded") << s.first;
}

Scene<2> make_scene(const PatchScene &given)
{
  Turned body = given.body; // with the contact edge as edge number first
  for (unsigned int k = 0; k < 4; ++k)
    body.corners[(k + given.first) % 4] = given.body.corners[k];
  const Patch &patch = given.patch;
  Scene<2> scene;
  scene.geometry = body.geometry(2, 2);
  scene.materials = {{young, poisson, PlaneModel::strain}};
  scene.solver.normal_contact = given.normal;
  const auto boundary = [&](const unsigned int k) -> BoundaryCondition<2> &
  { return scene.boundary(sides[(k + given.first) % 4]); };
  boundary(0).contact = Contact::unilateral;
  boundary(0).gap = body.scalar([=](const Point<2> &x) { return patch.depth + patch.tilt * x[0]; });
  if (patch.bound >= 0)
    boundary(0).friction.bound = expression<2>(patch.bound);
  for (const unsigned int k : {1U, 2U, 3U})
    if (k == 2 || given.sides_are_held)
      boundary(k).displacement =
          body.field([=](const Point<2> &x) { return patch.displacement(x); });
    else
      boundary(k).traction =
          body.traction((k + given.first) % 4, [=](const Point<2> &) { return patch.stress(); });
  return scene;
}

using UnilateralPatch = ::testing::TestWithParam<PatchScene>;

TEST_P(UnilateralPatch, IsExact)
{
  const PatchScene &given = GetParam();
  const Patch &patch = given.patch;
  const Scene<2> scene = make_scene(given);
  check(scene);
  const RandomMesh mesh(scene, 1 + given.first, 2, 2, 7);
  const Laboratory discrete(scene, mesh);
  const Solution<2> solution = discrete.solve();
  EXPECT_EQ(discrete.algebraic.corrections, 0u);
  EXPECT_LE(nodal_error(solution, [&](const Point<2> &x)
                        { return given.body.turned(patch.displacement(given.body.own(x))); }),
            1e-11);
  const double p = patch.pressure();
  unsigned int n_pressures = 0;
  for (unsigned int i = 0; i < solution.z.size(); ++i)
  {
    const ContactMultiplier<2> &unknown = discrete.contact_space.multipliers()[i];
    const bool is_pressure = unknown.kind == ContactMultiplier<2>::Kind::pressure;
    EXPECT_NEAR(solution.z[i], is_pressure ? p : patch.friction(), 1e-9 * p);
    n_pressures += is_pressure;
  }
  EXPECT_GT(n_pressures, 3u);
  const ContactState<2> state = contact_states(SolutionField(solution)).at(0);
  for (const ContactPoint<2> &point : state.points)
  {
    EXPECT_FALSE(point.is_open);
    EXPECT_NEAR(point.gap, 0., 1e-13);
    EXPECT_NEAR(point.normal_traction, -p, 1e-9 * p);
  }
  EXPECT_NEAR(state.normal_resultant, -p * state.area, 1e-10 * p);
  EXPECT_NEAR(state.highest_pressure, p, 1e-9 * p);
  EXPECT_EQ(state.highest_tension, 0.);
  EXPECT_LE(state.deepest_penetration, 1e-13);
  expect_equilibrium(solution, discrete.system.loads());
  expect_complementary(solution);
}

std::vector<PatchScene> all_patches()
{
  std::vector<PatchScene> result;
  for (const Turned &body : bodies)
    for (const Patch &patch : patches)
      for (const NormalContact normal : both_discretisations)
        for (const bool held : {true, false})
          result.push_back(
              {body, patch, normal, held, static_cast<unsigned int>(result.size() % 3)});
  return result;
}

std::string test_name(const ::testing::TestParamInfo<PatchScene> &info)
{
  std::ostringstream out;
  out << info.param;
  return out.str();
}

INSTANTIATE_TEST_SUITE_P(, UnilateralPatch, ::testing::ValuesIn(all_patches()), test_name);

/** Without friction nodes ask for no degree above 1, whatever its neighbours have. */
TEST(UnilateralPatchOfDegreeOne, IsExactAtNodes)
{
  for (const Turned &body : bodies)
    for (const bool held : {true, false})
    {
      const Patch &patch = patches.front();
      const Scene<2> scene = make_scene({body, patch, NormalContact::nodes, held});
      const RandomMesh mesh(scene, 3, 2, 1, 3);
      const Laboratory discrete(scene, mesh);
      const Solution<2> solution = discrete.solve();
      EXPECT_LE(nodal_error(solution, [&](const Point<2> &x)
                            { return body.turned(patch.displacement(body.own(x))); }),
                1e-12);
      for (const double z : solution.z)
        EXPECT_NEAR(z, patch.pressure(), 1e-10 * patch.pressure());
    }
}

// ---------------------------------------------------------------- corners

/** Where a support decides u_n the support carries what presses: no unknown for what no one can move. */
TEST(UnilateralCorner, HasAPressureOnlyWhereItMayMove)
{
  const Turned &body = bodies[1];
  for (const bool held : {true, false})
  {
    const Scene<2> scene = make_scene({body, patches.front(), NormalContact::nodes, held});
    const RandomMesh mesh(scene, 4, 1);
    const Laboratory discrete(scene, mesh);
    for (const unsigned int k : {0u, 1u})
    {
      const Point<2> corner(body.turned(body.corners[k]));
      unsigned int n_there = 0;
      for (const ContactMultiplier<2> &unknown : discrete.contact_space.multipliers())
        n_there += unknown.x.distance(corner) < 1e-12;
      EXPECT_EQ(n_there, held ? 0u : 1u);
    }
  }
}

/** A beam held at both ends above the plane is loaded until its middle touches; its ends stay open. */
TEST(UnilateralCorner, StaysOpenWhereItIsHeldAboveThePlane)
{
  for (const Turned &body : {bodies[0], bodies[1]})
    for (const NormalContact normal : both_discretisations)
    {
      Scene<2> scene;
      scene.geometry = body.geometry(8, 2);
      scene.solver.normal_contact = normal;
      scene.body_force = body.field([](const Point<2> &) { return Point<2>(0, -3); });
      for (const std::string side : {"left", "right"})
        scene.boundary(side).displacement = {{expression<2>(0.), expression<2>(0.)}};
      scene.boundary("bottom").contact = Contact::unilateral;
      scene.boundary("bottom").gap = expression<2>(0.2);
      const RandomMesh mesh(scene, 5, 1);
      const Laboratory discrete(scene, mesh);
      const Solution<2> solution = discrete.solve();
      expect_complementary(solution);
      expect_equilibrium(solution, discrete.system.loads());
      const ContactState<2> state = contact_states(SolutionField(solution)).at(0);
      ASSERT_EQ(state.zones.size(), 3u);
      EXPECT_EQ(state.zones[0].mode, ContactMode::open);
      EXPECT_NE(state.zones[1].mode, ContactMode::open);
      EXPECT_EQ(state.zones[2].mode, ContactMode::open);
      EXPECT_EQ(state.points.front().normal_traction, 0.);
      EXPECT_GT(state.points.front().gap, 0.02);
    }
}

// ---------------------------------------------------------------- press fit

/** Walls around a body that is larger than the room between them, one to four of them. */
class PressFit : public ::testing::TestWithParam<std::tuple<Turned, NormalContact, PlaneModel>>
{
protected:
  const Turned body = std::get<0>(GetParam());
  const Material material{young, poisson, std::get<2>(GetParam())};

  Scene<2> scene() const
  {
    Scene<2> result;
    result.geometry = body.geometry(3, 2);
    result.materials = {material};
    result.solver.normal_contact = std::get<1>(GetParam());
    return result;
  }

  /** Uniform strains with the origin of the own axes at rest, and the pressures of the walls. */
  void expect_uniform(const Scene<2> &scene, const std::array<double, 2> &strain,
                      const Tensor<1, 2> &origin, const std::vector<double> &pressures) const
  {
    check(scene);
    const RandomMesh mesh(scene, 6, 2);
    const Laboratory discrete(scene, mesh);
    const Solution<2> solution = discrete.solve();
    EXPECT_LE(nodal_error(solution,
                          [&](const Point<2> &x)
                          {
                            const Point<2> X = body.own(x);
                            return body.turned(origin +
                                               Point<2>(strain[0] * X[0], strain[1] * X[1]));
                          }),
              1e-10); // contact alone holds the body: a soft spring, at a loss of digits
    const auto states = contact_states(SolutionField(solution));
    ASSERT_EQ(states.size(), pressures.size());
    for (unsigned int k = 0; k < states.size(); ++k)
    {
      EXPECT_NEAR(states[k].normal_resultant, -pressures[k] * states[k].area, 1e-10);
      for (const ContactPoint<2> &point : states[k].points)
        EXPECT_NEAR(point.normal_traction, -pressures[k], 1e-9 * pressures[0]);
    }
    expect_complementary(solution);
    expect_equilibrium(solution, discrete.system.loads());
  }
};

TEST_P(PressFit, BetweenTwoWallsHasUniformPressure)
{
  Scene<2> room = scene();
  room.boundary("bottom").contact = Contact::bilateral;
  const double left = 0.03, right = 0.01;
  for (const auto &[side, depth] : {std::pair("left", left), std::pair("right", right)})
  {
    room.boundary(side).contact = Contact::unilateral;
    room.boundary(side).gap = expression<2>(-depth);
  }
  const double strain = -(left + right) / 2, l = material.lambda(2), m = material.mu(),
               across = -l / (l + 2 * m) * strain, p = -(l + 2 * m) * strain - l * across;
  expect_uniform(room, {{strain, across}}, Point<2>(left, 0), {p, p, 0.});
}

TEST_P(PressFit, OnAllSidesHasUniformPressure)
{
  Scene<2> room = scene();
  const std::array<double, 4> depth = {{0.03, 0.01, 0.025, 0.}}; // by boundary id
  for (BoundaryCondition<2> &boundary : room.boundaries)
  {
    boundary.contact = Contact::unilateral;
    boundary.gap = expression<2>(-depth[boundary.id]);
  }
  const std::array<double, 2> strain = {{-(depth[0] + depth[1]) / 2, -(depth[2] + depth[3])}};
  const double l = material.lambda(2), m = material.mu(), sum = l * (strain[0] + strain[1]),
               p_x = -sum - 2 * m * strain[0], p_y = -sum - 2 * m * strain[1];
  expect_uniform(room, strain, Point<2>(depth[0], depth[2]), {p_x, p_x, p_y, p_y});
}

INSTANTIATE_TEST_SUITE_P(, PressFit,
                         ::testing::Combine(::testing::Values(bodies[0], bodies[1]),
                                            ::testing::ValuesIn(both_discretisations),
                                            ::testing::Values(PlaneModel::strain,
                                                              PlaneModel::stress)));

// ---------------------------------------------------------------- separation

/** The top is lifted by @p height at its ends, and loads pull at the body. */
Scene<2> lifted_block(const Turned &body, const NormalContact normal,
                      const std::array<double, 2> &height)
{
  Scene<2> scene;
  scene.geometry = body.geometry(2, 2);
  scene.materials = {{young, poisson, PlaneModel::strain}};
  scene.solver.normal_contact = normal;
  scene.body_force = body.field([](const Point<2> &x) { return Point<2>(0.02, 0.01 * x[0]); });
  scene.boundary("top").displacement =
      body.field([=](const Point<2> &x)
                 { return Point<2>(0, height[0] + (height[1] - height[0]) * x[0] / 2); });
  scene.boundary("bottom").contact = Contact::unilateral;
  return scene;
}

TEST(Separation, UnderTensionLeavesTheFreeBody)
{
  for (const Turned &body : {bodies[0], bodies[1]})
    for (const NormalContact normal : both_discretisations)
    {
      const Scene<2> scene = lifted_block(body, normal, {{0.2, 0.3}});
      const RandomMesh mesh(scene, 7, 2);
      const Laboratory discrete(scene, mesh);
      const Solution<2> solution = discrete.solve();
      for (const double z : solution.z)
        EXPECT_EQ(z, 0.);
      const ContactState<2> state = contact_states(SolutionField(solution)).at(0);
      for (const ContactPoint<2> &point : state.points)
      {
        EXPECT_EQ(point.normal_traction, 0.);
        EXPECT_EQ(point.mode(), ContactMode::open);
        EXPECT_GT(point.gap, 0.1);
      }
      EXPECT_EQ(state.normal_resultant, 0.);
      EXPECT_EQ(state.highest_pressure, 0.);
      EXPECT_EQ(state.highest_tension, 0.);
      EXPECT_EQ(state.deepest_penetration, 0.);
      EXPECT_TRUE(state.transitions.empty());

      Scene<2> free = scene;
      free.boundary("bottom").contact = Contact::none;
      const Laboratory without(free, mesh);
      const Solution<2> expected = without.solve();
      const Energies e = energies(SolutionField(solution), discrete.algebraic.energy_product,
                                  discrete.system.work(solution.u)),
                     f = energies(SolutionField(expected), without.algebraic.energy_product,
                                  without.system.work(expected.u));
      EXPECT_NEAR(e.lagrangian, f.lagrangian, 1e-12 * f.norm * f.norm);
      EXPECT_NEAR(e.energy, f.energy, 1e-12 * f.norm * f.norm);
      EXPECT_NEAR(e.norm, f.norm, 1e-12 * f.norm);
      EXPECT_EQ(e.slack, 0.);
      Vector<double> difference = solution.u;
      difference -= expected.u;
      EXPECT_LE(difference.linfty_norm(), 1e-12 * expected.u.linfty_norm());
    }
}

/** One end is pressed down, the other lifted: no pressure and an open gap there, exactly. */
TEST(Separation, OfOneEndIsExactThere)
{
  for (const Turned &body : {bodies[0], bodies[1]})
    for (const NormalContact normal : both_discretisations)
    {
      const Scene<2> scene = lifted_block(body, normal, {{-0.1, 0.2}});
      const RandomMesh mesh(scene, 7, 2);
      const Laboratory discrete(scene, mesh);
      const Solution<2> solution = discrete.solve();
      expect_complementary(solution);
      expect_equilibrium(solution, discrete.system.loads());
      const ContactState<2> state = contact_states(SolutionField(solution)).at(0);
      ASSERT_EQ(state.zones.size(), 2u);
      EXPECT_NE(state.zones[0].mode, ContactMode::open);
      EXPECT_EQ(state.zones[1].mode, ContactMode::open);
      EXPECT_LT(state.normal_resultant, -0.01);
      unsigned int n_zero = 0;
      const Vector<double> means = ContactOracle(*solution.spaces, normal).means(solution.u);
      for (unsigned int i = 0; i < solution.z.size(); ++i)
        if (solution.z[i] == 0.)
        {
          EXPECT_LT(means[i], 0.);
          ++n_zero;
        }
      EXPECT_GT(n_zero, 0u);
      EXPECT_LT(n_zero, solution.z.size());
    }
}
} // namespace
