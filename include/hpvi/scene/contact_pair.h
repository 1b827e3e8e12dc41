// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_contact_pair_h
#define hpvi_contact_pair_h

#include <deal.II/base/types.h>

#include <array>
#include <optional>
#include <string>

namespace hpvi
{
/**
 * Two sides of bodies that touch along a line or a curve. The boundaries that face each other are parts of these sides, and
 * their conditions say which law holds between them; both say the same.
 */
struct ContactPair
{
  std::string name;
  std::array<unsigned int, 2> sides; ///< by number, in the order of `Between`
  /** The parts of these sides that face each other: whole edges on either, with ends opposite to each other. */
  std::array<dealii::types::boundary_id, 2> parts;
  /** Which of the two has the multipliers; nothing: on each mesh the one with more of them. */
  std::optional<unsigned int> slave = std::nullopt;
};
} // namespace hpvi

#endif
