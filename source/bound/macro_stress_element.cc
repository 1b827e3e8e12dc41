// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/dense_algebra.h>
#include <hpvi/algebra/triangular.h>
#include <hpvi/bound/macro_stress_element.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hpvi
{
using namespace dealii;

namespace
{
constexpr char macro_stresses[] = "the stresses of a cell";

/** Conditions of the triangles that leave the tractions between them independent. The others follow from
 * these and the balance of the cell; that at the crossing, since both diagonals are straight there. */
constexpr unsigned int n_inner_conditions = 20;
bool is_independent(const unsigned int f, const unsigned int condition)
{
  return f < 3 || condition == 3 || condition == 4;
}

Point<2> crossing_of(const MacroStressElement::Vertices &v)
{
  const Tensor<1, 2> one = v[3] - v[0], other = v[2] - v[1];
  return Point<2>(cross(v[1] - v[0], other) / cross(one, other) * one);
}
} // namespace

double MacroStressElement::size(const Vertices &v)
{
  return std::sqrt(cross(v[3] - v[0], v[2] - v[1]) / 8);
}

MacroStressElement::MacroStressElement(const TriangleStress &triangle, const Vertices &vertices,
                                       const Material &material)
    : triangle(triangle), crossing(crossing_of(vertices) / size(vertices)),
      n_edges(8 * (triangle.k + 1))
{
  for (unsigned int f = 0; f < 4; ++f)
    triangles.emplace_back(triangle, f, vertices, crossing, size(vertices), material);
  set_conditions();
  // Edges between triangles, by their vertices, come before the faces.
  const unsigned int size = 2 * n_edges;
  std::vector<double> H(size * size), C(n_inner_conditions * size);
  for (unsigned int f = 0; f < 4; ++f)
  {
    add_energy(triangles[f], H);
    add_conditions(f, C);
  }
  eliminate(H, C);
}

const MacroTriangle &MacroStressElement::piece(const unsigned int f) const
{
  return triangles[f];
}

const std::vector<double> &MacroStressElement::conditions() const
{
  return N;
}

const std::vector<double> &MacroStressElement::edge_energy() const
{
  return G;
}

/** Adds the energy of a triangle, from tractions on the edges of the cell. */
void MacroStressElement::add_energy(MacroTriangle &piece, std::vector<double> &H) const
{
  const unsigned int n = triangle.k + 1, size = triangle.n_edges + triangle.n_bubbles;
  const std::vector<double> M = piece.eliminate_bubbles();
  for (unsigned int e = 0; e < 3; ++e)
    for (unsigned int d = 0; d < 3; ++d)
      for (unsigned int c = 0; c < 4; ++c)
        for (unsigned int a = 0; a < 4; ++a)
        {
          const double weight = piece.to_edge[e][a / 2][c / 2] * piece.to_edge[d][a % 2][c % 2];
          for (unsigned int j = 0; j < n; ++j)
          {
            const double *const from =
                &M[(2 * n * d + a % 2 * n + j) * size + 2 * n * e + a / 2 * n];
            double *const to = &H[(2 * n * piece.places[d] + c % 2 * n + j) * 2 * n_edges +
                                  2 * n * piece.places[e] + c / 2 * n];
            for (unsigned int i = 0; i < n; ++i)
              to[i] += weight * from[i];
          }
        }
}

void MacroStressElement::add_conditions(const unsigned int f, std::vector<double> &C) const
{
  const MacroTriangle &piece = triangles[f];
  const unsigned int n = triangle.k + 1, n_data = triangle.n_divergence + triangle.n_edges;
  for (unsigned int condition = 0; condition < 6; ++condition)
  {
    if (!is_independent(f, condition))
      continue;
    const unsigned int row = f < 3 ? 6 * f + condition : 15 + condition;
    const double *const one = &triangle.conditions[condition * n_data + triangle.n_divergence];
    for (unsigned int e = 0; e < 3; ++e)
      for (unsigned int c = 0; c < 2; ++c)
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int a = 0; a < 2; ++a)
            C[(2 * n * piece.places[e] + c * n + i) * n_inner_conditions + row] +=
                piece.to_edge[e][a][c] * one[2 * n * e + a * n + i];
  }
}

