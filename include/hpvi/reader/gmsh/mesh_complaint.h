// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_mesh_complaint_h
#define hpvi_mesh_complaint_h

#include <cstddef>
#include <string>

namespace hpvi
{
/** The one line about a mesh file that is refused: file, what is wrong, remedy. */
class MeshComplaint
{
public:
  explicit MeshComplaint(const std::string &path);

  [[noreturn]] void operator()(const std::string &problem_and_remedy) const;

  /** Names a line of the file, counted from 1. */
  [[noreturn]] void at(std::size_t line, const std::string &problem_and_remedy) const;

  /** Names an element by its number in the file; 0: it has none. */
  [[noreturn]] void of(std::size_t element, const std::string &problem_and_remedy) const;

private:
  const std::string file;
};
} // namespace hpvi

#endif
