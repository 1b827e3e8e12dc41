// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_shape_tables_h
#define hpvi_shape_tables_h

#include <deal.II/base/point.h>
#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/hp/fe_collection.h>
#include <deal.II/lac/full_matrix.h>

#include <array>
#include <map>
#include <vector>

namespace hpvi
{
/**
 * The scalar FE_Q(p) tabulated at Gauss points of the reference cell [0,1]^dim or of one of its
 * faces, in deal.II's numbering of shape functions. Rows of @p derivatives come point by point;
 * each point has its dim first derivatives and, where asked for, dim^2 second derivatives.
 */
template <int dim>
struct ShapeTable
{
  unsigned int n_shapes;
  unsigned int rows_per_point; ///< dim, or dim + dim^2 with second derivatives
  std::vector<dealii::Point<dim>> points;
  std::vector<double> weights;            ///< of the quadrature on the cell or the face
  dealii::FullMatrix<double> values;      ///< n_points x n_shapes
  dealii::FullMatrix<double> derivatives; ///< (n_points rows_per_point) x n_shapes
};

/** How deal.II numbers the unknowns of FESystem(FE_Q(p), dim) on one cell. */
struct LocalNumbering
{
  unsigned int n_boundary;             ///< unknowns on vertices and faces; they come first
  std::vector<unsigned int> component; ///< of each unknown
  std::vector<unsigned int> shape;     ///< scalar shape function of each unknown
  /** In 2D, those of each edge: component by component, each along the edge. */
  std::vector<std::vector<unsigned int>> edge;
};

/** In @p part: the edge itself, not its first (0) or second (1) half. */
constexpr unsigned int whole_edge = dealii::numbers::invalid_unsigned_int;

/**
 * A polynomial on an edge, given at some of the Gauss-Lobatto nodes there, at the Gauss-Lobatto
 * nodes of another degree on the edge or on one half of it.
 */
struct EdgeInterpolation
{
  std::vector<unsigned int> nodes;    ///< where it is given, counted along the edge
  dealii::FullMatrix<double> weights; ///< new nodes x given nodes
};

/** Polynomials in one variable at the Gauss points of an edge. */
struct EdgeTable
{
  dealii::FullMatrix<double> shapes;      ///< points x (p+1): FE_Q(p) on the edge
  dealii::FullMatrix<double> multipliers; ///< points x n: Lagrange basis at the n Gauss points
};

/**
 * All tables that a run needs, each computed when first asked for. They depend on degree, face and
 * number of points only, never on a cell; so cells cost one small matrix product where deal.II's
 * FEValues would transform every shape function at every point.
 */
template <int dim>
class ShapeTables
{
public:
  /** (n_gauss)^dim points in the cell, with second derivatives. */
  const ShapeTable<dim> &cell(unsigned int degree, unsigned int n_gauss) const;

  /** The same points with first derivatives only. */
  const ShapeTable<dim> &gradients(unsigned int degree, unsigned int n_gauss) const;

  /** (n_gauss)^(dim-1) points on face @p face_no. */
  const ShapeTable<dim> &face(unsigned int degree, unsigned int face_no,
                              unsigned int n_gauss) const;

  /** The same on the part of a face that its child @p subface_no covers. */
  const ShapeTable<dim> &subface(unsigned int degree, unsigned int face_no, unsigned int subface_no,
                                 unsigned int n_gauss) const;

  /** FESystem(FE_Q(p), dim) at index p - 1, for p up to @p highest and maybe beyond. */
  const dealii::hp::FECollection<dim> &elements(unsigned int highest) const;

  const LocalNumbering &numbering(unsigned int degree) const;

  /**
   * From @p trace_degree + 1 of the nodes of @p source_degree, both ends among them, to all nodes of
   * @p target_degree on @p part of the edge.
   */
  const EdgeInterpolation &edge_interpolation(unsigned int source_degree, unsigned int trace_degree,
                                              unsigned int target_degree, unsigned int part) const;

