// SPDX-License-Identifier: LGPL-2.1-or-later

// The guaranteed bound puts together what other files of this folder make. It rests on the theorem
// of Prager and Synge, extended to friction: with a stress $s$ in equilibrium with the loads and
// with an admissible friction $-g\lambda^*$, $|\lambda^*| \le 1$ everywhere, and a pressure
// $\pi \ge 0$ where contact is unilateral,
//
// $$\begin{aligned}
//   |u - u_N|_a^2 &\le |s - \sigma(u_N)|^2 + 2\,\mathrm{gap}(u_N - w) + |w|_a^2,
//   \\ \mathrm{gap}(v) &= \int_{\Gamma_C} g\,(|v_t| - \lambda^* v_t) + \pi\,(u_0 - v_n)\,ds,
// \end{aligned}$$
//
// for any displacement $w$ that vanishes where $u$ is prescribed and for which $u_N - w$ does not
// penetrate. The first term is the distance of two stresses, the second what the discrete friction misses of the law, and the third pays for
// $w$, which takes the oscillation of $u_N$ around zero away where the body sticks. The proof, and
// the terms that come from loads and supports which are no polynomials, are in doc/bound.md.
#include <hpvi/algebra/dense_algebra.h>
#include <hpvi/base/formatting.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/base/text.h>
#include <hpvi/base/thread_pool.h>
#include <hpvi/bound/admissible_friction.h>
#include <hpvi/bound/cell_constants.h>
#include <hpvi/bound/contact_correction.h>
#include <hpvi/bound/coulomb_bound.h>
#include <hpvi/bound/data_error.h>
#include <hpvi/bound/error_bound.h>
#include <hpvi/bound/joint_lift.h>
#include <hpvi/bound/row_stresses.h>
#include <hpvi/bound/stress_work.h>
#include <hpvi/plane/matching.h>

#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Relative imbalance that is taken for round-off; up to the second the oscillation pays for it; up to the third it leaves an estimate. */
constexpr double tolerable = 1e-9, payable = 1e-7, estimable = 1e-4;

/** What contact adds: w, and what is left of the law where u_N - w moves. */
struct ContactError
{
  std::vector<double> energies, gaps; ///< |w|_K^2 by cell, gap(u_N - w) by face
};

/** |w|_a */
double norm(const ContactError &contact)
{
  return std::sqrt(std::max(0., sum(contact.energies))); // round-off
}

/** No less than |d - w|_a: w is along the contact boundary, d elsewhere, so that the cells of both are few. */
double distance_from_admissible(const ContactError &contact, const DataError &data)
{
  double square = 0;
  for (unsigned int cell = 0; cell < data.lifts.size(); ++cell)
    square += std::pow(std::sqrt(std::max(0., contact.energies[cell])) + data.lifts[cell], 2);
  return std::sqrt(square);
}

/** A = (sum_K (eta_K + O_K)^2)^{1/2}: each cell pays for its own loads. */
double stress_and_oscillation(const EquilibratedStress &stress, const DataError &data)
{
  double square = 0;
  for (unsigned int cell = 0; cell < stress.squares.size(); ++cell)
    square += std::pow(std::sqrt(stress.squares[cell]) + data.oscillation[cell], 2);
  return std::sqrt(square) + data.unresolved;
}

// @sect3{By cell}
//
// A bound is one number, but its square is a sum over cells: a second indicator to mark by, without
// unknown constants, and as fine at high degrees as at low ones.
void set_squares(ErrorBound &result, const Solution<2> &solution, const EquilibratedStress &stress,
                 const ContactError &contact, const DataError &data)
{
  for (unsigned int cell = 0; cell < stress.squares.size(); ++cell)
    result.squares.push_back(std::pow(std::sqrt(stress.squares[cell]) + data.oscillation[cell], 2) +
                             std::max(0., contact.energies[cell]));
  result.moved = contact.energies;
  result.lifted = data.lifts;
  const auto &faces = solution.contact_space.faces();
  for (unsigned int face = 0; face < faces.size(); ++face)
    result.squares[faces[face].cell->active_cell_index()] += 2 * std::max(0., contact.gaps[face]);
}

