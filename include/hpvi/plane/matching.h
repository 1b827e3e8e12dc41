// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_matching_h
#define hpvi_matching_h

#include <hpvi/plane/contact_space.h>
#include <hpvi/plane/mesh.h>

#include <string>
#include <vector>

namespace hpvi
{
/** The whole face of the body opposite that lies opposite to a whole face; null: there is none, or parts of some. */
template <int dim>
const ContactSegment<dim> *whole_face_opposite(const ContactFace<dim> &face);

/** Displacement unknowns at the nodes of a contact face, component by component, in the order of its reference coordinate. */
template <int dim>
struct FaceDofs
{
  /** Opposite to a body the nodes of one that matches. */
  FaceDofs(const ContactFace<dim> &face, const DisplacementSpace<dim> &space,
           const ShapeTables<dim> &tables);

  std::vector<dealii::types::global_dof_index> own,
      opposite; ///< opposite to a rigid foundation: none

  /** v, or the jump of v where bodies touch, of one of them. */
  double jump(const dealii::Vector<double> &v, const unsigned int i) const
  {
    return opposite.empty() ? v[own[i]] : v[own[i]] - v[opposite[i]];
  }

  /** Adds a force on the jump to forces on displacements. */
  void add_force(const unsigned int i, const double force, dealii::Vector<double> &forces) const
  {
    forces[own[i]] += force;
    if (!opposite.empty())
      forces[opposite[i]] -= force;
  }
};

/** Why no ErrorBound of @p scene is guaranteed, whatever its mesh, in words; empty where one is. */
template <int dim>
std::string no_error_bound(const Scene<dim> &scene);

/** Do faces of two bodies match everywhere, vertex to vertex and with equal degrees? */
template <int dim>
bool all_match(const ContactSpace<dim> &contact_space);

/**
 * Do meshes not match, is contact along a curve or another direction than the normal, or does friction know a pressure that may pull? Then
 * JointTractions give what contact exerts.
 */
template <int dim>
bool has_given_tractions(const ContactSpace<dim> &contact_space);

/**
 * Where a bound is asked for, bisects cells of a mesh along joints until bodies match there, where each edge of one is a half, a
 * quarter, ... of an edge of the other, or the reverse. Where some edges never will nothing is done.
 */
template <int dim>
void match_nested(const Scene<dim> &scene, const ShapeTables<dim> &tables,
                  dealii::Triangulation<dim> &triangulation, Degrees &degrees);

/**
 * Adds to @p refinement what it takes for joints that match to match again: of two cells opposite to each other both are
 * bisected, by deal.II's 2:1 closure too, or neither, and both have the higher degree.
 */
template <int dim>
void keep_matching(const ContactSpace<dim> &contact_space,
                   const dealii::Triangulation<dim> &triangulation, Refinement &refinement);
} // namespace hpvi

#endif
