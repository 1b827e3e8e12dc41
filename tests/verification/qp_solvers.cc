// SPDX-License-Identifier: LGPL-2.1-or-later
// The solvers of the reduced problem on scenes: same results, whatever solver and start.
#include "discretisation.h"

#include <hpvi/plane/multiplier_trace.h>

namespace
{
using namespace verification;

struct Outcome
{
  std::vector<double> lagrangians, lambda;
  unsigned int steps_that_fell_back = 0;
  double largest_gradient = 0;
  QpReport last;
};

Outcome outcome_of(const std::string &scene, const Overrides &overrides)
{
  Outcome result;
  const Scene<2> shipped = shipped_scene(scene, overrides);
  AdaptiveSolver<2>(shipped).run(
      [&](const StepReport<2> &step)
      {
        result.lagrangians.push_back(step.energies.lagrangian);
        result.lambda.assign(step.solution().z.begin(), step.solution().z.end());
        result.steps_that_fell_back += step.reduced->qp.fell_back;
        result.largest_gradient =
            std::max(result.largest_gradient, step.reduced->qp.projected_gradient);
        result.last = step.reduced->qp;
      });
  return result;
}

using QpSolvers = ::testing::TestWithParam<const char *>;

TEST_P(QpSolvers, Agree)
{
  const auto with = [&](const std::string &solver, const std::string &warm)
  {
    return outcome_of(
        GetParam(),
        {{"Solver/QP solver", solver}, {"Solver/QP warm start", warm}, given::steps("hpa2", "10")});
  };
  const Outcome reference = with("mprgp", "false");
  for (const Outcome &other :
       {with("mprgp", "true"), with("active set", "false"), with("active set", "true")})
  {
    ASSERT_EQ(other.lambda.size(), reference.lambda.size());
    for (unsigned int k = 0; k < reference.lagrangians.size(); ++k)
      EXPECT_NEAR(other.lagrangians[k], reference.lagrangians[k],
                  1e-11 * std::abs(reference.lagrangians[k]));
    for (unsigned int i = 0; i < reference.lambda.size(); ++i)
      EXPECT_NEAR(other.lambda[i], reference.lambda[i], 1e-7); // cond(S) times 1e-12
    EXPECT_LE(other.largest_gradient, 1e-12);
  }
}

INSTANTIATE_TEST_SUITE_P(, QpSolvers,
                         ::testing::Values("han-6-12", "han-6-13", "stick-slip", "semicoercive"));

/** From step to step few states change: Newton's method needs one or two factorisations. */
TEST(ActiveSetOnScenes, WarmStartsNeedFewSolves)
{
  for (const std::string scene : {"han-6-12", "han-6-13", "stick-slip"})
  {
    const Outcome result =
        outcome_of(scene, {{"Solver/QP solver", "active set"}, {"Adaptivity/Maximum steps", "12"}});
    EXPECT_EQ(result.steps_that_fell_back, 0u) << scene;
    EXPECT_LE(result.last.dense_solves, 3u) << scene;
  }
}

/** A polynomial on the old mesh is found again on every finer one. */
TEST(MultiplierTrace, ReproducesPolynomials)
{
  const auto scene = shipped_scene("han-6-12");
  const auto quadratic = [](const Point<2> &x) { return 0.3 - 0.2 * x[0] + 0.05 * x[0] * x[0]; };
  const ShapeTables<2> tables;
  const auto sample = [&](const ContactSpace<2> &space)
  {
    Vector<double> values(space.n_multipliers());
    for (const ContactFace<2> &face : space.faces())
      for (unsigned int i = 0; i < face.n_multipliers; ++i)
        values[face.first_multiplier + i] =
            quadratic(face.point(tables.gauss(face.n_multipliers).point(i)[0]));
    return values;
  };
  std::mt19937 random(1);
  RandomMesh coarse(scene, 1, 1, 4, 7); // degree 2 of the multiplier at least
  const DisplacementSpace<2> coarse_space(scene, coarse.mesh, coarse.degrees, tables);
  const ContactSpace<2> coarse_contact(scene, coarse_space, tables);
  const MultiplierTrace<2> trace(coarse_contact, sample(coarse_contact));

  refine_at_random(coarse.mesh, 3, random);
  const Degrees degrees = random_degrees(coarse.mesh, 2, 9, random);
  const DisplacementSpace<2> fine_space(scene, coarse.mesh, degrees, tables);
  const ContactSpace<2> fine_contact(scene, fine_space, tables);
  const Vector<double> found = trace.values(fine_contact, tables), expected = sample(fine_contact);
  ASSERT_GT(found.size(), 10u);
  for (unsigned int i = 0; i < found.size(); ++i)
    EXPECT_NEAR(found[i], expected[i], 1e-12);
}

TEST(MultiplierTrace, OfNothingIsZero)
{
  const auto scene = shipped_scene("han-6-12");
  const ShapeTables<2> tables;
  const RandomMesh mesh(scene, 1, 1);
  const DisplacementSpace<2> space(scene, mesh.mesh, mesh.degrees, tables);
  EXPECT_TRUE(
      MultiplierTrace<2>().values(ContactSpace<2>(scene, space, tables), tables).all_zero());
}
} // namespace
