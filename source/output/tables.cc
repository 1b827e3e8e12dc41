// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/output/tables.h>

#include <algorithm>
#include <cmath>
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
/** Square root of the sum of one of the squared contributions to the estimate. */
std::string root_of_sum(const std::vector<double> &squares)
{
  return text(std::sqrt(std::accumulate(squares.begin(), squares.end(), 0.)));
}
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
                      double ContactState<dim>::*const component)
{
  return contact.size() == 1 ? text(contact.front().*component) : "";
}

/** The row of convergence.csv. */
template <int dim>
Record convergence_record(const StepReport<dim> &step)
{
  const DisplacementSpace<dim> &space = step.solution.displacement_space;
  const auto [p_min, p_max] = std::minmax_element(space.degrees().begin(), space.degrees().end());
  const auto known = [](const double value) { return std::isfinite(value) ? text(value) : ""; };
  const auto condition = [&](const double value) { return value == 0 ? "" : known(value); };
  const bool coulomb = step.solution.scene.has_coulomb_friction();
  Record record{
      {"step", text(step.number)},
      {"elements", text(space.triangulation().n_active_cells())},
      {"dofs", text(space.n_dofs())},
      {"dofs_free", text(space.n_free_dofs())},
      {"multipliers", text(step.solution.contact_space.n_multipliers())},
      {"p_min", text(*p_min)},
      {"p_max", text(*p_max)},
      {"estimate", text(step.estimate.total())},
      {"lagrangian", text(step.energies.lagrangian)},
      {"energy", text(step.energies.energy)},
      {"slack", text(step.energies.slack)},
      {"qp_multiplications", text(step.qp.multiplications)},
      {"seconds", text(step.seconds, 6)},
      {"estimate_volume", root_of_sum(step.estimate.volume)},
      {"estimate_jumps", root_of_sum(step.estimate.jumps)},
      {"estimate_neumann", root_of_sum(step.estimate.neumann)},
      {"estimate_contact", root_of_sum(step.estimate.contact)},
      {"qp_cg", text(step.qp.cg_steps)},
      {"qp_expansion", text(step.qp.expansion_steps)},
      {"qp_proportioning", text(step.qp.proportioning_steps)},
      {"qp_dense_solves", text(step.qp.dense_solves)},
      {"qp_fell_back", text(static_cast<unsigned int>(step.qp.fell_back))},
      {"qp_projected_gradient", text(step.qp.projected_gradient)},
      {"condition_raw", condition(step.condition_raw)},
      {"condition_scaled", condition(step.condition_scaled)},
      {"estimate_scaled", text(step.scaled_estimate)},
      {"estimate_relative", known(step.relative_estimate)},
      {"energy_norm", text(step.energies.norm)},
      {"friction_resultant", resultant(step.contact, &ContactState<dim>::friction_resultant)},
      {"error_energy", known(step.errors.energy)},
      {"error_relative", known(step.errors.energy / step.errors.energy_norm)},
      {"error_l2", known(step.errors.l2)},
      {"error_multiplier", known(step.errors.multiplier_l2)},
      {"error_transition", known(step.errors.transition)},
      {"energy_difference", known(step.energies.energy - step.errors.reference_energy)},
      {"effectivity", known(step.scaled_estimate / step.errors.energy)},
      {"transitions", transition_list(transitions(step.contact))},
      {"normal_resultant", resultant(step.contact, &ContactState<dim>::normal_resultant)},
      {"error_pressure", known(step.errors.pressure_l2)},
      {"estimate_normal", root_of_sum(step.estimate.normal)},
      {"estimate_penetration", root_of_sum(step.estimate.penetration)},
      {"coulomb_newton", coulomb ? text(step.coulomb.newton_steps) : ""},
      {"coulomb_fixed_point", coulomb ? text(step.coulomb.fixed_point_steps) : ""},
      {"coulomb_contraction", coulomb ? condition(step.coulomb.contraction) : ""},
      {"coulomb_method", step.coulomb.method},
      {"estimate_tension", root_of_sum(step.estimate.tension)},
      {"estimate_excess", root_of_sum(step.estimate.excess)},
      {"coulomb_difference", step.coulomb.difference ? known(*step.coulomb.difference) : ""}};
  const auto bound = [&](double ErrorBound::*const part)
  { return step.bound ? text((*step.bound).*part) : ""; };
  // J(u) lies between the two; J(u_N) itself need not, where u_N penetrates the foundation.
  const auto end = [&](const double J, const int sign, double ErrorBound::*const distance)
  { return step.bound ? text(J + sign * (*step.bound).*distance) : ""; };
  record.insert(record.end(),
                {{"error_bound", bound(&ErrorBound::total)},
                 {"error_bound_relative", known(step.relative_bound)},
                 {"energy_low", end(step.energies.energy, -1, &ErrorBound::energy_below)},
                 {"energy_high", end(step.energies.energy, 1, &ErrorBound::energy_above)},
                 {"bound_stress", bound(&ErrorBound::stress)},
                 {"bound_slip", bound(&ErrorBound::slip)},
                 {"bound_oscillation", bound(&ErrorBound::oscillation)},
                 {"bound_data", bound(&ErrorBound::data)},
                 {"bound_imbalance", known(step.bound_imbalance)}});
  for (const auto &[stage, seconds] : stage_record(step.times))
    record.emplace_back("seconds_" + stage, seconds);
  if (step.load.number > 0)
  {
    record.emplace_back("load_step", text(step.load.number));
    record.emplace_back("t", text(step.load.t));
  }
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
      record.emplace_back("force_" + force.boundary + "_" + "xyz"[d], text(force.force[d]));
  for (const ContactState<dim> &state : step.contact)
    for (const ContactMode mode : {ContactMode::open, ContactMode::slip, ContactMode::stick})
      record.emplace_back(mode_name(mode) + "_" +
                              step.solution.scene.boundaries[state.boundary].name,
                          text(length(state, mode)));
  record.emplace_back("stopped_by", step.stopped_by);
  record.emplace_back("released_energy", text(step.load.released));
  record.emplace_back("unbalanced_energy", text(step.load.unbalanced));
  return record;
}

/** Number of elements by degree; entry 0 stays empty. */
template <int dim>
std::vector<unsigned int> count_degrees(const DisplacementSpace<dim> &space)
{
  std::vector<unsigned int> count(1);
  for (const auto &cell : space.dof_handler().active_cell_iterators())
    if (cell->is_locally_owned())
    {
      const unsigned int degree = space.degrees()[cell->active_cell_index()];
      count.resize(std::max<std::size_t>(count.size(), degree + 1));
      ++count[degree];
    }
  return count;
}
} // namespace

template <int dim>
void Tables<dim>::add(const StepReport<dim> &step)
{
  row = convergence_record(step);
  add_row(rows, row);
  elements.push_back(count_degrees(step.solution.displacement_space));
  add_degrees();
  if (step.load.number > 0 && !step.stopped_by.empty())
    add_row(load_steps, loading_record(step));
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
    const std::vector<unsigned int> &count = elements[k];
    Record record{{"step", std::to_string(k + 1)},
                  {"elements", text(std::accumulate(count.begin(), count.end(), 0U))}};
    for (unsigned int p = 1; p < n_columns; ++p)
      record.emplace_back("p" + text(p), text(p < count.size() ? count[p] : 0U));
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
const GrowingText &Tables<dim>::loading() const
{
  return load_steps;
}

template class Tables<2>;
} // namespace hpvi
