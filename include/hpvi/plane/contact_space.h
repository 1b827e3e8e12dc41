// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_contact_space_h
#define hpvi_contact_space_h

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_dgq.h>
#include <deal.II/lac/vector.h>
#include <hpvi/plane/cell_map.h>
#include <hpvi/plane/displacement_space.h>
#include <hpvi/plane/friction_rule.h>
#include <hpvi/plane/mortar_segmentation.h>
#include <hpvi/solvers/friction_cones.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace hpvi
{
/** u_t(x) from which slip is counted, by the number of a contact boundary [length]; where there is none: 0. */
template <int dim>
using PastSlip = std::map<dealii::types::boundary_id, Expression<dim>>;

/**
 * A contact face at one of its points: the one source of normals, tangents and lengths there. ContactFace::frame() has
 * `Contact direction` d in the place of the normal, and t = (-d_y, d_x).
 */
template <int dim>
struct ContactFrame
{
  dealii::Point<dim> x;
  dealii::Tensor<1, dim> normal;  ///< outer unit normal n, or d
  dealii::Tensor<1, dim> tangent; ///< t = (-n_y, n_x); in space the first of two
  double measure; ///< ds over ds of the reference face: the length of a straight edge
};

/** At @p s of face @p face_no in reference coordinates, in [0,1]^(dim-1). */
template <int dim>
ContactFrame<dim> contact_frame(const CellMap<dim> &map, const unsigned int face_no,
                                const dealii::Point<dim - 1> &s)
{
  static_assert(dim == 2, "one tangent");
  const dealii::Point<dim> reference = point_on_face<dim>(face_no, s);
  const dealii::Tensor<1, dim> normal = map.normal(face_no, reference);
  return {map.point(reference), normal, -dealii::cross_product_2d(normal),
          map.face_measure(face_no, reference)};
}

/** What friction may be at one point of a quadrature rule on [0,1]. */
struct PointLimit
{
  double s, weight;
  FrictionLimit friction;
};

/**
 * One face of the contact boundary. Its multiplier unknowns are those of friction, the values of z_N
 * at its Gauss points, then those of normal contact, the pressures at its normal points; both in the
 * order of the face's own reference coordinate.
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
  unsigned int first_multiplier; ///< index of the first unknown of friction
  unsigned int n_multipliers;    ///< n_points, or 0 where g vanishes on the whole face
  /**
   * Where the pressure has its unknowns, in [0,1]: none without unilateral contact; the Gauss points
   * of a multiplier; or Gauss-Lobatto points, without those where u_n is prescribed.
   */
  std::vector<double> normal_points;
  std::vector<unsigned int> pressures; ///< their unknowns; a vertex shares its own
  FrictionRule friction;               ///< for integrals over the face that hold g [stress]
  FrictionRule coefficient = {};       ///< likewise mu_f; no points where the boundary names none
  std::vector<PointLimit> limits =
      {};                         ///< a rule for the limit of the law, cut where its functions are
  Expression<dim> past = nullptr; ///< of PastSlip
  bool at_nodes = false;          ///< are the normal points Gauss-Lobatto points?
  bool is_axisymmetric =
      false; ///< around the axis: measures hold 2 pi x, and so do weights of limits
  /** Of the other body, where there is one: u_n and u_t stand for jumps [u] = u - u' then. */
  std::vector<ContactSegment<dim>> segments = {};

  TouchingBodies bodies = {{0, no_body}}; ///< its own and the one opposite

  /** Which of the segments lies at s in [0,1]. */
  const ContactSegment<dim> &segment(double s) const;

  /** At reference coordinate s in [0,1] of the face. */
  ContactFrame<dim>
  frame(double s) const; ///< its measure is that of the full turn, if there is one
  dealii::Point<dim> point(double s) const; ///< x there

  /** At a Gauss-Lobatto node with the normal of the curve that the edge follows: neighbours agree on it. */
  ContactFrame<dim> node_frame(double s) const;

  /** At s in [0,1] what stands in the place of friction_bound(); null: that does. See ContactSpace::under(). */
  std::function<double(double)> limit = {};

  /** int psi_i of the Lagrange basis at Gauss points of the face [length^(dim-1)]. */
  double basis_integral(const dealii::QGauss<1> &points, unsigned int i) const;

  double friction_bound(const dealii::Point<dim> &x) const;       ///< FrictionLaw::bound_at()
  double friction_coefficient(const dealii::Point<dim> &x) const; ///< likewise
  double limit_at(double s) const;          ///< that, or what stands in its place, at s in [0,1]
  double friction_without_pressure() const; ///< int limit(0)
  double past_slip(const dealii::Point<dim> &x) const; ///< u_t(x) from which slip is counted
};

