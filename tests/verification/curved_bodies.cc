// SPDX-License-Identifier: LGPL-2.1-or-later
// Bodies that touch along curves: what lies opposite, rings in rings, discs on blocks, slip that is carried from load to load.
#include "discretisation.h"
#include "mesh_texts.h"

#include <hpvi/driver/load_history.h>
#include <hpvi/plane/mesh.h>
#include <hpvi/plane/multiplier_trace.h>
#include <hpvi/reader/shapes/ring_sector.h>
#include <hpvi/reader/shapes/shape.h>
#include <hpvi/results/contact_residuals.h>
#include <hpvi/scene/boundary_parts.h>
#include <hpvi/scene/edge_projection.h>
#include <hpvi/scene/side_normals.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <random>
#include <tuple>

namespace
{
using namespace verification;

// ---------------------------------------------------------------- rings in rings

/** A ring from 1 to 1.5 in one from 1.5 to 2, with seven arcs on five. */
Overrides rings(const Overrides &others)
{
  return with({given::ring("Body in", "1, 1.5", "0, 360", "1, 7"),
               given::ring("Body out", "1.5, 2", "0, 360", "1, 5"),
               {"Body out/Material", "hard"},
               given::elastic("10", "0.3"),
               given::elastic("30", "0.2", "hard"),
               {"Contact fit/Between", "in.outer, out.inner"},
               given::steps("pu", "1", "10")},
              others);
}

/** Quarters between planes of symmetry, with 2 cells on 3. */
Overrides quarters(const Overrides &others)
{
  Overrides entries = rings({{"Body in/Angles", "0, 90"},
                             {"Body in/Subdivisions", "1, 2"},
                             {"Body out/Angles", "0, 90"},
                             {"Body out/Subdivisions", "1, 3"}});
  for (const char *const side : {"in.start", "in.end", "out.start", "out.end"})
    entries.emplace_back("Boundary " + std::string(side) + "/Symmetry", "true");
  return with(entries, others);
}

struct Lame
{
  double mu, lambda;
  Lame(const double E, const double nu)
      : mu(E / (2 * (1 + nu))), lambda(E * nu / ((1 + nu) * (1 - 2 * nu)))
  {
  }
};

/** u_r = A r + B/r in both: the pressure between them under @p inside, @p gap wide before. */
double fit_pressure(const double inside, const double gap)
{
  const Lame a(10, 0.3), b(30, 0.2);
  const auto s = [](const Lame &m, const double r) {
    return std::array<double, 2>{{2 * (m.lambda + m.mu), -2 * m.mu / (r * r)}};
  };
  LAPACKFullMatrix<double> M(4, 4);
  Vector<double> x(4);
  for (const unsigned int k : {0, 1})
  {
    M(0, k) = s(a, 1)[k];
    M(1, k) = s(a, 1.5)[k];
    M(1, 2 + k) = -s(b, 1.5)[k];
    M(2, 2 + k) = s(b, 2)[k];
  }
  M(3, 0) = 1.5;
  M(3, 1) = 1 / 1.5;
  M(3, 2) = -1.5;
  M(3, 3) = -1 / 1.5;
  x[0] = -inside;
  x[3] = gap;
  M.compute_lu_factorization();
  M.solve(x);
  return -(s(a, 1.5)[0] * x[0] + s(a, 1.5)[1] * x[1]);
}

/** The only step of a scene. */
void solved(const Overrides &entries, const std::function<void(const StepReport<2> &)> &look)
{
  AdaptiveSolver<2>(scene_of(with(entries, {{"Error/Bound", "false"}}))).run(look);
}

/** Bodies that are moved towards each other by `distance`, and touch where that is 1. */
struct Approach
{
  std::string name;
  Overrides entries;
  std::string moved; ///< the entry that moves one
};

std::vector<Approach> approaches()
{
  const Overrides roller = {given::ring("Body a", "1, 10", "180, 360", "2, 4"),
                            {"Body a/Centre", "0, 30"}},
                  box = {{"Body b/Lower corner", "-20, 0"},
                         {"Body b/Upper corner", "20, 19"},
                         {"Boundary b.bottom/Displacement", "0; 0"},
                         {"Contact c/Between", "a.outer, b.top"}},
                  wedge = {given::quadrilateral("Body a", "-5, 21; 5, 20; 5, 30; -5, 30", "3, 2"),
                           {"Contact c/Between", "a.bottom, b.top"}},
                  bore = {{"Body a/Angles", "0, 360"},
                          {"Body a/Centre", "0, 0"},
                          {"Body a/Subdivisions", "1, 8"},
                          given::ring("Body b", "11, 15", "0, 360", "1, 9"),
                          {"Boundary b.outer/Displacement", "0; 0"},
                          {"Contact c/Between", "a.outer, b.inner"}};
  const std::string inner = "Boundary a.inner/Displacement";
  return {
      {"roller", with(roller, box), inner},
      {"steel", with(with(roller, box), {{"Material/Young's modulus", "210000"}}), inner},
      {"friction", with(with(roller, box), {{"Contact c/Friction coefficient", "0.3"}}), inner},
      {"fine",
       with(with(roller, box), {{"Body a/Subdivisions", "4, 8"}, {"Body b/Subdivisions", "6, 3"}}),
       inner},
      {"degree 6", with(with(roller, box), {{"Adaptivity/Start degree", "6"}}), inner},
      {"sphere",
       with(with(roller, box), {{"Body a/Angles", "270, 360"},
                                {"Body a/Subdivisions", "2, 3"},
                                {"Body b/Lower corner", "0, 0"},
                                {"Material/Plane", "axisymmetric"}}),
       inner},
      {"bore", with(roller, bore), inner},
      {"wedge", with(box, wedge), "Boundary a.top/Displacement"}};
}

/**
 * A body that is only moved is no problem to refine for, and none that others take an error from. Where a coarse mesh cannot tell that it does
 * not touch, because a hundredth of the distance is left, that takes another step or two.
 */
TEST(CurvedBodies, AreMovedBeforeTheyTouch)
{
  for (const Approach &approach : approaches())
    for (const std::string distance : {"0.1", "0.99"})
    {
      const std::string name = approach.name + ' ' + distance;
      const unsigned int most = name == "sphere 0.99" ? 3 : 1;
      std::string stopped_by;
      solved(with(approach.entries, {{approach.moved, "0; -" + distance},
                                     {"Adaptivity/Maximum steps", in_digits(most)}}),
             [&](const StepReport<2> &step)
             {
               stopped_by = text(step.stopped_by);
               if (stopped_by != "round-off")
                 return;
               EXPECT_EQ(texts(step.warnings), std::vector<std::string>()) << name;
               EXPECT_EQ(step.solution().z.linfty_norm(), 0.) << name;
               const double moved = std::stod(distance);
               EXPECT_NEAR(step.field.largest_displacement(), moved, 1e-12 * moved) << name;
             });
      EXPECT_EQ(stopped_by, "round-off") << name;
    }
}

/** hpa3 up to p = 12 comes to the end of double precision, on curves, in pairs and of revolution, and ends there. */
TEST(CurvedBodies, EndWhereRoundOffRules)
{
  const Overrides hp = {given::steps("hpa3", "18", "3"),
                        {"Adaptivity/Maximum degree", "12"},
                        {"Adaptivity/hpa3 threshold", "0.2"},
                        {"Adaptivity/Tolerance", "0"}};
  const Overrides tube = {given::ring("Geometry", "1, 2", "0, 90", "1, 2"),
                          {"Boundary inner/Pressure", "1"},
                          {"Material/Poisson's ratio", "0.3"},
                          {"Boundary start/Symmetry", "true"}},
                  symmetric = {{"Boundary end/Symmetry", "true"}},
                  turned = {{"Material/Plane", "axisymmetric"}};
  const Scene<2> press_ring =
      shipped_scene("press-ring", with(hp, {{"Adaptivity/Maximum degree", "10"}})); // in less time
  for (const auto &[name, scene] :
       {std::make_pair("press-ring", press_ring),
        std::make_pair("tube", scene_of(with(with(tube, symmetric), hp))),
        std::make_pair("hollow sphere", scene_of(with(with(tube, turned), hp))),
        std::make_pair("quarters",
                       scene_of(with(quarters({{"Boundary in.inner/Pressure", "1"}}), hp))),
        std::make_pair("fit", scene_of(with(quarters({{"Contact fit/Gap", "-0.001"}}), hp)))})
  {
    std::string stopped_by;
    double relative = 0, seconds = 0;
    AdaptiveSolver<2>(scene).run(
        [&](const StepReport<2> &step)
        {
          stopped_by = text(step.stopped_by);
          relative = step.relative_estimate;
          seconds = step.seconds;
        });
    EXPECT_EQ(stopped_by, "round-off") << name;
    EXPECT_LT(relative, 1e-10) << name;
    EXPECT_LT(seconds, 20.) << name;
  }
}

/**
 * The third of three load steps presses as the static scene does, though the first two are exact; so it has no tolerance from them.
 */
TEST(CurvedBodies, PressAfterLoadStepsApart)
{
  for (const Approach &approach : approaches())
  {
    const Overrides limits = {
        {"Adaptivity/Maximum steps", "5"}, {"Adaptivity/Tolerance", "0"}, {"Error/Bound", "false"}};
    const auto push = [](const StepReport<2> &step) { return step.contact.at(0).normal_resultant; };
    if (approach.name == "fine" || approach.name == "steel") // for time; they are rollers
      continue;
    double exact = 0;
    std::vector<std::string> stopped_by;
    solved(with(with(approach.entries, limits), {{approach.moved, "0; -1.05"}}),
           [&](const StepReport<2> &step) { exact = push(step); });
    EXPECT_LT(exact, 0.) << approach.name;
    LoadHistory<2>(scene_of(with(with(approach.entries, limits),
                                 {{approach.moved, "0; -1.05*t"}, {"Loading/Steps", "3"}})))
        .run(
            [&](const StepReport<2> &step)
            {
              if (step.stopped_by.empty())
                return;
              stopped_by.push_back(text(step.stopped_by));
              if (step.load.number < 3)
                EXPECT_EQ(push(step), 0.) << approach.name;
              else
                EXPECT_NEAR(push(step), exact, 1e-9 * std::abs(exact)) << approach.name;
            });
    EXPECT_EQ(stopped_by, (std::vector<std::string>{"round-off", "round-off", "Maximum steps"}))
        << approach.name;
  }
}

/** Under a pressure inside, pressed into each other, and both; by any law that has a pressure, either side the slave. */
TEST(CurvedBodies, FitAsLameSays)
{
  struct Row
  {
    std::string law, slave;
    double inside, gap;
  };
  for (const Row &row :
       {Row{"unilateral", "in.outer", 1, 0}, Row{"unilateral", "out.inner", 1, 0},
        Row{"bilateral", "automatic", 1, 0}, Row{"tied", "automatic", 1, 0},
        Row{"unilateral", "automatic", 0, -0.01}, Row{"unilateral", "out.inner", 0.5, -0.005},
        Row{"unilateral", "automatic", 1, 0.01}})
  {
    Overrides entries = quarters({{"Contact fit/Law", row.law},
                                  {"Contact fit/Slave", row.slave},
                                  {"Boundary in.inner/Pressure", in_digits(row.inside)}});
    if (row.gap != 0)
      entries.emplace_back("Contact fit/Gap", in_digits(row.gap));
    solved(entries,
           [&](const StepReport<2> &step)
           {
             const double p = fit_pressure(row.inside, row.gap);
             ASSERT_GT(p, 0.01);
             for (const ContactPoint<2> &point : step.contact.at(0).points)
             {
               EXPECT_NEAR(-point.normal_traction, p, 2e-8) << row.law << " " << row.slave;
               EXPECT_NEAR(point.tangential_traction, 0, 2e-8);
             }
             EXPECT_NEAR(step.contact[0].area, 1.5 * numbers::PI / 2, 1e-10);
           });
  }
}

/** Rings of the same middle with a distance in the drawing: closed by a pressure, each with its own arc. */
TEST(CurvedBodies, CloseTheGapOfTheDrawing)
{
  for (const std::string slave : {"in.outer", "out.inner"})
    solved(quarters({{"Body out/Radii", "1.501, 2"},
                     {"Contact fit/Slave", slave},
                     {"Boundary in.inner/Pressure", "1"}}),
           [&](const StepReport<2> &step)
           {
             // To first order in the distance the fit of rings that touch, with this gap.
             EXPECT_NEAR(step.contact.at(0).points[0].normal_traction, -fit_pressure(1, 0.001),
                         1e-3);
             EXPECT_NEAR(step.contact[0].points[0].gap, 0, 1e-9);
             for (const ContactPoint<2> &point : step.contact[0].points)
               EXPECT_NEAR(point.normal_traction, step.contact[0].points[0].normal_traction, 1e-7);
           });
}

/** Quarters of both rings as surfaces of one mesh file, @p n cells along each arc, that share the curve between them. */
std::string file_of_rings(const unsigned int n)
{
  std::ostringstream nodes, lines, cells;
  unsigned int n_elements = 0;
  const auto node = [n](const unsigned int ring, const unsigned int k)
  { return ring * (n + 1) + k + 1; };
  const auto line = [&](const unsigned int group, const unsigned int a, const unsigned int b)
  { lines << ++n_elements << " 1 2 " << group << " " << group << " " << a << " " << b << "\n"; };
  for (const unsigned int ring : {0, 1, 2})
    for (unsigned int k = 0; k <= n; ++k)
    {
      const Point<2> x = Circle(Point<2>(), 1 + ring / 2.).point(k * numbers::PI / (2 * n));
      nodes << node(ring, k) << " " << in_digits(x[0]) << " " << in_digits(x[1]) << " 0\n";
      if (k < n)
        line(1 + ring, node(ring, k), node(ring, k + 1));
    }
  for (const unsigned int ring : {0, 1})
  {
    line(4, node(ring, 0), node(ring + 1, 0));
    line(5, node(ring, n), node(ring + 1, n));
    for (unsigned int k = 0; k < n; ++k)
      cells << ++n_elements << " 3 2 " << 6 + ring << " " << 6 + ring << " " << node(ring, k) << " "
            << node(ring + 1, k) << " " << node(ring + 1, k + 1) << " " << node(ring, k + 1)
            << "\n";
  }
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n7\n1 1 \"hole\"\n1 2 \"joint\"\n1 "
         "3 "
         "\"rim\"\n1 4 \"start\"\n1 5 \"end\"\n2 6 \"core\"\n2 7 "
         "\"shell\"\n$EndPhysicalNames\n$Nodes\n" +
         std::to_string(3 * (n + 1)) + "\n" + nodes.str() + "$EndNodes\n$Elements\n" +
         std::to_string(n_elements) + "\n" + lines.str() + cells.str() + "$EndElements\n";
}

/** A ring of each of two such files, or of one, whose edges follow curves of these kinds. */
Overrides rings_of_files(const std::string &inner, const std::string &outer,
                         const std::string &inner_curve, const std::string &outer_curve,
                         const std::string &law)
{
  Overrides entries{given::elastic("10", "0.3"),
                    {"Body out/Material", "hard"},
                    given::elastic("30", "0.2", "hard"),
                    {"Body in/File", inner},
                    {"Body in/Surfaces", "core"},
                    {"Body out/File", outer},
                    {"Body out/Surfaces", "shell"},
                    given::joint("fit", "in.joint, out.joint", law),
                    {"Boundary in.hole/Pressure", "1"},
                    {"Boundary in.hole/Curve", inner_curve},
                    {"Boundary in.joint/Curve", inner_curve},
                    {"Boundary out.joint/Curve", outer_curve},
                    {"Boundary out.rim/Curve", outer_curve},
                    given::steps("pu", "1", "8")};
  for (const std::string body : {"in", "out"})
  {
    entries.emplace_back("Body " + body + "/Shape", "file");
    for (const char *const side : {".start", ".end"})
      entries.emplace_back("Boundary " + body + side + "/Symmetry", "true");
  }
  return entries;
}

/** Surfaces of a drawing that share a circle, or a spline, touch along it. */
TEST(CurvedBodies, ShareACurveOfAMeshFile)
{
  const auto file = std::filesystem::path(::testing::TempDir()) / "hpvi-rings.msh";
  std::ofstream(file) << file_of_rings(4);
  for (const std::string curve : {"circle", "spline"})
    for (const std::string law : {"unilateral", "tied"})
      solved(rings_of_files(file.string(), file.string(), curve, curve, law),
             [&](const StepReport<2> &step)
             {
               for (const ContactPoint<2> &point : step.contact.at(0).points)
                 EXPECT_NEAR(-point.normal_traction / fit_pressure(1, 0), 1,
                             curve == "circle" ? 1e-7 : 1e-2)
                     << curve << " " << law;
             });
}

/** A polygon in a circle: u_0 has kinks inside the edges of the circle, where R (1 - cos a / cos t) begins again. */
TEST(CurvedBodies, CountTheGapOfAPolygon)
{
  const auto inner = std::filesystem::path(::testing::TempDir()) / "hpvi-polygon.msh",
             outer = std::filesystem::path(::testing::TempDir()) / "hpvi-circle.msh";
  std::ofstream(inner) << file_of_rings(4);
  std::ofstream(outer) << file_of_rings(3);
  const Scene<2> scene =
      scene_of(rings_of_files(inner.string(), outer.string(), "", "circle", "unilateral"));
  EXPECT_EQ(scene.pairs[0].slave, 1U);
  Triangulation<2> mesh;
  make_mesh(scene, mesh);
  const Degrees degrees(mesh.n_active_cells(), 10);
  set_edge_degrees(mesh, degrees);
  const Laboratory laboratory(scene, mesh, degrees);
  double sum = 0;
  for (const ContactMultiplier<2> &unknown : laboratory.contact_space.multipliers())
    sum += unknown.gap;
  const double a = numbers::PI / 16;
  EXPECT_NEAR(sum, 8 * 2.25 * (a - std::cos(a) * std::log(std::tan(numbers::PI / 4 + a / 2))),
              1e-9);
}

/** A polygon in a circle, glued: `Closed within` takes the sagitta of its edges for none. */
TEST(CurvedBodies, AreTiedToAPolygon)
{
  const auto file = std::filesystem::path(::testing::TempDir()) / "hpvi-rings-of-8.msh";
  std::ofstream(file) << file_of_rings(8);
  const Overrides entries = with(rings_of_files(file.string(), file.string(), "", "circle", "tied"),
                                 {{"Adaptivity/Start degree", "4"}});
  EXPECT_THROW(scene_of(entries), InputError);
  const double sagitta = 1.5 * (1 - std::cos(numbers::PI / 32)); // 0.0072
  EXPECT_THROW(scene_of(with(entries, {{"Contact fit/Closed within", in_digits(0.9 * sagitta)}})),
               InputError);
  double mean = 0;
  solved(with(entries, {{"Contact fit/Closed within", in_digits(1.01 * sagitta)}}),
         [&](const StepReport<2> &step)
         { mean = -step.contact.at(0).normal_resultant / step.contact[0].area; });
  EXPECT_NEAR(mean / fit_pressure(1, 0), 1, 0.02);
}

/** What one step has found starts the next, on another mesh and with the other side as slave. */
TEST(CurvedBodies, HandTractionsOn)
{
  const auto scene_with = [](const std::string &slave)
  {
    return scene_of(rings({{"Boundary in.inner/Pressure", "1+0.3*x+0.2*y"},
                           {"Boundary out.outer/Spring", "10; 10"},
                           {"Contact fit/Law", "tied"},
                           {"Contact fit/Slave", slave}}));
  };
  const Scene<2> one = scene_with("in.outer"), other = scene_with("out.inner");
  Triangulation<2> coarse, fine;
  make_mesh(one, coarse);
  make_mesh(other, fine);
  fine.refine_global(1);
  const Degrees high(coarse.n_active_cells(), 8), low(fine.n_active_cells(), 7);
  set_edge_degrees(coarse, high);
  set_edge_degrees(fine, low);
  const Laboratory from(one, coarse, high), to(other, fine, low);
  const Vector<double> handed =
      MultiplierTrace<2>(from.contact_space, from.solve().z).values(to.contact_space, to.tables);
  const Vector<double> found = to.solve().z;
  for (unsigned int i = 0; i < found.size(); ++i)
    EXPECT_NEAR(handed[i], found[i], 2e-3 * found.linfty_norm())
        << to.contact_space.multipliers()[i].x;
}

/** Rings that turn: what friction or glue carries around, u_t = C r + D/r, and what slips. */
TEST(CurvedBodies, TurnEachOther)
{
  const Lame a(10, 0.3), b(30, 0.2);
  // T r^2 = K: u_t = K/(2 mu) (...) from the inside, turned by U, to the outside, held.
  const double U = 0.02, per_moment = (1 - 1 / 2.25) / (2 * a.mu) + (1 / 2.25 - 0.25) / (2 * b.mu),
               K = U / per_moment;
  for (const auto &[law, entry, value] :
       std::vector<std::tuple<std::string, std::string, std::string>>{
           {"tied", "", ""},
           {"bilateral", "Friction bound", "10"},
           {"bilateral", "Friction bound", "0.01"},
           {"tangential", "Friction bound", "0.01"},
           {"unilateral", "Friction coefficient", "0.1"},
           {"unilateral", "", ""}})
  {
    Overrides entries = rings({{"Contact fit/Law", law},
                               {"Boundary in.inner/Displacement", "0.01*x-0.02*y; 0.01*y+0.02*x"},
                               {"Boundary out.outer/Displacement", "0; 0"}});
    if (!entry.empty())
      entries.emplace_back("Contact fit/" + entry, value);
    solved(entries,
           [&, law = law, entry = entry, value = value](const StepReport<2> &step)
           {
             const ContactState<2> &fit = step.contact.at(0);
             const double p = -fit.normal_resultant / (3 * numbers::PI),
                          bound = value == "10" || law == "tied" ? 100
                                  : value == "0.1"               ? 0.1 * p
                                  : entry.empty()                ? 0
                                                                 : 0.01,
                          traction = std::min(K / 2.25, bound);
             for (const ContactPoint<2> &point : fit.points)
             {
               EXPECT_NEAR(point.tangential_traction, -traction, 1e-8) << law << " " << value;
               if (law != "tangential")
               {
                 EXPECT_NEAR(point.normal_traction, -p, 1e-6) << law;
               }
               EXPECT_NEAR(point.tangential_jump, 1.5 * (U - traction * 2.25 * per_moment), 1e-8)
                   << law << " " << value;
             }
             EXPECT_LT(step.equilibrium.force_imbalance, 1e-10);
             EXPECT_LT(step.equilibrium.moment_imbalance, 1e-10);
           });
  }
}

/** Of meshes with hanging nodes and any degrees on both sides the pressure is uniform as far as their arcs are circles. */
TEST(CurvedBodies, PressUniformlyThroughAnyMeshes)
{
  const Scene<2> scene = scene_of(rings({{"Boundary in.inner/Pressure", "1"},
                                         {"Boundary out.outer/Spring", "1; 1"},
                                         {"Contact fit/Friction bound", "0.1"}}));
  for (const unsigned int seed : {1, 2, 3})
  {
    const RandomMesh mesh(scene, seed, 1, 7, 10);
    for (const auto &cell : mesh.mesh.active_cell_iterators())
      cell->set_material_id(body_of<2>(scene.geometry, cell));
    const Laboratory laboratory(scene, mesh);
    const Solution<2> solution = laboratory.solve();
    const auto states = contact_states(SolutionField<2>(solution));
    const double p = -states.at(0).normal_resultant / (3 * numbers::PI);
    for (const ContactPoint<2> &point : states[0].points)
    {
      EXPECT_NEAR(point.normal_traction, -p, 2e-6) << seed;
      EXPECT_NEAR(point.tangential_traction, 0, 2e-6);
    }
    EXPECT_LT(norms(estimate_error(SolutionField<2>(solution)), MPI_COMM_SELF).total, 1e-4);
  }
}

/** A ring that nothing but the other one holds, without friction: it may turn, and no angle of it is better than another. */
TEST(CurvedBodies, LetRingsTurnInRings)
{
  for (const unsigned int degree : {3, 4, 6})
    solved(rings({{"Boundary in.inner/Pressure", "1"},
                  {"Boundary out.outer/Displacement", "0; 0"},
                  {"Adaptivity/Start degree", in_digits(degree)}}),
           [&](const StepReport<2> &step)
           {
             EXPECT_LT(step.energies.norm, 2);
             double turn = 0;
             for (const ContactPoint<2> &point : step.contact.at(0).points)
               turn = std::max(turn, std::abs(point.tangential_jump));
             EXPECT_LT(turn, 0.02) << degree;
           });
}

/** Turned in two load steps: the second counts slip from the first, whichever side has the multipliers. */
TEST(CurvedBodies, CountSlipFromThePast)
{
  for (const std::string slave : {"in.outer", "out.inner"})
  {
    const Scene<2> scene = scene_of(rings({{"Boundary in.inner/Displacement", "-0.1*t*y; 0.1*t*x"},
                                           {"Boundary out.outer/Displacement", "0; 0"},
                                           {"Contact fit/Law", "bilateral"},
                                           {"Contact fit/Slave", slave},
                                           {"Contact fit/Friction bound", "0.05"},
                                           {"Loading/Steps", "3"}}));
    LoadHistory<2>(scene).run(
        [&](const StepReport<2> &step)
        {
          if (step.load.number > 1)
            for (const ContactPoint<2> &point : step.contact.at(0).points)
            {
              EXPECT_NEAR(point.slip, 1.5 * 0.1 / 3, 1e-8) << slave;
              EXPECT_NEAR(point.tangential_traction, -0.05, 1e-8);
            }
        });
  }
}

// ---------------------------------------------------------------- bodies of revolution

/** A sleeve from 1 to 1.5 pulled along the axis in one from 1.5 to 2, nu = 0: s_rz = K/r, u_z = W + K/mu ln r up to the joint. */
TEST(CurvedBodies, PullASleeveInASleeve)
{
  const double way = std::log(1.5) / 5 + std::log(2 / 1.5) / 15, // by K, mu = 5 and 15
      p = 0.01 / (1.5 / 10 * (1 + 2.25) / 1.25 + 1.5 / 30 * (4 + 2.25) / 1.75);
  for (const auto &[law, W, steps] : std::vector<std::tuple<std::string, double, unsigned int>>{
           {"stick", 0.0005, 0}, {"slip", 0.01, 0}, {"slip", 0.01, 2}})
  {
    const double K = law == "stick" ? -W / way : -0.3 * p * 1.5, slip = W + K * way;
    ASSERT_LE(std::abs(K), 0.3 * p * 1.5 + 1e-15);
    Overrides entries{
        given::block("in", "1, 0", "1.5, 1", "1, 2"),
        given::block("out", "1.5, 0", "2, 1", "1, 3"),
        {"Body out/Material", "hard"},
        given::elastic("10", "0"),
        {"Material/Plane", "axisymmetric"},
        {"Material hard/Young's modulus", "30"},
        {"Contact fit/Between", "in.right, out.left"},
        {"Contact fit/Gap", "-0.01"},
        {"Contact fit/Friction coefficient", "0.3"},
        {"Boundary in.left/Displacement", "free; " + in_digits(W) + (steps ? "*t" : "")},
        {"Boundary out.right/Displacement", "free; 0"},
        given::steps("pu", "1", "10")};
    for (const std::string body : {"in", "out"})
    {
      entries.emplace_back("Boundary " + body + ".top/Traction", in_digits(K) + "/x; 0");
      entries.emplace_back("Boundary " + body + ".bottom/Traction", in_digits(-K) + "/x; 0");
    }
    if (steps > 0)
      entries.emplace_back("Loading/Steps", in_digits(steps));
    const auto look = [&, W = W, steps = steps](const StepReport<2> &step)
    {
      const bool is_last = steps == 0 || step.load.number == steps;
      for (const ContactPoint<2> &point : step.contact.at(0).points)
      {
        EXPECT_NEAR(point.normal_traction, -p, 1e-7);
        // Along t, which points upwards: friction acts on the sleeve against its way.
        EXPECT_NEAR(point.tangential_traction, K / 1.5, 1e-7);
        if (is_last)
        {
          EXPECT_NEAR(point.tangential_jump, slip, 1e-8);
          EXPECT_NEAR(point.slip, steps ? W / steps : slip, 1e-8);
        }
      }
      EXPECT_NEAR(step.contact[0].normal_resultant, -p * 3 * numbers::PI, 1e-7);
      EXPECT_LT(step.equilibrium.force_imbalance, 1e-10);
    };
    const Scene<2> scene = scene_of(entries);
    if (steps > 0)
      LoadHistory<2>(scene).run(look);
    else
      AdaptiveSolver<2>(scene).run(look);
  }
}

// ---------------------------------------------------------------- what lies opposite

/** A normal of the slave meets what X says, all along, for circles inside each other and a line below one. */
TEST(CurvedBodies, SeeWhatLiesOpposite)
{
  const auto circle =
      [](const Point<2> &centre, const double radius, const double from, const double to)
  {
    const auto curve = std::make_shared<const Circle>(centre, radius);
    return EdgePath{{{curve->point(from), curve->point(to)}}, {curve, from, to}};
  };
  const double pi = numbers::PI;
  // From a circle of radius 1 around 0 to the inside of one of radius 3 around (0, 0.5), which runs clockwise.
  const EdgePath own = circle({0, 0}, 1, 0.2, 1.2), other = circle({0, 0.5}, 3, pi, 0);
  for (unsigned int k = 0; k <= 10; ++k)
  {
    const double s = k / 10.;
    const auto place = place_opposite(other, own.point(s), own.normal(s));
    ASSERT_TRUE(place);
    EXPECT_LT((own.point(s) + place->distance * own.normal(s)).distance(other.point(place->s)),
              1e-14);
    const double y = own.normal(s)[1]; // |d n - (0, 0.5 - ...)| = 3
    EXPECT_NEAR(place->distance, 0.5 * y + std::sqrt(9 - 0.25 * (1 - y * y)) - 1, 1e-14);
    const auto near = place_opposite(other, own.point(s), own.normal(s), 0.5);
    ASSERT_TRUE(near);
    EXPECT_NEAR(near->s, place->s, 1e-13);
  }
  // The other half of the outer circle looks the same way and is not opposite.
  EXPECT_FALSE(place_opposite(circle({0, 0.5}, 3, 2 * pi, pi), own.point(0.5), own.normal(0.5)));
  // A line below a disc, up to where normals meet it at 60 degrees.
  const EdgePath line{{{Point<2>(10, 0), Point<2>(-10, 0)}}};
  for (const double degrees : {0., 30., 59., 61.})
  {
    const double angle = degrees * pi / 180;
    const auto place = place_opposite(line, Point<2>(std::sin(angle), 1 - std::cos(angle)),
                                      Tensor<1, 2>({std::sin(angle), -std::cos(angle)}));
    ASSERT_EQ(bool(place), degrees < 60);
    if (place)
    {
      EXPECT_NEAR(place->distance, 1 / std::cos(angle) - 1, 1e-14);
    }
  }
}

/** Which edges of a disc and a block make the pair, and which of them has the multipliers. */
TEST(CurvedBodies, TakeTheEdgesThatFaceEachOther)
{
  const auto disc_on =
      [](const std::string &left, const std::string &right, const Overrides &others)
  {
    return scene_of(with({given::half_disc("Body disc", "0, 1", "1", "180"),
                          given::block("block", left + ", -1", right + ", 0", "8, 2"),
                          {"Contact line/Between", "disc.arc, block.top"},
                          {"Boundary block.bottom/Displacement", "0; 0"},
                          {"Boundary disc.flat/Displacement", "0; -0.01"}},
                         others));
  };
  const auto lengths = [](const Scene<2> &scene)
  {
    std::array<double, 2> result{{0, 0}};
    const std::vector<Side<2>> sides = sides_of(scene);
    for (const unsigned int k : {0, 1})
      for (unsigned int piece = 0; piece < sides[scene.pairs[0].parts[k]].pieces.size(); ++piece)
        for (unsigned int i = 0; i < 64; ++i)
        {
          const Side<2> &side = sides[scene.pairs[0].parts[k]];
          result[k] += side.point(piece, i / 64.).distance(side.point(piece, (i + 1) / 64.));
        }
    return result;
  };
  // The two lower arcs of 45 degrees see |x| < 1, all that is on the block below; its edges see all of the arc to 60 degrees.
  const Scene<2> wide = disc_on("-2", "2", {});
  EXPECT_EQ(wide.pairs[0].slave, 0U);
  EXPECT_NEAR(lengths(wide)[0], numbers::PI / 2, 1e-3);
  EXPECT_NEAR(lengths(wide)[1], 2, 1e-9);
  const Scene<2> reversed = disc_on("-2", "2", {{"Contact line/Between", "block.top, disc.arc"}});
  EXPECT_EQ(reversed.pairs[0].slave, 0U);
  EXPECT_NEAR(lengths(reversed)[0], 1,
              1e-9); // edges of 0.5, those from 0.5 to 1 end beyond 60 degrees
  // A narrow block ends opposite to both arcs: they hang over, and it is the slave.
  const Scene<2> narrow = disc_on("-0.4", "0.4", {});
  EXPECT_EQ(narrow.pairs[0].slave, 1U);
  EXPECT_NEAR(lengths(narrow)[1], 0.8, 1e-9);
  EXPECT_THROW(disc_on("-0.4", "0.4", {{"Contact line/Slave", "disc.arc"}}), InputError);
  // So is one that ends opposite to one of them, although the other one could be in the pair.
  EXPECT_EQ(disc_on("-2", "0.4", {}).pairs[0].slave, 1U);
  // Rings lie opposite to each other from either side.
  const Scene<2> ring = scene_of(rings({{"Boundary out.outer/Displacement", "0; 0"}}));
  EXPECT_FALSE(ring.pairs[0].slave);
  EXPECT_EQ(ring.boundaries[ring.pairs[0].parts[0]].name, "in.outer");
  EXPECT_FALSE(ring.boundaries[ring.pairs[0].parts[0]].gap);
}

/** Of a side with gaps, arcs and edges of any length, what is found in a tree of its edges is what all of them say. */
TEST(CurvedBodies, FindEdgesAsIfTheyLookedAtAll)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-1, 1);
  for (unsigned int n : {1, 2, 7, 40, 300})
  {
    std::vector<EdgePath> edges;
    Side<2> side;
    std::vector<Point<2>> points{{0, 0}}; // as far from all edges of half of the sides
    for (unsigned int k = 0; k < n; ++k)
    {
      const double step = 2 * numbers::PI / n, from = k * step,
                   to = from + (n % 2 == 0 ? 1 : 0.5 + 0.5 * any(random)) * step;
      const auto circle =
          std::make_shared<const Circle>(Point<2>(0, 0), 1 + (n % 2) * 0.2 * any(random));
      edges.push_back({{{circle->point(from), circle->point(to)}}});
      if (n > 2 && (n % 2 == 0 || any(random) > 0))
        edges.back().curve = {circle, from, to};
      side.pieces.push_back({{edges.back().ends[0], edges.back().ends[1]}});
      side.curves.push_back(edges.back().curve);
      points.push_back(edges.back().ends[0]); // of two edges
      points.push_back(edges.back().point(0.5 + 0.5 * any(random)));
      points.push_back(Point<2>(2 * any(random), 2 * any(random)));
    }
    const ExactSide drawn(edges);
    const SideNormals<2> normals(side);
    for (const Point<2> &x : points)
    {
      std::vector<double> distances;
      for (const EdgePath &edge : edges)
        distances.push_back(edge.point(edge.nearest(x)).distance(x));
      const unsigned int nearest =
          std::min_element(distances.begin(), distances.end()) - distances.begin();
      EXPECT_EQ(drawn.nearest_edge(x), nearest) << n << " edges, " << x;
      EXPECT_EQ(normals(x), side.normal(x)) << n << " edges, " << x;
      const double angle = numbers::PI * any(random);
      const Tensor<1, 2> along({std::cos(angle), std::sin(angle)});
      std::optional<ExactSide::Place> first;
      for (unsigned int e = 0; e < n; ++e)
        if (const auto place = place_opposite(edges[e], x, along);
            place && (!first || std::abs(place->distance) < std::abs(first->place.distance)))
          first = ExactSide::Place{e, *place};
      const auto opposite = drawn.opposite(x, along);
      ASSERT_EQ(bool(opposite), bool(first)) << n << " edges, " << x;
      if (first)
      {
        EXPECT_EQ(opposite->edge, first->edge);
        EXPECT_EQ(opposite->place.distance, first->place.distance);
      }
    }
  }
}

