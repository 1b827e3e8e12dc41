// SPDX-License-Identifier: LGPL-2.1-or-later

// @sect3{Under Coulomb's law}
//
// Theorem (C) of doc/coulomb.md in space: chi, |chi| <= 1, is a vector along contact and M' >= mu_f (|U_t| - chi . U_t) - (u_0 - U_n). The proof is
// the same.
#include <hpvi/base/formatting.h>
#include <hpvi/base/numbers.h>
#include <hpvi/base/text.h>
#include <hpvi/bound/coulomb_bound.h>
#include <hpvi/bound/coulomb_coupling.h>
#include <hpvi/space/box_bound_stages.h>
#include <hpvi/space/friction_coupling.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr double margin = 1.05;  ///< what spaces still miss of theta
constexpr double reserve = 1.1;  ///< of what the samples of a face miss between them
constexpr double no_slip = 1e-8; ///< of mu_f chi

/** So many equidistant points in [0,1], both ends with them. */
std::vector<double> equidistant(const unsigned int n)
{
  std::vector<double> result(n);
  for (unsigned int i = 0; i < n; ++i)
    result[i] = double(i) / (n - 1);
  return result;
}
} // namespace

/** Has friction on the face a pressure beside it? */
bool BoxBound::couples(const ContactDofFace<3> &face) const
{
  return face.has_friction() && face.has_pressure() &&
         space.condition(face.cell, face.face).friction.knows_pressure();
}

/**
 * chi has to be continuous: a Bernstein coefficient that faces share becomes the mean of those of faces that press, which is in the disc
 * as these are. Where nothing presses it is zero, but for what neighbours have.
 */
void BoxBound::join_directions()
{
  std::vector<double> sums(space.dof_handler.n_dofs()), counts(sums.size());
  std::vector<std::vector<std::vector<types::global_dof_index>>> dofs;
  for (unsigned int k = 0; k < contact.size(); ++k)
  {
    const ContactDofFace<3> &face = space.faces[k];
    dofs.push_back(face_dofs(face));
    if (!couples(face) ||
        *std::max_element(contact[k].pressure.begin(), contact[k].pressure.end()) <= 0)
      continue;
    const auto axes = tangents<3>(face.face);
    for (unsigned int t = 0; t < 2; ++t)
      for (unsigned int i = 0; i < contact[k].lambda[t].size(); ++i)
      {
        sums[dofs[k][axes[t]][i]] += contact[k].lambda[t][i];
        ++counts[dofs[k][axes[t]][i]];
      }
  }
  DistributedVector chi = space.ghosted_vector();
  for (const unsigned int k : coarse_first())
    if (couples(space.faces[k]))
      for (unsigned int t = 0; t < 2; ++t)
      {
        const auto &own = dofs[k][tangents<3>(space.faces[k].face)[t]];
        for (unsigned int i = 0; i < own.size(); ++i)
          contact[k].lambda[t][i] = counts[own[i]] > 0 ? sums[own[i]] / counts[own[i]] : 0.;
        set_trace(own, 1., contact[k].lambda[t], chi);
      }
}

/** mu_f chi at contact dofs. */
std::vector<ContactVector<3>> BoxBound::couplings() const
{
  std::vector<ContactVector<3>> result(space.contact.size());
  for (unsigned int k = 0; k < contact.size(); ++k)
  {
    const ContactDofFace<3> &face = space.faces[k];
    if (!couples(face))
      continue;
    const auto axes = tangents<3>(face.face);
    const Tensor<1, 3> size = PrimalSpace<3>::extent(face.cell);
    const Point<3> corner = map_of<3>(face.cell).point(Point<3>());
    for (unsigned int i = 0; i < space.tables.n_contact_dofs(); ++i)
    {
      const Point<3> x = space.contact[face.friction + i].x;
      const auto a = bernstein(p, (x - corner)[axes[0]] / size[axes[0]]),
                 b = bernstein(p, (x - corner)[axes[1]] / size[axes[1]]);
      Tensor<1, 3> chi;
      for (unsigned int t = 0; t < 2; ++t)
        for (unsigned int j = 0; j < contact[k].lambda[t].size(); ++j)
          chi[axes[t]] += a[j % (p + 1)] * b[j / (p + 1)] * contact[k].lambda[t][j];
      for (unsigned int s = 0; s < 2; ++s)
        result[face.friction + i][s] =
            space.condition(face.cell, face.face).friction.coefficient_at(x) *
            (chi * face.direction(face.tangential(s)));
    }
  }
  return result;
}

