// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/dense_algebra.h>
#include <hpvi/base/input_error.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/bound/dual_scene.h>
#include <hpvi/bound/stress_work.h>
#include <hpvi/driver/mean_intervals.h>
#include <hpvi/plane/initial_stress.h>
#include <hpvi/plane/springs.h>
#include <hpvi/results/probe_rule.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
const std::string moves = "the mean moves with a motion that contact alone resists";

bool is_held(const Scene<2> &scene)
{
  try
  {
    return scene.free_motions().empty();
  }
  catch (const InputError &)
  {
    return false;
  }
}

/** Do rules of quadrature see all of q? Each of a load that is too narrow may miss it. */
bool sees_all(const Solution<2> &solution, const Probe<2> &probe, const unsigned int component)
{
  return probe.kind != ProbeKind::disc ||
         std::abs(solution.spaces->loads->sum().force[component] - 1) < 1e-9;
}

/** Is q no displacement of V? It is prescribed then. */
bool is_zero(const Scene<2> &dual)
{
  return !dual.has_body_force() &&
         std::none_of(dual.boundaries.begin(), dual.boundaries.end(),
                      [](const BoundaryCondition<2> &boundary)
                      {
                        return boundary.has_traction() ||
                               (boundary.plate && boundary.plate->force != std::array<double, 3>{});
                      });
}

/** |w|_a where u_N is not in V + u_D but for w, as it jumps along joints that must not open, which @p of_mean has as well; else 0. */
double correction_at_joints(const Scene<2> &of_mean, const ErrorBound &bound)
{
  return of_mean.has_pairs() ? std::sqrt(std::max(0., sum(bound.moved))) : 0.;
}

/** |z_N|_a, or a little more where rules of Gauss do not give it. */
double largest_norm(const Solution<2> &z)
{
  std::vector<EnergyRule> rules;
  const std::vector<double> energies =
      largest_energies(z.scene, z.displacement_space, z.tables, z.u, rules);
  Vector<double> forces(z.u.size());
  return std::sqrt(
      std::accumulate(energies.begin(), energies.end(), 0.) +
      add_spring_forces(spring_faces(z.scene, z.displacement_space, z.tables), z.u, forces));
}

/** Is a rigid plate along a curve free to turn? Its middle is that of the drawing, and the mean has some of its turn then. */
bool turns_along_curve(const Probe<2> &probe, const Scene<2> &scene)
{
  const std::vector<Side<2>> sides = sides_of(scene);
  return std::any_of(probe.on.begin(), probe.on.end(),
                     [&](const types::boundary_id id)
                     {
                       const auto &plate = scene.boundaries[id].plate;
                       return plate && plate->is_free(2) && !sides[id].curves.empty();
                     });
}

/** Does the disc of a probe reach into cells with curved edges, on which its rule is no more than near? */
bool reaches_curves(const Probe<2> &probe, const StepReport<2> &step)
{
  for (const WeightedPoints<2> &part :
       probe_rule(probe, step.scene, step.field.dof_handler, step.field.tables))
    if (map_of<2>(part.cell).is_curved())
      return true;
  return false;
}

/** Is w zero in all cells where the probe is? */
bool is_away_from_corrections(const Probe<2> &probe, const StepReport<2> &step)
{
  for (const auto &cell : step.field.dof_handler.active_cell_iterators())
  {
    if (!(step.bound->moved[cell->active_cell_index()] > 0))
      continue;
    if (probe.kind == ProbeKind::disc &&
        cell->bounding_box().point_inside(probe.at, probe.size / cell->minimum_vertex_distance()))
      return false;
    for (const unsigned int face : cell->face_indices())
      if (probe.kind == ProbeKind::boundary && cell->at_boundary(face) &&
          std::find(probe.on.begin(), probe.on.end(), cell->face(face)->boundary_id()) !=
              probe.on.end())
        return false;
  }
  return true;
}

/** Is d zero where the probe is? It lives in cells at prescribed displacements and gaps. */
bool is_away_from_lifts(const Probe<2> &probe, const StepReport<2> &step)
{
  const ErrorBound &bound = *step.bound;
  if (bound.data == 0)
    return true;
  if (probe.kind == ProbeKind::boundary)
    return std::all_of(probe.on.begin(), probe.on.end(),
                       [&](const types::boundary_id id)
                       {
                         const BoundaryCondition<2> &boundary = step.scene.boundaries[id];
                         return !boundary.has_displacement() && !boundary.has_contact();
                       });
  for (const auto &cell : step.field.dof_handler.active_cell_iterators())
    if (bound.lifted[cell->active_cell_index()] > 0 &&
        cell->bounding_box().point_inside(probe.at, probe.size / cell->minimum_vertex_distance()))
      return false;
  return true;
}
} // namespace

template <int dim>
MeanIntervals<dim>::MeanIntervals(const Scene<dim> &scene, Solve solve)
    : scene(scene), solve(std::move(solve))
{
}

