// SPDX-License-Identifier: LGPL-2.1-or-later

#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/reader/checks/checks.h>
#include <hpvi/reader/checks/rejection.h>
#include <hpvi/reader/input/parameters.h>
#include <hpvi/reader/scene_entries.h>
#include <hpvi/reader/shapes/shape.h>
#include <hpvi/scene/boundary_parts.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace hpvi
{
namespace
{
/** Compares what code may have set with what a file may say; a switch may be either. */
template <int dim>
struct CheckValue
{
  const Scene<dim> &scene;

  void operator()(const std::string &, const std::string &, const bool) const
  {
  }

  void operator()(const std::string &section, const std::string &name, const double value) const
  {
    check_value(scene, section, name, text(value));
  }

  template <class Integer>
  void operator()(const std::string &section, const std::string &name, const Integer value) const
  {
    check_value(scene, section, name, std::to_string(value));
  }
};

/** Of all bodies. */
template <int dim>
unsigned int lowest_degree(const Scene<dim> &scene)
{
  unsigned int result = scene.start_degree_of(0);
  for (unsigned int body = 1; body < scene.geometry.bodies.size(); ++body)
    result = std::min(result, scene.start_degree_of(body));
  return result;
}

template <int dim>
void check_adaptivity(const Scene<dim> &scene)
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
  for (unsigned int body = 0; body < adaptivity.degrees_of_bodies.size(); ++body)
    if (const unsigned int own = adaptivity.degrees_of_bodies[body];
        own > adaptivity.maximum_degree)
      reject(scene, "Body " + scene.geometry.bodies[body].name, "Start degree",
             "exceeds Maximum degree = " + std::to_string(adaptivity.maximum_degree) +
                 "; lower the one or raise the other",
             std::to_string(own));
  if (scene.error_bound && scene.error_bound_last && adaptivity.indicator == Indicator::bound)
    reject(scene, "Adaptivity", "Indicator",
           "marks cells by the bound of each step, and Error/Bound = last step has it for the last "
           "one; set residual, or Bound = true",
           "bound");
  if (adaptivity.hpa1_bisected + adaptivity.hpa1_raised > 1 + 1e-12)
    reject(scene, "Adaptivity", "hpa1 raised fraction",
           "makes more than all cells with hpa1 bisected fraction = " +
               (scene.parameters ? scene.parameters->text("Adaptivity", "hpa1 bisected fraction")
                                 : text(adaptivity.hpa1_bisected)) +
               "; let the two sum to at most 1",
           text(adaptivity.hpa1_raised));
}

/** Coulomb's bounds follow the pressure, which nodes would let turn negative between them. */
template <int dim>
void check_normal_contact(const Scene<dim> &scene)
{
  for (const BoundaryCondition<dim> &boundary : scene.boundaries)
    if (scene.solver.normal_contact == NormalContact::nodes && boundary.is_unilateral() &&
        boundary.friction.knows_pressure())
      reject(scene, "Solver", "Normal contact",
             "is not offered with the Friction coefficient of Boundary " + boundary.name +
                 "; set multiplier, or automatic",
             "nodes");
}

/** Only contact without friction that closes at nodes needs no multiplier. */
template <int dim>
bool needs_multiplier(const Scene<dim> &scene, const BoundaryCondition<dim> &boundary)
{
  return boundary.has_contact() && (!boundary.is_unilateral() || boundary.friction ||
                                    scene.normal_contact() == NormalContact::multiplier);
}

template <int dim>
void check_multiplier_degree(const Scene<dim> &scene, const SceneUse use)
{
  if (std::none_of(scene.boundaries.begin(), scene.boundaries.end(),
                   [&](const BoundaryCondition<dim> &b) { return needs_multiplier(scene, b); }))
    return;
  const int offset = scene.solver.multiplier_offset;
  // p + 1 multipliers on each edge meet p tangential displacements per edge, and one more at most.
  if (offset >= 0 && use == SceneUse::solve)
    reject(scene, "Solver", "Multiplier degree offset",
           "makes S singular: there are more multipliers than displacements on the "
           "contact boundary determine, the discrete inf-sup constant is 0; give -2, or "
           "measure the constant by hpvi --inf-sup",
           std::to_string(offset));
  const unsigned int lowest = lowest_degree(scene);
  if (static_cast<int>(lowest) + offset < 0)
    reject(scene, "Adaptivity", "Start degree",
           "is too low for contact: the multiplier has degree p - " + std::to_string(-offset) +
               "; give at least " + std::to_string(-offset) +
               " or raise Solver/Multiplier degree offset = " + std::to_string(offset),
           std::to_string(lowest));
}

template <int dim>
void reject_unknowns(const Scene<dim> &scene, const double unknowns, const std::string &entry,
                     const std::string &remedy)
{
  if (!(unknowns > scene.adaptivity.maximum_unknowns))
    return;
  if (scene.geometry.shape == Shape::bodies) // whose meshes have entries of their own
    reject(scene, "Adaptivity", "Maximum unknowns",
           "is less than the bodies have in the first step, at least " +
               std::to_string(std::llround(unknowns)) + " free unknowns of degree " +
               std::to_string(lowest_degree(scene)) +
               "; take coarser meshes, by their Subdivisions, or raise it",
           std::to_string(scene.adaptivity.maximum_unknowns));
  reject(scene, "Geometry", entry,
         "makes at least " + std::to_string(std::llround(unknowns)) + " free unknowns of degree " +
             std::to_string(scene.adaptivity.start_degree) +
             " in the first step, more than Adaptivity/Maximum unknowns = " +
             std::to_string(scene.adaptivity.maximum_unknowns) + "; " + remedy);
}

/** By p^2 nodes that are a cell's own, and supports that may hold all nodes of the boundary. */
template <int dim>
void check_first_step_on_mesh(const Scene<dim> &scene)
{
  const double p = lowest_degree(scene);
  if constexpr (dim == 3) // nodes inside of a cell are its own
    reject_unknowns(scene, 3 * std::pow(p - 1, 3) * scene.geometry.n_cells(), "File",
                    "take a coarser mesh or raise that limit");
  double n_outside = 0;
  for (const CoarseMesh::Edge &edge : scene.geometry.mesh->edges)
    n_outside += edge.boundary == CoarseMesh::inside ? 0 : 1;
  if constexpr (dim == 2)
    reject_unknowns(scene, 2 * (p * p * scene.geometry.n_cells() - p * n_outside),
                    scene.geometry.shape == Shape::file ? "File" : "Subdivisions",
                    "take a coarser mesh or raise that limit");
}

/** At least so many: grading adds some, and what two sides hold where they meet is held once. */
template <int dim>
void check_first_step(const Scene<dim> &scene)
{
  const unsigned int degree = scene.adaptivity.start_degree;
  if (scene.geometry.has_mesh())
    return check_first_step_on_mesh(scene);
  std::array<double, dim> nodes;
  double all_nodes = 1;
  for (unsigned int d = 0; d < dim; ++d)
    all_nodes *= nodes[d] = 1. + degree * double(scene.geometry.n_cells(d));
  const std::vector<Side<dim>> sides = sides_of(scene);
  double unknowns = dim * all_nodes;
  for (const BoundaryCondition<dim> &boundary : scene.boundaries)
  {
    int held = boundary.holds_normal() ? 1 : 0;
    for (const auto &component : boundary.displacement)
      held += component != nullptr ? 1 : 0;
    unknowns -= std::min(held, dim) * all_nodes / nodes[sides[boundary.id].axis];
  }
  reject_unknowns(scene, unknowns, "Subdivisions", "start coarser or raise that limit");
}
} // namespace