/** Motions of the cell, with rotation about the crossing: B'z of each triangle is one of its own. */
void MacroStressElement::set_conditions()
{
  const unsigned int n_divergence = triangle.n_divergence, n = triangle.k + 1,
                     n_data = n_divergence + triangle.n_edges;
  N.assign(3 * n_edges, 0.);
  N_divergence.assign(4 * 3 * n_divergence, 0.);
  for (unsigned int z = 0; z < 3; ++z)
  {
    for (unsigned int f = 0; f < 4; ++f)
    {
      const MacroTriangle &piece = triangles[f];
      const Tensor<2, 2> B = piece.scale * piece.B;
      const std::array<double, 3> motion{
          {z < 2 ? B[z][0] : 0., z < 2 ? B[z][1] : 0.,
           z < 2 ? 0. : piece.scale * piece.scale * determinant(piece.B)}};
      for (unsigned int j = 0; j < 3; ++j)
      {
        const double *const one = &triangle.conditions[j * n_data];
        for (unsigned int i = 0; i < n_divergence; ++i)
          N_divergence[(f * 3 + z) * n_divergence + i] += motion[j] * one[i];
        for (unsigned int c = 0; c < 2; ++c)
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int a = 0; a < 2; ++a)
              N[z * n_edges + 2 * n * f + c * n + i] +=
                  motion[j] * piece.to_edge[0][a][c] * one[n_divergence + a * n + i];
      }
    }
  }
  normalise_conditions();
}

void MacroStressElement::normalise_conditions()
{
  const unsigned int n = triangle.n_divergence;
  for (unsigned int z = 0; z < 3; ++z)
  {
    double *const outer = &N[z * n_edges];
    double square = std::inner_product(outer, outer + n_edges, outer, 0.);
    for (unsigned int f = 0; f < 4; ++f)
    {
      const double *const inner = &N_divergence[(f * 3 + z) * n];
      square += std::inner_product(inner, inner + n, inner, 0.);
    }
    const double factor = 1 / std::sqrt(square);
    for (unsigned int i = 0; i < n_edges; ++i)
      outer[i] *= factor;
    for (unsigned int f = 0; f < 4; ++f)
      for (unsigned int i = 0; i < n; ++i)
        N_divergence[(f * 3 + z) * n + i] *= factor;
  }
}

/**
 * Tractions x between the triangles for tractions t on the faces: `x'H_ii x/2 + x'H_io t` least subject to
 * `C_i x + C_o t = 0`. With `L L' = H_ii`, `Y = L^-1 H_io`, `W = L^-1 C_i'`, `S = W'W`, `Q = C_o - W'Y` the least energy is
 * that of `G = H_oo - Y'Y + Q'S^-1 Q`.
 */
void MacroStressElement::eliminate(const std::vector<double> &H, const std::vector<double> &C)
{
  const unsigned int n = n_edges, m = n_inner_conditions;
  L.resize(n * n);
  Y.resize(n * n);
  G.resize(n * n);
  W.resize(n * m);
  for (unsigned int j = 0; j < n; ++j)
  {
    std::copy_n(&H[j * 2 * n], n, &L[j * n]);
    std::copy_n(&H[(n + j) * 2 * n], n, &Y[j * n]);
    std::copy_n(&H[(n + j) * 2 * n + n], n, &G[j * n]);
    for (unsigned int i = 0; i < m; ++i)
      W[i * n + j] = C[j * m + i];
  }
  require_regular(cholesky(n, L.data(), n), macro_stresses);
  solve_triangular('N', n, n, {L.data(), n}, Y.data(), n);
  solve_triangular('N', n, m, {L.data(), n}, W.data(), n);
  S.resize(m * m);
  multiply('T', 'N', m, m, n, 1., {W.data(), n}, {W.data(), n}, 0., S.data(), m);
  require_regular(cholesky(m, S.data(), m), macro_stresses);
  Q.assign(C.begin() + n * m, C.end());
  multiply('T', 'N', m, n, n, -1., {W.data(), n}, {Y.data(), n}, 1., Q.data(), m);
  solve_triangular('N', m, n, {S.data(), m}, Q.data(), m); // L_S^-1 Q
  multiply('T', 'N', n, n, n, -1., {Y.data(), n}, {Y.data(), n}, 1., G.data(), n);
  multiply('T', 'N', n, n, m, 1., {Q.data(), m}, {Q.data(), m}, 1., G.data(), n);
}

