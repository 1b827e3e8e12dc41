// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/moments/rigid_motions.h>

namespace hpvi
{
using namespace dealii;

namespace
{
/** The value at @p x of a translation or, about @p centre, a rotation. */
template <int dim>
Tensor<1, dim> rigid_motion(const unsigned int motion, const Tensor<1, dim> &arm)
{
  Tensor<1, dim> result;
  if (motion < dim)
    result[motion] = 1;
  else
  {
    const unsigned int a = motion == dim ? 0 : (motion == dim + 1 ? 1 : 2), b = (a + 1) % dim;
    result[a] = -arm[b];
    result[b] = arm[a];
  }
  return result;
}
} // namespace

template <int dim>
std::vector<double> rigid_motions(const MomentSpace<dim> &space)
{
  const unsigned int n = space.owned.n_elements();
  const FESystem<dim> &fe = space.tables.fe;
  const Point<dim> centre = space.scene.geometry.centre();
  const double length = space.scene.geometry.radius();
  std::vector<double> result(n * n_motions<dim>, 0.);
  std::vector<types::global_dof_index> dofs(fe.dofs_per_cell);
  for (const auto &cell : space.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      cell->get_dof_indices(dofs);
      const Tensor<1, dim> size = MomentSpace<dim>::extent(cell);
      for (unsigned int i = 0; i < fe.dofs_per_cell; ++i)
        if (space.owned.is_element(dofs[i]) && !space.constraints.is_constrained(dofs[i]))
        {
          Tensor<1, dim> arm = cell->vertex(0) - centre;
          for (unsigned int d = 0; d < dim; ++d)
            arm[d] += fe.unit_support_point(i)[d] * size[d];
          for (unsigned int m = 0; m < n_motions<dim>; ++m)
            result[m * n + space.owned.index_within_set(dofs[i])] =
                rigid_motion(m, arm / length)[fe.system_to_component_index(i).first];
        }
    }
  for (const MomentFace<dim> &face : space.faces)
    for (unsigned int k = 0; k < space.tables.n_moments(); ++k)
      for (unsigned int m = 0; m < n_motions<dim>; ++m)
      {
        const auto set = [&](const ContactMoment<dim> &moment, const unsigned int s,
                             const unsigned int axis) {
          result[m * n + moment.unknowns[s]] = rigid_motion(m, (moment.x - centre) / length)[axis];
        };
        for (unsigned int s = 0; face.has_friction() && s < dim - 1; ++s)
          set(space.contact[face.friction + k], s, tangents<dim>(face.face)[s]);
        if (face.has_pressure())
          set(space.contact[face.pressure + k], 0, face.face / 2);
      }
  return result;
}

template std::vector<double> rigid_motions(const MomentSpace<2> &);
template std::vector<double> rigid_motions(const MomentSpace<3> &);
} // namespace hpvi
