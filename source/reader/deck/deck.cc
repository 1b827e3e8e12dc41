// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/deck/deck.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <regex>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Cards that ask for output, or steer how a program solves. */
const std::set<std::string> without_meaning = {"HEADING",
                                               "NODE PRINT",
                                               "EL PRINT",
                                               "NODE FILE",
                                               "EL FILE",
                                               "CONTACT FILE",
                                               "CONTACT PRINT",
                                               "ENERGY FILE",
                                               "ENERGY PRINT",
                                               "OUTPUT",
                                               "NODE OUTPUT",
                                               "ELEMENT OUTPUT",
                                               "CONTACT OUTPUT",
                                               "ENERGY OUTPUT",
                                               "SECTION PRINT",
                                               "PREPRINT",
                                               "PRINT",
                                               "RESTART",
                                               "MONITOR",
                                               "FILE FORMAT",
                                               "TIME POINTS",
                                               "CONTROLS",
                                               "SOLUTION TECHNIQUE",
                                               "SECTION CONTROLS",
                                               "END PART",
                                               "ASSEMBLY",
                                               "END ASSEMBLY",
                                               "END INSTANCE",
                                               "PART",
                                               "INSTANCE",
                                               "USER OUTPUT VARIABLES",
                                               "PHYSICAL CONSTANTS"};
const std::set<std::string> of_history = {
    "BOUNDARY", "CLOAD",  "DLOAD",       "DSLOAD",    "STEP",
    "END STEP", "STATIC", "TEMPERATURE", "AMPLITUDE", "INITIAL CONDITIONS"};
const std::set<std::string> of_other_steps = {"FREQUENCY",
                                              "BUCKLE",
                                              "DYNAMIC",
                                              "MODAL DYNAMIC",
                                              "STEADY STATE DYNAMICS",
                                              "VISCO",
                                              "HEAT TRANSFER",
                                              "COUPLED TEMPERATURE-DISPLACEMENT",
                                              "UNCOUPLED TEMPERATURE-DISPLACEMENT"};

/** A card where it acts: in an instance of a part it speaks of numbers of that. */
struct Placed
{
  const DeckCard *card;
  std::string scope; ///< INSTANCE. or nothing
};

/** How an instance lies: turned, then moved. */
struct Motion
{
  double dx = 0, dy = 0, x = 0, y = 0, angle = 0;

  Point<2> operator()(const Point<2> &p) const
  {
    const double u = p[0] + dx - x, v = p[1] + dy - y, c = std::cos(angle), s = std::sin(angle);
    return Point<2>(x + c * u - s * v, y + s * u + c * v);
  }
};

class DeckReader
{
public:
  explicit DeckReader(const std::string &path) : cards(read_deck_cards(path)), complain{path}
  {
    deck.path = path;
  }

  Deck read()
  {
    place_cards();
    for (const Placed &one : placed)
      if (one.card->keyword == "NODE")
        read_nodes(one);
    for (const Placed &one : placed)
      if (one.card->keyword == "ELEMENT")
        read_elements(one);
    if (deck.elements.empty())
      complain(
          "has no elements of the plane or of revolution; give CPS, CPE or CAX elements of three, "
          "four, six or eight nodes");
    for (const Placed &one : placed)
      if (one.card->keyword == "NSET" || one.card->keyword == "ELSET")
        read_set(one);
    for (const Placed &one : placed)
      read_other(one);
    give_sections();
    return std::move(deck);
  }

private:
  void leave_out(const DeckCard &card, const std::string &why)
  {
    deck.left_out.push_back(card.place() + ": *" + printable(card.keyword, 60) + why);
  }

  // ------------------------------------------------------------ parts and instances

  void place_cards()
  {
    std::map<std::string, std::vector<const DeckCard *>> parts;
    std::vector<const DeckCard *> *part = nullptr;
    std::string scope;
    for (const DeckCard &card : cards)
    {
      const std::string &word = card.keyword;
      if (word == "PART")
        part = &parts[upper_case(card.value("NAME"))];
      else if (word == "END PART")
        part = nullptr;
      else if (part != nullptr)
        part->push_back(&card);
      else if (word == "INSTANCE")
        scope = begin_instance(card, parts);
      else if (word == "END INSTANCE")
        scope.clear();
      else
        placed.push_back({&card, scope});
    }
  }

