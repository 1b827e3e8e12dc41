// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_deck_scene_h
#define hpvi_deck_scene_h

#include <string>
#include <vector>

namespace hpvi
{
/** A deck as a scene. */
struct DeckScene
{
  std::string scene; ///< scene.prm, beside which the mesh stands as mesh.msh
  std::string mesh;
  std::vector<std::string> left_out; ///< FILE:LINE: what the scene does not say
  std::vector<std::string> meant;    ///< FILE:LINE: what it says in other words, and which
};

/** Throws InputError of one line. */
DeckScene import_deck(const std::string &path);
} // namespace hpvi

#endif
