// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_slip_direction_h
#define hpvi_slip_direction_h

#include <hpvi/bound/admissible_contact.h>

#include <functional>
#include <string>
#include <vector>

namespace hpvi
{
/** chi at s in [0,1] of each contact face; null where no friction knows the pressure. Continuous along contact that has no corner. */
using SlipDirection = std::vector<std::function<double(double)>>;

/**
 * chi with `tau = (g + mu_f pi) chi` of an admissible friction: l* where pi presses or g acts. Along faces that are open it goes on,
 * linearly from vertex to vertex between what it is at both ends of the open part; at each vertex as little off that as makes
 * `mu_f (|U_t| - chi U_t) <= u_0 - U_n` there. @p contact must outlive it.
 */
SlipDirection slip_direction(const Solution<2> &solution, const AdmissibleContact &contact);

/**
 * What a bound may assume of the solution beside Coulomb's law: it sticks on `sticks`, faces that stick at all of their points
 * beside neighbours that do, or do at those of the nearer half, and slips elsewhere in the direction chi' = 1 or -1 alone.
 */
struct SlipZones
{
  std::vector<bool> sticks; ///< by contact face
  SlipDirection direction;  ///< chi'; 0 on `sticks`
  std::string
      words; ///< "bottom sticks from (1, 0) to (2, 0), and slips elsewhere only as computed"
  bool contradicts = false; ///< do opposite slips meet with no `sticks` between?
};
SlipZones slip_zones(const Solution<2> &solution, const AdmissibleContact &contact);
} // namespace hpvi

#endif
