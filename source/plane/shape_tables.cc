// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/polynomial.h>
#include <deal.II/base/qprojector.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_tools.h>
#include <deal.II/lac/lapack_templates.h>
#include <hpvi/base/memo_table.h>
#include <hpvi/plane/shape_tables.h>

#include <cmath>
#include <numeric>

namespace hpvi
{
using namespace dealii;

namespace
{
/** Value, first and second derivative of every 1D Lagrange polynomial at one coordinate. */
using Derivatives1D = std::vector<std::array<double, 3>>;

/** FE_Q(p) as products of Lagrange polynomials at the Gauss-Lobatto points. */
template <int dim>
class TensorElement
{
public:
  explicit TensorElement(const unsigned int degree)
      : polynomials(Polynomials::generate_complete_Lagrange_basis(
            QGaussLobatto<1>(degree + 1).get_points())),
        index(FETools::hierarchic_to_lexicographic_numbering<dim>(degree).size())
  {
    const auto lexicographic = FETools::hierarchic_to_lexicographic_numbering<dim>(degree);
    for (unsigned int shape = 0; shape < index.size(); ++shape)
      for (unsigned int d = 0, rest = lexicographic[shape]; d < dim; ++d, rest /= degree + 1)
        index[shape][d] = rest % (degree + 1);
  }

  unsigned int n_shapes() const
  {
    return index.size();
  }

  void locate(const Point<dim> &point)
  {
    for (unsigned int d = 0; d < dim; ++d)
    {
      factors[d].resize(polynomials.size());
      for (unsigned int i = 0; i < polynomials.size(); ++i)
        polynomials[i].value(point[d], 2, factors[d][i].data());
    }
  }

