// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/bound/correction_search.h>
#include <hpvi/plane/matching.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

namespace hpvi
{
using namespace dealii;

namespace
{
/** @p cells and those that share unknowns with them. */
template <int dim>
std::vector<bool> with_neighbours(const std::vector<bool> &cells,
                                  const DisplacementSpace<dim> &space,
                                  const Unknowns<dim> &unknowns, const unsigned int n_unknowns)
{
  std::vector<bool> touched(n_unknowns), result(cells);
  for (unsigned int cell = 0; cell < cells.size(); ++cell)
    if (cells[cell])
      for (const auto dof : space.cell_dofs(cell))
        for (const auto &[unknown, weight] : unknowns.terms(dof))
          touched[unknown] = true;
  for (unsigned int cell = 0; cell < cells.size(); ++cell)
    for (const auto dof : space.cell_dofs(cell))
      for (const auto &[unknown, weight] : unknowns.terms(dof))
        result[cell] = result[cell] || touched[unknown];
  return result;
}
} // namespace

/**
 * Free are the traces, and what none but cells at the contact boundary have: w decays so fast into the body
 * more cells would change its energy by a few hundredths. A body that keeps its volume needs more room to move.
 * Along faces that slip everywhere, and are not @p nearby where others do not, w has nothing to mend.
 */
template <int dim>
std::vector<typename CorrectionSearch<dim>::Role>
CorrectionSearch<dim>::roles(const std::vector<bool> &nearby) const
{
  const Unknowns<dim> &unknowns = discretisation.unknowns;
  const auto may_rub = [&](const unsigned int k)
  { return !faces[k].friction.vanishes() && (slips[k].mode != Slip::everywhere || nearby[k]); };
  std::vector<Role> result(A.n(), Role::free);
  std::vector<bool> is_at_contact(solution.displacement_space.degrees().size());
  const auto take = [&](const unsigned int k)
  {
    is_at_contact[faces[k].cell->active_cell_index()] = true;
    for (const ContactSegment<dim> &segment : faces[k].segments)
      is_at_contact[segment.cell->active_cell_index()] = true;
  };
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (may_rub(k) || is_near_pressure[k])
      take(k);
  for (const Joint &joint : joints)
    take(joint.face);
  if (solution.scene.is_nearly_incompressible())
    is_at_contact = with_neighbours(is_at_contact, solution.displacement_space, unknowns, A.n());
  for (unsigned int cell = 0; cell < is_at_contact.size(); ++cell)
    if (!is_at_contact[cell])
      for (const auto dof : solution.displacement_space.cell_dofs(cell))
        for (const auto &[unknown, weight] : unknowns.terms(dof))
          result[unknown] = Role::outside;
  for (unsigned int k = 0; k < faces.size(); ++k)
    for (const unsigned int unknown : traces[k].unknowns)
      if (slips[k].mode == Slip::nowhere)
        result[unknown] = Role::fixed;
      else if (may_rub(k) && result[unknown] == Role::outside)
        result[unknown] = Role::free;
  add_normal_roles(result);
  join_roles(result);
  free_coupled_edges(result);
  return result;
}

/**
 * An edge whose nodes others constrain, as those of its halves or of a lower degree do, is told by some of its nodes and its
 * vertices: which nodes depends on the frame, and so would what it is to keep them where they are while a vertex moves. They are
 * free, in both components. Edges at contact have moments in their place, as every frame has them.
 */
template <int dim>
void CorrectionSearch<dim>::free_coupled_edges(std::vector<Role> &roles) const
{
  const DisplacementSpace<dim> &space = solution.displacement_space;
  const Unknowns<dim> &unknowns = discretisation.unknowns;
  const std::vector<bool> is_on_contact = contact_dofs();
  std::vector<bool> is_of_edge(roles.size()), is_coupled(roles.size());
  const auto moves = [&](const auto &term) { return roles[term.first] != Role::outside; };
  for (unsigned int cell = 0; cell < space.degrees().size(); ++cell)
  {
    const LocalNumbering &numbering = solution.tables.numbering(space.degrees()[cell]);
    const auto dofs = space.cell_dofs(cell);
    std::vector<bool> moves_with_others(numbering.shape.size());
    for (unsigned int i = 0; i < dofs.size(); ++i)
    {
      const Terms terms = unknowns.terms(dofs[i]);
      if (is_on_contact[dofs[i]])
        continue;
      if (numbering.shape[i] >= GeometryInfo<dim>::vertices_per_cell && unknowns.is_plain(dofs[i]))
        is_of_edge[terms[0].first] = true;
      if (std::any_of(terms.begin(), terms.end(), moves))
        moves_with_others[numbering.shape[i]] = true;
    }
    for (unsigned int i = 0; i < dofs.size(); ++i)
      if (moves_with_others[numbering.shape[i]] && !is_on_contact[dofs[i]])
        for (const auto &[unknown, weight] : unknowns.terms(dofs[i]))
          is_coupled[unknown] = true;
  }
  for (unsigned int unknown = 0; unknown < roles.size(); ++unknown)
    if (is_of_edge[unknown] && is_coupled[unknown] && roles[unknown] == Role::outside)
      roles[unknown] = Role::free;
}

/** By displacement unknown: is it one of an edge at contact, or of the edge opposite? */
template <int dim>
std::vector<bool> CorrectionSearch<dim>::contact_dofs() const
{
  std::vector<bool> result(solution.displacement_space.n_dofs());
  for (const ContactFace<dim> &face : faces)
  {
    const FaceDofs<dim> dofs(face, solution.displacement_space, solution.tables);
    for (const auto *side : {&dofs.own, &dofs.opposite})
      for (const types::global_dof_index dof : *side)
        result[dof] = true;
  }
  return result;
}

/**
 * Which unknowns of a plate a face has depends on the frame, and so does along which of two slanted sides a corner has its
 * unknowns: what fixes one of them holds all.
 */
template <int dim>
void CorrectionSearch<dim>::join_roles(std::vector<Role> &roles) const
{
  std::vector<std::set<unsigned int>> groups = slanted_corners();
  groups.insert(groups.end(), freedom.plates().begin(), freedom.plates().end());
  for (const std::set<unsigned int> &group : groups)
  {
    const auto has = [&](const Role role)
    {
      return std::any_of(group.begin(), group.end(),
                         [&](const unsigned int unknown) { return roles[unknown] == role; });
    };
    const Role common = has(Role::fixed)  ? Role::fixed
                        : has(Role::free) ? Role::free
                                          : Role::outside;
    for (const unsigned int unknown : group)
      roles[unknown] = common;
  }
}

/** The unknowns of each vertex where two contact boundaries meet neither along one line nor at a right angle. */
template <int dim>
std::vector<std::set<unsigned int>> CorrectionSearch<dim>::slanted_corners() const
{
  std::vector<std::set<unsigned int>> result;
  std::map<types::global_dof_index, const ContactFace<dim> *> first; // by first component
  for (const ContactFace<dim> &face : faces)
  {
    const FaceDofs<dim> dofs(face, solution.displacement_space, solution.tables);
    const unsigned int n = face.degree + 1;
    for (const unsigned int node : {0U, n - 1})
    {
      const ContactFace<dim> *const other = first.emplace(dofs.own[node], &face).first->second;
      const Tensor<1, dim> tangent = face.frame(0.5).tangent;
      const double along = tangent * other->frame(0.5).tangent,
                   across = tangent * other->frame(0.5).normal;
      if (other->condition == face.condition || std::abs(along * across) < 1e-6)
        continue;
      std::set<unsigned int> unknowns;
      for (unsigned int c = 0; c < dim; ++c)
        for (const auto &[unknown, weight] : discretisation.unknowns.terms(dofs.own[c * n + node]))
          unknowns.insert(unknown);
      result.push_back(unknowns);
    }
  }
  return result;
}

/** At a corner of two sides both components share unknowns: what one of them fixes is fixed. */
template <int dim>
void CorrectionSearch<dim>::add_normal_roles(std::vector<Role> &roles) const
{
  for (const bool is_near : {false, true})
    for (unsigned int k = 0; k < faces.size(); ++k)
      if (openings[k] && is_near == is_near_pressure[k])
        for (const unsigned int unknown : openings[k]->penetration.unknowns)
          if (roles[unknown] != Role::fixed)
            roles[unknown] = is_near ? Role::free : Role::outside;
  for (unsigned int k = 0; k < faces.size(); ++k)
    if (openings[k] && openings[k]->mode == Opening::closed)
      for (const unsigned int unknown : openings[k]->penetration.unknowns)
        roles[unknown] = Role::fixed;
  for (const Joint &joint : joints)
    for (const unsigned int unknown : joint.trace.unknowns)
      roles[unknown] = Role::fixed;
}

/** Does a face press, or one of two on either side of it, or does it penetrate? */
template <int dim>
bool CorrectionSearch<dim>::find_near_pressure(const unsigned int face) const
{
  if (!openings[face])
    return false;
  if (openings[face]->mode != Opening::open)
    return true;
  for (const unsigned int other : faces_beside(face, 2, faces))
    if (openings[other]->mode != Opening::open)
      return true;
  return largest_value(EdgePolynomial(openings[face]->penetration.u), tolerance) > tolerance;
}

template std::vector<CorrectionSearch<2>::Role>
CorrectionSearch<2>::roles(const std::vector<bool> &) const;
template bool CorrectionSearch<2>::find_near_pressure(unsigned int) const;
} // namespace hpvi
