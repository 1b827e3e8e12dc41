// SPDX-License-Identifier: LGPL-2.1-or-later
// What is computed cell by cell - shapes, stiffness, residuals - against deal.II's FEValues.
#include "dense_elimination.h"
#include "discretisation.h"

#include <hpvi/results/solution_field.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <set>

namespace
{
using namespace verification;

using Vertices = CellMap<2>::Vertices;

const Vertices square = {{{0, 0}, {1, 0}, {0, 1}, {1, 1}}};

struct NamedCell
{
  std::string name;
  Vertices vertices;
  bool affine;
};

std::ostream &operator<<(std::ostream &out, const NamedCell &cell)
{
  return out << cell.name;
}

const std::vector<NamedCell> cells = {
    {"Square", square, true},
    {"FlatRectangle", {{{1, 2}, {4, 2}, {1, 2.1}, {4, 2.1}}}, true},
    {"Parallelogram", {{{0, 0}, {2, 0.5}, {0.4, 1}, {2.4, 1.5}}}, true},
    {"TurnedSquare", {{{0, 0}, {0.6, 0.8}, {-0.8, 0.6}, {-0.2, 1.4}}}, true},
    {"Trapezoid", {{{0, 0}, {2, 0}, {0.5, 1}, {1.2, 1}}}, false},
    {"Quadrilateral", {{{0.1, 0}, {2, -0.3}, {-0.4, 1}, {1.5, 1.7}}}, false}};

std::string name_of(const ::testing::TestParamInfo<NamedCell> &info)
{
  return info.param.name;
}

/** A mesh of this one cell. */
void make_cell(const Vertices &vertices, Triangulation<2> &mesh)
{
  CellData<2> cell;
  std::vector<Point<2>> points(vertices.begin(), vertices.end());
  for (unsigned int v = 0; v < 4; ++v)
    cell.vertices[v] = v;
  mesh.create_triangulation(points, {cell}, SubCellData());
}

// ---------------------------------------------------------------- geometry

using CellMaps = ::testing::TestWithParam<NamedCell>;

TEST_P(CellMaps, AreDealIIsBilinearMaps)
{
  Triangulation<2> mesh;
  make_cell(GetParam().vertices, mesh);
  const FE_Q<2> fe(1);
  const QGauss<2> gauss(4);
  FEValues<2> values(fe, gauss,
                     update_quadrature_points | update_jacobians | update_jacobian_grads);
  values.reinit(mesh.begin_active());
  const CellMap<2> map = map_of<2>(mesh.begin_active());
  EXPECT_EQ(map.is_affine(), GetParam().affine);
  for (unsigned int q = 0; q < gauss.size(); ++q)
  {
    const Point<2> reference = gauss.point(q);
    EXPECT_LE(map.point(reference).distance(values.quadrature_point(q)), 1e-14);
    const auto J = map.jacobian(reference);
    const auto H = map.hessian(reference);
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int j = 0; j < 2; ++j)
      {
        EXPECT_NEAR(J[i][j], values.jacobian(q)[i][j], 1e-14);
        for (unsigned int k = 0; k < 2; ++k)
          EXPECT_NEAR(H[i][j][k], values.jacobian_grad(q)[i][j][k], 1e-14);
      }
  }
}

INSTANTIATE_TEST_SUITE_P(, CellMaps, ::testing::ValuesIn(cells), name_of);

// ---------------------------------------------------------------- shape functions

/** Largest second derivatives grow like p^4, and round-off with them. */
double tolerance(const unsigned int degree, const unsigned int order)
{
  return 1e-13 * std::pow(degree, 2 * order);
}

class ShapeFunctions : public ::testing::TestWithParam<unsigned int>
{
protected:
  const unsigned int p = GetParam();
  const FE_Q<2> fe{p};
  const ShapeTables<2> tables;

