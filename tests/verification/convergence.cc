// SPDX-License-Identifier: LGPL-2.1-or-later
// Rates: manufactured solutions, energies, and the adaptive methods on both thesis examples.
#include "friction_quadrature.h"

#include <hpvi/results/solution_field.h>

#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <map>

namespace
{
using namespace verification;

/** Slope of the least-squares line through the points (x, y). */
double slope(const std::vector<double> &x, const std::vector<double> &y)
{
  double sum_x = 0, sum_y = 0, sum_xx = 0, sum_xy = 0;
  const double n = x.size();
  for (unsigned int i = 0; i < x.size(); ++i)
  {
    sum_x += x[i];
    sum_y += y[i];
    sum_xx += x[i] * x[i];
    sum_xy += x[i] * y[i];
  }
  return (n * sum_xy - sum_x * sum_y) / (n * sum_xx - sum_x * sum_x);
}

// ---------------------------------------------------------------- manufactured solution

/**
 * u = (sin(2x+y), cos(x-2y)) with its body force; displacement prescribed on three sides, traction
 * on the right one. No contact.
 */
class Manufactured
{
public:
  Manufactured(const std::string &method, const unsigned int degree, const unsigned int steps,
               const Overrides &geometry)
  {
    Overrides entries = {given::elastic("2", "0.3"),
                         {"Material/Plane", "strain"},
                         {"Error/Bound", "false"},
                         given::steps(method, std::to_string(steps), std::to_string(degree))};
    entries.insert(entries.end(), geometry.begin(), geometry.end());
    for (const std::string side : {"left", "top", "bottom"})
      entries.emplace_back("Boundary " + side + "/Displacement", "sin(2*x + y); cos(x - 2*y)");
    const double mu = material.mu(), lambda = material.lambda(2);
    const std::string s = "sin(2*x + y)", c = "cos(2*x + y)", S = "sin(x - 2*y)",
                      C = "cos(x - 2*y)";
    // -mu Laplace u - (lambda + mu) grad div u
    entries.emplace_back("Body force/Expression",
                         in_digits(5 * mu) + "*" + s + " + " + in_digits(lambda + mu) + "*(4*" + s +
                             " - 2*" + C + "); " + in_digits(5 * mu) + "*" + C + " + " +
                             in_digits(lambda + mu) + "*(2*" + s + " + 4*" + C + ")");
    // sigma e_x
    entries.emplace_back("Boundary right/Traction",
                         in_digits(2 * lambda) + "*(" + c + " + " + S + ") + " + in_digits(4 * mu) +
                             "*" + c + "; " + in_digits(mu) + "*(" + c + " - " + S + ")");
    scene = std::make_unique<const Scene<2>>(scene_of(entries));
  }

  /** |u - u_N|_a */
  double energy_error(const Solution<2> &solution) const
  {
    double sum = 0;
    for (const auto &cell : solution.displacement_space.dof_handler().active_cell_iterators())
    {
      FEValues<2> values(cell->get_fe(), QGauss<2>(cell->get_fe().degree + 4),
                         update_gradients | update_JxW_values | update_quadrature_points);
      values.reinit(cell);
      std::vector<Tensor<2, 2>> gradients(values.n_quadrature_points);
      values[FEValuesExtractors::Vector(0)].get_function_gradients(solution.u, gradients);
      for (const unsigned int q : values.quadrature_point_indices())
      {
        const SymmetricTensor<2, 2> strain =
            symmetrize(gradients[q] - exact_gradient(values.quadrature_point(q)));
        sum += values.JxW(q) * (material.lambda(2) * std::pow(trace(strain), 2) +
                                2 * material.mu() * (strain * strain));
      }
    }
    return std::sqrt(sum);
  }

  /** ln N, ln |u - u_N|_a, ln eta of each step */
  struct History
  {
    std::vector<double> unknowns, error, indicator;
  };

