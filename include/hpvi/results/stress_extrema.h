// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_stress_extrema_h
#define hpvi_stress_extrema_h

#include <hpvi/results/field.h>

#include <vector>

namespace hpvi
{
/** A contact pressure, or von Mises' stress, at one point. */
template <int dim>
struct StressSample
{
  dealii::types::boundary_id boundary; ///< of the contact; invalid_boundary_id: von Mises' stress
  double value;                        ///< [stress]
  dealii::Point<dim> where;
  double
      length; ///< of the contact edge, or the longest one of the cell, on which it is the largest

  template <class Archive>
  void serialize(Archive &archive, unsigned int)
  {
    archive &boundary &value &where &length;
  }
};

/** `sqrt(3/2 s:s)` with the deviator s; plane strain holds sigma_zz as well, with an initial strain @p e33 across it. */
template <int dim>
double von_mises(const Material &material, const dealii::SymmetricTensor<2, dim> &sigma,
                 double e33 = 0);

/**
 * The largest pressure on each contact edge, where it presses, and von Mises' stress in each cell, at about
 * half as many Gauss points as u_N has nodes in a direction. On each process its own ones and the
 * stress_extrema() of the others. Collective.
 */
template <int dim>
std::vector<StressSample<dim>> stress_samples(const Field<dim> &field);

/** Within how much of a peak nothing is another one: 1 % of the body, or two of its edges. */
template <int dim>
double reach(const StressSample<dim> &peak, const Scene<dim> &scene);

/**
 * Of each contact boundary and of the body the three largest samples that are out of reach of each other,
 * the largest first.
 */
template <int dim>
std::vector<StressSample<dim>> stress_extrema(const std::vector<StressSample<dim>> &samples,
                                              const Scene<dim> &scene);
} // namespace hpvi

#endif
