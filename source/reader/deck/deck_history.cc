// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/reader/deck/deck_history.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
using Knots = std::vector<std::pair<double, double>>;

/** How a load or support goes on within a step. */
struct Amplitude
{
  Knots knots; ///< time, factor
  bool is_of_total_time = false;

  double at(const double time) const
  {
    if (knots.empty() || time <= knots.front().first)
      return knots.empty() ? 1 : knots.front().second;
    for (std::size_t k = 1; k < knots.size(); ++k)
      if (time <= knots[k].first)
        return knots[k - 1].second + (knots[k].second - knots[k - 1].second) *
                                         (time - knots[k - 1].first) /
                                         (knots[k].first - knots[k - 1].first);
    return knots.back().second;
  }
};

class HistoryReader
{
public:
  explicit HistoryReader(Deck &deck) : deck(deck), complain{deck.path}
  {
  }

  DeckHistory read()
  {
    for (const DeckCard &card : deck.history)
      if (card.keyword == "AMPLITUDE")
        read_amplitude(card);
    std::vector<const DeckCard *> own; // of the step at hand
    const DeckCard *step = nullptr;
    for (const DeckCard &card : deck.history)
      if (card.keyword == "STEP")
      {
        step = &card;
        own.clear();
      }
      else if (card.keyword == "END STEP")
      {
        if (step != nullptr)
          take_step(*step, own);
        step = nullptr;
      }
      else if (step != nullptr)
        own.push_back(&card);
      else if (card.keyword == "BOUNDARY")
        take_card(card, {0, 0});
      else if (card.keyword == "INITIAL CONDITIONS")
        take_first(card);
    if (end == 0)
      complain("has no step that is static; write *STEP, *STATIC and *END STEP around its loads");
    finish();
    return std::move(history);
  }

private:
  struct Time
  {
    double begin, end;
    bool is_sudden = false; ///< without an amplitude
  };

  void leave_out(const std::string &place, const std::string &what)
  {
    deck.left_out.push_back(place + ": " + what);
  }

  void read_amplitude(const DeckCard &card)
  {
    Amplitude &own = amplitudes[upper_case(card.value("NAME"))];
    own.is_of_total_time = upper_case(card.value("TIME")) == "TOTAL TIME" ||
                           upper_case(card.value("TIME")) == "TOTALTIME";
    if (const std::string how = upper_case(card.value("DEFINITION"));
        !how.empty() && how != "TABULAR")
      card.refuse_card("*AMPLITUDE is of DEFINITION = " + printable(how, 40) +
                       "; give times and factors, DEFINITION = TABULAR");
    for (const DeckCard::Row &row : card.rows)
      for (std::size_t k = 0; k + 1 < row.words.size() && !row.words[k].empty(); k += 2)
      {
        own.knots.emplace_back(number_of(row, k), number_of(row, k + 1));
        if (own.knots.size() > 1 && own.knots.end()[-2].first > own.knots.back().first)
          refuse_row(row, "the times of an amplitude fall; let them rise");
      }
  }

  void take_first(const DeckCard &card)
  {
    if (upper_case(card.value("TYPE")) != "TEMPERATURE")
      return leave_out(card.place(),
                       "*INITIAL CONDITIONS of TYPE = " + printable(card.value("TYPE"), 40));
    for (const DeckCard::Row &row : card.rows)
      for (const unsigned int node : deck.nodes_called(row, 0))
        history.first_temperatures[node] = number_of(row, 1);
  }

  void take_step(const DeckCard &step, const std::vector<const DeckCard *> &cards)
  {
    static const std::set<std::string> of_static = {"STATIC", "BOUNDARY",    "CLOAD",    "DLOAD",
                                                    "DSLOAD", "TEMPERATURE", "AMPLITUDE"};
    double period = 1;
    for (const DeckCard *const card : cards)
      if (card->keyword == "STATIC" && !card->rows.empty())
        period = number_of(card->rows[0], 1, 1);
      else if (!of_static.count(card->keyword) && card->keyword != "INITIAL CONDITIONS")
        return leave_out(step.place(), "*STEP: it is *" + card->keyword + " (" + card->place() +
                                           "), and a scene is static; the step is left out");
    if (step.has("PERTURBATION"))
      return leave_out(step.place(), "*STEP, PERTURBATION: the step is left out");
    if (step.has("NLGEOM") && upper_case(step.value("NLGEOM")) != "NO")
      leave_out(step.place(), "*STEP, NLGEOM: large displacements; a scene is of small ones");
    if (!(period > 0))
      period = 1;
    const Time time = {end, end + period, upper_case(step.value("AMPLITUDE")) == "STEP"};
    removed.clear();
    touched.clear();
    for (const DeckCard *const card : cards)
      take_card(*card, time);
    end = time.end;
    for_all([&](DeckCourse &course, const std::string &kind) { go_on(course, kind, time); });
    ++n_steps;
  }

