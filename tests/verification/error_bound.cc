// SPDX-License-Identifier: LGPL-2.1-or-later
// The guaranteed bound of the error: is the stress admissible, seen by other means than its own, and is the
// error below the bound?
#include "discretisation.h"

#include <hpvi/bound/admissible_friction.h>
#include <hpvi/bound/admissible_pressure.h>
#include <hpvi/bound/contact_correction.h>
#include <hpvi/bound/error_bound.h>
#include <hpvi/results/solution_field.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace
{
using namespace verification;

using Stress = std::function<SymmetricTensor<2, 2>(double, double)>; ///< of xi, eta in [-1,1]

/** s on a cell, in x and y. */
Stress stress_of(const EquilibratedStress &stress, const unsigned int cell)
{
  return [s = stress.stress(cell), B = stress.frame(cell)](const double xi, const double eta)
  {
    const std::array<double, 3> c = s.value(xi, eta);
    Tensor<2, 2> S;
    S[0][0] = c[0];
    S[1][1] = c[1];
    S[0][1] = S[1][0] = c[2];
    return SymmetricTensor<2, 2>(symmetrize(B * S * transpose(B)));
  };
}

/** Central differences of order 8. */
SymmetricTensor<2, 2> derivative(const std::function<SymmetricTensor<2, 2>(double)> &f,
                                 const double x)
{
  const double h = 0.005;
  const std::array<double, 4> weights{{4. / 5, -1. / 5, 4. / 105, -1. / 280}};
  SymmetricTensor<2, 2> result;
  for (unsigned int k = 0; k < 4; ++k)
    result += weights[k] / h * (f(x + (k + 1) * h) - f(x - (k + 1) * h));
  return result;
}

/** The largest |div s + F| times cell size, at random points. */
double imbalance(const Solution<2> &solution, const EquilibratedStress &stress,
                 const unsigned int cell, std::mt19937 &random)
{
  std::uniform_real_distribution<double> uniform(
      -0.8, 0.8); // off the corners, where differences would fail
  const Stress s = stress_of(stress, cell);
  const CellMap<2> map = map_of<2>(stress.patches().cells()[cell].iterator);
  const Tensor<2, 2> inverse = invert(map.jacobian({0.5, 0.5})); // d xi/d x is twice that
  double largest = 0;
  for (unsigned int k = 0; k < 20; ++k)
  {
    const double xi = uniform(random), eta = uniform(random);
    const auto along_xi = derivative([&](const double t) { return s(t, eta); }, xi),
               along_eta = derivative([&](const double t) { return s(xi, t); }, eta);
    Tensor<1, 2> residual;
    for (unsigned int c = 0; c < 2; ++c)
    {
      for (unsigned int j = 0; j < 2; ++j)
        residual[c] += 2 * (along_xi[c][j] * inverse[0][j] + along_eta[c][j] * inverse[1][j]);
      if (solution.scene.body_force[c])
        residual[c] +=
            solution.scene.body_force[c]->value(map.point({(1 + xi) / 2, (1 + eta) / 2}));
    }
    largest = std::max(largest, map.longest_edge() * residual.norm());
  }
  return largest;
}

/** s n at place t in [0,1] of a whole edge, seen from one of its sides. */
Tensor<1, 2> traction(const EquilibratedStress &stress, const StressEdge &edge,
                      const StressEdge::Side &side, const double t)
{
  const double s = side.part == whole_edge ? t : 2 * t - side.part;
  const double along = 2 * s - 1, across = side.face % 2 ? 1. : -1.;
  const Stress value = stress_of(stress, side.cell);
  return (side.face < 2 ? value(across, along) : value(along, across)) * edge.normal;
}

struct Violations
{
  double divergence = 0, jumps = 0, loads = 0, friction = 0, pull = 0, push = 0, scale = 0;
};

/** By how much s is not admissible, point by point. */
Violations violations(const Solution<2> &solution, const EquilibratedStress &stress)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform;
  Violations result;
  for (unsigned int cell = 0; cell < stress.squares.size(); ++cell)
  {
    result.divergence = std::max(result.divergence, imbalance(solution, stress, cell, random));
    result.scale = std::max(result.scale, stress_of(stress, cell)(0.3, -0.2).norm());
  }
  for (const StressEdge &edge : stress.patches().edges())
    for (unsigned int k = 0; k < 12; ++k)
    {
      const double t = uniform(random);
      const Tensor<1, 2> own = traction(stress, edge, edge.sides[0], t);
      if (!edge.at_boundary())
      {
        const auto &other = edge.sides.size() == 2 ? edge.sides[1] : edge.sides[t < 0.5 ? 1 : 2];
        result.jumps = std::max(result.jumps, (own - traction(stress, edge, other, t)).norm());
        continue;
      }
      const auto &condition = solution.scene.boundaries[edge.boundary];
      const auto face =
          stress.patches().cells()[edge.sides[0].cell].iterator->face(edge.sides[0].face);
      const Point<2> x = face->vertex(0) + t * (face->vertex(1) - face->vertex(0));
      const double outward = edge.sides[0].face % 2 ? 1. : -1.;
      Tensor<1, 2> missed = outward * own;
      for (unsigned int c = 0; c < 2; ++c)
        if (condition.traction[c])
          missed[c] -= condition.traction[c]->value(x);
      if (condition.has_contact())
      {
        const double g = condition.friction.limit(x, 0.);
        result.friction = std::max(result.friction, std::abs(missed * edge.tangent) - g);
        if (condition.contact == Contact::unilateral)
        {
          result.pull = std::max(result.pull, own * edge.normal); // both along growing xi or eta
          result.push = std::max(result.push, -(own * edge.normal));
        }
        if (condition.contact == Contact::tangential)
          result.loads = std::max(result.loads, std::abs(missed * edge.normal));
      }
      else
        for (unsigned int c = 0; c < 2; ++c)
          if (!condition.displacement[c])
            result.loads = std::max(result.loads, std::abs(missed[c]));
    }
  return result;
}

