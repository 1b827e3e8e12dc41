// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_nearest_force_h
#define hpvi_nearest_force_h

#include <deal.II/base/tensor.h>

#include <optional>

namespace hpvi
{
constexpr unsigned int most_equations = 24; ///< three of each of eight bodies, six of one in space

/** Forces and moments along motions, in units in which they compare; those that there are not are 0. */
using Force = dealii::Tensor<1, most_equations>;

/** A closed convex set of forces, known by what is farthest in it along a motion. */
class ForceSet
{
public:
  virtual ~ForceSet() = default;

  /** The farthest one, or a unit vector along which they have no end. */
  struct Extreme
  {
    Force place;
    bool is_ray;
  };
  virtual Extreme farthest(const Force &motion) const = 0;

  virtual Force start() const = 0; ///< any of them
  virtual unsigned int n_equations() const = 0;
};

/** Why no force of a set is e. */
struct Separation
{
  Force motion;
  double load;       ///< `motion.e`
  double resistance; ///< the largest `motion.x` in the set, less than the load
};

/**
 * Nothing where the set holds e to @p negligible of it. Otherwise the residual of the nearest point, which separates e from
 * the set. Of a set that is no polyhedron the nearest point is found in the limit, and what lies nearer than the method gets
 * counts as inside.
 */
std::optional<Separation> separate(const ForceSet &set, const Force &e, double negligible = 1e-12);
} // namespace hpvi

#endif
