// SPDX-License-Identifier: LGPL-2.1-or-later
// Bodies that touch each other: patch tests through meshes that do not match, closed forms, forces, frames, glued blocks.
#include "discretisation.h"
#include "mesh_texts.h"

#include <hpvi/driver/load_history.h>
#include <hpvi/reader/closed_forms/hertz.h>
#include <hpvi/results/contact_residuals.h>
#include <hpvi/results/stress_extrema.h>
#include <hpvi/scene/bodies.h>

#include <array>
#include <cmath>
#include <map>

namespace
{
using namespace verification;

// ---------------------------------------------------------------- uniform stress

/** Two blocks of breadth 2 and height 1, one upon the other along a line at @p angle, with uniform stress in each. */
struct Patch
{
  std::string law;
  double angle, upper_modulus, shear; ///< shear stress along the interface, the bound of friction
  std::string slave = "automatic";

  static constexpr double pressure = 1.5;

  /** u(x) = G (x, y) + b in the frame of the blocks; lower: 0 < y < 1, upper: 1 < y < 2. */
  struct Field
  {
    Tensor<2, 2> G;
    Tensor<1, 2> b;
  };

  Field field(const bool is_upper) const
  {
    const double E = is_upper ? upper_modulus : 10, nu = is_upper ? 0.2 : 0.3,
                 mu = E / (2 * (1 + nu)), lambda = E * nu / ((1 + nu) * (1 - 2 * nu));
    // Tied blocks strain alike along the line; others slip by this and by a jump.
    const double along = is_upper && law != "tied" ? 0.03 : 0.02;
    Field result;
    result.G[0][0] = along;
    result.G[1][1] = (-pressure - lambda * along) / (lambda + 2 * mu);
    result.G[0][1] = shear / mu; // T_t = -g on the upper body, whose t is (1, 0)
    if (is_upper)
    {
      const Field other = field(false);
      result.b[0] = other.G[0][1] - result.G[0][1] + (law == "tied" ? 0. : 0.5);
      result.b[1] = other.G[1][1] - result.G[1][1];
    }
    return result;
  }

  /** Of the place (x, y) in the frame of the blocks, turned. */
  Point<2> place(const double x, const double y) const
  {
    return {std::cos(angle) * x - std::sin(angle) * y, std::sin(angle) * x + std::cos(angle) * y};
  }

  std::string corners(const double lower, const double upper) const
  {
    std::string result;
    for (const Point<2> &x : {place(0, lower), place(2, lower), place(2, upper), place(0, upper)})
      result += (result.empty() ? "" : "; ") + in_digits(x[0]) + ", " + in_digits(x[1]);
    return result;
  }

  std::string displacement(const bool is_upper) const
  {
    const Field own = field(is_upper);
    Tensor<2, 2> R;
    R[0][0] = R[1][1] = std::cos(angle);
    R[1][0] = std::sin(angle);
    R[0][1] = -R[1][0];
    const Tensor<2, 2> G = R * own.G * transpose(R);
    const Tensor<1, 2> b = R * own.b;
    std::string result;
    for (const unsigned int c : {0, 1})
      result += (c == 0 ? "" : "; ") + in_digits(G[c][0]) + "*x+" + in_digits(G[c][1]) + "*y+" +
                in_digits(b[c]);
    return result;
  }

  Scene<2> scene() const
  {
    Overrides entries{given::quadrilateral("Body lower", corners(0, 1), "3, 2"),
                      given::quadrilateral("Body upper", corners(1, 2), "5, 2"),
                      {"Body upper/Material", "other"},
                      given::elastic("10", "0.3"),
                      given::elastic(in_digits(upper_modulus), "0.2", "other"),
                      given::joint("joint", "upper.bottom, lower.top", law),
                      {"Contact joint/Slave", slave}};
    if (shear > 0 && law != "tied")
      entries.emplace_back("Contact joint/Friction bound", in_digits(shear));
    for (const char *const side : {"left", "right", "bottom"})
      entries.emplace_back("Boundary lower." + std::string(side) + "/Displacement",
                           displacement(false));
    for (const char *const side : {"left", "right", "top"})
      entries.emplace_back("Boundary upper." + std::string(side) + "/Displacement",
                           displacement(true));
    return scene_of(entries);
  }
};

/** Meshes that do not match, hanging nodes and any degrees on both sides. */
TEST(Bodies, HandOverUniformStress)
{
  for (const Patch &patch :
       {Patch{"unilateral", 0, 10, 0}, Patch{"unilateral", 0.5, 1000, 0.2},
        Patch{"unilateral", -2, 0.1, 0.2, "lower.top"}, Patch{"bilateral", 1, 30, 0.3},
        Patch{"tied", 0.3, 30, 0.4}, Patch{"tied", 0, 0.2, 0.4, "upper.bottom"},
        Patch{"tied", 0, 0.2, 0.4, "lower.top"}})
    for (const unsigned int seed : {1, 2, 3})
    {
      const Scene<2> scene = patch.scene();
      std::mt19937 random(seed);
      Triangulation<2> mesh;
      make_mesh(scene, mesh);
      refine_at_random(mesh, 2, random);
      const Degrees degrees = random_degrees(mesh, 2, 6, random);
      const Laboratory laboratory(scene, mesh, degrees);
      const Solution<2> solution = laboratory.solve();
      const auto states = contact_states(SolutionField<2>(solution));
      ASSERT_EQ(states.size(), 1U);
      double worst = 0, deepest = 0;
      for (const ContactPoint<2> &point : states[0].points)
      {
        worst = std::max({worst, std::abs(point.normal_traction + Patch::pressure),
                          std::abs(point.tangential_traction + patch.shear)});
        deepest = std::max(deepest, std::abs(point.normal_jump));
      }
      EXPECT_LT(worst, 1e-9) << patch.law << ", angle " << patch.angle << ", seed " << seed;
      EXPECT_LT(deepest, 1e-11);
      EXPECT_NEAR(states[0].normal_resultant, -2 * Patch::pressure, 1e-9);
      // Nothing is left to indicate.
      EXPECT_LT(estimate_error(SolutionField<2>(solution)).total(), 1e-8);
    }
}

// ---------------------------------------------------------------- Hertz

/** The field of a body below y = 0, that of one above it in a mirror. */
class Mirrored : public ExactSolution<2>
{
public:
  explicit Mirrored(std::shared_ptr<const ExactSolution<2>> above) : above(std::move(above))
  {
  }

  Tensor<1, 2> displacement(const Point<2> &x) const override
  {
    Tensor<1, 2> u = above->displacement({x[0], -x[1]});
    u[1] = -u[1];
    return u;
  }

  Tensor<2, 2> gradient(const Point<2> &x) const override
  {
    Tensor<2, 2> result = above->gradient({x[0], -x[1]});
    result[0][1] = -result[0][1];
    result[1][0] = -result[1][0];
    return result;
  }

private:
  const std::shared_ptr<const ExactSolution<2>> above;
};

/** Two elastic bodies without friction, a = 0.7, p_0 = 7: each is Hertz's half space on a plane, their gaps add up. */
struct HertzOfTwo
{
  static constexpr double a = 0.7, k = 10, energy = .133954906582 + .207680549090;

