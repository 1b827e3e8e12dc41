// SPDX-License-Identifier: LGPL-2.1-or-later
// Pairs as drawings have them: vertices beside each other by what digits leave, edges that hang over, parts of sides.
#include "discretisation.h"

#include <hpvi/scene/boundary_parts.h>
#include <hpvi/scene/edge_projection.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>

namespace
{
using namespace verification;

constexpr double degree = numbers::PI / 180;

/** Cells, and edges of the boundary with the names of the sides that they belong to. */
struct Drawing
{
  std::vector<Point<2>> points;
  std::vector<std::array<unsigned int, 4>> cells; ///< counterclockwise
  std::vector<std::pair<std::string, std::array<unsigned int, 2>>> edges;

  /** The mesh file of this test that is called @p name. */
  std::string file(const std::string &name) const
  {
    std::vector<std::string> sides;
    const auto group = [&](const std::string &side)
    {
      const auto found = std::find(sides.begin(), sides.end(), side);
      const unsigned int number = found - sides.begin();
      if (found == sides.end())
        sides.push_back(side);
      return number + 1;
    };
    std::ostringstream out, elements;
    unsigned int n = 0;
    for (const auto &[side, ends] : edges)
      elements << ++n << " 1 2 " << group(side) << " " << group(side) << " " << ends[0] + 1 << " "
               << ends[1] + 1 << "\n";
    for (const auto &cell : cells)
      elements << ++n << " 3 2 9 9 " << cell[0] + 1 << " " << cell[1] + 1 << " " << cell[2] + 1
               << " " << cell[3] + 1 << "\n";
    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n" << sides.size() + 1 << "\n";
    for (const std::string &side : sides)
      out << "1 " << group(side) << " \"" << side << "\"\n";
    out << "2 9 \"all\"\n$EndPhysicalNames\n$Nodes\n" << points.size() << "\n";
    for (unsigned int k = 0; k < points.size(); ++k)
      out << k + 1 << " " << in_digits(points[k][0]) << " " << in_digits(points[k][1]) << " 0\n";
    out << "$EndNodes\n$Elements\n" << n << "\n" << elements.str() << "$EndElements\n";
    const auto path = std::filesystem::path(::testing::TempDir()) /
                      ("hpvi-" + name + "-" + std::to_string(getpid()) + ".msh");
    std::ofstream(path) << out.str();
    return path.string();
  }
};

/** A mesh file of one layer of cells between two chains of points, with names of the edges along the first one. */
std::string strip(const std::string &name, const std::vector<Point<2>> &a,
                  const std::vector<Point<2>> &b, const std::vector<std::string> &names = {"inner"},
                  const bool is_reversed = false)
{
  const unsigned int n = a.size() - 1;
  Drawing drawing{a, {}, {}};
  drawing.points.insert(drawing.points.end(), b.begin(), b.end());
  for (unsigned int k = 0; k < n; ++k)
  {
    drawing.edges.push_back({names[std::min<std::size_t>(k, names.size() - 1)], {{k, k + 1}}});
    drawing.edges.push_back({"outer", {{n + k + 1, n + k + 2}}});
  }
  drawing.edges.push_back({"start", {{0, n + 1}}});
  drawing.edges.push_back({"end", {{n, 2 * n + 1}}});
  for (unsigned int i = 0; i < n; ++i)
  {
    const unsigned int k = is_reversed ? n - 1 - i : i;
    drawing.cells.push_back({{k, n + k + 1, n + k + 2, k + 1}});
  }
  return drawing.file(name);
}

std::vector<Point<2>> arc(const Point<2> &centre, const double radius,
                          const std::vector<double> &angles)
{
  std::vector<Point<2>> result;
  for (const double angle : angles)
    result.push_back(Circle(centre, radius).point(angle * degree));
  return result;
}

/** A quarter of a ring with @p n cells, of which the vertices inside are moved by some of an edge to and fro. */
std::vector<double> angles(const unsigned int n, const std::function<double()> &moved)
{
  std::vector<double> result;
  for (unsigned int k = 0; k <= n; ++k)
    result.push_back((k + (k % n == 0 ? 0 : moved())) * 90. / n);
  return result;
}

/** The largest deviation of pressures from @p p, and of shears from zero, in the only step of a scene. */
double deviation(const Overrides &entries, const double p)
{
  double result = 0;
  each_step<2>(scene_of(entries),
               [&](const StepReport<2> &step)
               {
                 for (const ContactPoint<2> &point : step.contact.at(0).points)
                   result = std::max({result, std::abs(point.normal_traction + p),
                                      std::abs(point.tangential_traction)});
               });
  return result;
}

// ---------------------------------------------------------------- two drawings of one curve

/** A pin from 1 to 2 under the pressure 1 in a sheet from 2 to 3, of one material: u_r = A r + B/r. */
constexpr double fit = (9. / 4 - 1) / (9 - 1);

Overrides ring_shape(const std::string &body, const double inner, const unsigned int n)
{
  return {{"Body " + body + "/Shape", "ring sector"},
          {"Body " + body + "/Radii", in_digits(inner) + ", " + in_digits(inner + 1)},
          {"Body " + body + "/Angles", "0, 90"},
          {"Body " + body + "/Subdivisions", "1, " + std::to_string(n)}};
}

Overrides ring_file(const std::string &body, const double inner, const std::vector<double> &at,
                    const std::string &curve = "circle", const bool is_reversed = false)
{
  return {{"Body " + body + "/Shape", "file"},
          {"Body " + body + "/File",
           strip(body, arc({0, 0}, inner, at), arc({0, 0}, inner + 1, at), {"inner"}, is_reversed)},
          {"Boundary " + body + ".inner/Curve", curve},
          {"Boundary " + body + ".outer/Curve", curve}};
}

Overrides fitted(const std::string &law, const std::string &slave, const unsigned int p)
{
  Overrides entries{{"Contact fit/Between", "pin.outer, sheet.inner"},
                    {"Contact fit/Slave", slave},
                    given::elastic("10", "0.3"),
                    {"Boundary pin.inner/Pressure", "1"},
                    {"Error/Bound", "false"},
                    given::steps("pu", "1", std::to_string(p))};
  if (law == "Coulomb")
    entries.emplace_back("Contact fit/Friction coefficient", "0.3");
  else
    entries.emplace_back("Contact fit/Law", law);
  for (const char *const side : {"pin.start", "pin.end", "sheet.start", "sheet.end"})
    entries.emplace_back("Boundary " + std::string(side) + "/Symmetry", "true");
  return entries;
}

/** Whatever lies between vertices of both drawings, from what Gmsh leaves to a segment that is one, the fit is that of two shapes. */
TEST(DrawnPairs, FitWhereVerticesNearlyMeet)
{
  struct Row
  {
    std::string law, slave, curve;
    bool pin_is_a_shape;
    unsigned int n; ///< edges
    double most;    ///< distance of vertices over the length of an edge
  };
  for (const Row &row : {Row{"unilateral", "automatic", "circle", false, 2, 1e-5},
                         Row{"unilateral", "sheet.inner", "circle", true, 3, 1e-5},
                         Row{"unilateral", "pin.outer", "circle", true, 3, 1e-5},
                         Row{"Coulomb", "sheet.inner", "circle", false, 2, 1e-5},
                         Row{"tied", "pin.outer", "circle", false, 3, 1e-5},
                         Row{"bilateral", "automatic", "circle", true, 2, 1e-5},
                         Row{"unilateral", "pin.outer", "spline", false, 8, 1e-2},
                         Row{"bilateral", "sheet.inner", "spline", false, 6, 1e-2},
                         Row{"tied", "sheet.inner", "spline", false, 8, 1e-2}})
  {
    const bool is_circle = row.curve == "circle";
    const unsigned int p = is_circle ? 6 : 3;
    const double of_shapes =
        deviation(joined({fitted(row.law, row.slave, p), ring_shape("pin", 1, row.n),
                          ring_shape("sheet", 2, row.n)}),
                  fit);
    bool is_reversed = false;
    for (const double apart : {1e-2, 1e-5, 1e-6, 1e-8, 1e-9, 1e-12})
      if (apart <= row.most)
      {
        double sign = 1;
        is_reversed = !is_reversed;
        const Overrides scene = joined(
            {fitted(row.law, row.slave, p),
             row.pin_is_a_shape ? ring_shape("pin", 1, row.n)
                                : ring_file("pin", 1, angles(row.n, [] { return 0.; }), row.curve),
             ring_file("sheet", 2, angles(row.n, [&] { return (sign = -sign) * apart; }), row.curve,
                       is_reversed)});
        EXPECT_LT(deviation(scene, fit), (is_circle ? 2 : 20) * of_shapes + 1e-12)
            << row.law << " " << row.curve << " " << apart << " " << is_reversed;
      }
  }
}

/** Meshes of five sizes with the noise of Gmsh, each in each, either side the slave in turn. */
TEST(DrawnPairs, FitAsShapesDoAtAllSizes)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> digits(-9, -8);
  const auto noise = [&] { return std::pow(10., digits(random)); };
  for (unsigned int n : {2, 3, 4, 5, 6})
    for (unsigned int m : {2, 3, 4, 5, 6})
    {
      const std::string slave = (n + m) % 2 == 0 ? "pin.outer" : "sheet.inner";
      const Overrides entries = fitted("unilateral", slave, 4);
      const double of_shapes =
          deviation(joined({entries, ring_shape("pin", 1, n), ring_shape("sheet", 2, m)}), fit);
      EXPECT_LT(deviation(joined({entries, ring_file("pin", 1, angles(n, noise)),
                                  ring_file("sheet", 2, angles(m, noise))}),
                          fit),
                2 * of_shapes)
          << n << " in " << m << " " << slave;
    }
}