// @sect3{In the energy norm}
//
// For each $\lambda$ in $(0, 1]$ the error e satisfies $|e|^2 \le A^2 + 2\lambda\,\mathrm{gap} +
// ((1 - \lambda)|e| + \lambda b)^2$ with $A^2 = \sum_K (\eta_K + O_K)^2$, and so it is below the larger root.
// $\lambda = 1$ gives $(A^2 + 2\,\mathrm{gap} + b^2)^{1/2}$, the least where $w$ counts.
void set_norms(ErrorBound &result, const EquilibratedStress &stress, const ContactError &contact,
               const DataError &data)
{
  const double w = norm(contact), gap = std::max(0., sum(contact.gaps)); // round-off
  result.stress = std::sqrt(sum(stress.squares));
  result.slip = std::sqrt(2 * gap + w * w);
  result.oscillation =
      std::sqrt(std::inner_product(data.oscillation.begin(), data.oscillation.end(),
                                   data.oscillation.begin(), 0.)) +
      data.unresolved;
  result.data = data.lift;
  const double b = distance_from_admissible(contact, data),
               A = stress_and_oscillation(stress, data);
  result.total = least_root(A, gap, b);
}

/** Of the stress between sigma(u_N) and s that is nearest to that of the solution; doc/bound.md has the proof. */
void set_radius(ErrorBound &result, const EquilibratedStress &stress, const ContactError &contact,
                const DataError &data)
{
  const double A = stress_and_oscillation(stress, data), gap = std::max(0., sum(contact.gaps)),
               b = distance_from_admissible(contact, data);
  const auto radius = [&](const double theta)
  {
    const double rest = 1 - theta;
    return std::sqrt(rest * (rest * A * A + 2 * gap + rest / (1 - 2 * theta) * b * b)) +
           theta * data.beside;
  };
  const auto [theta, least] = boost::math::tools::brent_find_minima(radius, 0., 0.499, 20);
  if (least < result.total)
    result.theta = theta;
  result.radius = std::min(least, result.total);
}

/** Of U = u_N - w + d; J changes by @p change with u_N - w, w in V_N, as the rule of the stiffness says, which @p missed some. */
void set_energy(ErrorBound &result, const EquilibratedStress &stress, const ContactError &contact,
                const double change, const double missed, const DataError &data)
{
  const double w = norm(contact), b = distance_from_admissible(contact, data);
  result.energy = std::pow(stress_and_oscillation(stress, data) + b, 2) / 2 + sum(contact.gaps);
  // J(u_N - w + d) = J(u_N - w) + (sigma(u_N - w) - s, eps(d)) + int s n . d - R(d) + |d|^2/2
  const double centre = change + data.lift_work + data.lift * data.lift / 2,
               unknown = (result.stress + w + result.oscillation) * data.lift + data.missed_work;
  result.energy_above = (w == 0. && data.lift == 0. ? 0. : centre + unknown) + missed;
  result.energy_below = result.energy + unknown - centre + missed;
}

/** Under Coulomb's law no energy is least. */
void set_no_energy(ErrorBound &result)
{
  result.energy = result.energy_below = result.energy_above =
      std::numeric_limits<double>::quiet_NaN();
}

// @sect3{When there is none}
//
// Each assumption of the theorem is checked on the way. If one fails there is no bound, and a
// sentence that says why, with the number: a bound that is nearly guaranteed is not guaranteed.
/** Is friction at the points of its multiplier more or less than along the edge between them, where all of it slips? */
bool has_curved_limit(const Solution<2> &solution)
{
  const std::vector<ContactFace<2>> &faces = solution.contact_space.faces();
  return std::any_of(faces.begin(), faces.end(),
                     [](const ContactFace<2> &face)
                     {
                       const FrictionLaw<2> &law = face.condition->friction;
                       return law && law.knows_pressure() && !law.is_proportional();
                     });
}

/** Why the patch of cells about a vertex is out of balance. @p is_moved: contact is not that of the discrete solution, by more than round-off. */
std::string cause_of_imbalance(const EquilibratedStress &stress, const bool is_moved,
                               const Point<2> &vertex, const double size)
{
  if (stress.is_worst_in_corners)
    return "two edges that meet there ask for different shears";
  if (is_moved)
    return "friction and pressure that keep their bounds everywhere do not balance the loads, and "
           "no support carries the rest";
  double smallest = size, longest = 1;
  for (const VertexPatches::Cell &cell : stress.patches().cells())
    for (const unsigned int v : cell.iterator->vertex_indices())
      if (cell.iterator->vertex(v) == vertex)
      {
        const CellMap<2> map = map_of<2>(cell.iterator);
        smallest = std::min(smallest, map.longest_edge());
        longest = std::max(longest, map.longest_edge() / map.shortest_edge());
      }
  return "round-off, in cells of " + text(smallest / size, 2) + " of the body" +
         (longest > 20 ? ", " + text(longest, 2) + " times as long as wide" : "");
}

