// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/tolerances.h>
#include <hpvi/bound/error_bound.h>
#include <hpvi/output/boundary_words.h>
#include <hpvi/output/chart.h>
#include <hpvi/output/colour_bands.h>
#include <hpvi/output/contact_picture.h>
#include <hpvi/output/html.h>
#include <hpvi/output/report_plots.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace hpvi
{
namespace
{
constexpr const char *blue = "#1f5fa8", *orange = "#e07b00", *green = "#00796b", *black = "#222";

double field(const Record &row, const std::string &column)
{
  return number_of(row, column).value_or(std::numeric_limits<double>::quiet_NaN());
}

bool has_points(const ChartLine &line)
{
  return std::any_of(line.points.begin(), line.points.end(),
                     [](const auto &point) { return std::isfinite(point[1]); });
}

/** Lines without a point are left out. */
ChartLine line_of(const std::vector<Record> &rows, const std::string &x, const std::string &y,
                  ChartLine line)
{
  for (const Record &row : rows)
    line.points.push_back({{field(row, x), field(row, y)}});
  return line;
}
} // namespace

std::string convergence_plot(const RunFiles &files)
{
  if (files.steps.size() == 1)
    return missing("There is one step, and no curve of its error.");
  const bool is_history = !files.loads.empty();
  const std::string over = is_history ? "step" : "dofs_free";
  Chart chart;
  chart.is_logarithmic = true;
  chart.x_label = is_history ? "step" : "free unknowns (logarithm of base 10)";
  chart.y_label = "relative to the solution";
  const bool is_contradicted = member(files.summary, "contradiction");
  bool is_of_energy = true;
  std::vector<Record> rows = files.steps;
  for (Record &row : rows)
  {
    const std::string kind = words_of(row, "bound_kind");
    is_of_energy = is_of_energy && (kind.empty() || kind == text(BoundKind::energy));
    const auto norm = number_of(row, "error_estimate_equilibrated"),
               whole = number_of(row, "energy_norm");
    if (norm && whole && !kind.empty() && kind != text(BoundKind::energy))
      row.emplace_back("estimate_equilibrated_relative", *norm / *whole);
  }
  for (ChartLine line :
       {line_of(rows, over, "error_bound_relative",
                {is_contradicted ? "bound, contradicted"
                 : is_of_energy  ? "guaranteed bound"
                                 : "bound, if the coupling is as estimated",
                 blue,
                 "",
                 true,
                 {}}),
        line_of(rows, over, "estimate_equilibrated_relative",
                {"estimate by equilibrated stress", blue, "6 3", !is_history, {}}),
        line_of(files.steps, over, "estimate_relative",
                {"indicator (no bound)", orange, "6 3", !is_history, {}}),
        line_of(files.steps, over, "error_relative", {"true error", black, "2 2", true, {}})})
    if (has_points(line))
    {
      for (auto &[x, y] : line.points)
        x = is_history ? x : std::log10(x);
      chart.lines.push_back(line);
    }
  if (chart.lines.empty())
    return missing("no step has a relative error indicator: there is nothing to draw");
  return figure(chart.svg(), "How the error falls from step to step: in the energy norm, over that "
                             "of the solution.");
}

// ---------------------------------------------------------------- contact

namespace
{
/** Rows of one contact, in the order along it. */
struct ContactRows
{
  std::string name; ///< of a pair, else of the boundary
  std::vector<Record> rows;

  std::string boundary() const
  {
    return words_of(rows.front(), "boundary");
  }

  /** As in "joint (upper.bottom)", of which answer and forces tell. */
  std::string title() const
  {
    return name + (name == boundary() ? "" : " (" + boundary() + ")");
  }
};

std::vector<ContactRows> by_contact(const std::vector<Record> &contact)
{
  std::vector<ContactRows> result;
  for (const Record &row : contact)
  {
    const std::string pair = words_of(row, "contact"),
                      name = pair.empty() ? words_of(row, "boundary") : pair;
    const auto found = std::find_if(result.begin(), result.end(),
                                    [&](const ContactRows &one) { return one.name == name; });
    ContactRows &own = found == result.end() ? result.emplace_back() : *found;
    own.name = name;
    own.rows.push_back(row);
  }
  return result;
}

/** From @p begin, where that is known, else from the first one: along straight lines from point to point. */
std::vector<double> arc_lengths(const std::vector<Record> &rows,
                                const std::optional<std::array<double, 2>> &begin)
{
  std::vector<double> lengths;
  std::array<double, 2> last =
      begin.value_or(std::array<double, 2>{{field(rows.front(), "x"), field(rows.front(), "y")}});
  double length = 0;
  for (const Record &row : rows)
  {
    const std::array<double, 2> x{{field(row, "x"), field(row, "y")}};
    length += std::hypot(x[0] - last[0], x[1] - last[1]);
    lengths.push_back(length);
    last = x;
  }
  return lengths;
}

/** Where the first zone begins. */
std::optional<std::array<double, 2>> begin_of(const JsonTree &summary, const ContactRows &rows)
{
  const JsonTree *const contacts = member(summary, "contact");
  const JsonTree *zones = nullptr;
  if (contacts) // a pair that has a part of a side alone is named behind it
    for (const std::string &name : {rows.boundary(), rows.boundary() + " (" + rows.name + ")"})
      if (const JsonTree *const contact = member(*contacts, name))
        zones = member(*contact, "zones");
  if (!zones || zones->empty())
    return std::nullopt;
  const JsonTree *const from = member(zones->front().second, "from");
  if (!from || from->size() < 2)
    return std::nullopt;
  std::array<double, 2> place{};
  auto coordinate = from->begin();
  for (double &value : place)
    value = number((coordinate++)->second.data()).value_or(0);
  return place;
}

/** States between points change in the middle. */
std::vector<ChartBand> bands_of(const std::vector<Record> &rows, const std::vector<double> &lengths)
{
  std::vector<ChartBand> bands;
  std::string last;
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    const std::string state = words_of(rows[k], "state");
    const double begin = k == 0 ? 0. : (lengths[k - 1] + lengths[k]) / 2,
                 end = k + 1 < rows.size() ? (lengths[k] + lengths[k + 1]) / 2 : lengths[k];
    if (state == last)
      bands.back().end = end;
    else
      bands.push_back({begin, end, state_colour(state)});
    last = state;
  }
  return bands;
}

/** Where the multiplier says what part of its bound a friction is. */
ChartLine friction_limit(const std::vector<Record> &rows, const std::vector<double> &lengths,
                         const double sign)
{
  ChartLine line{sign > 0 ? "limit of friction" : "", "#888", "3 3", false, {}};
  for (std::size_t k = 0; k < rows.size(); ++k)
  {
    const double share = std::abs(field(rows[k], "multiplier")),
                 friction = std::abs(field(rows[k], "tangential_traction"));
    line.points.push_back({{lengths[k], share > 1e-3 ? sign * friction / share
                                                     : std::numeric_limits<double>::quiet_NaN()}});
  }
  return line;
}

std::string contact_plot(const Scene<2> &scene, const RunFiles &files, const ContactRows &contact)
{
  const std::vector<double> lengths = arc_lengths(contact.rows, begin_of(files.summary, contact));
  Chart chart;
  chart.title = legible(contact.title());
  chart.x_label = with_unit_of("arc length", scene.length_unit);
  chart.y_label = with_unit_of("traction", scene.stress_unit);
  ChartLine pressure{"pressure -T_n", black, "", false, {}},
      friction{"friction T_t", green, "7 2", false, {}};
  std::vector<double> up, down;
  for (std::size_t k = 0; k < contact.rows.size(); ++k)
  {
    const double p = -field(contact.rows[k], "normal_traction"),
                 t = field(contact.rows[k], "tangential_traction");
    pressure.points.push_back({{lengths[k], p}});
    friction.points.push_back({{lengths[k], t}});
    up.push_back(std::max({p, t, 0.}));
    down.push_back(std::max({-p, -t, 0.}));
  }
  const bool has_friction = std::any_of(friction.points.begin(), friction.points.end(),
                                        [](const auto &point) { return point[1] != 0; });
  chart.lines = {pressure};
  if (has_friction)
    for (const ChartLine &line : {friction_limit(contact.rows, lengths, 1),
                                  friction_limit(contact.rows, lengths, -1), friction})
      chart.lines.push_back(line);
  chart.highest = std::max(cut_off(up), 0.2 * cut_off(down));
  chart.lowest = -std::max(cut_off(down), 0.2 * cut_off(up));
  chart.bands = bands_of(contact.rows, lengths);
  for (const std::string state : {"open", "slip", "stick"})
    chart.names.emplace_back(state, state_colour(state));
  const bool is_cut = *std::max_element(up.begin(), up.end()) > *chart.highest ||
                      *std::max_element(down.begin(), down.end()) > -*chart.lowest;
  return figure(chart.svg(), "Contact " + contact.title() +
                                 " over its arc length; below it open, slip and stick." +
                                 (is_cut ? " Values at its ends are larger than the chart." : ""));
}

std::string contact_plot(const Scene<3> &scene, const RunFiles &, const ContactRows &contact)
{
  return figure(contact_picture(contact.rows, scene.stress_unit),
                "Contact " + contact.name + ": its states, and the pressure on it.");
}
} // namespace