  std::string begin_instance(const DeckCard &card,
                             const std::map<std::string, std::vector<const DeckCard *>> &parts)
  {
    const std::string scope = upper_case(card.value("NAME")) + ".";
    deck.spelling.emplace(scope, card.value("NAME"));
    Motion &motion = motions[scope];
    if (card.rows.size() > 0)
    {
      motion.dx = number_of(card.rows[0], 0);
      motion.dy = number_of(card.rows[0], 1);
    }
    if (card.rows.size() > 1)
    {
      const DeckCard::Row &row = card.rows[1];
      motion.x = number_of(row, 0);
      motion.y = number_of(row, 1);
      const double dx = number_of(row, 3) - motion.x, dy = number_of(row, 4) - motion.y,
                   dz = number_of(row, 5) - number_of(row, 2);
      if (std::abs(dx) + std::abs(dy) > 1e-9 * std::abs(dz))
        refuse_row(row, "the instance is turned out of the plane; turn it about an axis along z");
      motion.angle = number_of(row, 6) * numbers::PI / 180 * (dz < 0 ? -1 : 1);
    }
    const auto found = parts.find(upper_case(card.value("PART")));
    if (found == parts.end())
      card.refuse_card("*INSTANCE is of the part " + printable(card.value("PART")) +
                       ", which is not there; write *PART, NAME=... before it");
    for (const DeckCard *const one : found->second)
      placed.push_back({one, scope});
    return scope;
  }

  // ------------------------------------------------------------ nodes and elements

  static std::int64_t tag_of(const DeckCard::Row &row, const std::size_t index)
  {
    const double value = number_of(row, index, -1);
    if (!(value >= 0) || value > 1e15 || value != std::floor(value))
      refuse_row(row, printable(word_of(row, index), 40) +
                          " is no number of a node or an element; give a whole one");
    return std::int64_t(value);
  }

  void add(std::map<std::string, std::vector<unsigned int>> &sets, const std::string &name,
           const std::string &scope, const unsigned int index)
  {
    if (name.empty())
      return;
    const std::string key = scope + upper_case(name);
    deck.spelling.emplace(key, name);
    std::vector<unsigned int> &set = sets[key];
    if (set.empty() || set.back() != index)
      set.push_back(index);
  }

  void read_nodes(const Placed &one)
  {
    const Motion motion = motions[one.scope];
    for (const DeckCard::Row &row : one.card->rows)
    {
      const std::int64_t tag = tag_of(row, 0);
      const unsigned int index = deck.nodes.size();
      const Point<2> at = motion(Point<2>(number_of(row, 1), number_of(row, 2)));
      const auto [known, is_new] =
          deck.node_numbers.emplace(one.scope + std::to_string(tag), index);
      if (is_new)
      {
        deck.nodes.push_back({tag, at});
        heights.push_back(number_of(row, 3));
      }
      else if (deck.nodes[known->second].at.distance(at) > 0)
        refuse_row(row, "the node " + std::to_string(tag) +
                            " is at another place in a line before; give each node one place");
      add(deck.node_sets, one.card->value("NSET"), one.scope, known->second);
    }
  }