  /** Values and first derivatives at the table's own points. */
  void expect_right(const ShapeTable<2> &table) const
  {
    ASSERT_EQ(table.n_shapes, fe.n_dofs_per_cell());
    for (unsigned int q = 0; q < table.points.size(); ++q)
      for (unsigned int i = 0; i < table.n_shapes; ++i)
      {
        const Point<2> &x = table.points[q];
        EXPECT_NEAR(table.values(q, i), fe.shape_value(i, x), tolerance(p, 0));
        for (unsigned int d = 0; d < 2; ++d)
          EXPECT_NEAR(table.derivatives(q * table.rows_per_point + d, i), fe.shape_grad(i, x)[d],
                      tolerance(p, 1));
      }
  }

  template <class Values>
  void expect_points(const ShapeTable<2> &table, const Values &values) const
  {
    double measure = 0;
    for (const double weight : table.weights)
      measure += weight;
    EXPECT_NEAR(measure, 1., 1e-14);
    for (unsigned int q = 0; q < table.points.size(); ++q)
      EXPECT_LE(table.points[q].distance(values.quadrature_point(q)), 1e-14);
  }
};

TEST_P(ShapeFunctions, InTheCellAreThoseOfFEQ)
{
  const ShapeTable<2> &table = tables.cell(p, p + 2);
  const QGauss<2> gauss(p + 2);
  ASSERT_EQ(table.points, gauss.get_points());
  EXPECT_EQ(table.weights, gauss.get_weights());
  EXPECT_EQ(table.rows_per_point, 6u);
  expect_right(table);
  for (unsigned int q = 0; q < gauss.size(); ++q)
    for (unsigned int i = 0; i < table.n_shapes; ++i)
      for (unsigned int a = 0; a < 2; ++a)
        for (unsigned int b = 0; b < 2; ++b)
          EXPECT_NEAR(table.derivatives(q * 6 + 2 + 2 * a + b, i),
                      fe.shape_grad_grad(i, gauss.point(q))[a][b], tolerance(p, 2));
}

TEST_P(ShapeFunctions, OnFacesAreThoseOfFEQ)
{
  Triangulation<2> mesh;
  make_cell(square, mesh);
  FEFaceValues<2> values(fe, QGauss<1>(p + 1), update_quadrature_points);
  for (unsigned int face = 0; face < 4; ++face)
  {
    values.reinit(mesh.begin_active(), face);
    expect_points(tables.face(p, face, p + 1), values);
    expect_right(tables.face(p, face, p + 1));
  }
}

TEST_P(ShapeFunctions, OnHalvesOfFacesAreThoseOfFEQ)
{
  Triangulation<2> mesh;
  make_cell(square, mesh);
  FESubfaceValues<2> values(fe, QGauss<1>(p + 1), update_quadrature_points);
  mesh.refine_global(1); // the parent's faces then have the halves that values asks for
  for (unsigned int face = 0; face < 4; ++face)
    for (unsigned int half = 0; half < 2; ++half)
    {
      values.reinit(mesh.begin(0), face, half);
      expect_points(tables.subface(p, face, half, p + 1), values);
      expect_right(tables.subface(p, face, half, p + 1));
    }
}

TEST_P(ShapeFunctions, AreNumberedLikeTheVectorElement)
{
  const FESystem<2> system(fe, 2);
  const LocalNumbering &numbering = tables.numbering(p);
  EXPECT_EQ(numbering.n_boundary, 2 * 4 * p);
  ASSERT_EQ(numbering.shape.size(), system.n_dofs_per_cell());
  const Point<2> x(0.3, 0.6);
  for (unsigned int i = 0; i < system.n_dofs_per_cell(); ++i)
    for (unsigned int c = 0; c < 2; ++c)
      EXPECT_NEAR(system.shape_value_component(i, x, c),
                  c == numbering.component[i] ? fe.shape_value(numbering.shape[i], x) : 0., 1e-13);
  for (unsigned int i = 0; i < system.n_dofs_per_cell(); ++i)
  {
    const Point<2> support = system.unit_support_point(i);
    const bool inside = std::abs(support[0] - 0.5) < 0.499 && std::abs(support[1] - 0.5) < 0.499;
    EXPECT_EQ(i < numbering.n_boundary, !inside);
  }
}

INSTANTIATE_TEST_SUITE_P(, ShapeFunctions, ::testing::Values(1u, 2u, 3u, 5u, 8u, 12u));

