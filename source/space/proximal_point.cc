// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/numerical_failure.h>
#include <hpvi/space/proximal_point.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
// Softer springs need fewer steps: on prm/block-space.prm at its angle of friction plus 2e-4 of it 1e-3 fails, 1e-6 takes three.
constexpr double softness = 1e-6;       ///< of the springs beside a body as thick as this one
constexpr double balanced = 1e-9;       ///< of forces and moments, in parts of all of them
constexpr unsigned int most_steps = 40; ///< proximal steps
} // namespace

ProximalPoint::ProximalPoint(const PrimalSpace<3> &space, PrimalSystem<3> &system,
                             NewtonMatrix<3> &matrix, const ContactStatics &statics)
    : space(space), system(system), loads(system.f), statics(statics),
      springs(space.contact.size()), centres(space.contact.size())
{
  const double stiffness =
      softness * space.scene.materials[0].modulus(3) / space.scene.geometry.diameter();
  for (unsigned int k = 0; k < springs.size(); ++k)
    springs[k] = stiffness * space.contact[k].area;
  matrix.add_springs(springs);
}

ProximalPoint::~ProximalPoint()
{
  system.f = loads;
}

void ProximalPoint::drop_anchors(const DistributedVector &v)
{
  system.f = loads;
  for (unsigned int k = 0; k < springs.size(); ++k)
  {
    centres[k] = space.contact_value(v, k);
    space.add_contact_value(system.f, k, springs[k] * centres[k]);
  }
}

/** The norm of the forces of the springs, and twice their energy. */
double ProximalPoint::regularise(const DistributedVector &v, double &energy) const
{
  double squares = 0, work = 0;
  for (unsigned int k = 0; k < springs.size(); ++k)
  {
    const double square = (space.contact_value(v, k) - centres[k]).norm_square();
    squares += springs[k] * springs[k] * square;
    work += springs[k] * square;
  }
  energy = Utilities::MPI::sum(work, space.communicator());
  return std::sqrt(Utilities::MPI::sum(squares, space.communicator()));
}

NewtonReport ProximalPoint::solve(const DistributedVector &v,
                                  const std::vector<ContactVector<3>> &lambda,
                                  const NewtonSettings &wanted, const Solve &inner)
{
  NewtonReport report;
  NewtonSettings settings = wanted;
  std::string words;
  for (unsigned int step = 0; step < most_steps; ++step)
  {
    drop_anchors(v);
    report += inner(settings);
    double energy = 0;
    const double force = regularise(v, energy),
                 load = std::max(loads.l2_norm(), system.f.l2_norm());
    report.residual += load > 0 ? force / load : 0;
    report.error = std::sqrt(report.error * report.error + energy);
    const bool is_met = report.residual <= 2 * wanted.residual ||
                        (report.error > 0 && report.error <= wanted.error);
    const double left = statics.imbalance(lambda, words);
    if (left <= balanced && is_met)
      return report;
    if (is_met) // as the error of the mesh allows, but forces shall balance, which are out of it as the residual is
      settings = {std::clamp(0.1 * std::max(left, report.residual * balanced / left), 1e-10, 1e-3),
                  0., settings.maximum_steps};
  }
  throw NumericalFailure("no equilibrium found in " + std::to_string(most_steps) +
                         " steps: " + words +
                         "; add a support, raise friction, lower the loads or raise "
                         "Geometry/Subdivisions");
}
} // namespace hpvi
