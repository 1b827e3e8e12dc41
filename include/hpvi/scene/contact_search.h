// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_contact_search_h
#define hpvi_contact_search_h

#include <hpvi/scene/geometry.h>

#include <optional>
#include <string>

namespace hpvi
{
/** Where two straight sides face each other. */
struct FacingPart
{
  dealii::Tensor<1, 2> along; ///< the tangent of the first side
  double begin, end;          ///< x . along of the part that both have [length]
  double distance; ///< from the first to the second along the normal of the first [length]

  /** Positive where x lies opposite to both, its distance to the nearer end [length]. */
  double inside(const dealii::Point<2> &x) const;
};

/**
 * The part of two sides of bodies of @p size that lie opposite to each other. Nothing where they do not; @p problem says
 * why then, in words that go on after "the sides", or is empty where one bends or they are at an angle (edge_projection()).
 */
std::optional<FacingPart> contact_search(const Side<2> &first, const Side<2> &second, double size,
                                         std::string &problem);
} // namespace hpvi

#endif
