// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/adaptivity/warnings.h>
#include <hpvi/base/formatting.h>
#include <hpvi/body/cell_map.h>
#include <hpvi/contact/collapse.h>
#include <hpvi/evaluation/unseen_contact.h>
#include <hpvi/scene/data_scale.h>
#include <hpvi/solver/quadratic_program.h>
#include <hpvi/stresses/mean_gradients.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <sstream>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Text made of numbers with three digits. */
template <class... Parts>
std::string line(const Parts &...parts)
{
  std::ostringstream out;
  out.precision(3);
  (out << ... << parts);
  return out.str();
}

/** A number with its unit, unless that is 1. */
std::string labelled(const double value, const std::string &unit)
{
  return unit.empty() || unit == "1" ? line(value) : line(value, " ", unit);
}

/** A stress that the last bits of u make, or that is nothing beside the data, is none. */
template <int dim>
double round_off_stress(const Solution<dim> &solution)
{
  const Scene<dim> &scene = solution.scene;
  const double diameter = scene.geometry.corners.front().distance(scene.geometry.corners.back());
  return round_off_of_data * std::max(scene.largest_mu() * solution.u.linfty_norm() / diameter,
                                      data_scale(scene).stress);
}

/** The pulling part of the normal traction is compared with the whole; a corner alone is not worth a word. */
template <int dim>
std::string tensile_contact(const Solution<dim> &solution,
                            const std::vector<ContactState<dim>> &contact)
{
  double tension = 0, all = 0;
  const ContactState<dim> *worst = nullptr;
  for (const ContactState<dim> &state : contact)
  {
    if (solution.scene.boundaries[state.boundary].contact != Contact::bilateral)
      continue;
    tension += state.tension;
    all += 2 * state.tension - state.normal_resultant;
    if (!worst || state.highest_tension > worst->highest_tension)
      worst = &state;
  }
  if (!worst || !(tension > 0.01 * all && worst->highest_tension > round_off_stress(solution)))
    return {};
  return line("bilateral contact pulls: ", 100 * tension / all,
              " % of the normal traction is tensile, up to ",
              labelled(worst->highest_tension, solution.scene.stress_unit), " at (",
              worst->highest_tension_point, "); a body that may lift off needs unilateral contact");
}

/**
 * Gauss points obey |z_i| <= g(x_i), the polynomial through them need not. What exceeds g is compared
 * with the largest g and with the largest traction, because next to a bound that vanishes a quotient
 * says nothing.
 */
template <int dim>
std::string overshooting_multiplier(const Solution<dim> &solution)
{
  if (solution.z.size() == 0)
    return {};
  double excess = 1e-9 * solution.z.linfty_norm(), friction = 0, bound = 0;
  for (unsigned int i = 0; i < solution.z.size(); ++i)
    excess = std::max(excess, 0.05 * solution.contact_space.bound(i, solution.z));
  Point<dim> where;
  bool coulomb = false;
  for (const ContactFace<dim> &face : solution.contact_space.faces())
    for (unsigned int k = 0; face.n_multipliers > 1 && k <= 4 * face.n_multipliers; ++k)
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
        coulomb = face.condition->friction.coefficient != nullptr;
      }
    }
  if (friction == 0)
    return {};
  const std::string remedy = "refine there";
  if (bound < 0.1 * friction) // a quotient would say no more
    return line("friction reaches ", labelled(friction, solution.scene.stress_unit),
                " between Gauss points, at (", where, "), where ",
                coulomb ? "Friction coefficient times the pressure is " : "Friction bound is ",
                labelled(bound, bound > 0 ? solution.scene.stress_unit : ""), ": ", remedy);
  return line("|lambda| reaches ", friction / bound, " between Gauss points, at (", where,
              "); it obeys |lambda| <= 1 at the Gauss points only: ", remedy);
}

/** Pressures are positive at the points of the multiplier, the polynomial through them need not be. */
template <int dim>
std::string pulling_pressure(const Solution<dim> &solution,
                             const std::vector<ContactState<dim>> &contact)
{
  const ContactState<dim> *worst = nullptr;
  double share = 0.05;
  for (const ContactState<dim> &state : contact)
    if (solution.scene.boundaries[state.boundary].is_unilateral() &&
        state.highest_tension > share * state.highest_pressure &&
        state.highest_tension > round_off_stress(solution))
    {
      worst = &state;
      share = state.highest_tension / state.highest_pressure;
    }
  if (!worst)
    return {};
  return line("contact pulls between the points of its multiplier, with up to ",
              labelled(worst->highest_tension, solution.scene.stress_unit), " at (",
              worst->highest_tension_point, "), ", 100 * share,
              " % of the largest pressure; refine there");
}

