// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/space_checks.h>

#include <hpvi/base/formatting.h>
#include <hpvi/base/parameter_file.h>
#include <hpvi/base/text.h>
#include <hpvi/scene/parameters.h>
#include <hpvi/scene/scene_checks.h>
#include <hpvi/scene/scene_entries.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace hpvi
{
using namespace dealii;

namespace
{
/** As in the plane: squares of these must not over- or underflow. */
constexpr double smallest = 1e-100, largest = 1e100;

template <int dim>
[[noreturn]] void reject(const Scene<dim> &scene, const std::string &section,
                         const std::string &name, const std::string &problem_and_remedy,
                         const std::string &value = "")
{
  if (scene.parameters)
    scene.parameters->reject(section, name, problem_and_remedy);
  fail(printable(scene.name), section + "/" + name + (value.empty() ? "" : " = " + value),
       problem_and_remedy);
}

std::string section_of(const BoundaryCondition<3> &boundary)
{
  return "Boundary " + boundary.name;
}

/** Compares what code may have set with what a file may say. */
struct CheckNumber
{
  const Scene<3> &scene;
  const std::vector<Entry> entries = scene_entries(3);

  template <class Number>
  void operator()(const std::string &section, const std::string &name, const Number value) const
  {
    if constexpr (std::is_same_v<Number, bool>)
      return;
    std::string shown = std::to_string(value);
    if constexpr (std::is_same_v<Number, double>)
      shown = text(value);
    for (const Entry &entry : entries)
      if (entry.section == section && entry.name == name)
        if (const std::string objection = entry.objection(shown); !objection.empty())
          reject(scene, section, name, objection, shown);
  }
};

void check_box(const Scene<3> &scene)
{
  const Corners<3> &corners = scene.geometry.corners;
  double farthest = 0, shortest = largest;
  for (unsigned int d = 0; d < 3; ++d)
  {
    if (!(corners.front()[d] < corners.back()[d]))
      reject(scene, "Geometry", "Upper corner",
             "is not beyond the lower corner " + to_string(corners.front()) +
                 " in every direction; enlarge every coordinate beyond it",
             to_string(corners.back()));
    farthest = std::max({farthest, std::abs(corners.front()[d]), std::abs(corners.back()[d])});
    shortest = std::min(shortest, corners.back()[d] - corners.front()[d]);
  }
  if (scene.geometry.shape != Shape::box || corners != box_corners(corners.front(), corners.back()))
    reject(scene, "Geometry", "Shape",
           "is no box, and space has no other shape; take box_corners()");
  if (!(farthest <= largest) || !(shortest >= smallest) || shortest < 1e-10 * farthest)
    reject(scene, "Geometry", "Upper corner",
           "has an edge of length " + to_string(shortest) + " and coordinates up to " +
               to_string(farthest) +
               ", beyond what double precision can tell apart; choose another unit or move the "
               "body towards the origin");
}

// ---------------------------------------------------------------- functions

void check_function(const Scene<3> &scene, const std::string &section, const std::string &name,
                    const Expression<3> &function, const std::vector<Point<3>> &points,
                    const bool may_be_negative = true)
{
  double magnitude = 0;
  for (const Point<3> &point : points)
  {
    const double value = function ? function->value(point) : 0.;
    if (!std::isfinite(value))
      reject(scene, section, name,
             "is not finite at " + to_string(point) +
                 "; give a function that is finite everywhere it applies");
    if (value < 0 && !may_be_negative)
      reject(scene, section, name,
             "is " + to_string(value) + " at " + to_string(point) +
                 "; Tresca's bound needs g >= 0");
    magnitude = std::max(magnitude, std::abs(value));
  }
  if (magnitude > largest || (magnitude > 0 && magnitude < smallest))
    reject(scene, section, name,
           "has a component of magnitude " + to_string(magnitude) +
               ", outside 1e-100 to 1e100; choose other units or write 0");
}

void check_functions(const Scene<3> &scene)
{
  for (const auto &component : scene.body_force)
    check_function(scene, "Body force", "Expression", component, sample_body(scene.geometry));
  for (const BoundaryCondition<3> &boundary : scene.boundaries)
  {
    const auto points = sample_side(scene.geometry, boundary.id);
    for (const auto &component : boundary.displacement)
      check_function(scene, section_of(boundary), "Displacement", component, points);
    for (const auto &component : boundary.traction)
      check_function(scene, section_of(boundary), "Traction", component, points);
    check_function(scene, section_of(boundary), "Gap", boundary.gap, points);
    check_function(scene, section_of(boundary), "Friction bound", boundary.friction.bound, points,
                   false);
  }
}

/** What one boundary may say of itself. */
void check_boundary(const Scene<3> &scene, const BoundaryCondition<3> &boundary)
{
  const std::string section = section_of(boundary);
  for (unsigned int d = 0; d < 3; ++d)
    if (boundary.traction[d] != nullptr && boundary.displacement[d] != nullptr)
      reject(scene, section, "Traction",
             std::string("acts on the component ") + "xyz"[d] +
                 " that Displacement prescribes; make that component 0 here or free there");
  if (boundary.friction.bound && !boundary.has_contact())
    reject(scene, section, "Friction bound", friction_needs_contact);
  if (boundary.friction.coefficient && !boundary.has_contact())
    reject(scene, section, "Friction coefficient", friction_needs_contact);
  if (boundary.gap && !boundary.is_unilateral())
    reject(scene, section, "Gap", gap_needs_contact);
  if (boundary.contact == Contact::tangential && !boundary.friction)
    reject(scene, section, "Contact",
           "has friction nowhere to act; give Friction bound > 0 or set Contact = none",
           "tangential");
  if (boundary.has_contact() && boundary.has_displacement())
    reject(scene, section, "Displacement", "stands beside Contact; keep only one of the two");
}

// ---------------------------------------------------------------- supports

/** The value that @p boundary prescribes to a component at @p x; NaN: none. */
double prescribed(const BoundaryCondition<3> &boundary, const unsigned int component,
                  const Point<3> &x)
{
  if (boundary.holds_normal() && component == boundary.id / 2)
    return 0.;
  const auto &displacement = boundary.displacement[component];
  return displacement ? displacement->value(x) : std::numeric_limits<double>::quiet_NaN();
}

/** A support beside unilateral contact must not move the body into the foundation. */
void check_gap(const Scene<3> &scene, const BoundaryCondition<3> &contact,
               const BoundaryCondition<3> &support, const Point<3> &x, const double tolerance)
{
  const double sign = contact.id % 2 == 0 ? -1. : 1.,
               u_n = sign * prescribed(support, contact.id / 2, x);
  if (!contact.is_unilateral() || std::isnan(u_n))
    return;
  const double gap = contact.gap_at(x);
  if (u_n > gap + tolerance)
    reject(scene, section_of(support), "Displacement",
           "contradicts Boundary " + contact.name + "/Gap at their common point " + to_string(x) +
               ", for u_n exceeds the gap by " + to_string(u_n - gap) +
               "; let u_n <= u_0 there or free one component");
}

/** Two sides that meet in an edge must agree there. */
void check_edge(const Scene<3> &scene, const BoundaryCondition<3> &one,
                const BoundaryCondition<3> &two, const double tolerance)
{
  const double edge = scene.geometry.corners[0][two.id / 2],
               far_edge = scene.geometry.corners[7][two.id / 2];
  for (const Point<3> &x : sample_side(scene.geometry, one.id))
  {
    if (x[two.id / 2] != (two.id % 2 == 0 ? edge : far_edge))
      continue;
    check_gap(scene, one, two, x, tolerance);
    check_gap(scene, two, one, x, tolerance);
    for (unsigned int c = 0; c < 3; ++c)
    {
      const double a = prescribed(one, c, x), b = prescribed(two, c, x);
      if (std::abs(a - b) > tolerance) // NaN: one is free
      {
        const BoundaryCondition<3> &changeable = one.has_contact() ? two : one;
        reject(scene, section_of(changeable), "Displacement",
               "contradicts Boundary " + (one.has_contact() ? one : two).name +
                   " at their common point " + to_string(x) + " by " + to_string(std::abs(a - b)) +
                   "; make both agree there or free one component");
      }
    }
  }
}

/** u_c at @p x of the motion `a + b x (x - centre)/length`, by its six coefficients. */
std::array<double, 6> row_of(const unsigned int component, const Tensor<1, 3> &arm)
{
  std::array<double, 6> row{};
  row[component] = 1;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    Tensor<1, 3> rotation;
    rotation[axis] = 1;
    row[3 + axis] = cross_product_3d(rotation, arm)[component];
  }
  return row;
}

/** The smallest eigenvalue of the conditions' normal matrix relative to the largest. */
double least_resistance(const Scene<3> &scene)
{
  const Corners<3> &corners = scene.geometry.corners;
  const Point<3> centre = corners[0] + 0.5 * (corners[7] - corners[0]);
  const double length = corners[7].distance(centre);
  FullMatrix<double> normal(6, 6);
  for (const BoundaryCondition<3> &boundary : scene.boundaries)
    for (const Point<3> &x : sample_side(scene.geometry, boundary.id))
      for (unsigned int c = 0; c < 3; ++c)
        if (!std::isnan(prescribed(boundary, c, x)))
        {
          const auto row = row_of(c, (x - centre) / length);
          for (unsigned int i = 0; i < 6; ++i)
            for (unsigned int j = 0; j < 6; ++j)
              normal(i, j) += row[i] * row[j];
        }
  LAPACKFullMatrix<double> matrix(6, 6);
  matrix = normal;
  Vector<double> eigenvalues(6);
  FullMatrix<double> eigenvectors(6, 6);
  matrix.compute_eigenvalues_symmetric(-1, std::numeric_limits<double>::max() / 4, 1e-14,
                                       eigenvalues, eigenvectors);
  return eigenvalues[5] > 0 ? eigenvalues[0] / eigenvalues[5] : 0.;
}

/** At least so many: grading adds some. */
void check_first_step(const Scene<3> &scene)
{
  std::array<double, 3> nodes;
  for (unsigned int d = 0; d < 3; ++d)
    nodes[d] = 1. + scene.adaptivity.start_degree * double(scene.geometry.subdivisions[d]);
  double unknowns = 3 * nodes[0] * nodes[1] * nodes[2];
  for (const BoundaryCondition<3> &boundary : scene.boundaries)
    for (unsigned int c = 0; c < 3; ++c)
      if (boundary.displacement[c] || (boundary.holds_normal() && c == boundary.id / 2))
        unknowns -= nodes[0] * nodes[1] * nodes[2] / nodes[boundary.id / 2];
  if (unknowns > scene.adaptivity.maximum_unknowns)
    reject(scene, "Geometry", "Subdivisions",
           "makes at least " + text(std::floor(unknowns)) + " free unknowns of degree " +
               std::to_string(scene.adaptivity.start_degree) +
               " in the first step, more than Adaptivity/Maximum unknowns = " +
               std::to_string(scene.adaptivity.maximum_unknowns) +
               "; start coarser or raise that limit");
}
} // namespace

