// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/plane/missed_loads.h>
#include <hpvi/results/unseen_contact.h>
#include <hpvi/results/warnings/line.h>
#include <hpvi/results/warnings/warnings.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace hpvi
{
using namespace dealii;

namespace
{
template <int dim>
Warnings unseen_contact(const Solution<dim> &solution)
{
  const std::vector<UnseenContact<dim>> places = unseen_contacts(solution);
  if (places.empty())
    return {};
  const auto &worst = *std::max_element(
      places.begin(), places.end(), [](const auto &a, const auto &b) { return a.depth < b.depth; });
  return {{WarningKind::unseen_contact, worst.depth,
           line("contact is smaller than the mesh sees: the body passes through the foundation by ",
                labelled(worst.depth, solution.scene.length_unit), " at (", worst.where,
                "), between points that nothing presses; set Geometry/Graded towards that point, "
                "or take "
                "more steps of an adaptive method that bisects")}};
}

template <int dim>
Warnings unseen_gap(const Solution<dim> &solution)
{
  const std::vector<UnseenGap<dim>> places = unseen_gaps(solution);
  if (places.empty())
    return {};
  const auto &worst =
      *std::max_element(places.begin(), places.end(),
                        [](const auto &a, const auto &b)
                        { return std::abs(a.gap - a.seen) < std::abs(b.gap - b.seen); });
  return {
      {WarningKind::unseen_gap, std::abs(worst.gap - worst.seen),
       line("Gap varies inside ", places.size(), places.size() == 1 ? " edge" : " edges",
            " more than the points of the contact conditions see: near (", worst.where, ") it is ",
            labelled(worst.gap, solution.scene.length_unit), ", the conditions stand for ",
            labelled(std::abs(worst.seen) < 1e-9 * std::abs(worst.gap) ? 0. : worst.seen,
                     solution.scene.length_unit),
            " in an edge of length ", labelled(worst.face->length, solution.scene.length_unit),
            "; refine there, put a vertex where Gap jumps, or take more steps of an adaptive "
            "method that bisects")}};
}

std::string entry_of(const WarningKind kind)
{
  const bool is_bound = kind == WarningKind::bound || kind == WarningKind::bound_jump;
  return friction_entries[is_bound ? 0 : kind == WarningKind::friction_law ? 2 : 1];
}

/** Those that @p entry gives. */
template <int dim, template <int> class Place>
std::vector<Place<dim>> places_of(const std::string &entry, const std::vector<Place<dim>> &places)
{
  std::vector<Place<dim>> result;
  std::copy_if(places.begin(), places.end(), std::back_inserter(result),
               [&](const Place<dim> &place) { return place.entry == entry; });
  return result;
}

/** The discrete problem takes what @p entry gives at Gauss points only. */
template <int dim>
Warnings coarse_bound(const Solution<dim> &solution, const WarningKind kind)
{
  const std::string entry = entry_of(kind);
  const std::vector<UnresolvedBound<dim>> bounds =
      places_of(entry, solution.contact_space.unresolved_bounds(solution.z));
  if (bounds.empty())
    return {};
  const auto error = [](const UnresolvedBound<dim> &bound)
  { return std::abs(bound.sum - bound.integral); };
  const auto &worst =
      *std::max_element(bounds.begin(), bounds.end(),
                        [&](const auto &a, const auto &b) { return error(a) < error(b); });
  return {{kind, error(worst),
           line(entry, " varies inside ", bounds.size(), bounds.size() == 1 ? " edge" : " edges",
                " more than the multiplier's points see: ",
                worst.face->condition->friction.factor_in_words(), "they sum to ", worst.sum,
                ", the integral is ", worst.integral, " over the edge at (", worst.face->point(0.5),
                "); refine there, or take more steps of an adaptive method that bisects")}};
}

template <int dim>
Warnings unresolved_jump(const Solution<dim> &solution, const WarningKind kind)
{
  const std::string entry = entry_of(kind);
  const std::vector<UnresolvedJump<dim>> jumps =
      places_of(entry, solution.contact_space.unresolved_jumps(solution.z));
  if (jumps.empty())
    return {};
  const auto &worst = *std::max_element(
      jumps.begin(), jumps.end(), [](const auto &a, const auto &b) { return a.force < b.force; });
  return {{kind, worst.force,
           line(entry, " jumps inside ", jumps.size(), jumps.size() == 1 ? " edge" : " edges",
                ", by up to ",
                labelled(worst.height,
                         kind == WarningKind::coefficient_jump ? "" : solution.scene.stress_unit),
                " at (", worst.where, ") in an edge of length ",
                labelled(worst.face->length, solution.scene.length_unit),
                ": no polynomial follows that; put a vertex there by Geometry/Subdivisions or "
                "Geometry/Graded towards, or take more steps of an adaptive method")}};
}

/** "there", or "there and in so many other places". */
std::string places(const std::size_t n)
{
  return n == 1 ? "there"
                : line("there, and in ", n - 1, n == 2 ? " other place" : " other places");
}

std::string quantity(const Datum datum)
{
  return datum == Datum::load ? "force" : datum == Datum::spring ? "stiffness" : "stress";
}

template <int dim>
Warnings unresolved_load(const Solution<dim> &solution)
{
  const auto loads = solution.spaces->loads->unresolved(*solution.spaces->mesh);
  if (loads.empty())
    return {};
  const auto &worst = *std::max_element(
      loads.begin(), loads.end(), [](const auto &a, const auto &b) { return a.part < b.part; });
  return {{WarningKind::load, worst.part,
           worst.name + " is not resolved near (" + text(worst.where[0], 3) + " " +
               text(worst.where[1], 3) + "): its " + quantity(worst.datum) +
               " on the edge or cell " + places(loads.size()) + " is " +
               in_words(worst.datum, worst.integral) + " by the rule of the run and " +
               in_words(worst.datum, worst.finer) +
               " by one four times finer; put vertices where it jumps, or write it smoother"}};
}

template <int dim>
Warnings missed_displacement(const Solution<dim> &solution)
{
  auto missed = solution.spaces->loads->missed_displacements(*solution.spaces->mesh,
                                                             solution.displacement_space.degrees());
  missed.erase(std::remove_if(missed.begin(), missed.end(), [](const auto &m) { return m.is_gap; }),
               missed.end());
  if (missed.empty())
    return {};
  const auto size = [](const auto &m) { return std::abs(m.value - m.interpolated); };
  const auto &worst =
      *std::max_element(missed.begin(), missed.end(),
                        [&](const auto &a, const auto &b) { return size(a) < size(b); });
  return {
      {WarningKind::displacement, size(worst),
       worst.name + " lies between the nodes near (" + text(worst.where[0], 3) + " " +
           text(worst.where[1], 3) + "): " + places(missed.size()) + " it is " +
           labelled(worst.value, solution.scene.length_unit) + ", and " +
           labelled(worst.interpolated, solution.scene.length_unit) +
           " in the discrete problem; refine there, or take more steps of an adaptive method that "
           "bisects"}};
}

} // namespace

template <int dim>
Warnings unseen_warnings(const Solution<dim> &solution)
{
  return joined(unseen_contact(solution), unseen_gap(solution),
                coarse_bound(solution, WarningKind::bound),
                unresolved_jump(solution, WarningKind::bound_jump),
                coarse_bound(solution, WarningKind::coefficient),
                unresolved_jump(solution, WarningKind::coefficient_jump),
                coarse_bound(solution, WarningKind::friction_law), unresolved_load(solution),
                missed_displacement(solution));
}

template Warnings unseen_warnings(const Solution<2> &);
} // namespace hpvi
