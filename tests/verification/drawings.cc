// SPDX-License-Identifier: LGPL-2.1-or-later
// Drawings of CAD and meshes of other programs: each is drawn here by a script of Gmsh, saved in many formats, and read again.
#include "drawing_files.h"

#include <hpvi/reader/gmsh/hexahedral_file.h>
#include <hpvi/scene/hexahedral_mesh.h>

#include <deal.II/opencascade/utilities.h>

#include <algorithm>
#include <cmath>

namespace
{
using namespace drawings;

/** Files of one ring: what they tell, how near their area is, and how many boundaries they have. */
TEST(Drawings, AreReadInEveryFormat)
{
  const Folder folder;
  const std::string groups = "Physical Surface(\"body\") = {5}; Physical Curve(\"inner\") = {4};\n"
                             "Physical Curve(\"rest\") = {1, 2, 3};\n";
  const std::string mesh = "Mesh.RecombineAll = 1; Mesh.RecombinationAlgorithm = 3; Mesh 2;\n";
  folder.draw(ring + saved({"ring.step", "ring.brep"}));
  folder.draw(ring + mesh + "Mesh.SaveAll = 1;\n" +
              saved({"all.msh", "all.unv", "all.vtk", "all.bdf"}));
  folder.draw(ring + groups + mesh + saved({"groups.msh", "groups.unv"}) +
              "Mesh.MshFileVersion = 2.2;\n" + saved({"old.msh"}) + "Mesh.Binary = 1;\n" +
              saved({"old-bytes.msh"}) + "Mesh.MshFileVersion = 4.1;\n" + saved({"bytes.msh"}));
  folder.draw(ring + groups + "Mesh 2; SetOrder 3; Mesh.Binary = 1;\n" + saved({"cubic.msh"}));
  folder.draw(ring + groups + "Mesh 2; SetOrder 2;\n" + saved({"quadratic.msh"}));
  folder.draw(ring + groups + "Mesh 2; SetOrder 9;\n" + saved({"ninth.msh"}));
  folder.draw(ring + groups + "Mesh 2;\n" + saved({"triangles.msh"}));
  folder.draw(ring + groups + mesh + "PartitionMesh 3;\n" + saved({"parts.msh"}));
  folder.write("script.geo", ring);
  struct Row
  {
    std::string file, origin;
    double off; ///< of the area, relative
    std::size_t n_boundaries;
  };
  for (const Row &row : std::vector<Row>{{"ring.step", "a STEP file, lengths in mm", 1e-13, 4},
                                         {"ring.brep", "a BREP file of OpenCASCADE", 1e-13, 4},
                                         {"script.geo", "a script of Gmsh", 1e-13, 4},
                                         {"all.msh", "a mesh file of Gmsh", 2e-2, 4},
                                         {"all.unv", "an UNV file", 2e-2, 4},
                                         {"all.vtk", "a VTK file", 2e-2, 4},
                                         {"all.bdf", "a deck of Nastran", 2e-2, 4},
                                         {"groups.msh", "a mesh file of Gmsh", 2e-2, 2},
                                         {"groups.unv", "an UNV file", 2e-2, 2},
                                         {"old.msh", "a mesh file of Gmsh", 2e-2, 2},
                                         {"old-bytes.msh", "a mesh file of Gmsh", 2e-2, 2},
                                         {"bytes.msh", "a mesh file of Gmsh", 2e-2, 2},
                                         {"cubic.msh", "a mesh file of Gmsh", 1e-5, 2},
                                         {"quadratic.msh", "a mesh file of Gmsh", 1e-5, 2},
                                         {"ninth.msh", "a mesh file of Gmsh", 1e-13, 2},
                                         {"triangles.msh", "a mesh file of Gmsh", 2e-2, 2},
                                         {"parts.msh", "a mesh file of Gmsh", 2e-2, 2}})
  {
    CoarseMesh read;
    ASSERT_EQ(failure_of<InputError>([&]() { read = read_mesh_file(folder(row.file)); }), "")
        << row.file;
    EXPECT_EQ(read.origin, row.origin) << row.file;
    EXPECT_NEAR(area_of(read), ring_area, row.off * ring_area) << row.file;
    EXPECT_NEAR(area_of(read), area_of_cells(read), 1e-12) << row.file;
    EXPECT_EQ(read.boundaries.size(), row.n_boundaries) << row.file;
    EXPECT_FALSE(worst_cell(read).is_folded) << row.file;
  }
}

/** The same numbers in metres and in millimetres are the same body, each in its unit; and a unit may be asked for. */
TEST(Drawings, HaveUnits)
{
  const Folder folder;
  folder.draw(ring + saved({"mm.step"}));
  std::string metres = folder.text("mm.step");
  const std::string unit = "SI_UNIT(.MILLI.,.METRE.)";
  ASSERT_NE(metres.find(unit), std::string::npos);
  metres.replace(metres.find(unit), unit.size(), "SI_UNIT($,.METRE.)");
  folder.write("m.step", metres);
  struct Row
  {
    std::string file, unit;
    double factor;
  };
  const CoarseMesh plain = read_mesh_file(folder("mm.step"));
  for (const Row &row : std::vector<Row>{{"m.step", "", 1},
                                         {"m.step", "mm", 1000},
                                         {"mm.step", "m", 1e-3},
                                         {"mm.step", "cm", 0.1},
                                         {"mm.step", "inch", 1 / 25.4}})
  {
    DrawingRequest request;
    request.unit = row.unit;
    const CoarseMesh mesh = read_mesh_file(folder(row.file), {}, request);
    ASSERT_EQ(mesh.vertices.size(), plain.vertices.size()) << row.file << row.unit;
    for (unsigned int v = 0; v < mesh.vertices.size(); ++v)
      EXPECT_LT(mesh.vertices[v].distance(row.factor * plain.vertices[v]), 1e-13 * row.factor)
          << row.file << row.unit;
    EXPECT_NEAR(area_of(mesh), ring_area * row.factor * row.factor,
                1e-13 * row.factor * row.factor);
  }
  DrawingRequest request;
  request.unit = "m";
  folder.write("script.geo", ring);
  EXPECT_TRUE(
      says(failure_of<InputError>([&]() { read_mesh_file(folder("script.geo"), {}, request); }),
           "which has no unit of its own"));
}

/** Cells of all kinds become quadrilaterals that match, over the whole of the same area; a remark tells how many. */
TEST(Drawings, BecomeQuadrilaterals)
{
  const Folder folder;
  const std::string disc = kernel + "Disk(1) = {0, 0, 0, 1};\n",
                    quads = "Mesh.RecombineAll = 1; Mesh.RecombinationAlgorithm = ";
  struct Row
  {
    std::string name, script;
    double area;
    bool is_cut;
  };
  std::vector<Row> rows = {
      {"ring of triangles", ring + "Mesh.RecombineAll = 0;\n", ring_area, true},
      {"ring, mixed", ring + quads + "0;\n", ring_area, true},
      {"ring of quadrilaterals", ring, ring_area, false},
      {"disc of triangles", disc + "Mesh.RecombineAll = 0;\n", numbers::PI, true}};
  for (const std::string size : {"0.2", "0.3", "0.45", "0.7"})
    for (const std::string algorithm : {"0", "1", "3"})
      rows.push_back({"disc " + algorithm + " " + size,
                      disc + quads + algorithm + "; Mesh.MeshSizeMax = " + size + ";\n",
                      numbers::PI, true});
  for (const Row &row : rows)
  {
    folder.write("drawing.geo", row.script);
    CoarseMesh mesh;
    ASSERT_EQ(failure_of<InputError>([&]() { mesh = read_mesh_file(folder("drawing.geo")); }), "")
        << row.name;
    EXPECT_NEAR(area_of(mesh), row.area, 1e-12) << row.name;
    EXPECT_NEAR(area_of_cells(mesh), row.area, 1e-12) << row.name;
    const CellFlaw worst = worst_cell(mesh);
    EXPECT_FALSE(worst.is_folded) << row.name;
    EXPECT_LT(worst.angle, 179) << row.name;
    if (row.script.find("MeshSizeMax") == std::string::npos) // else it depends on luck
    {
      EXPECT_EQ(mentions(mesh.remarks, "quadrilaterals were made"), row.is_cut) << row.name;
    }
  }
}

/** Lines, circles and groups by their numbers, by corners, and by what the scene calls them. */
TEST(Drawings, HaveNamesByNumbers)
{
  const Folder folder;
  folder.draw(bracket + saved({"bracket.step"}) + "Mesh.MeshSizeFromCurvature = 24; Mesh 2;\n" +
              saved({"bracket.vtk"}));
  const auto names_of = [&](const std::string &file, const DrawingRequest &request)
  { return read_mesh_file(folder(file), {}, request).boundaries; };
  DrawingRequest request;
  EXPECT_EQ(names_of("bracket.step", request).size(), 8);
  request.size = 3; // where Gmsh would take 0.8
  request.curvature = 0;
  EXPECT_LT(read_mesh_file(folder("bracket.step"), {}, request).cells.size(), 30U);
  request = {};
  // Of elements that were made here no user knows the number.
  EXPECT_EQ(read_drawing(folder("bracket.step"), 2).elements.back().number, 0U);
  EXPECT_GT(read_drawing(folder("bracket.vtk"), 2).elements.back().number, 0U);
  // The fillet meets its lines smoothly, and is no curve of its own where there are no curves.
  const std::vector<std::string> corners = names_of("bracket.vtk", request);
  EXPECT_EQ(corners.size(), 6U);
  request.curves = {{3, "rim"}, {5, "rim"}};
  for (const std::string file : {"bracket.step", "bracket.vtk"})
  {
    const std::vector<std::string> names = names_of(file, request);
    EXPECT_EQ(std::count(names.begin(), names.end(), "rim"), 1) << file;
    EXPECT_EQ(std::count(names.begin(), names.end(), "3"), 0) << file;
    EXPECT_EQ(std::count(names.begin(), names.end(), "2"), 1) << file;
  }
  request.curves = {{99, "rim"}};
  for (const std::string file : {"bracket.step", "bracket.vtk"})
    EXPECT_TRUE(says(failure_of<InputError>([&]() { names_of(file, request); }),
                     "has no curve 99, which Boundary rim/Curves names; it has 1, 2, 3"))
        << file;
}

/** Gmsh folds cells over a coarse hole: of a drawing they are made anew, and a file is told of. */
TEST(Drawings, ThatGmshFoldsAreMeshedAnew)
{
  const Folder folder;
  const std::string script =
      bracket + "Mesh.MeshSizeMax = 0.63; Mesh.MeshSizeFromCurvature = 12; Mesh.RecombineAll = 1;\n"
                "Mesh.RecombinationAlgorithm = 3; Mesh.SubdivisionAlgorithm = 1;\n";
  const std::string saving = "Mesh.SaveAll = 1;\n" + saved({"folded.msh"});
  const double area = area_of(read_mesh_file(folder.write("exact.geo", bracket)));
  for (const std::string &meshing :
       std::vector<std::string>{"Mesh 2; SetOrder 3;\n", "Mesh 2;\n" + saving, ""})
  {
    const CoarseMesh mesh = read_mesh_file(folder.write("folded.geo", script + meshing));
    EXPECT_EQ(mentions(mesh.remarks, "the mesh that the script makes is folded"), !meshing.empty());
    EXPECT_NEAR(area_of_cells(mesh), area, 1e-9 * area);
  }
  EXPECT_TRUE(says(failure_of<InputError>([&]() { read_mesh_file(folder("folded.msh")); }),
                   ": the mesh is folded, or surfaces overlap; mesh it with another"));
}

/** Solids become hexahedra: tetrahedra, prisms and both, of drawings and of meshes; all of the volume, and boundaries by name or number. */
TEST(Drawings, OfSolidsBecomeHexahedra)
{
  const Folder folder;
  const std::string base = kernel + "Rectangle(1) = {0, 0, 0, 2, 1};\n",
                    block = kernel +
                            "Box(1) = {0, 0, 0, 2, 1, 1}; Box(2) = {0, 0, 1, 1, 1, 1};\n"
                            "BooleanUnion(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };\n";
  struct Row
  {
    std::string file, script;
    double volume;
    unsigned int times; ///< as many cells as before; 0: of a mixture
    std::size_t n_boundaries;
  };
  const std::string groups = "Physical Volume(\"body\") = {3}; Physical Surface(\"foot\") = {1};\n";
  for (const Row &row : std::vector<Row>{
           {"solid.geo", block, 3, 4, 8},
           {"box.step", kernel + "Box(1) = {0, 0, 0, 2, 1, 1};\nSave \"box.step\";\n", 2, 4, 6},
           {"prisms.geo", base + "Extrude {0, 0, 1.5} { Surface{1}; Layers{3}; Recombine; }\n", 3,
            3, 6},
           {"text.msh", block + groups + "Mesh 3; Save \"text.msh\";\n", 3, 4, 2},
           {"bytes.msh", block + groups + "Mesh 3; Mesh.Binary = 1; Save \"bytes.msh\";\n", 3, 4,
            2},
           {"old.msh",
            block + groups +
                "Physical Surface(\"two\") = {1, 2}; Mesh 3; Mesh.MshFileVersion = 2.2;\n"
                "Save \"old.msh\";\n",
            3, 4, 3},
           {"quadratic.msh", block + groups + "Mesh 3; SetOrder 2; Save \"quadratic.msh\";\n", 3, 4,
            2}})
  {
    if (row.file.find(".geo") != std::string::npos)
      folder.write(row.file, row.script);
    else if (!row.script.empty())
      read_drawing(folder.write("script.geo", row.script), 3);
    HexahedralMesh mesh;
    ASSERT_EQ(failure_of<InputError>([&]() { mesh = read_hexahedral_file(folder(row.file)); }), "")
        << row.file;
    double volume = 0;
    for (const auto &face : mesh.faces) // the divergence theorem for x/3
      volume += area_of(mesh.corners_of(face)) *
                (Tensor<1, 3>(mesh.corners_of(face)[0]) * normal_of(mesh.corners_of(face))) / 3;
    EXPECT_NEAR(volume, row.volume, 1e-12) << row.file;
    EXPECT_TRUE(mentions(mesh.remarks, " " + std::to_string(row.times) + " times as many"))
        << row.file;
    EXPECT_EQ(mesh.boundaries.size(), row.n_boundaries) << row.file;
    EXPECT_EQ(mentions(mesh.remarks, "of second or higher order count by their corners"),
              row.file == "quadratic.msh");
  }
  EXPECT_TRUE(
      says(failure_of<InputError>([&]() { read_hexahedral_file(folder.write("flat.geo", base)); }),
           "has no solid; draw one, or set Dimension = 2"));
}

/** IGES, which Gmsh cannot write: the tools of deal.II make it of the STEP file. */
TEST(Drawings, AreReadFromIges)
{
  const Folder folder;
  folder.draw(ring + saved({"ring.step"}));
  OpenCASCADE::write_IGES(OpenCASCADE::read_STEP(folder("ring.step"), 1), folder("ring.iges"));
  const CoarseMesh mesh = read_mesh_file(folder("ring.iges"));
  EXPECT_EQ(mesh.origin.find("an IGES file, lengths in "), 0) << mesh.origin;
  EXPECT_NEAR(area_of(mesh), ring_area, 1e-12);
  EXPECT_NEAR(area_of(mesh), area_of_cells(mesh), 1e-12);
  EXPECT_EQ(mesh.boundaries.size(), 4);
}
} // namespace
