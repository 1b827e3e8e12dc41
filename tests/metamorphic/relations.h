// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_metamorphic_relations_h
#define hpvi_metamorphic_relations_h

#include "outcome.h"
#include "random_scene.h"

#include <string>
#include <vector>

namespace metamorphic
{
/** What has to hold between two scenes. */
struct Relation
{
  enum class Claim
  {
    same,        ///< within tolerances
    same_primal, ///< the other one by the primal path
    same_moved,  ///< all but energies, to which a rigid motion adds the work of the loads
    overlapping  ///< intervals of energy
  };

  std::string name;
  RandomScene one, other;
  Frame frame; ///< that of the other; the first is told in its own
  Claim claim = Claim::same;
  Tolerances tolerances;

  /** What contradicts it, a line each. */
  std::vector<std::string> flaws(Outcome one, Outcome other) const;
};

/** All that must agree with @p scene, with random numbers where there is a choice. */
std::vector<Relation> relations(const RandomScene &scene, std::mt19937 &random);
} // namespace metamorphic

#endif
