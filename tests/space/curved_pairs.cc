// SPDX-License-Identifier: LGPL-2.1-or-later
// Bodies that touch along faces of second order, or along several planes, by meshes that do not match.
#include "curved_bodies.h"

#include <hpvi/base/input_error.h>
#include <hpvi/driver/load_history.h>

#include <algorithm>
#include <set>

namespace
{
using namespace space;

constexpr double pi = numbers::PI;

/** Of both bodies: a quadratic that the cells of any grid have exactly. */
double between(const Point<3> &x)
{
  return 0.3 * x[0] * x[0] + 0.2 * x[0] * x[2] - 0.25 * x[2] * x[2];
}

Point<3> turned(const Point<3> &x)
{
  const double c = std::cos(0.5), s = std::sin(0.5), d = std::cos(0.3), t = std::sin(0.3);
  const Point<3> y(c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]);
  return {y[0], d * y[1] - t * y[2], t * y[1] + d * y[2]};
}

/** The cushion above that quadratic, and what lies below it. */
Scene<3> cushions(const std::array<unsigned int, 2> &n, const Overrides &entries)
{
  const Map high = [](const Point<3> &x) {
    return turned({x[0], between(x) * (1 - x[1]) + x[1], x[2]});
  };
  const Map low = [](const Point<3> &x) {
    return turned({x[0], between(x) * x[1] - (1 - x[1]), x[2]});
  };
  return two_bodies({{{n[0], 1, n[0]}}, high, true, Grid::everywhere, 27},
                    {{{n[1], 1, n[1]}}, low, true, Grid::everywhere, 27}, {"bottom", "top"},
                    Overrides{{"Adaptivity/Maximum steps", "1"},
                              {"Boundary one.top/Displacement", "0; 0; 0"},
                              {"Boundary other.bottom/Displacement", "0; 0; 0"}} +
                        entries);
}

/** The cells of each body towards @p x. */
void grade(Scene<3> &scene, const Point<3> &x, const unsigned int levels)
{
  scene.geometry.graded_towards = {x};
  scene.geometry.grading_levels = levels;
  for (Body<3> &body : scene.geometry.bodies)
  {
    body.graded_towards = {x};
    body.grading_levels = levels;
  }
}

/** On all sides but those between the bodies. */
void prescribe_around(Scene<3> &scene, const KnownField<3> &exact)
{
  for (BoundaryCondition<3> &boundary : scene.boundaries)
    if (!boundary.pair)
      prescribe(boundary, exact);
}

double largest_error(const StepReport<3> &step, const KnownField<3> &exact)
{
  double result = 0;
  const Point<3> unit(0.3, 0.6, 0.2);
  for (const auto &cell : step.field.dof_handler.active_cell_iterators())
    result = std::max(result, (step.field.values(cell, {unit})[0].displacement -
                               exact.value(map_of<3>(cell).point(unit)))
                                  .norm());
  return result;
}

const KnownField<3> shrinking{[](const Point<3> &x) { return -0.01 * x; }, [](const Point<3> &)
                              { return -0.01 * Tensor<2, 3>(unit_symmetric_tensor<3>()); }};

/** A uniform pressure passes from one body to the other: both have the same face, and its parts are polygons. */
TEST(CurvedPairs, PassAUniformPressure)
{
  for (const auto &[law, degree, own_degree, slave, linear] :
       {std::tuple("unilateral", 2U, 0U, "one.bottom", LinearMethod::multigrid),
        {"unilateral", 2U, 0U, "other.top", LinearMethod::direct},
        {"tied", 2U, 0U, "other.top", LinearMethod::multigrid},
        {"tied", 3U, 0U, "one.bottom", LinearMethod::amg},
        {"bilateral", 4U, 0U, "other.top", LinearMethod::multigrid},
        {"unilateral", 3U, 2U, "one.bottom", LinearMethod::multigrid},
        {"unilateral", 2U, 4U, "other.top", LinearMethod::multigrid}})
  {
    Scene<3> scene = cushions({{degree > 2 ? 1U : 2U, degree > 2 ? 2U : 3U}},
                              {{"Contact joint/Law", law}, {"Contact joint/Slave", slave}});
    scene.adaptivity.start_degree = degree;
    scene.adaptivity.degrees_of_bodies = {0, own_degree};
    scene.solver.linear = linear;
    scene.solver.primal_tolerance = 1e-12;
    grade(scene, turned({0, 0, 0}), 1);
    prescribe_around(scene, shrinking);
    const double pressure = 0.01 * scene.materials[0].young / (1 - 2 * scene.materials[0].poisson);
    steps_of<3>(scene,
                [&](const StepReport<3> &step)
                {
                  ASSERT_FALSE(step.contact.at(0).points.empty());
                  for (const ContactPoint<3> &point : step.contact.at(0).points)
                    EXPECT_NEAR(point.normal_traction, -pressure, 1e-8 * pressure);
                  EXPECT_LT(largest_error(step, shrinking), 1e-9);
                  EXPECT_LT(step.norms.total, 1e-6);
                });
  }
}

