// SPDX-License-Identifier: LGPL-2.1-or-later
// What double precision leaves of a solution: slender bodies against the same discrete problem in
// quadruple precision, bodies far displaced, and where a run has nothing left to gain.
#include "discretisation.h"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <algorithm>
#include <array>

namespace
{
using namespace verification;

// ---------------------------------------------------------------- slender bodies

using Quad = boost::multiprecision::cpp_bin_float_quad;

/** int_0^1 of products of quadratic Lagrange polynomials at 0, 1/2, 1 and their derivatives, times 30. */
constexpr int mass[3][3] = {{4, 2, -1}, {2, 16, 2}, {-1, 2, 4}};
constexpr int stiffness[3][3] = {{70, -80, 10}, {-80, 160, -80}, {10, -80, 70}};
constexpr int mixed[3][3] = {{-15, 20, -5}, {-20, 0, 20}, {5, -20, 15}}; // phi_i phi_j'

/**
 * The cantilever of `length` unit squares with p = 2 in plane strain, E = 1, nu = 0.3, under the end
 * traction (0, t): `a(u,u)` of the discrete problem by a banded Cholesky factorisation in quadruple
 * precision. Nodes column by column, three in each, from x = 1/2 on.
 */
class QuadrupleCantilever
{
public:
  QuadrupleCantilever(const unsigned int length, const double t)
      : n(2 * 3 * 2 * length), rows(n, std::array<Quad, band>{})
  {
    for (unsigned int cell = 0; cell < length; ++cell)
      add_cell(cell);
    load.assign(n, 0);
    for (unsigned int j = 0; j < 3; ++j) // int phi_j over the end: Simpson's weights
      load[n - 6 + 2 * j + 1] = Quad(t) * (j == 1 ? 4 : 1) / 6;
  }

  /** f' A^-1 f = |L^-1 f|^2 */
  double energy_product()
  {
    Quad sum = 0;
    for (unsigned int i = 0; i < n; ++i)
    {
      const unsigned int first = i < band ? 0 : i - band + 1;
      for (unsigned int j = first; j <= i; ++j)
      {
        Quad value = entry(i, j);
        for (unsigned int k = std::max<unsigned int>(first, j < band ? 0 : j - band + 1); k < j;
             ++k)
          value -= entry(i, k) * entry(j, k);
        entry(i, j) = j < i ? Quad(value / entry(j, j)) : Quad(sqrt(value));
      }
      for (unsigned int k = first; k < i; ++k)
        load[i] -= entry(i, k) * load[k];
      load[i] /= entry(i, i);
      sum += load[i] * load[i];
    }
    return sum.convert_to<double>();
  }

private:
  static constexpr unsigned int band = 18; ///< three columns of three nodes

  /** Of the lower triangle. */
  Quad &entry(const unsigned int i, const unsigned int j)
  {
    return rows[i][i - j];
  }

  void add_cell(const unsigned int cell)
  {
    const Quad nu = Quad(3) / 10, mu = 1 / (2 * (1 + nu)), lambda = nu / ((1 + nu) * (1 - 2 * nu));
    // int d_c phi_a d_d phi_b on the unit square, times 900
    const auto product =
        [](const unsigned int a, const unsigned int b, const unsigned int c, const unsigned int d)
    {
      const auto factor = [](const unsigned int i, const unsigned int j, const bool di,
                             const bool dj) {
        return di && dj ? stiffness[i][j] : dj ? mixed[i][j] : di ? mixed[j][i] : mass[i][j];
      };
      return factor(a / 3, b / 3, c == 0, d == 0) * factor(a % 3, b % 3, c == 1, d == 1);
    };
    for (unsigned int a = 3 * (cell == 0); a < 9; ++a) // the first column is clamped
      for (unsigned int b = 3 * (cell == 0); b < 9; ++b)
        for (unsigned int c = 0; c < 2; ++c)
          for (unsigned int d = 0; d < 2; ++d)
          {
            const int i = 2 * (6 * cell + a) - 6 + c, j = 2 * (6 * cell + b) - 6 + d;
            Quad value = lambda * product(a, b, c, d) + mu * product(a, b, d, c);
            for (unsigned int e = 0; c == d && e < 2; ++e)
              value += mu * product(a, b, e, e);
            if (j <= i)
              entry(i, j) += value / 900;
          }
  }