EquilibratedStress equilibrated(const Solution<2> &solution, EquilibrationCache &cache,
                                const Solution<2> *const measured = nullptr,
                                const Volume volume = Volume::full)
{
  const AdmissibleFriction<2> friction(solution);
  const AdmissiblePressure<2> pressure(solution);
  return EquilibratedStress(
      solution,
      [&](const unsigned int face, const unsigned int end)
      { return friction.part(face, end).coefficients(); },
      [&](const unsigned int face, const unsigned int end)
      { return pressure.part(face, end).coefficients(); },
      cache, measured, volume);
}

struct Body
{
  std::string name, scene;
  Overrides overrides;
};

using Admissible = ::testing::TestWithParam<Body>;

void expect_admissible(const Solution<2> &solution, const EquilibratedStress &stress)
{
  const Violations found = violations(solution, stress);
  EXPECT_GT(found.scale, 1e-3);
  EXPECT_LE(found.divergence, 1e-10 * found.scale);
  EXPECT_LE(found.jumps, 1e-10 * found.scale);
  EXPECT_LE(found.loads, 1e-10 * found.scale);
  EXPECT_LE(found.friction, 1e-10 * found.scale);
  EXPECT_LE(found.pull, 1e-10 * found.scale);
  EXPECT_EQ(found.push > 0.01 * found.scale, solution.scene.has_unilateral_contact());
  EXPECT_LE(stress.defect, 1e-10); // relative to the tractions
}

/** On random meshes with hanging nodes and degrees 2 to 7; with the mixed method near incompressibility, too. */
TEST_P(Admissible, StressIsInEquilibriumAtEveryPoint)
{
  const Scene<2> scene = shipped_scene(GetParam().scene, GetParam().overrides);
  for (const unsigned int seed : {1, 2})
  {
    const RandomMesh mesh(scene, 2, seed, 2, 7);
    const Laboratory lab(scene, mesh);
    const Solution<2> solution = lab.solve();
    EquilibrationCache cache;
    expect_admissible(solution, equilibrated(solution, cache));
    if (!scene.is_nearly_incompressible())
      continue;
    SCOPED_TRACE("mixed");
    auto factor = std::make_unique<LinearSolver>(lab.discretisation.factor());
    const Solution<2> mixed = MixedProblem(scene).solve(solution, factor);
    expect_admissible(mixed, equilibrated(mixed, cache, &solution, Volume::projected));
  }
}

/** |s - sigma(u)|^2 of one cell by quadrature at points. */
double distance_square(const EquilibratedStress &stress, const unsigned int cell,
                       const Solution<2> &solution)
{
  const QGauss<1> gauss(12);
  const Stress s = stress_of(stress, cell);
  const auto &iterator = stress.patches().cells()[cell].iterator;
  const CellMap<2> map = map_of<2>(iterator);
  const Material &material = solution.scene.material_of(iterator);
  const HookesLaw<2> law(material);
  const double nu = material.lambda(2) / (2 * (material.lambda(2) + material.mu()));
  double sum = 0;
  for (unsigned int a = 0; a < gauss.size(); ++a)
    for (unsigned int b = 0; b < gauss.size(); ++b)
    {
      const Point<2> point(gauss.point(a)[0], gauss.point(b)[0]);
      const ShapeTable<2> table =
          tabulate<2>(solution.displacement_space.degrees()[cell], {point}, {1.}, false);
      const std::vector<double> d = evaluate(table.derivatives, solution.coefficients(cell));
      Tensor<2, 2> reference;
      for (unsigned int c = 0; c < 2; ++c)
        for (unsigned int j = 0; j < 2; ++j)
          reference[c][j] = d[c * 2 + j];
      const SymmetricTensor<2, 2> difference = s(2 * point[0] - 1, 2 * point[1] - 1) -
                                               law.stress(reference * invert(map.jacobian(point)));
      sum += gauss.weight(a) * gauss.weight(b) * determinant(map.jacobian(point)) *
             (difference * difference - nu * std::pow(trace(difference), 2)) / (2 * material.mu());
    }
  return sum;
}

