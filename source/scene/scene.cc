// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/tolerances.h>
#include <hpvi/scene/scene.h>

#include <hpvi/base/text.h>

#include <algorithm>
#include <limits>

namespace hpvi
{
using namespace dealii;

namespace
{
template <int dim>
bool any_given(const std::array<Expression<dim>, dim> &components)
{
  return std::any_of(components.begin(), components.end(),
                     [](const Expression<dim> &e) { return e != nullptr; });
}
} // namespace

template <int dim>
bool BoundaryCondition<dim>::has_displacement() const
{
  return any_given<dim>(displacement);
}

template <int dim>
bool BoundaryCondition<dim>::has_traction() const
{
  return any_given<dim>(traction);
}

template <int dim>
bool BoundaryCondition<dim>::exerts_forces() const
{
  return has_displacement() || has_contact() || symmetry || spring || plate;
}

template <int dim>
std::array<double, 2> Spring<dim>::at(const Point<dim> &x) const
{
  return {{normal ? normal->value(x) : 0., tangential ? tangential->value(x) : 0.}};
}

template <int dim>
bool Spring<dim>::varies() const
{
  return (normal && !is_constant<dim>(normal)) || (tangential && !is_constant<dim>(tangential));
}

template <int dim>
Tensor<2, dim> Spring<dim>::stiffness(const Point<dim> &x, const Tensor<1, dim> &n) const
{
  const auto [k_n, k_t] = at(x);
  return k_t * Tensor<2, dim>(unit_symmetric_tensor<dim>()) + (k_n - k_t) * outer_product(n, n);
}

template <int dim>
bool BoundaryCondition<dim>::has_contact() const
{
  return contact != Contact::none;
}

template <int dim>
bool BoundaryCondition<dim>::is_unilateral() const
{
  return contact == Contact::unilateral;
}

template <int dim>
bool BoundaryCondition<dim>::is_tied() const
{
  return contact == Contact::tied;
}

template <int dim>
bool BoundaryCondition<dim>::holds_normal() const
{
  return symmetry || (contact == Contact::bilateral && !pair && !friction.knows_pressure());
}

template <int dim>
bool BoundaryCondition<dim>::has_pressure() const
{
  return is_unilateral() || is_tied() ||
         (contact == Contact::bilateral && (pair || friction.knows_pressure()));
}

template <int dim>
double BoundaryCondition<dim>::gap_at(const Point<dim> &x) const
{
  return gap ? gap->value(x) : 0.;
}

template <int dim>
Tensor<1, dim> BoundaryCondition<dim>::held_direction(const Tensor<1, dim> &normal) const
{
  if (!contact_direction || !has_contact())
    return normal;
  // The normal itself, so that one who writes it down gets what one gets who does not.
  return (*contact_direction - normal).norm() <= same_direction ? normal : *contact_direction;
}

template <int dim>
std::vector<PointCondition<dim>> conditions_at(const BoundaryCondition<dim> &boundary,
                                               const Tensor<1, dim> &normal, const bool slides,
                                               const Point<dim> &point)
{
  std::vector<PointCondition<dim>> conditions;
  for (unsigned int d = 0; d < dim; ++d)
    if (boundary.displacement[d] != nullptr)
    {
      Tensor<1, dim> direction;
      direction[d] = 1.;
      conditions.push_back({direction, boundary.displacement[d]->value(point), boundary.id});
    }
  if (slides)
    conditions.push_back({boundary.held_direction(normal), 0., boundary.id});
  return conditions;
}

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
  case Method::hpa4:
    return 3;
  case Method::hup4:
  case Method::hap4:
    return 4;
  }
  return 2;
}

template <int dim>
double Loading<dim>::time(const unsigned int step) const
{
  return static_cast<double>((step - 1) % steps + 1) / steps;
}

template <int dim>
unsigned int Loading<dim>::cycle(const unsigned int step) const
{
  return until_steady == 0 ? 0 : (step - 1) / steps + 1;
}

// ---------------------------------------------------------------- the scene

template <int dim>
Scene<dim>::Scene() : materials(1)
{
  name_boundaries();
  if (dim == 3) // as in a file
  {
    adaptivity.method = Method::hap2;
    adaptivity.start_degree = own_start_degree(Method::hap2);
  }
}

template <int dim>
unsigned int Scene<dim>::start_degree_of(const unsigned int body) const
{
  const std::vector<unsigned int> &own = adaptivity.degrees_of_bodies;
  return body < own.size() && own[body] > 0 ? own[body] : adaptivity.start_degree;
}

template <int dim>
types::material_id Scene<dim>::material_of_coarse_cell(const Point<dim> &centre,
                                                       const unsigned int cell) const
{
  types::material_id result = material_at ? material_at(centre) : 0;
  if (geometry.mesh && !material_of_surface.empty())
    if (const auto own = material_of_surface[geometry.mesh->cells[cell].surface])
      result = *own;
  for (const Pretension<dim> &cut : pretensions)
    if (const auto *const own = cut.cell(centre))
      return own->material;
  return result;
}

template <int dim>
bool Scene<dim>::has_material_places() const
{
  return material_at || !material_of_surface.empty() || !pretensions.empty();
}

template <int dim>
void Scene<dim>::name_boundaries()
{
  const std::vector<std::string> names = geometry.boundary_names();
  boundaries.assign(names.size(), {});
  for (types::boundary_id b = 0; b < boundaries.size(); ++b)
  {
    boundaries[b].name = names[b];
    boundaries[b].id = b;
    boundaries[b].side = b;
  }
}

