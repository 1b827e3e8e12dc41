// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_primal_system_h
#define hpvi_primal_system_h

#include <hpvi/space/box_stiffness.h>
#include <hpvi/space/strain_loads.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <memory>
#include <vector>

namespace hpvi
{
/** A and f of `1/2 v'A v - f'v` in the basis of contact dofs; rows of constrained unknowns are diagonal. */
template <int dim>
class PrimalSystem
{
public:
  /** Collective. Throws InputError where a load is not finite. */
  explicit PrimalSystem(const PrimalSpace<dim> &space);

  double energy_product(const DistributedVector &u) const; ///< a(u, u), collective
  double work(const DistributedVector &u) const;           ///< L(u), collective

  /** Nodal forces in the basis of nodal values, before constraints. */
  struct NodalForces
  {
    DistributedVector internal, loads; ///< a(u, v_i) and L(v_i)
  };

  /** Of all nodes of this process and beside it. Collective. */
  NodalForces nodal_forces(const DistributedVector &u) const;

  /** Of L(v_i) what initial strains do, which balance themselves. Collective. */
  DistributedVector strain_loads() const;

  dealii::Tensor<2, dim> initial_stress() const; ///< StrainLoads::stress(), 0 without
  dealii::Tensor<1, 2>
  spring_stiffness() const; ///< of all faces, ElasticFoundation::stiffness(). Collective
  double initial_energy(const DistributedVector &u) const; ///< StrainLoads::energy(), likewise

  /** A, assembled when it is asked for first: matrix-free methods never do. Collective. */
  dealii::TrilinosWrappers::SparseMatrix &matrix();

  DistributedVector f;

private:
  using Cell = typename PrimalSpace<dim>::Cell;

  CellField<dim> body_load(const Cell &cell) const;
  CellField<dim> side_load(const Cell &cell, unsigned int face) const;
  CellField<dim> load(const Cell &cell) const;
  void assemble_loads(std::vector<double> &far);
  void add_plate_loads();
  void assemble_with_opposite(const Cell &cell, std::vector<double> &far);
  bool is_slave_cell(const Cell &cell) const;
  dealii::DynamicSparsityPattern sparsity(dealii::IndexSet &rows) const;
  void add_with_opposite(const Cell &cell);
  void add_nodal_forces(const DistributedVector &u, NodalForces &forces) const;

  const PrimalSpace<dim> &space;
  const BoxStiffness<dim> stiffness;
  std::unique_ptr<const StrainLoads<dim>> strains; ///< null: there are none
  std::unique_ptr<const DistributedVector> lifted; ///< u where v = 0, while loads are assembled
  dealii::TrilinosWrappers::SparseMatrix A;        ///< empty until matrix()
};
} // namespace hpvi

#endif
