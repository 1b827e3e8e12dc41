// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_rigid_plate_h
#define hpvi_rigid_plate_h

#include <array>
#include <optional>

namespace hpvi
{
/**
 * A rigid plate that is glued to a boundary, as of a testing machine: `u = U + phi x (x - c)` there, c the mean point
 * of the undeformed boundary. Its motions are the components of U and those of the rotation phi, in the plane one,
 * counterclockwise; each is either prescribed or free under a force or, a rotation, a moment about c.
 */
template <int dim>
struct RigidPlate
{
  static constexpr unsigned int n_motions = dim * (dim + 1) / 2;
  std::array<std::optional<double>, n_motions> displacement; ///< [length], [rad]; nothing: free
  std::array<double, n_motions>
      force{}; ///< in all [stress length^(dim-1)], [stress length^dim]; in the plane of unit thickness

  bool is_free(const unsigned int motion) const
  {
    return !displacement[motion];
  }
};
} // namespace hpvi

#endif
