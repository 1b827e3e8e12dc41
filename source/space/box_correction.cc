// SPDX-License-Identifier: LGPL-2.1-or-later

// @sect3{An admissible displacement}
//
// U = u_N - w with U_n <= u_0: a Bernstein coefficient of w_n is that of u_n - u_0 where all of its faces press, else its positive part,
// which is enough everywhere. Halves of an edge take over what its whole has: cutting keeps coefficients positive.
#include <hpvi/space/box_bound_stages.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hpvi
{
using namespace dealii;

std::vector<std::vector<types::global_dof_index>>
BoxBound::face_dofs(const ContactDofFace<3> &face) const
{
  std::vector<types::global_dof_index> dofs(space.tables.only().fe.dofs_per_cell);
  face.cell->get_dof_indices(dofs);
  std::vector<std::vector<types::global_dof_index>> result(
      3, std::vector<types::global_dof_index>((p + 1) * (p + 1)));
  const auto axes = tangents<3>(face.face);
  for (unsigned int i = 0; i < space.tables.only().n_shapes; ++i)
  {
    const unsigned int number = numbering[i];
    const std::array<unsigned int, 3> place{
        {number % (p + 1), number / (p + 1) % (p + 1), number / ((p + 1) * (p + 1))}};
    if (place[face.face / 2] == (face.face % 2) * p)
      for (unsigned int c = 0; c < 3; ++c)
        result[c][place[axes[0]] + (p + 1) * place[axes[1]]] =
            dofs[space.tables.only().numbers[i][c]];
  }
  return result;
}

/** By unknown: do all contact faces beside it press, or stick? */
std::vector<bool> BoxBound::held() const
{
  std::vector<bool> result(space.dof_handler.n_dofs(), true);
  for (const ContactDofFace<3> &face : space.faces)
  {
    bool presses = true, sticks = true;
    for (unsigned int k = 0; k < space.tables.only().n_contact_dofs(); ++k)
    {
      presses &= !face.has_pressure() || lambda[face.pressure + k][0] > 0;
      if (!face.has_friction())
      {
        sticks = false;
        continue;
      }
      const ContactDof<3> &friction = space.contact[face.friction + k];
      const bool acts =
          friction.weight > 0 || (friction.has_partner() && lambda[friction.partner][0] > 0);
      sticks &= acts && lambda[face.friction + k].norm() < 1 - 1e-9;
    }
    const auto dofs = face_dofs(face);
    for (unsigned int c = 0; c < 3; ++c)
      for (const auto dof : dofs[c])
        if (!(c == face.face / 2 ? presses : sticks))
          result[dof] = false;
  }
  return result;
}

/** Bernstein coefficients of u_n - u_0 from above, of the tangential component @p component of u. */
BoxModes BoxBound::violation(const ContactDofFace<3> &face, const unsigned int component) const
{
  const double sign = face.face % 2 ? 1. : -1.;
  const auto dofs = face_dofs(face);
  if (component != face.face / 2)
    return slip_trace(dofs[component]);
  BoxModes values, result;
  for (const auto dof : dofs[component])
    values.push_back(u(dof));
  const BoxModes gaps = gaps_at_nodes(face);
  for (unsigned int i = 0; i < values.size(); ++i)
    values[i] = sign * values[i] - gaps[i];
  result = along_axes(of.nodal, values, 2);
  for (double &coefficient : result)
    coefficient += above;
  return result;
}

BoxModes BoxBound::gaps_at_nodes(const ContactDofFace<3> &face) const
{
  const CellMap<3> map = map_of<3>(face.cell);
  const Expression<3> &gap = space.condition(face.cell, face.face).gap;
  BoxModes result((p + 1) * (p + 1));
  for (unsigned int i = 0; gap && i < result.size(); ++i)
    result[i] = gap->value(
        map.point(on_cell_face(face.face, {{of.nodes[i % (p + 1)], of.nodes[i / (p + 1)], 0.}})));
  return result;
}

/** Of all faces: neighbours have the same values at nodes that they share. */
void BoxBound::set_above()
{
  double largest = 0;
  for (const ContactDofFace<3> &face : space.faces)
  {
    const Expression<3> &gap = space.condition(face.cell, face.face).gap;
    if (!gap)
      continue;
    const CellMap<3> map = map_of<3>(face.cell);
    const BoxModes interpolated =
        along_axes(of.to_fine, along_axes(of.nodal, gaps_at_nodes(face), 2), 2);
    at_points(of.fine, 2,
              [&](const unsigned int q, const std::array<double, 3> &x, double)
              {
                const double value = gap->value(map.point(on_cell_face(face.face, x)));
                above = std::max(above, interpolated[q] - value);
                largest = std::max(largest, std::abs(value));
              });
  }
  if (above <= same_gap * largest)
    above = 0;
}

/** Faces by their level. */
std::vector<unsigned int> BoxBound::coarse_first() const
{
  std::vector<unsigned int> result(space.faces.size());
  std::iota(result.begin(), result.end(), 0u);
  std::stable_sort(result.begin(), result.end(),
                   [this](const unsigned int a, const unsigned int b)
                   { return space.faces[a].cell->level() < space.faces[b].cell->level(); });
  return result;
}

void BoxBound::correct()
{
  w = space.ghosted_vector();
  const std::vector<bool> is_held = held();
  set_above();
  for (const bool is_normal : {false, true}) // what must not penetrate has the last word
    for (const unsigned int number : coarse_first())
      for (unsigned int c = 0; c < 3; ++c)
        if (const ContactDofFace<3> &face = space.faces[number];
            (c == face.face / 2) == is_normal &&
            (is_normal ? face.has_pressure() : face.has_friction()))
          correct_along(face, c, is_held);
  set_constrained(w);
  for (const ContactDofFace<3> &face : space.faces)
    if (face.has_pressure())
    {
      const unsigned int c = face.face / 2;
      const double sign = face.face % 2 ? 1. : -1.;
      BoxModes values;
      const std::vector<types::global_dof_index> dofs = face_dofs(face)[c];
      for (const auto dof : dofs)
        values.push_back(sign * w(dof));
      const BoxModes of_w = along_axes(of.nodal, values, 2), needed = violation(face, c);
      for (unsigned int i = 0; i < of_w.size(); ++i)
        if (needed[i] - of_w[i] > same_gap * u.linfty_norm())
          flaw = "a support holds the body where its gap closes";
    }
}

/** Component @p c of w on one face. */
void BoxBound::correct_along(const ContactDofFace<3> &face, const unsigned int c,
                             const std::vector<bool> &is_held)
{
  const auto dofs = face_dofs(face)[c];
  const bool is_normal = c == face.face / 2;
  const double sign = is_normal && face.face % 2 == 0 ? -1. : 1.;
  BoxModes coefficients = violation(face, c);
  for (unsigned int i = 0; i < coefficients.size(); ++i)
    if (!is_held[dofs[i]])
      coefficients[i] = is_normal ? std::max(0., coefficients[i]) : 0.;
  set_trace(dofs, sign, coefficients, w);
}

double BoxBound::constrained_value(const types::global_dof_index dof,
                                   const DistributedVector &of_vector) const
{
  double result = 0;
  if (const auto *const entries = space.constraints.get_constraint_entries(dof))
    for (const auto &[other, weight] : *entries)
      result += weight * of_vector(other);
  return result;
}

void BoxBound::set_constrained(DistributedVector &of_vector) const
{
  for (const auto dof : space.owned)
    if (space.constraints.is_constrained(dof))
      of_vector(dof) = constrained_value(dof, of_vector);
}

/** Bernstein coefficients of what a vector has at the nodes of a face. */
BoxModes BoxBound::trace_of(const DistributedVector &of_vector,
                            const std::vector<types::global_dof_index> &dofs) const
{
  BoxModes values;
  for (const auto dof : dofs)
    values.push_back(of_vector(dof));
  return along_axes(of.nodal, values, 2);
}

/** Of a tangential component of u_N, less the past from which slip counts. */
BoxModes BoxBound::slip_trace(const std::vector<types::global_dof_index> &dofs) const
{
  BoxModes result = trace_of(u, dofs);
  if (space.past)
  {
    const BoxModes before = trace_of(*space.past, dofs);
    for (unsigned int i = 0; i < result.size(); ++i)
      result[i] -= before[i];
  }
  return result;
}

/**
 * Gives the nodes of a face, times @p sign, the values of a polynomial by Bernstein coefficients, but along edges of which inner nodes are
 * constrained: these coefficients become those of the edge.
 */
void BoxBound::set_trace(const std::vector<types::global_dof_index> &dofs, const double sign,
                         BoxModes &coefficients, DistributedVector &of_vector) const
{
  const unsigned int n = p + 1;
  for (const unsigned int side : {0u, p})
    for (unsigned int axis = 0; axis < 2; ++axis)
    {
      const auto place = [&](const unsigned int i)
      { return axis == 0 ? i + n * side : side + n * i; };
      if (!space.constraints.is_constrained(dofs[place(1)]))
        continue;
      BoxModes values;
      for (unsigned int i = 0; i < n; ++i)
      {
        const auto dof = dofs[place(i)];
        values.push_back(sign * (space.constraints.is_constrained(dof)
                                     ? constrained_value(dof, of_vector)
                                     : of_vector(dof)));
      }
      values = along_axes(of.nodal, values, 1);
      for (unsigned int i = 0; i < n; ++i)
        coefficients[place(i)] = values[i];
    }
  const BoxModes values = along_axes(of.to_nodes, coefficients, 2);
  for (unsigned int i = 0; i < values.size(); ++i)
    if (!space.constraints.is_constrained(dofs[i]))
      of_vector(dofs[i]) = sign * values[i];
}
} // namespace hpvi
