// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/quadrature_lib.h>
#include <hpvi/algebra/dense_algebra.h>
#include <hpvi/algebra/triangular.h>
#include <hpvi/bound/corner_stress.h>
#include <hpvi/bound/legendre.h>
#include <hpvi/bound/stress_element.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr char stresses[] = "the stresses of a cell";

using Components = std::array<double, 3>; ///< xx, yy, xy

/** A point of [-1,1]^2 with its weight. */
struct CornerPoint
{
  double xi, eta, weight;
};

/** Points with the same xi, or the same eta. */
struct CornerLine
{
  bool has_one_xi;
  std::vector<CornerPoint> points;
};

/** A rule for integrals with corner stresses, line by line: in each quarter Duffy's, collapsed into the corner. */
std::vector<CornerLine> corner_lines(const unsigned int n_gauss)
{
  std::vector<CornerLine> result;
  const QGauss<1> gauss(n_gauss);
  for (unsigned int quarter = 0; quarter < 4; ++quarter)
    for (unsigned int a = 0; a < n_gauss; ++a)
    {
      CornerLine across{true, {}}, along{false, {}};
      for (unsigned int b = 0; b < n_gauss; ++b)
      {
        const double u = gauss.point(a)[0], v = u * gauss.point(b)[0],
                     weight = u * gauss.weight(a) * gauss.weight(b);
        const double right = quarter % 2 ? 1 : -1, top = quarter / 2 ? 1 : -1;
        across.points.push_back({right * (1 - u), top * (1 - v), weight});
        along.points.push_back({right * (1 - v), top * (1 - u), weight});
      }
      result.push_back(across);
      result.push_back(along);
    }
  return result;
}
} // namespace

StressElement::StressElement(const unsigned int degree, const Tensor<2, 2> &B,
                             const Material &material, const unsigned int marked_corners)
    : StressSpace(degree, B, material)
{
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

void StressElement::add_corner_stress(const unsigned int corner)
{
  CornerStress result{corner, Modes<3>(m + 1), Modes<3>(), std::vector<double>(n_data)};
  std::vector<double> energies(corners.size() + 1);
  for (const CornerLine &line : corner_lines(m + 12))
  {
    std::array<std::vector<double>, 3> sums; // of the variable along the line
    sums.fill(std::vector<double>(m + 1));
    for (const auto &[xi, eta, weight] : line.points)
    {
      const Components s = corner_stress(m, corner, xi, eta);
      Components e{};
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int l = 0; l < 3; ++l)
          e[k] += weight * compliance[k][l] * s[l];
      const auto L = legendre::values(m + 1, line.has_one_xi ? eta : xi);
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int i = 0; i <= m; ++i)
          sums[k][i] += e[k] * L[i];
      for (unsigned int other = 0; other <= corners.size(); ++other)
      {
        const Components t =
            other == corners.size() ? s : corner_stress(m, corners[other].corner, xi, eta);
        energies[other] += e[0] * t[0] + e[1] * t[1] + e[2] * t[2];
      }
    }
    const CornerPoint &first = line.points.front();
    const auto L = legendre::values(m + 1, line.has_one_xi ? first.xi : first.eta);
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int i = 0; i <= m; ++i)
        for (unsigned int j = 0; j <= m; ++j)
          result.moments(k, i, j) += line.has_one_xi ? L[i] * sums[k][j] : L[j] * sums[k][i];
  }
  result.nearest = inverse_compliance(result.moments);
  Data data;
  for (unsigned int k = 0; k < 3; ++k)
    for (unsigned int i = 0; i <= m; ++i)
      for (unsigned int j = 0; j <= m; ++j)
      {
        set_data(k, i, j, data);
        for (const auto &[row, entry] : data)
          result.data[row] -= entry * result.nearest(k, i, j);
      }
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
  std::array<Data, 3> columns;
  for (unsigned int i = 0; i <= m; ++i)
    for (unsigned int j = 0; j <= m; ++j)
    {
      for (unsigned int k = 0; k < 3; ++k)
        set_data(k, i, j, columns[k]);
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int l = 0; l < 3; ++l)
          if (const double weight = inverses[present(i, j)][k][l])
            for (const auto &[column, b] : columns[l])
              for (const auto &[row, a] : columns[k])
                S[column * n_data + row] += weight * a * b;
    }
  const unsigned int n_corners = corners.size();
  if (n_corners > 0)
  {
    require_regular(cholesky(n_corners, corner_energy.data(), n_corners), stresses);
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
  require_regular(cholesky(n_data, L.data(), n_data), stresses);
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

/** Amplitudes of corner stresses, without their projections, nearest to a stress. */
std::vector<double> StressElement::corner_amplitudes(const Modes<3> &stress) const
{
  const unsigned int n = corners.size();
  std::vector<double> result(n);
  if (n == 0)
    return result;
  const Modes<3> own = moments(stress);
  for (unsigned int c = 0; c < n; ++c)
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int i = 0; i <= m; ++i)
        for (unsigned int j = 0; j <= m; ++j)
          result[c] +=
              (i < stress.n && j < stress.n ? corners[c].moments(k, i, j) * stress(k, i, j) : 0.) -
              corners[c].nearest(k, i, j) * own(k, i, j);
  for (const char op : {'N', 'T'})
    solve_triangular(op, n, 1, {corner_energy.data(), n}, result.data(), n);
  return result;
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
  if (stress.n == 0)
    return;
  const std::vector<double> amplitudes = corner_amplitudes(stress);
  subtract_data(nearest(stress), r);
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
  Data data;
  for (unsigned int k = 0; k < 3; ++k)
    for (unsigned int i = 0; i <= m; ++i)
      for (unsigned int j = 0; j <= m; ++j)
      {
        set_data(k, i, j, data);
        for (const auto &[row, entry] : data)
          right(k, i, j) += entry * y[row];
      }
  const std::vector<double> amplitudes = corner_amplitudes(stress);
  Stress result{nearest(stress), {}, m};
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
