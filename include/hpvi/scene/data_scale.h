// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_data_scale_h
#define hpvi_data_scale_h

namespace hpvi
{
template <int dim>
struct Scene;

/** Squares of lengths, stresses and displacements, and their products, must not over- or underflow. */
constexpr double smallest_magnitude = 1e-100, largest_magnitude = 1e100;

/**
 * Magnitudes of what a scene prescribes, its loads and displacements: what is below round-off of them
 * is zero. In a load history those of all load steps so far.
 */
struct DataScale
{
  double stress = 0;       ///< of tractions and of body forces times the size of the body
  double displacement = 0; ///< of prescribed displacements, interference and past slip [length]
};

/**
 * The largest magnitudes of what @p scene prescribes, at points all over its body and boundaries, and of
 * Scene::past_data. Either stands for the other: a stress strains the body over its whole size, and a
 * displacement stresses it. Bounds of friction and gaps that are open drive nothing and do not count.
 */
template <int dim>
DataScale data_scale(const Scene<dim> &scene);

/** Tractions and displacements below this part of data_scale() are round-off of the data. */
constexpr double round_off_of_data = 1e-12;

/** Two conditions on a displacement that differ by no more agree [length]. */
template <int dim>
double support_tolerance(const Scene<dim> &scene);

/**
 * The scene of load step @p number of the history of @p scene, after load steps whose data are @p past. Values of
 * loads, prescribed displacements and gaps that are round-off beside the data so far, as of `sin(pi*t)` for t = 1,
 * are 0, and so is what is too small to be squared.
 */
template <int dim>
Scene<dim> load_step(const Scene<dim> &scene, unsigned int number, const DataScale &past);
} // namespace hpvi

#endif