/** Edges of the master bend along a slave that lies away from it: cut along them, no part reaches far beyond its face of the master. */
TEST(CurvedPairs, AreCutWhereEdgesBend)
{
  const Map high = [](const Point<3> &x)
  { return Point<3>(x[0], between(x) * (1 - x[1]) + x[1], x[2]); };
  const Map low = [](const Point<3> &x)
  {
    const double a = 1.8 * (x[0] - 0.5), b = 1.8 * (x[2] - 0.5);
    const Point<3> y(0.5 + 0.9 * a - 0.4 * b, x[1], 0.5 + 0.4 * a + 0.9 * b);
    return Point<3>(y[0], (between(y) - 0.4) * x[1] - (1 - x[1]), y[2]);
  };
  const Scene<3> scene =
      two_bodies({{{2, 1, 2}}, high, true, Grid::everywhere, 27},
                 {{{3, 1, 3}}, low, true, Grid::everywhere, 27}, {"bottom", "top"},
                 {{"Contact joint/Slave", "one.bottom"},
                  {"Adaptivity/Maximum steps", "1"},
                  {"Boundary one.top/Displacement", "0; -0.001; 0"},
                  {"Boundary other.bottom/Displacement", "0; 0; 0"}});
  steps_of<3>(scene,
              [&](const StepReport<3> &step)
              {
                const PrimalSpace<3> &space = step.primal->space;
                double beyond = 0;
                unsigned int n_parts = 0;
                for (unsigned int k = 0; k < space.faces.size(); ++k)
                  for (const OppositeFaces::Part &part : (*space.opposite)[k].parts)
                  {
                    ++n_parts;
                    for (const auto &point : space.opposite->points_of(part, space.faces[k], 8))
                      for (unsigned int d = 0; d < 3; ++d)
                        beyond = std::max({beyond, -point.reference[d], point.reference[d] - 1});
                  }
                EXPECT_GT(n_parts, 9U);
                EXPECT_LT(beyond, 4e-3); // triangles of parts that are a little concave
              });
}

/** What moves like one body has no jump. */
TEST(CurvedPairs, MoveLikeOneBody)
{
  const Tensor<2, 3> spin({{0, -0.3, 0.2}, {0.3, 0, -0.1}, {-0.2, 0.1, 0}});
  const Tensor<1, 3> way({0.5, -0.2, 0.3});
  const KnownField<3> rigid{[=](const Point<3> &x) { return way + spin * x; },
                            [=](const Point<3> &) { return spin; }};
  Scene<3> rings = two_rings(3, 4, {{"Contact joint/Law", "tied"}});
  for (BoundaryCondition<3> &boundary : rings.boundaries)
    boundary.symmetry = false;
  for (Scene<3> scene : {cushions({{2, 3}}, {{"Contact joint/Law", "tied"}}), rings})
  {
    const bool is_ring = scene.geometry.radius() > 1.4;
    prescribe_around(scene, rigid);
    steps_of<3>(scene,
                [&](const StepReport<3> &step)
                {
                  // Faces of rings with other arcs are 1e-4 apart, by which a rotation moves them along each other.
                  EXPECT_LT(largest_error(step, rigid), is_ring ? 1e-3 : 1e-10);
                });
  }
}
/** A tied joint under any constant stress: tractions that turn with the normal are those of degree p - 2. */
TEST(CurvedPairs, PassAnyStressTheBetterTheFinerTheyAre)
{
  const Tensor<2, 3> B({{0.1, -0.02, 0.03}, {0.05, -0.1, 0.04}, {-0.03, 0.06, 0.2}});
  const KnownField<3> exact{[=](const Point<3> &x) { return B * x; },
                            [=](const Point<3> &) { return B; }};
  for (const unsigned int degree : {2U, 3U})
  {
    std::vector<double> errors;
    for (const unsigned int n : {2U, 4U})
    {
      Scene<3> scene = cushions({{n, 3 * n / 2}}, {{"Contact joint/Law", "tied"}});
      scene.adaptivity.start_degree = degree;
      prescribe_around(scene, exact);
      steps_of<3>(scene,
                  [&](const StepReport<3> &step) { errors.push_back(largest_error(step, exact)); });
    }
    EXPECT_LT(errors[1], errors[0] / 3) << degree;
  }
}

