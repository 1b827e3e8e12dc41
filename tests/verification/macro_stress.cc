// SPDX-License-Identifier: LGPL-2.1-or-later
// Equilibrated stresses on quadrilaterals that are no parallelograms.
#include "discretisation.h"

#include <hpvi/bound/error_bound.h>

#include <algorithm>
#include <numeric>

namespace
{
using namespace verification;
using Vertices = MacroStressElement::Vertices;

const std::vector<Vertices> shapes = {
    {{Point<2>(0, 0), Point<2>(1, 0), Point<2>(0, 1), Point<2>(1, 1)}},
    {{Point<2>(1, 2), Point<2>(4, 2.2), Point<2>(1.3, 3.7), Point<2>(3.2, 4)}},
    {{Point<2>(0, 0), Point<2>(0.1, -0.01), Point<2>(0.02, 0.3), Point<2>(0.09, 0.2)}}};
const Material material{2., 0.3, PlaneModel::strain};

constexpr unsigned int ends[4][2] = {{0, 2}, {1, 3}, {0, 1}, {2, 3}};

/** A cell with its element: data and values in the coordinates of the cell. */
struct Cell
{
  Cell(const Vertices &vertices, const unsigned int k)
      : vertices(vertices), h(MacroStressElement::size(vertices)), k(k),
        element(triangles.triangle(k), vertices, material)
  {
  }

  Point<2> local(const Point<2> &x) const
  {
    return Point<2>((x - vertices[0]) / h);
  }

  Point<2> on_face(const unsigned int face, const double s) const
  {
    return vertices[ends[face][0]] + s * (vertices[ends[face][1]] - vertices[ends[face][0]]);
  }

  /** Normal, towards growing xi or eta, and tangent. */
  std::array<Tensor<1, 2>, 2> frame(const unsigned int face) const
  {
    Tensor<1, 2> t = vertices[ends[face][1]] - vertices[ends[face][0]];
    t /= t.norm();
    return {{Tensor<1, 2>({t[1], -t[0]}) * (face < 2 ? 1. : -1.), t}};
  }

  /** Tractions of a stress on the faces. */
  std::vector<double> tractions(const std::function<Tensor<2, 2>(const Point<2> &)> &stress) const
  {
    std::vector<double> result(element.n_edges);
    const QGauss<1> gauss(k + 4);
    for (unsigned int face = 0; face < 4; ++face)
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        const double s = gauss.point(q)[0];
        const Tensor<1, 2> t = stress(on_face(face, s)) * frame(face)[0];
        const std::vector<double> L = legendre::values(k + 1, 2 * s - 1);
        for (unsigned int c = 0; c < 2; ++c)
          for (unsigned int i = 0; i <= k; ++i)
            result[(2 * face + c) * (k + 1) + i] +=
                2 * gauss.weight(q) * L[i] * (t * frame(face)[c]);
      }
    return result;
  }

  /** Data of a stress q and a divergence. */
  MacroStressElement::Data
  data(const std::function<Tensor<2, 2>(const Point<2> &)> &stress,
       const std::function<Tensor<1, 2>(const Point<2> &)> &divergence) const
  {
    MacroStressElement::Data result(1);
    const TriangleTable table(k, k + 4);
    const unsigned int n = element.triangle.n, n_lower = element.triangle.n_divergence / 2;
    for (unsigned int f = 0; f < 4; ++f)
    {
      result.stress[f].resize(3 * n);
      result.divergence[f].resize(2 * n_lower);
      const auto &piece = element.piece(f);
      const Tensor<2, 2> inverse = invert(piece.B);
      for (unsigned int q = 0; q < table.points.size(); ++q)
      {
        const Point<2> x =
            vertices[0] +
            h * (element.crossing +
                 piece.scale * (piece.B * Tensor<1, 2>({table.points[q][0], table.points[q][1]})));
        const Tensor<2, 2> S = inverse * stress(x) * transpose(inverse);
        const Tensor<1, 2> d = piece.scale * h * (inverse * divergence(x));
        for (unsigned int l = 0; l < n; ++l)
        {
          const double weight = table.weights[q] * table.values[q * n + l];
          result.stress[f][l] += weight * S[0][0];
          result.stress[f][n + l] += weight * S[1][1];
          result.stress[f][2 * n + l] += weight * S[0][1];
          for (unsigned int c = 0; c < 2 && l < n_lower; ++c)
            result.divergence[f][c * n_lower + l] += weight * d[c];
        }
      }
    }
    return result;
  }