  void read_elements(const Placed &one)
  {
    const DeckCard &card = *one.card;
    const std::string type = upper_case(card.value("TYPE"));
    static const std::regex plane("(CPE|CPS|CAX)([3468]).*");
    std::smatch match;
    if (!std::regex_match(type, match, plane))
    {
      if (type.compare(0, 3, "C3D") == 0 || type.compare(0, 2, "SC") == 0)
        card.refuse_card(
            "elements of type " + printable(type, 40) +
            " are of space, and a deck becomes a scene of the plane or of revolution; "
            "import a deck with CPS, CPE or CAX elements, or give the mesh to Shape = file "
            "with Dimension = 3");
      return leave_out(card, ": elements of type " + printable(type, 40));
    }
    const unsigned int n = match[2].str()[0] - '0';
    const PlaneModel model = match[1] == "CPS"   ? PlaneModel::stress
                             : match[1] == "CPE" ? PlaneModel::strain
                                                 : PlaneModel::axisymmetric;
    if (!deck.elements.empty() && deck.elements.front().plane != model)
      card.refuse_card(
          "elements of type " + printable(type, 40) + " stand beside others of another plane (" +
          deck.elements.front().place +
          "); a scene is of plane stress, plane strain or revolution: give all elements "
          "one of the three");
    std::vector<std::int64_t> words;
    for (const DeckCard::Row &row : card.rows)
    {
      for (std::size_t k = 0; k < row.words.size(); ++k)
        if (!row.words[k].empty())
          words.push_back(tag_of(row, k));
      if (words.size() > n + 1)
        refuse_row(row, "the element has " + std::to_string(words.size() - 1) +
                            " nodes, and its type " + printable(type, 40) + " has " +
                            std::to_string(n) + "; give each element a line");
      if (words.size() == n + 1)
      {
        take_element(one, row, words, n > 4 ? n / 2 : n, model);
        words.clear();
      }
    }
    if (!words.empty())
      refuse_row(card.rows.back(), "the element " + std::to_string(words[0]) + " has " +
                                       std::to_string(words.size() - 1) + " nodes of " +
                                       std::to_string(n) + "; write the file anew");
  }

  void take_element(const Placed &one, const DeckCard::Row &row,
                    const std::vector<std::int64_t> &words, const unsigned int n_corners,
                    const PlaneModel model)
  {
    Deck::Element element{words[0], {}, n_corners, model, place_of(row)};
    for (std::size_t k = 1; k < words.size(); ++k)
    {
      const auto found = deck.node_numbers.find(one.scope + std::to_string(words[k]));
      if (found == deck.node_numbers.end())
        refuse_row(row, "the element " + std::to_string(words[0]) + " has a node " +
                            std::to_string(words[k]) + " that is not there; write the file anew");
      element.nodes.push_back(found->second);
    }
    collapse(element);
    if (element.n_corners < 3)
      refuse_row(row, "the element " + std::to_string(words[0]) +
                          " has fewer than three corners; give it other nodes");
    if (!deck.element_numbers.emplace(one.scope + std::to_string(words[0]), deck.elements.size())
             .second)
      refuse_row(row, "the element " + std::to_string(words[0]) +
                          " stands in a line before; give it another number");
    add(deck.element_sets, one.card->value("ELSET"), one.scope, deck.elements.size());
    check_height(row, element);
    deck.elements.push_back(element);
  }

  /** A quadrilateral with a node twice is a triangle. Faces keep no number then, and loads on them are rare. */
  static void collapse(Deck::Element &element)
  {
    for (unsigned int k = 0; k < element.n_corners; ++k)
      if (element.corner(k) == element.corner(k + 1))
      {
        if (element.nodes.size() > element.n_corners)
          element.nodes.erase(element.nodes.begin() + element.n_corners + k);
        element.nodes.erase(element.nodes.begin() + (k + 1) % element.n_corners);
        --element.n_corners;
        break;
      }
  }

  void check_height(const DeckCard::Row &row, const Deck::Element &element) const
  {
    for (const unsigned int node : element.nodes)
      if (heights[node] != heights[element.nodes[0]] ||
          (!deck.elements.empty() && heights[node] != heights[deck.elements[0].nodes[0]]))
        refuse_row(row, "the node " + std::to_string(deck.nodes[node].number) +
                            " is not in the plane z = const of the others; draw the body there");
  }

  // ------------------------------------------------------------ sets and surfaces

  /** Of an option, in the scope of the card or of the instance that it names. */
  std::string scope_of(const Placed &one) const
  {
    const std::string instance = upper_case(one.card->value("INSTANCE"));
    return instance.empty() ? one.scope : instance + ".";
  }

