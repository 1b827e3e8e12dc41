// SPDX-License-Identifier: LGPL-2.1-or-later
// Coulomb friction: closed forms with their true errors, limits, several solutions, failures.
#include "coulomb_law.h"

#include <hpvi/reader/closed_forms/hertz.h>
#include <hpvi/reader/closed_forms/partial_slip.h>
#include <hpvi/reader/closed_forms/stick_slip.h>
#include <hpvi/results/residual_estimator.h>
#include <hpvi/results/solution_field.h>

#include <limits>
#include <map>

namespace
{
using namespace verification;

/** Hertz's pressure under full slip, friction -f p: two fields of Hertz's kind and a translation. */
class SlidingHertz : public ExactSolution<2>
{
public:
  SlidingHertz(const Material &material, const double f)
      : hertz(material, p_0, a, 0), friction(material, f * p_0, a, 1e-14 * a, 0)
  {
  }

  Tensor<1, 2> displacement(const Point<2> &x) const override
  {
    return hertz.displacement(x) + friction.displacement(x) + Point<2>(0.03, 0);
  }

  Tensor<2, 2> gradient(const Point<2> &x) const override
  {
    return hertz.gradient(x) + friction.gradient(x);
  }

  double multiplier(const Point<2> &) const override
  {
    return 1; // where there is pressure
  }

  double pressure(const Point<2> &x) const override
  {
    return hertz.pressure(x);
  }

  std::vector<Point<2>> singularities() const override
  {
    return hertz.singularities();
  }

  static constexpr double p_0 = 7, a = 0.7;

private:
  const Hertz hertz;
  const PartialSlip friction; // its stick zone is narrower than round-off
};

/** Stick meets slip under a uniform pressure q. */
class PressedStickSlip : public ExactSolution<2>
{
public:
  PressedStickSlip(const Material &material, const double g, const double q)
      : field(material, g, 0, 1), q(q), strain(q / (material.lambda(2) + 2 * material.mu())),
        drop((material.kolosov() - 1) / (material.kolosov() + 1) * g)
  {
  }

  double multiplier(const Point<2> &x) const override
  {
    return field.multiplier(x);
  }

  double pressure(const Point<2> &x) const override
  {
    return q - drop * std::sqrt(std::max(0., -x[0]));
  }

  Tensor<1, 2> displacement(const Point<2> &x) const override
  {
    return field.displacement(x) - Point<2>(0, strain * x[1]);
  }

  Tensor<2, 2> gradient(const Point<2> &x) const override
  {
    Tensor<2, 2> result = field.gradient(x);
    result[1][1] -= strain;
    return result;
  }

