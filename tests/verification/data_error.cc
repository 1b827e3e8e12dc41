// SPDX-License-Identifier: LGPL-2.1-or-later
// What the bound of the error pays for loads and displacements that are no polynomials: its constants, worked out by hand.
#include "discretisation.h"

#include <hpvi/bound/data_error.h>
#include <hpvi/bound/error_bound.h>
#include <hpvi/plane/initial_stress.h>

namespace
{
using namespace verification;

/** One rhombus with sides of length 1, held at the bottom; c = 2 mu = 1. */
struct Rhombus
{
  std::string corners;
  double diameter, height; ///< over the bottom
  double korn; ///< 2/r (1 + (1 - r^2)^{1/2})^{1/2}, r the quotient of the circles about its centre
};

const std::vector<Rhombus> rhombi = {
    {"0, 0; 1, 0; 1, 1; 0, 1", std::sqrt(2.), 1.,
     std::sqrt(8.) * std::sqrt(1 + std::sqrt(0.5))}, // r = 2^{-1/2}
    {"0, 0; 1, 0; 1.5, 0.86602540378443865; 0.5, 0.86602540378443865", std::sqrt(3.),
     std::sqrt(0.75), 4 * std::sqrt(1 + std::sqrt(0.75))}}; // r = 1/2

Scene<2> loaded(const Rhombus &cell, const Overrides &loads)
{
  Overrides entries = {given::quadrilateral("Geometry", cell.corners, "1, 1"),
                       given::elastic("1", "0"),
                       {"Boundary bottom/Displacement", "0; 0"}};
  entries.insert(entries.end(), loads.begin(), loads.end());
  return scene_of(entries);
}

EquilibratedStress equilibrated(const Solution<2> &solution, EquilibrationCache &cache)
{
  const EquilibratedStress::Parts none = [](unsigned int, unsigned int)
  { return std::vector<double>(); };
  return EquilibratedStress(solution, none, none, cache);
}

/** Its solution with p = 2, and a stress in equilibrium. */
struct LoadedCell
{
  LoadedCell(const Rhombus &cell, const Overrides &loads)
      : scene(loaded(cell, loads)), mesh(scene, 1, 0, 2, 2), lab(scene, mesh),
        solution(lab.solve()), stress(equilibrated(solution, cache))
  {
  }

  const Scene<2> scene;
  const RandomMesh mesh;
  const Laboratory lab;
  const Solution<2> solution;
  EquilibrationCache cache;
  const EquilibratedStress stress;
};

/** |G - s n| on the upper edge. */
double missed_on_top(const EquilibratedStress &stress, const Scene<2> &scene)
{
  const QGauss<1> gauss(20);
  double sum = 0;
  for (const StressEdge &edge : stress.patches().edges())
    if (edge.at_boundary() && scene.boundaries[edge.boundary].has_traction())
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const auto face = stress.patches().cells()[0].iterator->face(edge.sides[0].face);
        const double s = gauss.point(q)[0];
        const Point<2> x = face->vertex(0) + s * (face->vertex(1) - face->vertex(0));
        Tensor<1, 2> missed({0., scene.boundaries[edge.boundary].traction[1]->value(x)});
        const auto &tractions = stress.tractions()[&edge - stress.patches().edges().data()];
        for (unsigned int c = 0; c < 2; ++c)
          missed -= legendre::evaluate(tractions[c], 2 * s - 1) * edge.components[c].direction;
        sum += gauss.weight(q) * missed.norm_square();
      }
  return std::sqrt(sum);
}

/** The inequalities of Korn and of the trace: `korn ((d^2/pi^2 + 2 d/pi)/H)^{1/2} |G - Pi G|`. */
TEST(DataErrorOfOneCell, HasTheConstantsOfTractions)
{
  for (const Rhombus &cell : rhombi)
  {
    const LoadedCell one(cell, {{"Boundary top/Traction", "0; cos(5*x)"}});
    const Solution<2> &solution = one.solution;
    const EquilibratedStress &stress = one.stress;
    const double missed = missed_on_top(stress, one.scene), part = cell.diameter / numbers::PI;
    EXPECT_GT(missed, 0.01);
    const double expected = cell.korn * std::sqrt((part + 2) * part / cell.height) * missed;
    EXPECT_NEAR(DataError(solution, stress).oscillation[0], expected, 1e-9 * expected);
  }
}

