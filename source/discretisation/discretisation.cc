// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/dense_work.h>
#include <hpvi/base/memory.h>
#include <hpvi/discretisation/discretisation.h>

namespace hpvi
{
using namespace dealii;

template <int dim>
Spaces<dim>::Spaces(const Scene<dim> &scene,
                    std::shared_ptr<const Triangulation<dim>> triangulation, const Degrees &degrees,
                    std::shared_ptr<const ShapeTables<dim>> shape_tables)
    : mesh(std::move(triangulation)), tables(std::move(shape_tables)),
      displacement_space(scene, *mesh, degrees, *tables),
      contact_space(scene, displacement_space, *tables),
      contact_operator(displacement_space, contact_space, *tables)
{
}

namespace
{
template <int dim>
std::optional<RigidMotions<dim>>
motions_of(const Scene<dim> &scene, const Spaces<dim> &spaces, const Unknowns<dim> &unknowns,
           const ConditionRows &rows, const ElasticSystem<dim> &system)
{
  const std::vector<RigidBodyMotion<dim>> basis = scene.free_motions();
  if (basis.empty())
    return std::nullopt;
  return RigidMotions<dim>(basis, spaces.displacement_space, unknowns, rows,
                           spaces.contact_space.multipliers(), system);
}
} // namespace

template <int dim>
Discretisation<dim>::Discretisation(const Scene<dim> &scene,
                                    std::shared_ptr<const Spaces<dim>> all_spaces,
                                    CondensedElements<dim> &elements)
    : scene(scene), spaces(std::move(all_spaces)),
      unknowns(spaces->displacement_space, spaces->contact_operator, *spaces->tables),
      contact_rows(unknowns.contact_rows()), condensation(spaces->displacement_space, elements),
      system(scene, spaces->displacement_space, unknowns, condensation, *spaces->tables, elements),
      free_motions(motions_of(scene, *spaces, unknowns, contact_rows, system))
{
}

template <int dim>
Vector<double> Discretisation<dim>::displacement(const Vector<double> &x) const
{
  Vector<double> u = unknowns.distribute(x);
  condensation.extend(u);
  if (scene.has_body_force())
    condensation.add_interior(system.loads(), u);
  return u;
}

template <int dim>
LinearSolver Discretisation<dim>::factor() const
{
  const DenseWork dense{contact_rows.kept.size(), contact_rows.n_rows()};
  if (dense.n_multipliers > 0)
    require_memory(dense.bytes(), dense.name());
  return LinearSolver(system.A, contact_rows.kept, dense.n_multipliers > 0 ? dense.bytes() : 0.,
                      free_motions ? free_motions->stabilisation() : std::vector<Stabilisation>());
}

template class Spaces<2>;
template class Discretisation<2>;
} // namespace hpvi
