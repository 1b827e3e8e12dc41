// SPDX-License-Identifier: LGPL-2.1-or-later
// The process that reads drawings: what it runs, how it ends, and what is left of it.
#include "drawing_files.h"

#include <chrono>

namespace
{
using namespace drawings;

/** A file whose content is no script is never run as one, whatever its name. */
TEST(DrawingReader, RunsNoScripts)
{
  const Folder folder;
  const std::string script = "SystemCall \"touch " + folder("marker") + "\";\n" + ring;
  for (const std::string start :
       {"", "ISO-10303-21;\n", "DBRep_DrawableShape\n", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n",
        "\xEF\xBB\xBF$MeshFormat\n4.1 0 8\n$EndMeshFormat\n",
        "\n$MeshFormat\n4.1 0 8\n$EndMeshFormat\n",
        "$Comments\n$EndComments\n$MeshFormat\n4.1 0 8\n$EndMeshFormat\n", "    -1\n  2411\n",
        "# vtk DataFile Version 2.0\n", "$\nBEGIN BULK\nGRID\n", "*NODE\n"})
    for (const std::string ending : {".step", ".msh", ".unv", ".vtk", ".inp", ""})
    {
      const std::string file = folder.write("drawing" + ending, start + script);
      EXPECT_NE(failure_of<InputError>([&]() { read_mesh_file(file); }), "") << start << ending;
      EXPECT_FALSE(fs::exists(folder("marker"))) << start << ending;
    }
  // Gmsh goes by the first line.
  const std::string late = folder.write(
      "late.msh", script + "$Comments\n$EndComments\n$MeshFormat\n4.1 0 8\n$EndMeshFormat\n");
  EXPECT_NE(failure_of<InputError>([&]() { read_mesh_file(late); }), "");
  EXPECT_FALSE(fs::exists(folder("marker")));
  read_mesh_file(folder.write("drawing.geo", script)); // is a script
  EXPECT_TRUE(fs::exists(folder("marker")));
}

/** What the process does is told in one line, and nothing of it is left. */
TEST(DrawingReader, EndsInOneLine)
{
  const Folder folder;
  struct Row
  {
    std::string script, message;
    DrawingLimits limits;
  };
  for (const Row &row : std::vector<Row>{
           {"SystemCall \"kill -SEGV $PPID\";\n",
            "makes the reader of drawings die of signal 11 (Segmentation fault)",
            {}},
           {"SystemCall \"sleep 30\";\n",
            "took longer than 0.5 s to read and to mesh; set a larger Mesh size",
            {0.5, 8000}},
           {ring + "Mesh.MeshSizeMax = 0.001;\n",
            "needs more memory than the reader of drawings may take; set a larger Mesh size",
            {60, 150}},
           {"Plane Surface(1) = {", "as Gmsh says", {}},
           {kernel + "Sphere(1) = {0, 0, 0, 1};\n",
            "is a solid, and a body in the plane is a face; set Dimension = 3",
            {}},
           {kernel + "Circle(1) = {0, 0, 0, 1};\n", "has no face; make one of its curves", {}},
           {ring + "Rotate {{1, 0, 0}, {0, 0, 0}, Pi/2} { Surface{:}; }\n",
            "but in one of y = const; turn the drawing",
            {}},
           {ring + "Rotate {{1, 0, 0}, {0, 0, 0}, Pi/4} { Surface{:}; }\n",
            "is not in a plane z = const",
            {}}})
  {
    const std::string file = folder.write("drawing.geo", row.script);
    const auto begin = std::chrono::steady_clock::now();
    const std::string message =
        failure_of<InputError>([&]() { read_drawing(file, 2, {}, row.limits); });
    EXPECT_TRUE(says(message, row.message)) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5)) << row.script;
  }
  EXPECT_EQ(failure_of<InputError>(
                [&]() {
                  read_drawing(
                      folder.write("raised.geo", ring + "Translate {0, 0, 3} { Surface{:}; }\n"),
                      2);
                }),
            "");
}
} // namespace
