// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>
#include <hpvi/discretisation/internal_forces.h>
#include <hpvi/evaluation/contact_traces.h>
#include <hpvi/evaluation/energies.h>
#include <hpvi/evaluation/equilibrium.h>

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hpvi
{
using namespace dealii;

namespace
{
/** The points in (0,1) where a function of one variable vanishes, as far as its samples show. */
template <class F>
std::vector<double> zeros(const F &function, const unsigned int n_samples)
{
  std::vector<double> result;
  double left = 0., f_left = function(left);
  for (unsigned int k = 1; k <= n_samples; ++k)
  {
    const double right = static_cast<double>(k) / n_samples, f_right = function(right);
    if ((f_left < 0. && f_right > 0.) || (f_left > 0. && f_right < 0.))
    {
      const auto bracket = boost::math::tools::bisect(
          function, left, right, boost::math::tools::eps_tolerance<double>(48));
      result.push_back(0.5 * (bracket.first + bracket.second));
    }
    else if (f_right == 0. && k < n_samples)
      result.push_back(right);
    left = right;
    f_left = f_right;
  }
  return result;
}

/** int g |u_t| over one face: the pieces of its rule are cut further where u_t changes sign. */
template <int dim>
double friction_work(const ContactFace<dim> &face, const Solution<dim> &solution,
                     const EdgeDisplacement<dim> &u_t, const QGauss<1> &gauss)
{
  std::vector<double> cuts = zeros(u_t, 8 * face.degree);
  cuts.insert(cuts.end(), face.friction.cuts.begin(), face.friction.cuts.end());
  std::sort(cuts.begin(), cuts.end());
  double sum = 0;
  for (unsigned int k = 0; k + 1 < cuts.size(); ++k)
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const double width = cuts[k + 1] - cuts[k], s = cuts[k] + width * gauss.point(q)[0];
      sum += width * gauss.weight(q) * solution.contact_space.bound(face, solution.z, s) *
             std::abs(u_t(s));
    }
  return face.length * sum;
}
} // namespace

template <int dim>
Energies energies(const Solution<dim> &solution, const ElasticSystem<dim> &system, const double a)
{
  double friction = 0;
  for (const ContactFace<dim> &face : solution.contact_space.faces())
    if (face.n_multipliers > 0)
    {
      EdgeDisplacement<dim> slip(face, solution, &ContactFrame<dim>::tangent);
      slip.subtract_past(face, solution.tables);
      friction += friction_work(face, solution, slip, solution.tables.gauss(face.degree + 2));
    }
  const Vector<double> moments = solution.spaces->contact_operator.moments(solution.u);
  double coupling = 0;
  for (unsigned int i = 0; i < moments.size(); ++i)
    coupling += solution.z[i] * (moments[i] - solution.contact_space.multipliers()[i].gap);
  const double potential = 0.5 * a - system.work(solution.u);
  const double norm =
      std::sqrt(std::max(a, 0.)); // round-off has any sign where nothing is strained
  return {potential + coupling, potential + friction, norm, friction - coupling};
}

template <int dim>
Work work(const Solution<dim> &solution, const ElasticSystem<dim> &system,
          const Vector<double> &last)
{
  Vector<double> du(solution.u);
  du -= last;
  Work result;
  result.external =
      system.work(du) + work_of_supports(solution, system, du) -
      0.5 * internal_forces(solution.scene, solution.displacement_space, solution.tables, du)
                .energy_product;
  const Vector<double> moments = solution.spaces->contact_operator.moments(du);
  for (unsigned int i = 0; i < moments.size(); ++i)
    if (solution.contact_space.multipliers()[i].kind == ContactMultiplier<dim>::Kind::friction)
      result.dissipated += solution.z[i] * moments[i];
    else
      result.external -= solution.z[i] * moments[i];
  return result;
}

template Work work(const Solution<2> &, const ElasticSystem<2> &, const Vector<double> &);
template Energies energies(const Solution<2> &, const ElasticSystem<2> &, double);
} // namespace hpvi