/** From the displacement with which the stress is in balance, and from another. */
TEST(Equilibration, EnergyIsThatOfTheStresses)
{
  const Scene<2> scene = shipped_scene("stick-slip");
  const RandomMesh mesh(scene, 2, 3, 2, 6);
  const Laboratory lab(scene, mesh);
  const Solution<2> solution = lab.solve();
  Vector<double> u(solution.u);
  for (unsigned int i = 0; i < u.size(); ++i)
    u[i] *= 1. + 0.01 * (i % 7);
  const Solution<2> other(scene, solution.spaces, u, solution.z);
  EquilibrationCache cache;
  const EquilibratedStress own = equilibrated(solution, cache);
  for (unsigned int cell = 0; cell < own.squares.size(); ++cell)
  {
    const double square = distance_square(own, cell, solution);
    EXPECT_NEAR(own.squares[cell], square, 1e-9 * square + 1e-20);
  }
  const EquilibratedStress stress = equilibrated(solution, cache, &other);
  EXPECT_GT(std::abs(stress.squares[0] - own.squares[0]), 1e-3 * own.squares[0]);
  for (unsigned int cell = 0; cell < stress.squares.size(); ++cell)
  {
    const double square = distance_square(stress, cell, other);
    EXPECT_NEAR(stress.squares[cell], square, 1e-9 * square + 1e-20);
  }
}

const std::string rotated = "1, 0; 3, 1; 2.5, 2; 0.5, 1", // a rectangle
    skew = "0, 0; 4, 0; 6, 2; 2, 2";                      // at 45 degrees

INSTANTIATE_TEST_SUITE_P(
    Bodies, Admissible,
    ::testing::Values(
        Body{"exact", "stick-slip", {}}, Body{"strain", "plane-strain", {}},
        Body{"corners", "han-6-12", {}}, Body{"overhang", "han-6-13", {}},
        Body{"nearlyIncompressible", "plane-strain", {{"Material/Poisson's ratio", "0.4999"}}},
        Body{"nearlyIncompressibleParallelogram",
             "han-6-12-unilateral",
             {given::quadrilateral("Geometry", rotated),
              {"Material/Plane", "strain"},
              {"Material/Poisson's ratio", "0.4999"}}},
        Body{"bodyForce", "han-6-12", {{"Body force/Expression", "0.3; -2"}}},
        Body{"free", "semicoercive", {}},
        Body{"held", "han-6-12", {{"Boundary top/Displacement", "free; 0"}}},
        Body{"twoContacts", "han-6-12", {given::rough("top", "bilateral", "3")}},
        Body{"tangential", "han-6-12", {{"Boundary bottom/Contact", "tangential"}}},
        Body{"parallelogram", "han-6-12", {given::quadrilateral("Geometry", rotated)}},
        Body{"skew", "han-6-12", {given::quadrilateral("Geometry", skew)}},
        Body{"skewRoller",
             "han-6-12",
             {given::quadrilateral("Geometry", skew),
              {"Boundary top/Displacement", "free; 0"},
              {"Boundary left/Displacement", "0; free"},
              {"Boundary left/Traction", "0; 1"}}},
        Body{"skewSides",
             "han-6-12",
             {given::quadrilateral("Geometry", skew),
              {"Boundary right/Displacement", ""},
              given::rough("right", "bilateral", "1"),
              {"Boundary top/Displacement", "0; free"}}},
        Body{"skewOpens",
             "han-6-12-unilateral",
             {given::quadrilateral("Geometry", skew), {"Boundary top/Traction", "0; -2"}}},
        Body{"opens", "han-6-12-unilateral", {}},
        Body{"opensByMoments", "han-6-12-unilateral", {{"Solver/Normal contact", "multiplier"}}},
        Body{"opensOnAParallelogram",
             "han-6-12-unilateral",
             {given::quadrilateral("Geometry", rotated)}},
        Body{"cylinder", "hertz", {}}, Body{"punch", "punch", {}},
        Body{"longCells", "han-6-12", {{"Geometry/Subdivisions", "16, 1"}}},
        Body{"longSlantedCells",
             "han-6-12",
             {given::quadrilateral("Geometry", rotated, "1, 8"),
              {"Boundary top/Displacement", "free; 0"}}}),
    [](const ::testing::TestParamInfo<Body> &info) { return info.param.name; });

/** The least root over lambda, on a grid, of what Theorem (E) of doc/bound.md asks of its parts. */
double least_root(const ErrorBound &bound)
{
  double w_square = 0, b_square = 0, least = std::numeric_limits<double>::infinity();
  for (unsigned int cell = 0; cell < bound.moved.size(); ++cell)
  {
    w_square += std::max(0., bound.moved[cell]);
    b_square += std::pow(std::sqrt(std::max(0., bound.moved[cell])) + bound.lifted[cell], 2);
  }
  const double slip_square = bound.slip * bound.slip, two_gaps = slip_square - w_square,
               A_square = std::accumulate(bound.squares.begin(), bound.squares.end(), -slip_square);
  for (unsigned int k = 1; k <= 1000; ++k)
  {
    const double lambda = k / 1000., nu = 1 - lambda, half = nu * lambda * std::sqrt(b_square),
                 rest = 1 - nu * nu;
    least = std::min(least, (half + std::sqrt(half * half + rest * (A_square + lambda * two_gaps +
                                                                    lambda * lambda * b_square))) /
                                rest);
  }
  return least;
}

