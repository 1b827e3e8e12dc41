// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/quadrature_lib.h>
#include <hpvi/algebra/dense_algebra.h>
#include <hpvi/algebra/triangular.h>
#include <hpvi/base/memo_table.h>
#include <hpvi/bound/legendre.h>
#include <hpvi/bound/triangle_stress.h>

#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr double normals[3][2] = {{1., 1.}, {0., -1.}, {-1., 0.}};
/** Edges at the vertices (1,0), (0,1), (0,0), and whether these are their ends. */
constexpr unsigned int edges_at_vertex[3][2] = {{0, 1}, {0, 2}, {1, 2}};
constexpr bool is_end[3][2] = {{false, true}, {true, true}, {false, false}};

/** P_0^(0,beta) to P_{n-1}^(0,beta) at t. */
std::vector<double> jacobi(const unsigned int n, const double alpha, const double beta,
                           const double t)
{
  std::vector<double> P(n);
  for (unsigned int i = 0; i < n; ++i)
  {
    const double a = 2 * i + alpha + beta;
    P[i] = i == 0   ? 1.
           : i == 1 ? (alpha - beta + (alpha + beta + 2) * t) / 2
                    : ((a - 1) * (a * (a - 2) * t + alpha * alpha - beta * beta) * P[i - 1] -
                       2 * (i + alpha - 1) * (i + beta - 1) * a * P[i - 2]) /
                          (2 * i * (i + alpha + beta) * (a - 2));
  }
  return P;
}

/** Derivatives of the same. */
std::vector<double> jacobi_slopes(const unsigned int n, const double beta, const double t)
{
  std::vector<double> result(n);
  const std::vector<double> P = jacobi(n, 1, beta + 1, t);
  for (unsigned int i = 1; i < n; ++i)
    result[i] = (i + beta + 1) / 2 * P[i - 1];
  return result;
}

/** Place of i, j among all by the sum of both. */
unsigned int place(const unsigned int i, const unsigned int j)
{
  return (i + j) * (i + j + 1) / 2 + i;
}

double norm(const unsigned int i, const unsigned int j)
{
  return std::sqrt((2. * i + 1) * (2. * i + 2. * j + 2));
}

/** d/dx or d/dy of phi_l at u > 0. */
std::vector<double> basis_slopes(const unsigned int k, const unsigned int direction, const double u,
                                 const double v)
{
  std::vector<double> result((k + 1) * (k + 2) / 2);
  const double v_slope = (direction == 0 ? -v : 1 - v) / u;
  const std::vector<double> P = jacobi(k + 1, 0, 0, 2 * v - 1),
                            dP = jacobi_slopes(k + 1, 0, 2 * v - 1);
  for (unsigned int i = 0; i <= k; ++i)
  {
    const std::vector<double> Q = jacobi(k + 1 - i, 0, 2 * i + 1, 2 * u - 1),
                              dQ = jacobi_slopes(k + 1 - i, 2 * i + 1, 2 * u - 1);
    for (unsigned int j = 0; i + j <= k; ++j)
    {
      const double power = std::pow(u, i), slope = i == 0 ? 0. : i * std::pow(u, i - 1.);
      result[place(i, j)] = norm(i, j) * (P[i] * (slope * Q[j] + power * 2 * dQ[j]) +
                                          2 * dP[i] * power * Q[j] * v_slope);
    }
  }
  return result;
}

/** u, v of the point at s in [0,1] of an edge. */
std::array<double, 2> on_edge(const unsigned int edge, const double s)
{
  return edge == 0 ? std::array<double, 2>{{1., s}} : std::array<double, 2>{{s, edge - 1.}};
}
} // namespace

std::vector<double> TriangleStress::basis(const unsigned int k, const double u, const double v)
{
  std::vector<double> result((k + 1) * (k + 2) / 2);
  const std::vector<double> P = jacobi(k + 1, 0, 0, 2 * v - 1);
  for (unsigned int i = 0; i <= k; ++i)
  {
    const std::vector<double> Q = jacobi(k + 1 - i, 0, 2 * i + 1, 2 * u - 1);
    for (unsigned int j = 0; i + j <= k; ++j)
      result[place(i, j)] = norm(i, j) * P[i] * std::pow(u, i) * Q[j];
  }
  return result;
}

TriangleStress::TriangleStress(const unsigned int degree)
    : k(degree), n((k + 1) * (k + 2) / 2), n_divergence(k * (k + 1)), n_edges(6 * (k + 1)),
      n_bubbles(k < 4 ? 0 : (k - 2) * (k - 3) / 2)
{
  set_conditions();
  set_stresses();
  set_products();
}

