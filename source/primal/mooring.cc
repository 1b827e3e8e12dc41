// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/numerical_failure.h>
#include <hpvi/checks/space_motion.h>
#include <hpvi/moments/rigid_motions.h>
#include <hpvi/primal/mooring.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr double softness = 1e-3;     ///< of the springs beside a body as thick as this one
constexpr double balanced = 1e-9;     ///< of forces and moments, in parts of all of them
constexpr unsigned int patience = 40; ///< proximal steps
} // namespace

template <int dim>
Mooring<dim>::Mooring(const MomentSpace<dim> &space, PrimalSystem<dim> &system,
                      MomentMatrix<dim> &matrix)
    : space(space), system(system), loads(system.f), springs(space.contact.size()),
      anchors(space.contact.size())
{
  if (!space.rests_on_contact)
    return;
  const double stiffness =
      softness * space.scene.materials[0].modulus() / space.scene.geometry.diameter();
  for (unsigned int k = 0; k < springs.size(); ++k)
    springs[k] = stiffness * space.contact[k].area;
  matrix.add_springs(springs);
}

template <int dim>
Mooring<dim>::~Mooring()
{
  system.f = loads;
}

template <int dim>
void Mooring<dim>::drop_anchors(const DistributedVector &v)
{
  system.f = loads;
  for (unsigned int k = 0; k < springs.size(); ++k)
  {
    anchors[k] = space.moment(v, k);
    space.add_moment(system.f, k, springs[k] * anchors[k]);
  }
}

/** The norm of the forces of the springs, and twice their energy. */
template <int dim>
double Mooring<dim>::pull(const DistributedVector &v, double &energy) const
{
  double squares = 0, work = 0;
  for (unsigned int k = 0; k < springs.size(); ++k)
  {
    const double square = (space.moment(v, k) - anchors[k]).norm_square();
    squares += springs[k] * springs[k] * square;
    work += springs[k] * square;
  }
  energy = Utilities::MPI::sum(work, space.communicator());
  return std::sqrt(Utilities::MPI::sum(squares, space.communicator()));
}

/**
 * What loads and contact leave along the free motions, in parts of both; @p words of the motion where they leave most, as in
 * "the loads push the body along (1 0 0) with 2, contact resists with 1".
 */
template <int dim>
double Mooring<dim>::imbalance(const std::vector<ContactVector<dim>> &lambda,
                               std::string &words) const
{
  double worst = 0;
  if constexpr (dim == 3)
  {
    const std::vector<double> basis = rigid_motions(space);
    const unsigned int n = space.owned.n_elements();
    const double length = space.scene.geometry.radius();
    for (const SpaceMotion &motion : free_motions_in_space(space.scene))
    {
      std::array<double, 6> amounts;
      for (unsigned int d = 0; d < 3; ++d) // rigid_motions() turns about z, x and y
      {
        amounts[d] = motion.translation[d];
        amounts[3 + d] = motion.rotation[(d + 2) % 3] * length;
      }
      DistributedVector R = space.owned_vector();
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int m = 0; m < 6; ++m)
          R.local_element(i) += amounts[m] * basis[m * n + i];
      std::vector<double> own{0., 0., 0.}, sums(3); // loads, contact, all of both
      for (unsigned int i = 0; i < n; ++i)
      {
        own[0] += loads.local_element(i) * R.local_element(i);
        own[2] += std::abs(loads.local_element(i) * R.local_element(i));
      }
      for (unsigned int k = 0; k < springs.size(); ++k)
      {
        const double G = space.contact[k].area * space.contact[k].bound_by(lambda),
                     part = G * (lambda[k] * space.moment(R, k));
        own[1] += part;
        own[2] += std::abs(part);
      }
      Utilities::MPI::sum(own, space.communicator(), sums);
      const double left = sums[2] > 0 ? std::abs(sums[0] - sums[1]) / sums[2] : 0;
      if (left <= worst)
        continue;
      worst = left;
      const double unit = motion.turns() ? motion.rotation.norm() : motion.translation.norm();
      std::ostringstream line;
      line.precision(10);
      line << "the loads " << (motion.turns() ? "turn" : "push") << " the body "
           << motion.in_words() << " with " << sums[0] / unit << ", contact resists with "
           << sums[1] / unit;
      words = line.str();
    }
  }
  return worst;
}

template <int dim>
NewtonReport Mooring<dim>::solve(const DistributedVector &v,
                                 const std::vector<ContactVector<dim>> &lambda,
                                 const NewtonSettings &wanted, const Solve &inner)
{
  if (!space.rests_on_contact)
    return inner(wanted);
  NewtonReport report;
  NewtonSettings settings = wanted;
  std::string words;
  for (unsigned int step = 0; step < patience; ++step)
  {
    drop_anchors(v);
    report += inner(settings);
    double energy = 0;
    const double force = pull(v, energy), load = std::max(loads.l2_norm(), system.f.l2_norm());
    report.residual += load > 0 ? force / load : 0;
    report.error = std::sqrt(report.error * report.error + energy);
    const bool is_met = report.residual <= 2 * wanted.residual ||
                        (report.error > 0 && report.error <= wanted.error);
    if (imbalance(lambda, words) <= balanced && is_met)
      return report;
    if (is_met) // as the error of the mesh allows, but forces shall balance
      settings = {std::max(1e-12, 0.1 * settings.residual), 0., settings.maximum_steps};
  }
  throw NumericalFailure("no equilibrium: " + words +
                         "; add a support, raise friction, lower the loads or raise "
                         "Geometry/Subdivisions");
}

template class Mooring<2>;
template class Mooring<3>;
} // namespace hpvi
