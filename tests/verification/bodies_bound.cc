// SPDX-License-Identifier: LGPL-2.1-or-later
// The guaranteed bound where bodies touch: one traction for both, meshes that match and go on so, known energies.
#include "discretisation.h"

#include <hpvi/bound/admissible_friction.h>
#include <hpvi/bound/admissible_pressure.h>
#include <hpvi/bound/error_bound.h>
#include <hpvi/bound/joint_tractions.h>
#include <hpvi/plane/matching.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace
{
using namespace verification;

/** Two blocks, the upper one given by its corners in any order, with the name of its lower and upper side. */
struct Blocks
{
  std::string corners, cells, bottom, top;
};

const Blocks upright{"0, 0; 2, 0; 2, 1; 0, 1", "4, 2", "bottom", "top"},
    upside_down{"2, 1; 0, 1; 0, 0; 2, 0", "4, 2", "top", "bottom"},
    on_its_side{"0, 1; 0, 0; 2, 0; 2, 1", "2, 4", "right", "left"},
    skew{"0, 0; 2, 0; 2.3, 1; 0.3, 1", "4, 2", "bottom", "top"};

Scene<2> scene_of_blocks(const Blocks &upper, const Overrides &joint, const Overrides &others = {})
{
  Overrides entries{
      given::quadrilateral("Body lower", "-0.5, -1; 2.5, -1; 2.5, 0; -0.5, 0", "6, 2"),
      {"Body lower/Material", "other"},
      given::quadrilateral("Body upper", upper.corners, upper.cells),
      given::elastic("10", "0.3"),
      given::elastic("25", "0.2", "other"),
      {"Contact joint/Between", "upper." + upper.bottom + ", lower.top"},
      {"Boundary lower.bottom/Displacement", "0; 0"},
      {"Boundary upper." + upper.top + "/Displacement", "0.03; -0.02"},
      {"Error/Bound", "true"}};
  for (const auto &entry : joint)
    entries.emplace_back("Contact joint/" + entry.first, entry.second);
  entries.insert(entries.end(), others.begin(), others.end());
  return scene_of(entries);
}

/** A mesh that matches, bisected and raised at random, and what it takes to match again. */
struct MatchingMesh
{
  Triangulation<2> mesh;
  Degrees degrees;
  unsigned int n_unmatched = 0; ///< how often something had to be added

  MatchingMesh(const Scene<2> &scene, const unsigned int seed)
  {
    const ShapeTables<2> tables;
    make_mesh(scene, mesh);
    degrees.assign(mesh.n_active_cells(), 2);
    match_nested(scene, tables, mesh, degrees);
    std::mt19937 random(seed);
    std::uniform_int_distribution<unsigned int> dice(0, 5);
    for (unsigned int round = 0; round < 3; ++round)
    {
      Refinement refinement{std::vector<bool>(mesh.n_active_cells()), degrees};
      for (unsigned int cell = 0; cell < degrees.size(); ++cell)
        if (const unsigned int n = dice(random); n == 0)
          refinement.bisect[cell] = true;
        else if (n < 3)
          refinement.degrees[cell] += n;
      const Refinement wanted = refinement;
      {
        const DisplacementSpace<2> space(scene, mesh, degrees, tables);
        keep_matching(ContactSpace<2>(scene, space, tables), mesh, refinement);
      }
      n_unmatched += refinement.degrees != wanted.degrees;
      degrees = refine_mesh(mesh, degrees, refinement);
    }
  }
};

TEST(JointBound, KeepsMeshesMatching)
{
  const Scene<2> scene = scene_of_blocks(upright, {});
  unsigned int n_unmatched = 0;
  for (const unsigned int seed : {1, 2, 3, 4})
  {
    const MatchingMesh mesh(scene, seed);
    const Laboratory lab(scene, mesh.mesh, mesh.degrees);
    EXPECT_TRUE(all_match(lab.contact_space)) << seed;
    EXPECT_GT(lab.contact_space.faces().size(), 4U);
    n_unmatched += mesh.n_unmatched;
  }
  EXPECT_GT(n_unmatched, 4U);
}

/** s n at s in [0,1] of a joint, in one of its bodies. */
Tensor<1, 2> traction(const EquilibratedStress &stress, const StressEdge &edge,
                      const StressEdge::Side &side, const double s)
{
  const double on_side = side.part == reversed_edge ? 1. - s : s;
  const Point<2> xi = point_on_face<2>(side.face, Point<1>(on_side));
  if (stress.has_rows())
    return stress.value_of_rows(side.cell, xi) * edge.normal;
  const std::array<double, 3> c = stress.stress(side.cell).value(2 * xi[0] - 1, 2 * xi[1] - 1);
  Tensor<2, 2> S;
  S[0][0] = c[0];
  S[1][1] = c[1];
  S[0][1] = S[1][0] = c[2];
  const Tensor<2, 2> B = stress.frame(side.cell);
  return B * S * transpose(B) * edge.normal;
}

struct Law
{
  Overrides entries;
  bool may_pull;
  double friction; ///< the largest; negative: any
};

/** On random meshes, in each frame: in equilibrium, admissible, and the same on both sides. */
TEST(JointBound, HasOneTractionForBothBodies)
{
  const std::vector<Law> laws{{{{"Law", "tied"}}, true, -1.},
                              {{{"Law", "bilateral"}, {"Friction bound", "0.05"}}, true, 0.05},
                              {{{"Law", "unilateral"}, {"Friction bound", "0.05"}}, false, 0.05},
                              {{{"Law", "unilateral"}}, false, 0.}};
  for (const Blocks &blocks : {upright, upside_down, on_its_side, skew})
    for (const Law &law : laws)
    {
      SCOPED_TRACE(blocks.corners + ", " + law.entries[0].second);
      const Scene<2> scene = scene_of_blocks(blocks, law.entries);
      const MatchingMesh mesh(scene, 7);
      const Laboratory lab(scene, mesh.mesh, mesh.degrees);
      const Solution<2> solution = lab.solve();
      const AdmissibleFriction<2> friction(solution);
      const AdmissiblePressure<2> pressure(solution);
      EquilibrationCache cache;
      const EquilibratedStress stress(
          solution,
          [&](const unsigned int face, const unsigned int end)
          { return friction.part(face, end).coefficients(); },
          [&](const unsigned int face, const unsigned int end)
          { return pressure.part(face, end).coefficients(); },
          cache);
      EXPECT_EQ(stress.has_rows(), blocks.corners == skew.corners);
      EXPECT_LT(stress.defect, 1e-10);
      double jump = 0, pull = -1, rub = 0, largest = 0;
      unsigned int n_joints = 0;
      for (const StressEdge &edge : stress.patches().edges())
      {
        if (!edge.at_boundary() || edge.sides.size() < 2)
          continue;
        ++n_joints;
        for (const double s : {0.03, 0.27, 0.61, 0.88})
        {
          const Tensor<1, 2> own = traction(stress, edge, edge.sides[0], s),
                             other = traction(stress, edge, edge.sides[1], s);
          jump = std::max(jump, (own - other).norm());
          largest = std::max(largest, own.norm());
          pull = std::max(pull, own * edge.normal);
          rub = std::max(rub, std::abs(own * edge.tangent));
        }
      }
      EXPECT_GT(n_joints, 4U);
      EXPECT_GT(largest, 0.05);
      EXPECT_LT(jump, 1e-10 * largest);
      EXPECT_TRUE(law.may_pull || pull < 1e-11) << pull;
      if (law.friction >= 0)
        EXPECT_LT(rub, law.friction + 1e-11);
      else
        EXPECT_GT(rub, 0.05);
    }
}

struct Step
{
  double low, high, bound, distance;
  unsigned int n_elements;
};

std::vector<Step> run(const Scene<2> &scene, std::string *const no_bound = nullptr)
{
  std::vector<Step> result;
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        EXPECT_EQ(step.contradiction, "");
        if (no_bound)
          *no_bound = step.no_bound;
        if (!step.bound)
          return;
        const double J = step.energies.energy;
        result.push_back({J - step.bound->energy_below, J + step.bound->energy_above,
                          step.bound->total, step.errors.energy,
                          static_cast<unsigned int>(step.size.n_cells)});
      });
  return result;
}

