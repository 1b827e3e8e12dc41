// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/dense_algebra.h>
#include <hpvi/bound/box_stress.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** What the antisymmetric part weighs in the energy that chooses among stresses, times C^2; 4 to 16 make no difference. */
constexpr double antisymmetry_weight = 4;

/** beta^-2 - 1/2 of a rectangle, by Costabel and Dauge (arXiv:1303.6141). */
double of_slice(const double a, const double b)
{
  const double x = std::min(a, b) / std::hypot(a, b);
  return 2 / (x * x) * (1 + std::sqrt(1 - x * x)) - 0.5;
}

/**
 * C^2 with `|int q . omega(v)| <= C |q| |eps(v)|` for q of mean zero: on each slice across axis i omega_i differs from its mean by
 * `a |eps in the slice|`, and that mean from a constant by `b |eps_ij, eps_ik|`; doc/space.md has the proof. Squares of sums are parted
 * by (1 + t, 1 + 1/t), the best t of a grid.
 */
double rotation_constant(const Tensor<1, 3> &h)
{
  const double bump = std::pow(numbers::PI, 4) / 64; // |b|^2 times the area, b a product of sines
  double best = std::numeric_limits<double>::infinity();
  for (double exponent = -3; exponent <= 3; exponent += 0.05)
  {
    const double t = std::exp(exponent);
    std::array<double, 3> normal{}, shear{}; // shear[i] is that of the other two axes
    for (unsigned int i = 0; i < 3; ++i)
    {
      const unsigned int j = (i + 1) % 3, k = (i + 2) % 3;
      const double a = bump * of_slice(h[j], h[k]),
                   b = bump / 2 * h[i] * h[i] * (1 / (h[j] * h[j]) + 1 / (h[k] * h[k]));
      normal[j] += (1 + t) * a;
      normal[k] += (1 + t) * a;
      shear[i] += (1 + t) * a;
      shear[j] += (1 + 1 / t) * b;
      shear[k] += (1 + 1 / t) * b;
    }
    best = std::min(best, std::max(*std::max_element(normal.begin(), normal.end()),
                                   *std::max_element(shear.begin(), shear.end())));
  }
  return best;
}

/** Calls @p f for all modes of up to @p n in each direction. */
template <class F>
void for_modes(const unsigned int n, const F &f)
{
  for (unsigned int c = 0, number = 0; c < n; ++c)
    for (unsigned int b = 0; b < n; ++b)
      for (unsigned int a = 0; a < n; ++a)
        f(std::array<unsigned int, 3>{{a, b, c}}, number++);
}

SymmetricTensor<2, 3> unit(const unsigned int i, const unsigned int j)
{
  SymmetricTensor<2, 3> result;
  result[i][j] = i == j ? 1. : 0.5;
  return result;
}
} // namespace

double BoxStress::hat_product(const bool right, const unsigned int i, const unsigned int j)
{
  const double sign = right ? 0.5 : -0.5;
  return (i == j ? 0.5 : 0.) + (j + 1 == i   ? sign * legendre::shift(i)
                                : i + 1 == j ? sign * legendre::shift(j)
                                             : 0.);
}

BoxStress::BoxStress(const unsigned int p, const Tensor<1, 3> &shape, const Material &material)
    : p(p), n(p + 2), size(shape / std::cbrt(shape[0] * shape[1] * shape[2])), law(material),
      c(material.coercivity(3)), C(std::sqrt(rotation_constant(size)))
{
  set_law();
  set_rows();
  set_stresses();
  set_energy();
  set_hats();
}

unsigned int BoxStress::place(const unsigned int i, const unsigned int j,
                              const std::array<unsigned int, 3> &mode) const
{
  const unsigned int n_0 = n + (j == 0), n_1 = n + (j == 1);
  return (3 * i + j) * n_component() + mode[0] + n_0 * (mode[1] + n_1 * mode[2]);
}

void BoxStress::set_law()
{
  const double penalty = antisymmetry_weight * C * C / c;
  for (unsigned int s = 0; s < 9; ++s)
    for (unsigned int t = 0; t < 9; ++t)
    {
      const unsigned int i = s / 3, j = s % 3, k = t / 3, l = t % 3;
      symmetric[s][t] = law.complementary_product(unit(i, j), unit(k, l));
      both[s][t] = symmetric[s][t] + (i == j             ? 0.
                                      : i == k && j == l ? penalty
                                      : i == l && j == k ? -penalty
                                                         : 0.);
    }
}

