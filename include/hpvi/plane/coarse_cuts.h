// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_coarse_cuts_h
#define hpvi_coarse_cuts_h

#include <deal.II/base/bounding_box.h>
#include <deal.II/grid/tria.h>
#include <hpvi/algebra/cut_rule.h>
#include <hpvi/plane/cell_map.h>
#include <hpvi/scene/scene.h>

#include <optional>
#include <vector>

namespace hpvi
{
/**
 * How data are looked at on coarse edges and cells, where they are cut, and what an edge or cell of a refined mesh has of
 * these cuts.
 */
namespace coarse_cuts
{
using Cell = dealii::Triangulation<2>::cell_iterator;

bool varies(const Expression<2> &component); ///< is it given, and no constant?

/** The index of the coarse cell of @p cell. (deal.II's CellId holds 30 levels, and meshes may have more.) */
unsigned int coarse_index(Cell cell);

/** The part of its coarse cell that @p cell is, in reference coordinates. */
dealii::BoundingBox<2> part_of_coarse(Cell cell);

/** @p box in the coordinates in which @p part is [0,1]^2; nothing where round-off alone is common to both. */
std::optional<dealii::BoundingBox<2>> seen_from(const dealii::BoundingBox<2> &part,
                                                const dealii::BoundingBox<2> &box);

/** Those of @p cuts in the edge from @p lower with @p width, on [0,1], with both ends. */
std::vector<double> seen_from(double lower, double width, const std::vector<double> &cuts);

/** Of an edge or cell its share of those of a side of the body: refined ones are looked at no less closely than coarse ones. */
unsigned int n_parts(const Cell &cell, unsigned int of_side, unsigned int n_cells,
                     unsigned int least);

/** make_cut_rule() for a function along a face of @p cell; @p finer: with so many times as many samples. */
CutRule cut_edge(const dealii::Function<2> &f, const Cell &cell, unsigned int face,
                 const Scene<2> &scene, const dealii::QGauss<1> &gauss, unsigned int finer = 1);
} // namespace coarse_cuts
} // namespace hpvi

#endif
