// SPDX-License-Identifier: LGPL-2.1-or-later
// Bodies with curved edges: what their maps are, closed forms on rings and plates with holes, contact along arcs.
#include "discretisation.h"

#include <hpvi/driver/adaptive_solver.h>
#include <hpvi/plane/cell_map.h>
#include <hpvi/reader/gmsh/quadratic_edge.h>
#include <hpvi/reader/shapes/curve_fit.h>
#include <hpvi/reader/shapes/half_disc.h>
#include <hpvi/reader/shapes/mesh_from_file.h>
#include <hpvi/reader/shapes/plate_with_hole.h>
#include <hpvi/reader/shapes/ring_sector.h>
#include <hpvi/results/equilibrium.h>

#include <cmath>

namespace
{
using namespace verification;

Overrides ring(const Overrides &others)
{
  return with({{"Geometry/Shape", "ring sector"},
               {"Geometry/Radii", "1, 2"},
               {"Geometry/Subdivisions", "2, 4"},
               given::elastic("10", "0.3")},
              others);
}

double energy_of(const Laboratory &laboratory, const Solution<2> &solution)
{
  return 0.5 * internal_forces(laboratory.scene, solution.displacement_space, solution.tables,
                               solution.u)
                   .energy_product -
         laboratory.system.work(solution.u);
}

/** A mesh of one degree, its cells bisected some times. */
struct UniformMesh
{
  Triangulation<2> mesh;
  Degrees degrees;

