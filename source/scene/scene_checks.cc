// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/scene_checks.h>

#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/scene/parameters.h>
#include <hpvi/scene/scene_entries.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <limits>
#include <memory>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Squares of lengths, stresses and displacements, and their products, must not over- or underflow. */
constexpr double smallest = 1e-100, largest = 1e100;

// ---------------------------------------------------------------- words

/** "Section/Entry = value": as the file wrote it, else @p value, which functions do not have. */
std::string mention(const Scene<2> &scene, const std::string &section, const std::string &name,
                    const std::string &value = "")
{
  const std::string shown = scene.parameters ? scene.parameters->text(section, name) : value;
  return section + "/" + name + (scene.parameters || !shown.empty() ? " = " + shown : "");
}

[[noreturn]] void reject(const Scene<2> &scene, const std::string &section, const std::string &name,
                         const std::string &problem_and_remedy, const std::string &value = "")
{
  if (scene.parameters)
    scene.parameters->reject(section, name, problem_and_remedy);
  fail(printable(scene.name), mention(scene, section, name, value), problem_and_remedy);
}

/** Compares what code may have set with what a file may say. */
class CheckValue
{
public:
  explicit CheckValue(const Scene<2> &scene) : scene(scene), entries(scene_entries(2))
  {
  }

  void operator()(const std::string &, const std::string &, const bool) const
  {
  }

  template <class Number>
  void operator()(const std::string &section, const std::string &name, const Number value) const
  {
    const std::string shown = written(value);
    for (const Entry &entry : entries)
      if (entry.section == section && entry.name == name)
        if (const std::string objection = entry.objection(shown); !objection.empty())
          reject(scene, section, name, objection, shown);
  }

private:
  static std::string written(const double value)
  {
    return text(value);
  }

  template <class Integer>
  static std::string written(const Integer value)
  {
    return std::to_string(value);
  }

  const Scene<2> &scene;
  const std::vector<Entry> entries;
};

// ---------------------------------------------------------------- geometry

/** Without squares, which over- and underflow. */
double length(const Tensor<1, 2> &edge)
{
  return std::hypot(edge[0], edge[1]);
}

void check_box(const Scene<2> &scene)
{
  const Corners<2> &corners = scene.geometry.corners;
  for (unsigned int d = 0; d < 2; ++d)
    if (!(corners.front()[d] < corners.back()[d]))
      reject(scene, "Geometry", "Upper corner",
             "is not above and right of the lower corner " + to_string(corners.front()) +
                 "; enlarge every coordinate beyond it",
             to_string(corners.back()));
  if (corners != box_corners(corners.front(), corners.back()))
    reject(scene, "Geometry", "Shape",
           "has corners that are not those of a box; take box_corners() or shape = quadrilateral",
           "box");
}

/** Each corner must turn left. */
void check_quadrilateral(const Scene<2> &scene)
{
  const Corners<2> &corners = scene.geometry.corners;
  const std::array<Point<2>, 4> around = {{corners[0], corners[1], corners[3], corners[2]}};
  for (unsigned int c = 0; c < 4; ++c)
  {
    const Tensor<1, 2> in = around[c] - around[(c + 3) % 4], out = around[(c + 1) % 4] - around[c];
    const double sine =
        in[0] / length(in) * (out[1] / length(out)) - in[1] / length(in) * (out[0] / length(out));
    if (!(sine > 1e-12)) // no more than round-off
      reject(scene, "Geometry", "Corners",
             "is degenerate, clockwise or not convex at " + to_string(around[c]) +
                 "; give the corners of a convex quadrilateral counterclockwise from "
                 "the bottom left");
  }
}

/** Lengths that can be squared, edges that are more than round-off, corners that are corners. */
void check_shape(const Scene<2> &scene)
{
  const Geometry<2> &geometry = scene.geometry;
  const std::string entry = geometry.shape == Shape::box ? "Upper corner" : "Corners";
  double farthest = 0, shortest = std::numeric_limits<double>::max();
  for (const Point<2> &corner : geometry.corners)
    farthest = std::max({farthest, std::abs(corner[0]), std::abs(corner[1])});
  for (const Edge &edge : edges_of(geometry))
    shortest = std::min(shortest, length(edge.ends[1] - edge.ends[0]));
  if (!(farthest <= largest) || !(shortest >= smallest))
    reject(scene, "Geometry", entry,
           "has lengths from " + to_string(shortest) + " to " + to_string(farthest) +
               " and they must lie between 1e-100 and 1e100; choose another unit");
  if (shortest < 1e-10 * farthest)
    reject(scene, "Geometry", entry,
           "has an edge of length " + to_string(shortest) + " and coordinates up to " +
               to_string(farthest) +
               ", which round-off blurs; move the body towards "
               "the origin");
  const std::array<double, 4> angles = corner_angles(geometry);
  for (unsigned int c = 0; c < angles.size(); ++c)
    if (angles[c] < 0.1 || angles[c] > 179.9)
      reject(scene, "Geometry", entry,
             "has an angle of " + to_string(angles[c]) + " degrees at " +
                 to_string(geometry.corners[c]) +
                 "; give a quadrilateral with angles between 0.1 and 179.9 degrees");
}

