// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/plane/cell_map.h>
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

namespace
{
/** Contact dofs of a curved face, whose directions turn between its Gauss points. */
template <int dim>
void set_on_curved(const PrimalSpace<dim> &space, const ContactDofFace<dim> &face,
                   std::vector<double> &motions)
{
  const unsigned int n = space.owned.n_elements();
  const Point<dim> centre = space.scene.geometry.centre();
  const double length = space.scene.geometry.radius();
  const CellMap<dim> map = map_of<dim>(face.cell);
  std::vector<types::global_dof_index> dofs;
  const BoxTables<dim> &tables = space.tables.take_dofs(face.cell, dofs);
  const auto at_nodes = [&](const std::vector<unsigned int> &shapes, const unsigned int m)
  {
    Vector<double> result(dim * shapes.size());
    for (unsigned int j = 0; j < shapes.size(); ++j)
    {
      const Point<dim> node = tables.fe.unit_support_point(tables.numbers[shapes[j]][0]);
      const Tensor<1, dim> u = rigid_motion<dim>(m, (map.point(node) - centre) / length);
      for (unsigned int c = 0; c < dim; ++c)
        result[c * shapes.size() + j] = u[c];
    }
    return result;
  };
  const std::vector<unsigned int> &inner = tables.inner[face.face];
  for (unsigned int m = 0; m < n_motions<dim>; ++m)
  {
    Vector<double> moments(dim * inner.size());
    face.own->M.vmult(moments, at_nodes(inner, m));
    face.own->W.vmult_add(moments, at_nodes(tables.rim[face.face], m));
    for (unsigned int i = 0; i < moments.size(); ++i)
      motions[m * n + space.owned.index_within_set(
                          dofs[tables.numbers[inner[i % inner.size()]][i / inner.size()]])] =
          moments[i];
  }
}
} // namespace

template <int dim>
std::vector<double> rigid_motions(const PrimalSpace<dim> &space)
{
  const unsigned int n = space.owned.n_elements();
  const Point<dim> centre = space.scene.geometry.centre();
  const double length = space.scene.geometry.radius();
  std::vector<double> result(n * n_motions<dim>, 0.);
  std::vector<types::global_dof_index> dofs;
  for (const auto &cell : space.dof_handler.active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const FESystem<dim> &fe = space.tables.take_dofs(cell, dofs).fe;
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
    const BoxTables<dim> &tables = space.tables.take_dofs(face.cell, dofs);
    const bool is_jump =
        space.condition(face.cell, face.face).pair.has_value(); // all bodies move alike
    if (face.is_curved() && !is_jump)
    {
      set_on_curved(space, face, result);
      continue;
    }
    for (unsigned int k = 0; k < tables.n_contact_dofs(); ++k)
    {
      const Tensor<1, dim> arm = space.contact[face.first() + k].centroid - centre;
      for (const unsigned int c : face.components())
        for (unsigned int m = 0; m < n_motions<dim>; ++m)
          result[m * n + space.owned.index_within_set(
                             dofs[tables.numbers[tables.inner[face.face][k]][c]])] =
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
