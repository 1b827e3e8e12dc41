// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/scene.h>

#include <hpvi/base/text.h>
#include <hpvi/scene/expressions.h>
#include <hpvi/scene/parameters.h>
#include <hpvi/scene/scene_checks.h>
#include <hpvi/scene/scene_entries.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Squares of lengths, stresses and displacements, and their products, must not over- or underflow. */
constexpr double smallest = 1e-100, largest = 1e100;

/** Without squares, which over- and underflow. */
double length(const Tensor<1, 2> &edge)
{
  return std::hypot(edge[0], edge[1]);
}

template <int dim>
std::array<Point<dim>, GeometryInfo<dim>::vertices_per_cell> read_box(const Parameters &parameters)
{
  const Point<dim> lower = parameters.points<dim>("Geometry", "Lower corner")[0];
  const Point<dim> upper = parameters.points<dim>("Geometry", "Upper corner")[0];
  std::array<Point<dim>, GeometryInfo<dim>::vertices_per_cell> corners;
  for (unsigned int d = 0; d < dim; ++d)
  {
    if (!(lower[d] < upper[d]))
      parameters.reject("Geometry", "Upper corner",
                        "is not above and right of the lower corner " + to_string(lower) +
                            "; enlarge every coordinate beyond it");
    for (unsigned int v = 0; v < corners.size(); ++v)
      corners[v][d] = ((v >> d) & 1u) ? upper[d] : lower[d];
  }
  if (!parameters.text("Geometry", "Corners").empty())
    parameters.reject("Geometry", "Corners",
                      "has no meaning for a box; set Shape = quadrilateral or remove it");
  return corners;
}

/** Turned into deal.II's order; each corner must turn left. */
std::array<Point<2>, 4> read_quadrilateral(const Parameters &parameters)
{
  const std::vector<Point<2>> around = parameters.points<2>("Geometry", "Corners");
  if (around.size() != 4)
    parameters.reject("Geometry", "Corners",
                      "does not give four corners; a quadrilateral needs \"x, y; x, y; x, y; "
                      "x, y\", counterclockwise from the bottom left");
  for (unsigned int c = 0; c < 4; ++c)
  {
    const Tensor<1, 2> in = around[c] - around[(c + 3) % 4], out = around[(c + 1) % 4] - around[c];
    const double sine =
        in[0] / length(in) * (out[1] / length(out)) - in[1] / length(in) * (out[0] / length(out));
    if (!(sine > 1e-12)) // no more than round-off
      parameters.reject("Geometry", "Corners",
                        "is degenerate, clockwise or not convex at " + to_string(around[c]) +
                            "; give the corners of a convex quadrilateral counterclockwise from "
                            "the bottom left");
  }
  return {{around[0], around[1], around[3], around[2]}};
}

/** Lengths that can be squared, edges that are more than round-off, corners that are corners. */
void check_shape(const Parameters &parameters, const Geometry<2> &geometry)
{
  const std::string entry = geometry.shape == Shape::box ? "Upper corner" : "Corners";
  double farthest = 0, shortest = std::numeric_limits<double>::max();
  for (const Point<2> &corner : geometry.corners)
    farthest = std::max({farthest, std::abs(corner[0]), std::abs(corner[1])});
  for (const Edge &edge : edges_of(geometry))
    shortest = std::min(shortest, length(edge.ends[1] - edge.ends[0]));
  if (!(farthest <= largest) || !(shortest >= smallest))
    parameters.reject("Geometry", entry,
                      "has lengths from " + to_string(shortest) + " to " + to_string(farthest) +
                          " and they must lie between 1e-100 and 1e100; choose another unit");
  if (shortest < 1e-10 * farthest)
    parameters.reject("Geometry", entry,
                      "has an edge of length " + to_string(shortest) + " and coordinates up to " +
                          to_string(farthest) +
                          ", which round-off blurs; move the body towards "
                          "the origin");
  const std::array<double, 4> angles = corner_angles(geometry);
  for (unsigned int c = 0; c < angles.size(); ++c)
    if (angles[c] < 0.1 || angles[c] > 179.9)
      parameters.reject("Geometry", entry,
                        "has an angle of " + to_string(angles[c]) + " degrees at " +
                            to_string(geometry.corners[c]) +
                            "; give a quadrilateral with angles between 0.1 and 179.9 degrees");
}

