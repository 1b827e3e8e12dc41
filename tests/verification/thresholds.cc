// SPDX-License-Identifier: LGPL-2.1-or-later
// Numbers that decide: tolerances, numbers of points, which indicator counts. Each test sits near enough to one of them
// that another number would decide otherwise.
#include "discretisation.h"

#include <hpvi/base/finite.h>
#include <hpvi/base/input_error.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/driver/limits.h>
#include <hpvi/driver/load_history.h>
#include <hpvi/reader/checks/checks.h>
#include <hpvi/results/solution_field.h>
#include <hpvi/results/unseen_contact.h>

#include <limits>
#include <tuple>

namespace
{
using namespace verification;

/** A unit square of one cell, E = 2, nu = 0, plane strain: mu = 1. */
Scene<2> square(const Overrides &entries)
{
  return scene_of({given::elastic("2", "0"), given::steps("hup2", "1"), entries});
}

/** The coarse mesh of a scene and its spaces of one degree. */
struct CoarseSpaces
{
  Triangulation<2> mesh;
  std::shared_ptr<const Spaces<2>> spaces;

  CoarseSpaces(const Scene<2> &scene, const unsigned int degree)
  {
    make_mesh(scene, mesh);
    spaces = std::make_shared<const Spaces<2>>(scene, borrowed(mesh),
                                               Degrees(mesh.n_active_cells(), degree),
                                               std::make_shared<const ShapeTables<2>>());
  }

  /** The body as it was, free of tractions. */
  Solution<2> at_rest(const Scene<2> &scene) const
  {
    return {scene, spaces, Vector<double>(spaces->displacement_space.n_dofs()),
            Vector<double>(spaces->contact_space.n_multipliers())};
  }
};

/** The last step of a run; @p look sees it. */
void run(const Scene<2> &scene, const std::function<void(const StepReport<2> &)> &look)
{
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        if (!step.stopped_by.empty())
          look(step);
      });
}

// ---------------------------------------------------------------- loads, gaps, friction

/** What drives counts with its size on the body, here of diameter sqrt(2) and weight mu = 1. */
TEST(Thresholds, DataScaleIsOfAllThatDrives)
{
  struct Row
  {
    Overrides entries;
    double displacement, stress;
  };
  const double size = std::sqrt(2.);
  const auto plate = [](const std::string &entry, const std::string &value) {
    return Overrides{{"Boundary top/Rigid", "true"}, {"Boundary top/" + entry, value}};
  };
  for (const Row &row : {Row{{{"Boundary bottom/Gap", "-0.02"}}, 0.02, 0.02 / size}, // interference
                         Row{{{"Boundary bottom/Gap", "5"}}, 0, 0},
                         Row{{{"Boundary left/Traction", "0.3; 0"}}, 0.3 * size, 0.3},
                         Row{{{"Boundary left/Displacement", "0.02; free"}}, 0.02, 0.02 / size},
                         Row{plate("Rotation", "-0.02"), 0.02 * size, 0.02},
                         Row{plate("Moment", "0.3"), 0.3 / size, 0.3 / (size * size)}})
  {
    const DataScale scale =
        data_scale(square(Overrides{{"Boundary bottom/Contact", "unilateral"}} + row.entries));
    EXPECT_NEAR(scale.displacement, row.displacement, 1e-15) << row.entries.back().first;
    EXPECT_NEAR(scale.stress, row.stress, 1e-15) << row.entries.back().first;
  }
}

/** 4 % of the loads are left over, and nothing that the mesh sees resists them. */
TEST(Thresholds, LoadsThatNearlyCancelPushAllTheSame)
{
  const Scene<2> scene =
      square({{"Geometry/Subdivisions", "2, 2"},
              given::rough("bottom", "bilateral", "if(abs(x - 0.6) < 0.00001, 1e5, 0)"),
              {"Boundary top/Traction", "-0.48; -1"},
              {"Boundary left/Traction", "0.52; 0"}});
  const std::string failure = failure_of(scene);
  EXPECT_TRUE(says(failure, " with 0.04,")) << failure;
}

/** It vanishes in the middle of the edge, and acts near its ends. */
TEST(Thresholds, FrictionCoefficientIsSeenBesideTheMiddleOfAnEdge)
{
  const Scene<2> scene =
      square({{"Adaptivity/Method", "hup3"},
              {"Boundary bottom/Contact", "unilateral"},
              {"Boundary bottom/Friction coefficient", "if(abs(x - 0.5) > 0.25, 0.4, 0)"},
              {"Boundary top/Displacement", "0.03; -0.02"}});
  run(scene,
      [](const StepReport<2> &step)
      {
        const ContactState<2> &state = step.contact.at(0);
        EXPECT_GT(std::abs(state.friction_resultant), 0.1 * std::abs(state.normal_resultant));
      });
}

