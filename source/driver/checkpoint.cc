// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/version.h>
#include <hpvi/driver/checkpoint.h>
#include <hpvi/reader/scene_reader.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <system_error>
#include <tuple>

namespace hpvi
{
namespace
{
/** Those of @p loads that are no whole numbers. */
template <class Loads>
auto references_of(Loads &loads)
{
  auto &load = loads.load;
  return std::tie(load.t, load.work, load.dissipated, load.stored, load.released, load.unbalanced,
                  load.trapezoidal, loads.seconds, loads.slipped, loads.initial_part,
                  loads.tolerance, loads.past_data.stress, loads.past_data.displacement,
                  loads.data.stress, loads.data.displacement);
}

/** The bits of each: decimals of a large mesh would take longer than all else. */
void write_values(std::ostream &out, const char *const name, const dealii::Vector<double> &values)
{
  static_assert(sizeof(double) == sizeof(std::uint64_t));
  std::string line = name + (' ' + std::to_string(values.size()));
  line.reserve(line.size() + 17 * values.size() + 1);
  for (const double value : values)
  {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    line += ' ';
    for (int shift = 60; shift >= 0; shift -= 4)
      line += "0123456789abcdef"[bits >> shift & 15];
  }
  out << line << '\n';
}

/** Each cell that changes by how far it is from the one before and its degree. */
void write_marks(std::ostream &out, const MeshMarks &marks)
{
  out << marks.n_cells << ' ' << marks.changed.size();
  unsigned int last = 0;
  for (const auto &[cell, degree] : marks.changed)
  {
    out << ' ' << cell - last << ' ' << degree;
    last = cell;
  }
  out << ' ' << marks.then.size() << '\n';
  for (const MeshMarks &next : marks.then)
    write_marks(out, next);
}

/** What lasts from load step to load step. */
void write_history(std::ostream &out, const HistorySoFar &history)
{
  out << "contact " << history.contact.size() << '\n';
  for (ContactHistory contact : history.contact)
  {
    out << contact.boundary << ' ' << contact.points.size() << '\n';
    for (PointHistory &point : contact.points)
    {
      for (const double coordinate : point.x)
        out << text(coordinate) << ' ';
      for (const double *const number : point.numbers())
        out << text(*number) << ' ';
      out << '\n';
    }
  }
  out << "cycles " << history.cycles.size() << '\n';
  for (const LoadCycle &cycle : history.cycles)
    out << cycle.load_step << ' ' << text(cycle.work) << ' ' << text(cycle.dissipated) << ' '
        << text(cycle.change) << '\n';
  for (const HistoryLargest &one : {history.pressure, history.von_mises, history.opening})
  {
    out << "largest " << text(one.value) << ' ';
    for (const double coordinate : one.where)
      out << text(coordinate) << ' ';
    out << one.boundary << ' ' << one.load_step << ' ' << text(one.t) << '\n';
  }
}

/** All zero: there is no history of loads. */
void write_loads(std::ostream &out, const FinishedLoads &loads)
{
  out << "loads";
  for (const unsigned int n : {loads.load.number, loads.n_steps, loads.first})
    out << ' ' << n;
  std::apply([&out](const auto &...value) { (out << ... << (' ' + text(value))); },
             references_of(loads));
  out << "\nwarnings " << loads.warnings.size() << '\n';
  for (const Warning &warning : loads.warnings)
    out << static_cast<unsigned int>(warning.kind) << ' ' << text(warning.size) << '\n'
        << warning.text << '\n';
  write_history(out, loads.so_far);
}

/** How many, then boundary, value, place and length of each. */
template <int dim>
void write_extrema(std::ostream &out, const std::vector<StressSample<dim>> &extrema)
{
  out << ' ' << extrema.size();
  for (const StressSample<dim> &peak : extrema)
  {
    out << ' ' << peak.boundary << ' ' << text(peak.value);
    for (unsigned int d = 0; d < dim; ++d)
      out << ' ' << text(peak.where[d]);
    out << ' ' << text(peak.length);
  }
  out << '\n';
}

/** How many, the contradiction on a line of its own, then three lines of each. */
void write_claims(std::ostream &out, const Claims &claims, const std::string &contradiction)
{
  out << "claims " << claims.size() << "\n." << contradiction << '\n';
  for (const Claim &claim : claims)
    out << claim.what << '\n'
        << claim.where << '\n'
        << text(claim.low) << ' ' << text(claim.high) << ' ' << text(claim.round_off) << '\n';
}

const FileFormat &run_state_format()
{
  static const FileFormat format("run state", 10,
                                 "go on with the scene of that run, or begin a new one");
  return format;
}

/** The content of a file, word by word. */
class Reader
{
public:
  Reader(const std::string &content, const std::string &file) : in(content), file(file)
  {
  }

