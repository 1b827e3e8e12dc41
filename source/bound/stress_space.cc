// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/bound/legendre.h>
#include <hpvi/bound/stress_space.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

using Components = std::array<double, 3>; // xx, yy, xy

StressSpace::StressSpace(const unsigned int degree, const Tensor<2, 2> &B, const Material &material)
    : m(degree), n_normal(m - 1), n_tangential(m), n_divergence(2 * m * (m - 1)),
      n_edges(4 * (2 * m - 1)), n_data(n_divergence + n_edges)
{
  set_compliance(B, material);
  set_tractions(B);
}

/** Energy `C^-1 s : t` of components, `s = B E_k B'`. */
void StressSpace::set_compliance(const Tensor<2, 2> &B, const Material &material)
{
  const HookesLaw<2> law(material);
  std::array<Tensor<2, 2>, 3> s;
  for (unsigned int k = 0; k < 3; ++k)
  {
    Tensor<2, 2> E;
    E[k == 1][k != 0] = 1.;
    E[k != 0][k == 1] = 1.;
    s[k] = B * E * transpose(B);
  }
  for (unsigned int k = 0; k < 3; ++k)
    for (unsigned int l = 0; l < 3; ++l)
      compliance[k][l] = law.complementary_product(s[k], s[l]);
  for (unsigned int bits = 0; bits < 8; ++bits) // of none: zero
  {
    // Inverse of the rows and columns in bits, the others left out.
    Tensor<2, 3> part;
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int l = 0; l < 3; ++l)
        part[k][l] = (bits >> k & 1) && (bits >> l & 1) ? compliance[k][l] : double(k == l);
    part = invert(part);
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int l = 0; l < 3; ++l)
        inverses[bits][k][l] = (bits >> k & 1) && (bits >> l & 1) ? part[k][l] : 0.;
  }
}

/** `s n = B S e / |B^-T e|` with e the first or second unit vector. */
void StressSpace::set_tractions(const Tensor<2, 2> &B)
{
  for (const unsigned int along_xi : {0, 1})
  {
    Tensor<1, 2> across, along; // columns of B
    for (unsigned int c = 0; c < 2; ++c)
    {
      across[c] = B[c][along_xi];
      along[c] = B[c][1 - along_xi];
    }
    const double length = along.norm();
    const Tensor<1, 2> tangent = along / length;
    Tensor<1, 2> normal;
    normal[0] = along_xi ? -tangent[1] : tangent[1];
    normal[1] = along_xi ? tangent[0] : -tangent[0];
    const bool is_skew = std::abs(across * tangent) > 1e-10 * across.norm(); // or round-off
    // |B^-T e| is the length of the edge, since det B = 1
    traction[along_xi] = {{across * normal / length, is_skew ? across * tangent / length : 0., 1.}};
  }
}

bool StressSpace::has(const unsigned int component, const unsigned int i,
                      const unsigned int j) const
{
  return component == 0   ? i <= m && j + 2 <= m
         : component == 1 ? i + 2 <= m && j <= m
                          : i + 1 <= m && j + 1 <= m;
}

unsigned int StressSpace::present(const unsigned int i, const unsigned int j) const
{
  return has(0, i, j) + 2 * has(1, i, j) + 4 * has(2, i, j);
}

void StressSpace::set_data(const unsigned int component, const unsigned int i, const unsigned int j,
                           Data &data) const
{
  data.clear();
  if (!has(component, i, j))
    return;
  // d_xi of xx and xy, then d_eta of xy and yy
  const auto first = [&](const unsigned int a, const unsigned int b) { return a * (m - 1) + b; };
  const auto second = [&](const unsigned int a, const unsigned int b)
  { return m * (m - 1) + a * m + b; };
  if (component != 1)
    for (int a = static_cast<int>(i) - 1; a >= 0; a -= 2)
      data.emplace_back(component == 0 ? first(a, j) : second(a, j), legendre::derivative(i, a));
  if (component != 0)
    for (int b = static_cast<int>(j) - 1; b >= 0; b -= 2)
      data.emplace_back(component == 2 ? first(i, b) : second(i, b), legendre::derivative(j, b));
  for (const unsigned int along_xi : {0, 1})
  {
    if (component == 1 - along_xi)
      continue; // it has no part in the traction of this edge
    const auto &T = traction[along_xi];
    const unsigned int across = along_xi ? j : i, along = along_xi ? i : j;
    for (const unsigned int side : {0, 1})
    {
      const double end = legendre::at_end(across, side);
      const unsigned int face = 2 * along_xi + side;
      if (component == 2)
        data.emplace_back(n_divergence + edge_entry(face, 1) + along, T[2] * end);
      else
      {
        data.emplace_back(n_divergence + edge_entry(face, 0) + along, T[0] * end);
        if (T[1] != 0.)
          data.emplace_back(n_divergence + edge_entry(face, 1) + along, T[1] * end);
      }
    }
  }
}

