// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/symmetric_tensor.h>
#include <gtest/gtest.h>
#include <hpvi/reader/closed_forms/hertz.h>
#include <hpvi/reader/closed_forms/partial_slip.h>
#include <hpvi/reader/closed_forms/smooth.h>
#include <hpvi/reader/closed_forms/stick_slip.h>
#include <hpvi/reader/scene_reader.h>

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

const std::array<Material, 3> materials = {{{1., 0.3, PlaneModel::stress},
                                            {1., 0.3, PlaneModel::strain},
                                            {15., 0.4999, PlaneModel::strain}}};

/** Constant bound, u_n = 0. */
std::vector<Problem> sliding_problems()
{
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

constexpr double half_width = 0.6, stick_length = 0.35; ///< of the elliptic problems

/** @p g is the largest pressure, and the largest bound. */
std::vector<Problem> elliptic_problems()
{
  std::vector<Problem> result;
  for (const Material &material : materials)
    for (const double origin : {0., 0.1})
    {
      const double g = 0.03 * material.young;
      result.push_back(
          {"hertz", material, g, origin, std::make_shared<Hertz>(material, g, half_width, origin)});
      result.push_back(
          {"partial_slip", material, g, origin,
           std::make_shared<PartialSlip>(material, g, half_width, stick_length, origin)});
    }
  return result;
}

std::vector<Problem> all_problems()
{
  std::vector<Problem> result = sliding_problems();
  for (const Problem &problem : elliptic_problems())
    result.push_back(problem);
  return result;
}

class SlidingSolutions : public testing::TestWithParam<Problem>
{
};

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

TEST_P(SlidingSolutions, ObeyTheFrictionLaw)
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
  Geometry<2> turned;
  turned.corners =
      quadrilateral_corners({{Point<2>(0, 0), Point<2>(4, -3), Point<2>(7, 1), Point<2>(3, 4)}});
  const Side<2> side = sides_of(turned)[3];
  const Tensor<1, 2> normal({0.6, 0.8});
  for (const Point<2> &x : inside)
  {
    const Tensor<1, 2> expected = stress(*problem.solution, problem.material, x) * normal;
    for (unsigned int d = 0; d < 2; ++d)
    {
      EXPECT_NEAR(ExactTraction<2>(problem.solution, problem.material, side, d).value(x),
                  expected[d], 1e-13 * problem.material.lambda(2));
      EXPECT_EQ(ExactDisplacement<2>(problem.solution, d).value(x),
                problem.solution->displacement(x)[d]);
    }
  }
}

const auto problem_name = [](const auto &info)
{ return info.param.name + std::to_string(info.index); };

INSTANTIATE_TEST_SUITE_P(All, ExactSolutions, testing::ValuesIn(all_problems()), problem_name);
INSTANTIATE_TEST_SUITE_P(All, SlidingSolutions, testing::ValuesIn(sliding_problems()),
                         problem_name);

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

// ---------------------------------------------------------------- Hertz, partial slip

/** Points of the contact edge at distances from its centre that never are a or c. */
std::vector<Point<2>> around(const double centre)
{
  std::vector<Point<2>> points;
  for (const double d : {0., 0.01, 0.2, 0.349, 0.351, 0.5, 0.599, 0.601, 0.8, 5.})
    for (const double sign : {-1., 1.})
      points.emplace_back(centre + sign * d, 0.);
  return points;
}

double half_ellipse(const double d, const double radius)
{
  return d < radius ? std::sqrt(radius * radius - d * d) / half_width : 0.;
}

TEST(HertzContact, ObeysSignorinisConditions)
{
  for (const Problem &problem : elliptic_problems())
    if (problem.name == "hertz")
      for (const Point<2> &x : around(problem.origin))
      {
        const ExactSolution<2> &exact = *problem.solution;
        const Material &material = problem.material;
        const double d = std::abs(x[0] - problem.origin), p = exact.pressure(x);
        const SymmetricTensor<2, 2> sigma = stress(exact, material, x);
        EXPECT_NEAR(p, problem.g * half_ellipse(d, half_width), 1e-13 * problem.g);
        EXPECT_NEAR(-sigma[1][1], p, 1e-12 * material.young);
        EXPECT_NEAR(sigma[0][1], 0., 1e-12 * material.young);
        EXPECT_EQ(exact.multiplier(x), 0.);
        // E* of both plane models, 1/(2R) = p_0/(2 a E*); n = (0, -1).
        const double stiffness = 8 * material.mu() / (1 + material.kolosov()),
                     u_0 = problem.g / half_width / stiffness * d * d,
                     gap = u_0 + exact.displacement(x)[1];
        if (d < half_width)
          EXPECT_NEAR(gap, 0., 1e-15);
        else
          EXPECT_GT(gap, 1e-7);
      }
}

/** E/(1 - nu^2) and E: the elastic modulus under a plane punch. */
TEST(HertzContact, HasTheRadiusOfTheTextbook)
{
  for (const PlaneModel plane : {PlaneModel::strain, PlaneModel::stress})
  {
    const Material material{200., 0.3, plane};
    const double modulus = plane == PlaneModel::strain ? 200. / 0.91 : 200.,
                 slope = 7. / 0.7 / modulus; // 1/(2R)
    const Hertz exact(material, 7., 0.7, 0.);
    EXPECT_NEAR(exact.displacement(Point<2>(0.5, 0.))[1], -0.25 * slope, 1e-15);
  }
}