/** Energies that two other discretisations agree on; frictionless, with friction, glued, and with cells half as large above. */
TEST(JointBound, HoldsTheKnownEnergies)
{
  struct Known
  {
    std::string lower, upper, cells, law, friction, E_lower, E_upper, nu_lower, plane, top;
    double J, accuracy, last; ///< bound of the last step, relative
  };
  for (const Known &known :
       {Known{"0, -1; 3, 0", "1, 0; 2, 1", "6, 2; 2, 2", "unilateral", "0", "20", "10", "0.3",
              "strain", "0; -0.02", .00166735265, 2e-11, 2e-3},
        Known{"0, -1; 2, 0", "0, 0; 2, 1", "4, 2; 4, 2", "unilateral", "0.055", "20", "10", "0.25",
              "stress", "0.03; -0.02", .004281503947, 2e-12, 2e-3},
        Known{"0, -1; 2, 0", "0, 0; 2, 1", "4, 2; 2, 1", "unilateral", "0.055", "20", "10", "0.25",
              "stress", "0.03; -0.02", .004281503947, 2e-12, 3e-3},
        Known{"0, -1; 3, 0", "1, 0; 2, 1", "6, 2; 4, 4", "tied", "", "10", "100", "0.3", "strain",
              "0.02; -0.02", .0039624663, 2e-10, 1e-2},
        Known{"0, -1; 3, 0", "1, 0; 2, 1", "5, 2; 3, 2", "unilateral", "0", "20", "10", "0.3",
              "strain", "0; -0.02", .00166735265, 2e-11, 3e-3},
        Known{"0, -1; 2, 0", "0, 0; 2, 1", "4, 2; 5, 3", "unilateral", "0.055", "20", "10", "0.25",
              "stress", "0.03; -0.02", .004281503947, 2e-12, 3e-3},
        Known{"0, -1; 3, 0", "1, 0; 2, 1", "5, 2; 3, 3", "tied", "", "10", "100", "0.3", "strain",
              "0.02; -0.02", .0039624663, 2e-10, 1e-2}})
  {
    const auto part = [](const std::string &both, const bool second)
    { return second ? both.substr(both.find(';') + 2) : both.substr(0, both.find(';')); };
    Overrides entries{given::block("lower", part(known.lower, false), part(known.lower, true),
                                   part(known.cells, false)),
                      {"Body lower/Material", "other"},
                      given::block("upper", part(known.upper, false), part(known.upper, true),
                                   part(known.cells, true)),
                      {"Material/Plane", known.plane},
                      given::elastic(known.E_upper, "0.3"),
                      {"Material other/Plane", known.plane},
                      given::elastic(known.E_lower, known.nu_lower, "other"),
                      given::joint("joint", "upper.bottom, lower.top", known.law),
                      {"Boundary lower.bottom/Displacement", "0; 0"},
                      {"Boundary upper.top/Displacement", known.top},
                      {"Adaptivity/Maximum steps", "12"}};
    if (!known.friction.empty())
      entries.emplace_back("Contact joint/Friction bound", known.friction);
    const std::vector<Step> steps = run(scene_of(entries));
    ASSERT_EQ(steps.size(), 12U) << known.law;
    for (const Step &step : steps)
    {
      EXPECT_LT(step.low, known.J + known.accuracy) << known.law;
      EXPECT_GT(step.high, known.J - known.accuracy) << known.law;
    }
    EXPECT_LT(steps.back().bound, known.last * std::sqrt(2 * known.J)) << known.law;
  }
}