std::string flaw_of_balance(const Solution<2> &solution, const EquilibratedStress &stress,
                            const bool is_moved)
{
  if (stress.defect <= payable)
    return {};
  const Point<2> &vertex = solution.spaces->mesh->get_vertices()[stress.worst_vertex];
  return "patches of cells are out of balance by up to " + text(stress.defect, 2) +
         " of their stresses, at " + to_string(vertex) + ": " +
         cause_of_imbalance(stress,
                            is_moved && (stress.defect > 1e-6 || has_curved_limit(solution)),
                            vertex, solution.scene.geometry.diameter());
}

/** Why U = u_N - w + d is not admissible. */
std::string flaw_of_correction(const Solution<2> &solution, const ContactCorrection<2> &correction)
{
  const double largest = solution.u.linfty_norm();
  if (correction.penetration() > 0.)
    return "the displacement penetrates the foundation between nodes, by " +
           text(correction.penetration() / largest, 2) +
           " of the largest, and supports keep it there";
  if (correction.opening() > 0.)
    return "joints that must not open do so between their points, by " +
           text(correction.opening() / largest, 2) +
           " of the largest displacement, and what meets at their ends keeps them open";
  return {};
}

/** Nothing is guaranteed; but what is wrong by little, by @p size of the whole, leaves the number as an estimate. */
void set_flaw(ErrorBound &result, const std::string &why, const double size)
{
  if (!(size <= estimable))
    result.flaw = why;
  else if (result.kind != BoundKind::estimate)
  {
    result.kind = BoundKind::estimate;
    result.zones.clear();
    result.why = why;
    result.total = result.radius = result.estimate;
    result.theta = 0;
    set_no_energy(result);
  }
}

/** Strides may lower the degree of a cell: then the past on its edge is of a higher one. */
std::string flaw_of_past(const Solution<2> &solution)
{
  for (const ContactFace<2> &face : solution.contact_space.faces())
    for (unsigned int i = 0; face.past && i <= 2 * face.degree; ++i)
    {
      const double s = i / (2. * face.degree), past = face.past_slip(face.point(s));
      if (std::abs(past + less_past(face, solution.tables)(s)) >
          1e-10 * (std::abs(past) + solution.u.linfty_norm()))
        return "slip of the load step before has a higher degree than the edge at " +
               to_string(face.point(0.5));
    }
  return {};
}

std::string flaw(const Solution<2> &solution, const AdmissiblePressure<2> &pressure,
                 const DataError &data, const bool has_rows)
{
  const double largest = solution.u.linfty_norm();
  if (pressure.tension() > 0.)
    return "pressure is negative between the nodes of contact, by " + text(pressure.tension(), 2) +
           " of the largest, and cannot be made admissible";
  if (has_rows)
  {
    if (const std::string cut = cut_inside_cell(solution); !cut.empty())
      return cut;
    for (const auto &cell : solution.displacement_space.dof_handler().active_cell_iterators())
      if (!CellConstants(map_of<2>(cell)).is_star_shaped(solution.scene.material_of(cell)))
        return "the cell at " + to_string(cell->center()) +
               " is not star-shaped about its middle, or touches the axis by a vertex alone, and "
               "nothing is known of its rotations";
  }
  if (solution.scene.has_plates() && has_long_cells(solution))
    return "cells are more than four times as long as wide, and a stress that is made in all of "
           "them at "
           "once knows no rigid plate";
  if (!(sum(data.oscillation) < std::numeric_limits<double>::infinity()))
    return solution.scene.is_axisymmetric()
               ? "loads or friction in cells on the axis are no polynomials of their degree"
               : "a cell is so flat that no rule encloses the energy on it";
  const std::string &unit = solution.scene.length_unit;
  if (!(data.missed_data <= 1e-8 * largest))
    return "a prescribed displacement or gap is not smooth along the edge at " +
           to_string(data.missed_at) + ", where polynomials miss it by " +
           text(data.missed_data, 2) + (unit.empty() || unit == "1" ? "" : " " + unit);
  return {};
}
// @sect3{A friction bound that varies, a force in a corner}
//
// Where $g$ varies between the points of the multiplier, friction within its bound may not do the
// work of $z_N$, and no pressure has the moment of a force that stands in a corner node. No stress near
// $\sigma(u_N)$ is in balance with them then. Forces that make up for the
// difference move $u_N$; near the stress of what they make of it there is one.
std::optional<JointTractions> joints_of(const Solution<2> &solution,
                                        const AdmissibleFriction<2> &friction,
                                        const AdmissiblePressure<2> &pressure)
{
  std::optional<JointTractions> result;
  if (has_given_tractions(solution.contact_space))
    result.emplace(solution, friction, pressure);
  return result;
}

