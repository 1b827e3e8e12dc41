// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_deck_history_h
#define hpvi_deck_history_h

#include <hpvi/reader/deck/deck.h>

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace hpvi
{
/** A number of a support or a load over the time of a deck: linear between knots, of which two may have one time. */
struct DeckCourse
{
  std::vector<std::pair<double, double>> knots; ///< time, value
  std::set<std::string> names;                  ///< sets in which it is given, or lines
  std::string place;                            ///< where it stands first

  double last() const;
  double at(double time) const;
  bool is_zero() const;

  /** In t from 0 to 1, if @p with_time, times @p factor; else the last value. */
  std::string text(bool with_time, double factor = 1) const;
};

DeckCourse sum(const std::vector<DeckCourse> &courses);

/** What acts on a deck, with times from 0 to 1. */
struct DeckHistory
{
  using NodeComponent = std::pair<unsigned int, unsigned int>;

  /** On elements of a set: GRAV, CENTRIF, BX or BY with its numbers behind the magnitude. */
  struct BodyLoad
  {
    std::string kind;
    std::vector<unsigned int> elements;
    std::vector<double> numbers;
    DeckCourse course;
  };

  std::map<NodeComponent, DeckCourse> supports, forces;
  std::map<Deck::Face, DeckCourse> pressures;
  std::vector<BodyLoad> body_loads;
  std::map<unsigned int, DeckCourse> temperatures; ///< by node, those of the beginning included
  std::map<unsigned int, double> first_temperatures;
  unsigned int n_steps = 1; ///< of the scene
  bool has_time = false;    ///< does it take a history to say it?
};

/** Adds to @p deck what is left out. */
DeckHistory history_of(Deck &deck);
} // namespace hpvi

#endif