TEST(Evaluate, IsOneProductPerComponent)
{
  const ShapeTables<2> tables;
  const FullMatrix<double> &values = tables.cell(3, 4).values;
  std::vector<double> coefficients(2 * values.n());
  for (unsigned int i = 0; i < coefficients.size(); ++i)
    coefficients[i] = std::sin(i + 1.);
  const std::vector<double> result = evaluate(values, coefficients);
  ASSERT_EQ(result.size(), 2 * values.m());
  for (unsigned int c = 0; c < 2; ++c)
    for (unsigned int q = 0; q < values.m(); ++q)
    {
      double sum = 0;
      for (unsigned int i = 0; i < values.n(); ++i)
        sum += values(q, i) * coefficients[c * values.n() + i];
      EXPECT_NEAR(result[c * values.m() + q], sum, 1e-13);
    }
}

// ---------------------------------------------------------------- element stiffness

Scene<2> elastic_scene(const bool body_force)
{
  return scene_of({given::elastic("3", "0.35"),
                   {"Material/Plane", "stress"},
                   {"Body force/Expression", body_force ? "0; -1" : ""},
                   {"Boundary top/Displacement", "0; 0"}});
}

/** a(v_j, v_i) on one cell, with points enough for any quadrilateral. */
FullMatrix<double> stiffness_by_fe_values(const Vertices &vertices, const unsigned int p,
                                          const Material &material)
{
  Triangulation<2> mesh;
  make_cell(vertices, mesh);
  const FESystem<2> fe(FE_Q<2>(p), 2);
  FEValues<2> values(fe, QGauss<2>(p + 20), update_gradients | update_JxW_values);
  values.reinit(mesh.begin_active());
  const FEValuesExtractors::Vector u(0);
  FullMatrix<double> K(fe.n_dofs_per_cell(), fe.n_dofs_per_cell());
  for (const unsigned int q : values.quadrature_point_indices())
    for (unsigned int i = 0; i < K.m(); ++i)
      for (unsigned int j = 0; j < K.n(); ++j)
        K(i, j) += values.JxW(q) *
                   (material.lambda(2) * values[u].divergence(i, q) * values[u].divergence(j, q) +
                    2 * material.mu() *
                        (values[u].symmetric_gradient(i, q) * values[u].symmetric_gradient(j, q)));
  return K;
}

class Stiffness : public ::testing::TestWithParam<NamedCell>
{
protected:
  const Scene<2> scene = elastic_scene(true);
  const ShapeTables<2> tables;
};

/** By plain inversion of the interior block. */
TEST_P(Stiffness, IsCondensedToTheBoundary)
{
  CondensedElements<2> stiffnesses(scene, tables);
  for (const unsigned int p : {1u, 2u, 4u, 7u})
    expect_condensed(*stiffnesses.get(CellMap<2>(GetParam().vertices), p, 0),
                     stiffness_by_fe_values(GetParam().vertices, p, scene.materials[0]), 8 * p,
                     1e-11);
}

INSTANTIATE_TEST_SUITE_P(, Stiffness, ::testing::ValuesIn(cells), name_of);

/** The vertices moved by @p shift after being multiplied by @p factor. */
CellMap<2> moved(Vertices vertices, const double factor, const Tensor<1, 2> &shift)
{
  for (Point<2> &v : vertices)
    v = factor * v + shift;
  return CellMap<2>(vertices);
}

TEST(CongruenceCache, SharesTheMatricesOfMovedAndScaledCells)
{
  const Scene<2> scene = elastic_scene(false);
  const ShapeTables<2> tables;
  CondensedElements<2> stiffnesses(scene, tables);
  for (const NamedCell &cell : cells)
  {
    const auto element = stiffnesses.get(CellMap<2>(cell.vertices), 4, 0);
    for (const double factor : {1e-6, 0.3, 1., 1024.})
      EXPECT_EQ(stiffnesses.get(moved(cell.vertices, factor, factor * Point<2>(3.1, -7.3)), 4, 0),
                element)
          << cell.name << " times " << factor;
  }
}

