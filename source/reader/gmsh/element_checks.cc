// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/gmsh/element_checks.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Elements that a body cannot have: how many of which kind, and what to do. */
[[noreturn]] void refuse(const std::vector<GmshFile::Element> &elements,
                         const GmshFile::Element &first, const MeshComplaint &complain)
{
  const ElementKind kind = element_kind(first.type);
  const auto is_same = [&](const GmshFile::Element &element)
  {
    const ElementKind other = element_kind(element.type);
    return kind.name == nullptr ? element.type == first.type : other.name == std::string(kind.name);
  };
  const std::string n = std::to_string(std::count_if(elements.begin(), elements.end(), is_same));
  const std::string name =
      kind.name == nullptr ? "elements of type " + std::to_string(first.type) : kind.name;
  complain.of(first.number,
              "the mesh has " + name + " (" + n + "); a body in the plane has " +
                  (kind.dim == 3 ? "none: set Dimension = 3, or save a plane one"
                                 : "triangles and quadrilaterals: mesh it with these"));
}

[[noreturn]] void refuse_groupless(const GmshFile &file, const GmshFile::Element &first,
                                   const unsigned int n, const unsigned int n_cells,
                                   const MeshComplaint &complain)
{
  Point<2> centre;
  for (unsigned int k = 0; k < 4; ++k)
    for (unsigned int d = 0; d < 2; ++d)
      centre[d] += file.nodes[first.nodes[k]].at[d] / 4;
  complain.of(first.number, std::to_string(n) + " of " + std::to_string(n_cells) +
                                " cells are in no physical surface, the first about " +
                                to_string(centre) +
                                "; give each surface one in the drawing, as in Physical "
                                "Surface(\"plate\") = {1};");
}
} // namespace

void check_elements(const GmshFile &file, const MeshComplaint &complain)
{
  const auto refuse_any = [&](const auto &is_unfit)
  {
    const auto found = std::find_if(file.elements.begin(), file.elements.end(), is_unfit);
    if (found != file.elements.end())
      refuse(file.elements, *found, complain);
  };
  refuse_any([](const GmshFile::Element &element) { return element_kind(element.type).dim == 3; });
  refuse_any([](const GmshFile::Element &element)
             { return element_kind(element.type).n_nodes == 0; });
  unsigned int n_cells = 0, n = 0;
  const GmshFile::Element *first = nullptr;
  for (const GmshFile::Element &element : file.elements)
    if (element_kind(element.type).dim == 2)
    {
      ++n_cells;
      if (element.group == 0 && n++ == 0)
        first = &element;
    }
  if (n_cells == 0)
    complain("has no cells; mesh the drawing with gmsh -2, and give its surfaces physical groups");
  if (n > 0)
    refuse_groupless(file, *first, n, n_cells, complain);
}

double size_of(const CoarseMesh &mesh, const MeshComplaint &complain)
{
  double size = 0, largest = 0;
  for (unsigned int d = 0; d < 2; ++d)
  {
    const auto [low, high] = std::minmax_element(mesh.vertices.begin(), mesh.vertices.end(),
                                                 [d](const Point<2> &one, const Point<2> &two)
                                                 { return one[d] < two[d]; });
    size = std::max(size, (*high)[d] - (*low)[d]);
    largest = std::max({largest, std::abs((*high)[d]), std::abs((*low)[d])});
  }
  if (!(size >= 1e-100 && largest <= 1e100))
    complain("the body is " + to_string(size) + " wide and reaches to " + to_string(largest) +
             ", and lengths must lie between 1e-100 and 1e100; choose another unit");
  return size;
}

void check_places(const GmshFile &file, const CoarseMesh &mesh,
                  const std::vector<unsigned int> &nodes, const double size,
                  const MeshComplaint &complain)
{
  // Sorted by x, then by y within runs of x that round-off alone makes differ.
  const double tolerance = 1e-12 * size;
  const auto &x = mesh.vertices;
  std::vector<unsigned int> order(x.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](const unsigned int v, const unsigned int w) { return x[v][0] < x[w][0]; });
  unsigned int n = 0, first = 0, second = 0;
  for (auto begin = order.begin(); begin != order.end();)
  {
    auto end = begin + 1;
    while (end != order.end() && x[*end][0] - x[*(end - 1)][0] <= tolerance)
      ++end;
    std::sort(begin, end,
              [&](const unsigned int v, const unsigned int w) { return x[v][1] < x[w][1]; });
    for (auto v = begin; v + 1 != end; ++v)
      if (x[v[0]].distance(x[v[1]]) <= tolerance && n++ == 0)
      {
        first = std::min(v[0], v[1]);
        second = std::max(v[0], v[1]);
      }
    begin = end;
  }
  if (n > 0)
    complain("the nodes " + std::to_string(file.nodes[nodes[first]].tag) + " and " +
             std::to_string(file.nodes[nodes[second]].tag) + " are both at " + to_string(x[first]) +
             (n > 1 ? ", one of " + std::to_string(n) + " such pairs" : "") +
             "; give surfaces that touch one curve there, Coherence in the drawing makes it, or a "
             "subsection Body NAME for each with its Surfaces, if they are bodies of their own");
}
} // namespace hpvi
