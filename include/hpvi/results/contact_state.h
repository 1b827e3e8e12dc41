// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_contact_state_h
#define hpvi_contact_state_h

#include <hpvi/results/field.h>

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

/** What u_N, z_N do at one point of the contact boundary where multipliers have their values. Tractions are the contact's alone. */
template <int dim>
struct ContactPoint
{
  dealii::Point<dim> x;
  double area = 0;           ///< that it stands for, of a quadrature rule [length^(dim-1)]
  double face_length = 0;    ///< of the face that it lies on; in space the root of its area
  double friction_bound = 0; ///< g [stress], 0 on a face without multipliers
  Tangential<dim> lambda{};  ///< z_N/g, 0 where g is, dimensionless
  bool slips = true;         ///< |lambda| = 1 or g = 0
  bool is_open = false; ///< no pressure acts: of the multiplier here, or of the nodes on both sides
  double gap = 0; ///< u_0 - u_n of unilateral contact [length], else -u_n; of jumps between bodies
  double normal_displacement = 0;            ///< u_n [length], of two bodies that of the first side
  Tangential<dim> tangential_displacement{}; ///< u_t [length], likewise
  double normal_jump = 0;                    ///< [u]_n between bodies, else u_n [length]
  Tangential<dim> tangential_jump{};         ///< [u]_t likewise
  /**
   * T_n [stress], positive where it pulls: -lambda_n where contact has a multiplier for it, else
   * n.(sigma(u_N) n - G).
   */
  double normal_traction = 0;
  Tangential<dim> tangential_traction{}; ///< T_t = -z_N [stress]
  Tangential<dim> slip{}; ///< [u]_t, in a load history less that of the load step before [length]
  /** The largest stress along the surface of the body with the multipliers, in the plane t . sigma(u_N) t [stress]. */
  double surface_stress = 0;

  ContactMode mode() const
  {
    return is_open ? ContactMode::open : slips ? ContactMode::slip : ContactMode::stick;
  }

  template <class Archive>
  void serialize(Archive &archive, unsigned int)
  {
    archive &x &area &face_length &friction_bound &lambda &slips &is_open &gap &normal_displacement
        &tangential_displacement &normal_jump &tangential_jump &normal_traction &tangential_traction
            &slip &surface_stress;
  }
};

/** A part of a contact boundary in one mode, along the tangent. */
template <int dim>
struct ContactZone
{
  ContactMode mode;
  dealii::Point<dim> begin, end;
  double
      length; ///< from one to the other, along edges that turn by what their points stand for [length]
};

/** Edges of a contact boundary in the plane, each of which begins where the one before ends. */
template <int dim>
struct ContactChain
{
  dealii::Point<dim> begin, end;
  unsigned int first_point, last_point; ///< of ContactState::points; the last one is not its own

  template <class Archive>
  void serialize(Archive &archive, unsigned int)
  {
    archive &begin &end &first_point &last_point;
  }
};

/** What happens on one contact boundary. */
template <int dim>
struct ContactState
{
  dealii::types::boundary_id boundary =
      0;                                ///< of two bodies the first of `Between`, whose frame it is
  dealii::types::boundary_id slave = 0; ///< that with the multipliers: the same, or the other one
  double area = 0;                      ///< [length^(dim-1)]: in the plane its length
  double open_area = 0;                 ///< of points in this mode, likewise
  double slipping_area = 0;             ///< likewise
  dealii::Point<dim> begin, end;        ///< in the plane its ends, along the tangent
  /**
   * In the plane along the tangent, in space by x, y, z; a face without multipliers has one in each direction.
   * On the first process alone, as transitions and zones, which are those of the plane.
   */
  std::vector<ContactPoint<dim>> points;
  /**
   * Where u_N changes between open, stick and slip or turns its slip around: halfway between neighbouring
   * points whose states differ, along the tangent.
   */
  std::vector<dealii::Point<dim>> transitions;
  std::vector<ContactZone<dim>>
      zones; ///< between the ends of each piece, no two alike in a row there
  std::vector<ContactChain<dim>> chains; ///< in the plane, of this process
  double normal_resultant = 0;           ///< int T_n [stress length^(dim-1)]
  Tangential<dim> friction_resultant{};  ///< int T_t = -int z_N, likewise
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

  template <class Archive>
  void serialize(Archive &archive, unsigned int)
  {
    archive &boundary &slave &area &open_area &slipping_area &begin &end &chains &normal_resultant
        &friction_resultant &friction_force &absolute_friction &open_friction &tension
            &highest_tension &highest_tension_point &highest_pressure &highest_pressure_point
                &deepest_penetration &deepest_penetration_point;
  }
};

/** Of each contact boundary, by id, over all processes. Collective. */
template <int dim>
std::vector<ContactState<dim>> contact_states(const Field<dim> &field);

/** Those of all boundaries, one after the other. */
template <int dim>
std::vector<dealii::Point<dim>> transitions(const std::vector<ContactState<dim>> &states);
} // namespace hpvi

#endif