  History run() const
  {
    History history;
    AdaptiveSolver<2>(*scene).run(
        [&](const StepReport<2> &step)
        {
          history.unknowns.push_back(std::log(step.solution().displacement_space.n_free_dofs()));
          history.error.push_back(std::log(energy_error(step.solution())));
          history.indicator.push_back(std::log(step.scaled_estimate));
        });
    return history;
  }

private:
  static Tensor<2, 2> exact_gradient(const Point<2> &x)
  {
    Tensor<2, 2> gradient;
    gradient[0][0] = 2 * std::cos(2 * x[0] + x[1]);
    gradient[0][1] = std::cos(2 * x[0] + x[1]);
    gradient[1][0] = -std::sin(x[0] - 2 * x[1]);
    gradient[1][1] = 2 * std::sin(x[0] - 2 * x[1]);
    return gradient;
  }

  const Material material{2., 0.3, PlaneModel::strain};
  std::unique_ptr<const Scene<2>> scene;
};

const Overrides box = {{"Geometry/Subdivisions", "2, 2"}};
/** The right edge is upright, as the traction assumes. */
const Overrides distorted = {
    given::quadrilateral("Geometry", "0.2, 0; 1, -0.1; 1, 1.2; 0, 0.9", "2, 2")};

/** Under uniform bisection the error falls like h^p, that is N^(-p/2), and so does eta. */
TEST(Manufactured, ErrorOfUniformBisectionHasTheOptimalOrder)
{
  for (const Overrides &geometry : {box, distorted})
    for (const unsigned int p : {1u, 2u, 3u, 4u})
    {
      auto history = Manufactured("hup2", p, p < 3 ? 5 : 4, geometry).run();
      for (auto *series : {&history.unknowns, &history.error, &history.indicator})
        series->erase(series->begin()); // the first mesh is too coarse for asymptotics
      EXPECT_NEAR(slope(history.unknowns, history.error), -0.5 * p, 0.08 * p) << "p = " << p;
      EXPECT_NEAR(slope(history.unknowns, history.indicator), -0.5 * p, 0.08 * p) << "p = " << p;
    }
}

/** On one mesh the error falls faster than by any fixed factor as p rises. */
TEST(Manufactured, ErrorOfUniformRaisingFallsExponentially)
{
  for (const Overrides &geometry : {box, distorted})
  {
    const auto history = Manufactured("pu", 2, 9, geometry).run();
    ASSERT_EQ(history.error.size(), 9u);
    for (unsigned int k = 1; k < history.error.size(); ++k)
    {
      EXPECT_LE(history.error[k], history.error[k - 1] - std::log(5.)) << "p = " << k + 2;
      EXPECT_LE(history.indicator[k], history.indicator[k - 1] - std::log(3.)) << "p = " << k + 2;
    }
  }
}

/** Wherever the error can be seen, indicator and error stay within a moderate factor. */
TEST(Manufactured, IndicatorIsReliableAndEfficient)
{
  for (const std::string method : {"hpa1", "hpa2", "hap3"})
  {
    const auto history = Manufactured(method, 2, 8, box).run();
    for (unsigned int k = 0; k < history.error.size(); ++k)
    {
      const double effectivity = std::exp(history.indicator[k] - history.error[k]);
      EXPECT_GE(effectivity, 1.) << method << ", step " << k + 1;
      EXPECT_LE(effectivity, 30.) << method << ", step " << k + 1;
    }
    EXPECT_LT(history.error.back(), history.error.front() - std::log(10.)) << method;
  }
}

// ---------------------------------------------------------------- energies

TEST(Energies, ResolveTheSignChangesOfTheSlip)
{
  const Scene<2> scene = scene_of({given::box("3, 1", "3, 1"),
                                   {"Body force/Expression", "1; x"},
                                   {"Boundary top/Displacement", "0; 0"},
                                   given::rough("bottom", "bilateral", "1 + x")});
  for (const unsigned int seed : {1u, 2u, 3u})
  {
    const RandomMesh mesh(scene, seed, 1);
    const Laboratory discrete(scene, mesh);
    std::mt19937 random(seed);
    const Solution<2> field = discrete.random_field(random);
    const FrictionIntegrals sums = integrate_friction(field, 4000);
    const double friction = sums.friction, coupling = sums.coupling;
    const double a = internal_forces(scene, discrete.displacement_space, discrete.tables, field.u)
                         .energy_product,
                 work = discrete.system.work(field.u);
    const Energies e = energies(SolutionField(field), a, discrete.system.work(field.u));
    EXPECT_NEAR(e.norm * e.norm, a, 1e-12 * a);
    EXPECT_NEAR(e.slack, friction - coupling, 1e-6 * friction);
    EXPECT_NEAR(e.energy - (0.5 * a - work), friction, 1e-6 * friction);
    EXPECT_NEAR(e.lagrangian - (0.5 * a - work), coupling, 1e-6 * friction);
  }
}

TEST(Energies, SlackIsNegativeByTheOvershootOfTheMultiplierAtMost)
{
  for (const std::string name : {"han-6-12", "han-6-13"})
  {
    const Scene<2> scene = shipped_scene(name, {{"Adaptivity/Maximum steps", "12"}});
    double first = 0, last = 0;
    AdaptiveSolver<2>(scene).run(
        [&](const StepReport<2> &step)
        {
          SCOPED_TRACE(name + ", step " + std::to_string(step.number));
          expect_slack_of_overshoot_alone(step.solution(), step.energies.slack);
          last = std::abs(step.energies.slack);
          first = step.number == 1 ? last : first;
        });
    EXPECT_LT(last, 0.1 * first) << name;
  }
}

// ---------------------------------------------------------------- methods of Chapter 5

struct History
{
  std::vector<double> unknowns, indicator;
  std::vector<std::map<unsigned int, unsigned int>> degrees; ///< elements of each degree, per step
};

History run(const std::string &example, const Overrides &overrides)
{
  History history;
  const Scene<2> scene = shipped_scene(example, overrides);
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        history.unknowns.push_back(step.solution().displacement_space.n_free_dofs());
        history.indicator.push_back(step.estimate.total());
        history.degrees.emplace_back();
        for (const unsigned int p : step.solution().displacement_space.degrees())
          ++history.degrees.back()[p];
      });
  return history;
}

