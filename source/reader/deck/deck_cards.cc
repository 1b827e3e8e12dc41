// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/file_format.h>
#include <hpvi/base/text.h>
#include <hpvi/reader/deck/deck_cards.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace hpvi
{
namespace
{
constexpr unsigned int most_includes = 16; ///< within each other

std::string unquoted(std::string text)
{
  text = single_spaced(text);
  if (text.size() > 1 && text.front() == '"' && text.back() == '"')
    text = single_spaced(text.substr(1, text.size() - 2));
  return text;
}

/** Parts between commas, but not within quotes. */
std::vector<std::string> parts_of(const std::string &line)
{
  std::vector<std::string> parts(1);
  bool is_quoted = false;
  for (const char c : line)
  {
    is_quoted = c == '"' ? !is_quoted : is_quoted;
    if (c == ',' && !is_quoted)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  for (std::string &part : parts)
    part = unquoted(part);
  return parts;
}

class CardReader
{
public:
  std::vector<DeckCard> cards;

  void read(const std::string &path, const unsigned int depth)
  {
    const std::string content = content_of(path);
    std::istringstream in(content);
    std::size_t line = 0;
    std::string keyword; // that goes on in the next line
    for (std::string text; std::getline(in, text);)
    {
      ++line;
      while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())))
        text.pop_back();
      const std::size_t begin = text.find_first_not_of(" \t");
      if (begin == std::string::npos || text.compare(begin, 2, "**") == 0)
        continue;
      text = text.substr(begin);
      if (!keyword.empty())
        text = keyword + text;
      keyword.clear();
      if (text[0] != '*')
        take_row(path, line, text);
      else if (text.back() == ',')
        keyword = text;
      else
        take_keyword(path, line, text, depth);
    }
  }

private:
  void take_row(const std::string &path, const std::size_t line, const std::string &text)
  {
    if (cards.empty())
      MeshComplaint(path).at(line, "the line stands before any keyword; begin a deck with one, as "
                                   "*HEADING");
    cards.back().rows.push_back({parts_of(text), line, path});
  }

  void take_keyword(const std::string &path, const std::size_t line, const std::string &text,
                    const unsigned int depth)
  {
    const std::vector<std::string> parts = parts_of(text.substr(1));
    DeckCard card{upper_case(parts[0]), {}, {}, path, line};
    for (std::size_t k = 1; k < parts.size(); ++k)
    {
      const std::size_t equals = parts[k].find('=');
      const std::string name = upper_case(single_spaced(parts[k].substr(0, equals)));
      if (!name.empty())
        card.options[name] =
            equals == std::string::npos ? "" : unquoted(parts[k].substr(equals + 1));
    }
    if (card.keyword == "INCLUDE")
      return include(card, depth);
    cards.push_back(card);
  }

  void include(const DeckCard &card, const unsigned int depth)
  {
    const std::string name = card.value("INPUT");
    if (name.empty())
      card.refuse_card("*INCLUDE names no file; write *INCLUDE, INPUT=FILE");
    const std::string path = (std::filesystem::path(card.file).parent_path() / name).string();
    std::error_code error;
    if (!std::filesystem::is_regular_file(path, error))
      card.refuse_card("*INCLUDE names " + printable(name) +
                       ", which is not there; put it beside the deck");
    if (depth == most_includes)
      card.refuse_card("*INCLUDE goes deeper than " + std::to_string(most_includes) +
                       " files; let none include itself");
    read(path, depth + 1);
  }
};
} // namespace

std::string upper_case(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
                 [](const unsigned char c) { return std::toupper(c); });
  return text;
}

bool DeckCard::has(const std::string &option) const
{
  return options.count(option) > 0;
}

std::string DeckCard::value(const std::string &option) const
{
  const auto found = options.find(option);
  return found == options.end() ? "" : found->second;
}

std::string DeckCard::place() const
{
  return printable(file, 400) + ":" + std::to_string(line);
}

void DeckCard::refuse_card(const std::string &problem_and_remedy) const
{
  MeshComplaint(file).at(line, problem_and_remedy);
}

std::string word_of(const DeckCard::Row &row, const std::size_t index)
{
  return index < row.words.size() ? row.words[index] : "";
}

double number_of(const DeckCard::Row &row, const std::size_t index, const double otherwise)
{
  std::string word = word_of(row, index);
  if (word.empty())
    return otherwise;
  std::replace_if(
      word.begin(), word.end(), [](const char c) { return c == 'd' || c == 'D'; }, 'e');
  char *end = nullptr;
  const double value = std::strtod(word.c_str(), &end);
  if (*end != '\0' || !std::isfinite(value) || std::isalpha(static_cast<unsigned char>(word[0])))
    refuse_row(row, printable(word, 40) + " is no number; give one as number " +
                        std::to_string(index + 1) + " of this line");
  return value;
}

std::string place_of(const DeckCard::Row &row)
{
  return printable(row.file, 400) + ":" + std::to_string(row.line);
}

void refuse_row(const DeckCard::Row &row, const std::string &problem_and_remedy)
{
  MeshComplaint(row.file).at(row.line, problem_and_remedy);
}

std::vector<DeckCard> read_deck_cards(const std::string &path)
{
  const MeshComplaint complain(path);
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    complain("is no file that can be read; name a deck (.inp)");
  if (!looks_like_deck(content_of(path)))
    complain("is no deck of CalculiX or Abaqus, which has keywords as *NODE; name one (.inp)");
  CardReader reader;
  reader.read(path, 0);
  return std::move(reader.cards);
}

bool looks_like_deck(const std::string &beginning)
{
  if (beginning.find('\0') != std::string::npos)
    return false;
  const std::string text = upper_case(beginning.substr(0, 1 << 16));
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string::npos || text[begin] != '*')
    return false;
  for (const char *const word : {"*NODE", "*INCLUDE", "*PART", "*HEADING"})
    if (const std::size_t at = text.find(word);
        at != std::string::npos && (at == 0 || text[at - 1] == '\n'))
      return true;
  return false;
}
} // namespace hpvi
