// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_space_grid_h
#define hpvi_space_grid_h

#include "runs.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>

namespace space
{
using Map = std::function<Point<3>(const Point<3> &)>;

/** Where a grid of the unit cube goes, its cells counted by @p n, in format 2.2; @p any_order: corners begin anywhere. */
struct Grid
{
  static bool everywhere(const Point<3> &)
  {
    return true;
  }

  std::array<unsigned int, 3> n;
  Map map;
  bool any_order = false;
  std::function<bool(const Point<3> &)> takes = everywhere; ///< cells, by their centre
  unsigned int n_nodes = 8;                                 ///< of a cell: 8, 20 or 27

  void write(const std::string &file) const;

private:
  using Place = std::array<unsigned int, 3>; ///< in halves of cells

  /** Means of corners: of edges and faces in Gmsh's order. */
  static std::vector<Place> middles(const std::vector<Place> &corners,
                                    const std::vector<std::vector<unsigned int>> &of);
  std::vector<Place> nodes_of_face(std::vector<Place> corners) const;
  std::vector<Place> nodes_of_cell(std::vector<Place> corners) const;
};

inline std::vector<Grid::Place> Grid::middles(const std::vector<Place> &corners,
                                              const std::vector<std::vector<unsigned int>> &of)
{
  std::vector<Place> result;
  for (const auto &some : of)
  {
    Place sum{};
    for (const unsigned int v : some)
      for (unsigned int d = 0; d < 3; ++d)
        sum[d] += corners[v][d];
    for (unsigned int &coordinate : sum)
      coordinate /= some.size();
    result.push_back(sum);
  }
  return result;
}

inline std::vector<Grid::Place> Grid::nodes_of_face(std::vector<Place> corners) const
{
  const auto edges = middles(corners, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}),
             centre = middles(corners, {{0, 1, 2, 3}});
  if (n_nodes > 8)
    corners.insert(corners.end(), edges.begin(), edges.end());
  if (n_nodes > 20)
    corners.insert(corners.end(), centre.begin(), centre.end());
  return corners;
}

inline std::vector<Grid::Place> Grid::nodes_of_cell(std::vector<Place> corners) const
{
  const auto edges = middles(corners, {{0, 1},
                                       {0, 3},
                                       {0, 4},
                                       {1, 2},
                                       {1, 5},
                                       {2, 3},
                                       {2, 6},
                                       {3, 7},
                                       {4, 5},
                                       {4, 7},
                                       {5, 6},
                                       {6, 7}}),
             others = middles(corners, {{0, 3, 2, 1},
                                        {0, 1, 5, 4},
                                        {0, 4, 7, 3},
                                        {1, 2, 6, 5},
                                        {2, 3, 7, 6},
                                        {4, 5, 6, 7},
                                        {0, 1, 2, 3, 4, 5, 6, 7}});
  if (n_nodes > 8)
    corners.insert(corners.end(), edges.begin(), edges.end());
  if (n_nodes > 20)
    corners.insert(corners.end(), others.begin(), others.end());
  return corners;
}

inline void Grid::write(const std::string &file) const
{
  static const std::map<unsigned int, std::array<unsigned int, 2>> types{
      {8, {{3, 5}}}, {20, {{16, 17}}}, {27, {{10, 12}}}}; // of a face and of a cell
  const auto [of_face, of_cell] = types.at(n_nodes);
  std::map<Place, unsigned int> numbers;
  std::vector<Point<3>> points;
  const auto number = [&](const Place &place)
  {
    const auto [found, is_new] = numbers.try_emplace(place, points.size() + 1);
    if (is_new)
      points.push_back(
          map(Point<3>(place[0] / (2. * n[0]), place[1] / (2. * n[1]), place[2] / (2. * n[2]))));
    return found->second;
  };
  std::vector<std::string> elements;
  const auto add =
      [&](const unsigned int type, const unsigned int group, const std::vector<Place> &nodes)
  {
    std::string line = std::to_string(elements.size() + 1) + " " + std::to_string(type) + " 2 " +
                       std::to_string(group) + " " + std::to_string(group);
    for (const Place &node : nodes)
      line += " " + std::to_string(number(node));
    elements.push_back(line);
  };
  std::mt19937 random;
  for (unsigned int k = 0; k < n[2]; ++k)
    for (unsigned int j = 0; j < n[1]; ++j)
      for (unsigned int i = 0; i < n[0]; ++i)
      {
        if (!takes(Point<3>((i + 0.5) / n[0], (j + 0.5) / n[1], (k + 0.5) / n[2])))
          continue;
        std::vector<Place> c;
        for (const unsigned int z : {0U, 1U})
          for (const auto &[x, y] : {std::pair(0U, 0U), {1U, 0U}, {1U, 1U}, {0U, 1U}})
            c.push_back({{2 * (i + x), 2 * (j + y), 2 * (k + z)}});
        const auto face =
            [&](const bool is_outside, const unsigned int id, const std::array<unsigned int, 4> &v)
        {
          if (is_outside)
            add(of_face, id, nodes_of_face({c[v[0]], c[v[1]], c[v[2]], c[v[3]]}));
        };
        face(i == 0, 1, {{0, 3, 7, 4}});
        face(i + 1 == n[0], 2, {{1, 2, 6, 5}});
        face(j == 0, 3, {{0, 1, 5, 4}});
        face(j + 1 == n[1], 4, {{3, 2, 6, 7}});
        face(k == 0, 5, {{0, 1, 2, 3}});
        face(k + 1 == n[2], 6, {{4, 5, 6, 7}});
        for (unsigned int turns = any_order ? random() % 4 : 0; turns > 0; --turns)
          c = {c[1], c[2], c[3], c[0], c[5], c[6], c[7], c[4]};
        for (unsigned int turns = any_order ? random() % 3 : 0; turns > 0; --turns)
          c = {c[0], c[4], c[5], c[1], c[3], c[7], c[6], c[2]};
        add(of_cell, 1, nodes_of_cell(c));
      }
  std::ofstream out(file);
  out.precision(17);
  out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n7\n";
  for (unsigned int f = 0; f < 6; ++f)
    out << "2 " << f + 1 << " \"" << boundary_names(3)[f] << "\"\n";
  out << "3 1 \"block\"\n$EndPhysicalNames\n$Nodes\n" << points.size() << "\n";
  for (unsigned int k = 0; k < points.size(); ++k)
    out << k + 1 << " " << points[k] << "\n";
  out << "$EndNodes\n$Elements\n" << elements.size() << "\n";
  for (const std::string &element : elements)
    out << element << "\n";
  out << "$EndElements\n";
}

/** A scene of the mesh, without conditions. */
inline Scene<3> scene_of(const Grid &grid, const std::string &name, const Overrides &entries = {})
{
  const std::string file = name + ".msh";
  grid.write(file);
  std::ofstream(name + ".prm")
      << "set Dimension = 3\nsubsection Geometry\n  set Shape = file\n  set File = " << file
      << "\nend\n"
      << (entries.empty() ? "subsection Boundary top\n  set Displacement = 0; 0; 0\nend\n" : "");
  Scene<3> scene = read_scene<3>(name + ".prm", entries);
  std::filesystem::remove(name + ".prm");
  std::filesystem::remove(file);
  return scene;
}
} // namespace space

#endif