void check_geometry(const Scene<3> &scene)
{
  check_box(scene);
  const Geometry<3> &geometry = scene.geometry;
  double cells = 1;
  for (const unsigned int n : geometry.subdivisions)
    cells *= n;
  if (cells == 0)
    reject(scene, "Geometry", "Subdivisions", "makes no cells; give three positive integers");
  if (cells > 1e6)
    reject(scene, "Geometry", "Subdivisions",
           "makes more than a million cells; start coarse and let the mesh adapt");
  if (geometry.grading_levels > 0 && geometry.graded_towards.empty())
    reject(scene, "Geometry", "Grading levels",
           "has no point to grade to; set Graded towards = x, y, z or remove it");
  for (const Point<3> &point : geometry.graded_towards)
    for (unsigned int d = 0; d < 3; ++d)
      if (!(point[d] >= geometry.corners[0][d] && point[d] <= geometry.corners[7][d]))
        reject(scene, "Geometry", "Graded towards",
               "has the point " + to_string(point) + " outside the body; name points of the body");
}

void check_materials(const Scene<3> &scene)
{
  if (scene.materials.empty() || (scene.materials.size() > 1 && !scene.material_at))
    fail(printable(scene.origin()), "Material",
         "is missing, or not said where; give at least one, and material_at for more");
  for (const Material &material : scene.materials)
  {
    CheckNumber{scene}("Material", "Young's modulus", material.young);
    if (!(material.poisson > -1 && material.poisson < 0.5))
      reject(scene, "Material", "Poisson's ratio",
             "is outside (-1, 1/2); an elastic material has -1 < nu < 1/2", text(material.poisson));
  }
}

