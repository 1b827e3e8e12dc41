// SPDX-License-Identifier: LGPL-2.1-or-later
#include "../texts.h"
#include "mesh_texts.h"

#include <hpvi/base/input_error.h>
#include <hpvi/reader/gmsh/quadratic_edge.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace dealii;
using namespace hpvi;

namespace
{
double signed_area(const CoarseMesh &mesh, const CoarseMesh::Cell &cell)
{
  double result = 0;
  for (unsigned int k = 0; k < 4; ++k)
  {
    const Point<2> &x = mesh.vertices[cell.vertices[k]],
                   &y = mesh.vertices[cell.vertices[(k + 1) % 4]];
    result += 0.5 * (x[0] * y[1] - x[1] * y[0]);
  }
  return result;
}

/** Of what the boundary surrounds, which is to its left. */
double enclosed_area(const CoarseMesh &mesh)
{
  double result = 0;
  for (const CoarseMesh::Edge &edge : mesh.edges)
    if (edge.boundary != CoarseMesh::inside)
    {
      const Point<2> &x = mesh.vertices[edge.vertices[0]], &y = mesh.vertices[edge.vertices[1]];
      result += 0.5 * (x[0] * y[1] - x[1] * y[0]);
    }
  return result;
}

std::vector<unsigned int> edges_by_boundary(const CoarseMesh &mesh)
{
  std::vector<unsigned int> result(mesh.boundaries.size(), 0);
  for (const CoarseMesh::Edge &edge : mesh.edges)
    if (edge.boundary != CoarseMesh::inside)
      ++result[edge.boundary];
  return result;
}

void expect_two_squares(const CoarseMesh &mesh)
{
  using Names = std::vector<std::string>;
  ASSERT_EQ(mesh.vertices.size(), 6); // the seventh is in no cell
  ASSERT_EQ(mesh.cells.size(), 2);
  EXPECT_EQ(mesh.surfaces, (Names{"soft part", "stiff"}));
  EXPECT_EQ(mesh.boundaries, (Names{"bottom", "7", ""}));
  EXPECT_EQ(mesh.interfaces, Names{"joint"});
  EXPECT_EQ(edges_by_boundary(mesh), (std::vector<unsigned int>{2, 1, 3}));
  EXPECT_EQ(mesh.cells[0].surface, 0);
  EXPECT_EQ(mesh.cells[1].surface, 1);
  for (const CoarseMesh::Cell &cell : mesh.cells) // the second is clockwise in the file
    EXPECT_EQ(signed_area(mesh, cell), 1);
  EXPECT_EQ(enclosed_area(mesh), 2);
  ASSERT_EQ(mesh.edges.size(), 7);
  const CoarseMesh::Edge &joint = mesh.edges.back();
  EXPECT_EQ(joint.boundary, CoarseMesh::inside);
  EXPECT_EQ(joint.interface, 0);
  EXPECT_EQ(mesh.vertices[joint.vertices[0]], Point<2>(1, 0)); // counterclockwise around soft
  EXPECT_EQ(mesh.vertices[joint.vertices[1]], Point<2>(1, 1));
  for (unsigned int k = 0; k + 1 < 6; ++k)
    EXPECT_EQ(mesh.edges[k].vertices[1], mesh.edges[k + 1].vertices[0]) << "loops are in order";
  EXPECT_EQ(mesh.edges[5].vertices[1], mesh.edges[0].vertices[0]);
}

bool equal(const CoarseMesh &one, const CoarseMesh &two)
{
  return one.vertices == two.vertices && one.boundaries == two.boundaries &&
         one.interfaces == two.interfaces && one.surfaces == two.surfaces &&
         std::equal(one.edges.begin(), one.edges.end(), two.edges.begin(), two.edges.end(),
                    [](const CoarseMesh::Edge &e, const CoarseMesh::Edge &f)
                    {
                      return e.vertices == f.vertices && e.boundary == f.boundary &&
                             e.interface == f.interface && bool(e.curve) == bool(f.curve);
                    });
}
} // namespace