/** Where no coupling is finite: something holds the normal displacement at an edge of contact and leaves what slips. Empty: nowhere. */
std::string BoxBound::unbounded() const
{
  std::vector<bool> is_held(space.dof_handler.n_dofs()), is_free(is_held.size(), true);
  for (const auto dof : space.owned)
    if (const auto *const entries = space.constraints.get_constraint_entries(dof))
    {
      is_held[dof] = entries->empty();
      is_free[dof] = !entries->empty();
    }
  for (const ContactDofFace<3> &face : space.faces) // X_t = 0 along friction
  {
    const auto dofs = face_dofs(face);
    for (unsigned int t = 0; face.has_friction() && t < 2; ++t)
      for (const auto dof : dofs[tangents<3>(face.face)[t]])
        is_held[dof] = true;
  }
  for (unsigned int k = 0; k < contact.size(); ++k)
  {
    const ContactDofFace<3> &face = space.faces[k];
    if (!couples(face))
      continue;
    const auto dofs = face_dofs(face);
    const CellMap<3> map = map_of<3>(face.cell);
    for (unsigned int i = 0; i < dofs[0].size(); ++i)
      for (unsigned int t = 0; t < 2; ++t)
      {
        const Point<3> x = map.point(
            on_cell_face(face.face, {{of.nodes[i % (p + 1)], of.nodes[i / (p + 1)], 0.}}));
        if (is_held[dofs[face.face / 2][i]] && is_free[dofs[tangents<3>(face.face)[t]][i]] &&
            std::abs(contact[k].lambda[t][i]) *
                    space.condition(face.cell, face.face).friction.coefficient_at(x) >
                no_slip)
          return "contact with friction ends at " + to_string(x) +
                 ", where the body can slide but not lift, and no coupling is finite";
      }
  }
  return {};
}

/** (mu_f (|U_t| - chi . U_t) - (u_0 - U_n))_+ at tensor products of @p points on a face of the space. */
std::vector<double> BoxBound::against(const unsigned int number,
                                      const std::vector<double> &points) const
{
  const ContactDofFace<3> &face = space.faces[number];
  const BoundaryCondition<3> &condition = space.condition(face.cell, face.face);
  const auto axes = tangents<3>(face.face);
  const unsigned int axis = face.face / 2, n = points.size();
  const double sign = face.face % 2 ? 1. : -1.;
  const CellMap<3> map = map_of<3>(face.cell);
  const FullMatrix<double> values = bernstein_at(points, p);
  std::array<BoxModes, 3> U;
  const auto dofs = face_dofs(face);
  for (unsigned int c = 0; c < 3; ++c)
  {
    U[c] = at(values, trace_of(u, dofs[c]));
    const BoxModes of_w = at(values, trace_of(w, dofs[c]));
    for (unsigned int q = 0; q < of_w.size(); ++q)
      U[c][q] -= of_w[q];
  }
  const std::array<BoxModes, 2> chi{
      {at(values, contact[number].lambda[0]), at(values, contact[number].lambda[1])}};
  std::vector<double> result(n * n);
  for (unsigned int q = 0; q < result.size(); ++q)
  {
    const Point<3> x = map.point(on_cell_face(face.face, {{points[q % n], points[q / n], 0.}}));
    const Tensor<1, 2> slip({U[axes[0]][q], U[axes[1]][q]}), own({chi[0][q], chi[1][q]});
    const double room = (condition.gap ? condition.gap->value(x) : 0.) - sign * U[axis][q],
                 value = condition.friction.coefficient_at(x) * (slip.norm() - own * slip) -
                         std::max(0., room);
    result[q] = value > same_gap * u.linfty_norm() ? value : 0.;
  }
  return result;
}