  void read_set(const Placed &one)
  {
    const DeckCard &card = *one.card;
    const bool is_of_nodes = card.keyword == "NSET";
    const std::string name = card.value(card.keyword), scope = scope_of(one);
    if (name.empty())
      card.refuse_card("the set has no name; write *" + card.keyword + ", " + card.keyword +
                       "=NAME");
    auto &sets = is_of_nodes ? deck.node_sets : deck.element_sets;
    const auto &numbers = is_of_nodes ? deck.node_numbers : deck.element_numbers;
    const std::string key = one.scope + upper_case(name);
    deck.spelling.emplace(key, name);
    sets[key]; // may be empty
    const auto take = [&](const DeckCard::Row &row, const std::int64_t tag)
    {
      const auto found = numbers.find(scope + std::to_string(tag));
      if (found != numbers.end()) // generated sets may have holes
        add(sets, name, one.scope, found->second);
      (void)row;
    };
    if (is_of_nodes && card.has("ELSET"))
      for (const unsigned int e : called(deck.element_sets, scope, card.value("ELSET")))
        for (const unsigned int node : deck.elements[e].nodes)
          add(sets, name, one.scope, node);
    for (const DeckCard::Row &row : card.rows)
      if (card.has("GENERATE"))
      {
        const std::int64_t begin = tag_of(row, 0), end = tag_of(row, 1),
                           step =
                               row.words.size() > 2 && !row.words[2].empty() ? tag_of(row, 2) : 1;
        if (step == 0 || end < begin || (end - begin) / std::max<std::int64_t>(step, 1) > 10000000)
          refuse_row(row, "GENERATE goes from " + std::to_string(begin) + " to " +
                              std::to_string(end) + " by " + std::to_string(step) +
                              "; give a first, a last and a step that fit");
        for (std::int64_t tag = begin; tag <= end; tag += step)
          take(row, tag);
      }
      else
        for (std::size_t k = 0; k < row.words.size(); ++k)
          if (const std::string &word = row.words[k]; word.empty())
            continue;
          else if (std::isdigit(static_cast<unsigned char>(word[0])) &&
                   word.find_first_not_of("0123456789") == std::string::npos)
            take(row, tag_of(row, k));
          else
          {
            const std::vector<unsigned int> more = called(sets, scope, word);
            for (const unsigned int index : more)
              add(sets, name, one.scope, index);
          }
    std::vector<unsigned int> &set = sets[key];
    std::sort(set.begin(), set.end());
    set.erase(std::unique(set.begin(), set.end()), set.end());
  }

  static std::vector<unsigned int>
  called(const std::map<std::string, std::vector<unsigned int>> &sets, const std::string &scope,
         const std::string &name)
  {
    for (const std::string &key : {scope + upper_case(name), upper_case(name)})
      if (const auto found = sets.find(key); found != sets.end())
        return found->second;
    return {};
  }

  void read_surface(const Placed &one)
  {
    const DeckCard &card = *one.card;
    const std::string name = card.value("NAME"), type = upper_case(card.value("TYPE")),
                      scope = scope_of(one), key = one.scope + upper_case(name);
    if (outer.empty())
      outer = deck.outer_faces();
    if (!type.empty() && type != "ELEMENT" && type != "NODE")
      return leave_out(card, ": a surface of type " + printable(type, 40));
    deck.spelling.emplace(key, name);
    std::vector<Deck::Face> &faces = deck.surfaces[key];
    std::vector<unsigned int> nodes;
    for (const DeckCard::Row &row : card.rows)
    {
      const DeckCard::Row scoped = with_scope(row, scope, type == "NODE");
      if (type == "NODE")
      {
        const std::vector<unsigned int> more = deck.nodes_called(scoped, 0);
        nodes.insert(nodes.end(), more.begin(), more.end());
        continue;
      }
      const std::vector<unsigned int> elements = deck.elements_called(scoped, 0);
      const std::string face = upper_case(word_of(row, 1));
      for (const unsigned int e : elements)
        if (face.empty())
        {
          for (const Deck::Face &free : outer)
            if (free.first == e)
              faces.push_back(free);
        }
        else
          faces.push_back({e, face_number(row, face, deck.elements[e])});
    }
    if (type == "NODE")
      faces = faces_between(deck, nodes, outer);
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    if (faces.empty())
      leave_out(card, ": the surface " + printable(name, 40) + " has no edge on a boundary");
  }