/** Whichever way the corners of a body are listed. */
TEST(JointBound, IsTheSameInAnyFrame)
{
  for (const std::string law : {"tied", "bilateral", "unilateral"})
  {
    Overrides entries{{"Law", law}};
    if (law != "tied")
      entries.emplace_back("Friction bound", "0.055");
    const Overrides method{{"Adaptivity/Maximum steps", "5"}};
    const std::vector<Step> steps = run(scene_of_blocks(upright, entries, method));
    for (const Blocks &other : {upside_down, on_its_side})
    {
      const std::vector<Step> turned = run(scene_of_blocks(other, entries, method));
      ASSERT_EQ(turned.size(), 5U);
      for (unsigned int k = 0; k < 5; ++k)
      {
        EXPECT_EQ(turned[k].n_elements, steps[k].n_elements) << law;
        EXPECT_NEAR(turned[k].bound, steps[k].bound, 1e-9 * steps[k].bound) << law;
      }
    }
  }
}

/** What friction has that no polynomial follows acts on both bodies: on two equal ones it counts twice. */
TEST(JointBound, CountsOscillationInBothBodies)
{
  const std::string g = "0.02*(1 + 0.5*cos(7*x))";
  const Overrides method{given::steps("pu", "1", "3"), {"Material/Young's modulus", "10"}};
  Overrides one(method), two(method);
  for (const auto &entry : Overrides{given::box("2, 1", "4, 2"),
                                     given::rough("bottom", "bilateral", g),
                                     {"Boundary top/Displacement", "0.3; -0.02"}})
    one.push_back(entry);
  for (const auto &entry : Overrides{given::block("upper", "2, 1", "4, 2"),
                                     given::block("lower", "0, -1", "2, 0", "4, 2"),
                                     given::joint("joint", "upper.bottom, lower.top", "bilateral"),
                                     {"Contact joint/Friction bound", g},
                                     {"Boundary upper.top/Displacement", "0.3; -0.02"},
                                     {"Boundary lower.bottom/Displacement", "0; 0"}})
    two.push_back(entry);
  std::vector<double> oscillation;
  for (const Overrides &entries : {one, two})
    each_step<2>(scene_of(entries),
                 [&](const StepReport<2> &step)
                 {
                   ASSERT_TRUE(step.bound) << step.no_bound;
                   EXPECT_NEAR(step.contact[0].slipping_area, 2., 1e-10);
                   oscillation.push_back(step.bound->oscillation);
                 });
  ASSERT_EQ(oscillation.size(), 2U);
  EXPECT_GT(oscillation[0], 1e-9);
  EXPECT_NEAR(oscillation[1], std::sqrt(2.) * oscillation[0], 1e-6 * oscillation[0]);
}

/** Where bodies slide along each other tractions may pull: no pressure is to be mended. */
TEST(JointBound, LetsSlidingBodiesPull)
{
  const std::vector<Step> steps = run(scene_of_blocks(
      upright, {{"Law", "bilateral"}, {"Friction bound", "0.02"}},
      {{"Boundary upper.top/Displacement", "0.03; 0.02"}, {"Adaptivity/Maximum steps", "4"}}));
  ASSERT_EQ(steps.size(), 4U);
  for (const Step &one : steps)
    for (const Step &other : steps)
      EXPECT_LE(one.low, other.high);
  EXPECT_LT(steps[3].bound, 0.5 * steps[0].bound);
}

/** What the jump does between moments costs what the softer body takes to move, whichever has the multipliers. */
TEST(JointBound, MovesTheSofterBody)
{
  for (const std::string slave : {"upper.bottom", "lower.top"})
  {
    const std::vector<Step> steps = run(scene_of_blocks(
        upright, {{"Law", "tied"}, {"Slave", slave}},
        {{"Material other/Young's modulus", "1e6"}, {"Adaptivity/Maximum steps", "4"}}));
    ASSERT_EQ(steps.size(), 4U);
    EXPECT_LT(steps[3].bound, 0.005) << slave; // of a norm of 0.12
  }
}

/** One block on two others: where these meet, friction of one of them is not the other's. */
TEST(JointBound, KeepsPairsApart)
{
  const std::vector<Step> steps =
      run(scene_of({given::block("upper", "2, 1", "4, 2"),
                    given::block("left", "0, -1", "1, 0", "2, 2"),
                    given::block("right", "1, -1", "2, 0", "2, 2"),
                    {"Contact one/Between", "upper.bottom, left.top"},
                    {"Contact one/Slave", "upper.bottom"},
                    {"Contact one/Friction bound", "0.3"},
                    {"Contact other/Between", "upper.bottom, right.top"},
                    {"Contact other/Slave", "upper.bottom"},
                    {"Contact other/Friction bound", "0.1"},
                    {"Material/Young's modulus", "10"},
                    given::clamped({"left.bottom", "right.bottom"}),
                    {"Boundary upper.top/Displacement", "0.04; -0.03"},
                    {"Adaptivity/Maximum steps", "4"}}));
  EXPECT_EQ(steps.size(), 4U);
}

/** Unit squares, on each other in rows or side by side, glued to springs above, with joints of any law: at inner vertices four meet. */
class Wall
{
public:
  Wall(const unsigned int n_columns, const unsigned int n_rows, const unsigned int seed)
      : n_columns(n_columns), n_rows(n_rows), random(seed)
  {
    for (unsigned int i = 0; i < n_columns; ++i)
      for (unsigned int j = 0; j < n_rows; ++j)
        add_body(i, j);
    entries.emplace_back("Material/Young's modulus", "1");
    entries.emplace_back("Material right/Where", "x - 1");
    entries.emplace_back("Material right/Young's modulus", power(-1.5, 1.5));
    for (unsigned int i = 0; i < n_columns; ++i)
      for (unsigned int j = 0; j < n_rows; ++j)
      {
        if (i + 1 < n_columns)
          add_joint(body(i, j) + ".right", body(i + 1, j) + ".left", /*holds=*/n_rows == 1);
        if (j + 1 < n_rows)
          add_joint(body(i, j) + ".top", body(i, j + 1) + ".bottom", false);
      }
  }

  Overrides entries;

private:
  static std::string body(const unsigned int i, const unsigned int j)
  {
    return "b" + std::to_string(i) + std::to_string(j);
  }

