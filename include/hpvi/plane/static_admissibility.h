// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_static_admissibility_h
#define hpvi_static_admissibility_h

#include <hpvi/plane/contact_space.h>

#include <optional>
#include <string>
#include <vector>

namespace hpvi
{
/** Motions R that strain nothing and that no support resists, and the loads L(R) along them. */
template <int dim>
struct LoadedMotions
{
  std::vector<RigidBodyMotion<dim>> motions; ///< independent, with one centre
  dealii::Vector<double> loads;              ///< 0 where round-off is all there is
  unsigned int n_seen;  ///< how many of them, the first ones, the multiplier of the mesh sees
  double thickness = 1; ///< of the body [length], by which forces in words are multiplied

  unsigned int n_bodies() const
  {
    return 1 + motions.front().others.size();
  }

  /** L(R) of any motion; nothing where supports resist it. */
  std::optional<double> along(const RigidBodyMotion<dim> &motion) const;

  /** The sum of the motions times @p coefficients. */
  RigidBodyMotion<dim> sum(const dealii::Vector<double> &coefficients) const;
};

/**
 * Whether contact can hold a body against its loads, on whatever mesh: its pressures act at any point of
 * their boundary, its friction carries int g. Rigid motions are linear along a straight boundary, so that
 * two pressures at its ends do all that any others do; under Coulomb's law with a coefficient that varies
 * the points between count as well, eight on each face and those of the multiplier. Throws
 * NumericalFailure, with the motion that sets in and its numbers, where contact cannot.
 */
template <int dim>
void require_static_admissibility(const ContactSpace<dim> &contact_space,
                                  const LoadedMotions<dim> &loaded);

/** What the multiplier of a mesh lacks to hold a body that contact could hold. */
struct InadmissibleContact
{
  std::vector<unsigned int> cells; ///< active cells with the points that would resist; may be none
  std::string why;                 ///< for the one who gives up
};

/** Nothing where the multiplier has a value that balances the loads. */
template <int dim>
std::optional<InadmissibleContact> inadmissible_contact(const ContactSpace<dim> &contact_space,
                                                        const LoadedMotions<dim> &loaded);
} // namespace hpvi

#endif