template <int dim>
void check_method(const Scene<dim> &scene, const SceneUse use)
{
  for_each_value(scene, CheckValue<dim>{scene});
  check_adaptivity(scene);
  check_first_step(scene);
  check_normal_contact(scene);
  check_multiplier_degree(scene, use);
}

namespace
{
/** Of the body of this number. */
template <int dim>
std::optional<Objection> objection_to_degree(const Scene<dim> &scene, const unsigned int body,
                                             const std::string &why)
{
  const unsigned int degree = scene.start_degree_of(body);
  const std::vector<unsigned int> &own = scene.adaptivity.degrees_of_bodies;
  const std::string section = body < own.size() && own[body] > 0
                                  ? "Body " + scene.geometry.bodies[body].name
                                  : "Adaptivity";
  if (degree < 2 || degree > 8)
    return Objection{section, "Start degree", "is not offered by " + why + "; give 2 to 8",
                     std::to_string(degree)};
  if (dim == 3 && scene.solver.linear == LinearMethod::multigrid && degree > 4)
    return Objection{"Solver", "Linear",
                     "is for degrees 2 to 4, and " +
                         (section == "Adaptivity" ? "" : section + "/") + "Start degree is " +
                         std::to_string(degree) + "; give automatic, amg or direct",
                     "multigrid"};
  return std::nullopt;
}
} // namespace

