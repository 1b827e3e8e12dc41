// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/mpi.h>
#include <hpvi/results/error_estimate.h>
#include <hpvi/results/residual_estimator.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace hpvi
{
using namespace dealii;

double ErrorEstimate::indicator(const unsigned int cell) const
{
  double sum = volume[cell] + jumps[cell] + neumann[cell] + contact[cell];
  for (const auto *part : {&normal, &penetration, &tension, &excess})
    sum += part->empty() ? 0. : (*part)[cell];
  return std::sqrt(sum);
}

std::vector<double> ErrorEstimate::indicators() const
{
  std::vector<double> eta(volume.size());
  for (unsigned int cell = 0; cell < eta.size(); ++cell)
    eta[cell] = indicator(cell);
  return eta;
}

double ErrorEstimate::total() const
{
  double sum = 0;
  for (const auto *part :
       {&volume, &jumps, &neumann, &contact, &normal, &penetration, &tension, &excess})
    sum = std::accumulate(part->begin(), part->end(), sum);
  return std::sqrt(sum);
}

EstimateNorms norms(const ErrorEstimate &estimate, MPI_Comm communicator)
{
  const auto root = [&](const double sum)
  { return std::sqrt(Utilities::MPI::sum(sum, communicator)); };
  EstimateNorms result;
  double all = 0;
  const auto add = [&](const std::vector<double> &part)
  {
    all = std::accumulate(part.begin(), part.end(), all);
    return root(std::accumulate(part.begin(), part.end(), 0.));
  };
  result.volume = add(estimate.volume);
  result.jumps = add(estimate.jumps);
  result.neumann = add(estimate.neumann);
  result.contact = add(estimate.contact);
  result.normal = add(estimate.normal);
  result.penetration = add(estimate.penetration);
  result.tension = add(estimate.tension);
  result.excess = add(estimate.excess);
  result.total = root(all);
  return result;
}

// Second derivatives amplify the last bits of $u_N$ by $(p^2/h)^2$. On deep meshes the indicator is
// some day that of round-off, and stops falling whatever is refined. How large that is, is measured
// and not estimated: by the indicator of a random displacement as large as the last bits are.
template <int dim>
double round_off_of_estimate(const Field<dim> &field)
{
  Scene<dim> unloaded = field.scene;
  unloaded.body_force = {};
  unloaded.body_force_of_material.clear();
  unloaded.initial_strains.clear();
  for (BoundaryCondition<dim> &boundary : unloaded.boundaries)
  {
    boundary.traction = {};
    if (boundary.is_unilateral()) // too far away to touch
      boundary.gap = expression<dim>(std::numeric_limits<double>::max());
  }
  return norms(estimate_error(*field.round_off_probe(unloaded)), field.communicator()).total;
}

template double round_off_of_estimate(const Field<2> &);
template double round_off_of_estimate(const Field<3> &);
} // namespace hpvi
