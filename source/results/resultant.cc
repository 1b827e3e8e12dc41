// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/results/resultant.h>

#include <algorithm>

namespace hpvi
{
using namespace dealii;

namespace
{
/** In space the length of the vector. */
double along_tangent(const double friction)
{
  return friction;
}

double along_tangent(const Tensor<1, 3> &friction)
{
  return friction.norm();
}

double component(const double moment, const unsigned int)
{
  return moment;
}

double component(const Tensor<1, 3> &moment, const unsigned int d)
{
  return moment[d];
}

template <int dim>
Resultant<dim> resultant_of(const BoundaryForce<dim> &force, const ForceKind kind)
{
  Resultant<dim> result;
  result.name = force.boundary;
  result.kind = kind;
  result.boundary = force.id;
  for (unsigned int d = 0; d < dim; ++d)
    result.force[d].value = force.force[d];
  for (unsigned int d = 0; d < result.n_moments; ++d)
    result.moment[d].value = component(force.moment, d);
  return result;
}

/** Both sides of a pair have it: normal and tangent of the other one point the other way, and so do its tractions. */
template <int dim>
const ContactState<dim> *state_of(const types::boundary_id boundary, const Scene<dim> &scene,
                                  const std::vector<ContactState<dim>> &contact)
{
  const auto &pair = scene.boundaries[boundary].pair;
  const types::boundary_id first = pair ? scene.pairs[*pair].parts[0] : boundary;
  const auto state = std::find_if(contact.begin(), contact.end(),
                                  [&](const auto &one) { return one.boundary == first; });
  return state == contact.end() ? nullptr : &*state;
}
} // namespace

template <int dim>
std::vector<Resultant<dim>> resultants(const Scene<dim> &scene, const Equilibrium<dim> &equilibrium,
                                       const std::vector<ContactState<dim>> &contact)
{
  std::vector<Resultant<dim>> result;
  for (const BoundaryForce<dim> &force : equilibrium.reactions)
  {
    const bool is_contact = scene.boundaries[force.id].has_contact();
    result.push_back(resultant_of(force, is_contact ? ForceKind::contact : ForceKind::support));
    if (!is_contact)
      continue;
    if (const ContactState<dim> *const state = state_of(force.id, scene, contact))
    {
      result.back().normal.value = state->normal_resultant;
      result.back().friction.value = along_tangent(state->friction_resultant);
    }
  }
  for (const BoundaryForce<dim> &force : equilibrium.parts_of_loads)
    result.push_back(resultant_of(force, ForceKind::load));
  return result;
}

template std::vector<Resultant<2>> resultants(const Scene<2> &, const Equilibrium<2> &,
                                              const std::vector<ContactState<2>> &);
template std::vector<Resultant<3>> resultants(const Scene<3> &, const Equilibrium<3> &,
                                              const std::vector<ContactState<3>> &);
} // namespace hpvi
