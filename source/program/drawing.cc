// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The program hpvi_drawing, which stands beside the library: it reads a drawing or a mesh with Gmsh's library, meshes the
// drawing, and writes nodes, elements and curves as text. A process of its own, for Gmsh and OpenCASCADE crash on some
// inputs, take all memory, or never end.
//
// usage: hpvi_drawing KIND FILE DIMENSION SIZE CURVATURE SCALE UNIT CPU-SECONDS MEGABYTES
//
// KIND is that of the content, by which the loader is chosen: Gmsh itself goes by the ending of the name, and runs what it
// does not know as a script. SIZE [length] and CURVATURE (cells per turn) are those of cells, 0: what Gmsh or the script
// says. UNIT is that of the file, as in M or INCH, -: it has none; SCALE is how many of the result's it has.
#include <gmsh.h>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <new>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{
/** What is handed over: to the standard output OpenCASCADE and scripts write what they like. */
std::FILE *out = nullptr;

struct Request
{
  std::string kind, path;
  int dim;
  double size, curvature, scale; ///< scale: of lengths of the file
  std::string unit; ///< of the file, as OpenCASCADE calls it; it would turn all into mm

  bool is_cad() const
  {
    return kind == "step" || kind == "iges" || kind == "brep";
  }
};

using Group = std::pair<int, int>; ///< dimension, tag

/** What the drawing is, in the words of the one line that it is answered with. */
[[noreturn]] void refuse(const std::string &problem_and_remedy)
{
  throw std::invalid_argument(problem_and_remedy);
}

void limit(const int resource, const double value)
{
  const rlimit both = {rlim_t(value), rlim_t(value)};
  if (value > 0)
    setrlimit(resource, &both);
}

void set(const std::string &option, const double value)
{
  gmsh::option::setNumber(option, value);
}

/** Before a script, which may say otherwise. */
void choose_options(const Request &request)
{
  set("General.Terminal", 0);
  set("General.NumThreads", 1);
  set("Mesh.Algorithm", 6); // 8 crashes and loops in Gmsh 4.8
  set("Mesh.RecombineAll", request.dim == 2);
  set("Mesh.RecombinationAlgorithm", 1);
  set("Mesh.MeshSizeFromCurvature", request.curvature);
  set("Geometry.OCCImportLabels", 0);
  if (request.unit != "-")
    gmsh::option::setString("Geometry.OCCTargetUnit", request.unit);
}

/** Is a mesh file of Gmsh in a format before 3, in which each element tells its group? */
bool has_groups_of_elements(const Request &request)
{
  std::ifstream in(request.path);
  std::string word, version;
  while (request.kind == "msh" && in >> word && word != "$MeshFormat" && word != "$NOD")
    continue;
  in >> version;
  return request.kind == "msh" && (word == "$NOD" || version < "3");
}

bool is_an_entity_in_two_groups()
{
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities);
  return std::any_of(entities.begin(), entities.end(),
                     [](const auto &entity)
                     {
                       std::vector<int> groups;
                       gmsh::model::getPhysicalGroupsForEntity(entity.first, entity.second, groups);
                       return groups.size() > 1;
                     });
}

/** Are entities of the model the groups of the file? Gmsh gives the groups of elements to their entity, and so does not know whose
 * they were where it has several. */
bool load(const Request &request)
{
  gmsh::logger::start();
  if (request.is_cad())
  {
    gmsh::vectorpair shapes;
    gmsh::model::occ::importShapes(request.path, shapes, true, request.kind);
    gmsh::model::occ::synchronize();
    return false;
  }
  gmsh::merge(request.path);
  if (!has_groups_of_elements(request) || !is_an_entity_in_two_groups())
    return false;
  gmsh::clear();
  set("Mesh.SwitchElementTags", 1);
  gmsh::merge(request.path);
  return true;
}

bool has(const int dim)
{
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities, dim);
  return !entities.empty();
}

/** Gmsh's own view of a drawing before it is meshed. */
struct Box
{
  std::array<double, 3> low, high;

  double extent(const int d) const
  {
    return high[d] - low[d];
  }

