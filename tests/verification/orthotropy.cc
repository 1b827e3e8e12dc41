// SPDX-License-Identifier: LGPL-2.1-or-later
// Scenes of orthotropic materials: displacement, energies, indicator and bound.
#include "discretisation.h"

#include <hpvi/driver/backend.h>
#include <hpvi/reader/checks/checks.h>
#include <hpvi/reader/scene_reader.h>
#include <hpvi/results/true_error.h>

#include <limits>

using namespace verification;

namespace
{
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/** E2 = 1 and E1 = @p ratio; nu12 and nu21 are at most 0.3. */
Overrides fibres(const double ratio, const double angle, const std::string &plane = "strain")
{
  const std::string nu = in_digits(0.3 * std::min(1., ratio));
  return {{"Material/Elasticity", "orthotropic"},
          {"Material/Plane", plane},
          {"Material/Young's moduli", in_digits(ratio) + ", 1, 1"},
          {"Material/Poisson's ratios", nu + ", " + nu + ", 0.4"},
          {"Material/Shear moduli", "0.5, 1, 1"},
          {"Material/Angle", in_digits(angle)}};
}

/** A displacement with its gradient. */
class Field : public ExactSolution<2>
{
public:
  std::function<Tensor<1, 2>(const Point<2> &)> value;
  std::function<Tensor<2, 2>(const Point<2> &)> slope;

  Tensor<1, 2> displacement(const Point<2> &x) const override
  {
    return value(x);
  }
  Tensor<2, 2> gradient(const Point<2> &x) const override
  {
    return slope(x);
  }
};

/** The left side moves as @p exact says, the others have its traction. */
void prescribe(Scene<2> &scene, const std::shared_ptr<const Field> &exact)
{
  const HookesLaw<2> law(scene.materials[0]);
  for (BoundaryCondition<2> &boundary : scene.boundaries)
    for (unsigned int c = 0; c < 2; ++c)
      if (boundary.name == "left")
        boundary.displacement[c] =
            expression<2>([exact, c](const Point<2> &x) { return exact->displacement(x)[c]; });
      else
        boundary.traction[c] = expression<2>(
            [exact, law, side = sides_of(scene.geometry)[boundary.id], c](const Point<2> &x)
            { return law.traction(exact->gradient(x), side.normal(x))[c]; });
}

/** True error, bound and indicator of a step in energy norm, and that of the solution. */
struct Errors
{
  double energy, bound, indicator, norm;
};

std::vector<Errors> errors_of(const Scene<2> &scene, const std::shared_ptr<const Field> &exact)
{
  std::vector<Errors> result;
  Scene<2> compared = scene; // which no check would let pass
  compared.exact_solution = exact;
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        const TrueErrors errors = TrueError<2>(compared).measure(step.field, step.contact);
        EXPECT_TRUE(step.bound) << step.no_bound;
        result.push_back({errors.energy, step.bound ? step.bound->total : no_number,
                          step.scaled_estimate, errors.energy_norm});
      });
  return result;
}

// ---------------------------------------------------------------- uniform stress

/** The strain of a stress, in the axes of the material and back. */
SymmetricTensor<2, 2> strain_of(const SymmetricTensor<2, 2> &sigma, const Orthotropy &own,
                                const PlaneModel plane)
{
  const double angle = own.angle * numbers::PI / 180;
  const Tensor<2, 2> Q({{std::cos(angle), -std::sin(angle)}, {std::sin(angle), std::cos(angle)}}),
      s = transpose(Q) * Tensor<2, 2>(sigma) * Q;
  const auto &[E1, E2, E3] = own.young;
  const auto &[nu12, nu13, nu23] = own.poisson;
  const double s3 =
      plane == PlaneModel::strain ? E3 * (nu13 / E1 * s[0][0] + nu23 / E2 * s[1][1]) : 0.;
  Tensor<2, 2> e;
  e[0][0] = (s[0][0] - nu12 * s[1][1] - nu13 * s3) / E1;
  e[1][1] = s[1][1] / E2 - nu12 / E1 * s[0][0] - nu23 / E2 * s3;
  e[0][1] = e[1][0] = s[0][1] / (2 * own.shear);
  return symmetrize(Q * e * transpose(Q));
}

