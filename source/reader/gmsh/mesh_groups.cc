// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/gmsh/mesh_groups.h>

#include <algorithm>
#include <map>

namespace hpvi
{
namespace
{
/** As a scene may write it behind `subsection Boundary`. */
bool is_name(const std::string &name)
{
  const auto is_fit = [](const char c)
  {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == ' ';
  };
  return !name.empty() && std::all_of(name.begin(), name.end(), is_fit) &&
         name == single_spaced(name);
}
} // namespace

GroupNumbers::GroupNumbers(const GmshFile &file, const unsigned int dim,
                           std::vector<std::int64_t> given, const MeshComplaint &complain)
    : tags(std::move(given))
{
  const auto comes_before = [](const std::int64_t one, const std::int64_t two)
  { return (one == 0) != (two == 0) ? two == 0 : one < two; };
  std::sort(tags.begin(), tags.end(), comes_before);
  tags.erase(std::unique(tags.begin(), tags.end()), tags.end());
  std::map<std::string, std::int64_t> known;
  for (const std::int64_t tag : tags)
  {
    const auto found = file.names.find({dim, tag});
    all_names.push_back(tag == 0                    ? ""
                        : found == file.names.end() ? std::to_string(tag)
                                                    : found->second);
    if (tag != 0 && !is_name(all_names.back()))
      complain("the physical " + file.words({dim, tag}) +
               " has no name for a scene; take letters, digits, '_', '-' and single blanks between "
               "them");
    const auto [same, is_new] = known.insert({lower_case(all_names.back()), tag});
    if (!is_new)
      complain("the physical groups " + std::to_string(same->second) + " and " +
               std::to_string(tag) + " are called " + file.words({dim, same->second}) + " and " +
               file.words({dim, tag}) + "; give them names that differ, not in case alone");
  }
}

unsigned int GroupNumbers::number(const std::int64_t tag) const
{
  if (tag == 0)
    return tags.size() - 1;
  return std::lower_bound(tags.begin(), tags.end() - (tags.back() == 0 ? 1 : 0), tag) -
         tags.begin();
}

std::vector<std::string> GroupNumbers::names() const
{
  return all_names;
}

namespace
{
std::vector<std::int64_t> tags_of(const CellEdges &edges, const std::vector<std::int64_t> &groups,
                                  const bool on_boundary)
{
  std::vector<std::int64_t> tags;
  for (unsigned int e = 0; e < groups.size(); ++e)
    if (edges.all()[e].is_on_boundary() == on_boundary && (on_boundary || groups[e] != 0))
      tags.push_back(groups[e]);
  return tags;
}
} // namespace

EdgeGroups::EdgeGroups(const GmshFile &file, const CoarseMesh &mesh, const CellEdges &edges,
                       const std::vector<std::int64_t> &groups, const MeshComplaint &complain)
    : boundaries(file, 1, tags_of(edges, groups, true), complain),
      interfaces(file, 1, tags_of(edges, groups, false), complain), edges(edges), groups(groups)
{
  struct Parts
  {
    unsigned int n_outside = 0, n_inside = 0, first_inside = 0;
  };
  std::map<std::int64_t, Parts> parts;
  for (unsigned int e = 0; e < groups.size(); ++e)
    if (groups[e] != 0)
    {
      Parts &part = parts[groups[e]];
      if (edges.all()[e].is_on_boundary())
        ++part.n_outside;
      else if (part.n_inside++ == 0)
        part.first_inside = e;
    }
  for (const auto &[tag, part] : parts)
    if (part.n_outside > 0 && part.n_inside > 0)
      complain("the physical " + file.words({1, tag}) + " has " + std::to_string(part.n_outside) +
               (part.n_outside == 1 ? " edge" : " edges") + " on the boundary and " +
               std::to_string(part.n_inside) + " between two cells, the first of these " +
               edge_in_words(mesh, edges.all()[part.first_inside].vertices) +
               "; give those inside a group of their own, or none");
}

std::vector<unsigned int> EdgeGroups::ordered_loops() const
{
  std::vector<unsigned int> result = edges.loops();
  const auto vertices = [&](const unsigned int e) { return edges.all()[e].vertices; };
  for (auto begin = result.begin(); begin != result.end();)
  {
    auto end = begin;
    while (vertices(*end)[1] != vertices(*begin)[0])
      ++end;
    ++end;
    const auto change =
        std::find_if(begin, end, [&](const unsigned int e) { return groups[e] != groups[*begin]; });
    if (change != end && groups[*(end - 1)] == groups[*begin])
      std::rotate(begin, change, end);
    begin = end;
  }
  return result;
}
} // namespace hpvi