void check_grading(const Parameters &parameters, const Geometry<2> &geometry)
{
  if (geometry.grading_levels > 0 && geometry.graded_towards.empty())
    parameters.reject("Geometry", "Grading levels",
                      "has no point to grade to; set Graded towards = x, y or remove it");
  const double diameter = std::max(geometry.corners[0].distance(geometry.corners[3]),
                                   geometry.corners[1].distance(geometry.corners[2]));
  for (const Point<2> &point : geometry.graded_towards)
    for (const Edge &edge : edges_of(geometry))
      if (!(edge.normal * (point - edge.ends[0]) <= 1e-10 * diameter))
        parameters.reject("Geometry", "Graded towards",
                          "has the point " + to_string(point) +
                              " outside the body; name points of the body");
}

template <int dim>
Geometry<dim> read_geometry(const Parameters &parameters)
{
  Geometry<dim> geometry;
  const bool box = parameters.text("Geometry", "Shape") == "box";
  geometry.shape = box ? Shape::box : Shape::quadrilateral;
  geometry.corners = box ? read_box<dim>(parameters) : read_quadrilateral(parameters);
  check_shape(parameters, geometry);

  const std::vector<int> subdivisions = Utilities::string_to_int(
      Utilities::split_string_list(parameters.text("Geometry", "Subdivisions"), ','));
  double cells = 1;
  for (unsigned int d = 0; d < dim; ++d)
    cells *= geometry.subdivisions[d] = subdivisions[d];
  if (cells > 1e6)
    parameters.reject("Geometry", "Subdivisions",
                      "makes more than a million cells; start coarse and let the mesh adapt");

  geometry.graded_towards = parameters.points<dim>("Geometry", "Graded towards");
  geometry.grading_levels = parameters.integer("Geometry", "Grading levels");
  check_grading(parameters, geometry);
  return geometry;
}

Material read_material(const Parameters &parameters)
{
  Material material;
  material.young = parameters.number("Material", "Young's modulus");
  material.poisson = parameters.number("Material", "Poisson's ratio");
  material.plane =
      parameters.text("Material", "Plane") == "stress" ? PlaneModel::stress : PlaneModel::strain;
  if (!(material.poisson > -1 && material.poisson < 0.5))
    parameters.reject("Material", "Poisson's ratio",
                      "is outside (-1, 1/2); an elastic material has -1 < nu < 1/2");
  return material;
}

// ---------------------------------------------------------------- the exact solution

/** The value of a friction bound that is the same all along @p edge; NaN if it is not. */
double constant_friction_bound(const Parameters &parameters, const ExpressionReader<2> &expressions,
                               const std::string &boundary, const Edge &edge)
{
  const std::vector<Point<2>> points = edge.sample();
  const auto bound = expressions.read_bound("Boundary " + boundary, "Friction bound", points);
  if (bound == nullptr || parameters.text("Boundary " + boundary, "Contact") == "none")
    return 0.;
  const double value = bound->value(points[0]);
  const bool constant =
      std::all_of(points.begin(), points.end(),
                  [&](const Point<2> &point) { return bound->value(point) == value; });
  return constant ? value : std::numeric_limits<double>::quiet_NaN();
}

/** Every one of them slides along the bottom of the body, on y = 0. */
std::shared_ptr<const ExactSolution<2>> read_exact_solution(const Parameters &parameters,
                                                            const ExpressionReader<2> &expressions,
                                                            const Scene<2> &scene)
{
  const std::string section = "Exact solution", solution = parameters.text(section, "Solution");
  if (solution == "none")
    return nullptr;
  const unsigned int bottom = 2;
  const Edge edge = edges_of(scene.geometry)[bottom];
  if (edge.ends[0][1] != 0. || edge.ends[1][1] != 0. || edge.normal[1] > 0)
    parameters.reject(section, "Solution",
                      "slides along y = 0 below the body; put the bottom edge there");
  const double friction_bound =
      constant_friction_bound(parameters, expressions, boundary_names[bottom], edge);
  if (!(solution == "stick-slip" ? friction_bound > 0 : friction_bound >= 0))
    parameters.reject("Boundary " + boundary_names[bottom], "Friction bound",
                      "must be a positive constant for Exact solution/Solution = " + solution +
                          "; give a number, and Contact = bilateral");
  const double transition = parameters.number(section, "Transition");
  const double length = parameters.number(section, "Length");
  if (solution == "stick-slip")
    return std::make_shared<StickSlip>(scene.materials[0], friction_bound, transition, length);
  return std::make_shared<Smooth>(scene.materials[0], friction_bound, transition, length);
}

