// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_space_motion_h
#define hpvi_space_motion_h

#include <hpvi/scene/scene.h>

#include <string>
#include <vector>

namespace hpvi
{
/** What strains nothing in space: `translation + rotation x (x - centre)`. */
struct SpaceMotion
{
  dealii::Tensor<1, 3> translation; ///< dimensionless
  dealii::Tensor<1, 3> rotation;    ///< [1/length]
  dealii::Point<3> centre;

  dealii::Tensor<1, 3> at(const dealii::Point<3> &x) const;

  /** Where it turns about an axis and goes along it by less than a tenth, "about an axis along (0 0 1) through (1 0 0)"; else "along (1 0 0)". */
  std::string in_words() const;

  bool turns() const; ///< by these words?

  /** @p factor times @p other, of the same centre, is added. */
  void add(double factor, const SpaceMotion &other);
};

constexpr unsigned int most_free_motions = 24; ///< of all bodies together

/** One of each body, with one centre; a single one where there are no several. */
using BodyMotions = std::vector<SpaceMotion>;

/**
 * A basis of the motions, up to six of each body, that supports and ties of @p scene leave free: contact alone resists them.
 * Throws InputError where nothing does.
 */
std::vector<BodyMotions> free_motions_in_space(const Scene<3> &scene);

/** Are there any? In the plane the primal path asks for supports. */
template <int dim>
bool rests_on_contact(const Scene<dim> &scene);
} // namespace hpvi

#endif
