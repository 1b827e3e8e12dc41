// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_attack_drawn_scene_h
#define hpvi_attack_drawn_scene_h

#include <string>

namespace attack
{
/** A scene that is attacked, and the same problem as the reference is told it. */
struct DrawnScene
{
  std::string text, reference;
  bool shares_mesh; ///< its coarse one, but for grading: solutions can be compared cell by cell
};
} // namespace attack

#endif