/** Largest and smallest quotient of bound and error over the steps of a run. */
std::pair<double, double> effectivities(const Scene<2> &scene, const double floor)
{
  double largest = 0, smallest = std::numeric_limits<double>::infinity();
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        ASSERT_TRUE(step.bound);
        EXPECT_NEAR(step.bound->total, least_root(*step.bound), 1e-4 * step.bound->total);
        if (step.errors.energy < floor * step.energies.norm)
          return;
        largest = std::max(largest, step.bound->total / step.errors.energy);
        smallest = std::min(smallest, step.bound->total / step.errors.energy);
      });
  return {smallest, largest};
}

TEST(ErrorBoundOfUnilateralContact, IsAboveTheErrorAndNear)
{
  for (const std::string contact : {"nodes", "multiplier"})
    for (const std::string method : {"hpa3", "hap4", "hup2"})
    {
      SCOPED_TRACE(contact + " " + method);
      const auto [smallest, largest] =
          effectivities(shipped_scene("hertz", {{"Solver/Normal contact", contact},
                                                given::steps(method, method == "hup2" ? "4" : "12"),
                                                {"Adaptivity/Indicator", "bound"}}),
                        1e-9);
      EXPECT_GE(smallest, 1.);
      EXPECT_LE(largest, 1.8);
    }
}

/** What a gap that is no polynomial has between the nodes counts as data. */
TEST(ErrorBoundOfUnilateralContact, SeesTheGapBetweenNodes)
{
  each_step<2>(shipped_scene("han-6-12-unilateral", {{"Boundary bottom/Gap", "0.01*(1 - cos(x))"},
                                                     {"Adaptivity/Maximum steps", "2"}}),
               [](const StepReport<2> &step)
               {
                 ASSERT_TRUE(step.bound) << step.no_bound;
                 EXPECT_GT(step.bound->data, 1e-7);
               });
}

/** A body that lies on waves between the nodes: the bound holds beside a finer run, both by their distance and their energies. */
TEST(ErrorBoundOfUnilateralContact, PaysForWavesOfTheGap)
{
  const Overrides scene = {
      {"Material/Poisson's ratio", "0.3"},        {"Geometry/Subdivisions", "2, 1"},
      {"Boundary top/Displacement", "0; -0.02"},  {"Boundary bottom/Contact", "unilateral"},
      {"Boundary bottom/Gap", "0.002*cos(11*x)"}, {"Adaptivity/Tolerance", "0"}};
  const auto with = [&](Overrides more)
  {
    more.insert(more.end(), scene.begin(), scene.end());
    return scene_of(more);
  };
  const std::string file = ::testing::TempDir() + "waves-" + std::to_string(std::random_device()());
  double low = 0, high = 0, of_reference = 0;
  each_step<2>(with({given::steps("hpa3", "9")}),
               [&](const StepReport<2> &step)
               {
                 ASSERT_TRUE(step.bound) << step.no_bound;
                 std::ofstream out(file);
                 write_solution(out, step.field, step.energies.energy);
                 of_reference = step.bound->total;
                 low = step.energies.energy - step.bound->energy_below;
                 high = step.energies.energy + step.bound->energy_above;
               });
  each_step<2>(with({given::steps("hup2", "3"), {"Error/Reference solution", file}}),
               [&](const StepReport<2> &step)
               {
                 ASSERT_TRUE(step.bound) << step.no_bound;
                 EXPECT_LT(of_reference, 0.05 * step.errors.energy);
                 EXPECT_GE(step.bound->total, step.errors.energy - of_reference);
                 EXPECT_LE(step.bound->total, 3 * step.errors.energy);
                 EXPECT_LE(step.energies.energy - step.bound->energy_below, high);
                 EXPECT_GE(step.energies.energy + step.bound->energy_above, low);
               });
  std::filesystem::remove(file);
}

/** A body that is held at the end of its contact, above the foundation: what penetrates elsewhere moves nothing there. */
TEST(ErrorBoundOfUnilateralContact, IsNearWhereTheHeldEndIsOpen)
{
  for (const std::string contact : {"nodes", "multiplier"})
    each_step<2>(scene_of({given::box("2, 1", "2, 1"),
                           {"Boundary right/Displacement", "0; 0"},
                           {"Boundary top/Traction", "0; -0.1"},
                           {"Boundary bottom/Contact", "unilateral"},
                           {"Boundary bottom/Gap", "0.02 + 0.02*x"},
                           {"Solver/Normal contact", contact},
                           given::steps("hup2", "1")}),
                 [](const StepReport<2> &step)
                 {
                   ASSERT_TRUE(step.bound) << step.no_bound;
                   EXPECT_LT(step.bound->slip,
                             1.5 * step.bound->stress); // 2.4 to 2.7 times otherwise
                 });
}

/** Tangent and normal are the unknowns at the vertices there; w is small beside the error. */
TEST(ErrorBoundOfUnilateralContact, IsNearOnASlantedBoundary)
{
  each_step<2>(shipped_scene("han-6-12-unilateral", {given::quadrilateral("Geometry", rotated),
                                                     {"Adaptivity/Maximum steps", "12"}}),
               [](const StepReport<2> &step)
               {
                 ASSERT_TRUE(step.bound) << step.no_bound;
                 EXPECT_LT(step.bound->slip, step.bound->stress);
               });
}