std::optional<Solution<2>>
moved(const Solution<2> &solution, const Discretisation<2> &discretisation,
      const AdmissibleFriction<2> &friction, const AdmissiblePressure<2> &pressure,
      const std::optional<JointTractions> &joints, const LinearSolver *const factor)
{
  if (!joints && friction.imbalance() <= tolerable && pressure.is_balanced())
    return std::nullopt;
  Vector<double> missing(solution.u.size());
  if (joints)
    missing = joints->missing_forces();
  else
  {
    missing = friction.missing_forces(solution);
    missing += pressure.missing_forces(solution);
  }
  const Vector<double> forces = discretisation.unknowns.collect(missing);
  Vector<double> u = discretisation.unknowns.expand(factor ? factor->solve(forces)
                                                           : discretisation.factor().solve(forces));
  discretisation.condensation.extend(u);
  u += solution.u;
  Solution<2> result(solution);
  result.u = u;
  return result;
}
} // namespace

void count_from_past(ErrorBound &result)
{
  if (result.kind == BoundKind::energy || result.kind == BoundKind::coupling)
  {
    result.kind = BoundKind::history;
    result.theta = 0;
    result.radius = result.total;
    set_no_energy(result);
  }
  else if (result.kind == BoundKind::zones)
  {
    result.kind = BoundKind::estimate;
    result.why = "where it sticks is assumed, and slip counts from the load step before";
    result.total = result.radius = result.estimate;
    result.zones.clear();
  }
}

std::string text(const BoundKind kind)
{
  constexpr const char *words[] = {"energy", "coupling", "zones", "history", "estimate"};
  return words[static_cast<unsigned int>(kind)];
}

ErrorBounds::ErrorBounds() = default;
ErrorBounds::~ErrorBounds() = default;

std::vector<double> ErrorBound::indicators() const
{
  std::vector<double> result;
  for (const double square : squares)
    result.push_back(std::sqrt(square));
  return result;
}

// @sect3{Friction, pressure and stress}
//
// Tractions along the contact that keep their bounds everywhere, and a stress in equilibrium with them
// and with the loads. They are made of a discrete solution, not always that whose error is bounded.
struct ErrorBounds::AdmissibleStress
{
  AdmissibleStress(const Solution<2> &measured, std::optional<Solution<2>> of_mixed_problem,
                   const Discretisation<2> &discretisation, const LinearSolver *const factor,
                   EquilibrationCache &cache)
      : mixed(std::move(of_mixed_problem)), pressure(mixed ? *mixed : measured),
        of_pressure(under_admissible_limit(mixed ? *mixed : measured, pressure)),
        start(of_pressure ? *of_pressure
              : mixed     ? *mixed
                          : measured),
        friction(start), joints(joints_of(start, friction, pressure)),
        balanced(moved(start, discretisation, friction, pressure, joints, factor)),
        stress(
            balanced ? *balanced : start,
            [&](const unsigned int face, const unsigned int end)
            { return friction.part(face, end).coefficients(); },
            [&](const unsigned int face, const unsigned int end)
            { return pressure.part(face, end).coefficients(); },
            cache, balanced || mixed ? &measured : nullptr,
            mixed ? Volume::projected : Volume::full, joints ? &*joints : nullptr)
  {
  }

  bool is_balanced() const
  {
    return stress.defect <= tolerable;
  }

  double eta() const ///< infinite where it is not in balance
  {
    return is_balanced() ? std::sqrt(sum(stress.squares)) : std::numeric_limits<double>::infinity();
  }

