// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_grid_cuts_h
#define hpvi_grid_cuts_h

#include <hpvi/scene/scene.h>

#include <string>
#include <vector>

namespace hpvi
{
/** Adds grid lines at @p places of the unit cube across @p direction, which @p path asks for, and a remark that says so. */
template <int dim>
void add_lines(Scene<dim> &scene, unsigned int direction, const std::vector<double> &places,
               const std::string &path);

/**
 * Adds to the coarse mesh of a box the grid lines that it lacks where @p where, of the entry @p path, changes
 * its sign along the side number @p side, and a remark that says so. Other shapes stay as they are.
 */
template <int dim>
void cut_side(Scene<dim> &scene, unsigned int side, const Expression<dim> &where,
              const std::string &path);

/** The same all over the body, where @p where changes its sign along straight grid lines. */
template <int dim>
void cut_body(Scene<dim> &scene, const Expression<dim> &where, const std::string &path);
} // namespace hpvi

#endif
