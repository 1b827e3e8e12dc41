// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/bound/boundary_tractions.h>
#include <hpvi/bound/edge_polynomial.h>
#include <hpvi/bound/legendre.h>
#include <hpvi/plane/springs.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Do the traction of an edge at the boundary and the outer normal agree, 1, or not, -1? */
double outward(const StressEdge &edge)
{
  return edge.sides[0].face % 2 ? 1. : -1.;
}
} // namespace

BoundaryTractions::BoundaryTractions(const Solution<2> &solution, const VertexPatches &patches,
                                     const Parts &friction, const Parts &pressure,
                                     const JointTractions *const joints)
    : solution(solution), patches(patches), joints(joints), halves(patches.edges().size())
{
  const auto &faces = solution.contact_space.faces();
  contact_parts.resize(faces.size());
  for (unsigned int face = 0; !joints && face < faces.size(); ++face)
    for (unsigned int end = 0; end < 2; ++end)
    {
      contact_parts[face].friction[end] = friction(face, end);
      if (faces[face].condition->is_unilateral())
        contact_parts[face].pressure[end] = pressure(face, end);
    }
  for (unsigned int e = 0; e < halves.size(); ++e)
    if (patches.edges()[e].at_boundary())
      set(e);
}

const BoundaryTractions::Halves &BoundaryTractions::of_hats(const unsigned int edge) const
{
  return halves[edge];
}

/** Adds `weight psi traction` at s in [0,1] of an edge for the hat functions psi of both ends, whose tractions may differ. */
void BoundaryTractions::add_load(const unsigned int index, const double s, const double weight,
                                 const std::array<Tensor<1, 2>, 2> &tractions)
{
  const StressEdge &edge = patches.edges()[index];
  const std::vector<double> L = legendre::values(edge.degree, 2 * s - 1);
  for (unsigned int end = 0; end < 2; ++end)
    for (unsigned int c = 0; c < 2; ++c)
    {
      std::vector<double> &coefficients = halves[index][end][c];
      const double psi = end == 0 ? 1 - s : s,
                   value = 2 * weight * psi * (tractions[end] * edge.components[c].direction);
      for (unsigned int i = 0; i < coefficients.size(); ++i)
        coefficients[i] += value * L[i];
    }
}

/** That of the discrete equations. */
LoadRule<1> BoundaryTractions::rule(const StressEdge &edge, const Datum datum) const
{
  const StressEdge::Side &side = edge.sides[0];
  const auto &cell = patches.cells()[side.cell].iterator;
  const unsigned int degree = solution.displacement_space.degrees()[side.cell];
  const LoadRules<2> &rules = *solution.spaces->loads;
  return datum == Datum::load ? rules.traction(cell, side.face, degree)
                              : rules.spring(cell, side.face, degree);
}

Point<2> BoundaryTractions::point(const StressEdge &edge, const double s) const
{
  const StressEdge::Side &side = edge.sides[0];
  const auto &cell = patches.cells()[side.cell].iterator;
  const auto face = cell->face(side.face);
  return edge.is_curved ? map_of<2>(cell).point(point_on_face<2>(side.face, Point<1>(s)))
                        : face->vertex(0) + s * (face->vertex(1) - face->vertex(0));
}

/** |x'|/length. */
double BoundaryTractions::stretch(const StressEdge &edge, const double s) const
{
  const StressEdge::Side &side = edge.sides[0];
  return edge.is_curved
             ? map_of<2>(patches.cells()[side.cell].iterator)
                       .face_measure(side.face, point_on_face<2>(side.face, Point<1>(s))) /
                   edge.length
             : 1.;
}

Tensor<1, 2> BoundaryTractions::load_on(const StressEdge &edge, const double s) const
{
  const BoundaryCondition<2> &condition = solution.scene.boundaries[edge.boundary];
  const Point<2> x = point(edge, s);
  return outward(edge) * stretch(edge, s) * solution.scene.circumference(x) *
         load_at<2>(condition.traction, x);
}