using Effectivity = ::testing::TestWithParam<Body>;

TEST_P(Effectivity, BoundIsAboveTheErrorAndNear)
{
  const auto [smallest, largest] =
      effectivities(shipped_scene(GetParam().scene, GetParam().overrides), 1e-10);
  EXPECT_GE(smallest, 1.);
  EXPECT_LE(largest, 1.8);
}

INSTANTIATE_TEST_SUITE_P(
    Runs, Effectivity,
    ::testing::Values(Body{"hpa3", "stick-slip", {}},
                      Body{"hpa3ByBound", "stick-slip", {{"Adaptivity/Indicator", "bound"}}},
                      Body{"hpa2", "stick-slip", {{"Adaptivity/Method", "hpa2"}}},
                      Body{"hap4", "stick-slip", {given::steps("hap4", "8", "4")}},
                      Body{"hup2", "stick-slip", {given::steps("hup2", "5", "2")}},
                      Body{"strain", "plane-strain", {}}, Body{"smooth", "smooth", {}}),
    [](const ::testing::TestParamInfo<Body> &info) { return info.param.name; });

/** Nothing of a bound is missing and nothing counts twice, in the whole or in what the cells are marked by. */
TEST(ErrorBoundParts, MakeTheWhole)
{
  const auto sum = [](const std::vector<double> &values)
  { return std::accumulate(values.begin(), values.end(), 0.); };
  unsigned int n_with_gap = 0, n_with_energy = 0;
  for (const unsigned int seed : {1, 2, 3, 4})
  {
    // Loads are polynomials, supports hold at zero: stress and slip are all there is.
    const Scene<2> scene = shipped_scene(seed % 2 ? "han-6-12" : "han-6-13");
    const RandomMesh mesh(scene, seed, 1, 2, 5);
    const Laboratory lab(scene, mesh);
    const Solution<2> solution = lab.solve();
    const ErrorBound bound = ErrorBounds().compute(solution, lab.discretisation);
    EquilibrationCache cache;
    const EquilibratedStress stress = equilibrated(solution, cache);
    EdgeBubbles bubbles;
    const ContactCorrection<2> slip(solution, lab.discretisation, AdmissibleFriction<2>(solution),
                                    AdmissiblePressure<2>(solution), &bubbles);
    const double eta_square = sum(stress.squares), small = 1e-9 * eta_square;
    n_with_gap += sum(slip.gap()) > 1e4 * small;
    n_with_energy += sum(slip.energy()) > 1e4 * small;
    ASSERT_LT(bound.oscillation, 1e-10 * bound.stress);
    ASSERT_EQ(bound.data, 0.);
    const double square = eta_square + slip.total();
    EXPECT_NEAR(std::pow(bound.total, 2), square, small);
    EXPECT_NEAR(std::pow(bound.slip, 2), slip.total(), small);
    EXPECT_NEAR(bound.energy, eta_square / 2 + sum(slip.uncorrected_gap()), small);
    std::vector<double> shares = stress.squares;
    for (unsigned int cell = 0; cell < shares.size(); ++cell)
      shares[cell] += slip.energy()[cell];
    const auto &faces = solution.contact_space.faces();
    for (unsigned int face = 0; face < faces.size(); ++face)
      shares[faces[face].cell->active_cell_index()] += 2 * slip.gap()[face];
    for (unsigned int cell = 0; cell < shares.size(); ++cell)
    {
      EXPECT_NEAR(bound.squares[cell], shares[cell], small) << cell;
      EXPECT_NEAR(std::pow(bound.indicators()[cell], 2), shares[cell], small);
    }
  }
  EXPECT_GE(n_with_gap, 2u);
  EXPECT_GE(n_with_energy, 2u);
}

/** Where friction changes inside an edge, what is no polynomial of the space there makes up for it. */
TEST(ErrorBoundInsideAnEdge, IsAboveTheErrorAndNear)
{
  for (const auto &[method, near] : std::vector<std::pair<std::string, double>>{
           {"hpa2", 1.55}, {"hpa3", 1.55}, {"hap4", 1.5}, {"hup2", 1.4}})
  {
    const auto [smallest, largest] = effectivities(
        shipped_scene("stick-slip", {{"Exact solution/Transition", "0.1"},
                                     {"Adaptivity/Indicator", "bound"},
                                     given::steps(method, method == "hup2" ? "6" : "8")}),
        1e-10);
    EXPECT_GE(smallest, 1.) << method;
    EXPECT_LE(largest, near) << method;
  }
}

