// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/dense_algebra.h>
#include <hpvi/base/thread_pool.h>
#include <hpvi/bound/admissible_pressure.h>
#include <hpvi/bound/cell_constants.h>
#include <hpvi/bound/data_error.h>
#include <hpvi/bound/displacement_lift.h>
#include <hpvi/plane/initial_stress.h>
#include <hpvi/plane/internal_forces.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace hpvi
{
using namespace dealii;

namespace
{
/** |G - Pi G| on an edge, in the components that are prescribed; of a cell on the axis over the root of 2 pi x. */
double missed_traction(const Solution<2> &solution, const EquilibratedStress &stress,
                       const unsigned int index)
{
  const StressEdge &edge = stress.patches().edges()[index];
  const auto &cell = stress.patches().cells()[edge.sides[0].cell].iterator;
  const CellMap<2> map = map_of<2>(cell);
  const bool is_on_axis = CellConstants(map).is_on_axis(solution.scene.material_of(cell));
  double sum = 0;
  for (const auto &[s, weight] : stress.prescribed().points(index))
  {
    const Tensor<1, 2> exact = stress.prescribed().value(index, s);
    double length = edge.length / stress.prescribed().stretch(edge, s);
    if (is_on_axis)
      length /= full_turn(map.point(point_on_face<2>(edge.sides[0].face, Point<1>(s))));
    for (unsigned int c = 0; c < 2; ++c)
      if (!edge.components[c].is_unknown)
      {
        const double missed = exact * edge.components[c].direction -
                              legendre::evaluate(stress.tractions()[index][c], 2 * s - 1);
        sum += weight * length * missed * missed;
      }
  }
  return std::sqrt(sum);
}

/**
 * What no rule of quadrature tells of loads and springs, at most 1e-9 of them: counted as if all of them were wrong by this
 * part. Below 1e-13 it is round-off, like an imbalance of patches up to 1e-9 of their stresses. One above, which round-off
 * leaves where a stiff material moves with a soft one, counts as if n patches were out of it all in one direction: their
 * forces do n^{1/2} times the work then that the stresses of one do on its strains.
 */
double unresolved_loads(const Solution<2> &solution, const EquilibratedStress &stress)
{
  const LoadRules<2> &rules = *solution.spaces->loads;
  double part = rules.difference(Datum::load) + rules.difference(Datum::spring);
  if (stress.defect > 1e-9)
    part += stress.defect * std::sqrt(double(stress.squares.size()));
  if (part < 1e-13)
    return 0.;
  return part * std::sqrt(internal_forces(solution.scene, solution.displacement_space,
                                          solution.tables, solution.u)
                              .energy_product);
}

/** Along unilateral contact; between two bodies it is the slave's. */
bool has_gap(const Solution<2> &solution, const StressEdge &edge)
{
  const BoundaryCondition<2> &condition = solution.scene.boundaries[edge.boundary];
  return condition.is_unilateral() && condition.gap &&
         edge.contact_face != numbers::invalid_unsigned_int;
}

/** One component of u_D, or of u_0 n along unilateral contact, at s in [0,1] of an edge; none: neither. */
std::function<double(double)> prescribed_value(const Solution<2> &solution, const StressEdge &edge,
                                               const CellMap<2> &map, const unsigned int component)
{
  const BoundaryCondition<2> &condition = solution.scene.boundaries[edge.boundary];
  if (const auto &u_D = condition.displacement[component])
    return [&u_D, &map, face = edge.sides[0].face](const double s)
    { return u_D->value(map.point(point_on_face<2>(face, Point<1>(s)))); };
  if (!has_gap(solution, edge))
    return {};
  const ContactFace<2> &face = solution.contact_space.faces()[edge.contact_face];
  return [&face, component](const double s)
  { return face.node_frame(s).normal[component] * gap_on_face(face, s); };
}

/** delta = d on one edge: what the nodes of V_N miss of u_D or u_0 n. */
struct Missed
{
  std::array<Vector<double>, 2> value; ///< Legendre coefficients
  std::array<double, 2>
      missed_data{}; ///< by how much the polynomial differs from the data between its nodes
  Point<2> missed_at;

  /** A polynomial that vanishes at both ends and oscillates by `missed_data`, beyond the degrees of value. */
  std::array<Vector<double>, 2> oscillation() const;
};

std::array<Vector<double>, 2> Missed::oscillation() const
{
  const unsigned int n = value[0].size();
  std::array<Vector<double>, 2> result{{Vector<double>(n + 2), Vector<double>(n + 2)}};
  for (unsigned int c = 0; c < 2; ++c) // P_{n+1} - P_{n-1}
  {
    result[c][n + 1] = missed_data[c] / legendre::at_end(n + 1, true);
    result[c][n - 1] = -missed_data[c] / legendre::at_end(n - 1, true);
  }
  return result;
}

Missed missed_displacement(const Solution<2> &solution, const EquilibratedStress &stress,
                           const unsigned int index)
{
  const StressEdge &edge = stress.patches().edges()[index];
  const BoundaryCondition<2> &condition = solution.scene.boundaries[edge.boundary];
  const unsigned int cell = edge.sides[0].cell, face = edge.sides[0].face;
  const unsigned int p = solution.displacement_space.degrees()[cell], n = p + 13;
  const CellMap<2> map = map_of<2>(stress.patches().cells()[cell].iterator);
  const QGaussLobatto<1> &nodes = solution.tables.gauss_lobatto(n),
                         &own = solution.tables.gauss_lobatto(p + 1);
  const auto dofs = solution.displacement_space.cell_dofs(cell);
  const std::vector<unsigned int> &on_edge = solution.tables.numbering(p).edge[face];
  const LegendreTables &tables = stress.legendre_tables();
  std::vector<double> between =
      solution.spaces->loads->displacement_points(stress.patches().cells()[cell].iterator, face);
  for (unsigned int k = 0; k < n; ++k)
    between.push_back((k + 0.5) / n);
  Missed result;
  for (unsigned int c = 0; c < 2; ++c)
  {
    result.value[c].reinit(n);
    const auto data = prescribed_value(solution, edge, map, c);
    if (!data)
      continue;
    Vector<double> at_own(p + 1), coarse(p + 1), at_nodes(n);
    for (unsigned int k = 0; k <= p; ++k)
      at_own[k] = condition.displacement[c] ? solution.u[dofs[on_edge[c * (p + 1) + k]]]
                                            : data(own.point(k)[0]);
    tables.from_nodes(p).vmult(coarse, at_own);
    for (unsigned int k = 0; k < n; ++k)
      at_nodes[k] = data(nodes.point(k)[0]);
    tables.from_nodes(n - 1).vmult(result.value[c], at_nodes);
    const std::vector<double> fine(result.value[c].begin(), result.value[c].end());
    const double round_off = 1e-13 * at_nodes.linfty_norm(),
                 before = std::max(result.missed_data[0], result.missed_data[1]);
    for (const double s : between)
      if (const double missed = std::abs(legendre::evaluate(fine, 2 * s - 1) - data(s));
          missed > std::max(round_off, result.missed_data[c]))
      {
        result.missed_data[c] = missed;
        if (missed > before)
          result.missed_at = map.point(point_on_face<2>(face, Point<1>(s)));
      }
    for (unsigned int i = 0; i <= p; ++i)
      result.value[c][i] -= coarse[i];
    if (result.value[c].linfty_norm() <= 1e-14 * at_nodes.linfty_norm() || // round-off
        (edge.is_curved && !condition.displacement[c]))                    // which JointLift knows
      result.value[c] = 0.;
  }
  return result;
}

/** At s in [0,1] of its edge. */
Tensor<1, 2> value_at(const std::array<Vector<double>, 2> &coefficients, const double s)
{
  const std::vector<double> L = legendre::values(coefficients[0].size(), 2 * s - 1);
  Tensor<1, 2> result;
  for (unsigned int c = 0; c < 2; ++c)
    for (unsigned int i = 0; i < L.size(); ++i)
      result[c] += coefficients[c][i] * L[i];
  return result;
}

/** int (s n - G + k u_N) . d over an edge. */
double boundary_work(const Solution<2> &solution, const EquilibratedStress &stress,
                     const unsigned int index, const Missed &missed)
{
  const StressEdge &edge = stress.patches().edges()[index];
  double sum = 0;
  for (unsigned int k = 0; k < 2; ++k)
    for (unsigned int c = 0; c < 2; ++c)
      for (unsigned int i = 0; i < stress.tractions()[index][k].size(); ++i)
        if (i < missed.value[c].size())
          sum += 0.5 * edge.components[k].direction[c] * stress.tractions()[index][k][i] *
                 missed.value[c][i];
  const BoundaryCondition<2> &condition = solution.scene.boundaries[edge.boundary];
  if (condition.has_traction() || condition.spring)
    for (const auto &[s, weight] : stress.prescribed().points(index))
      sum -= weight * (stress.prescribed().load(index, s) * value_at(missed.value, s));
  const auto &cell = stress.patches().cells()[edge.sides[0].cell].iterator;
  return cell->face(edge.sides[0].face)->diameter() * (edge.sides[0].face % 2 ? 1. : -1.) * sum;
}

/** No less than int |s n| over an edge. */
double absolute_traction(const EquilibratedStress &stress, const unsigned int index)
{
  double square = 0;
  for (const std::vector<double> &component : stress.tractions()[index])
    square += std::inner_product(component.begin(), component.end(), component.begin(), 0.);
  const StressEdge::Side &side = stress.patches().edges()[index].sides[0];
  return stress.patches().cells()[side.cell].iterator->face(side.face)->diameter() *
         std::sqrt(square / 2);
}

} // namespace

/** What s lacks of the initial stress is a stress: it needs no constant. What the discrete equations miss of it does work on u_N. */
void DataError::add_initial_strain(const Solution<2> &solution, const EquilibratedStress &stress)
{
  std::vector<double> squares(oscillation.size()); // of what the discrete equations miss
  parallel_for_each(squares.size(), 8,
                    [&](const unsigned int cell)
                    {
                      oscillation[cell] += stress.missed_initial_stress(cell);
                      squares[cell] = stress.initial_stress_error(solution, cell);
                    });
  const double norm = std::sqrt(
      internal_forces(solution.scene, solution.displacement_space, solution.tables, solution.u)
          .energy_product);
  const double missed = std::sqrt(sum(squares));
  if (missed <= 1e-12 * norm)
    return; // round-off
  unresolved += missed;
  missed_work += missed * norm;
}

namespace
{
/** `C |missed|` of a traction on an edge, C that of its trace. */
double oscillation_of(const Solution<2> &solution, const EquilibratedStress &stress,
                      const StressEdge::Side &side, const double missed)
{
  const auto &cell = stress.patches().cells()[side.cell].iterator;
  const CellConstants shape(map_of<2>(cell));
  const Material &material = solution.scene.material_of(cell);
  return missed == 0.                 ? 0.
         : shape.is_on_axis(material) ? shape.trace_on_axis(side.face) * missed
                                      : shape.trace(side.face) * shape.korn() * missed;
}
} // namespace

DataError::DataError(const Solution<2> &solution, const EquilibratedStress &stress,
                     const JointLift *const joints)
    : oscillation(stress.squares.size()), lifts(oscillation.size()),
      unresolved(unresolved_loads(solution, stress))
{
  if (joints)
  {
    lifts = joints->cells;
    lift_work = joints->work;
  }
  const VertexPatches &patches = stress.patches();
  std::vector<double> in_contact(oscillation.size());
  for (unsigned int e = 0; e < patches.edges().size(); ++e)
  {
    const StressEdge &edge = patches.edges()[e];
    if (!edge.at_boundary())
      continue;
    const auto add = [&](const StressEdge::Side &side, const double missed, const bool is_known)
    {
      const double of_side = oscillation_of(solution, stress, side, missed);
      oscillation[side.cell] += of_side;
      if (!is_known)
        in_contact[side.cell] += of_side;
    };
    const unsigned int cell = edge.sides[0].cell, face = edge.sides[0].face;
    const BoundaryCondition<2> &condition = solution.scene.boundaries[edge.boundary];
    if (condition.has_traction() || condition.friction || condition.spring || edge.is_given)
      for (const StressEdge::Side &side : edge.sides) // friction between two bodies acts on both
        add(side, missed_traction(solution, stress, e),
            !condition.has_contact() && !condition.friction && !condition.spring && !edge.is_given);
    if (stress.has_rows())
      add(edge.sides[0], stress.missed_traction(cell, face), false);
    if (condition.has_displacement() || has_gap(solution, edge))
    {
      const Missed missed = missed_displacement(solution, stress, e);
      // two edges of a cell: the triangle inequality
      const auto &iterator = patches.cells()[cell].iterator;
      const CellMap<2> map = map_of<2>(iterator);
      for (const auto &part : {missed.value, missed.oscillation()})
        lifts[cell] += std::sqrt(
            std::max(0., lift_energy(map, face, part, solution.scene.material_of(iterator),
                                     solution.tables) +
                             spring_energy(solution.scene, condition, map, face,
                                           edge_points(part, 6, solution.tables))));
      lift_work += boundary_work(solution, stress, e, missed);
      const double most = std::max(missed.missed_data[0], missed.missed_data[1]);
      missed_work += most * absolute_traction(stress, e);
      if (most > missed_data)
      {
        missed_data = most;
        missed_at = missed.missed_at;
      }
    }
  }
  std::vector<double> missed_forces(oscillation.size());
  if (solution.scene.has_body_force())
    parallel_for_each(missed_forces.size(), 8,
                      [&](const unsigned int cell)
                      { missed_forces[cell] = stress.missed_force(cell); });
  for (unsigned int cell = 0; cell < oscillation.size(); ++cell)
  {
    lift += lifts[cell] * lifts[cell];
    const double missed = missed_forces[cell];
    if (oscillation[cell] == 0. && missed == 0.)
      continue;
    const auto &iterator = patches.cells()[cell].iterator;
    const CellConstants shape(map_of<2>(iterator));
    const Material &material = solution.scene.material_of(iterator);
    if (missed > 0.)
      oscillation[cell] += shape.poincare() * shape.korn() * missed;
    const double root =
        std::sqrt(shape.is_on_axis(material) ? material.coercivity(3) : shape.coercivity(material));
    oscillation[cell] /= root;
    beside += std::pow(in_contact[cell] / root, 2);
  }
  beside = std::sqrt(beside);
  for (unsigned int cell = 0; cell < oscillation.size(); ++cell)
    oscillation[cell] += stress.antisymmetry[cell];
  if (solution.scene.has_initial_strain())
    add_initial_strain(solution, stress);
  beside += unresolved;
  lift = std::sqrt(lift);
}
} // namespace hpvi
