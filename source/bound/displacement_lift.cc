// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/bound/displacement_lift.h>
#include <hpvi/bound/legendre.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr unsigned int powers[] = {1, 2, 3, 4, 6, 8, 12, 16, 24, 36, 60};

/** By s in [0,1]; coefficients of Legendre polynomials in both. */
Vector<double> derivative(const Vector<double> &f)
{
  Vector<double> result(f.size());
  for (unsigned int i = 0; i < f.size(); ++i)
    for (unsigned int j = 0; j < i; ++j)
      result[j] += 2 * legendre::derivative(i, j) * f[i];
  return result;
}

/** `int_0^s f`, by `(2i + 1) P_i = P_{i+1}' - P_{i-1}'`; the last coefficient of f is zero. */
Vector<double> integral(const Vector<double> &f)
{
  Vector<double> result(f.size());
  const auto add = [&](const unsigned int i, const double of_P)
  { result[i] += of_P / legendre::at_end(i, true); };
  for (unsigned int i = 0; i + 1 < f.size(); ++i)
  {
    const double part = 0.5 * f[i] * legendre::at_end(i, true) / (2 * i + 1);
    add(i + 1, part);
    add(i == 0 ? 0 : i - 1, i == 0 ? part : -part);
  }
  return result;
}

/** |delta(s) (1 - n)^q|_a^2 on a cell that is no parallelogram, or around an axis, least over some q. */
double distorted_energy(const CellMap<2> &map, const unsigned int face,
                        const std::vector<EdgePoint> &delta, const Material &material,
                        const ShapeTables<2> &tables)
{
  const unsigned int along = face < 2 ? 1 : 0;
  const HookesLaw<2> law(material);
  const bool is_axisymmetric = material.plane == PlaneModel::axisymmetric;
  const QGauss<1> &across = tables.gauss(64);
  std::array<double, std::size(powers)> energies{};
  for (const auto &[s, of_s, value, by_s] : delta)
    for (unsigned int b = 0; b < across.size(); ++b)
    {
      const double left = across.point(b)[0]; // 1 - n
      Point<2> xi;
      xi[along] = s;
      xi[1 - along] = face % 2 ? left : 1 - left;
      const Tensor<2, 2> J = map.jacobian(xi), inverse = invert(J);
      const Point<2> x = map.point(xi);
      const double weight =
          of_s * across.weight(b) * determinant(J) * (is_axisymmetric ? full_turn(x) : 1.);
      for (unsigned int k = 0; k < energies.size(); ++k)
      {
        const double power = std::pow(left, powers[k] - 1.);
        Tensor<2, 2> reference;
        for (unsigned int c = 0; c < 2; ++c)
        {
          reference[c][along] = by_s[c] * power * left;
          reference[c][1 - along] = (face % 2 ? 1. : -1.) * powers[k] * value[c] * power;
        }
        const double hoop = is_axisymmetric ? value[0] * power * left / x[0] : 0.;
        energies[k] += weight * law.energy_product(reference * inverse, hoop);
      }
    }
  return *std::min_element(energies.begin(), energies.end());
}

/** The parts of |delta(s) b(n)|_a^2 on a parallelogram: `along int b b + across int b' b' + mixed int b b'`. */
struct ProductEnergies
{
  ProductEnergies(const CellMap<2> &map, const unsigned int face,
                  const std::vector<EdgePoint> &delta, const HookesLaw<2> &law)
  {
    Tensor<2, 2> slopes, values, of_both; // int over s of products of components
    for (const EdgePoint &at : delta)
    {
      slopes += at.weight * outer_product(at.slope, at.slope);
      values += at.weight * outer_product(at.value, at.value);
      of_both += at.weight * outer_product(at.slope, at.value);
    }
    const Tensor<2, 2> J = map.jacobian({0.5, 0.5}), inverse = invert(J);
    const unsigned int s = face < 2 ? 1 : 0, n = 1 - s;
    for (unsigned int c = 0; c < 2; ++c)
      for (unsigned int d = 0; d < 2; ++d)
      {
        // int over the reference cell of d_k phi_c d_l phi_d, less its factor across
        const auto energy = [&](const unsigned int k, const unsigned int l, const double product)
        {
          return determinant(J) * law.stiffness([&](const unsigned int i, const unsigned int j)
                                                { return inverse[k][i] * inverse[l][j] * product; },
                                                c, d);
        };
        along += energy(s, s, slopes[c][d]);
        across += energy(n, n, values[c][d]);
        mixed += energy(s, n, of_both[c][d]) + energy(n, s, of_both[d][c]);
      }
  }