std::vector<RigidBodyMotion<3>> free_motions(const Scene<3> &scene)
{
  if (least_resistance(scene) < 1e-12)
    throw InputError(printable(scene.origin(), 400) +
                     ": Boundary left, right, bottom, top, front, back/Displacement: the supports "
                     "leave a rigid-body motion free, which neither friction nor unilateral "
                     "contact may resist in space; prescribe a displacement component or "
                     "bilateral contact that stops it");
  return {};
}

template <int dim>
void check_primal_path(const Scene<dim> &scene)
{
  const std::string why = dim == 3 ? "space" : "the primal path";
  const Adaptivity &adaptivity = scene.adaptivity;
  if (adaptivity.method >= Method::pu)
    reject(scene, "Adaptivity", "Method",
           "varies the degree from cell to cell or with the steps, which " + why +
               " does not offer; take hup2, hup3, hup4, hap2, hap3 or hap4",
           method_names[static_cast<unsigned int>(adaptivity.method)]);
  if (adaptivity.start_degree < 2 || adaptivity.start_degree > 8)
    reject(scene, "Adaptivity", "Start degree", "is not offered by " + why + "; give 2 to 8",
           std::to_string(adaptivity.start_degree));
  for (const BoundaryCondition<dim> &boundary : scene.boundaries)
  {
    const std::string section = "Boundary " + boundary.name;
    if (boundary.friction.coefficient)
      reject(scene, section, "Friction coefficient",
             "is Coulomb's law, which " + why + " does not offer; give Friction bound, Tresca's");
  }
  if (scene.has_unilateral_contact() && scene.normal_contact() == NormalContact::nodes)
    reject(scene, "Solver", "Normal contact",
           "is not offered by " + why + ", whose pressures are multipliers; set multiplier",
           "nodes");
  if ((scene.has_friction() || scene.has_unilateral_contact()) &&
      scene.solver.multiplier_offset != -2)
    reject(scene, "Solver", "Multiplier degree offset",
           "is not offered by " + why + ", whose moments need -2; remove it");
  if (scene.solver.condition_number)
    reject(scene, "Solver", "Condition number",
           "asks for a matrix S that " + why + " does not form; remove it");
  if (scene.output.reference || !scene.reference_solution.empty())
    reject(scene, scene.output.reference ? "Output" : "Error", "Reference solution",
           "is not offered by " + why + "; remove it");
  if (scene.loading.steps > 0)
    reject(scene, "Loading", "Steps",
           "is a load history, which " + why + " does not offer; remove it",
           std::to_string(scene.loading.steps));
  if (scene.geometry.shape != Shape::box)
    reject(scene, "Geometry", "Shape", "is not offered by " + why + "; set Shape = box",
           "quadrilateral");
  if (scene.exact_solution)
    reject(scene, "Exact solution", "Solution",
           "is not offered by " + why + "; set Path = reduced or remove it");
}