/** Fields of one row for its data, by the singular values of what data a field has. */
void BoxStress::set_rows()
{
  Matrix D(n_row(), 3 * n_component());
  for (unsigned int j = 0; j < 3; ++j)
  {
    const unsigned int one = (j + 1) % 3, other = (j + 2) % 3;
    for_modes(n + 1,
              [&](const std::array<unsigned int, 3> &mode, unsigned int)
              {
                if (mode[one] >= n || mode[other] >= n)
                  return;
                const unsigned int column = place(0, j, mode);
                for (unsigned int i = 0; i < mode[j]; ++i)
                {
                  std::array<unsigned int, 3> row = mode;
                  row[j] = i;
                  D(row[0] + n * (row[1] + n * row[2]), column) =
                      2 / size[j] * legendre::derivative(mode[j], i);
                }
                const unsigned int along =
                    mode[std::min(one, other)] + n * mode[std::max(one, other)];
                for (const bool right : {false, true})
                  D(n * n * n + (2 * j + right) * n * n + along, column) =
                      (right ? 1 : -1) * legendre::at_end(mode[j], right);
              });
  }
  Matrix factors(D);
  factors.compute_svd();
  const unsigned int rank = n_row() - 1;
  require_regular(factors.singular_value(rank - 1) > 1e-10 * factors.singular_value(0), "stresses");
  R.reinit(3 * n_component(), n_row());
  Z.reinit(3 * n_component(), 3 * n_component() - rank);
  const LAPACKFullMatrix<double> &U = factors.get_svd_u(), &Vt = factors.get_svd_vt();
  Matrix scaled(rank, n_row());
  Matrix V(rank, 3 * n_component());
  for (unsigned int r = 0; r < rank; ++r)
  {
    for (unsigned int i = 0; i < n_row(); ++i)
      scaled(r, i) = U(i, r) / factors.singular_value(r);
    for (unsigned int i = 0; i < 3 * n_component(); ++i)
      V(r, i) = Vt(r, i);
  }
  V.Tmmult(R, scaled);
  for (unsigned int z = 0; z < Z.n(); ++z)
    for (unsigned int i = 0; i < Z.m(); ++i)
      Z(i, z) = Vt(rank + z, i);
}

/** The energy's matrix times fields; modes that only one column of the tensor has stand by themselves. */
BoxStress::Matrix BoxStress::weighted(const Matrix &fields, const bool symmetric_alone) const
{
  const auto &law_of = symmetric_alone ? symmetric : both;
  Matrix result(fields.m(), fields.n());
  for_modes(n + 1,
            [&](const std::array<unsigned int, 3> &mode, unsigned int)
            {
              std::vector<std::array<unsigned int, 2>> present; // component, place
              for (unsigned int s = 0; s < 9; ++s)
              {
                bool has_mode = true;
                for (unsigned int d = 0; d < 3; ++d)
                  has_mode &= mode[d] < n + (s % 3 == d);
                if (has_mode)
                  present.push_back({{s, place(s / 3, s % 3, mode)}});
              }
              for (unsigned int column = 0; column < fields.n(); ++column)
                for (const auto &[s, row] : present)
                {
                  double sum = 0;
                  for (const auto &[t, other] : present)
                    sum += law_of[s][t] * fields(other, column);
                  result(row, column) = sum / 8; // modes of L_0 on [-1,1]
                }
            });
  return result;
}

/** sigma(u) is a field of the space. */
void BoxStress::set_stresses()
{
  const unsigned int m = p + 1, n_modes = m * m * m;
  sigma.reinit(9 * n_component(), 3 * n_modes);
  for (unsigned int component = 0; component < 3; ++component)
    for_modes(m,
              [&](const std::array<unsigned int, 3> &of_u, const unsigned int number)
              {
                for (unsigned int d = 0; d < 3; ++d)
                  for (unsigned int i = 0; i < of_u[d]; ++i)
                  {
                    std::array<unsigned int, 3> mode = of_u;
                    mode[d] = i;
                    Tensor<2, 3> gradient;
                    gradient[component][d] = 2 / size[d] * legendre::derivative(of_u[d], i);
                    const SymmetricTensor<2, 3> stress = law.stress(gradient);
                    for (unsigned int s = 0; s < 9; ++s)
                      sigma(place(s / 3, s % 3, mode), component * n_modes + number) +=
                          stress[s / 3][s % 3];
                  }
              });
}