/**
 * A quarter of a ring as free meshes have it: @p n edges along its arc, vertices that are moved by a fifth of a cell but along the ends, and every
 * fourth cell with a smaller one inside, so that vertices have three and five cells around them.
 */
std::string free_ring(const std::string &name, const double inner, const unsigned int n,
                      std::mt19937 &random)
{
  std::uniform_real_distribution<double> moved(-0.2, 0.2);
  const unsigned int m = std::max(1., std::round(n / (numbers::PI / 2 * (inner + 0.5))));
  Drawing drawing;
  for (unsigned int j = 0; j <= m; ++j)
    for (unsigned int k = 0; k <= n; ++k)
    {
      const bool on_arc = j % m == 0, at_end = k % n == 0;
      const double radius = inner + (j + (on_arc ? 0 : moved(random))) / m,
                   angle = (k + (at_end ? 0 : moved(random))) * 90. / n;
      drawing.points.push_back(Circle({0, 0}, radius).point(angle * degree));
    }
  const auto at = [&](const unsigned int j, const unsigned int k) { return j * (n + 1) + k; };
  for (unsigned int k = 0; k < n; ++k)
  {
    drawing.edges.push_back({"inner", {{at(0, k), at(0, k + 1)}}});
    drawing.edges.push_back({"outer", {{at(m, k), at(m, k + 1)}}});
  }
  for (unsigned int j = 0; j < m; ++j)
  {
    drawing.edges.push_back({"start", {{at(j, 0), at(j + 1, 0)}}});
    drawing.edges.push_back({"end", {{at(j, n), at(j + 1, n)}}});
  }
  for (unsigned int j = 0; j < m; ++j)
    for (unsigned int k = 0; k < n; ++k)
    {
      const std::array<unsigned int, 4> cell{
          {at(j, k), at(j + 1, k), at(j + 1, k + 1), at(j, k + 1)}};
      if ((j + k) % 4 != 1)
      {
        drawing.cells.push_back(cell);
        continue;
      }
      std::array<unsigned int, 4> inside;
      for (unsigned int c = 0; c < 4; ++c)
      {
        inside[c] = drawing.points.size();
        Point<2> x;
        for (unsigned int d = 0; d < 4; ++d)
          x += (c == d ? 0.55 : 0.15) * drawing.points[cell[d]];
        drawing.points.push_back(x);
      }
      drawing.cells.push_back(inside);
      for (unsigned int c = 0; c < 4; ++c)
        drawing.cells.push_back({{cell[c], cell[(c + 1) % 4], inside[(c + 1) % 4], inside[c]}});
    }
  return drawing.file(name);
}

