// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/reader/checks/checks.h>
#include <hpvi/reader/scene_reader.h>
#include <hpvi/reader/shapes/mesh_from_file.h>
#include <hpvi/reader/shapes/shape.h>

#include <hpvi/base/display_name.h>
#include <hpvi/base/text.h>
#include <hpvi/reader/automatic_pairs.h>
#include <hpvi/reader/bodies_reader.h>
#include <hpvi/reader/body_reader.h>
#include <hpvi/reader/boundary_reader.h>
#include <hpvi/reader/closed_forms/closed_form.h>
#include <hpvi/reader/closed_forms/plane_field.h>
#include <hpvi/reader/input/expressions.h>
#include <hpvi/reader/input/parameters.h>
#include <hpvi/reader/pretension_reader.h>
#include <hpvi/reader/probe_reader.h>
#include <hpvi/reader/scene_aliases.h>
#include <hpvi/reader/scene_entries.h>
#include <hpvi/scene/boundary_parts.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <type_traits>

namespace hpvi
{
using namespace dealii;

namespace
{
/** The section that says it: a named material inherits what it leaves out. */
std::string section_with(const Parameters &parameters, const Material &material,
                         const std::string &entry)
{
  const std::string own = section_of_material(material.name);
  return parameters.text(own, entry).empty() ? section_of_material("") : own;
}

/** Three components, or four, of which the last one is across the plane; in space six. */
std::array<Expression<3>, 6> read_components(const Parameters &parameters,
                                             const ExpressionReader<3> &expressions,
                                             const Material &material,
                                             const std::vector<Point<3>> &points)
{
  const std::string entry = "Initial strain";
  return expressions.read<6>(section_with(parameters, material, entry), entry, "0", points);
}

std::array<Expression<2>, 4> read_components(const Parameters &parameters,
                                             const ExpressionReader<2> &expressions,
                                             const Material &material,
                                             const std::vector<Point<2>> &points)
{
  const std::string entry = "Initial strain", section = section_with(parameters, material, entry),
                    value = parameters.text(section, entry);
  if (std::count(value.begin(), value.end(), ';') != 3)
  {
    const auto in_plane = expressions.read<3>(section, entry, "0", points);
    return {{in_plane[0], in_plane[1], in_plane[2], nullptr}};
  }
  const auto all = expressions.read<4>(section, entry, "0", points);
  if (all[3] && material.plane == PlaneModel::stress)
    parameters.reject(section, entry,
                      "has a fourth component, and plane stress lets the body become thicker as it "
                      "likes; give e1; e2; e12");
  return all;
}

/** Takes initial strains and the temperature of all materials; @p t is the time in a load history. */
template <int dim>
void read_initial_strains(const Parameters &parameters, const std::optional<double> t,
                          Scene<dim> &scene)
{
  const std::string section = "Temperature", entry = "Expression";
  const std::vector<Point<dim>> points = sample_body(scene.geometry);
  bool expands = false;
  for (const Material &material : scene.materials)
  {
    const ExpressionReader<dim> expressions(parameters, constants_of(material, t),
                                            remark_on_constants(material));
    InitialStrain<dim> strain;
    strain.components = read_components(parameters, expressions, material, points);
    strain.expansion = parameters.number(section_with(parameters, material, "Thermal expansion"),
                                         "Thermal expansion");
    strain.temperature = expressions.template read<1>(section, entry, "0", points)[0];
    expands = expands || strain.expansion != 0.;
    scene.initial_strains.push_back(strain);
  }
  if (!parameters.text(section, entry).empty() && !expands)
    parameters.reject("Temperature", "Expression",
                      "strains nothing; give Material/Thermal expansion or remove it");
  if constexpr (dim == 2)
    for (unsigned int k = 0; k < scene.pretensions.size(); ++k)
      set_shortening(scene, k, 0.);
  if (!scene.has_initial_strain())
    scene.initial_strains.clear();
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
    if (parameters.has(section, name)) // several bodies have each their own
      value = parameters.integer(section, name);
  }
};

// ---------------------------------------------------------------- the exact solution

/** The value of a friction bound that is the same all along @p side; NaN if it is not. */
template <int dim>
double constant_friction_bound(const Parameters &parameters,
                               const ExpressionReader<dim> &expressions,
                               const std::string &boundary, const Side<dim> &side)
{
  const std::vector<Point<dim>> points = side.sample();
  const auto bound = expressions.read_friction(boundary, points).bound;
  if (bound == nullptr || parameters.text(boundary, "Contact") == "none")
    return 0.;
  const double value = bound->value(points[0]);
  const bool constant =
      std::all_of(points.begin(), points.end(),
                  [&](const Point<dim> &point) { return bound->value(point) == value; });
  return constant ? value : std::numeric_limits<double>::quiet_NaN();
}

/** Every one of them slides along a side of the body, on y = 0; in space it is plane strain. */
template <int dim>
std::shared_ptr<const ExactSolution<dim>>
read_exact_solution(const Parameters &parameters, const ExpressionReader<dim> &expressions,
                    const Scene<dim> &scene)
{
  const std::string solution = parameters.text("Exact solution", "Solution");
  const auto form = std::find_if(closed_forms().begin(), closed_forms().end(),
                                 [&](const ClosedForm &one) { return one.name == solution; });
  if (form == closed_forms().end())
    return nullptr;
  const auto is_below = [](const Side<dim> &side)
  {
    const std::vector<Point<dim>> points = side.sample();
    return std::all_of(points.begin(), points.end(),
                       [&](const Point<dim> &x) { return x[1] == 0. && side.normal(x)[1] <= 0; });
  };
  const std::vector<Side<dim>> sides = sides_of(scene.geometry);
  const auto side = std::find_if(sides.begin(), sides.end(), is_below);
  if (side == sides.end())
    parameters.reject("Exact solution", "Solution",
                      "slides along y = 0 below the body; put the bottom edge there");
  const std::string boundary = "Boundary " + scene.boundaries[side - sides.begin()].name;
  const auto bound = [&]()
  { return constant_friction_bound(parameters, expressions, boundary, *side); };
  const auto in_plane = form->read({parameters, scene.materials[0], boundary, bound});
  if constexpr (dim == 2)
    return in_plane;
  else
    return std::make_shared<const PlaneField>(in_plane);
}

// ---------------------------------------------------------------- the rest

template <int dim>
void read_method(const Parameters &parameters, Scene<dim> &scene)
{
  for_each_value(scene, ReadValue{parameters});
  const auto choose = [&](auto &value, const char *section, const char *name, const auto &names)
  { value = read_choice<std::decay_t<decltype(value)>>(parameters, section, name, names); };
  choose(scene.adaptivity.method, "Adaptivity", "Method", method_names);
  choose(scene.adaptivity.indicator, "Adaptivity", "Indicator", indicator_names);
  const std::string on = parameters.text("Adaptivity", "Tolerance on");
  if (std::find(indicator_names.begin(), indicator_names.end(), on) != indicator_names.end())
    choose(scene.adaptivity.tolerance_on, "Adaptivity", "Tolerance on", indicator_names);
  else
    scene.adaptivity.tolerance_column = on;
  choose(scene.adaptivity.reading, "Adaptivity", "Smoothness reading", reading_names);
  if (parameters.has("Error", "Bound"))
  {
    const std::string bound = parameters.text("Error", "Bound");
    scene.error_bound = bound != "false";
    scene.error_bound_last = bound == "last step";
  }
  choose(scene.output.steps, "Output", "Steps", output_steps_names);
  choose(scene.solver.path, "Solver", "Path", path_names);
  choose(scene.solver.linear, "Solver", "Linear", linear_names);
  if constexpr (dim == 2)
  {
    scene.localised_coupling = parameters.text("Error", "Coupling") == "localised";
    choose(scene.solver.qp_solver, "Solver", "QP solver", qp_solver_names);
    choose(scene.solver.coulomb_method, "Solver", "Coulomb solver", coulomb_method_names);
  }
  choose(scene.solver.normal_contact, "Solver", "Normal contact", normal_contact_names);
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
         parameters.text("Exact solution", "Solution") == "none" &&
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
  if (parameters.has("Error", "Bound") && parameters.text("Error", "Bound") == "last step" &&
      !parameters.is_named("Adaptivity", "Indicator"))
    parameters.set("Adaptivity", "Indicator", "residual"); // which all steps have
  if (parameters.text("Material", "Elasticity") == "isotropic")
    return;
  for (const char *const entry : {"Young's modulus", "Poisson's ratio"})
    if (!parameters.is_named("Material", entry))
      parameters.set("Material", entry, "");
}

/** What `automatic` is for the scene that was read, in it and for scene.prm. */
template <int dim>
void settle_normal_contact(Parameters &parameters, Scene<dim> &scene)
{
  scene.solver.normal_contact = scene.normal_contact();
  parameters.set("Solver", "Normal contact",
                 normal_contact_names[static_cast<unsigned int>(scene.solver.normal_contact)]);
}

/**
 * Would the dense algebra of the first mesh take longer than what the primal path takes? Of one
 * core: `3e-10 s m^3` for m multipliers, and twelve times, for N unknowns,
 * `1e-6 s N + 3e-9 s N^3/2`. `./run space` measures all three, doc/space.md has the chart.
 */
bool primal_path_pays(const Scene<2> &scene)
{
  const double p = scene.adaptivity.start_degree;
  const std::array<unsigned int, 2> cells{{scene.geometry.n_cells(0), scene.geometry.n_cells(1)}};
  const double unknowns = 2 * (1 + p * cells[0]) * (1 + p * cells[1]);
  const std::vector<Side<2>> sides = sides_of(scene);
  double multipliers = 0;
  for (const auto &boundary : scene.boundaries)
    if (boundary.has_contact() && boundary.friction)
      multipliers += (p - 1) * (scene.geometry.has_mesh() ? sides[boundary.id].pieces.size()
                                                          : cells[1 - sides[boundary.id].axis]);
  return 3e-10 * std::pow(multipliers, 3) > 12 * (1e-6 * unknowns + 3e-9 * std::pow(unknowns, 1.5));
}

/** What `auto` is for a scene that passed its check(): primal where that pays and offers all that is asked for, the bound too. */
void settle_path(Scene<2> &scene)
{
  const Adaptivity &limits = scene.adaptivity;
  if (scene.solver.path == SolutionPath::automatic &&
      !scene.has_unilateral_contact() && // solved by nodes or multipliers, as the scene says
      !scene.has_coulomb_friction() &&   // by Newton's method on the cones
      !(limits.tolerance > 0 && limits.tolerance_on == Indicator::bound) &&
      primal_path_pays(scene) && !objection_to_primal_path(scene) && scene.free_motions().empty())
    scene.solver.path = SolutionPath::primal;
}

/** Of each material, its weight among them. */
template <int dim>
void read_body_force(const Parameters &parameters, const std::optional<double> t, Scene<dim> &scene)
{
  const std::vector<Point<dim>> points = sample_body(scene.geometry);
  const std::string section = "Body force";
  bool is_heavy = false;
  for (const Material &material : scene.materials)
  {
    const ExpressionReader<dim> expressions(parameters, constants_of(material, t),
                                            remark_on_constants(material));
    Load<dim> force = expressions.template read<dim>(section, "Expression", "0", points);
    const Load<dim> gravity = expressions.template read<dim>(section, "Gravity", "0", points);
    for (unsigned int c = 0; c < dim; ++c)
      force[c] = sum<dim>(force[c], material.density, gravity[c]);
    is_heavy = is_heavy || material.density > 0;
    scene.body_force_of_material.push_back(force);
  }
  if (!parameters.text(section, "Gravity").empty() && !is_heavy)
    parameters.reject("Body force", "Gravity",
                      "acts on nothing; give Material/Density or remove it");
  if (scene.materials.size() > 1)
    return;
  scene.body_force = scene.body_force_of_material.front();
  scene.body_force_of_material.clear();
}

/** Runs made a page and pictures of meshes once: files that ask for them are taken as they are. */
template <int dim>
void remark_on_pictures(const Parameters &parameters, Scene<dim> &scene)
{
  for (const std::string entry : {"Report", "Mesh picture"})
    if (parameters.has("Output", entry) && parameters.boolean("Output", entry))
      scene.remarks.push_back("Output/" + entry +
                              " has no effect any more: hpvi --report DIR makes a page of a run, "
                              "with its mesh");
}

/**
 * Where cells are no parallelograms, around an axis and under laws that know the pressure, the bound takes longer than the step: a file that does not name it has it
 * of the last step.
 */
void choose_bound(const Parameters &parameters, Scene<2> &scene)
{
  if (parameters.boolean("Error", "Bound on distorted cells"))
    scene.remarks.push_back("Error/Bound on distorted cells has no effect any more: cells of any "
                            "shape have a bound, by default in the last step");
  const bool names_indicator = parameters.is_named("Adaptivity", "Indicator");
  const bool is_of_file = scene.geometry.has_mesh() && scene.geometry.bodies.empty(),
             is_cheap = scene.geometry.has_affine_cells() && !is_of_file &&
                        !scene.has_coulomb_friction() && !scene.is_axisymmetric();
  if (parameters.is_named("Error", "Bound") || is_cheap ||
      (names_indicator && scene.adaptivity.indicator == Indicator::bound))
    return;
  scene.error_bound_last = true;
  if (!names_indicator)
    scene.adaptivity.indicator = Indicator::residual;
}

/** None by default but of one body of boxes. */
void choose_bound(const Parameters &parameters, Scene<3> &scene)
{
  if (!parameters.is_named("Error", "Bound"))
    scene.error_bound = !scene.geometry.has_mesh() && scene.geometry.bodies.empty();
}

/** All but the load history; @p t is its time, if there is one. */
template <int dim>
Scene<dim> read_problem(const std::shared_ptr<const Parameters> &parameters, const UserNames &names,
                        const std::string &name, const std::optional<double> t)
{
  Scene<dim> scene;
  scene.parameters = parameters;
  scene.file = parameters->file_name();
  scene.name = name;
  scene.title = parameters->text("", "Title");
  scene.length_unit = parameters->text("Units", "Length");
  scene.stress_unit = parameters->text("Units", "Stress");

  read_body(*parameters, names, scene);
  read_method(*parameters, scene);
  read_body_force(*parameters, t, scene);
  read_initial_strains(*parameters, t, scene);
  scene.exact_solution =
      read_exact_solution(*parameters,
                          ExpressionReader<dim>(*parameters, constants_of(scene.materials[0], t),
                                                remark_on_constants(scene.materials[0])),
                          scene);
  check_covered_sides(*parameters, scene);
  for (BoundaryCondition<dim> &boundary : scene.boundaries)
    if (boundary.pair)
      read_pair(*parameters, t, scene, boundary);
    else if (!boundary.name.empty()) // edges of a mesh in no group
      read_boundary(*parameters, t, scene, boundary);
  read_probes(*parameters, names.probes, scene);
  scene.reference_solution = parameters->text("Error", "Reference solution");
  remark_on_pictures(*parameters, scene);
  choose_bound(*parameters, scene);
  return scene;
}

/** A history has the functions of every load step, which are those of one problem with t frozen. */
template <int dim>
Loading<dim> read_loading(const std::shared_ptr<const Parameters> &parameters,
                          const UserNames &names, const std::string &name)
{
  Loading<dim> loading;
  loading.adapt =
      read_choice<LoadAdaptivity>(*parameters, "Loading", "Adapt", load_adaptivity_names);
  if (!parameters->text("Loading", "Steps").empty())
  {
    loading.steps = parameters->integer("Loading", "Steps");
    loading.at = [=](const double t) { return read_problem<dim>(parameters, names, name, t); };
  }
  else if (loading.adapt != LoadAdaptivity::every_step)
    parameters->reject("Loading", "Adapt", "has no load step to mean; set Steps or remove it");
  loading.maximum_cycles = parameters->integer("Loading", "Maximum cycles");
  if (const std::string share = parameters->text("Loading", "Until steady"); share.empty())
  {
    if (loading.maximum_cycles != 20)
      parameters->reject("Loading", "Maximum cycles",
                         "has no cycle to mean; set Until steady or remove it");
  }
  else if (loading.steps == 0)
    parameters->reject("Loading", "Until steady",
                       "has no load step to repeat; set Steps or remove it");
  else
    loading.until_steady = parameters->number("Loading", "Until steady");
  return loading;
}
} // namespace