TEST(CongruenceCache, TellsShapesAndDegreesApart)
{
  const Scene<2> scene = elastic_scene(false);
  const ShapeTables<2> tables;
  CondensedElements<2> stiffnesses(scene, tables);
  std::vector<std::shared_ptr<const CondensedElement>> elements; // keeps them alive
  std::set<const CondensedElement *> different;
  const auto add = [&](const Vertices &vertices, const unsigned int degree)
  {
    elements.push_back(stiffnesses.get(CellMap<2>(vertices), degree, 0));
    different.insert(elements.back().get());
  };
  for (const NamedCell &cell : cells)
    for (const unsigned int degree : {2u, 3u})
      add(cell.vertices, degree);
  for (const double little : {1e-6, 1e-8, 1e-10}) // nearly the square
  {
    add({{{0, 0}, {1, 0}, {0, 1 + little}, {1, 1 + little}}}, 2);
    add({{{0, 0}, {1, 0}, {0, 1}, {1, 1 + little}}}, 2);
    add({{{0, 0}, {1 + little, 0}, {0, 1}, {1, 1}}}, 2);
  }
  EXPECT_EQ(different.size(), elements.size());
}

TEST(CongruenceCache, ForgetsWhatNobodyUses)
{
  const Scene<2> scene = elastic_scene(false);
  const ShapeTables<2> tables;
  CondensedElements<2> stiffnesses(scene, tables);
  std::weak_ptr<const CondensedElement> element = stiffnesses.get(CellMap<2>(square), 3, 0);
  EXPECT_TRUE(element.expired());
}

/** T'KT beside its definition; shared by what is equal, and by nothing else. */
TEST(CongruenceCache, ConstrainedMatricesAreCongruentAndShared)
{
  const Scene<2> scene = elastic_scene(false);
  const ShapeTables<2> tables;
  CondensedElements<2> stiffnesses(scene, tables);
  auto element = stiffnesses.get(CellMap<2>(square), 3, 0);
  const unsigned int n = element->condensed.m(), n_targets = n + 2;

  // All but the last two unknowns are free; those depend on three others each.
  std::vector<ConstraintEntry> T;
  for (unsigned int i = 0; i + 2 < n; ++i)
    T.push_back({i, i, 1.});
  for (unsigned int i = n - 2; i < n; ++i)
    for (const unsigned int target : {i - 5, n - 2 + i % 2, n_targets - 1})
      T.push_back({i, target, 0.1 * (1 + target) - 0.3 * i});
  FullMatrix<double> dense(n, n_targets), KT(n, n_targets), expected(n_targets, n_targets);
  for (const ConstraintEntry &entry : T)
    dense(entry.local, entry.target) += entry.weight;
  element->condensed.mmult(KT, dense);
  dense.Tmmult(expected, KT);
  auto matrix = stiffnesses.constrained(element, T, n_targets);
  expected.add(-1., *matrix);
  EXPECT_LE(expected.frobenius_norm(), 1e-13 * matrix->frobenius_norm());

  EXPECT_EQ(stiffnesses.constrained(element, T, n_targets), matrix);
  auto other = T;
  other.back().weight = std::nextafter(other.back().weight, 10.);
  EXPECT_NE(stiffnesses.constrained(element, other, n_targets), matrix);
  EXPECT_NE(
      stiffnesses.constrained(stiffnesses.get(CellMap<2>(cells[1].vertices), 3, 0), T, n_targets),
      matrix);

  const std::weak_ptr<const CondensedElement> unused = element;
  element.reset();
  matrix.reset();
  stiffnesses.forget_unused();
  EXPECT_TRUE(unused.expired());
}

// ---------------------------------------------------------------- residual indicator

/** (4.44)-(4.51) by deal.II's FEValues: derivatives in physical coordinates from the library. */
class ResidualOracle
{
public:
  ResidualOracle(const Solution<2> &solution, unsigned int extra);

  ErrorEstimate result;

private:
  using Cell = DoFHandler<2>::active_cell_iterator;

  /** 2 mu, of materials that resist changes of volume: what strains of residuals are measured by. */
  double stiffness(const Cell &cell) const
  {
    return 2 * solution.scene.materials[cell->material_id()].mu();
  }

  double first_stiffness() const
  {
    return 2 * solution.scene.materials[0].mu();
  }