/** The foundation holds the body at points or in moments only. */
template <int dim>
std::string penetration(const Solution<dim> &solution,
                        const std::vector<ContactState<dim>> &contact)
{
  const ContactState<dim> *worst = nullptr;
  for (const ContactState<dim> &state : contact)
    if (!worst || state.deepest_penetration > worst->deepest_penetration)
      worst = &state;
  if (!worst || worst->deepest_penetration == 0)
    return {};
  return deep_penetration(solution.scene, worst->boundary, worst->deepest_penetration,
                          worst->deepest_penetration_point, deformation(solution));
}

template <int dim>
std::string unseen_contact(const Solution<dim> &solution)
{
  const std::vector<UnseenContact<dim>> places = unseen_contacts(solution);
  if (places.empty())
    return {};
  const auto &worst = *std::max_element(
      places.begin(), places.end(), [](const auto &a, const auto &b) { return a.depth < b.depth; });
  return line(
      "contact is smaller than the mesh sees: the body passes through the foundation by ",
      labelled(worst.depth, solution.scene.length_unit), " at (", worst.where,
      "), between points that nothing presses; set Geometry/Graded towards that point, or take "
      "more steps of an adaptive method that bisects");
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
std::string unseen_gap(const Solution<dim> &solution)
{
  const std::vector<UnseenGap<dim>> places = unseen_gaps(solution);
  if (places.empty())
    return {};
  const auto &worst =
      *std::max_element(places.begin(), places.end(),
                        [](const auto &a, const auto &b)
                        { return std::abs(a.gap - a.seen) < std::abs(b.gap - b.seen); });
  return line("Gap varies inside ", places.size(), places.size() == 1 ? " edge" : " edges",
              " more than the points of the contact conditions see: near (", worst.where,
              ") it is ", labelled(worst.gap, solution.scene.length_unit),
              ", the conditions stand for ",
              labelled(std::abs(worst.seen) < 1e-9 * std::abs(worst.gap) ? 0. : worst.seen,
                       solution.scene.length_unit),
              " in an edge of length ", labelled(worst.face->length, solution.scene.length_unit),
              "; refine there, put a vertex where Gap jumps, or take more steps of an adaptive "
              "method that bisects");
}

template <int dim>
std::string coarse_transition(const Solution<dim> &solution,
                              const std::vector<ContactState<dim>> &contact)
{
  std::string list;
  for (const ContactState<dim> &state : contact)
    for (const Point<dim> &x : state.transitions)
      if (const double edge = longest_edge_at(x, state.boundary, solution);
          edge > 0.01 * state.length)
        list += line(list.empty() ? "" : ", ", "(", x, ") to +-",
                     labelled(edge, solution.scene.length_unit));
  if (list.empty())
    return {};
  return (solution.scene.has_unilateral_contact() ? "zones of contact meet at "
                                                  : "stick and slip meet at ") +
         list +
         " only: more than 1 % of the contact boundary; take more steps of an adaptive method";
}

template <int dim>
std::string open_friction(const std::vector<ContactState<dim>> &contact)
{
  double open = 0, all = 0;
  for (const ContactState<dim> &state : contact)
  {
    open += state.open_friction;
    all += state.absolute_friction;
  }
  return friction_without_contact(open, all);
}

/** Three steps in a row that bring less than a tenth each. */
std::string stagnating_estimate(const History &history)
{
  const unsigned int n = history.size(), steps = 3;
  if (n <= steps)
    return {};
  for (unsigned int k = n - steps; k < n; ++k)
    if (!(history[k].estimate > 0.9 * history[k - 1].estimate))
      return {};
  return line("the error indicator stagnates: ", history[n - 1 - steps].estimate,
              " three steps ago, ", history[n - 1].estimate,
              " now; the data may hold what no refinement resolves");
}

/** Refinement lowers the indicator of any load with finite energy; a factor 4 upwards is none. */
std::string rising_estimate(const History &history, const bool contact_opens)
{
  // Contact that is found late lifts the indicator once, and then it falls again.
  const auto falls_below = [&](const unsigned int k)
  { return contact_opens && history.back().estimate < history[k].estimate; };
  for (unsigned int k = 1, least = 0; k < history.size(); ++k)
  {
    if (history[k].estimate > 4 * history[least].estimate && !falls_below(least))
      return line("the error indicator rose from ", history[least].estimate, " in step ", least + 1,
                  " to ", history[k].estimate, " in step ", k + 1,
                  ": a load or a prescribed displacement may be unbounded; look for poles",
                  contact_opens ? ", or for contact that coarse meshes missed" : "");
    if (history[k].estimate < history[least].estimate)
      least = k;
  }
  return {};
}

std::string round_off(const AlgebraicError &algebraic)
{
  if (algebraic.total() <= AlgebraicError::doubtful)
    return {};
  return line("round-off reaches ", algebraic.total(),
              " of the solution: the body is slender or weakly supported beyond what double "
              "precision resolves; trust no more digits than that");
}

template <int dim>
std::string elongated_elements(const Solution<dim> &solution)
{
  double worst = 1;
  Point<dim> where;
  for (const auto &cell : solution.displacement_space.dof_handler().active_cell_iterators())
  {
    if (!cell->is_locally_owned())
      continue;
    const CellMap<dim> map = map_of<dim>(cell);
    const double ratio = map.longest_edge() / map.shortest_edge();
    if (ratio > worst)
    {
      worst = ratio;
      where = cell->center();
    }
  }
  if (worst < 20 * (1 - 1e-12))
    return {};
  return line(
      "elements up to ", worst, " times as long as wide, at (", where,
      "): constants of the error indicator grow with that, and where loads jump, or shear at "
      "a corner, so does the bound of the error; take more cells along the body, "
      "Geometry/Subdivisions");
}

/**
 * A parallelogram of 5 degrees multiplies the indicator by 50 and round-off by 1000, which grows
 * like the inverse square of the angle; near 180 degrees alone much less happens.
 */
std::string sharp_corners(const Geometry<2> &geometry)
{
  const std::array<double, 4> angles = corner_angles(geometry);
  std::string list;
  for (unsigned int c = 0; c < angles.size(); ++c)
    if (angles[c] < 5 || angles[c] > 175)
      list += line(list.empty() ? "" : ", ", text(angles[c], 4), " degrees at (",
                   geometry.corners[c], ")");
  if (list.empty())
    return {};
  return "the body has corners of " + list +
         ": distorted elements enlarge the error indicator and round-off; cut the body in another "
         "way or compare with a finer mesh";
}

/** With lambda/mu large, low degrees lock: doc/stability.md shows by how much. */
template <int dim>
std::string locking(const Solution<dim> &solution)
{
  const DisplacementSpace<dim> &space = solution.displacement_space;
  const Adaptivity &adaptivity = solution.scene.adaptivity;
  const auto ratio = [](const Material &material) { return material.lambda(dim) / material.mu(); };
  unsigned int lowest = 4; // locks no more
  const Material *locked = nullptr;
  for (const auto &cell : space.dof_handler().active_cell_iterators())
  {
    if (!cell->is_locally_owned())
      continue;
    unsigned int degree = space.degrees()[cell->active_cell_index()];
    // hp meshes that began with low degrees are refined for what those could not resolve.
    if (adaptivity.method >= Method::hpa1)
      degree = std::min(degree, adaptivity.start_degree);
    const Material &material = solution.scene.material_of(cell);
    if (degree < lowest && ratio(material) >= 50)
    {
      lowest = degree;
      locked = &material;
    }
  }
  if (locked == nullptr)
    return {};
  return line("Poisson's ratio ", text(locked->poisson),
              " is near 1/2 (lambda/mu = ", ratio(*locked), ") and elements of degree ", lowest,
              " may lock; use Adaptivity/Start degree = 6");
}

/** The least offset at which displacement and multiplier no longer balance: the thesis has -2. */
template <int dim>
std::string rich_multiplier(const Solution<dim> &solution)
{
  if (solution.scene.solver.multiplier_offset < -1 || solution.z.size() == 0)
    return {};
  return "multipliers of degree p - 1 are too many: the inf-sup constant falls as the mesh is "
         "refined (see hpvi --inf-sup); use Solver/Multiplier degree offset = -2";
}

/** Friction gives all it has, `|sum w_i z_i t| = sum w_i g(x_i)`: both edges of a strip may be in contact. */
template <int dim>
std::string whole_body_slips(const Solution<dim> &solution,
                             const std::vector<ContactState<dim>> &contact)
{
  const std::vector<RigidBodyMotion<dim>> motions = solution.scene.free_motions();
  if (motions.empty() || solution.scene.has_pressure())
    return {};
  Tensor<1, dim> friction;
  for (const ContactState<dim> &state : contact)
    friction += state.friction_force;
  if (std::abs(friction * motions.front().translation) <
      (1 - slip_tolerance) * solution.contact_space.discrete_friction_limit())
    return {};
  return line("the loads reach what friction can resist: the whole body slips ",
              motions.front().direction(),
              " and its place is not unique; lower the loads or add a support");
}

/**
 * With unilateral contact: a motion that no multiplier resists which could still change. These are the
 * frictions below their bound and the pressures above zero; `sum_i w_i (d_i . R(x_i))^2` over them is
 * not positive definite for the motions R.
 */
template <int dim>
std::string free_place(const Solution<dim> &solution, const std::vector<ContactState<dim>> &contact)
{
  const std::vector<RigidBodyMotion<dim>> motions = solution.scene.free_motions();
  if (motions.empty() || !solution.scene.has_pressure())
    return {};
  double largest = 0, size = 0;
  for (const ContactState<dim> &state : contact)
    largest = std::max(largest, state.highest_pressure);
  FullMatrix<double> gram(motions.size(), motions.size());
  for (unsigned int i = 0; i < solution.z.size(); ++i)
  {
    const ContactMultiplier<dim> &multiplier = solution.contact_space.multipliers()[i];
    size += multiplier.weight;
    const bool holds = multiplier.kind == ContactMultiplier<dim>::Kind::pressure
                           ? multiplier.is_bilateral || solution.z[i] > slip_tolerance * largest
                           : std::abs(solution.z[i]) <
                                 (1 - slip_tolerance) * solution.contact_space.bound(i, solution.z);
    for (unsigned int j = 0; j < motions.size() && holds; ++j)
      for (unsigned int k = 0; k < motions.size(); ++k)
        gram(j, k) += multiplier.weight * (multiplier.direction * motions[j].at(multiplier.x)) *
                      (multiplier.direction * motions[k].at(multiplier.x));
  }
  const auto [eigenvalue, combination] = eigenpairs(gram).back();
  if (eigenvalue > 1e-14 * size)
    return {};
  const std::string entry = friction_entry(solution.contact_space);
  return line("contact does not hold the body ", combined(motions, combination).direction(),
              ": its place is not unique; ", entry.empty() ? "" : "raise " + entry + ", ",
              "lower the loads or add a support");
}

/** The entry that gives friction on @p face. */
template <int dim>
std::string friction_entry(const ContactFace<dim> &face)
{
  return face.condition->friction.coefficient ? "Friction coefficient" : "Friction bound";
}

/** Those that @p entry gives. */
template <int dim, template <int> class Place>
std::vector<Place<dim>> places_of(const std::string &entry, const std::vector<Place<dim>> &places)
{
  std::vector<Place<dim>> result;
  std::copy_if(places.begin(), places.end(), std::back_inserter(result),
               [&](const Place<dim> &place) { return friction_entry(*place.face) == entry; });
  return result;
}

/** The discrete problem takes what @p entry gives at Gauss points only. */
template <int dim>
std::string coarse_bound(const Solution<dim> &solution, const std::string &entry)
{
  const std::vector<UnresolvedBound<dim>> bounds =
      places_of(entry, solution.contact_space.unresolved_bounds(solution.z));
  if (bounds.empty())
    return {};
  const auto error = [](const UnresolvedBound<dim> &bound)
  { return std::abs(bound.sum - bound.integral); };
  const auto &worst =
      *std::max_element(bounds.begin(), bounds.end(),
                        [&](const auto &a, const auto &b) { return error(a) < error(b); });
  return line(entry, " varies inside ", bounds.size(), bounds.size() == 1 ? " edge" : " edges",
              " more than the multiplier's points see: ",
              worst.face->condition->friction.coefficient ? "times the pressure " : "",
              "they sum to ", worst.sum, ", the integral is ", worst.integral,
              " over the edge at (", worst.face->point(0.5),
              "); refine there, or take more steps of an adaptive method that bisects");
}

template <int dim>
std::string unresolved_jump(const Solution<dim> &solution, const std::string &entry)
{
  const std::vector<UnresolvedJump<dim>> jumps =
      places_of(entry, solution.contact_space.unresolved_jumps(solution.z));
  if (jumps.empty())
    return {};
  const auto &worst = *std::max_element(
      jumps.begin(), jumps.end(), [](const auto &a, const auto &b) { return a.force < b.force; });
  return line(
      entry, " jumps inside ", jumps.size(), jumps.size() == 1 ? " edge" : " edges", ", by up to ",
      labelled(worst.height,
               worst.face->condition->friction.coefficient ? "" : solution.scene.stress_unit),
      " at (", worst.where, ") in an edge of length ",
      labelled(worst.face->length, solution.scene.length_unit),
      ": no polynomial follows that; put a vertex there by Geometry/Subdivisions or "
      "Geometry/Graded towards, or take more steps of an adaptive method");
}

/** "there", or "there and in so many other places". */
std::string places(const std::size_t n)
{
  return n == 1 ? "there"
                : line("there, and in ", n - 1, n == 2 ? " other place" : " other places");
}

template <int dim>
std::string unresolved_load(const Solution<dim> &solution)
{
  const auto loads = solution.spaces->loads->unresolved(*solution.spaces->mesh);
  if (loads.empty())
    return {};
  const auto &worst =
      *std::max_element(loads.begin(), loads.end(),
                        [](const auto &a, const auto &b) { return a.deviation < b.deviation; });
  return worst.name + " is not resolved near (" + text(worst.where[0], 3) + " " +
         text(worst.where[1], 3) + "): its force on the edge or cell " + places(loads.size()) +
         " is (" + line(worst.force) + ") by the rule of the run and (" + line(worst.finer) +
         ") by one four times finer; put vertices where it jumps, or write it smoother";
}

template <int dim>
std::string missed_displacement(const Solution<dim> &solution)
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
  return worst.name + " lies between the nodes near (" + text(worst.where[0], 3) + " " +
         text(worst.where[1], 3) + "): " + places(missed.size()) + " it is " +
         labelled(worst.value, solution.scene.length_unit) + ", and " +
         labelled(worst.interpolated, solution.scene.length_unit) +
         " in the discrete problem; refine there, or take more steps of an adaptive method that "
         "bisects";
}