  const unsigned int n;
  std::vector<std::array<Quad, band>> rows;
  std::vector<Quad> load;
};

Overrides cantilever(const unsigned int length)
{
  return {given::box(std::to_string(length) + ", 1", std::to_string(length) + ", 1"),
          {"Boundary left/Displacement", "0; 0"},
          {"Boundary right/Traction", "0; 1e-6"},
          given::steps("hup2", "1")};
}

/** The tip moves by L(u)/t on average, and L(u) = a(u,u). */
TEST(SlenderCantilever, IsThatOfQuadruplePrecision)
{
  const double tolerance = 1e-9; // the factorisation alone is 3e-8 off at 1000
  for (const unsigned int length : {100u, 300u, 1000u})
  {
    const double expected = QuadrupleCantilever(length, 1e-6).energy_product();
    const Scene<2> scene = scene_of(cantilever(length));
    AdaptiveSolver<2>(scene).run(
        [&](const StepReport<2> &step)
        {
          const double tip = -2 * step.energies.energy; // J = a/2 - L = -L/2
          EXPECT_NEAR(tip, expected, tolerance * expected) << length;
          EXPECT_NEAR(step.energies.norm * step.energies.norm, tip, tolerance * tip) << length;
          EXPECT_LT(step.reduced->algebraic.total(), tolerance) << length;
        });
  }
}

/**
 * Friction strong enough holds the end of a long cantilever under its weight: it does not move there,
 * beside what it would do without friction.
 */
TEST(SlenderCantilever, IsHeldAtItsEnd)
{
  const auto moments = [](const std::string &bound)
  {
    Overrides entries = cantilever(1000);
    entries.emplace_back("Boundary right/Traction", "");
    entries.emplace_back("Boundary right/Contact", "bilateral");
    entries.emplace_back("Boundary right/Friction bound", bound);
    entries.emplace_back("Body force/Expression", "0; -1e-9");
    const Scene<2> scene = scene_of(entries);
    double largest = 0;
    AdaptiveSolver<2>(scene).run(
        [&](const StepReport<2> &step)
        {
          const Solution<2> &u = step.solution();
          largest = u.spaces->contact_operator.moments(u.u).linfty_norm();
        });
    return largest;
  };
  EXPECT_LE(moments("1"), 1e-8 * moments("1e-9"));
}

/** What double precision cannot solve is no result. */
TEST(SlenderCantilever, BeyondAllPrecisionIsRefused)
{
  Overrides entries = cantilever(1000);
  entries[0].second = "1e7, 1";
  EXPECT_THROW(AdaptiveSolver<2>(scene_of(entries)).run([](const StepReport<2> &) {}),
               NumericalFailure);
}

/** Corrections are for those who need them. */
TEST(IterativeRefinement, LeavesOrdinaryBodiesAlone)
{
  for (const std::string name : {"han-6-12", "han-6-13", "stick-slip"})
    each_step<2>(shipped_scene(name), [&](const StepReport<2> &step)
                 { EXPECT_EQ(step.reduced->algebraic.corrections, 0u) << name; });
}

/** A displacement spoilt at random comes back, whatever data the scene has. */
TEST(IterativeRefinement, CorrectsASpoiltDisplacement)
{
  const Scene<2> scene =
      scene_of({given::quadrilateral("Geometry", "0, 0; 3, 0.5; 2.5, 2; 0.2, 1.7", "2, 2"),
                {"Body force/Expression", "x*y; 1 - x"},
                {"Boundary top/Displacement", "0.05 + 0.1*x; 0.05*y"},
                {"Boundary right/Traction", "1 + y; -x"},
                given::rough("bottom", "bilateral", "0.1")});
  const RandomMesh mesh(scene, 3, 2);
  const Laboratory discrete(scene, mesh);
  const Solution<2> solution = discrete.solve();
  const SchurComplement reduced = discrete.reduce();
  std::mt19937 random(1);
  Vector<double> spoilt = discrete.random_field(random).u;
  const LinearSolver solver = discrete.discretisation.factor();
  const AlgebraicError error =
      IterativeRefinement<2>(discrete.discretisation, discrete.elements, solver, reduced)
          .improve(solution.z, spoilt);
  EXPECT_GT(error.corrections, 0u);
  EXPECT_LE(error.total(), 1e-12);
  spoilt -= solution.u;
  EXPECT_LE(spoilt.linfty_norm(), 1e-11 * solution.u.linfty_norm());
}

/** One step brings the solution of a body that locks to round-off; passes for the multiplier find next to nothing to do. */
TEST(IterativeRefinement, TakesFewSteps)
{
  unsigned int n_corrected = 0;
  for (const std::string name : {"plane-strain", "resting"}) // the second one has free motions
    for (const auto &[nu, most] :
         std::vector<std::pair<std::string, unsigned int>>{{"0.4999", 1}, {"0.499999", 4}})
    {
      const Scene<2> scene = shipped_scene(name, {{"Material/Poisson's ratio", nu},
                                                  {"Adaptivity/Method", "hup2"},
                                                  {"Adaptivity/Maximum unknowns", "4000"},
                                                  {"Error/Bound", "false"}});
      AdaptiveSolver<2>(scene).run(
          [&](const StepReport<2> &step)
          {
            n_corrected += step.reduced->algebraic.corrections > 0;
            EXPECT_EQ(step.reduced->algebraic.relative > 0.,
                      step.reduced->algebraic.corrections > 0);
            EXPECT_LE(step.reduced->algebraic.corrections, most) << name << ' ' << nu;
            EXPECT_LE(step.reduced->algebraic.relative, 1e-11) << name << ' ' << nu;
            EXPECT_LE(step.reduced->algebraic.multiplier, 1e-9) << name << ' ' << nu;
          });
    }
  EXPECT_GE(n_corrected, 12u);
}

/**
 * From one cell of 1000:1 on, by the default method: the spaces are nested, so J falls with every
 * step, and the tip comes to what beam theory says, less the clamp and more the shear.
 */
TEST(SlenderCantilever, IsABeam)
{
  const Scene<2> scene = scene_of({{"Geometry/Upper corner", "1000, 1"},
                                   {"Boundary left/Displacement", "0; 0"},
                                   {"Boundary right/Traction", "0; 1e-6"}});
  double last = 0;
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        EXPECT_LE(step.energies.energy, last * (1 - 1e-12)) << step.number;
        last = step.energies.energy;
      });
  const double beam = 1e-6 * 1e9 / 3 * 12 * 0.91; // F L^3/(3 E I) with E/(1 - nu^2)
  EXPECT_NEAR(-2 * last / 1e-6, beam, 2e-4 * beam);
}