  DeckCard::Row with_scope(DeckCard::Row row, const std::string &scope,
                           const bool is_of_nodes) const
  {
    if (row.words.empty() || scope.empty())
      return row;
    const std::string own = scope + upper_case(row.words[0]);
    if ((is_of_nodes ? deck.node_sets : deck.element_sets).count(own) ||
        (is_of_nodes ? deck.node_numbers : deck.element_numbers).count(own))
      row.words[0] = own;
    return row;
  }

  static unsigned int face_number(const DeckCard::Row &row, const std::string &face,
                                  const Deck::Element &element)
  {
    if (face.size() != 2 || face[0] != 'S' || face[1] < '1' ||
        unsigned(face[1] - '1') >= element.n_corners)
      refuse_row(row, printable(face, 40) + " is no edge of an element with " +
                          std::to_string(element.n_corners) + " corners; give S1 to S" +
                          std::to_string(element.n_corners));
    return face[1] - '1';
  }

  // ------------------------------------------------------------ all else

  void read_other(const Placed &one)
  {
    const DeckCard &card = *one.card;
    const std::string &word = card.keyword;
    if (word == "HEADING" && !card.rows.empty() && deck.title.empty())
      deck.title = printable(card.rows[0].words[0]);
    if (word == "NODE" || word == "ELEMENT" || word == "NSET" || word == "ELSET" ||
        without_meaning.count(word))
      return;
    if (word == "SURFACE")
      return read_surface(one);
    if (word == "MATERIAL")
      return begin_material(card);
    if (read_material_card(card) || read_contact_card(one))
      return;
    if (word == "SOLID SECTION")
      return read_section(one);
    if (word == "ORIENTATION")
      return read_orientation(card);
    if (word == "TRANSFORM")
      return read_axes(one);
    if (of_history.count(word) || of_other_steps.count(word))
    {
      deck.history.push_back(card);
      for (DeckCard::Row &row : deck.history.back().rows)
        row = with_scope(row, one.scope, word != "DLOAD" && word != "DSLOAD");
      return;
    }
    leave_out(card, "");
  }

  void begin_material(const DeckCard &card)
  {
    const std::string name = card.value("NAME");
    if (name.empty())
      card.refuse_card("*MATERIAL has no name; write *MATERIAL, NAME=STEEL");
    material = upper_case(name);
    deck.materials[material] = {name, card.place(), 0, 0, 0, 0, {}};
  }

  /** Of the material before it. */
  bool read_material_card(const DeckCard &card)
  {
    const std::string &word = card.keyword;
    static const std::set<std::string> known = {"ELASTIC", "DENSITY", "EXPANSION"};
    static const std::set<std::string> unknown = {"PLASTIC",
                                                  "CREEP",
                                                  "HYPERELASTIC",
                                                  "HYPERFOAM",
                                                  "VISCOELASTIC",
                                                  "CONDUCTIVITY",
                                                  "DAMPING",
                                                  "DEPVAR",
                                                  "USER MATERIAL",
                                                  "SPECIFIC HEAT",
                                                  "CYCLIC HARDENING",
                                                  "DAMAGE INITIATION",
                                                  "DEFORMATION PLASTICITY",
                                                  "RATE DEPENDENT"};
    if (unknown.count(word))
    {
      leave_out(card, material.empty() ? ""
                                       : ": the material " + deck.materials[material].name +
                                             " is linearly elastic here");
      return true;
    }
    if (!known.count(word))
      return false;
    if (material.empty() || card.rows.empty())
      card.refuse_card("*" + word +
                       " belongs to no material or has no numbers; write it behind "
                       "*MATERIAL, NAME=...");
    Deck::Elastic &own = deck.materials[material];
    const DeckCard::Row &row = card.rows[0];
    if (word == "DENSITY")
      own.density = number_of(row, 0);
    else if (word == "EXPANSION")
    {
      own.expansion = number_of(row, 0);
      if (const std::string type = upper_case(card.value("TYPE")); !type.empty() && type != "ISO")
        leave_out(card, ": expansion that differs by direction; the first number is taken");
    }
    else
      read_elastic(card, row, own);
    const bool is_long = word == "ELASTIC" && own.orthotropic; // goes on in a second row
    if (card.rows.size() > (is_long ? 2 : 1))
      leave_out(card, ": numbers that depend on temperature; the first row is taken");
    return true;
  }

