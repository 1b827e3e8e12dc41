// SPDX-License-Identifier: LGPL-2.1-or-later
// Bodies of two materials whose displacement is linear in each of them: computed to round-off.
#include "discretisation.h"

#include <gtest/gtest.h>
#include <hpvi/driver/adaptive_solver.h>
#include <hpvi/results/contact_traces.h>
#include <hpvi/results/residual_estimator.h>
#include <hpvi/results/solution_field.h>
#include <hpvi/results/true_error.h>

#include <cmath>

using namespace verification;

namespace
{
const Material soft{2., 0.2, PlaneModel::strain}, stiff{70., 0.35, PlaneModel::strain};

/** Linear on both sides of the line where @p along is 1, and continuous: u(0) = 0. */
class TwoStrains : public ExactSolution<2>
{
public:
  TwoStrains(const unsigned int across, const Tensor<2, 2> &below, const Tensor<2, 2> &above)
      : across(across), below(below), above(above)
  {
  }

  Tensor<1, 2> displacement(const Point<2> &x) const override
  {
    Point<2> at_interface = x;
    at_interface[across] = std::min(x[across], 1.);
    return below * at_interface + above * (x - at_interface);
  }

  Tensor<2, 2> gradient(const Point<2> &x) const override
  {
    return x[across] < 1 ? below : above;
  }

private:
  const unsigned int across;
  const Tensor<2, 2> below, above;
};

Tensor<2, 2> diagonal(const double x, const double y)
{
  Tensor<2, 2> result;
  result[0][0] = x;
  result[1][1] = y;
  return result;
}

/** lambda + 2 mu, what a strain in one direction alone meets. */
double longitudinal(const Material &material)
{
  return material.lambda(2) + 2 * material.mu();
}

/** Two squares side by side (@p across = 0) or on top of each other, the stiff one farther out. */
struct Bar
{
  const unsigned int across;
  Scene<2> scene;
  std::shared_ptr<const TwoStrains> exact;
  double energy_product; ///< a(u,u)
  Triangulation<2> mesh;
  Degrees degrees;

  Bar(const unsigned int across, const Overrides &entries)
      : across(across), scene(scene_of(entries))
  {
    scene.materials = {soft, stiff};
    make_mesh(scene, mesh);
    for (const auto &cell : mesh.active_cell_iterators())
      cell->set_material_id(cell->center()[across] < 1 ? 0 : 1);
    std::mt19937 random(7);
    refine_at_random(mesh, 2, random); // children inherit the material
    degrees = random_degrees(mesh, 2, 4, random);
  }

