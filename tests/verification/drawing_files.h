// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_drawing_files_h
#define hpvi_drawing_files_h

#include "discretisation.h"

#include "../texts.h"

#include <hpvi/base/input_error.h>
#include <hpvi/reader/gmsh/mesh_file.h>

#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

/** Drawings by scripts of Gmsh, which save them in many formats. */
namespace drawings
{
using namespace verification;
namespace fs = std::filesystem;

/** With the files of one test, of any process. */
class Folder
{
public:
  Folder() : path(fs::temp_directory_path() / ("hpvi-drawings-" + std::to_string(getpid())))
  {
    fs::create_directories(path);
  }

  ~Folder()
  {
    fs::remove_all(path);
  }

  std::string operator()(const std::string &name) const
  {
    return (path / name).string();
  }

  std::string write(const std::string &name, const std::string &text) const
  {
    std::ofstream(path / name, std::ios::binary) << text;
    return (*this)(name);
  }

  std::string text(const std::string &name) const
  {
    std::ostringstream text;
    text << std::ifstream(path / name, std::ios::binary).rdbuf();
    return text.str();
  }

  /** Runs a script of Gmsh, which saves files here. */
  void draw(const std::string &script) const
  {
    read_mesh_file(write("script.geo", script));
  }

  const fs::path path;
};

inline const std::string kernel = "SetFactory(\"OpenCASCADE\");\n";

/** A quarter of a ring with radii 1 and 2: its curves are 1: y = 0, 2: outside, 3: x = 0, 4: inside. */
inline const std::string ring = kernel + R"(Disk(1) = {0, 0, 0, 2};
Disk(2) = {0, 0, 0, 1};
BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
Rectangle(4) = {0, 0, 0, 3, 3};
BooleanIntersection(5) = { Surface{3}; Delete; }{ Surface{4}; Delete; };
)";

/** With a fillet and a hole. */
inline const std::string bracket = kernel + R"(Point(1) = {0, 0, 0}; Point(2) = {6, 0, 0};
Point(3) = {6, 1.2, 0}; Point(4) = {2, 1.2, 0}; Point(5) = {1.2, 2, 0}; Point(6) = {1.2, 5, 0};
Point(7) = {0, 5, 0}; Point(8) = {2, 2, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Circle(4) = {4, 8, 5}; Line(5) = {5, 6};
Line(6) = {6, 7}; Line(7) = {7, 1}; Circle(8) = {4.5, 0.6, 0, 0.3};
Curve Loop(1) = {1:7}; Curve Loop(2) = {8}; Plane Surface(1) = {1, 2};
)";

inline std::string saved(const std::vector<std::string> &names)
{
  std::string script;
  for (const std::string &name : names)
    script += "Save \"" + name + "\";\n";
  return script;
}

/** Of what the boundary surrounds, along its curves: half of the integral of x dy - y dx. */
inline double area_of(const CoarseMesh &mesh)
{
  double area = 0;
  const QGauss<1> gauss(20);
  for (const CoarseMesh::Edge &edge : mesh.edges)
  {
    if (edge.boundary == CoarseMesh::inside)
      continue;
    const Point<2> a = mesh.vertices[edge.vertices[0]], b = mesh.vertices[edge.vertices[1]];
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const double s = gauss.point(q)[0];
      const Point<2> x = edge.curve ? edge.curve.point(s) : a + s * (b - a);
      const Tensor<1, 2> way = edge.curve ? edge.curve.derivative(s) : b - a;
      area += gauss.weight(q) * 0.5 * (x[0] * way[1] - x[1] * way[0]);
    }
  }
  return area;
}

inline double area_of_cells(const CoarseMesh &mesh)
{
  double area = 0;
  const QGauss<1> gauss(12);
  const EdgeCurves curves(mesh);
  for (unsigned int c = 0; c < mesh.cells.size(); ++c)
  {
    const BlendedCell cell(curves, c);
    for (unsigned int q = 0; q < gauss.size(); ++q)
      for (unsigned int r = 0; r < gauss.size(); ++r)
        area += gauss.weight(q) * gauss.weight(r) *
                cell.determinant(gauss.point(q)[0], gauss.point(r)[0]);
  }
  return area;
}

constexpr double ring_area = 0.75 * numbers::PI;
} // namespace drawings

#endif
