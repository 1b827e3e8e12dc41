// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_primal_system_h
#define hpvi_primal_system_h

#include <hpvi/moments/moment_space.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <map>
#include <tuple>

namespace hpvi
{
/** A and f of `1/2 v'A v - f'v` in the basis of moments; rows of constrained unknowns are diagonal. */
template <int dim>
class PrimalSystem
{
public:
  /** Collective. Throws InputError where a load is not finite. */
  explicit PrimalSystem(const MomentSpace<dim> &space);

  double energy_product(const DistributedVector &u) const; ///< a(u, u), collective
  double work(const DistributedVector &u) const;           ///< L(u), collective

  /** Nodal forces in the basis of nodal values, before constraints. */
  struct NodalForces
  {
    DistributedVector internal, loads; ///< a(u, v_i) and L(v_i)
  };

  /** Of all nodes of this process and beside it. Collective. */
  NodalForces nodal_forces(const DistributedVector &u) const;

  dealii::TrilinosWrappers::SparseMatrix A;
  DistributedVector f;

private:
  using Cell = typename MomentSpace<dim>::Cell;
  using Matrix = dealii::FullMatrix<double>;

  /** Cells of one size, material and set of components with moments share K and T'KT. */
  const Matrix &stiffness(const Cell &cell, const std::vector<bool> &moment_components) const;
  /** The same for cells of one size: their level, unless grid lines cut some of the coarse mesh shorter. */
  unsigned int size_class(const Cell &cell) const;
  CellField<dim> body_load(const Cell &cell) const;
  CellField<dim> side_load(const Cell &cell, unsigned int face) const;
  CellField<dim> load(const Cell &cell) const;
  void assemble();
  void add_nodal_forces(const DistributedVector &u, NodalForces &forces) const;

  const MomentSpace<dim> &space;
  mutable std::vector<dealii::Tensor<1, dim>> sizes; ///< by size_class(), of cells that differ
  mutable std::map<std::tuple<unsigned int, unsigned int, std::vector<bool>>, Matrix> matrices;
};
} // namespace hpvi

#endif
