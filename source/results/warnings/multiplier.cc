// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/plane/failure_mechanism.h>
#include <hpvi/results/warnings/line.h>
#include <hpvi/results/warnings/warnings.h>
#include <hpvi/solvers/coulomb_solver.h>
#include <hpvi/solvers/quadratic_program.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/**
 * Gauss points obey |z_i| <= g(x_i), the polynomial through them need not. What exceeds g is compared
 * with the largest g and with the largest traction, because next to a bound that vanishes a quotient
 * says nothing.
 */
template <int dim>
Warnings overshooting_multiplier(const Solution<dim> &solution)
{
  if (solution.z.size() == 0)
    return {};
  double excess = 1e-9 * solution.z.linfty_norm(), friction = 0, bound = 0;
  for (unsigned int i = 0; i < solution.z.size(); ++i)
    excess = std::max(excess, 0.05 * solution.contact_space.bound(i, solution.z));
  Point<dim> where;
  std::string limit;
  for (const ContactFace<dim> &face : solution.contact_space.faces())
    for (unsigned int k = 0;
         face.n_multipliers > 1 && !face.condition->is_tied() && k <= 4 * face.n_multipliers; ++k)
    {
      const double s = k / (4. * face.n_multipliers);
      const double g = solution.contact_space.bound(face, solution.z, s),
                   z = std::abs(solution.contact_space.value(face, solution.z, s));
      if (z - g > excess)
      {
        excess = z - g;
        friction = z;
        bound = g;
        where = face.point(s);
        limit = face.condition->friction.limit_in_words();
      }
    }
  if (friction == 0)
    return {};
  const std::string remedy = "refine there";
  if (bound < 0.1 * friction) // a quotient would say no more
    return {{WarningKind::overshoot, friction - bound,
             line("friction reaches ", labelled(friction, solution.scene.stress_unit),
                  " between Gauss points, at (", where, "), where ", limit, " is ",
                  labelled(bound, bound > 0 ? solution.scene.stress_unit : ""), ": ", remedy)}};
  return {{WarningKind::overshoot, friction - bound,
           line("|lambda| reaches ", friction / bound, " between Gauss points, at (", where,
                "); it obeys |lambda| <= 1 at the Gauss points only: ", remedy)}};
}

/** The length of the longest edge of a contact boundary that @p x lies on, its vertices included; 0: none. */
template <int dim>
double longest_edge_at(const Point<dim> &x, const types::boundary_id boundary,
                       const Solution<dim> &solution)
{
  const double hair = 1e-6;
  double longest = 0;
  for (const ContactFace<dim> &face : solution.contact_space.faces())
  {
    const Tensor<1, dim> edge = face.point(1.) - face.point(0.);
    const double s = (x - face.point(0.)) * edge / edge.norm_square();
    if (face.condition->id == boundary && s >= -hair && s <= 1 + hair &&
        (x - face.point(s)).norm() < hair * face.length)
      longest = std::max(longest, face.length);
  }
  return longest;
}

template <int dim>
Warnings coarse_transition(const Solution<dim> &solution,
                           const std::vector<ContactState<dim>> &contact)
{
  std::string list;
  double longest = 0;
  for (const ContactState<dim> &state : contact)
    for (const Point<dim> &x : state.transitions)
      if (const double edge = longest_edge_at(x, state.boundary, solution);
          edge > 0.01 * state.area)
      {
        longest = std::max(longest, edge);
        list += line(list.empty() ? "" : ", ", "(", x, ") to +-",
                     labelled(edge, solution.scene.length_unit));
      }
  if (list.empty())
    return {};
  return {
      {WarningKind::transition, longest,
       (solution.scene.has_unilateral_contact() ? "zones of contact meet at "
                                                : "stick and slip meet at ") +
           list +
           " only: more than 1 % of the contact boundary; take more steps of an adaptive method"}};
}

Warnings round_off(const AlgebraicError &algebraic)
{
  if (algebraic.total() <= AlgebraicError::doubtful)
    return {};
  return {{WarningKind::round_off, algebraic.total(),
           line("round-off reaches ", algebraic.total(),
                " of the solution: the body is slender or weakly supported beyond what double "
                "precision resolves; trust no more digits than that")}};
}

/** The least offset at which displacement and multiplier no longer balance: the thesis has -2. */
template <int dim>
Warnings rich_multiplier(const Solution<dim> &solution)
{
  if (solution.scene.solver.multiplier_offset < -1 || solution.z.size() == 0)
    return {};
  return {{WarningKind::rich_multiplier, 0.,
           "multipliers of degree p - 1 are too many: the inf-sup constant falls as the mesh is "
           "refined (see hpvi --inf-sup); use Solver/Multiplier degree offset = -2"}};
}

