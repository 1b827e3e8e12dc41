// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/quadrature_lib.h>
#include <hpvi/base/input_error.h>
#include <hpvi/contact/contact_order.h>
#include <hpvi/contact/contact_space.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr unsigned int none = numbers::invalid_unsigned_int;
constexpr double infinity = std::numeric_limits<double>::infinity();

template <int dim>
ContactFace<dim> make_face(const typename DoFHandler<dim>::active_cell_iterator &cell,
                           const unsigned int face_no, const unsigned int degree,
                           const int multiplier_offset, const BoundaryCondition<dim> &condition)
{
  ContactFace<dim> face{cell, face_no, degree, &condition, map_of<dim>(cell), 0, 0, 0,
                        0,    {},      {},     {}};
  face.n_points = std::max(0, static_cast<int>(degree) + multiplier_offset + 1);
  face.length = face.map.is_curved() ? face.map.face_area(face_no) : face.frame(0.5).measure;
  return face;
}

/** The points of the rules for g and mu_f: of both, where both are there, on their common pieces. */
template <int dim>
std::vector<PointLimit> limits_of(const ContactFace<dim> &face, const QGauss<1> &gauss)
{
  std::vector<PointLimit> result;
  const auto add = [&](const double s, const double weight)
  {
    const Point<dim> x = face.point(s);
    const double measure = face.map.is_curved() ? face.frame(s).measure / face.length
                           : face.is_turned     ? full_turn(x)
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
void integrate_friction(ContactFace<dim> &face, const QGauss<1> &gauss)
{
  const unsigned int degree = face.degree + std::max(1U, face.n_points) - 1;
  face.friction = make_friction_rule(
      [&face](const double s) { return face.friction_bound(face.point(s)); }, gauss, degree);
  if (face.condition->friction.knows_pressure())
    face.coefficient = make_friction_rule([&face](const double s)
                                          { return face.friction_coefficient(face.point(s)); },
                                          gauss, degree);
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
                     [](const auto &entry) { return std::abs(entry.second) < 1e-6; });
}
} // namespace

template <int dim>
ContactSpace<dim>::ContactSpace(const Scene<dim> &scene,
                                const DisplacementSpace<dim> &displacement_space,
                                const ShapeTables<dim> &tables, const PastSlip<dim> &past)
{
  if (!scene.has_contact())
    return;
  for (const auto &cell : displacement_space.dof_handler().active_cell_iterators())
    if (cell->is_locally_owned() && cell->at_boundary())
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary())
        {
          const BoundaryCondition<dim> &condition = scene.boundaries[cell->face(f)->boundary_id()];
          if (condition.has_contact())
            contact_faces.push_back(
                make_face(cell, f, displacement_space.degrees()[cell->active_cell_index()],
                          scene.solver.multiplier_offset, condition));
        }

  sort_along_boundaries(scene.geometry, contact_faces);
  for (ContactFace<dim> &face : contact_faces)
  {
    face.is_turned = scene.is_axisymmetric();
    if (const auto found = past.find(face.condition->id); found != past.end())
      face.past = found->second;
    number_friction(face, tables);
    if (!face.condition->has_pressure())
      continue;
    // With nodes a limit that follows the pressure could turn negative between them.
    face.at_nodes = scene.normal_contact() == NormalContact::nodes &&
                    !face.condition->friction.knows_pressure();
    if (face.at_nodes)
      number_nodes(face, displacement_space, tables);
    else
      number_pressures(face, tables);
  }
}

template <int dim>
void ContactSpace<dim>::number_friction(ContactFace<dim> &face, const ShapeTables<dim> &tables)
{
  // p+1 Gauss points are exact to degree 2p+1 = p + (p-2) + 3: exact for g up to degree 3, or 2
  // for multipliers of degree p-1. Only beyond degree p, where no run goes, it takes more.
  integrate_friction(face, tables.gauss(std::max(face.degree + 1, face.n_points)));
  face.first_multiplier = unknowns.size();
  const bool acts = std::any_of(face.limits.begin(), face.limits.end(),
                                [](const PointLimit &at) { return !at.friction.vanishes(); });
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
  }
  if (face.past)
    add_past(face, tables.gauss(std::max(face.degree, face.n_points) + 1));
}

