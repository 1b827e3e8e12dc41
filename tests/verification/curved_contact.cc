// SPDX-License-Identifier: LGPL-2.1-or-later
// What happens along curved edges: friction where the parameter runs unevenly, pressure at nodes, slip that is counted from a
// past, plates, the order of points; and what is said of cells that curves spoil.
#include "discretisation.h"

#include <hpvi/base/file_format.h>
#include <hpvi/driver/adaptive_solver.h>
#include <hpvi/driver/load_history.h>
#include <hpvi/plane/folded_cell.h>
#include <hpvi/reader/shapes/half_disc.h>
#include <hpvi/reader/shapes/ring_sector.h>
#include <hpvi/results/residual_estimator.h>
#include <hpvi/results/warnings/body_state.h>
#include <hpvi/results/warnings/warnings.h>
#include <hpvi/scene/plate_motion.h>

#include <cmath>

namespace
{
using namespace verification;

/** The unit ring in twice as large a one, eight cells around. */
Overrides ring(const Overrides &others)
{
  Overrides entries{given::ring("Geometry", "1, 2", "0, 360", "1, 8"), given::elastic("10", "0.3"),
                    given::steps("pu", "1", "8")};
  entries.insert(entries.end(), others.begin(), others.end());
  return entries;
}

/** A circle whose parameter runs twice as fast at one end of each eighth as at the other. */
class UnevenCircle : public Circle
{
public:
  explicit UnevenCircle(const double radius) : Circle(Point<2>(), radius)
  {
  }

  Point<2> point(const double t) const override
  {
    return Circle::point(angle(t));
  }

  Tensor<1, 2> derivative(const double t) const override
  {
    const double s = t - std::floor(t);
    return (2. / 3 + 2. / 3 * s) * numbers::PI / 4 * Circle::derivative(angle(t));
  }

  double nearest(const Point<2> &x, const double from, const double to) const override
  {
    double a = from, b = to;
    const double wanted = Circle::nearest(x, angle(from), angle(to));
    for (unsigned int k = 0; k < 60; ++k)
      ((angle((a + b) / 2) < wanted) == (from < to) ? a : b) = (a + b) / 2;
    return (a + b) / 2;
  }

private:
  static double angle(const double t)
  {
    const double s = t - std::floor(t);
    return (std::floor(t) + (2 * s + s * s) / 3) * numbers::PI / 4;
  }
};

/** Of a bound with one wave on each eighth only the mean is left, if each length counts as what it is. */
TEST(CurvedContact, CarriesFrictionByLength)
{
  Scene<2> scene =
      scene_of(ring({{"Boundary inner/Displacement", "0; 0"},
                     given::rough("outer", "bilateral", "0.2+0.1*sin(8*atan2(y,x))")}));
  CoarseMesh mesh = *scene.geometry.mesh;
  const auto uneven = std::make_shared<const UnevenCircle>(2.);
  for (CoarseMesh::Edge &edge : mesh.edges)
    if (edge.boundary == 1)
    {
      const double first = std::round(edge.curve.from / (numbers::PI / 4));
      edge.curve = {uneven, first, first + 1};
    }
  // The last parameter of an eighth belongs to it, not to the next.
  for (CoarseMesh::Edge &edge : mesh.edges)
    if (edge.boundary == 1)
      edge.curve.to -= 1e-13;
  scene.geometry.mesh = std::make_shared<const CoarseMesh>(mesh);
  Triangulation<2> triangulation;
  make_mesh(scene, triangulation);
  const Degrees degrees(triangulation.n_active_cells(), 8);
  set_edge_degrees(triangulation, degrees);
  const Laboratory laboratory(scene, triangulation, degrees);
  EXPECT_NEAR(laboratory.contact_space.friction_limit(), 0.2 * 4 * numbers::PI, 1e-6);
  EXPECT_NEAR(laboratory.contact_space.discrete_friction_limit(), 0.2 * 4 * numbers::PI, 1e-4);
}

/** Lame's ring under pressure in a rigid one, without friction: pressures at nodes, or moments of them. */
TEST(CurvedContact, HasLamesPressure)
{
  const double mu = 10 / 2.6, lambda = 10 * 0.3 / (1.3 * 0.4), B = 1 / (2 * mu + (lambda + mu) / 2),
               p = -(2 * (lambda + mu) * -B / 4 - 2 * mu * B / 4);
  for (const std::string normal_contact : {"nodes", "multiplier"})
    each_step<2>(scene_of(ring({{"Boundary inner/Traction", "x; y"},
                                given::rough("outer", "unilateral", "0.01"),
                                {"Solver/Normal contact", normal_contact}})),
                 [&](const StepReport<2> &step)
                 {
                   const ContactState<2> &outer = step.contact.at(0);
                   EXPECT_NEAR(-outer.normal_resultant / (4 * numbers::PI), p, 1e-7)
                       << normal_contact;
                   for (const ContactPoint<2> &point : outer.points)
                     EXPECT_NEAR(-point.normal_traction, p, 1e-5) << normal_contact;
                 });
}

/** Counterclockwise, whatever the numbers of cells: an angle falls once, where the boundary begins again. */
TEST(CurvedContact, OrdersPointsAlongTheBoundary)
{
  const Scene<2> scene = scene_of(ring({{"Boundary inner/Displacement", "0.01*x; 0.02*y"},
                                        given::rough("outer", "bilateral", "0.1")}));
  const RandomMesh mesh(scene, 5, 2, 3, 5);
  const Laboratory laboratory(scene, mesh);
  unsigned int n_falls = 0;
  double last = -10;
  for (const ContactFace<2> &face : laboratory.contact_space.faces())
  {
    const Point<2> x = face.point(0.5);
    const double angle = std::atan2(x[1], x[0]);
    n_falls += angle < last;
    last = angle;
  }
  EXPECT_EQ(n_falls, 1U);
}

/** Turned in two load steps: the second one counts slip from the first. */
TEST(CurvedContact, CountsSlipFromThePast)
{
  const Scene<2> scene = scene_of(ring({{"Boundary inner/Displacement", "-0.1*t*y; 0.1*t*x"},
                                        given::rough("outer", "bilateral", "0.05"),
                                        {"Loading/Steps", "2"}}));
  // u_t = K/(2 mu) (1/r - r) + U r with K = 4 g: what it has more at t = 1 than at t = 1/2 is rigid.
  const double mu = 10 / 2.6, slip = 0.05 * 2, all = 0.1 * 2 - 4 * 0.05 / (2 * mu) * (2 - 0.5);
  LoadHistory<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        if (step.load.number == 2)
          for (const ContactPoint<2> &point : step.contact.at(0).points)
          {
            EXPECT_NEAR(point.slip, slip, 1e-8);
            EXPECT_NEAR(point.tangential_displacement, all, 1e-8);
          }
      });
}