  double number(const double least, const double largest)
  {
    return std::uniform_real_distribution<double>(least, largest)(random);
  }

  std::string power(const double least, const double largest)
  {
    return std::to_string(std::pow(10., number(least, largest)));
  }

  void add_body(const unsigned int i, const unsigned int j)
  {
    const std::string name = body(i, j), section = "Boundary " + name;
    const auto corner = [&](const unsigned int end)
    { return std::to_string(i + end) + ", " + std::to_string(j + end); };
    entries.emplace_back("Body " + name + "/Lower corner", corner(0));
    entries.emplace_back("Body " + name + "/Upper corner", corner(1));
    const auto load = [&](const double largest)
    {
      return std::to_string(number(-largest, largest)) + "; " +
             std::to_string(number(-largest, largest));
    };
    if (j == 0 && n_rows > 1)
      entries.emplace_back(section + ".bottom/Displacement", "0; 0");
    if (j + 1 == n_rows && (n_rows > 1 || i == 0))
      entries.emplace_back(section + ".top/Spring", power(-1, 6) + "; " + power(-1, 6));
    if (j + 1 == n_rows)
      entries.emplace_back(section + ".top/Traction", load(0.01));
    if (i + 1 == n_columns)
      entries.emplace_back(section + ".right/Traction", load(0.03));
  }

  void add_joint(const std::string &one, const std::string &other, const bool holds)
  {
    const std::string section = "Contact c" + std::to_string(n_joints++);
    const bool is_first = number(0, 1) < 0.5;
    const double law = holds ? 0. : number(0, 3);
    entries.emplace_back(section + "/Between", is_first ? one + ", " + other : other + ", " + one);
    entries.emplace_back(section + "/Law", law < 1 ? "tied" : law < 2 ? "bilateral" : "unilateral");
    entries.emplace_back(section + "/Slave", number(0, 1) < 0.5 ? one : other);
    if (law >= 1 && number(0, 1) < 0.5)
      entries.emplace_back(section + "/Friction bound", std::to_string(number(0.001, 0.01)));
  }

  const unsigned int n_columns, n_rows;
  unsigned int n_joints = 0;
  std::mt19937 random;
};

Scene<2> with_method(Overrides entries, const std::string &method, const unsigned int n_steps)
{
  entries.emplace_back("Adaptivity/Method", method);
  entries.emplace_back("Adaptivity/Maximum steps", std::to_string(n_steps));
  entries.emplace_back("Adaptivity/Maximum unknowns", "2500");
  entries.emplace_back("Adaptivity/Tolerance", "0");
  return scene_of(entries);
}

/** A corner that a joint moves, on an edge above a floor that moves nothing: nobody counts what slips and penetrates along it. */
TEST(JointBound, EndsWhereAnotherContactHoldsACorner)
{
  std::string no_bound;
  run(with_method({{"Body a/Upper corner", "1, 1"},
                   {"Body a/Subdivisions", "2, 2"},
                   {"Body b/Lower corner", "1, 0"},
                   {"Body b/Upper corner", "2, 1"},
                   {"Body b/Subdivisions", "3, 3"},
                   {"Body b/Material", "hard"},
                   {"Material hard/Young's modulus", "1000"},
                   {"Material hard/Poisson's ratio", "0.3"},
                   given::joint("joint", "a.right, b.left", "unilateral"),
                   {"Contact joint/Friction bound", "0.05"},
                   {"Boundary a.left/Displacement", "0.02; 0"},
                   {"Boundary b.right/Displacement", "0; 0"},
                   {"Boundary b.bottom/Contact", "unilateral"},
                   {"Boundary b.bottom/Friction bound", "0.03"},
                   {"Boundary b.top/Traction", "0; -0.3"},
                   {"Solver/Normal contact", "multiplier"},
                   {"Error/Bound", "true"}},
                  "hup2", 3),
      &no_bound);
  EXPECT_EQ(no_bound, "another contact holds a corner");
}

/** Two bodies, the first of them glued to springs, and four around a vertex, below springs; the second energy is that of two bodies. */
TEST(JointBound, HoldsKnownEnergiesBesideSprings)
{
  const std::string top = "0.104107505532; 0.104107505532",
                    load = "0.00943966479188; -0.00316025449529",
                    right = "0.0291803670998; -0.0289871607475";
  struct Known
  {
    Overrides entries;
    std::string method;
    unsigned int n_steps;
    double J, accuracy;
  };
  for (const Known &known : {Known{{{"Body one/Upper corner", "1, 1"},
                                    {"Body two/Lower corner", "1, 0"},
                                    {"Body two/Upper corner", "2, 1"},
                                    {"Boundary one.top/Spring", "100; 100"},
                                    {"Boundary two.right/Shear", "0.01"},
                                    given::joint("joint", "one.right, two.left", "tied")},
                                   "hpa3",
                                   6,
                                   -.00091824,
                                   1e-8},
                             Known{{{"Body l0/Upper corner", "1, 1"},
                                    {"Body l1/Lower corner", "1, 0"},
                                    {"Body l1/Upper corner", "2, 1"},
                                    {"Body u0/Lower corner", "0, 1"},
                                    {"Body u0/Upper corner", "1, 2"},
                                    {"Body u1/Lower corner", "1, 1"},
                                    {"Body u1/Upper corner", "2, 2"},
                                    {"Material/Young's modulus", "1"},
                                    {"Material m/Where", "x - 1"},
                                    {"Material m/Young's modulus", "25.8884085624"},
                                    given::clamped({"l0.bottom", "l1.bottom"}),
                                    {"Boundary u0.top/Spring", top},
                                    {"Boundary u0.top/Traction", load},
                                    {"Boundary u1.top/Spring", top},
                                    {"Boundary u1.top/Traction", load},
                                    {"Boundary l1.right/Traction", right},
                                    {"Boundary u1.right/Traction", right},
                                    given::joint("a", "l0.right, l1.left", "tied"),
                                    given::joint("b", "u0.right, u1.left", "tied"),
                                    {"Contact c/Between", "u0.bottom, l0.top"},
                                    {"Contact d/Between", "u1.bottom, l1.top"}},
                                   "hup2",
                                   4,
                                   -.0058556186048,
                                   1e-10}})
  {
    const std::vector<Step> steps = run(with_method(known.entries, known.method, known.n_steps));
    ASSERT_EQ(steps.size(), known.n_steps);
    for (const Step &step : steps)
    {
      EXPECT_LE(step.low, known.J + known.accuracy);
      EXPECT_GE(step.high, known.J - known.accuracy);
    }
  }
}

