// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_elastic_strain_h
#define hpvi_elastic_strain_h

#include <hpvi/plane/cell_map.h>
#include <hpvi/scene/scene.h>

namespace hpvi
{
/** What stresses belong to: the strain of a displacement without the initial strain. */
template <int dim>
struct ElasticStrain
{
  dealii::Tensor<2, dim> in_plane; ///< in space all of it: a gradient, for HookesLaw
  double hoop = 0;                 ///< around the axis of an axisymmetric body, else 0
  double across = 0;               ///< for Material::transverse_stress()
};

/**
 * In a cell of @p material at a point of the reference cell, where its displacement is @p u and has @p gradient. At an edge along
 * which the initial strain jumps it is that of the inside of the cell: a temperature may be another beyond a joint, and what an
 * expression says of the joint itself belongs to one side.
 */
template <int dim>
ElasticStrain<dim> elastic_strain(const Scene<dim> &scene, dealii::types::material_id material,
                                  const CellMap<dim> &map, const dealii::Point<dim> &reference,
                                  const dealii::Tensor<1, dim> &u,
                                  const dealii::Tensor<2, dim> &gradient);
} // namespace hpvi

#endif