/** A, data x coefficients, by columns: of each pair of row and component a factor of phi_l or its slopes. */
std::vector<double> TriangleStress::data_matrix() const
{
  const unsigned int n_data = n_divergence + n_edges, n_lower = n_divergence / 2;
  std::vector<double> A(n_data * 3 * n);
  // The vector v in Div S = S v or S nu, v the gradient or nu, with moments of both its components.
  const auto add = [&](const unsigned int row, const unsigned int next, const unsigned int l,
                       const double x, const double y)
  {
    A[l * n_data + row] += x;
    A[(2 * n + l) * n_data + row] += y;
    A[(n + l) * n_data + row + next] += y;
    A[(2 * n + l) * n_data + row + next] += x;
  };
  const QGauss<1> gauss(k + 2);
  for (unsigned int a = 0; a < gauss.size(); ++a)
    for (unsigned int b = 0; b < gauss.size(); ++b)
    {
      const double u = gauss.point(a)[0], v = gauss.point(b)[0],
                   weight = gauss.weight(a) * gauss.weight(b) * u;
      const std::vector<double> phi = basis(k, u, v), x = basis_slopes(k, 0, u, v),
                                y = basis_slopes(k, 1, u, v);
      for (unsigned int l = 0; l < n; ++l)
        for (unsigned int row = 0; row < n_lower; ++row)
          add(row, n_lower, l, weight * phi[row] * x[l], weight * phi[row] * y[l]);
    }
  for (unsigned int edge = 0; edge < 3; ++edge)
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const double s = gauss.point(q)[0];
      const auto [u, v] = on_edge(edge, s);
      const std::vector<double> phi = basis(k, u, v), L = legendre::values(k + 1, 2 * s - 1);
      for (unsigned int l = 0; l < n; ++l)
        for (unsigned int i = 0; i <= k; ++i)
        {
          const double moment = 2 * gauss.weight(q) * L[i] * phi[l];
          add(n_divergence + edge * 2 * (k + 1) + i, k + 1, l, moment * normals[edge][0],
              moment * normals[edge][1]);
        }
    }
  return A;
}

void TriangleStress::set_conditions()
{
  const unsigned int n_data = n_divergence + n_edges, n_lower = n_divergence / 2;
  conditions.assign(n_data * 6, 0.);
  const auto motion = [](const unsigned int z, const double x, const double y) {
    return std::array<double, 2>{{z == 0 ? 1. : z == 1 ? 0. : -y, z == 0 ? 0. : z == 1 ? 1. : x}};
  };
  const QGauss<1> gauss(k + 2);
  for (unsigned int z = 0; z < 3; ++z)
  {
    double *const N = &conditions[z * n_data];
    for (unsigned int a = 0; a < gauss.size(); ++a)
      for (unsigned int b = 0; b < gauss.size(); ++b)
      {
        const double u = gauss.point(a)[0], v = gauss.point(b)[0];
        const std::vector<double> phi = basis(k, u, v);
        for (unsigned int c = 0; c < 2; ++c)
          for (unsigned int l = 0; l < n_lower; ++l)
            N[c * n_lower + l] +=
                gauss.weight(a) * gauss.weight(b) * u * phi[l] * motion(z, u * (1 - v), u * v)[c];
      }
    for (unsigned int edge = 0; edge < 3; ++edge)
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const double s = gauss.point(q)[0];
        const auto [u, v] = on_edge(edge, s);
        const std::vector<double> L = legendre::values(k + 1, 2 * s - 1);
        for (unsigned int c = 0; c < 2; ++c)
          for (unsigned int i = 0; i <= k; ++i)
            N[n_divergence + (edge * 2 + c) * (k + 1) + i] -=
                gauss.weight(q) * L[i] * motion(z, u * (1 - v), u * v)[c];
      }
  }
  add_vertex_conditions();
}

void TriangleStress::add_vertex_conditions()
{
  const unsigned int n_data = n_divergence + n_edges;
  const double n_tractions = k + 1.; // to the size of the others
  for (unsigned int vertex = 0; vertex < 3; ++vertex)
    for (unsigned int side = 0; side < 2; ++side)
      for (unsigned int c = 0; c < 2; ++c)
        for (unsigned int i = 0; i <= k; ++i)
          conditions[(3 + vertex) * n_data + n_divergence +
                     (edges_at_vertex[vertex][side] * 2 + c) * (k + 1) + i] =
              (side == 0 ? 1. : -1.) / n_tractions * legendre::at_end(i, is_end[vertex][side]) *
              normals[edges_at_vertex[vertex][1 - side]][c];
}

std::vector<double> TriangleStress::orthonormal_conditions() const
{
  const unsigned int n_data = n_divergence + n_edges;
  std::vector<double> Q(conditions), gram(36);
  for (unsigned int pass = 0; pass < 2; ++pass) // twice, for round-off
  {
    multiply('T', 'N', 6, 6, n_data, 1., {Q.data(), n_data}, {Q.data(), n_data}, 0., gram.data(),
             6);
    AssertThrow(cholesky(6, gram.data(), 6), ExcInternalError());
    std::vector<double> rows(6 * n_data); // Q' := L^-1 Q'
    for (unsigned int i = 0; i < n_data; ++i)
      for (unsigned int j = 0; j < 6; ++j)
        rows[i * 6 + j] = Q[j * n_data + i];
    solve_triangular('N', 6, n_data, {gram.data(), 6}, rows.data(), 6);
    for (unsigned int i = 0; i < n_data; ++i)
      for (unsigned int j = 0; j < 6; ++j)
        Q[j * n_data + i] = rows[i * 6 + j];
  }
  return Q;
}