TEST(MeshFile, ReadsCellsBoundariesAndNames)
{
  expect_two_squares(read_text(two_squares_22));
  expect_two_squares(read_text(two_squares_40));
  expect_two_squares(read_text(two_squares_41));
  EXPECT_TRUE(equal(read_text(two_squares_22), read_text(two_squares_41)));
  EXPECT_TRUE(equal(read_text(two_squares_22), read_text(two_squares_40)));
}

TEST(MeshFile, TakesOtherLineEndsAndSections)
{
  for (const std::string &text : {two_squares_22, two_squares_41})
  {
    expect_two_squares(read_text(replaced_all(text, "\n", "\r\n")));
    EXPECT_TRUE(says(message_of("\xEF\xBB\xBF" + text), "does not begin like one"));
    expect_two_squares(read_text("$Comments\nsee there\n$EndComments\n" + text));
    expect_two_squares(
        read_text(text + "$NodeData\n1\n\"u\"\n1\n0\n3\n0\n1\n1\n5 2.5\n$EndNodeData\n"));
  }
}

TEST(MeshFile, ReadsEdgesOfSecondOrder)
{
  for (const std::string &text : {curved_cell_22, curved_cell_41})
  {
    const CoarseMesh mesh = read_text(text);
    ASSERT_EQ(mesh.edges.size(), 4);
    EXPECT_EQ(mesh.vertices.size(), 4);
    for (const CoarseMesh::Edge &edge : mesh.edges)
    {
      const bool is_bottom = mesh.boundaries[edge.boundary] == "bottom";
      ASSERT_EQ(bool(edge.curve), is_bottom) << "the others are straight";
      if (!is_bottom)
        continue;
      const CurvePiece &piece = edge.curve;
      EXPECT_LT(piece.curve->point(piece.from).distance(mesh.vertices[edge.vertices[0]]), 1e-15);
      EXPECT_LT(piece.curve->point(piece.to).distance(mesh.vertices[edge.vertices[1]]), 1e-15);
      EXPECT_LT(piece.curve->point(0.5 * (piece.from + piece.to)).distance(Point<2>(1, -0.25)),
                1e-15);
    }
  }
}

TEST(QuadraticEdge, HasDerivativeAndNearestPoint)
{
  const QuadraticEdge edge({0, 0}, {1.1, 0.7}, {2, -0.1});
  for (double t = -0.25; t < 1.3; t += 0.125)
  {
    const double h = 1e-5;
    const Tensor<1, 2> difference = (edge.point(t + h) - edge.point(t - h)) / (2 * h);
    EXPECT_LT((difference - edge.derivative(t)).norm(), 1e-9);
  }
  for (const Point<2> &x :
       {Point<2>(0.3, 0.9), Point<2>(1, 0.1), Point<2>(-1, -1), Point<2>(1.2, -4)})
    for (const auto &[from, to] : {std::pair{0., 1.}, {1., 0.}, {0.3, 0.6}})
    {
      const double t = edge.nearest(x, from, to);
      EXPECT_GE(t, std::min(from, to));
      EXPECT_LE(t, std::max(from, to));
      for (unsigned int k = 0; k <= 1000; ++k)
        EXPECT_LE(edge.point(t).distance(x),
                  edge.point(from + k / 1000. * (to - from)).distance(x) + 1e-14);
    }
  EXPECT_NEAR(QuadraticEdge({0, 0}, {1, 0.5}, {2, 0}).bow(), 0.25, 1e-15);
  EXPECT_TRUE(QuadraticEdge({0, 0}, {1.4, 0.7}, {2, 0}).is_regular());
  EXPECT_FALSE(QuadraticEdge({0, 0}, {1.5, 0.7}, {2, 0}).is_regular());
}

