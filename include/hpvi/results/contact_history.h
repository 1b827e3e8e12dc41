// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_contact_history_h
#define hpvi_contact_history_h

#include <hpvi/results/contact_state.h>

#include <array>
#include <vector>

namespace hpvi
{
/** What has happened at a point of contact at the ends of the load steps so far; it slips where ContactMode::slip. */
struct PointHistory
{
  std::array<double, 3> x{}; ///< in the plane the last one is 0
  double face_length = 0;    ///< ContactPoint::face_length
  double pressure = 0;       ///< the largest max(0, -T_n) [stress]
  double shear = 0;          ///< the largest |T_t| [stress]
  double tension = 0;    ///< the largest ContactPoint::surface_stress, 0 where none pulls [stress]
  double path = 0;       ///< int |ds| [length], s the slip: the sum over load steps that slip
  double dissipated = 0; ///< int -T_t . ds, with T_t at the end of each load step [stress length]
  double rubbed = 0;     ///< int max(0, -T_n) |ds| likewise: Archard's wear without its coefficient
  double open = 0;       ///< how long it is open, in t
  std::array<double, 3> slip{}, lowest{}, highest{}; ///< int ds; in the plane its first component
  std::array<double, 3> jump{};                      ///< ContactPoint::tangential_jump, likewise

  double slip_range() const; ///< delta = |highest - lowest| [length]

  /** All but the place. */
  std::array<double *, 20> numbers();
};

/** Of one contact, in the order of ContactState::points. */
struct ContactHistory
{
  unsigned int boundary; ///< ContactState::boundary
  std::vector<PointHistory> points;
};

/**
 * Adds a load step of @p scene that is over and lasts @p dt to @p histories. Where its points are others than those before, what these know is
 * carried over along straight lines between neighbours, in space from the nearest one.
 */
template <int dim>
void add_load_step(const Scene<dim> &scene, const std::vector<ContactState<dim>> &contact,
                   double dt, std::vector<ContactHistory> &histories);
} // namespace hpvi

#endif
