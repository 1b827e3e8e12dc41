// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_contact_state_h
#define hpvi_contact_state_h

#include <hpvi/discretisation/solution.h>

#include <string>
#include <vector>

namespace hpvi
{
/** How near to 1 |lambda| counts as slip: solvers put what slips on the wall up to round-off. */
constexpr double slip_tolerance = 1e-8;

/** What the foundation does at a point. */
enum class ContactMode
{
  open, ///< unilateral contact without pressure; friction of Tresca acts all the same
  slip, ///< |lambda| = 1 or g = 0
  stick
};

std::string mode_name(ContactMode mode); ///< open, slip, stick

/** What u_N, z_N do at one Gauss point of the contact boundary. Tractions are the contact's alone. */
template <int dim>
struct ContactPoint
{
  dealii::Point<dim> x;
  double face_length;    ///< of the face that it lies on
  double friction_bound; ///< g [stress], 0 on a face without multipliers
  double lambda;         ///< z_N/g, 0 where g is, dimensionless
  bool slips;            ///< |lambda| = 1 or g = 0
  bool is_open; ///< no pressure acts: of the multiplier here, or of the nodes on both sides
  double gap;   ///< u_0 - u_n of unilateral contact [length], else -u_n
  double normal_displacement, tangential_displacement; ///< u_n, u_t [length]
  /**
   * T_n [stress], positive where it pulls: -lambda_n where contact has a multiplier for it, else
   * n.(sigma(u_N) n - G).
   */
  double normal_traction;
  double tangential_traction; ///< T_t = -z_N [stress]
  double slip;                ///< u_t, in a load history less that of the load step before [length]

  ContactMode mode() const
  {
    return is_open ? ContactMode::open : slips ? ContactMode::slip : ContactMode::stick;
  }
};

/** A part of a contact boundary in one mode, along the tangent. */
template <int dim>
struct ContactZone
{
  ContactMode mode;
  dealii::Point<dim> begin, end;
};

/** What happens on one contact boundary. */
template <int dim>
struct ContactState
{
  dealii::types::boundary_id boundary = 0;
  double length = 0;
  /** Face by face along the tangent; a face without multipliers has one. */
  std::vector<ContactPoint<dim>> points;
  /**
   * Where u_N changes between open, stick and slip or turns its slip around: halfway between neighbouring
   * points whose states differ, along the tangent.
   */
  std::vector<dealii::Point<dim>> transitions;
  std::vector<ContactZone<dim>> zones; ///< between the ends of the boundary, no two alike in a row
  double normal_resultant = 0;         ///< int T_n [stress length^(dim-1)]
  double friction_resultant = 0;       ///< int T_t = -int z_N, likewise
  dealii::Tensor<1, dim> friction_force; ///< int T_t t, likewise
  double absolute_friction = 0;          ///< int |T_t|, likewise
  double open_friction = 0;              ///< that part of it where contact is open
  double tension = 0;                    ///< int max(T_n, 0), likewise
  double highest_tension = 0;            ///< max(T_n, 0) [stress]
  dealii::Point<dim> highest_tension_point;
  double highest_pressure = 0; ///< max(-T_n, 0) [stress]
  dealii::Point<dim> highest_pressure_point;
  /** max(u_n - u_0, 0) [length]; |u_n| where a multiplier holds u_n = 0. */
  double deepest_penetration = 0;
  dealii::Point<dim> deepest_penetration_point;
};

/** Of each contact boundary, by id. */
template <int dim>
std::vector<ContactState<dim>> contact_states(const Solution<dim> &solution);

/** Those of all boundaries, one after the other. */
template <int dim>
std::vector<dealii::Point<dim>> transitions(const std::vector<ContactState<dim>> &states);
} // namespace hpvi

#endif