/** r of eta ~ N^-r over all steps with N >= 300. */
double algebraic_rate(const History &history)
{
  std::vector<double> x, y;
  for (unsigned int k = 0; k < history.unknowns.size(); ++k)
    if (history.unknowns[k] >= 300)
    {
      x.push_back(std::log(history.unknowns[k]));
      y.push_back(std::log(history.indicator[k]));
    }
  EXPECT_GE(x.size(), 4u);
  return -slope(x, y);
}

/** beta of eta ~ C exp(-beta N^(1/3)) over all steps. */
double exponential_rate(const History &history)
{
  std::vector<double> x, y;
  for (unsigned int k = 0; k < history.unknowns.size(); ++k)
  {
    x.push_back(std::cbrt(history.unknowns[k]));
    y.push_back(std::log(history.indicator[k]));
  }
  return -slope(x, y);
}

struct ExpectedRate
{
  std::string example, method;
  double at_least; ///< the thesis's rate less 0.07; hap3 on the square reaches the full rate
  unsigned int maximum_unknowns;
};

std::ostream &operator<<(std::ostream &out, const ExpectedRate &rate)
{
  return out << rate.example << ", " << rate.method;
}

using MethodRates = ::testing::TestWithParam<ExpectedRate>;

TEST_P(MethodRates, AreThoseOfTheThesisOrBetter)
{
  const History history =
      run(GetParam().example,
          {given::steps(GetParam().method, GetParam().method == "pu" ? "11" : "100"),
           {"Adaptivity/Maximum unknowns", std::to_string(GetParam().maximum_unknowns)}});
  EXPECT_GE(algebraic_rate(history), GetParam().at_least);
}

