// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/moments/box_stiffness.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

bool any(const std::vector<bool> &moment_components)
{
  return std::find(moment_components.begin(), moment_components.end(), true) !=
         moment_components.end();
}

template <int dim>
BoxStiffness<dim>::BoxStiffness(const MomentSpace<dim> &space)
    : space(space), none(dim * GeometryInfo<dim>::faces_per_cell, false)
{
}

template <int dim>
const FullMatrix<double> &BoxStiffness<dim>::nodal(const Cell &cell) const
{
  return operator()(cell, none);
}

template <int dim>
const FullMatrix<double> &
BoxStiffness<dim>::operator()(const Cell &cell, const std::vector<bool> &moment_components) const
{
  const auto [entry, is_new] =
      matrices.try_emplace({size_class(cell), cell->material_id(), moment_components});
  if (!is_new)
    return entry->second;
  const Matrix K = space.tables.stiffness(HookesLaw<dim>(space.scene.material_of(cell)),
                                          MomentSpace<dim>::extent(cell));
  if (!any(moment_components))
    return entry->second = K;
  const Matrix T = space.tables.basis_of_moments(moment_components);
  Matrix KT(K.m(), K.m());
  K.mmult(KT, T);
  entry->second.reinit(K.m(), K.m());
  T.Tmmult(entry->second, KT);
  return entry->second;
}

template <int dim>
unsigned int BoxStiffness<dim>::size_class(const Cell &cell) const
{
  const auto &cuts = space.scene.geometry.cuts;
  if (std::all_of(cuts.begin(), cuts.end(), [](const auto &lines) { return lines.empty(); }))
    return cell->level();
  const Tensor<1, dim> size = MomentSpace<dim>::extent(cell);
  const auto known = std::find_if(sizes.begin(), sizes.end(),
                                  [&](const Tensor<1, dim> &other)
                                  {
                                    for (unsigned int d = 0; d < dim; ++d)
                                      if (std::abs(other[d] - size[d]) > 1e-12 * size[d])
                                        return false;
                                    return true;
                                  });
  if (known == sizes.end())
  {
    sizes.push_back(size);
    return sizes.size() - 1;
  }
  return known - sizes.begin();
}

template class BoxStiffness<2>;
template class BoxStiffness<3>;
} // namespace hpvi
