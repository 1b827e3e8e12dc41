// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/quadrature_lib.h>
#include <hpvi/algebra/dense_algebra.h>
#include <hpvi/base/numerical_failure.h>
#include <hpvi/stresses/legendre.h>
#include <hpvi/stresses/stress_element.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Throws NumericalFailure unless a local matrix is positive definite. */
void require_regular(const bool is_positive_definite)
{
  if (!is_positive_definite)
    throw NumericalFailure("round-off spoils the stresses of a cell, as where it is many thousand "
                           "times as long as wide");
}

using Components = std::array<double, 3>; ///< xx, yy, xy

/** c(t) with c(0) = 1, c(1) = c'(1) = 0, its first and second derivative: of degree 4 where tractions may be. */
std::array<double, 3> cut_off(const unsigned int m, const double t)
{
  if (m < 5)
    return {{(1 - t) * (1 - t), -2 * (1 - t), 2.}};
  const double e = 1 - t * t;
  return {{e * e, -4 * e * t, 8 * t * t - 4 * e}};
}

/** The second derivatives of `r^2 F(theta) c(x) c(y)` that make its stress, x and y in [0,1] from the corner. */
Components corner_stress_from_corner(const unsigned int m, const double x, const double y)
{
  const double theta = std::atan2(y, x), D = numbers::PI / 4, r2 = x * x + y * y;
  const double P = -r2 * theta - x * y - D * (x * x - y * y) + D * r2;
  const double Px = -2 * x * theta, Py = -2 * y * theta - 2 * x + 4 * D * y;
  const double xy = r2 > 0 ? x * y / r2 : 0., cosine = r2 > 0 ? (x * x - y * y) / r2 : 1.;
  const double Pxx = -2 * theta + 2 * xy, Pyy = -2 * theta - 2 * xy + 4 * D, Pxy = -cosine - 1;
  const auto c = cut_off(m, x), d = cut_off(m, y);
  return {{(Pyy * d[0] + 2 * Py * d[1] + P * d[2]) * c[0],
           (Pxx * c[0] + 2 * Px * c[1] + P * c[2]) * d[0],
           -(Pxy * c[0] * d[0] + Px * c[0] * d[1] + Py * c[1] * d[0] + P * c[1] * d[1])}};
}

/** The stress of a marked corner at xi, eta in [-1,1]. */
Components corner_stress(const unsigned int m, const unsigned int corner, const double xi,
                         const double eta)
{
  const bool right = corner % 2, top = corner / 2;
  Components s = corner_stress_from_corner(m, right ? (1 - xi) / 2 : (1 + xi) / 2,
                                           top ? (1 - eta) / 2 : (1 + eta) / 2);
  s[2] *= right != top ? -1 : 1;
  return s;
}

/** Points and weights on [-1,1]^2: in each quarter Duffy's, collapsed into the corner. */
template <class F>
void for_each_corner_point(const unsigned int n_gauss, const F &f)
{
  const QGauss<1> gauss(n_gauss);
  for (unsigned int quarter = 0; quarter < 4; ++quarter)
    for (unsigned int a = 0; a < n_gauss; ++a)
      for (unsigned int b = 0; b < n_gauss; ++b)
      {
        const double u = gauss.point(a)[0], v = u * gauss.point(b)[0],
                     weight = u * gauss.weight(a) * gauss.weight(b);
        const double right = quarter % 2 ? 1 : -1, top = quarter / 2 ? 1 : -1;
        f(right * (1 - u), top * (1 - v), weight);
        f(right * (1 - v), top * (1 - u), weight);
      }
}
} // namespace