  double along = 0, across = 0, mixed = 0;
};

/** a, a', a'', b and b' of lift_energy(), and the integrals of their products for all q and r. */
class Profiles
{
public:
  enum
  {
    a,
    slope_of_a,
    curvature_of_a,
    b,
    slope_of_b,
    n_profiles
  };
  using Products = std::array<std::array<double, n_profiles>, n_profiles>;

  Profiles()
  {
    const QGauss<1> gauss(64);
    for (const unsigned int q : powers)
      for (const unsigned int r : powers)
      {
        if (q < 2)
          continue;
        Products sum{};
        for (unsigned int k = 0; k < gauss.size(); ++k)
        {
          const double n = gauss.point(k)[0], power = std::pow(1 - n, q - 2.),
                       of_b = std::pow(1 - n, r - 1.);
          const std::array<double, n_profiles> at{
              {power * (1 - n) * (1 - n) * (1 + q * n), -1. * q * (q + 1) * n * power * (1 - n),
               q * (q + 1) * power * (q * n - 1), of_b * (1 - n), -1. * r * of_b}};
          for (unsigned int i = 0; i < n_profiles; ++i)
            for (unsigned int j = 0; j < n_profiles; ++j)
              sum[i][j] += gauss.weight(k) * at[i] * at[j];
        }
        products.push_back(sum);
      }
  }

  std::vector<Products> products; ///< of all pairs of powers
};

/** f(s) times a profile: a part of the derivative of component c by variable k, 0 along and 1 across. */
struct Term
{
  Vector<double> f;
  unsigned int profile, c, k;
};

/** Those of the lift that changes the volume little; @p delta has components along a_s and a_n. */
std::array<Term, 8> solenoidal_terms(const std::array<Vector<double>, 2> &delta)
{
  const unsigned int size = delta[0].size() + 1;
  Vector<double> T(delta[0]), D(delta[1]), B(size); // delta_s, -F', m B with B = P_0 - P_2
  T.grow_or_shrink(size);
  D.grow_or_shrink(size);
  B[0] = D[0];
  B[2] = -D[0] * legendre::at_end(0, true) / legendre::at_end(2, true);
  D -= B;
  Vector<double> minus_D(D), F = integral(D);
  minus_D *= -1.;
  F *= -1.;
  return {{{minus_D, Profiles::slope_of_a, 0, 0},
           {F, Profiles::curvature_of_a, 0, 1},
           {derivative(D), Profiles::a, 1, 0},
           {D, Profiles::slope_of_a, 1, 1},
           {derivative(T), Profiles::b, 0, 0},
           {T, Profiles::slope_of_b, 0, 1},
           {derivative(B), Profiles::b, 1, 0},
           {B, Profiles::slope_of_b, 1, 1}}};
}