/** What springs of varying stiffness exert on u_N, along all of an edge or a strip of it, is a traction like others: of degree beyond that of the stresses, and paid for. */
TEST(DataErrorOfOneCell, HasTheConstantsOfSprings)
{
  for (const std::string k : {"cos(5*x)", "if(abs(x - 0.925) < 0.025, 20, 0)"})
    for (const Rhombus &cell : rhombi)
    {
      const LoadedCell one(cell, {{"Boundary top/Spring", "2 + " + k + "; 1 + " + k},
                                  {"Boundary right/Traction", "1; 0"}});
      const Solution<2> &solution = one.solution;
      const EquilibratedStress &stress = one.stress;
      const auto &edges = stress.patches().edges();
      const QIterated<1> gauss(QGauss<1>(20), 20); // the strip ends where its parts do
      double sum = 0, least = 1;
      for (unsigned int e = 0; e < edges.size(); ++e)
        if (edges[e].at_boundary() && one.scene.boundaries[edges[e].boundary].spring)
          for (unsigned int q = 0; q < gauss.size(); ++q)
          {
            const double s = gauss.point(q)[0];
            Tensor<1, 2> missed = stress.prescribed().value(e, s);
            least = std::min(least, missed.norm());
            for (unsigned int c = 0; c < 2; ++c)
              missed -= legendre::evaluate(stress.tractions()[e][c], 2 * s - 1) *
                        edges[e].components[c].direction;
            sum += gauss.weight(q) * missed.norm_square();
          }
      EXPECT_GT(least, 1e-4); // it is there at all
      EXPECT_GT(sum, 1e-8);
      const double part = cell.diameter / numbers::PI;
      const double expected = cell.korn * std::sqrt((part + 2) * part / cell.height * sum);
      EXPECT_NEAR(DataError(solution, stress).oscillation[0], expected, 1e-6 * expected) << k;
    }
}

/** |f - Pi f| in a cell, Pi f of degrees below @p n in each of its coordinates. */
double missed_by_polynomials(const std::function<double(const Point<2> &)> &f,
                             const CellMap<2> &map, const unsigned int n)
{
  const QGauss<2> gauss(24);
  FullMatrix<double> modes(n, n);
  const auto legendre_at = [n](const Point<2> &s, const unsigned int d)
  { return legendre::values(n, 2 * s[d] - 1); };
  for (unsigned int q = 0; q < gauss.size(); ++q)
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        modes(i, j) += 4 * gauss.weight(q) * f(map.point(gauss.point(q))) *
                       legendre_at(gauss.point(q), 0)[i] * legendre_at(gauss.point(q), 1)[j];
  double sum = 0;
  for (unsigned int q = 0; q < gauss.size(); ++q)
  {
    double missed = f(map.point(gauss.point(q)));
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        missed -=
            modes(i, j) * legendre_at(gauss.point(q), 0)[i] * legendre_at(gauss.point(q), 1)[j];
    sum += gauss.weight(q) * missed * missed;
  }
  return std::sqrt(std::abs(determinant(map.jacobian(Point<2>(0.5, 0.5)))) * sum);
}

/** Those of Korn and of Poincaré: `korn d/pi |F - Pi F|`. */
TEST(DataErrorOfOneCell, HasTheConstantsOfBodyForces)
{
  for (const Rhombus &cell : rhombi)
  {
    const LoadedCell one(cell, {{"Body force/Expression", "0; cos(5*x)"}});
    const Solution<2> &solution = one.solution;
    const EquilibratedStress &stress = one.stress;
    const double missed = stress.missed_force(0);
    EXPECT_GT(missed, 1e-4);
    const unsigned int m = stress.patches().edges()[0].degree;
    const double best = missed_by_polynomials([](const Point<2> &x) { return std::cos(5 * x[0]); },
                                              map_of<2>(stress.patches().cells()[0].iterator),
                                              m - 1); // div s has no more along xi
    EXPECT_GE(missed, 0.999 * best);
    EXPECT_LE(missed, 1.2 * best); // Pi F interpolates
    const double expected = cell.korn * cell.diameter / numbers::PI * missed;
    EXPECT_NEAR(DataError(solution, stress).oscillation[0], expected, 1e-9 * expected);
  }
}

