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

/** Two sides in space that face each other, before the bodies are one geometry. */
struct SpacePair
{
  std::string name, section;
  std::array<unsigned int, 2> bodies, sides; ///< by number, the side of its body
  std::array<std::string, 2> called;         ///< what `Between` calls them
  std::array<Expression<3>, 2> part;  ///< positive on the part that `Between` names; null: all
  std::array<Expression<3>, 2> where; ///< positive on faces that have the other side opposite
  /** From either side to the other along its normal [length]; null: they touch all along. */
  std::array<Expression<3>, 2> distance;
  std::optional<unsigned int> slave;
  std::string closed = {}; ///< what `Closed within` does, in words; empty: nothing
};

/** `Between` and `Slave` of @p section. Boxes of @p singles get grid lines where the other side ends. */
SpacePair read_space_pair(const Parameters &parameters, const std::string &section,
                          const std::string &name, const UserNames &names,
                          std::vector<Scene<3>> &singles);

/**
 * Which faces of either side lie opposite to the other, and at what distance, after the grid lines of all pairs. A side with faces of which a
 * part alone does is the master.
 */
void match_faces(const Parameters &parameters, const std::vector<Scene<3>> &singles,
                 SpacePair &pair);

/** A part of each of the two sides, as `Where` of a boundary would make it. */
void add_parts(const SpacePair &read, Scene<3> &scene);
} // namespace hpvi

#endif