/** What springs exert on the displacement that the stress is made of. */
Tensor<1, 2> BoundaryTractions::spring_on(const StressEdge &edge, const double s) const
{
  const BoundaryCondition<2> &condition = solution.scene.boundaries[edge.boundary];
  const StressEdge::Side &side = edge.sides[0];
  const CellMap<2> map = map_of<2>(patches.cells()[side.cell].iterator);
  const Point<2> on_face = point_on_face<2>(side.face, Point<1>(s));
  const unsigned int p = solution.displacement_space.degrees()[side.cell];
  const auto dofs = solution.displacement_space.cell_dofs(side.cell);
  const LocalNumbering &numbering = solution.tables.numbering(p);
  std::vector<double> nodal(dofs.size());
  for (unsigned int i = 0; i < dofs.size(); ++i)
    nodal[numbering.component[i] * dofs.size() / 2 + numbering.shape[i]] = solution.u[dofs[i]];
  const std::vector<double> u = evaluate(tabulate<2>(p, {on_face}, {1.}, false).values, nodal);
  return -outward(edge) * stretch(edge, s) * solution.scene.circumference(map.point(on_face)) *
         (condition.spring.stiffness(map.point(on_face), map.normal(side.face, on_face)) *
          Tensor<1, 2>({u[0], u[1]}));
}

/** `-g l t` with the polynomial l of one end. */
Tensor<1, 2> BoundaryTractions::friction_on(const StressEdge &edge, const unsigned int end,
                                            const double s, const double bound) const
{
  const ContactFace<2> &face = solution.contact_space.faces()[edge.contact_face];
  return -outward(edge) * bound *
         legendre::evaluate(contact_parts[edge.contact_face].friction[end], 2 * s - 1) *
         face.frame(s).tangent;
}

/**
 * What loads and contact prescribe on an edge of the boundary, in the direction of the edge's traction.
 * Loads have the quadrature of the discrete equations, so that moments are the same.
 */
void BoundaryTractions::set(const unsigned int index)
{
  const StressEdge &edge = patches.edges()[index];
  const BoundaryCondition<2> &condition = solution.scene.boundaries[edge.boundary];
  for (auto &half : halves[index])
    for (unsigned int c = 0; c < 2; ++c)
      half[c].assign(edge.components[c].n, 0.);
  const auto add_loads = [&](const Quadrature<1> &rule, const auto &load)
  {
    for (unsigned int q = 0; q < rule.size(); ++q)
    {
      const Tensor<1, 2> value = load(edge, rule.point(q)[0]);
      add_load(index, rule.point(q)[0], rule.weight(q), {{value, value}});
    }
  };
  if (condition.has_traction())
    add_loads(rule(edge, Datum::load).quadrature,
              [&](const auto &...at) { return load_on(at...); });
  if (condition.spring)
    add_loads(rule(edge, Datum::spring).quadrature,
              [&](const auto &...at) { return spring_on(at...); });
  if (edge.contact_face != numbers::invalid_unsigned_int)
    joints ? add_joint(index) : add_contact(index);
  for (unsigned int end = 0; !edge.is_curved && end < 2; ++end)
    meet_ends(edge, end, value(index, end));
  if (solution.scene.is_axisymmetric())
    vanish_on_axis(index);
}

/** Tractions all the way around an axis are zero on it: so are their polynomials, by the highest mode. */
void BoundaryTractions::vanish_on_axis(const unsigned int index)
{
  const StressEdge &edge = patches.edges()[index];
  for (const unsigned int end : {0, 1})
    if (std::abs(point(edge, end)[0]) < 1e-12 * edge.length)
      for (auto &half : halves[index])
        for (std::vector<double> &coefficients : half)
        {
          double value = 0;
          for (unsigned int i = 0; i < coefficients.size(); ++i)
            value += coefficients[i] * legendre::at_end(i, end);
          if (!coefficients.empty())
            coefficients.back() -= value / legendre::at_end(coefficients.size() - 1, end);
        }
}

void BoundaryTractions::add_contact(const unsigned int index)
{
  const StressEdge &edge = patches.edges()[index];
  const FrictionRule friction = traction_rule(solution.contact_space.faces()[edge.contact_face],
                                              edge.degree - 2, solution.tables);
  for (unsigned int q = 0; q < friction.points.size(); ++q)
    add_load(index, friction.points[q], friction.weights[q],
             {{friction_on(edge, 0, friction.points[q], friction.values[q]),
               friction_on(edge, 1, friction.points[q], friction.values[q])}});
  for (unsigned int end = 0; end < 2; ++end)
  {
    const std::vector<double> &t = contact_parts[edge.contact_face].pressure[end];
    for (unsigned int i = 0; i < t.size(); ++i)
      halves[index][end][0][i] -= t[i];
  }
}