/** For each row the same R and Z. */
void BoxStress::set_energy()
{
  const unsigned int n_field = 3 * n_component(), n_bubbles = Z.n();
  Matrix bubbles(3 * n_field, 3 * n_bubbles);
  lift.reinit(3 * n_field, 3 * n_row());
  for (unsigned int row = 0; row < 3; ++row)
    for (unsigned int i = 0; i < n_field; ++i)
    {
      for (unsigned int z = 0; z < n_bubbles; ++z)
        bubbles(row * n_field + i, row * n_bubbles + z) = Z(i, z);
      for (unsigned int d = 0; d < n_row(); ++d)
        lift(row * n_field + i, row * n_row() + d) = R(i, d);
    }
  const Matrix of_bubbles = weighted(bubbles, false);
  Matrix energy(3 * n_bubbles, 3 * n_bubbles);
  bubbles.Tmmult(energy, of_bubbles);
  energy.set_property(LAPACKSupport::symmetric);
  energy.compute_cholesky_factorization();
  const auto best = [&](const Matrix &fields) // of the same data
  {
    Matrix right(3 * n_bubbles, fields.n());
    of_bubbles.Tmmult(right, fields);
    energy.solve(right);
    Matrix result(fields.m(), fields.n());
    bubbles.mmult(result, right);
    return result;
  };
  own = best(sigma);
  Matrix unneeded = best(lift);
  N.reinit(3 * n_row(), n_conditions);
  for (unsigned int datum = 0; datum < 3 * n_row(); ++datum)
    for (unsigned int m = 0; m < 3; ++m) // q of mean zero: bubbles change no mean
    {
      const unsigned int i = (m + 1) % 3, j = (m + 2) % 3;
      N(datum, 3 + m) = lift(place(i, j, {}), datum) - lift(place(j, i, {}), datum);
    }
  lift.add(-1., unneeded);
  G.reinit(3 * n_row(), 3 * n_row());
  lift.Tmmult(G, weighted(lift, false));
  for (unsigned int row = 0; row < 3; ++row)
  {
    N(row * n_row(), row) = std::sqrt(2.);
    for (unsigned int face = 0; face < 6; ++face)
      N(on_face(face, row), row) = -2 / size[face / 2];
  }
  for (unsigned int i = 0; i < n_conditions; ++i)
  {
    double square = 0;
    for (unsigned int datum = 0; datum < N.m(); ++datum)
      square += N(datum, i) * N(datum, i);
    for (unsigned int datum = 0; datum < N.m(); ++datum)
      N(datum, i) /= std::sqrt(square);
  }
}

/** Fields sigma(u) times psi of corner @p v. */
BoxStress::Matrix BoxStress::times_hat(const unsigned int v) const
{
  const unsigned int m = p + 1;
  Matrix result(sigma.m(), sigma.n());
  for (unsigned int s = 0; s < 9; ++s)
    for_modes(m,
              [&](const std::array<unsigned int, 3> &of_stress, unsigned int)
              {
                const unsigned int from = place(s / 3, s % 3, of_stress);
                for_modes(n,
                          [&](const std::array<unsigned int, 3> &mode, unsigned int)
                          {
                            double factor = 1;
                            for (unsigned int d = 0; d < 3 && factor != 0; ++d)
                              factor *= hat_product(v >> d & 1u, mode[d], of_stress[d]);
                            if (factor != 0)
                              for (unsigned int column = 0; column < sigma.n(); ++column)
                                result(place(s / 3, s % 3, mode), column) +=
                                    factor * sigma(from, column);
                          });
              });
  return result;
}

/** Data sigma(u) grad psi. */
BoxStress::Matrix BoxStress::divergence_of_hat(const unsigned int v) const
{
  const unsigned int m = p + 1;
  Matrix result(3 * n_row(), sigma.n());
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      for_modes(m,
                [&](const std::array<unsigned int, 3> &of_stress, unsigned int)
                {
                  const unsigned int from = place(i, j, of_stress);
                  for_modes(n,
                            [&](const std::array<unsigned int, 3> &mode, const unsigned int number)
                            {
                              double factor = 1;
                              for (unsigned int d = 0; d < 3 && factor != 0; ++d)
                                factor *= d != j ? hat_product(v >> d & 1u, mode[d], of_stress[d])
                                          : mode[d] == of_stress[d]
                                              ? (v >> d & 1u ? 1. : -1.) / size[d]
                                              : 0.;
                              if (factor != 0)
                                for (unsigned int column = 0; column < sigma.n(); ++column)
                                  result(i * n_row() + number, column) +=
                                      factor * sigma(from, column);
                            });
                });
  return result;
}