// ---------------------------------------------------------------- boundary conditions

/** A load needs a displacement that can give way. */
template <int dim>
void check_loads(const Parameters &parameters, const std::string &section,
                 const BoundaryCondition<dim> &boundary)
{
  for (unsigned int d = 0; d < dim; ++d)
    if (boundary.traction[d] != nullptr && boundary.displacement[d] != nullptr)
      parameters.reject(section, "Traction",
                        std::string("acts on the component ") + "xyz"[d] +
                            " that Displacement prescribes; make that component 0 here or free "
                            "there");
}

/** What contact excludes on the same boundary. */
template <int dim>
void check_contact(const Parameters &parameters, const std::string &section,
                   const BoundaryCondition<dim> &boundary)
{
  if (!boundary.bilateral_contact)
  {
    if (!parameters.text(section, "Friction bound").empty())
      parameters.reject(section, "Friction bound",
                        "needs contact; set Contact = bilateral or remove it");
    return;
  }
  if (boundary.has_displacement())
    parameters.reject(section, "Displacement",
                      "stands beside Contact = bilateral; keep only one of the two");
}

/** Loads and displacements enter energies as squares. */
template <int dim>
void check_magnitude(const Parameters &parameters, const std::string &section,
                     const std::string &name,
                     const std::array<typename BoundaryCondition<dim>::Expression, dim> &components,
                     const std::vector<Point<dim>> &points)
{
  for (const auto &component : components)
  {
    double magnitude = 0;
    for (const Point<dim> &point : points)
      if (component)
        magnitude = std::max(magnitude, std::abs(component->value(point)));
    if (magnitude > largest || (magnitude > 0 && magnitude < smallest))
      parameters.reject(section, name,
                        "has a component of magnitude " + to_string(magnitude) +
                            ", outside 1e-100 to 1e100; choose other units or write 0");
  }
}

template <int dim>
BoundaryCondition<dim> read_boundary(const Parameters &parameters,
                                     const ExpressionReader<dim> &expressions,
                                     const Scene<dim> &scene, const types::boundary_id id)
{
  using Expression = typename BoundaryCondition<dim>::Expression;
  const Edge edge = edges_of(scene.geometry)[id];
  const std::vector<Point<dim>> points = edge.sample();
  const auto exact_displacement = [&](const unsigned int c) -> Expression
  {
    return scene.exact_solution == nullptr
               ? nullptr
               : std::make_shared<ExactDisplacement<dim>>(scene.exact_solution, c);
  };
  const auto exact_traction = [&](const unsigned int c) -> Expression
  {
    return scene.exact_solution == nullptr
               ? nullptr
               : std::make_shared<ExactTraction<dim>>(scene.exact_solution, scene.materials[0],
                                                      edge.normal, c);
  };

  BoundaryCondition<dim> boundary;
  boundary.id = id;
  boundary.name = boundary_names[id];
  const std::string section = "Boundary " + boundary.name;
  boundary.displacement =
      expressions.template read<dim>(section, "Displacement", "free", points, exact_displacement);
  boundary.traction =
      expressions.template read<dim>(section, "Traction", "0", points, exact_traction);
  boundary.bilateral_contact = parameters.text(section, "Contact") == "bilateral";
  boundary.friction_bound = expressions.read_bound(section, "Friction bound", points);
  check_magnitude<dim>(parameters, section, "Displacement", boundary.displacement, points);
  check_magnitude<dim>(parameters, section, "Traction", boundary.traction, points);
  check_loads(parameters, section, boundary);
  check_contact(parameters, section, boundary);
  return boundary;
}

