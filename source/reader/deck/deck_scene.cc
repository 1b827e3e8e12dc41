// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/disjoint_sets.h>
#include <hpvi/base/formatting.h>
#include <hpvi/base/parameter_file.h>
#include <hpvi/base/text.h>
#include <hpvi/reader/deck/deck_history.h>
#include <hpvi/reader/deck/deck_mesh.h>
#include <hpvi/reader/deck/deck_scene.h>

#include <deal.II/base/numbers.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace hpvi
{
using namespace dealii;

namespace
{
using Values = std::vector<std::pair<Point<2>, double>>;

/** As "a", "a + b*x" or with y: the linear function through all of them; empty where there is none. */
std::string linear_function(const Values &values)
{
  double largest = 0, size = 0;
  Point<2> centre;
  for (const auto &[at, value] : values)
  {
    largest = std::max(largest, std::abs(value));
    centre += at / double(values.size());
  }
  for (const auto &[at, value] : values)
    size = std::max(size, at.distance(centre));
  if (largest == 0)
    return "0";
  for (const std::vector<unsigned int> &axes :
       std::vector<std::vector<unsigned int>>{{}, {0}, {1}, {0, 1}})
  {
    // Least squares in coordinates of the size 1 about the centre.
    const unsigned int n = 1 + axes.size();
    const auto term = [&](const Point<2> &at, const unsigned int k)
    { return k == 0 ? 1. : (at[axes[k - 1]] - centre[axes[k - 1]]) / size; };
    FullMatrix<double> A(n, n);
    Vector<double> b(n), c(n);
    for (const auto &[at, value] : values)
      for (unsigned int i = 0; i < n; ++i)
      {
        b[i] += term(at, i) * value;
        for (unsigned int j = 0; j < n; ++j)
          A(i, j) += term(at, i) * term(at, j);
      }
    bool is_flat = false;
    for (unsigned int i = 0; i < n; ++i)
      is_flat = is_flat || A(i, i) < 1e-12 * values.size();
    if (n == 3)
      is_flat = is_flat || A(1, 1) * A(2, 2) - A(1, 2) * A(1, 2) < 1e-10 * A(1, 1) * A(2, 2);
    if (is_flat)
      continue;
    FullMatrix<double> inverse(n, n);
    inverse.invert(A);
    inverse.vmult(c, b);
    const bool fits = std::all_of(values.begin(), values.end(),
                                  [&](const auto &one)
                                  {
                                    double there = 0;
                                    for (unsigned int k = 0; k < n; ++k)
                                      there += c[k] * term(one.first, k);
                                    return std::abs(there - one.second) <= 1e-6 * largest;
                                  });
    if (!fits)
      continue;
    if (n == 1)
      return text(values.front().second);
    double begin = c[0];
    std::string slopes;
    for (unsigned int k = 1; k < n; ++k)
    {
      const double slope = rounded(c[k] / size, 12);
      begin -= slope * centre[axes[k - 1]];
      slopes +=
          (slope < 0 ? " - " : " + ") + text(std::abs(slope)) + (axes[k - 1] == 0 ? "*x" : "*y");
    }
    return text(std::abs(begin) < 1e-12 * largest ? 0. : rounded(begin, 12)) + slopes;
  }
  return "";
}

/** A stiff body that the deck holds in each of its nodes. */
constexpr unsigned int rigid_factor = 100000;

class SceneMaker
{
public:
  explicit SceneMaker(const std::string &path)
      : complain{path}, deck(read_deck(path)), history(history_of(deck)), outer(deck.outer_faces()),
        size(deck.size()), is_turned(deck.elements.front().plane == PlaneModel::axisymmetric)
  {
  }

  DeckScene make()
  {
    find_bodies();
    name_bodies();
    find_contact();
    find_sides();
    for (Deck::Pair &pair : deck.pairs)
      part_surfaces(pair);
    check_nodes();
    check_faces();
    write_head();
    write_bodies();
    write_materials();
    for (Side &side : sides)
      write_side(side);
    write_pairs();
    write_body_forces();
    write_temperature();
    std::vector<NamedFaces> curves;
    for (const Side &side : sides)
      curves.push_back({side.name, side.faces});
    const GmshFile file = mesh_of_deck(deck, surfaces, curves);
    return {scene, mesh_text(file), deck.left_out, deck.meant};
  }

private:
  struct Body
  {
    std::string name;
    std::vector<unsigned int> elements;
    std::vector<std::string> sections; ///< keys of materials and angles in it
    bool is_rigid = false;             ///< are all of its nodes held?
  };

  /** Edges of one body on which the same acts. */
  struct Side
  {
    unsigned int body;
    unsigned int contact; ///< number of its surfaces, from 1 on; 0: none
    std::array<std::set<std::string>, 2> supports, forces; ///< names, by component
    std::string pressure;                                  ///< course in words
    std::string name;
    std::vector<Deck::Face> faces;

    auto key() const
    {
      return std::tie(body, contact, supports, forces, pressure);
    }

    bool is_free() const
    {
      return contact == 0 && supports[0].empty() && supports[1].empty() && forces[0].empty() &&
             forces[1].empty() && pressure.empty();
    }

    bool has_loads() const
    {
      Side bare = *this;
      bare.contact = 0;
      return !bare.is_free();
    }
  };

  void leave_out(const std::string &place, const std::string &what)
  {
    deck.left_out.push_back(place + ": " + what);
  }

  void mean(const std::string &place, const std::string &what)
  {
    deck.meant.push_back(place + ": " + what);
  }

  std::string spelled(const std::string &key) const
  {
    const auto found = deck.spelling.find(key);
    return scene_name(found == deck.spelling.end() ? key : found->second);
  }

  /** That no other has, in whatever case. */
  static std::string unique(const std::string &name, std::set<std::string> &names)
  {
    std::string result = name;
    for (unsigned int k = 2; !names.insert(lower_case(result)).second; ++k)
      result = name + " " + std::to_string(k);
    return result;
  }

  // ------------------------------------------------------------ bodies

  /** Elements that edges connect. */
  void find_bodies()
  {
    DisjointSets sets(deck.elements.size());
    std::map<std::pair<unsigned int, unsigned int>, unsigned int> edges;
    for (unsigned int e = 0; e < deck.elements.size(); ++e)
      for (unsigned int k = 0; k < deck.elements[e].n_corners; ++k)
      {
        const auto ends = std::minmax({deck.elements[e].corner(k), deck.elements[e].corner(k + 1)});
        sets.join(e, edges.emplace(ends, e).first->second);
      }
    std::map<unsigned int, unsigned int> numbers;
    for (unsigned int e = 0; e < deck.elements.size(); ++e)
    {
      const auto [found, is_new] = numbers.emplace(sets.root(e), bodies.size());
      if (is_new)
        bodies.emplace_back();
      Body &body = bodies[found->second];
      body.elements.push_back(e);
      body_of.push_back(found->second);
      if (std::find(body.sections.begin(), body.sections.end(), material_key(e)) ==
          body.sections.end())
        body.sections.push_back(material_key(e));
    }
    for (Body &body : bodies)
      body.is_rigid =
          bodies.size() > 1 && std::all_of(body.elements.begin(), body.elements.end(),
                                           [&](const unsigned int e) { return is_held(e); });
  }

  bool is_held(const unsigned int e) const
  {
    return std::all_of(
        deck.elements[e].nodes.begin(), deck.elements[e].nodes.end(),
        [&](const unsigned int node) {
          return history.supports.count({node, 0}) > 0 && history.supports.count({node, 1}) > 0;
        });
  }

  /** Material and angle. */
  std::string material_key(const unsigned int e) const
  {
    const Deck::Section &section = deck.sections.at(deck.elements[e].section);
    return section.material + (section.angle == 0 ? "" : "|" + text(section.angle));
  }

  /** By its instance, or a set of elements that has no others, those of sections first. */
  void name_bodies()
  {
    const auto fits = [&](const std::string &key, const Body &body)
    {
      const std::vector<unsigned int> &set = deck.element_sets.at(key);
      return set.size() == body.elements.size() &&
             std::is_permutation(set.begin(), set.end(), body.elements.begin());
    };
    for (Body &body : bodies)
    {
      const std::string &section = deck.elements[body.elements[0]].section;
      std::string name;
      if (const std::size_t dot = section.find('.'); dot != std::string::npos)
        name = spelled(section.substr(0, dot + 1));
      else if (bodies.size() == 1 || fits(section, body))
        name = spelled(section);
      for (const auto &[key, set] : deck.element_sets)
        if (name.empty() && fits(key, body))
          name = spelled(key);
      if (name.empty())
        name = "body " + std::to_string(1 + (&body - bodies.data()));
      body.name = unique(lower_case(name) == "force" ? "force body" : name, body_names);
    }
  }

  // ------------------------------------------------------------ sides

  void find_contact()
  {
    std::vector<std::string> keys;
    for (const Deck::Pair &pair : deck.pairs)
      for (const std::string &key : pair.surfaces)
        if (std::find(keys.begin(), keys.end(), key) == keys.end())
          keys.push_back(key);
    DisjointSets sets(keys.size());
    for (unsigned int k = 0; k < keys.size(); ++k)
      for (const Deck::Face &face : deck.surfaces.at(keys[k]))
      {
        const auto [known, is_new] = contact_of.emplace(face, k);
        if (!is_new)
          sets.join(known->second, k);
      }
    for (auto &[face, k] : contact_of)
      k = sets.root(k) + 1;
    for (unsigned int k = 0; k < keys.size(); ++k)
    {
      surface_number[keys[k]] = sets.root(k) + 1;
      surface_name.emplace(sets.root(k) + 1, spelled(keys[k]));
    }
  }

  /** Names that all nodes of an edge have. */
  std::set<std::string> common(const std::map<DeckHistory::NodeComponent, DeckCourse> &courses,
                               const Deck::Face &face, const unsigned int d) const
  {
    std::set<std::string> result;
    bool is_first = true;
    for (const unsigned int node : deck.elements[face.first].edge(face.second))
    {
      const auto found = courses.find({node, d});
      if (found == courses.end())
        return {};
      if (is_first)
        result = found->second.names;
      std::set<std::string> both;
      std::set_intersection(result.begin(), result.end(), found->second.names.begin(),
                            found->second.names.end(), std::inserter(both, both.begin()));
      result = both;
      is_first = false;
    }
    return result;
  }

  bool is_on_axis(const Deck::Face &face) const
  {
    for (const unsigned int node : deck.elements[face.first].edge(face.second))
      if (std::abs(deck.nodes[node].at[0]) > 1e-10 * size)
        return false;
    return is_turned;
  }

  void find_sides()
  {
    for (const Deck::Face &face : outer)
    {
      Side side{body_of[face.first], 0, {}, {}, "", "", {}};
      if (const auto found = contact_of.find(face); found != contact_of.end())
        side.contact = found->second;
      const bool is_rigid_contact = bodies[side.body].is_rigid && side.contact != 0;
      for (unsigned int d = 0; d < 2; ++d)
      {
        if (!is_rigid_contact && !is_on_axis(face))
          side.supports[d] = common(history.supports, face, d);
        if (!bodies[side.body].is_rigid && !is_on_axis(face))
          side.forces[d] = common(history.forces, face, d);
      }
      if (const auto found = history.pressures.find(face);
          found != history.pressures.end() && !bodies[side.body].is_rigid)
        side.pressure = found->second.text(history.has_time);
      if (side.is_free())
        continue;
      const auto same = std::find_if(sides.begin(), sides.end(),
                                     [&](const Side &one) { return one.key() == side.key(); });
      (same == sides.end() ? *sides.insert(sides.end(), side) : *same).faces.push_back(face);
    }
    std::set<std::string> names;
    for (Side &side : sides)
      side.name = unique(words_of(side), names);
    name_free_edges(names);
  }

  /** By sets of nodes along edges and by surfaces, for probes and users. */
  void name_free_edges(std::set<std::string> &names)
  {
    std::set<Deck::Face> taken, is_outer(outer.begin(), outer.end());
    for (const Side &side : sides)
      taken.insert(side.faces.begin(), side.faces.end());
    std::vector<std::pair<std::string, std::vector<Deck::Face>>> all(deck.surfaces.begin(),
                                                                     deck.surfaces.end());
    for (const auto &[key, nodes] : deck.node_sets)
      if (const std::vector<Deck::Face> own = faces_between(deck, nodes, outer);
          nodes_of(own).size() == nodes.size())
        all.emplace_back(key, own);
    std::stable_sort(all.begin(), all.end(),
                     [](const auto &a, const auto &b)
                     { return a.second.size() < b.second.size(); });
    for (const auto &[key, faces] : all)
    {
      std::map<unsigned int, std::vector<Deck::Face>> own; // by body
      for (const Deck::Face &face : faces)
        if (is_outer.count(face) > 0 && taken.insert(face).second)
          own[body_of[face.first]].push_back(face);
      for (const auto &[body, some] : own)
        sides.push_back({body, 0, {}, {}, "", unique(spelled(key), names), some});
    }
  }

  std::string words_of(const Side &side) const
  {
    std::vector<std::string> words;
    const auto add = [&](const std::string &word)
    {
      if (std::find(words.begin(), words.end(), word) == words.end() && words.size() < 2)
        words.push_back(word);
    };
    if (side.contact != 0)
      add(surface_name.at(side.contact));
    for (const auto *const some : {&side.supports, &side.forces})
      for (const std::set<std::string> &names : *some)
        for (const std::string &name : names)
          if (name[0] != '#')
            add(spelled(name));
    if (!side.pressure.empty())
      for (const std::string &name : history.pressures.at(side.faces[0]).names)
        add(name[0] == '#' ? "pressed" : spelled(name));
    if (words.empty() || words[0] == "pressed")
      words = {set_of(side)};
    if (!words[0].empty())
      return boost::algorithm::join(words, " ");
    return !side.pressure.empty()                                 ? "pressed"
           : side.supports[0].empty() && side.supports[1].empty() ? "loaded"
                                                                  : "held";
  }

  /** The set of nodes that has the edges of a side and no others; empty where there is none. */
  std::string set_of(const Side &side) const
  {
    for (const auto &[key, nodes] : deck.node_sets)
      if (faces_between(deck, nodes, outer) == side.faces)
        return spelled(key);
    return "";
  }

  // ------------------------------------------------------------ interference

  /** Of a node on a side the mean of the normals of its edges, out of the body. */
  std::map<unsigned int, Tensor<1, 2>> normals(const std::vector<Deck::Face> &faces) const
  {
    std::map<unsigned int, Tensor<1, 2>> result;
    for (const auto &[e, k] : faces)
    {
      const Deck::Element &element = deck.elements[e];
      const Tensor<1, 2> along =
          deck.nodes[element.corner(k + 1)].at - deck.nodes[element.corner(k)].at;
      Tensor<1, 2> normal({along[1], -along[0]});
      Point<2> centre;
      for (unsigned int c = 0; c < element.n_corners; ++c)
        centre += deck.nodes[element.corner(c)].at / element.n_corners;
      if (normal * (centre - deck.nodes[element.corner(k)].at) > 0) // a clockwise element
        normal *= -1;
      for (const unsigned int node : element.edge(k))
        result[node] += normal / normal.norm();
    }
    for (auto &[node, normal] : result)
      normal /= normal.norm();
    return result;
  }

  /** Along @p normal from a point to the edges; empty where it meets none. */
  std::optional<double> distance(const Point<2> &at, const Tensor<1, 2> &normal,
                                 const std::vector<Deck::Face> &faces) const
  {
    std::optional<double> result;
    for (const auto &[e, k] : faces)
    {
      const Point<2> &a = deck.nodes[deck.elements[e].corner(k)].at;
      const Tensor<1, 2> along = deck.nodes[deck.elements[e].corner(k + 1)].at - a, to = a - at;
      const double across = cross(normal, along);
      if (std::abs(across) < 0.1 * along.norm())
        continue;
      const double s = cross(to, normal) / across, d = cross(to, along) / across;
      if (s > -1e-6 && s < 1 + 1e-6 && (!result || std::abs(d) < std::abs(*result)))
        result = d;
    }
    return result;
  }

  static double cross(const Tensor<1, 2> &a, const Tensor<1, 2> &b)
  {
    return a[0] * b[1] - a[1] * b[0];
  }

  /**
   * Surfaces that are drawn inside each other, by the same depth everywhere, are an interference: the slave is drawn on the master
   * instead, and the depth is a negative gap.
   */
  void part_surfaces(Deck::Pair &pair)
  {
    const std::vector<Deck::Face> &slave = deck.surfaces.at(pair.surfaces[0]),
                                  &master = deck.surfaces.at(pair.surfaces[1]);
    const std::map<unsigned int, Tensor<1, 2>> out = normals(slave);
    double least = 1e300, most = -1e300;
    for (const auto &[node, normal] : out)
      if (const auto d = distance(deck.nodes[node].at, normal, master); d && *d > -0.05 * size)
      {
        least = std::min(least, *d);
        most = std::max(most, *d);
      }
    const double depth = -(least + most) / 2;
    if (!(most < -1e-9 * size) || most - least > 0.02 * depth || pair.closed_within > depth)
      return;
    for (const auto &[node, normal] : out)
      deck.nodes[node].at -= depth * normal;
    pair.clearance -= rounded(depth, 9);
    mean(pair.place, "the surfaces " + spelled(pair.surfaces[0]) + " and " +
                         spelled(pair.surfaces[1]) + " are drawn " + text(depth, 6) +
                         " inside each other; here they are drawn on each other, with this "
                         "interference as Gap");
  }

  /** What stands at nodes that make no edge has no meaning in the continuum. */
  void check_nodes()
  {
    std::set<DeckHistory::NodeComponent> held, loaded;
    for (const Side &side : sides)
      for (const Deck::Face &face : side.faces)
        for (const unsigned int node : deck.elements[face.first].edge(face.second))
          for (unsigned int d = 0; d < 2; ++d)
          {
            if (!side.supports[d].empty())
              held.insert({node, d});
            if (!side.forces[d].empty())
              loaded.insert({node, d});
          }
    std::set<unsigned int> rigid, known;
    for (unsigned int e = 0; e < deck.elements.size(); ++e)
      for (const unsigned int node : deck.elements[e].nodes)
      {
        known.insert(node);
        if (bodies[body_of[e]].is_rigid)
          rigid.insert(node);
      }
    const auto tell = [&](const std::map<DeckHistory::NodeComponent, DeckCourse> &courses,
                          const std::set<DeckHistory::NodeComponent> &covered,
                          const std::string &card, const std::string &why)
    {
      std::map<std::string, std::set<unsigned int>> nodes; // by place
      for (const auto &[key, course] : courses)
      {
        const bool is_on_axis = is_turned && card == "*BOUNDARY" && key.second == 0 &&
                                std::abs(deck.nodes[key.first].at[0]) <= 1e-10 * size;
        const bool says_nothing = course.is_zero() && card == "*CLOAD";
        if (covered.count(key) == 0 && rigid.count(key.first) == 0 && !is_on_axis && !says_nothing)
          nodes[course.place].insert(key.first);
      }
      for (const auto &[place, own] : nodes)
      {
        const bool is_loose = known.count(*own.begin()) == 0;
        const std::string which =
            own.size() == 1 ? "the node " + std::to_string(deck.nodes[*own.begin()].number)
                            : std::to_string(own.size()) + " nodes, the first " +
                                  std::to_string(deck.nodes[*own.begin()].number) + ",";
        leave_out(place, card + ": " + which +
                             (is_loose ? " of no element of the plane" : " on no edge of it") +
                             (is_loose ? "" : "; " + why));
      }
    };
    tell(history.supports, held, "*BOUNDARY", "a point holds nothing in the continuum");
    tell(history.forces, loaded, "*CLOAD",
         "a force at a point has infinite energy in the continuum: give it to the nodes of an "
         "edge, or as a pressure");
  }

  /** Pressures on edges inside of a body, or on the axis. */
  void check_faces()
  {
    const std::set<Deck::Face> is_outer(outer.begin(), outer.end());
    std::map<std::string, unsigned int> inside;
    for (const auto &[face, course] : history.pressures)
      if (is_outer.count(face) == 0)
        ++inside[course.place];
    for (const auto &[place, n] : inside)
      leave_out(place, "a pressure on " + std::to_string(n) + (n == 1 ? " edge" : " edges") +
                           " between two elements");
  }

  // ------------------------------------------------------------ the scene

  void line(const std::string &text)
  {
    scene += text + "\n";
  }

  void set(const std::string &name, const std::string &value)
  {
    line("  set " + name + " = " + value);
  }

  void write_head()
  {
    line("# A deck of CalculiX or Abaqus as a scene, by hpvi --import " +
         storable(printable(deck.path, 400)));
    if (!deck.title.empty())
      line("set Title = " + storable(deck.title));
    line("");
    if (!history.has_time)
      return;
    line("subsection Loading");
    set("Steps", std::to_string(history.n_steps));
    line("end");
    line("subsection Adaptivity");
    set("Maximum steps", "6");
    line("end\n");
  }

  void write_bodies()
  {
    surfaces.resize(deck.elements.size());
    std::set<std::string> names;
    for (const Body &body : bodies)
      for (const std::string &section : body.sections)
      {
        const std::string name =
            unique(body.sections.size() == 1 && bodies.size() > 1
                       ? body.name
                       : scene_name(deck.materials.at(section.substr(0, section.find('|'))).name),
                   names);
        for (const unsigned int e : body.elements)
          if (material_key(e) == section)
            surfaces[e] = name;
      }
    if (bodies.size() == 1)
    {
      line("subsection Geometry");
      set("Shape", "file");
      set("File", "mesh.msh");
      line("end");
      return;
    }
    for (const Body &body : bodies)
    {
      std::vector<std::string> own;
      for (const unsigned int e : body.elements)
        if (std::find(own.begin(), own.end(), surfaces[e]) == own.end())
          own.push_back(surfaces[e]);
      line("subsection Body " + body.name);
      set("Shape", "file");
      set("File", "mesh.msh");
      set("Surfaces", boost::algorithm::join(own, ", "));
      if (own.size() == 1)
        set("Material", material_of(body));
      line("end");
    }
  }

  std::string material_of(const Body &body) const
  {
    const std::string &key = body.sections[0];
    const std::size_t bar = key.find('|');
    return scene_name(deck.materials.at(key.substr(0, bar)).name) +
           (bar == std::string::npos ? "" : " turned by " + scene_name(key.substr(bar + 1))) +
           (body.is_rigid ? " rigid" : "");
  }

  /** One for each body of one material, and for each surface of others. */
  void write_materials()
  {
    std::map<std::string, std::pair<unsigned int, bool>> all; // element, is it rigid?
    for (const Body &body : bodies)
      if (body.sections.size() == 1 && bodies.size() > 1)
        all.emplace(material_of(body), std::pair(body.elements[0], body.is_rigid));
      else
        for (const unsigned int e : body.elements)
          all.emplace(surfaces[e], std::pair(e, body.is_rigid));
    const double thickness = deck.sections.at(deck.elements[0].section).thickness;
    for (const auto &[key, section] : deck.sections)
      if (section.thickness != thickness)
        complain("the section of " + section.place + " has the thickness " +
                 text(section.thickness) + ", and that of " +
                 deck.sections.at(deck.elements[0].section).place + " has " + text(thickness) +
                 "; a scene has one: give all sections one");
    bool is_first = true;
    for (const auto &[name, one] : all)
    {
      line("subsection Material " + name);
      write_material(one.first, one.second);
      if (is_first && deck.elements[0].plane != PlaneModel::strain)
        set("Plane", is_turned ? "axisymmetric" : "stress");
      if (is_first && thickness != 1)
        set("Thickness", text(thickness));
      is_first = false;
      line("end");
    }
    for (const Body &body : bodies)
      if (body.is_rigid)
        mean(history.supports.at({deck.elements[body.elements[0]].nodes[0], 0}).place,
             "*BOUNDARY: all nodes of " + body.name + " are held, and it does not deform; its " +
                 "boundary is held here, and it is " + std::to_string(rigid_factor) +
                 " times as stiff");
  }

  void write_material(const unsigned int e, const bool is_rigid)
  {
    const Deck::Section &section = deck.sections.at(deck.elements[e].section);
    const Deck::Elastic &own = deck.materials.at(section.material);
    const double factor = is_rigid ? rigid_factor : 1;
    if (own.orthotropic)
    {
      const std::array<double, 9> &c = *own.orthotropic;
      const auto three = [&](const unsigned int k, const double times) {
        return text(times * c[k]) + ", " + text(times * c[k + 1]) + ", " + text(times * c[k + 2]);
      };
      if (is_turned)
        complain("the material " + own.name + " (" + own.place +
                 ") is orthotropic, and a body of revolution is isotropic; give "
                 "it an isotropic material");
      set("Elasticity", "orthotropic");
      set("Young's moduli", three(0, factor));
      set("Poisson's ratios", three(3, 1));
      set("Shear moduli", three(6, factor));
      if (section.angle != 0)
        set("Angle", text(section.angle));
    }
    else
    {
      set("Young's modulus", text(factor * own.E));
      set("Poisson's ratio", text(own.nu));
    }
    if (own.density != 0 && !history.body_loads.empty())
      set("Density", text(own.density));
    if (own.expansion != 0 && !history.temperatures.empty())
      set("Thermal expansion", text(own.expansion));
  }

  std::string section_of(const Side &side) const
  {
    return "Boundary " + (bodies.size() > 1 ? bodies[side.body].name + "." : "") + side.name;
  }

  void write_side(Side &side)
  {
    std::vector<std::pair<std::string, std::string>> entries;
    if (!side.supports[0].empty() || !side.supports[1].empty())
      write_support(side, entries);
    if (!side.pressure.empty())
      entries.emplace_back("Pressure", side.pressure);
    if (!side.forces[0].empty() || !side.forces[1].empty())
      entries.emplace_back("Traction", traction(side, 0) + "; " + traction(side, 1));
    if (entries.empty())
      return;
    line("subsection " + section_of(side));
    for (const auto &[name, value] : entries)
      set(name, value);
    line("end");
  }

  std::set<unsigned int> nodes_of(const std::vector<Deck::Face> &faces) const
  {
    std::set<unsigned int> nodes;
    for (const Deck::Face &face : faces)
      for (const unsigned int node : deck.elements[face.first].edge(face.second))
        nodes.insert(node);
    return nodes;
  }

  void write_support(const Side &side, std::vector<std::pair<std::string, std::string>> &entries)
  {
    const std::set<unsigned int> nodes = nodes_of(side.faces);
    const bool is_turned_support =
        std::any_of(nodes.begin(), nodes.end(),
                    [&](const unsigned int node) { return deck.axes.count(node) > 0; });
    std::array<bool, 2> is_zero{{true, true}};
    for (unsigned int d = 0; d < 2; ++d)
      for (const unsigned int node : nodes)
        is_zero[d] =
            is_zero[d] && !side.supports[d].empty() && history.supports.at({node, d}).is_zero();
    if (is_turned_support && !(is_zero[0] && is_zero[1]))
    {
      for (const unsigned int d : {0, 1})
        if (is_zero[d] && side.supports[1 - d].empty() && is_along_axis(side, d))
          return entries.emplace_back("Symmetry", "true"), void();
      return leave_out(place_of_support(side), "*BOUNDARY along axes of *TRANSFORM that are not "
                                               "normal to the edge " +
                                                   side.name);
    }
    std::array<std::string, 2> words;
    for (unsigned int d = 0; d < 2; ++d)
      words[d] = side.supports[d].empty() ? "free" : displacement(side, nodes, d);
    if (words[0].empty() || words[1].empty())
      return leave_out(place_of_support(side), "*BOUNDARY: displacements of nodes that no linear "
                                               "function has");
    entries.emplace_back("Displacement", words[0] + "; " + words[1]);
  }

  std::string place_of_support(const Side &side) const
  {
    const unsigned int d = side.supports[0].empty() ? 1 : 0;
    return history.supports.at({deck.elements[side.faces[0].first].corner(side.faces[0].second), d})
        .place;
  }

  /** Is the normal of each edge the axis of its nodes? */
  bool is_along_axis(const Side &side, const unsigned int d) const
  {
    for (const auto &[e, k] : side.faces)
    {
      const unsigned int a = deck.elements[e].corner(k), b = deck.elements[e].corner(k + 1);
      Tensor<1, 2> axis, along = deck.nodes[b].at - deck.nodes[a].at;
      for (const unsigned int node : {a, b})
        if (const auto found = deck.axes.find(node); found != deck.axes.end())
          axis += found->second;
        else
          axis[0] += 1;
      if (d == 1)
        axis = Tensor<1, 2>({-axis[1], axis[0]});
      if (std::abs(axis * along) > 1e-5 * axis.norm() * along.norm())
        return false;
    }
    return true;
  }

  /** Of nodes, times a function of t that all of them have; empty where there is none. */
  std::string displacement(const Side &, const std::set<unsigned int> &nodes,
                           const unsigned int d) const
  {
    const auto course = [&](const unsigned int node) -> const DeckCourse & {
      return history.supports.at({node, d});
    };
    const auto peak = [](const DeckCourse &one)
    {
      double result = 0;
      for (const auto &knot : one.knots)
        result = std::abs(knot.second) > std::abs(result) ? knot.second : result;
      return result;
    };
    Values values;
    const DeckCourse *largest = nullptr;
    for (const unsigned int node : nodes)
    {
      const DeckCourse &own = course(node);
      values.emplace_back(deck.nodes[node].at, history.has_time ? peak(own) : own.last());
      if (largest == nullptr || std::abs(peak(own)) > std::abs(peak(*largest)))
        largest = &own;
    }
    const std::string in_space = linear_function(values);
    if (!history.has_time || in_space == "0" || in_space.empty())
      return in_space;
    const double unit = peak(*largest);
    for (const unsigned int node : nodes)
      for (const auto &[time, value] : largest->knots)
        if (std::abs(course(node).at(time) * unit - largest->at(time) * peak(course(node))) >
            1e-9 * unit * unit)
          return "";
    if (in_space.find_first_of("xy") == std::string::npos)
      return largest->text(true);
    return "(" + in_space + ")*(" + largest->text(true, 1 / unit) + ")";
  }

  /** Forces of nodes, spread evenly over the edges between them: of a body of revolution those of the full turn. */
  std::string traction(const Side &side, const unsigned int d)
  {
    if (side.forces[d].empty())
      return "0";
    std::vector<Deck::Face> faces;
    for (const Side &other : sides)
      if (other.forces[d] == side.forces[d])
        faces.insert(faces.end(), other.faces.begin(), other.faces.end());
    std::vector<DeckCourse> courses;
    for (const unsigned int node : nodes_of(faces))
      courses.push_back(history.forces.at({node, d}));
    double area = 0;
    for (const auto &[e, k] : faces)
    {
      const Point<2> &a = deck.nodes[deck.elements[e].corner(k)].at,
                     &b = deck.nodes[deck.elements[e].corner(k + 1)].at;
      area += a.distance(b) * (is_turned ? numbers::PI * (a[0] + b[0])
                                         : deck.sections.at(deck.elements[e].section).thickness);
    }
    const DeckCourse all = sum(courses);
    const std::string place = courses.front().place;
    if (told.insert(place + std::to_string(d)).second)
      mean(place, "*CLOAD: forces of " + std::to_string(courses.size()) + " nodes, " +
                      text(all.last(), 6) + " along " + (d == 0 ? "x" : "y") +
                      " in all, are spread evenly over the edges of " + side.name);
    return all.text(history.has_time, 1 / area);
  }

  void write_pairs()
  {
    std::set<std::string> names;
    for (const Deck::Pair &pair : deck.pairs)
    {
      std::array<std::vector<const Side *>, 2> own;
      for (const unsigned int k : {0, 1})
        for (const Side &side : sides)
          if (side.contact != 0 && side.contact == surface_number.at(pair.surfaces[k]))
          {
            if (!side.has_loads())
              own[k].push_back(&side);
            else
              leave_out(pair.place,
                        "contact along " + side.name + ", where supports or loads stand as well");
          }
      bool is_any = false;
      for (const Side *const slave : own[0])
        for (const Side *const master : own[1])
          if (slave->body != master->body)
          {
            is_any = true;
            write_pair(pair, *slave, *master, names);
          }
      if (!is_any)
        leave_out(pair.place, "contact of " + spelled(pair.surfaces[0]) + " and " +
                                  spelled(pair.surfaces[1]) +
                                  ", which are not two edges of two bodies");
    }
  }

  void write_pair(const Deck::Pair &pair, const Side &slave, const Side &master,
                  std::set<std::string> &names)
  {
    const auto found = deck.interactions.find(pair.interaction);
    const Deck::Interaction law =
        found == deck.interactions.end() ? Deck::Interaction() : found->second;
    line("subsection Contact " + unique(slave.name + "-" + master.name, names));
    set("Between", bodies[slave.body].name + "." + slave.name + ", " + bodies[master.body].name +
                       "." + master.name);
    const bool is_tied = pair.is_tied || law.is_tied;
    if (is_tied || law.sticks_together)
      set("Law", is_tied ? "tied" : "bilateral");
    if (const double closed = std::min(pair.closed_within, 0.01 * size); closed > 0)
      set("Closed within", text(rounded(closed, 6)));
    if (pair.clearance != 0 && !is_tied)
      set("Gap", text(pair.clearance));
    if (law.friction != 0 && !is_tied)
      set("Friction coefficient", text(law.friction));
    if (law.friction != 0 && law.most_friction != 0 && !is_tied)
    {
      set("Friction bound", text(law.most_friction));
      set("Friction law", "limited");
    }
    line("end");
  }

  // ------------------------------------------------------------ loads inside

  void write_body_forces()
  {
    std::array<std::vector<std::string>, 2> gravity, force;
    for (const DeckHistory::BodyLoad &load : history.body_loads)
    {
      const bool by_mass = load.kind == "GRAV" || load.kind == "CENTRIF";
      const std::set<unsigned int> own(load.elements.begin(), load.elements.end());
      bool is_of_all = true;
      for (unsigned int e = 0; e < deck.elements.size(); ++e)
      {
        const Deck::Elastic &material =
            deck.materials.at(deck.sections.at(deck.elements[e].section).material);
        is_of_all = is_of_all && (own.count(e) > 0 || (by_mass && material.density == 0) ||
                                  bodies[body_of[e]].is_rigid);
      }
      if (!is_of_all)
      {
        leave_out(load.course.place, load.kind + " of a part of the elements; a scene has one for "
                                                 "all that have a density");
        continue;
      }
      add_body_load(load, gravity, force);
    }
    const auto both = [](const std::array<std::vector<std::string>, 2> &terms)
    {
      const auto one = [](const std::vector<std::string> &some)
      { return some.empty() ? "0" : boost::algorithm::join(some, " + "); };
      return one(terms[0]) + "; " + one(terms[1]);
    };
    if (gravity[0].empty() && gravity[1].empty() && force[0].empty() && force[1].empty())
      return;
    line("subsection Body force");
    if (!force[0].empty() || !force[1].empty())
      set("Expression", both(force));
    if (!gravity[0].empty() || !gravity[1].empty())
      set("Gravity", both(gravity));
    line("end");
  }

  void add_body_load(const DeckHistory::BodyLoad &load,
                     std::array<std::vector<std::string>, 2> &gravity,
                     std::array<std::vector<std::string>, 2> &force)
  {
    const auto course = [&](const double factor)
    { return load.course.text(history.has_time, factor); };
    const std::vector<double> &c = load.numbers;
    if (load.kind == "BX" || load.kind == "BY")
      force[load.kind == "BX" ? 0 : 1].push_back(course(1));
    else if (load.kind == "GRAV")
    {
      for (unsigned int d = 0; d < 2; ++d)
        if (c[d] != 0)
          gravity[d].push_back(course(c[d]));
    }
    else if (is_turned && c[3] == 0 && c[5] == 0)
      gravity[0].push_back("(" + course(1) + ")*x");
    else if (!is_turned && c[3] == 0 && c[4] == 0)
      for (unsigned int d = 0; d < 2; ++d)
        gravity[d].push_back("(" + course(1) + ")*(" + (d == 0 ? "x" : "y") +
                             (c[d] > 0 ? "" : "+") + (c[d] == 0 ? "0" : text(-c[d])) + ")");
    else
      leave_out(load.course.place, "CENTRIF about an axis that is not that of the plane");
  }

  void write_temperature()
  {
    if (history.temperatures.empty())
      return;
    bool expands = false;
    for (const auto &[key, material] : deck.materials)
      expands = expands || material.expansion != 0;
    if (!expands)
      return;
    Values values;
    std::vector<DeckCourse> courses;
    for (unsigned int node = 0; node < deck.nodes.size(); ++node)
      if (const auto found = history.temperatures.find(node); found != history.temperatures.end())
      {
        const auto first = history.first_temperatures.find(node);
        DeckCourse course = found->second;
        for (auto &[time, value] : course.knots)
          value -= first == history.first_temperatures.end() ? 0 : first->second;
        courses.push_back(course);
        values.emplace_back(deck.nodes[node].at, course.last());
      }
    const std::string place = courses.front().place;
    std::string words = linear_function(values);
    if (words.empty())
      return leave_out(place, "*TEMPERATURE: temperatures of nodes that no linear function has");
    if (history.has_time)
    {
      const DeckCourse *largest = &courses.front();
      for (const DeckCourse &course : courses)
        if (std::abs(course.last()) > std::abs(largest->last()))
          largest = &course;
      if (largest->last() == 0)
        return leave_out(place, "*TEMPERATURE: temperatures that are 0 at the end");
      words = "(" + words + ")*(" + largest->text(true, 1 / largest->last()) + ")";
    }
    line("subsection Temperature");
    set("Expression", words);
    line("end");
  }

  const MeshComplaint complain;
  Deck deck;
  const DeckHistory history;
  const std::vector<Deck::Face> outer;
  const double size;
  const bool is_turned;
  std::vector<Body> bodies;
  std::vector<unsigned int> body_of; ///< by element
  std::set<std::string> body_names;
  std::map<Deck::Face, unsigned int> contact_of;      ///< numbers from 1 on
  std::map<std::string, unsigned int> surface_number; ///< by key
  std::map<unsigned int, std::string> surface_name;
  std::vector<Side> sides;
  std::vector<std::string> surfaces; ///< by element
  std::set<std::string> told;
  std::string scene;
};
} // namespace

DeckScene import_deck(const std::string &path)
{
  return SceneMaker(path).make();
}
} // namespace hpvi