  void read_elastic(const DeckCard &card, const DeckCard::Row &row, Deck::Elastic &own)
  {
    const std::string type = upper_case(card.value("TYPE"));
    if (type.empty() || type == "ISO" || type == "ISOTROPIC")
    {
      own.E = number_of(row, 0);
      own.nu = number_of(row, 1);
      return;
    }
    if (type != "ENGINEERING CONSTANTS")
      card.refuse_card("*ELASTIC is of TYPE = " + printable(type, 40) +
                       ", and a scene has isotropic and orthotropic materials; give ENGINEERING "
                       "CONSTANTS");
    std::array<double, 9> numbers{};
    for (unsigned int k = 0; k < 9; ++k)
      numbers[k] = k < 8                  ? number_of(row, k)
                   : card.rows.size() > 1 ? number_of(card.rows[1], 0)
                                          : 0;
    own.orthotropic = numbers;
  }

  /** Two points in the plane: axis 1, and one in the plane of axes 1 and 2. */
  void read_orientation(const DeckCard &card)
  {
    const std::string system = upper_case(card.value("SYSTEM"));
    if ((!system.empty() && system != "RECTANGULAR") || card.rows.empty() ||
        number_of(card.rows[0], 2) != 0)
      return leave_out(card, ": axes that are no directions in the plane");
    deck.orientations[upper_case(card.value("NAME"))] =
        std::atan2(number_of(card.rows[0], 1), number_of(card.rows[0], 0)) * 180 / numbers::PI;
  }

  /** Of nodes: directions, or, around a point, radial and tangential. */
  void read_axes(const Placed &one)
  {
    const DeckCard &card = *one.card;
    const std::string type = upper_case(card.value("TYPE"));
    if (card.rows.empty() || (!type.empty() && type != "R" && type != "C"))
      return leave_out(card, ": axes that are neither R nor C");
    const DeckCard::Row name = {{card.value("NSET")}, card.line, card.file};
    const Point<2> a(number_of(card.rows[0], 0), number_of(card.rows[0], 1));
    for (const unsigned int node : deck.nodes_called(with_scope(name, one.scope, true), 0))
    {
      const Tensor<1, 2> axis = type == "C" ? deck.nodes[node].at - a : Tensor<1, 2>(a);
      if (axis.norm() > 0)
        deck.axes[node] = axis / axis.norm();
    }
  }

  void read_section(const Placed &one)
  {
    const DeckCard &card = *one.card;
    const std::string set = upper_case(card.value("ELSET"));
    std::string key = one.scope + set;
    if (!deck.element_sets.count(key))
      key = set;
    const auto found = deck.element_sets.find(key);
    if (found == deck.element_sets.end())
      card.refuse_card("*SOLID SECTION is of the element set " + printable(card.value("ELSET")) +
                       ", which is not there; name one of *ELSET or *ELEMENT");
    double thickness = card.rows.empty() ? 1 : number_of(card.rows[0], 0, 1);
    const bool is_turned =
        !deck.elements.empty() && deck.elements.front().plane == PlaneModel::axisymmetric;
    thickness = thickness <= 0 || is_turned ? 1 : thickness;
    deck.sections[key] = {upper_case(card.value("MATERIAL")), card.place(), thickness, 0};
    turned[key] = upper_case(card.value("ORIENTATION"));
    for (const unsigned int e : found->second)
      deck.elements[e].section = key;
  }

