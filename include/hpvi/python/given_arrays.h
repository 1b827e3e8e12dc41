// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_given_arrays_h
#define hpvi_given_arrays_h

#include <hpvi/reader/gmsh/gmsh_file.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace hpvi
{
/** A mesh as Python has it: numbers of points count from 0. */
struct GivenArrays
{
  using Rows = std::vector<std::vector<std::int64_t>>;

  unsigned int dim = 2;       ///< coordinates of a point
  std::vector<double> points; ///< one behind the other
  Rows
      cells; ///< points of each: corners around it, in space around the bottom and then the top, then middles of edges
  std::map<std::string, Rows> boundaries; ///< edges, in space faces, by their corners
  std::map<std::string, std::vector<std::int64_t>> parts; ///< numbers of cells
};

/** Throws InputError for numbers of points and cells that are not there. */
GmshFile mesh_of_arrays(const GivenArrays &arrays);
} // namespace hpvi

#endif
