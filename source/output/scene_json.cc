// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/base/version.h>
#include <hpvi/output/boundary_words.h>
#include <hpvi/output/record.h>
#include <hpvi/output/scene_json.h>
#include <hpvi/output/scene_words.h>
#include <hpvi/plane/cell_map.h>
#include <hpvi/plane/mesh.h>
#include <hpvi/reader/bodies_reader.h>
#include <hpvi/reader/pretension_reader.h>
#include <hpvi/reader/probe_reader.h>
#include <hpvi/reader/scene_entries.h>
#include <hpvi/reader/scene_reader.h>

#include <deal.II/grid/tria.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
std::string boolean(const bool value)
{
  return value ? "true" : "false";
}

/** A number that a picture needs: with as many digits as tell places of a body far from the origin apart. */
std::string number_text(const double value)
{
  return json_value(Value(rounded(value + 0., 13)));
}

template <int dim>
std::string vector(const Tensor<1, dim> &value)
{
  std::string numbers;
  for (unsigned int c = 0; c < dim; ++c)
    numbers += (c > 0 ? ", " : "") + number_text(value[c]);
  return "[" + numbers + "]";
}

template <int dim>
std::string points(const std::vector<Point<dim>> &some)
{
  std::vector<std::string> items;
  for (const Point<dim> &x : some)
    items.push_back(vector(x));
  return json_list(items);
}

std::vector<std::string> lines_of(const std::string &text)
{
  std::vector<std::string> lines;
  std::string line;
  for (std::istringstream in(text); std::getline(in, line);)
    if (!line.empty())
      lines.push_back(line);
  return lines;
}

// ---------------------------------------------------------------- entries

/** By kind of section and name of entry: a Boundary has the same wherever it is. */
using Defaults = std::map<std::pair<std::string, std::string>, std::string>;

std::string kind_of(const std::string &section)
{
  return section == "Body force" ? section : section.substr(0, section.find(' '));
}

Defaults defaults_of(const int dim)
{
  Defaults defaults;
  std::vector<Entry> entries = scene_entries(dim, {{"NAME"}, {}});
  for (const auto &some : {body_entries(2, "NAME"), pair_entries("NAME"),
                           pretension_entries("NAME"), probe_entries(dim, "NAME")})
    entries.insert(entries.end(), some.begin(), some.end());
  for (const Entry &entry : entries)
    defaults[{kind_of(entry.section), entry.name}] = entry.default_value;
  return defaults;
}

std::string trimmed(const std::string &text)
{
  const std::size_t begin = text.find_first_not_of(' '), end = text.find_last_not_of(' ');
  return begin == std::string::npos ? "" : text.substr(begin, end - begin + 1);
}

/** Of the text of scene.prm those entries that are not at their defaults, as in "Boundary top/Traction". */
std::vector<std::string> changed_entries(const std::string &scene_prm, const int dim)
{
  const Defaults defaults = defaults_of(dim);
  std::vector<std::string> changed;
  std::string section;
  for (const std::string &line : lines_of(scene_prm))
  {
    const std::string words = trimmed(line);
    if (words.rfind("subsection ", 0) == 0)
      section = words.substr(11);
    else if (words == "end")
      section.clear();
    const std::size_t equals = words.find('=');
    if (words.rfind("set ", 0) != 0 || equals == std::string::npos)
      continue;
    const std::string name = trimmed(words.substr(4, equals - 4)),
                      value = trimmed(words.substr(equals + 1));
    const auto found = defaults.find({kind_of(section), name});
    // What a further material leaves open is that of elsewhere.
    if (!value.empty() && (found == defaults.end() || found->second != value))
      changed.push_back((section.empty() ? "" : section + "/") + name);
  }
  return changed;
}

// ---------------------------------------------------------------- the body

/** Along a face, its first vertex to its second: both, @p n - 1 points between them, and of what is curved enough to look smooth. */
std::vector<Point<2>> face_line(const CellMap<2> &map, const unsigned int face, unsigned int n = 1)
{
  n = std::max(n, map.is_curved() && map.blends()[face] ? 16U : 1U);
  std::vector<Point<2>> line;
  for (unsigned int k = 0; k <= n; ++k) // the ends exactly: there an expression may jump
    line.push_back(k == 0 || k == n
                       ? map.vertices()[GeometryInfo<2>::face_to_cell_vertices(face, k / n)]
                       : map.point(point_on_face<2>(face, Point<1>(double(k) / n))));
  return line;
}

