// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/symmetric_tensor.h>
#include <gtest/gtest.h>
#include <hpvi/scene/exact_solution.h>
#include <hpvi/scene/scene_reader.h>

#include <array>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

namespace
{
using namespace dealii;
using namespace hpvi;

SymmetricTensor<2, 2> stress(const ExactSolution<2> &solution, const Material &material,
                             const Point<2> &x)
{
  const SymmetricTensor<2, 2> strain = symmetrize(solution.gradient(x));
  return material.lambda(2) * trace(strain) * unit_symmetric_tensor<2>() +
         2 * material.mu() * strain;
}

Point<2> shifted(Point<2> x, const unsigned int direction, const double step)
{
  x[direction] += step;
  return x;
}

/** Points of (-1,1) x (0,1) away from any transition used below. */
const std::vector<Point<2>> inside = {{-0.9, 0.05}, {-0.4, 0.6}, {0., 0.3},  {0.15, 0.2},
                                      {0.5, 0.02},  {0.7, 0.9},  {0.95, 0.4}};

const std::vector<double> along_contact = {-1., -0.7, -0.25, -0.01, 0.05, 0.2, 0.5, 0.8, 1.};

struct Problem
{
  std::string name;
  Material material;
  double g, origin;
  std::shared_ptr<const ExactSolution<2>> solution;
};

std::vector<Problem> problems()
{
  const std::array<Material, 3> materials = {{{1., 0.3, PlaneModel::stress},
                                              {1., 0.3, PlaneModel::strain},
                                              {15., 0.4999, PlaneModel::strain}}};
  std::vector<Problem> result;
  for (const Material &material : materials)
    for (const double origin : {0., 0.1})
    {
      const double g = 0.3 * material.young;
      result.push_back({"stick_slip", material, g, origin,
                        std::make_shared<StickSlip>(material, g, origin, 0.8)});
      result.push_back(
          {"smooth", material, g, origin, std::make_shared<Smooth>(material, g, origin, 0.7)});
    }
  return result;
}

class ExactSolutions : public testing::TestWithParam<Problem>
{
};

TEST_P(ExactSolutions, GradientIsThatOfTheDisplacement)
{
  const ExactSolution<2> &exact = *GetParam().solution;
  const double h = 1e-5;
  for (const Point<2> &x : inside)
    for (unsigned int j = 0; j < 2; ++j)
    {
      const Tensor<1, 2> difference =
          exact.displacement(shifted(x, j, h)) - exact.displacement(shifted(x, j, -h));
      for (unsigned int i = 0; i < 2; ++i)
        EXPECT_NEAR(exact.gradient(x)[i][j], difference[i] / (2 * h), 1e-7);
    }
}

TEST_P(ExactSolutions, StressIsInEquilibriumWithoutBodyForce)
{
  const Problem &problem = GetParam();
  const auto sigma = [&](const Point<2> &x)
  { return stress(*problem.solution, problem.material, x); };
  const double h = 1e-5;
  for (const Point<2> &x : inside)
  {
    Tensor<1, 2> divergence;
    for (unsigned int j = 0; j < 2; ++j)
      for (unsigned int i = 0; i < 2; ++i)
        divergence[i] += (sigma(shifted(x, j, h))[i][j] - sigma(shifted(x, j, -h))[i][j]) / (2 * h);
    EXPECT_LT(divergence.norm(), 1e-5 * problem.material.young);
  }
}

TEST_P(ExactSolutions, ObeysTheFrictionLaw)
{
  const Problem &problem = GetParam();
  for (const double x : along_contact)
  {
    const Point<2> point(x, 0.);
    const Tensor<1, 2> u = problem.solution->displacement(point);
    const double lambda = problem.solution->multiplier(point);
    EXPECT_NEAR(u[1], 0., 1e-14);
    EXPECT_LE(std::abs(lambda), 1. + 1e-14);
    EXPECT_NEAR(lambda * u[0], std::abs(u[0]), 1e-14); // t = (1, 0) below the body
    // n = (0, -1): sigma_t = -sigma_xy = -g lambda
    EXPECT_NEAR(stress(*problem.solution, problem.material, point)[0][1], problem.g * lambda,
                1e-12 * problem.material.young);
  }
}

TEST_P(ExactSolutions, TractionIsStressTimesNormal)
{
  const Problem &problem = GetParam();
  const Tensor<1, 2> normal({0.6, 0.8});
  for (const Point<2> &x : inside)
  {
    const Tensor<1, 2> expected = stress(*problem.solution, problem.material, x) * normal;
    for (unsigned int d = 0; d < 2; ++d)
    {
      EXPECT_NEAR(ExactTraction<2>(problem.solution, problem.material, normal, d).value(x),
                  expected[d], 1e-13 * problem.material.lambda(2));
      EXPECT_EQ(ExactDisplacement<2>(problem.solution, d).value(x),
                problem.solution->displacement(x)[d]);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, ExactSolutions, testing::ValuesIn(problems()),
                         [](const auto &info)
                         { return info.param.name + std::to_string(info.index); });

/** Hooke's law from the gradient against Kolosov's formulas, here with the root of w = -z. */
TEST(StickSlip, StressIsThatOfThePotentials)
{
  const Material material{1., 0.3, PlaneModel::stress};
  const double g = 0.3, c = 0.1, kappa = 2.7 / 1.3, A = g / (1.5 * (1 + kappa));
  const StickSlip exact(material, g, c, 1.);
  for (const Point<2> &x : inside)
  {
    const std::complex<double> z(x[0] - c, x[1]), root = std::sqrt(-z);
    const std::complex<double> phi_1 = -1.5 * A * root, phi_2 = 0.75 * A / root,
                               psi_1 = 1.5 * (kappa + 1.5) * A * root;
    const std::complex<double> deviator = 2. * (std::conj(z) * phi_2 + psi_1);
    const SymmetricTensor<2, 2> sigma = stress(exact, material, x);
    EXPECT_NEAR(trace(sigma), 4 * phi_1.real(), 1e-13);
    EXPECT_NEAR(sigma[1][1] - sigma[0][0], deviator.real(), 1e-13);
    EXPECT_NEAR(sigma[0][1], deviator.imag() / 2 + g, 1e-13);
  }
}

TEST(StickSlip, SticksRightOfTheTransitionOnly)
{
  const Material material{1., 0.3, PlaneModel::stress};
  const double g = 0.3, c = 0.1, L = 0.5;
  const StickSlip exact(material, g, c, L);
  ASSERT_EQ(exact.transitions().size(), 1u);
  EXPECT_EQ(exact.transitions()[0], Point<2>(c, 0.));
  EXPECT_EQ(exact.multiplier(Point<2>(c - 0.3, 0.)), 1.);
  EXPECT_GT(exact.displacement(Point<2>(c - 0.3, 0.))[0], 0.01);
  EXPECT_NEAR(exact.displacement(Point<2>(c + 0.3, 0.)).norm(), 0., 1e-15);
  EXPECT_NEAR(exact.multiplier(Point<2>(c + L, 0.)), 0., 1e-15);
  EXPECT_NEAR(exact.multiplier(Point<2>(c + 4 * L, 0.)), -1., 1e-15);
  const Tensor<2, 2> slope = exact.gradient(Point<2>(c, 0.)); // finite where phi'' is not
  EXPECT_NEAR(slope[0][1], g / material.mu(), 1e-15);
  // A round-off below the edge is still this side of the branch cut.
  EXPECT_NEAR(
      (exact.displacement(Point<2>(0.6, -1e-17)) - exact.displacement(Point<2>(0.6, 0.))).norm(),
      0., 1e-14);
}

/** `int sigma : eps` over a square whose corner @p tip is the transition, in dyadic L shapes. */
double graded_energy(const ExactSolution<2> &exact, const Material &material, const Point<2> &tip,
                     const double signed_size)
{
  const QGauss<2> gauss(12);
  double energy = 0, size = 0.5;
  for (unsigned int level = 0; level < 40; ++level, size /= 2)
    for (unsigned int quarter = 1; quarter < 4; ++quarter)
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const Point<2> unit = size * (Point<2>(quarter % 2, quarter / 2) + gauss.point(q));
        const Point<2> x = tip + Point<2>(signed_size * unit[0], unit[1]);
        energy += gauss.weight(q) * size * size *
                  (stress(exact, material, x) * symmetrize(exact.gradient(x)));
      }
  return energy;
}

TEST(StickSlip, EnergyOfTheStandardRun)
{
  const Material material{1., 0.3, PlaneModel::stress};
  const StickSlip exact(material, 0.3, 0., 1.);
  const double energy = graded_energy(exact, material, Point<2>(), -1.) +
                        graded_energy(exact, material, Point<2>(), 1.);
  EXPECT_NEAR(energy, 0.37710185557, 1e-11);
}

std::string scene_file(const std::string &name)
{
  return "prm/" + name;
}

TEST(ExactSolution, BoundariesTakeItByName)
{
  const Scene<2> scene = read_scene<2>(scene_file("stick-slip.prm"));
  ASSERT_NE(scene.exact_solution, nullptr);
  EXPECT_EQ(scene.exact_solution->transitions().at(0), Point<2>(0., 0.));
  const Point<2> corner(-1., 0.);
  EXPECT_EQ(scene.boundaries[0].displacement[0]->value(corner),
            scene.exact_solution->displacement(corner)[0]);
  // kappa A / mu with A = g/(1.5 (1 + kappa)) = 0.065
  EXPECT_NEAR(scene.exact_solution->displacement(corner)[0], 0.351, 1e-14);

  const Scene<2> smooth = read_scene<2>(scene_file("smooth.prm"));
  EXPECT_TRUE(smooth.exact_solution->singularities().empty());
  EXPECT_TRUE(smooth.boundaries[3].has_traction());
}
} // namespace
