// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_joint_tractions_h
#define hpvi_joint_tractions_h

#include <hpvi/bound/admissible_friction.h>
#include <hpvi/bound/admissible_pressure.h>
#include <hpvi/plane/solution.h>

#include <array>
#include <map>
#include <utility>
#include <vector>

namespace hpvi
{
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
  bool has_other;

  /** The coordinate on the slave's face where that of the edge is @p s; on_other(): on the edge opposite. */
  double on_slave(const double s) const
  {
    return at_begin + (s - begin) / (end - begin) * (at_end - at_begin);
  }
  double on_other(const double s) const
  {
    return other_begin + (s - begin) / (end - begin) * (other_end - other_begin);
  }
};

/** An edge of either side of a contact, with its pieces in ascending order; there may be gaps between those of a master. */
struct JointEdge
{
  dealii::DoFHandler<2>::active_cell_iterator cell;
  unsigned int face_no;
  bool is_slave;
  std::vector<JointPiece> pieces;
};

/** 2 mu of a cell, or what an orthotropic material has in its place. */
double stiffness(const Solution<2> &solution,
                 const dealii::DoFHandler<2>::active_cell_iterator &cell);

/** Those of all contacts: the slaves' by number of their face, then those of the masters. */
std::vector<JointEdge> joint_edges(const ContactSpace<2> &contact_space);

/**
 * Tractions tau along all contacts that are polynomials on each edge of the slave and that the laws admit at every point: pressure
 * `pi >= 0` where contact is unilateral, friction `g l*`, |l*| <= 1, and any where a joint cannot open or slide. There tau has the mean
 * of z_N on each edge and is else nearest to the mean of both bodies' -sigma(u_N) n, weighted by the other's mu; along the normal it has
 * the moment of z_N on each straight side, too. They need not be in balance with u_N: that is for u_N + x,
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

  /** tau at s in [0,1] of the slave's face: what the slave exerts on the master [stress]. */
  dealii::Tensor<1, 2> value(unsigned int face, double s) const;

  double pressure(unsigned int face, double s) const; ///< its part along the normal

  unsigned int degree(unsigned int face) const; ///< of tau along the slave's face, over g

  unsigned int degree(const JointEdge &edge) const; ///< the largest on its pieces

  /** Points of a piece between which tau is smooth, and their weights, with sum 1; for functions of @p more degrees beside tau. */
  std::vector<std::pair<double, double>> points(const JointPiece &piece, unsigned int more) const;

  /** int (z_N - tau) . [v] for all displacement unknowns v. */
  dealii::Vector<double> missing_forces() const;

private:
  std::array<EdgePolynomial, 2> wanted(unsigned int face) const;
  void balance_moments();

  const Solution<2> &solution;
  const AdmissibleFriction<2> &friction;
  std::vector<JointEdge> all;
  std::map<std::pair<unsigned int, unsigned int>, unsigned int> by_cell;
  std::vector<std::array<EdgePolynomial, 2>> parts; ///< by face, along normal and tangent
};
} // namespace hpvi

#endif