/** Around the cell counterclockwise, each point once. */
std::vector<Point<2>> cell_outline(const CellMap<2> &map)
{
  std::vector<Point<2>> outline;
  for (const unsigned int face : {2, 1, 3, 0})
  {
    std::vector<Point<2>> line = face_line(map, face);
    if (face == 3 || face == 0)
      line = {line.rbegin(), line.rend()};
    outline.insert(outline.end(), line.begin(), line.end() - 1);
  }
  return outline;
}

std::string cells_json(const Scene<2> &scene, const Triangulation<2> &mesh)
{
  std::vector<std::string> cells;
  for (const auto &cell : mesh.active_cell_iterators())
  {
    const std::optional<Orthotropy> &own = scene.material_of(cell).orthotropy;
    cells.push_back(
        json_members({{"material", std::to_string(material_beside(scene, cell->material_id()))},
                      {"angle", own ? number_text(own->angle) : "null"},
                      {"outline", points(cell_outline(map_of<2>(cell)))}}));
  }
  return json_list(cells, 4);
}

template <int dim>
std::string materials_json(const Scene<dim> &scene, const Triangulation<dim> &mesh)
{
  std::vector<std::string> materials;
  for (const std::size_t k : materials_of(scene, mesh))
    materials.push_back(
        json_members({{"number", std::to_string(k)},
                      {"name", json_string(name_in_words(scene, k))},
                      {"words", json_string(material_in_words(scene, scene.materials[k]))}}));
  return json_list(materials, 4);
}

// ---------------------------------------------------------------- boundaries

/** Of each edge with this condition places along it, the body on the left: where something varies so many that nothing narrow is missed. */
std::vector<std::vector<Point<2>>> edges_of(const BoundaryCondition<2> &condition,
                                            const Triangulation<2> &mesh, const bool varies)
{
  std::vector<std::pair<Triangulation<2>::active_cell_iterator, unsigned int>> faces;
  for (const auto &cell : mesh.active_cell_iterators())
    for (const unsigned int face : cell->face_indices())
      if (cell->at_boundary(face) && cell->face(face)->boundary_id() == condition.id)
        faces.emplace_back(cell, face);
  std::vector<std::vector<Point<2>>> edges;
  for (const auto &[cell, face] : faces)
  {
    std::vector<Point<2>> line =
        face_line(map_of<2>(cell), face, varies ? 1 + 400 / faces.size() : 1);
    if (cross_product_2d(line.back() - line.front()) * (cell->center() - line.front()) > 0)
      line = {line.rbegin(), line.rend()};
    edges.push_back(line);
  }
  return edges;
}

/** The components of a vector at places; null where it has none. */
template <class Components>
std::string vectors(const Components &components, const std::vector<Point<2>> &places)
{
  if (!components[0] && !components[1])
    return "null";
  std::vector<std::string> values;
  for (const Point<2> &x : places)
    values.push_back(vector(Tensor<1, 2>({components[0] ? components[0]->value(x) : 0.,
                                          components[1] ? components[1]->value(x) : 0.})));
  return json_list(values);
}

std::string edges_json(const BoundaryCondition<2> &condition, const Triangulation<2> &mesh)
{
  const bool is_gap = condition.is_unilateral() && !condition.pair,
             varies = condition.has_displacement() || condition.has_traction() || is_gap;
  std::vector<std::string> edges;
  for (const std::vector<Point<2>> &places : edges_of(condition, mesh, varies))
  {
    std::vector<std::string> gaps;
    for (const Point<2> &x : places)
      if (is_gap)
        gaps.push_back(number_text(condition.gap_at(x)));
    edges.push_back(json_members({{"x", points(places)},
                                  {"gap", is_gap ? json_list(gaps) : "null"},
                                  {"traction", vectors(condition.traction, places)},
                                  {"displacement", vectors(condition.displacement, places)}}));
  }
  return json_list(edges, 6);
}

template <int dim>
std::string contact_name(const BoundaryCondition<dim> &condition)
{
  if (!condition.has_contact())
    return "null";
  return json_string(condition.is_tied()                        ? "tied"
                     : condition.contact == Contact::bilateral  ? "bilateral"
                     : condition.contact == Contact::tangential ? "tangential"
                                                                : "unilateral");
}

std::string plate_json(const std::optional<RigidPlate<2>> &plate)
{
  return plate ? json_members({{"force", vector(Tensor<1, 2>({plate->force[0], plate->force[1]}))},
                               {"moment", number_text(plate->force[2])}})
               : "null";
}