  /** @p below_cells: of the lower body; 6, 3 above. @p levels: of grading in both. */
  HertzOfTwo(const std::string &below_cells, const std::string &levels, const Overrides &method)
  {
    Overrides entries{given::block("upper", "-2, 0", "2, 2", "6, 3"),
                      given::graded("Body upper", "-0.7, 0; 0.7, 0", levels),
                      given::block("lower", "-2, -1", "2, 0", below_cells),
                      given::graded("Body lower", "-0.7, 0; 0.7, 0", levels),
                      {"Body lower/Material", "soft"},
                      given::elastic("200", "0.3"),
                      given::elastic("100", "0.2", "soft"),
                      {"Contact line/Between", "upper.bottom, lower.top"},
                      {"Contact line/Gap", "x^2/2/3.53356890459"}};
    for (const char *const side :
         {"upper.top", "upper.left", "upper.right", "lower.bottom", "lower.left", "lower.right"})
      entries.emplace_back("Boundary " + std::string(side) + "/Displacement", "0; 0");
    entries.insert(entries.end(), method.begin(), method.end());
    scene = scene_of(entries);
    fields = {{std::make_shared<const Hertz>(scene.materials[0], k * a, a, 0.),
               std::make_shared<const Mirrored>(
                   std::make_shared<const Hertz>(scene.materials[1], k * a, a, 0.))}};
    for (BoundaryCondition<2> &boundary : scene.boundaries)
      for (unsigned int c = 0; boundary.has_displacement() && c < 2; ++c)
        boundary.displacement[c] =
            std::make_shared<ExactDisplacement<2>>(fields[boundary.name[0] == 'l'], c);
  }

  /** |u - u_N|_a of both bodies by 24^2 points in each cell. */
  double error(const Solution<2> &solution) const
  {
    const QGauss<2> gauss(24);
    double square = 0;
    for (const auto &cell : solution.displacement_space.dof_handler().active_cell_iterators())
    {
      const unsigned int index = cell->active_cell_index(),
                         p = solution.displacement_space.degrees()[index];
      const ShapeTable<2> table = tabulate<2>(p, gauss.get_points(), gauss.get_weights(), false);
      const std::vector<double> slopes = evaluate(table.derivatives, solution.coefficients(index));
      const CellMap<2> map = map_of<2>(cell);
      const HookesLaw<2> law(scene.material_of(cell));
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const Tensor<2, 2> J = map.jacobian(gauss.point(q));
        const Point<2> x = map.point(gauss.point(q));
        Tensor<2, 2> missed = physical_gradient<2>(slopes, 2 * q, 2 * gauss.size(), invert(J));
        missed -= fields[x[1] < 0]->gradient(x);
        square += gauss.weight(q) * determinant(J) * law.energy_product(missed);
      }
    }
    return std::sqrt(square);
  }

  Scene<2> scene;
  std::array<std::shared_ptr<const ExactSolution<2>>, 2> fields; ///< above, below
};

TEST(Bodies, PressEachOtherAsHertzSays)
{
  constexpr double a = HertzOfTwo::a, k = HertzOfTwo::k;
  const HertzOfTwo hertz("5, 2", "11", {given::steps("pu", "1", "9"), {"Error/Bound", "false"}});
  each_step<2>(hertz.scene,
               [&](const StepReport<2> &step)
               {
                 EXPECT_NEAR(step.energies.energy, HertzOfTwo::energy, 1e-10 * HertzOfTwo::energy);
                 const ContactState<2> &contact = step.contact[0];
                 EXPECT_NEAR(contact.normal_resultant, -7.6969020013, 1e-8);
                 ASSERT_EQ(contact.transitions.size(), 2U);
                 EXPECT_NEAR(contact.transitions[0][0], -a, 2e-4);
                 EXPECT_NEAR(contact.transitions[1][0], a, 2e-4);
                 for (const ContactPoint<2> &point : contact.points)
                 {
                   const double x = std::abs(point.x[0]) < 0.6 ? point.x[0] : 0.;
                   EXPECT_NEAR(x == 0 ? -k * a : point.normal_traction, -k * half_ellipse(x, a),
                               1e-4);
                 }
               });
}

/** Where meshes match there is a bound: above the error, and energies are known to be within an interval. */
TEST(Bodies, HaveABoundOfTheirErrorByHertz)
{
  for (const std::string method : {"pu", "hpa3"})
  {
    const HertzOfTwo hertz("6, 2", "7", {given::steps(method, "5")});
    unsigned int n_bounds = 0;
    each_step<2>(
        hertz.scene,
        [&](const StepReport<2> &step)
        {
          ASSERT_TRUE(step.bound) << step.no_bound;
          ++n_bounds;
          const double error = hertz.error(step.solution());
          EXPECT_GE(step.bound->total, error) << method;
          EXPECT_LE(step.bound->total, 2.5 * error) << method;
          EXPECT_LE(step.energies.energy - step.bound->energy_below, HertzOfTwo::energy + 1e-12);
          EXPECT_GE(step.energies.energy + step.bound->energy_above, HertzOfTwo::energy - 1e-12);
        });
    EXPECT_EQ(n_bounds, 5U);
  }
}

/** Hertz's field and what friction f k sqrt(a^2 - x^2) adds, less that of a smaller zone |x| < c where bodies stick: Cattaneo's. */
class RubbingField : public ExactSolution<2>
{
public:
  RubbingField(const Material &material, const double k, const double a, const double c,
               const double f, const double shift)
      : normal(material, k * a, a, 0.), k(k), a(a), c(c), f(f), shift(shift), mu(material.mu()),
        kappa(material.kolosov())
  {
  }

  Tensor<1, 2> displacement(const Point<2> &x) const override
  {
    Tensor<1, 2> u = normal.displacement(x);
    u += tangential(x, a);
    if (c > 0)
      u -= tangential(x, c);
    u[0] += shift;
    return u;
  }

  Tensor<2, 2> gradient(const Point<2> &) const override
  {
    return {};
  }

private:
  /** Muskhelishvili's potentials of a shear f k sqrt(a^2 - x^2), written out. */
  Tensor<1, 2> tangential(const Point<2> &point, const double half_width) const
  {
    const double x = point[0], y = point[1], a2 = half_width * half_width, q = x * x - y * y - a2,
                 s = std::sqrt(q * q + 4 * x * x * y * y);
    double m = std::sqrt(std::max(0., (s - q) / 2)), n = std::sqrt(std::max(0., (s + q) / 2));
    n = x < 0 ? -n : n;
    if (q > 0)
      m = x * y / n;
    else if (m > 0)
      n = x * y / m;
    const double h = std::hypot(x + n, y + m),
                 A = (x * x - y * y - x * n + y * m) / 2 + a2 / 2 * std::log(h / half_width),
                 B = x * y - (x * m + y * n) / 2 - a2 / 2 * std::asin((x + n) / h);
    return f * k / (2 * mu) *
           Tensor<1, 2>({(kappa + 1) / 2 * A - y * (y - m), (kappa - 1) / 2 * B - y * (x - n)});
  }

  const Hertz normal;
  const double k, a, c, f, shift, mu, kappa;
};

struct Rubbing
{
  std::string name;
  double lower_modulus, lower_ratio, radius, stick, shift, energy, friction;
};