  double size() const
  {
    return std::max({extent(0), extent(1), extent(2)});
  }
};

Box box_of_drawing()
{
  Box box;
  gmsh::model::getBoundingBox(-1, -1, box.low[0], box.low[1], box.low[2], box.high[0], box.high[1],
                              box.high[2]);
  return box;
}

/** A body in the plane is a face in a plane z = const, one in space a solid. */
void check_drawing(const Request &request)
{
  if (request.dim == 3 && !has(3))
    refuse("has no solid; draw one, or set Dimension = 2 for a face in the plane");
  if (request.dim == 3)
    return;
  if (has(3))
    refuse("is a solid, and a body in the plane is a face; set Dimension = 3, or draw its section "
           "as a face in a plane z = const");
  if (!has(2))
    refuse("has no face; make one of its curves, as a body in the plane is a face");
  const Box box = box_of_drawing();
  if (box.extent(2) > 1e-6 * box.size() + 3e-7) // boxes of OpenCASCADE have a margin of 1e-7
    refuse(std::string("is not in a plane z = const, in which a body lies") +
           (box.extent(0) < 1e-6 * box.size() + 3e-7   ? ", but in one of x = const"
            : box.extent(1) < 1e-6 * box.size() + 3e-7 ? ", but in one of y = const"
                                                       : "") +
           "; turn the drawing, or set Dimension = 3 for a solid");
}

/** What a mesh in the plane is worth. */
class Quality
{
public:
  Quality()
  {
    gmsh::vectorpair entities;
    gmsh::model::getEntities(entities);
    take_nodes();
    for (const auto &[dim, tag] : entities)
      if (dim == 1)
        take_lines(tag);
    for (const auto &[dim, tag] : entities)
      if (dim == 2)
        take_cells(tag);
  }

  /** Quadrilaterals when all is cut that has to be; folded ones are no mesh. */
  double cost() const
  {
    const double n = has_to_be_cut ? 3. * n_triangles + 4. * n_quadrilaterals : n_quadrilaterals;
    return is_folded || is_concave ? 1e300 : n * (largest_degrees > good_degrees ? 2 : 1);
  }

  bool is_without_folds() const
  {
    return !is_folded;
  }

  bool is_good() const
  {
    return !is_folded && !is_concave && !has_to_be_cut && largest_degrees <= good_degrees;
  }

private:
  static constexpr double good_degrees = 150;

  void take_nodes()
  {
    std::vector<std::size_t> tags;
    std::vector<double> x, none;
    gmsh::model::mesh::getNodes(tags, x, none, -1, -1, false, false);
    for (std::size_t k = 0; k < tags.size(); ++k)
      places[tags[k]] = {{x[3 * k], x[3 * k + 1]}};
  }

  void take_lines(const int curve)
  {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> tags, all;
    gmsh::model::mesh::getElements(types, tags, all, 1, curve);
    for (std::size_t t = 0; t < types.size(); ++t)
      for (std::size_t k = 0; types[t] == 1 && k + 1 < all[t].size(); k += 2)
        curves[{std::min(all[t][k], all[t][k + 1]), std::max(all[t][k], all[t][k + 1])}] = curve;
  }

  void take_cells(const int surface)
  {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> tags, all;
    gmsh::model::mesh::getElements(types, tags, all, 2, surface);
    double turn = 0; // all cells of a surface turn the same way
    for (std::size_t t = 0; t < types.size(); ++t)
    {
      const std::size_t n = types[t] == 2 ? 3 : 4;
      (n == 3 ? n_triangles : n_quadrilaterals) += all[t].size() / n;
      has_to_be_cut = has_to_be_cut || n == 3;
      for (std::size_t begin = 0; begin + n <= all[t].size(); begin += n)
      {
        const double area = area_of(all[t].data() + begin, n);
        turn = turn == 0 ? area : turn;
        is_folded = is_folded || !(area * turn > 0);
        for (std::size_t k = 0; k < n; ++k)
          take_corner(all[t][begin + (k + n - 1) % n], all[t][begin + k],
                      all[t][begin + (k + 1) % n], turn);
      }
    }
  }