  const std::optional<Solution<2>> mixed;
  const AdmissiblePressure<2> pressure;
  const std::optional<Solution<2>> of_pressure; ///< where the limit of friction follows that
  const Solution<2> &start;
  const AdmissibleFriction<2> friction;
  const std::optional<JointTractions> joints; ///< where meshes of two bodies do not match
  const std::optional<Solution<2>> balanced;
  const EquilibratedStress stress;
};

// @sect3{Near incompressibility}
//
// The pressure of $u_N$ oscillates where degrees are low, or cells with singularities large, and a stress in
// equilibrium with it is far from that of the solution. The stress and tractions are those of a mixed method then,
// corrected for round-off if the patches show it.
std::unique_ptr<const ErrorBounds::AdmissibleStress>
ErrorBounds::stress_of_mixed_problem(const Solution<2> &solution,
                                     std::unique_ptr<LinearSolver> factor)
{
  if (!mixed)
    mixed = std::make_unique<MixedProblem>(solution.scene);
  const auto make = [&](Solution<2> start)
  {
    return std::make_unique<const AdmissibleStress>(solution, std::move(start),
                                                    mixed->discretisation(), factor.get(), cache);
  };
  auto result = make(mixed->solve(solution, factor));
  return result->is_balanced() ? std::move(result) : make(mixed->correct(*result->mixed, *factor));
}

// A few steps of an hp-method bring degrees and cells that do not lock. So both stresses are made as soon as half
// of the cells have a degree of 4 or more, until that of $u_N$ is less than a tenth farther from
// $\sigma(u_N)$ than the other; then it alone, unless it has not come nearer since the step before.
std::unique_ptr<const ErrorBounds::AdmissibleStress>
ErrorBounds::nearest_stress(const Solution<2> &solution, const Discretisation<2> &discretisation,
                            std::unique_ptr<LinearSolver> factor, double &hysteresis)
{
  const std::vector<unsigned int> &degrees = solution.displacement_space.degrees();
  const bool may_lock = solution.scene.is_nearly_incompressible() &&
                        !solution.scene.has_coulomb_friction() &&
                        !solution.scene.is_axisymmetric() && !has_distorted_cells(solution);
  const auto n_high = std::count_if(degrees.begin(), degrees.end(),
                                    [](const unsigned int degree) { return degree >= 4; });
  std::unique_ptr<const AdmissibleStress> own;
  if (!may_lock || 2 * n_high >= std::ptrdiff_t(degrees.size()))
    own = std::make_unique<const AdmissibleStress>(solution, std::nullopt, discretisation,
                                                   factor.get(), cache);
  const double eta = own ? own->eta() : std::numeric_limits<double>::infinity();
  if (!may_lock || eta < std::exchange(hysteresis, eta))
    return own;
  auto stable = stress_of_mixed_problem(solution, std::move(factor));
  if (!(eta < 1.1 * stable->eta()))
    hysteresis = 0.;
  return eta < stable->eta() ? std::move(own) : std::move(stable);
}

// @sect3{The order of things}
//
// A stress; a correction $w$ for what $u_N$ does where it should stick; and what data leave. The energy of $u_N - w$
// is known for a $w$ in $V_N$ alone. Where meshes of bodies do not match, what they do there is a part of $d$, and no $w$ is left.
/** Contact with w; @p result has its flaw, and for the energy the change of J and |w|_K^2. */
struct ErrorBounds::Contact
{
  ContactError in_norms, in_energy;
  double change = 0;
  Vector<double> moved; ///< u_N - w of that
  std::string flaw;
  std::optional<ContactCorrection<2>> correction; ///< w of the norms
};

ErrorBounds::Contact ErrorBounds::contact_of(const Solution<2> &solution,
                                             const Discretisation<2> &discretisation,
                                             const AdmissibleStress &made)
{
  Contact result;
  const bool is_moved =
      !made.of_pressure && (solution.scene.has_unilateral_contact() || solution.scene.has_pairs());
  std::array<std::optional<ContactCorrection<2>>, 2> corrections;
  parallel_for_each(is_moved ? 2 : 1, 1,
                    [&](const unsigned int k)
                    {
                      corrections[k].emplace(solution, discretisation, made.friction, made.pressure,
                                             k == 0 ? &bubbles : nullptr);
                    });
  const ContactCorrection<2> &first = *corrections[0];
  result.in_norms = {first.energy(), first.gap()};
  result.in_energy = {std::vector<double>(first.energy().size()), first.uncorrected_gap()};
  result.moved = solution.u;
  if (is_moved)
  {
    Vector<double> v(corrections[1]->unknowns());
    v *= -1.;
    result.change = energy_change(solution, discretisation, v);
    Vector<double> w = discretisation.unknowns.expand(v);
    discretisation.condensation.extend(w);
    result.moved += w;
    result.in_energy = {corrections[1]->energy(), corrections[1]->gap()};
  }
  for (const auto &correction : corrections)
    if (result.flaw.empty() && correction)
      result.flaw = flaw_of_correction(solution, *correction);
  result.correction = std::move(corrections[0]);
  return result;
}