  /** The Gauss rule on [0,1]: deal.II computes its points anew for each object. */
  const dealii::QGauss<1> &gauss(unsigned int n_gauss) const;

  /** The Gauss-Lobatto rule on [0,1]: its points are the nodes of FE_Q(n_points - 1) on an edge. */
  const dealii::QGaussLobatto<1> &gauss_lobatto(unsigned int n_points) const;

  /** Lagrange polynomials at the Gauss points. */
  const std::vector<dealii::Polynomials::Polynomial<double>> &
  gauss_lagrange(unsigned int n_gauss) const;

  /** Along an edge of degree @p degree with @p n_multipliers, at @p n_gauss points. */
  const EdgeTable &edge(unsigned int degree, unsigned int n_multipliers,
                        unsigned int n_gauss) const;

  /**
   * N, (p-1) x (p+1): a polynomial of degree p >= 2 on an edge has at its p-1 interior nodes the values
   * `N (m, v(0), v(1))`, where `m_i = int psi_i v / int psi_i` are its moments with the Lagrange basis
   * psi at p-1 Gauss points. N has condition 1.0 (p = 2) to 1.8 (p = 14). Integrals may have the weight
   * `1 + slope (2s - 1)`, slope in [-1, 1]: then the condition is 9 at most.
   */
  const dealii::FullMatrix<double> &nodes_from_moments(unsigned int degree,
                                                       double slope = 0.) const;

private:
  const ShapeTable<dim> &in_cell(unsigned int degree, unsigned int n_gauss,
                                 bool second_derivatives) const;

  mutable std::map<std::array<unsigned int, 4>, ShapeTable<dim>> tables;
  mutable std::map<unsigned int, dealii::hp::FECollection<dim>>
      finite_elements; ///< by the highest degree
  mutable std::map<unsigned int, LocalNumbering> numberings;
  mutable std::map<std::array<unsigned int, 4>, EdgeInterpolation> interpolations;
  mutable std::map<unsigned int, dealii::QGauss<1>> gauss_rules;
  mutable std::map<unsigned int, dealii::QGaussLobatto<1>> gauss_lobatto_rules;
  mutable std::map<unsigned int, std::vector<dealii::Polynomials::Polynomial<double>>>
      lagrange_bases;
  mutable std::map<std::array<unsigned int, 3>, EdgeTable> edge_tables;
  mutable std::map<std::pair<unsigned int, double>, dealii::FullMatrix<double>> moment_nodes;
};

/**
 * Apply @p table (rows x n_shapes) to vector-valued coefficients stored component by component:
 * result[c * rows + r] = sum_i table(r, i) coefficients[c * n_shapes + i].
 */
std::vector<double> evaluate(const dealii::FullMatrix<double> &table,
                             const std::vector<double> &coefficients);

/** The table of scalar FE_Q(p) at any points of the reference cell. */
template <int dim>
ShapeTable<dim> tabulate(unsigned int degree, const std::vector<dealii::Point<dim>> &points,
                         const std::vector<double> &weights, bool second_derivatives);
/**
 * d u_c / d x_j at a point whose derivatives on the reference cell stand in the dim rows from
 * @p first_row on, of @p n_rows a component, as evaluate() stores them.
 */
template <int dim>
dealii::Tensor<2, dim> physical_gradient(const std::vector<double> &derivatives,
                                         const unsigned int first_row, const unsigned int n_rows,
                                         const dealii::Tensor<2, dim> &inverse_jacobian)
{
  dealii::Tensor<2, dim> gradient;
  for (unsigned int c = 0; c < dim; ++c)
    for (unsigned int r = 0; r < dim; ++r)
      for (unsigned int j = 0; j < dim; ++j)
        gradient[c][j] += derivatives[c * n_rows + first_row + r] * inverse_jacobian[r][j];
  return gradient;
}
} // namespace hpvi

#endif