/** `R = A' (A A' + Q Q')^-1`. */
void TriangleStress::set_stresses()
{
  const unsigned int n_data = n_divergence + n_edges, n_stress = 3 * n;
  const std::vector<double> A = data_matrix(), Q = orthonormal_conditions();
  std::vector<double> K(n_data * n_data), R(n_stress * n_data);
  multiply('N', 'T', n_data, n_data, n_stress, 1., {A.data(), n_data}, {A.data(), n_data}, 0.,
           K.data(), n_data);
  multiply('N', 'T', n_data, n_data, 6, 1., {Q.data(), n_data}, {Q.data(), n_data}, 1., K.data(),
           n_data);
  AssertThrow(cholesky(n_data, K.data(), n_data), ExcInternalError());
  for (unsigned int pass = 0; pass < 2; ++pass) // R += A' K^-1 (1 - Q Q' - A R), for round-off
  {
    std::vector<double> E(n_data * n_data);
    for (unsigned int i = 0; i < n_data; ++i)
      E[i * n_data + i] = 1.;
    multiply('N', 'T', n_data, n_data, 6, -1., {Q.data(), n_data}, {Q.data(), n_data}, 1., E.data(),
             n_data);
    multiply('N', 'N', n_data, n_data, n_stress, -1., {A.data(), n_data}, {R.data(), n_stress}, 1.,
             E.data(), n_data);
    for (const char op : {'N', 'T'})
      solve_triangular(op, n_data, n_data, {K.data(), n_data}, E.data(), n_data);
    multiply('T', 'N', n_stress, n_data, n_data, 1., {A.data(), n_data}, {E.data(), n_data}, 1.,
             R.data(), n_stress);
  }
  of_divergence.assign(R.begin(), R.begin() + n_stress * n_divergence);
  of_edges.assign(R.begin() + n_stress * n_divergence, R.end());

  add_bubbles(A, R);
}

/** Orthonormal columns of the projector `1 - R A`, behind those of edges. */
void TriangleStress::add_bubbles(const std::vector<double> &A, const std::vector<double> &R)
{
  if (n_bubbles == 0)
    return;
  const unsigned int n_data = n_divergence + n_edges, n_stress = 3 * n;
  std::vector<double> P(n_stress * n_stress);
  for (unsigned int i = 0; i < n_stress; ++i)
    P[i * n_stress + i] = 1.;
  multiply('N', 'N', n_stress, n_stress, n_data, -1., {R.data(), n_stress}, {A.data(), n_data}, 1.,
           P.data(), n_stress);
  const PivotedCholesky factor(n_stress, P, 1e-8);
  AssertThrow(factor.order.size() == n_bubbles, ExcInternalError());
  std::vector<double> rows(n_bubbles * n_stress); // L^-1 times the chosen rows of P: orthonormal
  for (unsigned int i = 0; i < n_stress; ++i)
    for (unsigned int j = 0; j < n_bubbles; ++j)
      rows[i * n_bubbles + j] = P[i * n_stress + factor.order[j]];
  solve_triangular('N', n_bubbles, n_stress, {factor.L.data(), n_bubbles}, rows.data(), n_bubbles);
  for (unsigned int j = 0; j < n_bubbles; ++j)
    for (unsigned int i = 0; i < n_stress; ++i)
      of_edges.push_back(rows[i * n_bubbles + j]);
}

void TriangleStress::set_products()
{
  const unsigned int size = n_edges + n_bubbles;
  constexpr unsigned int pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
  for (unsigned int pair = 0; pair < 6; ++pair)
  {
    const auto [a, b] = pairs[pair];
    products[pair].resize(size * size);
    for (const bool transposed : {false, true})
      if (!transposed || a != b)
        multiply('T', 'N', size, size, n, 1., {&of_edges[(transposed ? b : a) * n], 3 * n},
                 {&of_edges[(transposed ? a : b) * n], 3 * n}, transposed ? 1. : 0.,
                 products[pair].data(), size);
  }
}

TriangleTable::TriangleTable(const unsigned int degree, const unsigned int n_gauss)
{
  const QGauss<1> gauss(n_gauss);
  for (unsigned int a = 0; a < n_gauss; ++a)
    for (unsigned int b = 0; b < n_gauss; ++b)
    {
      const double u = gauss.point(a)[0], v = gauss.point(b)[0];
      points.push_back({{u * (1 - v), u * v}});
      weights.push_back(gauss.weight(a) * gauss.weight(b) * u);
      const std::vector<double> phi = TriangleStress::basis(degree, u, v);
      values.insert(values.end(), phi.begin(), phi.end());
    }
}

const TriangleStress &TriangleStresses::triangle(const unsigned int degree) const
{
  return memoised(triangles, degree, [&]() { return TriangleStress(degree); });
}

const TriangleTable &TriangleStresses::table(const unsigned int degree,
                                             const unsigned int n_gauss) const
{
  return memoised(tables, {{degree, n_gauss}}, [&]() { return TriangleTable(degree, n_gauss); });
}
} // namespace hpvi
