// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_box_bound_stages_h
#define hpvi_box_bound_stages_h

#include <hpvi/bound/error_bound.h>
#include <hpvi/space/box_polynomials.h>
#include <hpvi/space/box_stiffness.h>
#include <hpvi/space/newton_matrix.h>

#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace hpvi
{
constexpr double same_gap = 1e-12; ///< of a gap: what differs by less is round-off

/** The face functions of friction and pressure on one contact face. */
struct ContactTractions
{
  bool has_friction = false, has_pressure = false;
  std::array<BoxModes, 2>
      lambda;        ///< Bernstein coefficients of lam* along both tangents of tangents()
  BoxModes pressure; ///< of pi
};

/** What box_bound() does, stage by stage; the source of each has its name. */
class BoxBound
{
public:
  /** @p work: L(u_N) of the discrete problem. */
  BoxBound(const PrimalSpace<3> &space, NewtonMatrix<3> &matrix, const DistributedVector &u,
           const std::vector<ContactVector<3>> &lambda, double work);

  ErrorBound compute();

protected: // tests look at the stages
  using Cell = PrimalSpace<3>::Cell;

  dealii::Vector<double> modes(const Cell &cell, const DistributedVector &of) const;
  void take_loads();
  BoxModes projected(const Load<3> &load, unsigned int component, const CellMap<3> &map, int face,
                     double &missed);
  double missed_by(const BoxModes &modes, const std::vector<double> &values,
                   unsigned int n_axes) const;
  void take_contact(const BoxEquilibration &elements);
  ContactTractions tractions(const ContactDofFace<3> &face, const BoxStress &element) const;
  void give(const ContactDofFace<3> &face, const ContactTractions &contact);
  DistributedVector balanced();
  void correct();
  dealii::Vector<double> local_load(unsigned int cell) const;
  std::vector<std::vector<dealii::types::global_dof_index>>
  face_dofs(const ContactDofFace<3> &face) const;
  BoxModes trace_of(const DistributedVector &of_vector,
                    const std::vector<dealii::types::global_dof_index> &dofs) const;
  BoxModes slip_trace(const std::vector<dealii::types::global_dof_index> &dofs) const;
  std::vector<unsigned int> coarse_first() const;
  std::vector<bool> held() const;
  BoxModes violation(const ContactDofFace<3> &face, unsigned int component) const;
  BoxModes gaps_at_nodes(const ContactDofFace<3> &face) const;
  void set_above();
  void correct_along(const ContactDofFace<3> &face, unsigned int c,
                     const std::vector<bool> &is_held);
  double constrained_value(dealii::types::global_dof_index dof,
                           const DistributedVector &of_vector) const;
  void set_trace(const std::vector<dealii::types::global_dof_index> &dofs, double sign,
                 BoxModes &coefficients, DistributedVector &of_vector) const;
  void set_constrained(DistributedVector &of_vector) const;
  double gap(const ContactDofFace<3> &face, const ContactTractions &contact);

  bool couples(const ContactDofFace<3> &face) const;
  void join_directions();
  std::vector<bool> zones() const;
  std::string in_words(const std::vector<bool> &zones) const;
  std::vector<ContactVector<3>> couplings(const PrimalSpace<3> &at,
                                          const std::vector<bool> &zones) const;
  double coupling_of(unsigned int degree, const std::vector<bool> &zones);
  double coupling(const std::vector<bool> &zones);
  std::set<dealii::types::global_dof_index> without_lift() const;
  std::string unbounded(const std::vector<bool> &zones) const;
  std::vector<double> against(unsigned int face, const std::vector<double> &points) const;
  bool is_supported(dealii::types::global_dof_index dof) const;
  std::optional<dealii::Point<3>> jump_of_coefficient(const std::vector<bool> &zones) const;
  std::optional<std::vector<BoxModes>> bumps(DistributedVector &X) const;
  std::vector<double> heights_of(const std::vector<std::vector<double>> &needed,
                                 unsigned int n_points) const;
  double energy_norm(const DistributedVector &of_vector) const;
  double coulomb_gap(const std::vector<BoxModes> &bumps) const;
  double closed_forms(const std::vector<bool> &zones) const;
  double coupled_bound(ErrorBound &result, const std::vector<bool> &zones, double A, double b);
  void set_coulomb(ErrorBound &result, double A, double b);

  const PrimalSpace<3> &space;
  NewtonMatrix<3> &matrix;
  const DistributedVector &u;
  const std::vector<ContactVector<3>> &lambda;
  const double work_of_rule; ///< L(u_N) by the points of the discrete problem
  const unsigned int p;
  const Representations of;
  const std::vector<unsigned int> numbering;
  const BoxStiffness<3> stiffness;
  std::vector<Cell> cells;
  std::vector<BoxModes> forces;
  BoxEquilibration::Sides sides;
  std::vector<ContactTractions> contact;     ///< by face of the space
  std::vector<std::array<double, 7>> missed; ///< |F - Pi F|, |G - Pi G| by cell
  std::vector<double> moved, gaps;           ///< |w|_K^2 and gap(u_N - w) by cell
  std::vector<double> face_gaps;             ///< the second by face of the space
  DistributedVector w;
  double change = 0;   ///< J(u_N - w) - J(u_N)
  double work = 0;     ///< L(u_N)
  double of_rules = 0; ///< by how much rules differ in these
  double above = 0;    ///< what polynomials through nodes of gaps are above them at most [length]
  std::string flaw;
};
} // namespace hpvi

#endif