  /** As text() writes it, which knows infinity; whole numbers also in another @p base. */
  template <class Number, class... Base>
  Number number(const Base... base)
  {
    std::string word;
    Number value{};
    in >> word;
    const char *const end = word.data() + word.size();
    const auto result = std::from_chars(word.data(), end, value, base...);
    if (result.ec != std::errc() || result.ptr != end)
      malformed();
    return value;
  }

  void expect(const std::string &name)
  {
    std::string word;
    if (!(in >> word) || word != name)
      malformed();
  }

  std::vector<std::string> lines(const unsigned int n)
  {
    std::vector<std::string> result(n);
    in >> std::ws;
    for (std::string &line : result)
      std::getline(in, line);
    return result;
  }

  dealii::Vector<double> values(const std::string &name)
  {
    expect(name);
    dealii::Vector<double> result(number<unsigned int>());
    for (double &value : result)
    {
      const std::uint64_t bits = number<std::uint64_t>(16);
      std::memcpy(&value, &bits, sizeof bits);
    }
    return result;
  }

  template <int dim>
  std::vector<StressSample<dim>> extrema()
  {
    std::vector<StressSample<dim>> result;
    for (unsigned int n = number<unsigned int>(); n > 0; --n)
    {
      StressSample<dim> &peak = result.emplace_back();
      peak.boundary = number<dealii::types::boundary_id>();
      peak.value = number<double>();
      for (unsigned int d = 0; d < dim; ++d)
        peak.where[d] = number<double>();
      peak.length = number<double>();
    }
    return result;
  }

  void claims(Claims &claims, std::string &contradiction)
  {
    expect("claims");
    claims.resize(number<unsigned int>());
    contradiction = lines(1).front().substr(1);
    for (Claim &claim : claims)
    {
      const std::vector<std::string> words = lines(2);
      claim = {words[0], words[1], number<double>(), number<double>(), number<double>()};
    }
  }

  MeshMarks marks()
  {
    MeshMarks result;
    result.n_cells = number<unsigned int>();
    unsigned int cell = 0;
    for (unsigned int n = number<unsigned int>(); n > 0; --n)
    {
      cell += number<unsigned int>();
      result.changed.emplace_back(cell, number<unsigned int>());
    }
    for (unsigned int n = number<unsigned int>(); n > 0; --n)
      result.then.push_back(marks());
    return result;
  }

  FinishedLoads loads()
  {
    FinishedLoads result;
    for (unsigned int *const n : {&result.load.number, &result.n_steps, &result.first})
      *n = number<unsigned int>();
    std::apply([this](auto &...value) { ((value = number<double>()), ...); },
               references_of(result));
    expect("warnings");
    for (unsigned int n = number<unsigned int>(); n > 0; --n)
    {
      const auto kind = static_cast<WarningKind>(number<unsigned int>());
      const double size = number<double>();
      result.warnings.push_back({kind, size, lines(1).front()});
    }
    result.so_far = history();
    return result;
  }

  HistorySoFar history()
  {
    HistorySoFar result;
    expect("contact");
    result.contact.resize(number<unsigned int>());
    for (ContactHistory &contact : result.contact)
    {
      contact.boundary = number<unsigned int>();
      contact.points.resize(number<unsigned int>());
      for (PointHistory &point : contact.points)
      {
        for (double &coordinate : point.x)
          coordinate = number<double>();
        for (double *const value : point.numbers())
          *value = number<double>();
      }
    }
    expect("cycles");
    result.cycles.resize(number<unsigned int>());
    for (LoadCycle &cycle : result.cycles)
    {
      cycle.load_step = number<unsigned int>();
      for (double *const value : {&cycle.work, &cycle.dissipated, &cycle.change})
        *value = number<double>();
    }
    for (HistoryLargest *const one : {&result.pressure, &result.von_mises, &result.opening})
    {
      expect("largest");
      one->value = number<double>();
      for (double &coordinate : one->where)
        coordinate = number<double>();
      one->boundary = number<unsigned int>();
      one->load_step = number<unsigned int>();
      one->t = number<double>();
    }
    return result;
  }

private:
  [[noreturn]] void malformed() const
  {
    run_state_format().reject(file, "not a run state");
  }

