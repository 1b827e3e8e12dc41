// SPDX-License-Identifier: LGPL-2.1-or-later
// Bodies of revolution against closed forms: tubes, shafts, and a sleeve that rubs in a ring.
#include "discretisation.h"

#include <hpvi/results/equilibrium.h>
#include <hpvi/results/residual_estimator.h>

#include <complex>

using namespace verification;

namespace
{
constexpr double pi = numbers::PI, young = 10, poisson = 0.3, mu = young / 2.6,
                 lambda = young * 0.3 / (1.3 * 0.4);

const Overrides turned = {given::elastic("10", "0.3"),
                          {"Material/Plane", "axisymmetric"},
                          {"Geometry/Subdivisions", "2, 2"}};
const Overrides ring =
    turned + Overrides{{"Geometry/Lower corner", "1, 0"}, {"Geometry/Upper corner", "2, 1"}};
const Overrides flat_ends = {{"Boundary bottom/Displacement", "free; 0"},
                             {"Boundary top/Displacement", "free; 0"}};

struct Step
{
  double J, elastic, indicator, slip = 0, normal_resultant = 0;
  Equilibrium<2> forces;
};

/** With one degree after the other on the coarse mesh. */
std::vector<Step> steps_of(const Overrides &entries, const unsigned int degree,
                           const unsigned int n_steps)
{
  std::vector<Step> result;
  each_step<2>(scene_of(entries + Overrides{given::steps("pu", std::to_string(n_steps),
                                                         std::to_string(degree))}),
               [&](const StepReport<2> &step)
               {
                 result.push_back({step.energies.energy, 0.5 * std::pow(step.energies.norm, 2),
                                   step.norms.total, 0, 0, step.equilibrium});
                 if (!step.contact.empty())
                 {
                   result.back().slip = step.contact[0].points[0].slip;
                   result.back().normal_resultant = step.contact[0].normal_resultant;
                 }
                 EXPECT_LT(step.equilibrium.force_imbalance, 1e-10);
               });
  return result;
}

/** u = A r + B/r under the pressure 1 inside. */
TEST(Axisymmetric, TubeUnderPressureConvergesExponentially)
{
  const double B = 1 / (1.5 * mu), A = mu * B / (4 * (lambda + mu)), J = -pi * (A + B);
  const std::vector<Step> steps =
      steps_of(ring + flat_ends + Overrides{{"Boundary left/Pressure", "1"}}, 2, 8);
  for (unsigned int k = 0; k < steps.size(); ++k)
  {
    const double square = steps[k].J - J; // half of that of the error
    EXPECT_GT(square, -1e-12);
    EXPECT_LT(square, 2e-2 * std::pow(0.05, k) * std::abs(J) + 1e-13) << k;
    if (square > 1e-7 * std::abs(J))
    {
      EXPECT_GT(steps[k].indicator, std::sqrt(2 * square));
      EXPECT_LT(steps[k].indicator, 20 * std::sqrt(2 * square));
    }
  }
  EXPECT_NEAR(steps.back().J, J, 1e-13);
  EXPECT_TRUE(std::isnan(steps.back().forces.loads.force[0]));
}

/** F = (x, 0): u = C r - r^3/(8 (lambda + 2 mu)), in the space from p = 3 on, the axis included. */
TEST(Axisymmetric, RotatingShaftIsExact)
{
  const double D = 1 / (8 * (lambda + 2 * mu)),
               C = (3 * (lambda + 2 * mu) + lambda) * D / (2 * (lambda + mu)),
               J = -pi * (C / 4 - D / 6);
  const std::vector<Step> steps =
      steps_of(turned + flat_ends + Overrides{{"Body force/Expression", "x; 0"}}, 2, 4);
  EXPECT_GT(steps[0].J, J * (1 - 1e-4));
  for (unsigned int k = 1; k < steps.size(); ++k)
  {
    EXPECT_NEAR(steps[k].J, J, 1e-14);
    EXPECT_LT(steps[k].indicator, 1e-11);
  }
}

/** u = (a x, b y) has a uniform stress: exact on skew cells with hanging nodes and any degrees. */
TEST(Axisymmetric, UniformStressOnAnyMesh)
{
  const Overrides skew = {given::elastic("10", "0.3"),
                          {"Material/Plane", "axisymmetric"},
                          {"Geometry/Shape", "quadrilateral"},
                          {"Geometry/Subdivisions", "3, 2"}};
  for (const char *const corners : {"0, 0; 2, 0; 1.6, 1; 0, 1.2", "0.5, 0; 2, 0.3; 1.6, 1.5; 1, 1"})
  {
    Scene<2> scene = scene_of(skew + Overrides{{"Geometry/Corners", corners},
                                               {"Boundary top/Displacement", "0.02*x; -0.01*y"},
                                               {"Boundary bottom/Displacement", "0.02*x; -0.01*y"},
                                               {"Boundary right/Displacement", "0.02*x; -0.01*y"}});
    if (!scene.boundary("left").symmetry)
      for (unsigned int c = 0; c < 2; ++c)
        scene.boundary("left").displacement[c] =
            expression<2>([c](const Point<2> &x) { return c == 0 ? 0.02 * x[0] : -0.01 * x[1]; });
    const RandomMesh mesh(scene, 5, 2, 1, 6);
    const Laboratory discrete(scene, mesh);
    const Solution<2> solution = discrete.solve();
    for (const auto &cell : discrete.displacement_space.dof_handler().active_cell_iterators())
    {
      const auto dofs = discrete.displacement_space.cell_dofs(cell->active_cell_index());
      const CellMap<2> map = map_of<2>(cell);
      for (unsigned int i = 0; i < dofs.size(); ++i)
      {
        const Point<2> x = map.point(cell->get_fe().get_unit_support_points()[i]);
        const unsigned int c = cell->get_fe().system_to_component_index(i).first;
        EXPECT_NEAR(solution.u[dofs[i]], c == 0 ? 0.02 * x[0] : -0.01 * x[1], 1e-14);
      }
    }
    for (const double eta : estimate_error(SolutionField<2>(solution)).volume)
      EXPECT_LT(eta, 1e-20);
  }
}

/** Element matrices of one class are the same: along the axis cells may move, away from it they may not. */
TEST(Axisymmetric, ClassesOfCells)
{
  const Scene<2> scene = scene_of(ring + flat_ends);
  const ShapeTables<2> tables;
  const ElementMatrices<2> elements(scene, tables);
  const auto square = [](const double x, const double y, const double h) {
    return CellMap<2>({{{x, y}, {x + h, y}, {x, y + h}, {x + h, y + h}}});
  };
  const auto of = [&](const CellMap<2> &map) { return elements.congruence_class(map, 3, 0); };
  EXPECT_EQ(of(square(1, 0, 0.5)), of(square(1, 3, 0.5)));
  EXPECT_NE(of(square(1, 0, 0.5)), of(square(1.5, 0, 0.5)));
  EXPECT_NE(of(square(1, 0, 0.5)), of(square(2, 0, 1)));
}

/** Pulled at r = 1 by W, held at r = 2 by a ring: u_z = W + K/mu ln r. */
struct Sleeve
{
  std::string friction;
  double u_i, W, K, slip, elastic;
};

TEST(Axisymmetric, SleeveInARing)
{
  for (const Sleeve &sleeve :
       {Sleeve{"bound", .01, .02, -.1109765416, 0, .012208849513},
        Sleeve{"coefficient", .02, .06, -.1076923077, .0405918789, .027510210619}})
  {
    const bool sticks = sleeve.slip == 0;
    const double K = sticks ? -mu * sleeve.W / std::log(2.) : sleeve.K,
                 s = -2 * lambda * sleeve.u_i / 3;
    const auto traction = [&](const double sign)
    { return in_digits(sign * K) + "/x; " + in_digits(sign * s); };
    const std::vector<Step> steps = steps_of(
        ring + Overrides{{"Boundary left/Displacement",
                          in_digits(sleeve.u_i) + "; " + in_digits(sleeve.W)},
                         {"Boundary right/Contact", "bilateral"},
                         {"Boundary right/Friction " + sleeve.friction, sticks ? "0.2" : "0.3"},
                         {"Boundary top/Traction", traction(1)},
                         {"Boundary bottom/Traction", traction(-1)}},
        2, 9);
    EXPECT_NEAR(steps.back().elastic, sleeve.elastic, 2e-8);
    EXPECT_NEAR(steps.back().slip, sleeve.slip, 1e-8);
    EXPECT_NEAR(steps.back().forces.reactions.back().force[1], 2 * pi * K, 1e-7);
    // T_n = s_rr(2) = 2 (lambda + mu) A - 2 mu B/4 with A = -u_i/3, B = -4A
    const double A = -sleeve.u_i / 3;
    EXPECT_NEAR(steps.back().normal_resultant, 2 * pi * 2 * (2 * (lambda + mu) * A + 2 * mu * A),
                1e-6);
  }
}

/** A cylinder under a plate: the force is that of the full turn, and contact carries it. */
TEST(Axisymmetric, PlateOnACylinder)
{
  const Overrides block = {{"Boundary top/Rigid", "true"},
                           {"Boundary top/Force", "free; -3"},
                           {"Boundary bottom/Contact", "unilateral"},
                           {"Material/Poisson's ratio", "0"}};
  const std::vector<Step> steps = steps_of(turned + block, 3, 1);
  const PlateState<2> &plate = steps[0].forces.plates[0];
  EXPECT_NEAR(plate.displacement[1], -3 / (pi * young), 1e-12);
  EXPECT_NEAR(plate.displacement[0], 0, 1e-14);
  EXPECT_NEAR(steps[0].normal_resultant, -3, 1e-10);
  EXPECT_NEAR(steps[0].elastic, 0.5 * 9 / (pi * young), 1e-10);
}

/** All that is weighed by 2 pi x, of one step. */
std::vector<double> amounts(const StepReport<2> &step)
{
  const ContactState<2> &contact = step.contact.at(0);
  const EstimateNorms &norms = step.norms;
  std::vector<double> result{
      step.energies.energy,     step.energies.lagrangian,       std::pow(step.energies.norm, 2),
      contact.normal_resultant, contact.friction_resultant,     contact.area,
      contact.slipping_area,    step.equilibrium.loads.force[1]};
  for (const double part : {norms.volume, norms.jumps, norms.neumann, norms.contact, norms.normal})
    result.push_back(part * part);
  for (const BoundaryForce<2> &reaction : step.equilibrium.reactions)
    result.push_back(reaction.force[1]);
  return result;
}

/**
 * A hundred thousand times as far from the axis as it is wide a body is as in plane strain, 2 pi x times over: energies, forces, the
 * measure of contact, and each part of the indicator.
 */
TEST(Axisymmetric, FarFromTheAxisIsPlaneStrain)
{
  constexpr double radius = 2e5;
  const auto steps = [&](const std::string &plane, const std::string &friction)
  {
    const std::string x = "(x - " + in_digits(radius) + ")";
    std::vector<std::vector<double>> result;
    each_step<2>(
        scene_of({given::elastic("10", "0.3"),
                  {"Material/Plane", plane},
                  {"Material/Density", "0.1"},
                  {"Material/Initial strain", "0; 0; 0.02*" + x + "^2; 0.01*y"},
                  {"Body force/Gravity", "0; -1"},
                  given::box(in_digits(radius) + ", 0", in_digits(radius + 2) + ", 1", "4, 2"),
                  {"Boundary left/Displacement", "0; free"},
                  {"Boundary right/Spring", "2; 1"},
                  {"Boundary top/Pressure", "1 + " + x + "^2"},
                  {"Boundary bottom/Contact", "unilateral"},
                  {"Boundary bottom/Gap", "0.05*" + x},
                  {"Boundary bottom/" + friction, "0.1*(1 + " + x + ")"},
                  {"Solver/Normal contact", "multiplier"},
                  given::steps("hup3", "2")}),
        [&](const StepReport<2> &step) { result.push_back(amounts(step)); });
    return result;
  };
  for (const char *const friction : {"Friction bound", "Friction coefficient"})
  {
    const auto round = steps("axisymmetric", friction), flat = steps("strain", friction);
    ASSERT_EQ(round.size(), flat.size());
    for (unsigned int k = 0; k < flat.size(); ++k)
    {
      ASSERT_EQ(round[k].size(), flat[k].size());
      for (unsigned int i = 0; i < flat[k].size(); ++i)
        EXPECT_NEAR(round[k][i] / (2 * pi * radius), flat[k][i], 1e-4 * std::abs(flat[k][i]))
            << friction << ' ' << k << ' ' << i;
    }
  }
}

/** Longer by a thousand, or its ends changed about: the same body. */
TEST(Axisymmetric, ScaledAndMirrored)
{
  const auto energies = [](const double length, const double up)
  {
    const std::string x = "(x/" + in_digits(length) + ")", y = "(y/" + in_digits(up * length) + ")";
    const std::string base = up > 0 ? "bottom" : "top", roof = up > 0 ? "top" : "bottom";
    std::vector<double> result;
    each_step<2>(
        scene_of(
            {given::elastic("10", "0.3"),
             {"Material/Plane", "axisymmetric"},
             {"Material/Thermal expansion", "0.01"},
             {"Temperature/Expression", x + "^2 + " + y},
             given::box("0, " + in_digits(up > 0 ? 0. : -length),
                        in_digits(2 * length) + ", " + in_digits(up > 0 ? length : 0.), "4, 2"),
             {"Boundary right/Spring", in_digits(2 / length) + "; " + in_digits(1 / length)},
             {"Boundary " + roof + "/Pressure", "1 + " + x + "^2"},
             {"Boundary " + base + "/Contact", "unilateral"},
             {"Boundary " + base + "/Friction coefficient", "0.1"},
             given::steps("hpa3", "3")}),
        [&](const StepReport<2> &step)
        {
          result.push_back(step.energies.energy / std::pow(length, 3));
          result.push_back(std::pow(step.norms.total, 2) / std::pow(length, 3));
        });
    return result;
  };
  const std::vector<double> here = energies(1, 1);
  for (const auto &[length, up] : {std::pair{1., -1.}, {1000., 1.}, {0.01, -1.}})
  {
    const std::vector<double> there = energies(length, up);
    ASSERT_EQ(there.size(), here.size());
    for (unsigned int i = 0; i < here.size(); ++i)
      EXPECT_NEAR(there[i] / here[i], 1, i % 2 == 0 ? 1e-10 : 1e-8)
          << length << ' ' << up << ' ' << i;
  }
}

/** A cylinder of radius 1 and height 2 by a mesh file, of which @p axis has x of the lowest node and of the middle one there;
 * the edges between them are a group, or in none. */
std::string cylinder_file(const std::array<double, 2> &axis, const bool is_named = true)
{
  const auto file = std::filesystem::path(::testing::TempDir()) /
                    ("hpvi-cylinder" + in_digits(axis[0]) + in_digits(axis[1]) +
                     (is_named ? "" : "-unnamed") + ".msh");
  std::ofstream(file)
      << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n"
      << (is_named ? "4\n1 1 \"left\"\n" : "3\n")
      << "1 2 \"bottom\"\n1 3 \"right\"\n2 4 \"body\"\n$EndPhysicalNames\n$Nodes\n6\n1 "
      << in_digits(axis[0]) << " 0 0\n2 1 0 0\n3 1 1 0\n4 " << in_digits(axis[1])
      << " 1 0\n5 1 2 0\n6 " << in_digits(axis[0]) << " 2 0\n$EndNodes\n$Elements\n"
      << (is_named ? "7\n1 1 2 1 1 1 4\n2 1 2 1 1 4 6\n" : "5\n")
      << "3 1 2 2 2 1 2\n4 1 2 3 3 2 3\n5 1 2 3 3 3 5\n6 3 2 4 4 1 2 3 4\n7 3 2 4 4 4 3 5 "
         "6\n$EndElements\n";
  return file.string();
}

/** A drawing has its axis at x = 0 to round-off: what is nearer than 1e-10 of the size is there, and u_x = 0. */
TEST(Axisymmetric, AxisOfADrawing)
{
  const auto file = [](const double one, const double other, const bool is_named = true)
  {
    return Overrides{{"Geometry/Shape", "file"},
                     {"Geometry/File", cylinder_file({{one, other}}, is_named)},
                     {"Geometry/Subdivisions", "1, 1"}};
  };
  const auto quadrilateral = [](const std::string &one, const std::string &other) {
    return Overrides{given::quadrilateral("Geometry", one + ", 0; 1, 0; 1, 2; " + other + ", 2")};
  };
  const std::vector<Overrides> rows{
      file(0, 0),
      file(-1.8e-15, 0),
      file(6e-16, 6e-16),
      file(1e-10, -1e-10),
      file(-2e-10, 1e-16),
      quadrilateral("-1.8e-15", "6e-16"),
      quadrilateral("1e-11", "0"),
      {{"Geometry/Lower corner", "-1e-12, 0"}, {"Geometry/Upper corner", "1, 2"}}};
  // Under the pressure 1 around it u = (-(1 - nu) x, 2 nu y)/E.
  const double J = -(1 - poisson) / young * 2 * pi;
  for (const Overrides &row : rows)
  {
    const Overrides entries =
        turned + row +
        Overrides{{"Boundary bottom/Symmetry", "true"}, {"Boundary right/Pressure", "1"}};
    const Scene<2> scene = scene_of(entries);
    EXPECT_TRUE(std::any_of(scene.boundaries.begin(), scene.boundaries.end(),
                            [](const BoundaryCondition<2> &side)
                            { return side.name == "left" && side.symmetry; }))
        << row[1].second;
    EXPECT_NEAR(steps_of(entries, 2, 1)[0].J, J, 1e-12) << row[1].second;
  }
  // Edges there that are in no group need no support of their own.
  EXPECT_NEAR(steps_of(turned + file(0, 0, false) +
                           Overrides{{"Boundary bottom/Symmetry", "true"},
                                     {"Boundary right/Pressure", "1"}},
                       2, 1)[0]
                  .J,
              J, 1e-12);
  for (const Overrides &row : {file(-1e-9, 0), quadrilateral("-1e-9", "0")})
    EXPECT_THROW(scene_of(turned + row + Overrides{{"Boundary bottom/Symmetry", "true"}}),
                 InputError);
}

/** Heat in all directions: free it strains without stress, held it presses everywhere alike. */
TEST(Axisymmetric, Heat)
{
  const Overrides hot = {{"Material/Thermal expansion", "0.001"}, {"Temperature/Expression", "10"}};
  for (const Overrides &body : {turned, ring})
  {
    const std::vector<Step> free =
        steps_of(body + hot + Overrides{{"Boundary bottom/Displacement", "free; 0"}}, 2, 1);
    const double volume = body == turned ? pi : 3 * pi, C = 0.5 * 3 * young / (1 - 2 * poisson);
    EXPECT_NEAR(free[0].J, -C * 1e-4 * volume, 1e-12);
    const std::string left =
        body == turned ? "Boundary bottom/Displacement" : "Boundary left/Displacement";
    const std::vector<Step> held =
        steps_of(body + hot + flat_ends +
                     Overrides{{"Boundary right/Displacement", "0; free"},
                               {left, body == turned ? "free; 0" : "0; free"}},
                 2, 1);
    EXPECT_NEAR(held[0].elastic, 0, 1e-14); // a(u,u)/2 of u = 0
  }
}

using Complex = std::complex<double>;

/** What a potential of the half space z > 0 is made of, at zeta = z + i a. */
struct Potentials
{
  Complex L, I1, I2, dL, dI1, dI2, dI3;
  Complex inverse_R;