/**
 * Bernstein coefficients of M' by face, and X with X_n = M', all other nodal values zero; X infinite in its first place: supports are in the way. A
 * coefficient is the largest value that M' has to have near its place, all of them are enlarged until samples are below.
 */
std::vector<BoxModes> BoxBound::bumps(DistributedVector &X) const
{
  const unsigned int n = p + 1, per_part = 4, n_points = per_part * p + 1;
  const std::vector<double> points = equidistant(n_points);
  std::vector<double> heights(space.dof_handler.n_dofs());
  std::vector<std::vector<double>> needed(contact.size());
  for (unsigned int k = 0; k < contact.size(); ++k)
  {
    if (!couples(space.faces[k]))
      continue;
    needed[k] = against(k, points);
    const auto dofs = face_dofs(space.faces[k])[space.faces[k].face / 2];
    for (unsigned int q = 0; q < needed[k].size(); ++q)
      for (unsigned int i = 0; i < dofs.size(); ++i)
        if (std::abs(int(q % n_points) - int(per_part * (i % n))) <= int(per_part) &&
            std::abs(int(q / n_points) - int(per_part * (i / n))) <= int(per_part))
          heights[dofs[i]] = std::max(heights[dofs[i]], needed[k][q]);
  }
  for (const auto dof : space.owned) // halves of an edge take over what its whole has
    if (const auto *const entries = space.constraints.get_constraint_entries(dof))
      for (const auto &[other, weight] : *entries)
        heights[other] = std::max(heights[other], heights[dof]);
  std::vector<BoxModes> result(contact.size());
  const FullMatrix<double> values = bernstein_at(points, p);
  double factor = 1;
  for (const unsigned int k : coarse_first())
  {
    const ContactDofFace<3> &face = space.faces[k];
    if (!couples(face))
      continue;
    const auto dofs = face_dofs(face)[face.face / 2];
    for (const auto dof : dofs)
      result[k].push_back(heights[dof]);
    set_trace(dofs, face.face % 2 ? 1. : -1., result[k], X);
    const BoxModes bump = at(values, result[k]);
    for (unsigned int q = 0; q < bump.size(); ++q)
      if (needed[k][q] > 0)
        factor = std::max(factor, bump[q] > 0 ? needed[k][q] / bump[q] : infinity);
  }
  factor *= reserve;
  set_constrained(X);
  X *= factor;
  for (BoxModes &bump : result)
    for (double &coefficient : bump)
      coefficient *= factor;
  return result;
}

/** |v|_a of nodal values. */
double BoxBound::energy_norm(const DistributedVector &of_vector) const
{
  Vector<double> local(space.tables.fe.dofs_per_cell), internal(local);
  double square = 0;
  for (const Cell &cell : cells)
  {
    cell->get_dof_values(of_vector, local);
    if (local.linfty_norm() == 0)
      continue;
    stiffness.multiply(cell, internal, local);
    square += internal * local;
  }
  return std::sqrt(std::max(0., square));
}