/** H2, all of the contact slips, and H3, Cattaneo and Mindlin's partial slip under Coulomb's own law. */
TEST(Bodies, RubAsCattaneoSays)
{
  const double a = 0.7, k = 10, f = 0.3;
  for (const Rubbing &known : {Rubbing{"full slip", 100, 0.2, 3.53356890459, 0, 0.03,
                                       .149120752172 + .235901204537, 0.3 * 7.6969020013},
                               Rubbing{"partial slip", 200, 0.3, 5.49450549451, 0.4, 0,
                                       .140448661664 + .093787639127, 1.55508836353}})
  {
    const std::string places = "-0.7, 0; 0.7, 0; -0.4, 0; 0.4, 0";
    Scene<2> scene = scene_of(
        {given::block("upper", "-2, 0", "2, 2", "6, 3"),
         given::graded("Body upper", places, "11"),
         given::block("lower", "-2, -1", "2, 0", "5, 2"),
         given::graded("Body lower", places, "11"),
         {"Body lower/Material", "other"},
         given::elastic("200", "0.3"),
         given::elastic(in_digits(known.lower_modulus), in_digits(known.lower_ratio), "other"),
         {"Contact line/Between", "upper.bottom, lower.top"},
         {"Contact line/Friction coefficient", "0.3"},
         given::clamped({"upper.top", "upper.left", "upper.right", "lower.bottom", "lower.left",
                         "lower.right"}),
         {"Error/Bound", "false"},
         given::steps("pu", "1", "9")});
    const std::shared_ptr<const ExactSolution<2>> fields[] = {
        std::make_shared<const RubbingField>(scene.materials[0], k, a, known.stick, f, known.shift),
        std::make_shared<const Mirrored>(
            std::make_shared<const RubbingField>(scene.materials[1], k, a, known.stick, -f, 0.))};
    for (BoundaryCondition<2> &boundary : scene.boundaries)
      for (unsigned int d = 0; d < 2; ++d)
        if (boundary.has_displacement())
          boundary.displacement[d] =
              std::make_shared<ExactDisplacement<2>>(fields[boundary.name[0] == 'l'], d);
    const auto slope = [](const Material &material)
    { return (material.kolosov() - 1) / material.mu(); };
    const double uneven = f * k / 4 * (slope(scene.materials[0]) - slope(scene.materials[1]));
    for (const types::boundary_id part : scene.pairs[0].parts)
      scene.boundaries[part].gap = expression<2>(
          [=](const Point<2> &x)
          {
            const double s = x[0], braces = std::abs(s) < a
                                                ? s * std::sqrt(a * a - s * s) / 2 +
                                                      a * a / 2 * std::asin(s / a)
                                                : std::copysign(numbers::PI * a * a / 4, s);
            return s * s / 2 / known.radius + uneven * braces;
          });
    AdaptiveSolver<2>(scene).run(
        [&](const StepReport<2> &step)
        {
          const ContactState<2> &contact = step.contact[0];
          EXPECT_NEAR(0.5 * std::pow(step.energies.norm, 2), known.energy, 1e-10 * known.energy)
              << known.name;
          EXPECT_NEAR(contact.normal_resultant, -7.6969020013, 1e-8) << known.name;
          EXPECT_NEAR(contact.friction_resultant, -known.friction, 1e-8) << known.name;
          double stick = 0;
          for (const ContactZone<2> &zone : contact.zones)
            stick += zone.mode == ContactMode::stick ? zone.length : 0.;
          EXPECT_NEAR(stick, 2 * known.stick, 1e-3) << known.name;
        });
  }
}

// ---------------------------------------------------------------- known answers

Overrides box(const std::string &name, const std::string &lower, const std::string &upper,
              const std::string &subdivisions, const std::string &E, const std::string &nu)
{
  return {{"Body " + name + "/Lower corner", lower},
          {"Body " + name + "/Upper corner", upper},
          {"Body " + name + "/Subdivisions", subdivisions},
          {"Body " + name + "/Material", name},
          {"Material " + name + "/Young's modulus", E},
          {"Material " + name + "/Poisson's ratio", nu}};
}

/** O1 to O4: two other discretisations agree on these digits (matching nodes, moments through meshes that do not match). */
struct KnownCase
{
  std::string name;
  Overrides entries;
  double energy, normal, friction; ///< resultants of the last pair
};

const Overrides clamped{{"Boundary lower.bottom/Displacement", "0; 0"},
                        {"Adaptivity/Maximum steps", "16"},
                        {"Output/VTU", "false"}};

std::vector<KnownCase> known_cases()
{
  const Overrides touch{{"Contact joint/Between", "upper.bottom, lower.top"}};
  return {
      {"block on a wider one",
       joined({clamped,
               touch,
               box("lower", "0, -1", "3, 0", "6, 2", "20", "0.3"),
               box("upper", "1, 0", "2, 1", "3, 3", "10", "0.3"),
               {{"Boundary upper.top/Displacement", "0; -0.02"}}}),
       .00166735265, .166735265, 0.},
      {"sheared with friction",
       joined({clamped,
               touch,
               box("lower", "0, -1", "2, 0", "4, 2", "20", "0.25"),
               box("upper", "0, 0", "2, 1", "5, 3", "10", "0.3"),
               {{"Material/Plane", "stress"},
                {"Contact joint/Friction bound", "0.055"},
                {"Boundary upper.top/Displacement", "0.03; -0.02"}}}),
       .004281503947, .27349126, .09761887},
      {"glued",
       joined(
           {clamped,
            touch,
            box("lower", "0, -1", "3, 0", "6, 2", "10", "0.3"),
            box("upper", "1, 0", "2, 1", "3, 3", "100", "0.3"),
            {{"Contact joint/Law", "tied"}, {"Boundary upper.top/Displacement", "0.02; -0.02"}}}),
       .0039624663, .2957241, .1005225},
      {"block between two others",
       joined({clamped,
               box("lower", "0, -1", "3, 0", "6, 2", "20", "0.3"),
               box("middle", "1, 0", "2, 0.5", "4, 2", "10", "0.2"),
               box("upper", "0, 0.5", "3, 1.5", "6, 2", "30", "0.3"),
               {{"Contact below/Between", "middle.bottom, lower.top"},
                {"Contact below/Friction bound", "0.03"},
                {"Contact above/Between", "middle.top, upper.bottom"},
                {"Contact above/Friction coefficient", "0.4"},
                {"Boundary upper.top/Displacement", "0.01; -0.02"}}}),
       .00220250993, .203659398, .02626836},
  };
}

TEST(Bodies, HaveKnownAnswers)
{
  for (const KnownCase &known : known_cases())
    last_step<2>(scene_of(with(known.entries, {{"Error/Bound", "false"}})),
                 [&](const StepReport<2> &step)
                 {
                   const ContactState<2> &contact = step.contact.back();
                   EXPECT_NEAR(step.energies.energy, known.energy, 3e-6 * known.energy)
                       << known.name;
                   EXPECT_NEAR(contact.normal_resultant, -known.normal, 2e-5 * known.normal)
                       << known.name;
                   EXPECT_NEAR(contact.friction_resultant, -known.friction, 2e-5) << known.name;
                   EXPECT_LT(step.equilibrium.force_imbalance, 1e-10) << known.name;
                   EXPECT_LT(step.equilibrium.moment_imbalance, 1e-10) << known.name;
                 });
}

/** Force on each body by itself. */
TEST(Bodies, AreEachInEquilibrium)
{
  last_step<2>(scene_of(known_cases()[3].entries),
               [](const StepReport<2> &step)
               {
                 for (const std::string body : {"lower.", "middle.", "upper."})
                 {
                   Tensor<1, 2> sum;
                   double size = 0;
                   for (const BoundaryForce<2> &force : step.equilibrium.reactions)
                     if (force.boundary.rfind(body, 0) == 0)
                     {
                       sum += force.force;
                       size += force.force.norm();
                     }
                   EXPECT_GT(size, 0.2) << body;
                   EXPECT_LT(sum.norm(), 1e-10 * size) << body;
                 }
                 ASSERT_EQ(step.equilibrium.bodies.size(), 3U);
                 EXPECT_EQ(step.equilibrium.bodies[1].body, "middle");
                 for (const BodyBalance &one : step.equilibrium.bodies)
                 {
                   EXPECT_LT(one.force_imbalance, 1e-10) << one.body;
                   EXPECT_LT(one.moment_imbalance, 1e-10) << one.body;
                 }
               });
}