  Potentials(const double r, const double z, const double a)
  {
    const Complex zeta(z, a), R = std::sqrt(r * r + zeta * zeta), S = R + zeta, q = r / S;
    L = std::log(S);
    I1 = zeta * L - R;
    I2 = (zeta * zeta / 2. - r * r / 4) * L - 0.75 * zeta * R + r * r / 4;
    dL = r / (R * S);
    dI1 = -q;
    dI2 = -r * L / 2. - zeta * q / 2. + r / 4;
    dI3 = -q * (R * R + R * zeta + zeta * zeta) / 6. - r * I1 / 2. + r * zeta / 4.;
    inverse_R = 1. / R;
  }
};

/** Of F_r, F_rz, F_z and F_zz. */
Tensor<1, 2> displacement_of(const std::array<double, 4> &F, const double z, const double shear)
{
  return Tensor<1, 2>({-(1 - 2 * poisson) * F[0] - z * F[1], 2 * (1 - poisson) * F[2] - z * F[3]}) /
         (2 * shear);
}

/** Exact displacements above and outside, contact with what the sphere or the punch is below. */
Step pressed(const std::function<Tensor<1, 2>(const Point<2> &)> &u, const Expression<2> &gap,
             const Overrides &entries)
{
  Scene<2> scene = scene_of(turned + entries +
                            Overrides{{"Material/Young's modulus", "200"},
                                      {"Geometry/Upper corner", "2, 2"},
                                      given::clamped({"top", "right"}),
                                      given::steps("hpa3", "24"),
                                      {"Adaptivity/Indicator", "residual"},
                                      {"Adaptivity/Maximum unknowns", "8000"}});
  for (const char *const name : {"top", "right"})
    for (unsigned int c = 0; c < 2; ++c)
      scene.boundary(name).displacement[c] =
          expression<2>([u, c](const Point<2> &x) { return u(x)[c]; });
  for (BoundaryCondition<2> &boundary : scene.boundaries)
    if (boundary.is_unilateral())
      boundary.gap = gap;
  Step result;
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        result = {step.energies.energy,
                  0.5 * std::pow(step.energies.norm, 2),
                  step.norms.total,
                  0,
                  step.contact[0].normal_resultant,
                  step.equilibrium};
      });
  return result;
}

