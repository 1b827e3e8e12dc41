// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/quadrature_lib.h>
#include <hpvi/base/input_error.h>
#include <hpvi/base/tolerances.h>
#include <hpvi/plane/coarse_cuts.h>
#include <hpvi/plane/contact_space.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace hpvi
{
using namespace dealii;

namespace
{
/** The highest of what slip is counted from. */
template <int dim>
unsigned int degree_of_past(const ContactFace<dim> &face)
{
  unsigned int degree = face.degree;
  for (const ContactSegment<dim> &segment : face.segments)
    degree = std::max(degree, segment.degree + (segment.drawn ? 4 : 0));
  return degree;
}
/** The points of the rules for g and mu_f: of both, where both are there, on their common pieces. */
template <int dim>
std::vector<PointLimit> limits_of(const ContactFace<dim> &face, const QGauss<1> &gauss)
{
  std::vector<PointLimit> result;
  const auto add = [&](const double s, const double weight)
  {
    const Point<dim> x = face.point(s);
    const double measure = face.map.is_curved()   ? face.frame(s).measure / face.length
                           : face.is_axisymmetric ? full_turn(x)
                                                  : 1.;
    result.push_back({s, weight * measure, face.condition->friction.at(x)});
  };
  const FrictionRule &one = face.friction.vanishes() ? face.coefficient : face.friction;
  if (face.friction.vanishes() || face.coefficient.vanishes())
  {
    for (unsigned int q = 0; q < one.points.size(); ++q)
      add(one.points[q], one.weights[q]);
    return result;
  }
  std::vector<double> cuts;
  std::set_union(face.friction.cuts.begin(), face.friction.cuts.end(),
                 face.coefficient.cuts.begin(), face.coefficient.cuts.end(),
                 std::back_inserter(cuts));
  for (unsigned int k = 0; k + 1 < cuts.size(); ++k)
    for (unsigned int q = 0; q < gauss.size(); ++q)
      add(cuts[k] + (cuts[k + 1] - cuts[k]) * gauss.point(q)[0],
          (cuts[k + 1] - cuts[k]) * gauss.weight(q));
  return result;
}

/** Give the face its rules for g, mu_f and the limit; in `int g |u_t|` g meets the degree p. */
template <int dim>
void integrate_friction(ContactFace<dim> &face, const QGauss<1> &gauss, const Scene<dim> &scene)
{
  // A coarse edge has its share of the samples that loads have along a side.
  const unsigned int n_parts = coarse_cuts::n_parts(
      face.cell, 512 / gauss.size(), scene.geometry.n_cells(1 - face.face_no / 2), 16);
  const auto parts_for = [&](const Expression<dim> &function)
  { return coarse_cuts::varies(function) ? n_parts : 1U; };
  const unsigned int degree = face.degree + std::max(1U, face.n_points) - 1;
  face.friction =
      make_friction_rule([&face](const double s) { return face.friction_bound(face.point(s)); },
                         gauss, degree, parts_for(face.condition->friction.bound));
  if (face.condition->friction.knows_pressure())
    face.coefficient = make_friction_rule(
        [&face](const double s) { return face.friction_coefficient(face.point(s)); }, gauss, degree,
        parts_for(face.condition->friction.coefficient));
  face.limits = limits_of(face, gauss);
}

/** A scene by code is checked at some points of the boundary, none of which need be @p x. */
template <int dim>
FrictionLimit checked_limit(const ContactFace<dim> &face, const Point<dim> &x)
{
  const double g = face.friction_bound(x);
  if (g >= 0 && std::isfinite(g))
    return face.condition->friction.at(x);
  std::ostringstream line;
  line << "Boundary " << face.condition->name << "/Friction bound: is " << g << " at (" << x
       << "); give a bound that is finite and not negative everywhere";
  throw InputError(line.str());
}

/** u_0 at @p x, of which the same is true. */
template <int dim>
double checked_gap(const ContactFace<dim> &face, const Point<dim> &x)
{
  const double gap = face.condition->gap_at(x);
  if (std::isfinite(gap))
    return gap;
  std::ostringstream line;
  line << "Boundary " << face.condition->name << "/Gap: is " << gap << " at (" << x
       << "); give a gap that is finite everywhere";
  throw InputError(line.str());
}

/** Is `direction . u` prescribed at a node? */
template <int dim>
bool is_prescribed(const AffineConstraints<double> &constraints,
                   const std::array<types::global_dof_index, dim> &dofs,
                   const Tensor<1, dim> &direction)
{
  std::map<types::global_dof_index, double> free;
  for (unsigned int c = 0; c < dim; ++c)
    if (const auto *entries = constraints.get_constraint_entries(dofs[c]))
      for (const auto &[master, weight] : *entries)
        free[master] += direction[c] * weight;
    else
      free[dofs[c]] += direction[c];
  return std::all_of(free.begin(), free.end(),
                     [](const auto &entry) { return std::abs(entry.second) < repeated_direction; });
}
} // namespace

template <int dim>
void ContactSpace<dim>::number_friction(ContactFace<dim> &face, const Scene<dim> &scene,
                                        const ShapeTables<dim> &tables)
{
  // p+1 Gauss points are exact to degree 2p+1 = p + (p-2) + 3: exact for g up to degree 3, or 2
  // for multipliers of degree p-1. Only beyond degree p, where no run goes, it takes more.
  integrate_friction(face, tables.gauss(std::max(face.degree + 1, face.n_points)), scene);
  face.first_multiplier = unknowns.size();
  const bool acts = std::any_of(face.limits.begin(), face.limits.end(),
                                [](const PointLimit &at) { return !at.friction.vanishes(); }) ||
                    face.condition->is_tied();
  face.n_multipliers = acts ? face.n_points : 0;
  if (face.n_multipliers == 0)
    return;
  const QGauss<1> &points = tables.gauss(face.n_points);
  elements.try_emplace(face.n_points, points);
  for (unsigned int i = 0; i < face.n_points; ++i)
  {
    const ContactFrame<dim> frame = face.frame(points.point(i)[0]);
    unknowns.push_back({Kind::friction, frame.x, frame.tangent, face.basis_integral(points, i),
                        checked_limit(face, frame.x)});
    unknowns.back().is_bilateral = face.condition->is_tied();
  }
  if (face.past)
    add_past(face, tables.gauss(std::max(degree_of_past(face), face.n_points) + 1));
}

namespace
{
/** Where edges of the body opposite end, gaps and jumps may have kinks. */
template <int dim>
std::vector<std::array<double, 2>> pieces_of(const ContactFace<dim> &face)
{
  std::vector<std::array<double, 2>> pieces;
  for (const ContactSegment<dim> &segment : face.segments)
    pieces.push_back({{segment.begin, segment.end}});
  if (pieces.empty())
    pieces.push_back({{0., 1.}});
  return pieces;
}
} // namespace

/** What slip is counted from is a polynomial of degree p, between bodies on each segment: @p gauss is exact. */
template <int dim>
void ContactSpace<dim>::add_past(const ContactFace<dim> &face, const QGauss<1> &gauss)
{
  for (const auto &[begin, end] : pieces_of(face))
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const double s = begin + (end - begin) * gauss.point(q)[0];
      const ContactFrame<dim> frame = face.frame(s);
      const double past = (end - begin) * gauss.weight(q) * frame.measure * face.past_slip(frame.x);
      const std::vector<double> basis = basis_values(face, s);
      for (unsigned int i = 0; i < basis.size(); ++i)
        unknowns[face.first_multiplier + i].gap += past * basis[i];
    }
}