/** int pi (u_0 - U_n + M') over friction that couples, and the gap of all other contact. */
double BoxBound::coulomb_gap(const std::vector<BoxModes> &bumps) const
{
  double result = 0;
  for (unsigned int k = 0; k < contact.size(); ++k)
  {
    const ContactDofFace<3> &face = space.faces[k];
    if (!couples(face))
    {
      result += face_gaps[k];
      continue;
    }
    const auto axes = tangents<3>(face.face);
    const unsigned int axis = face.face / 2;
    const double sign = face.face % 2 ? 1. : -1.;
    const Tensor<1, 3> size = PrimalSpace<3>::extent(face.cell);
    const CellMap<3> map = map_of<3>(face.cell);
    const Expression<3> &gap = space.condition(face.cell, face.face).gap;
    BoxModes U_n = trace_of(u, face_dofs(face)[axis]);
    const BoxModes w_n = trace_of(w, face_dofs(face)[axis]);
    for (unsigned int i = 0; i < U_n.size(); ++i)
      U_n[i] = sign * (U_n[i] - w_n[i]);
    std::array<double, 2> by_rule{};
    for (const bool is_finer : {false, true})
    {
      const FullMatrix<double> &values = is_finer ? of.to_finer : of.to_fine;
      const BoxModes normal = at(values, U_n), bump = at(values, bumps[k]),
                     pressure = at(values, contact[k].pressure);
      at_points(is_finer ? of.finer : of.fine, 2,
                [&](const unsigned int q, const std::array<double, 3> &x, const double weight)
                {
                  const double u_0 = gap ? gap->value(map.point(on_cell_face(face.face, x))) : 0.;
                  by_rule[is_finer] += weight * size[axes[0]] * size[axes[1]] * pressure[q] *
                                       (u_0 - normal[q] + bump[q]);
                });
    }
    result += std::max(0., by_rule[1]) + std::abs(by_rule[1] - by_rule[0]);
  }
  return result;
}

/** A bound for every solution if the coupling of chi allows it; else Tresca's for the same stress is an estimate. */
void BoxBound::set_coulomb(ErrorBound &result, const double A, const double b)
{
  result.kind = BoundKind::estimate;
  double largest = 0; // of closed forms
  for (unsigned int k = 0; k < contact.size(); ++k)
  {
    const ContactDofFace<3> &face = space.faces[k];
    const FrictionLaw<3> &friction = space.condition(face.cell, face.face).friction;
    if (!couples(face))
      continue;
    if (!friction.is_proportional())
    {
      result.why = friction.name() +
                   " has no bound of the error, whatever the coupling: its limit follows the "
                   "pressure " +
                   (friction.by_pressure ? "by a curve" : "up to a bound alone");
      return;
    }
    const double of_material = std::max(half_plane_coupling(space.scene.material_of(face.cell)),
                                        free_wedge_coupling(numbers::PI / 2));
    const CellMap<3> map = map_of<3>(face.cell);
    for (unsigned int i = 0; i < contact[k].lambda[0].size(); ++i)
    {
      const Point<3> x = map.point(
          on_cell_face(face.face, {{double(i % (p + 1)) / p, double(i / (p + 1)) / p, 0.}}));
      largest = std::max(largest, of_material * friction.coefficient_at(x) *
                                      std::hypot(contact[k].lambda[0][i], contact[k].lambda[1][i]));
    }
  }
  result.why = unbounded();
  if (!result.why.empty())
    return;
  result.coupling = std::max(largest, margin * friction_coupling(space, matrix, couplings()));
  DistributedVector X = space.ghosted_vector();
  const std::vector<BoxModes> of_slip = bumps(X);
  const double lift = energy_norm(X),
               total = result.coupling <= largest_coupling && std::isfinite(lift)
                           ? coulomb_bound(result.coupling, {A, coulomb_gap(of_slip), b, lift})
                           : infinity;
  if (std::isfinite(total))
  {
    result.total = result.radius = total;
    result.theta = 0;
    result.kind = BoundKind::coupling;
  }
  else
    result.why = result.coupling <= largest_coupling
                     ? "a support is in the way of what friction against the slip costs"
                     : "the coupling of friction, " + text(result.coupling, 3) +
                           ", is too strong for a bound of the error";
}
} // namespace hpvi