/** What one step says of Lame's rings: the root of the missing energy, and the deviation of the pressure where there is contact. */
struct FitErrors
{
  double energy = 0, pressure = 0;
};

FitErrors fit_errors(const Overrides &entries, const double exact)
{
  FitErrors result;
  each_step<2>(scene_of(entries),
               [&](const StepReport<2> &step)
               {
                 result.energy = std::sqrt(std::abs(step.energies.energy - exact));
                 for (const ContactState<2> &contact : step.contact)
                   for (const ContactPoint<2> &point : contact.points)
                     result.pressure =
                         std::max({result.pressure, std::abs(point.normal_traction + fit),
                                   std::abs(point.tangential_traction)});
               });
  return result;
}

/**
 * The segmentation of two free meshes costs nothing: the energy is as near as those of both rings alone, under the exact pressure, and the
 * pressure as near as that of the worse of them on a rigid circle that has the exact displacement.
 */
TEST(DrawnPairs, FitAsEachFreeMeshAloneDoes)
{
  const double E = 10, nu = 0.3, A = 1. / 8, B = 9. / 8; // s_rr = A - B/r^2, s_tt = A + B/r^2
  const auto u = [&](const double r) { return (1 + nu) / E * ((1 - 2 * nu) * A * r + B / r); };
  const double inner_work = u(1) * numbers::PI / 2, fit_work = fit * u(2) * numbers::PI;
  struct Ring
  {
    std::string file;
    FitErrors alone; ///< energy under the pressure, pressure on the rigid circle
  };
  std::mt19937 random(11);
  std::array<std::vector<Ring>, 2> rings;
  for (const unsigned int body : {0, 1})
    for (const unsigned int n : {4, 5, 7, 9, 12})
    {
      const std::string name = (body == 0 ? "pin" : "sheet") + std::to_string(n),
                        file = free_ring(name, 1 + body, n, random),
                        face = body == 0 ? "outer" : "inner";
      const Overrides ring{{"Geometry/Shape", "file"},
                           {"Geometry/File", file},
                           given::elastic(in_digits(E), in_digits(nu)),
                           {"Boundary inner/Curve", "circle"},
                           {"Boundary outer/Curve", "circle"},
                           given::symmetric({"start", "end"}),
                           {"Boundary inner/Pressure", "1"},
                           given::steps("pu", "1", "4")};
      const double work = body == 0 ? inner_work - fit_work : fit_work;
      Overrides on_circle =
          joined({ring,
                  {{"Boundary " + face + "/Contact", "unilateral"},
                   {"Boundary " + face + "/Gap", in_digits(body == 0 ? u(2) : -u(2))}}});
      if (body == 1)
        on_circle = joined({on_circle, {{"Boundary inner/Pressure", "0"}}});
      rings[body].push_back(
          {file,
           {fit_errors(joined({ring, {{"Boundary " + face + "/Pressure", in_digits(fit)}}}),
                       -work / 2)
                .energy,
            fit_errors(on_circle, 0).pressure}});
    }
  unsigned int n_pairs = 0;
  for (const Ring &pin : rings[0])
    for (const Ring &sheet : rings[1])
    {
      const std::string slave = (n_pairs++) % 2 == 0 ? "pin.outer" : "sheet.inner"; // of 25
      Overrides entries = fitted("unilateral", slave, 4);
      for (const auto &[body, file] : {std::make_pair("pin", pin.file), {"sheet", sheet.file}})
        entries = joined({entries,
                          {{"Body " + std::string(body) + "/Shape", "file"},
                           {"Body " + std::string(body) + "/File", file},
                           {"Boundary " + std::string(body) + ".inner/Curve", "circle"},
                           {"Boundary " + std::string(body) + ".outer/Curve", "circle"}}});
      const FitErrors errors = fit_errors(entries, -inner_work / 2);
      EXPECT_LT(errors.energy, 1.1 * std::hypot(pin.alone.energy, sheet.alone.energy))
          << pin.file << " " << sheet.file << " " << slave;
      EXPECT_LT(errors.pressure, 2 * std::max(pin.alone.pressure, sheet.alone.pressure))
          << pin.file << " " << sheet.file << " " << slave;
    }
}

/** What hangs over by less than 1e-6 of an edge ends there, also where cells are smaller than that: on either body, on arcs and splines; the pressure is right on average. */
TEST(DrawnPairs, EndWithCellsThatHangOverAltogether)
{
  for (const auto &[curve, levels, over] :
       std::vector<std::tuple<std::string, unsigned int, double>>{{"circle", 0, 4e-5},
                                                                  {"circle", 24, 4e-5},
                                                                  {"circle", 28, 8e-6},
                                                                  {"circle", 24, -4e-5},
                                                                  {"spline", 24, 1e-5},
                                                                  {"spline", 27, 8e-6}})
    for (const bool of_pin : {true, false})
    {
      const std::string slave = of_pin ? "pin" : "sheet";
      std::vector<double> longer = angles(curve == "circle" ? 2 : 8, [] { return 0.; });
      longer.back() += over;
      const std::vector<double> other = angles(8, [] { return 0.; });
      const Point<2> end = arc({0, 0}, 2, longer).back();
      Overrides entries = joined(
          {fitted("unilateral", of_pin ? "pin.outer" : "sheet.inner", 3),
           ring_file("pin", 1, of_pin ? longer : other, curve),
           ring_file("sheet", 2, of_pin ? other : longer, curve),
           {{"Body " + slave + "/Graded towards", in_digits(end[0]) + ", " + in_digits(end[1])},
            {"Body " + slave + "/Grading levels", std::to_string(levels)}}});
      double mean = 0;
      each_step<2>(scene_of(entries), [&](const StepReport<2> &step)
                   { mean = -step.contact.at(0).normal_resultant / step.contact[0].area; });
      EXPECT_NEAR(mean / fit, 1, 1e-3) << curve << " " << levels << " " << over << " " << slave;
    }
}

