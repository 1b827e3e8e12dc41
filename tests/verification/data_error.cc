// SPDX-License-Identifier: LGPL-2.1-or-later
// What the bound of the error pays for loads and displacements that are no polynomials: its constants, worked out by hand.
#include "discretisation.h"

#include <hpvi/equilibration/data_error.h>
#include <hpvi/equilibration/error_bound.h>

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
  Overrides entries = {
      {"Geometry/Shape", "quadrilateral"}, {"Geometry/Corners", cell.corners},
      {"Geometry/Subdivisions", "1, 1"},   {"Material/Young's modulus", "1"},
      {"Material/Poisson's ratio", "0"},   {"Boundary bottom/Displacement", "0; 0"}};
  entries.insert(entries.end(), loads.begin(), loads.end());
  return scene_of(entries);
}

EquilibratedStress equilibrated(const Solution<2> &solution, EquilibrationCache &cache)
{
  const EquilibratedStress::Parts none = [](unsigned int, unsigned int)
  { return std::vector<double>(); };
  return EquilibratedStress(solution, none, none, cache);
}

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
    const Scene<2> scene = loaded(cell, {{"Boundary top/Traction", "0; cos(5*x)"}});
    const RandomMesh mesh(scene, 1, 0, 2, 2);
    const Laboratory lab(scene, mesh);
    const Solution<2> solution = lab.solve();
    EquilibrationCache cache;
    const EquilibratedStress stress = equilibrated(solution, cache);
    const double missed = missed_on_top(stress, scene), part = cell.diameter / numbers::PI;
    EXPECT_GT(missed, 0.01);
    const double expected = cell.korn * std::sqrt((part + 2) * part / cell.height) * missed;
    EXPECT_NEAR(DataError(solution, stress).oscillation[0], expected, 1e-9 * expected);
  }
}

/** Those of Korn and of Poincaré: `korn d/pi |F - Pi F|`. */
TEST(DataErrorOfOneCell, HasTheConstantsOfBodyForces)
{
  for (const Rhombus &cell : rhombi)
  {
    const Scene<2> scene = loaded(cell, {{"Body force/Expression", "0; cos(5*x)"}});
    const RandomMesh mesh(scene, 1, 0, 2, 2);
    const Laboratory lab(scene, mesh);
    const Solution<2> solution = lab.solve();
    EquilibrationCache cache;
    const EquilibratedStress stress = equilibrated(solution, cache);
    const double missed = stress.missed_force(0);
    EXPECT_GT(missed, 1e-4);
    const double expected = cell.korn * cell.diameter / numbers::PI * missed;
    EXPECT_NEAR(DataError(solution, stress).oscillation[0], expected, 1e-9 * expected);
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
} // namespace
