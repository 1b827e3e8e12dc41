// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/space/contact_dof_transform.h>

#include <algorithm>
#include <map>

namespace hpvi
{
using namespace dealii;

template <typename Number>
void ContactDofTransform<Number>::resolve(const PrimalSpace<3> &space, const Vector &pattern,
                                          const types::global_dof_index dof,
                                          const std::function<void(unsigned int, double)> &take)
{
  const Utilities::MPI::Partitioner &partitioner = *pattern.get_partitioner();
  if (!space.constraints.is_constrained(dof))
    take(partitioner.global_to_local(dof), 1.);
  else
    for (const auto &[other, weight] : *space.constraints.get_constraint_entries(dof))
      take(partitioner.global_to_local(other), weight);
}

template <typename Number>
ContactDofTransform<Number>::ContactDofTransform(const PrimalSpace<3> &space, const Vector &pattern)
{
  if (space.opposite)
    values = &space.opposite->unknowns();
  if (space.faces.empty())
    return;
  const auto add_matrices = [this](const FaceContactDofs &contact_dofs)
  {
    matrices.emplace_back();
    for (unsigned int k = 0; k < contact_dofs.M.m(); ++k)
      for (unsigned int j = 0; j < contact_dofs.M.n(); ++j)
      {
        matrices.back().M.push_back(contact_dofs.M(k, j));
        matrices.back().M_inverse.push_back(contact_dofs.M_inverse(k, j));
      }
  };
  for (const BoxTables<3> &tables : space.tables.all)
    add_matrices(tables.contact_dofs);
  for (const ContactDofFace<3> &face : space.faces)
  {
    if (face.own)
      add_matrices(*face.own);
    add(space, pattern, face, face.own ? matrices.size() - 1 : space.tables.number_of(face.cell));
  }
}

template <typename Number>
void ContactDofTransform<Number>::add(const PrimalSpace<3> &space, const Vector &pattern,
                                      const ContactDofFace<3> &face, const unsigned int matrix)
{
  const FaceContactDofs &contact_dofs = space.contact_dofs_on(face);
  FullMatrix<double> C(contact_dofs.M.m(), contact_dofs.W.n());
  contact_dofs.M_inverse.mmult(C, contact_dofs.W);
  if (face.is_curved())
  {
    add_row(space, pattern, face, face.components(), C, matrix);
    if (values)
      add_opposite(space, &face - space.faces.data(), std::nullopt, contact_dofs.M_inverse);
    return;
  }
  if (face.axes.is_rotated())
  {
    turns.push_back({static_cast<unsigned int>(contact_dofs.M.m()),
                     static_cast<unsigned int>(inner.size()),
                     {}});
    for (unsigned int own = 0; own < 3; ++own)
      for (unsigned int c = 0; c < 3; ++c)
        turns.back().directions[own][c] = face.direction(own)[c];
  }
  for (const unsigned int axis : face.components())
  {
    add_row(space, pattern, face, {axis}, C, matrix);
    if (values)
      add_opposite(space, &face - space.faces.data(), axis, contact_dofs.M_inverse);
  }
}

template <typename Number>
void ContactDofTransform<Number>::add_row(const PrimalSpace<3> &space, const Vector &pattern,
                                          const ContactDofFace<3> &face,
                                          const std::vector<unsigned int> &components,
                                          const FullMatrix<double> &C, const unsigned int matrix)
{
  std::vector<types::global_dof_index> dofs;
  const BoxTables<3> &tables = space.tables.take_dofs(face.cell, dofs);
  const auto &inner_shapes = tables.inner[face.face], &rim_shapes = tables.rim[face.face];
  std::map<unsigned int, std::vector<double>> columns;
  for (unsigned int j = 0; j < C.n(); ++j)
    resolve(
        space, pattern,
        dofs[tables.numbers[rim_shapes[j % rim_shapes.size()]][components[j / rim_shapes.size()]]],
        [&](const unsigned int local, const double weight)
        {
          std::vector<double> &column = columns[local];
          column.resize(C.m());
          for (unsigned int k = 0; k < C.m(); ++k)
            column[k] -= weight * C(k, j);
        });
  rows.push_back({static_cast<unsigned int>(C.m()), static_cast<unsigned int>(inner.size()),
                  static_cast<unsigned int>(rim.size()), static_cast<unsigned int>(columns.size()),
                  matrix, to_inner.size()});
  largest = std::max<unsigned int>(largest, C.m());
  for (const unsigned int component : components)
    for (const unsigned int shape : inner_shapes)
      inner.push_back(
          pattern.get_partitioner()->global_to_local(dofs[tables.numbers[shape][component]]));
  for (const auto &[local, column] : columns)
  {
    rim.push_back(local);
    to_inner.insert(to_inner.end(), column.begin(), column.end());
  }
}

/** To the last row, which is one of the face of this number; of a curved face, without @p axis, that of all components. */
template <typename Number>
void ContactDofTransform<Number>::add_opposite(const PrimalSpace<3> &space, const unsigned int face,
                                               const std::optional<unsigned int> axis,
                                               const FullMatrix<double> &M_inverse)
{
  std::map<unsigned int, std::vector<double>> columns;
  const unsigned int n = M_inverse.m();
  for (const OppositeFaces::Row &opposite : (*space.opposite)[face].rows)
    for (unsigned int c = axis.value_or(0); c <= axis.value_or(2); ++c)
      for (const auto &[unknown, weight] : space.opposite->nodes[opposite.node].entries[c])
      {
        std::vector<double> &column = columns[values->place(unknown)];
        column.resize(n);
        for (unsigned int k = 0; k < n; ++k)
          for (unsigned int j = 0; j < n; ++j)
            column[k] +=
                weight * M_inverse(k, j) * (axis ? opposite.moments[j] : opposite.turned[j][c]);
      }
  rows.back().first_far = far.size();
  rows.back().n_far = columns.size();
  rows.back().first_far_entry = far_to_inner.size();
  for (const auto &[place, column] : columns)
  {
    far.push_back(place);
    far_to_inner.insert(far_to_inner.end(), column.begin(), column.end());
  }
}

/** Components along the directions of faces to those along axes, or back. */
template <typename Number>
void ContactDofTransform<Number>::turn(Vector &v, const bool to_axes) const
{
  for (const Turn &turn : turns)
    for (unsigned int n = turn.n, k = 0; k < n; ++k)
    {
      std::array<Number, 3> old, turned{};
      for (unsigned int c = 0; c < 3; ++c)
        old[c] = v.local_element(inner[turn.first_inner + c * n + k]);
      for (unsigned int own = 0; own < 3; ++own)
        for (unsigned int c = 0; c < 3; ++c)
          turned[to_axes ? c : own] += turn.directions[own][c] * old[to_axes ? own : c];
      for (unsigned int c = 0; c < 3; ++c)
        v.local_element(inner[turn.first_inner + c * n + k]) = turned[c];
    }
}

// With `C = -M^-1 W` over the rim, and M^-1 R over what is opposite, T is `u_inner = M^-1 m + C u_rim`, its inverse `m = M (u_inner - C u_rim)`.
template <typename Number>
template <bool inverse>
void ContactDofTransform<Number>::transform(Vector &v) const
{
  if (values)
    values->take(v.begin(), exchanged);
  if (!inverse)
    turn(v, true);
  std::vector<Number> old(largest), rest(largest);
  for (const Row &row : rows)
  {
    const unsigned int n = row.n;
    for (unsigned int k = 0; k < n; ++k)
    {
      old[k] = v.local_element(inner[row.first_inner + k]);
      rest[k] = 0;
    }
    const std::vector<Number> &M = matrices[row.matrix].M,
                              &M_inverse = matrices[row.matrix].M_inverse;
    const Number *column = to_inner.data() + row.first_entry;
    for (unsigned int j = 0; j < row.n_rim; ++j, column += n)
    {
      const Number value = v.local_element(rim[row.first_rim + j]);
      for (unsigned int k = 0; k < n; ++k)
        rest[k] += column[k] * value;
    }
    column = far_to_inner.data() + row.first_far_entry;
    for (unsigned int j = 0; j < row.n_far; ++j, column += n)
    {
      const Number value = exchanged[far[row.first_far + j]];
      for (unsigned int k = 0; k < n; ++k)
        rest[k] += column[k] * value;
    }
    for (unsigned int k = 0; k < n; ++k)
    {
      Number sum = inverse ? 0 : rest[k];
      for (unsigned int j = 0; j < n; ++j)
        sum += inverse ? M[k * n + j] * (old[j] - rest[j]) : M_inverse[k * n + j] * old[j];
      v.local_element(inner[row.first_inner + k]) = sum;
    }
  }
  if (inverse)
    turn(v, false);
}

template <typename Number>
template <bool inverse>
void ContactDofTransform<Number>::transform_transposed(Vector &r) const
{
  if (inverse)
    turn(r, true);
  if (values)
    exchanged.assign(values->size(), 0);
  std::vector<Number> old(largest), on_rim(largest);
  for (const Row &row : rows)
  {
    const unsigned int n = row.n;
    for (unsigned int k = 0; k < n; ++k)
      old[k] = r.local_element(inner[row.first_inner + k]);
    const std::vector<Number> &M = matrices[row.matrix].M,
                              &M_inverse = matrices[row.matrix].M_inverse;
    for (unsigned int k = 0; k < n; ++k)
    {
      Number sum = 0;
      for (unsigned int j = 0; j < n; ++j)
        sum += (inverse ? M[j * n + k] : M_inverse[j * n + k]) * old[j];
      r.local_element(inner[row.first_inner + k]) = sum;
      on_rim[k] = inverse ? -sum : old[k];
    }
    const Number *column = to_inner.data() + row.first_entry;
    for (unsigned int j = 0; j < row.n_rim; ++j, column += n)
    {
      Number sum = 0;
      for (unsigned int k = 0; k < n; ++k)
        sum += column[k] * on_rim[k];
      r.local_element(rim[row.first_rim + j]) += sum;
    }
    column = far_to_inner.data() + row.first_far_entry;
    for (unsigned int j = 0; j < row.n_far; ++j, column += n)
    {
      Number sum = 0;
      for (unsigned int k = 0; k < n; ++k)
        sum += column[k] * on_rim[k];
      exchanged[far[row.first_far + j]] += sum;
    }
  }
  if (!inverse)
    turn(r, false);
  if (values)
    values->add(exchanged, r.begin());
}

template <typename Number>
void ContactDofTransform<Number>::to_nodes(Vector &v, std::vector<Number> *const kept) const
{
  v.update_ghost_values();
  if (kept)
  {
    kept->clear();
    for (const unsigned int i : inner)
      kept->push_back(v.local_element(i));
  }
  transform<false>(v);
}

template <typename Number>
void ContactDofTransform<Number>::restore(Vector &v, const std::vector<Number> &kept) const
{
  for (std::size_t k = 0; k < inner.size(); ++k)
    v.local_element(inner[k]) = kept[k];
  v.zero_out_ghost_values();
}

template <typename Number>
void ContactDofTransform<Number>::to_nodes_transposed(Vector &r) const
{
  transform_transposed<false>(r);
  r.compress(VectorOperation::add);
}

template <typename Number>
void ContactDofTransform<Number>::to_moments(Vector &v) const
{
  v.update_ghost_values();
  transform<true>(v);
  v.zero_out_ghost_values();
}

template <typename Number>
void ContactDofTransform<Number>::to_moments_transposed(Vector &r) const
{
  transform_transposed<true>(r);
  r.compress(VectorOperation::add);
}

template class ContactDofTransform<double>;
template class ContactDofTransform<float>;
} // namespace hpvi
