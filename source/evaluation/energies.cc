// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>
#include <hpvi/evaluation/contact_traces.h>
#include <hpvi/evaluation/energies.h>
#include <hpvi/evaluation/equilibrium.h>

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
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
      // Signs alone: products of small values underflow.
      const auto sign = [&](const double s)
      {
        const double value = function(s);
        return (value > 0.) - (value < 0.);
      };
      const auto bracket = boost::math::tools::bisect(
          sign, left, right, boost::math::tools::eps_tolerance<double>(48));
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

namespace
{
/** u_0 in the moments of all pressures. */
template <int dim>
std::vector<double> gaps(const ContactSpace<dim> &contact_space)
{
  std::vector<double> result;
  for (const ContactMultiplier<dim> &multiplier : contact_space.multipliers())
    if (multiplier.kind == ContactMultiplier<dim>::Kind::pressure)
      result.push_back(multiplier.gap);
  return result;
}

/** What acts in one state while the body moves by du and its foundation by du_0. */
struct Acting
{
  double outside = 0;  ///< loads, supports and foundation
  double friction = 0; ///< int z du_t
  double pressure = 0; ///< int p d(u_n - u_0)
  double residual = 0; ///< what has no balance
};

/** @p change of gaps(). */
template <int dim>
Acting acting(const Solution<dim> &state, const Vector<double> &loads, const Vector<double> &du,
              const std::vector<double> &change)
{
  const ReactionWork reactions = reaction_work(state, loads, du);
  Acting result;
  result.outside = std::inner_product(loads.begin(), loads.end(), du.begin(), reactions.supports);
  result.residual = -reactions.elsewhere;
  const Vector<double> moments = state.spaces->contact_operator.moments(du);
  auto du_0 = change.begin();
  for (unsigned int i = 0; i < moments.size(); ++i)
    if (state.contact_space.multipliers()[i].kind == ContactMultiplier<dim>::Kind::friction)
      result.friction += state.z[i] * moments[i];
    else
    {
      result.outside -= state.z[i] * *du_0;
      result.pressure += state.z[i] * (moments[i] - *du_0++);
    }
  return result;
}

Work between(const Acting &last, const Acting &next)
{
  return {0.5 * (last.outside + next.outside), next.friction,
          0.5 * (last.friction - next.friction + last.pressure + next.pressure),
          0.5 * last.residual};
}
} // namespace

template <int dim>
Work work(const Solution<dim> &last, const Solution<dim> &next, const Vector<double> &loads)
{
  Vector<double> du(next.u);
  du -= last.u;
  std::vector<double> change = gaps(next.contact_space);
  const std::vector<double> before = gaps(last.contact_space);
  std::transform(change.begin(), change.end(), before.begin(), change.begin(), std::minus<>());
  return between(
      acting(last,
             load_vector(last.scene, last.displacement_space, last.tables, *last.spaces->loads), du,
             change),
      acting(next, loads, du, change));
}

template <int dim>
Work work_from_rest(const Solution<dim> &next, const Vector<double> &loads)
{
  std::vector<double> change = gaps(next.contact_space);
  for (double &gap : change)
    gap = std::min(gap, 0.);
  return between({}, acting(next, loads, next.u, change));
}

template Work work(const Solution<2> &, const Solution<2> &, const Vector<double> &);
template Work work_from_rest(const Solution<2> &, const Vector<double> &);
template Energies energies(const Solution<2> &, const ElasticSystem<2> &, double);
} // namespace hpvi