StressElement::StressElement(const unsigned int degree, const Tensor<2, 2> &B,
                             const Material &material, const unsigned int marked_corners)
    : m(degree), n_normal(m - 1), n_tangential(m), n_divergence(2 * m * (m - 1)),
      n_edges(4 * (2 * m - 1)), n_data(n_divergence + n_edges)
{
  set_compliance(B, material);
  set_tractions(B);
  for (unsigned int corner = 0; corner < 4; ++corner)
    if (marked_corners & (1u << corner))
      add_corner_stress(corner);
  set_conditions(B);
  for (unsigned int corner = 0; corner < 4; ++corner)
    if (!(marked_corners & (1u << corner)))
    {
      // S_xy from the edge along eta minus S_xy from the one along xi
      const bool right = corner % 2, top = corner / 2;
      std::vector<double> condition(n_data);
      for (const unsigned int along_xi : {0, 1})
      {
        const auto &T = traction[along_xi];
        const unsigned int face = along_xi ? 2 + top : right;
        const double sign = along_xi ? -1. : 1.;
        for (unsigned int i = 0; i < n_tangential; ++i)
        {
          const double end = sign * legendre::at_end(i, along_xi ? right : top) / T[2];
          condition[n_divergence + edge_entry(face, 1) + i] = end;
          if (i < n_normal)
            condition[n_divergence + edge_entry(face, 0) + i] = -end * T[1] / T[0];
        }
      }
      add_condition(condition);
    }
  factorise();
}

/** Energy of components: `s = B E_k B'`, `C^-1 s : s = (s : s - nu' tr(s)^2)/(2 mu)`, nu' = lambda/(2(lambda + mu)). */
void StressElement::set_compliance(const Tensor<2, 2> &B, const Material &material)
{
  const double mu = material.mu(), lambda = material.lambda(2), nu = lambda / (2 * (lambda + mu));
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
      compliance[k][l] = (scalar_product(s[k], s[l]) - nu * trace(s[k]) * trace(s[l])) / (2 * mu);
  for (unsigned int bits = 1; bits < 8; ++bits)
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
void StressElement::set_tractions(const Tensor<2, 2> &B)
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

bool StressElement::has(const unsigned int component, const unsigned int i,
                        const unsigned int j) const
{
  return component == 0   ? i <= m && j + 2 <= m
         : component == 1 ? i + 2 <= m && j <= m
                          : i + 1 <= m && j + 1 <= m;
}

template <class F>
void StressElement::for_each_datum(const unsigned int component, const unsigned int i,
                                   const unsigned int j, const F &f) const
{
  // d_xi of xx and xy, then d_eta of xy and yy
  const auto first = [&](const unsigned int a, const unsigned int b) { return a * (m - 1) + b; };
  const auto second = [&](const unsigned int a, const unsigned int b)
  { return m * (m - 1) + a * m + b; };
  if (component != 1)
    for (int a = static_cast<int>(i) - 1; a >= 0; a -= 2)
      f(component == 0 ? first(a, j) : second(a, j), legendre::derivative(i, a));
  if (component != 0)
    for (int b = static_cast<int>(j) - 1; b >= 0; b -= 2)
      f(component == 2 ? first(i, b) : second(i, b), legendre::derivative(j, b));
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
        f(n_divergence + edge_entry(face, 1) + along, T[2] * end);
      else
      {
        f(n_divergence + edge_entry(face, 0) + along, T[0] * end);
        if (T[1] != 0.)
          f(n_divergence + edge_entry(face, 1) + along, T[1] * end);
      }
    }
  }
}

Modes<3> StressElement::moments(const Modes<3> &stress) const
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

Modes<3> StressElement::inverse_compliance(const Modes<3> &moments) const
{
  Modes<3> result(m + 1);
  for (unsigned int i = 0; i <= m; ++i)
    for (unsigned int j = 0; j <= m; ++j)
      set_nearest(i, j, {{moments(0, i, j), moments(1, i, j), moments(2, i, j)}}, result);
  return result;
}

/** A mode from its moments, with the components that exist. */
void StressElement::set_nearest(const unsigned int i, const unsigned int j,
                                const Components &moments, Modes<3> &result) const
{
  const unsigned int bits = has(0, i, j) + 2 * has(1, i, j) + 4 * has(2, i, j);
  for (unsigned int k = 0; bits != 0 && k < 3; ++k)
    for (unsigned int l = 0; l < 3; ++l)
      result(k, i, j) += inverses[bits][k][l] * moments[l];
}

