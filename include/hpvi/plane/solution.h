// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_solution_h
#define hpvi_solution_h

#include <deal.II/lac/vector.h>
#include <hpvi/plane/discretisation.h>

namespace hpvi
{
/**
 * The discrete solution (u_N, z_N) of Problem 5.1, z_N = g lambda_N, and the spaces it lives in, which
 * live as long as it does. The scene must outlive it.
 */
template <int dim>
struct Solution
{
  Solution(const Scene<dim> &scene, std::shared_ptr<const Spaces<dim>> all_spaces,
           dealii::Vector<double> u, dealii::Vector<double> z)
      : scene(scene), spaces(std::move(all_spaces)), displacement_space(spaces->displacement_space),
        contact_space(spaces->contact_space), tables(*spaces->tables), u(std::move(u)),
        z(std::move(z))
  {
  }

  /** The same values where contact is @p other, which has the same unknowns, in the place of that of the spaces. */
  Solution(const Solution &solution, std::shared_ptr<const ContactSpace<dim>> other)
      : scene(solution.scene), spaces(solution.spaces), own_contact(std::move(other)),
        displacement_space(spaces->displacement_space), contact_space(*own_contact),
        tables(*spaces->tables), u(solution.u), z(solution.z), own_scene(solution.own_scene)
  {
  }

  const Scene<dim> &scene;
  const std::shared_ptr<const Spaces<dim>> spaces;
  const std::shared_ptr<const ContactSpace<dim>> own_contact; ///< null: that of the spaces
  const DisplacementSpace<dim> &displacement_space;           ///< of spaces, like tables
  const ContactSpace<dim> &contact_space;
  const ShapeTables<dim> &tables;
  dealii::Vector<double> u; ///< all displacement unknowns, constrained ones included [length]
  dealii::Vector<double> z; ///< friction traction at the Gauss points, `T_t = -z` [stress]
  /** Of the scene and that of the spaces, where they are a step's own; null: somebody else keeps them. */
  std::shared_ptr<const Scene<dim>> own_scene;

  /**
   * Coefficients of u_N on one cell in the scalar FE_Q(p_K), component by component: entry
   * [c * n_shapes + i] belongs to component c and scalar shape function i.
   */
  std::vector<double> coefficients(const unsigned int cell) const
  {
    const LocalNumbering &numbering = tables.numbering(displacement_space.degrees()[cell]);
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