/** Values at @p s of the polynomials that are 1 at one of @p points and 0 at the others. */
std::vector<double> lagrange_basis(const std::vector<double> &points, double s);

/** One unknown of the multiplier: a traction at a point, in one direction. */
template <int dim>
struct ContactMultiplier
{
  enum class Kind
  {
    friction, ///< along the tangent: |z| <= limit(z_n) with its partner z_n, if it has one; tied: any
    pressure ///< along the normal: z >= 0, or of any sign where contact is bilateral
  };

  Kind kind;
  dealii::Point<dim> x;
  dealii::Tensor<1, dim> direction; ///< of the displacement that it works on
  /** Of the quadrature rule, times ds: `int z_N = sum_i weight_i z_i` [length^(dim-1)]. */
  double weight = 0;
  FrictionLimit friction = {}; ///< nothing for a pressure
  /** int psi u_0 with its basis function psi; of friction that of the past slip [length^dim]. */
  double gap = 0;
  unsigned int partner = dealii::numbers::invalid_unsigned_int; ///< its pressure there; else none
  bool is_bilateral = false;                                    ///< a traction of any sign
  TouchingBodies bodies = {{0, no_body}};                       ///< of its face
};

/** A jump of g, or of mu_f, inside an edge, which no polynomial of the discrete problem follows. */
template <int dim>
struct UnresolvedJump
{
  const ContactFace<dim> *face;
  std::string entry; ///< of the function that jumps
  dealii::Point<dim> where;
  double height; ///< of g [stress], of mu_f [-]
  double force;  ///< what the whole edge would carry more by it [stress length]
};

/**
 * An edge on which the Gauss points of the multiplier miss what the limit does between them: with the
 * polynomial of the pressure, where the law knows one.
 */
template <int dim>
struct UnresolvedBound
{
  const ContactFace<dim> *face;
  std::string entry; ///< FrictionLaw::entry()
  double
      sum; ///< sum_k w_k limit(x_k), what the discrete problem takes for its integral [stress length]
  double integral; ///< int limit
  double absolute; ///< int |limit|: pressures may pull
};

/**
 * The space of contact tractions z_N, the multipliers. Friction, T_t = -z: on each contact face where g
 * does not vanish the polynomials of degree p + offset, discontinuous from face to face, Lagrange basis
 * at the p + offset + 1 Gauss points x_i, in the set |z_i| <= g(x_i). For constant g it is g times W_N
 * of (3.58) with the discrete set (3.68), and offset = -2 the thesis's
 * (SolverSettings::multiplier_offset). Where g varies the thesis multiplies the polynomials by g; both
 * are equal once g is resolved, and this one divides by g nowhere (doc/decisions.md).
 *
 * Pressure, T_n = -z, on faces with unilateral contact: either the same polynomials with z_i >= 0, so
 * that `u_n <= u_0` holds in their moments; or (NormalContact::nodes) a continuous polynomial of degree
 * p with z_i >= 0 at the Gauss-Lobatto points and `int z v_n` by the Gauss-Lobatto rule, so that
 * `u_n <= u_0` holds at these points, (3.67), and the weight times z_i is the reaction of a node.
 */
