// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/space/box_stiffness.h>
#include <hpvi/space/cell_basis.h>

#include <algorithm>
#include <map>

namespace hpvi
{
using namespace dealii;

bool has_opposite(const PrimalSpace<3> &space, const PrimalSpace<3>::Cell &cell)
{
  if (!space.opposite || !cell->at_boundary())
    return false;
  for (const unsigned int face : cell->face_indices())
    if (cell->at_boundary(face) && space.condition(cell, face).pair &&
        space.moment_face(cell, face))
      return true;
  return false;
}

namespace
{
/** By unknown and number of the cell. */
using Weights = std::map<CellBasis::Dof, std::map<unsigned int, double>>;

/** What the opposite nodes add to the inner ones of a face: `M^-1 R`. */
void add_opposite(const PrimalSpace<3> &space, const ContactDofFace<3> &face, Weights &weights)
{
  const FullMatrix<double> &M_inverse = space.contact_dofs_on(face).M_inverse;
  const BoxTables<3> &tables = space.tables.of(face.cell);
  const unsigned int n = tables.n_contact_dofs();
  const auto &rows = (*space.opposite)[&face - space.faces.data()].rows;
  if (face.is_curved())
  {
    for (const OppositeFaces::Row &row : rows)
      for (unsigned int i = 0; i < 3 * n && !row.turned.empty(); ++i)
        for (unsigned int c = 0; c < 3; ++c)
        {
          double weight = 0;
          for (unsigned int j = 0; j < 3 * n; ++j)
            weight += M_inverse(i, j) * row.turned[j][c];
          for (const auto &[unknown, part] : space.opposite->nodes[row.node].entries[c])
            weights[unknown][tables.numbers[tables.inner[face.face][i % n]][i / n]] +=
                part * weight;
        }
    return;
  }
  for (const OppositeFaces::Row &row : rows)
    for (unsigned int k = 0; k < n; ++k)
    {
      double weight = 0;
      for (unsigned int j = 0; j < n; ++j)
        weight += M_inverse(k, j) * row.moments[j];
      for (const unsigned int c : face.components())
        for (const auto &[unknown, part] : space.opposite->nodes[row.node].entries[c])
          weights[unknown][tables.numbers[tables.inner[face.face][k]][c]] += part * weight;
    }
}
} // namespace

CellBasis cell_basis(const PrimalSpace<3> &space, const PrimalSpace<3>::Cell &cell)
{
  std::vector<CellBasis::Dof> dofs;
  space.tables.take_dofs(cell, dofs);
  const unsigned int n = dofs.size();
  const FullMatrix<double> T = basis_of_moments(space, cell);
  Weights weights;
  const auto add = [&](const CellBasis::Dof unknown, const unsigned int j, const double part)
  {
    for (unsigned int i = 0; i < n; ++i)
      if (T(i, j) != 0)
        weights[unknown][i] += part * T(i, j);
  };
  for (unsigned int j = 0; j < n; ++j)
    if (!space.constraints.is_constrained(dofs[j]))
      add(dofs[j], j, 1.);
    else
      for (const auto &[unknown, part] : *space.constraints.get_constraint_entries(dofs[j]))
        add(unknown, j, part);
  for (const unsigned int number : cell->face_indices())
    if (const ContactDofFace<3> *const face = space.moment_face(cell, number))
      add_opposite(space, *face, weights);
  CellBasis result;
  for (const auto &[unknown, column] : weights)
  {
    result.unknowns.push_back(unknown);
    result.columns.emplace_back(column.begin(), column.end());
  }
  return result;
}

FullMatrix<double> CellBasis::transformed(const FullMatrix<double> &K) const
{
  FullMatrix<double> result(unknowns.size(), unknowns.size());
  std::vector<double> product(K.m());
  for (unsigned int J = 0; J < columns.size(); ++J)
  {
    std::fill(product.begin(), product.end(), 0.);
    for (const auto &[j, w_j] : columns[J])
      for (unsigned int i = 0; i < product.size(); ++i)
        product[i] += w_j * K(i, j);
    for (unsigned int I = 0; I < columns.size(); ++I)
      for (const auto &[i, w_i] : columns[I])
        result(I, J) += w_i * product[i];
  }
  return result;
}

std::vector<double> CellBasis::diagonal(const FullMatrix<double> &K) const
{
  std::vector<double> result;
  for (const auto &column : columns)
  {
    double sum = 0;
    for (const auto &[i, w_i] : column)
      for (const auto &[j, w_j] : column)
        sum += w_i * K(i, j) * w_j;
    result.push_back(sum);
  }
  return result;
}
} // namespace hpvi
