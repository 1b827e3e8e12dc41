// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/dense_algebra.h>
#include <hpvi/base/numbers.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/bound/correction_search.h>
#include <hpvi/bound/legendre.h>
#include <hpvi/bound/stress_work.h>
#include <hpvi/plane/springs.h>
#include <hpvi/solvers/inequality_program.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hpvi
{
using namespace dealii;

namespace
{
/** A trace of w at a point of its face by the unknowns of a strip that are kept. */
Vector<double> trace_row(const RestrictedEnergy &strip, const Trace &trace, const double s)
{
  const Vector<double> L = legendre_basis(trace.legendre.m(), s);
  Vector<double> values(trace.unknowns.size()), row(strip.n_kept());
  trace.legendre.Tvmult(values, L);
  for (unsigned int m = 0; m < values.size(); ++m)
    if (const unsigned int place = strip.place(trace.unknowns[m]); place != none)
      row[place] += values[m];
  return row;
}

/** `sign (rest - w) <= 0` at one point of a face, w that of the unknowns kept; false: w is fixed there. */
bool add_condition(const Trace &trace, const EdgePolynomial &rest, const double sign,
                   const double s, const RestrictedEnergy &strip, InequalityProgram &program)
{
  Vector<double> row = trace_row(strip, trace, s);
  row *= sign;
  if (row.linfty_norm() <= 1e-9)
    return false;
  program.add_inequality(row, sign * rest(s));
  return true;
}

} // namespace

template <int dim>
CorrectionSearch<dim>::CorrectionSearch(const Solution<dim> &solution,
                                        const Discretisation<dim> &discretisation,
                                        const AdmissibleFriction<dim> &friction,
                                        const AdmissiblePressure<dim> &pressure,
                                        EdgeBubbles *const bubbles)
    : solution(solution), discretisation(discretisation), friction(friction),
      freedom(solution, discretisation.unknowns), faces(solution.contact_space.faces()),
      slips(slips_of(solution)), openings(faces.size()), A{discretisation.system.A, {}}
{
  const LegendreTables tables;
  for (unsigned int k = 0; k < faces.size(); ++k)
  {
    traces.push_back(trace_of(faces[k], faces[k].frame(0.5).tangent, solution,
                              discretisation.unknowns, tables.from_nodes(faces[k].degree)));
    if (faces[k].past)
      traces[k].u =
          (EdgePolynomial(traces[k].u) + less_past(faces[k], solution.tables)).coefficients();
    const Contact law = faces[k].condition->contact;
    if (!faces[k].segments.empty() && (law == Contact::tied || law == Contact::bilateral))
      joints.push_back({k, faces[k].frame(0.5).normal,
                        trace_of(faces[k], faces[k].frame(0.5).normal, solution,
                                 discretisation.unknowns, tables.from_nodes(faces[k].degree))});
    if (!faces[k].segments.empty() && law == Contact::tied)
      joints.push_back({k, faces[k].frame(0.5).tangent, traces[k]});
    if (!faces[k].condition->is_unilateral())
      continue;
    openings[k] = opening_of(k, solution, discretisation.unknowns, pressure, tables);
    tolerance = std::max(tolerance, 1e-14 * EdgePolynomial(openings[k]->penetration.u).largest());
  }
  if (solution.scene.has_unilateral_contact())
  {
    places = meeting_places();
    are_held = held_ends();
  }
  for (unsigned int k = 0; k < faces.size(); ++k)
    is_near_pressure.push_back(find_near_pressure(k));
  if (!bubbles)
    return;
  free_neighbours(slips, faces);
  free_neighbours(openings, faces);
  std::map<unsigned int, std::vector<BubbleFace>> by_cell;
  for (unsigned int k = 0; k < faces.size(); ++k)
  {
    const ContactFrame<dim> frame = faces[k].frame(0.5);
    Directions directions;
    if (slips[k].mode == Slip::partly)
      directions.emplace_back(frame.tangent, &traces[k]);
    if (openings[k] && openings[k]->mode == Opening::partly)
      directions.emplace_back(frame.normal, &openings[k]->penetration);
    if (!directions.empty())
      by_cell[faces[k].cell->active_cell_index()].emplace_back(&faces[k], directions);
  }
  for (const auto &[cell, own_faces] : by_cell)
    add_bubbles(cell, own_faces, *bubbles);
}

template <int dim>
typename CorrectionSearch<dim>::Candidate CorrectionSearch<dim>::nothing() const
{
  return of(Vector<double>(A.n()));
}

template <int dim>
typename CorrectionSearch<dim>::Candidate CorrectionSearch<dim>::of(const Vector<double> &w) const
{
  Candidate result{w, {}, 0., 0., 0.};
  result.penetration = lift(result.w); // which moves w
  result.opening = open_joints(result.w);
  result.total = result.penetration > 0. || result.opening > 0.
                     ? std::numeric_limits<double>::infinity()
                     : A.energy(result.w);
  for (unsigned int k = 0; k < faces.size(); ++k)
  {
    const EdgePolynomial rest = traces[k].rest(result.w);
    // Where w has taken u_Nt away, round-off is left, whose signs are not worth the search.
    result.gaps.push_back(rest.largest() > 1e-13 * EdgePolynomial(traces[k].u).largest()
                              ? friction_gap(faces[k], rest, solution.tables,
                                             [&](const double s) { return friction.value(k, s); })
                              : 2. * rest.largest() * faces[k].length *
                                    faces[k].friction.integral());
    if (openings[k])
      result.gaps.back() +=
          faces[k].length * openings[k]->gap(openings[k]->penetration.rest(result.w));
  }
  result.total += 2. * sum(result.gaps);
  return result;
}

template <int dim>
void CorrectionSearch<dim>::take_better(Candidate &best, const Vector<double> &w) const
{
  Candidate next = of(w);
  if (next.total < best.total)
    best = std::move(next);
}

/**
 * Faces whose slip is to keep its direction: those that slip in part, up to two slipping ones beside each that
 * does not slip everywhere, and those with more than a hundredth of the gap of all that slip.
 */
template <int dim>
std::vector<bool> CorrectionSearch<dim>::nearby_faces(const std::vector<double> &gaps) const
{
  double of_slip = 0;
  for (unsigned int k = 0; k < faces.size(); ++k)
    of_slip += slips[k].mode == Slip::everywhere ? gaps[k] : 0.;
  std::vector<bool> result(faces.size());
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (slips[k].mode == Slip::everywhere)
    {
      if (gaps[k] > std::max(0.01 * of_slip, 1e-10 * sum(gaps))) // not by round-off
        result[k] = true;
    }
    else
    {
      result[k] = slips[k].mode == Slip::partly;
      for (const unsigned int other : faces_beside(k, 2, faces))
        if (slips[other].mode == Slip::everywhere)
          result[other] = true;
    }
  for (unsigned int k = 0; k < faces.size(); ++k)
    result[k] = result[k] && slips[k].direction != 0.;
  return result;
}

template <int dim>
std::vector<unsigned int> CorrectionSearch<dim>::kept_unknowns(const std::vector<bool> &nearby,
                                                               const std::vector<Role> &roles) const
{
  std::vector<unsigned int> result;
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (nearby[k] || slips[k].mode == Slip::partly)
      for (const unsigned int unknown : traces[k].unknowns)
        if (roles[unknown] == Role::free)
          result.push_back(unknown);
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (is_near_pressure[k])
      for (const unsigned int unknown : openings[k]->penetration.unknowns)
        if (roles[unknown] == Role::free)
          result.push_back(unknown);
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

/** On the faces nearby u_Nt - w_t has the direction of slip, and the gap is linear in w: l* of degree p + 5 times up to p + 8. */
template <int dim>
void CorrectionSearch<dim>::add_friction(const RestrictedEnergy &strip,
                                         const std::vector<bool> &nearby,
                                         const Vector<double> &fixed, Vector<double> &h,
                                         std::vector<Condition> &conditions) const
{
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (nearby[k])
    {
      const FrictionRule rule = traction_rule(faces[k], faces[k].degree + 5, solution.tables);
      for (unsigned int q = 0; q < rule.points.size(); ++q)
        h.add(faces[k].length * rule.weights[q] * rule.values[q] *
                  (slips[k].direction - friction.value(k, rule.points[q])),
              trace_row(strip, traces[k], rule.points[q]));
      conditions.push_back(
          {&traces[k], traces[k].rest(fixed), -slips[k].direction, /*is_of_pressure=*/false});
    }
}

/** Where the body presses or nearly does, u_Nn - w_n <= u_0; the gap is linear in w. */
template <int dim>
void CorrectionSearch<dim>::add_pressure(const RestrictedEnergy &strip, const Vector<double> &fixed,
                                         Vector<double> &h,
                                         std::vector<Condition> &conditions) const
{
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (is_near_pressure[k])
    {
      const Trace &trace = openings[k]->penetration;
      const QGauss<1> &gauss = solution.tables.gauss(faces[k].degree + 7);
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const double s = gauss.point(q)[0];
        h.add(-faces[k].length * gauss.weight(q) * openings[k]->pressure(s),
              trace_row(strip, trace, s));
      }
      conditions.push_back({&trace, trace.rest(fixed), 1., /*is_of_pressure=*/true});
    }
}

/** The w for which what is left keeps its direction; empty: none has been found. */
template <int dim>
Vector<double> CorrectionSearch<dim>::in_one_direction(const RestrictedEnergy &strip,
                                                       const std::vector<bool> &nearby,
                                                       const Vector<double> &fixed) const
{
  Vector<double> h = strip.h(), w;
  std::vector<Condition> conditions;
  add_friction(strip, nearby, fixed, h, conditions);
  add_pressure(strip, fixed, h, conditions);
  InequalityProgram program(strip.H(), h);
  const auto add = [&](const Condition &condition, const double s)
  { return add_condition(*condition.trace, condition.rest, condition.sign, s, strip, program); };
  for (const Condition &condition : conditions)
    for (unsigned int i = 0, n = condition.trace->legendre.m(); i <= n; ++i)
      add(condition, 0.5 - 0.5 * std::cos(numbers::PI * i / n));
  // What has another sign between the points is worth more points; the w is measured as it is, with what it misses.
  constexpr double implied = 1e-8;
  bool stands_out = true;
  for (unsigned int round = 0; stands_out && round <= 10 && program.solve(implied); ++round)
  {
    w = strip.minimiser(program.minimiser());
    stands_out = false;
    for (const Condition &condition : conditions)
    {
      const EdgePolynomial rest = condition.trace->rest(w);
      const double round_off = condition.is_of_pressure ? tolerance : 1e-14 * rest.largest();
      for (const double s : rest.extremes())
        if (condition.sign * rest(s) > round_off)
          stands_out = add(condition, s) || stands_out;
    }
  }
  return w;
}

template <int dim>
typename CorrectionSearch<dim>::Candidate CorrectionSearch<dim>::best(Candidate result) const
{
  if (result.total == 0.)
    return result;
  const std::vector<bool> nearby = nearby_faces(result.gaps);
  const std::vector<Role> all_roles = roles(nearby);
  Vector<double> fixed = fixed_displacement();
  std::vector<bool> is_free;
  for (unsigned int i = 0; i < fixed.size(); ++i)
  {
    if (all_roles[i] != Role::fixed)
      fixed[i] = 0.;
    is_free.push_back(all_roles[i] == Role::free);
  }
  const RestrictedEnergy strip(A, is_free, fixed, kept_unknowns(nearby, all_roles));
  take_better(result, strip.minimiser());
  if (strip.n_kept() > 0)
    try
    {
      if (const Vector<double> w = in_one_direction(strip, nearby, fixed); w.size() > 0)
        take_better(result, w);
    }
    catch (const NumericalFailure &)
    {
      // Stiffness that is singular to round-off: a candidate less.
    }
  return result;
}

template <int dim>
EdgePolynomial CorrectionSearch<dim>::slip(const unsigned int face, const Vector<double> &w) const
{
  return traces[face].rest(w);
}

template <int dim>
EdgePolynomial CorrectionSearch<dim>::penetration_along(const unsigned int face,
                                                        const Vector<double> &w) const
{
  return openings[face] ? openings[face]->penetration.rest(w) : EdgePolynomial();
}

template <int dim>
std::vector<double> CorrectionSearch<dim>::energies(const Vector<double> &w) const
{
  std::vector<double> result = energies_by_cell(solution, discretisation, w);
  for (unsigned int i = 0; i < cell_of_bubble.size(); ++i)
    result[cell_of_bubble[i]] += A.energy(A.A.n() + i, w);
  return result;
}

// Where the rule of the stiffness is not exact, the energy is that of the displacement with its part inside the cell, enclosed.
template <int dim>
std::vector<double> energies_by_cell(const Solution<dim> &solution,
                                     const Discretisation<dim> &discretisation,
                                     const Vector<double> &w)
{
  const DisplacementSpace<dim> &space = solution.displacement_space;
  Vector<double> moved = discretisation.unknowns.expand(w); // bubbles are zero at springs
  const auto is_near = [&](const auto &cell)
  { return solution.scene.is_axisymmetric() || !map_of<dim>(cell).is_affine(); };
  bool is_any = false;
  for (const auto &cell : space.dof_handler().active_cell_iterators())
    is_any = is_any || is_near(cell);
  if (is_any)
    discretisation.condensation.extend(moved);
  std::vector<double> result;
  for (const auto &cell : space.dof_handler().active_cell_iterators())
  {
    const auto &element = discretisation.condensation.element(cell->active_cell_index());
    const auto dofs = space.cell_dofs(cell->active_cell_index());
    Vector<double> values(element ? element->condensed.m() : 0);
    for (unsigned int i = 0; i < values.size(); ++i)
      values[i] = moved[dofs[i]];
    result.push_back(
        values.all_zero() ? 0.
        : is_near(cell)
            ? energy_range(cell, solution.scene, space, solution.tables, moved,
                           displacement_rule(cell, solution.scene,
                                             space.degrees()[cell->active_cell_index()]))
                  .high
            : element->condensed.matrix_norm_square(values));
  }
  Vector<double> forces(moved.size());
  for (const SpringFace &face : spring_faces(solution.scene, space, solution.tables))
    result[face.cell] += add_spring_forces({face}, moved, forces);
  return result;
}

template class CorrectionSearch<2>;
template std::vector<double> energies_by_cell(const Solution<2> &, const Discretisation<2> &,
                                              const Vector<double> &);
} // namespace hpvi