/** Displacements are those since the body was at rest, so that past load steps count. */
template <int dim>
std::string large_strain(const Solution<dim> &solution)
{
  const std::vector<MeanGradient<dim>> means =
      mean_gradients(solution.displacement_space, solution.tables, solution.u);
  const auto &worst = *std::max_element(means.begin(), means.end(),
                                        [](const auto &a, const auto &b)
                                        { return a.largest_strain() < b.largest_strain(); });
  if (worst.largest_strain() < 0.05)
    return {};
  return line("the strain is ", 100 * worst.largest_strain(),
              " % on average over the coarse cell at (", worst.centre,
              "): linear elasticity is for strains of a few percent at most; check loads, "
              "prescribed displacements and Young's modulus");
}

/** A body that turns by the angle a grows by `1/cos a - 1` in linear theory, 0.4 % at 5 degrees. */
template <int dim>
std::string large_rotation(const Solution<dim> &solution)
{
  const std::vector<MeanGradient<dim>> means =
      mean_gradients(solution.displacement_space, solution.tables, solution.u);
  const auto &worst =
      *std::max_element(means.begin(), means.end(),
                        [](const auto &a, const auto &b) { return a.rotation() < b.rotation(); });
  const double degrees = worst.rotation() * 180 / numbers::PI;
  if (degrees < 5)
    return {};
  return line("the body turns by ", degrees, " degrees on average over the coarse cell at (",
              worst.centre,
              "): linear elasticity is for rotations of a few degrees at most; check loads, "
              "prescribed displacements and Young's modulus");
}

