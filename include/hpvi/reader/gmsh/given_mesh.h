// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_given_mesh_h
#define hpvi_given_mesh_h

#include <hpvi/reader/gmsh/gmsh_file.h>

#include <optional>
#include <string>

namespace hpvi
{
/** A mesh that a program has made, without a file: as long as it lives its name may stand in the place of a path. */
class GivenMesh
{
public:
  explicit GivenMesh(GmshFile file);
  ~GivenMesh();
  GivenMesh(const GivenMesh &) = delete;

  const GmshFile file;
  const std::string name; ///< as that of a file
};

/** The mesh of this name, if there is one. */
std::optional<GmshFile> given_mesh(const std::string &name);
} // namespace hpvi

#endif