  /** The derivative of the given order in each direction at the point located last. */
  double derivative(const unsigned int shape, const std::array<unsigned int, dim> &order) const
  {
    double product = 1.;
    for (unsigned int d = 0; d < dim; ++d)
      product *= factors[d][index[shape][d]][order[d]];
    return product;
  }

private:
  const std::vector<Polynomials::Polynomial<double>> polynomials;
  std::vector<std::array<unsigned int, dim>> index; ///< of the factors of each shape function
  std::array<Derivatives1D, dim> factors;
};
} // namespace

template <int dim>
ShapeTable<dim> tabulate(const unsigned int degree, const std::vector<Point<dim>> &points,
                         const std::vector<double> &weights, const bool second_derivatives)
{
  thread_local std::map<unsigned int, TensorElement<dim>> elements; // dearer than a few points
  TensorElement<dim> &element = elements.try_emplace(degree, degree).first->second;
  ShapeTable<dim> table;
  table.n_shapes = element.n_shapes();
  table.rows_per_point = dim + (second_derivatives ? dim * dim : 0);
  table.points = points;
  table.weights = weights;
  table.values.reinit(points.size(), table.n_shapes);
  table.derivatives.reinit(points.size() * table.rows_per_point, table.n_shapes);
  for (unsigned int q = 0; q < points.size(); ++q)
  {
    element.locate(points[q]);
    for (unsigned int i = 0; i < table.n_shapes; ++i)
    {
      unsigned int row = q * table.rows_per_point;
      table.values(q, i) = element.derivative(i, {});
      for (unsigned int a = 0; a < dim; ++a)
      {
        std::array<unsigned int, dim> order{};
        order[a] = 1;
        table.derivatives(row++, i) = element.derivative(i, order);
      }
      for (unsigned int a = 0; second_derivatives && a < dim; ++a)
        for (unsigned int b = 0; b < dim; ++b)
        {
          std::array<unsigned int, dim> order{};
          ++order[a], ++order[b];
          table.derivatives(row++, i) = element.derivative(i, order);
        }
    }
  }
  return table;
}

namespace
{
constexpr unsigned int whole_cell = numbers::invalid_unsigned_int, whole_face = whole_cell;
} // namespace

template <int dim>
const ShapeTable<dim> &ShapeTables<dim>::cell(const unsigned int degree,
                                              const unsigned int n_gauss) const
{
  return in_cell(degree, n_gauss, true);
}

template <int dim>
const ShapeTable<dim> &ShapeTables<dim>::gradients(const unsigned int degree,
                                                   const unsigned int n_gauss) const
{
  return in_cell(degree, n_gauss, false);
}

template <int dim>
const ShapeTable<dim> &ShapeTables<dim>::in_cell(const unsigned int degree,
                                                 const unsigned int n_gauss,
                                                 const bool second_derivatives) const
{
  const auto make = [&]()
  {
    const QGauss<dim> gauss(n_gauss);
    return tabulate<dim>(degree, gauss.get_points(), gauss.get_weights(), second_derivatives);
  };
  return memoised(tables, {{degree, whole_cell, second_derivatives, n_gauss}}, make);
}

template <int dim>
const ShapeTable<dim> &ShapeTables<dim>::face(const unsigned int degree, const unsigned int face_no,
                                              const unsigned int n_gauss) const
{
  return subface(degree, face_no, whole_face, n_gauss);
}

template <int dim>
const ShapeTable<dim> &
ShapeTables<dim>::subface(const unsigned int degree, const unsigned int face_no,
                          const unsigned int subface_no, const unsigned int n_gauss) const
{
  const auto make = [&]()
  {
    const QGauss<dim - 1> gauss(n_gauss);
    const auto hypercube = ReferenceCells::get_hypercube<dim>();
    std::vector<Point<dim>> points(gauss.size());
    if (subface_no == whole_face)
      QProjector<dim>::project_to_face(hypercube, gauss, face_no, points);
    else
      QProjector<dim>::project_to_subface(hypercube, gauss, face_no, subface_no, points);
    return tabulate<dim>(degree, points, gauss.get_weights(), false);
  };
  return memoised(tables, {{degree, face_no, subface_no, n_gauss}}, make);
}

// A collection that is handed out never grows: another thread may be copying it. A longer one shares the elements of those before.
template <int dim>
const hp::FECollection<dim> &ShapeTables<dim>::elements(const unsigned int highest) const
{
  const hp::FECollection<dim> *longest = nullptr;
  {
    const ReadsMemoTables reading;
    if (const auto found = finite_elements.lower_bound(highest); found != finite_elements.end())
      return found->second;
    if (!finite_elements.empty())
      longest = &finite_elements.rbegin()->second;
  }
  return memoised(finite_elements, highest,
                  [&]()
                  {
                    auto result =
                        longest ? hp::FECollection<dim>(*longest) : hp::FECollection<dim>();
                    while (result.size() < highest)
                      result.push_back(FESystem<dim>(FE_Q<dim>(result.size() + 1), dim));
                    return result;
                  });
}

namespace
{
/** deal.II lists the ends of an edge before the nodes between them. */
template <int dim>
void number_edges(const FiniteElement<dim> &fe, LocalNumbering &numbering)
{
  const unsigned int n_nodes = fe.degree + 1;
  for (const unsigned int face : GeometryInfo<dim>::face_indices())
  {
    numbering.edge.emplace_back(dim * n_nodes);
    for (unsigned int i = 0; i < fe.n_dofs_per_face(face); ++i)
    {
      const auto [component, shape] = fe.face_system_to_component_index(i, face);
      const unsigned int node = shape == 0 ? 0 : shape == 1 ? fe.degree : shape - 1;
      numbering.edge.back()[component * n_nodes + node] = fe.face_to_cell_index(i, face);
    }
  }
}
} // namespace

template <int dim>
const LocalNumbering &ShapeTables<dim>::numbering(const unsigned int degree) const
{
  const auto make = [&]()
  {
    const FiniteElement<dim> &fe = elements(degree)[degree - 1];
    LocalNumbering numbering;
    numbering.n_boundary = fe.n_dofs_per_cell() - fe.template n_dofs_per_object<dim>();
    for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
    {
      numbering.component.push_back(fe.system_to_component_index(i).first);
      numbering.shape.push_back(fe.system_to_component_index(i).second);
    }
    if (dim == 2)
      number_edges(fe, numbering);
    return numbering;
  };
  return memoised(numberings, degree, make);
}

namespace
{
/** 1 / prod_k (x_i - x_k) of node i among @p nodes. */
double barycentric_weight(const std::vector<Point<1>> &x, const std::vector<unsigned int> &nodes,
                          const unsigned int i)
{
  double product = 1.;
  for (const unsigned int k : nodes)
    if (k != nodes[i])
      product *= x[nodes[i]][0] - x[k][0];
  return 1. / product;
}

/**
 * @p n of the nodes @p x, its ends among them. The one of the largest barycentric weight goes first:
 * its value follows from the others by quotients of these weights, none above 1.
 */
std::vector<unsigned int> select_nodes(const std::vector<Point<1>> &x, const unsigned int n)
{
  std::vector<unsigned int> nodes(x.size());
  std::iota(nodes.begin(), nodes.end(), 0);
  while (nodes.size() > n)
  {
    unsigned int largest = 1;
    for (unsigned int i = 2; i + 1 < nodes.size(); ++i)
      if (std::abs(barycentric_weight(x, nodes, i)) >
          std::abs(barycentric_weight(x, nodes, largest)) * (1 + 1e-9))
        largest = i;
    nodes.erase(nodes.begin() + largest);
  }
  return nodes;
}
} // namespace

template <int dim>
const EdgeInterpolation &ShapeTables<dim>::edge_interpolation(const unsigned int source_degree,
                                                              const unsigned int trace_degree,
                                                              const unsigned int target_degree,
                                                              const unsigned int part) const
{
  const auto make = [&]()
  {
    EdgeInterpolation result;
    const std::vector<Point<1>> &x = gauss_lobatto(source_degree + 1).get_points(),
                                &targets = gauss_lobatto(target_degree + 1).get_points();
    result.nodes = select_nodes(x, trace_degree + 1);
    result.weights.reinit(targets.size(), result.nodes.size());
    for (unsigned int i = 0; i < targets.size(); ++i)
    {
      const double t = part == whole_edge ? targets[i][0] : (part + targets[i][0]) / 2;
      for (unsigned int j = 0; j < result.nodes.size(); ++j)
      {
        double product = barycentric_weight(x, result.nodes, j);
        for (const unsigned int k : result.nodes)
          if (k != result.nodes[j])
            product *= t - x[k][0];
        result.weights(i, j) = product;
      }
    }
    return result;
  };
  return memoised(interpolations, {{source_degree, trace_degree, target_degree, part}}, make);
}

template <int dim>
const QGauss<1> &ShapeTables<dim>::gauss(const unsigned int n_gauss) const
{
  return memoised(gauss_rules, n_gauss, [&]() { return QGauss<1>(n_gauss); });
}

template <int dim>
const QGaussLobatto<1> &ShapeTables<dim>::gauss_lobatto(const unsigned int n_points) const
{
  return memoised(gauss_lobatto_rules, n_points, [&]() { return QGaussLobatto<1>(n_points); });
}

template <int dim>
const std::vector<Polynomials::Polynomial<double>> &
ShapeTables<dim>::gauss_lagrange(const unsigned int n_gauss) const
{
  return memoised(
      lagrange_bases, n_gauss,
      [&]() { return Polynomials::generate_complete_Lagrange_basis(gauss(n_gauss).get_points()); });
}

template <int dim>
const EdgeTable &ShapeTables<dim>::edge(const unsigned int degree, const unsigned int n_multipliers,
                                        const unsigned int n_gauss) const
{
  const auto make = [&]()
  {
    EdgeTable table;
    std::vector<Point<1>> nodes;
    for (const Point<1> &s : gauss_lobatto(degree + 1).get_points())
      nodes.emplace_back(s);
    const auto shapes = Polynomials::generate_complete_Lagrange_basis(nodes);
    const auto &multipliers = gauss_lagrange(n_multipliers);
    table.shapes.reinit(n_gauss, shapes.size());
    table.multipliers.reinit(n_gauss, n_multipliers);
    for (unsigned int q = 0; q < n_gauss; ++q)
    {
      const double s = gauss(n_gauss).point(q)[0];
      for (unsigned int j = 0; j < shapes.size(); ++j)
        table.shapes(q, j) = shapes[j].value(s);
      for (unsigned int i = 0; i < n_multipliers; ++i)
        table.multipliers(q, i) = multipliers[i].value(s);
    }
    return table;
  };
  return memoised(edge_tables, {{degree, n_multipliers, n_gauss}}, make);
}

template <int dim>
const FullMatrix<double> &ShapeTables<dim>::nodes_from_moments(const unsigned int degree,
                                                               const double slope) const
{
  const auto make = [&]()
  {
    FullMatrix<double> N;
    const unsigned int n = degree - 1;
    const EdgeTable &table = edge(degree, n, degree);
    FullMatrix<double> inner(n, n), inverse(n, n);
    Vector<double> weights(n);
    N.reinit(n, n + 2);
    // m_i w_i = sum_j inner_ij v_j + what both ends contribute.
    FullMatrix<double> ends(n, 2);
    for (unsigned int q = 0; q < degree; ++q)
      for (unsigned int i = 0; i < n; ++i)
      {
        const double psi = gauss(degree).weight(q) * table.multipliers(q, i) *
                           (1 + slope * (2 * gauss(degree).point(q)[0] - 1));
        weights[i] += psi;
        for (unsigned int j = 0; j < n; ++j)
          inner(i, j) += psi * table.shapes(q, j + 1);
        ends(i, 0) += psi * table.shapes(q, 0);
        ends(i, 1) += psi * table.shapes(q, degree);
      }
    inverse.invert(inner);
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
      {
        N(j, i) = inverse(j, i) * weights[i];
        N(j, n) -= inverse(j, i) * ends(i, 0);
        N(j, n + 1) -= inverse(j, i) * ends(i, 1);
      }
    return N;
  };
  return memoised(moment_nodes, {degree, slope}, make);
}

std::vector<double> evaluate(const FullMatrix<double> &table,
                             const std::vector<double> &coefficients)
{
  // A row-major matrix is its transpose to BLAS. Of small matrices OpenBLAS multiplies these as they are, components first, and
  // would copy others into a buffer that all threads share.
  const types::blas_int rows = table.m(), shapes = table.n(), n = coefficients.size() / shapes;
  const double one = 1., zero = 0.;
  std::vector<double> transposed(coefficients.size()), by_row(rows * n), result(rows * n);
  for (int i = 0; i < shapes; ++i)
    for (int c = 0; c < n; ++c)
      transposed[i * n + c] = coefficients[c * shapes + i];
  gemm("N", "N", &n, &rows, &shapes, &one, transposed.data(), &n, &table(0, 0), &shapes, &zero,
       by_row.data(), &n);
  for (int q = 0; q < rows; ++q)
    for (int c = 0; c < n; ++c)
      result[c * rows + q] = by_row[q * n + c];
  return result;
}

template struct ShapeTable<2>;
template class ShapeTables<2>;
template struct ShapeTable<3>;
template class ShapeTables<3>;
template ShapeTable<2> tabulate(unsigned int, const std::vector<Point<2>> &,
                                const std::vector<double> &, bool);
template ShapeTable<3> tabulate(unsigned int, const std::vector<Point<3>> &,
                                const std::vector<double> &, bool);
} // namespace hpvi
