// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/gmsh/cell_checks.h>
#include <hpvi/reader/gmsh/curve_numbers.h>

#include <algorithm>
#include <set>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Has no element of so many dimensions a group, nor a group a name? */
bool is_without_groups(const GmshFile &file, const unsigned int dim)
{
  return std::none_of(file.elements.begin(), file.elements.end(),
                      [dim](const GmshFile::Element &element)
                      { return element.group != 0 && element_kind(element.type).dim == dim; }) &&
         std::none_of(file.names.begin(), file.names.end(),
                      [dim](const auto &name) { return name.first.first == dim; });
}

/** Behind all tags of a drawing. */
constexpr std::int64_t first_named = 1000000000;

/** The group of a curve that the request names; 0: it names none. */
std::int64_t named_group(const DrawingRequest &request, const std::int64_t curve)
{
  const auto found = request.curves.find(curve);
  if (found == request.curves.end())
    return 0;
  std::int64_t group = first_named;
  for (const std::string &name : names_of_curves(request))
    if (name != found->second)
      ++group;
    else
      break;
  return group;
}

void check_curves(const DrawingRequest &request, const std::set<std::int64_t> &known,
                  const MeshComplaint &complain)
{
  std::vector<std::string> words;
  for (const std::int64_t curve : known)
    words.push_back(std::to_string(curve));
  for (const auto &[curve, name] : request.curves)
    if (known.count(curve) == 0)
      complain("has no curve " + std::to_string(curve) + ", which Boundary " + name +
               "/Curves names; it has " +
               (words.size() <= 40 ? listed(words, "and") : words.front() + " to " + words.back()));
}
} // namespace

void number_groups(GmshFile &file, const unsigned int dim, const DrawingRequest &request,
                   const MeshComplaint &complain)
{
  std::int64_t group = first_named;
  for (const std::string &name : names_of_curves(request))
    file.names[{1, group++}] = name;
  const bool has_no_surfaces = is_without_groups(file, dim);
  if (request.curves.empty())
    file.is_numbered = is_without_groups(file, dim - 1);
  else
    file.is_numbered =
        std::none_of(file.elements.begin(), file.elements.end(),
                     [dim](const GmshFile::Element &element)
                     { return element.group != 0 && element_kind(element.type).dim == dim - 1; });
  std::set<std::int64_t> curves;
  for (GmshFile::Element &element : file.elements)
  {
    const unsigned int own = element_kind(element.type).dim;
    if (own == dim && has_no_surfaces)
      element.group = std::max<std::int64_t>(element.entity, 1);
    if (own != dim - 1 || element.entity == 0)
      continue;
    curves.insert(element.entity);
    if (file.is_numbered)
      element.group = element.entity;
    if (const std::int64_t named = named_group(request, element.entity))
      element.group = named;
  }
  if (!curves.empty())
    check_curves(request, curves, complain);
}

std::vector<std::int64_t> groups_between_corners(const CoarseMesh &mesh, const CellEdges &edges,
                                                 const std::vector<CurvePiece> &curves,
                                                 const DrawingRequest &request,
                                                 const MeshComplaint &complain)
{
  std::vector<std::int64_t> groups(edges.all().size(), 0);
  const std::vector<unsigned int> &loops = edges.loops();
  const auto direction = [&](const unsigned int e, const double s) -> Tensor<1, 2>
  {
    const auto &ends = edges.all()[e].vertices;
    return curves[e] ? curves[e].derivative(s) : mesh.vertices[ends[1]] - mesh.vertices[ends[0]];
  };
  const auto is_corner = [&](const unsigned int before, const unsigned int after)
  {
    const double turn = degrees_between(direction(before, 1), direction(after, 0));
    return turn > 30 && turn < 330;
  };
  std::int64_t number = 0;
  std::set<std::int64_t> known;
  for (auto begin = loops.begin(); begin != loops.end();)
  {
    auto end = begin;
    while (edges.all()[*end].vertices[1] != edges.all()[*begin].vertices[0])
      ++end;
    std::vector<unsigned int> loop(begin, ++end);
    for (unsigned int k = 0; k < loop.size(); ++k)
      if (is_corner(loop.back(), loop.front()))
        break;
      else
        std::rotate(loop.begin(), loop.begin() + 1, loop.end());
    for (unsigned int k = 0; k < loop.size(); ++k)
    {
      if (k == 0 || is_corner(loop[k - 1], loop[k]))
        known.insert(++number);
      const std::int64_t named = named_group(request, number);
      groups[loop[k]] = named != 0 ? named : number;
    }
    begin = end;
  }
  check_curves(request, known, complain);
  return groups;
}
} // namespace hpvi