// @sect3{The norm of a mean}
//
template <>
const MeanIntervals<2>::Dual &MeanIntervals<2>::dual(const unsigned int number,
                                                     const unsigned int component,
                                                     const StepReport<2> &step)
{
  const auto [place, is_new] =
      duals.emplace(std::array<unsigned int, 2>{{number, component}}, Dual());
  Dual &result = place->second;
  if (!is_new)
    return result;
  const Probe<2> &probe = scene.probes[number];
  std::map<types::boundary_id, double> meshed;
  for (const types::boundary_id id : probe.on)
    if (scene.geometry.has_curves())
      meshed[id] = boundary_size(id, scene, step.field.dof_handler, step.field.tables);
  result.scene = std::make_shared<const Scene<2>>(dual_scene(scene, probe, component, meshed));
  if (is_zero(*result.scene))
    return result;
  for (const types::boundary_id id : probe.on)
    if (result.scene->boundaries[id].symmetry)
      result.why = result.scene->boundaries[id].name + " slides at an angle to x and y";
  if (!result.why.empty())
    return result;
  result.why = moves;
  if (!is_held(*result.scene))
    return result;
  try
  {
    const Solution<2> solution = step.solution();
    solve(*result.scene, scene.geometry.has_curves() ? &solution : nullptr,
          [&](const StepReport<2> &of_dual)
          {
            result.why = of_dual.no_bound;
            if (!of_dual.bound)
              return;
            if (!sees_all(of_dual.solution(), probe, component))
            {
              result.why = "the disc is too small beside the body";
              return;
            }
            result.z = std::make_shared<const Solution<2>>(of_dual.solution());
            const Solution<2> &z = *result.z;
            const double norm = largest_norm(z), error = of_dual.bound->total;
            // z_N is orthogonal to its error where it is in V, but for what the rule of the stiffness misses of its energy.
            result.norm = result.scene->has_pairs()
                              ? norm + error
                              : std::sqrt(norm * norm + error * error + 2 * missed_energy(z, z.u));
            result.error = error;
            if (!std::isfinite(result.norm))
            {
              result.z.reset();
              result.why = "cells are too flat";
            }
          });
  }
  catch (const InputError &)
  {
    result.why = "its mean is no load that the scene can bear";
  }
  catch (const NumericalFailure &error)
  {
    result.why = error.what();
  }
  if (result.z)
    result.why.clear();
  if (probe.kind == ProbeKind::disc)
    result.remainder = smooth_mean(scene, probe).remainder;
  return result;
}

// @sect3{Intervals}
//
template <>
Interval MeanIntervals<2>::interval(const Measured &mean, const Dual &dual,
                                    const StepReport<2> &step)
{
  const double round_off = scene.geometry.has_curves() ? 1e-11 : 1e-14; // |x'| is no polynomial
  if (!dual.z)
    return {mean.value, round_off * std::abs(mean.value)};
  const ErrorBound &bound = *step.bound;
  const Solution<2> solution = step.solution(), &z = *dual.z;
  const double norm = dual.norm + dual.remainder;
  double width = bound.total * norm;
  if (!scene.geometry.has_curves()) // along curves tractions do not work on straight edges
  {
    const StressWork work = work_of_difference(solution, bound, z, tables);
    const double missed_strain = initial_stress_error(scene, z.displacement_space,
                                                      *solution.spaces->loads, z.tables),
                 half_way =
                     bound.radius * norm +
                     bound.theta *
                         ((bound.stress + bound.oscillation) * (dual.error + dual.remainder) +
                          std::abs(work.value) + work.defect + missed_strain * norm);
    width = std::min(width, half_way); // the first argument where the other is no number
  }
  return {mean.value, width + (bound.data + correction_at_joints(*dual.scene, bound)) * norm +
                          round_off * std::abs(mean.value)};
}

template <>
void MeanIntervals<2>::set(StepReport<2> &step)
{
  std::string &why = step.no_intervals;
  if (scene.geometry.has_curves())
    duals.clear();
  for (ProbeValue<2> &value : step.probes)
  {
    const Probe<2> &probe = scene.probes[value.probe];
    if (!probe.is_mean())
      continue;
    std::string flaw;
    if (scene.is_axisymmetric() && probe.kind == ProbeKind::disc)
      flaw = "a mean over a ring has the weight of the radius";
    else if (scene.geometry.has_curves() && probe.kind == ProbeKind::disc &&
             reaches_curves(probe, step))
      flaw = "the disc reaches into cells with curved edges";
    else if (turns_along_curve(probe, scene))
      flaw = "a rigid plate along a curve may turn";
    for (unsigned int c = 0; c < 2 && flaw.empty(); ++c)
    {
      const Dual &of_mean = dual(value.probe, c, step);
      if (!of_mean.why.empty())
        flaw = of_mean.why;
      else if (!is_away_from_lifts(probe, step))
        flaw = "prescribed displacements there are no polynomials of the mesh";
      else if (of_mean.z && of_mean.scene->has_pairs() &&
               !is_away_from_corrections(probe, step)) // w is none where all is prescribed
        flaw = "cells of joints have a part of it";
      else
        value.displacement[c].interval = interval(value.displacement[c], of_mean, step);
    }
    if (!flaw.empty())
      why += (why.empty() ? "probe " : "; probe ") + probe.name + ": " + flaw;
  }
}

template <>
void MeanIntervals<3>::set(StepReport<3> &)
{
}

template class MeanIntervals<2>;
template class MeanIntervals<3>;
} // namespace hpvi
