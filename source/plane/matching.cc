// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/base/tolerances.h>
#include <hpvi/plane/matching.h>
#include <hpvi/scene/boundary_parts.h>
#include <hpvi/scene/space_motion.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace hpvi
{
using namespace dealii;

template <int dim>
const ContactSegment<dim> *whole_face_opposite(const ContactFace<dim> &face)
{
  if (face.segments.size() != 1)
    return nullptr;
  const ContactSegment<dim> &only = face.segments[0];
  const bool is_whole = only.begin <= same_on_edge && only.end >= 1. - same_on_edge &&
                        std::abs(only.at_end - only.at_begin) >= 1. - same_on_edge;
  return is_whole ? &only : nullptr;
}

template <int dim>
FaceDofs<dim>::FaceDofs(const ContactFace<dim> &face, const DisplacementSpace<dim> &space,
                        const ShapeTables<dim> &tables)
{
  const unsigned int n = face.degree + 1;
  const auto dofs = space.cell_dofs(face.cell->active_cell_index());
  for (const unsigned int i : tables.numbering(face.degree).edge[face.face_no])
    own.push_back(dofs[i]);
  const ContactSegment<dim> *const other = whole_face_opposite(face);
  if (!other || other->degree != face.degree)
    return;
  const auto others = space.cell_dofs(other->cell->active_cell_index());
  const std::vector<unsigned int> &edge = tables.numbering(face.degree).edge[other->face_no];
  const bool is_reversed = other->at_end < other->at_begin;
  for (unsigned int c = 0; c < dim; ++c)
    for (unsigned int j = 0; j < n; ++j)
      opposite.push_back(others[edge[c * n + (is_reversed ? n - 1 - j : j)]]);
}

template <int dim>
bool all_match(const ContactSpace<dim> &contact_space)
{
  for (const ContactFace<dim> &face : contact_space.faces())
    if (!face.segments.empty())
    {
      const ContactSegment<dim> *const opposite = whole_face_opposite(face);
      if (!opposite || opposite->degree != face.degree)
        return false;
    }
  return true;
}

template <int dim>
bool has_given_tractions(const ContactSpace<dim> &contact_space)
{
  if (!all_match(contact_space))
    return true;
  for (const ContactFace<dim> &face : contact_space.faces())
  {
    if (face.is_axisymmetric || face.map.is_curved() ||
        (!face.segments.empty() && face.segments[0].drawn) ||
        (!face.condition->is_unilateral() && face.condition->friction.knows_pressure()))
      return true;
    for (const double s : {0., 0.5, 1.})
      if (const Tensor<1, dim> normal =
              contact_frame(face.map, face.face_no, Point<dim - 1>(s)).normal;
          (face.frame(s).normal - normal).norm() > 1e-12)
        return true;
  }
  return false;
}

namespace
{
/** Is [begin, end] a part of [0, 1] that bisections make of it? */
bool is_dyadic(const double begin, const double end)
{
  const double n = std::round(1. / (end - begin)), level = std::log2(n);
  return std::abs(n * (end - begin) - 1.) < 1e-6 && level == std::round(level) &&
         std::abs(n * begin - std::round(n * begin)) < 1e-6;
}
/** The coarser cells of joints that bisections can make match; no cell where all match, or some never will. */
template <int dim>
std::vector<bool> nested_cells(const ContactSpace<dim> &contact_space, const unsigned int n_cells)
{
  std::vector<bool> result(n_cells);
  for (const ContactFace<dim> &face : contact_space.faces())
    for (const ContactSegment<dim> &segment : face.segments)
    {
      if (segment.drawn) // given tractions are as near there
        return std::vector<bool>(n_cells);
      const auto [begin, end] = std::minmax(segment.at_begin, segment.at_end);
      const bool fills_own = segment.end - segment.begin >= 1. - same_on_edge,
                 fills_opposite = end - begin >= 1. - same_on_edge;
      if (!(fills_own || fills_opposite) || !is_dyadic(segment.begin, segment.end) ||
          !is_dyadic(begin, end))
        return std::vector<bool>(n_cells);
      if (!fills_own)
        result[face.cell->active_cell_index()] = true;
      if (!fills_opposite)
        result[segment.cell->active_cell_index()] = true;
    }
  return result;
}
} // namespace

namespace
{
/** The first boundary along a curve whose normal displacement is held by a rigid foundation; null: there is none. */
template <int dim>
const BoundaryCondition<dim> *curved_contact(const Scene<dim> &scene)
{
  if (!scene.geometry.has_curves())
    return nullptr;
  const std::vector<Side<dim>> sides = sides_of(scene);
  for (const BoundaryCondition<dim> &boundary : scene.boundaries)
    if (boundary.holds_normal() && !boundary.contact_direction)
      for (const auto &curve : sides[boundary.id].curves)
        if (curve)
          return &boundary;
  return nullptr;
}

/** What the bound on boxes does not know. */
std::string beyond_boxes(const Scene<3> &scene)
{
  if (scene.geometry.has_mesh())
    return "cells of a mesh file are no boxes";
  if (scene.has_pairs())
    return "bodies in space touch each other";
  if (rests_on_contact(scene))
    return "contact alone holds the body";
  if (scene.has_springs())
    return "springs hold the body";
  if (scene.has_plates())
    return "a side is glued to a rigid plate";
  if (scene.has_initial_strain())
    return "a material has an initial strain";
  for (const BoundaryCondition<3> &boundary : scene.boundaries)
    if (boundary.contact_direction)
      return "contact is along a direction";
    else if (boundary.contact == Contact::bilateral && boundary.gap)
      return "bilateral contact has a gap";
    else if (boundary.contact != Contact::unilateral && boundary.friction.knows_pressure())
      return "friction knows the pressure of contact that does not open";
  return {};
}
} // namespace

template <int dim>
std::string no_error_bound(const Scene<dim> &scene)
{
  if (scene.adaptivity.start_degree < 2)
    return "cells have degree 1";
  if (const BoundaryCondition<dim> *const curved = curved_contact(scene))
    return "the normal of " + printable(curved->name) +
           " turns along a curved edge on which it is held, and what holds it there is not known "
           "at every point";
  if constexpr (dim == 3)
    return beyond_boxes(scene);
  return {};
}

template <int dim>
void match_nested(const Scene<dim> &scene, const ShapeTables<dim> &tables,
                  Triangulation<dim> &triangulation, Degrees &degrees)
{
  const auto next = [&]
  {
    const DisplacementSpace<dim> space(scene, triangulation, degrees, tables);
    return Refinement{
        nested_cells(ContactSpace<dim>(scene, space, tables), triangulation.n_active_cells()),
        degrees};
  };
  bool matches = !scene.has_pairs() || !scene.error_bound || scene.has_coulomb_friction() ||
                 !no_error_bound(scene).empty();
  while (!matches)
  {
    const Refinement refinement = next();
    matches = refinement.is_empty(degrees);
    degrees = refine_mesh(triangulation, degrees, refinement);
  }
}

template <int dim>
void keep_matching(const ContactSpace<dim> &contact_space, const Triangulation<dim> &triangulation,
                   Refinement &refinement)
{
  std::vector<std::pair<unsigned int, unsigned int>> joints; // cells
  for (const ContactFace<dim> &face : contact_space.faces())
    if (const ContactSegment<dim> *const opposite = whole_face_opposite(face);
        opposite && !opposite->drawn)
      joints.emplace_back(face.cell->active_cell_index(), opposite->cell->active_cell_index());
  if (joints.empty())
    return;
  Triangulation<dim> trial;
  trial.copy_triangulation(triangulation);
  for (bool is_changed = true; is_changed;)
  {
    is_changed = false;
    for (const auto &cell : trial.active_cell_iterators())
      if (refinement.bisect[cell->active_cell_index()])
        cell->set_refine_flag();
    trial.prepare_coarsening_and_refinement();
    for (const auto &cell : trial.active_cell_iterators())
      if (cell->refine_flag_set())
        refinement.bisect[cell->active_cell_index()] = true;
    for (const auto &[one, other] : joints)
      if (refinement.bisect[one] != refinement.bisect[other])
      {
        refinement.bisect[one] = refinement.bisect[other] = true;
        is_changed = true;
      }
  }
  // A cell may touch several: degrees go on from one to the next.
  for (bool is_changed = true; is_changed;)
  {
    is_changed = false;
    for (const auto &[one, other] : joints)
      if (refinement.degrees[one] != refinement.degrees[other] && !refinement.bisect[one])
      {
        refinement.degrees[one] = refinement.degrees[other] =
            std::max(refinement.degrees[one], refinement.degrees[other]);
        is_changed = true;
      }
  }
}

template struct FaceDofs<2>;
template const ContactSegment<2> *whole_face_opposite(const ContactFace<2> &);
template bool all_match(const ContactSpace<2> &);
template bool has_given_tractions(const ContactSpace<2> &);
template std::string no_error_bound(const Scene<2> &);
template std::string no_error_bound(const Scene<3> &);
template void match_nested(const Scene<2> &, const ShapeTables<2> &, Triangulation<2> &, Degrees &);
template void keep_matching(const ContactSpace<2> &, const Triangulation<2> &, Refinement &);
} // namespace hpvi