  double area_of(const std::size_t *const nodes, const std::size_t n)
  {
    double twice = 0;
    for (std::size_t k = 0; k < n; ++k)
    {
      const auto &a = places[nodes[k]], &b = places[nodes[(k + 1) % n]];
      twice += a[0] * b[1] - a[1] * b[0];
    }
    return twice / 2;
  }

  int curve_at(const std::size_t a, const std::size_t b) const
  {
    const auto found = curves.find({std::min(a, b), std::max(a, b)});
    return found == curves.end() ? 0 : found->second;
  }

  void take_corner(const std::size_t before, const std::size_t here, const std::size_t after,
                   const double turn)
  {
    const auto &a = places[before], &b = places[here], &c = places[after];
    const double x = c[0] - b[0], y = c[1] - b[1], u = a[0] - b[0], v = a[1] - b[1],
                 across = x * v - y * u;
    is_concave = is_concave || !(across * turn > 0);
    largest_degrees =
        std::max(largest_degrees, std::atan2(std::abs(across), x * u + y * v) * 180 / M_PI);
    const int curve = curve_at(before, here);
    has_to_be_cut = has_to_be_cut || (curve != 0 && curve == curve_at(here, after));
  }

  std::map<std::size_t, std::array<double, 2>> places;
  std::map<std::pair<std::size_t, std::size_t>, int> curves; ///< by the ends of their lines
  std::size_t n_triangles = 0, n_quadrilaterals = 0;
  bool is_folded = false, is_concave = false, has_to_be_cut = false;
  double largest_degrees = 0;
};

bool has_cells(const int dim)
{
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, nodes;
  gmsh::model::mesh::getElements(types, tags, nodes, dim);
  return !types.empty();
}

bool is_partitioned()
{
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities);
  return std::any_of(entities.begin(), entities.end(),
                     [](const auto &entity)
                     {
                       std::vector<int> partitions;
                       gmsh::model::getPartitions(entity.first, entity.second, partitions);
                       return !partitions.empty();
                     });
}

/** Are its surfaces those of a drawing, and not of a mesh that a script has read? */
bool is_drawn()
{
  gmsh::vectorpair surfaces;
  gmsh::model::getEntities(surfaces, 2);
  return std::none_of(surfaces.begin(), surfaces.end(),
                      [](const auto &surface)
                      {
                        std::string type;
                        gmsh::model::getType(surface.first, surface.second, type);
                        return type == "Discrete surface";
                      });
}

constexpr double blossom = 1, full_blossom = 3, full_simple = 2, simple = 0;

/** Gmsh has several ways to make quadrilaterals of triangles, none of which is always good: the first good one, or the best. */
void generate_cells()
{
  const std::string option = "Mesh.RecombinationAlgorithm";
  double algorithm = 0, recombines = 0, best = blossom, least = 1e301;
  gmsh::option::getNumber(option, algorithm);
  gmsh::option::getNumber("Mesh.RecombineAll", recombines);
  const auto generate = [&](const double way)
  {
    gmsh::model::mesh::clear();
    set(option, way);
    gmsh::model::mesh::generate(2);
  };
  if (algorithm != blossom || recombines != 1) // a script has chosen
  {
    if (!has_cells(2))
      gmsh::model::mesh::generate(2);
    if (Quality().is_without_folds())
      return;
    set("Mesh.RecombineAll", 1);
    set("Mesh.SubdivisionAlgorithm", 0);
  }
  for (const double way : {blossom, full_blossom, full_simple, simple})
  {
    generate(way);
    const Quality quality;
    if (quality.is_good())
      return;
    if (quality.cost() < least)
    {
      least = quality.cost();
      best = way;
    }
  }
  generate(best);
}