/** So are faces in space: a roof of many slopes, whose normals alternate. */
TEST(CurvedBodies, FindFacesAsIfTheyLookedAtAll)
{
  Side<3> side;
  const unsigned int n = 12;
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
    {
      Side<3>::Piece piece;
      for (unsigned int v = 0; v < 4; ++v)
      {
        const unsigned int x = i + v % 2, y = j + v / 2;
        piece[v] = Point<3>(double(x) / n, double(y) / n, x % 2 * 0.03 + x * x * 0.004);
      }
      side.pieces.push_back(piece);
    }
  const SideNormals<3> normals(side);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(-0.2, 1.2);
  for (unsigned int k = 0; k < 300; ++k)
  {
    const Point<3> beside(any(random), any(random), any(random)),
        x = k % 3 == 0 ? side.pieces[k % side.pieces.size()][k % 4] : beside;
    EXPECT_EQ(normals(x), side.normal(x)) << x;
  }
}

/** A polygon has no normals at its corners: the other side is the slave, and two polygons make no pair. */
TEST(CurvedBodies, WantASmoothSlave)
{
  const auto ring =
      [](const double inner, const double outer, const unsigned int n, const bool curved)
  {
    CoarseMesh mesh = RingSector{{0, 0}, inner, outer, 0, 90, 1, n}.mesh();
    for (CoarseMesh::Edge &edge : mesh.edges)
      if (!curved)
        edge.curve = {};
    return geometry_of(Shape::ring_sector, mesh);
  };
  std::string problem;
  const ExactSide polygon(ring(1, 1.5, 3, false), 1), circle(ring(1.5, 2, 2, true), 0),
      coarse(ring(1.5, 2, 2, false), 0);
  const ProjectedEdges edges = edge_projection({{polygon, circle}}, std::nullopt, 4, problem);
  EXPECT_EQ(edges.slave, 1U);
  EXPECT_NEAR(edges.largest, 1.5 * (1 - std::cos(numbers::PI / 12)), 2e-3);
  EXPECT_GT(edges.least, -1e-12);
  EXPECT_TRUE(edge_projection({{polygon, circle}}, 0, 4, problem).is_empty());
  EXPECT_NE(problem.find("corner"), std::string::npos) << problem;
  EXPECT_TRUE(edge_projection({{polygon, coarse}}, std::nullopt, 4, problem).is_empty());
  EXPECT_NE(problem.find("corner"), std::string::npos) << problem;
}