// ---------------------------------------------------------------- method, solver, output

unsigned int own_start_degree(const Method method)
{
  switch (method)
  {
  case Method::hup2:
  case Method::hap2:
  case Method::pu:
  case Method::hpa1:
    return 2;
  case Method::hup3:
  case Method::hap3:
  case Method::hpa2:
  case Method::hpa3:
    return 3;
  case Method::hup4:
  case Method::hap4:
    return 4;
  }
  return 2;
}

Method read_method(const Parameters &parameters)
{
  const auto found =
      std::find(method_names.begin(), method_names.end(), parameters.text("Adaptivity", "Method"));
  return static_cast<Method>(found - method_names.begin());
}

/** Resolves `Start degree = 0`, also in @p parameters. */
Adaptivity read_adaptivity(Parameters &parameters)
{
  const std::string section = "Adaptivity";
  Adaptivity adaptivity;
  adaptivity.method = read_method(parameters);
  adaptivity.reading = parameters.text(section, "Smoothness reading") == "plain"
                           ? SmoothnessReading::plain
                           : SmoothnessReading::joint;
  adaptivity.start_degree = parameters.integer(section, "Start degree");
  if (adaptivity.start_degree == 0)
    adaptivity.start_degree = own_start_degree(adaptivity.method);
  parameters.set(section, "Start degree", std::to_string(adaptivity.start_degree));
  adaptivity.maximum_degree = parameters.integer(section, "Maximum degree");
  adaptivity.hap_threshold = parameters.number(section, "hap threshold");
  adaptivity.hpa1_bisected = parameters.number(section, "hpa1 bisected fraction");
  adaptivity.hpa1_raised = parameters.number(section, "hpa1 raised fraction");
  adaptivity.hpa2_marked = parameters.number(section, "hpa2 marked fraction");
  adaptivity.hpa2_decay = parameters.number(section, "hpa2 decay threshold");
  adaptivity.hpa3_threshold = parameters.number(section, "hpa3 threshold");
  adaptivity.hpa3_decay = parameters.number(section, "hpa3 decay threshold");
  adaptivity.maximum_steps = parameters.integer(section, "Maximum steps");
  adaptivity.maximum_unknowns = parameters.integer(section, "Maximum unknowns");
  adaptivity.maximum_seconds = parameters.number(section, "Maximum seconds");
  adaptivity.tolerance = parameters.number(section, "Tolerance");

  if (adaptivity.start_degree > adaptivity.maximum_degree)
    parameters.reject(section, "Start degree",
                      "exceeds Maximum degree = " + std::to_string(adaptivity.maximum_degree) +
                          "; lower the one or raise the other");
  if (adaptivity.hpa1_bisected + adaptivity.hpa1_raised > 1 + 1e-12)
    parameters.reject(section, "hpa1 raised fraction",
                      "makes more than all cells with hpa1 bisected fraction = " +
                          parameters.text(section, "hpa1 bisected fraction") +
                          "; let the two sum to at most 1");
  return adaptivity;
}

SolverSettings read_solver(const Parameters &parameters)
{
  SolverSettings solver;
  solver.qp_solver =
      parameters.text("Solver", "QP solver") == "mprgp" ? QpSolver::mprgp : QpSolver::active_set;
  solver.qp_warm_start = parameters.boolean("Solver", "QP warm start");
  solver.qp_tolerance = parameters.number("Solver", "QP tolerance");
  solver.qp_maximum_multiplications = parameters.integer("Solver", "QP maximum multiplications");
  solver.diagonal_scaling = parameters.boolean("Solver", "Diagonal scaling");
  solver.multiplier_offset = parameters.integer("Solver", "Multiplier degree offset");
  solver.condition_number = parameters.boolean("Solver", "Condition number");
  return solver;
}

OutputSettings read_output(const Parameters &parameters)
{
  OutputSettings output;
  output.vtu = parameters.boolean("Output", "VTU");
  output.mesh_picture = parameters.boolean("Output", "Mesh picture");
  output.contact = parameters.boolean("Output", "Contact tables");
  output.reference = parameters.boolean("Output", "Reference solution");
  return output;
}
} // namespace