/** Intervals of all steps hold what a finer run knows of the energy, and claims of both agree. */
TEST(JointBound, CountsSpringsWhereManyBodiesMeet)
{
  unsigned int n_steps = 0;
  for (unsigned int seed = 1; seed <= 12; ++seed)
  {
    const unsigned int n_rows = seed % 4 == 0 ? 1 : 2, n_columns = 2 + (n_rows == 1) + seed % 3 / 2;
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Wall wall(n_columns, n_rows, seed);
    std::vector<Step> steps = run(with_method(wall.entries, "hpa3", 10));
    ASSERT_FALSE(steps.empty());
    const Step &finest = *std::min_element(steps.begin(), steps.end(),
                                           [](const Step &one, const Step &other)
                                           { return one.high - one.low < other.high - other.low; });
    const double low = finest.low, high = finest.high;
    const std::vector<Step> coarse = run(with_method(wall.entries, "hup2", 3));
    n_steps += coarse.size();
    steps.insert(steps.end(), coarse.begin(), coarse.end());
    const double round_off = 1e-10 * std::abs(high);
    for (const Step &step : steps)
    {
      EXPECT_LE(step.low, high + round_off);
      EXPECT_GE(step.high, low - round_off);
    }
  }
  EXPECT_EQ(n_steps, 36U);
}

/** Blocks with @p cells and the modulus @p E above one with 25 and 6 cells, few vertices opposite to another. */
Scene<2> unmatched(const std::string &cells, const std::string &E, const Overrides &joint,
                   const std::string &steps)
{
  Blocks blocks(upright);
  blocks.cells = cells;
  return scene_of_blocks(blocks, joint,
                         {{"Material/Young's modulus", E},
                          {"Adaptivity/Method", "hpa3"},
                          {"Adaptivity/Maximum steps", steps}});
}

/** A block that is pushed along its foundation and meets it along a direction that is not the normal. */
Scene<2> pushed(const std::string &steps)
{
  return scene_of({given::box("2, 1", "4, 2"),
                   given::elastic("10", "0.3"),
                   {"Boundary top/Displacement", "0.01; -0.02"},
                   {"Boundary bottom/Contact", "unilateral"},
                   {"Boundary bottom/Contact direction", "0.4; -1"},
                   {"Boundary bottom/Gap", "0.002*(x - 1)^2"},
                   {"Boundary bottom/Friction bound", "0.05"},
                   {"Adaptivity/Method", "hpa3"},
                   {"Adaptivity/Maximum steps", steps}});
}

/** A soft tube in another one around the axis, whose meshes do not match. */
Scene<2> tubes(const Overrides &joint, const std::string &steps)
{
  Overrides entries{given::block("in", "1, 0", "2, 1", "1, 2"),
                    given::block("out", "2, -0.3", "3, 1.2", "1, 2"),
                    {"Body in/Material", "soft"},
                    given::elastic("1", "0.3"),
                    given::elastic("0.5", "0.2", "soft"),
                    {"Material/Plane", "axisymmetric"},
                    {"Contact fit/Between", "in.right, out.left"},
                    {"Boundary in.top/Traction", "0.01; 0.001"},
                    {"Boundary out.bottom/Displacement", "free; 0"},
                    {"Error/Bound", "true"},
                    {"Adaptivity/Method", "hpa3"},
                    {"Adaptivity/Start degree", "3"},
                    {"Adaptivity/Maximum steps", steps}};
  for (const auto &entry : joint)
    entries.emplace_back("Contact fit/" + entry.first, entry.second);
  return scene_of(entries);
}

/** A body of revolution with loads of all kinds, on springs and in a rigid seat, of cells that are no rectangles. */
Scene<2> turned(const std::string &steps)
{
  return scene_of({{"Geometry/Shape", "quadrilateral"},
                   {"Geometry/Corners", "1, 0; 2.3, 0.2; 2.3, 1.1; 1.2, 1"},
                   {"Geometry/Subdivisions", "2, 2"},
                   given::elastic("1", "0.3"),
                   {"Material/Plane", "axisymmetric"},
                   {"Material/Initial strain", "0.01*x; 0.02*y; 0; 0.01*exp(y)"},
                   {"Body force/Expression", "0.1*exp(y); 0.02*x"},
                   {"Boundary left/Pressure", "0.05 + 0.1*y*y"},
                   {"Boundary bottom/Spring", "3; 1"},
                   {"Boundary right/Contact", "unilateral"},
                   {"Boundary right/Gap", "0.02*y"},
                   {"Boundary right/Friction bound", "0.01*x"},
                   {"Error/Bound", "true"},
                   {"Adaptivity/Method", "hpa3"},
                   {"Adaptivity/Start degree", "3"},
                   {"Adaptivity/Maximum steps", steps}});
}

/** A cylinder with its axis, under its own weight on a block of @p cells, rubbing on it. */
Scene<2> pillar(const std::string &cells, const std::string &gap, const std::string &steps)
{
  return scene_of({given::block("pillar", "0, 0", "1, 1", "2, 2"),
                   given::block("base", "0, -2", "2, 0", cells),
                   given::elastic("1", "0.3"),
                   {"Material/Plane", "axisymmetric"},
                   {"Body force/Expression", "0; -0.002"},
                   {"Boundary pillar.top/Displacement", "free; -0.01"},
                   {"Boundary base.bottom/Displacement", "0; 0"},
                   {"Contact joint/Between", "pillar.bottom, base.top"},
                   {"Contact joint/Gap", gap},
                   {"Contact joint/Friction bound", "0.001"},
                   {"Error/Bound", "true"},
                   {"Adaptivity/Method", "hpa3"},
                   {"Adaptivity/Start degree", "3"},
                   {"Adaptivity/Maximum steps", steps}});
}

