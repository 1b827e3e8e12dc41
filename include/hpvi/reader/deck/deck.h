// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_deck_h
#define hpvi_deck_h

#include <hpvi/reader/deck/deck_cards.h>
#include <hpvi/scene/material.h>

#include <deal.II/base/point.h>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace hpvi
{
/** What stands in a deck, with the places where it does: mesh, names, materials, contact. Its steps are in DeckHistory. */
struct Deck
{
  struct Node
  {
    std::int64_t number;
    dealii::Point<2> at;
  };

  struct Element
  {
    std::int64_t number;
    std::vector<unsigned int> nodes; ///< indices: corners, then middles of edges
    unsigned int n_corners;
    PlaneModel plane;
    std::string place;
    std::string section = {}; ///< key of its set in sections; empty: none

    unsigned int corner(unsigned int k) const
    {
      return nodes[k % n_corners];
    }

    /** Nodes of an edge: its ends, and its middle if it has one. */
    std::vector<unsigned int> edge(unsigned int k) const;
  };

  using Face = std::pair<unsigned int, unsigned int>; ///< element, edge from 0 on

  struct Elastic
  {
    std::string name, place;
    double E = 0, nu = 0, density = 0, expansion = 0;
    std::optional<std::array<double, 9>>
        orthotropic; ///< E1, E2, E3, nu12, nu13, nu23, G12, G13, G23
  };

  struct Section
  {
    std::string material, place;
    double thickness, angle; ///< of axis 1 [degrees]
  };

  struct Interaction
  {
    double friction = 0, most_friction = 0; ///< of Coulomb; its limit, 0: none
    bool is_tied = false, sticks_together = false;
  };

  struct Pair
  {
    std::array<std::string, 2> surfaces; ///< keys, the slave first
    std::string interaction, place;
    double closed_within = 0, clearance = 0;
    bool is_tied = false;
  };

  std::string title, path;
  std::vector<Node> nodes;
  std::vector<Element> elements;
  std::map<std::string, std::vector<unsigned int>> node_sets, element_sets; ///< by name in capitals
  std::map<std::string, std::vector<Face>> surfaces;
  std::map<std::string, std::string> spelling; ///< names as they are written first
  std::map<std::string, Elastic> materials;
  std::map<std::string, Section> sections; ///< by element set
  std::map<std::string, Interaction> interactions;
  std::vector<Pair> pairs;
  std::map<std::string, double> orientations; ///< of axis 1 [degrees]
  std::map<unsigned int, dealii::Tensor<1, 2>>
      axes;                          ///< axis 1 of nodes whose supports have their own
  std::vector<DeckCard> history;     ///< cards of supports, loads and steps, in their order
  std::vector<std::string> left_out; ///< FILE:LINE: what the scene does not say
  std::vector<std::string> meant;    ///< what it says in other words

  std::vector<Face> outer_faces() const; ///< of one element alone
  double size() const;

  /** The nodes that a word means, a number or the name of a set. Throws InputError. */
  std::vector<unsigned int> nodes_called(const DeckCard::Row &row, std::size_t index) const;
  std::vector<unsigned int> elements_called(const DeckCard::Row &row, std::size_t index) const;

  std::map<std::string, unsigned int> node_numbers,
      element_numbers; ///< indices by number, INSTANCE.number of an assembly
};

/** Faces of a surface, or edges between nodes of a set, of those @p outer. */
std::vector<Deck::Face> faces_between(const Deck &deck, const std::vector<unsigned int> &nodes,
                                      const std::vector<Deck::Face> &outer);

/** Throws InputError of one line for what is damaged, or stands in space. */
Deck read_deck(const std::string &path);
} // namespace hpvi

#endif