/** Lame's shrink fit. */
TEST(CurvedPairs, FitLikeLamesRings)
{
  for (const char *const slave : {"one.right", "other.left"})
    for (const auto &[n, m, degree, within, sum] : {std::tuple(4U, 6U, 2U, 2e-4, 1.2e-4),
                                                    {8U, 12U, 2U, 2e-5, 1e-5},
                                                    {8U, 12U, 3U, 4e-5, 1e-7}})
    {
      std::ostringstream gap;
      gap.precision(16);
      gap << -overlap_of_rings();
      Scene<3> scene =
          two_rings(n, m, {{"Contact joint/Gap", gap.str()}, {"Contact joint/Slave", slave}});
      scene.adaptivity.start_degree = degree;
      steps_of<3>(scene,
                  [&](const StepReport<3> &step)
                  {
                    double normal = 0, area = 0, worst = 0;
                    for (const ContactPoint<3> &point : step.contact.at(0).points)
                    {
                      worst = std::max(worst, std::abs(point.normal_traction + 1));
                      normal -= point.area * point.normal_traction;
                      area += point.area;
                    }
                    EXPECT_LT(worst, within);
                    EXPECT_NEAR(normal / (pi / 2), 1, sum);
                    EXPECT_NEAR(area / (pi / 2), 1, 3e-5);
                  });
    }
}

double force_on(const StepReport<3> &step, const std::string &name, const unsigned int component)
{
  double result = 0;
  for (const Resultant<3> &resultant : step.forces)
    if (resultant.name == name)
      result += resultant.force[component].value;
  return result;
}

/** What one body exerts on the other is what it gets, and each is in balance. */
void expect_balance(const StepReport<3> &step, const std::string &one, const std::string &other,
                    const double size)
{
  for (unsigned int c = 0; c < 3; ++c)
    EXPECT_NEAR(force_on(step, one, c), -force_on(step, other, c), 1e-9 * size) << c;
  EXPECT_LT(step.equilibrium.force_imbalance, 1e-8);
  EXPECT_LT(step.equilibrium.moment_imbalance, 1e-8);
}

/** An outer ring that is drawn off the inner one by @p way along z. */
Scene<3> drawn_ring(const bool follows_pressure, const std::string &slave, const std::string &way,
                    const Overrides &entries = {})
{
  return two_rings(3, 4,
                   Overrides{{"Boundary one.front/Symmetry", "false"},
                             {"Boundary one.back/Symmetry", "false"},
                             {"Boundary other.front/Symmetry", "false"},
                             {"Boundary other.back/Symmetry", "false"},
                             {"Boundary one.left/Displacement", "0; 0; 0"},
                             {"Boundary other.right/Displacement", "0; 0; " + way},
                             {"Contact joint/Gap", "-0.02"},
                             {"Contact joint/Slave", slave},
                             {"Adaptivity/Maximum steps", "2"},
                             {"Adaptivity/Method", "hap2"}} +
                       (follows_pressure ? Overrides{{"Contact joint/Friction coefficient", "0.2"}}
                                         : Overrides{{"Contact joint/Friction bound", "0.2"}}) +
                       entries);
}