/** Moments of the gap by p + 2 points: exact for gaps of degree up to p + 3 - offset. */
template <int dim>
void ContactSpace<dim>::number_pressures(ContactFace<dim> &face, const ShapeTables<dim> &tables)
{
  const QGauss<1> &points = tables.gauss(face.n_points),
                  &gauss = tables.gauss(std::max(face.degree, face.n_points) + 2);
  for (unsigned int i = 0; i < face.n_points; ++i)
  {
    const ContactFrame<dim> frame = face.frame(points.point(i)[0]);
    face.normal_points.push_back(points.point(i)[0]);
    face.pressures.push_back(unknowns.size());
    if (face.condition->friction.knows_pressure() && face.n_multipliers > 0)
      unknowns[face.first_multiplier + i].partner = unknowns.size();
    unknowns.push_back({Kind::pressure, frame.x, frame.normal, face.basis_integral(points, i)});
    unknowns.back().is_bilateral = !face.condition->is_unilateral();
  }
  for (const auto &[begin, end] : pieces_of(face))
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const double s = begin + (end - begin) * gauss.point(q)[0];
      const ContactFrame<dim> frame = face.frame(s);
      const double gap =
          (end - begin) * gauss.weight(q) * frame.measure * checked_gap(face, frame.x);
      const std::vector<double> basis = lagrange_basis(face.normal_points, s);
      for (unsigned int i = 0; i < basis.size(); ++i)
        unknowns[face.pressures[i]].gap += gap * basis[i];
    }
}