void mesh(const Request &request)
{
  if (is_partitioned())
    gmsh::model::mesh::unpartition(); // which drops groups whose names have an underscore
  if (request.kind != "geo" && !request.is_cad())
    return;
  if (has_cells(request.dim)) // a script may make its own
  {
    if (request.dim == 3 || !is_drawn())
      return;
    gmsh::model::mesh::setOrder(1); // edges follow the drawing whatever the order
    if (Quality().is_without_folds())
      return;
    std::fputs("remark the mesh that the script makes is folded, and another one was made; set "
               "another Mesh.RecombinationAlgorithm there\n",
               out);
  }
  check_drawing(request);
  if (request.size > 0)
  {
    set("Mesh.MeshSizeMax", request.size / request.scale);
    gmsh::vectorpair points; // at which else it is a tenth of the diagonal
    gmsh::model::getEntities(points, 0);
    if (request.is_cad())
      gmsh::model::mesh::setSize(points, request.size / request.scale);
  }
  if (request.curvature > 0)
    set("Mesh.MeshSizeFromCurvature", request.curvature);
  if (request.dim == 2)
    generate_cells();
  else
    gmsh::model::mesh::generate(request.dim);
}

// ---------------------------------------------------------------- what is handed over

/** Names on one line. */
std::string word(std::string name)
{
  std::replace_if(
      name.begin(), name.end(), [](const unsigned char c) { return c < ' '; }, ' ');
  return name;
}

/** The group of each entity; of several the one with the fewest entities, of equal ones the first. */
class Groups
{
public:
  /** @p are_entities: an entity is a group, and groups are entities. */
  explicit Groups(const bool are_entities) : are_entities(are_entities)
  {
    gmsh::vectorpair all;
    gmsh::model::getPhysicalGroups(all);
    for (const auto &[dim, tag] : all)
    {
      std::string name;
      gmsh::model::getPhysicalName(dim, tag, name);
      std::vector<int> entities;
      gmsh::model::getEntitiesForPhysicalGroup(dim, tag, entities);
      int own = tag;
      if (!name.empty())
        own = by_name.emplace(std::pair(dim, name), tag).first->second; // two of one name are one
      n_entities[{dim, own}] += entities.size();
      for (const int entity : entities)
        of_entity[{dim, entity}].insert(own);
      if (!name.empty() && !are_entities)
        std::fprintf(out, "name %d %d %s\n", dim, own, word(name).c_str());
    }
    gmsh::model::getEntities(all);
    for (const auto &[dim, tag] : all)
    {
      std::string name;
      if (are_entities)
        gmsh::model::getPhysicalName(dim, tag, name);
      if (!name.empty())
        std::fprintf(out, "name %d %d %s\n", dim, tag, word(name).c_str());
    }
  }

  int group_of(const int dim, const int entity) const
  {
    return are_entities ? entity : of(dim, entity);
  }

  int entity_of(const int dim, const int entity) const
  {
    return are_entities ? of(dim, entity) : entity;
  }

private:
  int of(const int dim, const int entity) const
  {
    const auto found = of_entity.find({dim, entity});
    if (found == of_entity.end())
      return 0;
    return *std::min_element(found->second.begin(), found->second.end(),
                             [&](const int a, const int b) {
                               return n_entities.at({dim, a}) < n_entities.at({dim, b});
                             });
  }

  const bool are_entities;
  std::map<std::pair<int, std::string>, int> by_name;
  std::map<Group, std::size_t> n_entities;
  std::map<Group, std::set<int>> of_entity;
};

/** All nodes by tag, and z of a plane z = const, which is taken off. */
class Nodes
{
public:
  explicit Nodes(const Request &request) : scale(request.scale)
  {
    std::vector<std::size_t> tags;
    std::vector<double> x, parameters;
    gmsh::model::mesh::getNodes(tags, x, parameters, -1, -1, false, false);
    for (std::size_t k = 0; k < tags.size(); ++k)
      places[tags[k]] = {{scale * x[3 * k], scale * x[3 * k + 1], scale * x[3 * k + 2]}};
  }

  void take(const std::size_t tag)
  {
    used.insert(tag);
  }

  /** Of an edge of higher order, between its ends. */
  void take_in_edge(const std::size_t tag)
  {
    in_edges.insert(tag);
  }

  bool is_used(const std::size_t tag) const
  {
    return used.count(tag) > 0;
  }