/** On the slave's side, where it is not cut; else each piece has its own. */
void BoundaryTractions::add_joint(const unsigned int index)
{
  const StressEdge &edge = patches.edges()[index];
  const JointPiece &piece = joints->edges()[edge.contact_face].pieces[0];
  if (joints->edges()[edge.contact_face].is_cut)
    return;
  for (const auto &[s, weight] : joints->points(piece, 0., 1., edge.degree + 1))
  {
    const Tensor<1, 2> T = -outward(edge) / edge.length * joints->density(piece, s);
    add_load(index, s, weight, {{T, T}});
  }
}

Tensor<1, 2> BoundaryTractions::load(const unsigned int index, const double s) const
{
  const StressEdge &edge = patches.edges()[index];
  return solution.scene.boundaries[edge.boundary].spring ? load_on(edge, s) + spring_on(edge, s)
                                                         : load_on(edge, s);
}

Tensor<1, 2> BoundaryTractions::value(const unsigned int index, const double s) const
{
  const StressEdge &edge = patches.edges()[index];
  const Tensor<1, 2> result = load(index, s);
  if (edge.contact_face == numbers::invalid_unsigned_int)
    return result;
  if (joints && joints->edges()[edge.contact_face].is_cut)
    return result;
  if (joints)
    return result - outward(edge) / edge.length *
                        joints->density(joints->edges()[edge.contact_face].pieces[0], s);
  const ContactFace<2> &face = solution.contact_space.faces()[edge.contact_face];
  const auto &[friction, pressure] = contact_parts[edge.contact_face];
  const auto at = [s](const std::vector<double> &part)
  { return legendre::evaluate(part, 2 * s - 1); };
  const double l = (1 - s) * at(friction[0]) + s * at(friction[1]);
  return result - outward(edge) * face.limit_at(s) * l * face.frame(s).tangent -
         (at(pressure[0]) + at(pressure[1])) * edge.normal;
}

double BoundaryTractions::work_of_loads(const unsigned int index,
                                        const std::function<Tensor<1, 2>(double)> &v) const
{
  const StressEdge &edge = patches.edges()[index];
  const BoundaryCondition<2> &condition = solution.scene.boundaries[edge.boundary];
  double sum = 0;
  const auto add = [&](const Quadrature<1> &rule, const auto &load)
  {
    for (unsigned int q = 0; q < rule.size(); ++q)
      sum += rule.weight(q) * (load(rule.point(q)[0]) * v(rule.point(q)[0]));
  };
  if (condition.has_traction())
    add(rule(edge, Datum::load).quadrature, [&](const double s) { return load_on(edge, s); });
  if (condition.spring)
    add(rule(edge, Datum::spring).quadrature, [&](const double s) { return spring_on(edge, s); });
  return outward(edge) * edge.length * sum;
}

std::vector<std::pair<double, double>> BoundaryTractions::points(const unsigned int index) const
{
  const StressEdge &edge = patches.edges()[index];
  std::vector<double> cuts = {0., 1.};
  unsigned int n = 8;
  const BoundaryCondition<2> &condition = solution.scene.boundaries[edge.boundary];
  for (const Datum datum : {Datum::load, Datum::spring})
    if (datum == Datum::load ? condition.has_traction() : bool(condition.spring))
    {
      const LoadRule<1> own = rule(edge, datum);
      cuts.insert(cuts.end(), own.cuts.begin(), own.cuts.end());
      n = std::max(n, own.most_points);
    }
  if (edge.contact_face != numbers::invalid_unsigned_int)
  {
    const auto &others = solution.contact_space.faces()[edge.contact_face].friction.cuts;
    cuts.insert(cuts.end(), others.begin(), others.end());
  }
  std::sort(cuts.begin(), cuts.end());
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  const QGauss<1> &gauss = solution.tables.gauss(edge.degree + n);
  std::vector<std::pair<double, double>> result;
  for (unsigned int piece = 0; piece + 1 < cuts.size(); ++piece)
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const double length = cuts[piece + 1] - cuts[piece];
      result.emplace_back(cuts[piece] + length * gauss.point(q)[0], length * gauss.weight(q));
    }
  return result;
}

/**
 * The shear at the ends of an edge is that of the neighbouring edges, whatever projections are; the two highest modes
 * of a component that is known, of the tangential one if it is, make it so.
 */