/** int x^4, of which the two points of the displacement's own rule would find 7/36. */
TEST(Thresholds, MomentsOfTheGapAreExactBeyondTheDegreeOfTheCell)
{
  const Scene<2> scene = square({{"Boundary bottom/Contact", "unilateral"},
                                 {"Boundary bottom/Gap", "x^4"},
                                 {"Boundary top/Displacement", "0; 0"},
                                 {"Solver/Normal contact", "multiplier"}});
  const CoarseSpaces coarse(scene, 2);
  const auto &unknowns = coarse.spaces->contact_space.multipliers();
  ASSERT_EQ(unknowns.size(), 1u);
  EXPECT_NEAR(unknowns[0].gap, 0.2, 1e-14);
}

/** Two sides of one direction share the node between them, and none may pass through its own foundation. */
TEST(Thresholds, TheNearerFoundationHoldsANodeOfTwoSides)
{
  for (const double bottom : {0.01, 0.03})
  {
    Scene<2> scene;
    scene.geometry.shape = Shape::quadrilateral;
    scene.geometry.corners = quadrilateral_corners(
        {{Point<2>(0, 0), Point<2>(1, -1e-7), Point<2>(2, 0), Point<2>(1, 1)}});
    scene.solver.normal_contact = NormalContact::nodes;
    for (const auto &[side, gap] : {std::make_pair("bottom", bottom), {"right", 0.04 - bottom}})
    {
      scene.boundary(side).contact = Contact::unilateral;
      scene.boundary(side).gap = expression<2>(gap);
    }
    const CoarseSpaces coarse(scene, 2);
    unsigned int n_shared = 0;
    for (const ContactMultiplier<2> &node : coarse.spaces->contact_space.multipliers())
      if (node.x.distance(Point<2>(1, -1e-7)) < 1e-6)
      {
        EXPECT_NEAR(node.gap / node.weight, 0.01, 1e-15);
        ++n_shared;
      }
    EXPECT_EQ(n_shared, 1u);
  }
}

/** At a corner that a support holds. */
TEST(Thresholds, SupportsMayNotMoveANodeThroughTheFoundation)
{
  Scene<2> scene;
  scene.solver.normal_contact = NormalContact::nodes;
  scene.boundary("bottom").contact = Contact::unilateral;
  scene.boundary("bottom").gap = expression<2>(0.01);
  for (const double u_n : {0.005, 0.011})
  {
    scene.boundary("left").displacement = {{expression<2>(0.), expression<2>(-u_n)}};
    const auto build = [&]
    {
      check(scene);
      CoarseSpaces(scene, 2);
    };
    if (u_n < 0.01)
      EXPECT_NO_THROW(build());
    else
      EXPECT_THROW(build(), InputError);
  }
}

/** A foundation that carries a hundred-thousandth of what another does is in contact. */
TEST(Thresholds, ASmallPressureClosesContact)
{
  const Scene<2> scene = square({{"Boundary bottom/Contact", "unilateral"},
                                 {"Boundary left/Contact", "unilateral"},
                                 {"Boundary top/Displacement", "free; -0.5"},
                                 {"Boundary right/Displacement", "-5e-6; free"},
                                 {"Solver/Normal contact", "multiplier"}});
  run(scene,
      [](const StepReport<2> &step)
      {
        ASSERT_EQ(step.contact.size(), 2u);
        for (const ContactState<2> &state : step.contact)
          for (const ContactPoint<2> &point : state.points)
          {
            EXPECT_FALSE(point.is_open);
            EXPECT_NEAR(point.normal_traction, state.boundary == 0 ? -1e-5 : -1., 1e-12);
          }
      });
}

// ---------------------------------------------------------------- what passes through foundations

/** Of the nodes one touches, and the polynomial between them does not follow a kink. */
TEST(Thresholds, PenetrationOfAFewPercentIsWarnedOf)
{
  const auto is_warned_of = [](const std::string &gap)
  {
    bool result = false;
    run(square({{"Boundary bottom/Contact", "unilateral"},
                {"Boundary bottom/Gap", gap},
                {"Boundary top/Displacement", "0; -0.2"},
                {"Solver/Normal contact", "nodes"}}),
        [&](const StepReport<2> &step)
        { result = mentions(texts(step.warnings), "penetrates the foundation"); });
    return result;
  };
  EXPECT_TRUE(is_warned_of("0.1*abs(x - 0.3)"));
  EXPECT_FALSE(is_warned_of("0.1*(x - 0.3)^2"));
}

