// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/scene/scene_reader.h>

#include <hpvi/base/text.h>
#include <hpvi/input/expressions.h>
#include <hpvi/input/parameters.h>
#include <hpvi/input/scene_entries.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>

namespace hpvi
{
using namespace dealii;

namespace
{
/** The enumerator whose name is the value of an entry. */
template <class Enum>
Enum read_choice(const Parameters &parameters, const std::string &section, const std::string &name,
                 const std::vector<std::string> &names)
{
  const auto found = std::find(names.begin(), names.end(), parameters.text(section, name));
  return static_cast<Enum>(found - names.begin());
}

/** Takes the value of an entry, for for_each_value(). */
struct ReadValue
{
  const Parameters &parameters;

  void operator()(const char *section, const char *name, double &value) const
  {
    value = parameters.number(section, name);
  }

  void operator()(const char *section, const char *name, bool &value) const
  {
    value = parameters.boolean(section, name);
  }

  template <class Integer>
  void operator()(const char *section, const char *name, Integer &value) const
  {
    value = parameters.integer(section, name);
  }
};

Corners<2> read_corners(const Parameters &parameters)
{
  const std::vector<Point<2>> around = parameters.points<2>("Geometry", "Corners");
  if (around.size() != 4)
    parameters.reject("Geometry", "Corners",
                      "does not give four corners; a quadrilateral needs \"x, y; x, y; x, y; "
                      "x, y\", counterclockwise from the bottom left");
  return quadrilateral_corners({{around[0], around[1], around[2], around[3]}});
}

/** The shape that only the plane has. */
void read_quadrilateral(const Parameters &parameters, Geometry<2> &geometry)
{
  geometry.shape = read_choice<Shape>(parameters, "Geometry", "Shape", shape_names);
  if (geometry.shape == Shape::quadrilateral)
    geometry.corners = read_corners(parameters);
  else if (!parameters.text("Geometry", "Corners").empty())
    parameters.reject("Geometry", "Corners",
                      "has no meaning for a box; set Shape = quadrilateral or remove it");
}

template <int dim>
void read_geometry(const Parameters &parameters, Geometry<dim> &geometry)
{
  geometry.corners = box_corners(parameters.points<dim>("Geometry", "Lower corner")[0],
                                 parameters.points<dim>("Geometry", "Upper corner")[0]);
  if constexpr (dim == 2)
    read_quadrilateral(parameters, geometry);
  const std::vector<int> subdivisions = Utilities::string_to_int(
      Utilities::split_string_list(parameters.text("Geometry", "Subdivisions"), ','));
  std::copy(subdivisions.begin(), subdivisions.end(), geometry.subdivisions.begin());
  geometry.graded_towards = parameters.points<dim>("Geometry", "Graded towards");
}

template <int dim>
Material read_material(const Parameters &parameters)
{
  Material material{parameters.number("Material", "Young's modulus"),
                    parameters.number("Material", "Poisson's ratio")};
  if (dim == 2)
    material.plane = read_choice<PlaneModel>(parameters, "Material", "Plane", plane_names);
  return material;
}

/** What expressions may use; the time @p t in a load history. */
std::map<std::string, double> constants_of(const Material &material, const std::optional<double> t)
{
  std::map<std::string, double> constants = {
      {"pi", numbers::PI}, {"E", material.young}, {"nu", material.poisson}, {"mu", material.mu()}};
  if (t)
    constants.emplace("t", *t);
  return constants;
}

// ---------------------------------------------------------------- the exact solution

/** The value of a friction bound that is the same all along @p side; NaN if it is not. */
double constant_friction_bound(const Parameters &parameters, const ExpressionReader<2> &expressions,
                               const std::string &boundary, const Side<2> &side)
{
  const std::vector<Point<2>> points = side.sample();
  const auto bound = expressions.read_bound("Boundary " + boundary, "Friction bound", points,
                                            "Tresca's bound needs g >= 0");
  if (bound == nullptr || parameters.text("Boundary " + boundary, "Contact") == "none")
    return 0.;
  const double value = bound->value(points[0]);
  const bool constant =
      std::all_of(points.begin(), points.end(),
                  [&](const Point<2> &point) { return bound->value(point) == value; });
  return constant ? value : std::numeric_limits<double>::quiet_NaN();
}

/** Hertz's contact and partial slip, null for other names; both ask for a kind of contact. */
std::shared_ptr<const ExactSolution<2>> read_elliptic_solution(const Parameters &parameters,
                                                               const Material &material,
                                                               const std::string &solution,
                                                               const std::string &boundary)
{
  const std::string section = "Exact solution",
                    contact = solution == "hertz" ? "unilateral" : "tangential";
  if (solution != "hertz" && solution != "partial-slip")
    return nullptr;
  if (parameters.text("Boundary " + boundary, "Contact") != contact)
    parameters.reject("Boundary " + boundary, "Contact",
                      "is not that of Exact solution/Solution = " + solution +
                          "; set Contact = " + contact);
  const double centre = parameters.number(section, "Transition"),
               half_width = parameters.number(section, "Length"),
               largest = parameters.number(section, "Pressure"),
               stick_length = parameters.number(section, "Stick length");
  if (solution == "hertz")
    return std::make_shared<Hertz>(material, largest, half_width, centre);
  if (!(stick_length < half_width))
    parameters.reject(section, "Stick length",
                      "leaves no slip within Length = " + parameters.text(section, "Length") +
                          "; give less");
  return std::make_shared<PartialSlip>(material, largest, half_width, stick_length, centre);
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
  const Side<2> side = sides_of(scene.geometry)[bottom];
  if (side.ends[0][1] != 0. || side.ends[1][1] != 0. || side.normal[1] > 0)
    parameters.reject(section, "Solution",
                      "slides along y = 0 below the body; put the bottom edge there");
  if (const auto elliptic =
          read_elliptic_solution(parameters, scene.materials[0], solution, boundary_names[bottom]))
    return elliptic;
  const double friction_bound =
      constant_friction_bound(parameters, expressions, boundary_names[bottom], side);
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

// ---------------------------------------------------------------- the rest

/** What `exact` stands for on @p boundary; nothing in space, where no closed form is offered. */
template <int dim>
std::array<typename ExpressionReader<dim>::ExactField, 2>
exact_displacement_and_traction(const Scene<dim> &scene, const unsigned int boundary)
{
  if constexpr (dim == 2)
    if (scene.exact_solution != nullptr)
      return {{[&scene](const unsigned int c)
               { return std::make_shared<ExactDisplacement<2>>(scene.exact_solution, c); },
               [&scene, boundary](const unsigned int c)
               {
                 return std::make_shared<ExactTraction<2>>(
                     scene.exact_solution, scene.materials[0],
                     sides_of(scene.geometry)[boundary].normal, c);
               }}};
  const auto none = [](const unsigned int) { return nullptr; };
  (void)scene, (void)boundary;
  return {{none, none}};
}

template <int dim>
void read_boundary(const Parameters &parameters, const ExpressionReader<dim> &expressions,
                   const Scene<dim> &scene, BoundaryCondition<dim> &boundary)
{
  const std::vector<Point<dim>> points = sides_of(scene.geometry)[boundary.id].sample();
  const auto [exact_displacement, exact_traction] =
      exact_displacement_and_traction(scene, boundary.id);

  const std::string section = "Boundary " + boundary.name;
  boundary.displacement =
      expressions.template read<dim>(section, "Displacement", "free", points, exact_displacement);
  boundary.traction =
      expressions.template read<dim>(section, "Traction", "0", points, exact_traction);
  boundary.contact = read_choice<Contact>(parameters, section, "Contact", contact_names);
  boundary.gap = expressions.template read<1>(section, "Gap", "0", points)[0];
  boundary.friction.bound =
      expressions.read_bound(section, "Friction bound", points, "Tresca's bound needs g >= 0");
  boundary.friction.coefficient = expressions.read_bound(section, "Friction coefficient", points,
                                                         "Coulomb's coefficient needs mu_f >= 0");
  // Even a zero is one too many.
  if (!boundary.is_unilateral() && !parameters.text(section, "Gap").empty())
    parameters.reject(section, "Gap", gap_needs_contact);
  if (!boundary.has_contact() && !parameters.text(section, "Friction bound").empty())
    parameters.reject(section, "Friction bound", friction_needs_contact);
  if (!boundary.has_contact() && !parameters.text(section, "Friction coefficient").empty())
    parameters.reject(section, "Friction coefficient", friction_needs_contact);
}

template <int dim>
void read_method(const Parameters &parameters, Scene<dim> &scene)
{
  for_each_value(scene, ReadValue{parameters});
  Adaptivity &adaptivity = scene.adaptivity;
  adaptivity.method = read_choice<Method>(parameters, "Adaptivity", "Method", method_names);
  adaptivity.indicator =
      read_choice<Indicator>(parameters, "Adaptivity", "Indicator", indicator_names);
  adaptivity.tolerance_on =
      read_choice<Indicator>(parameters, "Adaptivity", "Tolerance on", indicator_names);
  adaptivity.reading =
      read_choice<SmoothnessReading>(parameters, "Adaptivity", "Smoothness reading", reading_names);
  scene.output.steps = read_choice<OutputSteps>(parameters, "Output", "Steps", output_steps_names);
  scene.solver.path = read_choice<SolutionPath>(parameters, "Solver", "Path", path_names);
  scene.solver.linear = read_choice<LinearMethod>(parameters, "Solver", "Linear", linear_names);
  scene.solver.qp_solver =
      read_choice<QpSolver>(parameters, "Solver", "QP solver", qp_solver_names);
  scene.solver.coulomb_method =
      read_choice<CoulombMethod>(parameters, "Solver", "Coulomb solver", coulomb_method_names);
  scene.solver.normal_contact =
      read_choice<NormalContact>(parameters, "Solver", "Normal contact", normal_contact_names);
}
bool is_in_space(const Parameters &parameters)
{
  return parameters.text("", "Dimension") == "3";
}

/** Does the scene leave it to the program when to stop, and is its error the only thing to look at? */
bool names_no_end(const Parameters &parameters)
{
  const std::vector<std::string> limits = {"Maximum steps", "Maximum unknowns", "Maximum seconds"};
  return std::none_of(limits.begin(), limits.end(),
                      [&](const std::string &limit)
                      { return parameters.is_named("Adaptivity", limit); }) &&
         parameters.text("Loading", "Steps").empty() &&
         (is_in_space(parameters) || parameters.text("Exact solution", "Solution") == "none") &&
         parameters.text("Error", "Reference solution").empty() &&
         !parameters.boolean("Output", "Reference solution");
}

/** The number for Adaptivity/Tolerance = automatic; returns whether it is the default. */
bool choose_tolerance(Parameters &parameters, const SceneUse use)
{
  if (parameters.text("Adaptivity", "Tolerance") != "automatic")
    return false;
  const bool is_default = use == SceneUse::solve && names_no_end(parameters);
  parameters.set("Adaptivity", "Tolerance", is_default ? default_tolerance : "0");
  // No bound is asked for where there can be none.
  if (is_default && !parameters.is_named("Adaptivity", "Tolerance on") &&
      (is_in_space(parameters) || parameters.text("Solver", "Path") == "primal"))
    parameters.set("Adaptivity", "Tolerance on", "residual");
  return is_default;
}

/** What the file leaves to the program, which scene.prm shall say. */
void complete(Parameters &parameters, const std::string &name)
{
  if (parameters.text("", "Title").empty())
    parameters.set("", "Title", storable(name));
  if (parameters.integer("Adaptivity", "Start degree") == 0)
    parameters.set("Adaptivity", "Start degree",
                   std::to_string(own_start_degree(
                       read_choice<Method>(parameters, "Adaptivity", "Method", method_names))));
}

/** What `automatic` is for the scene that was read, in it and for scene.prm. */
template <int dim>
void settle_normal_contact(Parameters &parameters, Scene<dim> &scene)
{
  scene.solver.normal_contact = scene.normal_contact();
  parameters.set("Solver", "Normal contact",
                 normal_contact_names[static_cast<unsigned int>(scene.solver.normal_contact)]);
}

/** All but the load history; @p t is its time, if there is one. */
template <int dim>
Scene<dim> read_problem(const std::shared_ptr<const Parameters> &parameters,
                        const std::string &name, const std::optional<double> t)
{
  Scene<dim> scene;
  scene.parameters = parameters;
  scene.name = name;
  scene.title = parameters->text("", "Title");
  scene.length_unit = parameters->text("Units", "Length");
  scene.stress_unit = parameters->text("Units", "Stress");

  read_method(*parameters, scene);

  // Expressions are tried on the body and know its material: both must be sound.
  read_geometry(*parameters, scene.geometry);
  scene.materials = {read_material<dim>(*parameters)};
  scene.check_body();
  const ExpressionReader<dim> expressions(*parameters, constants_of(scene.materials[0], t));
  scene.body_force =
      expressions.template read<dim>("Body force", "Expression", "0", sample_body(scene.geometry));
  if constexpr (dim == 2)
    scene.exact_solution = read_exact_solution(*parameters, expressions, scene);
  for (BoundaryCondition<dim> &boundary : scene.boundaries)
    read_boundary(*parameters, expressions, scene, boundary);
  scene.reference_solution = parameters->text("Error", "Reference solution");
  return scene;
}

/** A history has the functions of every load step, which are those of one problem with t frozen. */
template <int dim>
Loading<dim> read_loading(const std::shared_ptr<const Parameters> &parameters,
                          const std::string &name)
{
  Loading<dim> loading;
  loading.adapt =
      read_choice<LoadAdaptivity>(*parameters, "Loading", "Adapt", load_adaptivity_names);
  if (!parameters->text("Loading", "Steps").empty())
  {
    loading.steps = parameters->integer("Loading", "Steps");
    loading.at = [=](const double t) { return read_problem<dim>(parameters, name, t); };
  }
  else if (loading.adapt != LoadAdaptivity::every_step)
    parameters->reject("Loading", "Adapt", "has no load step to mean; set Steps or remove it");
  return loading;
}
} // namespace

template <int dim>
Scene<dim> read_scene(const std::string &file,
                      const std::vector<std::pair<std::string, std::string>> &overrides,
                      const SceneUse use)
{
  const auto parameters = std::make_shared<Parameters>(scene_entries(dim), scene_hints(dim), file);
  parameters->read(overrides);
  if (parameters->text("", "Dimension") != std::to_string(dim))
    parameters->reject("", "Dimension",
                       "is not that of the program; set Dimension = " + std::to_string(dim));
  const std::string name = std::filesystem::path(file).stem().string();
  complete(*parameters, name);
  const bool is_default_tolerance = choose_tolerance(*parameters, use);
  const Loading<dim> loading = read_loading<dim>(parameters, name);
  Scene<dim> scene =
      loading.at ? loading.at(loading.time(1)) : read_problem<dim>(parameters, name, std::nullopt);
  settle_normal_contact(*parameters, scene);
  scene.loading = loading;
  scene.adaptivity.is_default_tolerance = is_default_tolerance;
  scene.check(use);
  return scene;
}

int scene_dimension(const std::string &file,
                    const std::vector<std::pair<std::string, std::string>> &overrides)
{
  std::string dimension = "2";
  for (const Assignment &assignment : read_parameter_file(file))
    if (assignment.section.empty() && assignment.name == "Dimension")
      dimension = assignment.value;
  for (const auto &[entry, value] : overrides)
    if (single_spaced(entry) == "Dimension")
      dimension = Utilities::trim(value);
  return dimension == "3" ? 3 : 2;
}

std::string default_parameters()
{
  return Parameters(scene_entries(2), {}, "").print(true);
}

template Scene<2> read_scene(const std::string &,
                             const std::vector<std::pair<std::string, std::string>> &, SceneUse);
template Scene<3> read_scene(const std::string &,
                             const std::vector<std::pair<std::string, std::string>> &, SceneUse);
} // namespace hpvi