namespace
{
/** Of the body first, for these say which others there may be. */
template <int dim>
UserNames names_in(const ParameterFile &file)
{
  const std::vector<std::string> bodies = body_names(file.assignments);
  SideNames sides;
  if (bodies.empty())
    sides = names_of_sides<dim>(file);
  for (const std::string &body : bodies)
  {
    const SideNames own = names_of_sides<dim>(file, "Body " + body);
    for (const std::string &side : own.sides)
      sides.sides.push_back(side.empty() ? "" : body + "." + side);
    for (const std::vector<std::string> &curves : {own.sides, own.interfaces})
      for (const std::string &curve : curves)
        if (own.is_from_file && !curve.empty())
          sides.interfaces.push_back(body + "." + curve);
  }
  UserNames names = user_names(file.assignments, sides.sides);
  if (dim == 3 && !names.pretensions.empty())
    throw InputError(display_name(file.name) + ": " + section_of_pretension(names.pretensions[0]) +
                     ": is offered in the plane alone; set Dimension = 2 or remove it");
  names.bodies = bodies;
  names.is_from_file = sides.is_from_file;
  names.interfaces = sides.interfaces;
  return names;
}
} // namespace

namespace
{
/** With the pairs that `Between = automatic` finds, as if the file named them; @p sections are these. */
template <int dim>
ParameterFile with_pairs(const ParameterFile &given, std::string &sections)
{
  ParameterFile file = given;
  const std::vector<std::string> pairs = automatic_pairs(given.assignments);
  if (pairs.empty() || body_names(given.assignments).empty())
    return file;
  file.assignments = without_pairs(given.assignments, pairs);
  const UserNames names = names_in<dim>(file);
  const auto parameters = std::make_shared<Parameters>(
      scene_entries(dim, names), scene_aliases(dim, names.sides, names.interfaces), file.name);
  parameters->read(file.assignments);
  Scene<dim> bodies;
  bodies.parameters = parameters;
  read_body(*parameters, names, bodies);
  file.assignments = with_pairs_found(given.assignments, pairs, bodies, sections);
  return file;
}
} // namespace

