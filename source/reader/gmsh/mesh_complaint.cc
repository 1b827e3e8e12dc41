// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/input_error.h>
#include <hpvi/base/text.h>
#include <hpvi/reader/gmsh/mesh_complaint.h>

namespace hpvi
{
MeshComplaint::MeshComplaint(const std::string &path) : file(printable(path, 400))
{
}

void MeshComplaint::operator()(const std::string &problem_and_remedy) const
{
  throw InputError(file + ": " + problem_and_remedy);
}

void MeshComplaint::at(const std::size_t line, const std::string &problem_and_remedy) const
{
  throw InputError(file + (line > 0 ? ":" + std::to_string(line) : "") + ": " + problem_and_remedy);
}

void MeshComplaint::of(const std::size_t element, const std::string &problem_and_remedy) const
{
  (*this)((element > 0 ? "element " + std::to_string(element) + ": " : "") + problem_and_remedy);
}
} // namespace hpvi
