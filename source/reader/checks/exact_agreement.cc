// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/checks/checks.h>
#include <hpvi/reader/checks/rejection.h>
#include <hpvi/reader/shapes/shape.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Compares one boundary with the exact solution, at points all along it. */
template <int dim>
class ExactSolutionCheck
{
public:
  ExactSolutionCheck(const Scene<dim> &scene, const unsigned int id)
      : scene(scene), exact(*scene.exact_solution), boundary(scene.boundaries[id]),
        section(section_of(boundary)), side(sides_of(scene.geometry)[id])
  {
    for (unsigned int d = 0; d < dim; ++d)
      stress[d] =
          std::make_unique<ExactTraction<dim>>(scene.exact_solution, scene.materials[0], side, d);
    for (const Side<dim> &any : sides_of(scene.geometry))
      for (const Point<dim> &point : any.sample())
      {
        displacement_scale = std::max(displacement_scale, exact.displacement(point).norm());
        stress_scale = std::max(stress_scale, scene.materials[0].residual_weight() *
                                                  exact.gradient(point).norm());
      }
  }

  void run() const
  {
    for (const Point<dim> &point : side.sample())
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
  void check_displacement(const Point<dim> &point) const
  {
    const Tensor<1, dim> u = exact.displacement(point);
    for (unsigned int d = 0; d < dim; ++d)
      if (boundary.displacement[d] != nullptr &&
          differ(boundary.displacement[d]->value(point), u[d], displacement_scale))
        contradict("Displacement", point, "write exact");
  }

  void check_traction(const Point<dim> &point) const
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (boundary.displacement[d] == nullptr &&
          differ(traction(d, point), stress[d]->value(point), stress_scale))
        contradict("Traction", point, "write exact");
  }

  /**
   * bilateral: `u_n = 0`; unilateral: `u_n <= u_0`, `p >= 0`, `(u_n - u_0) p = 0`; unilateral and, with
   * p = 0, tangential: `sigma_n = G_n - p`.
   */
  void check_normal_contact(const Point<dim> &point) const
  {
    const double u_n = exact.displacement(point) * side.normal(point);
    if (boundary.contact == Contact::bilateral)
    {
      if (differ(u_n, 0, displacement_scale))
        contradict("Contact", point, "set Contact = none");
      return;
    }
    const double p = boundary.is_unilateral() ? exact.pressure(point) : 0.;
    double imbalance = p;
    for (unsigned int d = 0; d < dim; ++d)
      imbalance += side.normal(point)[d] * (stress[d]->value(point) - traction(d, point));
    if (p < -tolerance * stress_scale || differ(imbalance, 0, stress_scale))
      contradict_load(point, "Contact", "set Contact = none");
    const double gap = boundary.gap_at(point) - u_n;
    const bool closed = p > tolerance * stress_scale;
    if (boundary.is_unilateral() && differ(closed ? gap : std::min(gap, 0.), 0, displacement_scale))
      contradict("Gap", point, "give that of the solution");
  }

  /** `sigma_t = G_t - g lambda`, `|lambda| <= 1`, `lambda u_t = |u_t|`. */
  void check_friction_law(const Point<dim> &point) const
  {
    const Tensor<1, dim> u = exact.displacement(point), t = along_slip(point);
    const double lambda = exact.multiplier(point);
    if (std::abs(lambda) > 1 + tolerance)
      reject(scene, "Exact solution", "Length",
             "asks friction for |lambda| = " + to_string(std::abs(lambda)) + " > 1 at " +
                 to_string(point) +
                 "; enlarge it, shorten the contact or move Transition to the right");
    Tensor<1, dim> imbalance = g(point) * lambda * t;
    for (unsigned int d = 0; d < dim; ++d)
      imbalance[d] += stress[d]->value(point) - traction(d, point);
    const Tensor<1, dim> n = side.normal(point);
    imbalance -= (imbalance * n) * n;
    if (differ(imbalance.norm(), 0, stress_scale))
      contradict_load(point, friction_entry(), "give that of the solution");
    if (g(point) == 0 || !differ(lambda * (u * t), std::abs(u * t), displacement_scale))
      return;
    if (lambda == 0)
      contradict(friction_entry(), point, "leave the contact without friction");
    reject(scene, "Exact solution", "Length",
           "lets the body slip against its friction at " + to_string(point) +
               "; enlarge it or move Transition to the right");
  }

  /** The tangent that multipliers count along: in space, where closed forms are plane, the first axis. */
  Tensor<1, dim> along_slip(const Point<dim> &point) const
  {
    if constexpr (dim == 2)
      return side.tangent(point);
    else
      return Point<dim>::unit_vector(0);
  }

