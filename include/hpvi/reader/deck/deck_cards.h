// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_deck_cards_h
#define hpvi_deck_cards_h

#include <hpvi/reader/gmsh/mesh_complaint.h>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace hpvi
{
/** A keyword of a deck of CalculiX or Abaqus with its options and the rows behind it. */
struct DeckCard
{
  struct Row
  {
    std::vector<std::string> words; ///< between commas
    std::size_t line;
    std::string file; ///< that includes may change within a card
  };

  std::string keyword;                        ///< in capitals, without the star
  std::map<std::string, std::string> options; ///< by name in capitals; values as they are written
  std::vector<Row> rows;
  std::string file;
  std::size_t line;

  bool has(const std::string &option) const;
  std::string value(const std::string &option) const; ///< empty where it has none
  std::string place() const;                          ///< FILE:LINE
  [[noreturn]] void refuse_card(const std::string &problem_and_remedy) const;
};

/** The word with this @p index; empty where the row has no more. */
std::string word_of(const DeckCard::Row &row, std::size_t index);

/** The number there, @p otherwise where nothing stands. Throws InputError where it is none. */
double number_of(const DeckCard::Row &row, std::size_t index, double otherwise = 0);

std::string place_of(const DeckCard::Row &row);
[[noreturn]] void refuse_row(const DeckCard::Row &row, const std::string &problem_and_remedy);

/** A deck line by line, with what it includes. Throws InputError of one line. */
std::vector<DeckCard> read_deck_cards(const std::string &path);

/** Does a text begin as decks do? */
bool looks_like_deck(const std::string &beginning);

std::string upper_case(std::string text);
} // namespace hpvi

#endif