void check_grading(const Scene<2> &scene)
{
  const Geometry<2> &geometry = scene.geometry;
  if (geometry.grading_levels > 0 && geometry.graded_towards.empty())
    reject(scene, "Geometry", "Grading levels",
           "has no point to grade to; set Graded towards = x, y or remove it");
  const double diameter = std::max(geometry.corners[0].distance(geometry.corners[3]),
                                   geometry.corners[1].distance(geometry.corners[2]));
  for (const Point<2> &point : geometry.graded_towards)
    for (const Edge &edge : edges_of(geometry))
      if (!(edge.normal * (point - edge.ends[0]) <= 1e-10 * diameter))
        reject(scene, "Geometry", "Graded towards",
               "has the point " + to_string(point) + " outside the body; name points of the body");
}

} // namespace

void check_geometry(const Scene<2> &scene)
{
  scene.geometry.shape == Shape::box ? check_box(scene) : check_quadrilateral(scene);
  check_shape(scene);
  double cells = 1;
  std::string shown;
  for (const unsigned int n : scene.geometry.subdivisions)
  {
    cells *= n;
    shown += (shown.empty() ? "" : ", ") + std::to_string(n);
  }
  if (cells == 0)
    reject(scene, "Geometry", "Subdivisions", "makes no cells; give two positive integers", shown);
  if (cells > 1e6)
    reject(scene, "Geometry", "Subdivisions",
           "makes more than a million cells; start coarse and let the mesh adapt", shown);
  check_grading(scene);
}

void check_materials(const Scene<2> &scene)
{
  const CheckValue check_value(scene);
  const std::string number = std::to_string(scene.materials.size());
  if (scene.materials.empty())
    fail(printable(scene.origin()), "Material", "is missing; give at least one");
  if (scene.materials.size() > 1 && !scene.material_at)
    fail(printable(scene.origin()), "Material",
         "says nowhere which of " + number + " is where; set material_at or keep one");
  for (const Material &material : scene.materials)
  {
    check_value("Material", "Young's modulus", material.young);
    if (!(material.poisson > -1 && material.poisson < 0.5))
      reject(scene, "Material", "Poisson's ratio",
             "is outside (-1, 1/2); an elastic material has -1 < nu < 1/2", text(material.poisson));
  }
}

