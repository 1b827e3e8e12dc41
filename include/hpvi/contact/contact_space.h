// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_contact_space_h
#define hpvi_contact_space_h

#include <deal.II/base/tensor.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/lac/vector.h>
#include <hpvi/body/displacement_space.h>
#include <hpvi/contact/friction_rule.h>
#include <hpvi/solver/quadratic_program.h>

#include <map>
#include <memory>
#include <vector>

namespace hpvi
{
/**
 * One face of the contact boundary. Its multiplier unknowns are the values of lambda_N at its
 * Gauss points, in the order of the face's own reference coordinate.
 */
template <int dim>
struct ContactFace
{
  typename dealii::DoFHandler<dim>::active_cell_iterator cell;
  unsigned int face_no;
  unsigned int degree; ///< p_K of the cell
  const BoundaryCondition<dim> *condition;
  dealii::Tensor<1, dim> normal;  ///< outer unit normal n
  dealii::Tensor<1, dim> tangent; ///< t = (-n_y, n_x)
  unsigned int n_points;          ///< Gauss points: p + offset + 1
  unsigned int first_multiplier;  ///< index of the first unknown
  unsigned int n_multipliers;     ///< n_points, or 0 where g vanishes on the whole face
  FrictionRule friction;          ///< for every integral over the face that holds g [stress]
  /** Shape functions at the points of @p friction; null for one piece: those of ShapeTables. */
  std::shared_ptr<const ShapeTable<dim>> own_table;

  /** Friction bound g(x), zero where the boundary names none. */
  double friction_bound(const dealii::Point<dim> &x) const;

  /** The point at reference coordinate s in [0,1], from vertex 0 of the face to vertex 1. */
  dealii::Point<dim> point(double s) const;

  double length() const; ///< of the straight edge

  /** The scalar FE_Q(p) at the points of @p friction. */
  const ShapeTable<dim> &friction_table(const ShapeTables<dim> &tables) const;
};

/** A jump of g inside an edge, which no polynomial of the discrete problem follows. */
template <int dim>
struct UnresolvedJump
{
  const ContactFace<dim> *face;
  dealii::Point<dim> where;
  double height; ///< of g [stress]
};

/**
 * The multiplier space W_N of (3.58): on each contact face where g does not vanish the polynomials
 * of degree p + offset, discontinuous from face to face, Lagrange basis at the p + offset + 1 Gauss
 * points; with the discrete set (3.68), |z_i| <= 1. The thesis has offset = -2
 * (SolverSettings::multiplier_offset).
 */
template <int dim>
class ContactSpace
{
public:
  ContactSpace(const Scene<dim> &scene, const DisplacementSpace<dim> &displacement_space);

  /** Faces along the boundary: one contact boundary after the other, each sorted by position. */
  const std::vector<ContactFace<dim>> &faces() const;

  unsigned int n_multipliers() const;

  /** -1 <= z_i <= 1. */
  FeasibleSet feasible_set() const;

  /**
   * Values of the multiplier's Lagrange basis on @p face at reference coordinates @p s in [0,1].
   */
  std::vector<double> basis_values(const ContactFace<dim> &face, double s) const;

  /** lambda_N on @p face at s in [0,1]; zero on a face without multipliers. Dimensionless. */
  double value(const ContactFace<dim> &face, const dealii::Vector<double> &lambda, double s) const;

  /** int g, all that friction can carry along the contact boundary [stress length^(dim-1)]. */
  double friction_limit() const;

  /** Jumps of g whose height times the length of their edge exceeds 1e-6 of friction_limit(). */
  std::vector<UnresolvedJump<dim>> unresolved_jumps() const;

private:
  void number_multipliers();

  std::vector<ContactFace<dim>> contact_faces;
  std::map<unsigned int, dealii::FE_DGQArbitraryNodes<dim - 1>> elements; ///< by n_points
  unsigned int n_unknowns = 0;
};
} // namespace hpvi

#endif
