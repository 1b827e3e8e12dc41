// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_solution_h
#define hpvi_solution_h

#include <deal.II/lac/vector.h>
#include <hpvi/body/displacement_space.h>
#include <hpvi/body/shape_tables.h>
#include <hpvi/contact/contact_space.h>

namespace hpvi
{
/** The discrete solution (u_N, lambda_N) of Problem 5.1 and the spaces it lives in. */
template <int dim>
struct Solution
{
  const Scene<dim> &scene;
  const DisplacementSpace<dim> &displacement_space;
  const ContactSpace<dim> &contact_space;
  dealii::Vector<double> u;      ///< all displacement unknowns, constrained ones included [length]
  dealii::Vector<double> lambda; ///< multiplier unknowns, dimensionless

  /**
   * Coefficients of u_N on one cell in the scalar FE_Q(p_K), component by component: entry
   * [c * n_shapes + i] belongs to component c and scalar shape function i.
   */
  std::vector<double> coefficients(unsigned int cell, const LocalNumbering &numbering) const
  {
    const auto dofs = displacement_space.cell_dofs(cell);
    const unsigned int n_shapes = dofs.size() / dim;
    std::vector<double> local(dofs.size());
    for (unsigned int i = 0; i < dofs.size(); ++i)
      local[numbering.component[i] * n_shapes + numbering.shape[i]] = u[dofs[i]];
    return local;
  }
};
} // namespace hpvi

#endif
