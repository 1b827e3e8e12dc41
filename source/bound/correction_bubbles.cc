// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/bound/correction_search.h>
#include <hpvi/bound/legendre.h>

#include <map>

namespace hpvi
{
using namespace dealii;

namespace
{
/**
 * How many degrees edge bubbles have beyond the cell's. Measured: with eight the bound is a twentieth lower near
 * incompressibility, where it is harder to move in one cell; elsewhere by up to a twentieth, not worth their matrices.
 */
template <int dim>
unsigned int bubbles_on(const ContactFace<dim> &face, const Scene<dim> &scene)
{
  return scene.material_of(face.cell).is_nearly_incompressible(dim) ? 8 : 4;
}

/** Coefficients of P_{p+1+i} - P_{p-1+i}, which vanish at both ends: (p + 1 + n_bubbles) x n_bubbles. */
FullMatrix<double> bubble_coefficients(const unsigned int p, const unsigned int n_bubbles)
{
  FullMatrix<double> result(p + 1 + n_bubbles, n_bubbles);
  for (unsigned int i = 0; i < n_bubbles; ++i)
  {
    result(p + 1 + i, i) = 1. / legendre::root(p + 1 + i);
    result(p - 1 + i, i) = -1. / legendre::root(p - 1 + i);
  }
  return result;
}
} // namespace

/** Bubbles along the directions of some traces on the faces of a cell, as unknowns of these. */
template <int dim>
void CorrectionSearch<dim>::add_bubbles(const unsigned int cell,
                                        const std::vector<BubbleFace> &own_faces,
                                        EdgeBubbles &bubbles)
{
  unsigned int first = A.n();
  EdgeBubbles::Traces all;
  for (const auto &[face, directions] : own_faces)
  {
    const FullMatrix<double> coefficients =
        bubble_coefficients(face->degree, bubbles_on(*face, solution.scene));
    all.emplace_back(face, bubbles_at_nodes(coefficients, directions));
    for (const auto &[direction, trace] : directions)
    {
      trace->extend(coefficients, first);
      first += coefficients.n();
    }
  }
  add_columns(cell, bubbles.energies(all, solution.scene, solution.tables));
}

/** Bubbles with these coefficients, along each of the directions, at the nodes of their degree. */
template <int dim>
FullMatrix<double> CorrectionSearch<dim>::bubbles_at_nodes(const FullMatrix<double> &coefficients,
                                                           const Directions &directions) const
{
  const unsigned int n_bubbles = coefficients.n(), n_nodes = coefficients.m();
  FullMatrix<double> at_nodes(dim * n_nodes, directions.size() * n_bubbles);
  for (unsigned int node = 0; node < n_nodes; ++node)
  {
    const Vector<double> L =
        legendre_basis(n_nodes, solution.tables.gauss_lobatto(n_nodes).point(node)[0]);
    Vector<double> values(n_bubbles);
    coefficients.Tvmult(values, L);
    for (unsigned int d = 0; d < directions.size(); ++d)
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int i = 0; i < n_bubbles; ++i)
          at_nodes(c * n_nodes + node, d * n_bubbles + i) = directions[d].first[c] * values[i];
  }
  return at_nodes;
}

template <int dim>
void CorrectionSearch<dim>::add_columns(const unsigned int cell,
                                        const EdgeBubbles::Energies &energies)
{
  const auto dofs = solution.displacement_space.cell_dofs(cell);
  const unsigned int first = A.n();
  for (unsigned int i = 0; i < energies.own.n(); ++i)
  {
    std::map<unsigned int, double> column;
    for (unsigned int j = 0; j < energies.with_shapes.m(); ++j)
      for (const auto &[unknown, weight] : discretisation.unknowns.terms(dofs[j]))
        column[unknown] += weight * energies.with_shapes(j, i);
    for (unsigned int j = 0; j <= i; ++j)
      column[first + j] = energies.own(j, i);
    for (const auto &[row, value] : column)
    {
      A.border.row.push_back(row);
      A.border.value.push_back(value);
    }
    A.border.column_start.push_back(A.border.row.size());
    cell_of_bubble.push_back(cell);
  }
}

template void CorrectionSearch<2>::add_bubbles(unsigned int, const std::vector<BubbleFace> &,
                                               EdgeBubbles &);
} // namespace hpvi
