// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/exceptions.h>
#include <deal.II/base/tensor.h>
#include <hpvi/balance/equality_constraints.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr unsigned int most_equations = 24; ///< three of each of eight bodies

using Force = Tensor<1, most_equations>; ///< of the equations there are, the others 0

/** What counts as nothing beside e. */
constexpr double negligible = 1e-12;

/** Resultants `G'z` of the points of a set, columns of G scaled to length one. */
class Resultants
{
public:
  Resultants(const FeasibleSet &feasible_set, const EqualityConstraints &constraints);

  /** The farthest one along @p motion, or a unit vector along which they have no end. */
  struct Extreme
  {
    Force place;
    bool is_ray;
  };
  Extreme farthest(const Force &motion) const;

  Force resultant(const Vector<double> &z) const;

  const FeasibleSet &feasible_set;
  const unsigned int n_equations;
  Force length, e; ///< of the columns; scaled right hand side
  std::vector<Force> rows;
};

Resultants::Resultants(const FeasibleSet &feasible_set, const EqualityConstraints &constraints)
    : feasible_set(feasible_set), n_equations(std::max<unsigned int>(3, constraints.e.size())),
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

/**
 * The resultant nearest to e by Wolfe's algorithm ("Finding the nearest point in a polytope", Math.
 * Programming 11, 1976), with rays beside points: the nearest point of what a few extremes span is moved
 * by one more extreme at a time, and those that lose their weight are dropped. Finite for polyhedra.
 */
class Nearest
{
public:
  explicit Nearest(const Resultants &resultants);

  Force residual; ///< e less the nearest point

private:
  struct Corner
  {
    Resultants::Extreme extreme;
    double weight;
  };

  bool add_corner();
  void minimise();
  std::vector<double> minimise_on_span();
  bool shorten(const std::vector<double> &weights);

  const Resultants &resultants;
  std::vector<Corner> corners; ///< affinely independent, at least one of them a point
};

Nearest::Nearest(const Resultants &resultants) : resultants(resultants)
{
  Vector<double> zero(resultants.rows.size());
  resultants.feasible_set.project(zero);
  corners.push_back({{resultants.resultant(zero), false}, 1.});
  minimise();
  // Many more than ever seen.
  for (unsigned int steps_left = 10000; steps_left > 0; --steps_left)
    if (residual.norm() <= 0.1 * negligible * resultants.e.norm() || !add_corner())
      return;
}

/** False if no extreme lies nearer to e. */
bool Nearest::add_corner()
{
  const double distance = residual.norm();
  const Resultants::Extreme extreme = resultants.farthest(residual);
  if (!extreme.is_ray)
  {
    const double gain = residual * (extreme.place - resultants.e) + distance * distance,
                 size = std::max(extreme.place.norm(), resultants.e.norm());
    if (gain <= distance * std::max(1e-9 * distance, 1e-15 * size))
      return false;
  }
  if (corners.size() > resultants.n_equations)
    return false; // their span is all there is: what remains is round-off
  corners.push_back({extreme, 0.});
  minimise();
  return residual.norm() < distance;
}

void Nearest::minimise()
{
  while (!shorten(minimise_on_span()))
    ;
}

/** Sets the residual of the nearest point of the affine span and returns that point's weights. */
std::vector<double> Nearest::minimise_on_span()
{
  const auto base = std::max_element(
      corners.begin(), corners.end(),
      [](const Corner &a, const Corner &b)
      { return (a.extreme.is_ray ? -1. : a.weight) < (b.extreme.is_ray ? -1. : b.weight); });
  residual = resultants.e - base->extreme.place;
  std::vector<Force> basis;
  std::vector<std::vector<double>> R; // columns of the triangle in edges = basis R
  std::vector<double> product(corners.size()), weights(corners.size());
  for (const Corner &corner : corners)
  {
    if (&corner == &*base)
      continue;
    Force edge = corner.extreme.place - (corner.extreme.is_ray ? Force() : base->extreme.place);
    std::vector<double> column(basis.size() + 1);
    for (int pass = 0; pass < 2; ++pass) // the second removes the round-off of the first
      for (unsigned int k = 0; k < basis.size(); ++k)
      {
        const double part = basis[k] * edge;
        column[k] += part;
        edge -= part * basis[k];
      }
    column.back() = edge.norm();
    basis.push_back(column.back() > 0. ? edge / column.back() : edge);
    R.push_back(column);
  }
  for (int pass = 0; pass < 3; ++pass)
    for (unsigned int k = 0; k < basis.size(); ++k)
    {
      const double part = basis[k] * residual;
      product[k] += part;
      residual -= part * basis[k];
    }
  weights[base - corners.begin()] = 1.;
  for (unsigned int k = basis.size(), i = corners.size(); k-- > 0;)
  {
    do
      --i;
    while (&corners[i] == &*base);
    weights[i] = R[k].back() > 0. ? product[k] / R[k].back() : 0.;
    for (unsigned int l = 0; l < k; ++l)
      product[l] -= weights[i] * R[k][l];
    if (!corners[i].extreme.is_ray)
      weights[base - corners.begin()] -= weights[i];
  }
  return weights;
}

/** Go towards @p weights as far as all stay positive. True if that is all the way. */
bool Nearest::shorten(const std::vector<double> &weights)
{
  double part = 1.;
  unsigned int blocking = corners.size();
  for (unsigned int k = 0; k < corners.size(); ++k)
    if (weights[k] <= 0. && corners[k].weight <= part * (corners[k].weight - weights[k]))
    {
      part = corners[k].weight - weights[k] > 0.
                 ? corners[k].weight / (corners[k].weight - weights[k])
                 : 0.;
      blocking = k;
    }
  for (unsigned int k = 0; k < corners.size(); ++k)
    corners[k].weight += part * (weights[k] - corners[k].weight);
  if (blocking == corners.size())
    return true;
  corners.erase(corners.begin() + blocking);
  return false;
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
  const Force motion = Nearest(resultants).residual;
  if (motion.norm() == 0.)
    return {};
  const Resultants::Extreme extreme = resultants.farthest(motion);
  const double load = motion * resultants.e, resistance = motion * extreme.place;
  if (extreme.is_ray || !(load - resistance > negligible * motion.norm() * resultants.e.norm()))
    return {};

  unsigned int largest = 0;
  for (unsigned int j = 0; j < constraints.e.size(); ++j)
    if (std::abs(motion[j]) > std::abs(motion[largest]))
      largest = j;
  const double unit = std::abs(motion[largest]) / resultants.length[largest];
  Imbalance result{Vector<double>(constraints.e.size()), load / unit, resistance / unit};
  for (unsigned int j = 0; j < constraints.e.size(); ++j)
    result.motion[j] = motion[j] / resultants.length[j] / unit;
  return result;
}
} // namespace hpvi
