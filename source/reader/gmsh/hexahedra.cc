// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/reader/gmsh/hexahedra.h>

#include <algorithm>
#include <set>

namespace hpvi
{
using namespace dealii;

namespace
{
using Element = GmshFile::Element;
using Loop = std::vector<unsigned int>; ///< corners around a face

constexpr std::int64_t tetrahedron = 4, brick = 5, prism = 6;

/** Faces by corners of a cell in Gmsh's order. */
const std::vector<Loop> &faces_of(const std::int64_t type)
{
  static const std::map<std::int64_t, std::vector<Loop>> all = {
      {tetrahedron, {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}},
      {brick, {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}},
      {prism, {{0, 1, 2}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}}};
  return all.at(type);
}

bool is_in_space(const Element &element)
{
  return element.type == tetrahedron || element.type == brick || element.type == prism;
}

class HexahedraCutter
{
public:
  explicit HexahedraCutter(GmshFile &file) : file(file)
  {
    for (const GmshFile::Node &node : file.nodes)
      last_tag = std::max(last_tag, node.tag);
  }

  void cut()
  {
    std::vector<Element> old;
    std::swap(old, file.elements);
    find_heights(old);
    unsigned int n_before = 0;
    for (const Element &element : old)
      if (is_in_space(element))
      {
        ++n_before;
        heights.empty() ? cut_cell(element) : cut_prism(element);
      }
      else if (element.type == 2 || element.type == 3)
        cut_face(element);
      else
        file.elements.push_back(element);
    const unsigned int n_after =
        std::count_if(file.elements.begin(), file.elements.end(), is_in_space);
    file.remarks.push_back("of " + text(n_before) + " tetrahedra, prisms and hexahedra " +
                           text(n_after) + " hexahedra were made, " +
                           text(double(n_after) / n_before, 2) +
                           " times as many; transfinite volumes and layers make fewer in Gmsh");
  }

private:
  static Loop sorted(Loop nodes)
  {
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  }

  /** Edges between the triangles of prisms, where all cells are such, and no height is an edge of a triangle. */
  void find_heights(const std::vector<Element> &elements)
  {
    std::set<Loop> across;
    for (const Element &cell : elements)
      if (is_in_space(cell))
      {
        if (cell.type != prism)
          return heights.clear();
        for (unsigned int k = 0; k < 3; ++k)
        {
          heights.insert(sorted({cell.nodes[k], cell.nodes[k + 3]}));
          for (const unsigned int level : {0, 3})
            across.insert(sorted({cell.nodes[level + k], cell.nodes[level + (k + 1) % 3]}));
        }
      }
    if (std::any_of(across.begin(), across.end(),
                    [&](const Loop &edge) { return heights.count(edge) > 0; }))
      heights.clear();
  }

  /** The node in the middle of an edge, a face or a cell. */
  unsigned int centre(const Loop &nodes)
  {
    const auto [known, is_new] = centres.try_emplace(sorted(nodes), file.nodes.size());
    if (is_new)
    {
      Tensor<1, 3> sum;
      for (const unsigned int node : nodes)
        sum += file.nodes[node].at;
      file.nodes.push_back({++last_tag, Point<3>(sum / double(nodes.size()))});
    }
    return known->second;
  }

  void add(const Element &parent, const std::int64_t type, const Loop &nodes)
  {
    Element child = parent;
    child.type = type;
    child.nodes = {};
    std::copy(nodes.begin(), nodes.end(), child.nodes.begin());
    file.elements.push_back(child);
  }

  void cut_cell(const Element &cell)
  {
    const unsigned int n = element_kind(cell.type).n_corners;
    const unsigned int middle = centre(Loop(cell.nodes.begin(), cell.nodes.begin() + n));
    for (unsigned int v = 0; v < n; ++v)
    {
      // Three faces meet at a corner, each with two of its three neighbours.
      std::map<Loop, unsigned int> face_between;
      Loop beside;
      for (const Loop &face : faces_of(cell.type))
        if (const auto at = std::find(face.begin(), face.end(), v); at != face.end())
        {
          const std::size_t k = at - face.begin(), size = face.size();
          const unsigned int before = cell.nodes[face[(k + size - 1) % size]],
                             after = cell.nodes[face[(k + 1) % size]];
          Loop nodes;
          for (const unsigned int corner : face)
            nodes.push_back(cell.nodes[corner]);
          face_between[sorted({before, after})] = centre(nodes);
          for (const unsigned int node : {before, after})
            if (std::find(beside.begin(), beside.end(), node) == beside.end())
              beside.push_back(node);
        }
      const auto edge = [&](const unsigned int k) { return centre({cell.nodes[v], beside[k]}); };
      const auto face = [&](const unsigned int j, const unsigned int k) {
        return face_between.at(sorted({beside[j], beside[k]}));
      };
      add(cell, brick,
          {cell.nodes[v], edge(0), face(0, 1), edge(1), edge(2), face(0, 2), middle, face(1, 2)});
    }
  }

  void cut_prism(const Element &cell)
  {
    for (unsigned int k = 0; k < 3; ++k)
    {
      Loop nodes;
      for (const unsigned int level : {0, 3})
      {
        const auto node = [&](const unsigned int corner) { return cell.nodes[level + corner % 3]; };
        nodes.insert(nodes.end(),
                     {node(k), centre({node(k), node(k + 1)}), centre({node(0), node(1), node(2)}),
                      centre({node(k), node(k + 2)})});
      }
      add(cell, brick, nodes);
    }
  }

  void cut_face(const Element &face)
  {
    const unsigned int n = face.type == 2 ? 3 : 4;
    const Loop nodes(face.nodes.begin(), face.nodes.begin() + n);
    const auto node = [&](const unsigned int k) { return nodes[k % n]; };
    if (n == 4 && !heights.empty())
    {
      const unsigned int first = heights.count(sorted({node(0), node(1)})) > 0 ? 1 : 0;
      const unsigned int m = centre({node(first), node(first + 1)}),
                         other = centre({node(first + 2), node(first + 3)});
      add(face, 3, {node(first), m, other, node(first + 3)});
      add(face, 3, {m, node(first + 1), node(first + 2), other});
      return;
    }
    for (unsigned int k = 0; k < n; ++k)
      add(face, 3,
          {node(k), centre({node(k), node(k + 1)}), centre(nodes),
           centre({node(k), node(k + n - 1)})});
  }

  GmshFile &file;
  std::map<Loop, unsigned int> centres; ///< nodes by those between which they are
  std::set<Loop> heights;               ///< edges that are not cut
  std::int64_t last_tag = 0;
};
} // namespace

void make_hexahedra(GmshFile &file)
{
  const auto has = [&](const auto &is_such)
  { return std::any_of(file.elements.begin(), file.elements.end(), is_such); };
  const bool has_others =
      has([](const Element &element)
          { return element_kind(element.type).dim == 3 && !is_in_space(element); });
  if (!has_others && has([](const Element &element)
                         { return element.type == tetrahedron || element.type == prism; }))
    HexahedraCutter(file).cut();
}
} // namespace hpvi