/** A distance in the drawing, which a pressure closes, and an interference: as between shapes. */
TEST(DrawnPairs, CloseADistanceWhereVerticesNearlyMeet)
{
  for (const auto &[distance, gap, slave] :
       std::vector<std::tuple<double, std::string, std::string>>{{1e-3, "0", "pin.outer"},
                                                                 {1e-3, "0", "sheet.inner"},
                                                                 {0.01, "-0.005", "automatic"},
                                                                 {0, "-0.01", "pin.outer"},
                                                                 {0, "0.01", "sheet.inner"}})
  {
    Overrides entries = fitted("unilateral", slave, 8);
    entries.emplace_back("Contact fit/Gap", gap);
    const auto pressure = [&](const Overrides &bodies)
    {
      double mean = 0;
      each_step<2>(scene_of(joined({entries, bodies})), [&](const StepReport<2> &step)
                   { mean = -step.contact.at(0).normal_resultant / step.contact[0].area; });
      return mean;
    };
    const double of_shapes =
        pressure(joined({ring_shape("pin", 1, 3), ring_shape("sheet", 2 + distance, 3)}));
    EXPECT_GT(of_shapes, 0.01);
    for (const double apart : {1e-6, 3e-8, 1e-9})
      EXPECT_NEAR(
          pressure(joined({ring_file("pin", 1, angles(3, [&] { return apart; })),
                           ring_file("sheet", 2 + distance, angles(3, [] { return 0.; }))})) /
              of_shapes,
          1, 1e-8)
          << distance << " " << apart;
  }
}

/** Two splines through points of one curve that are others lie in each other here and there, and are one curve; what is drawn so is not. */
TEST(DrawnPairs, TakeSplinesForOneCurve)
{
  using Height = std::function<double(double)>;
  const Height wave = [](const double x) { return 0.2 * std::sin(2 * x); },
               dome = [](const double x) { return 0.3 * std::sqrt(1 - (x - 1) * (x - 1) / 2); },
               ramp = [](const double x) { return 0.1 * std::exp(x) - 0.4; };
  struct Row
  {
    std::string name;
    Height lower, upper;
    unsigned int n, m;
    std::string problem; ///< empty: taken
  };
  const auto moved = [](const Height &f, const Height &by)
  { return [f, by](const double x) { return f(x) + by(x); }; };
  const std::vector<Row> rows{
      {"a wave", wave, wave, 9, 12, ""},
      {"the same from below", wave, wave, 12, 9, ""},
      {"a coarse wave", wave, wave, 5, 7, ""},
      {"the same with a fine one", wave, wave, 5, 20, ""},
      {"a dome", dome, dome, 8, 11, ""},
      {"a ramp", ramp, ramp, 6, 9, ""},
      {"a wave higher than the other one", moved(wave, [](double) { return 1e-5; }), wave, 9, 9,
       "lie 1e-05 inside each other at"},
      {"a bump in it", moved(wave, [](const double x) { return 0.02 * std::sin(x); }), wave, 9, 12,
       "inside each other at (1.5"},
      {"a bump in a straight side",
       [](const double x) { return 0.003 * std::sin(numbers::PI * x); }, [](double) { return 0.; },
       12, 9, "lie 0.003 inside each other at (0.5, "}};
  const double E = 10, nu = 0.3;
  for (const Row &row : rows)
  {
    const auto file =
        [&](const std::string &name, const Height &height, const unsigned int n, const double far)
    {
      std::vector<Point<2>> curve, line;
      for (unsigned int k = 0; k <= n; ++k)
      {
        const double x = 2. * k / n;
        curve.emplace_back(x, height(x));
        line.emplace_back(x, far);
      }
      return strip(name, curve, line);
    };
    const Overrides entries{{"Body lower/Shape", "file"},
                            {"Body lower/File", file("lower", row.lower, row.n, -1)},
                            {"Body upper/Shape", "file"},
                            {"Body upper/File", file("upper", row.upper, row.m, 1)},
                            {"Boundary lower.inner/Curve", "spline"},
                            {"Boundary upper.inner/Curve", "spline"},
                            given::symmetric({"lower.outer", "lower.start", "upper.start"}),
                            {"Boundary upper.outer/Pressure", "1"},
                            given::joint("joint", "upper.inner, lower.inner", "tied"),
                            given::elastic(in_digits(E), in_digits(nu)),
                            given::steps("pu", "1", "4")};
    if (!row.problem.empty())
    {
      const std::string refusal = failure_of<InputError>([&] { scene_of(entries); });
      EXPECT_TRUE(says(refusal, row.problem)) << row.name << ": " << refusal;
      continue;
    }
    const Scene<2> scene = scene_of(entries);
    EXPECT_TRUE(mentions(scene.remarks, "leave open")) << row.name;
    double energy = 0;
    AdaptiveSolver<2>(scene).run([&](const StepReport<2> &step) { energy = step.energies.energy; });
    EXPECT_NEAR(energy * E / (1 - nu * nu) / -2, 1, 1e-4) << row.name;
  }
}

