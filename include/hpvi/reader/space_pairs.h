// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_space_pairs_h
#define hpvi_space_pairs_h

#include <hpvi/reader/user_names.h>
#include <hpvi/scene/scene.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace hpvi
{
class Parameters;

/** Two sides of boxes that face each other, before the bodies are one geometry. */
struct SpacePair
{
  std::string name, section;
  std::array<unsigned int, 2> bodies, sides; ///< by number, the side of its body
  std::array<std::string, 2> called;         ///< what `Between` calls them
  /** Positive where both sides lie opposite to each other, and on a part of one that `Between` names. */
  std::array<Expression<3>, 2> where;
  double distance = 0; ///< from the one to the other [length]
  std::optional<unsigned int> slave;
  std::string closed = {}; ///< what `Closed within` does, in words; empty: nothing
};

/**
 * `Between`, `Closed within` and `Slave` of @p section. The boxes of @p singles get grid lines where the part that lies opposite
 * ends.
 */
SpacePair read_space_pair(const Parameters &parameters, const std::string &section,
                          const std::string &name, const UserNames &names,
                          std::vector<Scene<3>> &singles);

/** A part of each of the two sides, as `Where` of a boundary would make it. */
void add_parts(const SpacePair &read, Scene<3> &scene);
} // namespace hpvi

#endif