void BoxStress::set_hats()
{
  for (unsigned int v = 0; v < 8; ++v)
  {
    const Matrix data = divergence_of_hat(v);
    Matrix gradient(3 * n_row(), sigma.n()), defect(n_conditions, sigma.n());
    lift.Tmmult(gradient, weighted(times_hat(v), false));
    gradient *= -1.;
    G.mmult(gradient, data, /*adding=*/true);
    N.Tmmult(defect, data);
    Matrix &hat = hats.emplace_back(3 * n_row() + n_conditions, sigma.n());
    for (unsigned int column = 0; column < sigma.n(); ++column)
    {
      for (unsigned int i = 0; i < 3 * n_row(); ++i)
        hat(i, column) = gradient(i, column);
      for (unsigned int i = 0; i < n_conditions; ++i)
        hat(3 * n_row() + i, column) = defect(i, column);
    }
  }
}

void BoxStress::add_hat(const std::array<double, 8> &hat, const Vector<double> &u,
                        std::vector<double> &result) const
{
  Vector<double> sum(3 * n_row() + n_conditions), scaled(u);
  for (unsigned int v = 0; v < 8; ++v)
    if (hat[v] != 0)
    {
      scaled.equ(hat[v], u);
      hats[v].vmult(sum, scaled, /*adding=*/true);
    }
  for (unsigned int i = 0; i < result.size(); ++i)
    result[i] += sum[i];
}

void BoxStress::add_data(const std::vector<double> &data, std::vector<double> &result) const
{
  for (unsigned int j = 0; j < data.size(); ++j)
    if (data[j] != 0)
    {
      for (unsigned int i = 0; i < data.size(); ++i)
        result[i] += G(i, j) * data[j];
      for (unsigned int i = 0; i < n_conditions; ++i)
        result[data.size() + i] += N(j, i) * data[j];
    }
}

BoxStress::Distance BoxStress::distance(const std::vector<double> &data,
                                        const Vector<double> &u) const
{
  Vector<double> field(sigma.m()), difference(sigma.m());
  lift.vmult(field, Vector<double>(data.begin(), data.end()));
  own.vmult(field, u, /*adding=*/true);
  sigma.vmult(difference, u);
  difference.sadd(-1., 1., field);
  double square = 0, antisymmetric = 0;
  for_modes(n + 1,
            [&](const std::array<unsigned int, 3> &mode, unsigned int)
            {
              Tensor<2, 3> s;
              for (unsigned int i = 0; i < 3; ++i)
                for (unsigned int j = 0; j < 3; ++j)
                {
                  bool has_mode = true;
                  for (unsigned int d = 0; d < 3; ++d)
                    has_mode &= mode[d] < n + (j == d);
                  if (has_mode)
                    s[i][j] = difference[place(i, j, mode)];
                }
              const SymmetricTensor<2, 3> sym = symmetrize(s);
              square += law.complementary_product(sym, sym);
              for (unsigned int i = 0; i < 3; ++i)
                antisymmetric += std::pow(s[i][(i + 1) % 3] - s[(i + 1) % 3][i], 2);
            });
  return {square / 8, C * std::sqrt(antisymmetric / (8 * c))};
}

std::vector<double> BoxStress::stress(const Vector<double> &u, const unsigned int i,
                                      const unsigned int j) const
{
  std::vector<double> result;
  for_modes(p + 1,
            [&](const std::array<unsigned int, 3> &mode, unsigned int)
            {
              const unsigned int row = place(i, j, mode);
              double sum = 0;
              for (unsigned int column = 0; column < sigma.n(); ++column)
                sum += sigma(row, column) * u[column];
              result.push_back(sum);
            });
  return result;
}

// With the rotation that is left out |grad v|^2 is |eps|^2 + 2 |omega|^2.
double BoxStress::poincare() const
{
  return std::max({size[0], size[1], size[2]}) / numbers::PI * std::sqrt((1 + 2 * C * C) / c);
}

// h int_face v^2 = int_box d_z((z - z_0) v^2)
double BoxStress::trace(const unsigned int face) const
{
  const double v = std::max({size[0], size[1], size[2]}) / numbers::PI, h = size[face / 2];
  return std::sqrt(v * v / h + 2 * v) * std::sqrt((1 + 2 * C * C) / c);
}
} // namespace hpvi
