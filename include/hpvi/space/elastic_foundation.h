// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_elastic_foundation_h
#define hpvi_elastic_foundation_h

#include <hpvi/plane/shape_tables.h>
#include <hpvi/space/degree_tables.h>

#include <deal.II/grid/tria.h>

#include <vector>

namespace hpvi
{
/** Springs on one face of a cell, `int k_n v_n w_n + k_t v_t w_t` of its shape functions. */
template <int dim>
struct SpringsOfFace
{
  dealii::types::boundary_id boundary;
  std::vector<unsigned int> shapes; ///< that do not vanish on the face
  /** `int (k_n n n' + k_t (I - n n')) phi_i phi_j`, row by row. */
  std::vector<dealii::Tensor<2, dim>> K;
  dealii::Tensor<1, 2> sums; ///< `int k_n` and `int k_t` over the face [stress length^(dim-2)]

  /** What the body does to the foundation where it moves by @p u, node by node of #shapes: `K u` [stress length^(dim-1)]. */
  std::vector<dealii::Tensor<1, dim>> forces(const CellField<dim> &u) const;
};

/** The springs below the faces of a mesh: what they add to the stiffness of cells. */
template <int dim>
class ElasticFoundation
{
public:
  using Cell = typename dealii::Triangulation<dim>::cell_iterator;

  /** Both live as long as this. */
  ElasticFoundation(const Scene<dim> &scene, const DegreeTables<dim> &tables);

  bool holds(const Cell &cell) const; ///< has it a face on springs?

  std::vector<SpringsOfFace<dim>> below(const Cell &cell) const;

  /** To the stiffness of @p cell, of nodal values. */
  void add_to(dealii::FullMatrix<double> &K, const Cell &cell) const;
  void add_to_diagonal(std::vector<double> &diagonal, const Cell &cell) const;

private:
  const Spring<dim> &spring(const Cell &cell, unsigned int face) const;

  const Scene<dim> &scene;
  const DegreeTables<dim> &tables;
  const bool has_springs;
  /** By degree and face, where any has springs. */
  std::vector<std::vector<ShapeTable<dim>>> constant, varying;
};
} // namespace hpvi

#endif
