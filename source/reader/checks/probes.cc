// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/base/text.h>
#include <hpvi/base/tolerances.h>
#include <hpvi/reader/checks/checks.h>
#include <hpvi/reader/checks/rejection.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Of convergence.csv, which probes add theirs to; a test holds this list against the table. */
const std::set<std::string> own_columns = {"step",
                                           "elements",
                                           "dofs",
                                           "dofs_free",
                                           "multipliers",
                                           "p_min",
                                           "p_max",
                                           "estimate",
                                           "lagrangian",
                                           "energy",
                                           "slack",
                                           "qp_multiplications",
                                           "seconds",
                                           "estimate_volume",
                                           "estimate_jumps",
                                           "estimate_neumann",
                                           "estimate_contact",
                                           "qp_cg",
                                           "qp_expansion",
                                           "qp_proportioning",
                                           "qp_dense_solves",
                                           "qp_fell_back",
                                           "qp_projected_gradient",
                                           "condition_raw",
                                           "condition_scaled",
                                           "estimate_scaled",
                                           "estimate_relative",
                                           "energy_norm",
                                           "friction_resultant",
                                           "error_energy",
                                           "error_relative",
                                           "error_l2",
                                           "error_multiplier",
                                           "error_transition",
                                           "energy_difference",
                                           "effectivity",
                                           "transitions",
                                           "normal_resultant",
                                           "error_pressure",
                                           "estimate_normal",
                                           "estimate_penetration",
                                           "coulomb_newton",
                                           "coulomb_fixed_point",
                                           "coulomb_contraction",
                                           "coulomb_method",
                                           "estimate_tension",
                                           "estimate_excess",
                                           "coulomb_difference",
                                           "error_bound",
                                           "error_bound_relative",
                                           "energy_low",
                                           "energy_high",
                                           "bound_stress",
                                           "bound_slip",
                                           "bound_oscillation",
                                           "bound_data",
                                           "bound_imbalance",
                                           "error_estimate_equilibrated",
                                           "coupling",
                                           "bound_kind",
                                           "load_step",
                                           "t",
                                           "newton_steps",
                                           "newton_cg",
                                           "newton_setups",
                                           "newton_fell_back",
                                           "newton_line_searches",
                                           "newton_residual",
                                           "newton_error",
                                           "augmented_steps",
                                           "slipping",
                                           "pressing",
                                           "peak_memory",
                                           "processes",
                                           "friction_resultant_x",
                                           "friction_resultant_y",
                                           "friction_resultant_z",
                                           "normal_resultant_bound",
                                           "friction_resultant_bound"};

std::string section_of(const std::string &probe)
{
  return "Probe " + probe;
}

/** Columns of stages begin with `seconds_`. */
template <int dim>
void check_name(const Scene<dim> &scene, const Probe<dim> &probe)
{
  const std::string &name = probe.name;
  const std::string entry = probe.kind == ProbeKind::line       ? "From"
                            : probe.kind == ProbeKind::boundary ? "On"
                                                                : "At";
  if (name == "residual" || name == "bound")
    reject(scene, section_of(name), entry,
           "is of a probe that is called like a value of Adaptivity/Tolerance on; choose another "
           "name");
  if (own_columns.count(name) > 0 || name.rfind("seconds_", 0) == 0)
    reject(scene, section_of(name), entry,
           "is of a probe that is called like a column of convergence.csv; choose another name");
  for (const Probe<dim> &other : scene.probes)
    for (const std::string &column : columns_of(other))
      if (column == name)
        reject(scene, section_of(name), entry,
               "is of a probe that is called like a column of Probe " + other.name +
                   "; choose another name");
}

double distance_from_boundary(const Geometry<2> &geometry, const Point<2> &x)
{
  double least = std::numeric_limits<double>::max();
  for (const Side<2> &side : sides_of(geometry))
    for (unsigned int k = 0; k < side.pieces.size(); ++k)
      least = std::min(least, side.distance(k, x));
  return least;
}

/** Beside a curve, which cells follow up to their degree, a run finds out. */
template <int dim>
bool may_be_inside(const Geometry<dim> &geometry, const Point<dim> &x)
{
  if (geometry.contains(x))
    return true;
  if constexpr (dim == 2)
    return geometry.has_curves() && distance_from_boundary(geometry, x) < 0.01 * geometry.radius();
  return false;
}

template <int dim>
void check_inside(const Scene<dim> &scene, const Probe<dim> &probe, const std::string &entry,
                  const Point<dim> &x)
{
  if (!may_be_inside(scene.geometry, x))
    reject(scene, section_of(probe.name), entry, "lies outside of the body; give a point of it");
}

