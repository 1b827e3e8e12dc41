// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/checks/checks.h>
#include <hpvi/reader/checks/rejection.h>

#include <fstream>

namespace hpvi
{
namespace
{
/** A reference solution holds the entries of its problem, for those who compare with it. */
template <int dim>
void check_reference(const Scene<dim> &scene)
{
  if (!scene.parameters && (scene.output.reference || !scene.reference_solution.empty()))
    fail(printable(scene.name),
         scene.output.reference ? "Output/Reference solution" : "Error/Reference solution",
         "compares the entries of two files, and this scene has none; read it from a file");
  if (!scene.reference_solution.empty() && !std::ifstream(scene.reference_solution))
    reject(scene, "Error", "Reference solution",
           "cannot be read; make the file by a run with Output/Reference solution = "
           "true, or leave the entry empty");
}

/** What the plane alone offers. */
void check_space(const Scene<3> &scene, const SceneUse use)
{
  if (scene.solver.path == SolutionPath::reduced)
    reject(scene, "Solver", "Path", "is not offered in space; set auto or primal", "reduced");
  if (use == SceneUse::measure)
    throw InputError(printable(scene.origin(), 400) +
                     ": Dimension = 3: the inf-sup constant is measured in the plane alone; remove "
                     "--inf-sup");
  check_primal_path(scene);
}
} // namespace

template <int dim>
void check(const Scene<dim> &scene, const SceneUse use)
{
  if constexpr (dim == 3)
    check_space(scene, use);
  if (scene.has_load_history())
    check_load_history(scene, use);
  check_bodies(scene);
  check_body(scene);
  check_material_places(scene);
  check_axisymmetry(scene);
  check_boundaries(scene);
  check_supports(scene);
  check_pretensions(scene);
  scene.free_motions();
  check_exact_solution(scene);
  check_reference(scene);
  check_probes(scene);
  check_tolerance_column(scene);
  check_method(scene, use);
  if (scene.solver.path == SolutionPath::primal && use == SceneUse::solve)
    check_primal_path(scene);
}

template void check(const Scene<2> &, SceneUse);
template void check(const Scene<3> &, SceneUse);
} // namespace hpvi