  void add_volume(const Cell &cell);
  void add_edge(const Cell &cell, unsigned int face);
  void add_jump(const Cell &cell, unsigned int face);
  void add_neumann(const Cell &cell, unsigned int face);
  void add_contact(const Cell &cell, unsigned int face);

  /** sigma n by @p values, for the given normals */
  std::vector<Tensor<1, 2>> tractions(const FEValuesBase<2> &values,
                                      const std::vector<Tensor<1, 2>> &normals) const;

  /** h_K/p_K */
  static double weight(const Cell &cell)
  {
    double h = 0;
    for (const unsigned int face : cell->face_indices())
      h = std::max(h, cell->face(face)->vertex(0).distance(cell->face(face)->vertex(1)));
    return h / cell->get_fe().degree;
  }

  QGauss<1> edge_gauss(const unsigned int degree) const
  {
    return QGauss<1>(degree + extra);
  }

  const Solution<2> &solution;
  const unsigned int extra;
};

ResidualOracle::ResidualOracle(const Solution<2> &solution, const unsigned int extra)
    : solution(solution), extra(extra)
{
  const DoFHandler<2> &dofs = solution.displacement_space.dof_handler();
  const unsigned int n = dofs.get_triangulation().n_active_cells();
  for (auto *part : {&result.volume, &result.jumps, &result.neumann, &result.contact})
    part->resize(n);
  for (const auto &cell : dofs.active_cell_iterators())
  {
    add_volume(cell);
    for (const unsigned int face : cell->face_indices())
      add_edge(cell, face);
  }
}

void ResidualOracle::add_volume(const Cell &cell)
{
  FEValues<2> values(cell->get_fe(), QGauss<2>(cell->get_fe().degree + extra),
                     update_hessians | update_JxW_values | update_quadrature_points);
  values.reinit(cell);
  std::vector<Tensor<3, 2>> second(values.n_quadrature_points);
  values[FEValuesExtractors::Vector(0)].get_function_hessians(solution.u, second);
  const Material &material = solution.scene.materials[cell->material_id()];
  const double lambda = material.lambda(2), mu = material.mu();
  double sum = 0;
  for (const unsigned int q : values.quadrature_point_indices())
  {
    Tensor<1, 2> r; // -div sigma - F
    for (unsigned int i = 0; i < 2; ++i)
    {
      for (unsigned int j = 0; j < 2; ++j)
        r[i] -= (lambda + mu) * second[q][j][i][j] + mu * second[q][i][j][j];
      if (solution.scene.body_force[i])
        r[i] -= solution.scene.body_force[i]->value(values.quadrature_point(q));
    }
    sum += values.JxW(q) * r.norm_square();
  }
  result.volume[cell->active_cell_index()] =
      std::pow(weight(cell), 2) * sum * first_stiffness() / stiffness(cell);
}

std::vector<Tensor<1, 2>> ResidualOracle::tractions(const FEValuesBase<2> &values,
                                                    const std::vector<Tensor<1, 2>> &normals) const
{
  std::vector<Tensor<2, 2>> gradients(normals.size());
  values[FEValuesExtractors::Vector(0)].get_function_gradients(solution.u, gradients);
  std::vector<Tensor<1, 2>> result(normals.size());
  const Material &material = solution.scene.materials[values.get_cell()->material_id()];
  const double lambda = material.lambda(2), mu = material.mu();
  for (unsigned int q = 0; q < normals.size(); ++q)
  {
    const SymmetricTensor<2, 2> strain = symmetrize(gradients[q]);
    result[q] =
        (lambda * trace(strain) * unit_symmetric_tensor<2>() + 2 * mu * strain) * normals[q];
  }
  return result;
}

void ResidualOracle::add_edge(const Cell &cell, const unsigned int face)
{
  if (cell->at_boundary(face))
  {
    const auto &condition = solution.scene.boundaries[cell->face(face)->boundary_id()];
    if (condition.has_contact())
      add_contact(cell, face);
    else
      add_neumann(cell, face);
  }
  else if (!cell->face(face)->has_children())
    add_jump(cell, face);
}

