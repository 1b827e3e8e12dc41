// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_element_matrices_h
#define hpvi_element_matrices_h

#include <deal.II/lac/full_matrix.h>
#include <hpvi/plane/cell_map.h>
#include <hpvi/plane/shape_tables.h>
#include <hpvi/scene/scene.h>

#include <array>
#include <memory>
#include <vector>

namespace hpvi
{
class TensorStiffness;

/**
 * Gauss points per direction that integrate products of gradients over a cell. p + 1 are exact on
 * affine cells. On others 1/det J stands under the integral, and n points beyond p leave a relative
 * error of rho^{-2n}: rho, the sum of the half axes of the ellipse up to its pole, is
 * `(sqrt(r) + 1)/(sqrt(r) - 1)` for a quotient r of the values of det J at the ends of an edge. As
 * many are taken as bring that below 1e-14, so that Galerkin's orthogonality holds to round-off.
 */
template <int dim>
unsigned int stiffness_points(const CellMap<dim> &map, unsigned int degree);

/**
 * The same in the body of @p scene. An axisymmetric one has 1/x under the integral, with its pole on the axis; of boxes that
 * touch the axis u_x/x is a polynomial.
 */
template <int dim>
unsigned int stiffness_points(const Scene<dim> &scene, const CellMap<dim> &map,
                              unsigned int degree);

/**
 * How a(.,.) counts changes of volume in nearly incompressible materials: div v itself, or its projection onto P_{p-1} of
 * each cell, in reference coordinates. Then u is that of the stable mixed pair Q_p, P_{p-1}, the pressure
 * eliminated (Bernardi and Maday, M3AS 9, 1999); for parallelograms only.
 */
enum class Volume
{
  full,
  projected
};

/**
 * What the projection takes away from Q_p: products of Legendre polynomials of degree p and more, orthonormal on the
 * unit cell, at the points of a table; modes x points.
 */
template <int dim>
dealii::FullMatrix<double> oscillating_modes(const ShapeTable<dim> &table, unsigned int degree);

/** Stiffness matrices of elements, each a function of the cell's map, degree and material. */
template <int dim>
class ElementMatrices
{
public:
  /** @p scene and @p tables must outlive this object. */
  ElementMatrices(const Scene<dim> &scene, const ShapeTables<dim> &tables,
                  Volume volume = Volume::full);

  const Volume volume;

  /** `K_ij = a(phi_j, phi_i)` over the cell, in deal.II's local numbering of FESystem(FE_Q(p), dim). */
  dealii::FullMatrix<double> stiffness(const CellMap<dim> &map, unsigned int degree,
                                       dealii::types::material_id material) const;

  /**
   * Has triangle() the matrix? Of cells with an affine map it is a sum of few matrices of the reference cell, and one of them
   * serves many cells; of other cells no two are congruent.
   */
  bool is_factorised(const CellMap<dim> &map) const;

  /** @p K := the lower triangle of stiffness() by columns, unknowns inside the cell first; what is above it is undefined. */
  void triangle(const CellMap<dim> &map, unsigned int degree, dealii::types::material_id material,
                std::vector<double> &K) const;

  /** How many of the first rows of stiffness() belong to the boundary of the cell. */
  unsigned int n_boundary(unsigned int degree) const;

  /**
   * Elements of one class have the same matrix: in two dimensions a(.,.) does not change when a
   * cell is moved or scaled, so an adaptive mesh has a handful of classes
   * for each material. In an axisymmetric body it does not change along the axis alone: the class holds the radius
   * and the size, where it has nothing else to say of vertex 0.
   */
  using Class = std::array<long, 3 + dim * dealii::GeometryInfo<dim>::vertices_per_cell>;
  Class congruence_class(const CellMap<dim> &map, unsigned int degree,
                         dealii::types::material_id material) const;

private:
  dealii::FullMatrix<double> from_triangle(const CellMap<dim> &map, unsigned int degree,
                                           dealii::types::material_id material) const;

  const Scene<dim> &scene;
  const ShapeTables<dim> &tables;
  const std::shared_ptr<TensorStiffness> factorised;
};
} // namespace hpvi

#endif
