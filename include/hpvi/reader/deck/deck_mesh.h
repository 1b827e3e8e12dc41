// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_deck_mesh_h
#define hpvi_deck_mesh_h

#include <hpvi/reader/deck/deck.h>
#include <hpvi/reader/gmsh/gmsh_file.h>

#include <string>
#include <vector>

namespace hpvi
{
/** A name as sections of a scene have them: letters, digits, '_', '-' and single blanks. */
std::string scene_name(const std::string &name);

/** Edges with a name. */
struct NamedFaces
{
  std::string name;
  std::vector<Deck::Face> faces;
};

/** Nodes, cells in surfaces by name, and edges; @p surfaces are those of elements. */
GmshFile mesh_of_deck(const Deck &deck, const std::vector<std::string> &surfaces,
                      const std::vector<NamedFaces> &curves);

/**
 * What `Shape = file` takes of a deck: elements by the sets of their sections, edges by *SURFACE and *NSET, of several the one
 * with the fewest edges.
 */
GmshFile read_deck_mesh(const std::string &path);

/** As a mesh file of Gmsh, 2.2 in ASCII, as read_gmsh_file() reads it. */
std::string mesh_text(const GmshFile &file);
} // namespace hpvi

#endif