/** Where bodies touch their displacements differ. */
void check_one_body(const Scene<2> &scene, const Probe<2> &probe)
{
  const std::vector<Side<2>> sides = sides_of(scene.geometry);
  std::vector<std::string> touching;
  for (const Body<2> &body : scene.geometry.bodies)
    if (std::any_of(body.sides.begin(), body.sides.end(),
                    [&](const unsigned int side)
                    {
                      for (unsigned int k = 0; k < sides[side].pieces.size(); ++k)
                        if (sides[side].distance(k, probe.at) <= on_body * scene.geometry.radius())
                          return true;
                      return false;
                    }))
      touching.push_back(body.name);
  if (touching.size() > 1)
    reject(scene, section_of(probe.name), "At",
           "lies where " + listed(touching, "and") +
               " touch and may move apart; move it into one of them, or take On = BODY.side");
}

void check_one_body(const Scene<3> &, const Probe<3> &)
{
}

void check_disc(const Scene<2> &scene, const Probe<2> &probe)
{
  const double room = distance_from_boundary(scene.geometry, probe.at);
  if (!(probe.size > 0 && std::isfinite(probe.size)))
    reject(scene, section_of(probe.name), "Size", "is no radius; give a positive number",
           text(probe.size));
  if (probe.size > (1 + 1e-9) * room)
    reject(scene, section_of(probe.name), "Size",
           "makes a disc that leaves the body, whose boundary is " + to_string(room) +
               " away from At; make it smaller, or move it",
           text(probe.size));
}

void check_disc(const Scene<3> &scene, const Probe<3> &probe)
{
  reject(scene, section_of(probe.name), "Size", "is of discs, and space has none; remove it");
}

template <int dim>
void check_line(const Scene<dim> &scene, const Probe<dim> &probe)
{
  check_inside(scene, probe, "From", probe.from);
  check_inside(scene, probe, "To", probe.to);
  if (probe.n_points < 2)
    reject(scene, section_of(probe.name), "Points", "are too few for a line; give 2 at least",
           std::to_string(probe.n_points));
}

template <int dim>
void check_place(const Scene<dim> &scene, const Probe<dim> &probe)
{
  if (probe.kind == ProbeKind::line)
    check_line(scene, probe);
  else if (probe.kind == ProbeKind::boundary)
  {
    for (const types::boundary_id id : probe.on)
      if (id >= scene.boundaries.size())
        reject(scene, section_of(probe.name), "On", "is no boundary of the scene; name one");
    if (probe.on.empty())
      reject(scene, section_of(probe.name), "On", "is no boundary of the scene; name one");
  }
  else
  {
    check_inside(scene, probe, "At", probe.at);
    check_one_body(scene, probe);
    if (probe.kind == ProbeKind::disc)
      check_disc(scene, probe);
  }
}

/** Has the table a single resultant of contact, beside which its half-width can stand? */
template <int dim>
unsigned int n_contacts(const Scene<dim> &scene)
{
  unsigned int n = scene.pairs.size();
  for (const BoundaryCondition<dim> &boundary : scene.boundaries)
    n += boundary.has_contact() && !boundary.pair ? 1 : 0;
  return n;
}
} // namespace

template <int dim>
void check_probes(const Scene<dim> &scene)
{
  for (const Probe<dim> &probe : scene.probes)
  {
    check_name(scene, probe);
    check_place(scene, probe);
  }
}

template <int dim>
void check_tolerance_column(const Scene<dim> &scene)
{
  const std::string &column = scene.adaptivity.tolerance_column;
  if (column.empty())
    return;
  const std::vector<std::string> contact = {"normal_resultant", "friction_resultant"};
  std::vector<std::string> known{"residual", "bound", equilibrated_estimate};
  if (n_contacts(scene) == 1)
    known.insert(known.end(), contact.begin(), contact.end());
  else if (std::find(contact.begin(), contact.end(), column) != contact.end())
    reject(scene, "Adaptivity", "Tolerance on",
           "is empty unless the scene has one contact boundary or pair, and it has " +
               std::to_string(n_contacts(scene)) + "; give residual, bound or a probe",
           column);
  for (const Probe<dim> &probe : scene.probes)
    if (probe.kind != ProbeKind::line)
    {
      known.push_back(probe.name);
      for (unsigned int d = 0; d < dim; ++d)
        known.push_back(probe.name + "_u" + "xyz"[d]);
    }
  if (std::find(known.begin(), known.end(), column) == known.end())
    reject(scene, "Adaptivity", "Tolerance on",
           "is neither an error nor a number with an interval; this scene has: " +
               listed(known, "and"),
           column);
}

template void check_probes(const Scene<2> &);
template void check_probes(const Scene<3> &);
template void check_tolerance_column(const Scene<2> &);
template void check_tolerance_column(const Scene<3> &);
} // namespace hpvi