  /** What friction may be under the pressure of the solution. */
  double g(const Point<dim> &point) const
  {
    return boundary.friction.limit(point, exact.pressure(point));
  }

  std::string friction_entry() const
  {
    return boundary.friction.entry();
  }

  double traction(const unsigned int component, const Point<dim> &point) const
  {
    return boundary.traction[component] ? boundary.traction[component]->value(point) : 0.;
  }

  static bool differ(const double a, const double b, const double scale)
  {
    return !(std::abs(a - b) <= tolerance * scale);
  }

  /** A load on the contact is at fault, or else @p entry. */
  [[noreturn]] void contradict_load(const Point<dim> &point, const std::string &entry,
                                    const std::string &remedy) const
  {
    if (boundary.has_traction())
      contradict("Traction", point, "leave the contact without traction");
    contradict(entry, point, remedy);
  }

  [[noreturn]] void contradict(const std::string &entry, const Point<dim> &point,
                               const std::string &remedy) const
  {
    reject(scene, section, entry,
           "contradicts " + mention(scene, "Exact solution", "Solution") + " at " +
               to_string(point) + "; " + remedy + " or set Solution = none");
  }

  static constexpr double tolerance = 1e-8;
  const Scene<dim> &scene;
  const ExactSolution<dim> &exact;
  const BoundaryCondition<dim> &boundary;
  const std::string section;
  const Side<dim> side;
  std::array<std::unique_ptr<const Function<dim>>, dim> stress; ///< the components of `sigma n`
  double displacement_scale = 0, stress_scale = 0;
};

} // namespace

template <int dim>
void check_exact_solution(const Scene<dim> &scene)
{
  if (scene.exact_solution == nullptr)
    return;
  if (scene.has_body_force())
    reject(scene, "Body force", "Expression",
           "contradicts " + mention(scene, "Exact solution", "Solution") +
               ", which has none; remove it or set Solution = none");
  if (!scene.pretensions.empty())
    reject(scene, "Exact solution", "Solution",
           "knows no Pretension; remove it, or measure errors by Error/Reference solution");
  if (scene.has_initial_strain())
    reject(scene, "Exact solution", "Solution",
           "knows no initial strain; remove it, or measure errors by Error/Reference solution");
  if (scene.materials.size() > 1)
    reject(scene, "Exact solution", "Solution",
           "knows one material, and the scene has " + std::to_string(scene.materials.size()) +
               "; measure errors by Error/Reference solution");
  if (scene.materials[0].orthotropy)
    reject(
        scene, section_of_material(scene.materials[0].name), "Elasticity",
        "contradicts " + mention(scene, "Exact solution", "Solution") +
            ", which is that of an isotropic material; measure errors by Error/Reference solution",
        "orthotropic");
  if (scene.has_parts())
    reject(scene, "Exact solution", "Solution",
           "knows whole sides, and Boundary " + scene.boundaries.back().name +
               " is a part; measure errors by Error/Reference solution");
  for (const BoundaryCondition<dim> &boundary : scene.boundaries)
    if (boundary.symmetry || boundary.spring || boundary.plate)
      reject(scene, section_of(boundary),
             boundary.symmetry ? "Symmetry"
             : boundary.spring ? "Spring"
                               : "Rigid",
             "is none of " + mention(scene, "Exact solution", "Solution") +
                 "; give Displacement = exact, or measure errors by Error/Reference solution");
  for (const BoundaryCondition<dim> &boundary : scene.boundaries)
    if (boundary.contact_direction)
      reject(scene, section_of(boundary), "Contact direction",
             "is none of " + mention(scene, "Exact solution", "Solution") +
                 ", which has contact along the normal; remove it, or measure errors by "
                 "Error/Reference solution");
  if (scene.geometry.has_mesh())
    reject(scene, "Geometry", "Shape",
           "stands beside " + mention(scene, "Exact solution", "Solution") +
               ", which is measured on a box or a quadrilateral alone; measure errors by "
               "Error/Reference solution",
           name_of_shape<dim>(scene.geometry.shape));
  if (scene.thickness != 1)
    reject(scene, "Exact solution", "Solution",
           "is that of a body of unit thickness; remove Material/Thickness");
  for (unsigned int b = 0; b < scene.boundaries.size(); ++b)
    ExactSolutionCheck<dim>(scene, b).run();
}

template void check_exact_solution(const Scene<2> &);
template void check_exact_solution(const Scene<3> &);
} // namespace hpvi
