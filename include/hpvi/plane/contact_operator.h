// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_contact_operator_h
#define hpvi_contact_operator_h

#include <hpvi/plane/contact_space.h>

namespace hpvi
{
/**
 * The rows of `b(v, z) = int z_t v_t + int z_n v_n` over the contact boundary, one for each multiplier
 * unknown i with its basis function psi_i: `B_i v = int psi_i v_t` or `int psi_i v_n`, the latter by the
 * Gauss-Lobatto rule where pressures stand at nodes. Neither bound nor gap stands in them, so that they
 * outlive a change of g; |z_i| <= g(x_i) is a matter of the feasible set.
 *
 * Where a multiplier has degree p - 2 and nothing prescribes the displacement that it works on, a
 * contact edge has as many interior nodes as Gauss points, p - 1, and they belong to one cell and never
 * hang. There the moments `m_i = B_i u / w_i`, w_i = int psi_i the Gauss weight times length, take the
 * place of the nodal values: as unknowns of the linear system they make B diagonal,
 * `b(u, z) = sum w_i m_i z_i`.
 *
 * Where another body lies opposite, B has the jump [u] = u - u' in the place of u, integrated segment by segment, and the
 * unknowns are moments of the jump: the linear system is that of bodies glued together where these vanish.
 */
template <int dim>
class ContactOperator
{
  static_assert(dim == 2, "nodes along a straight edge");

public:
  using Kind = typename ContactMultiplier<dim>::Kind;

  /** The spaces must outlive this object. */
  ContactOperator(const DisplacementSpace<dim> &displacement_space,
                  const ContactSpace<dim> &contact_space, const ShapeTables<dim> &tables);

  /** B u: what u does at the contact boundary, by multiplier [length^dim]. */
  dealii::Vector<double> moments(const dealii::Vector<double> &u) const;

  /** B' z: b(v_i, z) for every displacement unknown; of one contact boundary where it is named. */
  dealii::Vector<double>
  forces(const dealii::Vector<double> &z,
         dealii::types::boundary_id only = dealii::numbers::invalid_boundary_id) const;

  /** The part of B that belongs to one face and one direction, and its way to moments. */
  struct Rows
  {
    const ContactFace<dim> *face;
    typename ContactMultiplier<dim>::Kind kind;
    std::vector<unsigned int> multipliers; ///< of each row; a vertex may get its row from two faces
    /** Displacement unknowns of its edge, component by component, each along the edge. */
    std::vector<dealii::types::global_dof_index> dofs;
    dealii::FullMatrix<double> B; ///< multipliers x dofs
    /** The same of the body opposite, whose displacement is subtracted: none of a rigid foundation. */
    std::vector<dealii::types::global_dof_index> master_dofs;
    dealii::FullMatrix<double> master; ///< multipliers x master_dofs
    /**
     * The displacement in this direction at the p-1 interior nodes by the p-1 moments and that at both
     * ends, `u_t = N (m, u_t(0), u_t(1))`; null where the nodal values stay the unknowns.
     */
    const dealii::FullMatrix<double> *nodes;
  };

  /** Of every face with multipliers, in the order of ContactSpace::faces(); friction first. */
  const std::vector<Rows> &rows() const;

  const ContactSpace<dim> &contact_space() const;

private:
  const DisplacementSpace<dim> &space;
  const ContactSpace<dim> &multipliers;
  std::vector<Rows> face_rows;
};
} // namespace hpvi

#endif
