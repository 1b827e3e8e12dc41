// SPDX-License-Identifier: LGPL-2.1-or-later
// Pictures of scenes: parts of boundaries on any mesh, materials, texts that find room.
#include <gtest/gtest.h>
#include <hpvi/output/chart.h>
#include <hpvi/output/drawing.h>
#include <hpvi/output/outline_part.h>
#include <hpvi/output/scene_picture.h>
#include <hpvi/output/scene_words.h>

#include <deal.II/grid/grid_generator.h>

#include <algorithm>
#include <regex>
#include <sstream>

using namespace dealii;
using namespace hpvi;

namespace
{
unsigned int count(const std::string &text, const std::string &what)
{
  const std::regex pattern(what);
  return std::distance(std::sregex_iterator(text.begin(), text.end(), pattern),
                       std::sregex_iterator());
}

/** The unit square of 4 x 4 cells whose lower side is free but for its first and last edges, which are boundary 4. */
void make_square(Triangulation<2> &mesh)
{
  GridGenerator::subdivided_hyper_rectangle(mesh, {4, 4}, Point<2>(0, 0), Point<2>(1, 1), true);
  for (const auto &cell : mesh.active_cell_iterators())
    for (const unsigned int number : cell->face_indices())
      if (const auto face = cell->face(number); cell->at_boundary(number) &&
                                                face->center()[1] == 0 &&
                                                std::abs(face->center()[0] - 0.5) > 0.3)
        face->set_boundary_id(4);
}
} // namespace

TEST(BoundaryParts, EdgesOfOneNameNeedNotHangTogether)
{
  Triangulation<2> mesh;
  make_square(mesh);
  std::vector<double> lengths(5);
  std::vector<unsigned int> n_parts(5);
  for (const OutlinePart &part : boundary_parts(mesh))
  {
    lengths[part.boundary] += part.length();
    ++n_parts[part.boundary];
  }
  EXPECT_EQ(n_parts, (std::vector<unsigned int>{1, 1, 1, 1, 2}));
  EXPECT_EQ(lengths, (std::vector<double>{1., 1., 0.5, 1., 0.5}));
}

TEST(BoundaryParts, NormalsPointOutwards)
{
  Triangulation<2> mesh;
  GridGenerator::parallelogram(mesh, {Point<2>(2., 1.), Point<2>(-1., 2.)});
  mesh.refine_global(2);
  for (const OutlinePart &part : boundary_parts(mesh))
  {
    const OutlinePlace place = part.at(0.3 * part.length());
    EXPECT_GT(place.normal * (place.x - Point<2>(0.5, 1.5)), 0.);
    EXPECT_NEAR(place.normal.norm(), 1., 1e-14);
  }
  EXPECT_EQ(boundary_parts(mesh).size(), 4u); // of one number, cut at corners
}

TEST(BoundaryParts, ARoundHoleIsOnePart)
{
  Triangulation<2> mesh;
  GridGenerator::hyper_cube_with_cylindrical_hole(mesh, 0.3, 1.);
  mesh.refine_global(2);
  unsigned int n_closed = 0;
  for (const OutlinePart &part : boundary_parts(mesh))
    if (part.points().front().distance(part.points().back()) < 1e-12)
    {
      ++n_closed;
      EXPECT_LT(part.at(0.1).normal * (part.at(0.1).x - Point<2>()), 0.); // into the hole
    }
  EXPECT_EQ(n_closed, 1u);
}

TEST(ScenePicture, MaterialsHaveColoursAndAKey)
{
  Scene<2> scene;
  scene.stress_unit = "MPa";
  scene.geometry.subdivisions = {{2, 2}};
  scene.materials = {{10., 0.2, PlaneModel::strain}, {70., 0.3, PlaneModel::strain}};
  scene.material_at = [](const Point<2> &x) { return x[1] > 0.5; };
  const std::string picture = scene_picture(scene);
  const std::string first = "fill=\"#e6edf5\"", second = "fill=\"#f6d9a8\"";
  EXPECT_EQ(count(picture, "class=\"cell\" " + first), 2u);
  EXPECT_EQ(count(picture, "class=\"cell\" " + second), 2u);
  EXPECT_EQ(count(picture, first), 3u); // with the key
  EXPECT_EQ(count(picture, "Young's modulus 70 MPa, Poisson's ratio 0.3, plane strain<"), 1u);
}

/** A cross in each cell, whose longer line lies along axis 1; y of a page points down. */
TEST(ScenePicture, OrthotropicMaterialsShowTheirAxes)
{
  Scene<2> scene;
  scene.stress_unit = "MPa";
  scene.geometry.subdivisions = {{2, 2}};
  Material fibres{1., 0.3, PlaneModel::stress};
  fibres.orthotropy = Orthotropy{{{70, 10, 1}}, {{0.2, 0, 0}}, 5, 90};
  scene.materials = {{10., 0.2, PlaneModel::stress}, fibres};
  scene.material_at = [](const Point<2> &x) { return x[1] > 0.5; };
  const std::string picture = scene_picture(scene);
  EXPECT_EQ(count(picture, "E1 = 70, E2 = 10, G12 = 5 MPa, nu12 = 0.2, axis 1 at 90 degrees, "
                           "plane stress<"),
            1u);
  const std::size_t begin = picture.find("axes-of-materials");
  ASSERT_NE(begin, std::string::npos);
  const std::string crosses = picture.substr(begin, picture.find("</g>", begin) - begin);
  EXPECT_EQ(count(crosses, "stroke-width=\"1.4\""), 2u);
  EXPECT_EQ(count(crosses, ">1<"), 1u);
  EXPECT_EQ(count(crosses, "M120 -340L120 -380"), 1u) << crosses;
}