/** What slip is counted from is a polynomial of degree p: @p gauss is exact. */
template <int dim>
void ContactSpace<dim>::add_past(const ContactFace<dim> &face, const QGauss<1> &gauss)
{
  for (unsigned int q = 0; q < gauss.size(); ++q)
  {
    const ContactFrame<dim> frame = face.frame(gauss.point(q)[0]);
    const double past = gauss.weight(q) * frame.measure * face.past_slip(frame.x);
    const std::vector<double> basis = basis_values(face, gauss.point(q)[0]);
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
  for (unsigned int q = 0; q < gauss.size(); ++q)
  {
    const ContactFrame<dim> frame = face.frame(gauss.point(q)[0]);
    const double gap = gauss.weight(q) * frame.measure * checked_gap(face, frame.x);
    const std::vector<double> basis = lagrange_basis(face.normal_points, gauss.point(q)[0]);
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
      const auto same = std::find_if(known.begin(), known.end(),
                                     [&](const unsigned int i) {
                                       return (unknowns[i].direction - frame.normal).norm() < 1e-6;
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

template <int dim>
const std::vector<ContactFace<dim>> &ContactSpace<dim>::faces() const
{
  return contact_faces;
}

template <int dim>
unsigned int ContactSpace<dim>::n_multipliers() const
{
  return unknowns.size();
}

template <int dim>
const std::vector<ContactMultiplier<dim>> &ContactSpace<dim>::multipliers() const
{
  return unknowns;
}

template <int dim>
FeasibleSet ContactSpace<dim>::feasible_set() const
{
  FeasibleSet result;
  for (const ContactMultiplier<dim> &unknown : unknowns)
    if (unknown.is_bilateral || unknown.partner != none)
      result.add_interval(-infinity, infinity);
    else if (unknown.kind == Kind::friction)
      result.add_interval(-unknown.friction.limit(0.), unknown.friction.limit(0.));
    else
      result.add_interval(0., infinity);
  return result;
}

template <int dim>
std::vector<FrictionCones::Cone> ContactSpace<dim>::cones() const
{
  std::vector<FrictionCones::Cone> result;
  for (unsigned int i = 0; i < unknowns.size(); ++i)
    if (unknowns[i].partner != none)
      result.push_back({i, unknowns[i].partner, unknowns[i].friction});
  return result;
}

template <int dim>
double ContactSpace<dim>::bound(const unsigned int unknown, const Vector<double> &z) const
{
  const ContactMultiplier<dim> &own = unknowns[unknown];
  return own.friction.limit(own.partner == none ? 0. : z[own.partner]);
}

template <int dim>
double ContactSpace<dim>::bound(const ContactFace<dim> &face, const Vector<double> &z,
                                const double s) const
{
  const Point<dim> x = face.point(s);
  const FrictionLaw<dim> &law = face.condition->friction;
  return law.limit(x, law.knows_pressure() ? pressure(face, z, s) : 0.);
}

template <int dim>
std::vector<double> ContactSpace<dim>::basis_values(const ContactFace<dim> &face,
                                                    const double s) const
{
  std::vector<double> values(face.n_multipliers);
  if (face.n_multipliers > 0)
  {
    const FE_DGQArbitraryNodes<dim - 1> &element = elements.at(face.n_multipliers);
    for (unsigned int i = 0; i < values.size(); ++i)
      values[i] = element.shape_value(i, Point<dim - 1>(s));
  }
  return values;
}

template <int dim>
double ContactSpace<dim>::value(const ContactFace<dim> &face, const Vector<double> &z,
                                const double s) const
{
  const std::vector<double> basis = basis_values(face, s);
  double sum = 0;
  for (unsigned int i = 0; i < basis.size(); ++i)
    sum += basis[i] * z[face.first_multiplier + i];
  return sum;
}

template <int dim>
double ContactSpace<dim>::pressure(const ContactFace<dim> &face, const Vector<double> &z,
                                   const double s) const
{
  const std::vector<double> basis = lagrange_basis(face.normal_points, s);
  double sum = 0;
  for (unsigned int i = 0; i < basis.size(); ++i)
    sum += basis[i] * z[face.pressures[i]];
  return sum;
}

template <int dim>
double ContactSpace<dim>::friction_limit() const
{
  double sum = 0;
  for (const ContactFace<dim> &face : contact_faces)
    sum += face.friction_without_pressure();
  return sum;
}

template <int dim>
double ContactSpace<dim>::discrete_friction_limit() const
{
  double sum = 0;
  for (const ContactMultiplier<dim> &unknown : unknowns)
    sum += unknown.weight * unknown.friction.limit(0.);
  return sum;
}

template <int dim>
double ContactSpace<dim>::largest_bound() const
{
  double largest = 0;
  for (const ContactMultiplier<dim> &unknown : unknowns)
    largest = std::max(largest, unknown.friction.limit(0.));
  return largest;
}

template class ContactSpace<2>;
} // namespace hpvi
