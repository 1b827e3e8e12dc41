// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/primal/transfer.h>

#include <deal.II/base/utilities.h>

namespace hpvi
{
using namespace dealii;

template <int dim>
Transfer<dim>::Transfer(Mesh &mesh, const MomentSpace<dim> &space, const DistributedVector &u,
                        const std::vector<Tangential<dim>> &lambda)
    : mesh(mesh)
{
  // First the nodal values, then lambda face by face.
  const auto pack = [&space, &u, &lambda](const Cell &cell, const auto)
  {
    const typename MomentSpace<dim>::Cell dof_cell(*cell, &space.dof_handler);
    Vector<double> local(space.tables.fe.dofs_per_cell);
    dof_cell->get_dof_values(u, local);
    std::vector<double> data(local.begin(), local.end());
    const std::vector<bool> friction_faces = space.friction_faces(dof_cell);
    for (const unsigned int face : cell->face_indices())
      for (unsigned int k = 0; friction_faces[face] && k < space.tables.n_moments(); ++k)
        for (unsigned int s = 0; s < dim - 1; ++s)
          data.push_back(lambda[space.first_disc(dof_cell, face) + k][s]);
    return Utilities::pack(data, false);
  };
  handle = mesh.register_data_attach(pack, true);
}

template <int dim>
void Transfer<dim>::unpack(const MomentSpace<dim> &space, DistributedVector &u,
                           std::vector<Tangential<dim>> &lambda)
{
  u = space.ghosted_vector();
  lambda.assign(space.discs.size(), Tangential<dim>());
  const unsigned int n = space.tables.fe.dofs_per_cell;
  const auto take = [&](const Cell &cell, const auto status, const auto &range)
  {
    const auto data = Utilities::unpack<std::vector<double>>(range.begin(), range.end(), false);
    Vector<double> local(data.begin(), data.begin() + n);
    const std::vector<double> multiplier(data.begin() + n, data.end());
    const typename DoFHandler<dim>::cell_iterator dof_cell(*cell, &space.dof_handler);
    dof_cell->set_dof_values_by_interpolation(local, u);
    std::vector<bool> faces(GeometryInfo<dim>::faces_per_cell, false);
    for (const unsigned int face : cell->face_indices())
      faces[face] = cell->at_boundary(face) &&
                    space.scene.boundaries[cell->face(face)->boundary_id()].friction.bound;
    if (status == parallel::distributed::Triangulation<dim>::CELL_PERSIST)
      take_multiplier(space, cell, cell, faces, multiplier, lambda);
    else
      for (const Cell &child : cell->child_iterators())
        take_multiplier(space, child, cell, faces, multiplier, lambda);
  };
  mesh.notify_ready_to_unpack(handle, take);
  u.zero_out_ghost_values();
  u.update_ghost_values();
}

/** lambda of the parent, a polynomial of degree p-2 on each face, at the discs of a cell. */
template <int dim>
void Transfer<dim>::take_multiplier(const MomentSpace<dim> &space, const Cell &cell,
                                    const Cell &parent, const std::vector<bool> &parent_faces,
                                    const std::vector<double> &values,
                                    std::vector<Tangential<dim>> &lambda)
{
  const unsigned int n = space.tables.n_moments();
  const Tensor<1, dim> size = MomentSpace<dim>::extent(parent);
  unsigned int first = 0; // of the values on a face
  for (const unsigned int face : cell->face_indices())
  {
    if (!parent_faces[face])
      continue;
    const typename MomentSpace<dim>::Cell dof_cell(*cell, &space.dof_handler);
    for (unsigned int k = 0; cell->at_boundary(face) && k < n; ++k)
    {
      const unsigned int disc = space.first_disc(dof_cell, face) + k;
      Point<dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = (space.discs[disc].x[d] - parent->vertex(0)[d]) / size[d];
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int s = 0; s < dim - 1; ++s)
          lambda[disc][s] += values[first + j * (dim - 1) + s] * space.tables.psi(j, face, x);
    }
    first += n * (dim - 1);
  }
}

template class Transfer<2>;
template class Transfer<3>;
} // namespace hpvi