/** Friction is its bound, under Tresca's and under Coulomb's law. */
TEST(CurvedPairs, SlipAlongEachOther)
{
  for (const bool follows_pressure : {false, true})
    for (const char *const slave : {"one.right", "other.left"})
      steps_of<3>(drawn_ring(follows_pressure, slave, "0.1"),
                  [&](const StepReport<3> &step)
                  {
                    double bound = 0;
                    for (const ContactPoint<3> &point : step.contact.at(0).points)
                    {
                      EXPECT_GT(std::abs(point.lambda[2]), 0.99);
                      bound += 0.2 * point.area * (follows_pressure ? -point.normal_traction : 1.);
                    }
                    EXPECT_NEAR(std::abs(force_on(step, "one.right", 2)) / bound, 1, 1e-3);
                    expect_balance(step, "one.right", "other.left", bound);
                    EXPECT_NEAR(step.energies.slack, 0, 1e-4 * bound * 0.1);
                  });
}

/** Drawn, pushed back, and left there: slip counts from the load step before, and what loads do is stored or lost by friction. */
TEST(CurvedPairs, RememberTheirSlip)
{
  for (const char *const slave : {"one.right", "other.left"})
  {
    const Scene<3> scene =
        drawn_ring(false, slave, "(t < 0.5 ? 0.3 : 0)", {{"Loading/Steps", "3"}});
    std::vector<double> dissipated;
    double drawn = 0;
    LoadHistory<3>(scene).run(
        [&](const StepReport<3> &step)
        {
          if (step.stopped_by.empty())
            return;
          double force = 0, slip = 0, area = 0;
          for (const ContactPoint<3> &point : step.contact.at(0).points)
          {
            EXPECT_GT(std::abs(point.lambda[2]), 0.99);
            force += 0.2 * point.area * point.lambda[2];
            slip += point.area * point.slip[2];
            area += point.area;
          }
          slip /= area;
          dissipated.push_back(step.load.dissipated);
          EXPECT_NEAR(step.load.work,
                      step.load.stored + step.load.dissipated + step.load.released +
                          step.load.unbalanced,
                      1e-5 * dissipated[0]);
          if (dissipated.size() == 1)
            drawn = force;
          else
            EXPECT_NEAR(force, -drawn, 1e-3 * std::abs(drawn)); // friction has turned
          if (dissipated.size() < 3)
            EXPECT_NEAR(std::abs(slip), dissipated.size() == 1 ? 0.267 : 0.234, 0.002);
          else
            EXPECT_NEAR(slip, 0, 1e-7);
        });
    ASSERT_EQ(dissipated.size(), 3U);
    EXPECT_NEAR(dissipated[2], dissipated[1], 1e-6 * dissipated[1]);
  }
}

/** Of half a turn eight facets, on radii from @p inner on: cells may be more than these. */
Grid facets(const double inner, const double outer, const unsigned int n, const unsigned int layers)
{
  return {{{1, n, layers}},
          [=](const Point<3> &x)
          {
            const double turn = 8 * x[1], r = inner + (outer - inner) * x[0];
            const unsigned int k = std::min(turn, 7.);
            const auto corner = [](const unsigned int j)
            { return Point<3>(std::cos(pi * j / 8), std::sin(pi * j / 8), 0); };
            const Tensor<1, 3> place =
                r * ((k + 1 - turn) * corner(k) + (turn - k) * Tensor<1, 3>(corner(k + 1)));
            return Point<3>(place[0], place[1], 0.5 * x[2]);
          }};
}

/** Half of a pin `one` in half of a hole `other`, both of 16 facets a turn; one facet has two cells of the hole. */
Scene<3> facetted_pin(const Overrides &entries)
{
  return two_bodies(facets(0.5, 1, 8, 1), facets(1, 2, 16, 2), {"right", "left"},
                    Overrides{{"Boundary one.left/Displacement", "0.02; 0; 0"},
                              {"Boundary other.right/Displacement", "0; 0; 0"},
                              {"Material/Young's modulus", "20"},
                              {"Material/Poisson's ratio", "0.3"},
                              {"Adaptivity/Method", "hup2"},
                              {"Adaptivity/Maximum steps", "1"}} +
                        entries);
}