  /** Of all that is used. */
  void drop_height()
  {
    double low = 1e300, high = -1e300, size = 0;
    for (const std::size_t tag : used)
    {
      low = std::min(low, at(tag)[2]);
      high = std::max(high, at(tag)[2]);
      size = std::max({size, std::abs(at(tag)[0]), std::abs(at(tag)[1])});
    }
    if (high - low > 1e-12 * size)
      return;
    height = low;
    for (const std::size_t tag : in_edges)
      if (std::abs(at(tag)[2] - height) > 1e-12 * size)
        refuse("has the node " + std::to_string(tag) +
               " inside an edge, and outside of the plane of all corners; draw it there");
  }

  const std::array<double, 3> &at(const std::size_t tag) const
  {
    const auto found = places.find(tag);
    if (found == places.end())
      refuse("has an element with a node " + std::to_string(tag) +
             " that is not there; write the file anew");
    for (const double x : found->second)
      if (!std::isfinite(x))
        refuse("has the node " + std::to_string(tag) +
               " at a place that is no finite number; write the file anew");
    return found->second;
  }

  void print() const
  {
    for (const std::size_t tag : used)
    {
      const auto &x = at(tag);
      std::fprintf(out, "node %zu %.17g %.17g %.17g\n", tag, x[0], x[1], x[2] - height);
    }
  }

  double height = 0;
  const double scale;

private:
  std::map<std::size_t, std::array<double, 3>> places;
  std::set<std::size_t> used, in_edges;
};

/** Elements of a dimension by their corners, with entity and group; edges of higher order as curves. */
class Elements
{
public:
  Elements(const Request &request, Nodes &nodes, const Groups &groups)
      : is_drawing(request.is_cad() || request.kind == "geo"), nodes(nodes), groups(groups)
  {
    gmsh::vectorpair entities;
    gmsh::model::getEntities(entities);
    std::vector<int> cells;
    gmsh::model::mesh::getElementTypes(cells, 3);
    is_of_second_order = cells.size() == 1 && (cells[0] == 12 || cells[0] == 17); // of 27, 20 nodes
    for (const auto &[dim, tag] : entities)
      if (dim > 0)
        take(dim, tag);
  }

  void print() const
  {
    for (const std::string &line : lines)
      std::fprintf(out, "%s\n", line.c_str());
    if (n_by_corners > 0)
      std::fputs(
          ("remark " + std::to_string(n_by_corners) +
           " cells of second or higher order count by their corners, for in space only meshes of "
           "hexahedra of second order alone are curved; mesh finer where that matters\n")
              .c_str(),
          out);
  }

private:
  struct Kind
  {
    int dim, order, n_nodes, n_corners, type; ///< type of the first order
  };

  const Kind &kind(const int type)
  {
    const auto found = kinds.find(type);
    if (found != kinds.end())
      return found->second;
    std::string name;
    Kind kind;
    std::vector<double> local;
    gmsh::model::mesh::getElementProperties(type, name, kind.dim, kind.order, kind.n_nodes, local,
                                            kind.n_corners);
    // Lines 1, triangles 2, quadrilaterals 3, tetrahedra 4, hexahedra 5, prisms 6, pyramids 7.
    static const std::map<std::pair<int, int>, int> first = {
        {{1, 2}, 1}, {{2, 3}, 2}, {{2, 4}, 3}, {{3, 4}, 4}, {{3, 8}, 5}, {{3, 6}, 6}, {{3, 5}, 7}};
    const auto same = first.find({kind.dim, kind.n_corners});
    kind.type = same == first.end() ? 0 : same->second;
    return kinds.emplace(type, kind).first->second;
  }

  void take(const int dim, const int entity)
  {
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> tags, all;
    gmsh::model::mesh::getElements(types, tags, all, dim, entity);
    for (std::size_t t = 0; t < types.size(); ++t)
    {
      const Kind &one = kind(types[t]);
      for (std::size_t begin = 0; begin + one.n_nodes <= all[t].size(); begin += one.n_nodes)
        take(one, types[t], entity, is_drawing ? 0 : tags[t][begin / one.n_nodes],
             all[t].data() + begin);
    }
  }