/** The mean point of half a circle and its diameter, 2R/(pi + 2) above the latter. */
TEST(CurvedContact, TurnsPlatesAboutTheirMeanPoint)
{
  CoarseMesh mesh = HalfDisc{{0, 0}, 3, 0}.mesh();
  for (CoarseMesh::Edge &edge : mesh.edges)
    edge.boundary = 0;
  mesh.boundaries = {"all"};
  Scene<2> scene;
  scene.geometry = geometry_of(Shape::half_disc, mesh);
  scene.name_boundaries();
  scene.boundaries[0].plate = RigidPlate<2>();
  const PlateMotion<2> plate(scene, scene.boundaries[0]);
  EXPECT_NEAR(plate.centre()[0], 0, 1e-14);
  EXPECT_NEAR(plate.centre()[1], 6 / (numbers::PI + 2), 1e-14);
}

/** A linear displacement leaves no residual on curved cells, where second derivatives of maps count. */
TEST(CurvedContact, HasNoResidualUnderConstantStress)
{
  const std::string u = "0.01*x+0.02*y; -0.03*x+0.015*y";
  const Scene<2> scene =
      scene_of(ring({{"Boundary inner/Displacement", u}, {"Boundary outer/Displacement", u}}));
  const RandomMesh mesh(scene, 3, 1, 2, 6);
  const Laboratory laboratory(scene, mesh);
  const Solution<2> solution = laboratory.solve();
  EXPECT_LT(norms(estimate_error(SolutionField<2>(solution)), MPI_COMM_SELF).total, 1e-10);
}

/** A straight edge that crosses the arc beside it, and two edges on one arc. */
TEST(CurvedContact, FindsCellsThatCurvesSpoil)
{
  CoarseMesh thin = RingSector{{0, 0}, 1, 1.02, 0, 90, 2, 2}.mesh();
  for (CoarseMesh::Edge &edge : thin.edges)
    if (edge.boundary == CoarseMesh::inside)
      edge.curve = {};
  EXPECT_TRUE(worst_cell(thin).is_folded);
  Scene<2> scene;
  scene.geometry = geometry_of(Shape::ring_sector, thin);
  scene.name_boundaries();
  Triangulation<2> mesh;
  make_mesh(scene, mesh);
  EXPECT_TRUE(folded_cell(mesh));
  mesh.clear();
  scene.geometry = geometry_of(Shape::ring_sector, RingSector{{0, 0}, 1, 1.02, 0, 90, 2, 2}.mesh());
  make_mesh(scene, mesh);
  EXPECT_FALSE(folded_cell(mesh));

  // A triangle in disguise: the third corner of the only cell all but lies between its neighbours.
  CoarseMesh flat;
  flat.vertices = {{0, 0}, {1, 0}, {0.52, 0.52}, {0, 1}};
  flat.cells = {{{{0, 1, 2, 3}}}};
  flat.boundaries = {"all"};
  for (unsigned int v = 0; v < 4; ++v)
    flat.edges.push_back({{{v, (v + 1) % 4}}, 0});
  const double degrees = 180 - 4 * std::atan(0.04) * 90 / numbers::PI;
  EXPECT_NEAR(worst_cell(flat).angle, degrees, 1e-9);
  scene.geometry = geometry_of(Shape::file, flat);
  BodyState<2> body;
  body.gradients.resize(1);
  body.degrees = {3};
  const Warnings warnings = mesh_warnings(scene, body);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].text.find("(0.52 0.52)"), std::string::npos) << warnings[0].text;
}

/** Where a mesh lies says nothing, what is in it does. */
TEST(CurvedContact, KnowsMeshFilesByTheirContent)
{
  const auto path = [](const std::string &name) { return ::testing::TempDir() + "hpvi-" + name; };
  std::ofstream(path("one.msh")) << "a mesh";
  std::ofstream(path("two.msh")) << "a mesh";
  std::ofstream(path("three.msh")) << "another";
  const auto entries = [&](const std::string &name)
  {
    return entries_of("subsection Geometry\n  set File = " + path(name) + "\nend\n",
                      [](const std::string &, const std::string &) { return true; });
  };
  EXPECT_EQ(entries("one.msh"), entries("two.msh"));
  EXPECT_NE(entries("one.msh"), entries("three.msh"));
  for (const char *const name : {"one.msh", "two.msh", "three.msh"})
    std::filesystem::remove(path(name));
}
} // namespace