TEST(ScenePicture, AnyExpressionOfCode)
{
  Scene<2> scene;
  scene.boundary("right").traction = {{expression<2>(2.), nullptr}};
  scene.boundary("top").displacement = {{nullptr, expression<2>(0.)}};
  const std::string picture = scene_picture(scene);
  EXPECT_EQ(count(picture, "class=\"traction\" data-boundary=\"right\""), 1u);
  EXPECT_EQ(count(picture, "class=\"support\""), 1u);
}

TEST(Drawing, NotesDoNotOverlap)
{
  Drawing drawing;
  for (unsigned int k = 0; k < 12; ++k)
    drawing.add({{0., 0.}, PageVector({0., -1.}), 20., {{"the same place"}}, "note", ""});
  drawing.write_notes();
  EXPECT_GE(drawing.extent().height(), 12 * Drawing::font_size);
}

/** Points on straight lines are left out; those of a gentle curve, each of which is between its neighbours, are not all. */
TEST(Drawing, LinesFollowTheirPoints)
{
  const auto corners = [](const double curvature)
  {
    std::vector<PagePoint> points;
    for (unsigned int k = 0; k < 200; ++k)
      points.emplace_back(k, curvature * k * k);
    Drawing drawing;
    drawing.line(points, "");
    std::string d = drawing.svg("");
    d = d.substr(d.find("d=\"M") + 4);
    d = d.substr(0, d.find('"'));
    std::replace(d.begin(), d.end(), 'L', ' ');
    std::istringstream in(d);
    std::vector<PagePoint> result;
    for (PagePoint corner; in >> corner[0] >> corner[1];)
      result.push_back(corner);
    return result;
  };
  EXPECT_EQ(corners(0).size(), 2u);
  const double curvature = 1e-3;
  const std::vector<PagePoint> line = corners(curvature);
  EXPECT_LT(line.size(), 50u);
  for (std::size_t k = 1; k < line.size(); ++k) // a chord of this length is so far from its arc
    EXPECT_LT(curvature * std::pow(line[k][0] - line[k - 1][0], 2) / 4, 0.03);
}

/** An axis with one number cannot be read, and one with many neither. */
TEST(Chart, LogarithmicAxesHaveSomeNumbers)
{
  for (const double low : {0.3, 0.1, 0.022, 0.011, 1e-3, 1e-5, 1e-12, 1e-30})
  {
    Chart chart;
    chart.is_logarithmic = true;
    chart.lines = {{"", "#000", "", true, {{{0., 0.44}}, {{1., low}}}}};
    const unsigned int n = count(chart.svg(), "text-anchor=\"end\"");
    EXPECT_GE(n, 2u) << low;
    EXPECT_LE(n, 10u) << low;
  }
}

/** Resultants are in stress times area: the label of stress says it where it divides by that of length. */
TEST(SceneWords, ForcesOfPlatesHaveUnits)
{
  Scene<2> scene;
  BoundaryCondition<2> &top = scene.boundary("top");
  top.plate = RigidPlate<2>();
  top.plate->force = {{20000, 0, 1.5}};
  const auto words = [&](const std::string &stress, const std::string &length)
  {
    scene.stress_unit = stress;
    scene.length_unit = length;
    std::string line;
    for (const std::string &phrase : support_phrases<2>(scene, top, {Point<2>(0, 1)}))
      line += phrase + "; ";
    return line;
  };
  EXPECT_EQ(words("N/mm^2", "mm"), "rigid plate; Fx = 20000 N; uy free; moment = 1.5 N mm; ");
  EXPECT_EQ(words("MPa", "m"), "rigid plate; Fx = 20000 MN; uy free; moment = 1.5 MN m; ");
  EXPECT_EQ(words("bar", "m"), "rigid plate; Fx = 20000 bar m^2; uy free; moment = 1.5 bar m^3; ");
  EXPECT_EQ(words("MPa", "1"), "rigid plate; Fx = 20000; uy free; moment = 1.5; ");
}

TEST(SceneWords, RangesAndUnits)
{
  EXPECT_EQ(range_in_words({1., 1. + 1e-12}, "mm"), "1 mm");
  EXPECT_EQ(range_in_words({-0.5, 0., 0.25}, "mm"), "-0.5 to 0.25 mm");
  EXPECT_EQ(range_in_words({1e-20, 2.}, "1"), "0 to 2");
  EXPECT_EQ(range_in_words({1.00001, 1.00002}, ""), "1.00001 to 1.00002");
}