// ---------------------------------------------------------------- what is near

/** By Hertz, of a force P per thickness on a radius R of the relative curvature. */
double hertz_pressure(const double P, const double R)
{
  const double E = 210000, nu = 0.3;
  return std::sqrt(P * E / (2 * (1 - nu * nu)) / (numbers::PI * R));
}

Overrides half_disc(const std::string &body, const std::string &centre, const double radius,
                    const double angle)
{
  return {{"Body " + body + "/Shape", "half disc"},
          {"Body " + body + "/Centre", centre},
          {"Body " + body + "/Radius", in_digits(radius)},
          {"Body " + body + "/Angle", in_digits(angle)}};
}

Overrides bar(const double half_length)
{
  return {given::block("bar", in_digits(-half_length) + ", -10", in_digits(half_length) + ", 0",
                       "12, 1"),
          {"Boundary bar.bottom/Displacement", "0; 0"}};
}

/** A flank of an involute of the base circle of radius 50 cos 20 degrees about (0, 0), with a layer of cells inside; turned by 180 degrees about (50, 0). */
Overrides flank(const std::string &body, const bool is_turned)
{
  const double base = 50 * std::cos(20 * degree), at_pitch = std::tan(20 * degree);
  std::vector<Point<2>> edge, inside;
  for (unsigned int k = 0; k <= 20; ++k)
  {
    const double roll = 0.1 + k * 0.032, turn = roll - at_pitch + 20 * degree;
    const Point<2> x(base * (std::cos(turn) + roll * std::sin(turn)),
                     -base * (std::sin(turn) - roll * std::cos(turn)));
    const Tensor<1, 2> n({std::sin(turn), std::cos(turn)}); // out of the tooth
    for (const bool is_inside : {false, true})
    {
      const Point<2> place = is_inside ? x - 3 * n : x;
      (is_inside ? inside : edge)
          .push_back(is_turned ? Point<2>(100 - place[0], -place[1]) : place);
    }
  }
  return {{"Body " + body + "/Shape", "file"},
          {"Body " + body + "/File", strip(body, edge, inside, {"flank"})},
          {"Boundary " + body + ".flank/Curve", "spline"}};
}

/** Edges that hang over where nobody presses are left out, however large the scene is, and peaks are Hertz's. */
TEST(DrawnPairs, LeaveOutEdgesThatAreFarForTheirRadius)
{
  struct Row
  {
    std::string name, between;
    Overrides bodies;
    double R;
    unsigned int slave; ///< of Between
  };
  const Overrides roller = joined(
      {half_disc("roller", "0, 5", 5, 180), {{"Boundary roller.flat/Displacement", "0; -0.05"}}});
  const std::vector<Row> rows{
      {"a roller on a long bar", "roller.arc, bar.top", joined({roller, bar(120)}), 5, 0},
      {"a bar under a roller", "bar.top, roller.arc", joined({roller, bar(120)}), 5, 1},
      {"a small roller on a large one", "roller.arc, disc.arc",
       joined({roller,
               half_disc("disc", "0, -200", 200, 0),
               {given::graded("Body disc", "0, 0", "5"),
                {"Boundary disc.flat/Displacement", "0; 0"}}}),
       1 / (1 / 5. + 1 / 200.), 0},
      {"a roller on a slope", "roller.arc, slope.top",
       joined({half_disc("roller", "-2.5, 4.3301270189221936", 5, 210),
               {{"Boundary roller.flat/Displacement", "0.025; -0.0433"},
                given::quadrilateral(
                    "Body slope",
                    "-98.9230484541326, -68.6602540378444; 108.9230484541326, 51.3397459621556; "
                    "103.9230484541326, 60; "
                    "-103.9230484541326, -60",
                    "12, 1"),
                {"Boundary slope.bottom/Displacement", "0; 0"}}}),
       5, 0},
      {"a tube in a massive arch",
       "tube.outer, arch.inner",
       {given::ring("Body tube", "2, 5", "-90, 270", "1, 8"),
        {"Body tube/Centre", "0, 5"},
        {"Boundary tube.inner/Displacement", "0; -0.05"},
        given::ring("Body arch", "8, 120", "190, 350", "4, 6"),
        {"Body arch/Centre", "0, 8"},
        {"Boundary arch.outer/Displacement", "0; 0"}},
       1 / (1 / 5. - 1 / 8.),
       0},
      {"flanks of gears", "driver.flank, driven.flank",
       joined({flank("driver", false),
               flank("driven", true),
               {{"Boundary driver.outer/Displacement", "0; 0.02"},
                {"Boundary driven.outer/Displacement", "0; 0"}}}),
       50 * std::sin(20 * degree) / 2, 0}};
  for (const Row &row : rows)
  {
    const Scene<2> scene = scene_of(joined({row.bodies,
                                            {{"Contact line/Between", row.between},
                                             given::elastic("210000", "0.3"),
                                             given::steps("hpa3", "9"),
                                             {"Adaptivity/Maximum unknowns", "3500"}}}));
    EXPECT_EQ(scene.pairs[0].slave, row.slave) << row.name;
    EXPECT_TRUE(mentions(scene.remarks, "leaves out")) << row.name;
    double highest = 0, force = 0;
    AdaptiveSolver<2>(scene).run(
        [&](const StepReport<2> &step)
        {
          highest = step.contact.at(0).highest_pressure;
          force = -step.contact[0].normal_resultant;
          EXPECT_LT(step.equilibrium.force_imbalance, 1e-8) << row.name;
        });
    ASSERT_GT(force, 1) << row.name;
    EXPECT_NEAR(highest / hertz_pressure(force, row.R), 1, 0.02) << row.name << " " << force;
  }
}

