// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/disjoint_sets.h>
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/reader/gmsh/quadratic_edge.h>
#include <hpvi/reader/gmsh/quadrilaterals.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace hpvi
{
using namespace dealii;

namespace
{
using Element = GmshFile::Element;
using Ends = std::array<unsigned int, 2>; ///< the smaller node first

Ends ends_of(const unsigned int a, const unsigned int b)
{
  return {{std::min(a, b), std::max(a, b)}};
}

/** The corner of more than 180 degrees of a quadrilateral with straight edges that has one; 4: it has none, or crosses itself. */
unsigned int concave_corner(const GmshFile &file, const Element &cell)
{
  const auto place = [&](const unsigned int k)
  {
    const Point<3> &at = file.nodes[cell.nodes[k % 4]].at;
    return Point<2>(at[0], at[1]);
  };
  const auto across = [&](const unsigned int k) // sine of the corner times both edges
  {
    const Tensor<1, 2> out = place(k + 1) - place(k), in = place(k + 3) - place(k);
    return (out[0] * in[1] - out[1] * in[0]) / (out.norm() * in.norm());
  };
  const double hair = 1e-3;
  for (const double sign : {1., -1.}) // clockwise cells are turned round later
    for (unsigned int k = 0; k < 4; ++k)
      if (sign * across(k) < -hair && sign * across(k + 1) > hair && sign * across(k + 2) > hair &&
          sign * across(k + 3) > hair)
        return k;
  return 4;
}

class Cutter
{
public:
  Cutter(GmshFile &file, const MeshComplaint &complain) : file(file), complain(complain)
  {
    for (unsigned int e = 0; e < file.elements.size(); ++e)
    {
      const ElementKind kind = element_kind(file.elements[e].type);
      if (kind.name == nullptr || kind.dim != 2)
        continue;
      cells.push_back(e);
      for (unsigned int k = 0; k < kind.n_corners; ++k)
        sides[edge(file.elements[e], k)].push_back(e);
    }
    for (const Element &element : file.elements)
      if (const ElementKind kind = element_kind(element.type); kind.dim == 1 && kind.n_corners == 2)
        lines.insert(ends_of(element.nodes[0], element.nodes[1]));
    for (const auto &[ends, beside] : sides)
      if (beside.size() > 1 && lines.count(ends) == 0 &&
          file.elements[beside[0]].group == file.elements[beside[1]].group)
        inner.insert(ends);
  }

  void cut()
  {
    take_middles();
    const std::vector<bool> is_cut = cells_to_cut();
    if (std::none_of(is_cut.begin(), is_cut.end(), [](const bool cut) { return cut; }))
      return;
    std::vector<Element> old;
    std::swap(old, file.elements);
    unsigned int n_triangles = 0, n_flat = 0, n_before = 0;
    for (unsigned int e = 0; e < old.size(); ++e)
    {
      const ElementKind kind = element_kind(old[e].type);
      if (kind.dim == 1 && is_line_cut(old[e], is_cut))
        cut_line(old[e]);
      else if (kind.dim != 2 || !is_cut[e])
        file.elements.push_back(old[e]);
      else
      {
        ++n_before;
        n_triangles += kind.n_corners == 3;
        n_flat += flat_corner(old[e]) < kind.n_corners && kind.n_corners == 4;
        cut_cell(old[e]);
      }
    }
    tell(n_before, n_triangles, n_flat);
  }

private:
  void tell(const unsigned int n_before, const unsigned int n_triangles, const unsigned int n_flat)
  {
    const unsigned int n_after =
        std::count_if(file.elements.begin(), file.elements.end(),
                      [](const Element &element) { return element_kind(element.type).dim == 2; });
    std::string what;
    if (n_triangles > 0)
      what = text(n_triangles) + (n_triangles == 1 ? " triangle" : " triangles");
    if (n_flat > 0)
      what += (what.empty() ? "" : " and ") + text(n_flat) +
              (n_flat == 1 ? " cell with a corner" : " cells with a corner") +
              " of 180 degrees or more";
    file.remarks.push_back(
        "of " + text(n_before) + " cells, among them " + what + ", " + text(n_after) +
        " quadrilaterals were made, " + text(double(n_after) / n_before, 2) + " times as many" +
        (file.is_drawing ? ""
                         : "; Mesh.RecombineAll = 1; Mesh.RecombinationAlgorithm = 3; make "
                           "quadrilaterals in Gmsh"));
  }

  static unsigned int n_corners(const Element &cell)
  {
    return element_kind(cell.type).n_corners;
  }

  static Ends edge(const Element &cell, const unsigned int k)
  {
    return ends_of(cell.nodes[k], cell.nodes[(k + 1) % n_corners(cell)]);
  }

  Point<2> place(const unsigned int node) const
  {
    return Point<2>(file.nodes[node].at[0], file.nodes[node].at[1]);
  }

  /** Of elements of second order, as decks and arrays have them. */
  void take_middles()
  {
    for (const Element &element : file.elements)
    {
      const ElementKind kind = element_kind(element.type);
      if (kind.name == nullptr || kind.dim > 2 || kind.n_nodes <= kind.n_corners ||
          file.nodes.empty())
        continue;
      for (unsigned int k = 0; k < (kind.dim == 1 ? 1 : kind.n_corners); ++k)
      {
        const unsigned int a = element.nodes[k], b = element.nodes[(k + 1) % kind.n_corners];
        middles[ends_of(a, b)] = element.nodes[kind.n_corners + k];
      }
    }
  }

  CurvePiece curve(const unsigned int from, const unsigned int to) const
  {
    if (inner.count(ends_of(from, to)) > 0)
      return {};
    if (const CurvePiece known = file.curve(from, to))
      return known;
    const auto middle = middles.find(ends_of(from, to));
    if (middle == middles.end())
      return {};
    const auto result =
        std::make_shared<QuadraticEdge>(place(from), place(middle->second), place(to));
    if (!result->is_regular())
      complain("the middle node " + std::to_string(file.nodes[middle->second].tag) +
               " of the edge from " + to_string(place(from)) + " to " + to_string(place(to)) +
               " is not in the middle half of it, where the curve would turn back; mesh finer, or "
               "with -order 1");
    return result->bow() > 1e-10 ? CurvePiece{result, 0, 1} : CurvePiece();
  }

  /** Of the edge from a node to another at the first, or, of one that is cut, of the chord to its middle. */
  Tensor<1, 2> direction(const unsigned int from, const unsigned int to,
                         const bool by_halves = false) const
  {
    const CurvePiece piece = curve(from, to);
    if (!piece)
      return place(to) - place(from);
    return by_halves ? piece.point(0.5) - place(from) : piece.derivative(0);
  }

  /** The corner where two edges are one smooth curve, or one line; n_corners: there is none. */
  unsigned int flat_corner(const Element &cell, const bool by_halves = false) const
  {
    // Of files each cell that was taken as it is stays so; cells of our own may be better.
    const double least = file.is_drawing ? 170 : 179.9;
    const unsigned int n = n_corners(cell);
    double area = 0;
    for (unsigned int k = 0; k < n; ++k)
    {
      const Point<2> a = place(cell.nodes[k]), b = place(cell.nodes[(k + 1) % n]);
      area += a[0] * b[1] - a[1] * b[0];
    }
    for (unsigned int k = 0; k < n; ++k)
    {
      const unsigned int before = cell.nodes[(k + n - 1) % n], after = cell.nodes[(k + 1) % n];
      if (!curve(cell.nodes[k], before) && !curve(cell.nodes[k], after))
        continue; // of straight edges own checks know more
      const Tensor<1, 2> in = direction(cell.nodes[k], before, by_halves),
                         out = direction(cell.nodes[k], after, by_halves);
      const double turn = std::atan2(out[0] * in[1] - out[1] * in[0], out * in) * 180 / numbers::PI;
      const double degrees = area > 0 ? turn : -turn;
      if (degrees > least || degrees < least - 360 + 20)
        return k;
    }
    return n == 4 ? concave_corner(file, cell) : n;
  }

  /** Of whole meshes that hang together by edges. */
  std::vector<bool> cells_to_cut() const
  {
    DisjointSets meshes(file.elements.size());
    for (const auto &[ends, beside] : sides)
      for (const unsigned int e : beside)
        meshes.join(e, beside.front());
    std::vector<bool> is_bad(file.elements.size(), false), result(file.elements.size(), false);
    for (const unsigned int e : cells)
      if (n_corners(file.elements[e]) == 3 || flat_corner(file.elements[e]) < 4)
        is_bad[meshes.root(e)] = true;
    for (const unsigned int e : cells)
      result[e] = is_bad[meshes.root(e)];
    return result;
  }

  bool is_line_cut(const Element &line, const std::vector<bool> &is_cut) const
  {
    const auto beside = sides.find(ends_of(line.nodes[0], line.nodes[1]));
    return beside != sides.end() && is_cut[beside->second.front()];
  }

  unsigned int new_node(const Point<2> &x)
  {
    file.nodes.push_back({++last_tag(), Point<3>(x[0], x[1], 0)});
    return file.nodes.size() - 1;
  }

  std::int64_t &last_tag()
  {
    if (tag == 0)
      for (const GmshFile::Node &node : file.nodes)
        tag = std::max(tag, node.tag);
    return tag;
  }

  /** The node in the middle of an edge, whose halves follow its curve. */
  unsigned int middle(const unsigned int from, const unsigned int to)
  {
    const Ends ends = ends_of(from, to);
    const auto known = halves.find(ends);
    if (known != halves.end())
      return known->second;
    const CurvePiece piece = curve(ends[0], ends[1]);
    const unsigned int node =
        new_node(piece ? piece.point(0.5) : Point<2>((place(from) + place(to)) / 2.));
    if (piece)
    {
      file.set_curve(ends[0], node, piece.between(0, 0.5));
      file.set_curve(node, ends[1], piece.between(0.5, 1));
    }
    return halves[ends] = node;
  }

  void cut_line(const Element &line)
  {
    const unsigned int m = middle(line.nodes[0], line.nodes[1]);
    for (const auto &[a, b] : {std::pair(line.nodes[0], m), {m, line.nodes[1]}})
    {
      Element half = line;
      half.type = 1;
      half.nodes = {{a, b}};
      file.elements.push_back(half);
    }
  }

  void add(const Element &parent, const std::array<unsigned int, 4> &corners)
  {
    Element child = parent;
    child.type = 3;
    child.nodes = {};
    std::copy(corners.begin(), corners.end(), child.nodes.begin());
    file.elements.push_back(child);
  }

  void cut_cell(const Element &cell)
  {
    // Cells that are cut have their corners checked by chords.
    const unsigned int n = n_corners(cell), by_tangents = flat_corner(cell),
                       flat = by_tangents < n ? by_tangents : flat_corner(cell, n == 4);
    if (n == 4 && flat < 4)
      for (const unsigned int k : {flat, (flat + 2) % 4})
      {
        Element half = cell;
        half.type = 2;
        half.nodes = {{cell.nodes[k], cell.nodes[(k + 1) % 4], cell.nodes[(k + 2) % 4]}};
        cut_cell(half);
      }
    else if (n == 3 && flat < 3)
      cut_flat_triangle(cell, flat);
    else
      cut_around_centre(cell);
  }

  /** Each corner with its two edges and the centre. */
  void cut_around_centre(const Element &cell)
  {
    const unsigned int n = n_corners(cell);
    std::array<unsigned int, 4> m;
    Tensor<1, 2> sum;
    for (unsigned int k = 0; k < n; ++k)
    {
      m[k] = middle(cell.nodes[k], cell.nodes[(k + 1) % n]);
      sum += place(m[k]);
    }
    const unsigned int centre = new_node(Point<2>(sum / double(n)));
    for (unsigned int k = 0; k < n; ++k)
      add(cell, {{cell.nodes[k], m[k], centre, m[(k + n - 1) % n]}});
  }

  /** Two cells share the corner of 180 degrees; X, Y and Z make the smallest of their largest angles on circles of 10 to 50 degrees an edge. */
  void cut_flat_triangle(const Element &cell, const unsigned int flat)
  {
    const unsigned int a = cell.nodes[flat], b = cell.nodes[(flat + 1) % 3],
                       c = cell.nodes[(flat + 2) % 3], ab = middle(a, b), bc = middle(b, c),
                       ac = middle(a, c);
    const auto beside = [&](const unsigned int corner, const unsigned int side)
    {
      return Point<2>(0.385 * Tensor<1, 2>(place(a)) - 0.07 * Tensor<1, 2>(place(side)) +
                      0.54 * Tensor<1, 2>(place(bc)) + 0.145 * Tensor<1, 2>(place(corner)));
    };
    const unsigned int x = new_node(place(a) + 0.14 * (place(bc) - place(a))),
                       y = new_node(beside(b, ab)), z = new_node(beside(c, ac));
    add(cell, {{a, ab, y, x}});
    add(cell, {{ab, b, bc, y}});
    add(cell, {{x, y, bc, z}});
    add(cell, {{a, x, z, ac}});
    add(cell, {{ac, z, bc, c}});
  }

  GmshFile &file;
  const MeshComplaint &complain;
  std::vector<unsigned int> cells;                 ///< elements of two dimensions
  std::map<Ends, std::vector<unsigned int>> sides; ///< cells at each edge
  std::set<Ends> inner; ///< edges that are straight: between cells of one group, without a line
  std::set<Ends> lines; ///< edges with a line
  std::map<Ends, unsigned int> middles,
      halves;           ///< nodes of elements of second order; those made here
  std::int64_t tag = 0; ///< the largest of all nodes
};
} // namespace

void make_quadrilaterals(GmshFile &file, const MeshComplaint &complain)
{
  const bool has_triangles =
      std::any_of(file.elements.begin(), file.elements.end(),
                  [](const Element &element) { return element_kind(element.type).n_corners == 3; });
  const bool has_others =
      std::any_of(file.elements.begin(), file.elements.end(),
                  [](const Element &element)
                  {
                    const ElementKind kind = element_kind(element.type);
                    return kind.name == nullptr || kind.dim == 3 || kind.n_nodes == 0;
                  });
  const bool has_curves =
      !file.curves.empty() || std::any_of(file.elements.begin(), file.elements.end(),
                                          [](const Element &element)
                                          {
                                            const ElementKind kind = element_kind(element.type);
                                            return kind.n_nodes > kind.n_corners;
                                          });
  const bool has_concave =
      std::any_of(file.elements.begin(), file.elements.end(),
                  [&](const Element &element)
                  { return element.type == 3 && concave_corner(file, element) < 4; });
  if (!has_others && (has_triangles || has_curves || has_concave))
    Cutter(file, complain).cut();
}
} // namespace hpvi
