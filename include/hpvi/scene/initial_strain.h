// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_initial_strain_h
#define hpvi_initial_strain_h

#include <deal.II/base/point.h>
#include <hpvi/scene/expression.h>

#include <array>
#include <optional>

namespace hpvi
{
/** Tensor components of a strain (e12 is half the angle): in and across the plane e11, e22, e12, e33; in space e11, e22, e33, e12, e13, e23. */
template <int dim>
using StrainComponents = std::array<double, dim == 2 ? 4 : 6>;

using PlaneStrain = StrainComponents<2>;

/** Their names in messages. */
template <int dim>
const std::array<const char *, dim == 2 ? 4 : 6> &strain_names();

/** The strain eps_0 of a material that carries no stress: stresses are `C : (eps - eps_0)`. */
template <int dim>
struct InitialStrain
{
  std::array<Expression<dim>, dim == 2 ? 4 : 6>
      components;              ///< as StrainComponents has them; null: zero
  double expansion = 0;        ///< alpha [1/temperature], in all directions
  Expression<dim> temperature; ///< difference to the state without stress; null: zero

  std::optional<StrainComponents<dim>>
      shortening; ///< what a Pretension adds to these; nothing: there is none

  explicit operator bool() const;

  StrainComponents<dim> value(const dealii::Point<dim> &x) const;
};
} // namespace hpvi

#endif
