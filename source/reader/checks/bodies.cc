// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/text.h>
#include <hpvi/reader/checks/checks.h>
#include <hpvi/reader/checks/rejection.h>

namespace hpvi
{
/** What several bodies do not offer. */
template <int dim>
void check_bodies(const Scene<dim> &scene)
{
  if (scene.geometry.bodies.empty())
    return;
  const std::string bodies = "of several bodies is not offered; ";
  if (dim == 2 && scene.solver.path == SolutionPath::primal)
    reject(scene, "Solver", "Path", "in a scene " + bodies + "set auto or reduced", "primal");
  if (scene.solver.normal_contact == NormalContact::nodes)
    reject(scene, "Solver", "Normal contact",
           "in a scene " + bodies + "set multiplier, whose moments bodies hand over", "nodes");
  if (scene.exact_solution)
    reject(scene, "Exact solution", "Solution", "in a scene " + bodies + "set none");
  if (scene.solver.multiplier_offset != -2)
    reject(scene, "Solver", "Multiplier degree offset",
           "in a scene " + bodies + "set -2 or remove it",
           std::to_string(scene.solver.multiplier_offset));
}

template void check_bodies(const Scene<2> &);
template void check_bodies(const Scene<3> &);
} // namespace hpvi
