// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_mesh_h
#define hpvi_mesh_h

#include <deal.II/grid/tria.h>
#include <hpvi/scene/scene.h>

#include <memory>
#include <utility>
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

/** The number of the body that has @p cell: 0 where there is one. */
template <int dim>
unsigned int body_of(const Geometry<dim> &geometry,
                     typename dealii::Triangulation<dim>::cell_iterator cell);

/** A pointer to a mesh that somebody else owns, for those that want to share one. */
template <int dim>
std::shared_ptr<const dealii::Triangulation<dim>>
borrowed(const dealii::Triangulation<dim> &triangulation)
{
  return {std::shared_ptr<const dealii::Triangulation<dim>>(), &triangulation};
}

struct Refinement;

/** A Refinement by what it changes: no larger than its marks are, and told without the mesh. */
struct MeshMarks
{
  unsigned int n_cells = 0; ///< of the mesh that is refined
  /** Cells in the order of their indices with their new degrees, 0 where they are bisected. */
  std::vector<std::pair<unsigned int, unsigned int>> changed;
  std::vector<MeshMarks> then; ///< those of Refinement

  MeshMarks() = default;
  MeshMarks(const Refinement &refinement, const Degrees &degrees);

  /** Is it one of a mesh with these degrees? */
  bool fits(const Degrees &degrees) const;

  /** The whole of it, on a mesh that it fits. */
  Refinement refinement(const Degrees &degrees) const;
};

/** What to do with each cell, by active cell index. */
struct Refinement
{
  std::vector<bool> bisect;
  Degrees degrees;                  ///< after raising p; cells that are bisected do not use theirs
  std::vector<MeshMarks> then = {}; ///< one after the other, of the meshes that come of it

  bool is_empty(const Degrees &old_degrees) const; ///< does nothing change?
};

/**
 * Carry out @p refinement with deal.II's 2:1 closure; returns the degrees of the new cells.
 * A cell is either bisected or raised: where the closure bisects a cell that was to be raised, its
 * children keep the old degree. So the thesis's tables want it (doc/chapter5.md). Then what follows.
 */
template <int dim>
Degrees refine_mesh(dealii::Triangulation<dim> &triangulation, const Degrees &degrees,
                    const Refinement &refinement);
} // namespace hpvi

#endif
