// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/exceptions.h>
#include <hpvi/solvers/equality_constraints.h>
#include <hpvi/solvers/nearest_force.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Resultants `G'z` of the points of a set, columns of G scaled to length one. */
class Resultants : public ForceSet
{
public:
  Resultants(const FeasibleSet &feasible_set, const EqualityConstraints &constraints);

  Extreme farthest(const Force &motion) const override;
  Force start() const override;
  unsigned int n_equations() const override;

  Force length, e; ///< of the columns; scaled right hand side

private:
  Force resultant(const Vector<double> &z) const;

  const FeasibleSet &feasible_set;
  const unsigned int n;
  std::vector<Force> rows;
};

Resultants::Resultants(const FeasibleSet &feasible_set, const EqualityConstraints &constraints)
    : feasible_set(feasible_set), n(std::max<unsigned int>(3, constraints.e.size())),
      rows(feasible_set.size())
{
  const FullMatrix<double> &G = constraints.G;
  AssertDimension(G.m(), feasible_set.size());
  AssertDimension(G.n(), constraints.e.size());
  AssertThrow(G.n() <= most_equations,
              ExcMessage("There are at most three equations of eight bodies."));
  for (unsigned int j = 0; j < G.n(); ++j)
  {
    for (unsigned int i = 0; i < G.m(); ++i)
      length[j] = std::hypot(length[j], G(i, j));
    if (length[j] == 0.)
      length[j] = 1.;
    for (unsigned int i = 0; i < G.m(); ++i)
      rows[i][j] = G(i, j) / length[j];
    e[j] = constraints.e[j] / length[j];
  }
}

unsigned int Resultants::n_equations() const
{
  return n;
}

Force Resultants::start() const
{
  Vector<double> zero(rows.size());
  feasible_set.project(zero);
  return resultant(zero);
}

Force Resultants::resultant(const Vector<double> &z) const
{
  Force sum;
  for (unsigned int i = 0; i < rows.size(); ++i)
    sum += z[i] * rows[i];
  return sum;
}

Resultants::Extreme Resultants::farthest(const Force &motion) const
{
  Vector<double> direction(rows.size()), z;
  for (unsigned int i = 0; i < rows.size(); ++i)
  {
    direction[i] = motion * rows[i];
    // Orthogonal to round-off is orthogonal: such a half line has no end on either side.
    if (std::abs(direction[i]) <= 1e-13 * motion.norm() * rows[i].norm())
      direction[i] = 0.;
  }
  const bool is_ray = !feasible_set.farthest(direction, z);
  const Force place = resultant(z);
  return {is_ray ? place / place.norm() : place, is_ray};
}
} // namespace

Vector<double> EqualityConstraints::gap(const Vector<double> &z) const
{
  Vector<double> result(e.size());
  if (e.size() == 0) // supports hold the body
    return result;
  G.Tvmult(result, z);
  result.sadd(-1., 1., e);
  return result;
}

double EqualityConstraints::imbalance(const Vector<double> &z, const Vector<double> &noise,
                                      const double tolerance) const
{
  const unsigned int m = e.size();
  Vector<double> length(m), noise_of(m);
  double forces = 0, largest = 0;
  for (unsigned int j = 0; j < m; ++j)
  {
    double sum = std::abs(e[j]);
    for (unsigned int i = 0; i < z.size(); ++i)
    {
      length[j] = std::hypot(length[j], G(i, j));
      sum += std::abs(G(i, j) * z[i]);
      noise_of[j] += std::abs(G(i, j)) * noise[i];
    }
    if (sum > 0.)
      forces = std::max(forces, sum / length[j]);
  }
  const Vector<double> left = gap(z);
  for (unsigned int j = 0; j < m; ++j)
  {
    const double allowed = length[j] * forces + noise_of[j] +
                           (round_off.size() > 0 ? round_off[j] / tolerance : 0.),
                 here = left[j] == 0. ? 0. : std::abs(left[j]) / allowed;
    if (!(here <= largest)) // NaN, too
      largest = here;
    if (std::isnan(largest))
      break;
  }
  return largest;
}

Vector<double> noise_of(const Vector<double> &d, const Vector<double> &scale)
{
  Vector<double> scaled(d);
  scaled.scale(scale);
  Vector<double> result(scale);
  result *= 1e-2 * scaled.l2_norm();
  return result;
}

FullMatrix<double> root_of(const FullMatrix<double> &Gamma)
{
  FullMatrix<double> result(Gamma.m());
  if (Gamma.m() > 0)
    result.cholesky(Gamma);
  return result;
}

Vector<double> EqualityConstraints::along(const Vector<double> &x) const
{
  Vector<double> result(G.m());
  G.vmult(result, x);
  return result;
}

std::optional<Imbalance> find_imbalance(const FeasibleSet &feasible_set,
                                        const EqualityConstraints &constraints)
{
  const Resultants resultants(feasible_set, constraints);
  const std::optional<Separation> separation = separate(resultants, resultants.e);
  if (!separation)
    return {};

  unsigned int largest = 0;
  const Force &motion = separation->motion;
  for (unsigned int j = 0; j < constraints.e.size(); ++j)
    if (std::abs(motion[j]) > std::abs(motion[largest]))
      largest = j;
  const double unit = std::abs(motion[largest]) / resultants.length[largest];
  Imbalance result{Vector<double>(constraints.e.size()), separation->load / unit,
                   separation->resistance / unit};
  for (unsigned int j = 0; j < constraints.e.size(); ++j)
    result.motion[j] = motion[j] / resultants.length[j] / unit;
  return result;
}
} // namespace hpvi