/** A disc in a cup, turned as a whole, or seen in a mirror: the same energy, forces and displacements. */
TEST(CurvedBodies, AreTheSameInAnyFrame)
{
  const auto cup = [](const double degrees, const bool mirrored)
  {
    const double angle = degrees * numbers::PI / 180, c = std::cos(angle), s = std::sin(angle),
                 sign = mirrored ? -1 : 1;
    const auto place = [&](const double x, const double y, const std::string &between)
    { return in_digits(c * sign * x - s * y) + between + in_digits(s * sign * x + c * y); };
    const double from = mirrored ? 200 : 210;
    return Overrides{
        given::half_disc("Body disc", place(0, 1, ", "), "1", in_digits(180 + degrees)),
        given::ring("Body cup", "1.3, 2",
                    in_digits(from + degrees) + ", " + in_digits(from + 130 + degrees), "1, 5"),
        {"Body cup/Centre", place(0.1, 1.2, ", ")},
        {"Contact seat/Between", "disc.arc, cup.inner"},
        {"Contact seat/Friction coefficient", "0.2"},
        {"Boundary cup.outer/Displacement", "0; 0"},
        {"Boundary disc.flat/Displacement", place(0.03, -0.12, "; ")},
        given::steps("pu", "1", "6")};
  };
  std::vector<std::array<double, 3>> found;
  for (const auto &[degrees, mirrored] : std::vector<std::pair<double, bool>>{
           {0, false}, {37, false}, {-140, false}, {0, true}, {37, true}})
    solved(cup(degrees, mirrored),
           [&, mirrored = mirrored](const StepReport<2> &step)
           {
             const ContactState<2> &seat = step.contact.at(0);
             found.push_back({{step.energies.energy, seat.normal_resultant,
                               (mirrored ? -1 : 1) * seat.friction_resultant}});
           });
  ASSERT_LT(found[0][1], -0.01);
  for (const auto &one : found)
    for (const unsigned int k : {0, 1, 2})
      EXPECT_NEAR(one[k], found[0][k], 1e-9 * std::abs(found[0][1]));
}

