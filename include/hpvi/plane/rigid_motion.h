// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_rigid_motion_h
#define hpvi_rigid_motion_h

#include <hpvi/plane/elastic_system.h>
#include <hpvi/solvers/balance_solver.h>

namespace hpvi
{
/**
 * The motions R that strain nothing and that no support resists, up to three of each body in the plane. Those that
 * contact sees, `G = B R != 0`, are held by forces in balance with the loads, `R'(f - B' z) = 0`; A is
 * stabilised by `c P P'`, where P'u is the mean displacement along R over the contact. Those that no
 * contact sees are unknowns of their own: A is stabilised by a spring at one unknown, which carries no
 * force, and u is not unique.
 *
 * Motions are chosen so that they are orthogonal over the contact, `G' W^-1 G` diagonal with the weights
 * W of the multipliers: then one is seen where its entry is above round-off. Two bodies that touch along a circle may turn about its
 * middle; the polynomials that stand for the circle would press by as much as their normals differ from those of the circle, and that is no
 * more than round-off.
 */
template <int dim>
class RigidMotions
{
public:
  /**
   * @p basis of the motions; @p precision of the normals of contact. Throws NumericalFailure where loads push along one that no
   * contact sees.
   */
  RigidMotions(const std::vector<RigidBodyMotion<dim>> &basis, const Geometry<dim> &geometry,
               const DisplacementSpace<dim> &space, const Unknowns<dim> &unknowns,
               const ConditionRows &rows, const std::vector<ContactMultiplier<dim>> &multipliers,
               const ElasticSystem<dim> &system, double precision = 0);

  unsigned int n_seen() const; ///< by contact

  /** `G' z = e`: the contact balances the loads along each motion that it sees. */
  const EqualityConstraints &balance() const;

  /**
   * S contains `G penalty G'` and d `G penalty e`, because A^-1 contains `R penalty R'`: the inverse of
   * c (P'R)^2, by motion.
   */
  const dealii::FullMatrix<double> &penalty() const;

  /** What is added to A, motion by motion. */
  const std::vector<Stabilisation> &stabilisation() const;

  /** The motion with @p amounts of those that contact sees. */
  RigidBodyMotion<dim> motion(const dealii::Vector<double> &amounts) const;

  /** The same at the unknowns. */
  dealii::Vector<double> at_unknowns(const dealii::Vector<double> &amounts) const;

  /** Amounts of the motions of the basis, which outlive the mesh, and back. */
  dealii::Vector<double> in_basis(const dealii::Vector<double> &amounts) const;
  dealii::Vector<double> from_basis(const dealii::Vector<double> &coefficients) const;

private:
  void split_by_contact(std::vector<dealii::Vector<double>> columns, double smallest);
  void stabilise_seen(const ConditionRows &rows,
                      const std::vector<ContactMultiplier<dim>> &multipliers,
                      const SymmetricMatrix &A);
  void hold_unseen(const ElasticSystem<dim> &system);

  std::vector<RigidBodyMotion<dim>> basis;
  std::vector<dealii::Vector<double>> combinations; ///< of the basis: first those that are seen
  std::vector<dealii::Vector<double>> R;            ///< of each, at the unknowns
  EqualityConstraints equations;
  dealii::FullMatrix<double> inverse_stiffness;
  std::vector<Stabilisation> terms;
};
} // namespace hpvi

#endif
