// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_box_tables_h
#define hpvi_box_tables_h

#include <hpvi/plane/cell_map.h>
#include <hpvi/scene/contact_axes.h>
#include <hpvi/scene/material.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/lac/full_matrix.h>

#include <array>
#include <functional>
#include <vector>

namespace hpvi
{
/** Scalar shape functions of one degree at Gauss points of the unit cell. */
template <int dim>
struct BoxTable
{
  std::vector<dealii::Point<dim>> points;
  std::vector<double> weights;       ///< they sum to 1
  dealii::FullMatrix<double> values; ///< by point and shape function
  std::array<dealii::FullMatrix<double>, dim> gradients;
};

/** The coefficients of a field on a cell, by shape function and component. */
template <int dim>
using CellField = std::vector<dealii::Tensor<1, dim>>;

/** Of loads on a cell and a field there: the work. */
template <int dim>
double product(const CellField<dim> &a, const CellField<dim> &b)
{
  double sum = 0;
  for (unsigned int i = 0; i < a.size(); ++i)
    sum += a[i] * b[i];
  return sum;
}

/**
 * The change from the inner nodes of a contact face to its contact dofs, `m = M u_inner + W u_rim`: of each component by itself; of a
 * curved face, whose directions turn, of all components at once, rows by direction and Gauss point, columns by axis and node.
 */
struct FaceContactDofs
{
  dealii::FullMatrix<double> M, M_inverse, W;
  std::vector<double> areas; ///< `int psi_k`
};

/**
 * All that depends on the degree alone: of cells that are boxes: shape functions at Gauss points, the
 * stiffness of the unit cell, and the change from the inner nodes of a contact face to contact dofs.
 *
 * A contact face has as many inner nodes as Gauss points x_k of the rule with p-1 points a direction.
 * With psi_k, Lagrange's basis at these points, the contact dofs `m_k = int psi_k u / int psi_k` take the
 * place of the inner nodal values:
 *
 *     m = M u_inner + W u_rim,    u_inner = M^-1 (m - W u_rim).
 */
template <int dim>
class BoxTables
{
public:
  explicit BoxTables(unsigned int degree);

  const unsigned int degree;
  const dealii::FESystem<dim> fe; ///< of displacements
  const unsigned int n_shapes;    ///< of the scalar element
  /** Of #fe by shape function and component; deal.II searches its list for each. */
  const std::vector<std::array<unsigned int, dim>> numbers;
  const BoxTable<dim> cell;                          ///< p+1 points in each direction
  std::vector<BoxTable<dim>> faces;                  ///< by face, likewise
  std::vector<BoxTable<dim>> moment_points;          ///< by face: the Gauss points x_k
  std::vector<std::vector<unsigned int>> inner, rim; ///< shape functions of a face by face
  FaceContactDofs
      contact_dofs; ///< of the unit face, the same for all: of parallelograms but for their area

  /** Number of contact dofs of each component on a face, `(p-1)^(dim-1)`. */
  unsigned int n_contact_dofs() const
  {
    return contact_dofs.M.m();
  }

  /** psi_k at a point of the unit face whose coordinates along the axes of the body are @p x. */
  double psi(unsigned int k, unsigned int face, const dealii::Point<dim> &x) const;

  /** The stiffness matrix of a box, in the numbering of #fe. */
  dealii::FullMatrix<double> stiffness(const HookesLaw<dim> &law,
                                       const dealii::Tensor<1, dim> &size) const;

  /** Of any cell; by p+1 points a direction, as products without a matrix take them. */
  dealii::FullMatrix<double> stiffness(const HookesLaw<dim> &law, const CellMap<dim> &map) const;

  /** Of a face whose measure is not constant: `m_k = int psi_k u ds / int psi_k ds`. */
  FaceContactDofs moments_of(const CellMap<dim> &map, unsigned int face) const;

  /** Of a face of a curved cell: `m_kd = int psi_k u.e_d ds / int psi_k ds`, e_d the directions of @p axes. */
  FaceContactDofs
  curved_moments_of(const CellMap<dim> &map, unsigned int face,
                    const std::function<ContactAxes<dim>(const dealii::Point<dim> &)> &axes) const;

  /** T of `u = T v` on a box: @p components[dim face + component] says where v has contact dofs for inner nodes. */
  dealii::FullMatrix<double> basis_of_moments(const std::vector<bool> &components) const;

private:
  dealii::FE_Q<dim> scalar() const;
  void number_faces();
  FaceContactDofs
  make_contact_dofs(unsigned int face,
                    const std::function<double(const dealii::Point<dim> &)> &measure) const;

  std::vector<double> gauss; ///< coordinates of the points x_k
  std::array<std::array<dealii::FullMatrix<double>, dim>, dim>
      products; ///< int d_a phi_i d_b phi_j
};

/** `d phi_i/d x_a` of a cell at the points of @p table, by axis, and the weights of its points times det J. */
template <int dim>
struct CellGradients
{
  CellGradients(const BoxTable<dim> &table, const CellMap<dim> &map);

  std::array<dealii::FullMatrix<double>, dim> gradients; ///< by point and shape function
  std::vector<double> volumes;
};

/** The gradient of a field at point @p q of @p table in a box of @p size: (i,j) is d_j u_i. */
template <int dim>
dealii::Tensor<2, dim> gradient(const BoxTable<dim> &table, unsigned int q,
                                const CellField<dim> &field, const dealii::Tensor<1, dim> &size);

/** The axes along a face, in rising order. */
template <int dim>
std::array<unsigned int, dim - 1> tangents(const unsigned int face)
{
  std::array<unsigned int, dim - 1> axes{};
  unsigned int n = 0;
  for (unsigned int d = 0; d < dim; ++d)
    if (d != face / 2)
      axes[n++] = d;
  return axes;
}
} // namespace hpvi

#endif