// ---------------------------------------------------------------- the interface

template <int dim>
bool BoundaryCondition<dim>::has_displacement() const
{
  return std::any_of(displacement.begin(), displacement.end(),
                     [](const Expression &e) { return e != nullptr; });
}

template <int dim>
bool BoundaryCondition<dim>::has_traction() const
{
  return std::any_of(traction.begin(), traction.end(),
                     [](const Expression &e) { return e != nullptr; });
}

template <int dim>
double Scene<dim>::coercivity() const
{
  double least = std::numeric_limits<double>::max();
  for (const Material &material : materials)
    least = std::min(least, material.coercivity(dim));
  return least;
}

template <int dim>
double Scene<dim>::largest_mu() const
{
  double largest_mu = 0;
  for (const Material &material : materials)
    largest_mu = std::max(largest_mu, material.mu());
  return largest_mu;
}

template <int dim>
bool Scene<dim>::has_known_solution() const
{
  return exact_solution || !reference_solution.empty();
}

template <int dim>
bool Scene<dim>::has_body_force() const
{
  return std::any_of(body_force.begin(), body_force.end(),
                     [](const Expression &e) { return e != nullptr; });
}

template <int dim>
bool Scene<dim>::has_contact() const
{
  return std::any_of(boundaries.begin(), boundaries.end(),
                     [](const BoundaryCondition<dim> &b) { return b.bilateral_contact; });
}

template <int dim>
bool Scene<dim>::has_friction() const
{
  return std::any_of(boundaries.begin(), boundaries.end(),
                     [](const BoundaryCondition<dim> &b)
                     { return b.bilateral_contact && b.friction_bound != nullptr; });
}

template <int dim>
Scene<dim> Scene<dim>::read(const std::string &file,
                            const std::vector<std::pair<std::string, std::string>> &overrides,
                            const SceneUse use)
{
  Parameters parameters(scene_entries(dim), file);
  parameters.read(overrides);
  if (parameters.text("", "Dimension") != std::to_string(dim))
    parameters.reject("", "Dimension", "is not available yet; set Dimension = 2");
  Scene scene;
  scene.file = file;
  scene.name = std::filesystem::path(file).stem().string();
  if (parameters.text("", "Title").empty())
    parameters.set("", "Title", scene.name);
  scene.title = parameters.text("", "Title");
  scene.length_unit = parameters.text("Units", "Length");
  scene.stress_unit = parameters.text("Units", "Stress");

  scene.geometry = read_geometry<dim>(parameters);
  scene.materials = {read_material(parameters)};
  const ExpressionReader<dim> expressions(parameters, scene.materials[0]);
  const std::vector<Point<dim>> inside = sample_body(scene.geometry);
  scene.body_force = expressions.template read<dim>("Body force", "Expression", "0", inside);
  check_magnitude<dim>(parameters, "Body force", "Expression", scene.body_force, inside);
  scene.exact_solution = read_exact_solution(parameters, expressions, scene);
  for (types::boundary_id b = 0; b < GeometryInfo<dim>::faces_per_cell; ++b)
    scene.boundaries.push_back(read_boundary(parameters, expressions, scene, b));
  check_corners(parameters, scene);
  scene.free_translation = hpvi::free_translation(scene);
  check_exact_solution(parameters, scene);
  scene.reference_solution = parameters.text("Error", "Reference solution");
  if (!scene.reference_solution.empty() && !std::ifstream(scene.reference_solution))
    parameters.reject("Error", "Reference solution",
                      "cannot be read; make the file by a run with Output/Reference solution = "
                      "true, or leave the entry empty");

  scene.adaptivity = read_adaptivity(parameters);
  check_first_step(parameters, scene);
  scene.solver = read_solver(parameters);
  check_multiplier_degree(parameters, scene, use);
  scene.output = read_output(parameters);
  scene.effective_parameters = parameters.print(false);
  return scene;
}

template <int dim>
std::string Scene<dim>::default_parameters()
{
  return Parameters(scene_entries(dim), "").print(true);
}

template struct BoundaryCondition<2>;
template struct Scene<2>;
} // namespace hpvi