  std::istringstream in;
  const std::string file;
};

/** Whatever else a scene says decides about the numbers of a run. */
bool decides(const std::string &section, const std::string &entry)
{
  const bool limit = section == "Adaptivity" &&
                     (entry.rfind("Maximum ", 0) == 0 || entry.rfind("Tolerance", 0) == 0) &&
                     entry != "Maximum degree";
  return !limit && section != "Output" && section != "Error" && section != "Units" &&
         entry != "Title" && entry != "Threads";
}
} // namespace

template <int dim>
std::vector<std::string> RunState<dim>::entries_of(const Scene<dim> &scene,
                                                   const unsigned int n_processes)
{
  std::vector<std::string> result = hpvi::entries_of(effective_parameters(scene), decides);
  // Several processes name the path that one finds by itself.
  std::replace(result.begin(), result.end(), std::string("Solver/Path = auto"),
               std::string("Solver/Path = ") +
                   (takes_primal_path(scene, n_processes) ? "primal" : "reduced"));
  if (!result.empty()) // digits belong to the program
    result.insert(result.begin(), "hpvi = " + version());
  return result;
}

template <int dim>
void RunState<dim>::require_scene(const Scene<dim> &scene, const unsigned int n_processes) const
{
  format().check_entries(name, entries, entries_of(scene, n_processes));
}

template <int dim>
const FileFormat &RunState<dim>::format()
{
  return run_state_format();
}

template <int dim>
void RunState<dim>::write(std::ostream &out) const
{
  std::ostringstream content;
  content << "entries " << entries.size() << '\n';
  for (const std::string &entry : entries)
    content << entry << '\n';
  content << "steps " << history.size() << '\n';
  for (const PastStep<dim> &step : history)
  {
    content << text(step.estimate) << ' ' << text(step.relative_estimate) << ' '
            << text(step.relative_bound) << ' ' << text(step.relative_half_width) << ' '
            << text(step.seconds) << ' ' << step.lacks_condition << ' ' << text(step.hysteresis);
    write_extrema(content, step.extrema);
    write_claims(content, step.claims, step.contradiction);
  }
  content << "refinements " << refinements.size() << '\n';
  for (const MeshMarks &marks : refinements)
    write_marks(content, marks);
  content << "kept " << values.kept.size();
  for (const unsigned int number : values.kept)
    content << ' ' << number;
  content << '\n';
  write_loads(content, loads.value_or(FinishedLoads()));
  write_values(content, "motion", values.motion);
  write_values(content, "shortenings", values.shortenings);
  write_values(content, "u", values.u);
  write_values(content, "z", values.z);
  format().write(out, content.str());
}

template <int dim>
RunState<dim> RunState<dim>::read(std::istream &in, const std::string &name)
{
  Reader reader(format().read(in, name), name);
  RunState state;
  state.name = name;
  reader.expect("entries");
  state.entries = reader.lines(reader.number<unsigned int>());
  reader.expect("steps");
  for (unsigned int n = reader.number<unsigned int>(); n > 0; --n)
  {
    PastStep<dim> &step = state.history.emplace_back();
    step.estimate = reader.number<double>();
    step.relative_estimate = reader.number<double>();
    step.relative_bound = reader.number<double>();
    step.relative_half_width = reader.number<double>();
    step.seconds = reader.number<double>();
    step.lacks_condition = reader.number<unsigned int>() != 0;
    step.hysteresis = reader.number<double>();
    step.extrema = reader.template extrema<dim>();
    reader.claims(step.claims, step.contradiction);
  }
  reader.expect("refinements");
  for (unsigned int n = reader.number<unsigned int>(); n > 0; --n)
    state.refinements.push_back(reader.marks());
  reader.expect("kept");
  for (unsigned int n = reader.number<unsigned int>(); n > 0; --n)
    state.values.kept.push_back(reader.number<unsigned int>());
  reader.expect("loads");
  if (const FinishedLoads loads = reader.loads(); loads.load.number > 0)
    state.loads = loads;
  state.values.motion = reader.values("motion");
  state.values.shortenings = reader.values("shortenings");
  state.values.u = reader.values("u");
  state.values.z = reader.values("z");
  return state;
}

template struct RunState<2>;
template struct RunState<3>;
} // namespace hpvi