/** `int sigma n . u` over the boundary of (-2,2) x (0,2), by intervals that shrink towards @p ends. */
double boundary_energy(const ExactSolution<2> &exact, const Material &material,
                       const std::vector<double> &ends)
{
  const QGauss<1> gauss(16);
  double energy = 0;
  const auto integrate = [&](const Point<2> &from, const Point<2> &to, const Tensor<1, 2> &normal)
  {
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const Point<2> x = from + gauss.point(q)[0] * (to - from);
      energy += gauss.weight(q) * from.distance(to) *
                (stress(exact, material, x) * normal * exact.displacement(x));
    }
  };
  for (unsigned int k = 0; k < 8; ++k)
  {
    const double s = -2 + k / 2., y = k / 4.;
    integrate({s, 2.}, {s + 0.5, 2.}, Tensor<1, 2>({0., 1.}));
    integrate({2., y}, {2., y + 0.25}, Tensor<1, 2>({1., 0.}));
    integrate({-2., y}, {-2., y + 0.25}, Tensor<1, 2>({-1., 0.}));
  }
  for (unsigned int e = 0; e + 1 < ends.size(); ++e)
    for (const double from : {ends[e], ends[e + 1]})
    {
      double size = (ends[e] + ends[e + 1]) / 2 - from;
      for (unsigned int level = 0; level < 50; ++level, size /= 2)
      {
        const double a = from + size / 2, b = from + size;
        integrate({std::min(a, b), 0.}, {std::max(a, b), 0.}, Tensor<1, 2>({0., -1.}));
      }
    }
  return energy;
}

/** The numbers of an independent program. */
TEST(HertzContact, EnergyAndResultantOfTheStandardRun)
{
  const Material material{200., 0.3, PlaneModel::strain};
  const Hertz exact(material, 7., 0.7, 0.);
  EXPECT_NEAR(boundary_energy(exact, material, {-2., -0.7, 0.7, 2.}) / 2, 0.133954906582, 1e-12);
  double resultant = 0;
  const QGauss<1> gauss(8);
  for (unsigned int q = 0; q < gauss.size(); ++q) // by angles: the integrand is a cosine's square
  {
    const double angle = numbers::PI * (gauss.point(q)[0] - 0.5);
    resultant += gauss.weight(q) * numbers::PI * 0.7 * std::cos(angle) *
                 exact.pressure(Point<2>(0.7 * std::sin(angle), 0.));
  }
  EXPECT_NEAR(resultant, 7.6969020013, 1e-9);
}

TEST(PartialSlip, ObeysTheFrictionLawWithoutNormalTraction)
{
  for (const Problem &problem : elliptic_problems())
    if (problem.name == "partial_slip")
      for (const Point<2> &x : around(problem.origin))
      {
        const ExactSolution<2> &exact = *problem.solution;
        const double d = std::abs(x[0] - problem.origin), E = problem.material.young,
                     g = problem.g * half_ellipse(d, half_width), lambda = exact.multiplier(x),
                     u_t = exact.displacement(x)[0]; // t = (1, 0) below the body
        const SymmetricTensor<2, 2> sigma = stress(exact, problem.material, x);
        EXPECT_NEAR(sigma[1][1], 0., 1e-12 * E);
        EXPECT_NEAR(sigma[0][1], g * lambda, 1e-12 * E); // sigma_t = -sigma_xy = -g lambda
        EXPECT_NEAR(sigma[0][1], g - problem.g * half_ellipse(d, stick_length), 1e-12 * E);
        if (d < stick_length)
        {
          EXPECT_NEAR(u_t, 0., 1e-16);
          EXPECT_LT(std::abs(lambda), 1.);
        }
        else
        {
          EXPECT_GT(u_t, 1e-7);
          EXPECT_EQ(lambda, 1.);
        }
      }
}

/** Bounded at the ends of the zones, where terms of the formulas are not, and symmetric. */
TEST(EllipticSolutions, AreFiniteAndSymmetric)
{
  for (const Problem &problem : elliptic_problems())
  {
    const ExactSolution<2> &exact = *problem.solution;
    for (const Point<2> &x : exact.singularities())
    {
      EXPECT_TRUE(std::isfinite(exact.displacement(x).norm()));
      EXPECT_LT(exact.gradient(x).norm(), problem.name == "hertz" ? 0.2 : 0.3);
    }
    const bool hertz = problem.name == "hertz";
    EXPECT_EQ(exact.singularities().size(), hertz ? 2U : 4U);
    ASSERT_EQ(exact.transitions().size(), 2U);
    const double end = hertz ? half_width : stick_length;
    EXPECT_EQ(exact.transitions()[0], Point<2>(problem.origin - end, 0.));
    EXPECT_EQ(exact.transitions()[1], Point<2>(problem.origin + end, 0.));
    for (const double y : {0., 1e-9, 0.3, 40.})
    {
      const Tensor<1, 2> left = exact.displacement(Point<2>(problem.origin - 0.7, y)),
                         right = exact.displacement(Point<2>(problem.origin + 0.7, y));
      EXPECT_NEAR(left[0], hertz ? -right[0] : right[0], 1e-15);
      EXPECT_NEAR(left[1], hertz ? right[1] : -right[1], 1e-15);
    }
  }
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

  const Scene<2> hertz = read_scene<2>(scene_file("hertz.prm"));
  ASSERT_NE(hertz.exact_solution, nullptr);
  EXPECT_EQ(hertz.exact_solution->transitions().at(1), Point<2>(0.7, 0.));
  EXPECT_NEAR(hertz.exact_solution->pressure(Point<2>(0., 0.)), 7., 1e-14);

  const Scene<2> partial_slip = read_scene<2>(scene_file("partial-slip.prm"));
  ASSERT_NE(partial_slip.exact_solution, nullptr);
  EXPECT_EQ(partial_slip.exact_solution->transitions().at(1), Point<2>(0.4, 0.));
  EXPECT_NEAR(partial_slip.exact_solution->multiplier(Point<2>(0., 0.)), 1 - 4. / 7, 1e-15);
}
} // namespace