/** Each cell is given its own part, so an edge between equals is visited from both sides. */
void ResidualOracle::add_jump(const Cell &cell, const unsigned int face)
{
  const Cell neighbor = cell->neighbor(face);
  const auto gauss = edge_gauss(std::max(cell->get_fe().degree, neighbor->get_fe().degree));
  const UpdateFlags flags = update_gradients | update_JxW_values | update_normal_vectors;
  FEFaceValues<2> here(cell->get_fe(), gauss, flags);
  here.reinit(cell, face);
  const auto &normals = here.get_normal_vectors();
  std::vector<Tensor<1, 2>> opposite;
  if (cell->neighbor_is_coarser(face))
  {
    const auto [other, subface] = cell->neighbor_of_coarser_neighbor(face);
    FESubfaceValues<2> there(neighbor->get_fe(), gauss, flags);
    there.reinit(neighbor, other, subface);
    opposite = tractions(there, normals);
  }
  else
  {
    FEFaceValues<2> there(neighbor->get_fe(), gauss, flags);
    there.reinit(neighbor, cell->neighbor_of_neighbor(face));
    opposite = tractions(there, normals);
  }
  const auto own = tractions(here, normals);
  double sum = 0;
  for (const unsigned int q : here.quadrature_point_indices())
    sum += here.JxW(q) * (own[q] - opposite[q]).norm_square() / 4.;
  sum *= 2 * first_stiffness() / (stiffness(cell) + stiffness(neighbor));
  result.jumps[cell->active_cell_index()] += weight(cell) * sum;
  if (cell->neighbor_is_coarser(face))
    result.jumps[neighbor->active_cell_index()] += weight(neighbor) * sum;
}

void ResidualOracle::add_neumann(const Cell &cell, const unsigned int face)
{
  const auto &condition = solution.scene.boundaries[cell->face(face)->boundary_id()];
  FEFaceValues<2> values(cell->get_fe(), edge_gauss(cell->get_fe().degree),
                         update_gradients | update_JxW_values | update_normal_vectors |
                             update_quadrature_points);
  values.reinit(cell, face);
  const auto own = tractions(values, values.get_normal_vectors());
  double sum = 0;
  for (const unsigned int q : values.quadrature_point_indices())
    for (unsigned int c = 0; c < 2; ++c)
    {
      const double G =
          condition.traction[c] ? condition.traction[c]->value(values.quadrature_point(q)) : 0.;
      if (!condition.displacement[c])
        sum += values.JxW(q) * std::pow(own[q][c] - G, 2);
    }
  result.neumann[cell->active_cell_index()] +=
      weight(cell) * sum * first_stiffness() / stiffness(cell);
}

void ResidualOracle::add_contact(const Cell &cell, const unsigned int face)
{
  const auto &faces = solution.contact_space.faces();
  const auto contact = std::find_if(faces.begin(), faces.end(),
                                    [&](const ContactFace<2> &candidate) {
                                      return candidate.cell == cell && candidate.face_no == face;
                                    });
  ASSERT_NE(contact, faces.end());
  FEFaceValues<2> values(cell->get_fe(), edge_gauss(cell->get_fe().degree),
                         update_gradients | update_JxW_values | update_normal_vectors |
                             update_quadrature_points);
  values.reinit(cell, face);
  const auto own = tractions(values, values.get_normal_vectors());
  double sum = 0;
  for (const unsigned int q : values.quadrature_point_indices())
  {
    const Point<2> x = values.quadrature_point(q);
    const Tensor<1, 2> n = values.normal_vector(q), t = Point<2>(-n[1], n[0]);
    const double s = x.distance(cell->face(face)->vertex(0)) /
                     cell->face(face)->vertex(0).distance(cell->face(face)->vertex(1));
    double residual = own[q] * t + solution.contact_space.value(*contact, solution.z, s);
    for (unsigned int c = 0; c < 2; ++c)
      if (contact->condition->traction[c])
        residual -= contact->condition->traction[c]->value(x) * t[c];
    sum += values.JxW(q) * residual * residual;
  }
  result.contact[cell->active_cell_index()] +=
      weight(cell) * sum * first_stiffness() / stiffness(cell);
}