/** An edge that hangs over counts by its radius, in a body of any size: 1/cos 13 degrees - 1 = 0.026 of it is far, 1/cos 10 degrees - 1 = 0.015 near. */
TEST(DrawnPairs, MeasureWhatHangsOverByItsRadius)
{
  for (const double radius : {0.1, 1., 5.})
    for (const auto &[turn, is_far] : {std::make_pair(13, true), {10, false}})
    {
      const auto circle = std::make_shared<const Circle>(Point<2>(), radius);
      std::vector<EdgePath> arcs;
      for (int k = -3; k < 3; ++k)
      {
        const double from = (k * turn - 90) * degree, to = from + turn * degree;
        arcs.push_back({{{circle->point(from), circle->point(to)}}, {circle, from, to}});
      }
      const double end = radius * std::tan(1.5 * turn * degree);
      const std::vector<EdgePath> line{{{{Point<2>(end, -radius), Point<2>(-end, -radius)}}, {}}};
      std::string problem;
      const ProjectedEdges edges =
          edge_projection({{ExactSide(arcs), ExactSide(line)}}, 0, 100, problem);
      EXPECT_EQ(problem.empty(), is_far) << radius << " " << turn << " " << problem;
      EXPECT_EQ(edges.left_out.number, is_far ? 2U : 0U) << radius << " " << turn;
    }
}

/** Of the other side an edge at whose vertex the last one ends, but for digits, takes no part. */
TEST(DrawnPairs, LeaveOutWhatBeginsAtAVertex)
{
  for (const double over : {0., 3e-6, -3e-6, 1e-3})
  {
    const auto edge = [](const double from, const double to) {
      return EdgePath{{{Point<2>(from, 0), Point<2>(to, 0)}}, {}};
    };
    const double vertex = 1 - over;
    const std::vector<EdgePath> slave{edge(0, 1)}, master{edge(vertex, -20), edge(20, vertex)};
    std::string problem;
    const ProjectedEdges edges =
        edge_projection({{ExactSide(slave), ExactSide(master)}}, 0, 100, problem);
    ASSERT_EQ(problem, "") << over;
    EXPECT_EQ(edges.in_pair[1], (std::vector<bool>{true, over > 1e-4})) << over;
  }
}

/** A punch with fillets of radius 1 beside its flat foot, of which each has a pair with one bar; and on a rigid floor, where the gap says what is round. */
TEST(DrawnPairs, PressAFilletBesideAFlatFoot)
{
  std::vector<Point<2>> foot = arc({-4, 1}, 1, {180, 202.5, 225, 247.5, 270}), top;
  for (const double x : {-2., 0., 2.})
    foot.emplace_back(x, 0);
  for (const Point<2> &x : arc({4, 1}, 1, {270, 292.5, 315, 337.5, 360}))
    foot.push_back(x);
  for (unsigned int k = 0; k < foot.size(); ++k)
    top.emplace_back(-4 + k * 2. / 3, 4);
  const std::string round = "fillet", flat = "bottom";
  const std::string file =
      strip("punch", foot, top,
            {round, round, round, round, flat, flat, flat, flat, round, round, round, round});
  const auto force = [](const Overrides &entries)
  {
    const Scene<2> scene = scene_of(joined({entries,
                                            {given::elastic("210000", "0.3"),
                                             given::steps("hpa3", "8"),
                                             {"Adaptivity/Maximum unknowns", "3000"}}}));
    double sum = 0;
    AdaptiveSolver<2>(scene).run(
        [&](const StepReport<2> &step)
        {
          sum = 0;
          for (const ContactState<2> &contact : step.contact)
            sum -= contact.normal_resultant;
        });
    return sum;
  };
  const Overrides of_fillet{{"Contact round/Between", "punch.fillet, bar.top"}},
      of_bottom{{"Contact flat/Between", "punch.bottom, bar.top"}};
  const auto on_a_bar = [&](const Overrides &first, const Overrides &second)
  {
    return joined({{{"Body punch/Shape", "file"},
                    {"Body punch/File", file},
                    {"Boundary punch.fillet/Curve", "circle"},
                    {"Boundary punch.outer/Displacement", "0; -0.02"},
                    {"Body bar/Material", "rigid"},
                    given::elastic("2.1e11", "0.3", "rigid")},
                   bar(120),
                   first,
                   second});
  };
  const double one = force(on_a_bar(of_fillet, of_bottom)),
               other = force(on_a_bar(of_bottom, of_fillet)),
               rigid = force({{"Geometry/Shape", "file"},
                              {"Geometry/File", file},
                              {"Boundary fillet/Curve", "circle"},
                              {"Boundary outer/Displacement", "0; -0.02"},
                              {"Boundary bottom/Contact", "unilateral"},
                              {"Boundary fillet/Contact", "unilateral"},
                              {"Boundary fillet/Contact direction", "0; -1"},
                              {"Boundary fillet/Gap", "1 - sqrt(max(0, 1 - (abs(x) - 4)^2))"}});
  EXPECT_GT(rigid, 1000);
  EXPECT_NEAR(one / rigid, 1, 0.01);
  EXPECT_NEAR(one / other, 1, 1e-6);
}

// ---------------------------------------------------------------- parts of sides

/** The energy of one step on the coarse mesh, and what the sides of its pairs are called. */
struct Told
{
  double energy = 0;
  std::vector<std::string> names;
};

Told told(const Overrides &entries)
{
  const Scene<2> scene =
      scene_of(joined({entries,
                       {{"Adaptivity/Method", "pu"},
                        {"Adaptivity/Start degree", "4"},
                        {"Adaptivity/Maximum steps", "1"},
                        {"Error/Bound", "false"}, // which matches meshes where they touch
                        {"Material/Young's modulus", "10"},
                        {"Material/Poisson's ratio", "0.3"}}}));
  Told result;
  for (const ContactPair &pair : scene.pairs)
    for (const unsigned int part : pair.parts)
      result.names.push_back(scene.boundaries[part].name);
  AdaptiveSolver<2>(scene).run([&](const StepReport<2> &step)
                               { result.energy = step.energies.energy; });
  return result;
}