/** A pair along several planes passes a uniform pressure on all of them. */
TEST(FacettedPairs, PassAUniformPressure)
{
  for (const auto &[slave, degree] :
       {std::pair("one.right", 2U), {"other.left", 2U}, {"one.right", 3U}})
  {
    Scene<3> scene = facetted_pin({{"Contact joint/Slave", slave}});
    scene.adaptivity.start_degree = degree;
    scene.solver.primal_tolerance = 1e-13;
    prescribe_around(scene, shrinking);
    const double pressure = 0.01 * 20 / (1 - 2 * 0.3);
    steps_of<3>(scene,
                [&](const StepReport<3> &step)
                {
                  std::set<long> reached;
                  for (const ContactPoint<3> &point : step.contact.at(0).points)
                  {
                    EXPECT_NEAR(point.normal_traction, -pressure, 1e-11 * pressure);
                    reached.insert(std::lround(8 * std::atan2(point.x[1], point.x[0]) / pi - 0.5));
                  }
                  EXPECT_EQ(reached.size(), 8);
                  EXPECT_LT(largest_error(step, shrinking), 1e-11);
                });
  }
}

/** A pin pushed to one side of a hole: both balance, and either may be the slave. */
TEST(FacettedPairs, PushAPinIntoAHole)
{
  std::vector<std::array<double, 2>> forces; // by mesh, on the pin
  for (const unsigned int slave : {0U, 1U})
  {
    Overrides entries{{"Contact joint/Gap", "0.001"},
                      {"Contact joint/Friction coefficient", "0.2"},
                      {"Contact joint/Slave", slave == 0 ? "one.right" : "other.left"},
                      {"Adaptivity/Maximum steps", "2"}};
    for (const char *const body : {"one", "other"})
      for (const char *const side : {"bottom", "top", "front", "back"})
        entries.emplace_back("Boundary " + std::string(body) + "." + side + "/Symmetry", "true");
    unsigned int k = 0;
    steps_of<3>(facetted_pin(entries),
                [&](const StepReport<3> &step)
                {
                  forces.resize(2);
                  forces[k++][slave] = force_on(step, "one.right", 0);
                  expect_balance(step, "one.right", "other.left", 0.1);
                  for (const ContactPoint<3> &point : step.contact.at(0).points)
                    EXPECT_LE(point.normal_traction, 1e-12);
                });
  }
  const auto apart = [](const std::array<double, 2> &both)
  { return std::abs(both[1] / both[0] - 1); };
  EXPECT_LT(forces[0][0], 0);
  EXPECT_LT(apart(forces[0]), 0.02);
  EXPECT_LT(apart(forces[1]), 0.6 * apart(forces[0]));
}

/** Friction's work in J counts the slip since the load step before, in plane pairs as well. */
TEST(FlatPairs, CountSlipInTheEnergy)
{
  const auto block = [](const unsigned int n, const double low) {
    return Grid{{{n, 1, n}}, [=](const Point<3> &x) { return Point<3>(x[0], x[1] + low, x[2]); }};
  };
  const Scene<3> scene =
      two_bodies(block(2, 0), block(3, -1), {"bottom", "top"},
                 {{"Material/Young's modulus", "200"},
                  {"Material/Poisson's ratio", "0.3"},
                  {"Contact joint/Friction bound", "0.2"},
                  {"Boundary one.top/Displacement", "(t < 0.5 ? 0.3 : 0.1); -0.01; 0"},
                  {"Boundary other.bottom/Displacement", "0; 0; 0"},
                  {"Adaptivity/Maximum steps", "1"},
                  {"Loading/Steps", "3"}});
  unsigned int n = 0;
  LoadHistory<3>(scene).run(
      [&](const StepReport<3> &step)
      {
        ++n;
        EXPECT_GE(step.energies.slack, -1e-10);
        EXPECT_LT(step.energies.slack, 1e-2 * 0.2 * 0.2)
            << n; // of what friction does in a load step
      });
  EXPECT_EQ(n, 3U);
}

/** Where two planes of one side meet the other one has an edge, too, or the pair is refused. */
TEST(FacettedPairs, HaveTheSameEdges)
{
  const auto block = [](const unsigned int n, const double low, const double high)
  {
    return Grid{{{n, 1, 1}},
                [=](const Point<3> &x)
                {
                  const double ridge = 1 - 0.1 * std::abs(2 * x[0] - 1);
                  return Point<3>(x[0], low * (1 - x[1]) + high * x[1] + (n == 1 ? 0 : ridge),
                                  x[2]);
                }};
  };
  const Overrides held{{"Boundary one.top/Displacement", "0; 0; 0"},
                       {"Boundary other.bottom/Displacement", "0; 0; 0"}};
  EXPECT_NO_THROW(two_bodies(block(2, 0, 1), block(2, -1, 0), {"bottom", "top"}, held));
  const std::string line = ::failure_of<InputError>(
      [&] {
        two_bodies(block(1, 1, 2), block(2, -1, 0), {"bottom", "top"}, held);
      });
  EXPECT_NE(line.find("one has a step or an edge opposite to a face of the other"),
            std::string::npos)
      << line;
}