/** In the solid one of the tubes cells on the axis are cut along it, by the vertices of the other. */
Scene<2> plugged(const std::string &steps)
{
  return scene_of({given::block("in", "0, 0", "1, 1", "1, 2"),
                   given::block("out", "1, -0.3", "2, 1.2", "1, 2"),
                   given::elastic("1", "0.3"),
                   {"Material/Plane", "axisymmetric"},
                   {"Contact fit/Between", "in.right, out.left"},
                   {"Contact fit/Law", "tied"},
                   {"Boundary in.top/Traction", "0; 0.01"},
                   {"Boundary out.bottom/Displacement", "free; 0"},
                   {"Error/Bound", "true"},
                   {"Adaptivity/Method", "hpa3"},
                   {"Adaptivity/Start degree", "3"},
                   {"Adaptivity/Maximum steps", steps}});
}

/**
 * From below and not from far, beside runs that are far finer: bodies of revolution; every law, the slave coarse, fine, soft and stiff; and contact along a
 * direction.
 */
TEST(JointBound, BoundsTheErrorWhereTractionsAreGiven)
{
  const Overrides tied{{"Law", "tied"}}, sliding{{"Law", "bilateral"}},
      pressed{{"Law", "unilateral"}, {"Friction bound", "0.05"}},
      with_gap{{"Law", "unilateral"}, {"Gap", "0.002*(x - 1)^2"}};
  const auto blocks = [](const std::string &cells, const std::string &E, const Overrides &joint)
  { return [=](const std::string &steps) { return unmatched(cells, E, joint, steps); }; };
  unsigned int row = 0;
  for (const std::function<Scene<2>(const std::string &)> &scene_with :
       {std::function<Scene<2>(const std::string &)>(pushed),
        {blocks("5, 2", "10", tied)},
        {blocks("7, 3", "2500", tied)},
        {blocks("3, 2", "0.25", tied)},
        {blocks("5, 2", "10", sliding)},
        {blocks("5, 2", "10", pressed)},
        {blocks("7, 1", "1", with_gap)},
        {turned},
        {[&](const std::string &steps)
         { return pillar("3, 2", "0", steps); }}, // cuts in cells on the axis
        {[&](const std::string &steps) { return pillar("4, 2", "0.02*x^2", steps); }},
        {plugged},
        {[&](const std::string &steps) { return tubes(tied, steps); }},
        {[&](const std::string &steps) {
          return tubes({{"Law", "unilateral"}, {"Gap", "-0.05"}, {"Friction bound", "0.002"}},
                       steps);
        }}})
  {
    SCOPED_TRACE(row++);
    Scene<2> fine = scene_with("10");
    fine.error_bound = false;
    const ReferenceFile reference(fine);
    Scene<2> scene = scene_with("4");
    scene.reference_solution = reference.path;
    const std::vector<Step> steps = run(scene);
    EXPECT_EQ(steps.size(), 4U);
    for (const Step &step : steps)
    {
      EXPECT_GE(step.bound, step.distance);
      EXPECT_LE(step.bound, 2 * step.distance);
    }
  }
}

/** Rings of 90 degrees in each other, the inner one too large by 0.03, between planes of symmetry. */
Overrides rings(const std::string &inner, const std::string &outer, const std::string &between)
{
  Overrides entries{given::ring("Body in", "20, 30", "0, 90", inner),
                    {"Body in/Material", "bronze"},
                    given::ring("Body out", "30, 45", "0, 90", outer),
                    given::elastic("210000", "0.3"),
                    given::elastic("110000", "0.34", "bronze"),
                    {"Material/Plane", "strain"},
                    {"Contact fit/Between", between},
                    {"Contact fit/Gap", "-0.03"}};
  for (const char *const side : {"in.start", "in.end", "out.start", "out.end"})
    entries.emplace_back("Boundary " + std::string(side) + "/Symmetry", "true");
  return entries;
}

/** A ring in a rigid seat that is narrower by 0.02. */
Overrides seated(const std::string &cells)
{
  return {given::ring("Geometry", "30, 40", "-30, 30", cells),
          given::elastic("210000", "0.3"),
          {"Material/Plane", "strain"},
          {"Boundary start/Symmetry", "true"},
          {"Boundary end/Symmetry", "true"},
          {"Boundary outer/Contact", "unilateral"},
          {"Boundary outer/Gap", "-0.02"}};
}

/** Lame's rings press each other with P: J = P delta b/2 times their angle, by the radial displacements of both. */
TEST(JointBound, HoldsLamesEnergies)
{
  const double b = 30, nu_in = 0.34 / 0.66, nu_out = 0.3 / 0.7,
               in = (1 - 0.34 * 0.34) / 110000 * ((b * b + 400) / (b * b - 400) - nu_in),
               out = (1 - 0.09) / 210000 * ((2025 + b * b) / (2025 - b * b) + nu_out),
               of_pair = 0.03 * 0.03 / (in + out) / 2 * numbers::PI / 2,
               alone = (1 - 0.09) / 210000 * ((1600. + 900.) / (1600. - 900.) - nu_out),
               of_seat = 0.02 * 0.02 / alone / 2 * numbers::PI / 3;
  for (const auto &[entries, J] : {std::pair{rings("1, 2", "1, 3", "in.outer, out.inner"), of_pair},
                                   {rings("1, 3", "1, 2", "out.inner, in.outer"), of_pair},
                                   {rings("1, 2", "1, 2", "in.outer, out.inner"), of_pair},
                                   {seated("1, 4"), of_seat}})
    for (const std::string method : {"hup2", "hpa3"})
    {
      const std::vector<Step> steps = run(scene_of({entries,
                                                    {"Error/Bound", "true"},
                                                    {"Adaptivity/Method", method},
                                                    {"Adaptivity/Maximum steps", "4"}}));
      ASSERT_EQ(steps.size(), 4U);
      for (const Step &step : steps)
      {
        EXPECT_LT(step.low, J);
        EXPECT_GT(step.high, J * (1 - 1e-9)); // of polynomials in the place of circles
        EXPECT_LT(step.high - step.low, 4e-3 * J);
        EXPECT_LT(step.bound, 0.09 * std::sqrt(2 * J));
      }
    }
}