  bool read_contact_card(const Placed &one)
  {
    const DeckCard &card = *one.card;
    const std::string &word = card.keyword;
    if (word == "SURFACE INTERACTION")
      interaction = upper_case(card.value("NAME"));
    else if (word == "FRICTION" && !card.rows.empty())
    {
      Deck::Interaction &own = deck.interactions[interaction];
      own.friction = number_of(card.rows[0], 0);
      if (card.has("TAUMAX"))
        own.most_friction = number_of({{card.value("TAUMAX")}, card.line, card.file}, 0);
      if (card.rows[0].words.size() > 1 && !card.rows[0].words[1].empty())
        deck.meant.push_back(card.place() + ": *FRICTION: its stiffness where it sticks; sides "
                                            "that stick do not move along each other");
      return true;
    }
    else if (word == "SURFACE BEHAVIOR")
    {
      const std::string law = upper_case(card.value("PRESSURE-OVERCLOSURE"));
      deck.interactions[interaction].is_tied |= law == "TIED";
      deck.interactions[interaction].sticks_together |= card.has("NO SEPARATION");
      if (!law.empty() && law != "HARD" && law != "TIED")
        deck.meant.push_back(card.place() + ": *SURFACE BEHAVIOR: pressure by overclosure (" +
                             printable(law, 40) + "); sides do not enter each other");
      return true;
    }
    else if (word == "CONTACT PAIR" || word == "TIE")
      read_pairs(one);
    else if (word == "CLEARANCE")
      clearances.push_back(&card);
    else
      return word == "FRICTION";
    if (word == "SURFACE INTERACTION")
      deck.interactions[interaction];
    return true;
  }

  void read_pairs(const Placed &one)
  {
    const DeckCard &card = *one.card;
    for (const DeckCard::Row &row : card.rows)
    {
      Deck::Pair pair;
      pair.place = place_of(row);
      pair.interaction = upper_case(card.value("INTERACTION"));
      pair.is_tied = card.keyword == "TIE";
      for (const unsigned int k : {0, 1})
        pair.surfaces[k] = surface_called(one, row, k);
      for (const char *const option : {"ADJUST", "POSITION TOLERANCE"})
        if (const std::string value = card.value(option);
            !value.empty() && std::isalpha(static_cast<unsigned char>(value[0])) == 0)
          pair.closed_within = number_of({{value}, card.line, card.file}, 0);
      deck.pairs.push_back(pair);
    }
  }

  /** One of *SURFACE, or, as CalculiX has it, a set of nodes. */
  std::string surface_called(const Placed &one, const DeckCard::Row &row, const unsigned int index)
  {
    const std::string name = upper_case(word_of(row, index));
    for (const std::string &key : {one.scope + name, name})
      if (deck.surfaces.count(key))
        return key;
    for (const std::string &key : {one.scope + name, name})
      if (const auto set = deck.node_sets.find(key); set != deck.node_sets.end())
      {
        deck.surfaces[key] = faces_between(deck, set->second, deck.outer_faces());
        return key;
      }
    refuse_row(row, "names the surface " + printable(word_of(row, index)) +
                        ", which is not there; write *SURFACE, NAME=... before it");
  }

  void give_sections()
  {
    for (const DeckCard *const card : clearances)
      for (Deck::Pair &pair : deck.pairs)
        if (pair.surfaces[0] == upper_case(card->value("SLAVE")) &&
            pair.surfaces[1] == upper_case(card->value("MASTER")))
          pair.clearance = number_of({{card->value("VALUE")}, card->line, card->file}, 0);
    for (auto &[key, section] : deck.sections)
      if (!turned[key].empty())
        section.angle = deck.orientations[turned[key]];
    for (const Deck::Element &element : deck.elements)
    {
      if (element.section.empty())
        complain("the element " + std::to_string(element.number) + " (" + element.place +
                 ") has no material; write *SOLID SECTION, ELSET=..., MATERIAL=... "
                 "for its set");
      const Deck::Section &section = deck.sections.at(element.section);
      const auto found = deck.materials.find(section.material);
      if (found == deck.materials.end() || (found->second.E <= 0 && !found->second.orthotropic))
        complain("the material " + printable(section.material) + " of " + section.place +
                 " has no Young's modulus; write *MATERIAL, NAME=... with *ELASTIC");
    }
  }

