// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/space/rigid_motions.h>

namespace hpvi
{
using namespace dealii;

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

template <int dim>
std::vector<double> rigid_motions(const PrimalSpace<dim> &space)
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
      const CellMap<dim> map = map_of<dim>(cell);
      for (unsigned int i = 0; i < fe.dofs_per_cell; ++i)
        if (space.owned.is_element(dofs[i]) && !space.constraints.is_constrained(dofs[i]))
        {
          const Tensor<1, dim> arm = map.point(fe.unit_support_point(i)) - centre;
          for (unsigned int m = 0; m < n_motions<dim>; ++m)
            result[m * n + space.owned.index_within_set(dofs[i])] =
                rigid_motion<dim>(m, arm / length)[fe.system_to_component_index(i).first];
        }
    }
  for (const ContactDofFace<dim> &face : space.faces)
  {
    face.cell->get_dof_indices(dofs);
    const bool is_jump =
        space.condition(face.cell, face.face).pair.has_value(); // all bodies move alike
    for (unsigned int k = 0; k < space.tables.n_contact_dofs(); ++k)
    {
      const Tensor<1, dim> arm = space.contact[face.first() + k].centroid - centre;
      for (const unsigned int c : face.components())
        for (unsigned int m = 0; m < n_motions<dim>; ++m)
          result[m * n + space.owned.index_within_set(
                             dofs[space.tables.numbers[space.tables.inner[face.face][k]][c]])] =
              is_jump ? 0. : rigid_motion<dim>(m, arm / length) * face.direction(c);
    }
  }
  return result;
}

template Tensor<1, 2> rigid_motion(unsigned int, const Tensor<1, 2> &);
template Tensor<1, 3> rigid_motion(unsigned int, const Tensor<1, 3> &);
template std::vector<double> rigid_motions(const PrimalSpace<2> &);
template std::vector<double> rigid_motions(const PrimalSpace<3> &);
} // namespace hpvi