void StressElement::add_corner_stress(const unsigned int corner)
{
  CornerStress result{corner, Modes<3>(m + 1), Modes<3>(), std::vector<double>(n_data)};
  std::vector<double> energies(corners.size() + 1);
  for_each_corner_point(
      m + 12,
      [&](const double xi, const double eta, const double weight)
      {
        const Components s = corner_stress(m, corner, xi, eta);
        Components e{};
        for (unsigned int k = 0; k < 3; ++k)
          for (unsigned int l = 0; l < 3; ++l)
            e[k] += weight * compliance[k][l] * s[l];
        const auto Li = legendre::values(m + 1, xi), Lj = legendre::values(m + 1, eta);
        for (unsigned int k = 0; k < 3; ++k)
          for (unsigned int i = 0; i <= m; ++i)
            for (unsigned int j = 0; j <= m; ++j)
              result.moments(k, i, j) += e[k] * Li[i] * Lj[j];
        for (unsigned int other = 0; other <= corners.size(); ++other)
        {
          const Components t =
              other == corners.size() ? s : corner_stress(m, corners[other].corner, xi, eta);
          energies[other] += e[0] * t[0] + e[1] * t[1] + e[2] * t[2];
        }
      });
  result.nearest = inverse_compliance(result.moments);
  for (unsigned int k = 0; k < 3; ++k)
    for (unsigned int i = 0; i <= m; ++i)
      for (unsigned int j = 0; j <= m; ++j)
        if (has(k, i, j))
          for_each_datum(k, i, j,
                         [&](const unsigned int row, const double entry)
                         { result.data[row] -= entry * result.nearest(k, i, j); });
  const QGauss<1> gauss(m + 2);
  for (unsigned int q = 0; q < gauss.size(); ++q)
  {
    const double xi = 2 * gauss.point(q)[0] - 1;
    const double shear = corner_stress(m, corner, xi, corner / 2 ? 1. : -1.)[2];
    const auto Li = legendre::values(n_tangential, xi);
    for (unsigned int i = 0; i < n_tangential; ++i)
      result.data[n_divergence + edge_entry(2 + corner / 2, 1) + i] +=
          2 * gauss.weight(q) * traction[1][2] * shear * Li[i];
  }
  corners.push_back(result);
  // What projections hold already does not count.
  const unsigned int n = corners.size();
  std::vector<double> enlarged(n * n);
  for (unsigned int k = 0; k + 1 < n; ++k)
    for (unsigned int l = 0; l + 1 < n; ++l)
      enlarged[k * n + l] = corner_energy[k * (n - 1) + l];
  for (unsigned int k = 0; k < n; ++k)
  {
    double energy = energies[k];
    energy -= std::inner_product(corners[k].nearest.coefficients.begin(),
                                 corners[k].nearest.coefficients.end(),
                                 result.moments.coefficients.begin(), 0.);
    enlarged[k * n + n - 1] = enlarged[(n - 1) * n + k] = energy;
  }
  corner_energy = enlarged;
}

/** Of length 1, but not orthogonal to the others: a corner sees its two edges alone, and patches count on that. */
void StressElement::add_condition(const std::vector<double> &condition)
{
  const double norm =
      std::sqrt(std::inner_product(condition.begin(), condition.end(), condition.begin(), 0.));
  for (const double entry : condition)
    N.push_back(entry / norm);
}

/** Equilibrium: `int Div S . B'z` is the work of the tractions on a rigid motion z, in coordinates B (xi, eta)'. */
void StressElement::set_conditions(const Tensor<2, 2> &B)
{
  for (unsigned int motion = 0; motion < 3; ++motion)
  {
    const auto z = [&](const double xi, const double eta)
    {
      const Tensor<1, 2> x = B * Tensor<1, 2>({xi, eta});
      return motion < 2 ? Tensor<1, 2>({double(motion == 0), double(motion == 1)})
                        : Tensor<1, 2>({-x[1], x[0]});
    };
    std::vector<double> condition(n_data);
    const QGauss<1> gauss(2);
    for (unsigned int a = 0; a < 2; ++a)
    {
      const double xi = 2 * gauss.point(a)[0] - 1;
      const auto Li = legendre::values(2, xi);
      for (unsigned int b = 0; b < 2; ++b)
      {
        const double eta = 2 * gauss.point(b)[0] - 1;
        const auto Lj = legendre::values(2, eta);
        const Tensor<1, 2> pulled = transpose(B) * z(xi, eta);
        for (unsigned int i = 0; i < 2; ++i)
          for (unsigned int j = 0; j < 2; ++j)
          {
            condition[i * (m - 1) + j] += pulled[0] * Li[i] * Lj[j];
            condition[m * (m - 1) + i * m + j] += pulled[1] * Li[i] * Lj[j];
          }
      }
      for (unsigned int face = 0; face < 4; ++face)
      {
        const bool along_xi = face >= 2;
        const double side = face % 2 ? 1. : -1.;
        Tensor<1, 2> along{{B[0][1 - along_xi], B[1][1 - along_xi]}};
        const Tensor<1, 2> normal{
            {along_xi ? -along[1] : along[1], along_xi ? along[0] : -along[0]}}; // times length
        const Tensor<1, 2> at = along_xi ? z(xi, side) : z(side, xi);
        for (unsigned int i = 0; i < 2; ++i)
        {
          condition[n_divergence + edge_entry(face, 0) + i] -= side * Li[i] * (normal * at);
          condition[n_divergence + edge_entry(face, 1) + i] -= side * Li[i] * (along * at);
        }
      }
    }
    add_condition(condition);
  }
}