/** What is missing on one body is seen there, although all bodies together balance. */
TEST(Bodies, AreBalancedOneByOne)
{
  const Scene<2> scene = scene_of(known_cases()[0].entries);
  NodalForces<2> forces;
  for (const unsigned int body : {0, 1})
    for (const double sign : {1., -1.})
      forces.reactions.push_back({0, Tensor<1, 2>({0., sign}), {1.5, 0.}, body});
  Equilibrium<2> found = equilibrium(scene, forces);
  EXPECT_EQ(found.force_imbalance, 0.);
  EXPECT_EQ(found.bodies[0].force_imbalance, 0.);
  forces.reactions[0].body = 1; // which the other has too much then
  found = equilibrium(scene, forces);
  EXPECT_EQ(found.force_imbalance, 0.);
  EXPECT_EQ(found.bodies[0].force_imbalance, 1.);
  EXPECT_NEAR(found.bodies[1].force_imbalance, 1. / 3, 1e-15);
}

// ---------------------------------------------------------------- the same in another guise

struct Result
{
  double energy, normal, friction, length_of_slip;
  Tensor<1, 2> own_displacement; ///< the sum over the points of the first side
};

Result solved(const Scene<2> &scene)
{
  Result result{};
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        const ContactState<2> &contact = step.contact.front();
        result = {step.energies.energy,
                  contact.normal_resultant,
                  contact.friction_resultant,
                  contact.slipping_area,
                  {}};
        for (const ContactPoint<2> &point : contact.points)
          result.own_displacement += Tensor<1, 2>(
              {point.area * point.tangential_displacement, point.area * point.normal_displacement});
      });
  return result;
}

/** Whichever side has the multipliers, and whichever is named first. */
TEST(Bodies, MeetInEitherOrder)
{
  const Overrides entries = known_cases()[1].entries;
  const auto with = [&](const std::string &between, const std::string &slave)
  {
    return solved(scene_of(joined({entries,
                                   {{"Contact joint/Between", between},
                                    {"Contact joint/Slave", slave},
                                    {"Adaptivity/Maximum steps", "8"}}})));
  };
  const Result one = with("upper.bottom, lower.top", "upper.bottom"),
               turned = with("lower.top, upper.bottom", "upper.bottom"),
               other = with("upper.bottom, lower.top", "lower.top");
  EXPECT_NEAR(turned.energy, one.energy, 1e-12);
  EXPECT_NEAR(turned.normal, one.normal, 1e-10);
  EXPECT_NEAR(turned.friction, one.friction, 1e-10);
  EXPECT_NEAR(turned.length_of_slip, one.length_of_slip, 1e-10);
  EXPECT_NEAR(other.energy, one.energy, 1e-4 * one.energy);
  EXPECT_NEAR(other.friction, one.friction, 2e-3 * std::abs(one.friction));
  // The columns are those of the first side, whoever is slave.
  EXPECT_NEAR(other.own_displacement[0], one.own_displacement[0], 1e-4);
  EXPECT_NEAR(other.own_displacement[1], one.own_displacement[1], 1e-4);
  EXPECT_GT(one.own_displacement[0], 0.01);
  EXPECT_LT(turned.own_displacement[0], -0.005); // t of the lower body runs the other way
}

/** Two halves that press each other are one on a rigid plane with half the gap. */
TEST(Bodies, ThatAreEqualMeetInAPlane)
{
  const Overrides method{given::steps("pu", "1", "5"),
                         {"Solver/Normal contact", "multiplier"},
                         given::elastic("10", "0.3")};
  const Result half = solved(scene_of(joined({method,
                                              {{"Geometry/Subdivisions", "6, 4"},
                                               {"Boundary top/Displacement", "0; -0.05"},
                                               {"Boundary bottom/Contact", "unilateral"},
                                               {"Boundary bottom/Gap", "0.2*(x-0.4)^2"}}}))),
               both =
                   solved(scene_of(joined({method,
                                           {{"Body upper/Subdivisions", "6, 4"},
                                            given::block("lower", "0, -1.1", "1, -0.1", "6, 4"),
                                            {"Contact line/Between", "lower.top, upper.bottom"},
                                            {"Contact line/Gap", "0.4*(x-0.4)^2-0.1"},
                                            {"Boundary upper.top/Displacement", "0; -0.05"},
                                            {"Boundary lower.bottom/Displacement", "0; 0.05"}}})));
  EXPECT_LT(half.normal, -0.1);
  EXPECT_NEAR(both.energy, 2 * half.energy, 1e-11);
  EXPECT_NEAR(both.normal, half.normal, 1e-10);
}

/** Sides whose gap is steep where they press are not parallel: a word with slope and place. */
TEST(Bodies, SayWhereTheirGapIsSteep)
{
  for (const double slope : {0.15, 0.25})
  {
    std::vector<std::string> said;
    each_step<2>(
        scene_of({{"Body upper/Subdivisions", "6, 3"},
                  given::block("lower", "0, -1", "1, 0", "4, 3"),
                  {"Contact line/Between", "lower.top, upper.bottom"},
                  {"Contact line/Gap", "if(x < 0.5, 0, " + in_digits(slope) + "*(x - 0.5))"},
                  {"Boundary upper.top/Displacement", "0; -0.5"},
                  {"Boundary lower.bottom/Displacement", "0; 0"},
                  {"Adaptivity/Maximum steps", "1"}}),
        [&](const StepReport<2> &step) { said = texts(step.warnings); });
    EXPECT_EQ(mentions(said, "has a slope of 0.25 at (0."), slope > 0.2);
  }
}

/** On a body a million times as stiff a block does what it does on a rigid plane. */
TEST(Bodies, MeetStiffOnesAsFoundations)
{
  const Overrides both{given::steps("pu", "1", "5"),
                       {"Solver/Normal contact", "multiplier"},
                       given::elastic("10", "0.3")};
  const Result plane = solved(scene_of(joined({both,
                                               {{"Geometry/Subdivisions", "5, 4"},
                                                {"Boundary top/Displacement", "0.05; -0.05"},
                                                given::rough("bottom", "unilateral", "0.1")}}))),
               stiff =
                   solved(scene_of(joined({both,
                                           {{"Body block/Subdivisions", "5, 4"},
                                            given::block("base", "-1, -1", "2, 0", "3, 1"),
                                            {"Body base/Material", "stiff"},
                                            {"Material stiff/Young's modulus", "1e7"},
                                            {"Contact joint/Between", "block.bottom, base.top"},
                                            {"Contact joint/Slave", "block.bottom"},
                                            {"Contact joint/Friction bound", "0.1"},
                                            {"Boundary base.bottom/Displacement", "0; 0"},
                                            {"Boundary block.top/Displacement", "0.05; -0.05"}}})));
  EXPECT_GT(std::abs(plane.friction), 0.05);
  EXPECT_NEAR(stiff.energy, plane.energy, 1e-5 * plane.energy);
  EXPECT_NEAR(stiff.normal, plane.normal, 1e-5 * std::abs(plane.normal));
  EXPECT_NEAR(stiff.friction, plane.friction, 1e-5 * std::abs(plane.friction));
}