  const Vertices vertices;
  const double h;
  const unsigned int k;
  static const TriangleStresses triangles;
  const MacroStressElement element;
};
const TriangleStresses Cell::triangles;

Tensor<2, 2> zero_stress(const Point<2> &)
{
  return {};
}

Tensor<1, 2> zero_force(const Point<2> &)
{
  return {};
}

/** Of degree 2, with divergence (y, 2 - 2 x). */
Tensor<2, 2> quadratic(const Point<2> &x)
{
  Tensor<2, 2> s;
  s[0][0] = 1 + x[0] * x[1] - x[1] * x[1];
  s[1][1] = 2 * x[1] - 0.5 - 3 * x[0] * x[1];
  s[0][1] = s[1][0] = 0.3 + 0.5 * x[0] * x[0] + 2 * x[0];
  return s;
}

Tensor<1, 2> divergence_of_quadratic(const Point<2> &x)
{
  return Tensor<1, 2>({x[1], x[0] + 2. + 2. - 3. * x[0]});
}

/** Random tractions, in balance with no divergence. */
std::vector<double> random_tractions(const Cell &cell, std::mt19937 &random)
{
  std::uniform_real_distribution<double> uniform(-1., 1.);
  const unsigned int n = cell.element.n_edges;
  std::vector<double> t(n), gram(9);
  for (double &value : t)
    value = uniform(random);
  const std::vector<double> &N = cell.element.conditions();
  multiply('T', 'N', 3, 3, n, 1., {N.data(), n}, {N.data(), n}, 0., gram.data(), 3);
  const PivotedCholesky factor(3, gram, 1e-12);
  for (unsigned int pass = 0; pass < 2; ++pass)
  {
    std::vector<double> defect(3);
    multiply('T', 'N', 3, 1, n, 1., {N.data(), n}, {t.data(), n}, 0., defect.data(), 3);
    const std::vector<double> mu = factor.solve(defect);
    multiply('N', 'N', n, 1, 3, -1., {N.data(), n}, {mu.data(), 3}, 1., t.data(), n);
  }
  return t;
}

void for_each_cell(const std::function<void(const Cell &)> &check)
{
  for (const Vertices &shape : shapes)
    for (unsigned int k = 3; k <= 8; ++k)
    {
      SCOPED_TRACE("degree " + std::to_string(k) + ", corner " + in_digits(shape[3][0]));
      check(Cell(shape, k));
    }
}

TEST(MacroStressElement, FindsAStressOfItsSpace)
{
  for_each_cell(
      [](const Cell &cell)
      {
        const auto data = cell.data(quadratic, divergence_of_quadratic);
        const std::vector<double> t = cell.tractions(quadratic);
        const auto stress = cell.element.stress(data, t);
        EXPECT_LE(stress.energy, 1e-24);
        for (const Point<2> xi : {Point<2>(0.1, 0.4), Point<2>(0.7, 0.6), Point<2>(0.5, 0.05)})
        {
          const Point<2> x = CellMap<2>(cell.vertices).point(xi);
          EXPECT_LE((cell.element.value(stress, cell.local(x)) - quadratic(x)).norm(), 1e-11);
        }
        std::vector<double> gradients, defects;
        cell.element.reduce(data, gradients, defects);
        multiply('T', 'N', 3, 1, cell.element.n_edges, 1.,
                 {cell.element.conditions().data(), cell.element.n_edges},
                 {t.data(), cell.element.n_edges}, 1., defects.data(), 3);
        for (const double defect : defects)
          EXPECT_NEAR(defect, 0., 1e-12);
      });
}

/** Any tractions in balance, whatever they are at corners: three conditions and no more. */
TEST(MacroStressElement, MeetsAllTractionsInBalance)
{
  std::mt19937 random(1);
  for_each_cell(
      [&](const Cell &cell)
      {
        const std::vector<double> t = random_tractions(cell, random);
        const auto stress = cell.element.stress(cell.data(zero_stress, zero_force), t);
        for (unsigned int face = 0; face < 4; ++face)
          for (const double s : {0.001, 0.2, 0.77, 0.999})
          {
            const Point<2> x = cell.local(cell.on_face(face, s));
            // towards the crossing, to stay in the cell
            const Point<2> inside = x + 1e-13 * (cell.element.crossing - x);
            const Tensor<1, 2> found = cell.element.value(stress, inside) * cell.frame(face)[0];
            for (unsigned int c = 0; c < 2; ++c)
            {
              const auto first = t.begin() + (2 * face + c) * (cell.k + 1);
              const double expected =
                  legendre::evaluate(std::vector<double>(first, first + cell.k + 1), 2 * s - 1);
              EXPECT_NEAR(found * cell.frame(face)[c], expected, 1e-9);
            }
          }
      });
}