/** Where g varies between the points of the multiplier, u_N is not what the stress is in balance with. */
TEST(ErrorBoundOfAVaryingBound, IsAboveTheErrorAndNear)
{
  const auto scene =
      [](const std::string &method, const std::string &unknowns, const std::string &reference)
  {
    return shipped_scene("han-6-12", {{"Boundary bottom/Friction bound", "4.5*(1 + 0.3*sin(5*x))"},
                                      given::steps(method, "40"),
                                      {"Adaptivity/Maximum unknowns", unknowns},
                                      {"Error/Reference solution", reference}});
  };
  const ReferenceFile reference(scene("hpa2", "15000", ""));
  for (const auto &[method, near] :
       std::vector<std::pair<std::string, double>>{{"hup2", 1.3}, {"hap4", 1.45}, {"hpa3", 1.35}})
  {
    const auto [smallest, largest] = effectivities(scene(method, "1500", reference.path), 1e-4);
    EXPECT_GE(smallest, 1.) << method;
    EXPECT_LE(largest, near) << method;
  }
}

/** With the pressure of u_N, which oscillates, it would be up to 100 times the error. */
TEST(ErrorBoundNearIncompressibility, IsAboveTheErrorAndNear)
{
  for (const auto &[method, poisson, near] :
       std::vector<std::tuple<std::string, std::string, double>>{{"hpa3", "0.4999", 1.8},
                                                                 {"hap4", "0.4999", 1.6},
                                                                 {"hup2", "0.4999", 1.1},
                                                                 {"hup2", "0.499999", 1.1},
                                                                 {"hap4", "0.499999", 2.}})
  {
    SCOPED_TRACE(method + " " + poisson);
    const auto [smallest, largest] = effectivities(
        shipped_scene("plane-strain", {{"Material/Poisson's ratio", poisson},
                                       given::steps(method, method == "hpa3" ? "10" : "4", "0")}),
        1e-9);
    EXPECT_GE(smallest, 1.);
    EXPECT_LE(largest, near);
  }
}

/** The stress of u_N where it locks, if it is taken for near; else the one that is nearer, which is remembered. */
TEST(ErrorBoundNearIncompressibility, ComparesTwoStressesUntilOneWillDo)
{
  const double any = std::numeric_limits<double>::infinity();
  const auto bounds_of = [](const unsigned int degree, const std::string &subdivisions,
                            const std::vector<double> &own_stresses)
  {
    const Scene<2> scene = shipped_scene("plane-strain", {{"Material/Poisson's ratio", "0.4999"},
                                                          {"Geometry/Subdivisions", subdivisions}});
    const RandomMesh mesh(scene, 1, 0, degree, degree);
    const Laboratory lab(scene, mesh);
    const Solution<2> solution = lab.solve();
    std::vector<ErrorBound> result;
    ErrorBounds bounds;
    for (const double hysteresis : own_stresses)
      result.push_back(bounds.compute(solution, lab.discretisation, nullptr, hysteresis));
    return result;
  };
  const std::vector<ErrorBound> locking = bounds_of(4, "4, 2", {0., any, 1e-20});
  EXPECT_EQ(locking[0].hysteresis, 0.);
  EXPECT_GT(locking[1].stress, 3. * locking[0].stress);
  EXPECT_EQ(locking[1].hysteresis, locking[1].stress);
  EXPECT_EQ(locking[2].stress, locking[0].stress); // farther than in the step before
  const std::vector<ErrorBound> free = bounds_of(8, "16, 8", {0., any});
  EXPECT_EQ(free[1].hysteresis, free[1].stress);
  EXPECT_EQ(free[0].hysteresis, free[1].stress);
  EXPECT_LE(free[0].stress, free[1].stress);
  EXPECT_LE(free[1].stress, 1.1 * free[0].stress);
  EXPECT_EQ(bounds_of(2, "16, 8", {0.})[0].hysteresis, 0.);
}

/** Where the body slips as it is, far from where slip ends, there is nothing for w to mend. */
TEST(ErrorBoundOfSlip, MovesNothingFarFromWhereSlipEnds)
{
  for (const std::string poisson : {"0.3", "0.4999"})
  {
    const Scene<2> scene = shipped_scene("plane-strain", {{"Material/Poisson's ratio", poisson},
                                                          {"Geometry/Subdivisions", "32, 8"}});
    const RandomMesh mesh(scene, 1, 0, 3, 3);
    const Laboratory lab(scene, mesh);
    const Solution<2> solution = lab.solve();
    EdgeBubbles bubbles;
    const ContactCorrection<2> slip(solution, lab.discretisation, AdmissibleFriction<2>(solution),
                                    AdmissiblePressure<2>(solution), &bubbles);
    double near = 0;
    for (const ContactFace<2> &face : solution.contact_space.faces())
    {
      const double energy = slip.energy()[face.cell->active_cell_index()], x = face.point(0.5)[0];
      near += energy;
      EXPECT_TRUE(energy == 0. || x > -0.4) << x; // slips up to 0
    }
    EXPECT_GT(near, 0.);
  }
}

/** |d - w|_a by cells: w is along the contact boundary, data are missed elsewhere. */
TEST(ErrorBound, AddsCorrectionAndDataCellByCell)
{
  each_step<2>(shipped_scene("plane-strain", {{"Material/Poisson's ratio", "0.4999"},
                                              {"Adaptivity/Indicator", "bound"},
                                              {"Adaptivity/Maximum steps", "3"}}),
               [](const StepReport<2> &step)
               {
                 ASSERT_TRUE(step.bound) << step.no_bound;
                 const ErrorBound &bound = *step.bound;
                 ASSERT_GT(bound.data, 0.);
                 ASSERT_LT(bound.oscillation, 1e-12 * bound.total); // round-off
                 const double least = std::hypot(bound.stress, bound.slip);
                 EXPECT_GE(bound.total * (1. + 1e-11), std::hypot(least, bound.data));
                 EXPECT_LT(bound.total, 0.999 * std::hypot(bound.stress, bound.slip + bound.data));
               });
}

