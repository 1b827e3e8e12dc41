// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/gmsh/hexahedral_file.h>
#include <hpvi/shapes/hexahedra_from_file.h>
#include <hpvi/shapes/mesh_from_file.h>

namespace hpvi
{
using namespace dealii;

ShapeKind<3> hexahedra_from_file()
{
  return {
      Shape::file,
      "file",
      "file: hexahedra of a mesh file of Gmsh, given by File; its boundaries are the physical "
      "surfaces.",
      {{"Geometry", "File", "", std::make_shared<Patterns::Anything>(), "a file name or nothing",
        "Mesh file of Gmsh, format 4.1 or 2.2, ASCII, with hexahedra of first order and plane "
        "faces, physical surfaces and physical volumes; a path relative to that of the scene."}},
      "File",
      [](const Parameters &parameters, Geometry<3> &geometry)
      {
        const std::string file = parameters.text("Geometry", "File");
        if (file.empty())
          parameters.reject("Geometry", "File", "names no mesh; give a file of Gmsh, as body.msh");
        geometry.mesh = std::make_shared<const HexahedralMesh>(
            read_hexahedral_file(beside(parameters.file_name(), file)));
      },
      nullptr,
      [](const GeometryText &text)
      {
        const std::string file = text("File");
        return file.empty()
                   ? SideNames()
                   : SideNames{read_hexahedral_file(file).boundaries, {}, /*is_from_file=*/true};
      },
      false};
}
} // namespace hpvi