template <int dim>
std::optional<Objection> objection_to_primal_path(const Scene<dim> &scene)
{
  const std::string why = dim == 3 ? "space" : "the primal path";
  const Adaptivity &adaptivity = scene.adaptivity;
  if (adaptivity.method >= Method::pu)
    return Objection{"Adaptivity", "Method",
                     "varies the degree from cell to cell or with the steps, which " + why +
                         " does not offer; take hup2, hup3, hup4, hap2, hap3 or hap4",
                     method_names[static_cast<unsigned int>(adaptivity.method)]};
  for (unsigned int body = 0; body == 0 || body < scene.geometry.bodies.size(); ++body)
    if (const auto objection = objection_to_degree(scene, body, why))
      return objection;
  for (const Material &material : scene.materials)
    if (dim == 2 && material.orthotropy)
      return Objection{section_of_material(material.name), "Elasticity",
                       "is not offered by " + why +
                           "; run the reduced path on one process, or give an isotropic material",
                       "orthotropic"};
  if (scene.is_axisymmetric())
    return Objection{"Material", "Plane",
                     "is not offered by " + why + "; run the reduced path on one process",
                     "axisymmetric"};
  for (const BoundaryCondition<dim> &boundary : scene.boundaries)
    if (dim == 2 && boundary.spring)
      return Objection{section_of(boundary), "Spring",
                       "is not offered by " + why +
                           "; run the reduced path on one process, or remove it"};
  if (!scene.pretensions.empty())
    return Objection{"Pretension " + scene.pretensions.front().name, "Through",
                     "is not offered by " + why +
                         "; run the reduced path on one process, or remove it"};
  if (dim == 2 && scene.has_initial_strain())
    return Objection{"Material", "Initial strain",
                     "or Thermal expansion is not offered by " + why +
                         "; run the reduced path on one process, or remove it"};
  for (const BoundaryCondition<dim> &boundary : scene.boundaries)
    if (dim == 2 && boundary.plate)
      return Objection{section_of(boundary), "Rigid",
                       "is not offered by " + why +
                           "; run the reduced path on one process, or remove it",
                       "true"};
  for (const BoundaryCondition<dim> &boundary : scene.boundaries)
    if (dim == 2 && boundary.contact_direction)
      return Objection{section_of(boundary), "Contact direction",
                       "is not offered by " + why +
                           "; run the reduced path on one process, or remove it"};
  if (scene.has_unilateral_contact() && scene.normal_contact() == NormalContact::nodes)
    return Objection{
        "Solver", "Normal contact",
        "is not offered by " + why + ", whose pressures are multipliers; set multiplier", "nodes"};
  if ((scene.has_friction() || scene.has_unilateral_contact()) &&
      scene.solver.multiplier_offset != -2)
    return Objection{"Solver", "Multiplier degree offset",
                     "is not offered by " + why + ", whose moments need -2; remove it"};
  if (scene.solver.condition_number)
    return Objection{"Solver", "Condition number",
                     "asks for a matrix S that " + why + " does not form; remove it"};
  if (scene.geometry.shape != Shape::box && !(dim == 3 && scene.geometry.has_mesh()))
    return Objection{"Geometry", "Shape", "is not offered by " + why + "; set Shape = box",
                     name_of_shape<dim>(scene.geometry.shape)};
  return std::nullopt;
}

template <int dim>
void check_primal_path(const Scene<dim> &scene)
{
  if (const auto found = objection_to_primal_path(scene))
    reject(scene, found->section, found->name, found->problem_and_remedy, found->value);
  if constexpr (dim == 2)
    if (const auto motions = scene.free_motions(); !motions.empty())
      throw InputError(printable(scene.origin(), 400) +
                       ": Boundary left, right, bottom, top/Displacement: the supports leave a "
                       "motion free " +
                       motions.front().direction() +
                       ", and bodies held by contact alone are not offered by the primal path; "
                       "prescribe a displacement component or bilateral contact that stops it, or "
                       "run the reduced path on one process");
}

template void check_method(const Scene<2> &, SceneUse);
template void check_method(const Scene<3> &, SceneUse);
template std::optional<Objection> objection_to_primal_path(const Scene<2> &);
template std::optional<Objection> objection_to_primal_path(const Scene<3> &);
template void check_primal_path(const Scene<2> &);
template void check_primal_path(const Scene<3> &);
} // namespace hpvi