namespace
{
// ---------------------------------------------------------------- functions

/** The functions of one entry, and where they are tried. */
struct EntryFunctions
{
  std::string section, name;
  std::array<Expression<2>, 2> components;
  std::vector<Point<2>> points;
};

std::vector<EntryFunctions> functions_of(const Scene<2> &scene)
{
  std::vector<EntryFunctions> result{
      {"Body force", "Expression", scene.body_force, sample_body(scene.geometry)}};
  const std::vector<Edge> edges = edges_of(scene.geometry);
  for (unsigned int b = 0; b < edges.size(); ++b)
  {
    const BoundaryCondition<2> &boundary = scene.boundaries[b];
    const std::string section = "Boundary " + boundary.name;
    result.push_back({section, "Displacement", boundary.displacement, edges[b].sample()});
    result.push_back({section, "Traction", boundary.traction, edges[b].sample()});
    result.push_back({section, "Gap", {{boundary.gap}}, edges[b].sample()});
  }
  return result;
}

/** Loads and displacements enter energies as squares; in load steps, checked by themselves, the smallest are 0. */
void check_magnitude(const Scene<2> &scene, const EntryFunctions &functions)
{
  for (const auto &component : functions.components)
  {
    double magnitude = 0;
    for (const Point<2> &point : functions.points)
      if (const double value = component ? component->value(point) : 0.; std::isfinite(value))
        magnitude = std::max(magnitude, std::abs(value));
    const bool is_small = magnitude > 0 && magnitude < smallest && !scene.has_load_history();
    if (magnitude > largest || is_small)
      reject(scene, functions.section, functions.name,
             "has a component of magnitude " + to_string(magnitude) +
                 ", outside 1e-100 to 1e100; choose other units or write 0");
  }
}

void check_finite(const Scene<2> &scene, const EntryFunctions &functions)
{
  for (const auto &component : functions.components)
    for (const Point<2> &point : functions.points)
      if (component && !std::isfinite(component->value(point)))
        reject(scene, functions.section, functions.name,
               "is not finite at " + to_string(point) +
                   "; give a function that is finite everywhere it applies");
}

std::string name_of(const Contact contact)
{
  return contact_names[static_cast<unsigned int>(contact)];
}

/** The largest value of a bound or a coefficient, which must not be negative. */
double check_friction(const Scene<2> &scene, const std::string &section, const std::string &name,
                      const Expression<2> &function, const std::vector<Point<2>> &points,
                      const std::string &remedy)
{
  double largest_value = 0;
  for (const Point<2> &point : points)
  {
    const double value = function ? function->value(point) : 0.;
    if (!(value >= 0 && std::isfinite(value)))
      reject(scene, section, name,
             "is " + to_string(value) + " at " + to_string(point) + "; " + remedy);
    largest_value = std::max(largest_value, value);
  }
  return largest_value;
}

void check_friction(const Scene<2> &scene, const std::string &section,
                    const BoundaryCondition<2> &boundary, const std::vector<Point<2>> &points)
{
  const FrictionLaw<2> &law = boundary.friction;
  if (law.bound && !boundary.has_contact())
    reject(scene, section, "Friction bound", friction_needs_contact);
  if (law.coefficient && !boundary.has_contact())
    reject(scene, section, "Friction coefficient", friction_needs_contact);
  if (law.bound && law.coefficient)
    reject(scene, section, "Friction coefficient",
           "stands beside Friction bound; keep Coulomb's law or Tresca's");
  if (law.coefficient && boundary.contact == Contact::tangential)
    reject(
        scene, section, "Friction coefficient",
        "needs a pressure, which Contact = tangential has not; give Friction bound or set Contact "
        "= unilateral");
  const double bound = check_friction(scene, section, "Friction bound", law.bound, points,
                                      "Tresca's bound needs g >= 0");
  check_friction(scene, section, "Friction coefficient", law.coefficient, points,
                 "Coulomb's coefficient needs mu_f >= 0");
  if (boundary.contact == Contact::tangential && bound == 0)
    reject(scene, section, "Contact",
           "has friction nowhere to act, for Friction bound is 0 all along the boundary; give "
           "Friction bound > 0 or set Contact = none",
           name_of(boundary.contact));
}

/** A load needs a displacement that can give way, contact a boundary that nothing else holds. */
void check_boundary(const Scene<2> &scene, const BoundaryCondition<2> &boundary, const Edge &edge)
{
  const std::string section = "Boundary " + boundary.name;
  for (unsigned int d = 0; d < 2; ++d)
    if (boundary.traction[d] != nullptr && boundary.displacement[d] != nullptr)
      reject(scene, section, "Traction",
             std::string("acts on the component ") + "xyz"[d] +
                 " that Displacement prescribes; make that component 0 here or free "
                 "there");
  check_friction(scene, section, boundary, edge.sample());
  if (boundary.gap != nullptr && !boundary.is_unilateral())
    reject(scene, section, "Gap", gap_needs_contact);
  if (boundary.has_contact() && boundary.has_displacement())
    reject(scene, section, "Displacement",
           "stands beside Contact = " + name_of(boundary.contact) + "; keep only one of the two");
}

void check_boundaries(const Scene<2> &scene)
{
  const std::vector<Edge> edges = edges_of(scene.geometry);
  if (scene.boundaries.size() != edges.size())
    fail(printable(scene.origin()), "Boundary",
         "has " + std::to_string(scene.boundaries.size()) + " instead of " +
             std::to_string(edges.size()) + "; change those of a new scene, add and remove none");
  for (unsigned int b = 0; b < edges.size(); ++b)
    if (scene.boundaries[b].id != b)
      fail(printable(scene.origin()), "Boundary " + scene.boundaries[b].name,
           "has the id " + std::to_string(scene.boundaries[b].id) + " and stands at " +
               std::to_string(b) + "; leave ids and order as they are in a new scene");
  const std::vector<EntryFunctions> all = functions_of(scene);
  for (const EntryFunctions &functions : all)
    check_magnitude(scene, functions);
  for (const EntryFunctions &functions : all) // after what is huge, which explains it
    check_finite(scene, functions);
  for (unsigned int b = 0; b < edges.size(); ++b)
    check_boundary(scene, scene.boundaries[b], edges[b]);
}

// ---------------------------------------------------------------- supports

/** `direction . u = value` at one point, said by one boundary. */
struct PointCondition
{
  Tensor<1, 2> direction;
  double value;
  unsigned int boundary;
};

std::vector<PointCondition> conditions_at(const BoundaryCondition<2> &boundary, const Edge &edge,
                                          const Point<2> &point)
{
  std::vector<PointCondition> conditions;
  for (unsigned int d = 0; d < 2; ++d)
    if (boundary.displacement[d] != nullptr)
    {
      Tensor<1, 2> direction;
      direction[d] = 1.;
      conditions.push_back({direction, boundary.displacement[d]->value(point), boundary.id});
    }
  if (boundary.contact == Contact::bilateral)
    conditions.push_back({edge.normal, 0., boundary.id});
  return conditions;
}

/** The entry that says what happens to the displacement of a boundary. */
std::string support_entry(const BoundaryCondition<2> &boundary)
{
  return boundary.contact == Contact::bilateral ? "Contact" : "Displacement";
}

[[noreturn]] void reject_corner(const Scene<2> &scene, const BoundaryCondition<2> &one,
                                const BoundaryCondition<2> &two, const Point<2> &corner,
                                const double contradiction)
{
  // The message stands at the boundary whose value can be changed.
  const BoundaryCondition<2> &changeable = one.contact == Contact::bilateral ? two : one;
  const BoundaryCondition<2> &other = one.contact == Contact::bilateral ? one : two;
  reject(scene, "Boundary " + changeable.name, support_entry(changeable),
         "contradicts " + mention(scene, "Boundary " + other.name, support_entry(other)) +
             " at their corner " + to_string(corner) + " by " + to_string(std::abs(contradiction)) +
             "; make both agree there or free one component");
}

/** Where @p boundary prescribes u_n > u_0 at its corner with @p contact. */
[[noreturn]] void reject_penetration(const Scene<2> &scene, const BoundaryCondition<2> &boundary,
                                     const BoundaryCondition<2> &contact, const Point<2> &corner,
                                     const double depth)
{
  const std::string limit =
      contact.gap ? mention(scene, "Boundary " + contact.name, "Gap")
                  : mention(scene, "Boundary " + contact.name, "Contact", name_of(contact.contact));
  reject(scene, "Boundary " + boundary.name, support_entry(boundary),
         "contradicts " + limit + " at their corner " + to_string(corner) +
             ", for u_n exceeds the gap by " + to_string(depth) +
             "; let u_n <= u_0 there or free one component");
}

/** What @p condition asks for beyond the orthonormal @p basis: no direction if that decides it. */
PointCondition rest_of(PointCondition condition, const std::vector<PointCondition> &basis)
{
  for (const PointCondition &q : basis)
  {
    const double product = condition.direction * q.direction;
    condition.direction -= product * q.direction;
    condition.value -= product * q.value;
  }
  return condition;
}

/** Can all @p conditions at one corner hold together, and @p limits `u_n <= u_0` with them? */
void check_corner(const Scene<2> &scene, const Point<2> &corner,
                  const std::vector<PointCondition> &conditions,
                  const std::vector<PointCondition> &limits, const double tolerance)
{
  constexpr double parallel = 1e-6;
  std::vector<PointCondition> basis; // by Gram and Schmidt
  for (const PointCondition &condition : conditions)
  {
    const PointCondition rest = rest_of(condition, basis);
    const double norm = rest.direction.norm();
    if (norm > parallel)
      basis.push_back({rest.direction / norm, rest.value / norm, rest.boundary});
    else if (std::abs(rest.value) > tolerance)
      reject_corner(scene, scene.boundaries[basis.front().boundary],
                    scene.boundaries[rest.boundary], corner, rest.value);
  }
  for (const PointCondition &limit : limits)
    if (const PointCondition rest = rest_of(limit, basis);
        rest.direction.norm() <= parallel && rest.value < -tolerance)
      reject_penetration(scene, scene.boundaries[basis.front().boundary],
                         scene.boundaries[limit.boundary], corner, -rest.value);
}

/** The motion `(a - c (y - y_0)/length, b + c (x - x_0)/length)`: its coefficients a, b, c. */
using RigidMotion = std::array<double, 3>;

bool is_translation(const RigidMotion &motion)
{
  return std::abs(motion[2]) < 1e-8;
}

std::string describe(const RigidMotion &motion, const Point<2> &centre, const double length)
{
  if (!is_translation(motion))
    return "rotation about " +
           to_string(centre + length / motion[2] * Point<2>(-motion[1], motion[0]));
  if (std::abs(motion[1]) < 1e-8)
    return "translation in x";
  if (std::abs(motion[0]) < 1e-8)
    return "translation in y";
  return "translation along " + to_string(Point<2>(motion[0], motion[1]));
}

/** A basis of the rigid-body motions that satisfy all @p rows, conditions on (a, b, c). */
std::vector<RigidMotion> free_motions(std::vector<RigidMotion> rows)
{
  // Gauss and Jordan: each column without pivot is a motion that earlier columns can balance.
  std::vector<unsigned int> pivots;
  std::vector<RigidMotion> motions;
  for (unsigned int column = 0; column < 3; ++column)
  {
    const unsigned int rank = pivots.size();
    const auto pivot = std::max_element(rows.begin() + rank, rows.end(),
                                        [column](const auto &a, const auto &b)
                                        { return std::abs(a[column]) < std::abs(b[column]); });
    if (pivot == rows.end() || std::abs((*pivot)[column]) < 1e-8)
    {
      RigidMotion motion = {{0, 0, 0}};
      motion[column] = 1;
      for (unsigned int k = 0; k < rank; ++k)
        motion[pivots[k]] = -rows[k][column] / rows[k][pivots[k]];
      motions.push_back(motion);
      continue;
    }
    std::swap(*pivot, rows[rank]);
    for (unsigned int r = 0; r < rows.size(); ++r)
    {
      const double factor = r == rank ? 0. : rows[r][column] / rows[rank][column];
      for (unsigned int c = 0; c < 3; ++c)
        rows[r][c] -= factor * rows[rank][c];
    }
    pivots.push_back(column);
  }
  return motions;
}

/** What `direction . u = 0` at @p x asks of a motion. */
RigidMotion row_of(const Tensor<1, 2> &direction, const Point<2> &x, const Point<2> &centre,
                   const double length)
{
  const Tensor<1, 2> arm = (x - centre) / length;
  return {{direction[0], direction[1], direction[1] * arm[0] - direction[0] * arm[1]}};
}

// ---------------------------------------------------------------- the exact solution

/** Compares one boundary with the exact solution, at points all along it. */
class ExactSolutionCheck
{
public:
  ExactSolutionCheck(const Scene<2> &scene, const unsigned int id)
      : scene(scene), exact(*scene.exact_solution), boundary(scene.boundaries[id]),
        section("Boundary " + boundary.name), edge(edges_of(scene.geometry)[id])
  {
    for (unsigned int d = 0; d < 2; ++d)
      stress[d] = std::make_unique<ExactTraction<2>>(scene.exact_solution, scene.materials[0],
                                                     edge.normal, d);
    for (const Edge &any : edges_of(scene.geometry))
      for (const Point<2> &point : any.sample())
      {
        displacement_scale = std::max(displacement_scale, exact.displacement(point).norm());
        stress_scale =
            std::max(stress_scale, scene.materials[0].mu() * exact.gradient(point).norm());
      }
  }