/** Hertz's sphere below a half space. */
TEST(Axisymmetric, SphereBelowACylinder)
{
  const double a = 0.7, p0 = 7, curvature = pi * p0 * (1 - 0.09) / (2 * a * 200);
  const auto u = [=](const Point<2> &x)
  {
    const Potentials f(x[0], x[1], a);
    const auto part = [&](const Complex &one, const Complex &other)
    { return -p0 / a * (a * one.real() - other.imag()); };
    return displacement_of(
        {{part(f.dI2, f.dI3), part(f.dI1, f.dI2), part(f.I1, f.I2), part(f.L, f.I1)}}, x[1],
        200 / 2.6);
  };
  const Step last = pressed(
      u, expression<2>([=](const Point<2> &x) { return curvature * (x[0] * x[0] / 2 - a * a); }),
      {{"Boundary bottom/Contact", "unilateral"}});
  EXPECT_NEAR(last.normal_resultant, -7.183775201209, 1e-5);
  EXPECT_NEAR(last.elastic, .07618164369, 1e-8);
}

/** A flat punch, whose pressure grows without bound towards its edge. */
TEST(Axisymmetric, PunchBelowACylinder)
{
  const double a = 0.7, P = 5, depth = P * (1 - 0.09) / (2 * a * 200);
  const auto u = [=](const Point<2> &x)
  {
    const Potentials f(x[0], x[1], a);
    const double factor = P / (2 * pi * a);
    return displacement_of({{factor * f.dI1.imag(), factor * f.dL.imag(), factor * f.L.imag(),
                             factor * f.inverse_R.imag()}},
                           x[1], 200 / 2.6);
  };
  const Step last = pressed(u, expression<2>([=](const Point<2> &) { return -depth; }),
                            {{"Boundary punch/On", "bottom"},
                             {"Boundary punch/Where", "0.7 - x"},
                             {"Boundary punch/Contact", "unilateral"}});
  EXPECT_NEAR(last.normal_resultant, -P, 1e-3 * P);
  EXPECT_NEAR(last.elastic, .0289823, 2e-6);
}
} // namespace
