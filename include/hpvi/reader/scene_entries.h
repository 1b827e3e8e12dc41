// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_scene_entries_h
#define hpvi_scene_entries_h

#include <hpvi/reader/input/parameters.h>
#include <hpvi/reader/user_names.h>

#include <algorithm>
#include <string>
#include <vector>

namespace hpvi
{
/** In the order of the enumerators of Method. */
inline const std::vector<std::string> method_names = {
    "hup2", "hup3", "hup4", "hap2", "hap3", "hap4", "pu", "hpa1", "hpa2", "hpa3", "hpa4"};

/** In the order of the enumerators of SmoothnessReading, Indicator, QpSolver, Contact, NormalContact,
    CoulombMethod, LoadAdaptivity, SolutionPath, LinearMethod, FrictionForm. */
inline const std::vector<std::string> reading_names = {"plain", "joint"},
                                      indicator_names = {"residual", "bound"},
                                      qp_solver_names = {"mprgp", "active set"},
                                      contact_names = {"none", "bilateral", "unilateral",
                                                       "tangential"},
                                      normal_contact_names = {"multiplier", "nodes", "automatic"},
                                      coulomb_method_names = {"newton", "fixed point"},
                                      load_adaptivity_names = {"first step", "every step"},
                                      output_steps_names = {"all", "last"},
                                      path_names = {"auto", "reduced", "primal"},
                                      linear_names = {"automatic", "multigrid", "amg", "direct"},
                                      friction_law_names = {"automatic", "limited", "cohesive"};

/** The enumerator whose name is the value of an entry. */
template <class Enum>
Enum read_choice(const Parameters &parameters, const std::string &section, const std::string &name,
                 const std::vector<std::string> &names)
{
  const auto found = std::find(names.begin(), names.end(), parameters.text(section, name));
  return static_cast<Enum>(found - names.begin());
}

/**
 * Calls `visit(section, entry, member)` for each number and each switch of a scene that one entry
 * sets as it stands, so that reader and check have them from one list.
 */
template <class Scene, class Visitor>
void for_each_value(Scene &scene, const Visitor &visit)
{
  visit("Geometry", "Grading levels", scene.geometry.grading_levels);
  auto &adaptivity = scene.adaptivity;
  visit("Adaptivity", "Maximum degree", adaptivity.maximum_degree);
  visit("Adaptivity", "Start degree", adaptivity.start_degree);
  visit("Adaptivity", "hap threshold", adaptivity.hap_threshold);
  visit("Adaptivity", "hpa1 bisected fraction", adaptivity.hpa1_bisected);
  visit("Adaptivity", "hpa1 raised fraction", adaptivity.hpa1_raised);
  visit("Adaptivity", "hpa2 marked fraction", adaptivity.hpa2_marked);
  visit("Adaptivity", "hpa2 decay threshold", adaptivity.hpa2_decay);
  visit("Adaptivity", "hpa3 threshold", adaptivity.hpa3_threshold);
  visit("Adaptivity", "hpa3 decay threshold", adaptivity.hpa3_decay);
  visit("Adaptivity", "Maximum steps", adaptivity.maximum_steps);
  visit("Adaptivity", "Maximum unknowns", adaptivity.maximum_unknowns);
  visit("Adaptivity", "Maximum seconds", adaptivity.maximum_seconds);
  visit("Adaptivity", "Tolerance", adaptivity.tolerance);
  constexpr bool in_plane = std::tuple_size_v<decltype(scene.body_force)> == 2;
  auto &solver = scene.solver;
  visit("Solver", "Primal tolerance", solver.primal_tolerance);
  if (in_plane)
  {
    visit("Solver", "QP warm start", solver.qp_warm_start);
    visit("Solver", "QP tolerance", solver.qp_tolerance);
    visit("Solver", "QP maximum multiplications", solver.qp_maximum_multiplications);
    visit("Solver", "Diagonal scaling", solver.diagonal_scaling);
    visit("Solver", "Check uniqueness", solver.check_uniqueness);
    visit("Solver", "Threads", solver.threads);
  }
  visit("Solver", "Multiplier degree offset", solver.multiplier_offset);
  visit("Solver", "Condition number", solver.condition_number);
  auto &output = scene.output;
  visit("Output", "VTU", output.vtu);
  visit("Output", "Contact tables", output.contact);
  visit("Output", "Reference solution", output.reference);
}

/** What is wrong with a bound or a direction where there is no contact, and with a gap where none can open. */
inline const std::string friction_needs_contact =
                             "needs contact; set Contact = bilateral, unilateral or tangential, or "
                             "remove it",
                         gap_needs_contact =
                             "needs contact that can open; set Contact = unilateral or remove it",
                         direction_needs_contact =
                             "needs contact that is measured along it; set Contact = bilateral, "
                             "unilateral or tangential, or remove it";

/**
 * All entries of a scene file in the order in which they are printed: names, defaults, admissible
 * values and documentation. @p names are those that the scene gives to sections of its own.
 */
std::vector<Entry> scene_entries(int dim, const UserNames &names);

/** @p text about a scene in the plane, for one in space: x, y and z, and components of three. */
std::string in_space(std::string text);
} // namespace hpvi

#endif
