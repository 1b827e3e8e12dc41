// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/dense_algebra.h>
#include <hpvi/bound/cut_element.h>
#include <hpvi/bound/legendre.h>

#include <cmath>

namespace hpvi
{
using namespace dealii;

CutElement::CutElement(const std::vector<Part> &parts, const unsigned int n_xi, const double h,
                       const Point<2> &centre)
    : parts(parts), h(h), centre(centre), k(parts[0].element->table.k),
      n_motions(parts[0].element->n_motions())
{
  set_places(n_xi);
  set_rows();
  const unsigned int m = n_faces(), n_inner = n - m, size = n_inner + C.m();
  A.reinit(n, n);
  N.resize(n_conditions * m);
  for (unsigned int box = 0; box < parts.size(); ++box)
    add_box(box);
  std::vector<double> matrix(size * size);
  for (unsigned int i = 0; i < n_inner; ++i)
  {
    for (unsigned int j = 0; j < n_inner; ++j)
      matrix[j * size + i] = A(m + i, m + j);
    for (unsigned int c = 0; c < C.m(); ++c)
      matrix[(n_inner + c) * size + i] = matrix[i * size + n_inner + c] = C(c, m + i);
  }
  factor = std::make_unique<const LuFactor>(std::move(matrix), size);
  require_regular(!factor->is_singular(), "the rows of stresses");
  best.reinit(n, m);
  std::vector<double> x(size);
  for (unsigned int j = 0; j < m; ++j)
  {
    for (unsigned int i = 0; i < n_inner; ++i)
      x[i] = -A(m + i, j);
    for (unsigned int c = 0; c < C.m(); ++c)
      x[n_inner + c] = -C(c, j);
    factor->solve(x);
    best(j, j) = 1.;
    for (unsigned int i = 0; i < n_inner; ++i)
      best(m + i, j) = x[i];
  }
  FullMatrix<double> half(n, m), reduced(m, m);
  A.mmult(half, best);
  best.Tmmult(reduced, half);
  for (unsigned int j = 0; j < m; ++j)
    for (unsigned int i = 0; i < m; ++i)
      G.push_back((reduced(i, j) + reduced(j, i)) / 2);
  for (unsigned int z = 0; z < n_conditions; ++z) // length 1, as those of other elements
  {
    double square = 0;
    for (unsigned int i = 0; i < m; ++i)
      square += N[z * m + i] * N[z * m + i];
    norms[z] = std::sqrt(square);
    for (unsigned int i = 0; i < m; ++i)
      N[z * m + i] /= norms[z];
    for (FullMatrix<double> &condition : conditions)
      for (unsigned int c = 0; c < n_conditions; ++c)
        condition(z, c) /= norms[z];
  }
}

/** Which tractions each box has: parts of those on faces of the cell, and those between it and its neighbours. */
void CutElement::set_places(const unsigned int n_xi)
{
  const unsigned int n_eta = parts.size() / n_xi, one = 2 * (k + 1);
  n = n_faces() + one * ((n_xi - 1) * n_eta + n_xi * (n_eta - 1));
  for (unsigned int box = 0; box < parts.size(); ++box)
  {
    const unsigned int x = box % n_xi, y = box / n_xi;
    FullMatrix<double> &own = to.emplace_back(n_faces(), n);
    std::array<bool, 4> &outer = is_outer.emplace_back();
    for (unsigned int face = 0; face < 4; ++face)
    {
      const unsigned int along = 1 - face / 2, at = face < 2 ? x : y,
                         last = (face < 2 ? n_xi : n_eta) - 1;
      const auto &[low, high] = parts[box].box.get_boundary_points();
      outer[face] = face % 2 ? at == last : at == 0;
      const FullMatrix<double> part = outer[face]
                                          ? legendre::restriction(k + 1, low[along], high[along])
                                          : FullMatrix<double>(IdentityMatrix(k + 1));
      unsigned int first = face * one;
      if (!outer[face] && face < 2)
        first = n_faces() + one * (y * (n_xi - 1) + x - 1 + face % 2);
      else if (!outer[face])
        first = n_faces() + one * ((n_xi - 1) * n_eta + (y - 1 + face % 2) * n_xi + x);
      for (unsigned int row = 0; row < 2; ++row)
        own.fill(part, face * one + row * (k + 1), first + row * (k + 1));
    }
  }
}

/** A line between boxes that ends on the axis is a face of two of them: its conditions are those of one. */
void CutElement::set_rows()
{
  unsigned int n_rows = 0;
  for (unsigned int box = 0; box < parts.size(); ++box)
  {
    const RowElement &element = *parts[box].element;
    n_conditions = std::max(n_conditions, element.n_conditions);
    rows.emplace_back().fill(numbers::invalid_unsigned_int);
    for (unsigned int c = 0; c < element.n_conditions; ++c)
      if (c < n_motions ? box + 1 < parts.size()
                        : !is_outer[box][element.face_of_end(c)] && element.face_of_end(c) % 2)
        rows[box][c] = n_rows++;
  }
  C.reinit(n_rows, n);
}

/** Adds its energy and conditions to those of the cell. */
void CutElement::add_box(const unsigned int box)
{
  const Part &part = parts[box];
  const unsigned int m = n_faces();
  const RowElement &element = *part.element;
  const TractionEnergy own = element.energy();
  FullMatrix<double> half(m, n), of_box(element.n_conditions, n);
  const double scale = part.h * part.h / (h * h);
  for (unsigned int i = 0; i < m; ++i)
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int l = 0; l < m; ++l)
        half(i, j) += scale * own.G.entries[std::size_t(l) * own.G.stride + i] * to[box](l, j);
  to[box].Tmmult(A, half, /*adding=*/true);
  for (unsigned int z = 0; z < element.n_conditions; ++z)
    for (unsigned int j = 0; j < n; ++j)
    {
      for (unsigned int l = 0; l < m; ++l)
        of_box(z, j) += own.N.entries[std::size_t(z) * own.N.stride + l] * to[box](l, j);
      if (rows[box][z] != numbers::invalid_unsigned_int)
        C(rows[box][z], j) = of_box(z, j);
    }
  // Forces and the moment about the middle of the cell, in units of its h.
  const RowElement::Conditions &lengths = element.lengths;
  const double ratio = part.h / h;
  const Tensor<1, 2> arm = (part.centre - centre) / h;
  FullMatrix<double> &of_cell = conditions.emplace_back(n_conditions, n_conditions);
  for (unsigned int c = 0; c < std::min(2U, n_motions); ++c)
    of_cell(c, c) = ratio * lengths[c];
  if (n_motions == 3)
  {
    of_cell(2, 0) = -arm[1] * ratio * lengths[0];
    of_cell(2, 1) = arm[0] * ratio * lengths[1];
    of_cell(2, 2) = ratio * ratio * lengths[2];
  }
  for (unsigned int c = n_motions; c < element.n_conditions; ++c)
    if (is_outer[box][element.face_of_end(c)]) // with the value that it has on the face of the cell
      of_cell(c, c) = lengths[c];
  for (unsigned int z = 0; z < n_conditions; ++z)
    for (unsigned int c = 0; c < element.n_conditions; ++c)
      for (unsigned int i = 0; i < m; ++i)
        N[z * m + i] += of_cell(z, c) * of_box(c, i);
}

