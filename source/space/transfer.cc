// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/numbers.h>
#include <hpvi/space/transfer.h>

#include <deal.II/base/utilities.h>

namespace hpvi
{
using namespace dealii;

template <int dim>
CellValues values_on(const typename PrimalSpace<dim>::Cell &cell, const PrimalSpace<dim> &space,
                     const DistributedVector &u, const std::vector<ContactVector<dim>> &lambda)
{
  const BoxTables<dim> &tables = space.tables.of(cell);
  Vector<double> local(tables.fe.dofs_per_cell);
  cell->get_dof_values(u, local);
  CellValues result{{local.begin(), local.end()}, {}};
  for (const unsigned int number : cell->face_indices())
    if (const ContactDofFace<dim> *const face = space.moment_face(cell, number))
      for (const unsigned int first : {face->friction, face->pressure})
        for (unsigned int k = 0; first != none && k < tables.n_contact_dofs(); ++k)
          for (unsigned int s = 0; s < space.contact[first].n_unknowns(); ++s)
            result.lambda.push_back(lambda[first + k][s]);
  return result;
}

namespace
{
/** None: they are the same. */
template <int dim>
unsigned int child_number(const typename Triangulation<dim>::cell_iterator &cell,
                          const typename Triangulation<dim>::cell_iterator &parent)
{
  for (unsigned int c = 0; cell != parent && c < parent->n_children(); ++c)
    if (parent->child(c) == cell)
      return c;
  return none;
}

/** lambda of the parent, a polynomial of degree p-2 on each face, at the contact dofs of a cell. */
template <int dim>
void take_multiplier(const PrimalSpace<dim> &space,
                     const typename Triangulation<dim>::cell_iterator &cell,
                     const typename Triangulation<dim>::cell_iterator &parent,
                     const std::vector<bool> &parent_components, const std::vector<double> &values,
                     std::vector<ContactVector<dim>> &lambda)
{
  const BoxTables<dim> &tables = space.tables.of(cell);
  const unsigned int n = tables.n_contact_dofs();
  const unsigned int child = child_number<dim>(cell, parent);
  unsigned int first = 0; // of the values on a face
  for (const unsigned int number : cell->face_indices())
    for (const bool is_friction : {true, false})
    {
      const unsigned int axis = is_friction ? tangents<dim>(number)[0] : number / 2,
                         n_components = is_friction ? dim - 1 : 1;
      if (!parent_components[dim * number + axis])
        continue;
      const typename PrimalSpace<dim>::Cell dof_cell(*cell, &space.dof_handler);
      for (unsigned int k = 0; cell->at_boundary(number) && k < n; ++k)
      {
        const ContactDofFace<dim> &face = *space.moment_face(dof_cell, number);
        const unsigned int own = (is_friction ? face.friction : face.pressure) + k;
        const Point<dim> &own_x = tables.moment_points[number].points[k],
                         x = child == none
                                 ? own_x
                                 : GeometryInfo<dim>::child_to_cell_coordinates(own_x, child);
        for (unsigned int j = 0; j < n; ++j)
          for (unsigned int s = 0; s < n_components; ++s)
            lambda[own][s] += values[first + j * n_components + s] * tables.psi(j, number, x);
      }
      first += n * n_components;
    }
}

} // namespace

template <int dim>
void take_values(const typename Triangulation<dim>::cell_iterator &cell, const CellValues &values,
                 const PrimalSpace<dim> &space, DistributedVector &u,
                 std::vector<ContactVector<dim>> &lambda)
{
  const typename DoFHandler<dim>::cell_iterator dof_cell(*cell, &space.dof_handler);
  dof_cell->set_dof_values_by_interpolation(Vector<double>(values.u.begin(), values.u.end()), u,
                                            space.tables.number_of(cell));
  const std::vector<bool> components = space.moment_components(cell);
  if (cell->is_active())
    take_multiplier(space, cell, cell, components, values.lambda, lambda);
  else
    for (const auto &child : cell->child_iterators())
      take_multiplier(space, child, cell, components, values.lambda, lambda);
}

template <int dim>
Transfer<dim>::Transfer(Mesh &mesh, const PrimalSpace<dim> &space, const DistributedVector &u,
                        const std::vector<ContactVector<dim>> &lambda)
    : mesh(mesh)
{
  const auto pack = [&space, &u, &lambda](const Cell &cell, const auto)
  {
    const CellValues values =
        values_on(typename PrimalSpace<dim>::Cell(*cell, &space.dof_handler), space, u, lambda);
    std::vector<double> data = values.u;
    data.insert(data.end(), values.lambda.begin(), values.lambda.end());
    return Utilities::pack(data, false);
  };
  handle = mesh.register_data_attach(pack, true);
}

template <int dim>
void Transfer<dim>::unpack(const PrimalSpace<dim> &space, DistributedVector &u,
                           std::vector<ContactVector<dim>> &lambda)
{
  u = space.ghosted_vector();
  lambda.assign(space.contact.size(), ContactVector<dim>());
  const auto take = [&](const Cell &cell, const auto, const auto &range)
  {
    const auto data = Utilities::unpack<std::vector<double>>(range.begin(), range.end(), false);
    const unsigned int n = space.tables.of(cell).fe.dofs_per_cell;
    const CellValues values{{data.begin(), data.begin() + n}, {data.begin() + n, data.end()}};
    take_values(cell, values, space, u, lambda);
  };
  mesh.notify_ready_to_unpack(handle, take);
  u.zero_out_ghost_values();
  u.update_ghost_values();
}

template CellValues values_on(const typename PrimalSpace<2>::Cell &, const PrimalSpace<2> &,
                              const DistributedVector &, const std::vector<ContactVector<2>> &);
template CellValues values_on(const typename PrimalSpace<3>::Cell &, const PrimalSpace<3> &,
                              const DistributedVector &, const std::vector<ContactVector<3>> &);
template void take_values(const Triangulation<2>::cell_iterator &, const CellValues &,
                          const PrimalSpace<2> &, DistributedVector &,
                          std::vector<ContactVector<2>> &);
template void take_values(const Triangulation<3>::cell_iterator &, const CellValues &,
                          const PrimalSpace<3> &, DistributedVector &,
                          std::vector<ContactVector<3>> &);
template class Transfer<2>;
template class Transfer<3>;
} // namespace hpvi