/** A fork that lies on its side, with one curve above its tines, of which the lower one reaches farther and rises by @p slope. */
std::string fork(const std::string &name, const double slope)
{
  return Drawing{
      {{-1, 0},
       {0, 0},
       {3, 0},
       {-1, 1},
       {0, 1},
       {3, 1 + 3 * slope},
       {-1, 2},
       {0, 2},
       {1.5, 2},
       {-1, 3},
       {0, 3},
       {1.5, 3}},
      {{{0, 1, 4, 3}}, {{1, 2, 5, 4}}, {{3, 4, 7, 6}}, {{6, 7, 10, 9}}, {{7, 8, 11, 10}}},
      {{"base", {{0, 1}}},
       {"base", {{1, 2}}},
       {"tops", {{4, 5}}},
       {"tops", {{9, 10}}},
       {"tops", {{10, 11}}},
       {"rest", {{2, 5}}},
       {"rest", {{4, 7}}},
       {"rest", {{7, 8}}},
       {"rest", {{8, 11}}},
       {"rest", {{0, 3}}},
       {"rest", {{3, 6}}},
       {"rest", {{6, 9}}}}}
      .file(name);
}

/** Pairs of parts are those of whole sides where these say the same: all of it, or a gap that never closes on the rest. */
TEST(DrawnPairs, TakePartsOfSides)
{
  const Overrides blocks{given::block("lower", "3, 1", "6, 2"),
                         given::block("upper", "1, 1", "2, 2", "4, 2"),
                         {"Boundary lower.bottom/Displacement", "0; 0"},
                         {"Boundary upper.top/Displacement", "0.01; -0.05"},
                         {"Contact joint/Friction bound", "0.1"}};
  const Overrides two{given::block("other", "0, 1", "0.75, 2", "2, 2"),
                      {"Boundary other.top/Displacement", "0; -0.1"}};
  const Overrides rings = joined({fitted("unilateral", "pin.outer", 4),
                                  ring_file("pin", 1, angles(2, [] { return 0.; })),
                                  ring_file("sheet", 2, angles(3, [] { return 0.; }))});
  const Overrides whole{{"Contact joint/Between", "upper.bottom, lower.top"}};
  const auto on_fork = [](const double slope)
  {
    return Overrides{{"Body fork/Shape", "file"},
                     {"Body fork/File", fork("fork" + in_digits(slope), slope)},
                     given::block("upper", "0, 3", "3, 4", "2, 1"),
                     {"Boundary fork.base/Displacement", "0; 0"},
                     {"Boundary upper.top/Displacement", "0; -0.05"},
                     {"Contact joint/Slave", "upper.bottom"}};
  };
  const auto part = [](const std::string &name, const std::string &on, const std::string &where) {
    return Overrides{{"Boundary " + name + "/On", on}, {"Boundary " + name + "/Where", where}};
  };
  struct Row
  {
    std::string name;
    Overrides parts, sides;
    std::vector<std::string> names;
  };
  for (const Row &row : std::vector<Row>{
           {"a part as long as what faces it",
            joined({blocks,
                    part("seat", "lower.top", "0.5 - abs(x - 1.5)"),
                    {{"Contact joint/Between", "upper.bottom, seat"}}}),
            joined({blocks, whole}),
            {"upper.bottom", "seat"}},
           {"one that is longer, and loaded beside it",
            joined({blocks,
                    part("deck", "lower.top", "1"),
                    {{"Contact joint/Between", "deck, upper.bottom"},
                     {"Boundary deck/Pressure", "0.1"}}}),
            joined({blocks, whole, {{"Boundary lower.top/Pressure", "0.1"}}}),
            {"deck (joint)", "upper.bottom"}},
           {"half of the master",
            joined({blocks,
                    part("half", "lower.top", "1.5 - x"),
                    {{"Contact joint/Between", "upper.bottom, half"}}}),
            joined({blocks,
                    whole,
                    {{"Contact joint/Gap", "x < 1.5 ? 0 : 1"},
                     {"Contact joint/Friction bound", "x < 1.5 ? 0.1 : 0"}}}),
            {"upper.bottom (joint)", "half (joint)"}},
           {"half of the slave",
            joined(
                {blocks,
                 part("half", "upper.bottom", "x - 1.5"),
                 {{"Contact joint/Between", "half, lower.top"}, {"Contact joint/Slave", "half"}}}),
            joined({blocks,
                    whole,
                    {{"Contact joint/Gap", "x > 1.5 ? 0 : 1"},
                     {"Contact joint/Friction bound", "x > 1.5 ? 0.1 : 0"},
                     {"Contact joint/Slave", "upper.bottom"}}}),
            {"half", "lower.top (joint)"}},
           {"two pieces of it",
            joined({blocks,
                    part("feet", "upper.bottom", "abs(x - 1.5) - 0.25"),
                    {{"Contact joint/Between", "feet, lower.top"}}}),
            joined({blocks,
                    whole,
                    {{"Contact joint/Gap", "abs(x - 1.5) > 0.25 ? 0 : 1"},
                     {"Contact joint/Friction bound", "abs(x - 1.5) > 0.25 ? 0.1 : 0"},
                     {"Contact joint/Slave", "upper.bottom"}}}),
            {"feet", "lower.top (joint)"}},
           {"a slave above a hole",
            joined({blocks,
                    part("banks", "lower.top", "abs(x - 1.5) - 0.25"),
                    {{"Contact joint/Between", "upper.bottom, banks"},
                     {"Contact joint/Slave", "upper.bottom"},
                     {"Body lower/Subdivisions", "12, 2"}}}),
            joined({blocks,
                    whole,
                    {{"Contact joint/Gap", "abs(x - 1.5) > 0.25 ? 0 : 1"},
                     {"Contact joint/Friction bound", "abs(x - 1.5) > 0.25 ? 0.1 : 0"},
                     {"Contact joint/Slave", "upper.bottom"},
                     {"Body lower/Subdivisions", "12, 2"}}}),
            {"upper.bottom (joint)", "banks (joint)"}},
           {"two pairs on one side",
            joined({blocks,
                    two,
                    part("mine", "lower.top", "x - 0.8"),
                    part("yours", "lower.top", "0.8 - x"),
                    {{"Contact joint/Between", "upper.bottom, mine"},
                     {"Contact again/Between", "yours, other.bottom"}}}),
            joined({blocks,
                    two,
                    whole,
                    {{"Body lower/Subdivisions", "6, 2"},
                     {"Boundary cut/On", "lower.top"},
                     {"Boundary cut/Where", "0.025 - abs(x - 0.775)"},
                     {"Contact again/Between", "lower.top, other.bottom"}}}),
            {"upper.bottom", "mine (joint)", "yours (again)", "other.bottom"}},
           {"a tine before another one",
            joined({on_fork(0),
                    part("near", "fork.tops", "y - 2.5"),
                    {{"Contact joint/Between", "upper.bottom, near"}}}),
            joined({on_fork(0), {{"Contact joint/Between", "upper.bottom, fork.tops"}}}),
            {"upper.bottom (joint)", "near (joint)"}},
           {"a tine before one that is askew",
            joined({on_fork(0.1),
                    part("near", "fork.tops", "y - 2.5"),
                    {{"Contact joint/Between", "upper.bottom, near"}}}),
            joined({on_fork(0.1), {{"Contact joint/Between", "upper.bottom, fork.tops"}}}),
            {"upper.bottom (joint)", "near (joint)"}},
           {"two arcs of a roller",
            joined({half_disc("roller", "0, 5", 5, 180),
                    bar(20),
                    part("foot", "roller.arc", "3.53 - abs(x)"),
                    {{"Boundary roller.flat/Displacement", "0; -0.1"},
                     {"Contact line/Between", "foot, bar.top"}}}),
            joined({half_disc("roller", "0, 5", 5, 180),
                    bar(20),
                    {{"Boundary roller.flat/Displacement", "0; -0.1"},
                     {"Contact line/Between", "roller.arc, bar.top"}}}),
            {"foot", "bar.top (line)"}},
           {"an arc of a drawn pin",
            joined({rings,
                    part("low", "pin.outer", "x - y"),
                    {{"Contact fit/Between", "low, sheet.inner"}, {"Contact fit/Slave", "low"}}}),
            joined({rings, {{"Contact fit/Gap", "y < x ? 0 : 1"}}}),
            {"low", "sheet.inner (fit)"}}})
  {
    const Told parts = told(row.parts), sides = told(row.sides);
    EXPECT_GT(std::abs(sides.energy), 1e-5) << row.name; // that of the fit is negative: loads alone
    EXPECT_NEAR(parts.energy / sides.energy, 1, 1e-9) << row.name;
    EXPECT_EQ(parts.names, row.names) << row.name;
  }
}