/** Friction gives all it has, `|sum w_i z_i t| = sum w_i g(x_i)`: both edges of a strip may be in contact. */
template <int dim>
Warnings whole_body_slips(const Solution<dim> &solution,
                          const std::vector<ContactState<dim>> &contact)
{
  const std::vector<RigidBodyMotion<dim>> motions = solution.scene.free_motions();
  if (motions.empty() || solution.scene.has_pressure() || solution.scene.has_pairs())
    return {};
  Tensor<1, dim> friction;
  for (const ContactState<dim> &state : contact)
    friction += state.friction_force;
  if (std::abs(friction * motions.front().translation) <
      (1 - slip_tolerance) * solution.contact_space.discrete_friction_limit())
    return {};
  return {{WarningKind::sliding_body, 0.,
           line("the loads reach what friction can resist: the whole body slips ",
                motions.front().direction(),
                " and its place is not unique; lower the loads or add a support")}};
}

/**
 * With unilateral contact: a motion that no multiplier resists which could still change. These are the
 * frictions below their bound and the pressures above zero; `sum_i w_i (d_i . R(x_i))^2` over them is
 * not positive definite for the motions R.
 */
template <int dim>
Warnings free_place(const Solution<dim> &solution, const std::vector<ContactState<dim>> &contact)
{
  const std::vector<RigidBodyMotion<dim>> motions = solution.scene.free_motions();
  if (motions.empty() || !(solution.scene.has_pressure() || solution.scene.has_pairs()))
    return {};
  double largest = 0, size = 0;
  for (const ContactState<dim> &state : contact)
    largest = std::max(largest, state.highest_pressure);
  FullMatrix<double> gram(motions.size(), motions.size());
  for (unsigned int i = 0; i < solution.z.size(); ++i)
  {
    const ContactMultiplier<dim> &multiplier = solution.contact_space.multipliers()[i];
    size += multiplier.weight;
    const bool holds = multiplier.is_bilateral ? true
                       : multiplier.kind == ContactMultiplier<dim>::Kind::pressure
                           ? solution.z[i] > slip_tolerance * largest
                           : std::abs(solution.z[i]) <
                                 (1 - slip_tolerance) * solution.contact_space.bound(i, solution.z);
    for (unsigned int j = 0; j < motions.size() && holds; ++j)
      for (unsigned int k = 0; k < motions.size(); ++k)
        gram(j, k) += multiplier.weight *
                      (multiplier.direction * motions[j].jump(multiplier.x, multiplier.bodies)) *
                      (multiplier.direction * motions[k].jump(multiplier.x, multiplier.bodies));
  }
  const auto [eigenvalue, combination] = eigenpairs(gram).back();
  if (eigenvalue > 1e-14 * size)
    return {};
  const std::string entry = friction_entry(solution.contact_space);
  return {{WarningKind::free_body, 0.,
           line("contact does not hold ", solution.scene.has_pairs() ? "" : "the body ",
                combined(motions, combination).direction(), ": its place is not unique; ",
                entry.empty() ? "" : "raise " + entry + ", ", "lower the loads or add a support")}};
}

} // namespace

Warnings several_solutions(const CoulombReport &report)
{
  if (!report.difference || *report.difference <= CoulombReport::same)
    return {};
  if (std::isnan(*report.difference))
    return {{WarningKind::several_solutions, 0.,
             "Coulomb friction: from a second start no solution was found, so that it is not known "
             "whether there is another than this one"}};
  return {
      {WarningKind::several_solutions, *report.difference,
       line("Coulomb friction has another solution, found from a second start: in the energy norm "
            "the tractions differ by ",
            *report.difference,
            " of the larger ones; what came before the loads decides between them, or lower "
            "Friction coefficient")}};
}

template <int dim>
Warnings multiplier_warnings(const Solution<dim> &solution,
                             const std::vector<ContactState<dim>> &contact,
                             const AlgebraicError &algebraic, const CoulombReport &coulomb)
{
  return joined(overshooting_multiplier(solution), coarse_transition(solution, contact),
                round_off(algebraic), rich_multiplier(solution),
                whole_body_slips(solution, contact), free_place(solution, contact),
                several_solutions(coulomb));
}

template Warnings multiplier_warnings(const Solution<2> &, const std::vector<ContactState<2>> &,
                                      const AlgebraicError &, const CoulombReport &);
} // namespace hpvi
