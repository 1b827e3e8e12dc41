// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_transfer_h
#define hpvi_transfer_h

#include <hpvi/moments/moment_space.h>

#include <vector>

namespace hpvi
{
/**
 * Carries a displacement and its multiplier to the mesh that refinement makes, wherever cells go: made before the
 * mesh is refined, asked once afterwards. Children take the polynomials of their parent.
 */
template <int dim>
class Transfer
{
public:
  using Mesh = typename MomentSpace<dim>::Mesh;

  /** The arguments must live until the mesh is refined. */
  Transfer(Mesh &mesh, const MomentSpace<dim> &space, const DistributedVector &u,
           const std::vector<ContactVector<dim>> &lambda);

  /** Of the new @p space: u with neighbours, lambda by discs. Collective. */
  void unpack(const MomentSpace<dim> &space, DistributedVector &u,
              std::vector<ContactVector<dim>> &lambda);

private:
  using Cell = typename dealii::Triangulation<dim>::cell_iterator;

  static void take_multiplier(const MomentSpace<dim> &space, const Cell &cell, const Cell &parent,
                              const std::vector<bool> &parent_components,
                              const std::vector<double> &values,
                              std::vector<ContactVector<dim>> &lambda);

  Mesh &mesh;
  unsigned int handle;
};
} // namespace hpvi

#endif