template <int dim>
BoundaryCondition<dim> &Scene<dim>::boundary(const std::string &wanted)
{
  std::string names;
  for (BoundaryCondition<dim> &candidate : boundaries)
  {
    if (candidate.name == wanted)
      return candidate;
    names += (names.empty() ? "" : ", ") + candidate.name;
  }
  throw InputError(origin() + ": Boundary " + printable(wanted) +
                   ": there is none of this name; give " + names);
}

template <int dim>
std::string Scene<dim>::origin() const
{
  return file.empty() ? name : file;
}

template <int dim>
double Scene<dim>::reference_coercivity() const
{
  return materials.front().coercivity(dim);
}

template <int dim>
double Scene<dim>::largest_weight() const
{
  double largest = 0;
  for (const Material &material : materials)
    largest = std::max(largest, material.residual_weight());
  return largest;
}

template <int dim>
bool Scene<dim>::has_body_force() const
{
  const std::vector<Load<dim>> forces = body_forces();
  return std::any_of(forces.begin(), forces.end(), any_given<dim>);
}

template <int dim>
std::vector<Load<dim>> Scene<dim>::body_forces() const
{
  return body_force_of_material.empty() ? std::vector<Load<dim>>{body_force}
                                        : body_force_of_material;
}

template <int dim>
bool Scene<dim>::has_springs() const
{
  return std::any_of(boundaries.begin(), boundaries.end(),
                     [](const BoundaryCondition<dim> &boundary) { return bool(boundary.spring); });
}

template <int dim>
bool Scene<dim>::has_plates() const
{
  return std::any_of(boundaries.begin(), boundaries.end(),
                     [](const BoundaryCondition<dim> &boundary) { return bool(boundary.plate); });
}

template <int dim>
bool Scene<dim>::has_initial_strain() const
{
  return std::any_of(initial_strains.begin(), initial_strains.end(),
                     [](const InitialStrain<dim> &strain) { return bool(strain); });
}

template <int dim>
Tensor<2, dim> Scene<dim>::initial_strain(const types::material_id material,
                                          const Point<dim> &x) const
{
  if (const InitialStrain<dim> &initial = initial_strains.at(material))
    return materials[material].without_stress(initial.value(x));
  return {};
}

template <int dim>
double Scene<dim>::hoop_strain(const types::material_id material, const Tensor<1, dim> &u,
                               const Tensor<2, dim> &gradient, const Point<dim> &x) const
{
  if (!is_axisymmetric())
    return 0.;
  // Round-off of a point on the axis is no radius.
  const double total = x[0] > 1e-12 * geometry.diameter() ? u[0] / x[0] : gradient[0][0];
  return initial_strains.empty() ? total : total - initial_strains.at(material).value(x)[3];
}

template <int dim>
bool Scene<dim>::has_parts() const
{
  return boundaries.size() > geometry.boundary_names().size();
}

template <int dim>
bool Scene<dim>::is_nearly_incompressible() const
{
  return std::any_of(materials.begin(), materials.end(),
                     [](const Material &material)
                     { return material.is_nearly_incompressible(dim); });
}

template <int dim>
bool Scene<dim>::has_load_history() const
{
  return loading.steps > 0 || loading.at;
}

template <int dim>
bool Scene<dim>::has_pairs() const
{
  return !pairs.empty();
}

template <int dim>
bool Scene<dim>::has_contact() const
{
  return std::any_of(boundaries.begin(), boundaries.end(),
                     [](const BoundaryCondition<dim> &b) { return b.has_contact(); });
}

template <int dim>
bool Scene<dim>::has_known_solution() const
{
  return exact_solution || !reference_solution.empty();
}

template <int dim>
bool Scene<dim>::has_friction() const
{
  return std::any_of(boundaries.begin(), boundaries.end(),
                     [](const BoundaryCondition<dim> &b) { return b.has_contact() && b.friction; });
}

template <int dim>
bool Scene<dim>::has_pressure() const
{
  return std::any_of(boundaries.begin(), boundaries.end(),
                     [](const BoundaryCondition<dim> &b) { return b.has_pressure(); });
}

template <int dim>
bool Scene<dim>::has_coulomb_friction() const
{
  return std::any_of(boundaries.begin(), boundaries.end(),
                     [](const BoundaryCondition<dim> &b)
                     { return b.has_contact() && b.friction.knows_pressure(); });
}

template <int dim>
bool Scene<dim>::has_unilateral_contact() const
{
  return std::any_of(boundaries.begin(), boundaries.end(),
                     [](const BoundaryCondition<dim> &b) { return b.is_unilateral(); });
}

template <int dim>
NormalContact Scene<dim>::normal_contact() const
{
  if (solver.normal_contact != NormalContact::automatic)
    return solver.normal_contact;
  // Nodes on the axis would have no weight.
  const bool has_nodes = dim == 2 && !is_axisymmetric() && solver.path != SolutionPath::primal &&
                         !has_coulomb_friction() && geometry.bodies.empty();
  return has_nodes ? NormalContact::nodes : NormalContact::multiplier;
}

template struct Spring<2>;
template struct Spring<3>;
template struct BoundaryCondition<2>;
template struct BoundaryCondition<3>;
template std::vector<PointCondition<2>> conditions_at(const BoundaryCondition<2> &,
                                                      const Tensor<1, 2> &, bool, const Point<2> &);
template std::vector<PointCondition<3>> conditions_at(const BoundaryCondition<3> &,
                                                      const Tensor<1, 3> &, bool, const Point<3> &);
template struct Loading<2>;
template struct Loading<3>;
template struct Scene<2>;
template struct Scene<3>;
} // namespace hpvi