MacroStressElement::Reduced MacroStressElement::reduce(const Data &data) const
{
  const unsigned int columns = data.columns, n_stress = 3 * triangle.n,
                     n_divergence = triangle.n_divergence, edges = triangle.n_edges,
                     bubbles = triangle.n_bubbles, size = edges + bubbles,
                     n_data = n_divergence + edges;
  Reduced result;
  result.gradient.resize(2 * n_edges * columns);
  result.defect.resize(n_inner_conditions * columns);
  for (unsigned int f = 0; f < 4; ++f)
  {
    const MacroTriangle &piece = triangles[f];
    result.rest[f] = data.stress[f];
    multiply('N', 'N', n_stress, columns, n_divergence, 1.,
             {triangle.of_divergence.data(), n_stress}, {data.divergence[f].data(), n_divergence},
             -1., result.rest[f].data(), n_stress);
    std::vector<double> moments(result.rest[f]), products(size * columns);
    piece.apply_energy(columns, moments);
    multiply('T', 'N', size, columns, n_stress, 1., {triangle.of_edges.data(), n_stress},
             {moments.data(), n_stress}, 0., products.data(), size);
    for (unsigned int column = 0; column < columns; ++column)
      result.bubbles[f].insert(result.bubbles[f].end(), &products[column * size] + edges,
                               &products[column * size] + size);
    solve_triangular('N', bubbles, columns, {piece.L.data(), bubbles}, result.bubbles[f].data(),
                     bubbles);
    multiply('T', 'N', edges, columns, bubbles, -1., {piece.X.data(), bubbles},
             {result.bubbles[f].data(), bubbles}, 1., products.data(), size);
    for (unsigned int column = 0; column < columns; ++column)
    {
      piece.add_gradient(&products[column * size], &result.gradient[2 * n_edges * column]);
      if (f < 3)
        multiply('T', 'N', 3, 1, n_divergence, 1., {triangle.conditions.data(), n_data},
                 {&data.divergence[f][column * n_divergence], n_divergence}, 0.,
                 &result.defect[n_inner_conditions * column + 6 * f], 3);
    }
  }
  return result;
}

void MacroStressElement::reduce(const Data &data, std::vector<double> &gradients,
                                std::vector<double> &defects) const
{
  const unsigned int columns = data.columns, n = n_edges, m = n_inner_conditions;
  const Reduced reduced = reduce(data);
  std::vector<double> y(n * columns), right(reduced.defect);
  gradients.resize(n * columns);
  for (unsigned int column = 0; column < columns; ++column)
  {
    std::copy_n(&reduced.gradient[2 * n * column], n, &y[n * column]);
    std::copy_n(&reduced.gradient[2 * n * column + n], n, &gradients[n * column]);
  }
  solve_triangular('N', n, columns, {L.data(), n}, y.data(), n);
  multiply('T', 'N', m, columns, n, -1., {W.data(), n}, {y.data(), n}, 1., right.data(), m);
  solve_triangular('N', m, columns, {S.data(), m}, right.data(), m);
  multiply('T', 'N', n, columns, n, -1., {Y.data(), n}, {y.data(), n}, 1., gradients.data(), n);
  multiply('T', 'N', n, columns, m, 1., {Q.data(), m}, {right.data(), m}, 1., gradients.data(), n);
  defects.assign(3 * columns, 0.);
  for (unsigned int f = 0; f < 4; ++f)
    multiply('T', 'N', 3, columns, triangle.n_divergence, 1.,
             {&N_divergence[3 * f * triangle.n_divergence], triangle.n_divergence},
             {data.divergence[f].data(), triangle.n_divergence}, 1., defects.data(), 3);
}