void expect_same(const std::string &part, const std::vector<double> &computed,
                 const std::vector<double> &expected)
{
  ASSERT_EQ(computed.size(), expected.size());
  double largest = 0;
  for (const double value : expected)
    largest = std::max(largest, value);
  EXPECT_GT(largest, 0.) << part;
  for (unsigned int cell = 0; cell < computed.size(); ++cell)
    EXPECT_NEAR(computed[cell], expected[cell], 1e-10 * (expected[cell] + 1e-4 * largest))
        << part << " of cell " << cell;
}

/** Two materials, every kind of condition; friction of degree 2 along the edge. */
Scene<2> loaded_scene(const std::string &corners)
{
  Scene<2> scene = scene_of({given::quadrilateral("Geometry", corners, "3, 2"),
                             {"Material/Young's modulus", "10"},
                             {"Material/Plane", "stress"},
                             {"Body force/Expression", "x*y; 1 - 2*x"},
                             {"Boundary top/Displacement", "0; 0"},
                             {"Boundary left/Traction", "0.5*y; 0"},
                             {"Boundary left/Displacement", "free; 0"},
                             {"Boundary right/Traction", "1 + y; -x"},
                             given::rough("bottom", "bilateral", "1 + x^2")});
  scene.materials.push_back({3., 0.1, PlaneModel::strain});
  return scene;
}

void expect_right_indicator(const Scene<2> &scene, const unsigned int seed,
                            const unsigned int extra)
{
  const RandomMesh mesh(scene, seed, 2, 2, 6);
  ASSERT_TRUE(mesh.mesh.has_hanging_nodes());
  const Laboratory discrete(scene, mesh);
  std::mt19937 random(seed);
  const Solution<2> field = discrete.random_field(random);
  const ErrorEstimate computed = estimate_error(SolutionField(field));
  const ErrorEstimate expected = ResidualOracle(field, extra).result;
  expect_same("volume", computed.volume, expected.volume);
  expect_same("jumps", computed.jumps, expected.jumps);
  expect_same("neumann", computed.neumann, expected.neumann);
  expect_same("contact", computed.contact, expected.contact);

  double sum = 0;
  for (unsigned int cell = 0; cell < mesh.degrees.size(); ++cell)
  {
    const double square = expected.volume[cell] + expected.jumps[cell] + expected.neumann[cell] +
                          expected.contact[cell];
    EXPECT_NEAR(computed.indicator(cell), std::sqrt(square), 1e-9 * std::sqrt(square));
    sum += square;
  }
  EXPECT_NEAR(computed.total(), std::sqrt(sum), 1e-9 * std::sqrt(sum));
}

/** On parallelograms every integrand is a polynomial: quadrature of any higher order agrees. */
TEST(ResidualIndicator, IsThatOfFEValuesOnParallelograms)
{
  for (const unsigned int seed : {1u, 2u, 3u})
    expect_right_indicator(loaded_scene("0, 0; 3, 0.6; 3.5, 2.6; 0.5, 2"), seed, 3);
}

/** On general quadrilaterals integrands are rational, so the quadrature must be the same. */
TEST(ResidualIndicator, IsThatOfFEValuesOnDistortedCells)
{
  for (const unsigned int seed : {1u, 2u, 3u})
    expect_right_indicator(loaded_scene("0, 0; 3, 0.6; 2.6, 2.6; -0.3, 2"), seed, 1);
}

/** a(v,v) >= 2 mu |eps|^2 with 2 mu = E/(1+nu), whatever the plane model. */
TEST(ResidualIndicator, IsScaledByTheCoercivityOfTheMaterial)
{
  for (const std::string plane : {"stress", "strain"})
    each_step<2>(shipped_scene("han-6-12", {given::elastic("12", "0.25"),
                                            {"Material/Plane", plane},
                                            {"Adaptivity/Maximum steps", "2"}}),
                 [](const StepReport<2> &step)
                 {
                   const double eta = step.estimate.total();
                   EXPECT_NEAR(step.scaled_estimate, eta / std::sqrt(9.6), 1e-12 * eta);
                   EXPECT_NEAR(step.relative_estimate * step.energies.norm, step.scaled_estimate,
                               1e-12 * eta);
                 });
}
} // namespace