void BoundaryTractions::meet_ends(const StressEdge &edge, const unsigned int end,
                                  const Tensor<1, 2> &at_end)
{
  auto &parts = halves[&edge - patches.edges().data()][end];
  std::array<double, 2> weights, missing{{0., 0.}};
  for (unsigned int c = 0; c < 2; ++c)
  {
    const StressEdge::Component &component = edge.components[c];
    weights[c] = component.is_unknown ? 0. : edge.weight_in_shear(component);
    missing[end] += weights[c] * (at_end * component.direction);
    for (unsigned int i = 0; i < component.n; ++i)
      for (unsigned int side = 0; side < 2; ++side)
        missing[side] -= weights[c] * parts[c][i] * legendre::at_end(i, side);
  }
  const unsigned int by = weights[1] != 0., n = edge.components[by].n;
  for (const unsigned int i : {n - 2, n - 1})
    for (unsigned int side = 0; weights[by] != 0. && side < 2; ++side)
      parts[by][i] += missing[side] / weights[by] * legendre::at_end(i, side) / (2 * i + 1);
}

/** S_xy at one end of a boundary edge, as far as it is known. */
BoundaryTractions::EndShear BoundaryTractions::end_shear(const unsigned int index,
                                                         const unsigned int end) const
{
  const StressEdge &edge = patches.edges()[index];
  EndShear result;
  for (unsigned int c = 0; c < 2; ++c)
  {
    const StressEdge::Component &component = edge.components[c];
    const double weight = edge.weight_in_shear(component);
    if (component.is_unknown)
    {
      result.is_free |= std::abs(component.direction * edge.tangent) > 1. - 1e-12;
      result.leans |= weight != 0.;
      continue;
    }
    double value = 0;
    for (unsigned int i = 0; i < component.n; ++i)
      value += halves[index][end][c][i] * legendre::at_end(i, end);
    result.known += weight * value;
    result.scale += std::abs(value);
  }
  return result;
}

/**
 * Corners of cells, by bits, where the edges of the boundary that meet prescribe different shears. The cells
 * of both share the difference, that of one cell takes it. So they do where other boundaries meet and the shear of one leans on an unknown traction that is not along it:
 * that alone could pay for the difference, but by the more the less it leans. Equal shears differ by round-off of the largest
 * one, more so where vertices far from the origin are rounded. Where glued bodies begin to touch, the shear between them
 * may be that of neither side.
 */
std::vector<unsigned int> BoundaryTractions::marked_corners() const
{
  struct End
  {
    unsigned int edge, end, side;
  };
  std::vector<unsigned int> result(patches.cells().size());
  std::map<unsigned int, std::vector<End>> ends;
  const std::vector<StressEdge> &all = patches.edges();
  for (unsigned int e = 0; e < all.size(); ++e)
    if (all[e].at_boundary())
      for (unsigned int end = 0; end < 2; ++end)
        for (unsigned int side = 0; side < all[e].sides.size(); ++side)
          ends[(side == 0 ? all[e].vertices : all[e].vertices_opposite)[end]].push_back(
              {e, end, side});
  double largest = 0;
  for (const auto &[vertex, edges] : ends)
    for (const auto &[e, end, side] : edges)
      largest = std::max(largest, end_shear(e, end).scale);
  for (const auto &[vertex, edges] : ends)
  {
    const StressEdge &first = all[edges[0].edge], &second = all[edges[1].edge];
    const EndShear one = end_shear(edges[0].edge, edges[0].end),
                   other = end_shear(edges[1].edge, edges[1].end);
    const bool differs = std::abs(one.known - other.known) > 1e-10 * largest,
               leans = first.boundary != second.boundary && (one.leans || other.leans),
               is_end_of_joint = (first.joins_bodies() && one.is_free) !=
                                 (second.joins_bodies() && other.is_free);
    if (!is_end_of_joint && (one.is_free || other.is_free || !(differs || leans)))
      continue;
    for (const auto &[e, end, side] : edges)
    {
      const StressEdge::Side &at = all[e].sides[side];
      result[at.cell] |= 1u << GeometryInfo<2>::face_to_cell_vertices(
                             at.face, at.part == reversed_edge ? 1 - end : end);
    }
  }
  return result;
}
} // namespace hpvi