  std::vector<Point<2>> singularities() const override
  {
    return field.singularities();
  }

private:
  const StickSlip field;
  const double q, strain, drop;
};

void prescribe(Scene<2> &scene, const std::shared_ptr<const ExactSolution<2>> &exact)
{
  scene.exact_solution = exact;
  verification::prescribe(scene, [=](const Point<2> &x) { return exact->displacement(x); });
}

Scene<2> sliding_hertz()
{
  const double f = 0.3, a = SlidingHertz::a, k = SlidingHertz::p_0 / a;
  Scene<2> scene;
  scene.geometry.corners = box_corners<2>({-2, 0}, {2, 2});
  scene.geometry.subdivisions = {{4, 2}};
  scene.materials = {{200, 0.3, PlaneModel::strain}};
  const Material &material = scene.materials[0];
  prescribe(scene, std::make_shared<SlidingHertz>(material, f));
  BoundaryCondition<2> &bottom = scene.boundary("bottom");
  bottom.contact = Contact::unilateral;
  bottom.friction.coefficient = expression<2>(f);
  const double R = 200 / (2 * (1 - 0.09) * k),
               twist = f * (material.kolosov() - 1) * k / (4 * material.mu());
  bottom.gap = expression<2>(
      [=](const Point<2> &x)
      {
        const double s = x[0];
        return s * s / (2 * R) + twist * (s * std::sqrt(std::max(0., a * a - s * s)) / 2 +
                                          a * a / 2 * std::asin(std::clamp(s / a, -1., 1.)));
      });
  return scene;
}

Scene<2> pressed_stick_slip(const Contact contact)
{
  const double g = 0.3, q = 1;
  Scene<2> scene;
  scene.geometry.corners = box_corners<2>({-1, 0}, {1, 1});
  scene.geometry.subdivisions = {{4, 2}};
  scene.materials = {{1, 0.3, PlaneModel::stress}};
  const auto exact = std::make_shared<PressedStickSlip>(scene.materials[0], g, q);
  prescribe(scene, exact);
  BoundaryCondition<2> &bottom = scene.boundary("bottom");
  bottom.contact = contact;
  bottom.friction.coefficient =
      expression<2>([=](const Point<2> &x) { return g / exact->pressure(x); });
  return scene;
}

Outcome adapt(Scene<2> scene, const Method method, const unsigned int steps)
{
  scene.adaptivity.method = method;
  scene.adaptivity.start_degree = own_start_degree(method);
  scene.adaptivity.maximum_steps = steps;
  return verification::run(scene);
}

// ---------------------------------------------------------------- closed forms

void expect_exponential(const std::vector<double> &energies, const double exact, const double last)
{
  EXPECT_LE(std::abs(energies.back() - exact), last * exact);
  EXPECT_LE(std::abs(energies.back() - exact), 1e-4 * std::abs(energies.front() - exact));
}

/** Friction -f p everywhere under Hertz's pressure p, which a gap that is not symmetric leaves as it was. */
TEST(CoulombFriction, SlipsUnderHertzPressure)
{
  Scene<2> scene = sliding_hertz();
  scene.adaptivity.maximum_steps = 18;
  const Outcome outcome = run(scene);
  expect_exponential(outcome.elastic_energy, 0.149120752172, 1e-9);
  const double P = 7.6969020013, a = SlidingHertz::a;
  EXPECT_NEAR(outcome.contact.normal_resultant, -P, 1e-7 * P);
  EXPECT_NEAR(outcome.contact.friction_resultant, -0.3 * P, 1e-7 * P);
  ASSERT_EQ(outcome.contact.zones.size(), 3u);
  EXPECT_EQ(outcome.contact.zones[1].mode, ContactMode::slip);
  EXPECT_NEAR(outcome.contact.zones[1].begin[0], -a, 1e-3 * a);
  EXPECT_NEAR(outcome.contact.zones[1].end[0], a, 1e-3 * a);
}

/** The stick-slip field with a uniform pressure q: f = g/p(x) makes Coulomb's bound the constant g. */
TEST(CoulombFriction, SticksAndSlipsWithAVariableCoefficient)
{
  for (const Contact contact : {Contact::unilateral, Contact::bilateral})
  {
    Scene<2> scene = pressed_stick_slip(contact);
    scene.adaptivity.maximum_steps = 20;
    const Outcome outcome = run(scene);
    expect_exponential(outcome.elastic_energy, 0.928311113728, 1e-8);
    ASSERT_EQ(outcome.contact.transitions.size(), 1u);
    EXPECT_NEAR(outcome.contact.transitions[0][0], 0, 1e-4);
  }
}

// ---------------------------------------------------------------- true errors and the indicator

/** Over degrees, meshes and both, the indicator is between half of the error and a few of it. */
TEST(CoulombProofs, IndicatorFollowsTheError)
{
  for (const Scene<2> &scene : {sliding_hertz(), pressed_stick_slip(Contact::unilateral),
                                pressed_stick_slip(Contact::bilateral)})
    for (const auto &[method, steps] : std::map<Method, unsigned int>{{Method::hup2, 4},
                                                                      {Method::hup3, 4},
                                                                      {Method::pu, 7},
                                                                      {Method::hap3, 5},
                                                                      {Method::hpa3, 12}})
      for (const double effectivity : adapt(scene, method, steps).effectivity)
      {
        EXPECT_GT(effectivity, 0.5);
        EXPECT_LT(effectivity, 8.);
      }
}

/** So is the bound, and never below it; Hertz's gap is no polynomial, which coarse edges miss too much of. */
TEST(CoulombProofs, BoundFollowsTheError)
{
  for (Scene<2> scene : {sliding_hertz(), pressed_stick_slip(Contact::unilateral)})
  {
    scene.adaptivity.method = Method::hpa3;
    scene.adaptivity.start_degree = 3;
    scene.adaptivity.maximum_steps = 14;
    unsigned int n_bounds = 0;
    AdaptiveSolver<2>(scene).run(
        [&](const StepReport<2> &step)
        {
          if (!step.bound)
            return;
          ++n_bounds;
          EXPECT_EQ(step.bound->kind, BoundKind::coupling);
          EXPECT_NEAR(step.bound->coupling, 0.37, 0.03);
          EXPECT_GT(step.bound->estimate, step.errors.energy);
          EXPECT_GT(step.bound->total, step.errors.energy);
          EXPECT_LT(step.bound->total, (step.number == 1 ? 4.7 : 2.3) * step.errors.energy);
        });
    EXPECT_GE(n_bounds, 3u);
  }
}

/** `|max(|z_t| - mu_f max(z_n, 0), 0)|^2` of random tractions, by polynomials through the Gauss points. */
TEST(CoulombProofs, IndicatorHoldsExcessOfFriction)
{
  for (const bool is_unilateral : {true, false})
  {
    Scene<2> scene = pressed_stick_slip(is_unilateral ? Contact::unilateral : Contact::bilateral);
    const auto coefficient = [](const Point<2> &x) { return 0.4 + 0.1 * x[0]; };
    scene.boundary("bottom").friction.coefficient = expression<2>(coefficient);
    const RandomMesh mesh(scene, 3, 2);
    const Laboratory discrete(scene, mesh);
    std::mt19937 random(7);
    const Solution<2> solution = discrete.random_field(random);
    const ErrorEstimate estimate = estimate_error(SolutionField(solution));
    std::vector<double> expected(mesh.degrees.size());
    for (const ContactFace<2> &face : discrete.contact_space.faces())
    {
      const unsigned int cell = face.cell->active_cell_index(), n = face.degree - 1;
      const auto basis = Polynomials::generate_complete_Lagrange_basis(QGauss<1>(n).get_points());
      const QGauss<1> rule(face.degree + 1);
      for (unsigned int q = 0; q < rule.size(); ++q)
      {
        const double s = rule.point(q)[0];
        double friction = 0, pressure = 0;
        for (unsigned int i = 0; i < n; ++i)
        {
          friction += solution.z[face.first_multiplier + i] * basis[i].value(s);
          pressure += solution.z[face.pressures[i]] * basis[i].value(s);
        }
        const double excess =
            std::max(0., std::abs(friction) - coefficient(face.point(s)) * std::max(0., pressure));
        expected[cell] += rule.weight(q) * face.length * excess * excess;
      }
      expected[cell] *= face.map.longest_edge() / face.degree;
    }
    double sum = 0;
    for (unsigned int cell = 0; cell < expected.size(); ++cell)
    {
      EXPECT_NEAR(estimate.excess[cell], expected[cell], 1e-12 * (1 + expected[cell]));
      sum += std::pow(estimate.indicator(cell), 2);
    }
    EXPECT_NEAR(estimate.total() * estimate.total(), sum, 1e-12 * sum);
    ErrorEstimate without = estimate;
    without.excess.clear();
    EXPECT_GT(estimate.total(), without.total());
    EXPECT_GT(estimate.indicator(0), without.indicator(0));
  }
  // Nothing of the kind under Tresca's law.
  const Scene<2> tresca = shipped_scene("han-6-12-unilateral", {});
  const RandomMesh mesh(tresca, 3, 1);
  EXPECT_TRUE(estimate_error(SolutionField(Laboratory(tresca, mesh).solve())).excess.empty());
}

// ---------------------------------------------------------------- exact states

/** A floor that is tilted by alpha: the body turns onto it, pressed alike everywhere, and nothing rubs. */
TEST(CoulombProofs, PatchOnATiltedFloorIsExact)
{
  const double d = 0.01, alpha = 0.02, strain = 0.003;
  Scene<2> scene;
  scene.geometry.corners = box_corners<2>({0, 0}, {2, 1});
  scene.geometry.subdivisions = {{2, 2}};
  scene.materials = {{10, 0.3, PlaneModel::strain}};
  const auto field = [=](const Point<2> &x)
  { return Point<2>(alpha * x[1], -d - alpha * x[0] - strain * x[1]); };
  verification::prescribe(scene, field);
  BoundaryCondition<2> &bottom = scene.boundary("bottom");
  bottom.contact = Contact::unilateral;
  bottom.gap = expression<2>([=](const Point<2> &x) { return d + alpha * x[0]; });
  bottom.friction.coefficient = expression<2>(0.3);
  const RandomMesh mesh(scene, 5, 2);
  const Laboratory discrete(scene, mesh);
  const Solution<2> solution = discrete.solve();
  EXPECT_LE(nodal_error(solution, field), 1e-12);
  const double p = (scene.materials[0].lambda(2) + 2 * scene.materials[0].mu()) * strain;
  const std::vector<ContactState<2>> contact = contact_states(SolutionField(solution));
  for (const ContactPoint<2> &point : contact.at(0).points)
  {
    EXPECT_NEAR(point.normal_traction, -p, 1e-10 * p);
    EXPECT_NEAR(point.tangential_traction, 0, 1e-10 * p);
  }
  expect_coulomb(solution);
}

// ---------------------------------------------------------------- scenes

/** The law at every point and the balance to 1e-8 (run() looks), where things press, and what they carry. */
TEST(CoulombProofs, ShippedScenesKeepTheLaw)
{
  const auto contact = [](const std::string &name) {
    return run(shipped_scene(name, {{"Adaptivity/Maximum steps", "8"}})).contact;
  };
  const double weight = 2; // of the block on the slope of 30 degrees
  EXPECT_NEAR(contact("slope").normal_resultant, -weight * std::cos(numbers::PI / 6), 1e-9);
  const ContactState<2> pad = contact("brake-pad");
  EXPECT_NEAR(pad.friction_resultant, 70, 1e-7); // it slips everywhere: mu_f p length
  EXPECT_NEAR(pad.normal_resultant, -200, 1e-7);
  EXPECT_EQ(pad.zones.front().mode, ContactMode::slip);
  EXPECT_EQ(pad.zones.back().mode, ContactMode::open);
  const ContactState<2> punch = contact("punch-friction");
  ASSERT_EQ(punch.zones.size(), 3u);
  EXPECT_EQ(punch.zones[0].mode, ContactMode::stick);
  EXPECT_EQ(punch.zones[1].mode, ContactMode::slip);
  EXPECT_EQ(punch.zones[2].mode, ContactMode::open);
  EXPECT_NEAR(punch.zones[2].begin[0], 1, 1e-12);
  EXPECT_EQ(contact("strut").zones.front().mode, ContactMode::stick);
}

// ---------------------------------------------------------------- nothing presses

/** Where contact carries no force, or loads cancel, the balance has only round-off to compare with. */
TEST(CoulombProofs, BodiesWithoutContactForcesComeToRest)
{
  const std::vector<Overrides> scenes = {
      // A floor that stands too high: the body rises.
      {given::rough("bottom", "unilateral", "0.1*(1 + x^2)"),
       {"Boundary bottom/Gap", "-0.01"},
       {"Geometry/Corners",
        "0, 0; 0.001, 0.9999995; -0.9985995, 1.4009993; -0.9995995, 0.4009998"}},
      // Pinched, and not strained along the plane.
      {{"Boundary bottom/Contact", "bilateral"},
       {"Boundary bottom/Friction coefficient", "1"},
       {"Boundary left/Traction", "0.0955336489125606; 0.0295520206661340"},
       {"Boundary right/Traction", "-0.0955336489125606; -0.0295520206661340"},
       {"Material/Poisson's ratio", "0"},
       {"Geometry/Corners", "0, 0; 1.910672978251212, 0.591040413322679; 1.615152771589872, "
                            "1.546376902448285; -0.295520206661340, 0.955336489125606"}},
      // Bent by loads that cancel.
      {{"Boundary bottom/Contact", "bilateral"},
       {"Boundary bottom/Friction coefficient", "1"},
       {"Boundary left/Traction", "0.1*y; 0"},
       {"Boundary right/Traction", "-0.1*y; 0"},
       {"Material/Poisson's ratio", "0"},
       {"Geometry/Subdivisions", "1, 1"},
       {"Geometry/Corners", "0, 0; 2, 0; 2, 1; 0, 1"}}};
  for (const Overrides &overrides : scenes)
  {
    Overrides entries = {{"Geometry/Shape", "quadrilateral"},
                         {"Geometry/Subdivisions", "2, 1"},
                         {"Material/Young's modulus", "200"},
                         {"Adaptivity/Maximum steps", "3"}};
    entries.insert(entries.end(), overrides.begin(), overrides.end());
    EXPECT_EQ(failure_of(scene_of(entries)), "") << overrides.front().second;
  }
}

// ---------------------------------------------------------------- several solutions, and none

TEST(CoulombProofs, StrutJamsOrLifts)
{
  const Outcome jammed = run(shipped_scene("strut", {{"Adaptivity/Maximum steps", "4"}}));
  EXPECT_TRUE(mentions(jammed.warnings, "has another solution"));
  EXPECT_LT(jammed.contact.normal_resultant, -0.1);
  each_step<2>(shipped_scene("strut", {{"Boundary bottom/Friction coefficient", "0.7"}}),
               [&](const StepReport<2> &step)
               {
                 EXPECT_EQ(*step.reduced->coulomb.difference, 0.);
                 EXPECT_FALSE(mentions(texts(step.warnings), "solution"));
                 EXPECT_TRUE(step.solution().z.all_zero());
               });
}

TEST(CoulombProofs, WarnsWhereAnotherSolutionIsNotExcluded)
{
  CoulombReport report;
  EXPECT_TRUE(several_solutions(report).empty());
  for (const double same : {0., 1e-8})
  {
    report.difference = same;
    EXPECT_TRUE(several_solutions(report).empty());
  }
  report.difference = 0.25;
  EXPECT_NE(several_solutions(report).at(0).text.find("differ by 0.25 of"), std::string::npos);
  report.difference = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(several_solutions(report).at(0).text.find("not known"), std::string::npos);
}

/** Exit status 2 with the numbers and what to try. */
TEST(CoulombProofs, SaysWhatToTryWhereItFails)
{
  const std::string failure =
      failure_of(shipped_scene("brake-pad", {{"Boundary top/Traction", ""},
                                             {"Boundary top/Displacement", "-1; -0.05"},
                                             {"Boundary bottom/Friction coefficient", "5"},
                                             {"Solver/Coulomb solver", "fixed point"}}));
  for (const std::string words :
       {"Coulomb friction (", "problems of Tresca: relative residual", "tolerance 1e-12",
        "contraction number", "set Solver/Coulomb solver = newton", "raise Geometry/Subdivisions",
        "lower Friction coefficient"})
    EXPECT_NE(failure.find(words), std::string::npos) << words << " in: " << failure;
  EXPECT_EQ(failure.find("support"), std::string::npos);
  // Where contact alone holds the body that may be why: bilateral contact that pulls does not rub.
  const std::string loose = failure_of(
      scene_of({given::quadrilateral("Geometry", "0, 0; 1, 0; 1.4, 0.5; 0.4, 0.5", "2, 1"),
                {"Material/Poisson's ratio", "0"},
                {"Boundary bottom/Contact", "bilateral"},
                {"Boundary bottom/Friction coefficient", "0.3"},
                {"Boundary top/Traction", "10*(x - 0.5); 0"}}));
  EXPECT_NE(loose.find("set Solver/Coulomb solver = fixed point"), std::string::npos) << loose;
  EXPECT_NE(loose.find("add a support"), std::string::npos) << loose;
}
} // namespace
