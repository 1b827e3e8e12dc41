// SPDX-License-Identifier: LGPL-2.1-or-later
// Ten drawings with meshes of Gmsh as they come: any size, algorithm, recombination, subdivision and order. HPVI_DRAWINGS says how many.
#include "drawing_files.h"

#include <sys/resource.h>

#include <random>

namespace
{
using namespace drawings;

const std::vector<std::string> ten = {
    bracket,
    ring,
    kernel + "Disk(1) = {0, 0, 0, 2};\n",
    kernel + "Rectangle(1) = {0, 0, 0, 4, 2, 0.4};\n",
    kernel + "Disk(1) = {0, 0, 0, 3, 1};\n",
    kernel + R"(Rectangle(1) = {-2, -2, 0, 8, 4};
Disk(2) = {0, 0, 0, 1};
Disk(3) = {3.5, 0, 0, 0.7, 0.4};
BooleanDifference(4) = { Surface{1}; Delete; }{ Surface{2, 3}; Delete; };
)",
    kernel +
        R"(Point(1) = {0, 0, 0}; Point(2) = {2, -0.5, 0}; Point(3) = {3, 1, 0}; Point(4) = {1.5, 2.2, 0};
Point(5) = {-0.5, 1.5, 0};
Spline(1) = {1, 2, 3, 4, 5, 1};
Curve Loop(1) = {1}; Plane Surface(1) = {1};
)",
    kernel +
        R"(Point(1) = {0, 0, 0}; Point(2) = {5, 0, 0}; Point(3) = {4, 2, 0}; Point(4) = {6, 4, 0}; Point(5) = {-1, 4, 0};
Point(6) = {1, 2, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 1};
Curve Loop(1) = {1:6}; Plane Surface(1) = {1};
)",
    kernel + R"(Rectangle(1) = {0, 0, 0, 3, 2};
Disk(2) = {1.5, 1.1, 0, 0.6};
BooleanFragments{ Surface{1}; Delete; }{ Surface{2}; Delete; }
)",
    kernel + R"(Disk(1) = {0, 0, 0, 2};
Rectangle(2) = {-3, 0, 0, 6, 3};
BooleanIntersection(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
)"};

unsigned int number_of_meshes()
{
  const char *const number = std::getenv("HPVI_DRAWINGS");
  return number == nullptr ? 50 : std::atoi(number);
}

/** Of this process and of those that read drawings. */
double seconds_of_work()
{
  double result = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN})
  {
    rusage usage;
    getrusage(who, &usage);
    result += usage.ru_utime.tv_sec + usage.ru_stime.tv_sec +
              1e-6 * (usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
  }
  return result;
}

TEST(RandomMeshes, AreReadAsTheyAreDrawn)
{
  const Folder folder;
  std::mt19937 random(1);
  const auto one_of = [&](const unsigned int n) { return random() % n; };
  std::vector<double> areas;
  for (const std::string &drawing : ten)
    areas.push_back(area_of(read_mesh_file(folder.write("exact.geo", drawing))));
  unsigned int n_folded = 0;
  for (unsigned int n = 0; n < number_of_meshes(); ++n)
  {
    const unsigned int d = one_of(ten.size()), mode = one_of(3), order = 1 + one_of(3);
    const unsigned int algorithms[] = {1, 5, 6};
    std::ostringstream options;
    options << "Mesh.MeshSizeMax = " << 0.3 + 0.01 * one_of(100)
            << "; Mesh.MeshSizeFromCurvature = " << 12 * (1 + one_of(2))
            << "; Mesh.Algorithm = " << algorithms[one_of(3)]
            << "; Mesh.RecombineAll = " << one_of(2)
            << "; Mesh.RecombinationAlgorithm = " << one_of(4)
            << "; Mesh.SubdivisionAlgorithm = " << one_of(2) << ";\n";
    const std::string text = ten[d] + options.str(),
                      meshed = text + "Mesh 2; SetOrder " + std::to_string(order) + ";\n";
    std::string file = folder.write("random.geo", mode == 0 ? text : meshed);
    const double begin = seconds_of_work();
    std::string refusal;
    CoarseMesh mesh;
    const auto read = [&]() { mesh = read_mesh_file(file); };
    if (mode == 2)
    {
      const std::string saving =
          meshed + "Mesh.SaveAll = 1; Mesh.Binary = " + std::to_string(one_of(2)) +
          "; Mesh.MshFileVersion = " + (one_of(2) ? "2.2" : "4.1") + ";\n" + saved({"random.msh"});
      refusal = failure_of<InputError>([&]() { folder.draw(saving); });
      file = folder("random.msh");
    }
    if (refusal.empty())
      refusal = failure_of<InputError>(read);
    if (says(refusal,
             "the mesh is folded")) // as Gmsh has saved it; from the drawing it is made anew
    {
      ASSERT_EQ(mode, 2U) << n << ": " << meshed;
      ++n_folded;
      refusal.clear();
      file = folder.write("random.geo", meshed);
      read();
      EXPECT_TRUE(mentions(mesh.remarks, "the mesh that the script makes is folded"));
    }
    EXPECT_EQ(refusal, "") << n << ": " << meshed << "mode " << mode;
    if (!refusal.empty())
      continue;
    // Gauss points know nothing of knots within an edge of a spline.
    const double hair = ten[d].find("Spline") == std::string::npos ? 1e-9 : 1e-5;
    EXPECT_NEAR(area_of(mesh), area_of_cells(mesh), hair * areas[d]) << n << ": " << meshed;
    // Edges follow the drawing, or they are polynomials of the mesh.
    EXPECT_NEAR(area_of(mesh), areas[d], (mode < 2 ? hair : 0.15) * areas[d])
        << n << ": " << meshed;
    EXPECT_LT(seconds_of_work() - begin, 5) << n << ": " << meshed;
  }
  EXPECT_LE(n_folded, number_of_meshes() / 100);
}
} // namespace
