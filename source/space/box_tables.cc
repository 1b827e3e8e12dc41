// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/space/box_tables.h>

#include <deal.II/base/geometry_info.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace hpvi
{
using namespace dealii;

namespace
{
template <int dim>
std::vector<std::array<unsigned int, dim>> numbers_of(const FiniteElement<dim> &fe)
{
  std::vector<std::array<unsigned int, dim>> numbers(fe.dofs_per_cell / dim);
  for (unsigned int k = 0; k < fe.dofs_per_cell; ++k)
  {
    const auto [component, shape] = fe.system_to_component_index(k);
    numbers[shape][component] = k;
  }
  return numbers;
}

template <int dim>
BoxTable<dim> box_table(const FiniteElement<dim> &fe, const std::vector<Point<dim>> &points,
                        const std::vector<double> &weights)
{
  BoxTable<dim> table;
  table.points = points;
  table.weights = weights;
  table.values.reinit(points.size(), fe.dofs_per_cell);
  for (unsigned int a = 0; a < dim; ++a)
    table.gradients[a].reinit(points.size(), fe.dofs_per_cell);
  for (unsigned int q = 0; q < points.size(); ++q)
    for (unsigned int i = 0; i < fe.dofs_per_cell; ++i)
    {
      table.values(q, i) = fe.shape_value(i, points[q]);
      const Tensor<1, dim> gradient = fe.shape_grad(i, points[q]);
      for (unsigned int a = 0; a < dim; ++a)
        table.gradients[a](q, i) = gradient[a];
    }
  return table;
}

/** @p rule on a face. */
template <int dim>
BoxTable<dim> tabulate_face(const FiniteElement<dim> &fe, const Quadrature<dim - 1> &rule,
                            const unsigned int face)
{
  const auto axes = tangents<dim>(face);
  std::vector<Point<dim>> points(rule.size());
  for (unsigned int q = 0; q < rule.size(); ++q)
  {
    points[q][face / 2] = face % 2;
    for (unsigned int s = 0; s < dim - 1; ++s)
      points[q][axes[s]] = rule.point(q)[s];
  }
  return box_table(fe, points, rule.get_weights());
}

template <int dim>
BoxTable<dim> tabulate_cell(const FiniteElement<dim> &fe, const unsigned int n_gauss)
{
  const QGauss<dim> rule(n_gauss);
  return box_table(fe, rule.get_points(), rule.get_weights());
}
} // namespace

template <int dim>
FE_Q<dim> BoxTables<dim>::scalar() const
{
  return FE_Q<dim>(degree);
}

template <int dim>
BoxTables<dim>::BoxTables(const unsigned int degree)
    : degree(degree), fe(FE_Q<dim>(degree), dim), n_shapes(fe.dofs_per_cell / dim),
      numbers(numbers_of(fe)), cell(tabulate_cell(scalar(), degree + 1))
{
  const FE_Q<dim> element = scalar();
  const QGauss<dim - 1> rule(degree + 1);
  for (const unsigned int face : GeometryInfo<dim>::face_indices())
  {
    faces.push_back(tabulate_face(element, rule, face));
    if (degree > 1)
      moment_points.push_back(tabulate_face(element, QGauss<dim - 1>(degree - 1), face));
  }
  for (unsigned int a = 0; a < dim; ++a)
    for (unsigned int b = 0; b < dim; ++b)
    {
      FullMatrix<double> weighted = cell.gradients[b];
      for (unsigned int q = 0; q < cell.weights.size(); ++q)
        for (unsigned int i = 0; i < n_shapes; ++i)
          weighted(q, i) *= cell.weights[q];
      products[a][b].reinit(n_shapes, n_shapes);
      cell.gradients[a].Tmmult(products[a][b], weighted);
    }
  if (degree > 1)
  {
    for (unsigned int i = 0; i + 1 < degree; ++i) // along the first axis
      gauss.push_back(moment_points.back().points[i][0]);
    number_faces();
    contact_dofs = make_contact_dofs(0, [](const Point<dim> &) { return 1.; });
  }
}

template <int dim>
void BoxTables<dim>::number_faces()
{
  const FE_Q<dim> element = scalar();
  const auto &nodes = element.get_unit_support_points();
  for (const unsigned int face : GeometryInfo<dim>::face_indices())
  {
    inner.emplace_back();
    rim.emplace_back();
    for (unsigned int i = 0; i < n_shapes; ++i)
      if (element.has_support_on_face(i, face))
      {
        bool is_inner = true;
        for (const unsigned int axis : tangents<dim>(face))
          is_inner = is_inner && nodes[i][axis] > 1e-9 && nodes[i][axis] < 1 - 1e-9;
        (is_inner ? inner : rim).back().push_back(i);
      }
    // deal.II numbers the nodes of a face in coordinates of its own.
    const auto before = [&](const unsigned int i, const unsigned int j)
    {
      for (unsigned int s = dim - 1; s-- > 0;)
        if (const double difference =
                nodes[i][tangents<dim>(face)[s]] - nodes[j][tangents<dim>(face)[s]];
            std::abs(difference) > 1e-9)
          return difference < 0;
      return false;
    };
    std::sort(inner.back().begin(), inner.back().end(), before);
    std::sort(rim.back().begin(), rim.back().end(), before);
  }
}

template <int dim>
FaceContactDofs
BoxTables<dim>::make_contact_dofs(const unsigned int face,
                                  const std::function<double(const Point<dim> &)> &measure) const
{
  const unsigned int n = inner[face].size();
  const BoxTable<dim> &table = faces[face];
  FaceContactDofs result;
  for (unsigned int k = 0; k < n; ++k) // psi_k ds has the degree p - 1 in each direction
    result.areas.push_back(moment_points[face].weights[k] * measure(moment_points[face].points[k]));
  result.M.reinit(n, n);
  result.W.reinit(n, rim[face].size());
  for (unsigned int q = 0; q < table.points.size(); ++q)
  {
    const double ds = table.weights[q] * measure(table.points[q]);
    for (unsigned int k = 0; k < n; ++k)
    {
      const double weight = ds * psi(k, face, table.points[q]) / result.areas[k];
      for (unsigned int j = 0; j < n; ++j)
        result.M(k, j) += weight * table.values(q, inner[face][j]);
      for (unsigned int j = 0; j < rim[face].size(); ++j)
        result.W(k, j) += weight * table.values(q, rim[face][j]);
    }
  }
  result.M_inverse.reinit(n, n);
  result.M_inverse.invert(result.M);
  return result;
}

template <int dim>
FaceContactDofs BoxTables<dim>::moments_of(const CellMap<dim> &map, const unsigned int face) const
{
  return make_contact_dofs(face, [&](const Point<dim> &x) { return map.face_measure(face, x); });
}

/** By p+2 points a direction, as gaps are taken. */
template <int dim>
FaceContactDofs BoxTables<dim>::curved_moments_of(
    const CellMap<dim> &map, const unsigned int face,
    const std::function<ContactAxes<dim>(const Point<dim> &)> &axes) const
{
  const unsigned int n = inner[face].size(), n_rim = rim[face].size();
  const BoxTable<dim> table = tabulate_face(scalar(), QGauss<dim - 1>(degree + 2), face);
  FaceContactDofs result;
  result.areas.resize(n);
  result.M.reinit(dim * n, dim * n);
  result.W.reinit(dim * n, dim * n_rim);
  for (unsigned int q = 0; q < table.points.size(); ++q)
  {
    const ContactAxes<dim> here = axes(table.points[q]);
    const double ds = table.weights[q] * map.face_measure(face, table.points[q]);
    for (unsigned int k = 0; k < n; ++k)
    {
      const double weight = ds * psi(k, face, table.points[q]);
      result.areas[k] += weight;
      for (unsigned int own = 0; own < dim; ++own)
        for (unsigned int c = 0; c < dim; ++c)
        {
          const double part = weight * (own == dim - 1 ? here.normal : here.tangents[own])[c];
          for (unsigned int j = 0; j < n; ++j)
            result.M(own * n + k, c * n + j) += part * table.values(q, inner[face][j]);
          for (unsigned int j = 0; j < n_rim; ++j)
            result.W(own * n + k, c * n_rim + j) += part * table.values(q, rim[face][j]);
        }
    }
  }
  for (unsigned int row = 0; row < dim * n; ++row)
  {
    for (unsigned int j = 0; j < result.M.n(); ++j)
      result.M(row, j) /= result.areas[row % n];
    for (unsigned int j = 0; j < result.W.n(); ++j)
      result.W(row, j) /= result.areas[row % n];
  }
  result.M_inverse.reinit(dim * n, dim * n);
  result.M_inverse.invert(result.M);
  return result;
}

template <int dim>
double BoxTables<dim>::psi(const unsigned int k, const unsigned int face, const Point<dim> &x) const
{
  double product = 1;
  for (const unsigned int axis : tangents<dim>(face))
    for (const double other : gauss)
    {
      const double own = moment_points[face].points[k][axis];
      if (std::abs(own - other) > 1e-9)
        product *= (x[axis] - other) / (own - other);
    }
  return product;
}

template <int dim>
FullMatrix<double> BoxTables<dim>::stiffness(const HookesLaw<dim> &law,
                                             const Tensor<1, dim> &size) const
{
  double volume = 1;
  for (unsigned int d = 0; d < dim; ++d)
    volume *= size[d];
  FullMatrix<double> K(fe.dofs_per_cell, fe.dofs_per_cell);
  for (unsigned int i = 0; i < n_shapes; ++i)
    for (unsigned int j = 0; j < n_shapes; ++j)
    {
      const auto P = [&](const unsigned int a, const unsigned int b)
      { return products[a][b](i, j) * volume / (size[a] * size[b]); };
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int d = 0; d < dim; ++d)
          K(numbers[i][c], numbers[j][d]) = law.stiffness(P, c, d);
    }
  return K;
}