void check_scene(const Scene<3> &scene, const SceneUse use)
{
  if (scene.solver.path == SolutionPath::reduced)
    reject(scene, "Solver", "Path", "is not offered in space; set auto or primal", "reduced");
  if (use == SceneUse::measure)
    throw InputError(printable(scene.origin(), 400) +
                     ": Dimension = 3: the inf-sup constant is measured in the plane alone; remove "
                     "--inf-sup");
  check_geometry(scene);
  check_materials(scene);
  if (scene.boundaries.size() != 6)
    fail(printable(scene.origin()), "Boundary", "has not six parts; add and remove none");
  check_functions(scene);
  for (const BoundaryCondition<3> &boundary : scene.boundaries)
    check_boundary(scene, boundary);
  const double tolerance = support_tolerance(scene);
  for (unsigned int a = 0; a < 6; ++a)
    for (unsigned int b = a + 1; b < 6; ++b)
      if (a / 2 != b / 2)
        check_edge(scene, scene.boundaries[a], scene.boundaries[b], tolerance);
  free_motions(scene);
  for_each_value(scene, CheckNumber{scene});
  check_primal_path(scene);
  check_first_step(scene);
}

template void check_primal_path(const Scene<2> &);
template void check_primal_path(const Scene<3> &);
} // namespace hpvi