/** What stresses of the element lack of an initial stress is a stress: `|(f - Pi f) E|` of eps_0 = f E, with no other factor. */
TEST(DataErrorOfOneCell, IsWhatStressesLackOfAnInitialStress)
{
  for (const Rhombus &cell : rhombi)
  {
    const Scene<2> scene =
        loaded(cell, {{"Material/Initial strain", "0.2*sin(5*x); 0; 0.1*sin(5*x)"}});
    const RandomMesh mesh(scene, 1, 0, 2, 2);
    const Laboratory lab(scene, mesh);
    const Solution<2> solution = lab.solve();
    EquilibrationCache cache;
    const EquilibratedStress stress = equilibrated(solution, cache);
    const DataError data(solution, stress);
    const double size = std::sqrt(0.2 * 0.2 + 2 * 0.1 * 0.1);
    const double expected =
        size * missed_by_polynomials([](const Point<2> &x) { return std::sin(5 * x[0]); },
                                     map_of<2>(mesh.mesh.begin_active()), 3);
    EXPECT_GT(expected, 1e-4);
    EXPECT_NEAR(data.oscillation[0], expected, 1e-8 * expected);
    EXPECT_LT(data.missed_work, 1e-9);
  }
}

/** What no rule of the discrete equations knows of an initial strain does work on u_N, which may be anything. */
TEST(DataErrorOfOneCell, PaysForInitialStrainsThatNoRuleKnows)
{
  const Scene<2> scene =
      loaded(rhombi[0], {{"Material/Initial strain", "0; if(x > 0.37 + 0.3*y, 0.1, 0); 0"}});
  const RandomMesh mesh(scene, 1, 0, 2, 2);
  const Laboratory lab(scene, mesh);
  const Solution<2> solution = lab.solve();
  EquilibrationCache cache;
  const DataError data(solution, equilibrated(solution, cache));
  const double norm = std::sqrt(
      internal_forces(scene, lab.displacement_space, lab.tables, solution.u).energy_product);
  EXPECT_GT(data.unresolved, 1e-3);
  EXPECT_GE(data.missed_work, 0.99 * data.unresolved * norm);
}

/** Of a body of revolution the strain around the axis counts as those in the plane do, and all of it with the way around. */
TEST(InitialStressError, CountsTheWayAroundAnAxis)
{
  const auto error = [](const std::string &strain, const double radius)
  {
    const Scene<2> scene = scene_of({{"Geometry/Lower corner", in_digits(radius) + ", 0"},
                                     {"Geometry/Upper corner", in_digits(radius + 1) + ", 1"},
                                     {"Material/Plane", "axisymmetric"},
                                     {"Material/Initial strain", strain},
                                     given::clamped({"bottom"})});
    const RandomMesh mesh(scene, 1, 0, 2, 2);
    const Laboratory lab(scene, mesh);
    return initial_stress_error(scene, lab.displacement_space, *lab.solve().spaces->loads,
                                lab.tables);
  };
  const std::string jump = "if(y > 0.37 + 0.3*(x - floor(x)), 0.1, 0)";
  const double around = error("0; 0; 0; " + jump, 1);
  EXPECT_GT(around, 1e-4);
  EXPECT_NEAR(error(jump + "; 0; 0; 0", 1), around, 1e-9 * around);
  EXPECT_NEAR(std::pow(error("0; 0; 0; " + jump, 4001) / error("0; 0; 0; " + jump, 1000), 2), 4.,
              5e-3);
}

/** Steps share what they know of loads and initial strains in a cell, which changes with its degree, and not with the mesh around it. */
TEST(DataOfCells, AreKnownOfThoseThatStay)
{
  const auto check = [](const StepReport<2> &step, EquilibrationCache &cache)
  {
    const Solution<2> &solution = step.solution();
    const DisplacementSpace<2> &space = solution.displacement_space;
    EquilibrationCache empty;
    const EquilibratedStress stress = equilibrated(solution, cache),
                             anew = equilibrated(solution, empty);
    const LoadRules<2> &loads = *solution.spaces->loads,
                       fresh(solution.scene, *solution.spaces->mesh, solution.spaces->tables);
    for (const auto &cell : space.dof_handler().active_cell_iterators())
    {
      const unsigned int index = cell->active_cell_index(), p = space.degrees()[index];
      EXPECT_EQ(loads.initial_strain(cell, p).most_points,
                fresh.initial_strain(cell, p).most_points);
      EXPECT_GE(loads.body_force(cell, p).n_gauss, p + 2);
      EXPECT_EQ(stress.initial_stress_error(solution, index),
                anew.initial_stress_error(solution, index));
      EXPECT_EQ(stress.missed_force(index), anew.missed_force(index));
    }
  };
  // Of a linear force the degree decides how many points it has.
  const std::string force = "0; 0.1*sin(x/7)";
  for (const auto &[method, steps, own_force] :
       {std::tuple("pu", "7", force), {"pu", "7", "0; 0.01*x"}, {"hup2", "3", force}})
  {
    EquilibrationCache cache;
    each_step<2>(shipped_scene("bolt", {{"Error/Bound", "false"},
                                        {"Body force/Expression", own_force},
                                        given::steps(method, steps)}),
                 [&](const StepReport<2> &step) { check(step, cache); });
  }
}

