// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_resultant_h
#define hpvi_resultant_h

#include <hpvi/results/contact_state.h>
#include <hpvi/results/equilibrium.h>
#include <hpvi/results/interval.h>

#include <deal.II/base/types.h>

#include <array>
#include <string>
#include <vector>

namespace hpvi
{
/** What exerts a force on the body. */
enum class ForceKind
{
  support,   ///< prescribed displacements, symmetry, springs, plates
  contact,   ///< with a foundation or another body, and supports of the same boundary
  load,      ///< tractions, or the body force
  pretension ///< none: what both parts of a bolt exert on each other
};

/** The force that one boundary, part of a side or side of a pair exerts on the body in one way: a row of forces.csv. */
template <int dim>
struct Resultant
{
  static constexpr unsigned int n_moments = dim == 2 ? 1 : 3;

  std::string name; ///< of the boundary, or "body force"
  ForceKind kind = ForceKind::support;
  dealii::types::boundary_id boundary =
      dealii::numbers::invalid_boundary_id; ///< none: the body force
  std::array<Measured, dim> force{};        ///< [stress length^(dim-1)]; radial: NaN
  std::array<Measured, n_moments>
      moment{};           ///< about Equilibrium::centre [stress length^dim]; about an axis: NaN
  Measured normal = {};   ///< of contact: int T_n [stress length^(dim-1)]; of a cut its tension
  Measured friction = {}; ///< of contact: int T_t, in space the length of that vector; likewise
};

/**
 * Of each boundary, part of a side and side of a pair what it exerts, supports and contact first, then loads. Together they
 * balance. Without intervals.
 */
template <int dim>
std::vector<Resultant<dim>> resultants(const Scene<dim> &scene, const Equilibrium<dim> &equilibrium,
                                       const std::vector<ContactState<dim>> &contact);
} // namespace hpvi

#endif