ErrorBound no_solution_for_bound(const std::string &what)
{
  ErrorBound result;
  result.imbalance = std::numeric_limits<double>::quiet_NaN();
  result.flaw = "a problem that the bound needs is not solved: " + what;
  return result;
}

double least_root(const double A, const double gap, const double b)
{
  const auto root = [&](const double lambda)
  {
    const double nu = 1 - lambda, half = nu * lambda * b, rest = 1 - nu * nu;
    return (half +
            std::sqrt(half * half + rest * (A * A + 2 * lambda * gap + lambda * lambda * b * b))) /
           rest;
  };
  return std::min(root(1.), boost::math::tools::brent_find_minima(root, 1e-3, 1., 20).second);
}

ErrorBound ErrorBounds::compute(const Solution<2> &measured,
                                const Discretisation<2> &discretisation,
                                std::unique_ptr<LinearSolver> factor, const double hysteresis)
try
{
  ErrorBound result;
  result.hysteresis = hysteresis;
  const auto made = nearest_stress(measured, discretisation, std::move(factor), result.hysteresis);
  const Solution<2> &solution = made->of_pressure ? *made->of_pressure : measured;
  const EquilibratedStress &stress = made->stress;
  std::optional<JointLift> joints;
  Contact contact;
  std::optional<DataError> missed;
  if (made->joints)
  {
    joints.emplace(solution, discretisation, *made->joints);
    contact = {{joints->energies, joints->gaps},
               {joints->energies, joints->gaps},
               joints->change,
               joints->moved,
               joints->flaw,
               std::nullopt};
  }
  parallel_for_each(joints ? 1 : 2, 1,
                    [&](const unsigned int k)
                    {
                      if (k == 0)
                        missed.emplace(solution, stress, joints ? &*joints : nullptr);
                      else
                        contact = contact_of(solution, discretisation, *made);
                    });
  const DataError &data = *missed;
  set_squares(result, solution, stress, contact.in_norms, data);
  set_norms(result, stress, contact.in_norms, data);
  result.estimate = result.total;
  result.tractions = edge_tractions(stress);
  if (made->of_pressure)
  {
    result.kind = BoundKind::estimate;
    std::optional<MatchingContact> matching;
    if (!joints)
      matching.emplace(solution, discretisation, made->friction, made->pressure,
                       *contact.correction);
    if (!coulomb)
      coulomb = std::make_unique<CoulombBounds>();
    coulomb->set(
        result, solution, joints ? static_cast<const AdmissibleContact &>(*joints) : *matching,
        stress_and_oscillation(stress, data), distance_from_admissible(contact.in_norms, data));
    result.radius = result.total;
    set_no_energy(result);
  }
  else
  {
    set_radius(result, stress, contact.in_norms, data);
    set_energy(result, stress, contact.in_energy, contact.change,
               missed_energy(solution, contact.moved) / 2, data);
    result.moved_by_energy = contact.in_energy.energies;
  }
  if (!solution.spaces->past.empty())
    count_from_past(result);
  result.imbalance = stress.defect;
  result.flaw = flaw(solution, made->pressure, data, stress.has_rows());
  if (result.flaw.empty())
    result.flaw = flaw_of_past(solution);
  if (!result.flaw.empty())
    return result;
  const double violation = contact.correction ? std::max(contact.correction->penetration(),
                                                         contact.correction->opening()) /
                                                    solution.u.linfty_norm()
                                              : std::numeric_limits<double>::infinity();
  for (const auto &[why, size] :
       {std::pair(contact.flaw, violation),
        std::pair(flaw_of_balance(solution, stress, bool(made->balanced)), stress.defect)})
    if (!why.empty() && result.flaw.empty())
      set_flaw(result, why, size);
  return result;
}
catch (const NumericalFailure &failure)
{
  return no_solution_for_bound(failure.what());
}
} // namespace hpvi
