// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_shared_points_h
#define hpvi_shared_points_h

#include <hpvi/plane/cell_map.h>
#include <hpvi/plane/shape_tables.h>

#include <vector>

namespace hpvi
{
/** Outer normals, and weights times ds, at the points of a table on a face. */
template <int dim>
struct FacePoints
{
  std::vector<dealii::Tensor<1, dim>> normals;
  std::vector<double> weights;
};

/** Of an axisymmetric body weights are those of the full turn. */
template <int dim>
FacePoints<dim> face_points(const CellMap<dim> &map, unsigned int face,
                            const ShapeTable<dim> &table, bool is_axisymmetric);

/**
 * The number of each point of @p table among those of @p other, which lie at the same places: in space two cells may look at a
 * face from corners of their own.
 */
template <int dim>
std::vector<unsigned int> shared_points(const CellMap<dim> &map, const ShapeTable<dim> &table,
                                        const CellMap<dim> &other_map,
                                        const ShapeTable<dim> &other);

/** Of a face of a coarser cell the part, as it counts them, that is @p face; deal.II's @p known where corners are the same. */
template <int dim>
unsigned int shared_subface(const CellMap<dim> &map, unsigned int face,
                            const CellMap<dim> &other_map, unsigned int other_face,
                            unsigned int known);
} // namespace hpvi

#endif
