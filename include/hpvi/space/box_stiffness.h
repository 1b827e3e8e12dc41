// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_box_stiffness_h
#define hpvi_box_stiffness_h

#include <hpvi/space/elastic_foundation.h>
#include <hpvi/space/primal_space.h>

#include <map>
#include <memory>
#include <tuple>

namespace hpvi
{
/**
 * Stiffness matrices of cells and of the springs below them, K or T'KT in the basis of contact dofs. Boxes of one size, material and set of components with contact dofs
 * share one where no springs hold them; of a mesh from a file parallelepipeds without contact dofs do, others are made when they are asked for.
 */
template <int dim>
class BoxStiffness
{
public:
  using Cell = typename PrimalSpace<dim>::Cell;
  using Matrix = dealii::FullMatrix<double>;

  explicit BoxStiffness(const PrimalSpace<dim> &space);

  /** Of nodal values; until the next call. */
  const Matrix &nodal(const Cell &cell) const;

  /** In the basis of contact dofs of a cell of this process; until the next call. */
  const Matrix &operator()(const Cell &cell) const;

  /** The diagonal of K of nodal values, of which no cell takes a matrix that has none already. */
  std::vector<double> diagonal(const Cell &cell) const;

  /** K u of nodal values. */
  void multiply(const Cell &cell, dealii::Vector<double> &result,
                const dealii::Vector<double> &u) const;

private:
  void multiply_body(const Cell &cell, dealii::Vector<double> &result,
                     const dealii::Vector<double> &u) const;
  const Matrix &of_body(const Cell &cell) const;
  const Matrix &of_box(const Cell &cell, const std::vector<bool> &moment_components) const;
  unsigned int size_class(const Cell &cell) const;
  const Matrix *known(const Cell &cell, const CellMap<dim> &map) const;
  HookesLaw<dim> law(const Cell &cell) const;

  const PrimalSpace<dim> &space;
  const ElasticFoundation<dim> foundation;
  const std::vector<bool> none;
  mutable std::vector<dealii::Tensor<1, dim>> sizes; ///< by size_class(), of cells that differ
  mutable std::map<std::tuple<unsigned int, unsigned int, std::vector<bool>>, Matrix> matrices;
  struct Parallelepiped
  {
    dealii::Tensor<2, dim> edges;
    dealii::types::material_id material;
    unsigned int degree;
    Matrix K;
  };
  mutable std::vector<std::unique_ptr<Parallelepiped>> parallelepipeds;
  mutable Matrix last; ///< what is not kept
};

/** T of `u = T v` on @p cell of this process. */
template <int dim>
dealii::FullMatrix<double> basis_of_moments(const PrimalSpace<dim> &space,
                                            const typename PrimalSpace<dim>::Cell &cell);

/** Has any component contact dofs? */
bool any(const std::vector<bool> &moment_components);
} // namespace hpvi

#endif
