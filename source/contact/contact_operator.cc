// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/contact/contact_operator.h>

namespace hpvi
{
using namespace dealii;

namespace
{
/** `int psi_i phi_j t_c` for the multiplier's basis psi and the edge's shape functions phi, by Gauss. */
template <int dim>
FullMatrix<double> edge_rows(const ContactFace<dim> &face, const ShapeTables<dim> &tables)
{
  // psi_i phi_j has degree 2p - 2 for the thesis's offset, 2p + offset in general.
  const unsigned int p = face.degree, n_gauss = std::max(p, face.n_multipliers) + 1;
  const EdgeTable &table = tables.edge(p, face.n_multipliers, n_gauss);
  FullMatrix<double> B(face.n_multipliers, dim * (p + 1));
  for (unsigned int q = 0; q < n_gauss; ++q)
  {
    const ContactFrame<dim> frame = face.frame(tables.gauss(n_gauss).point(q)[0]);
    const double weight = tables.gauss(n_gauss).weight(q) * frame.measure;
    for (unsigned int i = 0; i < B.m(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int j = 0; j <= p; ++j)
          B(i, c * (p + 1) + j) +=
              weight * table.multipliers(q, i) * table.shapes(q, j) * frame.tangent[c];
  }
  return B;
}

/** May the nodes inside the edge move along the tangent, and are there as many of them as multipliers? */
template <int dim>
bool takes_moments(const ContactFace<dim> &face)
{
  return face.n_multipliers + 1 == face.degree && !face.condition->has_displacement();
}
} // namespace

template <int dim>
ContactOperator<dim>::ContactOperator(const DisplacementSpace<dim> &displacement_space,
                                      const ContactSpace<dim> &contact_space,
                                      const ShapeTables<dim> &tables)
    : space(displacement_space), multipliers(contact_space)
{
  for (const ContactFace<dim> &face : contact_space.faces())
    if (face.n_multipliers > 0)
    {
      Rows rows{&face,
                {},
                edge_rows(face, tables),
                takes_moments(face) ? &tables.nodes_from_moments(face.degree) : nullptr};
      const auto dofs = space.cell_dofs(face.cell->active_cell_index());
      for (const unsigned int i : tables.numbering(face.degree).edge[face.face_no])
        rows.dofs.push_back(dofs[i]);
      face_rows.push_back(std::move(rows));
    }
}

template <int dim>
Vector<double> ContactOperator<dim>::moments(const Vector<double> &u) const
{
  Vector<double> result(multipliers.n_multipliers());
  for (const Rows &rows : face_rows)
    for (unsigned int i = 0; i < rows.B.m(); ++i)
      for (unsigned int j = 0; j < rows.B.n(); ++j)
        result[rows.face->first_multiplier + i] += rows.B(i, j) * u[rows.dofs[j]];
  return result;
}

template <int dim>
Vector<double> ContactOperator<dim>::forces(const Vector<double> &z,
                                            const types::boundary_id only) const
{
  Vector<double> result(space.n_dofs());
  for (const Rows &rows : face_rows)
    if (only == numbers::invalid_boundary_id || only == rows.face->condition->id)
      for (unsigned int i = 0; i < rows.B.m(); ++i)
        for (unsigned int j = 0; j < rows.B.n(); ++j)
          result[rows.dofs[j]] += rows.B(i, j) * z[rows.face->first_multiplier + i];
  return result;
}

template <int dim>
const std::vector<typename ContactOperator<dim>::Rows> &ContactOperator<dim>::rows() const
{
  return face_rows;
}

template <int dim>
const ContactSpace<dim> &ContactOperator<dim>::contact_space() const
{
  return multipliers;
}

template class ContactOperator<2>;
} // namespace hpvi
