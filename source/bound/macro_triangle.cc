// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/geometry_info.h>
#include <hpvi/algebra/dense_algebra.h>
#include <hpvi/algebra/triangular.h>
#include <hpvi/bound/macro_triangle.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
/** `C^-1 s : t` for pairs of `s = B E B'`. */
std::array<double, 6> component_energy(const Tensor<2, 2> &B, const double scale,
                                       const Material &material)
{
  const HookesLaw<2> law(material);
  constexpr unsigned int pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
  std::array<Tensor<2, 2>, 3> s;
  for (unsigned int k = 0; k < 3; ++k)
  {
    Tensor<2, 2> E;
    E[k == 1][k != 0] = 1.;
    E[k != 0][k == 1] = 1.;
    s[k] = B * E * transpose(B);
  }
  std::array<double, 6> result;
  for (unsigned int pair = 0; pair < 6; ++pair)
    result[pair] = scale * scale * law.complementary_product(s[pairs[pair][0]], s[pairs[pair][1]]);
  return result;
}
} // namespace

double cross(const Tensor<1, 2> &a, const Tensor<1, 2> &b)
{
  return a[0] * b[1] - a[1] * b[0];
}

/** `S nu = B^-1 (s n) l/scale` on an edge of length l. */
MacroTriangle::MacroTriangle(const TriangleStress &triangle, const unsigned int f,
                             const std::array<Point<2>, 4> &vertices, const Point<2> &crossing,
                             const double h, const Material &material)
    : triangle(triangle)
{
  const std::array<unsigned int, 2> ends{
      {GeometryInfo<2>::face_to_cell_vertices(f, 0), GeometryInfo<2>::face_to_cell_vertices(f, 1)}};
  const Tensor<1, 2> a = (vertices[ends[0]] - vertices[0]) / h,
                     b = (vertices[ends[1]] - vertices[0]) / h, to_a = a - crossing,
                     to_b = b - crossing;
  scale = std::sqrt(std::abs(cross(to_a, to_b)));
  for (unsigned int c = 0; c < 2; ++c)
  {
    B[c][0] = to_a[c] / scale;
    B[c][1] = to_b[c] / scale;
  }
  energy = component_energy(B, scale, material);
  const Tensor<2, 2> inverse = invert(B) / scale;
  Tensor<2, 2> frame; // columns: normal and tangent of the face
  const Tensor<1, 2> along = (b - a) / (b - a).norm();
  const double turn = f < 2 ? 1. : -1.;
  for (unsigned int c = 0; c < 2; ++c)
  {
    frame[c][0] = c == 0 ? turn * along[1] : -turn * along[0];
    frame[c][1] = along[c];
  }
  places = {{4 + f, ends[0], ends[1]}};
  to_edge = {{(f % 2 ? 1. : -1.) * (to_b - to_a).norm() * inverse * frame,
              turn * to_a.norm() * inverse, turn * to_b.norm() * inverse}};
}

/** S := M S for columns of stresses. */
void MacroTriangle::apply_energy(const unsigned int columns, std::vector<double> &S) const
{
  const unsigned int n = triangle.n;
  const auto &e = energy;
  for (unsigned int column = 0; column < columns; ++column)
    for (unsigned int l = 0; l < n; ++l)
    {
      double *const s = &S[column * 3 * n + l];
      const double xx = s[0], yy = s[n], xy = s[2 * n];
      s[0] = e[0] * xx + e[3] * yy + e[4] * xy;
      s[n] = e[3] * xx + e[1] * yy + e[5] * xy;
      s[2 * n] = e[4] * xx + e[5] * yy + e[2] * xy;
    }
}

/** Energy of S nu on the edges of a triangle: n_edges x n_edges, in columns of n_edges + n_bubbles. */
std::vector<double> MacroTriangle::eliminate_bubbles()
{
  const unsigned int edges = triangle.n_edges, bubbles = triangle.n_bubbles, size = edges + bubbles,
                     n_data = triangle.n_divergence + edges;
  std::vector<double> M(size * size);
  for (unsigned int pair = 0; pair < 6; ++pair)
    for (unsigned int i = 0; i < M.size(); ++i)
      M[i] += energy[pair] * triangle.products[pair][i];
  L.resize(bubbles * bubbles);
  X.resize(bubbles * edges);
  for (unsigned int j = 0; j < bubbles; ++j)
    std::copy_n(M.data() + (edges + j) * size + edges, bubbles, L.data() + j * bubbles);
  for (unsigned int j = 0; j < edges; ++j)
    std::copy_n(M.data() + j * size + edges, bubbles, X.data() + j * bubbles);
  require_regular(cholesky(bubbles, L.data(), bubbles), "the stresses of a cell");
  solve_triangular('N', bubbles, edges, {L.data(), bubbles}, X.data(), bubbles);
  multiply('T', 'N', edges, edges, bubbles, -1., {X.data(), bubbles}, {X.data(), bubbles}, 1.,
           M.data(), size);
  double alpha = 0;
  for (unsigned int i = 0; i < edges; ++i)
    alpha += M[i * size + i] / edges;
  // Definite also for what no stress has; constant where the conditions are met.
  multiply('N', 'T', edges, edges, 6, alpha, {&triangle.conditions[triangle.n_divergence], n_data},
           {&triangle.conditions[triangle.n_divergence], n_data}, 1., M.data(), size);
  return M;
}

void MacroTriangle::add_gradient(const double *const from, double *const gradient) const
{
  const unsigned int n = triangle.k + 1;
  for (unsigned int e = 0; e < 3; ++e)
    for (unsigned int c = 0; c < 2; ++c)
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int a = 0; a < 2; ++a)
          gradient[2 * n * places[e] + c * n + i] += to_edge[e][a][c] * from[2 * n * e + a * n + i];
}

/** S nu on the edges of a triangle. */
std::vector<double> MacroTriangle::tractions(const std::vector<double> &t) const
{
  const unsigned int n = triangle.k + 1;
  std::vector<double> result(triangle.n_edges);
  for (unsigned int e = 0; e < 3; ++e)
    for (unsigned int a = 0; a < 2; ++a)
      for (unsigned int c = 0; c < 2; ++c)
        for (unsigned int i = 0; i < n; ++i)
          result[2 * n * e + a * n + i] += to_edge[e][a][c] * t[2 * n * places[e] + c * n + i];
  return result;
}
} // namespace hpvi
