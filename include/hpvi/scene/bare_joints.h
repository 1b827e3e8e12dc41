// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_bare_joints_h
#define hpvi_bare_joints_h

#include <hpvi/scene/scene.h>

#include <array>
#include <string>
#include <vector>

namespace hpvi
{
/** Boundaries of two bodies that lie on each other, though no pair has them there. */
template <int dim>
struct BareJoint
{
  std::array<std::string, 2> sides; ///< their names; of edges without one that of the body
  dealii::Point<dim> at;            ///< a place where they do
};

/**
 * Of edges of the coarse mesh that meet no pair; not where both boundaries are held, for these do not come into each other. The
 * drawing counts: sides are on each other to 1e-9 of the size.
 */
std::vector<BareJoint<2>> bare_joints(const Scene<2> &scene);

/**
 * Boundaries of two bodies that lie on each other, or no farther apart than @p within, also where they touch in a point as a roller on a
 * plane; held or not, but not those of pairs.
 */
std::vector<BareJoint<2>> touching_sides(const Scene<2> &scene, double within);
std::vector<BareJoint<3>> touching_sides(const Scene<3> &scene, double within);
} // namespace hpvi

#endif