/** Edges of 1.5 below a block of breadth 1: that of the longer body is master, and half of each is free. */
/** One body as `Body b` is what it is as `Geometry`: loads act beside displacements that they do not work on. */
TEST(Bodies, TakeLoadsAlongStraightSidesAsBoxesDo)
{
  const auto energy_of =
      [](const std::string &section, const std::string &prefix, const Overrides &conditions)
  {
    Overrides entries{{section + "/Upper corner", "2, 1"},
                      {section + "/Subdivisions", "2, 1"},
                      given::steps("hup2", "1"),
                      {"Boundary " + prefix + "bottom/Displacement", "0; 0"}};
    for (const auto &[entry, value] : conditions)
      entries.emplace_back("Boundary " + prefix + entry, value);
    double energy = 0;
    each_step<2>(scene_of(entries),
                 [&](const StepReport<2> &step) { energy = step.energies.energy; });
    return energy;
  };
  const std::vector<Overrides> rows{
      {{"top/Displacement", "0.1; free"}, {"top/Pressure", "1 + x"}},
      {{"top/Displacement", "free; -0.01"}, {"top/Shear", "0.3"}},
      {{"left/Displacement", "free; 0"}, {"left/Pressure", "2"}},
      {{"right/Displacement", "free; 0"}, {"right/Pressure", "y"}},
      {{"right/Displacement", "0.01*y; free"}, {"right/Shear", "0.2*y"}},
      {{"top/Displacement", "0; free"}, {"top/Pressure", "-1"}, {"left/Pressure", "1"}},
      {{"top/Pressure", "x"}, {"top/Shear", "1"}, {"top/Traction", "1; 1"}}};
  for (const Overrides &row : rows)
  {
    const double box = energy_of("Geometry", "", row);
    EXPECT_NE(box, 0);
    EXPECT_NEAR(energy_of("Body b", "b.", row), box, 1e-12 * std::abs(box)) << row[0].second;
  }
  for (const Overrides &row : {Overrides{{"top/Displacement", "free; 0.1"}, {"top/Pressure", "1"}},
                               Overrides{{"top/Displacement", "0.1; free"}, {"top/Shear", "1"}},
                               Overrides{{"left/Displacement", "0; free"}, {"left/Pressure", "1"}}})
    for (const auto &[section, prefix] : {std::pair("Geometry", ""), {"Body b", "b."}})
      EXPECT_THROW(energy_of(section, prefix, row), InputError) << section << row[0].second;
}

TEST(Bodies, MayHangOver)
{
  const Scene<2> scene =
      scene_of({given::quadrilateral("Body lower", "0, -1; 3, -1; 3, 0; 0, 0", "2, 1"),
                {"Body upper/Lower corner", "1, 0"},
                {"Body upper/Upper corner", "2, 1"},
                {"Contact joint/Between", "lower.top, upper.bottom"},
                {"Boundary lower.bottom/Displacement", "0; 0"},
                {"Boundary upper.top/Displacement", "0; -0.02"},
                {"Material/Young's modulus", "10"}});
  EXPECT_EQ(scene.pairs[0].slave, std::optional<unsigned int>(1));
  Triangulation<2> mesh;
  make_mesh(scene, mesh);
  const Laboratory laboratory(scene, mesh, Degrees(mesh.n_active_cells(), 4));
  const Solution<2> solution = laboratory.solve();
  const SolutionField<2> field(solution);
  const Tractions<2> unit = [](const auto &, const ShapeTable<2> &table, const auto &) {
    return std::vector<Tensor<1, 2>>(table.points.size(), Tensor<1, 2>({0.6, 0.8}));
  };
  double normal = 0, tangential = 0, opposite = 0;
  for (const OppositeResidual &part : free_residuals<2>(field, unit))
  {
    normal += part.normal;
    tangential += part.tangential;
  }
  EXPECT_NEAR(normal, 2 * 0.64, 1e-12);
  EXPECT_NEAR(tangential, 2 * 0.36, 1e-12);
  const Tractions<2> none = [](const auto &, const ShapeTable<2> &table, const auto &)
  { return std::vector<Tensor<1, 2>>(table.points.size()); };
  for (const FieldFace<2> &face : field.faces())
    for (const OppositeResidual &part : opposite_residuals<2>(face, field, none))
      opposite += part.normal;
  EXPECT_GT(opposite, 1e-4); // the pressure of the block
  const auto states = contact_states(field);
  EXPECT_NEAR(states[0].area, 1, 1e-12);
}

// ---------------------------------------------------------------- bodies that contact alone holds

/** Three blocks under their own weight upon each other, and what the loads push nobody resists. */
TEST(Bodies, CarryWhatLiesOnThem)
{
  const Overrides stack = joined({box("a", "0, 0", "2, 1", "3, 2", "10", "0.3"),
                                  box("b", "0.2, 1", "1.9, 1.5", "4, 1", "20", "0.2"),
                                  box("c", "0.5, 1.5", "1.5, 2.5", "2, 2", "5", "0.3"),
                                  {{"Material a/Density", "0.1"},
                                   {"Material b/Density", "0.2"},
                                   {"Material c/Density", "0.3"},
                                   {"Body force/Gravity", "0; -1"},
                                   {"Boundary a.bottom/Contact", "unilateral"},
                                   {"Boundary a.bottom/Friction coefficient", "0.3"},
                                   {"Contact lower/Between", "b.bottom, a.top"},
                                   {"Contact lower/Friction coefficient", "0.3"},
                                   {"Contact upper/Between", "c.bottom, b.top"},
                                   {"Contact upper/Friction coefficient", "0.3"},
                                   {"Adaptivity/Maximum steps", "4"}}});
  each_step<2>(scene_of(stack),
               [](const StepReport<2> &step)
               {
                 ASSERT_EQ(step.contact.size(), 3U);
                 EXPECT_NEAR(step.contact[0].normal_resultant, -0.2 - 0.17 - 0.3, 1e-9);
                 EXPECT_NEAR(step.contact[1].normal_resultant, -0.17 - 0.3, 1e-9);
                 EXPECT_NEAR(step.contact[2].normal_resultant, -0.3, 1e-9);
               });
  // 0.3 on top push sideways: c slides on b, or b on a, or all of them; the names say who.
  const std::string failure =
      failure_of(scene_of(joined({stack, {{"Boundary c.left/Traction", "0.2; 0"}}})));
  EXPECT_TRUE(says(failure, "sliding along upper: the loads push c with 0.2")) << failure;
}

/** Two surfaces of one file that share a curve are two bodies with a side of its name each. */
TEST(Bodies, ShareAMeshFile)
{
  const auto file = std::filesystem::path(::testing::TempDir()) / "hpvi-two-squares.msh";
  std::ofstream(file) << two_squares_41;
  const Overrides both{
      {"Contact line/Friction bound", "0.01"},       given::elastic("10", "0.3"),
      {"Material stiff/Young's modulus", "20"},      {"Boundary a.bottom/Displacement", "0; 0"},
      {"Boundary b.bottom/Displacement", "0; 0.01"}, {"Adaptivity/Maximum steps", "6"}};
  const Result meshes = solved(scene_of(joined({both,
                                                {{"Body a/Shape", "file"},
                                                 {"Body a/File", file.string()},
                                                 {"Body a/Surfaces", "soft part"},
                                                 {"Body b/Shape", "file"},
                                                 {"Body b/File", file.string()},
                                                 {"Body b/Surfaces", "stiff"},
                                                 {"Contact line/Between", "a.joint, b.joint"},
                                                 {"Boundary b.7/Traction", "-0.2; 0"}}}))),
               boxes = solved(scene_of(joined({both,
                                               {{"Body b/Lower corner", "1, 0"},
                                                {"Body b/Upper corner", "2, 1"},
                                                {"Body a/Upper corner", "1, 1"},
                                                {"Body b/Material", "stiff"},
                                                {"Contact line/Between", "a.right, b.left"},
                                                {"Boundary b.right/Traction", "-0.2; 0"}}})));
  EXPECT_LT(boxes.normal, -0.04);
  EXPECT_GT(std::abs(boxes.friction), 1e-3);
  EXPECT_NEAR(meshes.energy, boxes.energy, 1e-12);
  EXPECT_NEAR(meshes.normal, boxes.normal, 1e-10);
  EXPECT_NEAR(meshes.friction, boxes.friction, 1e-10);
}

// ---------------------------------------------------------------- bodies of a mesh file

/** A block of a mesh file, with a grid of cells; its sides are called "NAME left" and so on, or "NAME" all round. */
struct DrawnBlock
{
  std::string name;
  Point<2> lower, upper;
  std::array<unsigned int, 2> n;
  bool is_clockwise = false, shares_nodes = false, has_one_side = false;
  unsigned int first_cell = 0; ///< of those in a row, by which the file begins
};