/** (J): the intervals of all steps have a point in common, and shrink. */
TEST(ErrorBoundOfEnergy, IntervalsHoldTheLeastEnergy)
{
  const std::string bound = "Boundary bottom/Friction bound";
  for (const auto &[name, g] :
       std::vector<std::pair<std::string, std::string>>{{"han-6-12", ""},
                                                        {"han-6-13", ""},
                                                        {"han-6-12-unilateral", ""},
                                                        {"resting", ""},
                                                        {"smooth", ""},
                                                        {"hertz", ""},
                                                        {"han-6-12", "2 + x"},
                                                        {"han-6-12", "4.5*(1 + 0.3*sin(5*x))"},
                                                        {"han-6-12", "if(x < 1.9, 2, 5)"}})
  {
    SCOPED_TRACE(name + " " + g);
    double above = std::numeric_limits<double>::infinity(), below = -above, widest = 0;
    bool counts_loads_once = false; // the second theorem is the better one
    Overrides overrides = {{"Adaptivity/Indicator", "bound"}, {"Adaptivity/Maximum steps", "12"}};
    if (!g.empty())
      overrides.emplace_back(bound, g);
    const Scene<2> scene = shipped_scene(name, overrides);
    AdaptiveSolver<2>(scene).run(
        [&](const StepReport<2> &step)
        {
          ASSERT_TRUE(step.bound);
          EXPECT_GE(step.bound->energy_above + step.bound->energy_below, 0.);
          if (g.empty() && step.bound->data == 0. && !scene.has_unilateral_contact())
          {
            EXPECT_EQ(step.bound->energy_above, 0.);
            EXPECT_EQ(step.bound->energy_below, step.bound->energy);
          }
          counts_loads_once |=
              step.bound->total <
              0.99 * (step.bound->oscillation + std::hypot(step.bound->stress, step.bound->slip));
          // Either proof pays for the stress, and none for more than all parts together.
          EXPECT_GE(step.bound->total * (1 + 1e-12), step.bound->stress);
          EXPECT_LE(step.bound->total * (1 - 1e-12),
                    2 * step.bound->oscillation + step.bound->data +
                        std::hypot(step.bound->stress, step.bound->slip));
          above = std::min(above, step.energies.energy + step.bound->energy_above);
          below = std::max(below, step.energies.energy - step.bound->energy_below);
          widest = std::max(widest, step.bound->energy);
        });
    EXPECT_TRUE(counts_loads_once || g != "if(x < 1.9, 2, 5)");
    EXPECT_LE(below, above + 1e-14 * std::abs(above)); // the smooth one is exact to round-off
    EXPECT_LT(above - below, 2e-3 * widest);
  }
}
/** One scene, told in some frame: entries of its sides, from the one between the first two corners on. */
struct ToldScene
{
  std::string name;
  std::array<Point<2>, 4> corners;
  std::array<unsigned int, 2> subdivisions;
  std::array<Overrides, 4> sides; ///< X and Y: coordinates of the body
  std::array<Tensor<1, 2>, 4> displacements;
  Overrides others;
  double
      far; ///< how far away it is told: where g varies, its expression has no more than a few digits
};

/** `x = turn X + (shift, 0)`, sides named from another corner on. */
Scene<2> told(const ToldScene &scene, const Tensor<2, 2> &turn, const double shift,
              const unsigned int first)
{
  const std::array<std::string, 4> names = {{"bottom", "right", "top", "left"}};
  const bool is_mirrored = determinant(turn) < 0;
  Overrides entries = scene.others;
  entries.emplace_back("Geometry/Shape", "quadrilateral");
  std::string corners;
  for (unsigned int k = 0; k < 4; ++k)
  {
    const unsigned int side = (is_mirrored ? first + 3 - k : first + k) % 4;
    const Tensor<1, 2> corner = turn * scene.corners[(side + (is_mirrored ? 1 : 0)) % 4];
    corners += (k == 0 ? "" : "; ") + in_digits(corner[0] + shift) + ", " + in_digits(corner[1]);
    for (auto [entry, value] : scene.sides[side])
    {
      if (const auto X = value.find('X'); X != std::string::npos)
        value.replace(X, 1,
                      "(" + in_digits(turn[0][0]) + "*(x - " + in_digits(shift) + ") + " +
                          in_digits(turn[1][0]) + "*y)");
      entries.emplace_back("Boundary " + names[k] + "/" + entry, value);
    }
    if (const Tensor<1, 2> u = turn * scene.displacements[side]; u.norm() > 0)
      entries.emplace_back("Boundary " + names[k] + "/Displacement",
                           in_digits(u[0]) + "; " + in_digits(u[1]));
  }
  const unsigned int along = first % 2 == (is_mirrored ? 0 : 1);
  entries.emplace_back("Geometry/Corners", corners);
  entries.emplace_back("Geometry/Subdivisions", std::to_string(scene.subdivisions[along]) + ", " +
                                                    std::to_string(scene.subdivisions[1 - along]));
  return scene_of(entries);
}