/**
 * A cantilever that rests on a short contact at its end, a lever of 300 away: friction there obeys its
 * conditions in the corrected displacement, not in that of the factorisation.
 */
TEST(SlenderCantilever, RubsAgainstItsEnd)
{
  Overrides entries = cantilever(300);
  entries.emplace_back("Boundary right/Contact", "bilateral");
  entries.emplace_back("Boundary right/Friction bound", "1e-7");
  entries.emplace_back("Boundary right/Traction", "0; 2e-6");
  entries.emplace_back("Adaptivity/Method", "hup3");
  const Scene<2> scene = scene_of(entries);
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        const Solution<2> &u = step.solution();
        const Vector<double> moments = u.spaces->contact_operator.moments(u.u);
        ASSERT_EQ(u.z.size(), 2u);
        for (unsigned int i = 0; i < 2; ++i)
        {
          EXPECT_EQ(u.z[i], 1e-7);
          EXPECT_GT(moments[i], 0.);
        }
        EXPECT_LT(step.reduced->algebraic.total(), 1e-6);
      });
}

// ---------------------------------------------------------------- far displacements and the floor

/** Uniaxial stress sigma in plane strain: a(u,u) = sigma^2 (1 - nu^2)/E times the area. */
TEST(FarDisplacement, DoesNotDrownTheEnergy)
{
  for (const std::string shift : {"0", "1e5"})
  {
    const Scene<2> scene = scene_of({{"Geometry/Subdivisions", "3, 2"},
                                     {"Boundary left/Displacement", shift + "; free"},
                                     {"Boundary bottom/Displacement", "free; " + shift},
                                     {"Boundary top/Traction", "0; 0.37"}});
    unsigned int steps = 0;
    AdaptiveSolver<2>(scene).run(
        [&](const StepReport<2> &step)
        {
          const double a = 0.37 * 0.37 * 0.91;
          EXPECT_NEAR(step.energies.norm * step.energies.norm, a, 1e-8 * a) << shift;
          for (const std::string &warning : texts(step.warnings)) // it is a third, after all
            EXPECT_EQ(warning.find("the strain is 33.7 %"), 0U) << warning;
          ++steps;
        });
    EXPECT_EQ(steps, 1u);
  }
}