template <int dim>
Scene<dim> read_scene(const ParameterFile &given, const SceneUse use,
                      const unsigned int n_processes)
{
  std::string found_pairs;
  const ParameterFile written = with_pairs<dim>(given, found_pairs);
  const std::string &file = written.name;
  const UserNames names = names_in<dim>(written);
  const auto parameters = std::make_shared<Parameters>(
      scene_entries(dim, names), scene_aliases(dim, names.sides, names.interfaces), file);
  parameters->read(written.assignments);
  if (n_processes > 1 && use == SceneUse::solve && parameters->text("Solver", "Path") == "auto")
    parameters->read({{"Solver", "Path", "primal", display_name(file) + " (--set)"}});
  if (parameters->text("", "Dimension") != std::to_string(dim))
    parameters->reject("", "Dimension",
                       "is not that of the program; set Dimension = " + std::to_string(dim));
  const std::string name = file.empty() ? "scene" : std::filesystem::path(file).stem().string();
  complete(*parameters, name);
  std::vector<std::string> bodies{"Geometry"};
  for (const std::string &body : names.bodies)
    bodies.push_back("Body " + body);
  for (const std::string &section : bodies)
    if (parameters->has(section, "File") && !parameters->text(section, "File").empty())
      // scene.prm lies in another directory
      parameters->set(section, "File",
                      std::filesystem::absolute(beside(file, parameters->text(section, "File")))
                          .lexically_normal()
                          .string());
  const bool is_default_tolerance = choose_tolerance(*parameters, use);
  const Loading<dim> loading = read_loading<dim>(parameters, names, name);
  Scene<dim> scene = loading.at ? loading.at(loading.time(1))
                                : read_problem<dim>(parameters, names, name, std::nullopt);
  settle_normal_contact(*parameters, scene);
  if (!scene.error_bound)
    parameters->set("Error", "Bound", "false");
  else if (scene.error_bound_last)
    parameters->set("Error", "Bound", "last step");
  if (scene.error_bound_last && !parameters->is_named("Adaptivity", "Indicator"))
    parameters->set("Adaptivity", "Indicator", "residual");
  scene.loading = loading;
  if (!found_pairs.empty()) // to be copied from what is printed
    scene.remarks.push_back("Between = automatic stands for\n" + found_pairs);
  scene.adaptivity.is_default_tolerance = is_default_tolerance;
  check(scene, use);
  if constexpr (dim == 2)
    settle_path(scene);
  return scene;
}

int scene_dimension(const ParameterFile &file)
{
  std::string dimension = "2";
  for (const Assignment &assignment : file.assignments)
    if (assignment.section.empty() && assignment.name == "Dimension")
      dimension = assignment.value;
  return dimension == "3" ? 3 : 2;
}

std::string default_parameters()
{
  std::vector<Entry> entries = scene_entries(2, {{"NAME"}, {"NAME"}});
  for (const auto &some : {curve_entries("NAME"),                         // of a file alone
                           body_entries(2, "NAME"), pair_entries("NAME"), // of several bodies
                           pretension_entries("NAME"), probe_entries(2, "NAME")})
    entries.insert(entries.end(), some.begin(), some.end());
  return Parameters(entries, {}, "").print(true);
}

template Scene<2> read_scene(const ParameterFile &, SceneUse, unsigned int);
template Scene<3> read_scene(const ParameterFile &, SceneUse, unsigned int);
} // namespace hpvi
