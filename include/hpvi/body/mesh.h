// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_mesh_h
#define hpvi_mesh_h

#include <deal.II/grid/tria.h>
#include <hpvi/scene/scene.h>

#include <vector>

namespace hpvi
{
/** The polynomial degree of each active cell, by active cell index. */
using Degrees = std::vector<unsigned int>;

/**
 * Build the coarse triangulation of @p scene: a regular grid of quadrilaterals whose boundary ids
 * are those of Scene::boundaries and material ids those of Scene::materials, bisected towards the
 * points that the scene names. Throws InputError where the scene has no such material.
 */
template <int dim>
void make_mesh(const Scene<dim> &scene, dealii::Triangulation<dim> &triangulation);

/** What to do with each cell, by active cell index. */
struct Refinement
{
  std::vector<bool> bisect;
  Degrees degrees; ///< after raising p; cells that are bisected do not use theirs

  bool is_empty(const Degrees &old_degrees) const; ///< does nothing change?
};

/**
 * Carry out @p refinement with deal.II's 2:1 closure; returns the degrees of the new cells.
 * A cell is either bisected or raised: where the closure bisects a cell that was to be raised, its
 * children keep the old degree. So the thesis's tables want it (doc/chapter5.md).
 */
template <int dim>
Degrees refine_mesh(dealii::Triangulation<dim> &triangulation, const Degrees &degrees,
                    const Refinement &refinement);
/** The outer unit normal of a cell's straight face. */
template <int dim, class CellIterator>
dealii::Tensor<1, dim> outer_normal(const CellIterator &cell, const unsigned int face)
{
  static_assert(dim == 2, "a straight edge");
  const dealii::Tensor<1, dim> along = cell->face(face)->vertex(1) - cell->face(face)->vertex(0);
  const dealii::Tensor<1, dim> normal = dealii::cross_product_2d(along / along.norm());
  return normal * (cell->face(face)->center() - cell->center()) < 0 ? -normal : normal;
}
} // namespace hpvi

#endif
