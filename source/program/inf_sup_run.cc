// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/input_error.h>
#include <hpvi/driver/adaptive_solver.h>
#include <hpvi/program/inf_sup_run.h>
#include <hpvi/program/interruption.h>
#include <hpvi/program/terminal.h>
#include <hpvi/results/inf_sup.h>

#include <iomanip>
#include <iostream>

namespace hpvi
{
namespace
{
void print_inf_sup_row(const StepReport<2> &step, const InfSup &inf_sup)
{
  const DisplacementSpace<2> &space = step.solution().displacement_space;
  std::cout << std::setw(4) << step.number << std::setw(10) << space.degrees().size()
            << std::setw(11) << space.n_free_dofs() << std::setw(12) << inf_sup.n_multipliers
            << std::setw(6) << inf_sup.lowest_degree << std::setw(6) << inf_sup.highest_degree
            << std::scientific << std::setprecision(6) << std::setw(14) << inf_sup.beta
            << std::setprecision(3) << std::setw(11) << inf_sup.bound() << std::endl;
}

/**
 * The scene whose run refines the mesh while another's multipliers are measured on it: itself, or
 * where no run could solve it the same scene with the stable multiplier, or the best its start
 * degree 1 allows.
 */
Scene<2> refining_scene(const Scene<2> &measured)
{
  Scene<2> scene = measured;
  if (scene.solver.multiplier_offset >= 0)
    scene.solver.multiplier_offset = scene.adaptivity.start_degree < 2 ? -1 : -2;
  return scene;
}

/** As in p-2, p, p+1. */
std::string multiplier_degree(const int offset)
{
  return "p" + (offset == 0 ? "" : (offset > 0 ? "+" : "") + std::to_string(offset));
}

} // namespace

void print_inf_sup(const Scene<2> &scene)
{
  if (!scene.has_friction() && !scene.has_unilateral_contact())
  {
    std::string names;
    for (const std::string &name : scene.geometry.boundary_names())
      names += (names.empty() || name.empty() ? "" : ", ") + name;
    throw InputError(scene.origin() + ": Boundary " + names +
                     "/Friction bound: no boundary "
                     "names one, so there is no multiplier to measure the inf-sup "
                     "constant of; name a contact with a bound, or a unilateral one, or remove "
                     "--inf-sup");
  }
  const Scene<2> refining = refining_scene(scene);
  AdaptiveSolver<2> solver(refining);
  note_interruptions();
  std::cout << version_line() << '\n'
            << legible(scene.title) << "\n\n"
            << "multiplier degree " << multiplier_degree(scene.solver.multiplier_offset)
            << "; p_min and p_max on the contact boundary; "
            << "bound = 1/(p_max^1/2 log^3/2 p_max)\n\n"
            << "step  elements  dofs_free multipliers p_min p_max          beta      bound"
            << std::endl;
  ProgressLine progress;
  solver.run(
      [&](const StepReport<2> &step)
      {
        progress.show({step.number, "measuring the inf-sup constant", ""});
        const DisplacementSpace<2> &space = step.solution().displacement_space;
        const InfSup inf_sup = measure_inf_sup(scene, space.triangulation(), space.degrees());
        progress.erase();
        print_inf_sup_row(step, inf_sup);
      },
      [&](const Progress &stage)
      {
        stop_if_interrupted();
        progress.show(stage);
      });
}

} // namespace hpvi
