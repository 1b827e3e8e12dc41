// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/gmsh/gmsh_file.h>
#include <hpvi/reader/gmsh/gmsh_text.h>

#include <algorithm>
#include <unordered_map>

namespace hpvi
{
using namespace dealii;

ElementKind element_kind(const std::int64_t type)
{
  static const std::map<std::int64_t, ElementKind> kinds = {
      {1, {"lines", 1, 2, 2}},
      {2, {"triangles", 2, 3, 3}},
      {3, {"quadrilaterals", 2, 4, 4}},
      {4, {"tetrahedra", 3, 4, 4}},
      {5, {"hexahedra", 3, 8, 8}},
      {6, {"prisms", 3, 6, 6}},
      {7, {"pyramids", 3, 0, 5}},
      {8, {"lines", 1, 3, 2}},
      {9, {"triangles", 2, 6, 3}},
      {10, {"quadrilaterals", 2, 9, 4}},
      {11, {"tetrahedra", 3, 0, 4}},
      {12, {"hexahedra", 3, 0, 8}},
      {13, {"prisms", 3, 0, 6}},
      {14, {"pyramids", 3, 0, 5}},
      {15, {"points", 0, 1, 1}},
      {16, {"quadrilaterals", 2, 8, 4}},
      {17, {"hexahedra", 3, 0, 8}},
      {18, {"prisms", 3, 0, 6}},
      {19, {"pyramids", 3, 0, 5}},
      {20, {"triangles", 2, 0, 3}},
      {21, {"triangles", 2, 0, 3}},
      {26, {"lines of third order", 1, 0, 2}},
      {27, {"lines of fourth order", 1, 0, 2}},
      {36, {"quadrilaterals of third order", 2, 0, 4}},
      {37, {"quadrilaterals of fourth order", 2, 0, 4}}};
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

namespace
{
class GmshReader
{
public:
  explicit GmshReader(const std::string &path) : text(path)
  {
    file.version = text.version();
  }

  GmshFile read()
  {
    if (text.has("PhysicalNames"))
      read_names();
    const bool has_blocks = file.version[0] == '4';
    if (text.has("PartitionedEntities"))
      text.complain("is cut into partitions; save the mesh as it was before");
    if (has_blocks && text.has("Entities"))
      read_entities();
    has_blocks ? read_node_blocks() : read_nodes();
    has_blocks ? read_element_blocks() : read_elements();
    unite_groups();
    return std::move(file);
  }

private:
  bool is_4_0() const
  {
    return file.version != "4.1";
  }

  /** Lines of `dimension tag "name"`, the name from the first quote to the last. */
  void read_names()
  {
    GmshRecords records(text, "PhysicalNames");
    records.next("the number of names", 1);
    for (std::size_t n = records.count(0, "names"); n > 0; --n)
    {
      records.next("a physical name", 3);
      const std::string line(records.line());
      const std::size_t first = line.find('"'), last = line.rfind('"');
      const std::int64_t dim = records.integer(0);
      if (first == std::string::npos || last == first || dim < 0 || dim > 3)
        records.damaged("the line is no dimension, tag and name in quotes");
      if (!file.names.insert({{dim, records.tag(1)}, line.substr(first + 1, last - first - 1)})
               .second)
        records.damaged("a physical group has a second name here");
    }
    records.finish();
  }

  /** Of points, curves, surfaces and volumes the physical groups; all lines begin with tag and box. */
  void read_entities()
  {
    GmshRecords records(text, "Entities");
    records.next("the numbers of points, curves, surfaces and volumes", 4);
    std::array<std::size_t, 4> numbers;
    for (unsigned int dim = 0; dim < 4; ++dim)
      numbers[dim] = records.count(dim, "entities");
    for (unsigned int dim = 0; dim < 4; ++dim)
      for (std::size_t n = numbers[dim]; n > 0; --n)
        read_entity(records, dim);
    records.finish();
    for (const auto &[entity, groups] : entities)
      for (const std::int64_t group : groups)
        ++n_entities[{entity.first, group}];
  }

  void read_entity(GmshRecords &records, const unsigned int dim)
  {
    const std::size_t groups = dim == 0 && !is_4_0() ? 4 : 7;
    records.next("an entity", groups + 1);
    const std::int64_t n = records.integer(groups);
    if (n < 0 || std::uint64_t(n) > records.n_words() - groups - 1)
      records.damaged("the entity announces more physical groups than the line has");
    std::vector<std::int64_t> all;
    for (std::int64_t k = 1; k <= n; ++k)
      all.push_back(std::abs(records.integer(groups + k))); // negative: turned round
    if (!entities.insert({{dim, records.integer(0)}, all}).second)
      records.damaged("an entity of this dimension and tag is there already");
  }

  /** Of several groups the one with the fewest entities, of equal ones the first. */
  std::int64_t group_of(const std::int64_t dim, const std::vector<std::int64_t> &groups) const
  {
    const auto best = std::min_element(
        groups.begin(), groups.end(),
        [&](const std::int64_t a, const std::int64_t b) {
          return std::pair(n_entities.at({dim, a}), a) < std::pair(n_entities.at({dim, b}), b);
        });
    return best == groups.end() ? 0 : *best;
  }

  /** Two groups of one name are one. */
  void unite_groups()
  {
    std::map<std::pair<unsigned int, std::string>, std::int64_t> first;
    for (auto named = file.names.begin(); named != file.names.end();)
    {
      const auto [dim, tag] = named->first;
      const auto [same, is_new] = first.insert({{dim, named->second}, tag});
      if (!is_new)
        for (GmshFile::Element &element : file.elements)
          if (element.group == tag && element_kind(element.type).dim == dim)
            element.group = same->second;
      named = is_new ? std::next(named) : file.names.erase(named);
    }
  }

  void add_node(const GmshRecords &records, const std::int64_t tag, const std::size_t first_word)
  {
    if (!indices.insert({tag, file.nodes.size()}).second)
      records.damaged("the node " + std::to_string(tag) + " is there already");
    Point<3> at;
    for (unsigned int d = 0; d < 3; ++d)
      at[d] = records.real(first_word + d);
    file.nodes.push_back({tag, at});
  }

  void read_nodes()
  {
    GmshRecords records(text, "Nodes");
    records.next("the number of nodes", 1);
    for (std::size_t n = records.count(0, "nodes"); n > 0; --n)
    {
      records.next("a node", 4);
      add_node(records, records.tag(0), 1);
    }
    records.finish();
  }

  /** Blocks of tags, then of coordinates; in 4.0 of both together. */
  void read_node_blocks()
  {
    GmshRecords records(text, "Nodes");
    records.next("the numbers of blocks and nodes", 2);
    const std::size_t n_nodes = records.count(1, "nodes");
    for (std::size_t n = records.count(0, "blocks"); n > 0; --n)
    {
      records.next("a block of nodes", 4);
      std::vector<std::int64_t> tags(records.count(3, "nodes"));
      for (std::int64_t &tag : tags)
      {
        records.next("a node", is_4_0() ? 4 : 1);
        tag = records.tag(0);
        if (is_4_0())
          add_node(records, tag, 1);
      }
      for (std::size_t k = 0; k < tags.size() && !is_4_0(); ++k)
      {
        records.next("the place of a node", 3);
        add_node(records, tags[k], 0);
      }
    }
    if (file.nodes.size() != n_nodes)
      records.damaged("$Nodes announces " + std::to_string(n_nodes) + " nodes and has " +
                      std::to_string(file.nodes.size()));
    records.finish();
  }

  void add_element(const GmshRecords &records, const std::int64_t type, const std::int64_t group,
                   const std::int64_t entity, const std::size_t first_word)
  {
    const ElementKind kind = element_kind(type);
    if (kind.n_nodes > 0 && records.n_words() != first_word + kind.n_nodes)
      records.damaged("the line has " + std::to_string(records.n_words()) +
                      " numbers, and an element of type " + std::to_string(type) + " has " +
                      std::to_string(first_word + kind.n_nodes) + " here");
    GmshFile::Element element;
    element.type = type;
    element.group = group;
    element.entity = entity;
    element.line = records.line_number();
    for (unsigned int k = 0; k < kind.n_nodes; ++k)
    {
      const auto node = indices.find(records.tag(first_word + k));
      if (node == indices.end())
        records.damaged("the element has a node " +
                        std::to_string(records.integer(first_word + k)) + " that $Nodes lacks");
      element.nodes[k] = node->second;
    }
    if (type != 15)
      file.elements.push_back(element);
  }

  /** `tag, type, number of tags, these, nodes`; the first of the tags is the physical group. */
  void read_elements()
  {
    GmshRecords records(text, "Elements");
    records.next("the number of elements", 1);
    for (std::size_t n = records.count(0, "elements"); n > 0; --n)
    {
      records.next("an element", 4);
      const std::int64_t n_tags = records.integer(2);
      if (n_tags < 0 || std::uint64_t(n_tags) > records.n_words() - 3)
        records.damaged("the element announces more tags than the line has");
      records.tag(0);
      add_element(records, records.integer(1), n_tags == 0 ? 0 : std::abs(records.integer(3)),
                  n_tags < 2 ? 0 : std::abs(records.integer(4)), 3 + n_tags);
    }
    records.finish();
  }

  /** Each block tells its entity, which knows the group. */
  void read_element_blocks()
  {
    GmshRecords records(text, "Elements");
    records.next("the numbers of blocks and elements", 2);
    const std::size_t n_elements = records.count(1, "elements");
    std::size_t n_read = 0;
    for (std::size_t n = records.count(0, "blocks"); n > 0; --n)
    {
      records.next("a block of elements", 4);
      const std::int64_t dim = records.integer(is_4_0() ? 1 : 0), type = records.integer(2);
      const std::int64_t entity = records.integer(is_4_0() ? 0 : 1);
      const std::int64_t group = group_of(records, dim, entity);
      if (const ElementKind kind = element_kind(type); kind.name != nullptr && kind.dim != dim)
        records.damaged("a block of dimension " + std::to_string(dim) + " holds " + kind.name);
      for (std::size_t k = records.count(3, "elements"); k > 0; --k, ++n_read)
      {
        records.next("an element", 2);
        records.tag(0);
        add_element(records, type, group, entity, 1);
      }
    }
    if (n_read != n_elements)
      records.damaged("$Elements announces " + std::to_string(n_elements) + " elements and has " +
                      std::to_string(n_read));
    records.finish();
  }

  std::int64_t group_of(const GmshRecords &records, const std::int64_t dim,
                        const std::int64_t tag) const
  {
    const auto entity = entities.find({dim, tag});
    if (entity == entities.end() && text.has("Entities"))
      records.damaged("the block belongs to an entity of dimension " + std::to_string(dim) +
                      " and tag " + std::to_string(tag) + " that $Entities lacks");
    return entity == entities.end() ? 0 : group_of(dim, entity->second);
  }

  const GmshText text;
  GmshFile file;
  /** Their physical groups, and how many entities each of these has. */
  std::map<std::pair<std::int64_t, std::int64_t>, std::vector<std::int64_t>> entities;
  std::map<std::pair<std::int64_t, std::int64_t>, std::size_t> n_entities;
  std::unordered_map<std::int64_t, unsigned int> indices; ///< of nodes, by tag
};
} // namespace

GmshFile read_gmsh_file(const std::string &path)
{
  return GmshReader(path).read();
}
} // namespace hpvi