/** Contact and its data stay where they were in the body at rest. */
template <int dim>
std::string long_slip(const Solution<dim> &solution, const std::vector<ContactState<dim>> &contact)
{
  const Corners<dim> &corners = solution.scene.geometry.corners;
  const double size = std::max(corners[0].distance(corners[3]), corners[1].distance(corners[2]));
  double longest = 0;
  Point<dim> where;
  for (const ContactState<dim> &state : contact)
    for (const ContactPoint<dim> &point : state.points)
      if (!point.is_open && std::abs(point.tangential_displacement) > longest)
      {
        longest = std::abs(point.tangential_displacement);
        where = point.x;
      }
  if (longest < 0.1 * size)
    return {};
  return line("the body slides by ", labelled(longest, solution.scene.length_unit), " at (", where,
              "), ", 100 * longest / size,
              " % of its size, where contact is that of the body at rest; check loads and "
              "prescribed displacements");
}

/** Empty fields of the table are explained once. */
std::string no_condition_number(const History &history)
{
  std::string list;
  for (unsigned int k = 0; k < history.size(); ++k)
    if (history[k].lacks_condition)
      list += (list.empty() ? "" : ", ") + std::to_string(k + 1);
  if (list.empty())
    return {};
  return "S is singular up to round-off in step " + list +
         ": there the table has no condition number; Friction bound may differ too much from point "
         "to point, or a multiplier act nowhere";
}
} // namespace

