// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_probe_value_h
#define hpvi_probe_value_h

#include <hpvi/results/field.h>
#include <hpvi/results/interval.h>

#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <limits>
#include <vector>

namespace hpvi
{
/** A stress with all its components: in the plane [2][2] is that across it, or around the axis [stress]. */
using FullStress = dealii::SymmetricTensor<2, 3>;

/** `sqrt(3/2 s:s)` with the deviator s. */
double von_mises(const FullStress &stress);

/** The larger one first: `m +- r`, Mohr's circle; deal.II's discriminant of equal ones may be negative by round-off. */
std::array<double, 2> principal_values(const dealii::SymmetricTensor<2, 2> &tensor);

/** In the plane those in it, the larger first, and sigma_zz as it is; in space all three, the largest first. */
template <int dim>
std::array<double, 3> principal_stresses(const FullStress &stress);

/** What a probe says of a step, but for one along a line; NaN where no cell has the point. */
template <int dim>
struct ProbeValue
{
  unsigned int probe = 0;                   ///< index into Scene::probes
  std::array<Measured, dim> displacement{}; ///< u, or its mean [length]
  FullStress stress;                        ///< there, or its mean
};

/** u and stress at one point of a line; NaN where no cell has it. */
template <int dim>
struct LinePoint
{
  dealii::Point<dim> x;
  dealii::Tensor<1, dim> displacement; ///< [length]
  FullStress stress;
};

/** What a probe along a line says of a step. */
template <int dim>
struct ProbeLine
{
  unsigned int probe = 0; ///< index into Scene::probes
  std::vector<LinePoint<dim>> points;
};

/** A number with the point that has it. */
template <int dim>
struct PlacedValue
{
  double value = std::numeric_limits<double>::quiet_NaN();
  dealii::Point<dim> where;
};

/** Of each of Scene::probes but lines, in their order, without intervals. Collective. */
template <int dim>
std::vector<ProbeValue<dim>> probe_values(const Field<dim> &field);

/** Of each of Scene::probes along a line; where cells meet the mean of their values. Collective. */
template <int dim>
std::vector<ProbeLine<dim>> probe_lines(const Field<dim> &field);

/** |u_N| at the node of all cells where it is largest. Collective. */
template <int dim>
PlacedValue<dim> largest_displacement(const Field<dim> &field);
} // namespace hpvi

#endif