/** Between = automatic finds what the scenes of prm/ name, one pair after the other; the section stands for all of several. */
TEST(DrawnPairs, AreFoundWhereSidesLieOnEachOther)
{
  struct Row
  {
    std::string scene, pair;
    Overrides more;
    std::vector<std::string> sides; ///< none: those that the file names
  };
  const auto sides_in = [](const std::string &text)
  {
    const std::vector<std::string> sides = Utilities::split_string_list(text, ',');
    return std::set<std::string>(sides.begin(), sides.end());
  };
  const Overrides three{given::block("lower", "6, 1", "6, 2"),
                        given::block("upper", "1, 1", "2, 2", "4, 2"),
                        given::block("third", "3, 1.001", "4, 2", "4, 2"),
                        {"Boundary lower.bottom/Displacement", "0; 0"},
                        {"Boundary upper.top/Displacement", "0; -0.1"},
                        {"Boundary third.top/Displacement", "0; -0.1"}};
  for (const Row &row : {Row{"blocks", "joint", {}, {}},
                         {"bush", "fit", {}, {}},
                         {"jaws", "left", {}, {}},
                         {"jaws", "right", {}, {}},
                         {"lug", "seat", {}, {}},
                         {"shrink-fit", "fit", {}, {}},
                         {"ssnp154", "line", {}, {}},
                         {"stack", "lower joint", {}, {}},
                         {"", "joint", three, {"lower.top, upper.bottom"}},
                         {"",
                          "joint",
                          joined({three, {{"Contact joint/Closed within", "0.01"}}}),
                          {"lower.top, upper.bottom", "lower.top, third.bottom"}}})
  {
    const std::string file = row.scene.empty() ? "" : "prm/" + row.scene + ".prm",
                      section = "Contact " + row.pair;
    Overrides entries{{section + "/Between", "automatic"}};
    entries.insert(entries.end(), row.more.begin(), row.more.end());
    const auto found = read_scene<2>(ParameterFile(file, entries));
    std::set<std::set<std::string>> pairs, expected;
    if (row.sides.empty())
      expected.insert(
          sides_in(read_scene<2>(ParameterFile(file)).parameters->text(section, "Between")));
    for (const std::string &sides : row.sides)
      expected.insert(sides_in(sides));
    for (const std::string &own : found.parameters->sections_with("Between"))
      if (own.compare(0, section.size(), section) == 0)
        pairs.insert(sides_in(found.parameters->text(own, "Between")));
    EXPECT_EQ(pairs, expected) << row.scene << " " << row.pair;
    EXPECT_NE(found.remarks.back().find("subsection " + section), std::string::npos) << row.scene;
  }
}
} // namespace