/** A ring between spheres in its seat: u = A R + B/R^2, the seat presses by 90.03 over a zone of the outer sphere (prm/press-ring-axi.prm). */
TEST(JointBound, HoldsTheEnergyOfARingBetweenSpheres)
{
  const double a = 30, b = 40, E = 210000, nu = 0.3,
               A_over_B = 2 * (1 - 2 * nu) / (1 + nu) / (a * a * a),
               B = -0.02 / (A_over_B * b + 1 / (b * b)),
               p = 2 * E * B / (1 + nu) * (1 / (b * b * b) - 1 / (a * a * a)),
               J = p * 0.02 / 2 * 2 * numbers::PI * b * b; // the zone is as high as b
  for (const std::string method : {"hup2", "hpa3"})
    for (const Step &step :
         run(scene_of({with({seated("1, 4")}, {{"Material/Plane", "axisymmetric"}}),
                       {"Error/Bound", "true"},
                       {"Adaptivity/Method", method},
                       {"Adaptivity/Maximum steps", "4"}})))
    {
      EXPECT_LT(step.low, J);
      EXPECT_GT(step.high, J * (1 - 1e-9));
      EXPECT_LT(step.high - step.low, 2e-3 * J);
      EXPECT_LT(step.bound, 0.05 * std::sqrt(2 * J));
    }
}

/** Contact that ends along curves: intervals of all steps of two methods meet, and get narrow. */
TEST(JointBound, MeetsItselfAlongCurves)
{
  const Overrides disc{given::half_disc("Body disc", "0, 1", "1", "180"),
                       {"Boundary disc.flat/Displacement", "0.004; -0.01"},
                       {"Body disc/Material", "soft"},
                       given::elastic("0.5", "0.25", "soft"),
                       given::elastic("1", "0.3"),
                       {"Contact line/Law", "unilateral"}};
  const Overrides block = with({disc, given::block("below", "-2, -1", "2, 0", "5, 2")},
                               {{"Boundary below.bottom/Displacement", "0; 0"}}),
                  other = with({disc, given::half_disc("Body below", "0, -20", "20", "0"),
                                given::graded("Body below", "0, 0", "4")},
                               {{"Boundary below.flat/Displacement", "0; 0"}});
  const Overrides alone{given::half_disc("Geometry", "0, 1", "1", "180"),
                        given::elastic("1", "0.3"),
                        {"Boundary flat/Displacement", "0.004; -0.01"},
                        {"Boundary rim/On", "arc"},
                        {"Boundary rim/Where", "0.29289 - y"},
                        {"Boundary rim/Contact", "unilateral"},
                        {"Boundary rim/Gap", "y/(1 - y)"},
                        {"Boundary rim/Friction bound", "0.002"}};
  // A ball of revolution, its pole in contact.
  const Overrides ball{given::half_disc("Geometry", "0, 1", "1", "270"),
                       given::elastic("1", "0.3"),
                       {"Material/Plane", "axisymmetric"},
                       {"Boundary lid/On", "arc"},
                       {"Boundary lid/Where", "y - 1.70711"},
                       {"Boundary lid/Displacement", "free; -0.01"},
                       {"Boundary rim/On", "arc"},
                       {"Boundary rim/Where", "0.29289 - y"},
                       {"Boundary rim/Contact", "unilateral"},
                       {"Boundary rim/Gap", "y/(1 - y)"}};
  for (const Overrides &entries :
       {ball, with(block, {{"Contact line/Between", "disc.arc, below.top"}}),
        with(block, {{"Contact line/Between", "below.top, disc.arc"},
                     {"Contact line/Friction bound", "0.002"}}),
        with(other, {{"Contact line/Between", "disc.arc, below.arc"},
                     {"Contact line/Friction bound", "0.002"}}),
        alone})
  {
    double low = -std::numeric_limits<double>::infinity(), high = -low, n = 0;
    for (const std::string method : {"hup2", "hpa3"})
      for (const Step &step :
           run(scene_of({entries,
                         {"Error/Bound", "true"},
                         {"Adaptivity/Method", method},
                         {"Adaptivity/Start degree", "5"},
                         {"Adaptivity/Maximum steps", method == "hup2" ? "2" : "6"}})))
      {
        ++n;
        low = std::max(low, step.low);
        high = std::min(high, step.high);
      }
    EXPECT_GE(n, 6); // coarse meshes may not resolve gaps far from contact to round-off
    EXPECT_LT(low, high * (1 + 1e-7));
    EXPECT_LT(high - low, 2e-3 * high);
  }
}