  /** What the step has not named stays, or goes with OP=NEW. */
  void go_on(DeckCourse &course, const std::string &kind, const Time &time)
  {
    if (touched.count(&course))
      return;
    if (removed.count(kind) && kind == "BOUNDARY")
      leave_out(course.place, "*BOUNDARY: a later step removes it (" + removed[kind] +
                                  "); a scene keeps its supports");
    course.knots.emplace_back(time.end,
                              removed.count(kind) && kind != "BOUNDARY" ? 0 : course.last());
  }

  template <typename Action>
  void for_all(const Action &action)
  {
    for (auto &[key, course] : history.supports)
      action(course, "BOUNDARY");
    for (auto &[key, course] : history.forces)
      action(course, "CLOAD");
    for (auto &[key, course] : history.pressures)
      action(course, "DLOAD");
    for (DeckHistory::BodyLoad &load : history.body_loads)
      action(load.course, "DLOAD");
    for (auto &[key, course] : history.temperatures)
      action(course, "TEMPERATURE");
  }

  void take_card(const DeckCard &card, const Time &time)
  {
    if (card.keyword == "STATIC" || card.keyword == "AMPLITUDE" ||
        card.keyword == "INITIAL CONDITIONS")
      return;
    const std::string kind = card.keyword == "DSLOAD" ? "DLOAD" : card.keyword;
    if (upper_case(card.value("OP")) == "NEW")
      removed.emplace(kind, card.place());
    if (card.has("FIXED")) // they stay where they are
      return;
    if (const std::string type = upper_case(card.value("TYPE"));
        !type.empty() && type != "DISPLACEMENT")
      return leave_out(card.place(), "*" + card.keyword + ", TYPE = " + printable(type, 40));
    for (const DeckCard::Row &row : card.rows)
      take_row(card, row, time);
  }

  void take_row(const DeckCard &card, const DeckCard::Row &row, const Time &time)
  {
    if (card.keyword == "BOUNDARY")
      take_support(card, row, time);
    else if (card.keyword == "CLOAD")
      take_force(card, row, time);
    else if (card.keyword == "TEMPERATURE")
      for (const unsigned int node : deck.nodes_called(row, 0))
        set(history.temperatures[node], card, row, time, number_of(row, 1),
            history.first_temperatures.count(node) ? history.first_temperatures[node] : 0);
    else
      take_distributed(card, row, time);
  }

  void take_support(const DeckCard &card, const DeckCard::Row &row, const Time &time)
  {
    const std::string word = upper_case(word_of(row, 1));
    static const std::map<std::string, std::array<bool, 2>> words = {
        {"ENCASTRE", {{true, true}}}, {"PINNED", {{true, true}}},  {"XSYMM", {{true, false}}},
        {"YSYMM", {{false, true}}},   {"XASYMM", {{false, true}}}, {"YASYMM", {{true, false}}},
        {"ZSYMM", {{false, false}}}};
    std::array<bool, 2> holds{{false, false}};
    if (const auto known = words.find(word); known != words.end())
      holds = known->second;
    else
    {
      const double first = number_of(row, 1), last = number_of(row, 2, first);
      if (first < 1 || last > 11 || last < first)
        refuse_row(row, "holds the degrees of freedom " + printable(word_of(row, 1), 20) + " to " +
                            printable(word_of(row, 2), 20) + "; give 1 for x and 2 for y");
      for (unsigned int d = 0; d < 2; ++d)
        holds[d] = first <= d + 1 && last >= d + 1;
      if (!holds[0] && !holds[1] && number_of(row, 3) != 0)
        leave_out(place_of(row), "*BOUNDARY: what is neither along x nor y");
    }
    for (const unsigned int node : deck.nodes_called(row, 0))
      for (unsigned int d = 0; d < 2; ++d)
        if (holds[d])
          set(history.supports[{node, d}], card, row, time, time.end > 0 ? number_of(row, 3) : 0);
  }

  void take_force(const DeckCard &card, const DeckCard::Row &row, const Time &time)
  {
    const double d = number_of(row, 1);
    if (d != 1 && d != 2)
      return leave_out(place_of(row), "*CLOAD: a force along " + printable(word_of(row, 1), 20) +
                                          ", which is neither x (1) nor y (2)");
    for (const unsigned int node : deck.nodes_called(row, 0))
    {
      DeckCourse &course = history.forces[{node, static_cast<unsigned int>(d) - 1}];
      // Forces of one step at one node add up.
      set(course, card, row, time,
          number_of(row, 2) + (touched.count(&course) ? given[&course] : 0));
    }
  }

