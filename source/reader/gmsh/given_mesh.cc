// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/reader/gmsh/given_mesh.h>

#include <map>
#include <mutex>
#include <utility>

namespace hpvi
{
namespace
{
struct Known
{
  std::mutex mutex;
  std::map<std::string, const GivenMesh *> meshes;
  unsigned int n_made = 0;
};

Known &known()
{
  static auto *const all = new Known; // outlives what Python destroys at its end
  return *all;
}

std::string new_name()
{
  const std::lock_guard<std::mutex> lock(known().mutex);
  return "/points and cells/mesh " + std::to_string(++known().n_made);
}
} // namespace

GivenMesh::GivenMesh(GmshFile file) : file(std::move(file)), name(new_name())
{
  const std::lock_guard<std::mutex> lock(known().mutex);
  known().meshes[name] = this;
}

GivenMesh::~GivenMesh()
{
  const std::lock_guard<std::mutex> lock(known().mutex);
  known().meshes.erase(name);
}

std::optional<GmshFile> given_mesh(const std::string &name)
{
  const std::lock_guard<std::mutex> lock(known().mutex);
  const auto found = known().meshes.find(name);
  if (found == known().meshes.end())
    return std::nullopt;
  return found->second->file;
}
} // namespace hpvi