/** What one body exerts is what the other bears, at every point, and within the law. */
TEST(JointBound, HandsTractionsOverWhereMeshesDoNotMatch)
{
  for (const std::string law : {"tied", "bilateral", "unilateral"})
  {
    SCOPED_TRACE(law);
    Overrides joint{{"Law", law}};
    if (law != "tied")
      joint.emplace_back("Friction bound", "0.05");
    const Scene<2> scene = unmatched("5, 2", "10", joint, "1");
    const RandomMesh mesh(scene, 4, 2, 2, 5);
    const Laboratory lab(scene, mesh);
    const Solution<2> solution = lab.solve();
    const AdmissibleFriction<2> friction(solution);
    const AdmissiblePressure<2> pressure(solution);
    const JointTractions joints(solution, friction, pressure);
    EquilibrationCache cache;
    const EquilibratedStress stress(solution, {}, {}, cache, nullptr, Volume::full, &joints);
    double largest = 0, pull = 0, rub = 0;
    unsigned int n_pieces = 0;
    for (const JointEdge &edge : joints.edges())
      for (const JointPiece &piece : edge.pieces)
        for (const double t : {0.02, 0.4, 0.9})
        {
          ++n_pieces;
          const double s = piece.begin + t * (piece.end - piece.begin);
          const Tensor<1, 2> normal = solution.contact_space.faces()[piece.face].frame(0.5).normal,
                             tau = joints.value(piece.face, piece.on_slave(s)),
                             own =
                                 stress.value_of_rows(edge.cell->active_cell_index(),
                                                      point_on_face<2>(edge.face_no, Point<1>(s))) *
                                 normal;
          largest = std::max(largest, tau.norm());
          pull = std::max(pull, -(tau * normal));
          rub =
              std::max(rub, std::sqrt(std::max(0., tau.norm_square() - std::pow(tau * normal, 2))));
          EXPECT_LT((own + tau).norm(), 1e-10 * largest);
        }
    EXPECT_GT(n_pieces, 60U);
    EXPECT_GT(largest, 0.05);
    EXPECT_TRUE(law != "unilateral" || pull <= 1e-12 * largest) << pull;
    EXPECT_TRUE(law == "tied" || rub <= 0.05 * (1 + 1e-12)) << rub;
  }
}

/** Where each edge of one is a half of one of the other cells are bisected until meshes match; without a bound nothing is. */
TEST(JointBound, BisectsWhereMeshesAreNested)
{
  Blocks other(upright);
  const Overrides method{{"Adaptivity/Maximum steps", "2"}};
  std::string why;
  other.cells = "8, 2";
  const std::vector<Step> nested = run(scene_of_blocks(other, {}, method), &why);
  EXPECT_EQ(why, "");
  ASSERT_EQ(nested.size(), 2U);
  unsigned int n_elements = 0;
  each_step<2>(
      scene_of_blocks(other, {}, {{"Adaptivity/Maximum steps", "1"}, {"Error/Bound", "false"}}),
      [&](const StepReport<2> &step)
      { n_elements = static_cast<unsigned int>(step.size.n_cells); });
  EXPECT_EQ(n_elements, 28U);
  EXPECT_EQ(nested[0].n_elements, 28U + 4 * 3);
}

/** Where parts, materials and other bodies end in one box, the boxes beside it get its lines as far as meshes match else. */
TEST(JointBound, GoesOnWhereABoxIsCut)
{
  struct Row
  {
    std::string name;
    Overrides entries;
    std::vector<std::string> cut; ///< bodies with a line that another one has
  };
  const auto box = [](const std::string &name, const std::string &lower, const std::string &upper,
                      const std::string &cells)
  {
    return Overrides{{"Body " + name + "/Lower corner", lower},
                     {"Body " + name + "/Upper corner", upper},
                     {"Body " + name + "/Subdivisions", cells},
                     given::elastic("10", "0.3"),
                     {"Adaptivity/Maximum steps", "3"}};
  };
  const auto joined = [](const std::vector<Overrides> &parts)
  {
    Overrides result;
    for (const Overrides &part : parts)
      result.insert(result.end(), part.begin(), part.end());
    return result;
  };
  const Overrides stack = joined({box("b", "0, 0", "3, 1", "6, 2"),
                                  box("a", "0, 1", "3, 2", "6, 2"),
                                  {{"Boundary b.bottom/Displacement", "0; 0"},
                                   {"Boundary a.left/Displacement", "0; free"},
                                   {"Contact joint/Between", "a.bottom, b.top"}}}),
                  load{{"Boundary load/On", "a.top"},
                       {"Boundary load/Where", "0.1 - abs(x - 1)"},
                       {"Boundary load/Pressure", "1"}},
                  beside = joined({box("a", "0, 0", "1, 2", "2, 4"),
                                   box("b", "1, 0", "2, 2", "1, 4"),
                                   {{"Boundary b.right/Displacement", "0; 0"},
                                    given::joint("joint", "a.right, b.left", "tied"),
                                    {"Boundary load/On", "a.left"},
                                    {"Boundary load/Where", "y - 0.3"},
                                    {"Boundary load/Traction", "1; 0"}}}),
                  third = joined({stack,
                                  box("c", "0.6, 2", "0.8, 3", "1, 2"),
                                  {{"Boundary c.top/Displacement", "0; -0.01"},
                                   {"Contact foot/Between", "c.bottom, a.top"}}});
  for (const Row &row :
       {Row{"a part of a side", joined({stack, load}), {"b"}},
        Row{"on a shorter body", joined({stack, load, {given::block("a", "2, 2", "4, 2")}}), {"b"}},
        Row{"a part of a side that stands", beside, {"b"}},
        Row{"a material in the body below",
            joined({stack,
                    {{"Material hard/Where", "min(x - 0.7, 1 - y)"},
                     given::elastic("40", "0.3", "hard"),
                     {"Boundary a.top/Pressure", "1"}}}),
            {"a"}},
        Row{"both",
            joined({stack,
                    load,
                    {{"Material hard/Where", "min(x - 2.3, 1 - y)"},
                     given::elastic("40", "0.3", "hard")}}),
            {"b", "a"}},
        Row{"a foot in the middle of a pile", third, {"b"}},
        Row{"and where no other line matches",
            joined({stack, load, {{"Body b/Subdivisions", "5, 2"}}}),
            {}},
        Row{"and where no bound is asked for",
            joined({stack, load, {{"Error/Bound", "false"}}}),
            {}}})
  {
    const Scene<2> scene = scene_of(row.entries);
    std::vector<std::string> cut;
    for (const std::string &remark : scene.remarks)
      if (remark.find("/Between has a grid line") != std::string::npos &&
          remark.find("foot/Between") == std::string::npos)
        cut.push_back(remark.substr(5, 1));
    EXPECT_EQ(cut, row.cut) << row.name;
    std::string why;
    const std::vector<Step> steps = run(scene, &why);
    EXPECT_EQ(steps.size(), row.name == "and where no bound is asked for" ? 0U : 3U)
        << row.name << ": " << why;
  }
}
} // namespace