/** `-L^-T (y + W mu)` with mu such that the conditions are met, and then those of the faces. */
std::vector<double> MacroStressElement::all_tractions(const Reduced &reduced,
                                                      const std::vector<double> &t) const
{
  const unsigned int n = n_edges, m = n_inner_conditions;
  std::vector<double> x(reduced.gradient.begin(), reduced.gradient.begin() + n), Yt(n), Qt(m),
      defect(reduced.defect);
  solve_triangular('N', n, 1, {L.data(), n}, x.data(), n);
  multiply('N', 'N', n, 1, n, 1., {Y.data(), n}, {t.data(), n}, 0., Yt.data(), n);
  multiply('N', 'N', m, 1, n, 1., {Q.data(), m}, {t.data(), n}, 0., Qt.data(), m);
  // C_o t = Q t + W'Y t
  multiply('T', 'N', m, 1, n, 1., {W.data(), n}, {Yt.data(), n}, 1., defect.data(), m);
  for (unsigned int i = 0; i < m; ++i)
    for (unsigned int j = 0; j <= i; ++j)
      defect[i] += S[j * m + i] * Qt[j];
  for (unsigned int i = 0; i < n; ++i)
    x[i] += Yt[i];
  for (unsigned int pass = 0; pass < 2; ++pass) // twice, for round-off
  {
    std::vector<double> mu(defect);
    multiply('T', 'N', m, 1, n, -1., {W.data(), n}, {x.data(), n}, 1., mu.data(), m);
    for (const char op : {'N', 'T'})
      solve_triangular(op, m, 1, {S.data(), m}, mu.data(), m);
    multiply('N', 'N', n, 1, m, 1., {W.data(), n}, {mu.data(), m}, 1., x.data(), n);
  }
  solve_triangular('T', n, 1, {L.data(), n}, x.data(), n);
  for (double &value : x)
    value = -value;
  x.insert(x.end(), t.begin(), t.end());
  return x;
}

MacroStressElement::Stress MacroStressElement::stress(const Data &data,
                                                      const std::vector<double> &tractions) const
{
  const unsigned int n_stress = 3 * triangle.n, bubbles = triangle.n_bubbles,
                     edges = triangle.n_edges;
  const Reduced reduced = reduce(data);
  const std::vector<double> all = all_tractions(reduced, tractions);
  Stress result;
  result.energy = 0;
  for (unsigned int f = 0; f < 4; ++f)
  {
    const MacroTriangle &piece = triangles[f];
    // t on the edges, then amplitudes of the bubbles: -L^-T (w + X t)
    std::vector<double> t = piece.tractions(all), b(reduced.bubbles[f]);
    multiply('N', 'N', bubbles, 1, edges, 1., {piece.X.data(), bubbles}, {t.data(), edges}, 1.,
             b.data(), bubbles);
    solve_triangular('T', bubbles, 1, {piece.L.data(), bubbles}, b.data(), bubbles);
    for (const double amplitude : b)
      t.push_back(-amplitude);
    std::vector<double> difference(reduced.rest[f]);
    multiply('N', 'N', n_stress, 1, edges + bubbles, 1., {triangle.of_edges.data(), n_stress},
             {t.data(), edges + bubbles}, 1., difference.data(), n_stress);
    std::vector<double> moments(difference);
    piece.apply_energy(1, moments);
    result.energy += std::inner_product(difference.begin(), difference.end(), moments.begin(), 0.);
    result.coefficients[f] = data.stress[f];
    for (unsigned int i = 0; i < n_stress; ++i)
      result.coefficients[f][i] += difference[i];
  }
  return result;
}

Tensor<2, 2> MacroStressElement::value(const Stress &stress, const Point<2> &x) const
{
  const unsigned int n = triangle.n;
  for (unsigned int f = 0;; ++f)
  {
    const MacroTriangle &piece = triangles[f];
    const Tensor<1, 2> xy = invert(piece.B) * (x - crossing) / piece.scale;
    if (f < 3 && std::min(xy[0], xy[1]) < 0)
      continue;
    const double u = xy[0] + xy[1];
    const std::vector<double> phi = TriangleStress::basis(triangle.k, u, u > 0 ? xy[1] / u : 0.);
    Tensor<2, 2> S;
    for (unsigned int l = 0; l < n; ++l)
    {
      S[0][0] += phi[l] * stress.coefficients[f][l];
      S[1][1] += phi[l] * stress.coefficients[f][n + l];
      S[0][1] += phi[l] * stress.coefficients[f][2 * n + l];
    }
    S[1][0] = S[0][1];
    return piece.B * S * transpose(piece.B);
  }
}
} // namespace hpvi
