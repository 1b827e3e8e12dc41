// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_transfer_h
#define hpvi_transfer_h

#include <hpvi/space/primal_space.h>

#include <vector>

namespace hpvi
{
/** u_N and the multiplier on one cell: nodal values, then lambda face by face, first its friction, then its pressure. */
struct CellValues
{
  std::vector<double> u, lambda;
};

template <int dim>
CellValues values_on(const typename PrimalSpace<dim>::Cell &cell, const PrimalSpace<dim> &space,
                     const DistributedVector &u, const std::vector<ContactVector<dim>> &lambda);

/** Takes them for @p cell, or for its children: u at nodes, lambda at discs, which must be zero there. */
template <int dim>
void take_values(const typename dealii::Triangulation<dim>::cell_iterator &cell,
                 const CellValues &values, const PrimalSpace<dim> &space, DistributedVector &u,
                 std::vector<ContactVector<dim>> &lambda);

/**
 * Carries a displacement and its multiplier to the mesh that refinement makes, wherever cells go: made before the
 * mesh is refined, asked once afterwards. Children take the polynomials of their parent.
 */
template <int dim>
class Transfer
{
public:
  using Mesh = typename PrimalSpace<dim>::Mesh;

  /** The arguments must live until the mesh is refined. */
  Transfer(Mesh &mesh, const PrimalSpace<dim> &space, const DistributedVector &u,
           const std::vector<ContactVector<dim>> &lambda);

  /** Of the new @p space: u with neighbours, lambda by discs. Collective. */
  void unpack(const PrimalSpace<dim> &space, DistributedVector &u,
              std::vector<ContactVector<dim>> &lambda);

private:
  using Cell = typename dealii::Triangulation<dim>::cell_iterator;

  Mesh &mesh;
  unsigned int handle;
};
} // namespace hpvi

#endif