INSTANTIATE_TEST_SUITE_P(, MethodRates,
                         ::testing::Values(ExpectedRate{"han-6-12", "hup2", 0.38, 10000},
                                           ExpectedRate{"han-6-12", "hap3", 0.9, 8000},
                                           ExpectedRate{"han-6-12", "pu", 0.28, 100000},
                                           ExpectedRate{"han-6-13", "hup3", 0.31, 20000},
                                           ExpectedRate{"han-6-13", "hap2", 0.53, 8000},
                                           ExpectedRate{"han-6-13", "pu", 0.23, 100000}),
                         [](const auto &info)
                         {
                           const std::string &example = info.param.example;
                           return (example == "han-6-12" ? "Square" : "Bar") + info.param.method;
                         });

TEST(ExponentialConvergence, OfTheSecondMethodIsThatOfTheThesis)
{
  for (const auto &[example, beta] :
       {std::make_pair("han-6-12", 0.34), std::make_pair("han-6-13", 0.31)})
  {
    const History history = run(example, {{"Adaptivity/Maximum steps", "16"}});
    EXPECT_GE(history.unknowns.size(), 15u);
    EXPECT_GE(history.unknowns.back(), 19000.) << example;
    EXPECT_GE(exponential_rate(history), beta) << example;
  }
}

using DegreeTable = std::vector<std::map<unsigned int, unsigned int>>;

/** DegreeTable 5.1 of the thesis, Example 5.2: elements of degree 3, 4, ..., as far as a reading goes. */
const DegreeTable table_5_1 = {{{3, 16}}, {{3, 28}}, {{3, 42}, {4, 1}}, {{3, 58}, {4, 6}}};
const std::vector<unsigned int> elements_5_1 = {16,  28,  43,  64,  85,  97,  127, 157,
                                                196, 226, 271, 319, 358, 418, 472};

/** DegreeTable 5.2, Example 5.3. */
const DegreeTable table_5_2 = {{{3, 4}},  {{3, 7}},          {{3, 13}},        {{3, 22}},
                               {{3, 37}}, {{3, 57}, {4, 1}}, {{3, 78}, {4, 7}}};
const std::vector<unsigned int> elements_5_2 = {4,   7,   13,  22,  37,  58,  85, 124,
                                                175, 226, 280, 331, 400, 502, 580};

/** The first @p n_rows exactly. */
void expect_table(const History &history, const DegreeTable &table, const unsigned int n_rows)
{
  for (unsigned int step = 0; step < n_rows; ++step)
    EXPECT_EQ(history.degrees[step], table[step]) << "row " << step + 1;
}

/**
 * The number of elements within 8 %, except in row 10, where both of the print's tables have 226
 * and doc/chapter5.md records 247.
 */
void expect_elements(const History &history, const std::vector<unsigned int> &elements)
{
  ASSERT_GE(history.degrees.size(), elements.size());
  for (unsigned int step = 0; step < elements.size(); ++step)
  {
    unsigned int n = 0;
    for (const auto &[degree, count] : history.degrees[step])
      n += count;
    EXPECT_NEAR(n, elements[step], (step + 1 == 10 ? 0.1 : 0.08) * elements[step])
        << "row " << step + 1;
  }
}

TEST(ThesisTables, PlainReadingGivesSixRowsOfTheBar)
{
  const History bar = run(
      "han-6-13", {{"Adaptivity/Smoothness reading", "plain"}, {"Adaptivity/Maximum steps", "6"}});
  expect_table(bar, table_5_2, 6);
}

TEST(ThesisTables, JointReadingGivesSevenRowsOfTheBarAndFourOfTheSquare)
{
  const Overrides joint = {{"Adaptivity/Smoothness reading", "joint"},
                           {"Adaptivity/Maximum steps", "15"}};
  const History square = run("han-6-12", joint), bar = run("han-6-13", joint);
  expect_table(square, table_5_1, 4);
  expect_elements(square, elements_5_1);
  expect_table(bar, table_5_2, 7);
  expect_elements(bar, elements_5_2);
}
} // namespace