const Overrides three_steps = {{"Material/Young's modulus", "10"}, given::steps("hpa3", "3")};
const Overrides more_steps = {{"Material/Young's modulus", "10"}, given::steps("hpa1", "4")};
const std::array<Point<2>, 4> leaning = {{{0, 0}, {1.5, 0}, {1.8, 1.2}, {0.3, 1.2}}},
                              upright = {{{0, 0}, {1.5, 0}, {1.5, 1.2}, {0, 1.2}}};

/** What round-off could decide is decided alike: whether cells are parallelograms, which one takes a corner's shear ... */
TEST(ErrorBoundInAnotherFrame, IsTheSame)
{
  const Overrides unilateral = {{"Contact", "unilateral"}, {"Friction bound", "0.01"}},
                  opens = {{"Contact", "unilateral"}, {"Gap", "0.01"}, {"Friction bound", "0.01"}},
                  slips = {{"Contact", "bilateral"}, {"Friction bound", "0.02"}},
                  sticks = {{"Contact", "unilateral"},
                            {"Gap", "0.01*exp(-X)"},
                            {"Friction bound", "1"}},
                  rubs_in_part = {{"Contact", "bilateral"},
                                  {"Friction bound", "0.05*max(0, X - 0.61)"}},
                  rubs = {{"Contact", "tangential"}, {"Friction bound", "0.02"}},
                  held = {{"Displacement", "0; 0"}}, loaded = {{"Pressure", "0.1"}},
                  plate = {{"Rigid", "true"}}, free;
  const Tensor<1, 2> none, down({0.004, -0.02}), along_left({-0.005, -0.02}),
      sideways({0.01, 0.005});
  const std::vector<ToldScene> scenes = {{"leaning",
                                          leaning,
                                          {{4, 2}},
                                          {{free, free, free, opens}},
                                          {{none, none, down, none}},
                                          three_steps,
                                          12345},
                                         {"pressed",
                                          leaning,
                                          {{3, 2}},
                                          {{unilateral, free, free, free}},
                                          {{none, none, down, none}},
                                          three_steps,
                                          12345},
                                         {"two contacts",
                                          upright,
                                          {{1, 2}},
                                          {{opens, free, free, opens}},
                                          {{none, none, down, none}},
                                          three_steps,
                                          12345},
                                         {"corner that slides along a slanted side",
                                          leaning,
                                          {{2, 3}},
                                          {{sticks, free, free, slips}},
                                          {{none, none, along_left, none}},
                                          three_steps,
                                          12345},
                                         {"slip on either side of stick",
                                          upright,
                                          {{4, 2}},
                                          {{slips, free, free, free}},
                                          {{none, none, down, none}},
                                          three_steps,
                                          12345},
                                         {"bound that vanishes in part",
                                          upright,
                                          {{2, 2}},
                                          {{rubs_in_part, free, free, free}},
                                          {{none, none, down, none}},
                                          three_steps,
                                          1},
                                         {"plate beside a gap",
                                          upright,
                                          {{3, 1}},
                                          {{opens, held, loaded, plate}},
                                          {{none, none, none, none}},
                                          three_steps,
                                          12345},
                                         {"halves beyond contact",
                                          upright,
                                          {{2, 2}},
                                          {{rubs, free, free, rubs}},
                                          {{none, none, sideways, none}},
                                          more_steps,
                                          1}};
  const Tensor<2, 2> as_it_is({{1, 0}, {0, 1}}), mirrored({{-1, 0}, {0, 1}}),
      turned({{std::cos(0.6), -std::sin(0.6)}, {std::sin(0.6), std::cos(0.6)}});
  const auto run = [](const Scene<2> &scene)
  {
    std::vector<std::array<double, 2>> result; // unknowns and bound of each step
    AdaptiveSolver<2>(scene).run(
        [&](const StepReport<2> &step)
        {
          EXPECT_TRUE(step.bound) << step.no_bound;
          result.push_back({{double(step.solution().displacement_space.n_free_dofs()),
                             step.bound ? step.bound->total : 0.}});
        });
    return result;
  };
  for (const ToldScene &scene : scenes)
  {
    const auto own = run(told(scene, as_it_is, 0, 0));
    const std::vector<Scene<2>> others = {told(scene, as_it_is, scene.far, 0),
                                          told(scene, mirrored, 0, 0), told(scene, turned, 0, 0),
                                          told(scene, as_it_is, 0, 1)};
    for (unsigned int k = 0; k < others.size(); ++k)
    {
      SCOPED_TRACE(scene.name + " in frame " + std::to_string(k));
      const auto other = run(others[k]);
      ASSERT_EQ(own.size(), other.size());
      for (unsigned int step = 0; step < own.size(); ++step)
      {
        EXPECT_EQ(own[step][0], other[step][0]);
        EXPECT_NEAR(other[step][1] / own[step][1], 1., 1e-6);
      }
    }
  }
}
} // namespace