namespace
{
/** A file that is wrong in one place, and what its message says. */
struct Flaw
{
  std::string name, text, message;
};

/** The mesh of two squares in format 2.2 with something else in one place. */
Flaw flaw(const std::string &name, const std::string &from, const std::string &to,
          const std::string &message)
{
  return {name, replaced(two_squares_22, from, to), message};
}

Flaw flaw_41(const std::string &name, const std::string &from, const std::string &to,
             const std::string &message)
{
  return {name, replaced(two_squares_41, from, to), message};
}

std::vector<Flaw> flaws_of_elements()
{
  return {
      flaw("triangle", "5 3 2 1 1 1 2 5 4", "5 2 2 1 1 1 2 5",
           ""), // which is cut
      flaw("hexahedron", "5 3 2 1 1 1 2 5 4", "5 5 2 1 1 1 2 5 4 1 2 3 4", "has hexahedra (1)"),
      flaw("tetrahedra", "5 3 2 1 1 1 2 5 4", "5 4 2 1 1 1 2 5 4", "set Dimension = 3"),
      flaw("type", "5 3 2 1 1 1 2 5 4", "5 999 2 1 1 1 2 5 4", "cannot be read"),
      flaw("no surface", "5 3 2 1 1", "5 3 2 0 1",
           ": element 5: 1 of 2 cells are in no physical surface, the first about (0.5, 0.5); give "
           "each"),
      flaw("loose line", "4 1 2 7 3 3 6", "4 1 2 7 3 3 4",
           ": element 4: the physical curve \"7\" has 1 edge of no cell, the first from (2, 0) to "
           "(0, 1); "
           "let"),
      flaw("inside and outside", "4 1 2 7 3 3 6", "4 1 2 4 3 3 6",
           "the physical curve \"joint\" has 1 edge on the boundary and 1 between two cells, the "
           "first "
           "of these from (1, 0) to (1, 1)"),
      flaw("same cell", "4 1 2 7 3 3 6", "4 3 2 1 1 5 4 1 2",
           "element 5: the cell with the edge from (1, 1) to (0, 1) is there already, the other is "
           "element 4; write"),
      flaw("three cells", "4 1 2 7 3 3 6", "4 3 2 1 1 2 7 8 5",
           "three cells have the edge from (1, 1) to (1, 0)"),
      flaw("same side", "5 3 2 1 1 1 2 5 4", "5 3 2 1 1 2 7 8 5",
           "two cells lie on the same side of the edge from (1, 1) to (1, 0), the other is element "
           "5: the mesh is folded, or surfaces overlap"),
      flaw("point", "4 1 2 7 3 3 6", "4 3 2 1 1 6 13 14 15",
           "cells touch each other at the point (2, 1) alone"),
      flaw("hanging", "5 3 2 1 1 1 2 5 4", "5 3 2 1 1 1 16 17 4",
           "the node at (1, 0.5) hangs on the edge from (1, 1) to (1, 0) of another cell"),
      flaw("node twice", "5 3 2 1 1 1 2 5 4", "5 3 2 1 1 1 2 5 2", "has the node 2 twice"),
  };
}

std::vector<Flaw> flaws_of_places()
{
  return {
      flaw("z", "\n5 1 1 0\n", "\n5 1 1 0.5\n",
           ": element 5: the node 5 at (1, 1, 0.5) is not in the plane z = 0"),
      flaw("one place", "\n16 1 0.5 0\n", "\n16 1 1e-14 0\n", ""),
      {"duplicate",
       replaced(replaced(two_squares_22, "\n16 1 0.5 0\n", "\n16 1 1e-14 0\n"), "5 3 2 1 1 1 2 5 4",
                "5 3 2 1 1 1 16 5 4"),
       "the nodes 16 and 2 are both at (1, 1e-14)"},
      flaw("straight corner", "\n4 0 1 0\n", "\n4 0 -1 0\n", "degrees at"),
      flaw("no angle", "\n4 0 1 0\n", "\n4 0.5 0.5 0\n",
           "the cell has a corner of 180 degrees at (0.5, 0.5)"),
      flaw("crossed", "5 3 2 1 1 1 2 5 4", "5 3 2 1 1 1 5 2 4", "the cell has a corner of"),
      flaw("large", "\n3 2 0 0\n", "\n3 1e200 0 0\n", "lengths must lie between 1e-100 and 1e100"),
      flaw("not finite", "\n3 2 0 0\n", "\n3 nan 0 0\n",
           "has the node 3 at a place that is no finite number"),
      flaw("infinite", "\n3 2 0 0\n", "\n3 1e999 0 0\n",
           "has the node 3 at a place that is no finite number"),
      flaw("no number", "\n3 2 0 0\n", "\n3 2,5 0 0\n", "cannot be read"),
      {"middle", replaced(curved_cell_22, "\n5 1 -0.25 0\n", "\n5 1.6 -0.25 0\n"),
       "the edge from (0, 0) to (2, 0) is on a curve that turns back"},
      {"middle in space", replaced(curved_cell_22, "\n5 1 -0.25 0\n", "\n5 1 -0.25 1\n"),
       "has the node 5 inside an edge, and outside of the plane"},
      {"second middle", replaced(curved_cell_22, "1 8 2 1 1 1 2 5", "1 8 2 1 1 1 2 6"),
       "has other nodes on the edge between the nodes 1 and 2 in one element than in another"},
  };
}

std::vector<Flaw> flaws_of_names()
{
  return {
      flaw("name", "\"bottom\"", "\"bot/tom\"",
           "the physical curve \"bot/tom\" has no name for a scene; take letters, digits, '_', '-' "
           "and "
           "single blanks"),
      flaw("utf", "\"bottom\"",
           "\"b\xC3\xB6"
           "den\"",
           "the physical curve \"b\xC3\xB6"
           "den\" has no name"),
      flaw("blanks", "\"soft part\"", "\"soft  part\"", "has no name for a scene"),
      flaw("case", "\"stiff\"", "\"Soft Part\"",
           "the physical groups 1 and 2 are called surface \"soft part\" "
           "and surface \"Soft Part\""),
      flaw("same", "1 4 \"joint\"", "1 7 \"Bottom\"", "in case alone"),
  };
}

std::vector<Flaw> flaws_of_files()
{
  const std::string head = "$MeshFormat\n", unknown = "is no drawing (.step, .iges, .brep, .geo)",
                    damaged = "cannot be read or meshed";
  return {
      {"empty", "", "is empty"},
      {"blank", " \r\n\n", unknown},
      {"text", "subsection Geometry\n", unknown},
      {"no format", "$MeshFormat", damaged},
      {"bytes", head + "4.1 1 8\n\1\0\0\0\n$EndMeshFormat\n", damaged},
      {"old", head + "1 0 8\n$EndMeshFormat\n", "has no cells in the plane"},
      {"nothing", head + "2.2 0 8\n$EndMeshFormat\n", "has no cells"},
      {"no cells",
       head + "2.2 0 8\n$EndMeshFormat\n$Nodes\n0\n$EndNodes\n$Elements\n0\n$EndElements\n",
       "has no cells"},
      {"cut", two_squares_22.substr(0, two_squares_22.size() - 20), damaged},
      flaw("no end", "$EndNodes\n", "", ""),
      flaw("no beginning", "$Nodes\n", "", damaged),
      {"repeated", two_squares_22 + "$Nodes\n0\n$EndNodes\n",
       "has an element with a node 1 that is not there"},
      flaw("huge", "$Nodes\n17\n", "$Nodes\n999999999999\n", damaged),
      flaw("negative", "$Nodes\n17\n", "$Nodes\n-1\n", damaged),
      flaw("too few", "$Nodes\n17\n", "$Nodes\n16\n", ""),
      flaw("same tag", "\n4 0 1 0\n", "\n5 0 1 0\n", damaged),
      flaw("short", "\n4 0 1 0\n", "\n4 0 1\n", damaged),
      flaw("no node", "5 3 2 1 1 1 2 5 4", "5 3 2 1 1 1 2 5 40", damaged),
      flaw("numbers", "5 3 2 1 1 1 2 5 4", "5 3 2 1 1 1 2 5", "are both at"),
      flaw("tags", "5 3 2 1 1 1 2 5 4", "5 3 90 1 1 1 2 5 4", damaged),
      flaw_41("entity", "2 2 3 1\n", "2 5 3 1\n", damaged),
      flaw_41("kind", "2 2 3 1\n", "1 2 3 1\n", damaged),
      flaw_41("blocks", "6 6 1 6\n", "7 6 1 6\n", damaged),
      flaw_41("sum", "6 6 1 6\n", "6 7 1 7\n", ""),
      flaw_41("all nodes", "1 17 1 17\n", "1 18 1 18\n", ""),
      flaw_41("entities", "0 4 2 0\n", "0 4 2 1\n", damaged),
      flaw_41("groups", "2 1 0 0 2 0 0 1 3 2 2 -3", "2 1 0 0 2 0 0 9 3 2 2 -3", damaged),
      flaw_41("same entity", "2 1 0 0 2 0 0 1 3 2 2 -3", "1 1 0 0 2 0 0 1 3 2 2 -3", damaged),
  };
}

void expect_refused(const std::vector<Flaw> &flaws)
{
  for (const Flaw &one : flaws)
  {
    const std::string message = message_of(one.text);
    if (one.message.empty()) // wrong in what is not used
      EXPECT_EQ(message, "") << one.name;
    else
      EXPECT_NE(message.find(one.message), std::string::npos) << one.name << ": " << message;
    EXPECT_EQ(message.find_first_of("\n\r"), std::string::npos) << one.name;
  }
}
} // namespace