/** A quarter of a block above the plane y = 0 whose lower side is a sphere of radius 10; @p is_below: what lies below, mirrored. */
Grid cap(const unsigned int n, const bool is_below)
{
  constexpr double radius = 10, width = 3, height = 3;
  return {{{n, 2, n}},
          [=](const Point<3> &unit)
          {
            const double x = width * unit[0], z = width * unit[2],
                         sphere = radius - std::sqrt(radius * radius - x * x - z * z),
                         s = is_below ? 1 - unit[1] : unit[1];
            return Point<3>(x, (is_below ? -1 : 1) * (sphere * (1 - s) + height * s), z);
          },
          true,
          Grid::everywhere,
          27};
}

/** Graded towards the point where both touch. */
Overrides pressed(const std::string &body, const std::string &far, const std::string &displacement)
{
  return {{"Boundary " + body + "left/Symmetry", "true"},
          {"Boundary " + body + "front/Symmetry", "true"},
          {"Boundary " + body + far + "/Displacement", displacement}};
}

struct Pressed
{
  double force = 0;
};

Pressed pressed_by(Scene<3> scene, const std::string &top)
{
  scene.adaptivity.maximum_steps = 1;
  scene.solver.primal_tolerance = 1e-11;
  grade(scene, Point<3>(), 3);
  Pressed result;
  steps_of<3>(scene,
              [&](const StepReport<3> &step)
              {
                result.force = force_on(step, top, 1);
                EXPECT_LT(step.equilibrium.force_imbalance, 1e-8);
                EXPECT_LT(step.equilibrium.moment_imbalance, 1e-8);
              });
  return result;
}

/** Which moves little along the contact: that has no jump between equal spheres, but acts along normals that are not those of the plane. */
const Overrides rubber{{"Material/Young's modulus", "2000"}, {"Material/Poisson's ratio", "0.49"}};

/**
 * The same body below as above is a rigid plane between both, at half of their distance; and a stiff block below is that plane. Forces
 * differ by what moves along the contact, 2e-3, which falls with the load.
 */
TEST(CurvedPairs, PressSpheresOnEachOther)
{
  const Overrides down = rubber + pressed("one.", "top", "0; -0.005; 0");
  const auto on_plane = [](const std::string &gap)
  {
    return pressed_by(scene_of(cap(4, false), "curved-cap",
                               rubber + pressed("", "top", "0; -0.005; 0") +
                                   Overrides{{"Boundary bottom/Contact", "unilateral"},
                                             {"Boundary bottom/Gap", gap}}),
                      "top");
  };
  const double rigid = on_plane("5*(2*(1 - y/10) - sqrt(4*(1 - y/10)^2 - 3) - 1)").force;
  for (const char *const slave : {"one.bottom", "other.top"})
  {
    const Pressed both = pressed_by(two_bodies(cap(4, false), cap(4, true), {"bottom", "top"},
                                               down + pressed("other.", "bottom", "0; 0.005; 0") +
                                                   Overrides{{"Contact joint/Slave", slave}}),
                                    "one.top");
    EXPECT_NEAR(both.force / rigid, 1, 2.5e-3) << slave;
  }
  const Pressed stiff = pressed_by(
      two_bodies(cap(4, false),
                 {{{3, 1, 3}},
                  [](const Point<3> &x) { return Point<3>(4 * x[0], 2 * x[1] - 2, 4 * x[2]); }},
                 {"bottom", "top"},
                 down + pressed("other.", "bottom", "0; 0; 0") +
                     Overrides{{"Body other/Material", "steel"},
                               {"Material steel/Young's modulus", "2e9"},
                               {"Material steel/Poisson's ratio", "0.3"}}),
      "one.top");
  EXPECT_NEAR(stiff.force / on_plane("y*10/(10 - y)").force, 1, 1e-4);
}
} // namespace