template <int dim>
class ContactSpace
{
public:
  /** Throws InputError where a prescribed displacement contradicts the gap at a node. */
  ContactSpace(const Scene<dim> &scene, const DisplacementSpace<dim> &displacement_space,
               const ShapeTables<dim> &tables, const PastSlip<dim> &past = {});

  /**
   * The same space where friction knows no pressure: on each face the function of s in [0,1] is the limit, and at the
   * unknowns that which @p z has.
   */
  ContactSpace under(const std::vector<std::function<double(double)>> &limits,
                     const dealii::Vector<double> &z, const ShapeTables<dim> &tables) const;

  /** Faces along the boundary: one contact boundary after the other, each sorted by position. */
  const std::vector<ContactFace<dim>> &faces() const;

  unsigned int n_multipliers() const;
  const std::vector<ContactMultiplier<dim>> &multipliers() const;

  /** |z_i| <= g(x_i) of friction, z_i >= 0 of pressures; no sides where a cone has them. */
  FeasibleSet feasible_set() const;

  /** The pairs of a law that knows the pressure; none under Tresca's. */
  std::vector<FrictionCones::Cone> cones() const;

  /** The limit at an unknown of friction where the multiplier is @p z. */
  double bound(unsigned int unknown, const dealii::Vector<double> &z) const;

  /** On @p face at s in [0,1] likewise, with the polynomial of the pressure. */
  double bound(const ContactFace<dim> &face, const dealii::Vector<double> &z, double s) const;

  /**
   * Values of the friction multiplier's Lagrange basis on @p face at reference coordinates @p s in
   * [0,1].
   */
  std::vector<double> basis_values(const ContactFace<dim> &face, double s) const;

  /** z_N of friction on @p face at s in [0,1]; zero on a face without multipliers [stress]. */
  double value(const ContactFace<dim> &face, const dealii::Vector<double> &z, double s) const;

  /** The pressure -T_n likewise. */
  double pressure(const ContactFace<dim> &face, const dealii::Vector<double> &z, double s) const;

  /** All that friction can carry without pressure along the contact boundary [stress length^(dim-1)]. */
  double friction_limit() const;

  /** The same in the discrete problem, `sum_i w_i limit_i(0)`. */
  double discrete_friction_limit() const;

  double largest_bound() const; ///< max limit_i(0) [stress]

  /**
   * Faces where `sum_k w_k limit(x_k)` differs from its integral by more than 1e-3 of it and 1e-6 of the same
   * over all faces: the discrete problem has another friction there than the scene. Where the law knows the
   * pressure that depends on @p z.
   */
  std::vector<UnresolvedBound<dim>> unresolved_bounds(const dealii::Vector<double> &z) const;

  /** Jumps of g or mu_f that change the friction of their edge by more than 1e-6 of that on all, likewise. */
  std::vector<UnresolvedJump<dim>> unresolved_jumps(const dealii::Vector<double> &z) const;

private:
  using Kind = typename ContactMultiplier<dim>::Kind;

  void number_friction(ContactFace<dim> &face, const Scene<dim> &scene,
                       const ShapeTables<dim> &tables);
  void add_past(const ContactFace<dim> &face, const dealii::QGauss<1> &gauss);
  void number_pressures(ContactFace<dim> &face, const ShapeTables<dim> &tables);
  void number_nodes(ContactFace<dim> &face, const DisplacementSpace<dim> &displacement_space,
                    const ShapeTables<dim> &tables);
  UnresolvedBound<dim> limit(const ContactFace<dim> &face, const dealii::Vector<double> &z) const;
  double carried_by(bool by_bound, const ContactFace<dim> &face,
                    const dealii::Vector<double> &z) const;
  std::vector<UnresolvedBound<dim>> limits(const dealii::Vector<double> &z) const;

  std::vector<ContactFace<dim>> contact_faces;
  std::vector<ContactMultiplier<dim>> unknowns;
  std::map<unsigned int, dealii::FE_DGQArbitraryNodes<dim - 1>> elements; ///< by n_points
  std::map<unsigned int, std::vector<unsigned int>> at_vertices; ///< pressures by vertex index
};
} // namespace hpvi

#endif