const Overrides block = {given::box("2, 1", "2, 2")},
                distorted = {
                    given::quadrilateral("Geometry", "0, 0; 2, 0.3; 1.7, 1.4; -0.2, 1", "2, 2"),
                    {"Error/Bound", "true"}};

std::shared_ptr<const Field> uniform(const SymmetricTensor<2, 2> &strain)
{
  auto exact = std::make_shared<Field>();
  exact->value = [strain](const Point<2> &x) { return strain * x; };
  exact->slope = [strain](const Point<2> &) { return Tensor<2, 2>(strain); };
  return exact;
}

TEST(Orthotropy, UniformStressHasTheStrainInClosedForm)
{
  SymmetricTensor<2, 2> sigma;
  sigma[0][0] = 3, sigma[1][1] = -1, sigma[0][1] = 0.7;
  for (const std::string plane : {"stress", "strain"})
    for (const Overrides &geometry : {block, distorted})
      for (const double angle : {0., 35., -110.})
      {
        SCOPED_TRACE(plane + " " + in_digits(angle));
        Scene<2> scene = scene_of(fibres(20, angle, plane) + geometry +
                                  Overrides{given::steps("hup2", "2"),
                                            {"Adaptivity/Tolerance", "0"},
                                            {"Boundary left/Displacement", "0; 0"}});
        scene.parameters = nullptr;
        const Material &material = scene.materials[0];
        const auto strain = strain_of(sigma, *material.orthotropy, material.plane);
        const auto exact = uniform(strain);
        const double area = scene.geometry.shape == Shape::box ? 2. : 2.135;
        prescribe(scene, exact);
        const std::vector<Errors> steps = errors_of(scene, exact);
        ASSERT_FALSE(steps.empty());
        EXPECT_NEAR(steps[0].norm, std::sqrt(sigma * strain * area), 1e-12 * steps[0].norm);
        EXPECT_LT(steps[0].energy, 1e-12 * steps[0].norm);
        EXPECT_LT(steps[0].indicator, 1e-11 * steps[0].norm);
        EXPECT_LT(steps[0].bound,
                  (geometry == block ? 1e-10 : 1e-5) * steps[0].norm); // a root of round-off
      }
}

/** Hanging nodes and degrees that differ. */
TEST(Orthotropy, UniformStressOnAnyMesh)
{
  Scene<2> scene =
      scene_of(fibres(20, 25) + block + Overrides{{"Boundary left/Displacement", "0; 0"}});
  scene.materials[0].young = scene.materials[0].poisson = no_number;
  SymmetricTensor<2, 2> sigma;
  sigma[0][0] = 3, sigma[0][1] = -0.7;
  const auto exact = uniform(strain_of(sigma, *scene.materials[0].orthotropy, PlaneModel::strain));
  prescribe(scene, exact);
  const RandomMesh mesh(scene, 3, 2);
  const Laboratory discrete(scene, mesh);
  const Solution<2> solution = discrete.solve();
  scene.exact_solution = exact;
  const TrueErrors errors = TrueError<2>(scene).measure(SolutionField(solution), {});
  EXPECT_LT(errors.energy, 1e-12 * errors.energy_norm);
  EXPECT_LT(errors.l2, 1e-12 * solution.u.linfty_norm());
}

// ---------------------------------------------------------------- a smooth field

