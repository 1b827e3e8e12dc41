// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_bodies_reader_h
#define hpvi_bodies_reader_h

#include <hpvi/reader/user_names.h>
#include <hpvi/scene/scene.h>

#include <optional>
#include <vector>

namespace hpvi
{
class Parameters;
struct Entry;

/** The entries of `Body NAME` and of `Contact NAME`. */
std::vector<Entry> body_entries(int dim, const std::string &name);
std::vector<Entry> pair_entries(const std::string &name);

/**
 * Takes the bodies and the pairs of sides that touch: @p scene gets the geometry, a boundary of each side, and behind them
 * of each pair the two parts of its sides that face each other, where grid lines of boxes are added if they end between two.
 */
void read_bodies(const Parameters &parameters, const UserNames &names, Scene<2> &scene);
void read_bodies(const Parameters &parameters, const UserNames &names, Scene<3> &scene);

/** Where @p part of a side is, without what pairs that name it take; null: they take it all. */
template <int dim>
Expression<dim> rest_of_part(const Parameters &parameters, const Scene<dim> &scene,
                             const BoundaryCondition<dim> &part);

/** Rejects what is said of a side, or a part of one, of which other bodies take all. */
template <int dim>
void check_covered_sides(const Parameters &parameters, const Scene<dim> &scene);

/** Of each body the material that it names, by surface of the mesh. */
template <int dim>
std::vector<std::optional<dealii::types::material_id>>
materials_of_bodies(const Parameters &parameters, const Scene<dim> &scene);

/** The law of the pair to which @p part belongs, in it; @p t is the time, if there is one. */
template <int dim>
void read_pair(const Parameters &parameters, std::optional<double> t, const Scene<dim> &scene,
               BoundaryCondition<dim> &part);
} // namespace hpvi

#endif