  /** Take the soft material for the outermost cells, a mistake that every quantity must feel. */
  void spoil()
  {
    for (const auto &cell : mesh.active_cell_iterators())
      if (cell->at_boundary(2 * across + 1))
        cell->set_material_id(0);
  }
};

/** Pulled by the stress 3 along x between walls without friction: `(lambda + 2 mu) eps = 3` in each. */
std::unique_ptr<Bar> in_series()
{
  auto bar = std::make_unique<Bar>(0, Overrides{given::box("2, 1", "4, 2"),
                                                {"Boundary left/Displacement", "0; free"},
                                                {"Boundary bottom/Contact", "bilateral"},
                                                {"Boundary top/Displacement", "free; 0"},
                                                {"Boundary right/Traction", "3; 0"}});
  const double a = 3 / longitudinal(soft), b = 3 / longitudinal(stiff);
  bar->exact = std::make_shared<TwoStrains>(0, diagonal(a, 0), diagonal(b, 0));
  bar->energy_product = 3 * (a + b);
  return bar;
}

/** Stretched by 1/10 with a free top: `sigma_yy = 0` in each, the forces add. */
std::unique_ptr<Bar> in_parallel()
{
  auto bar = std::make_unique<Bar>(1, Overrides{given::box("1, 2", "2, 4"),
                                                {"Boundary left/Displacement", "0; free"},
                                                {"Boundary bottom/Contact", "bilateral"},
                                                {"Boundary right/Displacement", "0.1; free"}});
  const auto strain = [](const Material &material)
  { return diagonal(0.1, -0.1 * material.lambda(2) / longitudinal(material)); };
  const auto modulus = [](const Material &material)
  { return 4 * material.mu() * (material.lambda(2) + material.mu()) / longitudinal(material); };
  bar->exact = std::make_shared<TwoStrains>(1, strain(soft), strain(stiff));
  bar->energy_product = 0.01 * (modulus(soft) + modulus(stiff));
  return bar;
}

/** How far the solution on @p bar is from the exact one, each relative to what is exact. */
struct Distance
{
  double displacement, energy, true_error, true_norm, indicator, normal_traction;
};

Distance distance(Bar &bar)
{
  const Laboratory discrete(bar.scene, bar.mesh, bar.degrees);
  const Solution<2> solution = discrete.solve();
  Distance result{};
  const double product =
      internal_forces(bar.scene, discrete.displacement_space, discrete.tables, solution.u)
          .energy_product;
  result.energy = std::abs(product / bar.energy_product - 1);

  bar.scene.exact_solution = bar.exact;
  const TrueErrors errors = TrueError<2>(bar.scene).measure(
      SolutionField(solution), contact_states(SolutionField(solution)));
  bar.scene.exact_solution = nullptr;
  result.displacement = errors.l2 / solution.u.linfty_norm();
  result.true_error = errors.energy / std::sqrt(bar.energy_product);
  result.true_norm = std::abs(errors.energy_norm * errors.energy_norm / bar.energy_product - 1);
  result.indicator = estimate_error(SolutionField(solution)).total() /
                     std::sqrt(bar.energy_product * bar.scene.reference_coercivity());
  for (const ContactFace<2> &face : discrete.contact_space.faces())
  {
    const Material &material = bar.scene.materials[face.cell->center()[bar.across] < 1 ? 0 : 1];
    const double expected =
        HookesLaw<2>(material).stress(bar.exact->gradient(face.cell->center()))[1][1];
    const ContactTraces<2> traces(face, 2, solution);
    for (unsigned int q = 0; q < 2; ++q)
      result.normal_traction =
          std::max(result.normal_traction, std::abs(traces.normal_traction(q) - expected));
  }
  return result;
}

void expect_exact(Bar &bar)
{
  const Distance right = distance(bar);
  EXPECT_LT(right.displacement, 1e-12);
  EXPECT_LT(right.energy, 1e-12);
  EXPECT_LT(right.true_error, 1e-12);
  EXPECT_LT(right.true_norm, 1e-12);
  EXPECT_LT(right.indicator, 1e-11);
  EXPECT_LT(right.normal_traction, 1e-11);

  bar.spoil();
  const Distance wrong = distance(bar);
  EXPECT_GT(wrong.displacement, 1e-3);
  EXPECT_GT(wrong.energy, 1e-3);
  EXPECT_GT(wrong.true_error, 1e-3);
  EXPECT_GT(wrong.true_norm, 1e-3);
}

TEST(Materials, InSeriesCarryTheSameStress)
{
  expect_exact(*in_series());
}

TEST(Materials, InParallelTakeTheSameStrain)
{
  expect_exact(*in_parallel());
}

TEST(Materials, RoundOffIsThatOfTheStiffest)
{
  for (const auto &materials : {std::vector<Material>{soft, stiff}, {stiff, soft}})
  {
    Scene<2> scene = scene_of({{"Boundary left/Displacement", "0; 0"}});
    scene.materials = materials;
    EXPECT_EQ(scene.largest_weight(), stiff.mu());
  }
}

/** A layer of the other material, loaded on a part of its top. */
double scaled_estimate(const std::vector<Material> &materials, const bool layer_is_first)
{
  Scene<2> scene = scene_of({{"Geometry/Subdivisions", "4, 4"},
                             {"Boundary left/Displacement", "0; 0"},
                             {"Boundary top/Traction", "0; -x^3"},
                             given::steps("hup3", "1")});
  scene.materials = materials;
  scene.material_at = [layer_is_first](const Point<2> &x)
  { return (x[1] > 0.5) == layer_is_first ? 0 : 1; };
  double result = 0;
  AdaptiveSolver<2>(scene).run([&](const StepReport<2> &step) { result = step.scaled_estimate; });
  return result;
}

/** Each residual counts as the strain that its own material has: which material is the first does not matter. */
TEST(Materials, IndicatorDoesNotDependOnTheirOrder)
{
  for (const double young : {1e-3, 1e3, 1e6})
  {
    const Material other{young, 0.2, soft.plane};
    const double one = scaled_estimate({soft, other}, true);
    EXPECT_NEAR(scaled_estimate({other, soft}, false), one, 1e-12 * one) << young;
    EXPECT_GT(std::abs(scaled_estimate({other, soft}, true) - one), 1e-3 * one) << young;
  }
}
} // namespace