/** Nodes of equal normal share an unknown, which has the smaller gap. */
template <int dim>
void ContactSpace<dim>::number_nodes(ContactFace<dim> &face,
                                     const DisplacementSpace<dim> &displacement_space,
                                     const ShapeTables<dim> &tables)
{
  static_assert(dim == 2, "nodes along a straight edge");
  const unsigned int p = face.degree;
  const auto dofs = displacement_space.cell_dofs(face.cell->active_cell_index());
  const std::vector<unsigned int> &on_edge = tables.numbering(p).edge[face.face_no];
  const QGaussLobatto<1> &rule = tables.gauss_lobatto(p + 1);
  for (unsigned int k = 0; k <= p; ++k)
  {
    const ContactFrame<dim> frame = face.node_frame(rule.point(k)[0]);
    const double weight = rule.weight(k) * frame.measure, gap = checked_gap(face, frame.x);
    // The support carries what presses there; that it stays above the gap has been checked.
    if (is_prescribed<dim>(displacement_space.constraints(),
                           {{dofs[on_edge[k]], dofs[on_edge[p + 1 + k]]}}, frame.normal))
      continue;
    unsigned int unknown = unknowns.size();
    if (k == 0 || k == p)
    {
      std::vector<unsigned int> &known =
          at_vertices[face.cell->face(face.face_no)->vertex_index(k / p)];
      const auto same =
          std::find_if(known.begin(), known.end(),
                       [&](const unsigned int i) {
                         return (unknowns[i].direction - frame.normal).norm() < repeated_direction;
                       });
      if (same == known.end())
        known.push_back(unknown);
      else
        unknown = *same;
    }
    face.normal_points.push_back(rule.point(k)[0]);
    face.pressures.push_back(unknown);
    if (unknown == unknowns.size())
      unknowns.push_back({Kind::pressure, frame.x, frame.normal});
    ContactMultiplier<dim> &node = unknowns[unknown];
    const double least = node.weight == 0. ? gap : std::min(gap, node.gap / node.weight);
    node.weight += weight;
    node.gap = least * node.weight;
  }
}

template void ContactSpace<2>::number_friction(ContactFace<2> &, const Scene<2> &,
                                               const ShapeTables<2> &);
template void ContactSpace<2>::number_pressures(ContactFace<2> &, const ShapeTables<2> &);
template void ContactSpace<2>::number_nodes(ContactFace<2> &, const DisplacementSpace<2> &,
                                            const ShapeTables<2> &);
} // namespace hpvi
