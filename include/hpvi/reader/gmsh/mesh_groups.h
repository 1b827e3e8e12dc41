// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_mesh_groups_h
#define hpvi_mesh_groups_h

#include <hpvi/reader/gmsh/cell_edges.h>
#include <hpvi/reader/gmsh/gmsh_file.h>

namespace hpvi
{
/** Numbers and names of the physical groups that have elements, in the order of their tags. */
class GroupNumbers
{
public:
  /** Throws InputError for a name that no scene can write, and for two that differ in case alone. */
  GroupNumbers(const GmshFile &file, unsigned int dim, std::vector<std::int64_t> tags,
               const MeshComplaint &complain);

  /** Of one of the tags. What is in no group has the last number, and an empty name. */
  unsigned int number(std::int64_t tag) const;

  std::vector<std::string> names() const;

private:
  std::vector<std::int64_t> tags; ///< ascending, 0 at the end
  std::vector<std::string> all_names;
};

/** What edges are called, by the tag of the physical curve on each of them, 0 for none. */
class EdgeGroups
{
public:
  /** Throws InputError where a curve lies on the boundary and inside. */
  EdgeGroups(const GmshFile &file, const CoarseMesh &mesh, const CellEdges &edges,
             const std::vector<std::int64_t> &groups, const MeshComplaint &complain);

  const GroupNumbers boundaries, interfaces;

  /** CellEdges::loops(), each from where a group begins. */
  std::vector<unsigned int> ordered_loops() const;

private:
  const CellEdges &edges;
  const std::vector<std::int64_t> &groups;
};
} // namespace hpvi

#endif