  void take_distributed(const DeckCard &card, const DeckCard::Row &row, const Time &time)
  {
    const std::string label = upper_case(word_of(row, 1));
    if (card.keyword == "DSLOAD" && label == "P")
    {
      const auto surface = deck.surfaces.find(upper_case(word_of(row, 0)));
      if (surface == deck.surfaces.end())
        refuse_row(row, "names the surface " + printable(word_of(row, 0)) +
                            ", which is not there; write *SURFACE, NAME=... before it");
      for (const Deck::Face &face : surface->second)
        set(history.pressures[face], card, row, time, number_of(row, 2));
      return;
    }
    if (label == "GRAV" || label == "CENTRIF" || label == "BX" || label == "BY")
      return take_body_load(card, row, time, label);
    if (label.size() != 2 || label[0] != 'P' || label[1] < '1' || label[1] > '4')
      return leave_out(place_of(row), "*" + card.keyword + ": a load " + printable(label, 40));
    for (const unsigned int e : deck.elements_called(row, 0))
    {
      const unsigned int k = label[1] - '1';
      if (k >= deck.elements[e].n_corners)
        refuse_row(row, printable(label, 40) + " is no edge of the element " +
                            std::to_string(deck.elements[e].number) + ", which has " +
                            std::to_string(deck.elements[e].n_corners) + "; give P1 to P" +
                            std::to_string(deck.elements[e].n_corners));
      set(history.pressures[{e, k}], card, row, time, number_of(row, 2));
    }
  }

  void take_body_load(const DeckCard &card, const DeckCard::Row &row, const Time &time,
                      const std::string &label)
  {
    const std::vector<unsigned int> elements = deck.elements_called(row, 0);
    std::vector<double> numbers;
    for (std::size_t k = 3; k < row.words.size(); ++k)
      numbers.push_back(number_of(row, k));
    numbers.resize(6);
    for (DeckHistory::BodyLoad &load : history.body_loads)
      if (load.kind == label && load.elements == elements && load.numbers == numbers)
        return set(load.course, card, row, time, number_of(row, 2));
    history.body_loads.reserve(1000); // courses are known by their place
    history.body_loads.push_back({label, elements, numbers, {}});
    set(history.body_loads.back().course, card, row, time, number_of(row, 2));
  }

  /** From its value at the beginning of the step to @p value. */
  void set(DeckCourse &course, const DeckCard &card, const DeckCard::Row &row, const Time &time,
           const double value, const double first = 0)
  {
    course.names.insert(name_in(card, row));
    if (course.place.empty())
      course.place = place_of(row);
    if (course.knots.empty())
    {
      if (card.keyword == "BOUNDARY" && time.begin > 0)
        leave_out(place_of(row), "*BOUNDARY: that it begins in a later step; it holds, with the "
                                 "displacement 0, from the beginning");
      course.knots.emplace_back(0, first);
      if (time.begin > 0)
        course.knots.emplace_back(time.begin, first);
    }
    if (time.end == 0)
      return;
    if (touched.count(&course))
      while (course.knots.size() > 1 && course.knots.back().first > time.begin)
        course.knots.pop_back();
    touched.insert(&course);
    given[&course] = value;
    const std::string name = upper_case(card.value("AMPLITUDE"));
    if (!name.empty())
      return follow(course, row, name, time, value);
    if (time.is_sudden)
      course.knots.emplace_back(time.begin, value);
    course.knots.emplace_back(time.end, value);
  }

  void follow(DeckCourse &course, const DeckCard::Row &row, const std::string &name,
              const Time &time, const double value)
  {
    const auto found = amplitudes.find(name);
    if (found == amplitudes.end())
      refuse_row(row, "follows the amplitude " + printable(name) +
                          ", which is not there; write *AMPLITUDE, NAME=...");
    const double shift = found->second.is_of_total_time ? 0 : time.begin;
    const auto add = [&](const double at)
    {
      const double here = value * found->second.at(at - shift);
      if (course.knots.back() != std::pair(at, here))
        course.knots.emplace_back(at, here);
    };
    add(time.begin);
    for (const auto &[at, factor] : found->second.knots)
      if (at + shift > time.begin && at + shift < time.end)
        add(at + shift);
    add(time.end);
    follows_amplitude = true;
  }

  /** Its set, or its card where nodes stand one by one. */
  static std::string name_in(const DeckCard &card, const DeckCard::Row &row)
  {
    const std::string word = upper_case(word_of(row, 0));
    const bool is_number =
        !word.empty() && std::isdigit(static_cast<unsigned char>(word.back())) &&
        word.substr(word.rfind('.') + 1).find_first_not_of("0123456789") == std::string::npos;
    return is_number ? "#" + card.place() : word;
  }

