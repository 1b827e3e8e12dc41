// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/admissibility/nodal_displacement.h>

namespace hpvi
{
using namespace dealii;

template <int dim>
void NodalDisplacement<dim>::set(const ContactFace<dim> &face, const Tensor<1, dim> &direction,
                                 const std::function<double(double)> &wanted)
{
  const auto dofs = solution.displacement_space.cell_dofs(face.cell->active_cell_index());
  const std::vector<unsigned int> &on_edge =
      solution.tables.numbering(face.degree).edge[face.face_no];
  const unsigned int n = face.degree + 1;
  for (unsigned int j = 0; j < n; ++j)
  {
    const auto [place, is_new] = heeded.try_emplace(dofs[on_edge[j]], direction);
    const Tensor<1, dim> &other = place->second;
    const Tensor<1, dim> step = is_new ? direction : direction - (direction * other) * other;
    if (step.norm() < 1e-6) // the face before this one has set it
      continue;
    double missing = wanted(solution.tables.gauss_lobatto(n).point(j)[0]);
    for (unsigned int c = 0; c < dim; ++c)
      missing -= direction[c] * u[dofs[on_edge[c * n + j]]];
    for (unsigned int c = 0; c < dim; ++c)
      if (const auto dof = dofs[on_edge[c * n + j]]; unknowns.terms(dof).size() > 0)
        u[dof] += missing / (direction * step) * step[c];
  }
}

template class NodalDisplacement<2>;
} // namespace hpvi