TEST(MacroStressElement, HasContinuousTractionsAndNoDivergenceInside)
{
  std::mt19937 random(2);
  for_each_cell(
      [&](const Cell &cell)
      {
        const auto stress =
            cell.element.stress(cell.data(zero_stress, zero_force), random_tractions(cell, random));
        const auto value = [&](const Tensor<1, 2> &x)
        { return cell.element.value(stress, Point<2>(x)); };
        const Tensor<1, 2> crossing = cell.element.crossing;
        for (unsigned int v = 0; v < 4; ++v)
          for (const double s : {0.1, 0.6, 0.95})
          {
            const Tensor<1, 2> along = cell.local(cell.vertices[v]) - crossing;
            const Tensor<1, 2> normal = Tensor<1, 2>({along[1], -along[0]}) / along.norm();
            const Tensor<1, 2> x = crossing + s * along, step = 1e-12 * normal;
            EXPECT_LE(((value(x + step) - value(x - step)) * normal).norm(), 1e-8);
          }
        for (const Point<2> xi : {Point<2>(0.15, 0.4), Point<2>(0.8, 0.6), Point<2>(0.5, 0.1)})
        {
          const Tensor<1, 2> x = cell.local(CellMap<2>(cell.vertices).point(xi));
          Tensor<1, 2> divergence;
          for (unsigned int d = 0; d < 2; ++d)
          {
            Tensor<1, 2> step;
            step[d] = 1e-4;
            const Tensor<2, 2> slope = 8. * (value(x + step) - value(x - step)) -
                                       (value(x + 2. * step) - value(x - 2. * step));
            for (unsigned int c = 0; c < 2; ++c)
              divergence[c] += slope[c][d] / 12e-4;
          }
          EXPECT_LE(divergence.norm(), 1e-6 * std::max(1., value(x).norm()));
        }
      });
}

/** G is the energy, and what the stress has least: orthogonal to stresses of other tractions within. */
TEST(MacroStressElement, HasLeastEnergy)
{
  std::mt19937 random(3);
  for_each_cell(
      [&](const Cell &cell)
      {
        const unsigned int n = cell.element.n_edges;
        const std::vector<double> t = random_tractions(cell, random);
        const auto stress = cell.element.stress(cell.data(zero_stress, zero_force), t);
        std::vector<double> Gt(n);
        multiply('N', 'N', n, 1, n, 1., {cell.element.edge_energy().data(), n}, {t.data(), n}, 0.,
                 Gt.data(), n);
        const double energy = std::inner_product(t.begin(), t.end(), Gt.begin(), 0.);
        EXPECT_NEAR(stress.energy, energy, 1e-10 * energy);
        // A stress of the space as q: the best for its tractions is itself, for others the distance is convex.
        MacroStressElement::Data shifted = cell.data(zero_stress, zero_force);
        shifted.stress = stress.coefficients;
        EXPECT_LE(cell.element.stress(shifted, t).energy, 1e-20 * energy);
        const std::vector<double> none(n);
        // |0 - q|^2 over stresses without data is least at the distance from them: Pythagoras
        EXPECT_NEAR(cell.element.stress(shifted, none).energy, energy, 1e-10 * energy);
      });
}

Scene<2> distorted(const Overrides &overrides)
{
  Overrides entries = {{"Geometry/Shape", "quadrilateral"},
                       {"Geometry/Corners", "-1, 0; 1, 0; 0.8, 1.1; -1.1, 0.8"}};
  entries.insert(entries.end(), overrides.begin(), overrides.end());
  return shipped_scene("stick-slip", entries);
}