  void run() const
  {
    for (const Point<2> &point : edge.sample())
    {
      check_displacement(point);
      if (!boundary.has_contact())
        check_traction(point);
      else
      {
        check_normal_contact(point);
        check_friction_law(point);
      }
    }
  }

private:
  void check_displacement(const Point<2> &point) const
  {
    const Tensor<1, 2> u = exact.displacement(point);
    for (unsigned int d = 0; d < 2; ++d)
      if (boundary.displacement[d] != nullptr &&
          differ(boundary.displacement[d]->value(point), u[d], displacement_scale))
        contradict("Displacement", point, "write exact");
  }

  void check_traction(const Point<2> &point) const
  {
    for (unsigned int d = 0; d < 2; ++d)
      if (boundary.displacement[d] == nullptr &&
          differ(traction(d, point), stress[d]->value(point), stress_scale))
        contradict("Traction", point, "write exact");
  }

  /**
   * bilateral: `u_n = 0`; unilateral: `u_n <= u_0`, `p >= 0`, `(u_n - u_0) p = 0`; unilateral and, with
   * p = 0, tangential: `sigma_n = G_n - p`.
   */
  void check_normal_contact(const Point<2> &point) const
  {
    const double u_n = exact.displacement(point) * edge.normal;
    if (boundary.contact == Contact::bilateral)
    {
      if (differ(u_n, 0, displacement_scale))
        contradict("Contact", point, "set Contact = none");
      return;
    }
    const double p = boundary.is_unilateral() ? exact.pressure(point) : 0.;
    double imbalance = p;
    for (unsigned int d = 0; d < 2; ++d)
      imbalance += edge.normal[d] * (stress[d]->value(point) - traction(d, point));
    if (p < -tolerance * stress_scale || differ(imbalance, 0, stress_scale))
      contradict_load(point, "Contact", "set Contact = none");
    const double gap = boundary.gap_at(point) - u_n;
    const bool closed = p > tolerance * stress_scale;
    if (boundary.is_unilateral() && differ(closed ? gap : std::min(gap, 0.), 0, displacement_scale))
      contradict("Gap", point, "give that of the solution");
  }