Modes<3> StressSpace::moments(const Modes<3> &stress) const
{
  Modes<3> result(m + 1);
  const unsigned int n = std::min(stress.n, m + 1);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int k = 0; k < 3; ++k)
        if (has(k, i, j))
          for (unsigned int l = 0; l < 3; ++l)
            result(k, i, j) += compliance[k][l] * stress(l, i, j);
  return result;
}

Modes<3> StressSpace::inverse_compliance(const Modes<3> &moments) const
{
  Modes<3> result(m + 1);
  for (unsigned int i = 0; i <= m; ++i)
    for (unsigned int j = 0; j <= m; ++j)
      set_nearest(i, j, {{moments(0, i, j), moments(1, i, j), moments(2, i, j)}}, result);
  return result;
}

/** A mode from its moments, with the components that exist. */
void StressSpace::set_nearest(const unsigned int i, const unsigned int j, const Components &moments,
                              Modes<3> &result) const
{
  const unsigned int bits = present(i, j);
  for (unsigned int k = 0; bits != 0 && k < 3; ++k)
    for (unsigned int l = 0; l < 3; ++l)
      result(k, i, j) += inverses[bits][k][l] * moments[l];
}

/** Where all components exist, that is the stress itself. */
Modes<3> StressSpace::nearest(const Modes<3> &stress) const
{
  Modes<3> result(m + 1);
  const unsigned int n = std::min(stress.n, m + 1);
  for (unsigned int i = 0; i < n; ++i)
  {
    const unsigned int n_whole = i + 2 <= m ? std::min(n, m - 1) : 0;
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int j = 0; j < n_whole; ++j)
        result(k, i, j) = stress(k, i, j);
    for (unsigned int j = n_whole; j < n; ++j)
    {
      const Components s{{stress(0, i, j), stress(1, i, j), stress(2, i, j)}};
      if (s[0] == 0. && s[1] == 0. && s[2] == 0.)
        continue;
      Components e{};
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int l = 0; l < 3 && has(k, i, j); ++l)
          e[k] += compliance[k][l] * s[l];
      set_nearest(i, j, e, result);
    }
  }
  return result;
}

/**
 * r -= A q, the data of a stress as set_data() has them: since `L_i' = root(i) sum root(a) L_a` over
 * a = i-1, i-3, ..., sums over the even and the odd modes from the highest one down are all it takes.
 */
void StressSpace::subtract_data(const Modes<3> &q, double *const r) const
{
  double *const first = r, *const second = r + m * (m - 1);
  std::array<std::vector<double>, 2> sums;
  for (const unsigned int component : {0, 1, 2})
    for (const unsigned int along_xi : {0, 1}) // derivative by xi (0) or eta (1)
    {
      if (component == 1 - along_xi)
        continue;
      // Modes `across` of the variable of the derivative, `along` of the other one.
      const unsigned int n_across = component == 2 ? m : m + 1,
                         n_along = component == 2 ? m : m - 1;
      const unsigned int q_across = along_xi ? 1 : m + 1, q_along = along_xi ? m + 1 : 1;
      // xx and yy stand in their own equation, xy in the other one.
      const bool is_first = (component == 2) == bool(along_xi);
      const unsigned int row = is_first ? m - 1 : m;
      double *const target = is_first ? first : second;
      const unsigned int t_across = along_xi ? 1 : row, t_along = along_xi ? row : 1;
      for (auto &sum : sums)
        sum.assign(n_along, 0.);
      for (unsigned int i = n_across; i-- > 0;)
      {
        const double root = legendre::root(i);
        const double *const from = &q.coefficients[component * q.n * q.n + i * q_across];
        double *const to = target + i * t_across;
        std::vector<double> &same = sums[i % 2], &other = sums[1 - i % 2];
        if (i + 1 < n_across)
          for (unsigned int j = 0; j < n_along; ++j)
            to[j * t_along] -= root * other[j];
        for (unsigned int j = 0; j < n_along; ++j)
          same[j] += root * from[j * q_along];
      }
      const auto &T = traction[along_xi];
      for (const unsigned int side : {0, 1})
        for (unsigned int j = 0; j < n_along; ++j)
        {
          const double end =
              0.70710678118654752440 * (sums[0][j] + (side == 0 ? -sums[1][j] : sums[1][j]));
          double *const edge = r + n_divergence + edge_entry(2 * along_xi + side, 0);
          if (component == 2)
            edge[n_normal + j] -= T[2] * end;
          else
          {
            edge[j] -= T[0] * end;
            edge[n_normal + j] -= T[1] * end;
          }
        }
    }
}
} // namespace hpvi