/** u = (sin(x + 2y), cos(2x - y)) with its body force: errors fall exponentially in p, the bound with them. */
TEST(Orthotropy, SmoothFieldsConvergeExponentially)
{
  auto exact = std::make_shared<Field>();
  exact->value = [](const Point<2> &x) {
    return Tensor<1, 2>({std::sin(x[0] + 2 * x[1]), std::cos(2 * x[0] - x[1])});
  };
  exact->slope = [](const Point<2> &x)
  {
    const double c = std::cos(x[0] + 2 * x[1]), s = std::sin(2 * x[0] - x[1]);
    return Tensor<2, 2>({{c, 2 * c}, {-2 * s, s}});
  };
  const auto curvature = [](const Point<2> &x)
  {
    const double s = -std::sin(x[0] + 2 * x[1]), c = -std::cos(2 * x[0] - x[1]);
    Tensor<3, 2> second;
    const std::array<double, 2> one{{1, 2}}, other{{2, -1}};
    for (unsigned int j = 0; j < 2; ++j)
      for (unsigned int k = 0; k < 2; ++k)
      {
        second[0][j][k] = s * one[j] * one[k];
        second[1][j][k] = c * other[j] * other[k];
      }
    return second;
  };
  for (const double ratio : {10., 1000.})
  {
    Scene<2> scene =
        scene_of(fibres(ratio, 30) + Overrides{{"Geometry/Subdivisions", "2, 2"},
                                               given::steps("pu", "8", "2"),
                                               {"Adaptivity/Tolerance", "0"},
                                               {"Boundary left/Displacement", "0; 0"}});
    scene.parameters = nullptr;
    prescribe(scene, exact);
    const HookesLaw<2> law(scene.materials[0]);
    for (unsigned int c = 0; c < 2; ++c)
      scene.body_force[c] = expression<2>([law, curvature, c](const Point<2> &x)
                                          { return -law.divergence_of_stress(curvature(x))[c]; });
    const std::vector<Errors> steps = errors_of(scene, exact);
    ASSERT_EQ(steps.size(), 8u);
    for (unsigned int k = 0; k < steps.size(); ++k)
    {
      EXPECT_LT(steps[k].energy, k == 0 ? 1. : 0.2 * steps[k - 1].energy) << ratio;
      EXPECT_GE(steps[k].bound, steps[k].energy * (1 - 1e-6)) << ratio;
      // Body forces like E1 oscillate, and count by the least stiffness.
      EXPECT_LE(steps[k].bound, std::sqrt(ratio) * steps[k].energy) << ratio;
    }
  }
}

// ---------------------------------------------------------------- the same in other words

struct Outcome
{
  double energy, norm, estimate, bound, von_mises;
  std::vector<double> u;
};

std::vector<Outcome> outcomes(const Scene<2> &scene)
{
  std::vector<Outcome> result;
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        EXPECT_TRUE(step.bound) << step.no_bound;
        double largest = 0;
        for (const auto &sample : step.extrema)
          largest = std::max(largest, sample.value);
        const Vector<double> &u = step.solution().u;
        result.push_back({step.energies.energy,
                          step.energies.norm,
                          step.scaled_estimate,
                          step.bound->total,
                          largest,
                          {u.begin(), u.end()}});
      });
  return result;
}