  /** `sigma_t = G_t - g lambda`, `|lambda| <= 1`, `lambda u_t = |u_t|`. */
  void check_friction_law(const Point<2> &point) const
  {
    const Tensor<1, 2> u = exact.displacement(point), n = edge.normal, t({-n[1], n[0]});
    const double lambda = exact.multiplier(point);
    if (std::abs(lambda) > 1 + tolerance)
      reject(scene, "Exact solution", "Length",
             "asks friction for |lambda| = " + to_string(std::abs(lambda)) + " > 1 at " +
                 to_string(point) +
                 "; enlarge it, shorten the contact or move Transition to the right");
    double imbalance = g(point) * lambda;
    for (unsigned int d = 0; d < 2; ++d)
      imbalance += t[d] * (stress[d]->value(point) - traction(d, point));
    if (differ(imbalance, 0, stress_scale))
      contradict_load(point, friction_entry(), "give that of the solution");
    if (g(point) == 0 || !differ(lambda * (u * t), std::abs(u * t), displacement_scale))
      return;
    if (lambda == 0)
      contradict(friction_entry(), point, "leave the contact without friction");
    reject(scene, "Exact solution", "Length",
           "lets the body slip against its friction at " + to_string(point) +
               "; enlarge it or move Transition to the right");
  }

  /** Tresca's bound, or Coulomb's under the pressure of the solution. */
  double g(const Point<2> &point) const
  {
    if (boundary.friction.coefficient)
      return boundary.friction.coefficient->value(point) * std::max(0., exact.pressure(point));
    return boundary.friction.bound ? boundary.friction.bound->value(point) : 0.;
  }

  std::string friction_entry() const
  {
    return boundary.friction.coefficient ? "Friction coefficient" : "Friction bound";
  }

  double traction(const unsigned int component, const Point<2> &point) const
  {
    return boundary.traction[component] ? boundary.traction[component]->value(point) : 0.;
  }

  static bool differ(const double a, const double b, const double scale)
  {
    return !(std::abs(a - b) <= tolerance * scale);
  }

  /** A load on the contact is at fault, or else @p entry. */
  [[noreturn]] void contradict_load(const Point<2> &point, const std::string &entry,
                                    const std::string &remedy) const
  {
    if (boundary.has_traction())
      contradict("Traction", point, "leave the contact without traction");
    contradict(entry, point, remedy);
  }