  void take(const Kind &one, const int type, const int entity, const std::size_t number,
            const std::size_t *const element)
  {
    const bool is_whole = one.dim == 3 && is_of_second_order;
    std::string line = "element " + std::to_string(one.type == 0 || is_whole ? type : one.type) +
                       " " + std::to_string(groups.entity_of(one.dim, entity)) + " " +
                       std::to_string(groups.group_of(one.dim, entity)) + " " +
                       std::to_string(number);
    n_by_corners += one.dim == 3 && one.order > 1 && !is_whole;
    for (int k = 0; k < (is_whole ? one.n_nodes : one.n_corners); ++k)
    {
      nodes.take(element[k]);
      line += " " + std::to_string(element[k]);
    }
    lines.push_back(line);
    if (one.order > 1 && one.dim <= 2 && one.type != 0)
      for (int edge = 0; edge < (one.dim == 1 ? 1 : one.n_corners); ++edge)
        take_edge(one, edge, element);
  }

  /** Gmsh goes along the edges, one after the other, behind the corners. */
  void take_edge(const Kind &one, const int edge, const std::size_t *const element)
  {
    const std::size_t from = element[edge], to = element[(edge + 1) % one.n_corners];
    if (is_drawing)
      return;
    const auto begin = element + one.n_corners + edge * (one.order - 1);
    const std::set<std::size_t> inner(begin, begin + one.order - 1);
    const auto [known, is_new] = edges.insert({{std::min(from, to), std::max(from, to)}, inner});
    if (known->second != inner)
      refuse("has other nodes on the edge between the nodes " + std::to_string(from) + " and " +
             std::to_string(to) + " in one element than in another; write the file anew");
    if (!is_new)
      return;
    std::string line =
        "edge " + std::to_string(from) + " " + std::to_string(to) + " " + std::to_string(one.order);
    const auto add = [&](const std::size_t node)
    {
      const auto &x = nodes.at(node);
      char text[100];
      std::snprintf(text, sizeof(text), " %.17g %.17g", x[0], x[1]);
      line += text;
    };
    add(from);
    for (int k = 0; k < one.order - 1; ++k)
    {
      nodes.take_in_edge(begin[k]);
      add(begin[k]);
    }
    add(to);
    lines.push_back(line);
  }

  const bool is_drawing;
  Nodes &nodes;
  const Groups &groups;
  std::map<int, Kind> kinds;
  std::vector<std::string> lines;
  std::map<std::pair<std::size_t, std::size_t>, std::set<std::size_t>>
      edges; ///< of higher order: nodes between their ends
  std::size_t n_by_corners = 0;
  bool is_of_second_order = false; ///< in space: hexahedra alone, which keep their nodes
};

constexpr int degree = 16; ///< of a panel of a curve

/** Of a drawing: its curves between neighbouring nodes as panels at Chebyshev's points, straight ones left out. */
class Curves
{
public:
  Curves(const Nodes &nodes) : nodes(nodes)
  {
    gmsh::vectorpair entities;
    gmsh::model::getEntities(entities, 1);
    for (const auto &[dim, tag] : entities)
      take(tag);
  }

private:
  struct Place
  {
    double t;
    std::size_t node;
  };

  struct Panel
  {
    double begin, end; ///< in [0,1]
    std::vector<double> points;
  };

  std::vector<double> values(const int curve, const std::vector<double> &t) const
  {
    std::vector<double> x;
    gmsh::model::getValue(1, curve, t, x);
    for (double &value : x)
      value *= nodes.scale;
    return x;
  }

  void take(const int curve) const
  {
    std::vector<double> low, high;
    gmsh::model::getParametrizationBounds(1, curve, low, high);
    std::vector<std::size_t> tags;
    std::vector<double> x, t;
    gmsh::model::mesh::getNodes(tags, x, t, 1, curve, false, true);
    if (low.empty() || high.empty() || t.size() != tags.size())
      return;
    std::vector<Place> places;
    for (std::size_t k = 0; k < tags.size(); ++k)
      if (nodes.is_used(tags[k])) // one in the middle of an edge is none of its ends
        places.push_back({t[k], tags[k]});
    for (const double end : {low[0], high[0]})
      places.push_back({end, end_node(curve, end)});
    std::sort(places.begin(), places.end(),
              [](const Place &a, const Place &b) { return a.t < b.t; });
    for (std::size_t k = 0; k + 1 < places.size(); ++k)
      if (places[k].node != 0 && places[k + 1].node != 0)
        print(curve, places[k], places[k + 1]);
  }