/** A material with equal moduli is isotropic in all that is computed. */
TEST(Orthotropy, EqualModuliGiveTheIsotropicSolution)
{
  const Overrides contact = {given::box("2, 1", "4, 2"),
                             {"Boundary left/Displacement", "0; 0"},
                             {"Boundary top/Traction", "0; -1 - x"},
                             given::rough("bottom", "unilateral", "0.1"),
                             {"Body force/Expression", "0; -0.3*x"},
                             given::steps("hpa3", "4"),
                             {"Adaptivity/Tolerance", "0"}};
  for (const std::string plane : {"stress", "strain"})
  {
    const double nu = 0.3, E = 7;
    const std::vector<Outcome> isotropic = outcomes(
        scene_of(contact + Overrides{{"Material/Plane", plane}, given::elastic("7", "0.3")}));
    Scene<2> scene =
        scene_of(contact + Overrides{{"Material/Plane", plane},
                                     {"Material/Elasticity", "orthotropic"},
                                     {"Material/Young's moduli", "7, 7, 7"},
                                     {"Material/Poisson's ratios", "0.3, 0.3, 0.3"},
                                     {"Material/Shear moduli", in_digits(E / 2 / (1 + nu))},
                                     {"Material/Angle", "25"}});
    scene.materials[0].young = scene.materials[0].poisson = no_number; // which nobody may ask for
    const std::vector<Outcome> same = outcomes(scene);
    ASSERT_EQ(same.size(), isotropic.size());
    for (unsigned int k = 0; k < same.size(); ++k)
    {
      const auto &a = same[k], &b = isotropic[k];
      EXPECT_NEAR(a.energy, b.energy, 1e-12 * std::abs(b.energy));
      EXPECT_NEAR(a.estimate, b.estimate, 1e-12 * b.norm);
      EXPECT_NEAR(a.bound, b.bound, 1e-12 * b.norm);
      EXPECT_NEAR(a.von_mises, b.von_mises, 1e-10 * b.von_mises);
      ASSERT_EQ(a.u.size(), b.u.size());
      double largest = 0, difference = 0;
      for (unsigned int i = 0; i < a.u.size(); ++i)
      {
        largest = std::max(largest, std::abs(b.u[i]));
        difference = std::max(difference, std::abs(a.u[i] - b.u[i]));
      }
      EXPECT_LT(difference, 1e-12 * largest);
    }
  }
}

/**
 * A strip whose fibres rise to the right is pulled: they turn towards the load, and its end sinks. By a small load across
 * it: J is quadratic, and its slope is the work of that load.
 */
TEST(Orthotropy, TensionOffAxisMovesTheEndAside)
{
  const auto energy = [](const double angle, const std::string &across)
  {
    double J = 0;
    each_step<2>(scene_of(fibres(30, angle) + Overrides{given::box("6, 1", "6, 1"),
                                                        {"Boundary left/Displacement", "0; 0"},
                                                        {"Boundary right/Traction", "1; " + across},
                                                        given::steps("hup4", "1")}),
                 [&](const StepReport<2> &step) { J = step.energies.energy; });
    return J;
  };
  const auto rise = [&](const double angle)
  { return (energy(angle, "-1") - energy(angle, "1")) / 2; };
  const double gamma =
      2 * strain_of(symmetrize(outer_product(Point<2>(1, 0), Point<2>(1, 0))),
                    {{{30, 1, 1}}, {{0.3, 0.3, 0.4}}, 0.5, 30}, PlaneModel::strain)[0][1];
  EXPECT_LT(gamma, -0.1);
  EXPECT_NEAR(rise(30), 6 * gamma, 0.3 * std::abs(6 * gamma)); // but for what the clamp holds
  EXPECT_NEAR(rise(-30), -rise(30), 1e-9);
}

// ---------------------------------------------------------------- what is not offered, and words

/** The message of a scene that no run may take. */
template <int dim>
std::string refusal(const Scene<dim> &scene)
{
  return failure_of<InputError>([&] { check(scene); });
}

TEST(Orthotropy, IsRefusedWhereItIsNotOffered)
{
  Scene<2> plane = scene_of(fibres(3, 10) + Overrides{{"Boundary left/Displacement", "0; 0"}});
  EXPECT_EQ(refusal(plane), "");
  plane.parameters = nullptr;
  plane.materials[0].orthotropy->poisson[0] = 2;
  EXPECT_NE(refusal(plane).find("Poisson's ratios = 2: has nu12^2"), std::string::npos)
      << refusal(plane);
  plane = scene_of(fibres(3, 10) + Overrides{{"Boundary left/Displacement", "0; 0"}});
  plane.exact_solution = uniform(SymmetricTensor<2, 2>());
  EXPECT_NE(refusal(plane).find("isotropic"), std::string::npos) << refusal(plane);
}