  [[noreturn]] void contradict(const std::string &entry, const Point<2> &point,
                               const std::string &remedy) const
  {
    reject(scene, section, entry,
           "contradicts " + mention(scene, "Exact solution", "Solution") + " at " +
               to_string(point) + "; " + remedy + " or set Solution = none");
  }

  static constexpr double tolerance = 1e-8;
  const Scene<2> &scene;
  const ExactSolution<2> &exact;
  const BoundaryCondition<2> &boundary;
  const std::string section;
  const Edge edge;
  std::array<std::unique_ptr<const Function<2>>, 2> stress; ///< the components of `sigma n`
  double displacement_scale = 0, stress_scale = 0;
};

void check_corners(const Scene<2> &scene)
{
  const std::vector<Edge> edges = edges_of(scene.geometry);
  const double tolerance = support_tolerance(scene);
  for (unsigned int c = 0; c < scene.geometry.corners.size(); ++c)
  {
    const Point<2> &corner = scene.geometry.corners[c];
    std::vector<PointCondition> conditions, limits;
    for (unsigned int f = 0; f < edges.size(); ++f)
      if (edges[f].corners[0] == c || edges[f].corners[1] == c)
      {
        const BoundaryCondition<2> &boundary = scene.boundaries[f];
        for (const PointCondition &condition : conditions_at(boundary, edges[f], corner))
          conditions.push_back(condition);
        if (boundary.is_unilateral())
          limits.push_back({edges[f].normal, boundary.gap_at(corner), boundary.id});
      }
    check_corner(scene, corner, conditions, limits, tolerance);
  }
}

void check_exact_solution(const Scene<2> &scene)
{
  if (scene.exact_solution == nullptr)
    return;
  if (scene.has_body_force())
    reject(scene, "Body force", "Expression",
           "contradicts " + mention(scene, "Exact solution", "Solution") +
               ", which has none; remove it or set Solution = none");
  if (scene.materials.size() > 1)
    reject(scene, "Exact solution", "Solution",
           "knows one material, and the scene has " + std::to_string(scene.materials.size()) +
               "; measure errors by Error/Reference solution");
  for (unsigned int b = 0; b < scene.boundaries.size(); ++b)
    ExactSolutionCheck(scene, b).run();
}

/** @p check of each load step in turn; what it refuses names the load step. */
void check_load_steps(const Scene<2> &scene, const std::function<void(unsigned int)> &check)
{
  for (unsigned int step = 1; step <= scene.loading.steps; ++step)
    try
    {
      check(step);
    }
    catch (const InputError &error)
    {
      const std::string line = error.what(), time = "t = " + to_string(scene.loading.time(step));
      if (step == 1 || line.find(time) != std::string::npos)
        throw;
      throw InputError(line + " (load step " + std::to_string(step) + ", " + time + ")");
    }
}

/** A history has no closed form here, and what one load step is compared with is none of another. */
void check_load_history(const Scene<2> &scene, const SceneUse use)
{
  const Loading<2> &loading = scene.loading;
  const std::string history = "is one state, and Loading/Steps asks for a history; remove either";
  if (loading.steps < 1 || loading.steps > 10000 || !loading.at)
    reject(scene, "Loading", "Steps",
           "is no history; give an integer from 1 to 10000, and the scene of each load step",
           std::to_string(loading.steps));
  if (use == SceneUse::measure)
    reject(scene, "Loading", "Steps",
           "is a history, and the inf-sup constant is one of a mesh, whatever the load; remove it",
           std::to_string(loading.steps));
  if (scene.exact_solution)
    reject(scene, "Exact solution", "Solution", history);
  if (!scene.reference_solution.empty())
    reject(scene, "Error", "Reference solution", history);
  if (scene.output.reference)
    reject(scene, "Output", "Reference solution", history, "true");
  DataScale past;
  check_load_steps(scene,
                   [&](const unsigned int step)
                   {
                     const Scene<2> next = load_step(scene, step, past);
                     next.check(use);
                     past = data_scale(next);
                   });
  if (past.stress == 0) // without data, or with none that is large enough to be squared
    check_load_steps(scene,
                     [&](const unsigned int step) { loading.at(loading.time(step)).check(use); });
}

/** A reference solution holds the entries of its problem, for those who compare with it. */
void check_reference(const Scene<2> &scene)
{
  if (!scene.parameters && (scene.output.reference || !scene.reference_solution.empty()))
    fail(printable(scene.name),
         scene.output.reference ? "Output/Reference solution" : "Error/Reference solution",
         "compares the entries of two files, and this scene has none; read it from a file");
  if (!scene.reference_solution.empty() && !std::ifstream(scene.reference_solution))
    reject(scene, "Error", "Reference solution",
           "cannot be read; make the file by a run with Output/Reference solution = "
           "true, or leave the entry empty");
}

// ---------------------------------------------------------------- the method

void check_adaptivity(const Scene<2> &scene)
{
  const Adaptivity &adaptivity = scene.adaptivity;
  const std::string start = std::to_string(adaptivity.start_degree);
  if (adaptivity.start_degree == 0) // a file's own degree, which the reader has put in its place
    reject(scene, "Adaptivity", "Start degree",
           "is no degree; give one from 1 to 20, as own_start_degree()", start);
  if (adaptivity.start_degree > adaptivity.maximum_degree)
    reject(scene, "Adaptivity", "Start degree",
           "exceeds Maximum degree = " + std::to_string(adaptivity.maximum_degree) +
               "; lower the one or raise the other",
           start);
  if (adaptivity.hpa1_bisected + adaptivity.hpa1_raised > 1 + 1e-12)
    reject(scene, "Adaptivity", "hpa1 raised fraction",
           "makes more than all cells with hpa1 bisected fraction = " +
               (scene.parameters ? scene.parameters->text("Adaptivity", "hpa1 bisected fraction")
                                 : text(adaptivity.hpa1_bisected)) +
               "; let the two sum to at most 1",
           text(adaptivity.hpa1_raised));
}

/** Coulomb's bounds follow the pressure, which nodes would let turn negative between them. */
void check_normal_contact(const Scene<2> &scene)
{
  for (const BoundaryCondition<2> &boundary : scene.boundaries)
    if (scene.solver.normal_contact == NormalContact::nodes && boundary.is_unilateral() &&
        boundary.friction.coefficient)
      reject(scene, "Solver", "Normal contact",
             "is not offered with the Friction coefficient of Boundary " + boundary.name +
                 "; set multiplier, or automatic",
             "nodes");
}

/** Only contact without friction that closes at nodes needs no multiplier. */
bool needs_multiplier(const Scene<2> &scene, const BoundaryCondition<2> &boundary)
{
  return boundary.has_contact() && (!boundary.is_unilateral() || boundary.friction ||
                                    scene.normal_contact() == NormalContact::multiplier);
}

void check_multiplier_degree(const Scene<2> &scene, const SceneUse use)
{
  if (std::none_of(scene.boundaries.begin(), scene.boundaries.end(),
                   [&](const BoundaryCondition<2> &b) { return needs_multiplier(scene, b); }))
    return;
  const int offset = scene.solver.multiplier_offset;
  // p + 1 multipliers on each edge meet p tangential displacements per edge, and one more at most.
  if (offset >= 0 && use == SceneUse::solve)
    reject(scene, "Solver", "Multiplier degree offset",
           "makes S singular: there are more multipliers than displacements on the "
           "contact boundary determine, the discrete inf-sup constant is 0; give -2, or "
           "measure the constant by hpvi --inf-sup",
           std::to_string(offset));
  if (static_cast<int>(scene.adaptivity.start_degree) + offset < 0)
    reject(scene, "Adaptivity", "Start degree",
           "is too low for contact: the multiplier has degree p - " + std::to_string(-offset) +
               "; give at least " + std::to_string(-offset) +
               " or raise Solver/Multiplier degree offset = " + std::to_string(offset),
           std::to_string(scene.adaptivity.start_degree));
}

/** At least so many: grading adds some, and what two edges hold at their corner is held once. */
void check_first_step(const Scene<2> &scene)
{
  const unsigned int degree = scene.adaptivity.start_degree;
  const double nodes_x = 1. + degree * scene.geometry.subdivisions[0],
               nodes_y = 1. + degree * scene.geometry.subdivisions[1];
  double unknowns = 2 * nodes_x * nodes_y;
  for (const BoundaryCondition<2> &boundary : scene.boundaries)
  {
    unsigned int held = boundary.holds_normal() ? 1 : 0;
    for (const auto &component : boundary.displacement)
      held += component != nullptr ? 1 : 0;
    unknowns -= std::min(held, 2U) * (boundary.id < 2 ? nodes_y : nodes_x);
  }
  if (unknowns > scene.adaptivity.maximum_unknowns)
    reject(scene, "Geometry", "Subdivisions",
           "makes at least " + std::to_string(std::llround(unknowns)) +
               " free unknowns of degree " + std::to_string(degree) +
               " in the first step, more than Adaptivity/Maximum unknowns = " +
               std::to_string(scene.adaptivity.maximum_unknowns) +
               "; start coarser or raise that limit");
}
} // namespace