/** A pebble between the points of an edge, at the odd twelfths of its length. */
TEST(Thresholds, APebbleThatIsSmallBesideTheEdgeIsSeen)
{
  for (const unsigned int k : {1U, 3U, 5U, 7U, 9U, 11U})
  {
    const std::string place = std::to_string(k) + "/12";
    const Scene<2> scene =
        square({{"Boundary bottom/Contact", "unilateral"},
                {"Boundary bottom/Gap", "0.01 - 0.02*exp(-((x - " + place + ")/0.002)^2)"},
                {"Boundary top/Displacement", "0; -0.001"}});
    const CoarseSpaces coarse(scene, 2);
    const auto places = unseen_contacts(coarse.at_rest(scene));
    ASSERT_EQ(places.size(), 1u) << place;
    EXPECT_NEAR(places[0].depth, 0.01, 1e-6);
    EXPECT_NEAR(places[0].where[0], k / 12., 1e-4);
  }
}

/** (4.45) of `u_n - u_0 = 1 + x^4`: mu^2 p/h int (1 + x^4)^2. */
TEST(Thresholds, PenetrationIsIntegratedBeyondTheDegreeOfTheCell)
{
  const Scene<2> scene = square({{"Boundary bottom/Contact", "unilateral"},
                                 {"Boundary bottom/Gap", "-1 - x^4"},
                                 {"Boundary top/Displacement", "free; free"},
                                 {"Boundary left/Displacement", "0; free"}});
  const CoarseSpaces coarse(scene, 2);
  const ErrorEstimate estimate = estimate_error(SolutionField(coarse.at_rest(scene)));
  EXPECT_NEAR(estimate.penetration.at(0), 2 * (1 + 2. / 5 + 1. / 9), 1e-12);
}

// ---------------------------------------------------------------- limits

/** Twenty times the indicator of round-off may be an error still. */
TEST(Thresholds, RoundOffEndsARunAtAFewTimesItself)
{
  const Overrides sheared = {{"Boundary bottom/Displacement", "0; 0"},
                             {"Boundary top/Displacement", "0.1*x^2; -0.1"}};
  Scene<2> scene = square(sheared);
  scene.adaptivity.maximum_steps = 100;
  run(square(sheared),
      [&](const StepReport<2> &step)
      {
        const double round_off = round_off_of_estimate(step.field);
        const auto limit_at = [&](const double estimate)
        {
          History<2> history;
          history.push_back({estimate, 1e-3, 1e-3, 0.});
          return reached_limit<2>(scene, history, {1, step.solution().u.linfty_norm(), 0., [&]() {
                                                     return round_off;
                                                   }});
        };
        EXPECT_EQ(limit_at(2 * round_off), Stop::round_off);
        EXPECT_EQ(limit_at(20 * round_off), Stop::none);
        // Up to a hundred times itself where strains are below it, or where it falls no further.
        const auto limit_after =
            [&](const double before, const double estimate, const double relative)
        {
          History<2> history;
          if (before > 0)
            history.push_back({before, 1e-3, 1e-3, 0.});
          history.push_back({estimate, relative, 1e-3, 0.});
          return reached_limit<2>(scene, history, {1, step.solution().u.linfty_norm(), 0., [&]() {
                                                     return round_off;
                                                   }});
        };
        EXPECT_EQ(limit_after(0, 90 * round_off, 1.1), Stop::round_off);
        EXPECT_EQ(limit_after(0, 90 * round_off, 0.9), Stop::none);
        EXPECT_EQ(limit_after(0, 110 * round_off, 1.1), Stop::none);
        EXPECT_EQ(limit_after(21 * round_off, 20 * round_off, 1e-3), Stop::round_off);
        EXPECT_EQ(limit_after(23 * round_off, 20 * round_off, 1e-3), Stop::none);
      });
}

/** The load moves along the top: its mesh has to follow until the indicator is that of the first load step. */
/** Units are the cause where numbers overflow, and of no 0/0 of moderate ones. */
TEST(Thresholds, UnitsAreBlamedWhereNumbersOverflow)
{
  const double none = std::numeric_limits<double>::quiet_NaN(),
               infinite = std::numeric_limits<double>::infinity();
  EXPECT_NO_THROW(check_finite("the energy", 1e300, 1e300));
  for (const auto &[value, size, words] : {std::make_tuple(none, 1e99, "0 divided by 0"),
                                           {none, 1e101, "choose units"},
                                           {infinite, 1., "choose units"}})
  {
    const std::string failure = failure_of<NumericalFailure>(
        [&, value = value, size = size] { check_finite("the energy", value, size); });
    EXPECT_TRUE(says(failure, words)) << failure;
  }
}

