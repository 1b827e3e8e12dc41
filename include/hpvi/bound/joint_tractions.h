// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_joint_tractions_h
#define hpvi_joint_tractions_h

#include <hpvi/bound/admissible_friction.h>
#include <hpvi/bound/admissible_pressure.h>
#include <hpvi/plane/solution.h>

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace hpvi
{
/** What lies opposite to what along a piece of a contact whose sides are curved, or at an angle to each other. */
struct FacingCoordinates
{
  /** Of the slave's and of the master's edge where the share of the other's piece is s in [0,1]. */
  EdgePolynomial on_slave, on_master;
  EdgePolynomial speed; ///< the derivative of the first
};

/** A part of an edge in contact, between places where an edge of the other body ends; of a rigid foundation all of it. */
struct JointPiece
{
  double begin, end;       ///< on the edge itself, in [0,1]
  unsigned int face;       ///< of ContactSpace::faces(): the slave's
  double at_begin, at_end; ///< on that one
  /** Opposite, on the master's edge for the slave and the reverse. */
  dealii::DoFHandler<2>::active_cell_iterator other;
  unsigned int other_face;
  double other_begin, other_end;
  bool has_other, is_slave;
  std::shared_ptr<const FacingCoordinates> drawn; ///< null: coordinates are linear in each other

  /** The coordinate on the slave's face where that of the edge is @p s; on_other(): on the edge opposite. */
  double on_slave(const double s) const
  {
    return drawn && !is_slave ? drawn->on_slave(share(s))
                              : at_begin + share(s) * (at_end - at_begin);
  }
  double on_other(const double s) const
  {
    return !is_slave ? on_slave(s)
           : drawn   ? drawn->on_master(share(s))
                     : other_begin + share(s) * (other_end - other_begin);
  }
  /** |d on_slave/ds| */
  double speed(const double s) const
  {
    return std::abs(drawn && !is_slave ? drawn->speed(share(s)) : at_end - at_begin) /
           (end - begin);
  }
  /** That of the edge where the slave's is @p at. */
  double from_slave(const double at) const
  {
    const double of_slave = (at - at_begin) / (at_end - at_begin);
    if (!drawn || is_slave)
      return begin + of_slave * (end - begin);
    return drawn->on_master(at_begin < at_end ? of_slave : 1. - of_slave);
  }

private:
  double share(const double s) const
  {
    return (s - begin) / (end - begin);
  }
};

/** An edge of either side of a contact, with its pieces in ascending order; there may be gaps between those of a master. */
struct JointEdge
{
  dealii::DoFHandler<2>::active_cell_iterator cell;
  unsigned int face_no;
  bool is_slave;
  std::vector<JointPiece> pieces;
  bool is_cut = false; ///< is tau another polynomial on each piece?
};

/** Points of Gauss through which a polynomial follows a smooth curve, or what is opposite to it. */
constexpr unsigned int n_of_curve = 24;

/** 2 mu of a cell, or what an orthotropic material has in its place. */
double stiffness(const Solution<2> &solution,
                 const dealii::DoFHandler<2>::active_cell_iterator &cell);

/** u_N at s in [0,1] of an edge of a cell. */
dealii::Tensor<1, 2> displacement_at(const Solution<2> &solution,
                                     const dealii::DoFHandler<2>::active_cell_iterator &cell,
                                     unsigned int face_no, double s);

/**
 * Those of all contacts: the slaves' by number of their face, then those of the masters. @p ends by face: where contact ends inside it, and a
 * piece too; below 0: nowhere.
 */
std::vector<JointEdge> joint_edges(const ContactSpace<2> &contact_space,
                                   const std::vector<double> &ends);

/**
 * Tractions tau along all contacts that are polynomials on each edge of the slave and that the laws admit at every point: pressure
 * `pi >= 0` where contact is unilateral, zero beyond the place where it ends inside an edge, friction `g l*`, |l*| <= 1, and any where a joint cannot open or slide. There tau has the mean
 * of z_N on each edge and is else nearest to the mean of both bodies' -sigma(u_N) n, weighted by the other's mu; along the normal it has
 * the moment of z_N on each straight side, too. Along motions v that no support resists it does the work of z_N: with a = sum a_i [v_i]
 * there is `pi (1 + a_n)` for pi, `l* + (1 - l*^2) a_t` for l*, and tau + a in a joint. Else tau need not be in balance with u_N: that is for u_N + x,
 *
 *     a(x, v) = int (z_N - tau) . [v]   for all v.
 */
class JointTractions
{
public:
  /** All must outlive this object. */
  JointTractions(const Solution<2> &solution, const AdmissibleFriction<2> &friction,
                 const AdmissiblePressure<2> &pressure);

  const std::vector<JointEdge> &edges() const;

  /** Of an edge of a cell; null: it is in no contact. */
  const JointEdge *edge(unsigned int cell, unsigned int face_no) const;

  /** ds over ds of the edge's own coordinate, and tau times that: what the slave exerts on the master [stress length]. */
  double measure(const JointPiece &piece, double s) const;
  dealii::Tensor<1, 2> density(const JointPiece &piece, double s) const;

  /** tau at s in [0,1] of the slave's face [stress]. */
  dealii::Tensor<1, 2> value(unsigned int face, double s) const;

  bool presses(const JointPiece &piece) const; ///< at all points of the multiplier there

  double pressure(unsigned int face, double s) const;  ///< its part along the normal
  double limit(unsigned int face, double s) const;     ///< what friction may be there
  double direction(unsigned int face, double s) const; ///< and its share of that, l*

  unsigned int degree(unsigned int face) const; ///< of tau along the slave's face, over g

  unsigned int degree(const JointEdge &edge) const; ///< the largest on its pieces

  /** Points of [begin, end] of a piece's edge and their weights, for functions of @p more degrees beside tau, which is smooth between cuts. */
  std::vector<std::pair<double, double>> points(const JointPiece &piece, double begin, double end,
                                                unsigned int more) const;

  /** int (z_N - tau) . [v] for all displacement unknowns v. */
  dealii::Vector<double> missing_forces() const;

private:
  double end_of_contact(unsigned int face) const;
  void set_pressure_before_end(unsigned int face);
  std::array<EdgePolynomial, 2> wanted(unsigned int face, double begin, double end) const;
  void balance_moments();
  void balance_motions();
  dealii::Vector<double> missing_work() const;
  std::array<double, 2> share_of_motions(unsigned int face, double s) const;

  const Solution<2> &solution;
  const AdmissibleFriction<2> &friction;
  std::vector<double> ends; ///< by face: where contact ends inside it, or -1
  std::vector<JointEdge> all;
  std::map<std::pair<unsigned int, unsigned int>, unsigned int> by_cell;
  std::vector<std::array<EdgePolynomial, 2>>
      parts; ///< by face, along normal and tangent; the first by the share of what is pressed
  std::vector<RigidBodyMotion<2>> motions; ///< that no support resists
  std::optional<RigidBodyMotion<2>> added; ///< a
  double unit = 0;                         ///< [stress]
};
} // namespace hpvi

#endif
