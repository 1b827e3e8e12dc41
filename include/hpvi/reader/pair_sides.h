// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_pair_sides_h
#define hpvi_pair_sides_h

#include <hpvi/reader/user_names.h>
#include <hpvi/scene/boundary_parts.h>
#include <hpvi/scene/contact_search.h>
#include <hpvi/scene/scene.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace hpvi
{
class Parameters;

/** A side of a body, `BODY.side`, or a part of one, `Boundary NAME` with `On` and `Where`. */
struct NamedSide
{
  std::string name;
  unsigned int body, side;
  Expression<2> where = nullptr; ///< positive on the part; null: all of the side

  bool has(const CoarseFace<2> &face) const;
};

/** Of all bodies, and behind them the parts in @p names. */
std::vector<NamedSide> named_sides(const Parameters &parameters, const UserNames &names,
                                   const std::vector<Scene<2>> &singles);

/** The two sides of a pair before the bodies are one geometry. */
struct PairSides
{
  std::string name, section;
  std::array<NamedSide, 2> sides;
  std::array<Expression<2>, 2>
      where; ///< of either side positive on its edges in the pair, else not
  /** From either side to the other along its normal [length]; null: they touch all along. */
  std::array<Expression<2>, 2> distance;
  std::optional<unsigned int> slave;
  std::optional<FacingPart> line = std::nullopt; ///< of straight sides that are parallel
  std::string closed = {}; ///< what `Closed within` does, in words; empty: it is 0
};

/**
 * `Between`, `Closed within` and `Slave` of @p section, and where straight sides that are parallel face each other. Boxes of @p singles get grid
 * lines where the other side ends opposite to an edge. An edge of another shape may hang over that end; its side is the master then, for a
 * multiplier there would press where nobody is.
 */
PairSides read_pair_sides(const Parameters &parameters, const std::string &section,
                          const std::string &name, const std::vector<NamedSide> &sides,
                          std::vector<Scene<2>> &singles);

/**
 * Grid lines that boxes have got where parts, materials and other sides end go on in the boxes beside them, as far as these match but for such
 * lines: what has a bound without a part of a side has one with it.
 */
void carry_on_cuts(const std::vector<PairSides> &pairs, std::vector<Scene<2>> &singles);

/** Where the others do, edge by edge; after the grid lines of all pairs. */
void match_edges(const Parameters &parameters, std::vector<Scene<2>> &singles, PairSides &pair);

/** Each edge belongs to one pair. */
void check_overlap(const Parameters &parameters, const std::vector<PairSides> &pairs);

/** A part of each of the two sides, as `Where` of a boundary would make it. */
void add_parts(const PairSides &read, Scene<2> &scene);
} // namespace hpvi

#endif