template <int dim>
std::vector<std::string> warnings(const Solution<dim> &solution,
                                  const std::vector<ContactState<dim>> &contact,
                                  const History &history, const AlgebraicError &algebraic)
{
  std::vector<std::string> result;
  for (const std::string &warning :
       {tensile_contact(solution, contact),
        overshooting_multiplier(solution),
        pulling_pressure(solution, contact),
        penetration(solution, contact),
        coarse_transition(solution, contact),
        open_friction(contact),
        stagnating_estimate(history),
        rising_estimate(history, solution.scene.has_unilateral_contact()),
        unseen_contact(solution),
        unseen_gap(solution),
        round_off(algebraic),
        elongated_elements(solution),
        sharp_corners(solution.scene.geometry),
        large_strain(solution),
        large_rotation(solution),
        long_slip(solution, contact),
        locking(solution),
        rich_multiplier(solution),
        whole_body_slips(solution, contact),
        free_place(solution, contact),
        coarse_bound(solution, "Friction bound"),
        unresolved_jump(solution, "Friction bound"),
        coarse_bound(solution, "Friction coefficient"),
        unresolved_jump(solution, "Friction coefficient"),
        unresolved_load(solution),
        missed_displacement(solution),
        no_condition_number(history)})
    if (!warning.empty())
      result.push_back(warning);
  return result;
}

