// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/dense_algebra.h>
#include <hpvi/bound/patch_data.h>

#include <algorithm>
#include <array>

namespace hpvi
{
using namespace dealii;

namespace
{
void set_column(const StressElement &element, const Modes<3> &product, const Modes<2> &of_sigma,
                const Modes<2> &load, double *const r)
{
  Modes<2> divergence(std::max(of_sigma.n, load.n));
  add(divergence, of_sigma);
  add(divergence, load);
  element.residual(product, divergence, r);
}

/** r of `psi sigma` with divergence `sigma grad psi - psi F` for the bilinear functions psi. */
void set_columns(const StressElement &element, const CellStress &cell, double *const r)
{
  const Modes<3> &sigma = cell.sigma, times_xi = times(0, sigma), times_eta = times(1, sigma);
  const Modes<2> force_xi = times(0, cell.force);
  residual_of_one(element, cell, r);
  set_column(element, times_xi, row(0, sigma), force_xi, r + element.n_data);
  set_column(element, times_eta, row(1, sigma), times(1, cell.force), r + 2 * element.n_data);
  Modes<2> both = row(0, times_eta);
  add(both, row(1, times_xi));
  set_column(element, times(1, times_xi), both, times(1, force_xi), r + 3 * element.n_data);
}

/** All that sigma(u) may have for u in Q_p. */
template <class Function>
void for_each_mode(Modes<3> &sigma, const unsigned int p, const Function &function)
{
  for (unsigned int k = 0; k < 3; ++k)
    for (unsigned int i = 0; i <= p; ++i)
      for (unsigned int j = 0; j < (i < p ? p + 1 : p); ++j)
        function(sigma(k, i, j));
}
} // namespace

void residual_of_one(const StressElement &element, const CellStress &cell, double *const r)
{
  element.residual(cell.sigma, cell.force, r);
}

PatchData patch_data(const StressElement &element, const std::vector<CellStress> &cells)
{
  constexpr unsigned int n_bilinear = PatchData::n_bilinear;
  const unsigned int n_data = element.n_data, n_edges = element.n_edges,
                     n_conditions = element.n_conditions(), n_sides = n_edges + n_conditions,
                     n_columns = n_bilinear * cells.size();
  std::vector<double> columns(std::size_t(n_data) * n_columns);
  PatchData result;
  for (unsigned int k = 0; k < cells.size(); ++k)
  {
    double *const own = &columns[std::size_t(n_data) * n_bilinear * k];
    set_columns(element, cells[k], own);
    result.r.insert(result.r.end(), own, own + n_data);
  }
  result.sides.resize(std::size_t(n_sides) * n_columns);
  multiply('T', 'N', n_edges, n_columns, n_data, 1., {element.edge_energy().data(), n_data},
           {columns.data(), n_data}, 0., result.sides.data(), n_sides);
  multiply('T', 'N', n_conditions, n_columns, n_data, 1., {element.conditions().data(), n_data},
           {columns.data(), n_data}, 0., result.sides.data() + n_edges, n_sides);
  return result;
}

Modes<3> stress_modes(const CellLaw &cell, const std::vector<double> &coefficients,
                      const unsigned int n, const LegendreTables &legendre)
{
  const unsigned int p = cell.degree;
  const HookesLaw<2> law(*cell.material);
  const Tensor<2, 2> inverse = invert(cell.B);
  Modes<3> sigma(n);
  for (unsigned int c = 0; c < 2; ++c)
  {
    const FullMatrix<double> U = legendre.displacement_modes(coefficients, c, p);
    for (unsigned int d = 0; d < 2; ++d)
    {
      Tensor<2, 2> reference;
      reference[c][d] = 1 / cell.h;
      const Tensor<2, 2> s =
          inverse * Tensor<2, 2>(law.stress(reference * inverse)) * transpose(inverse);
      const std::array<double, 3> weights{{s[0][0], s[1][1], s[0][1]}};
      for (unsigned int b = 0; b <= p; ++b)
      {
        std::array<double, 2> sums{{0., 0.}}; // L_i' = root(i) sum root(a) L_a, a = i-1, i-3, ...
        for (unsigned int i = p; i > 0; --i)
        {
          const unsigned int a = i - 1;
          sums[i % 2] += legendre::root(i) * (d == 0 ? U(i, b) : U(b, i));
          for (unsigned int k = 0; k < 3; ++k)
            sigma(k, d == 0 ? a : b, d == 0 ? b : a) +=
                weights[k] * legendre::root(a) * sums[i % 2];
        }
      }
    }
  }
  return sigma;
}

PatchData data_of_modes(const StressElement &element, const unsigned int p,
                        const unsigned int n_force)
{
  std::vector<CellStress> cells;
  Modes<3> sigma(element.m + 1);
  for_each_mode(sigma, p,
                [&](double &mode)
                {
                  mode = 1.;
                  cells.push_back({sigma, Modes<2>()});
                  mode = 0.;
                });
  Modes<2> force(n_force);
  for (double &mode : force.coefficients)
  {
    mode = 1.;
    cells.push_back({Modes<3>(), force});
    mode = 0.;
  }
  return patch_data(element, cells);
}

void append_modes(const CellStress &cell, const unsigned int p, std::vector<double> &modes)
{
  Modes<3> sigma = cell.sigma;
  for_each_mode(sigma, p, [&](const double mode) { modes.push_back(mode); });
  modes.insert(modes.end(), cell.force.coefficients.begin(), cell.force.coefficients.end());
}
} // namespace hpvi