/** In format 2.2; each block has nodes of its own, or those that others have at its places. */
std::string file_of(const std::vector<DrawnBlock> &blocks)
{
  std::ostringstream nodes, elements, names;
  std::map<std::array<double, 2>, unsigned int> known;
  unsigned int n_nodes = 0, n_elements = 0, n_names = 0;
  const auto group = [&](const unsigned int dim, const std::string &name)
  {
    names << dim << " " << ++n_names << " \"" << name << "\"\n";
    return n_names;
  };
  for (const DrawnBlock &block : blocks)
  {
    const auto [nx, ny] = block.n;
    std::vector<unsigned int> own;
    for (unsigned int j = 0; j <= ny; ++j)
      for (unsigned int i = 0; i <= nx; ++i)
      {
        const std::array<double, 2> x{
            {block.lower[0] + (block.upper[0] - block.lower[0]) * i / nx,
             block.lower[1] + (block.upper[1] - block.lower[1]) * j / ny}};
        const auto other = known.find(x);
        own.push_back(block.shares_nodes && other != known.end() ? other->second : ++n_nodes);
        if (own.back() == n_nodes)
          nodes << n_nodes << " " << in_digits(x[0]) << " " << in_digits(x[1]) << " 0\n";
        known.emplace(x, own.back());
      }
    const auto node = [&, nx = nx](const unsigned int i, const unsigned int j)
    { return own[j * (nx + 1) + i]; };
    const auto element = [&](const unsigned int type, const unsigned int tag,
                             const std::vector<unsigned int> &corners)
    {
      elements << ++n_elements << " " << type << " 2 " << tag << " " << tag;
      for (const unsigned int corner : corners)
        elements << " " << corner;
      elements << "\n";
    };
    const unsigned int surface = group(2, block.name);
    for (unsigned int k = 0; k < nx * ny; ++k)
    {
      const unsigned int cell = (block.first_cell + k) % (nx * ny), i = cell % nx, j = cell / nx;
      if (block.is_clockwise)
        element(3, surface, {node(i, j), node(i, j + 1), node(i + 1, j + 1), node(i + 1, j)});
      else
        element(3, surface, {node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
    }
    unsigned int side = block.has_one_side ? group(1, block.name) : 0;
    const auto next_side = [&](const std::string &name)
    { side = block.has_one_side ? side : group(1, block.name + " " + name); };
    next_side("left");
    for (unsigned int j = 0; j < ny; ++j)
      element(1, side, {node(0, j), node(0, j + 1)});
    next_side("right");
    for (unsigned int j = 0; j < ny; ++j)
      element(1, side, {node(nx, j), node(nx, j + 1)});
    next_side("bottom");
    for (unsigned int i = 0; i < nx; ++i)
      element(1, side, {node(i, 0), node(i + 1, 0)});
    next_side("top");
    for (unsigned int i = 0; i < nx; ++i)
      element(1, side, {node(i, ny), node(i + 1, ny)});
  }
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n" + std::to_string(n_names) + "\n" +
         names.str() + "$EndPhysicalNames\n$Nodes\n" + std::to_string(n_nodes) + "\n" +
         nodes.str() + "$EndNodes\n$Elements\n" + std::to_string(n_elements) + "\n" +
         elements.str() + "$EndElements\n";
}

std::string written(const std::string &name, const std::vector<DrawnBlock> &blocks)
{
  const auto file = std::filesystem::path(::testing::TempDir()) / name;
  std::ofstream(file) << file_of(blocks);
  return file.string();
}

/** Where bodies of one file touch they may have nodes at one place, or none that match: the file has no other surfaces for them. */
TEST(Bodies, OfOneFileHaveNodesOfTheirOwn)
{
  const DrawnBlock lower{"lower", {0, 0}, {3, 1}, {{3, 1}}},
      upper{"upper", {1, 1}, {2, 2}, {{1, 1}}}, upper_of_four{"upper", {1, 1}, {2, 2}, {{4, 2}}},
      clockwise{"upper", {1, 1}, {2, 2}, {{2, 1}}, true},
      all_over{"third", {0, 0}, {3, 2}, {{2, 2}}},
      corner{"third", {3, 1}, {4, 2}, {{1, 1}}, false, true},
      inside{"third", {0.25, 0.25}, {0.75, 0.75}, {{1, 1}}};
  const std::vector<std::pair<std::string, std::vector<DrawnBlock>>> rows{
      {"an edge on an edge", {lower, upper}},
      {"four edges on one", {lower, upper_of_four}},
      {"the upper one first", {upper, lower}},
      {"a cell that is clockwise", {lower, clockwise}},
      {"a surface all over them", {all_over, lower, upper_of_four}},
      {"a surface that shares a corner", {lower, upper, corner}},
      {"a surface inside", {inside, lower, upper}}};
  for (const auto &[name, blocks] : rows)
  {
    const std::string file = written("hpvi-blocks.msh", blocks);
    const Overrides both{{"Contact joint/Friction bound", "0.02"},
                         {"Material/Young's modulus", "10"},
                         {"Adaptivity/Maximum steps", "3"}};
    Overrides drawn{{"Contact joint/Between", "upper.upper bottom, lower.lower top"},
                    {"Boundary lower.lower bottom/Displacement", "0; 0"},
                    {"Boundary upper.upper top/Displacement", "0.01; -0.02"}},
        boxes{{"Contact joint/Between", "upper.bottom, lower.top"},
              {"Boundary lower.bottom/Displacement", "0; 0"},
              {"Boundary upper.top/Displacement", "0.01; -0.02"}};
    for (const DrawnBlock &block : blocks)
      if (block.name != "third")
      {
        const auto comma = [](const double x, const double y)
        { return in_digits(x) + ", " + in_digits(y); };
        const std::string body = "Body " + block.name;
        drawn = joined({drawn,
                        {{body + "/Shape", "file"},
                         {body + "/File", file},
                         {body + "/Surfaces", block.name}}});
        boxes = joined({boxes,
                        {{body + "/Lower corner", comma(block.lower[0], block.lower[1])},
                         {body + "/Upper corner", comma(block.upper[0], block.upper[1])},
                         {body + "/Subdivisions", comma(block.n[0], block.n[1])}}});
      }
    const Result meshes = solved(scene_of(joined({both, drawn}))),
                 grids = solved(scene_of(joined({both, boxes})));
    EXPECT_LT(grids.normal, -0.1);
    EXPECT_NEAR(meshes.energy, grids.energy, 1e-12) << name;
    EXPECT_NEAR(meshes.normal, grids.normal, 1e-10) << name;
    EXPECT_NEAR(meshes.friction, grids.friction, 1e-10) << name;
  }
  // One body of both surfaces wants nodes that they share, and says what else there is.
  const std::string refusal = failure_of<InputError>(
      [&]
      {
        scene_of({{"Geometry/Shape", "file"},
                  {"Geometry/File", written("hpvi-blocks.msh", {lower, upper})}});
      });
  EXPECT_TRUE(says(refusal, "with its Surfaces")) << refusal;
}

/** Wherever a mesh begins the loop of its edges, contact along a part of it is told from one end to the other. */
TEST(Bodies, TellContactFromAnEnd)
{
  struct Row
  {
    std::string where;
    std::vector<std::array<double, 2>> chains; ///< by x of their ends
  };
  for (const Row &row :
       {Row{"0.01 - y", {{{0, 6}}}}, Row{"0.01 - y - 10*max(0, x - 5)", {{{0, 5}}}},
        Row{"min(0.01 - y, x - 2)", {{{2, 6}}}},
        Row{"min(0.01 - y, abs(x - 3) - 1)", {{{0, 2}}, {{4, 6}}}}})
    for (unsigned int first = 0; first < 6; ++first)
    {
      DrawnBlock block{"block", {0, 0}, {6, 1}, {{6, 1}}};
      block.has_one_side = true;
      block.first_cell = first;
      const Scene<2> scene = scene_of({{"Geometry/Shape", "file"},
                                       {"Geometry/File", written("hpvi-loop.msh", {block})},
                                       {"Boundary foot/On", "block"},
                                       {"Boundary foot/Where", row.where},
                                       given::rough("foot", "bilateral", "0.01"),
                                       {"Boundary lid/On", "block"},
                                       {"Boundary lid/Where", "y - 0.99"},
                                       {"Boundary lid/Displacement", "0.1; -0.1"},
                                       {"Adaptivity/Maximum steps", "2"}});
      AdaptiveSolver<2>(scene).run(
          [&](const StepReport<2> &step)
          {
            const ContactState<2> &state = step.contact.at(0);
            ASSERT_EQ(state.chains.size(), row.chains.size()) << row.where << first;
            std::vector<std::array<double, 2>> chains; // of several any may be the first
            for (const ContactChain<2> &chain : state.chains)
            {
              chains.push_back({{chain.begin[0], chain.end[0]}});
              for (unsigned int k = chain.first_point; k + 1 < chain.last_point; ++k)
                EXPECT_LT(state.points[k].x[0], state.points[k + 1].x[0]) << row.where << first;
            }
            std::sort(chains.begin(), chains.end());
            for (unsigned int k = 0; k < chains.size(); ++k)
              for (const unsigned int end : {0, 1})
                EXPECT_NEAR(chains[k][end], row.chains[k][end], 1e-12) << row.where << first;
            EXPECT_EQ(state.zones.size(), row.chains.size()) << row.where << first;
          });
    }
}

// ---------------------------------------------------------------- what the drawing leaves between bodies

/** Blocks of 2 x 1 on each other under the pressure 1: distances and overlaps that count as none change nothing. */
TEST(Bodies, CloseSmallGapsOfTheDrawing)
{
  struct Row
  {
    std::string law, corners, closed;
    double tolerance; ///< of the pressure 1
    std::string words;
  };
  const std::string apart = "0, 1.001; 2, 1.001; 2, 2.001; 0, 2.001",
                    inside = "0, 0.998; 2, 0.998; 2, 1.998; 0, 1.998",
                    askew = "0, 1.001; 2, 1.002; 2, 2; 0, 2", touching = "0, 1; 2, 1; 2, 2; 0, 2",
                    through = "0, 0.999; 2, 1.001; 2, 2; 0, 2";
  for (const Row &row : {Row{"unilateral", apart, "0.001", 1e-9, "lie 0.001 apart"},
                         Row{"bilateral", apart, "0.002", 1e-9, "lie 0.001 apart"},
                         Row{"tied", apart, "0.01", 1e-9, "lie 0.001 apart"},
                         Row{"unilateral", inside, "0.002", 1e-9, "lie 0.002 inside each other"},
                         Row{"tied", inside, "0.003", 1e-9, "lie 0.002 inside each other"},
                         Row{"tied", askew, "0.003", 2e-3, "from 0.001 to 0.002, count as none"},
                         Row{"unilateral", through, "0.0015", 2e-3, "count as none"},
                         Row{"tied", touching, "0.001", 1e-9, "lie 0 apart"}})
  {
    const Scene<2> scene = scene_of({given::block("lower", "2, 1", "3, 1"),
                                     given::quadrilateral("Body upper", row.corners, "2, 1"),
                                     {"Material/Young's modulus", "10"},
                                     {"Material/Plane", "stress"},
                                     given::joint("joint", "upper.bottom, lower.top", row.law),
                                     {"Contact joint/Closed within", row.closed},
                                     given::symmetric({"lower.bottom", "lower.left", "upper.left"}),
                                     {"Boundary upper.top/Pressure", "1"},
                                     {"Adaptivity/Maximum steps", "1"}});
    EXPECT_TRUE(mentions(scene.remarks, row.words)) << row.words << ": " << scene.remarks.at(0);
    AdaptiveSolver<2>(scene).run(
        [&](const StepReport<2> &step)
        {
          EXPECT_NEAR(step.energies.energy, -0.2, 0.2 * row.tolerance) << row.law << row.corners;
          for (const ContactPoint<2> &point : step.contact.at(0).points)
            EXPECT_NEAR(point.normal_traction, -1, row.tolerance) << row.law << row.corners;
        });
  }
  // Distances that vary count as none up to it, and are meant beyond.
  const Scene<2> wedge =
      scene_of({given::block("lower", "2, 1", "3, 1"),
                given::quadrilateral("Body upper", "0, 0.999; 2, 1.003; 2, 2; 0, 2"),
                {"Contact joint/Between", "upper.bottom, lower.top"},
                {"Contact joint/Slave", "lower.top"},
                {"Contact joint/Closed within", "0.0015"},
                given::clamped({"lower.bottom", "upper.top"})});
  const Expression<2> gap = wedge.boundaries[wedge.pairs.at(0).parts[1]].gap;
  for (const double x : {0.1, 0.4, 0.6, 1.2, 1.24, 1.26, 1.5, 1.9})
    EXPECT_NEAR(gap->value(Point<2>(x, 1)), x < 1.25 ? 0. : 0.002 * x - 0.001, 1e-6) << x;
  // Where they shall touch in a point it is no remedy, and says so.
  const Scene<2> disc = scene_of({{"Body disc/Shape", "half disc"},
                                  {"Body disc/Centre", "0, 0.999"},
                                  {"Body disc/Angle", "180"},
                                  {"Body lower/Lower corner", "-2, -1"},
                                  {"Body lower/Upper corner", "2, 0"},
                                  {"Contact joint/Between", "disc.arc, lower.top"},
                                  {"Contact joint/Closed within", "0.002"},
                                  given::clamped({"lower.bottom", "disc.flat"})});
  EXPECT_TRUE(mentions(disc.remarks, "lie flat on each other"));
  // Beyond it the drawing is meant.
  EXPECT_NEAR(solved(scene_of({{"Body lower/Upper corner", "2, 1"},
                               {"Body upper/Lower corner", "0, 1.01"},
                               {"Body upper/Upper corner", "2, 2"},
                               {"Contact joint/Between", "upper.bottom, lower.top"},
                               {"Contact joint/Closed within", "0.005"},
                               given::symmetric({"lower.bottom", "lower.left"}),
                               {"Boundary upper.top/Displacement", "0; -0.005"},
                               {"Adaptivity/Maximum steps", "1"}}))
                  .normal,
              0, 1e-12);
}

/**
 * A temperature that jumps along edges is the same as materials that expand by different amounts: what an expression says of the edges
 * themselves is that of one side, and no more than the other's.
 */
TEST(Bodies, MeetAtOtherTemperatures)
{
  struct Row
  {
    std::string name;
    Overrides entries;
    std::pair<std::string, std::string> other; ///< the place of the material that expands
    std::string jump, level;                   ///< temperatures
    double tolerance;
  };
  const Overrides shaft{given::block("a", "15, 0", "30, 60", "2, 6"),
                        given::block("b", "30, 0", "60, 60", "3, 6"),
                        {"Material/Plane", "axisymmetric"},
                        given::symmetric({"a.bottom", "b.bottom", "a.top"}),
                        {"Contact fit/Between", "b.left, a.right"}},
      stack{
          given::block("a", "3, 1", "3, 1"),          given::block("b", "1, 1", "2, 2", "2, 2"),
          {"Boundary a.bottom/Displacement", "0; 0"}, {"Boundary b.top/Displacement", "0; -0.001"},
          {"Contact fit/Friction bound", "0.001"},    {"Contact fit/Between", "b.bottom, a.top"}},
      askew{given::quadrilateral("Body a", "0, 0; 2, 0; 2, 1.2; 0, 0.7", "2, 1"),
            given::quadrilateral("Body b", "0, 0.7; 2, 1.2; 2, 2; 0, 2", "3, 1"),
            {"Boundary a.bottom/Displacement", "0; 0"},
            given::joint("fit", "b.bottom, a.top", "tied")},
      rings{given::ring("Body a", "1, 1.5", "0, 90", "1, 4"),
            given::ring("Body b", "1.5, 2", "0, 90", "1, 5"),
            given::symmetric({"a.start", "b.start", "a.end", "b.end"}),
            {"Contact fit/Between", "b.inner, a.outer"}},
      alone{{"Geometry/Upper corner", "2, 1"}, {"Boundary left/Displacement", "0; 0"}};
  const std::pair<std::string, std::string> in_b{"Body b/Material", "other"},
      in_a{"Body a/Material", "other"}, right{"Material other/Where", "x > 0.7"};
  for (const Row &row :
       {Row{"a cold hub on a shaft", shaft, in_b, "x > 30 ? -1 : 0", "-1", 1e-9},
        Row{"the joint belongs to the hub", shaft, in_b, "x >= 30 ? -1 : 0", "-1", 1e-9},
        Row{"a hot shaft", shaft, in_a, "x < 30 ? 1 : 0", "1", 1e-9},
        Row{"a stack", stack, in_b, "y > 1 ? 1 : 0", "1", 1e-9},
        Row{"the joint belongs to the block", stack, in_b, "y >= 1 ? 1 : 0", "1", 1e-9},
        Row{"a slanted joint", askew, in_b, "y > 0.7 + 0.25*x + 1e-12 ? 1 : 0", "1", 1e-9},
        Row{"rings", rings, in_b, "x*x + y*y > 2.25 ? -1 : 0", "-1", 1e-6},
        Row{"materials of one body", alone, right, "x > 0.7 ? 1 : 0", "1", 1e-9},
        Row{"the line between them is hot", alone, right, "x >= 0.7 ? 1 : 0", "1", 1e-9}})
  {
    const auto steps = [&](const std::string &temperature, const std::string &alpha)
    {
      const Scene<2> scene = scene_of(joined({row.entries,
                                              {{"Material/Young's modulus", "10"},
                                               {"Material/Thermal expansion", alpha},
                                               {"Material other/Young's modulus", "20"},
                                               {"Material other/Thermal expansion", "0.001"},
                                               {"Temperature/Expression", temperature},
                                               {"Adaptivity/Indicator", "residual"},
                                               {"Adaptivity/Maximum steps", "3"},
                                               row.other}}));
      std::vector<std::array<double, 3>> result;
      AdaptiveSolver<2>(scene).run(
          [&](const StepReport<2> &step)
          {
            double peak = 0;
            for (const StressSample<2> &sample : stress_samples(step.field))
              peak = std::max(peak, sample.value);
            result.push_back({{step.energies.energy, step.norms.total, peak}});
          });
      return result;
    };
    const auto jumps = steps(row.jump, "0.001"), known = steps(row.level, "0");
    ASSERT_EQ(jumps.size(), known.size()) << row.name;
    for (unsigned int k = 0; k < known.size(); ++k)
      for (unsigned int i = 0; i < 3; ++i)
        EXPECT_NEAR(jumps[k][i], known[k][i],
                    row.tolerance * std::max(std::abs(known[k][i]), std::abs(known[0][i])))
            << row.name << k << i;
  }
}

// ---------------------------------------------------------------- what one body can

/** Parts and materials end where a box gets a grid line, be it `Geometry` or a `Body`. */
TEST(Bodies, AreCutAsOneBodyIs)
{
  const std::vector<Overrides> rows{
      {{"Boundary load/On", "top"}, {"Boundary load/Where", "0.3 - abs(x - 0.5)"}},
      {{"Boundary load/On", "right"}, {"Boundary load/Where", "y - 0.3"}},
      {{"Boundary load/On", "top"}, {"Boundary load/Where", "abs(x - 0.5) - 0.1"}},
      {{"Boundary load/On", "top"}, {"Boundary load/Where", "x < 0.123"}},
      {{"Boundary load/On", "top"},
       {"Boundary load/Where", "1"},
       {"Material hard/Where", "y > 0.3"}},
      {{"Boundary load/On", "top"},
       {"Boundary load/Where", "1"},
       {"Material hard/Where", "0.2 - abs(x - 1)"}},
      {{"Boundary load/On", "left"},
       {"Boundary load/Where", "0.6 - y"},
       {"Material hard/Where", "min(x - 0.7, 0.4 - y)"}}};
  for (const Overrides &row : rows)
  {
    const auto scene = [&](const std::string &body, const std::string &side)
    {
      Overrides entries{
          {body + "/Upper corner", "2, 1"},   {body + "/Subdivisions", "2, 1"},
          {"Boundary load/Pressure", "1"},    {"Boundary " + side + "bottom/Displacement", "0; 0"},
          {"Material/Young's modulus", "10"}, {"Adaptivity/Maximum steps", "2"}};
      for (const auto &[path, value] : row)
        entries.emplace_back(path, path == "Boundary load/On" ? side + value : value);
      if (std::any_of(row.begin(), row.end(),
                      [](const auto &entry) { return entry.first == "Material hard/Where"; }))
        entries.emplace_back("Material hard/Young's modulus", "40");
      return scene_of(entries);
    };
    const auto energy = [](const Scene<2> &scene)
    {
      double result = 0;
      AdaptiveSolver<2>(scene).run([&](const StepReport<2> &step)
                                   { result = step.energies.energy; });
      return result;
    };
    const Scene<2> one = scene("Geometry", ""), body = scene("Body a", "a.");
    EXPECT_EQ(one.geometry.n_cells(), body.geometry.n_cells());
    const double wanted = energy(one);
    EXPECT_NEAR(energy(body), wanted, 1e-12 * std::abs(wanted)) << row[1].second;
    if (row[1].second == "1")
      continue;
    ASSERT_FALSE(one.remarks.empty());
    ASSERT_EQ(body.remarks.size(), one.remarks.size());
    for (unsigned int k = 0; k < one.remarks.size(); ++k)
      EXPECT_EQ(body.remarks[k], "Body a: " + one.remarks[k]);
  }
}

// ---------------------------------------------------------------- histories

/** Sheared to and fro: what slipped stays slipped, work is dissipated, and the balance of energies closes. */
TEST(Bodies, RememberTheirSlip)
{
  const Overrides cycle = joined(
      {known_cases()[1].entries,
       {{"Loading/Steps", "4"},
        {"Boundary upper.top/Displacement", "0.03*(t<0.3 ? 1 : t<0.6 ? 0 : t<0.8 ? -1 : 0); -0.02"},
        {"Adaptivity/Maximum steps", "4"}}});
  double dissipated = 0;
  std::vector<double> friction;
  LoadHistory<2>(scene_of(cycle))
      .run(
          [&](const StepReport<2> &step)
          {
            if (step.stopped_by.empty())
              return;
            EXPECT_GE(step.load.dissipated, dissipated - 1e-12);
            dissipated = step.load.dissipated;
            friction.push_back(step.contact[0].friction_resultant);
            EXPECT_NEAR(step.load.work,
                        step.load.stored + step.load.dissipated + step.load.released +
                            step.load.unbalanced,
                        1e-9 * step.load.work);
          });
  EXPECT_GT(dissipated, 1e-4);
  ASSERT_EQ(friction.size(), 4U);
  EXPECT_LT(friction[0], -0.05);
  EXPECT_GT(friction[1], 0.001); // back where it was friction has the other sign
  EXPECT_GT(friction[2], 0.05);
  EXPECT_LT(friction[3], -0.001);
}
} // namespace