/** Tension along the foundation presses nothing and pulls nothing: 1e-16 is no warning. */
TEST(FarDisplacement, OfABodyThatIsOnlyMovedIsASolution)
{
  const Overrides moved = {{"Boundary left/Traction", ""},
                           {"Boundary right/Displacement", "0.01; -0.02"},
                           {"Boundary top/Displacement", "0.01; -0.02"},
                           {"Boundary bottom/Contact", "none"},
                           {"Boundary bottom/Friction bound", ""},
                           given::box("2, 2", "2, 3"),
                           {"Material/Young's modulus", "221.725"}};
  unsigned int steps = 0;
  each_step<2>(shipped_scene("han-6-12", moved),
               [&](const StepReport<2> &step)
               {
                 ++steps;
                 EXPECT_LE(step.energies.norm, 1e-13);
                 EXPECT_EQ(step.reduced->algebraic.relative, 0.);
                 EXPECT_EQ(text(step.stopped_by), "round-off");
               });
  EXPECT_EQ(steps, 1u);
}

TEST(Floor, NoWarningsAboutNothing)
{
  const Scene<2> scene = scene_of({{"Material/Plane", "stress"},
                                   {"Boundary left/Displacement", "0; free"},
                                   {"Adaptivity/Tolerance", "0"},
                                   {"Boundary bottom/Contact", "bilateral"},
                                   {"Boundary right/Traction", "0.037; 0"}});
  AdaptiveSolver<2>(scene).run(
      [](const StepReport<2> &step)
      {
        EXPECT_EQ(text(step.stopped_by), "round-off");
        EXPECT_EQ(texts(step.warnings), std::vector<std::string>());
      });
}

/** Where nothing acts there is no scale beside which an iterate is small: u is zero, not 1e-118. */
TEST(Floor, NothingActsAndNothingMoves)
{
  const Overrides unloaded = {given::box("1.3178, 2.2672", "2, 2"),
                              {"Boundary bottom/Contact", "bilateral"},
                              {"Boundary bottom/Friction coefficient", "0.11"},
                              {"Boundary right/Displacement", "0; 0"},
                              {"Boundary top/Contact", "unilateral"},
                              {"Boundary top/Gap", "100"},
                              {"Adaptivity/Method", "pu"},
                              {"Solver/QP solver", "mprgp"}};
  each_step<2>(scene_of(unloaded),
               [](const StepReport<2> &step)
               {
                 EXPECT_EQ(step.number, 1u);
                 EXPECT_EQ(text(step.stopped_by), "round-off");
                 EXPECT_EQ(step.solution().u.linfty_norm(), 0.);
                 EXPECT_EQ(step.solution().z.linfty_norm(), 0.);
               });
}

TEST(Floor, AnExactSolutionStopsTheRun)
{
  const Scene<2> scene = scene_of({{"Boundary left/Displacement", "0; free"},
                                   {"Adaptivity/Tolerance", "0"},
                                   {"Boundary bottom/Displacement", "free; 0"},
                                   {"Boundary top/Traction", "0; 0.37"}});
  AdaptiveSolver<2>(scene).run(
      [](const StepReport<2> &step)
      {
        EXPECT_EQ(step.number, 1u);
        EXPECT_EQ(text(step.stopped_by), "round-off");
      });
}

