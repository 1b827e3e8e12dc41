// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/scene_checks.h>

#include <hpvi/base/text.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace hpvi
{
using namespace dealii;

namespace
{
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
  if (boundary.bilateral_contact)
    conditions.push_back({edge.normal, 0., boundary.id});
  return conditions;
}

/** The entry that says what happens to the displacement of a boundary. */
std::string support_entry(const BoundaryCondition<2> &boundary)
{
  return boundary.bilateral_contact ? "Contact" : "Displacement";
}

[[noreturn]] void reject_corner(const Parameters &parameters, const BoundaryCondition<2> &one,
                                const BoundaryCondition<2> &two, const Point<2> &corner,
                                const double contradiction)
{
  // The message stands at the boundary whose value can be changed.
  const BoundaryCondition<2> &changeable = one.bilateral_contact ? two : one;
  const BoundaryCondition<2> &other = one.bilateral_contact ? one : two;
  const std::string section = "Boundary " + other.name;
  parameters.reject("Boundary " + changeable.name, support_entry(changeable),
                    "contradicts " + section + "/" + support_entry(other) + " = " +
                        parameters.text(section, support_entry(other)) + " at their corner " +
                        to_string(corner) + " by " + to_string(std::abs(contradiction)) +
                        "; make both agree there or free one component");
}

/** The largest displacement that any boundary prescribes. */
double largest_displacement(const Scene<2> &scene, const std::vector<Edge> &edges)
{
  double largest = 0;
  for (unsigned int f = 0; f < edges.size(); ++f)
    for (const Point<2> &point : edges[f].sample())
      for (const PointCondition &condition : conditions_at(scene.boundaries[f], edges[f], point))
        largest = std::max(largest, std::abs(condition.value));
  return largest;
}

/** Can all @p conditions at one corner hold together? */
void check_corner(const Parameters &parameters, const Scene<2> &scene, const Point<2> &corner,
                  const std::vector<PointCondition> &conditions, const double scale)
{
  std::vector<PointCondition> basis; // orthonormal directions, by Gram and Schmidt
  for (PointCondition rest : conditions)
  {
    for (const PointCondition &q : basis)
    {
      const double product = rest.direction * q.direction;
      rest.direction -= product * q.direction;
      rest.value -= product * q.value;
    }
    const double norm = rest.direction.norm();
    if (norm > 1e-6)
      basis.push_back({rest.direction / norm, rest.value / norm, rest.boundary});
    else if (std::abs(rest.value) > 1e-10 * scale)
      reject_corner(parameters, scene.boundaries[basis.front().boundary],
                    scene.boundaries[rest.boundary], corner, rest.value);
  }
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

/** May friction act against a translation along @p direction? Where it does, the mesh decides. */
bool friction_resists(const Scene<2> &scene, const std::vector<Edge> &edges,
                      const Tensor<1, 2> &direction)
{
  for (unsigned int f = 0; f < edges.size(); ++f)
    if (scene.boundaries[f].friction_bound &&
        (direction - (direction * edges[f].normal) * edges[f].normal).norm() > 1e-8)
      return true;
  return false;
}

// ---------------------------------------------------------------- the exact solution

/** Compares one boundary with the exact solution, at points all along it. */
class ExactSolutionCheck
{
public:
  ExactSolutionCheck(const Parameters &parameters, const Scene<2> &scene, const unsigned int id)
      : parameters(parameters), exact(*scene.exact_solution), boundary(scene.boundaries[id]),
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
      if (!boundary.bilateral_contact)
        check_traction(point);
      else
        check_contact(point);
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

  /** `u_n = 0`, `sigma_t = G_t - g lambda`, `|lambda| <= 1`, `lambda u_t = |u_t|`. */
  void check_contact(const Point<2> &point) const
  {
    const Tensor<1, 2> u = exact.displacement(point), n = edge.normal, t({-n[1], n[0]});
    if (differ(u * n, 0, displacement_scale))
      contradict("Contact", point, "set Contact = none");
    const double lambda = exact.multiplier(point);
    if (std::abs(lambda) > 1 + tolerance)
      parameters.reject("Exact solution", "Length",
                        "asks friction for |lambda| = " + to_string(std::abs(lambda)) + " > 1 at " +
                            to_string(point) +
                            "; enlarge it, shorten the contact or move Transition to the right");
    double imbalance = g(point) * lambda;
    for (unsigned int d = 0; d < 2; ++d)
      imbalance += t[d] * (stress[d]->value(point) - traction(d, point));
    if (differ(imbalance, 0, stress_scale))
      contradict("Traction", point, "leave the contact without traction");
    if (g(point) > 0 && differ(lambda * (u * t), std::abs(u * t), displacement_scale))
      parameters.reject("Exact solution", "Length",
                        "lets the body slip against its friction at " + to_string(point) +
                            "; enlarge it or move Transition to the right");
  }

  double g(const Point<2> &point) const
  {
    return boundary.friction_bound ? boundary.friction_bound->value(point) : 0.;
  }

  double traction(const unsigned int component, const Point<2> &point) const
  {
    return boundary.traction[component] ? boundary.traction[component]->value(point) : 0.;
  }

  static bool differ(const double a, const double b, const double scale)
  {
    return !(std::abs(a - b) <= tolerance * scale);
  }

  [[noreturn]] void contradict(const std::string &entry, const Point<2> &point,
                               const std::string &remedy) const
  {
    parameters.reject(
        section, entry,
        "contradicts Exact solution/Solution = " + parameters.text("Exact solution", "Solution") +
            " at " + to_string(point) + "; " + remedy + " or set Solution = none");
  }

  static constexpr double tolerance = 1e-8;
  const Parameters &parameters;
  const ExactSolution<2> &exact;
  const BoundaryCondition<2> &boundary;
  const std::string section;
  const Edge edge;
  std::array<std::unique_ptr<const Function<2>>, 2> stress; ///< the components of `sigma n`
  double displacement_scale = 0, stress_scale = 0;
};
} // namespace

void check_corners(const Parameters &parameters, const Scene<2> &scene)
{
  const std::vector<Edge> edges = edges_of(scene.geometry);
  const double scale = largest_displacement(scene, edges);
  for (unsigned int c = 0; c < scene.geometry.corners.size(); ++c)
  {
    const Point<2> &corner = scene.geometry.corners[c];
    std::vector<PointCondition> conditions;
    for (unsigned int f = 0; f < edges.size(); ++f)
      if (edges[f].corners[0] == c || edges[f].corners[1] == c)
        for (const PointCondition &condition : conditions_at(scene.boundaries[f], edges[f], corner))
          conditions.push_back(condition);
    check_corner(parameters, scene, corner, conditions, scale);
  }
}

std::optional<Tensor<1, 2>> free_translation(const Scene<2> &scene)
{
  const std::vector<Edge> edges = edges_of(scene.geometry);
  const Point<2> centre = centre_of(scene.geometry);
  double length = 0;
  for (const Point<2> &corner : scene.geometry.corners)
    length = std::max(length, corner.distance(centre));

  std::vector<RigidMotion> rows;
  for (unsigned int f = 0; f < edges.size(); ++f)
    for (const Point<2> &end : edges[f].ends) // rigid-body motions are linear along an edge
      for (const PointCondition &condition : conditions_at(scene.boundaries[f], edges[f], end))
      {
        const Tensor<1, 2> &n = condition.direction, arm = (end - centre) / length;
        rows.push_back({{n[0], n[1], n[1] * arm[0] - n[0] * arm[1]}});
      }
  std::optional<Tensor<1, 2>> translation;
  for (const RigidMotion &motion : free_motions(rows))
  {
    const Tensor<1, 2> direction({motion[0], motion[1]});
    if (translation || !is_translation(motion) || !friction_resists(scene, edges, direction))
      throw InputError(scene.file +
                       ": Boundary left, right, bottom, top/Displacement: the supports leave a "
                       "rigid-body motion free, " +
                       describe(motion, centre, length) +
                       ", and no friction resists it; prescribe a displacement component or "
                       "contact that stops it");
    translation = direction / direction.norm();
  }
  return translation;
}

void check_exact_solution(const Parameters &parameters, const Scene<2> &scene)
{
  if (scene.exact_solution == nullptr)
    return;
  if (scene.has_body_force())
    parameters.reject(
        "Body force", "Expression",
        "contradicts Exact solution/Solution = " + parameters.text("Exact solution", "Solution") +
            ", which has none; remove it or set Solution = none");
  for (unsigned int b = 0; b < scene.boundaries.size(); ++b)
    ExactSolutionCheck(parameters, scene, b).run();
}

void check_multiplier_degree(const Parameters &parameters, const Scene<2> &scene,
                             const SceneUse use)
{
  if (!scene.has_contact())
    return;
  const int offset = scene.solver.multiplier_offset;
  // p + 1 multipliers on each edge meet p tangential displacements per edge, and one more at most.
  if (offset >= 0 && use == SceneUse::solve)
    parameters.reject("Solver", "Multiplier degree offset",
                      "makes S singular: there are more multipliers than displacements on the "
                      "contact boundary determine, the discrete inf-sup constant is 0; give -2, or "
                      "measure the constant by hpvi --inf-sup");
  if (static_cast<int>(scene.adaptivity.start_degree) + offset < 0)
    parameters.reject("Adaptivity", "Start degree",
                      "is too low for contact: the multiplier has degree p - " +
                          std::to_string(-offset) + "; give at least " + std::to_string(-offset) +
                          " or raise Solver/Multiplier degree offset = " + std::to_string(offset));
}

/** At least so many: grading adds some, and what two edges hold at their corner is held once. */
void check_first_step(const Parameters &parameters, const Scene<2> &scene)
{
  const unsigned int degree = scene.adaptivity.start_degree;
  const double nodes_x = 1. + degree * scene.geometry.subdivisions[0],
               nodes_y = 1. + degree * scene.geometry.subdivisions[1];
  double unknowns = 2 * nodes_x * nodes_y;
  for (const BoundaryCondition<2> &boundary : scene.boundaries)
  {
    unsigned int held = boundary.bilateral_contact ? 1 : 0;
    for (const auto &component : boundary.displacement)
      held += component != nullptr ? 1 : 0;
    unknowns -= std::min(held, 2U) * (boundary.id < 2 ? nodes_y : nodes_x);
  }
  if (unknowns > scene.adaptivity.maximum_unknowns)
    parameters.reject("Geometry", "Subdivisions",
                      "makes at least " + std::to_string(std::llround(unknowns)) +
                          " free unknowns of degree " + std::to_string(degree) +
                          " in the first step, more than Adaptivity/Maximum unknowns = " +
                          std::to_string(scene.adaptivity.maximum_unknowns) +
                          "; start coarser or raise that limit");
}
} // namespace hpvi