template <int dim>
std::string deep_penetration(const Scene<dim> &scene, const types::boundary_id boundary,
                             const double depth, const Point<dim> &where, const double deformation)
{
  if (!(depth > 0.01 * deformation))
    return {};
  return line("the body penetrates the foundation of ", scene.boundaries[boundary].name,
              " by up to ", labelled(depth, scene.length_unit), " at (", where,
              "), more than 1 % of the ", labelled(deformation, scene.length_unit),
              " by which it deforms; refine there, or put a vertex where Gap has a kink or a jump");
}

std::string friction_without_contact(const double open, const double all)
{
  if (!(open > 0.01 * all))
    return {};
  return line("friction acts where contact is open: ", 100 * open / all,
              " % of it, because Friction bound is Tresca's and knows no pressure; let it vanish "
              "there, or take Friction coefficient");
}

std::string round_off_of_bound(const double relative, const double imbalance)
{
  if (!(relative < 1e-9 && relative > 1e-12)) // below that a run ends as exact to round-off
    return {};
  return line(
      "the bound of the error is ", relative,
      " of the solution, where round-off counts: it leaves patches of cells out of balance by ",
      imbalance, " of their stresses");
}

std::string several_solutions(const CoulombReport &report)
{
  if (!report.difference || *report.difference <= CoulombReport::same)
    return {};
  if (std::isnan(*report.difference))
    return "Coulomb friction: from a second start no solution was found, so that it is not known "
           "whether there is another than this one";
  return line(
      "Coulomb friction has another solution, found from a second start: in the energy norm "
      "the tractions differ by ",
      *report.difference,
      " of the larger ones; what came before the loads decides between them, or lower "
      "Friction coefficient");
}

template std::string deep_penetration(const Scene<2> &, types::boundary_id, double,
                                      const Point<2> &, double);
template std::string deep_penetration(const Scene<3> &, types::boundary_id, double,
                                      const Point<3> &, double);
template std::vector<std::string> warnings(const Solution<2> &,
                                           const std::vector<ContactState<2>> &, const History &,
                                           const AlgebraicError &);
} // namespace hpvi
