// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/input_error.h>
#include <hpvi/base/processes.h>
#include <hpvi/base/text.h>
#include <hpvi/output/forces_table.h>
#include <hpvi/output/probe_table.h>
#include <hpvi/output/tables.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <numeric>

namespace hpvi
{
using namespace dealii;

Record stage_record(const StageTimes &times)
{
  Record record;
  for (const auto &[name, seconds] : times.named())
    record.emplace_back(name, text(seconds, 6));
  return record;
}

namespace
{
/** Where stick meets slip: points separated by blanks, coordinates by slashes. */
template <int dim>
std::string transition_list(const std::vector<Point<dim>> &points)
{
  std::string list;
  for (const Point<dim> &x : points)
  {
    list += list.empty() ? "" : " ";
    for (unsigned int d = 0; d < dim; ++d)
      list += (d > 0 ? "/" : "") + text(x[d], 10);
  }
  return list;
}

/** Directions are the same all along one contact boundary alone; else empty. */
template <int dim>
std::string resultant(const std::vector<ContactState<dim>> &contact,
                      const std::function<double(const ContactState<dim> &)> &component)
{
  return contact.size() == 1 ? text(component(contact.front())) : "";
}

/** What there is of every step, and of an iteration on the multipliers. */
template <int dim>
Record solution_record(const StepReport<dim> &step)
{
  const QpReport *const qp = step.reduced ? &step.reduced->qp : nullptr;
  const auto of_qp = [&](const auto QpReport::*const count)
  { return qp ? text(qp->*count) : std::string(); };
  const auto condition = [](const double value) { return value == 0 ? "" : known(value); };
  return {{"step", text(step.number)},
          {"elements", text(step.size.n_cells)},
          {"dofs", text(step.size.n_dofs)},
          {"dofs_free", text(step.size.n_free)},
          {"multipliers", text(step.size.n_multipliers)},
          {"p_min", text(step.size.p_min())},
          {"p_max", text(step.size.p_max())},
          {"estimate", text(step.norms.total)},
          {"lagrangian", text(step.energies.lagrangian)},
          {"energy", text(step.energies.energy)},
          {"slack", text(step.energies.slack)},
          {"qp_multiplications", of_qp(&QpReport::multiplications)},
          {"seconds", text(step.seconds, 6)},
          {"estimate_volume", text(step.norms.volume)},
          {"estimate_jumps", text(step.norms.jumps)},
          {"estimate_neumann", text(step.norms.neumann)},
          {"estimate_contact", text(step.norms.contact)},
          {"qp_cg", of_qp(&QpReport::cg_steps)},
          {"qp_expansion", of_qp(&QpReport::expansion_steps)},
          {"qp_proportioning", of_qp(&QpReport::proportioning_steps)},
          {"qp_dense_solves", of_qp(&QpReport::dense_solves)},
          {"qp_fell_back", qp ? text(static_cast<unsigned int>(qp->fell_back)) : ""},
          {"qp_projected_gradient", of_qp(&QpReport::projected_gradient)},
          {"condition_raw", step.reduced ? condition(step.reduced->condition_raw) : ""},
          {"condition_scaled", step.reduced ? condition(step.reduced->condition_scaled) : ""},
          {"estimate_scaled", text(step.scaled_estimate)},
          {"estimate_relative", known(step.relative_estimate)},
          {"energy_norm", text(step.energies.norm)}};
}

/** In the plane, where it has one direction. */
std::string tangential_resultant(const std::vector<ContactState<2>> &contact)
{
  return resultant<2>(contact, [](const auto &state) { return state.friction_resultant; });
}

std::string tangential_resultant(const std::vector<ContactState<3>> &)
{
  return {};
}

/** Contact, and errors where they are known. */
template <int dim>
Record contact_record(const StepReport<dim> &step)
{
  return {{"friction_resultant", tangential_resultant(step.contact)},
          {"error_energy", known(step.errors.energy)},
          {"error_relative", known(step.errors.energy / step.errors.energy_norm)},
          {"error_l2", known(step.errors.l2)},
          {"error_multiplier", known(step.errors.multiplier_l2)},
          {"error_transition", known(step.errors.transition)},
          {"energy_difference", known(step.energies.energy - step.errors.reference_energy)},
          {"effectivity", known(step.scaled_estimate / step.errors.energy)},
          {"transitions", transition_list(transitions(step.contact))},
          {"normal_resultant",
           resultant<dim>(step.contact, [](const auto &state) { return state.normal_resultant; })},
          {"error_pressure", known(step.errors.pressure_l2)},
          {"estimate_normal", text(step.norms.normal)},
          {"estimate_penetration", text(step.norms.penetration)}};
}

/** Coulomb's law. */
template <int dim>
Record coulomb_record(const StepReport<dim> &step)
{
  const bool is_coulomb = step.scene.has_coulomb_friction();
  const CoulombReport *const report = step.reduced && is_coulomb ? &step.reduced->coulomb : nullptr;
  const NewtonReport *const primal = step.primal && is_coulomb ? &step.primal->newton : nullptr;
  const double contraction = report ? report->contraction : primal ? primal->contraction : 0.;
  return {{"coulomb_newton", report ? text(report->newton_steps) : ""},
          {"coulomb_fixed_point", report   ? text(report->fixed_point_steps)
                                  : primal ? text(primal->tresca_problems)
                                           : ""},
          {"coulomb_contraction", contraction != 0 ? known(contraction) : ""},
          {"coulomb_method", report   ? report->method
                             : primal ? "fixed point"
                                      : ""},
          {"estimate_tension", text(step.norms.tension)},
          {"estimate_excess", text(step.norms.excess)},
          {"coulomb_difference", report && report->difference ? known(*report->difference) : ""}};
}

/** The guaranteed bound. */
template <int dim>
Record bound_record(const StepReport<dim> &step)
{
  const auto bound = [&](double ErrorBound::*const part)
  { return step.bound ? text((*step.bound).*part) : ""; };
  // J(u) lies between the two; J(u_N) itself need not, where u_N penetrates the foundation.
  const auto end = [&](const int sign, double ErrorBound::*const distance)
  { return step.bound ? text(step.energies.energy + sign * (*step.bound).*distance) : ""; };
  const double high = step.energy_high; // where there is no bound
  return {{"error_bound", bound(&ErrorBound::total)},
          {"error_bound_relative", known(step.relative_bound)},
          {"energy_low", end(-1, &ErrorBound::energy_below)},
          {"energy_high", step.bound ? end(1, &ErrorBound::energy_above) : known(high)},
          {"bound_stress", bound(&ErrorBound::stress)},
          {"bound_slip", bound(&ErrorBound::slip)},
          {"bound_oscillation", bound(&ErrorBound::oscillation)},
          {"bound_data", bound(&ErrorBound::data)},
          {"bound_imbalance", known(step.bound_imbalance)}};
}

/** Seconds by stage and where a history stands. */
template <int dim>
Record time_record(const StepReport<dim> &step)
{
  Record record;
  for (const auto &[stage, seconds] : stage_record(step.times))
    record.emplace_back("seconds_" + stage, seconds);
  if (step.load.number > 0)
  {
    record.emplace_back("load_step", text(step.load.number));
    record.emplace_back("t", text(step.load.t));
  }
  return record;
}

/** The primal path, and what it takes. */
template <int dim>
Record newton_record(const StepReport<dim> &step)
{
  const NewtonReport *const newton = step.primal ? &step.primal->newton : nullptr;
  const auto of = [&](const auto NewtonReport::*const count)
  { return newton ? text(newton->*count) : std::string(); };
  Record record{
      {"newton_steps", of(&NewtonReport::steps)},
      {"newton_cg", of(&NewtonReport::cg_steps)},
      {"newton_setups", of(&NewtonReport::setups)},
      {"newton_fell_back", newton ? text(static_cast<unsigned int>(newton->fell_back)) : ""},
      {"newton_line_searches", of(&NewtonReport::line_searches)},
      {"newton_residual", of(&NewtonReport::residual)},
      {"newton_error", of(&NewtonReport::error)},
      {"augmented_steps", of(&NewtonReport::augmented_steps)},
      {"slipping", of(&NewtonReport::n_slipping)},
      {"pressing", of(&NewtonReport::n_pressing)},
      {"peak_memory", text(step.peak_memory)},
      {"processes", text(hpvi::n_processes(step.field.communicator()))}};
  for (unsigned int d = 0; d < 3; ++d)
    record.emplace_back(std::string("friction_resultant_") + "xyz"[d],
                        d < dim ? resultant<dim>(step.contact, [d](const auto &state)
                                                 { return state.friction_force[d]; })
                                : "");
  return record;
}

/** The row of convergence.csv, the same columns in the plane and in space, whichever backend solved. */
template <int dim>
Record convergence_record(const StepReport<dim> &step)
{
  Record record;
  for (const Record &part :
       {solution_record(step), contact_record(step), coulomb_record(step), bound_record(step),
        time_record(step), newton_record(step), probe_record(step)})
    record.insert(record.end(), part.begin(), part.end());
  return record;
}

/** The length of all zones of one mode. */
template <int dim>
double length(const ContactState<dim> &state, const ContactMode mode)
{
  double sum = 0;
  for (const ContactZone<dim> &zone : state.zones)
    sum += zone.mode == mode ? zone.begin.distance(zone.end) : 0.;
  return sum;
}

/** The row of loading.csv. */
template <int dim>
Record loading_record(const StepReport<dim> &step)
{
  Record record{
      {"load_step", text(step.load.number)}, {"t", text(step.load.t)},
      {"step", text(step.number)},           {"dissipated_energy", text(step.load.dissipated)},
      {"work", text(step.load.work)},        {"stored_energy", text(step.load.stored)}};
  std::vector<BoundaryForce<dim>> forces = step.equilibrium.reactions;
  forces.insert(forces.begin(), step.equilibrium.loads);
  for (const BoundaryForce<dim> &force : forces)
    for (unsigned int d = 0; d < dim; ++d)
      record.emplace_back("force_" + force.boundary + "_" + "xyz"[d], known(force.force[d]));
  for (const ContactState<dim> &state : step.contact)
    for (const ContactMode mode : {ContactMode::open, ContactMode::slip, ContactMode::stick})
      record.emplace_back(mode_name(mode) + "_" + step.scene.boundaries[state.boundary].name,
                          text(length(state, mode)));
  record.emplace_back("stopped_by", step.stopped_by);
  record.emplace_back("released_energy", text(step.load.released));
  record.emplace_back("unbalanced_energy", text(step.load.unbalanced));
  const Record displacements = prescribed_displacements(step);
  record.insert(record.end(), displacements.begin(), displacements.end());
  record.emplace_back("dissipated_energy_trapezoidal", text(step.load.trapezoidal));
  return record;
}

} // namespace

template <int dim>
void Tables<dim>::add(const StepReport<dim> &step)
{
  row = convergence_record(step);
  add_row(rows, row);
  add_rows(force_rows, forces_rows(step));
  elements.push_back(step.size.cells_of_degree);
  add_degrees();
  if (step.load.number > 0 && !step.stopped_by.empty())
    add_row(load_steps, loading_record(step));
}

namespace
{
unsigned int whole_number(const std::string &field)
{
  unsigned int result = 0;
  const char *const end = field.data() + field.size();
  if (field.empty() || std::from_chars(field.data(), end, result).ptr != end)
    throw InputError("a table has " + printable(field) + " in the place of a whole number");
  return result;
}

/** N of the column "pN", or 0. */
unsigned int degree_of(const std::string &column)
{
  return column.size() > 1 && column[0] == 'p' ? whole_number(column.substr(1)) : 0;
}
} // namespace

template <int dim>
std::vector<Record>
Tables<dim>::take_up(const unsigned int n_steps, const bool is_history,
                     const std::function<std::string(const std::string &)> &content_of)
{
  std::vector<Record> of_steps = records(content_of("convergence.csv")),
                      of_degrees = records(content_of("degrees.csv"));
  if (of_steps.size() < n_steps || of_degrees.size() < n_steps)
    throw InputError("convergence.csv or degrees.csv has fewer rows than the run has steps");
  of_steps.resize(n_steps);
  of_degrees.resize(n_steps);
  add_rows(rows, of_steps);
  row = of_steps.back();
  for (const Record &forces_of_step : records(content_of("forces.csv")))
    if (whole_number(forces_of_step.front().second) <= n_steps)
      add_row(force_rows, forces_of_step);
  unsigned int last = is_history ? 0 : n_steps;
  for (const Record &load_step : records(is_history ? content_of("loading.csv") : ""))
    if (const unsigned int step = whole_number(value_of(load_step, "step")); step <= n_steps)
    {
      add_row(load_steps, load_step);
      last = step;
    }
  if (last != n_steps)
    throw InputError("loading.csv lacks the row of step " + std::to_string(n_steps));
  for (const Record &record : of_degrees)
  {
    elements.emplace_back();
    for (const auto &[column, number] : record)
      if (const unsigned int p = degree_of(column); p > 0 && number != "0")
      {
        elements.back().resize(p + 1);
        elements.back()[p] = whole_number(number);
      }
    add_degrees();
  }
  rows.same = force_rows.same = degree_rows.same = load_steps.same = 0;
  return of_steps;
}

/** The row of the last step; with a column more, all rows. */
template <int dim>
void Tables<dim>::add_degrees()
{
  const bool grows = elements.back().size() > n_columns;
  if (grows)
  {
    degree_rows = {};
    n_columns = elements.back().size();
  }
  for (std::size_t k = grows ? 0 : elements.size() - 1; k < elements.size(); ++k)
  {
    const auto &count = elements[k];
    Record record{
        {"step", std::to_string(k + 1)},
        {"elements", text(std::accumulate(count.begin(), count.end(), types::global_dof_index()))}};
    for (unsigned int p = 1; p < n_columns; ++p)
      record.emplace_back("p" + text(p), text(p < count.size() ? count[p] : 0));
    add_row(degree_rows, record);
  }
  if (grows)
    degree_rows.same = 0;
}

template <int dim>
const Record &Tables<dim>::last_row() const
{
  return row;
}

template <int dim>
const GrowingText &Tables<dim>::convergence() const
{
  return rows;
}

template <int dim>
const GrowingText &Tables<dim>::degrees() const
{
  return degree_rows;
}

template <int dim>
const GrowingText &Tables<dim>::forces() const
{
  return force_rows;
}

template <int dim>
const GrowingText &Tables<dim>::loading() const
{
  return load_steps;
}

template class Tables<2>;
template class Tables<3>;
} // namespace hpvi