template <int dim>
std::string contact_plots(const Scene<dim> &scene, const RunFiles &files)
{
  if (!scene.has_contact())
    return {};
  if (files.contact.empty())
    return missing("no chart of contact: there is no " + std::string("contact-NN.csv") +
                   " of the last step; set Output/Contact tables = true to have it");
  constexpr unsigned int most = 4; // of more charts nobody would see any
  std::string charts;
  unsigned int n = 0;
  for (const ContactRows &contact : by_contact(files.contact))
    if (++n <= most)
      charts += contact_plot(scene, files, contact);
  return charts +
         (n > most ? missing("contact-NN.csv has " + text(n - most) + " contacts more") : "");
}

// ---------------------------------------------------------------- load histories

namespace
{
/** Force over displacement where that changes from load step to load step; else nothing. */
template <int dim>
std::string loop(const Scene<dim> &scene, const RunFiles &files, const std::string &boundary,
                 const unsigned int component)
{
  const std::string end = boundary + "_" + "xyz"[component], axis(1, "xyz"[component]);
  const ChartLine line =
      line_of(files.loads, "displacement_" + end, "force_" + end, {"", blue, "", true, {}});
  const auto [least, largest] = std::minmax_element(line.points.begin(), line.points.end());
  const double change = (*largest)[0] - (*least)[0],
               size = std::max(std::abs((*largest)[0]), std::abs((*least)[0]));
  if (!(change > unseen_in_picture * size) || !has_points(line))
    return {};
  Chart chart;
  chart.x_label = with_unit_of("u" + axis + " of " + boundary, scene.length_unit);
  chart.y_label = with_unit_of("force " + axis + " on " + boundary,
                               force_unit(scene.stress_unit, scene.length_unit));
  chart.lines = {line};
  return figure(chart.svg(), "Load history: force over displacement of " + boundary +
                                 "; the area of a loop is what a cycle takes.");
}

/** Columns of contact-history.csv over the arc length of one contact; nothing where all are zero. */
std::string history_plot(const RunFiles &files, const ContactRows &contact,
                         const std::string &label,
                         const std::vector<std::pair<std::string, std::string>> &columns,
                         const std::string &length_unit)
{
  const std::vector<double> lengths = arc_lengths(contact.rows, begin_of(files.summary, contact));
  const std::array<const char *, 2> colours{{black, orange}}, dashes{{"", "6 3"}};
  Chart chart;
  chart.title = legible(contact.title());
  chart.x_label = with_unit_of("arc length", length_unit);
  chart.y_label = label;
  bool has_any = false;
  for (const auto &[column, words] : columns)
  {
    ChartLine line{words, colours[chart.lines.size()], dashes[chart.lines.size()], false, {}};
    for (std::size_t k = 0; k < contact.rows.size(); ++k)
    {
      line.points.push_back({{lengths[k], field(contact.rows[k], column)}});
      has_any = has_any || line.points.back()[1] > 0;
    }
    chart.lines.push_back(line);
  }
  return has_any ? figure(chart.svg(), "Load history: over the arc length of contact " +
                                           contact.title() + ", up to its end.")
                 : "";
}

std::string history_plots(const Scene<3> &, const RunFiles &)
{
  return {};
}

/** Of as many contacts as one looks at. */
std::string history_plots(const Scene<2> &scene, const RunFiles &files)
{
  constexpr unsigned int most = 2;
  std::string charts;
  unsigned int n = 0;
  const std::string length = scene.length_unit, stress = scene.stress_unit;
  for (const ContactRows &contact : by_contact(files.history))
    if (++n <= most)
      charts +=
          (n > 1 ? ""
                 : history_plot(files, contact, with_unit_of("largest traction", stress),
                                {{"pressure_max", "pressure"}, {"shear_max", "shear"}}, length)) +
          history_plot(files, contact, with_unit_of("slip", length),
                       {{"slip_path", "path"}, {"slip_range", "range"}}, length) +
          history_plot(files, contact, with_unit_of("wear depth", length),
                       {{"wear_depth", "depth"}}, length);
  return charts;
}

std::string cycles_plot(const RunFiles &files, const std::string &unit)
{
  if (files.cycles.size() < 2)
    return {};
  Chart chart;
  chart.x_label = "cycle";
  chart.y_label = with_unit_of("dissipated energy", unit);
  chart.lines = {line_of(files.cycles, "cycle", "dissipated_energy", {"", orange, "", true, {}})};
  return figure(chart.svg(), "Load history: what friction dissipates in each cycle.");
}

std::string energies_plot(const RunFiles &files, const std::string &unit)
{
  Chart chart;
  const std::string over = files.cycles.empty() ? "t" : "load_step"; // each cycle has the same t
  chart.x_label = files.cycles.empty() ? "t" : "load step";
  chart.y_label = with_unit_of("energy", unit);
  for (const ChartLine &line :
       {line_of(files.loads, over, "work", {"work", black, "", false, {}}),
        line_of(files.loads, over, "stored_energy", {"stored", blue, "6 3", false, {}}),
        line_of(files.loads, over, "dissipated_energy", {"dissipated", orange, "2 2", true, {}})})
    chart.lines.push_back(line);
  return figure(chart.svg(), "Load history: work of the loads, and what became of it.");
}
} // namespace

template <int dim>
std::string loading_plots(const Scene<dim> &scene, const RunFiles &files)
{
  if (files.loads.size() < 2)
    return {};
  std::string charts;
  unsigned int n_loops = 0;
  constexpr unsigned int most = 2;
  for (const BoundaryCondition<dim> &boundary : scene.boundaries)
    for (unsigned int d = 0; d < dim && n_loops < most; ++d)
      if (const std::string chart = loop(scene, files, boundary.name, d); !chart.empty())
      {
        charts += chart;
        ++n_loops;
      }
  return charts + history_plots(scene, files) +
         cycles_plot(files, moment_unit(scene.stress_unit, scene.length_unit)) +
         energies_plot(files, moment_unit(scene.stress_unit, scene.length_unit));
}

template std::string contact_plots(const Scene<2> &, const RunFiles &);
template std::string contact_plots(const Scene<3> &, const RunFiles &);
template std::string loading_plots(const Scene<2> &, const RunFiles &);
template std::string loading_plots(const Scene<3> &, const RunFiles &);
} // namespace hpvi