  /** The node of the point at which a curve ends; 0: there is none. */
  std::size_t end_node(const int curve, const double t) const
  {
    const std::vector<double> here = values(curve, {t});
    gmsh::vectorpair points;
    gmsh::model::getBoundary({{1, curve}}, points, false, false, false);
    std::size_t best = 0;
    double least = 1e300;
    for (const auto &[dim, tag] : points)
    {
      std::vector<std::size_t> tags;
      std::vector<double> x, none;
      gmsh::model::mesh::getNodes(tags, x, none, dim, tag, false, false);
      for (const std::size_t node : tags)
      {
        if (!nodes.is_used(node))
          continue;
        const auto &at = nodes.at(node);
        const double distance = std::hypot(at[0] - here[0], at[1] - here[1]);
        if (distance < least)
        {
          least = distance;
          best = node;
        }
      }
    }
    return best;
  }

  /** Places of t for s in [0,1] of a panel, and between them those where it is tried. */
  static double place(const int k)
  {
    return (1 - std::cos(M_PI * k / (2 * degree))) / 2;
  }

  /** Of the polynomial of a panel at place(k), k odd, by the barycentric formula. */
  static double interpolated(const std::vector<double> &x, const int d, const int k)
  {
    double above = 0, below = 0;
    for (int j = 0; j <= degree; ++j)
    {
      const double weight =
          (j % 2 ? -1. : 1.) * (j == 0 || j == degree ? 0.5 : 1.) / (place(k) - place(2 * j));
      above += weight * x[6 * j + d];
      below += weight;
    }
    return above / below;
  }

  /** Bisected until its polynomial is the curve: a spline has knots inside. */
  void add(const int curve, const Place &from, const Place &to, const double begin,
           const double end, const double length, const int depth, std::vector<Panel> &panels) const
  {
    std::vector<double> t;
    for (int k = 0; k <= 2 * degree; ++k)
      t.push_back(from.t + (to.t - from.t) * (begin + (end - begin) * place(k)));
    const std::vector<double> x = values(curve, t);
    double off = 0;
    for (int k = 1; k < 2 * degree; k += 2)
      off = std::max(
          off, std::hypot(interpolated(x, 0, k) - x[3 * k], interpolated(x, 1, k) - x[3 * k + 1]));
    if (off > 1e-13 * length && depth < 10)
    {
      add(curve, from, to, begin, (begin + end) / 2, length, depth + 1, panels);
      return add(curve, from, to, (begin + end) / 2, end, length, depth + 1, panels);
    }
    Panel panel{begin, end, {}};
    for (int k = 0; k <= 2 * degree; k += 2)
      panel.points.insert(panel.points.end(), {x[3 * k], x[3 * k + 1]});
    panels.push_back(panel);
  }

  void print(const int curve, const Place &from, const Place &to) const
  {
    const auto &a = nodes.at(from.node), &b = nodes.at(to.node);
    const double dx = b[0] - a[0], dy = b[1] - a[1], length = std::hypot(dx, dy);
    std::vector<Panel> panels;
    add(curve, from, to, 0, 1, length + std::hypot(a[0], a[1]), 0, panels);
    double bow = 0;
    for (const Panel &panel : panels)
      for (int k = 0; k <= degree; ++k)
        bow = std::max(bow, std::abs(dx * (panel.points[2 * k + 1] - a[1]) -
                                     dy * (panel.points[2 * k] - a[0])));
    if (!(bow > 1e-11 * length * length))
      return;
    // Ends are the nodes, to the last digit.
    panels.front().points[0] = a[0];
    panels.front().points[1] = a[1];
    panels.back().points[2 * degree] = b[0];
    panels.back().points[2 * degree + 1] = b[1];
    std::fprintf(out, "curve %zu %zu %d %zu", from.node, to.node, degree, panels.size());
    for (const Panel &panel : panels)
    {
      std::fprintf(out, " %.17g %.17g", panel.begin, panel.end);
      for (const double x : panel.points)
        std::fprintf(out, " %.17g", x);
    }
    std::fprintf(out, "\n");
  }