/** Curves of a drawing that make it, as its entry has them; else its own name may be a number. */
template <int dim>
std::string curves_of(const Scene<dim> &scene, const std::string &name)
{
  const std::string section = "Boundary " + name;
  return scene.parameters && scene.parameters->has(section, "Curves")
             ? scene.parameters->text(section, "Curves")
             : "";
}

/** Points along a face, (n + 1)^2, in such an order that their coordinates turn about the outer normal; n = 1, or 4 of a curved cell. */
std::vector<Point<3>> face_grid(const CellMap<3> &map, const unsigned int face,
                                const Point<3> &inside)
{
  const unsigned int n = map.is_curved() ? 4 : 1;
  const auto grid = [&](const bool is_turned)
  {
    std::vector<Point<3>> result;
    for (unsigned int k = 0; k < (n + 1) * (n + 1); ++k)
    {
      const double s = double(k % (n + 1)) / n, t = double(k / (n + 1)) / n;
      result.push_back(
          map.point(point_on_face<3>(face, is_turned ? Point<2>(t, s) : Point<2>(s, t))));
    }
    return result;
  };
  const std::vector<Point<3>> one = grid(false);
  const bool is_outward =
      cross_product_3d(one[1] - one[0], one[n + 1] - one[0]) * (one[0] - inside) > 0;
  return is_outward ? one : grid(true);
}

/** Its vector in the middle; null where it has none. */
template <class Components>
std::string vector_at(const Components &components, const Point<3> &x)
{
  Tensor<1, 3> value;
  bool is_given = false;
  for (unsigned int c = 0; c < 3; ++c)
    if (components[c])
    {
      value[c] = components[c]->value(x);
      is_given = true;
    }
  return is_given ? vector(value) : "null";
}

std::string faces_json(const Scene<3> &scene, const BoundaryCondition<3> &condition,
                       const Triangulation<3> &mesh)
{
  std::vector<std::string> faces;
  for (const auto &cell : mesh.active_cell_iterators())
    for (const unsigned int face : cell->face_indices())
      if (cell->at_boundary(face) && cell->face(face)->boundary_id() == condition.id)
      {
        const CellMap<3> map = map_of<3>(cell);
        const Point<3> middle = map.point(point_on_face<3>(face, Point<2>(0.5, 0.5)));
        faces.push_back(
            json_members({{"x", points(face_grid(map, face, cell->center()))},
                          {"material", std::to_string(material_beside(scene, cell->material_id()))},
                          {"traction", vector_at(condition.traction, middle)},
                          {"displacement", vector_at(condition.displacement, middle)}}));
      }
  return json_list(faces, 6);
}

/** Places along it with their data: edges in the plane, in space faces. */
std::pair<std::string, std::string>
places_json(const Scene<2> &, const BoundaryCondition<2> &condition, const Triangulation<2> &mesh)
{
  return {"edges", edges_json(condition, mesh)};
}

std::pair<std::string, std::string> places_json(const Scene<3> &scene,
                                                const BoundaryCondition<3> &condition,
                                                const Triangulation<3> &mesh)
{
  return {"faces", faces_json(scene, condition, mesh)};
}

template <int dim>
std::string boundary_json(const Scene<dim> &scene, const Triangulation<dim> &mesh,
                          const BoundaryCondition<dim> &condition)
{
  const BoundaryPhrases phrases = phrases_of(scene, condition, mesh).value_or(BoundaryPhrases());
  const auto &d = condition.contact_direction;
  const bool speaks = !condition.pair || scene.pairs[*condition.pair].parts[0] == condition.id;
  std::vector<std::string> held;
  for (const Expression<dim> &component : condition.displacement)
    held.push_back(boolean(bool(component)));
  JsonMembers members = {{"name", json_string(condition.name)},
                         {"curves", json_string(curves_of(scene, condition.name))},
                         {"supports", json_strings(phrases.supports)},
                         {"contacts", speaks ? json_strings(phrases.contacts) : "[]"},
                         {"loads", json_strings(phrases.loads)},
                         {"held", json_list(held)},
                         {"symmetry", boolean(condition.symmetry)},
                         {"spring", boolean(bool(condition.spring))}};
  if constexpr (dim == 2)
    members.emplace_back("plate", plate_json(condition.plate));
  members.emplace_back("contact", contact_name(condition));
  members.emplace_back("pair", condition.pair ? json_string(condition.pair_name) : "null");
  members.emplace_back("direction", d ? vector(*d) : "null");
  members.push_back(places_json(scene, condition, mesh));
  return json_members(members);
}