/** J(U) of U = u_N + d is known but for (sigma(u_N) - s, eps(d)) and R(d): either end pays for these. */
TEST(ErrorBoundOfEnergy, PaysForWhatIsUnknownOfSupportsOutsideTheSpace)
{
  const Scene<2> scene = loaded(rhombi[0], {{"Boundary bottom/Displacement", "0; 0.1*sin(5*x)"},
                                            {"Boundary top/Traction", "0; cos(5*x)"}});
  const RandomMesh mesh(scene, 1, 0, 2, 2);
  const Laboratory lab(scene, mesh);
  const ErrorBound bound = ErrorBounds().compute(lab.solve(), lab.discretisation);
  ASSERT_EQ(bound.flaw, "");
  const double unknown = (bound.stress + bound.oscillation) * bound.data;
  EXPECT_GT(unknown, 1e-3 * bound.energy);
  EXPECT_NEAR(bound.energy_above + bound.energy_below - bound.energy, 2 * unknown,
              1e-9 * bound.energy);
}

/** Springs along a displacement that is prescribed and no polynomial: d moves them. */
Scene<2> square_on_springs(const std::string &k, const std::string &method,
                           const unsigned int steps)
{
  return scene_of({{"Boundary bottom/Displacement", "0.01*sin(5*x); 0.002*exp(x)"},
                   {"Boundary bottom/Spring", k + "; " + k},
                   {"Boundary top/Traction", "0.001; -0.002"},
                   given::steps(method, std::to_string(steps)),
                   {"Adaptivity/Tolerance", "0"},
                   {"Adaptivity/Maximum unknowns", "3000"}});
}

TEST(SpringBesideSupport, CountsInTheLift)
{
  const auto lift = [](const std::string &k)
  {
    double result = 0;
    each_step<2>(square_on_springs(k, "hup2", 1),
                 [&](const StepReport<2> &step)
                 {
                   ASSERT_TRUE(step.bound) << step.no_bound;
                   result = step.bound->data;
                 });
    return result;
  };
  // One edge of degree 2: what the parabolas through its ends and its middle miss.
  double square = 0;
  const QGauss<1> gauss(40);
  for (unsigned int q = 0; q < gauss.size(); ++q)
  {
    const double s = gauss.point(q)[0];
    const auto missed = [s](const auto &u)
    {
      return u(s) - u(0.) * (1 - s) * (1 - 2 * s) - u(0.5) * 4 * s * (1 - s) -
             u(1.) * s * (2 * s - 1);
    };
    square += gauss.weight(q) *
              (std::pow(missed([](const double x) { return 0.01 * std::sin(5 * x); }), 2) +
               std::pow(missed([](const double x) { return 0.002 * std::exp(x); }), 2));
  }
  EXPECT_NEAR(std::pow(lift("500"), 2) - std::pow(lift("0"), 2), 500 * square, 1e-3 * 500 * square);
}

TEST(SpringBesideSupport, IsCountedInTheEnergy)
{
  for (const std::string k : {"0.5", "50", "5000", "20*(1 + x)"})
  {
    double low = -1e300, high = 1e300;
    for (const std::string method : {"hpa3", "hup2", "hap4"})
      each_step<2>(square_on_springs(k, method, method == "hpa3" ? 10 : 3),
                   [&](const StepReport<2> &step)
                   {
                     ASSERT_TRUE(step.bound) << step.no_bound;
                     const double J = step.energies.energy, round_off = 1e-10 * std::abs(J);
                     low = std::max(low, J - step.bound->energy_below);
                     high = std::min(high, J + step.bound->energy_above);
                     EXPECT_LE(low, high + round_off) << k << ", " << method << ", " << step.number;
                   });
    EXPECT_LT(high - low, 1e-3 * std::abs(low)) << k;
  }
}
} // namespace