/**
 * `G = (A M^-1 A' + alpha N N')^-1` with M the energy of all stresses: on data that meet the conditions
 * N it does not depend on alpha.
 */
void StressElement::factorise()
{
  std::vector<double> S(n_data * n_data);
  std::array<std::vector<std::pair<unsigned int, double>>, 3> columns;
  for (unsigned int i = 0; i <= m; ++i)
    for (unsigned int j = 0; j <= m; ++j)
    {
      unsigned int bits = 0;
      for (unsigned int k = 0; k < 3; ++k)
      {
        columns[k].clear();
        if (!has(k, i, j))
          continue;
        bits += 1u << k;
        for_each_datum(k, i, j,
                       [&](const unsigned int row, const double entry)
                       { columns[k].emplace_back(row, entry); });
      }
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int l = 0; l < 3; ++l)
          if (const double weight = inverses[bits][k][l])
            for (const auto &[column, b] : columns[l])
              for (const auto &[row, a] : columns[k])
                S[column * n_data + row] += weight * a * b;
    }
  const unsigned int n_corners = corners.size();
  if (n_corners > 0)
  {
    require_regular(cholesky(n_corners, corner_energy.data(), n_corners));
    std::vector<double> data(n_corners * n_data); // by rows of L^-1 (data of all corners)
    for (unsigned int k = 0; k < n_corners; ++k)
      for (unsigned int i = 0; i < n_data; ++i)
        data[i * n_corners + k] = corners[k].data[i];
    solve_triangular('N', n_corners, n_data, {corner_energy.data(), n_corners}, data.data(),
                     n_corners);
    multiply('T', 'N', n_data, n_data, n_corners, 1., {data.data(), n_corners},
             {data.data(), n_corners}, 1., S.data(), n_data);
  }
  double alpha = 0;
  for (unsigned int i = 0; i < n_data; ++i)
    alpha += S[i * n_data + i] / n_data;
  multiply('N', 'T', n_data, n_data, n_conditions(), alpha, {N.data(), n_data}, {N.data(), n_data},
           1., S.data(), n_data);
  L = std::move(S);
  require_regular(cholesky(n_data, L.data(), n_data));
  G_edges.assign(n_data * n_edges, 0.);
  for (unsigned int i = 0; i < n_edges; ++i)
    G_edges[i * n_data + n_divergence + i] = 1.;
  solve_triangular('N', n_edges, n_edges, {&L[n_divergence * n_data + n_divergence], n_data},
                   &G_edges[n_divergence], n_data);
  solve_triangular('T', n_data, n_edges, {L.data(), n_data}, G_edges.data(), n_data);
}

unsigned int StressElement::n_conditions() const
{
  return N.size() / n_data;
}

const std::vector<double> &StressElement::conditions() const
{
  return N;
}

const std::vector<double> &StressElement::edge_energy() const
{
  return G_edges;
}

void StressElement::half_energy(std::vector<double> &R, const unsigned int columns) const
{
  solve_triangular('N', n_data, columns, {L.data(), n_data}, R.data(), n_data);
}