std::vector<RigidBodyMotion<2>> free_motions(const Scene<2> &scene)
{
  const std::vector<Edge> edges = edges_of(scene.geometry);
  const Point<2> centre = centre_of(scene.geometry);
  double length = 0;
  for (const Point<2> &corner : scene.geometry.corners)
    length = std::max(length, corner.distance(centre));

  std::vector<RigidMotion> held, resisted; // by supports; by supports or contact
  for (unsigned int f = 0; f < edges.size(); ++f)
    for (const Point<2> &end : edges[f].ends) // rigid-body motions are linear along an edge
    {
      const BoundaryCondition<2> &boundary = scene.boundaries[f];
      for (const PointCondition &condition : conditions_at(boundary, edges[f], end))
        // Coulomb's law has a multiplier where bilateral contact is a support else.
        (boundary.has_pressure() ? resisted : held)
            .push_back(row_of(condition.direction, end, centre, length));
      const Tensor<1, 2> &n = edges[f].normal;
      if (boundary.friction) // where it vanishes, the mesh decides
        resisted.push_back(row_of(Tensor<1, 2>({-n[1], n[0]}), end, centre, length));
    }
  resisted.insert(resisted.end(), held.begin(), held.end());
  // Unilateral contact holds some motions one way, and what none holds may be in balance.
  if (const auto motions = free_motions(resisted);
      !motions.empty() && !scene.has_unilateral_contact())
    throw InputError(printable(scene.origin(), 400) +
                     ": Boundary left, right, bottom, top/Displacement: the supports leave a "
                     "rigid-body motion free, " +
                     describe(motions.front(), centre, length) +
                     ", and no friction resists it; prescribe a displacement component or "
                     "contact that stops it");
  std::vector<RigidBodyMotion<2>> result;
  for (const RigidMotion &motion : free_motions(held))
  {
    RigidBodyMotion<2> free{Tensor<1, 2>({motion[0], motion[1]}), motion[2] / length, centre};
    if (is_translation(motion))
    {
      free.translation /= free.translation.norm();
      free.rotation = 0;
    }
    result.push_back(free);
  }
  return result;
}

