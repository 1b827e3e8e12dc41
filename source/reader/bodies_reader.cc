// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/input/expressions.h>
#include <hpvi/input/parameters.h>
#include <hpvi/reader/bodies_reader.h>
#include <hpvi/reader/grid_cuts.h>
#include <hpvi/reader/scene_entries.h>
#include <hpvi/scene/bodies.h>
#include <hpvi/scene/boundary_parts.h>
#include <hpvi/scene/facing_sides.h>
#include <hpvi/shapes/shape.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <map>

namespace hpvi
{
using namespace dealii;

namespace
{
/** In the order of the enumerators of Contact behind `none`. */
const std::vector<std::string> law_names = {"bilateral", "unilateral", "tangential", "tied"};

std::string section_of_body(const std::string &name)
{
  return "Body " + name;
}

std::string section_of_pair(const std::string &name)
{
  return "Contact " + name;
}
} // namespace

std::vector<Entry> body_entries(const std::string &name)
{
  std::vector<Entry> entries = geometry_entries<2>();
  entries.push_back({"", "Surfaces", "", std::make_shared<Patterns::Anything>(),
                     "names of surfaces \"A, B\" or nothing",
                     "The physical surfaces of File that make this body, as several bodies may "
                     "share a file; named curves that bound them are its boundaries; empty: all."});
  entries.push_back({"", "Material", "", std::make_shared<Patterns::Anything>(),
                     "the name of a material or nothing",
                     "The Material NAME of the body; empty: those that say Where they are, and the "
                     "unnamed one."});
  for (Entry &entry : entries)
    entry.section = section_of_body(name);
  return entries;
}

std::vector<Entry> pair_entries(const std::string &name)
{
  const auto text = std::make_shared<Patterns::Anything>();
  const std::string section = section_of_pair(name);
  return {
      {section, "Between", "", text, "two sides BODY.side, BODY.side",
       "The two sides of bodies that touch. Normal, tangent and tractions in tables are those of "
       "the first."},
      {section, "Law", "unilateral",
       std::make_shared<Patterns::Selection>("unilateral|bilateral|tied|tangential"),
       "unilateral, bilateral, tied or tangential",
       "unilateral: the bodies may part, [u]_n <= u_0, and pull nowhere, [u] the displacement of "
       "one less that of the other. bilateral: they slide along each other, [u]_n = 0. tied: they "
       "are glued, [u] = 0. tangential: nothing in the normal direction, friction alone acts."},
      {section, "Gap", "", text, "one expression u_0 or nothing",
       "Distance u_0(x,y) beside that of the drawing, along the normal [length], negative: "
       "interference; of Law = unilateral; empty: 0."},
      {section, "Friction bound", "", text, "one expression g >= 0 or nothing",
       "Tresca's bound g(x,y) >= 0 [stress], |T_t| <= g; empty or 0: no friction."},
      {section, "Friction coefficient", "", text, "one expression mu_f >= 0 or nothing",
       "Coulomb's coefficient mu_f(x,y) >= 0, |T_t| <= mu_f max(0, -T_n); empty or 0: no "
       "friction."},
      {section, "Friction law", "automatic",
       std::make_shared<Patterns::Selection>("automatic|limited|cohesive"),
       "automatic, limited or cohesive",
       "What Friction bound g and Friction coefficient mu_f make together, as in a Boundary."},
      {section, "Slave", "automatic", text, "automatic or one of the two sides",
       "Which of the two sides has the multipliers. automatic: on each mesh the one with more of "
       "them, of equal ones the first."}};
}

namespace
{
/** A body by itself, checked; messages name its section. */
Scene<2> single_body(const Parameters &parameters, const std::string &name)
{
  Scene<2> single;
  single.parameters = parameters.with_section("Geometry", section_of_body(name));
  single.geometry = read_geometry<2>(*single.parameters);
  single.geometry.grading_levels = single.parameters->integer("Geometry", "Grading levels");
  if (single.geometry.shape != Shape::file &&
      !single.parameters->text("Geometry", "Surfaces").empty())
    single.parameters->reject("Geometry", "Surfaces",
                              "are those of a mesh file; set Shape = file or remove it");
  single.check_body();
  return single;
}

/** The body and its side that `BODY.side` names. */
struct NamedSide
{
  std::string name;
  unsigned int body, side;
};

NamedSide side_called(const Parameters &parameters, const std::string &section,
                      const std::string &name, const std::vector<std::string> &bodies,
                      const std::vector<Scene<2>> &singles, const std::string &entry)
{
  std::vector<std::string> all;
  for (unsigned int b = 0; b < bodies.size(); ++b)
  {
    const std::vector<std::string> sides = singles[b].geometry.boundary_names();
    for (unsigned int s = 0; s < sides.size(); ++s)
      if (bodies[b] + "." + sides[s] == name)
        return {name, b, s};
      else if (!sides[s].empty())
        all.push_back(bodies[b] + "." + sides[s]);
  }
  parameters.reject(section, entry,
                    "names " + printable(name) +
                        ", which is no side; this scene has: " + listed(all, "and"));
}

/** A pair before the bodies are one geometry. */
struct ReadPair
{
  std::string name;
  std::array<NamedSide, 2> sides;
  FacingSides facing;
  std::array<FacingSides, 2> own; ///< of each side with whole edges
  std::optional<unsigned int> slave;
};

ReadPair read_sides(const Parameters &parameters, const std::string &name,
                    const std::vector<std::string> &bodies, const std::vector<Scene<2>> &singles)
{
  const std::string section = section_of_pair(name);
  const std::vector<std::string> sides =
      Utilities::split_string_list(parameters.text(section, "Between"), ',');
  if (sides.size() != 2)
    parameters.reject(section, "Between", "names no two sides; give BODY.side, BODY.side");
  ReadPair pair{name, {}, {}, {}, {}};
  for (const unsigned int k : {0, 1})
    pair.sides[k] = side_called(parameters, section, sides[k], bodies, singles, "Between");
  if (pair.sides[0].body == pair.sides[1].body)
    parameters.reject(section, "Between",
                      "names sides of one body; a body does not touch itself, name sides of two");
  const auto side_of = [&](const unsigned int k)
  { return sides_of(singles[pair.sides[k].body].geometry)[pair.sides[k].side]; };
  const double size = std::max(singles[pair.sides[0].body].geometry.diameter(),
                               singles[pair.sides[1].body].geometry.diameter());
  std::string problem;
  const std::optional<FacingSides> facing = facing_sides(side_of(0), side_of(1), size, problem);
  if (!facing)
    parameters.reject(section, "Between",
                      "names sides that " + problem + "; name two that lie opposite");
  pair.facing = *facing;
  if (pair.facing.distance < 0)
    parameters.reject(section, "Between",
                      "names sides that lie " + to_string(-pair.facing.distance) +
                          " inside each other; move the bodies apart and give an interference as "
                          "a negative Gap");
  if (const std::string slave = parameters.text(section, "Slave"); slave != "automatic")
  {
    const auto found = std::find(sides.begin(), sides.end(), slave);
    if (found == sides.end())
      parameters.reject(section, "Slave",
                        "is none of the two sides; give automatic or one of Between");
    pair.slave = found - sides.begin();
  }
  return pair;
}

/**
 * Grid lines of boxes where the other side ends. An edge of another shape may hang over that end; its side is the master
 * then, for a multiplier there would press where nobody is.
 */
void cut_at_ends(const Parameters &parameters, ReadPair &pair, std::vector<Scene<2>> &singles)
{
  const FacingSides facing = pair.facing;
  const std::string section = section_of_pair(pair.name);
  std::array<bool, 2> hangs_over{{false, false}};
  for (const unsigned int k : {0, 1})
  {
    pair.own[k] = facing;
    Scene<2> &body = singles[pair.sides[k].body];
    cut_side<2>(body, pair.sides[k].side,
                expression<2>([facing](const Point<2> &x) { return facing.inside(x); }),
                section + "/Between");
    for (const CoarseFace<2> &face : coarse_faces(body.geometry, pair.sides[k].side))
    {
      const double one = facing.along * face.corners[0], two = facing.along * face.corners[1],
                   begin = std::min(one, two), end = std::max(one, two),
                   hair = 1e-9 * (end - begin);
      if (end < facing.begin + hair || begin > facing.end - hair)
        continue;
      if (begin < facing.begin - hair || end > facing.end + hair)
        hangs_over[k] = true;
      pair.own[k].begin = std::min(pair.own[k].begin, begin);
      pair.own[k].end = std::max(pair.own[k].end, end);
    }
  }
  if (hangs_over[0] && hangs_over[1])
    parameters.reject(section, "Between",
                      "has edges of both sides that hang over the end of the other; give one body "
                      "a vertex where the other ends, by its Subdivisions");
  for (const unsigned int k : {0, 1})
    if (hangs_over[k] && pair.slave == k)
      parameters.reject(section, "Slave",
                        "has an edge that hangs over the end of the other side; give it a vertex "
                        "there, or set automatic");
    else if (hangs_over[k])
      pair.slave = 1 - k;
}

/** Each edge belongs to one pair. */
void check_overlap(const Parameters &parameters, const std::vector<ReadPair> &pairs)
{
  for (const ReadPair &one : pairs)
    for (const ReadPair &other : pairs)
      for (const NamedSide &side : one.sides)
        for (const NamedSide &same : other.sides)
        {
          if (&one <= &other || side.name != same.name)
            continue;
          // Along one line, whose direction may be either.
          const double sign = one.facing.along * other.facing.along > 0 ? 1 : -1;
          const double begin = std::min(sign * other.facing.begin, sign * other.facing.end),
                       end = std::max(sign * other.facing.begin, sign * other.facing.end);
          if (std::min(end, one.facing.end) - std::max(begin, one.facing.begin) >
              1e-9 * (end - begin))
            parameters.reject(section_of_pair(one.name), "Between",
                              "has edges of " + side.name + " that Contact " + other.name +
                                  " has, too; let each edge touch one body");
        }
}

/** Of the side where all of it is in the pair; else it needs one of its own, for the rest of the side has that. */
std::string name_of_part(const ReadPair &read, const unsigned int k, const unsigned int side,
                         const Scene<2> &scene)
{
  const std::vector<CoarseFace<2>> faces = coarse_faces(scene.geometry, side);
  const bool is_whole = std::all_of(faces.begin(), faces.end(),
                                    [&](const CoarseFace<2> &face)
                                    { return read.own[k].inside(middle_of(face)) > 0; });
  return read.sides[k].name + (is_whole ? "" : " (" + read.name + ")");
}

/** A part of each of the two sides, as `Where` of a boundary would make it. */
void add_parts(const ReadPair &read, Scene<2> &scene)
{
  ContactPair pair{read.name, {}, {}, read.slave};
  for (const unsigned int k : {0, 1})
  {
    BoundaryCondition<2> part;
    pair.sides[k] = scene.geometry.bodies[read.sides[k].body].sides[read.sides[k].side];
    part.name = name_of_part(read, k, pair.sides[k], scene);
    part.id = pair.parts[k] = scene.boundaries.size();
    part.side = pair.sides[k];
    part.where =
        expression<2>([facing = read.own[k]](const Point<2> &x) { return facing.inside(x); });
    part.pair = scene.pairs.size();
    part.pair_name = read.name;
    part.gap = read.facing.distance > 0 ? expression<2>(read.facing.distance) : nullptr;
    scene.boundaries.push_back(part);
  }
  scene.pairs.push_back(pair);
}
} // namespace

void read_bodies(const Parameters &parameters, const FreeNames &names, Scene<2> &scene)
{
  std::vector<Scene<2>> singles;
  for (const std::string &name : names.bodies)
    singles.push_back(single_body(parameters, name));
  std::vector<ReadPair> pairs;
  for (const std::string &name : names.pairs)
  {
    pairs.push_back(read_sides(parameters, name, names.bodies, singles));
    cut_at_ends(parameters, pairs.back(), singles);
  }
  check_overlap(parameters, pairs);
  std::vector<SingleBody> bodies;
  for (unsigned int b = 0; b < singles.size(); ++b)
  {
    bodies.push_back({names.bodies[b], singles[b].geometry});
    for (const std::string &remark : singles[b].remarks)
      scene.remarks.push_back(section_of_body(names.bodies[b]) + ": " + remark);
  }
  scene.geometry = geometry_of_bodies(bodies);
  scene.name_boundaries();
  for (const ReadPair &pair : pairs)
    add_parts(pair, scene);
}

void check_covered_sides(const Parameters &parameters, const Scene<2> &scene)
{
  const std::vector<Side<2>> sides = sides_of(scene);
  for (const BoundaryCondition<2> &part : scene.boundaries)
    if (part.pair && sides[part.side].pieces.empty())
      for (const char *const entry :
           {"Displacement", "Traction", "Pressure", "Shear", "Symmetry", "Spring", "Rigid", "Force",
            "Rotation", "Moment", "Contact", "Gap", "Contact direction", "Friction bound",
            "Friction coefficient"})
        if (const std::string section = "Boundary " + scene.boundaries[part.side].name;
            parameters.is_named(section, entry) && !parameters.text(section, entry).empty())
          parameters.reject(section, entry,
                            "acts nowhere, for " + section_of_pair(part.pair_name) +
                                " has all of this side; remove it");
}

std::vector<std::optional<types::material_id>> materials_of_bodies(const Parameters &parameters,
                                                                   const Scene<2> &scene)
{
  const auto called = [&](const std::string &name) -> std::optional<types::material_id>
  {
    for (unsigned int m = 1; m < scene.materials.size(); ++m)
      if (scene.materials[m].name == name)
        return m;
    return std::nullopt;
  };
  const CoarseMesh &mesh = *scene.geometry.mesh;
  std::vector<std::optional<types::material_id>> result;
  for (const std::string &surface : mesh.surfaces)
    result.push_back(called(surface));
  for (unsigned int b = 0; b < scene.geometry.bodies.size(); ++b)
  {
    const std::string section = section_of_body(scene.geometry.bodies[b].name),
                      name = parameters.text(section, "Material");
    if (name.empty())
      continue;
    const std::optional<types::material_id> material = called(name);
    if (!material)
      parameters.reject(section, "Material",
                        "is no material of this scene; open subsection Material " + name +
                            " or leave the entry empty");
    for (const CoarseMesh::Cell &cell : mesh.cells)
      if (cell.body == b)
        result[cell.surface] = material;
  }
  return result;
}

void read_pair(const Parameters &parameters, const std::optional<double> t, const Scene<2> &scene,
               BoundaryCondition<2> &part)
{
  const std::string section = section_of_pair(part.pair_name);
  std::map<std::string, double> constants{{"pi", numbers::PI}};
  if (t)
    constants.emplace("t", *t);
  const ExpressionReader<2> expressions(parameters, constants,
                                        "; E, nu and mu are those of no body here");
  const ContactPair &pair = scene.pairs[*part.pair];
  // Both parts are tried at the same places, so that they say the same.
  const std::vector<Point<2>> points = sides_of(scene)[pair.parts[0]].sample();
  part.contact = static_cast<Contact>(
      1 + (std::find(law_names.begin(), law_names.end(), parameters.text(section, "Law")) -
           law_names.begin()));
  const bool is_apart = part.gap != nullptr;
  part.gap = sum<2>(part.gap, 1., expressions.read<1>(section, "Gap", "0", points)[0]);
  part.friction.bound =
      expressions.read_bound(section, "Friction bound", points, "Tresca's bound needs g >= 0");
  part.friction.coefficient = expressions.read_bound(section, "Friction coefficient", points,
                                                     "Coulomb's coefficient needs mu_f >= 0");
  part.friction.form =
      read_choice<FrictionForm>(parameters, section, "Friction law", friction_law_names);
  if (!part.is_unilateral() && !parameters.text(section, "Gap").empty())
    parameters.reject(section, "Gap",
                      "needs contact that can open; set Law = unilateral or remove it");
  if ((part.is_tied() || part.contact == Contact::bilateral) && is_apart)
    parameters.reject(section, "Law",
                      "needs bodies that touch, and " + scene.boundaries[pair.parts[0]].name +
                          " and " + scene.boundaries[pair.parts[1]].name +
                          " lie apart; move them together or set unilateral");
  for (const char *const entry : {"Friction bound", "Friction coefficient"})
    if (part.is_tied() && !parameters.text(section, entry).empty())
      parameters.reject(section, entry, "means nothing where bodies are tied; remove it");
}
} // namespace hpvi