template <int dim>
std::string boundaries_json(const Scene<dim> &scene, const Triangulation<dim> &mesh)
{
  const std::vector<types::boundary_id> present = mesh.get_boundary_ids();
  std::vector<std::string> boundaries;
  for (const BoundaryCondition<dim> &condition : scene.boundaries)
    if (std::count(present.begin(), present.end(), condition.id) > 0)
      boundaries.push_back(boundary_json(scene, mesh, condition));
  return json_list(boundaries, 4);
}

// ---------------------------------------------------------------- the rest

/** Its mean and the centre of the body; null where there is none. */
template <int dim>
std::string body_force_json(const Scene<dim> &scene, const Triangulation<dim> &mesh)
{
  if (!scene.has_body_force())
    return "null";
  Tensor<1, dim> mean;
  Point<dim> centre;
  std::vector<double> sizes;
  double area = 0;
  for (const auto &cell : mesh.active_cell_iterators())
  {
    const auto &components = scene.body_force_in(cell);
    Tensor<1, dim> force;
    for (unsigned int c = 0; c < dim; ++c)
      force[c] = components[c] ? components[c]->value(cell->center()) : 0.;
    mean += cell->measure() * force;
    centre += cell->measure() * cell->center();
    area += cell->measure();
    sizes.push_back(force.norm());
  }
  return json_members(
      {{"mean", vector(mean / area)},
       {"centre", vector(centre / area)},
       {"words", json_string("body force " + range_in_words(sizes, body_force_unit(scene)))}});
}

std::string pretensions_json(const Scene<2> &scene)
{
  std::vector<std::string> cuts;
  const std::string unit = force_unit(scene.stress_unit, scene.length_unit);
  for (const Pretension<2> &cut : scene.pretensions)
    cuts.push_back(json_members({{"name", json_string(cut.name)},
                                 {"from", vector(cut.from)},
                                 {"to", vector(cut.to)},
                                 {"normal", vector(cut.normal)},
                                 {"words", json_string("F = " + with_unit(cut.force, unit))}}));
  return json_list(cuts);
}

template <int dim>
std::string probes_json(const Scene<dim> &scene)
{
  static const char *const kinds[] = {"point", "disc", "boundary", "line"};
  std::vector<std::string> probes;
  for (const Probe<dim> &probe : scene.probes)
  {
    std::vector<std::string> on;
    for (const types::boundary_id id : probe.on)
      on.push_back(scene.boundaries[id].name);
    probes.push_back(
        json_members({{"name", json_string(probe.name)},
                      {"kind", json_string(kinds[static_cast<unsigned int>(probe.kind)])},
                      {"at", vector(probe.at)},
                      {"size", number_text(probe.size)},
                      {"from", vector(probe.from)},
                      {"to", vector(probe.to)},
                      {"on", json_strings(on)}}));
  }
  return json_list(probes);
}

template <int dim>
JsonMembers drawn_members(const Scene<dim> &scene)
{
  Triangulation<dim> mesh;
  make_mesh(scene, mesh);
  JsonMembers members;
  if constexpr (dim == 2)
    members.emplace_back("cells", cells_json(scene, mesh));
  members.emplace_back("materials", materials_json(scene, mesh));
  members.emplace_back("boundaries", boundaries_json(scene, mesh));
  members.emplace_back("body_force", body_force_json(scene, mesh));
  if constexpr (dim == 2)
    members.emplace_back("pretensions", pretensions_json(scene));
  members.emplace_back("probes", probes_json(scene));
  return members;
}
} // namespace

template <int dim>
std::string scene_json(const Scene<dim> &scene)
{
  const std::string &length = scene.length_unit, &stress = scene.stress_unit;
  JsonMembers members = {
      {"program", json_string("hpvi " + version())},
      {"title", json_string(scene.title)},
      {"dimension", std::to_string(dim)},
      {"units", json_members({{"length", json_string(length)}, {"stress", json_string(stress)}})},
      {"history", boolean(scene.has_load_history())},
      {"words", json_strings(lines_of(scene_in_words(scene)))},
      {"changed", scene.parameters ? json_strings(changed_entries(effective_parameters(scene), dim))
                                   : "null"}};
  const JsonMembers drawn = drawn_members(at_the_end(scene));
  members.insert(members.end(), drawn.begin(), drawn.end());
  return json_file(members);
}

template std::string scene_json(const Scene<2> &);
template std::string scene_json(const Scene<3> &);
} // namespace hpvi
