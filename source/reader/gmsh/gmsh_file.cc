// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/gmsh/gmsh_file.h>

#include <algorithm>
#include <tuple>

namespace hpvi
{
using namespace dealii;

ElementKind element_kind(const std::int64_t type)
{
  static const std::map<std::int64_t, ElementKind> kinds = {
      {1, {"lines", 1, 2, 2}},           {2, {"triangles", 2, 3, 3}},
      {3, {"quadrilaterals", 2, 4, 4}},  {4, {"tetrahedra", 3, 4, 4}},
      {5, {"hexahedra", 3, 8, 8}},       {6, {"prisms", 3, 6, 6}},
      {7, {"pyramids", 3, 0, 5}},        {8, {"lines", 1, 3, 2}},
      {9, {"triangles", 2, 6, 3}},       {10, {"quadrilaterals", 2, 9, 4}},
      {12, {"hexahedra", 3, 27, 8}},     {15, {"points", 0, 1, 1}},
      {16, {"quadrilaterals", 2, 8, 4}}, {17, {"hexahedra", 3, 20, 8}}};
  const auto found = kinds.find(type);
  return found == kinds.end() ? ElementKind{nullptr, 0, 0, 0} : found->second;
}

std::string GmshFile::words(const Group &group) const
{
  const auto found = names.find(group);
  return (group.first == 1   ? "curve \""
          : group.first == 2 ? "surface \""
                             : "volume \"") +
         (found == names.end() ? std::to_string(group.second) : printable(found->second, 40)) + '"';
}

void GmshFile::set_curve(const unsigned int from, const unsigned int to, const CurvePiece &piece)
{
  if (from < to)
    curves[{{from, to}}] = piece;
  else
    curves[{{to, from}}] = piece.between(1, 0);
}

CurvePiece GmshFile::curve(const unsigned int from, const unsigned int to) const
{
  const auto found = curves.find({{std::min(from, to), std::max(from, to)}});
  return found == curves.end() ? CurvePiece()
         : from < to           ? found->second
                               : found->second.between(1, 0);
}

void GmshFile::take_smallest_groups()
{
  std::map<Group, std::size_t> n_elements;
  for (const Element &element : elements)
    ++n_elements[{element_kind(element.type).dim, element.group}];
  const auto rank = [&](const Element &element)
  {
    const std::size_t n = n_elements.at({element_kind(element.type).dim, element.group});
    return std::tuple(element.group == 0, n, element.group);
  };
  std::map<std::vector<unsigned int>, std::size_t> known;
  std::vector<Element> kept;
  for (const Element &element : elements)
  {
    const ElementKind kind = element_kind(element.type);
    std::vector<unsigned int> corners(element.nodes.begin(),
                                      element.nodes.begin() + kind.n_corners);
    std::sort(corners.begin(), corners.end());
    const auto [place, is_new] = known.try_emplace(corners, kept.size());
    if (is_new || kind.n_corners == 0 || kept[place->second].group == element.group)
      kept.push_back(element);
    else if (rank(element) < rank(kept[place->second]))
      kept[place->second] = element;
  }
  elements = kept;
}
} // namespace hpvi