/** The run stops, not before the true error has reached its own floor. */
TEST(Floor, IsWhereTheTrueErrorFallsNoFurther)
{
  const Scene<2> scene =
      shipped_scene("stick-slip", {given::steps("hpa3", "60"), {"Adaptivity/Tolerance", "0"}});
  std::vector<double> errors;
  std::string stopped_by;
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        errors.push_back(step.errors.energy / step.errors.energy_norm);
        stopped_by = text(step.stopped_by);
      });
  EXPECT_EQ(stopped_by, "round-off");
  EXPECT_LT(errors.size(), 40u);
  EXPECT_LT(errors.back(), 2e-12);
  EXPECT_GT(errors.back(), 0.3 * errors[errors.size() - 2]); // it has stopped falling
}

/** Heat is data: what the last bits are worth does not count it, and the run goes on until nothing falls. */
TEST(Floor, OfABodyUnderHeat)
{
  for (const std::string heat :
       {"cos(pi*x/2)*cos(pi*y)", "cos(pi*x)", "20 + cos(pi*x/2) + cos(pi*y)"})
    for (const std::string plane : {"stress", "strain"})
    {
      double relative = 1;
      std::string stopped_by;
      each_step<2>(scene_of({given::box("2, 1", "6, 3"),
                             {"Material/Plane", plane},
                             {"Material/Thermal expansion", "1e-5"},
                             {"Temperature/Expression", heat},
                             given::symmetric({"left", "right", "top", "bottom"}),
                             {"Error/Bound", "false"},
                             given::steps("pu", "20"),
                             {"Adaptivity/Maximum degree", "20"},
                             {"Adaptivity/Tolerance", "0"}}),
                   [&](const StepReport<2> &step)
                   {
                     stopped_by = text(step.stopped_by);
                     relative = step.relative_estimate;
                   });
      EXPECT_EQ(stopped_by, "round-off") << heat << " " << plane;
      EXPECT_LT(relative, 1e-10) << heat << " " << plane;
    }
}

/** Free expansion has no stress but the round-off of two strains; patches are in balance beside these, and there is a bound. */
TEST(Floor, OfABodyThatExpandsFreely)
{
  const Overrides free{given::box("2, 1", "4, 1"),
                       {"Material/Plane", "stress"},
                       {"Material/Thermal expansion", "12e-6"},
                       {"Temperature/Expression", "20"},
                       {"Boundary left/Displacement", "0; free"},
                       {"Adaptivity/Tolerance", "0"},
                       {"Boundary bottom/Symmetry", "true"}};
  const Overrides skew{given::quadrilateral("Geometry", "0, 0; 2, 0; 1.6, 1; 0, 0.8"),
                       {"Error/Bound", "true"}};
  for (const auto &[name, others] : std::vector<std::pair<std::string, Overrides>>{
           {"as it is", {}},
           {"a strain",
            {{"Temperature/Expression", "0"}, {"Material/Initial strain", "1e-3; -2e-3; 0"}}},
           {"a strain that varies",
            {{"Temperature/Expression", "0"}, {"Material/Initial strain", "1e-3*x; -2e-3; 0"}}},
           {"plane strain", {{"Material/Plane", "strain"}}},
           {"long", {{"Geometry/Upper corner", "2, 0.01"}}},
           {"far away", {{"Geometry/Lower corner", "100, 0"}, {"Geometry/Upper corner", "102, 1"}}},
           {"no parallelograms", skew},
           {"two parts",
            {{"Material stiff/Young's modulus", "1e3"}, {"Material stiff/Where", "x - 1"}}}})
  {
    Overrides entries = free;
    for (const auto &entry : others)
    {
      entries.erase(std::remove_if(entries.begin(), entries.end(),
                                   [&](const auto &one)
                                   {
                                     return one.first == entry.first ||
                                            (name == "no parallelograms" &&
                                             one.first.find("corner") != std::string::npos);
                                   }),
                    entries.end());
      entries.push_back(entry);
    }
    std::string stopped_by;
    each_step<2>(scene_of(entries),
                 [&, name = name](const StepReport<2> &step)
                 {
                   stopped_by = text(step.stopped_by);
                   EXPECT_LE(step.number, 4U) << name;
                   EXPECT_TRUE(step.bound) << name << ": " << step.no_bound;
                   EXPECT_LT(step.bound_imbalance, 1e-9) << name;
                 });
    EXPECT_EQ(stopped_by, "round-off") << name;
  }
}
} // namespace
