// SPDX-License-Identifier: LGPL-2.1-or-later
// Sum factorisation and condensation of cells that are no parallelograms, beside plain sums over shape functions.
#include "dense_elimination.h"
#include "discretisation.h"

#include <hpvi/plane/element_matrices.h>

namespace
{
using namespace verification;

using Vertices = CellMap<2>::Vertices;

/** Random cells, none of whose corners is flat, and none of them a parallelogram. */
class Dice
{
public:
  double operator()(const double from, const double to)
  {
    return std::uniform_real_distribution<>(from, to)(random);
  }

  CellMap<2> cell(const bool is_curved, const unsigned int degree)
  {
    Vertices v;
    const double angle = (*this)(0, 6), size = std::pow(10, (*this)(-3, 3));
    for (unsigned int k = 0; k < 4; ++k)
    {
      const Point<2> own(k % 2 + (*this)(-0.25, 0.25), 0.7 * (k / 2) + (*this)(-0.2, 0.2));
      v[k] = Point<2>(size * (3 + own[0] * std::cos(angle) - own[1] * std::sin(angle)),
                      size * (2 + own[0] * std::sin(angle) + own[1] * std::cos(angle)));
    }
    if (!is_curved)
      return CellMap<2>(v);
    // An arc of 0.6 radians, which takes a little of the cell away.
    const Tensor<1, 2> chord = v[3] - v[2], across = Point<2>(-chord[1], chord[0]);
    const double half = 0.3, radius = chord.norm() / 2 / std::sin(half);
    const Point<2> centre = v[2] + chord / 2. + across / (2 * std::tan(half));
    const auto circle = std::make_shared<const Circle>(centre, radius);
    const double from = std::atan2(v[2][1] - centre[1], v[2][0] - centre[0]);
    const CurvePiece arc{circle, from, from + 2 * half};
    auto bows = std::make_shared<EdgeBlends>();
    (*bows)[3] = EdgeBlend(
        arc, [&](const double s) { return arc.point(s); }, v[2], v[3], degree);
    return CellMap<2>(v, bows);
  }

private:
  std::mt19937 random{7};
};

/** Materials of all kinds in the plane. */
Scene<2> scene_with(const std::string &kind)
{
  Overrides entries = {{"Boundary top/Displacement", "0; 0"},
                       {"Material/Plane", kind.substr(0, kind.find(' '))}};
  if (kind.find("orthotropic") != std::string::npos)
    for (const auto &[name, value] : Overrides{{"Elasticity", "orthotropic"},
                                               {"Young's moduli", "11, 0.9, 0.5"},
                                               {"Poisson's ratios", "0.4, 0.45, 0.3"},
                                               {"Shear moduli", "0.7"},
                                               {"Angle", "30"}})
      entries.emplace_back("Material/" + name, value);
  else
    for (const auto &[name, value] :
         Overrides{{"Young's modulus", "3"}, {"Poisson's ratio", "0.35"}})
      entries.emplace_back("Material/" + name, value);
  return scene_of(entries);
}

/** The gradient on the cell of every unknown at one point. */
std::vector<Tensor<2, 2>> gradients_at(const CellMap<2> &map, const ShapeTable<2> &table,
                                       const LocalNumbering &numbering, const unsigned int q)
{
  const Tensor<2, 2> inverse = invert(map.jacobian(table.points[q]));
  std::vector<Tensor<2, 2>> result(numbering.shape.size());
  for (unsigned int i = 0; i < result.size(); ++i)
    for (unsigned int d = 0; d < 2; ++d)
      for (unsigned int r = 0; r < 2; ++r)
        result[i][numbering.component[i]][d] +=
            inverse[r][d] * table.derivatives(q * table.rows_per_point + r, numbering.shape[i]);
  return result;
}

/** `int sigma(phi_i) : grad phi_j`, point by point. */
FullMatrix<double> plain_stiffness(const Scene<2> &scene, const CellMap<2> &map,
                                   const unsigned int degree, const unsigned int n_points,
                                   const ShapeTables<2> &tables)
{
  const ShapeTable<2> &table = tables.gradients(degree, n_points);
  const LocalNumbering &numbering = tables.numbering(degree);
  const HookesLaw<2> law(scene.materials[0]);
  const bool is_axisymmetric = scene.is_axisymmetric();
  const unsigned int n = numbering.shape.size();
  FullMatrix<double> K(n, n);
  for (unsigned int q = 0; q < table.points.size(); ++q)
  {
    const Point<2> x = map.point(table.points[q]);
    const double weight = table.weights[q] * std::abs(determinant(map.jacobian(table.points[q]))) *
                          scene.circumference(x);
    const auto gradients = gradients_at(map, table, numbering, q);
    std::vector<double> hoop(n);
    for (unsigned int i = 0; is_axisymmetric && i < n; ++i)
      hoop[i] = numbering.component[i] == 0 ? table.values(q, numbering.shape[i]) / x[0] : 0.;
    for (unsigned int i = 0; i < n; ++i)
    {
      const SymmetricTensor<2, 2> sigma = law.stress(gradients[i], hoop[i]);
      const double around = is_axisymmetric ? law.hoop_stress(gradients[i], hoop[i]) : 0.;
      for (unsigned int j = 0; j < n; ++j)
        K(i, j) += weight * (scalar_product(Tensor<2, 2>(sigma), gradients[j]) + around * hoop[j]);
    }
  }
  return K;
}

class DistortedCells : public ::testing::TestWithParam<std::string>
{
protected:
  const Scene<2> scene = scene_with(GetParam());
  const ShapeTables<2> tables;
  const ElementMatrices<2> matrices{scene, tables};
  Dice dice;