  const std::vector<DeckCard> cards;
  const MeshComplaint complain;
  std::vector<Placed> placed;
  std::map<std::string, Motion> motions; ///< by scope
  std::vector<double> heights;           ///< z of nodes
  std::vector<Deck::Face> outer;
  std::string material, interaction;         ///< those that cards belong to
  std::map<std::string, std::string> turned; ///< orientations of sections
  std::vector<const DeckCard *> clearances;
  Deck deck;
};
} // namespace

std::vector<unsigned int> Deck::Element::edge(const unsigned int k) const
{
  std::vector<unsigned int> result = {corner(k), corner(k + 1)};
  if (nodes.size() > n_corners)
    result.push_back(nodes[n_corners + k]);
  return result;
}

std::vector<Deck::Face> Deck::outer_faces() const
{
  std::map<std::pair<unsigned int, unsigned int>, std::vector<Face>> faces;
  for (unsigned int e = 0; e < elements.size(); ++e)
    for (unsigned int k = 0; k < elements[e].n_corners; ++k)
      faces[std::minmax({elements[e].corner(k), elements[e].corner(k + 1)})].push_back({e, k});
  std::vector<Face> result;
  for (const auto &[ends, beside] : faces)
    if (beside.size() == 1)
      result.push_back(beside[0]);
  std::sort(result.begin(), result.end());
  return result;
}

double Deck::size() const
{
  Point<2> lower = nodes[elements[0].nodes[0]].at, upper = lower;
  for (const Element &element : elements)
    for (const unsigned int node : element.nodes)
      for (unsigned int d = 0; d < 2; ++d)
      {
        lower[d] = std::min(lower[d], nodes[node].at[d]);
        upper[d] = std::max(upper[d], nodes[node].at[d]);
      }
  return std::max(upper[0] - lower[0], upper[1] - lower[1]);
}

namespace
{
std::vector<unsigned int> items_called(const DeckCard::Row &row, const std::size_t index,
                                       const std::map<std::string, unsigned int> &numbers,
                                       const std::map<std::string, std::vector<unsigned int>> &sets,
                                       const std::string &kind)
{
  const std::string word = upper_case(word_of(row, index));
  if (const auto found = numbers.find(word); found != numbers.end())
    return {found->second};
  if (const auto found = sets.find(word); found != sets.end())
    return found->second;
  refuse_row(row, "names the " + kind + " " + printable(word_of(row, index), 60) +
                      ", which is not there; give a number or a set of the deck");
}
} // namespace

std::vector<unsigned int> Deck::nodes_called(const DeckCard::Row &row,
                                             const std::size_t index) const
{
  return items_called(row, index, node_numbers, node_sets, "node or node set");
}

std::vector<unsigned int> Deck::elements_called(const DeckCard::Row &row,
                                                const std::size_t index) const
{
  return items_called(row, index, element_numbers, element_sets, "element or element set");
}

std::vector<Deck::Face> faces_between(const Deck &deck, const std::vector<unsigned int> &nodes,
                                      const std::vector<Deck::Face> &outer)
{
  const std::set<unsigned int> own(nodes.begin(), nodes.end());
  std::vector<Deck::Face> result;
  for (const Deck::Face &face : outer)
  {
    const std::vector<unsigned int> edge = deck.elements[face.first].edge(face.second);
    if (std::all_of(edge.begin(), edge.end(),
                    [&](const unsigned int node) { return own.count(node) > 0; }))
      result.push_back(face);
  }
  return result;
}

Deck read_deck(const std::string &path)
{
  return DeckReader(path).read();
}
} // namespace hpvi