TractionEnergy CutElement::energy() const
{
  return {k + 1, k + 1, n_conditions, {G.data(), n_faces()}, {N.data(), n_faces()}};
}

/** All tractions where those on faces vanish. */
std::vector<double> CutElement::inner(const Data &data) const
{
  const unsigned int m = n_faces(), n_inner = n - m;
  std::vector<double> x(n_inner + C.m()), result(n);
  for (unsigned int box = 0; box < parts.size(); ++box)
  {
    const double scale = parts[box].h * parts[box].h / (h * h);
    for (unsigned int i = 0; i < n_inner; ++i)
      for (unsigned int l = 0; l < m; ++l)
        x[i] -= scale * to[box](l, m + i) * data.gradients[box][l];
    for (unsigned int c = 0; c < rows[box].size(); ++c)
      if (rows[box][c] != numbers::invalid_unsigned_int)
        x[n_inner + rows[box][c]] = -data.defects[box][c];
  }
  factor->solve(x);
  std::copy(x.begin(), x.begin() + n_inner, result.begin() + m);
  return result;
}

std::vector<double> CutElement::gradient(const Data &data) const
{
  const std::vector<double> at = inner(data);
  std::vector<double> of_all(n), result(n_faces());
  for (unsigned int i = 0; i < n; ++i)
  {
    for (unsigned int j = n_faces(); j < n; ++j)
      of_all[i] += A(i, j) * at[j];
    for (unsigned int box = 0; box < parts.size(); ++box)
      for (unsigned int l = 0; l < n_faces(); ++l)
        of_all[i] += parts[box].h * parts[box].h / (h * h) * to[box](l, i) * data.gradients[box][l];
  }
  for (unsigned int j = 0; j < n_faces(); ++j)
    for (unsigned int i = 0; i < n; ++i)
      result[j] += best(i, j) * of_all[i];
  return result;
}

RowElement::Conditions CutElement::of_cell(const unsigned int box,
                                           const RowElement::Conditions &moments) const
{
  RowElement::Conditions result{};
  for (unsigned int z = 0; z < n_conditions; ++z)
    for (unsigned int c = 0; c < n_conditions; ++c)
      result[z] += conditions[box](z, c) * moments[c];
  return result;
}

RowElement::Conditions CutElement::defect(const Data &data) const
{
  RowElement::Conditions result{};
  for (unsigned int box = 0; box < parts.size(); ++box)
  {
    const RowElement::Conditions own = of_cell(box, data.defects[box]);
    for (unsigned int z = 0; z < n_conditions; ++z)
      result[z] += own[z];
  }
  return result;
}

std::vector<std::vector<double>> CutElement::tractions(const std::vector<double> &faces,
                                                       const Data &data) const
{
  std::vector<double> all = inner(data);
  for (unsigned int i = 0; i < n; ++i)
    for (unsigned int j = 0; j < n_faces(); ++j)
      all[i] += best(i, j) * faces[j];
  std::vector<std::vector<double>> result;
  for (const FullMatrix<double> &of_box : to)
  {
    std::vector<double> &own = result.emplace_back(n_faces());
    for (unsigned int l = 0; l < own.size(); ++l)
      for (unsigned int i = 0; i < n; ++i)
        own[l] += of_box(l, i) * all[i];
  }
  return result;
}
} // namespace hpvi