/** Its energy, least over q and r. */
double solenoidal_energy(const CellMap<2> &map, const unsigned int face,
                         const std::array<Vector<double>, 2> &delta, const HookesLaw<2> &law)
{
  static const Profiles profiles;
  const Tensor<2, 2> J = map.jacobian({0.5, 0.5});
  const unsigned int along = face < 2 ? 1 : 0;
  Tensor<2, 2> A; // columns a_s and a_n
  for (unsigned int i = 0; i < 2; ++i)
  {
    A[i][0] = J[i][along];
    A[i][1] = (face % 2 ? -1. : 1.) * J[i][1 - along];
  }
  const Tensor<2, 2> inverse = invert(A);
  std::array<Vector<double>, 2> own{{delta[0], delta[0]}};
  for (unsigned int c = 0; c < 2; ++c)
  {
    own[c].equ(inverse[c][0], delta[0]);
    own[c].add(inverse[c][1], delta[1]);
  }
  const std::array<Term, 8> terms = solenoidal_terms(own);
  const auto gradient = [&](const Term &term)
  {
    Tensor<2, 2> result;
    for (unsigned int x = 0; x < 2; ++x)
      for (unsigned int y = 0; y < 2; ++y)
        result[x][y] = A[x][term.c] * inverse[term.k][y];
    return result;
  };
  Profiles::Products weights{};
  for (const Term &one : terms)
    for (const Term &other : terms)
      weights[one.profile][other.profile] +=
          0.5 * (one.f * other.f) * std::abs(determinant(A)) *
          scalar_product(Tensor<2, 2>(law.stress(gradient(one))), gradient(other));
  double best = std::numeric_limits<double>::infinity();
  for (const Profiles::Products &products : profiles.products)
  {
    double energy = 0;
    for (unsigned int i = 0; i < Profiles::n_profiles; ++i)
      for (unsigned int j = 0; j < Profiles::n_profiles; ++j)
        energy += weights[i][j] * products[i][j];
    best = std::min(best, energy);
  }
  return best;
}
/** Is the energy one of products of functions along and across the cell? */
bool is_plane_product(const CellMap<2> &map, const Material &material)
{
  return map.is_affine() && material.plane != PlaneModel::axisymmetric;
}
} // namespace

std::vector<EdgePoint> edge_points(const std::array<Vector<double>, 2> &delta,
                                   const unsigned int more, const ShapeTables<2> &tables)
{
  const unsigned int n = delta[0].size();
  const std::array<Vector<double>, 2> slope{{derivative(delta[0]), derivative(delta[1])}};
  const QGauss<1> &gauss = tables.gauss(n + more);
  std::vector<EdgePoint> result;
  for (unsigned int q = 0; q < gauss.size(); ++q)
  {
    const double s = gauss.point(q)[0];
    const std::vector<double> L = legendre::values(n, 2 * s - 1);
    EdgePoint &at = result.emplace_back(EdgePoint{s, gauss.weight(q), {}, {}});
    for (unsigned int c = 0; c < 2; ++c)
      for (unsigned int i = 0; i < n; ++i)
      {
        at.value[c] += delta[c][i] * L[i];
        at.slope[c] += slope[c][i] * L[i];
      }
  }
  return result;
}

double lift_energy(const CellMap<2> &map, const unsigned int face,
                   const std::array<Vector<double>, 2> &delta, const Material &material,
                   const ShapeTables<2> &tables)
{
  if (delta[0].all_zero() && delta[1].all_zero())
    return 0.;
  const double energy = lift_energy(map, face, edge_points(delta, 2, tables), material, tables);
  return is_plane_product(map, material)
             ? std::min(energy, solenoidal_energy(map, face, delta, HookesLaw<2>(material)))
             : energy;
}

double lift_energy(const CellMap<2> &map, const unsigned int face,
                   const std::vector<EdgePoint> &delta, const Material &material,
                   const ShapeTables<2> &tables)
{
  if (!is_plane_product(map, material))
    return distorted_energy(map, face, delta, material, tables);
  // Of int b b, int b' b' and int b b' the energy is a linear function.
  const ProductEnergies parts(map, face, delta, HookesLaw<2>(material));
  double best = std::numeric_limits<double>::infinity();
  for (unsigned int q = 1; q <= 60; ++q)
    best = std::min(best, parts.along / (2 * q + 1) + parts.across * q * q / (2 * q - 1) -
                              0.5 * (face % 2 ? -1. : 1.) * parts.mixed);
  return best;
}

double spring_energy(const Scene<2> &scene, const BoundaryCondition<2> &condition,
                     const CellMap<2> &map, const unsigned int face,
                     const std::vector<EdgePoint> &delta)
{
  double sum = 0;
  for (const EdgePoint &at : delta)
    if (condition.spring)
    {
      const Point<2> xi = point_on_face<2>(face, Point<1>(at.s));
      sum +=
          at.weight * map.face_measure(face, xi) * scene.circumference(map.point(xi)) *
          (at.value * (condition.spring.stiffness(map.point(xi), map.normal(face, xi)) * at.value));
    }
  return sum;
}
} // namespace hpvi