  const Nodes &nodes;
};

void hand_over(const Request &request, const bool groups_are_entities)
{
  if (!has_cells(request.dim))
    refuse(request.dim == 2 ? "has no cells in the plane; give it a face or a mesh of one"
                            : "has no cells in space; give it a solid or a mesh of one");
  const Groups groups(groups_are_entities);
  Nodes nodes(request);
  const Elements elements(request, nodes, groups);
  if (request.dim == 2)
    nodes.drop_height();
  nodes.print();
  elements.print();
  if (request.dim == 2 && (request.is_cad() || request.kind == "geo"))
    const Curves curves(nodes);
  std::fputs("end\n", out);
}

/** The last error that Gmsh has met, without its colours. */
std::string last_error()
{
  std::vector<std::string> log;
  gmsh::logger::get(log);
  const std::string start = "Error: ";
  for (auto line = log.rbegin(); line != log.rend(); ++line)
    if (line->rfind(start, 0) == 0)
      return line->substr(start.size());
  return "";
}

int run(const Request &request)
{
  std::string problem;
  try
  {
    choose_options(request);
    const bool groups_are_entities = load(request);
    mesh(request);
    hand_over(request, groups_are_entities);
    return std::fflush(out) == 0 ? 0 : 1;
  }
  catch (const std::invalid_argument &error)
  {
    problem = error.what();
  }
  catch (...) // Gmsh throws texts and numbers
  {
    const std::string words = last_error();
    problem = "cannot be read or meshed" + (words.empty() ? "" : ", as Gmsh says: " + word(words)) +
              "; open it with gmsh, mend it there, and save it anew";
  }
  std::fprintf(out, "\nerror %s\n", problem.c_str());
  std::fflush(out);
  return 1;
}

/** Gmsh ends by itself where it gets no memory, or knows no way. */
void tell_of_end()
{
  const std::string words = last_error();
  std::fprintf(out,
               "\nerror makes Gmsh give up%s; set another Mesh size, or mesh it with gmsh and name "
               "that mesh "
               "(.msh)\n",
               words.empty() ? "" : (": " + word(words)).c_str());
  std::fflush(out);
}

void end_of_memory()
{
  std::fputs(
      "\nerror needs more memory than the reader of drawings may take; set a larger Mesh size\n",
      out);
  std::fflush(out);
  std::_Exit(1);
}
} // namespace

int main(int argc, char *argv[])
{
  if (argc != 10)
  {
    std::fputs(
        "usage: hpvi_drawing KIND FILE DIMENSION SIZE CURVATURE SCALE UNIT CPU-SECONDS MEGABYTES\n",
        stderr);
    return 2;
  }
  const Request request = {argv[1],
                           argv[2],
                           std::atoi(argv[3]),
                           std::atof(argv[4]),
                           std::atof(argv[5]),
                           std::atof(argv[6]),
                           argv[7]};
  limit(RLIMIT_CORE, 1);
  limit(RLIMIT_CPU, std::atof(argv[8]));
  limit(RLIMIT_AS, std::atof(argv[9]) * 1e6);
  out = fdopen(dup(1), "w");
  if (out == nullptr || std::freopen("/dev/null", "w", stdout) == nullptr)
    return 2;
  static std::array<char, 1 << 16> buffer; // there may be no memory for one when it is wanted
  std::setvbuf(out, buffer.data(), _IOFBF, buffer.size());
  std::atexit(tell_of_end);
  std::set_new_handler(end_of_memory);
  gmsh::initialize(0, nullptr, false);
  const int status = run(request);
  std::_Exit(status); // Gmsh's own end may crash when all is said
}
