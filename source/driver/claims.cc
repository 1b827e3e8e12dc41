// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/formatting.h>
#include <hpvi/driver/claims.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
namespace
{
/** Of the largest force or displacement, for balance to that part is taken for round-off; and of energies beside |u_N|_a^2. */
constexpr double floor_of_numbers = 1e-9, floor_of_energies = 1e-10;

/** Where a side of a pair has its claims of a force. */
struct Joint
{
  std::string name; ///< of both sides
  bool is_second = false;
};

/** None where a support of the same side bears a part. */
template <int dim>
Joint joint_of(const Scene<dim> &scene, const Resultant<dim> &row)
{
  if (row.kind == ForceKind::contact)
    for (const ContactPair &pair : scene.pairs)
      for (const unsigned int side : {0, 1})
        if (row.boundary == pair.parts[side])
        {
          const BoundaryCondition<dim> &own = scene.boundaries[row.boundary],
                                       &other = scene.boundaries[pair.parts[1 - side]];
          if (own.has_displacement() || other.has_displacement())
            return {};
          return {side == 0 ? own.name + " and " + other.name : other.name + " and " + own.name,
                  side == 1};
        }
  return {};
}

template <int dim>
class ForceClaims
{
public:
  ForceClaims(const StepReport<dim> &step, Claims &result) : step(step), result(result)
  {
    for (const Resultant<dim> &row : step.forces)
    {
      for (const Measured &force : row.force)
        largest = std::max(largest, std::abs(force.value));
      for (const Measured &moment : row.moment)
        largest_moment = std::max(largest_moment, std::abs(moment.value));
    }
    largest_moment = std::max(largest_moment, step.scene.geometry.diameter() * largest);
  }

  void add(const Resultant<dim> &row)
  {
    const Joint joint = joint_of(step.scene, row);
    const double opposite = joint.is_second ? -1. : 1.;
    for (unsigned int d = 0; d < dim; ++d)
      add(std::string("force ") + "xyz"[d], row, joint, row.force[d], opposite, largest);
    for (unsigned int d = 0; d < row.n_moments; ++d)
      add(
          dim == 2 ? "moment" : std::string("moment ") + "xyz" [d], row, {}, row.moment[d], 1.,
          largest_moment);
    add("normal force", row, joint, row.normal, 1., largest);
    add("friction", row, joint, row.friction, 1., largest);
  }

private:
  void add(const std::string &what, const Resultant<dim> &row, const Joint &joint,
           const Measured &number, const double sign, const double scale)
  {
    if (!number.interval)
      return;
    const double b = step.scene.thickness, centre = sign * b * number.interval->centre,
                 half_width = b * number.interval->half_width;
    const bool has_two = !joint.name.empty();
    result.push_back({what + (has_two ? " between " + joint.name : " on " + row.name),
                      "in step " + text(step.number) + (has_two ? " on " + row.name : ""),
                      centre - half_width, centre + half_width, floor_of_numbers * b * scale});
  }

  const StepReport<dim> &step;
  Claims &result;
  double largest = 0, largest_moment = 0;
};
} // namespace

template <int dim>
Claims claims_of(const StepReport<dim> &step, const double displacement)
{
  Claims result;
  if (!step.bound || step.bound->kind != BoundKind::energy)
    return result;
  const std::string where = "in step " + text(step.number);
  const double b = step.scene.thickness, J = step.energies.energy;
  result.push_back({"the least energy", where, b * (J - step.bound->energy_below),
                    b * (J + step.bound->energy_above),
                    floor_of_energies * b * std::pow(step.energies.norm, 2)});
  ForceClaims<dim> forces(step, result);
  for (const Resultant<dim> &row : step.forces)
    forces.add(row);
  for (const ProbeValue<dim> &probe : step.probes)
    for (unsigned int d = 0; d < dim; ++d)
      if (const auto &interval = probe.displacement[d].interval)
        result.push_back({std::string("mean u") + "xyz"[d] + " of the probe " +
                              step.scene.probes[probe.probe].name,
                          where, interval->centre - interval->half_width,
                          interval->centre + interval->half_width,
                          floor_of_numbers * displacement});
  return result;
}

template <int dim>
void withdraw_claims(StepReport<dim> &step, const std::string &why)
{
  step.bound.reset();
  step.equilibrated = {};
  step.no_bound = why;
  step.relative_bound = std::numeric_limits<double>::quiet_NaN();
  step.no_intervals = why;
  for (Resultant<dim> &row : step.forces)
  {
    for (Measured &force : row.force)
      force.interval.reset();
    for (Measured &moment : row.moment)
      moment.interval.reset();
    row.normal.interval.reset();
    row.friction.interval.reset();
  }
  for (ProbeValue<dim> &probe : step.probes)
    for (Measured &displacement : probe.displacement)
      displacement.interval.reset();
}

template Claims claims_of(const StepReport<2> &, double);
template Claims claims_of(const StepReport<3> &, double);
template void withdraw_claims(StepReport<2> &, const std::string &);
template void withdraw_claims(StepReport<3> &, const std::string &);
} // namespace hpvi
