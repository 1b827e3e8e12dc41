// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_body_reader_h
#define hpvi_body_reader_h

#include <hpvi/reader/user_names.h>
#include <hpvi/scene/scene.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hpvi
{
class Parameters;

/**
 * Takes shape, materials and parts of sides from @p parameters, checks the body, and gives the coarse mesh of a box
 * the grid lines at which materials and parts end.
 */
template <int dim>
void read_body(const Parameters &parameters, const UserNames &names, Scene<dim> &scene);

/** The entry `Where` of @p section, tried at @p points: what says where something is knows neither time nor material. */
template <int dim>
Expression<dim> read_where(const Parameters &parameters, const std::string &section,
                           const std::vector<dealii::Point<dim>> &points);

/** What expressions may use where the body is of @p material: E, nu, mu and pi, the time @p t in a load history. */
std::map<std::string, double> constants_of(const Material &material, std::optional<double> t);

/** Why E, nu and mu are not among them, for messages; empty: they are. */
std::string remark_on_constants(const Material &material);

/** The materials of the cells along a boundary, by index. */
template <int dim>
std::vector<unsigned int> materials_along(const Scene<dim> &scene,
                                          const BoundaryCondition<dim> &boundary);
} // namespace hpvi

#endif
