// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_load_check_h
#define hpvi_load_check_h

#include <hpvi/results/equilibrium.h>

#include <string>

namespace hpvi
{
/**
 * The loads of a scene on its coarse cells, by a rule at least four times finer per direction than that of the primal path, which
 * has p + 1 Gauss points and cuts nothing.
 */
template <int dim>
struct LoadCheck
{
  explicit LoadCheck(const Scene<dim> &scene);

  /** On coarse cells that are there. */
  LoadCheck(const Scene<dim> &scene, const dealii::Triangulation<dim> &mesh);

  dealii::Point<dim> centre; ///< of the body
  BoundaryForce<dim> sum;    ///< of all of them, for unit thickness
  double thickness = 1;
  bool has_plates = false; ///< whose forces are not among them
  double absolute = 0;     ///< of all their components, int |.| [stress length^(dim-1)]
  double size;             ///< of the body [length], the longest lever

  std::string worst;                   ///< where the rules differ most, as in "Traction on top"
  dealii::Point<dim> where;            ///< the middle of that face or cell
  dealii::Tensor<1, dim> force, finer; ///< there, by both rules

  /** As in "loads: force (0 0 -2), moment (0 0 0) about (1 1 1)", a line. */
  std::string in_words() const;

  /** That @p loads of a discrete problem differ from the sum by more than 1e-3 of all; else empty. */
  std::string warning(const BoundaryForce<dim> &loads) const;
};

/**
 * The same of initial strains by their stress C eps_0, which acts as a load: that of the cells of a discrete problem in all,
 * @p stresses [stress length^dim], differs from the finer rule by more than 1e-3 of all; else empty. @p mesh has the coarse cells.
 */
template <int dim>
std::string strain_warning(const Scene<dim> &scene, const dealii::Triangulation<dim> &mesh,
                           const dealii::Tensor<2, dim> &stresses);

/** And of springs by `int k_n` and `int k_t` over their faces [stress length^(dim-2)]. */
template <int dim>
std::string spring_warning(const Scene<dim> &scene, const dealii::Triangulation<dim> &mesh,
                           const dealii::Tensor<1, 2> &stiffness);
} // namespace hpvi

#endif
