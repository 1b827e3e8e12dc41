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
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

namespace hpvi
{
using namespace dealii;

Record stage_record(const StageTimes &times)
{
  Record record;
  for (const auto &[name, seconds] : times.named())
    record.emplace_back(name, rounded(seconds, 6));
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
Value resultant(const std::vector<ContactState<dim>> &contact,
                const std::function<double(const ContactState<dim> &)> &component)
{
  return contact.size() == 1 ? Value(component(contact.front())) : Value();
}

/** What there is of every step, and of an iteration on the multipliers. */
template <int dim>
Record solution_record(const StepReport<dim> &step)
{
  const QpReport *const qp = step.reduced ? &step.reduced->qp : nullptr;
  const auto of_qp = [&](const auto QpReport::*const count)
  { return qp ? Value(qp->*count) : Value(); };
  const auto condition = [](const double value) { return value == 0 ? Value() : Value(value); };
  return {{"step", step.number},
          {"elements", step.size.n_cells},
          {"dofs", step.size.n_dofs},
          {"dofs_free", step.size.n_free},
          {"multipliers", step.size.n_multipliers},
          {"p_min", step.size.p_min()},
          {"p_max", step.size.p_max()},
          {"estimate", step.norms.total},
          {"lagrangian", step.energies.lagrangian},
          {"energy", step.energies.energy},
          {"slack", step.energies.slack},
          {"qp_multiplications", of_qp(&QpReport::multiplications)},
          {"seconds", rounded(step.seconds, 6)},
          {"estimate_volume", step.norms.volume},
          {"estimate_jumps", step.norms.jumps},
          {"estimate_neumann", step.norms.neumann},
          {"estimate_contact", step.norms.contact},
          {"qp_cg", of_qp(&QpReport::cg_steps)},
          {"qp_expansion", of_qp(&QpReport::expansion_steps)},
          {"qp_proportioning", of_qp(&QpReport::proportioning_steps)},
          {"qp_dense_solves", of_qp(&QpReport::dense_solves)},
          {"qp_fell_back", qp ? Value(static_cast<unsigned int>(qp->fell_back)) : Value()},
          {"qp_projected_gradient", of_qp(&QpReport::projected_gradient)},
          {"condition_raw", step.reduced ? condition(step.reduced->condition_raw) : Value()},
          {"condition_scaled", step.reduced ? condition(step.reduced->condition_scaled) : Value()},
          {"estimate_scaled", step.scaled_estimate},
          {"estimate_relative", step.relative_estimate},
          {"energy_norm", step.energies.norm}};
}

/** Contact, and errors where they are known. */
template <int dim>
Record contact_record(const StepReport<dim> &step)
{
  Value friction; // in the plane, where it has one direction
  if constexpr (dim == 2)
    friction =
        resultant<2>(step.contact, [](const auto &state) { return state.friction_resultant; });
  return {{"friction_resultant", friction},
          {"error_energy", step.errors.energy},
          {"error_relative", step.errors.energy / step.errors.energy_norm},
          {"error_l2", step.errors.l2},
          {"error_multiplier", step.errors.multiplier_l2},
          {"error_transition", step.errors.transition},
          {"energy_difference", step.energies.energy - step.errors.reference_energy},
          {"effectivity", step.scaled_estimate / step.errors.energy},
          {"transitions", transition_list(transitions(step.contact))},
          {"normal_resultant",
           resultant<dim>(step.contact, [](const auto &state) { return state.normal_resultant; })},
          {"error_pressure", step.errors.pressure_l2},
          {"estimate_normal", step.norms.normal},
          {"estimate_penetration", step.norms.penetration}};
}

/** Coulomb's law. */
template <int dim>
Record coulomb_record(const StepReport<dim> &step)
{
  const bool is_coulomb = step.scene.has_coulomb_friction();
  const CoulombReport *const report = step.reduced && is_coulomb ? &step.reduced->coulomb : nullptr;
  const NewtonReport *const primal = step.primal && is_coulomb ? &step.primal->newton : nullptr;
  const double contraction = report ? report->contraction : primal ? primal->contraction : 0.;
  return {
      {"coulomb_newton", report ? Value(report->newton_steps) : Value()},
      {"coulomb_fixed_point", report   ? Value(report->fixed_point_steps)
                              : primal ? Value(primal->tresca_problems)
                                       : Value()},
      {"coulomb_contraction", contraction != 0 ? Value(contraction) : Value()},
      {"coulomb_method", report   ? report->method
                         : primal ? "fixed point"
                                  : ""},
      {"estimate_tension", step.norms.tension},
      {"estimate_excess", step.norms.excess},
      {"coulomb_difference", report && report->difference ? Value(*report->difference) : Value()}};
}

/** The guaranteed bound. */
template <int dim>
Record bound_record(const StepReport<dim> &step)
{
  const auto bound = [&](double ErrorBound::*const part)
  { return step.bound ? Value((*step.bound).*part) : Value(); };
  // J(u) lies between the two; J(u_N) itself need not, where u_N penetrates the foundation.
  const auto end = [&](const int sign, double ErrorBound::*const distance)
  { return step.bound ? Value(step.energies.energy + sign * (*step.bound).*distance) : Value(); };
  const double high = step.energy_high; // where there is no bound
  const bool has_energy = step.bound && step.bound->kind == BoundKind::energy;
  return {{"error_bound", bound(&ErrorBound::total)},
          {"error_bound_relative", step.relative_bound},
          {"energy_low", has_energy ? end(-1, &ErrorBound::energy_below) : Value()},
          {"energy_high", has_energy ? end(1, &ErrorBound::energy_above) : Value(high)},
          {"bound_stress", bound(&ErrorBound::stress)},
          {"bound_slip", bound(&ErrorBound::slip)},
          {"bound_oscillation", bound(&ErrorBound::oscillation)},
          {"bound_data", bound(&ErrorBound::data)},
          {"bound_imbalance", step.bound_imbalance}};
}

/** The bound without the factor of Coulomb's law, and what kind of one it is. */
template <int dim>
Record equilibrated_record(const StepReport<dim> &step)
{
  const auto &[norm, relative, coupling, kind, zones, known] = step.equilibrated;
  return {{"error_estimate_equilibrated", norm}, {"coupling", coupling}, {"bound_kind", kind}};
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
    record.emplace_back("load_step", step.load.number);
    record.emplace_back("t", step.load.t);
  }
  return record;
}

/** The primal path, and what it takes. */
template <int dim>
Record newton_record(const StepReport<dim> &step)
{
  const NewtonReport *const newton = step.primal ? &step.primal->newton : nullptr;
  const auto of = [&](const auto NewtonReport::*const count)
  { return newton ? Value(newton->*count) : Value(); };
  Record record{
      {"newton_steps", of(&NewtonReport::steps)},
      {"newton_cg", of(&NewtonReport::cg_steps)},
      {"newton_setups", of(&NewtonReport::setups)},
      {"newton_fell_back", newton ? Value(static_cast<unsigned int>(newton->fell_back)) : Value()},
      {"newton_line_searches", of(&NewtonReport::line_searches)},
      {"newton_residual", of(&NewtonReport::residual)},
      {"newton_error", of(&NewtonReport::error)},
      {"augmented_steps", of(&NewtonReport::augmented_steps)},
      {"slipping", of(&NewtonReport::n_slipping)},
      {"pressing", of(&NewtonReport::n_pressing)},
      {"peak_memory", step.peak_memory},
      {"processes", hpvi::n_processes(step.field.communicator())}};
  for (unsigned int d = 0; d < 3; ++d)
    record.emplace_back(std::string("friction_resultant_") + "xyz"[d],
                        d < dim ? resultant<dim>(step.contact, [d](const auto &state)
                                                 { return state.friction_force[d]; })
                                : Value());
  return record;
}

/** The row of convergence.csv, the same columns in the plane and in space, whichever backend solved. */
template <int dim>
Record convergence_record(const StepReport<dim> &step)
{
  Record record;
  for (const Record &part :
       {solution_record(step), contact_record(step), coulomb_record(step), bound_record(step),
        time_record(step), newton_record(step), equilibrated_record(step), probe_record(step)})
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
  Record record{{"load_step", step.load.number}, {"t", step.load.t},
                {"step", step.number},           {"dissipated_energy", step.load.dissipated},
                {"work", step.load.work},        {"stored_energy", step.load.stored}};
  std::vector<BoundaryForce<dim>> forces = step.equilibrium.reactions;
  forces.insert(forces.begin(), step.equilibrium.loads);
  for (const BoundaryForce<dim> &force : forces)
    for (unsigned int d = 0; d < dim; ++d)
      record.emplace_back("force_" + force.boundary + "_" + "xyz"[d], force.force[d]);
  for (const ContactState<dim> &state : step.contact)
    for (const ContactMode mode : {ContactMode::open, ContactMode::slip, ContactMode::stick})
      record.emplace_back(mode_name(mode) + "_" + step.scene.boundaries[state.boundary].name,
                          length(state, mode));
  record.emplace_back("stopped_by", text(step.stopped_by));
  record.emplace_back("released_energy", step.load.released);
  record.emplace_back("unbalanced_energy", step.load.unbalanced);
  const Record displacements = prescribed_displacements(step);
  record.insert(record.end(), displacements.begin(), displacements.end());
  record.emplace_back("dissipated_energy_trapezoidal", step.load.trapezoidal);
  if (step.load.cycle > 0)
    record.emplace_back("cycle", step.load.cycle);
  return record;
}

unsigned int whole_number(const Value &field)
{
  if (const std::uint64_t *const number = std::get_if<std::uint64_t>(&field);
      number && *number <= std::numeric_limits<unsigned int>::max())
    return *number;
  throw InputError("a table has " + printable(text(field)) + " in the place of a whole number");
}

/** N of the column "pN", or 0. */
unsigned int degree_of(const std::string &column)
{
  return column.size() > 1 && column[0] == 'p' ? whole_number(value_from(column.substr(1))) : 0;
}
} // namespace

