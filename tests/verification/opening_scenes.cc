// SPDX-License-Identifier: LGPL-2.1-or-later
// Whole runs of scenes whose contact opens or holds by friction alone: closed forms, overkill runs,
// complementarity at every point and the balance of forces.
#include "opening_contact.h"

namespace
{
using namespace verification;

/** What closed forms say about each step of a run. */
struct Course
{
  std::vector<double> unknowns, error, transition;
  double elastic_energy, normal_resultant, highest_pressure, highest_tension, friction_resultant;
  std::vector<Point<2>> transitions;
  Point<2> highest_pressure_point;
};

Course course_of(const Scene<2> &scene)
{
  Course course;
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        const ContactState<2> &state = step.contact.at(0);
        course.unknowns.push_back(step.solution().displacement_space.n_free_dofs());
        course.error.push_back(step.errors.energy);
        course.transition.push_back(step.errors.transition);
        course.elastic_energy = step.energies.norm * step.energies.norm / 2;
        course.normal_resultant = state.normal_resultant;
        course.friction_resultant = state.friction_resultant;
        course.highest_pressure = state.highest_pressure;
        course.highest_pressure_point = state.highest_pressure_point;
        course.highest_tension = state.highest_tension;
        course.transitions = state.transitions;
      });
  return course;
}

/** `error = C exp(-rate N^{1/3})`: it falls in every step, and along a line. */
void expect_exponential_fall(const Course &course, const double rate)
{
  double x = 0, y = 0, xx = 0, xy = 0, yy = 0;
  const double n = course.error.size();
  for (unsigned int k = 0; k < course.error.size(); ++k)
  {
    if (k > 0)
    {
      EXPECT_LT(course.error[k], course.error[k - 1]) << "step " << k + 1;
    }
    const double s = std::cbrt(course.unknowns[k]), t = std::log(course.error[k]);
    x += s / n;
    y += t / n;
    xx += s * s / n;
    xy += s * t / n;
    yy += t * t / n;
  }
  EXPECT_LT((xy - x * y) / (xx - x * x), -rate);
  // An algebraic fall bends here: correlation far from -1.
  EXPECT_LT((xy - x * y) / std::sqrt((xx - x * x) * (yy - y * y)), -0.985);
}

class WithBothDiscretisations : public ::testing::TestWithParam<NormalContact>
{
protected:
  Scene<2> scene(const std::string &name, const unsigned int steps) const
  {
    return shipped_scene(name, {{"Solver/Normal contact", name_of(GetParam())},
                                {"Adaptivity/Maximum steps", std::to_string(steps)}});
  }
};

/** J and P of an independent program and of the closed form. */
TEST_P(WithBothDiscretisations, HertzFallsExponentiallyToItsClosedForm)
{
  const Course course = course_of(scene("hertz", 15));
  ASSERT_EQ(course.error.size(), 15u);
  expect_exponential_fall(course, 0.4);
  EXPECT_NEAR(course.elastic_energy, 0.133954906582, 1e-9 * 0.133954906582);
  EXPECT_NEAR(course.normal_resultant, -7.6969020013, 1e-8 * 7.6969020013);
  ASSERT_EQ(course.transitions.size(), 2u);
  EXPECT_NEAR(course.transitions[0][0], -0.7, 1e-4);
  EXPECT_NEAR(course.transitions[1][0], 0.7, 1e-4);
  EXPECT_NEAR(course.highest_pressure, 7., 1e-4 * 7.);
  EXPECT_LE(course.highest_pressure_point.norm(), 0.02);
  EXPECT_LE(course.error.back(), 1e-6);
}

/** The pressures of a last step along the contact. */
class Pressures
{
public:
  explicit Pressures(const Scene<2> &scene)
  {
    AdaptiveSolver<2>(scene).run(
        [&](const StepReport<2> &step)
        {
          solution = std::make_shared<const Solution<2>>(step.solution());
          balance = step.equilibrium;
          resultant = step.contact.at(0).normal_resultant;
        });
  }

  double at(const Point<2> &x) const
  {
    for (const ContactFace<2> &face : solution->contact_space.faces())
    {
      const Tensor<1, 2> edge = face.point(1.) - face.point(0.);
      const double s = (x - face.point(0.)) * edge / edge.norm_square();
      if (s >= 0 && s <= 1)
        return solution->contact_space.pressure(face, solution->z, s);
    }
    return std::numeric_limits<double>::quiet_NaN();
  }

  std::shared_ptr<const Solution<2>> solution;
  Equilibrium<2> balance;
  double resultant;
};

/** Pressure without bound at the edge of the punch, yet right up to 0.9 of it. */
TEST_P(WithBothDiscretisations, PunchHasThePressureOfAnOverkillRun)
{
  const Scene<2> coarse_scene = scene("punch", 22),
                 overkill_scene = shipped_scene("punch", {{"Adaptivity/Maximum steps", "25"}});
  const Pressures coarse(coarse_scene), overkill(overkill_scene);
  for (double x = 0.013; x < 0.9; x += 0.01)
  {
    const double p = overkill.at(Point<2>(x, 0));
    EXPECT_GT(p, 3.);
    EXPECT_NEAR(coarse.at(Point<2>(x, 0)), p, 1e-3 * p) << x;
  }
  EXPECT_GT(overkill.at(Point<2>(0.999, 0)), 10 * overkill.at(Point<2>(0.013, 0)));
  for (const Pressures *run : {&coarse, &overkill})
  {
    EXPECT_LE(run->balance.force_imbalance, 1e-8);
    EXPECT_LE(run->balance.moment_imbalance, 1e-8);
    double top = 0, bottom = 0;
    for (const BoundaryForce<2> &reaction : run->balance.reactions)
      (reaction.boundary == "top" ? top : bottom) +=
          reaction.boundary == "left" ? 0. : reaction.force[1];
    EXPECT_NEAR(top + bottom, 0., 1e-8 * bottom);
    EXPECT_NEAR(run->resultant, -bottom, 1e-8 * bottom);
  }
}