TEST(MacroStresses, BoundTheTrueError)
{
  for (const std::string method : {"hup2", "hap4", "hpa3"})
  {
    SCOPED_TRACE(method);
    const Scene<2> scene =
        distorted({{"Adaptivity/Method", method}, {"Adaptivity/Maximum unknowns", "1000"}});
    ASSERT_FALSE(scene.geometry.has_affine_cells());
    const auto tables = std::make_shared<const ShapeTables<2>>();
    CondensedElements<2> elements(scene, *tables);
    ErrorBounds bounds;
    AdaptiveSolver<2>(scene).run(
        [&](const StepReport<2> &step)
        {
          const ErrorBound bound = bounds.compute(
              step.solution(), Discretisation<2>(scene, step.solution().spaces, elements));
          EXPECT_GE(bound.total, step.errors.energy);
          EXPECT_LE(bound.total, 2.2 * step.errors.energy);
          EXPECT_LE(bound.imbalance, 1e-13);
        });
  }
}

/** With hanging nodes and mixed degrees: tractions of neighbours agree, those prescribed are met. */
TEST(MacroStresses, AreAdmissible)
{
  const Scene<2> scene = scene_of({{"Geometry/Shape", "quadrilateral"},
                                   {"Geometry/Corners", "0, 0; 4, 0; 3.2, 4.5; 0.6, 3.4"},
                                   {"Geometry/Subdivisions", "2, 2"},
                                   {"Material/Young's modulus", "15"},
                                   {"Material/Plane", "stress"},
                                   {"Body force/Expression", "x; 1 - 2*y"},
                                   {"Boundary left/Traction", "1.5*(5 - y); -0.75"},
                                   {"Boundary top/Displacement", "0; free"},
                                   {"Boundary right/Displacement", "0; 0"}});
  const RandomMesh mesh(scene, 5, 2, 2, 6);
  const Laboratory lab(scene, mesh);
  const Solution<2> solution = lab.solve();
  EquilibrationCache cache;
  const EquilibratedStress stress(
      solution, [](unsigned int, unsigned int) { return std::vector<double>(); }, {}, cache);
  ASSERT_TRUE(stress.has_macro_cells());
  double largest = 0, jump = 0, neumann = 0, divergence = 0;
  const auto traction = [&](const StressEdge &edge, const StressEdge::Side &side, const double s)
  {
    const double on_side = side.part == whole_edge ? s : 2 * s - side.part;
    const Tensor<2, 2> value =
        stress.macro_value(side.cell, point_on_face<2>(side.face, Point<1>(on_side)));
    largest = std::max(largest, value.norm());
    return value * edge.normal;
  };
  for (const StressEdge &edge : stress.patches().edges())
    for (const double s : {0.03, 0.27, 0.61, 0.88})
    {
      const Tensor<1, 2> t = traction(edge, edge.sides[0], s);
      for (unsigned int k = 1; k < edge.sides.size(); ++k)
        if (edge.sides[k].part == whole_edge || edge.sides[k].part == (s > 0.5))
          jump = std::max(jump, (t - traction(edge, edge.sides[k], s)).norm());
      const unsigned int index = &edge - stress.patches().edges().data();
      for (unsigned int c = 0; edge.at_boundary() && c < 2; ++c)
        if (!edge.components[c].is_unknown)
          neumann = std::max(neumann, std::abs((t - stress.prescribed().value(index, s)) *
                                               edge.components[c].direction));
    }
  for (const auto &cell : stress.patches().cells())
  {
    const CellMap<2> map = map_of<2>(cell.iterator);
    const unsigned int index = cell.iterator->active_cell_index();
    const Point<2> xi(0.3, 0.45);
    const Tensor<2, 2> inverse = invert(map.jacobian(xi));
    Tensor<1, 2> sum = Tensor<1, 2>({map.point(xi)[0], 1 - 2 * map.point(xi)[1]});
    const double step = 1e-3;
    for (unsigned int r = 0; r < 2; ++r)
    {
      const auto at = [&](const double t)
      {
        Point<2> x = xi;
        x[r] += t * step;
        return stress.macro_value(index, x);
      };
      const Tensor<2, 2> slope = (8. * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * step);
      for (unsigned int c = 0; c < 2; ++c)
        for (unsigned int d = 0; d < 2; ++d)
          sum[c] += slope[c][d] * inverse[r][d];
    }
    divergence = std::max(divergence, sum.norm() * map.longest_edge());
    EXPECT_LE(stress.missed_force(index), 1e-12);
  }
  EXPECT_LE(stress.defect, 1e-11 * largest);
  EXPECT_LE(jump, 1e-10 * largest);
  EXPECT_LE(neumann, 1e-10 * largest);
  EXPECT_LE(divergence, 1e-7 * largest); // of the differences
}
} // namespace