template <int dim>
CellGradients<dim>::CellGradients(const BoxTable<dim> &table, const CellMap<dim> &map)
{
  const unsigned int n_points = table.points.size(), n = table.values.n();
  for (FullMatrix<double> &component : gradients)
    component.reinit(n_points, n);
  for (unsigned int q = 0; q < n_points; ++q)
  {
    const Tensor<2, dim> J = map.jacobian(table.points[q]), inverse = invert(J);
    volumes.push_back(table.weights[q] * std::abs(determinant(J)));
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int b = 0; b < dim; ++b)
        for (unsigned int i = 0; i < n; ++i)
          gradients[a](q, i) += inverse[b][a] * table.gradients[b](q, i);
  }
}

template <int dim>
FullMatrix<double> BoxTables<dim>::stiffness(const HookesLaw<dim> &law,
                                             const CellMap<dim> &map) const
{
  const CellGradients<dim> of_cell(cell, map);
  std::array<std::array<FullMatrix<double>, dim>, dim> own;
  for (unsigned int b = 0; b < dim; ++b)
  {
    FullMatrix<double> weighted = of_cell.gradients[b];
    for (unsigned int q = 0; q < cell.points.size(); ++q)
      for (unsigned int i = 0; i < n_shapes; ++i)
        weighted(q, i) *= of_cell.volumes[q];
    for (unsigned int a = 0; a < dim; ++a)
    {
      own[a][b].reinit(n_shapes, n_shapes);
      of_cell.gradients[a].Tmmult(own[a][b], weighted);
    }
  }
  FullMatrix<double> K(fe.dofs_per_cell, fe.dofs_per_cell);
  for (unsigned int i = 0; i < n_shapes; ++i)
    for (unsigned int j = 0; j < n_shapes; ++j)
    {
      const auto P = [&](const unsigned int a, const unsigned int b) { return own[a][b](i, j); };
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int d = 0; d < dim; ++d)
          K(numbers[i][c], numbers[j][d]) = law.stiffness(P, c, d);
    }
  return K;
}