  UniformMesh(const Scene<2> &scene, const unsigned int degree, const unsigned int bisections = 0)
  {
    make_mesh(scene, mesh);
    mesh.refine_global(bisections);
    degrees.assign(mesh.n_active_cells(), degree);
    set_edge_degrees(mesh, degrees);
  }
};

double relative_energy_error(const Scene<2> &scene, const Triangulation<2> &mesh,
                             const Degrees &degrees, const double J)
{
  const Laboratory laboratory(scene, mesh, degrees);
  return std::abs(energy_of(laboratory, laboratory.solve()) - J) / std::abs(J);
}

/** Lame's ring under pressure inside, a quarter: J = -p u_r(1) pi/4. */
TEST(Curves, MeetLamesRing)
{
  const Scene<2> scene =
      scene_of(ring({given::symmetric({"start", "end"}), {"Boundary inner/Pressure", "1"}}));
  const double u = 0.13 * (0.4 / 3 + 4. / 3), J = -u * numbers::PI / 4;
  // The square of what the energy norm of the error is on 4 x 2 cells, twice as much is a failure.
  for (const auto &[degree, limit] :
       std::vector<std::pair<unsigned int, double>>{{2, 2e-3}, {4, 5e-7}, {6, 1e-10}, {8, 2e-12}})
  {
    const UniformMesh mesh(scene, degree);
    EXPECT_LT(relative_energy_error(scene, mesh.mesh, mesh.degrees, J), limit) << degree;
  }
}

/** u = (-y, x) at all nodes. */
Vector<double> rotation_of(const DisplacementSpace<2> &space)
{
  Vector<double> u(space.n_dofs());
  for (const auto &cell : space.dof_handler().active_cell_iterators())
  {
    const CellMap<2> map = map_of<2>(cell);
    const auto dofs = space.cell_dofs(cell->active_cell_index());
    const auto &nodes = cell->get_fe().get_unit_support_points();
    for (unsigned int i = 0; i < dofs.size(); ++i)
    {
      const Point<2> x = map.point(nodes[i]);
      u[dofs[i]] = cell->get_fe().system_to_component_index(i).first == 0 ? -x[1] : x[0];
    }
  }
  return u;
}

/** Rigid motions are in the space whatever the degrees of cells and however they hang: they strain nothing. */
TEST(Curves, LetBodiesTurnFreely)
{
  for (const unsigned int seed : {1U, 2U, 3U, 4U})
  {
    const Scene<2> scene = scene_of(ring({{"Boundary start/Displacement", "-y; x"}}));
    const RandomMesh mesh(scene, seed, 2);
    const Laboratory laboratory(scene, mesh);
    const DisplacementSpace<2> &space = laboratory.displacement_space;
    Vector<double> u = rotation_of(space), conforming = u;
    laboratory.displacement_space.constraints().distribute(conforming);
    const double energy = internal_forces(scene, space, laboratory.tables, u).energy_product;
    EXPECT_LT(energy, 1e-24) << seed;
    conforming -= u; // hanging nodes and degrees allow it
    EXPECT_LT(conforming.linfty_norm(), 1e-13) << seed;
  }
}

/** Constant stress is exact on any mesh: loads, boundaries and stiffness agree. */
TEST(Curves, PassThePatchTest)
{
  const std::string ux = "0.01*x+0.02*y", uy = "-0.03*x+0.015*y";
  for (const unsigned int seed : {1U, 2U, 3U})
  {
    const Scene<2> scene = scene_of(ring({{"Boundary start/Displacement", ux + ";" + uy},
                                          {"Boundary end/Displacement", ux + ";" + uy},
                                          {"Boundary inner/Displacement", ux + ";" + uy},
                                          {"Boundary outer/Displacement", ux + ";" + uy}}));
    const RandomMesh mesh(scene, seed, 2);
    const Laboratory laboratory(scene, mesh);
    const Solution<2> solution = laboratory.solve();
    const SolutionField<2> field(solution);
    for (const Point<2> &x : {Point<2>(1.1, 0.3), Point<2>(0.9, 1.2), Point<2>(0.2, 1.9)})
    {
      const auto value = field.at(x);
      ASSERT_TRUE(value);
      EXPECT_NEAR(value->displacement[0], 0.01 * x[0] + 0.02 * x[1], 1e-13);
      EXPECT_NEAR(value->displacement[1], -0.03 * x[0] + 0.015 * x[1], 1e-13);
    }
  }
}

/** Bilateral contact along an arc leaves the rotation about its centre free, and nothing else: no spurious spring. */
TEST(Curves, LetRingsTurnInTheirRing)
{
  for (const unsigned int seed : {1U, 2U, 3U})
  {
    const Scene<2> scene = scene_of(ring({{"Geometry/Angles", "0, 360"},
                                          {"Geometry/Subdivisions", "2, 6"},
                                          given::rough("outer", "bilateral", "0.1")}));
    ASSERT_EQ(scene.free_motions().size(), 1U);
    EXPECT_LT(scene.free_motions()[0].at(Point<2>()).norm(), 1e-12);
    const RandomMesh mesh(scene, seed, 2, 3);
    const Laboratory laboratory(scene, mesh);
    Vector<double> u = rotation_of(laboratory.displacement_space), held = u;
    laboratory.displacement_space.constraints().distribute(held);
    held -= u;
    EXPECT_LT(held.linfty_norm(), 1e-13) << seed;
  }
}

/** A row of P7 of the notes on closed forms: two materials in a rigid ring, moved and turned at the inner circle. */
struct TwoRings
{
  std::string friction_entry, friction;
  double turn, K, slip; ///< U, r^2 s_rt, and how far the ring slips
};

/**
 * u_r = A r + B/r in each ring; K is what sticks, or what friction allows. The closed form is solved here for A, B of both:
 * u_r given inside, zero outside, and u_r and s_r the same where the rings meet.
 */
TEST(Curves, MeetTwoRingsInARigidOne)
{
  const double p = 0.1745418277;
  for (const TwoRings &row :
       {TwoRings{"Friction bound", "0.2", 0.02, -0.2759572266, 0},
        TwoRings{"Friction coefficient", "0.3", 0.04, -4 * 0.3 * p, 0.0496401945}})
  {
    const std::string U = in_digits(row.turn);
    const Scene<2> scene =
        scene_of({given::ring("Geometry", "1, 2", "0, 360", "2, 8"),
                  given::elastic("10", "0.3"),
                  {"Material hard/Young's modulus", "1000"},
                  {"Material hard/Where", "x^2+y^2-2.25"},
                  {"Boundary inner/Displacement", "0.01*x-" + U + "*y; 0.01*y+" + U + "*x"},
                  {"Boundary outer/Contact", "bilateral"},
                  {"Boundary outer/" + row.friction_entry, row.friction},
                  given::steps("pu", "1", "9")});
    AdaptiveSolver<2>(scene).run(
        [&](const StepReport<2> &step)
        {
          const ContactState<2> &outer = step.contact.at(0);
          EXPECT_NEAR(-outer.normal_resultant / (4 * numbers::PI), p, 1e-8) << row.friction_entry;
          EXPECT_NEAR(outer.friction_resultant / numbers::PI, row.K, 1e-8) << row.friction_entry;
          for (const ContactPoint<2> &point : outer.points)
          {
            EXPECT_NEAR(-point.normal_traction, p, 2e-6);
            EXPECT_NEAR(point.tangential_traction, row.K / 4, 2e-6);
            EXPECT_NEAR(point.tangential_displacement, row.slip, 1e-8);
          }
          ASSERT_EQ(outer.zones.size(), 1U);
          EXPECT_NEAR(outer.zones[0].length, 4 * numbers::PI, 1e-9);
          EXPECT_NEAR(outer.area, 4 * numbers::PI, 1e-9);
          EXPECT_LT(step.equilibrium.force_imbalance, 1e-11);
          EXPECT_LT(step.equilibrium.moment_imbalance, 1e-11);
          if (row.slip == 0)
          {
            EXPECT_NEAR(step.energies.energy, 0.026445253400, 1e-9);
          }
        });
  }
}

/** Kirsch's stresses around a hole in a plate under tension, given as tractions on the outside. */
TEST(Curves, MeetKirschsPlate)
{
  // s_x = 1 far away; r^2 = x^2 + y^2, cosines and sines of 2t and 4t as polynomials of x and y over r.
  const std::string r2 = "(x^2+y^2)", c2 = "((x^2-y^2)/" + r2 + ")", s2 = "(2*x*y/" + r2 + ")",
                    c4 = "(" + c2 + "^2-" + s2 + "^2)", s4 = "(2*" + c2 + "*" + s2 + ")",
                    a = "(1/" + r2 + ")", b = "(1.5/" + r2 + "^2)",
                    sx = "(1-" + a + "*(1.5*" + c2 + "+" + c4 + ")+" + b + "*" + c4 + ")",
                    sy = "(-" + a + "*(0.5*" + c2 + "-" + c4 + ")-" + b + "*" + c4 + ")",
                    sxy = "(-" + a + "*(0.5*" + s2 + "+" + s4 + ")+" + b + "*" + s4 + ")";
  const auto energy = [&](const unsigned int degree)
  {
    const Scene<2> scene = scene_of({{"Geometry/Shape", "plate with hole"},
                                     given::box("4, 4", "4, 2"),
                                     {"Geometry/Part", "quarter"},
                                     given::elastic("10", "0.3"),
                                     given::symmetric({"left", "bottom"}),
                                     {"Boundary right/Traction", sx + ";" + sxy},
                                     {"Boundary top/Traction", sxy + ";" + sy}});
    const UniformMesh mesh(scene, degree);
    const Laboratory laboratory(scene, mesh.mesh, mesh.degrees);
    const Solution<2> solution = laboratory.solve();
    const SolutionField<2> field(solution);
    const auto at_hole = field.at(Point<2>(0, 1));
    EXPECT_TRUE(at_hole);
    return std::pair(energy_of(laboratory, solution), at_hole ? at_hole->stress[0][0] : 0.);
  };
  const auto [J, largest] = energy(14);
  EXPECT_NEAR(largest, 3, 1e-4); // Kirsch's three times the tension
  const double round_off = std::numeric_limits<double>::epsilon(); // 7e-8 squared is 25 of it
  for (const auto &[degree, limit] : std::vector<std::pair<unsigned int, double>>{
           {4, 2.4e-3}, {6, 7.6e-5}, {8, 2.4e-6}, {10, 7.4e-8}})
    EXPECT_LT(std::abs(energy(degree).first / J - 1), limit * limit + 8 * round_off) << degree;
}

/** Lame's hollow sphere under pressure inside, half of it as a body of revolution. */
TEST(Curves, MeetLamesSphere)
{
  const Scene<2> scene = scene_of(ring({{"Material/Plane", "axisymmetric"},
                                        {"Boundary start/Symmetry", "true"},
                                        {"Boundary inner/Pressure", "1"}}));
  // u_r = p a^3/(E (b^3 - a^3)) ((1 - 2 nu) r + (1 + nu) b^3/(2 r^2)), J = -p u_r(a) 2 pi a^2/2
  const double u = (0.4 + 1.3 * 4) / 70, J = -u * numbers::PI;
  for (const auto &[degree, limit] :
       std::vector<std::pair<unsigned int, double>>{{3, 2e-4}, {5, 1e-7}, {7, 1e-10}})
  {
    const UniformMesh mesh(scene, degree);
    EXPECT_LT(relative_energy_error(scene, mesh.mesh, mesh.degrees, J), limit) << degree;
  }
}

/** A circle through the vertices of a file is the circle; a spline comes close, and splines in pieces know corners. */
TEST(Curves, FitTheVerticesOfMeshes)
{
  const PlateWithHole plate{{0, 0}, {4, 4}, {0, 0}, 1, true, 3, 4};
  for (const bool is_spline : {false, true})
  {
    CoarseMesh mesh = plate.mesh();
    std::vector<unsigned int> hole;
    for (unsigned int e = 0; e < mesh.edges.size(); ++e)
      if (mesh.edges[e].boundary == 4)
      {
        hole.push_back(e);
        mesh.edges[e].curve = {};
      }
    EXPECT_TRUE(polygon_for_circle(mesh, hole));
    EXPECT_FALSE(polygon_for_circle(mesh, {hole[0], hole[1]})); // any three points lie on one
    EXPECT_EQ(is_spline ? bend_to_splines(mesh, hole) : bend_to_circles(mesh, hole), "");
    double farthest = 0;
    for (const unsigned int e : hole)
    {
      const CurvePiece &curve = mesh.edges[e].curve;
      ASSERT_TRUE(curve);
      for (const unsigned int end : {0, 1})
        EXPECT_LT(curve.point(end).distance(mesh.vertices[mesh.edges[e].vertices[end]]), 1e-14);
      for (unsigned int k = 0; k <= 8; ++k)
      {
        const Point<2> x = curve.point(k / 8.);
        farthest = std::max(farthest, std::abs(x.norm() - 1));
        EXPECT_NEAR(curve.nearest(x), k / 8., 1e-9);
      }
    }
    // Eight edges on a quarter: a not-a-knot spline misses by 4e-5, a natural one by 2e-3.
    EXPECT_LT(farthest, is_spline ? 6e-5 : 1e-14);
  }
}

/** What edges of a file look like a circle that was meant: chords, and edges of second order whose nodes are on it. */
TEST(Curves, LookLikeACircleThatWasMeant)
{
  enum class Kind
  {
    straight,
    second_order,
    bent
  };
  struct Row
  {
    std::string name;
    unsigned int n_edges;
    double angle, flattened; ///< degrees from the first to the last; y over that of a circle
    Kind kind;
    bool is_circle;
  };
  for (const Row &row :
       {Row{"quarter by two of second order", 2, 90, 1, Kind::second_order, true},
        Row{"whole by four of second order", 4, 360, 1, Kind::second_order, true},
        Row{"one of second order", 1, 45, 1, Kind::second_order, false}, // a parabola
        Row{"an ellipse of second order", 8, 180, 0.9, Kind::second_order, false},
        Row{"a polygon", 8, 180, 1, Kind::straight, true},
        Row{"a hexagon", 6, 360, 1, Kind::straight, false},
        Row{"an elliptic polygon", 16, 180, 0.9, Kind::straight, false},
        Row{"a circle by Curve", 8, 180, 1, Kind::bent, false}})
  {
    CoarseMesh mesh;
    mesh.boundaries = {"rim"};
    const auto point = [&](const double k)
    {
      const double t = k / row.n_edges * row.angle * numbers::PI / 180;
      return Point<2>(3 * std::cos(t), 3 * row.flattened * std::sin(t));
    };
    const auto circle = std::make_shared<const Circle>(Point<2>(), 3);
    for (unsigned int k = 0; k <= row.n_edges; ++k)
      mesh.vertices.push_back(point(k));
    for (unsigned int k = 0; k < row.n_edges; ++k)
    {
      CoarseMesh::Edge edge{{{k, row.angle == 360 ? (k + 1) % row.n_edges : k + 1}}, 0};
      if (row.kind == Kind::second_order)
        edge.curve = {std::make_shared<const QuadraticEdge>(point(k), point(k + 0.5), point(k + 1)),
                      0, 1};
      else if (row.kind == Kind::bent)
        edge.curve = {circle, k * numbers::PI / row.n_edges, (k + 1) * numbers::PI / row.n_edges};
      mesh.edges.push_back(edge);
    }
    const std::vector<std::string> remarks = remarks_on_polygons(mesh);
    ASSERT_EQ(remarks.size(), row.is_circle ? 1U : 0U) << row.name;
    if (!row.is_circle)
      continue;
    EXPECT_NE(remarks[0].find("on a circle of radius 3 around"), std::string::npos) << remarks[0];
    EXPECT_NE(remarks[0].find("Boundary rim/Curve = circle"), std::string::npos) << remarks[0];
    EXPECT_EQ(remarks[0].find("second order") != std::string::npos, row.kind == Kind::second_order)
        << remarks[0];
  }
}

/** Bisection converges at the rate of the degree, hanging nodes or not. */
TEST(Curves, ConvergeAtTheRateOfTheDegree)
{
  const Scene<2> scene = scene_of(ring({{"Geometry/Subdivisions", "1, 2"},
                                        given::symmetric({"start", "end"}),
                                        {"Boundary inner/Pressure", "1"}}));
  const double J = -0.13 * (0.4 / 3 + 4. / 3) * numbers::PI / 4;
  for (const unsigned int p : {2U, 3U, 4U})
  {
    std::array<double, 2> error;
    for (const unsigned int k : {0, 1})
    {
      const UniformMesh mesh(scene, p, k + 2);
      error[k] = std::sqrt(relative_energy_error(scene, mesh.mesh, mesh.degrees, J));
    }
    EXPECT_NEAR(std::log2(error[0] / error[1]), p, 0.15) << p;
  }
}
/** By degree from 2 on: the indicator over the error, whose square is what J_N is above J. */
std::vector<double> effectivities(const Overrides &entries, const double J)
{
  const Scene<2> scene = scene_of(with(
      entries,
      {given::elastic("10", "0.3"), given::steps("pu", "5", "2"), {"Adaptivity/Tolerance", "0"}}));
  std::vector<double> result;
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      { result.push_back(step.relative_estimate / std::sqrt(1 - step.energies.energy / J)); });
  return result;
}