/** Amplitudes of corner stresses, without their projections, nearest to a stress; q is its own. */
std::vector<double> StressElement::corner_amplitudes(const Modes<3> &stress,
                                                     const Modes<3> &q_moments) const
{
  std::vector<double> result(corners.size());
  for (unsigned int c = 0; c < corners.size(); ++c)
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int i = 0; i <= m; ++i)
        for (unsigned int j = 0; j <= m; ++j)
          result[c] +=
              (i < stress.n && j < stress.n ? corners[c].moments(k, i, j) * stress(k, i, j) : 0.) -
              corners[c].nearest(k, i, j) * q_moments(k, i, j);
  const unsigned int n = corners.size();
  for (const char op : {'N', 'T'})
    solve_triangular(op, n, 1, {corner_energy.data(), n}, result.data(), n);
  return result;
}

/** Where all components exist, that is the stress itself. */
Modes<3> StressElement::nearest(const Modes<3> &stress, std::vector<double> &amplitudes) const
{
  if (!corners.empty())
    amplitudes = corner_amplitudes(stress, moments(stress));
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
 * r -= A q, the data of a stress as for_each_datum() has them: since `L_i' = root(i) sum root(a) L_a` over
 * a = i-1, i-3, ..., sums over the even and the odd modes from the highest one down are all it takes.
 */
void StressElement::subtract_data(const Modes<3> &q, double *const r) const
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

void StressElement::residual(const Modes<3> &stress, const Modes<2> &divergence,
                             double *const r) const
{
  std::fill(r, r + n_data, 0.);
  const unsigned int n = std::min(divergence.n, m);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n; ++j)
    {
      if (j + 1 < m)
        r[i * (m - 1) + j] = divergence(0, i, j);
      if (i + 1 < m)
        r[m * (m - 1) + i * m + j] = divergence(1, i, j);
    }
  std::vector<double> amplitudes;
  subtract_data(nearest(stress, amplitudes), r);
  for (unsigned int c = 0; c < corners.size(); ++c)
    for (unsigned int i = 0; i < n_data; ++i)
      r[i] -= amplitudes[c] * corners[c].data[i];
}

/** `M^-1 A' G r` beside q. */
StressElement::Stress StressElement::stress(const Modes<3> &stress, const double *const r) const
{
  std::vector<double> y(r, r + n_data);
  for (const char op : {'N', 'T'})
    solve_triangular(op, n_data, 1, {L.data(), n_data}, y.data(), n_data);
  Modes<3> right(m + 1);
  for (unsigned int k = 0; k < 3; ++k)
    for (unsigned int i = 0; i <= m; ++i)
      for (unsigned int j = 0; j <= m; ++j)
        if (has(k, i, j))
          for_each_datum(k, i, j,
                         [&](const unsigned int row, const double entry)
                         { right(k, i, j) += entry * y[row]; });
  std::vector<double> amplitudes;
  Stress result{nearest(stress, amplitudes), {}, m};
  const Modes<3> added = inverse_compliance(right);
  const unsigned int n = corners.size();
  std::vector<double> more(n);
  for (unsigned int c = 0; c < n; ++c)
    more[c] = std::inner_product(y.begin(), y.end(), corners[c].data.begin(), 0.);
  for (const char op : {'N', 'T'})
    solve_triangular(op, n, 1, {corner_energy.data(), n}, more.data(), n);
  for (unsigned int i = 0; i < result.modes.coefficients.size(); ++i)
  {
    result.modes.coefficients[i] += added.coefficients[i];
    for (unsigned int c = 0; c < n; ++c)
      result.modes.coefficients[i] -=
          (amplitudes[c] + more[c]) * corners[c].nearest.coefficients[i];
  }
  for (unsigned int c = 0; c < n; ++c)
    result.corners.emplace_back(corners[c].corner, amplitudes[c] + more[c]);
  return result;
}

std::array<double, 3> StressElement::Stress::value(const double xi, const double eta) const
{
  const auto Li = legendre::values(m + 1, xi), Lj = legendre::values(m + 1, eta);
  Components s{};
  for (unsigned int k = 0; k < 3; ++k)
    for (unsigned int i = 0; i <= m; ++i)
      for (unsigned int j = 0; j <= m; ++j)
        s[k] += modes(k, i, j) * Li[i] * Lj[j];
  for (const auto &[corner, amplitude] : corners)
  {
    const Components c = corner_stress(m, corner, xi, eta);
    for (unsigned int k = 0; k < 3; ++k)
      s[k] += amplitude * c[k];
  }
  return s;
}
} // namespace hpvi