template <int dim>
FullMatrix<double> BoxTables<dim>::basis_of_moments(const std::vector<bool> &components) const
{
  FullMatrix<double> T = IdentityMatrix(fe.dofs_per_cell),
                     rim_to_inner(n_contact_dofs(), contact_dofs.W.n());
  contact_dofs.M_inverse.mmult(rim_to_inner, contact_dofs.W);
  for (const unsigned int face : GeometryInfo<dim>::face_indices())
    for (unsigned int c = 0; c < dim; ++c)
    {
      if (!components[dim * face + c])
        continue;
      const auto number = [&](const unsigned int shape) { return numbers[shape][c]; };
      for (unsigned int r = 0; r < n_contact_dofs(); ++r)
      {
        const unsigned int row = number(inner[face][r]);
        for (unsigned int k = 0; k < n_contact_dofs(); ++k)
          T(row, number(inner[face][k])) = contact_dofs.M_inverse(r, k);
        for (unsigned int j = 0; j < contact_dofs.W.n(); ++j)
          T(row, number(rim[face][j])) = -rim_to_inner(r, j);
      }
    }
  return T;
}

template <int dim>
Tensor<2, dim> gradient(const BoxTable<dim> &table, const unsigned int q,
                        const CellField<dim> &field, const Tensor<1, dim> &size)
{
  Tensor<2, dim> result;
  for (unsigned int a = 0; a < dim; ++a)
  {
    Tensor<1, dim> derivative;
    for (unsigned int i = 0; i < field.size(); ++i)
      derivative += table.gradients[a](q, i) * field[i];
    for (unsigned int c = 0; c < dim; ++c)
      result[c][a] = derivative[c] / size[a];
  }
  return result;
}

template struct CellGradients<2>;
template struct CellGradients<3>;
template class BoxTables<2>;
template class BoxTables<3>;
template Tensor<2, 2> gradient(const BoxTable<2> &, unsigned int, const CellField<2> &,
                               const Tensor<1, 2> &);
template Tensor<2, 3> gradient(const BoxTable<3> &, unsigned int, const CellField<3> &,
                               const Tensor<1, 3> &);
} // namespace hpvi