INSTANTIATE_TEST_SUITE_P(, WithBothDiscretisations, ::testing::ValuesIn(both_discretisations),
                         [](const auto &info) { return name_of(info.param); });

/** The resultant is `pi b (a - c^2/a)/2` with the largest bound b. */
TEST(PartialSlip, FallsExponentiallyToItsClosedForm)
{
  const Course course =
      course_of(shipped_scene("partial-slip", {{"Adaptivity/Maximum steps", "14"}}));
  ASSERT_EQ(course.error.size(), 14u);
  expect_exponential_fall(course, 0.35);
  ASSERT_EQ(course.transitions.size(), 2u);
  EXPECT_NEAR(course.transitions[0][0], -0.4, 1e-3);
  EXPECT_NEAR(course.transitions[1][0], 0.4, 1e-3);
  const double resultant = numbers::PI * 2.1 * (0.7 - 0.4 * 0.4 / 0.7) / 2;
  EXPECT_NEAR(std::abs(course.friction_resultant), resultant, 1e-6 * resultant);
  EXPECT_NEAR(course.normal_resultant, 0., 1e-10);
  // sigma_n itself, whose error falls more slowly, and slowest beside the ends of the stick zone.
  EXPECT_LE(std::max(course.highest_tension, course.highest_pressure), 5e-3 * 2.1);
}

// ---------------------------------------------------------------- all scenes

/**
 * Where a support decides u_n no node presses; the polynomial of the others stands for it in the integral
 * of the pressure, by the Gauss-Lobatto rule: its part of the resultant.
 */
double pressure_at_held_corners(const Solution<2> &solution)
{
  double sum = 0;
  if (solution.scene.normal_contact() == NormalContact::nodes)
    for (const ContactFace<2> &face : solution.contact_space.faces())
      if (face.condition->is_unilateral())
        for (const double s : {0., 1.})
          if (std::find(face.normal_points.begin(), face.normal_points.end(), s) ==
              face.normal_points.end())
            sum += QGaussLobatto<1>(face.degree + 1).weight(0) * face.length *
                   solution.contact_space.pressure(face, solution.z, s);
  return sum;
}

using OpeningScene = ::testing::TestWithParam<std::tuple<std::string, NormalContact>>;

/** In the first step, some later ones and the last. */
TEST_P(OpeningScene, IsComplementaryAndBalanced)
{
  const Scene<2> scene = shipped_scene(std::get<0>(GetParam()),
                                       {{"Solver/Normal contact", name_of(std::get<1>(GetParam()))},
                                        {"Adaptivity/Maximum steps", "9"}});
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        SCOPED_TRACE("step " + std::to_string(step.number));
        if (step.number % 4 != 1)
          return;
        const Solution<2> &solution = step.solution();
        CondensedElements<2> elements(scene, solution.tables);
        const Discretisation<2> discretisation(scene, solution.spaces, elements);
        expect_complementary(solution);
        expect_equilibrium(solution, discretisation.system.loads());
        const Equilibrium<2> balance =
            equilibrium(solution.scene, nodal_forces(solution, discretisation.system));
        EXPECT_LE(balance.force_imbalance, 1e-8);
        EXPECT_LE(balance.moment_imbalance, 1e-8);
        double normal = 0, friction = 0;
        for (unsigned int i = 0; i < solution.z.size(); ++i)
        {
          const ContactMultiplier<2> &unknown = solution.contact_space.multipliers()[i];
          (unknown.kind == ContactMultiplier<2>::Kind::pressure ? normal : friction) -=
              unknown.weight * solution.z[i];
        }
        normal -= pressure_at_held_corners(solution);
        if (!scene.has_friction()) // the pressure does no work in the gap
        {
          EXPECT_NEAR(step.energies.slack, 0., 1e-10 * step.energies.norm * step.energies.norm);
        }
        const ContactState<2> &state = step.contact.at(0);
        EXPECT_NEAR(state.friction_resultant, friction, 1e-10 * (1 + std::abs(friction)));
        if (scene.has_unilateral_contact())
        {
          EXPECT_NEAR(state.normal_resultant, normal, 1e-9 * (1 + std::abs(normal)));
          EXPECT_LE(state.highest_tension, state.highest_pressure); // between points alone
        }
      });
}

INSTANTIATE_TEST_SUITE_P(, OpeningScene,
                         ::testing::Combine(::testing::Values("hertz", "punch", "receding",
                                                              "resting", "han-6-12-unilateral",
                                                              "partial-slip"),
                                            ::testing::ValuesIn(both_discretisations)),
                         [](const auto &info)
                         {
                           std::string name =
                               std::get<0>(info.param) + name_of(std::get<1>(info.param));
                           name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
                           return name;
                         });
} // namespace
