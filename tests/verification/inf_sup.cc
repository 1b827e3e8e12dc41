// SPDX-License-Identifier: LGPL-2.1-or-later
// The discrete inf-sup constant: bounded below for degree p - 2, falling or zero above.
#include "discretisation.h"

#include <hpvi/inf_sup.h>

namespace
{
using namespace verification;

/** beta on the square of Example 5.2 in @p n by @p n cells of degree @p p. */
double beta(const unsigned int n, const unsigned int p, const int offset,
            const Overrides &more = {})
{
  const std::string cells = std::to_string(n) + ", " + std::to_string(n);
  Overrides entries = {{"Geometry/Subdivisions", cells},
                       {"Solver/Multiplier degree offset", std::to_string(offset)}};
  entries.insert(entries.end(), more.begin(), more.end());
  const auto scene = Scene<2>::read("prm/han-6-12.prm", entries, SceneUse::measure);
  Triangulation<2> mesh;
  make_mesh(scene, mesh);
  const Degrees degrees(mesh.n_active_cells(), p);
  return measure_inf_sup(scene, mesh, degrees, ShapeTables<2>()).beta;
}

TEST(InfSup, DoesNotDependOnTheMeshForTheThesisPair)
{
  for (const unsigned int p : {2U, 3U, 4U, 8U})
  {
    const double coarse = beta(4, p, -2), fine = beta(16, p, -2);
    EXPECT_GT(coarse, 0.8) << "p = " << p;
    EXPECT_LT(coarse, 1.) << "p = " << p;
    EXPECT_NEAR(fine, coarse, 0.02) << "p = " << p;
  }
}

TEST(InfSup, StaysAwayFromZeroAsTheDegreeGrows)
{
  // The proven bound falls by a factor 9 from p = 2 to 12; measured is 0.910 to 0.797.
  for (unsigned int p = 2; p <= 12; ++p)
    EXPECT_GT(beta(4, p, -2), 0.79) << "p = " << p;
}

TEST(InfSup, FallsLikeTheMeshSizeOneDegreeHigher)
{
  const double b4 = beta(4, 2, -1), b8 = beta(8, 2, -1), b16 = beta(16, 2, -1);
  EXPECT_LT(b4, 0.5);
  EXPECT_NEAR(b4 / b8, 2, 0.4);
  EXPECT_NEAR(b8 / b16, 2, 0.4);
}

TEST(InfSup, IsZeroForMultipliersOfDegreeP)
{
  for (const unsigned int p : {2U, 4U})
    EXPECT_LT(beta(4, p, 0), 1e-6) << "p = " << p;
}

TEST(InfSup, DoesNotDependOnUnitsOrOnTheBound)
{
  const double b = beta(4, 4, -2);
  EXPECT_NEAR(beta(4, 4, -2, {{"Material/Young's modulus", "210e9"}}), b, 1e-8);
  EXPECT_NEAR(beta(4, 4, -2, {{"Boundary bottom/Friction bound", "1e-9*(2+sin(x))"}}),
              beta(4, 4, -2, {{"Boundary bottom/Friction bound", "2+sin(x)"}}), 1e-8);
}

/** -1 runs, and is flagged. */
TEST(InfSup, OffsetsThatCannotWorkAreRefused)
{
  const auto scene_with = [](const std::string &offset)
  {
    return shipped_scene("han-6-12", {{"Solver/Multiplier degree offset", offset},
                                      {"Adaptivity/Maximum steps", "1"}});
  };
  EXPECT_THROW(scene_with("0"), InputError);
  EXPECT_THROW(scene_with("-9"), InputError); // a negative degree
  std::vector<std::string> warnings;
  AdaptiveSolver<2>(scene_with("-1")).run([&](const Step<2> &step) { warnings = step.warnings; });
  EXPECT_NE(std::find_if(warnings.begin(), warnings.end(),
                         [](const std::string &w)
                         { return w.find("inf-sup") != std::string::npos; }),
            warnings.end());
}
} // namespace
