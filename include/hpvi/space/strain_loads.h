// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_strain_loads_h
#define hpvi_strain_loads_h

#include <hpvi/plane/shape_tables.h>
#include <hpvi/space/primal_space.h>

namespace hpvi
{
/** What the initial strains eps_0 of a scene do to a body: they act as loads, and their stresses C eps_0 hold energy. */
template <int dim>
class StrainLoads
{
public:
  using Cell = typename PrimalSpace<dim>::Cell;

  /** By Gauss rules with @p finer times the p + 1 points a direction of the path, which cut no cell. Both live as long as this. */
  StrainLoads(const Scene<dim> &scene, const PrimalSpace<dim> &space, unsigned int finer);

  /** `int C eps_0 : eps(v_i)` over @p cell [stress length^(dim-1)]; zero where its material has none. */
  CellField<dim> load(const Cell &cell) const;

  /** `int C eps_0` over all cells [stress length^dim]. Collective. */
  dealii::Tensor<2, dim> stress() const;

  /**
   * `1/2 int C eps_0 : eps_0 - int C eps_0 : eps(u)`, by what the elastic energy of `eps(u) - eps_0` differs from a(u, u)/2
   * [stress length^dim]. Collective.
   */
  double energy(const DistributedVector &u) const;

private:
  bool is_strained(const Cell &cell) const;
  const ShapeTable<dim> &table_on(const Cell &cell) const;
  template <class Take>
  void for_each_point(const Cell &cell, const Take &take) const;

  const Scene<dim> &scene;
  const PrimalSpace<dim> &space;
  std::vector<ShapeTable<dim>> tables; ///< by degree
};
} // namespace hpvi

#endif
