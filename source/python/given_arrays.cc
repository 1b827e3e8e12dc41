// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/input_error.h>
#include <hpvi/base/text.h>
#include <hpvi/python/given_arrays.h>

#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
[[noreturn]] void refuse(const std::string &problem_and_remedy)
{
  throw InputError("hpvi.Scene: " + problem_and_remedy);
}

/** Gmsh's number of a cell with so many points; 0: there is none. */
std::int64_t type_of_cell(const unsigned int dim, const std::size_t n)
{
  static const std::map<std::pair<unsigned int, std::size_t>, std::int64_t> types = {
      {{2, 3}, 2},  {{2, 4}, 3}, {{2, 6}, 9}, {{2, 8}, 16},
      {{2, 9}, 10}, {{3, 4}, 4}, {{3, 6}, 6}, {{3, 8}, 5}};
  const auto found = types.find({dim, n});
  return found == types.end() ? 0 : found->second;
}

GmshFile::Element element_of(const std::int64_t type, const std::vector<std::int64_t> &row,
                             const std::size_t n_points, const std::string &what)
{
  GmshFile::Element element;
  element.type = type;
  for (unsigned int k = 0; k < row.size(); ++k)
  {
    if (row[k] < 0 || std::uint64_t(row[k]) >= n_points)
      refuse(what + " has the point " + std::to_string(row[k]) + ", and there are " +
             std::to_string(n_points) + "; count points from 0");
    element.nodes[k] = row[k];
  }
  return element;
}

void add_cells(const GivenArrays &arrays, const std::size_t n_points, GmshFile &file)
{
  for (std::size_t c = 0; c < arrays.cells.size(); ++c)
  {
    const std::string what = "cells: the cell " + std::to_string(c);
    const std::int64_t type = type_of_cell(arrays.dim, arrays.cells[c].size());
    if (type == 0)
      refuse(what + " has " + std::to_string(arrays.cells[c].size()) + " points; give " +
             (arrays.dim == 2 ? "3 or 4, or 6, 8 or 9 with middles of edges"
                              : "4, 6 or 8, of tetrahedra, prisms and hexahedra"));
    file.elements.push_back(element_of(type, arrays.cells[c], n_points, what));
    file.elements.back().group = 1;
  }
  file.names[{arrays.dim, 1}] = arrays.parts.empty() ? "body" : "rest";
  std::int64_t group = 1;
  for (const auto &[name, cells] : arrays.parts)
  {
    file.names[{arrays.dim, ++group}] = name;
    for (const std::int64_t c : cells)
    {
      if (c < 0 || std::uint64_t(c) >= arrays.cells.size())
        refuse("parts: " + printable(name) + " has the cell " + std::to_string(c) +
               ", and there are " + std::to_string(arrays.cells.size()) + "; count cells from 0");
      if (file.elements[c].group != 1)
        refuse("parts: " + printable(name) + " has the cell " + std::to_string(c) +
               ", which another part has, too; give each cell one");
      file.elements[c].group = group;
    }
  }
}
} // namespace

GmshFile mesh_of_arrays(const GivenArrays &arrays)
{
  GmshFile file;
  file.origin = "points and cells";
  if (arrays.dim != 2 && arrays.dim != 3)
    refuse("points: has " + std::to_string(arrays.dim) +
           " coordinates a point; give 2, or 3 in space");
  const std::size_t n_points = arrays.points.size() / arrays.dim;
  for (std::size_t n = 0; n < n_points; ++n)
  {
    Point<3> at;
    for (unsigned int d = 0; d < arrays.dim; ++d)
      at[d] = arrays.points[n * arrays.dim + d];
    if (!std::isfinite(at.norm()))
      refuse("points: the point " + std::to_string(n) + " is at " + to_string(at) +
             "; give finite numbers");
    file.nodes.push_back({std::int64_t(n) + 1, at});
  }
  add_cells(arrays, n_points, file);
  std::int64_t group = 0;
  for (const auto &[name, rows] : arrays.boundaries)
  {
    file.names[{arrays.dim - 1, ++group}] = name;
    for (const std::vector<std::int64_t> &row : rows)
    {
      const std::int64_t type = arrays.dim == 2   ? (row.size() == 2 ? 1 : 0)
                                : row.size() == 3 ? 2
                                : row.size() == 4 ? 3
                                                  : 0;
      const std::string what = "boundaries: " + printable(name);
      if (type == 0)
        refuse(what + " has " + std::to_string(row.size()) + " points in a row; give " +
               (arrays.dim == 2 ? "the two ends of each edge" : "3 or 4 corners of each face"));
      file.elements.push_back(element_of(type, row, n_points, what));
      file.elements.back().group = group;
    }
  }
  return file;
}
} // namespace hpvi
