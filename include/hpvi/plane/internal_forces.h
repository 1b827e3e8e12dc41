// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_internal_forces_h
#define hpvi_internal_forces_h

#include <deal.II/lac/vector.h>
#include <hpvi/plane/displacement_space.h>
#include <hpvi/plane/element_matrices.h>

namespace hpvi
{
/** What the stress of a displacement does on all test functions. */
struct InternalForces
{
  dealii::Vector<double> forces; ///< a(u, v_i) for every displacement unknown, springs among them
  double energy_product = 0;     ///< a(u,u)
};

/**
 * `a(u, v_i) = int sigma(u) : eps(v_i)` and what springs add, formed from the strains of u at Gauss points. A product
 * with the stiffness matrix would be the same in exact arithmetic; in floating point it leaves
 * forces of the order of round-off times stiffness times displacement, which a slender or a far
 * displaced body turns into false deformation. Here the round-off of u becomes a stress, and
 * stresses are in balance on every cell.
 */
template <int dim>
InternalForces internal_forces(const Scene<dim> &scene, const DisplacementSpace<dim> &space,
                               const ShapeTables<dim> &tables, const dealii::Vector<double> &u,
                               Volume volume = Volume::full);
} // namespace hpvi

#endif
