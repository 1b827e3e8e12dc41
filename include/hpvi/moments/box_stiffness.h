// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_box_stiffness_h
#define hpvi_box_stiffness_h

#include <hpvi/moments/moment_space.h>

#include <map>
#include <tuple>

namespace hpvi
{
/** Stiffness matrices of cells, K or T'KT in the basis of moments: those of one size, material and set of components with moments share one. */
template <int dim>
class BoxStiffness
{
public:
  using Cell = typename MomentSpace<dim>::Cell;
  using Matrix = dealii::FullMatrix<double>;

  explicit BoxStiffness(const MomentSpace<dim> &space);

  /** Of nodal values. */
  const Matrix &nodal(const Cell &cell) const;

  /** In the basis of moments that MomentSpace::moment_components says. */
  const Matrix &operator()(const Cell &cell, const std::vector<bool> &moment_components) const;

private:
  unsigned int size_class(const Cell &cell) const;

  const MomentSpace<dim> &space;
  const std::vector<bool> none;
  mutable std::vector<dealii::Tensor<1, dim>> sizes; ///< by size_class(), of cells that differ
  mutable std::map<std::tuple<unsigned int, unsigned int, std::vector<bool>>, Matrix> matrices;
};

/** Has any component moments? */
bool any(const std::vector<bool> &moment_components);
} // namespace hpvi

#endif