/**
 * The indicator on Lame's ring, u_r = U r + V/r, beside that on the ring rolled out: rectangles as long as its cells in the
 * middle, with u_x = U x + V/x.
 */
TEST(Curves, HaveTheEffectivityOfStraightCells)
{
  const double mu = 10 / 2.6, M = 10 * 0.3 / (1.3 * 0.4) + 2 * mu, U = 0.13 * 0.4 / 3,
               V = 0.13 * 4 / 3, length = 0.75 * numbers::PI;
  for (const std::string subdivisions : {"2, 4", "2, 2"})
  {
    const auto curved = effectivities(ring({{"Geometry/Subdivisions", subdivisions},
                                            given::symmetric({"start", "end"}),
                                            {"Boundary inner/Pressure", "1"}}),
                                      -(U + V) * numbers::PI / 4);
    const auto straight =
        effectivities({given::box("1, 0", "2, " + in_digits(length), subdivisions),
                       given::symmetric({"bottom", "top"}),
                       {"Boundary right/Displacement", "0; free"},
                       {"Boundary left/Traction", in_digits(M * (V - U)) + "; 0"},
                       {"Body force/Expression", in_digits(-2 * M * V) + "/x^3; 0"}},
                      -length * M / 2 * (U * U - U * V + 7 * V * V / 24));
    ASSERT_EQ(curved.size(), 5U);
    ASSERT_EQ(straight.size(), 5U);
    for (unsigned int k = 0; k < curved.size(); ++k)
    {
      EXPECT_LT(curved[k], 1.5 * straight[k]) << subdivisions << " p=" << k + 2;
      EXPECT_GT(curved[k], straight[k] / 1.5) << subdivisions << " p=" << k + 2;
    }
  }
}
} // namespace