/** A relative error of 0.5 of a displacement that is 1e-2 of the largest so far is 5e-3 of that. */
TEST(Thresholds, RoundOffIsBesideTheLargestDisplacementSoFar)
{
  AlgebraicError error;
  error.relative = 0.5;
  error.energy_product = 1;
  const double square = round_off_of_data * round_off_of_data;
  EXPECT_THROW(check_algebraic_error(error, 0.), NumericalFailure);
  EXPECT_THROW(check_algebraic_error(error, 2.4e3 * square), NumericalFailure);
  EXPECT_NO_THROW(check_algebraic_error(error, 2.6e3 * square));
}

/** What is missed of a gap counts up to three times the displacement, on edges that have the condition. */
TEST(Thresholds, GapsOutOfReachAreNotMissed)
{
  const Scene<2> scene = square({{"Boundary bottom/Contact", "unilateral"},
                                 {"Boundary bottom/Gap", "1"},
                                 {"Boundary top/Displacement", "0; -0.1"}});
  const CoarseSpaces coarse(scene, 2);
  Solution<2> solution = coarse.at_rest(scene);
  solution.u[0] = -0.1;
  struct Row
  {
    std::string name;
    double value, interpolated;
    bool is_gap, stays;
  };
  for (const Row &row :
       {Row{"Gap on bottom", 0.31, 0.5, true, false}, Row{"Gap on bottom", 0.29, 0.5, true, true},
        Row{"Gap on bottom", 5, 0.29, true, true}, Row{"Gap on top", 0.29, 0.5, true, false},
        Row{"Displacement on top", 0.31, 0.5, false, true}})
  {
    MissedDisplacement<2> missed{};
    missed.name = row.name;
    missed.value = row.value;
    missed.interpolated = row.interpolated;
    missed.is_gap = row.is_gap;
    EXPECT_EQ(within_reach<2>({missed}, solution).size(), row.stays ? 1U : 0U)
        << row.name << row.value;
  }
}

TEST(Thresholds, LoadStepsAreAsFineAsTheFirstByTheResidualIndicator)
{
  const Scene<2> scene = scene_of({given::box("4, 1", "8, 2"),
                                   {"Boundary bottom/Contact", "bilateral"},
                                   {"Boundary left/Displacement", "0; free"},
                                   {"Boundary top/Traction", "0; -exp(-9*(x - 6*t + 2)^2)"},
                                   given::steps("hpa3", "5"),
                                   {"Adaptivity/Indicator", "residual"},
                                   {"Adaptivity/Tolerance", "0"},
                                   {"Loading/Steps", "2"}});
  double first = 0;
  LoadHistory<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        if (step.stopped_by.empty())
          return;
        if (step.load.number == 1)
          first = step.relative_estimate;
        else
        {
          EXPECT_NE(text(step.stopped_by), "Maximum steps");
          EXPECT_LE(step.relative_estimate, 1.2 * first);
        }
      });
  EXPECT_GT(first, 0);
}

/**
 * A tolerance on a bound that does not exist is compared with the indicator: the run says so (tests/scenes/ends.py), and warns of
 * nothing where the body is so stiff that its strains are small.
 */
TEST(Thresholds, ToleranceOnNoBoundIsThatOfTheIndicator)
{
  for (const char *const on : {"bound", "residual"})
    run(square({given::quadrilateral("Geometry", "0, 0; 1, 0; 1.2, 1.3; 0, 1"),
                {"Adaptivity/Start degree", "1"},
                {"Boundary bottom/Displacement", "0; 0"},
                {"Boundary top/Traction", "0; -1"},
                {"Material/Young's modulus", "200"},
                {"Adaptivity/Maximum steps", "9"},
                {"Adaptivity/Tolerance", "0.9"},
                {"Adaptivity/Tolerance on", on}}),
        [&](const StepReport<2> &step)
        {
          EXPECT_EQ(text(step.stopped_by), "Tolerance");
          EXPECT_FALSE(step.no_bound.empty());
          EXPECT_EQ(texts(step.warnings), std::vector<std::string>());
        });
}

/** As a report reads them in a file. */
TEST(StopReason, IsReadFromItsWords)
{
  for (unsigned int k = 0; k <= static_cast<unsigned int>(Stop::load_step); ++k)
  {
    const StopReason reason{static_cast<Stop>(k),
                            static_cast<Stop>(k) == Stop::load_step ? 12U : 0U};
    const StopReason read = stop_reason_from(text(reason));
    EXPECT_EQ(read.stop, reason.stop) << text(reason);
    EXPECT_EQ(read.load_step, reason.load_step);
    EXPECT_EQ(text(read), text(reason));
  }
  EXPECT_EQ(text({Stop::load_step, 12}), "error of load step 12");
  EXPECT_TRUE(stop_reason_from("callback").empty());
}
} // namespace
