// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_checks_h
#define hpvi_checks_h

#include <hpvi/scene/scene.h>

#include <optional>
#include <string>

namespace hpvi
{
/** Throws InputError, one line with entry, value and remedy, for what no stage could make sense of: all that follows. */
template <int dim>
void check(const Scene<dim> &scene, SceneUse use = SceneUse::solve);

/** Of check() the part on which functions rely that are tried on the body: its shape and materials. */
template <int dim>
void check_body(const Scene<dim> &scene);

/**
 * Loads, displacements, gaps and friction are finite, can be squared and stand where they mean something.
 * What two boundaries say of a point they share is check_supports().
 */
template <int dim>
void check_boundaries(const Scene<dim> &scene);

/** Where two boundaries meet their conditions can hold together, and `u_n <= u_0` with them. */
template <int dim>
void check_supports(const Scene<dim> &scene);

/** Parts of sides are made of whole faces of the coarse mesh, of one at least, and do not overlap. */
template <int dim>
void check_parts(const Scene<dim> &scene);

/** Materials that a file says Where they are fill whole cells of the coarse mesh, one at least. */
template <int dim>
void check_material_places(const Scene<dim> &scene);

/** Loads, supports and contact are those of Scene::exact_solution, where there is one. */
template <int dim>
void check_exact_solution(const Scene<dim> &scene);

/** check() of each load step of a history, and what a history cannot have. */
template <int dim>
void check_load_history(const Scene<dim> &scene, SceneUse use);

/** An axisymmetric body lies at x >= 0, its axis has u_x = 0 alone, and it asks for nothing that only the plane offers. */
template <int dim>
void check_axisymmetry(const Scene<dim> &scene);

/** Numbers are those that a file may say, and the method, its degrees and its multipliers fit. */
template <int dim>
void check_method(const Scene<dim> &scene, SceneUse use);

/** Bolts are pulled, and nothing acts along the sides of the cells that are shortened. */
template <int dim>
void check_pretensions(const Scene<dim> &scene);

/** Probes lie in the body, and their columns have names of their own. */
template <int dim>
void check_probes(const Scene<dim> &scene);

/** Adaptivity::tolerance_column is a number of this scene that may have an interval. */
template <int dim>
void check_tolerance_column(const Scene<dim> &scene);

/** Several bodies ask for nothing that is offered for one alone. */
template <int dim>
void check_bodies(const Scene<dim> &scene);

/** An entry whose value is not on offer, as reject() takes it. */
struct Objection
{
  std::string section, name, problem_and_remedy, value{};
};

/** The first entry of @p scene that the primal path does not offer, free motions aside. */
template <int dim>
std::optional<Objection> objection_to_primal_path(const Scene<dim> &scene);

/** @p scene asks for nothing that the primal path does not offer. */
template <int dim>
void check_primal_path(const Scene<dim> &scene);
} // namespace hpvi

#endif
