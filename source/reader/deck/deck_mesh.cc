// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/reader/deck/deck_mesh.h>

#include <algorithm>
#include <map>
#include <set>

namespace hpvi
{
using namespace dealii;

std::string scene_name(const std::string &name)
{
  std::string result;
  for (const unsigned char c : name)
    result += std::isalnum(c) || c == '_' || c == '-' || c == ' ' ? char(c) : '-';
  result = single_spaced(result.substr(std::min(result.find_first_not_of("_- "), result.size())));
  return result.empty() ? "unnamed" : result;
}

GmshFile mesh_of_deck(const Deck &deck, const std::vector<std::string> &surfaces,
                      const std::vector<NamedFaces> &curves)
{
  GmshFile file;
  file.origin = "a deck of CalculiX or Abaqus";
  std::vector<unsigned int> numbers(deck.nodes.size(), 0);
  for (const Deck::Element &element : deck.elements)
    for (const unsigned int node : element.nodes)
      numbers[node] = 1;
  std::set<std::int64_t> tags; // of several instances several nodes have one
  bool are_unique = true;
  for (unsigned int n = 0; n < numbers.size(); ++n)
    are_unique = are_unique && (numbers[n] == 0 || tags.insert(deck.nodes[n].number).second);
  for (unsigned int n = 0; n < numbers.size(); ++n)
    if (numbers[n] != 0)
    {
      numbers[n] = file.nodes.size();
      const Point<2> &at = deck.nodes[n].at;
      file.nodes.push_back({are_unique ? deck.nodes[n].number : n + 1, Point<3>(at[0], at[1], 0)});
    }
  std::map<std::string, std::int64_t> groups;
  for (unsigned int e = 0; e < deck.elements.size(); ++e)
  {
    const Deck::Element &element = deck.elements[e];
    const bool is_quadratic = element.nodes.size() > element.n_corners;
    GmshFile::Element cell;
    cell.type = element.n_corners == 3 ? (is_quadratic ? 9 : 2) : is_quadratic ? 16 : 3;
    cell.group = groups.emplace(surfaces[e], groups.size() + 1).first->second;
    cell.entity = cell.group;
    for (unsigned int k = 0; k < element.nodes.size(); ++k)
      cell.nodes[k] = numbers[element.nodes[k]];
    file.elements.push_back(cell);
  }
  for (const auto &[name, group] : groups)
    file.names[{2, group}] = name;
  std::int64_t group = 0;
  for (const NamedFaces &curve : curves)
  {
    file.names[{1, ++group}] = curve.name;
    for (const auto &[e, k] : curve.faces)
    {
      const std::vector<unsigned int> nodes = deck.elements[e].edge(k);
      GmshFile::Element line;
      line.type = nodes.size() == 3 ? 8 : 1;
      line.group = line.entity = group;
      for (unsigned int n = 0; n < nodes.size(); ++n)
        line.nodes[n] = numbers[nodes[n]];
      file.elements.push_back(line);
    }
  }
  return file;
}

GmshFile read_deck_mesh(const std::string &path)
{
  const Deck deck = read_deck(path);
  std::vector<std::string> surfaces;
  std::set<std::string> used;
  for (const Deck::Element &element : deck.elements)
  {
    surfaces.push_back(scene_name(deck.spelling.at(element.section)));
    used.insert(element.section);
  }
  const std::vector<Deck::Face> outer = deck.outer_faces();
  const std::set<Deck::Face> is_outer(outer.begin(), outer.end());
  std::vector<NamedFaces> candidates;
  const auto add = [&](const std::string &key, const std::vector<Deck::Face> &faces)
  {
    NamedFaces own{scene_name(deck.spelling.at(key)), {}};
    std::copy_if(faces.begin(), faces.end(), std::back_inserter(own.faces),
                 [&](const Deck::Face &face) { return is_outer.count(face) > 0; });
    if (!own.faces.empty())
      candidates.push_back(own);
  };
  for (const auto &[key, faces] : deck.surfaces)
    add(key, faces);
  for (const auto &[key, nodes] : deck.node_sets)
    if (deck.surfaces.count(key) == 0)
      add(key, faces_between(deck, nodes, outer));
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const NamedFaces &a, const NamedFaces &b)
                   { return a.faces.size() < b.faces.size(); });
  std::set<Deck::Face> taken;
  std::set<std::string> names;
  std::vector<NamedFaces> curves;
  for (NamedFaces &one : candidates)
  {
    std::vector<Deck::Face> own;
    for (const Deck::Face &face : one.faces)
      if (taken.insert(face).second)
        own.push_back(face);
    one.faces = own;
    if (!own.empty() && names.insert(lower_case(one.name)).second)
      curves.push_back(one);
  }
  return mesh_of_deck(deck, surfaces, curves);
}

std::string mesh_text(const GmshFile &file)
{
  std::string result = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n" +
                       std::to_string(file.names.size()) + "\n";
  for (const auto &[group, name] : file.names)
    result +=
        std::to_string(group.first) + " " + std::to_string(group.second) + " \"" + name + "\"\n";
  result += "$EndPhysicalNames\n$Nodes\n" + std::to_string(file.nodes.size()) + "\n";
  for (const GmshFile::Node &node : file.nodes)
    result += std::to_string(node.tag) + " " + text(node.at[0]) + " " + text(node.at[1]) + " " +
              text(node.at[2]) + "\n";
  result += "$EndNodes\n$Elements\n" + std::to_string(file.elements.size()) + "\n";
  std::size_t number = 0;
  for (const GmshFile::Element &element : file.elements)
  {
    result += std::to_string(++number) + " " + std::to_string(element.type) + " 2 " +
              std::to_string(element.group) + " " + std::to_string(element.entity);
    for (unsigned int k = 0; k < element_kind(element.type).n_nodes; ++k)
      result += " " + std::to_string(file.nodes[element.nodes[k]].tag);
    result += "\n";
  }
  return result + "$EndElements\n";
}
} // namespace hpvi