  void finish()
  {
    history.has_time = n_steps > 1 || follows_amplitude;
    std::vector<double> times;
    for_all(
        [&](DeckCourse &course, const std::string &)
        {
          for (auto &[time, value] : course.knots)
          {
            time /= end;
            times.push_back(time);
          }
        });
    if (!history.has_time)
      return;
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    constexpr unsigned int most = 100;
    const auto is_met = [&](const unsigned int n)
    {
      return std::all_of(times.begin(), times.end(),
                         [n](const double time)
                         { return std::abs(time * n - std::round(time * n)) < 1e-6 * n; });
    };
    history.n_steps = n_steps;
    while (history.n_steps <= most && !is_met(history.n_steps))
      ++history.n_steps;
    if (history.n_steps <= most)
      return;
    history.n_steps = 40;
    deck.meant.push_back(printable(deck.path, 400) +
                         ": times of steps and amplitudes that no 100 equal load steps meet; 40 "
                         "are taken");
  }

  Deck &deck;
  const MeshComplaint complain;
  DeckHistory history;
  std::map<std::string, Amplitude> amplitudes;
  std::map<std::string, std::string> removed; ///< kinds with OP=NEW in the step, and where
  std::set<const DeckCourse *> touched;       ///< in the step
  std::map<const DeckCourse *, double> given; ///< in the step
  double end = 0;
  unsigned int n_steps = 0;
  bool follows_amplitude = false;
};
} // namespace

double DeckCourse::last() const
{
  return knots.empty() ? 0 : knots.back().second;
}

double DeckCourse::at(const double time) const
{
  for (std::size_t k = 1; k < knots.size(); ++k)
    if (time <= knots[k].first && knots[k].first > knots[k - 1].first)
      return knots[k - 1].second + (knots[k].second - knots[k - 1].second) *
                                       (time - knots[k - 1].first) /
                                       (knots[k].first - knots[k - 1].first);
  return last();
}

bool DeckCourse::is_zero() const
{
  return std::all_of(knots.begin(), knots.end(), [](const auto &knot) { return knot.second == 0; });
}

std::string DeckCourse::text(const bool with_time, const double factor) const
{
  if (!with_time || is_zero())
    return hpvi::text(factor * last());
  // Knots on the line between their neighbours say nothing.
  std::vector<std::pair<double, double>> own;
  for (const auto &knot : knots)
  {
    if (own.size() > 1)
    {
      const auto &[t0, v0] = own.end()[-2];
      const auto &[t1, v1] = own.back();
      const double there = v0 + (v1 - v0) * (knot.first - t0) / (t1 - t0);
      if (t1 > t0 && knot.first > t1 &&
          std::abs(there - knot.second) <= 1e-12 * (std::abs(there) + std::abs(knot.second)))
        own.pop_back();
    }
    own.push_back(knot);
  }
  std::string result, ends;
  for (std::size_t k = 1; k < own.size(); ++k)
  {
    const auto &[t0, v0] = own[k - 1];
    const auto &[t1, v1] = own[k];
    if (t1 <= t0)
      continue;
    const double slope = rounded(factor * (v1 - v0) / (t1 - t0), 12),
                 begin = rounded(factor * v0 - slope * t0, 12);
    std::string piece = slope == 0 ? hpvi::text(begin) : hpvi::text(slope) + "*t";
    if (slope != 0 && std::abs(begin) > 1e-11 * std::abs(slope))
      piece = hpvi::text(begin) + (slope < 0 ? "" : "+") + piece;
    if (k + 1 < own.size())
    {
      result += "if(t<" + hpvi::text(rounded(t1 + 1e-6, 7)) + ", " + piece + ", ";
      ends += ")";
    }
    else
      result += piece;
  }
  return result + ends;
}

DeckCourse sum(const std::vector<DeckCourse> &courses)
{
  DeckCourse result = courses.front();
  const auto is_like_first = [&](const DeckCourse &course)
  {
    return std::equal(course.knots.begin(), course.knots.end(), result.knots.begin(),
                      result.knots.end(),
                      [](const auto &a, const auto &b) { return a.first == b.first; });
  };
  if (!std::all_of(courses.begin(), courses.end(), is_like_first))
  {
    std::set<double> times;
    for (const DeckCourse &course : courses)
      for (const auto &knot : course.knots)
        times.insert(knot.first);
    result.knots.clear();
    for (const double time : times)
    {
      double value = 0;
      for (const DeckCourse &course : courses)
        value += course.at(time);
      result.knots.emplace_back(time, value);
    }
    return result;
  }
  for (std::size_t k = 0; k < result.knots.size(); ++k)
  {
    result.knots[k].second = 0;
    for (const DeckCourse &course : courses)
      result.knots[k].second += course.knots[k].second;
  }
  return result;
}

DeckHistory history_of(Deck &deck)
{
  return HistoryReader(deck).read();
}
} // namespace hpvi
