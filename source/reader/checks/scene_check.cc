// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/checks/checks.h>
#include <hpvi/reader/checks/rejection.h>
#include <hpvi/reader/checks/supports.h>

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
void Scene<dim>::check(const SceneUse use) const
{
  if constexpr (dim == 3)
    check_space(*this, use);
  if (has_load_history())
    check_load_history(*this, use);
  check_bodies(*this);
  check_body();
  check_material_places(*this);
  check_axisymmetry(*this);
  check_boundaries(*this);
  check_supports(*this);
  free_motions();
  check_exact_solution(*this);
  check_reference(*this);
  check_probes(*this);
  check_tolerance_column(*this);
  check_method(*this, use);
  if (solver.path == SolutionPath::primal && use == SceneUse::solve)
    check_primal_path(*this);
}

template void Scene<2>::check(SceneUse) const;
template void Scene<3>::check(SceneUse) const;
} // namespace hpvi
