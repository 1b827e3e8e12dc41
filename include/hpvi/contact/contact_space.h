// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_contact_space_h
#define hpvi_contact_space_h

#include <deal.II/fe/fe_dgq.h>
#include <deal.II/lac/vector.h>
#include <hpvi/body/displacement_space.h>
#include <hpvi/contact/contact_frame.h>
#include <hpvi/contact/friction_rule.h>
#include <hpvi/solver/feasible_set.h>

#include <map>
#include <vector>

namespace hpvi
{
/**
 * One face of the contact boundary. Its multiplier unknowns are the values of z_N at its Gauss
 * points, in the order of the face's own reference coordinate.
 */
template <int dim>
struct ContactFace
{
  typename dealii::DoFHandler<dim>::active_cell_iterator cell;
  unsigned int face_no;
  unsigned int degree; ///< p_K of the cell
  const BoundaryCondition<dim> *condition;
  CellMap<dim> map;              ///< of the cell
  double length;                 ///< of the face
  unsigned int n_points;         ///< Gauss points: p + offset + 1
  unsigned int first_multiplier; ///< index of the first unknown
  unsigned int n_multipliers;    ///< n_points, or 0 where g vanishes on the whole face
  FrictionRule friction;         ///< for integrals over the face that hold g [stress]

  /** At reference coordinate s in [0,1] of the face. */
  ContactFrame<dim> frame(double s) const;
  dealii::Point<dim> point(double s) const; ///< x there

  /** Friction bound g(x), zero where the boundary names none. */
  double friction_bound(const dealii::Point<dim> &x) const;
};

/** A jump of g inside an edge, which no polynomial of the discrete problem follows. */
template <int dim>
struct UnresolvedJump
{
  const ContactFace<dim> *face;
  dealii::Point<dim> where;
  double height; ///< of g [stress]
};

/** An edge on which the Gauss points of the multiplier miss what g does between them. */
template <int dim>
struct UnresolvedBound
{
  const ContactFace<dim> *face;
  double sum;      ///< sum_k w_k g(x_k), what the discrete problem takes for int g [stress length]
  double integral; ///< int g
};

/**
 * The space of friction tractions z_N = g lambda_N: on each contact face where g does not vanish the
 * polynomials of degree p + offset, discontinuous from face to face, Lagrange basis at the
 * p + offset + 1 Gauss points x_i, in the set |z_i| <= g(x_i). For constant g it is g times W_N of
 * (3.58) with the discrete set (3.68), and offset = -2 the thesis's
 * (SolverSettings::multiplier_offset). Where g varies the thesis multiplies the polynomials by g; both
 * are equal once g is resolved, and this one divides by g nowhere (doc/plan.md).
 */
template <int dim>
class ContactSpace
{
public:
  ContactSpace(const Scene<dim> &scene, const DisplacementSpace<dim> &displacement_space);

  /** Faces along the boundary: one contact boundary after the other, each sorted by position. */
  const std::vector<ContactFace<dim>> &faces() const;

  unsigned int n_multipliers() const;

  /** |z_i| <= g(x_i), where x_i = point(i). */
  FeasibleSet feasible_set() const;

  /** Gauss weights times ds by multiplier: `int z_N = sum_i weights_i z_i` [length^(dim-1)]. */
  const std::vector<double> &weights() const;

  /**
   * Values of the multiplier's Lagrange basis on @p face at reference coordinates @p s in [0,1].
   */
  std::vector<double> basis_values(const ContactFace<dim> &face, double s) const;

  /** z_N on @p face at s in [0,1]; zero on a face without multipliers [stress]. */
  double value(const ContactFace<dim> &face, const dealii::Vector<double> &z, double s) const;

  /** int g, all that friction can carry along the contact boundary [stress length^(dim-1)]. */
  double friction_limit() const;

  /** `sum_i w_i g(x_i)`, all that friction can carry in the discrete problem. */
  double discrete_friction_limit() const;

  double largest_bound() const; ///< max g(x_i) [stress]

  /**
   * Faces where `sum_k w_k g(x_k)` differs from int g by more than 1e-3 of it and 1e-6 of
   * friction_limit(): the discrete problem has another friction there than the scene.
   */
  std::vector<UnresolvedBound<dim>> unresolved_bounds() const;

  /** Jumps of g whose height times the length of their edge exceeds 1e-6 of friction_limit(). */
  std::vector<UnresolvedJump<dim>> unresolved_jumps() const;

private:
  void number_multipliers();

  std::vector<ContactFace<dim>> contact_faces;
  std::vector<double> point_weights, bounds; ///< w_i, g(x_i) by multiplier
  std::map<unsigned int, dealii::FE_DGQArbitraryNodes<dim - 1>> elements; ///< by n_points
  unsigned int n_unknowns = 0;
};
} // namespace hpvi

#endif