std::vector<Record> cycle_rows(const std::vector<LoadCycle> &cycles)
{
  std::vector<Record> rows;
  for (const LoadCycle &cycle : cycles)
    rows.push_back({{"cycle", rows.size() + 1},
                    {"load_step", cycle.load_step},
                    {"dissipated_energy", cycle.dissipated},
                    {"work", cycle.work},
                    {"change", cycle.change}});
  return rows;
}

template <int dim>
void Tables<dim>::add(const StepReport<dim> &step)
{
  convergence.add({convergence_record(step)});
  forces.add(forces_rows(step));
  elements.push_back(step.size.cells_of_degree);
  add_degrees();
  if (step.load.number > 0 && !step.stopped_by.empty())
    loading.add({loading_record(step)});
}

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
  convergence.add(of_steps);
  for (const Record &force : records(content_of("forces.csv")))
    if (whole_number(force.front().second) <= n_steps)
      forces.add({force});
  unsigned int last = is_history ? 0 : n_steps;
  for (const Record &load_step : records(is_history ? content_of("loading.csv") : ""))
    if (const unsigned int step = whole_number(value_of(load_step, "step")); step <= n_steps)
    {
      loading.add({load_step});
      last = step;
    }
  if (last != n_steps)
    throw InputError("loading.csv lacks the row of step " + std::to_string(n_steps));
  for (const Record &record : of_degrees)
  {
    elements.emplace_back();
    for (const auto &[column, number] : record)
      if (const unsigned int p = degree_of(column), n = p > 0 ? whole_number(number) : 0; n > 0)
      {
        elements.back().resize(p + 1);
        elements.back()[p] = n;
      }
    add_degrees();
  }
  convergence.same = forces.same = degrees.same = loading.same = 0;
  return of_steps;
}

/** The row of the last step; with a column more, all rows. */
template <int dim>
void Tables<dim>::add_degrees()
{
  const bool grows = elements.back().size() > n_columns;
  if (grows)
  {
    degrees = {};
    n_columns = elements.back().size();
  }
  for (std::size_t k = grows ? 0 : elements.size() - 1; k < elements.size(); ++k)
  {
    const auto &count = elements[k];
    Record record{
        {"step", k + 1},
        {"elements", std::accumulate(count.begin(), count.end(), types::global_dof_index())}};
    for (unsigned int p = 1; p < n_columns; ++p)
      record.emplace_back("p" + text(p), p < count.size() ? count[p] : 0);
    degrees.add({record});
  }
  if (grows)
    degrees.same = 0;
}

template class Tables<2>;
template class Tables<3>;
} // namespace hpvi
