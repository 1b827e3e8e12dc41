// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_scene_words_h
#define hpvi_scene_words_h

#include <hpvi/output/boundary_words.h>

#include <deal.II/grid/tria.h>

#include <cstddef>
#include <set>

namespace hpvi
{
/** The unit of a body force, as in "kN/m^2/m"; empty where one of both has no name. */
template <int dim>
std::string body_force_unit(const Scene<dim> &scene);

/** @p scene itself; of a load history its last load step, at t = 1, where round-off is 0. */
template <int dim>
Scene<dim> at_the_end(const Scene<dim> &scene);

/** As in "Young's modulus 200 MPa, Poisson's ratio 0.3, plane strain". */
template <int dim>
std::string material_in_words(const Scene<dim> &scene, const Material &material);

/** As in "material", "material steel"; the unnamed one of a file with several is "material elsewhere". */
template <int dim>
std::string name_in_words(const Scene<dim> &scene, std::size_t number);

/** Those that cells have: where all are named, none has the unnamed one. */
template <int dim>
std::set<std::size_t> materials_of(const Scene<dim> &scene, const dealii::Triangulation<dim> &mesh);

/**
 * What a scene says, a line each: body, materials, each boundary that is not free, the resultant of all loads. Throws
 * InputError where an expression has no value.
 */
template <int dim>
std::string scene_in_words(const Scene<dim> &scene);

/** The resultant of all loads by the rule of the path that solves, a line. Throws InputError where one is no number. */
template <int dim>
std::string resultant_in_words(const Scene<dim> &scene, bool is_primal);
} // namespace hpvi

#endif