void check_scene(const Scene<2> &scene, const SceneUse use)
{
  if (scene.has_load_history())
    check_load_history(scene, use);
  check_geometry(scene);
  check_materials(scene);
  check_boundaries(scene);
  check_corners(scene);
  free_motions(scene);
  check_exact_solution(scene);
  check_reference(scene);
  for_each_value(scene, CheckValue(scene));
  check_adaptivity(scene);
  check_first_step(scene);
  check_normal_contact(scene);
  check_multiplier_degree(scene, use);
}

// ---------------------------------------------------------------- round-off of data

namespace
{
/** Raises @p magnitude to what @p function has at @p points, but for what its check refuses. */
template <int dim>
void raise(double &magnitude, const Expression<dim> &function,
           const std::vector<Point<dim>> &points, const std::function<double(double)> &size)
{
  if (function)
    for (const Point<dim> &point : points)
      if (const double value = size(function->value(point)); value <= largest)
        magnitude = std::max(magnitude, value);
}

/** @p function, but 0 where that is round-off. */
template <int dim>
void drop(const double round_off, Expression<dim> &function)
{
  if (function)
    function = expression<dim>(
        [function = function, round_off](const Point<dim> &x)
        {
          const double value = function->value(x);
          return std::abs(value) < round_off ? 0. : value;
        });
}

template <int dim>
double size_of(const Geometry<dim> &geometry)
{
  return geometry.corners.front().distance(geometry.corners.back());
}
} // namespace

template <int dim>
DataScale data_scale(const Scene<dim> &scene)
{
  const double size = size_of(scene.geometry);
  const auto absolute = [](const double value) { return std::abs(value); };
  DataScale scale = scene.past_data;
  double force = 0;
  for (const Expression<dim> &component : scene.body_force)
    raise<dim>(force, component, sample_body(scene.geometry), absolute);
  scale.stress = std::max(scale.stress, force * size);
  for (const BoundaryCondition<dim> &boundary : scene.boundaries)
  {
    const std::vector<Point<dim>> points = sample_side(scene.geometry, boundary.id);
    for (unsigned int c = 0; c < dim; ++c)
    {
      raise<dim>(scale.stress, boundary.traction[c], points, absolute);
      raise<dim>(scale.displacement, boundary.displacement[c], points, absolute);
    }
    raise<dim>(scale.displacement, boundary.gap, points, [](const double gap) { return -gap; });
    raise<dim>(scale.displacement, boundary.friction.past, points, absolute);
  }
  double softest = scene.largest_mu();
  for (const Material &material : scene.materials)
    softest = std::min(softest, material.mu());
  const double strain = scale.stress / scene.largest_mu();
  scale.stress = std::max(scale.stress, softest * scale.displacement / size);
  scale.displacement = std::max(scale.displacement, strain * size);
  return scale;
}

template <int dim>
double support_tolerance(const Scene<dim> &scene)
{
  return 1e-10 * data_scale(scene).displacement;
}

template <int dim>
Scene<dim> load_step(const Scene<dim> &scene, const unsigned int number, const DataScale &past)
{
  Scene<dim> result = scene.loading.at(scene.loading.time(number));
  result.past_data = past;
  // A tenth of what counts as round-off of a solution: nothing that is seen is lost.
  const auto round_off = [](const double largest)
  { return std::max(0.1 * round_off_of_data * largest, smallest); };
  const DataScale scale = data_scale(result);
  for (Expression<dim> &component : result.body_force)
    drop(round_off(scale.stress / size_of(scene.geometry)), component);
  for (BoundaryCondition<dim> &boundary : result.boundaries)
  {
    for (unsigned int c = 0; c < dim; ++c)
    {
      drop(round_off(scale.stress), boundary.traction[c]);
      drop(round_off(scale.displacement), boundary.displacement[c]);
    }
    drop(round_off(scale.displacement), boundary.gap);
  }
  return result;
}

template DataScale data_scale(const Scene<2> &);
template DataScale data_scale(const Scene<3> &);
template double support_tolerance(const Scene<2> &);
template double support_tolerance(const Scene<3> &);
template Scene<2> load_step(const Scene<2> &, unsigned int, const DataScale &);
} // namespace hpvi