/** Rows of the master by many points: what the rule of the operator leaves out is small beside the error. */
TEST(CurvedBodies, IntegrateAcrossBothCurves)
{
  const Scene<2> scene = scene_of({given::half_disc("Body disc", "0, 1", "1", "180"),
                                   given::ring("Body cup", "1.3, 2", "210, 330", "1, 5"),
                                   {"Body cup/Centre", "0.1, 1.2"},
                                   given::joint("seat", "disc.arc, cup.inner", "unilateral"),
                                   {"Contact seat/Friction bound", "0.1"},
                                   {"Boundary cup.outer/Displacement", "0; 0"},
                                   {"Boundary disc.flat/Displacement", "0; -0.1"}});
  for (const unsigned int degree : {3, 6, 10})
  {
    Triangulation<2> mesh;
    make_mesh(scene, mesh);
    const Degrees degrees(mesh.n_active_cells(), degree);
    set_edge_degrees(mesh, degrees);
    const Laboratory laboratory(scene, mesh, degrees);
    unsigned int n_segments = 0;
    for (const ContactOperator<2>::Rows &rows : laboratory.contact_operator.rows())
    {
      const ContactFace<2> &face = *rows.face;
      ASSERT_FALSE(face.segments.empty());
      const unsigned int n = rows.multipliers.size();
      unsigned int first = 0;
      for (const ContactSegment<2> &segment : face.segments)
      {
        ++n_segments;
        FullMatrix<double> block(n, 2 * (segment.degree + 1));
        const QGauss<1> gauss(60);
        const QGauss<1> at_gauss(n);
        const QGaussLobatto<1> on_edge(segment.degree + 1);
        std::vector<double> nodes, edge_nodes;
        for (const Point<1> &node : at_gauss.get_points())
          nodes.push_back(node[0]);
        for (const Point<1> &node : on_edge.get_points())
          edge_nodes.push_back(node[0]);
        for (unsigned int q = 0; q < gauss.size(); ++q)
        {
          const double s = segment.begin + (segment.end - segment.begin) * gauss.point(q)[0];
          const ContactFrame<2> frame = face.frame(s);
          const Tensor<1, 2> d =
              rows.kind == ContactOperator<2>::Kind::friction ? frame.tangent : frame.normal;
          const std::vector<double> psi = lagrange_basis(nodes, s),
                                    phi = lagrange_basis(edge_nodes, segment.opposite(s));
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int c = 0; c < 2; ++c)
              for (unsigned int j = 0; j <= segment.degree; ++j)
                block(i, c * (segment.degree + 1) + j) += (segment.end - segment.begin) *
                                                          gauss.weight(q) * frame.measure * psi[i] *
                                                          phi[j] * d[c];
        }
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int j = 0; j < block.n(); ++j)
            EXPECT_NEAR(rows.master(i, first + j), block(i, j), 1e-8 * block.linfty_norm())
                << degree;
        first += block.n();
      }
    }
    EXPECT_GT(n_segments, 2 * 4U);
  }
}
} // namespace