TEST(MeshFile, RefusesElements)
{
  expect_refused(flaws_of_elements());
}

/** A corner of more than 180 degrees is no flaw: its cell is cut along the diagonal from there, and all others with it. */
TEST(MeshFile, CutsConcaveCells)
{
  const CoarseMesh mesh = read_text(replaced(two_squares_22, "\n4 0 1 0\n", "\n4 0.8 0.1 0\n"));
  EXPECT_EQ(mesh.cells.size(), 10);
  const auto tells = [](const std::string &remark)
  { return remark.find("1 cell with a corner of 180 degrees or more") != std::string::npos; };
  EXPECT_TRUE(std::any_of(mesh.remarks.begin(), mesh.remarks.end(), tells));
}

/** A curve in two groups is in the smaller one, of equal ones in the first; two groups of one name are one. */
TEST(MeshFile, TakesTheSmallerOfTwoGroups)
{
  const auto boundaries = [](const std::string &text) { return read_text(text).boundaries; };
  const std::vector<std::string> plain = boundaries(two_squares_41);
  EXPECT_EQ(boundaries(
                replaced(two_squares_41, "2 1 0 0 2 0 0 1 3 2 2 -3", "2 1 0 0 2 0 0 2 3 7 2 2 -3")),
            plain);
  EXPECT_EQ(
      read_text(replaced(two_squares_41, "1 0 0 0 1 1 0 1 1 0", "1 0 0 0 1 1 0 2 1 2 0")).surfaces,
      read_text(two_squares_41).surfaces);
  // Two edges of group 3 and one of 7: the first edge of 3 is in both.
  EXPECT_EQ(boundaries(replaced(two_squares_22, "4 1 2 7 3 3 6", "4 1 2 7 3 1 2")), plain);
  EXPECT_EQ(boundaries(replaced(two_squares_22, "\"bottom\"", "\"the_bottom\""))[0], "the_bottom");
  // Groups are those of elements, also where programs give all to one surface of the drawing.
  EXPECT_EQ(read_text(replaced(two_squares_22, "6 3 2 2 2", "6 3 2 2 1")).surfaces,
            read_text(two_squares_22).surfaces);
  // The soft cell is in both surfaces, of which that has one cell, and the other two.
  const CoarseMesh both = read_text(
      replaced(replaced(two_squares_22, "4 1 2 7 3 3 6", "4 1 2 7 3 3 6\n7 3 2 2 1 1 2 5 4"),
               "$Elements\n6\n", "$Elements\n7\n"));
  EXPECT_EQ(both.surfaces, read_text(two_squares_22).surfaces);
  EXPECT_EQ(both.cells.size(), 2);
}

TEST(MeshFile, RefusesPlaces)
{
  expect_refused(flaws_of_places());
}

TEST(MeshFile, RefusesNames)
{
  expect_refused(flaws_of_names());
}

TEST(MeshFile, RefusesFiles)
{
  expect_refused(flaws_of_files());
  for (const auto &[path, message] :
       {std::pair<std::string, std::string>{"no such file.msh",
                                            "no such file.msh: cannot be read; check the name"},
        {"tests", "tests: is a directory; name a drawing or a mesh"},
        {"/dev/zero", "/dev/zero: cannot be read"}})
    EXPECT_EQ(failure_of<InputError>([&, path = path] { read_mesh_file(path); }).find(message), 0)
        << path;
}
