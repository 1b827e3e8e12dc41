// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/base/gathered.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/space/friction_iteration.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr unsigned int maximum_problems = 200;
constexpr unsigned int patience = 30; ///< problems in which the residual must halve

[[noreturn]] void give_up_on_friction(const NewtonReport &report)
{
  std::ostringstream line;
  line << "friction that follows the pressure has not converged after " << report.tresca_problems
       << " problems of Tresca: relative residual " << report.residual << ", contraction number "
       << report.contraction
       << "; lower Friction coefficient, for where it is large there may be no solution, take "
          "Friction "
          "law = limited with a bound, start on another mesh, or raise Solver/Primal tolerance";
  throw NumericalFailure(line.str());
}

bool meets(const NewtonReport &left, const NewtonSettings &settings)
{
  return left.residual <= settings.residual || (left.error > 0 && left.error <= settings.error);
}

/** How exact the next problem of Tresca is to be solved, where @p now is left under its law. */
NewtonSettings part_of(const NewtonSettings &settings, const NewtonReport &now)
{
  NewtonSettings result = settings;
  result.wants_error = false; // that under the law is measured afterwards
  result.residual = std::max(0.5 * settings.residual, 0.1 * now.residual);
  if (settings.error > 0)
    result.error = std::max(0.5 * settings.error, 0.1 * now.error);
  return result;
}
} // namespace

template <int dim>
FrictionIteration<dim>::FrictionIteration(const PrimalSpace<dim> &space,
                                          SemismoothNewton<dim> &newton)
    : space(space), newton(newton)
{
  for (unsigned int k = 0; k < space.contact.size(); ++k)
  {
    weights.push_back(space.contact[k].weight);
    if (space.contact[k].has_partner())
      frictions.push_back(k);
  }
  const auto sizes = gathered(std::vector<std::size_t>{frictions.size()}, space.communicator());
  for (unsigned int p = 0; p < Utilities::MPI::this_mpi_process(space.communicator()); ++p)
    first += sizes[p];
}

/** `max(0, p_k) (int psi_k)^1/2` of all processes: their norm is that of L2 on the contact. */
template <int dim>
Vector<double>
FrictionIteration<dim>::pressures(const std::vector<ContactVector<dim>> &lambda) const
{
  std::vector<double> own;
  for (const unsigned int k : frictions)
    own.push_back(lambda.empty() ? 0.
                                 : std::max(0., lambda[space.contact[k].partner][0]) *
                                       std::sqrt(space.contact[k].area));
  const std::vector<double> all = gathered(own, space.communicator());
  return Vector<double>(all.begin(), all.end());
}

/** G of a friction at the pressures @p x. */
template <int dim>
double FrictionIteration<dim>::weight(const unsigned int i, const Vector<double> &x) const
{
  const ContactDof<dim> &contact_dof = space.contact[frictions[i]];
  return contact_dof.area * contact_dof.limit.limit(x[first + i] / std::sqrt(contact_dof.area));
}

/**
 * Gives SemismoothNewton the limits of the pressures @p x. What sticks keeps its traction, what slips slips on, and where
 * there was no friction it acts against the slip.
 */
template <int dim>
void FrictionIteration<dim>::take_limits(const Vector<double> &x, const DistributedVector &v,
                                         std::vector<ContactVector<dim>> &lambda)
{
  for (unsigned int i = 0; i < frictions.size(); ++i)
  {
    const unsigned int k = frictions[i];
    const ContactDof<dim> &contact_dof = space.contact[k];
    const double old = std::exchange(weights[k], weight(i, x));
    if (lambda.empty())
      continue;
    const ContactVector<dim> slip = space.contact_value(v, k) - contact_dof.gap;
    if (weights[k] == 0)
      lambda[k] = {};
    else if (old == 0)
      lambda[k] = slip / std::max(slip.norm(), std::numeric_limits<double>::min());
    else if (lambda[k].norm() < 1 - 1e-12)
      lambda[k] = contact_dof.projected(old / weights[k] * lambda[k]);
  }
  newton.take_weights(weights);
}

template <int dim>
NewtonReport FrictionIteration<dim>::solve(DistributedVector &v,
                                           std::vector<ContactVector<dim>> &lambda,
                                           const NewtonSettings &settings,
                                           const std::function<void(const NewtonReport &)> &heard)
{
  if (!space.scene.has_coulomb_friction())
    return newton.solve(v, lambda, settings, heard);
  const bool is_cold = Utilities::MPI::max(lambda.size(), space.communicator()) == 0;
  Vector<double> x = pressures(lambda);
  if (is_cold &&
      space.rests_on_contact) // sliding freely the body would go far: at first all sticks
    for (unsigned int i = 0; i < frictions.size(); ++i)
      x[first + i] =
          space.scene.materials[0].modulus(dim) * std::sqrt(space.contact[frictions[i]].area);
  if (!is_cold) // of a solution on another mesh or of the step before, in units of the limits there
    for (unsigned int i = 0; i < frictions.size(); ++i)
      if (lambda[frictions[i]].norm() > 0)
        weights[frictions[i]] = weight(i, x);
  take_limits(x, v, lambda);
  NewtonReport report, left = is_cold ? NewtonReport() : newton.measure(v, lambda, settings);
  left.residual = is_cold ? 0.1 : left.residual;
  if (!is_cold && meets(left, settings))
    return left;
  double halved = std::numeric_limits<double>::infinity();
  for (unsigned int since = 0; report.tresca_problems < maximum_problems; ++since)
  {
    report += newton.solve(v, lambda, part_of(settings, left), heard);
    ++report.tresca_problems;
    const Vector<double> found = pressures(lambda);
    take_limits(found, v, lambda);
    left = newton.measure(v, lambda, settings);
    report.residual = left.residual;
    report.error = left.error;
    report.n_slipping = left.n_slipping;
    report.n_pressing = left.n_pressing;
    report.contraction = acceleration.contraction;
    if (meets(left, settings))
      return report;
    if (left.residual <= 0.5 * halved)
    {
      halved = left.residual;
      since = 0;
    }
    if (since == patience)
      break;
    Vector<double> change = found;
    change -= x;
    x = is_cold && space.rests_on_contact && report.tresca_problems == 1
            ? found
            : acceleration.next(x, change);
    take_limits(x, v, lambda);
  }
  give_up_on_friction(report);
}

template class FrictionIteration<2>;
template class FrictionIteration<3>;
} // namespace hpvi