/** Not even where that would be faster. */
TEST(Orthotropy, NeverTakesThePrimalPath)
{
  const Overrides large = {{"Geometry/Subdivisions", "400, 1"},
                           {"Adaptivity/Tolerance", "0"},
                           {"Adaptivity/Method", "hup4"},
                           {"Boundary left/Displacement", "0; 0"},
                           given::rough("bottom", "bilateral", "1")};
  EXPECT_EQ(scene_of(large).solver.path, SolutionPath::primal);
  EXPECT_EQ(scene_of(large + fibres(3, 10)).solver.path, SolutionPath::automatic);
}

TEST(Orthotropy, ScenePrmIsTheSameScene)
{
  const Scene<2> scene =
      scene_of(fibres(7, -12.5, "stress") + Overrides{{"Boundary left/Displacement", "0; 0"},
                                                      {"Material core/Where", "x - 0.5"},
                                                      {"Material core/Angle", "40"},
                                                      {"Material rim/Where", "y - 0.5"},
                                                      {"Material rim/Elasticity", "isotropic"},
                                                      given::elastic("2", "0.2", "rim")});
  const auto file = std::filesystem::path(::testing::TempDir()) /
                    ("hpvi-" + std::to_string(std::random_device()()) + ".prm");
  std::ofstream(file) << effective_parameters(scene);
  const Scene<2> again = read_scene<2>(file.string(), {});
  std::filesystem::remove(file);
  EXPECT_EQ(effective_parameters(again), effective_parameters(scene));
  ASSERT_EQ(again.materials.size(), 3u);
  const std::array<double, 2> angles{{-12.5, 40}};
  for (unsigned int m = 0; m < 2; ++m)
  {
    ASSERT_TRUE(again.materials[m].orthotropy);
    EXPECT_EQ(again.materials[m].orthotropy->young[0], 7);
    EXPECT_EQ(again.materials[m].orthotropy->angle, angles[m]);
  }
  EXPECT_FALSE(again.materials[2].orthotropy);
  EXPECT_EQ(again.materials[2].young, 2);
}

TEST(Orthotropy, WarnsOfLockingFibres)
{
  for (const double ratio : {10., 1000.})
    for (const unsigned int degree : {2, 4})
    {
      std::vector<std::string> words;
      each_step<2>(scene_of(fibres(ratio, 30) +
                            Overrides{{"Boundary left/Displacement", "0; 0"},
                                      {"Boundary right/Traction", "0; 1e-4"},
                                      given::steps("hup" + std::to_string(degree), "1")}),
                   [&](const StepReport<2> &step)
                   {
                     for (const auto &warning : step.warnings)
                       words.push_back(warning.text);
                   });
      EXPECT_EQ(mentions(words,
                         "times as stiff against one strain as against another and elements of "
                         "degree 2 may lock"),
                ratio > 100 && degree == 2);
    }
}

// ---------------------------------------------------------------- bound

struct Case
{
  double ratio, angle;
  std::string plane;
};

using OrthotropicBound = ::testing::TestWithParam<Case>;

/** A finer run has less energy: half the square of the error. */
TEST_P(OrthotropicBound, HoldsAndIsNear)
{
  const Case &own = GetParam();
  const auto scene = [&](const std::string &method, const unsigned int steps)
  {
    return scene_of(fibres(own.ratio, own.angle, own.plane) +
                    Overrides{given::box("2, 1", "4, 2"),
                              {"Boundary left/Displacement", "0; 0"},
                              given::rough("bottom", "bilateral", "0.1"),
                              {"Boundary top/Traction", "0; -x*(2 - x)"},
                              given::steps(method, std::to_string(steps)),
                              {"Adaptivity/Tolerance", "0"}});
  };
  expect_bounds(scene, 16, {"hup2", "hup4", "hpa3"}, 3.,
                [](const StepReport<2> &step, const double error)
                { EXPECT_GT(step.scaled_estimate, error); });
}

INSTANTIATE_TEST_SUITE_P(All, OrthotropicBound,
                         ::testing::Values(Case{10, 0, "strain"}, Case{10, 30, "stress"},
                                           Case{100, 30, "strain"}, Case{1000, 0, "stress"},
                                           Case{1000, 30, "strain"}, Case{0.01, -70, "strain"}));
} // namespace
