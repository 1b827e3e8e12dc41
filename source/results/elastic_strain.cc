// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/results/elastic_strain.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hpvi
{
using namespace dealii;

namespace
{
/** The way towards the middle of a cell on which nothing but a jump changes much, as a part of it. */
template <int dim>
double short_way(const CellMap<dim> &map)
{
  // Edges have polynomials for their curves, along which the jump is.
  if (map.is_curved())
    return 1. / 256;
  double farthest = 0;
  for (const Point<dim> &vertex : map.vertices())
    farthest = std::max(farthest, vertex.norm());
  const double round_off = std::numeric_limits<double>::epsilon() * farthest / map.shortest_edge();
  return std::clamp(64 * round_off, 1e-9, 1. / 256);
}

/**
 * What the limit of eps_0 from the middle of a cell has more than eps_0 itself: by two points on the way, whose difference tells what is
 * smooth from a jump; 0 where there is none.
 */
template <int dim>
StrainComponents<dim> jump_inwards(const InitialStrain<dim> &initial, const CellMap<dim> &map,
                                   const Point<dim> &reference)
{
  Point<dim> middle;
  for (unsigned int d = 0; d < dim; ++d)
    middle[d] = 0.5;
  const Tensor<1, dim> way = short_way(map) * (middle - reference);
  const StrainComponents<dim> here = initial.value(map.point(reference)),
                              near = initial.value(map.point(reference + way)),
                              far = initial.value(map.point(reference + 2. * way));
  StrainComponents<dim> result{};
  for (unsigned int k = 0; k < result.size(); ++k)
    if (const double jump = 2 * near[k] - far[k] - here[k];
        std::abs(jump) > std::abs(near[k] - far[k]) + 1e-12 * std::abs(near[k]))
      result[k] = jump;
  return result;
}
} // namespace

template <int dim>
ElasticStrain<dim> elastic_strain(const Scene<dim> &scene, const types::material_id material,
                                  const CellMap<dim> &map, const Point<dim> &reference,
                                  const Tensor<1, dim> &u, const Tensor<2, dim> &gradient)
{
  if (scene.initial_strains.empty() && !scene.is_axisymmetric())
    return {gradient, 0., 0.};
  const Point<dim> x = map.point(reference);
  ElasticStrain<dim> result{gradient, scene.hoop_strain(material, u, gradient, x), 0.};
  if (!scene.initial_strains.empty())
  {
    const InitialStrain<dim> &initial = scene.initial_strains.at(material);
    const StrainComponents<dim> jump = jump_inwards<dim>(initial, map, reference);
    result.in_plane -= scene.initial_strain(material, x);
    result.in_plane -= Tensor<2, dim>(scene.materials[material].without_stress(jump));
    if constexpr (dim == 2)
    {
      result.across = initial.value(x)[3] + jump[3];
      if (scene.is_axisymmetric())
        result.hoop -= jump[3];
    }
  }
  if (scene.is_axisymmetric())
    result.across = -result.hoop;
  return result;
}

template ElasticStrain<2> elastic_strain(const Scene<2> &, types::material_id, const CellMap<2> &,
                                         const Point<2> &, const Tensor<1, 2> &,
                                         const Tensor<2, 2> &);
template ElasticStrain<3> elastic_strain(const Scene<3> &, types::material_id, const CellMap<3> &,
                                         const Point<3> &, const Tensor<1, 3> &,
                                         const Tensor<2, 3> &);
} // namespace hpvi