  template <class Test>
  void for_each_cell(const std::vector<unsigned int> &degrees, const Test &test)
  {
    for (const unsigned int degree : degrees)
      for (const bool is_curved : {false, true})
      {
        SCOPED_TRACE("degree " + std::to_string(degree) + (is_curved ? ", curved" : ""));
        const CellMap<2> map = dice.cell(is_curved, degree);
        ASSERT_TRUE(matrices.is_factorised(map));
        ASSERT_EQ(map.is_curved(), is_curved);
        test(map, degree);
      }
  }
};

TEST_P(DistortedCells, HaveTheStiffnessOfPlainSums)
{
  for_each_cell({1, 2, 3, 4, 5, 6, 7, 8, 9, 10},
                [&](const CellMap<2> &map, const unsigned int degree)
                {
                  const FullMatrix<double> K = matrices.stiffness(map, degree, 0);
                  const FullMatrix<double> same = plain_stiffness(
                      scene, map, degree, stiffness_points(scene, map, degree), tables);
                  EXPECT_LE(largest_difference(K, same), 1e-12 * same.linfty_norm());
                  if (map.is_curved() || scene.is_axisymmetric())
                    return;
                  const FullMatrix<double> exact = plain_stiffness(
                      scene, map, degree, stiffness_points(scene, map, degree) + 12, tables);
                  EXPECT_LE(largest_difference(K, exact), 1e-13 * exact.linfty_norm());
                });
}

/** Displacements and, of bodies in the plane, rotations; deal.II's nodes are those of FE_Q. */
TEST_P(DistortedCells, DoNotStrainWhenTheyMove)
{
  for_each_cell({1, 2, 3, 5, 8},
                [&](const CellMap<2> &map, const unsigned int degree)
                {
                  const FullMatrix<double> K = matrices.stiffness(map, degree, 0);
                  const FiniteElement<2> &fe = tables.elements(degree)[degree - 1];
                  const Point<2> centre = map.point(Point<2>(0.5, 0.5));
                  for (unsigned int motion = scene.is_axisymmetric() ? 1 : 0;
                       motion < (scene.is_axisymmetric() ? 2 : 3); ++motion)
                  {
                    Vector<double> u(K.m()), forces(K.m());
                    for (unsigned int i = 0; i < u.size(); ++i)
                    {
                      const unsigned int c = fe.system_to_component_index(i).first;
                      const Tensor<1, 2> arm =
                          (map.point(fe.unit_support_point(i)) - centre) / map.longest_edge();
                      u[i] = motion < 2 ? c == motion : c == 0 ? -arm[1] : arm[0];
                    }
                    K.vmult(forces, u);
                    EXPECT_LE(forces.linfty_norm(), 1e-13 * K.linfty_norm()) << motion;
                    EXPECT_LE(std::abs(forces * u), 1e-13 * K.linfty_norm()) << motion;
                  }
                });
}

/** As by Gauss and Jordan. */
TEST_P(DistortedCells, AreCondensedAsByDenseElimination)
{
  CondensedElements<2> elements(scene, tables);
  for_each_cell({1, 2, 3, 4, 6, 9},
                [&](const CellMap<2> &map, const unsigned int degree)
                {
                  const auto element = elements.get(map, degree, 0);
                  expect_condensed(*element, matrices.stiffness(map, degree, 0),
                                   matrices.n_boundary(degree), 1e-12);
                  EXPECT_EQ(element->extension.m(), 0U);
                });
}

/** Parallelograms have a matrix for it, other cells strains: both between them on one mesh, and forces the other way. */
TEST(Condensation, FindsTheWayIntoCellsAndOut)
{
  const Scene<2> scene =
      scene_of({given::quadrilateral("Body one", "0, 0; 2, 0; 1.7, 1.2; 0.2, 1", "2, 2"),
                given::block("two", "0, -1", "2, 0", "2, 1"),
                given::joint("joint", "one.bottom, two.top", "tied"),
                {"Boundary two.bottom/Displacement", "0; 0"},
                {"Body force/Expression", "0; -1"}});
  const RandomMesh mesh(scene, 5, 1, 1, 5);
  const Laboratory laboratory(scene, mesh);
  const Condensation<2> &condensation = laboratory.discretisation.condensation;
  const DisplacementSpace<2> &space = laboratory.displacement_space;
  const ElementMatrices<2> matrices(scene, laboratory.tables);
  std::mt19937 random(3);
  const Vector<double> start = laboratory.random_field(random).u;
  Vector<double> u = start, f = start, answer(u.size()), expected_u = u, expected_f = f,
                 expected_answer = answer;
  condensation.extend(u);
  condensation.eliminate(f);
  condensation.add_interior(start, answer);
  unsigned int n_own = 0, n_shared = 0;
  for (const auto &cell : space.dof_handler().active_cell_iterators())
  {
    const unsigned int index = cell->active_cell_index(), p = space.degrees()[index],
                       n_b = matrices.n_boundary(p);
    const auto dofs = space.cell_dofs(index);
    const DenseElimination dense(matrices.stiffness(map_of<2>(cell), p, cell->material_id()), n_b);
    n_own += p > 1 && condensation.element(index)->extension.empty();
    n_shared += condensation.element(index)->extension.m() > 0;
    for (unsigned int i = 0; i + n_b < dofs.size(); ++i)
    {
      expected_u[dofs[n_b + i]] = 0.;
      for (unsigned int j = 0; j < n_b; ++j)
      {
        expected_u[dofs[n_b + i]] += dense.extension(i, j) * start[dofs[j]];
        expected_f[dofs[j]] += dense.extension(i, j) * start[dofs[n_b + i]];
      }
      for (unsigned int j = 0; j + n_b < dofs.size(); ++j)
        expected_answer[dofs[n_b + i]] += dense.inverse(i, j) * start[dofs[n_b + j]];
    }
  }
  EXPECT_GT(n_own, 2U);
  EXPECT_GT(n_shared, 2U);
  for (unsigned int dof = 0; dof < u.size(); ++dof)
  {
    EXPECT_NEAR(u[dof], expected_u[dof], 1e-12) << dof;
    EXPECT_NEAR(f[dof], expected_f[dof], 1e-12) << dof;
    EXPECT_NEAR(answer[dof], expected_answer[dof], 1e-12) << dof;
  }
}

INSTANTIATE_TEST_SUITE_P(, DistortedCells,
                         ::testing::Values("stress", "strain", "stress orthotropic",
                                           "strain orthotropic", "axisymmetric"),
                         [](const auto &info)
                         {
                           std::string name = info.param;
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });
} // namespace
