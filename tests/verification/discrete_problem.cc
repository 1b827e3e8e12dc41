// SPDX-License-Identifier: LGPL-2.1-or-later
// The discrete problem as a whole: equations, complementarity, patch tests, rotation, conformity.
#include "friction_quadrature.h"

#include <hpvi/results/solution_field.h>

#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/hp/fe_values.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/numerics/vector_tools_boundary.h>

#include <algorithm>

namespace
{
using namespace verification;

/** Gauss quadrature with @p extra points more than the degree, by active FE index. */
template <int dim>
hp::QCollection<dim> quadratures(const hp::FECollection<2> &elements, const unsigned int extra)
{
  hp::QCollection<dim> collection;
  for (unsigned int i = 0; i < elements.size(); ++i)
    collection.push_back(QGauss<dim>(elements[i].degree + extra));
  return collection;
}

// ---------------------------------------------------------------- the oracle

/**
 * A, f, B of (5.1)-(5.3) by deal.II's FEValues on the whole hp space: no static condensation, no
 * congruence classes, no tables.
 */
class Oracle
{
public:
  /** @p extra: cells get that many Gauss points per direction more than the degree. */
  explicit Oracle(const Solution<2> &solution, unsigned int extra = 2);

  /** f - A u - B' lambda for the unknowns that no constraint binds. */
  Vector<double> residual(const Solution<2> &solution) const;

  /** f for the unknowns that no constraint binds. */
  Vector<double> load() const
  {
    return condense(F);
  }

  double energy_product(const Vector<double> &u) const
  {
    return K.matrix_norm_square(u);
  }

  double work(const Vector<double> &u) const
  {
    return F * u;
  }

  /** (B u)_i, with prescribed displacements */
  Vector<double> tangential_moments(const Vector<double> &u) const
  {
    Vector<double> result(B.m());
    if (B.m() > 0)
      B.vmult(result, u);
    return result;
  }

  /** B A^-1 B' z */
  Vector<double> schur_product(const Vector<double> &z) const;

private:
  void assemble_cells(const Solution<2> &solution, unsigned int extra);
  void assemble_tractions(const Solution<2> &solution, unsigned int extra);
  void assemble_contact(const Solution<2> &solution);
  Vector<double> condense(const Vector<double> &v) const;

  const AffineConstraints<double> &constraints;
  SparsityPattern pattern;
  SparseMatrix<double> K, A; // on all unknowns; with constraints eliminated
  Vector<double> F;
  FullMatrix<double> B;
};

Oracle::Oracle(const Solution<2> &solution, const unsigned int extra)
    : constraints(solution.displacement_space.constraints())
{
  const DoFHandler<2> &dofs = solution.displacement_space.dof_handler();
  DynamicSparsityPattern dynamic_pattern(dofs.n_dofs());
  DoFTools::make_sparsity_pattern(dofs, dynamic_pattern);
  DoFTools::make_sparsity_pattern(dofs, dynamic_pattern, constraints);
  pattern.copy_from(dynamic_pattern);
  K.reinit(pattern);
  A.reinit(pattern);
  F.reinit(dofs.n_dofs());
  B.reinit(solution.contact_space.n_multipliers(), dofs.n_dofs());
  assemble_cells(solution, extra);
  assemble_tractions(solution, extra);
  assemble_contact(solution);
}

void Oracle::assemble_cells(const Solution<2> &solution, const unsigned int extra)
{
  const Scene<2> &scene = solution.scene;
  const DoFHandler<2> &dofs = solution.displacement_space.dof_handler();
  const FEValuesExtractors::Vector displacement(0);
  hp::FEValues<2> hp_values(
      dofs.get_fe_collection(), quadratures<2>(dofs.get_fe_collection(), extra),
      update_values | update_gradients | update_JxW_values | update_quadrature_points);
  std::vector<types::global_dof_index> indices;
  for (const auto &cell : dofs.active_cell_iterators())
  {
    hp_values.reinit(cell);
    const FEValues<2> &values = hp_values.get_present_fe_values();
    const unsigned int n = values.dofs_per_cell;
    const Material &material = scene.materials[cell->material_id()];
    const double lambda = material.lambda(2), mu = material.mu();
    FullMatrix<double> local(n, n);
    indices.resize(n);
    cell->get_dof_indices(indices);
    for (const unsigned int q : values.quadrature_point_indices())
    {
      std::vector<SymmetricTensor<2, 2>> strain(n);
      for (unsigned int i = 0; i < n; ++i)
        strain[i] = values[displacement].symmetric_gradient(i, q);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          local(i, j) +=
              (lambda * trace(strain[i]) * trace(strain[j]) + 2 * mu * (strain[i] * strain[j])) *
              values.JxW(q);
      for (unsigned int c = 0; c < 2; ++c)
        if (scene.body_force[c])
          for (unsigned int i = 0; i < n; ++i)
            F[indices[i]] += scene.body_force[c]->value(values.quadrature_point(q)) *
                             values.shape_value_component(i, q, c) * values.JxW(q);
    }
    K.add(indices, local);
    constraints.distribute_local_to_global(local, indices, A);
  }
}

void Oracle::assemble_tractions(const Solution<2> &solution, const unsigned int extra)
{
  const DoFHandler<2> &dofs = solution.displacement_space.dof_handler();
  hp::FEFaceValues<2> hp_values(dofs.get_fe_collection(),
                                quadratures<1>(dofs.get_fe_collection(), extra),
                                update_values | update_JxW_values | update_quadrature_points);
  std::vector<types::global_dof_index> indices;
  for (const auto &cell : dofs.active_cell_iterators())
    for (const unsigned int face : cell->face_indices())
    {
      if (!cell->at_boundary(face))
        continue;
      const auto &traction = solution.scene.boundaries[cell->face(face)->boundary_id()].traction;
      hp_values.reinit(cell, face);
      const FEFaceValues<2> &values = hp_values.get_present_fe_values();
      indices.resize(values.dofs_per_cell);
      cell->get_dof_indices(indices);
      for (const unsigned int q : values.quadrature_point_indices())
        for (unsigned int c = 0; c < 2; ++c)
          if (traction[c])
            for (unsigned int i = 0; i < indices.size(); ++i)
              F[indices[i]] += traction[c]->value(values.quadrature_point(q)) *
                               values.shape_value_component(i, q, c) * values.JxW(q);
    }
}

void Oracle::assemble_contact(const Solution<2> &solution)
{
  const DoFHandler<2> &dofs = solution.displacement_space.dof_handler();
  hp::FEFaceValues<2> hp_values(
      dofs.get_fe_collection(), quadratures<1>(dofs.get_fe_collection(), 2),
      update_values | update_JxW_values | update_quadrature_points | update_normal_vectors);
  std::vector<types::global_dof_index> indices;
  for (const ContactFace<2> &contact : solution.contact_space.faces())
  {
    if (contact.n_multipliers == 0)
      continue;
    const auto edge = contact.cell->face(contact.face_no);
    const auto basis = Polynomials::generate_complete_Lagrange_basis(
        QGauss<1>(contact.n_multipliers).get_points());
    hp_values.reinit(contact.cell, contact.face_no);
    const FEFaceValues<2> &values = hp_values.get_present_fe_values();
    indices.resize(values.dofs_per_cell);
    contact.cell->get_dof_indices(indices);
    for (const unsigned int q : values.quadrature_point_indices())
    {
      const Point<2> x = values.quadrature_point(q);
      const Tensor<1, 2> n = values.normal_vector(q);
      const double s = x.distance(edge->vertex(0)) / edge->vertex(1).distance(edge->vertex(0));
      for (unsigned int i = 0; i < indices.size(); ++i)
      {
        const double v_t = -n[1] * values.shape_value_component(i, q, 0) +
                           n[0] * values.shape_value_component(i, q, 1);
        for (unsigned int m = 0; m < basis.size(); ++m)
          B(contact.first_multiplier + m, indices[i]) += values.JxW(q) * basis[m].value(s) * v_t;
      }
    }
  }
}

Vector<double> Oracle::condense(const Vector<double> &v) const
{
  Vector<double> result = v;
  for (types::global_dof_index i = 0; i < v.size(); ++i)
    if (constraints.is_constrained(i))
    {
      for (const auto &entry : *constraints.get_constraint_entries(i))
        result[entry.first] += v[i] * entry.second;
      result[i] = 0.;
    }
  return result;
}

Vector<double> Oracle::residual(const Solution<2> &solution) const
{
  Vector<double> r(F.size()), product(F.size());
  K.vmult(product, solution.u);
  r = F;
  r -= product;
  if (B.m() > 0)
  {
    B.Tvmult(product, solution.z);
    r -= product;
  }
  return condense(r);
}

Vector<double> Oracle::schur_product(const Vector<double> &z) const
{
  Vector<double> force(F.size());
  B.Tvmult(force, z);
  Vector<double> u = condense(force);
  SparseDirectUMFPACK inverse;
  inverse.initialize(A);
  inverse.solve(u);
  for (types::global_dof_index i = 0; i < u.size(); ++i)
    if (constraints.is_constrained(i))
    {
      u[i] = 0.; // homogeneous: an increment of the displacement
      for (const auto &entry : *constraints.get_constraint_entries(i))
        u[i] += u[entry.first] * entry.second;
    }
  return tangential_moments(u);
}

// ---------------------------------------------------------------- equations

class ThesisExample : public ::testing::TestWithParam<std::string>
{
protected:
  const Scene<2> scene = shipped_scene(GetParam(), {{"Adaptivity/Maximum steps", "9"}});

  /** After the first step, some steps later, and at the end. */
  void for_some_steps(const std::function<void(const StepReport<2> &)> &action) const
  {
    AdaptiveSolver<2>(scene).run(
        [&](const StepReport<2> &step)
        {
          SCOPED_TRACE("step " + std::to_string(step.number));
          if (step.number % 4 == 1)
            action(step);
        });
  }
};

TEST_P(ThesisExample, EquilibriumHoldsOnTheWholeSpace)
{
  for_some_steps(
      [](const StepReport<2> &step)
      {
        const Oracle oracle(step.solution());
        EXPECT_LE(oracle.residual(step.solution()).l2_norm(), 1e-10 * oracle.load().l2_norm());
      });
}

TEST_P(ThesisExample, MultiplierStaysInItsBounds)
{
  for_some_steps(
      [](const StepReport<2> &step)
      {
        const ContactSpace<2> &contact = step.solution().contact_space;
        EXPECT_LE(step.solution().z.linfty_norm(), contact.largest_bound());
        for (const ContactFace<2> &face : contact.faces())
          for (const Point<1> &s : std::vector<Point<1>>(QGauss<1>(face.degree - 1).get_points()))
            EXPECT_LE(std::abs(contact.value(face, step.solution().z, s[0])),
                      (1 + 1e-13) * face.friction_bound(face.point(s[0])));
      });
}

/**
 * z_i inside its bounds has (B u)_i = 0, else (B u)_i has the sign of z_i; in units of the scaled
 * gradient, whose norm the QP solver makes small. Returns the number of slipping Gauss points.
 */
unsigned int expect_complementary(const Solution<2> &solution,
                                  const Discretisation<2> &discretisation, const double tolerance)
{
  const LinearSolver solver = discretisation.factor();
  const SchurComplement reduced(solver, discretisation.system.f, discretisation.contact_rows);
  Vector<double> bounds(solution.z.size());
  for (const ContactFace<2> &face : solution.contact_space.faces())
    for (unsigned int i = 0; i < face.n_multipliers; ++i)
      bounds[face.first_multiplier + i] =
          face.friction_bound(face.point(QGauss<1>(face.n_points).point(i)[0]));
  const Vector<double> moments = Oracle(solution).tangential_moments(solution.u);
  double violation = 0, load = 0;
  unsigned int n_slip = 0;
  for (unsigned int i = 0; i < moments.size(); ++i)
  {
    const double scale = 1. / std::sqrt(reduced.S()(i, i)), z = solution.z[i];
    const double g = bounds[i], d = reduced.d()[i];
    EXPECT_LE(std::abs(z), g);
    const double wrong = z == g    ? std::min(moments[i], 0.)
                         : z == -g ? std::max(moments[i], 0.)
                                   : moments[i];
    violation += wrong * wrong * scale * scale;
    load += d * d * scale * scale;
    n_slip += std::abs(z) == g;
  }
  EXPECT_LE(std::sqrt(violation), 1.01 * tolerance * std::sqrt(load));
  return n_slip;
}

TEST_P(ThesisExample, SlipAndStickAreComplementary)
{
  for_some_steps(
      [this](const StepReport<2> &step)
      {
        const Solution<2> &solution = step.solution();
        CondensedElements<2> elements(scene, solution.tables);
        const Discretisation<2> discretisation(scene, solution.spaces, elements);
        const unsigned int n_slip =
            expect_complementary(solution, discretisation, scene.solver.qp_tolerance);
        EXPECT_GT(n_slip, 0u);                // both examples have a slip zone
        EXPECT_LT(n_slip, solution.z.size()); // and a stick zone
      });
}

/** With homogeneous supports, b(u,lambda) = L(u) - a(u,u), so the Lagrangian is -a(u,u)/2. */
TEST_P(ThesisExample, EnergiesObeyTheirIdentities)
{
  for_some_steps(
      [](const StepReport<2> &step)
      {
        const Energies &e = step.energies;
        const double a = e.norm * e.norm;
        EXPECT_NEAR(e.lagrangian, -0.5 * a, 1e-10 * a);
        EXPECT_NEAR(e.energy - e.lagrangian, e.slack, 1e-12 * a);
        expect_slack_of_overshoot_alone(step.solution(), e.slack);
        EXPECT_GT(a, 0.);
      });
}

TEST_P(ThesisExample, SchurComplementIsThatOfTheWholeSpace)
{
  const RandomMesh mesh(scene, 5, 2, 2, 6);
  const Laboratory discrete(scene, mesh);
  const SchurComplement reduced = discrete.reduce();
  std::mt19937 random(1);
  const Solution<2> field = discrete.random_field(random);
  Vector<double> product(field.z.size());
  reduced.S().vmult(product, field.z);
  Vector<double> expected = Oracle(field).schur_product(field.z);
  expected -= product;
  EXPECT_LE(expected.l2_norm(), 1e-10 * product.l2_norm());
}

INSTANTIATE_TEST_SUITE_P(, ThesisExample, ::testing::Values("han-6-12", "han-6-13"),
                         [](const auto &info)
                         { return info.param == "han-6-12" ? "Square" : "Bar"; });

/** Every kind of data; prescribed displacements move the end of the contact boundary. */
Scene<2> scene_of_every_kind(const std::string &friction_bound, const Overrides &more = {})
{
  Overrides entries = {given::quadrilateral("Geometry", "0, 0; 3, 0.5; 2.5, 2; 0.2, 1.7", "2, 2"),
                       {"Material/Young's modulus", "7"},
                       {"Body force/Expression", "x*y; 1 - x"},
                       {"Boundary top/Displacement", "0.05 + 0.1*x; 0.05*y"},
                       {"Boundary left/Displacement", "0.05 + 0.1*x; free"},
                       {"Boundary left/Traction", "0; y"},
                       {"Boundary right/Traction", "1 + y; -x"},
                       given::rough("bottom", "bilateral", friction_bound)};
  entries.insert(entries.end(), more.begin(), more.end());
  Scene<2> scene = scene_of(entries);
  scene.materials.push_back({20., 0.1, PlaneModel::stress});
  return scene;
}

/** Returns the number of slipping Gauss points. */
unsigned int expect_equilibrium(const Scene<2> &scene)
{
  const RandomMesh mesh(scene, 3, 2);
  const Laboratory discrete(scene, mesh);
  const Solution<2> solution = discrete.solve();
  EXPECT_EQ(discrete.algebraic.corrections, 0u);
  // On distorted cells no quadrature is exact; Galerkin's orthogonality asks for all digits.
  const Oracle oracle(solution, 20);
  EXPECT_LE(oracle.residual(solution).l2_norm(), 1e-10 * oracle.load().l2_norm());
  const double a = oracle.energy_product(solution.u);
  EXPECT_NEAR(internal_forces(scene, discrete.displacement_space, discrete.tables, solution.u)
                  .energy_product,
              a, 1e-10 * a);
  EXPECT_NEAR(discrete.system.work(solution.u), oracle.work(solution.u), 1e-10 * a);
  return expect_complementary(solution, discrete.discretisation, scene.solver.qp_tolerance);
}

TEST(Equilibrium, HoldsWithEveryKindOfDataOnADistortedRandomMesh)
{
  const unsigned int n_weak = expect_equilibrium(scene_of_every_kind("0.1 + 0.2*x"));
  const unsigned int n_strong = expect_equilibrium(scene_of_every_kind("10 + 20*x"));
  EXPECT_GT(n_weak, n_strong); // where all slips, B u has a sign only
}

/** Nodal values stay the unknowns: B has full rows, and prescribed displacements a part in them. */
TEST(Equilibrium, HoldsWithAMultiplierOfAnotherDegree)
{
  for (const std::string offset : {"-1", "-3"})
    expect_equilibrium(
        scene_of_every_kind("10 + 20*x", {{"Solver/Multiplier degree offset", offset}}));
}

/**
 * B u is B of the unknowns and what prescribed displacements add, for any x: FEValues knows nothing of
 * the two parts. With moments as unknowns B is diagonal and nothing is added.
 */
void expect_coupling(const int offset)
{
  SCOPED_TRACE("offset " + std::to_string(offset));
  const Scene<2> scene = scene_of_every_kind(
      "0.1 + 0.2*x", {{"Solver/Multiplier degree offset", std::to_string(offset)}});
  const RandomMesh mesh(scene, 3, 2);
  const Laboratory discrete(scene, mesh);
  const ConditionRows &rows = discrete.discretisation.contact_rows;
  EXPECT_EQ(rows.prescribed.linfty_norm() > 0., offset != -2);
  for (const ConditionRows::Row &row : rows.B)
    EXPECT_EQ(row.size() == 1, offset == -2);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  for (const double factor : {0., 1.})
  {
    Vector<double> x(discrete.system.f.size());
    for (double &value : x)
      value = factor * uniform(random);
    Solution<2> field = discrete.random_field(random);
    field.u = discrete.discretisation.displacement(x);
    const double largest = field.u.linfty_norm();
    EXPECT_GT(largest, 0.);
    Vector<double> moments = Oracle(field).tangential_moments(field.u);
    moments -= rows.prescribed;
    for (unsigned int m = 0; m < moments.size(); ++m)
      for (const auto &[place, weight] : rows.B[m])
        moments[m] -= weight * x[rows.interface[place]];
    EXPECT_LE(moments.linfty_norm(), 1e-12 * largest);
  }
}

TEST(Coupling, OfPrescribedDisplacementsIsPartOfTheWhole)
{
  for (const int offset : {-3, -2, -1})
    expect_coupling(offset);
}

/** The displacement that unknowns describe has them as its moments `int psi_i u_t / w_i` again. */
TEST(Moments, AreTheUnknownsInsideContactEdges)
{
  const Scene<2> scene = scene_of_every_kind("0.1 + 0.2*x");
  const RandomMesh mesh(scene, 3, 2);
  const Laboratory discrete(scene, mesh);
  const ConditionRows &rows = discrete.discretisation.contact_rows;
  EXPECT_EQ(rows.interface.size(), discrete.contact_space.n_multipliers());
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  Vector<double> x(discrete.discretisation.unknowns.n());
  for (double &value : x)
    value = uniform(random);
  // homogeneous: what x alone does
  const Vector<double> u = discrete.discretisation.unknowns.expand(x);
  Vector<double> back = discrete.discretisation.unknowns.coordinates(u);
  back -= x;
  EXPECT_LE(back.linfty_norm(), 1e-13);
}

/** `S = W S_p^{-1} W` with the primal Schur complement on the moments, `S_p = A_mm - A_mi A_ii^-1 A_im`. */
TEST(Moments, TurnThePrimalSchurComplementIntoTheDualOne)
{
  const Scene<2> scene = shipped_scene("han-6-12");
  const RandomMesh mesh(scene, 5, 1, 2, 5);
  const Laboratory discrete(scene, mesh);
  const SymmetricMatrix &A = discrete.system.A;
  const ConditionRows &rows = discrete.discretisation.contact_rows;
  const unsigned int n = A.n(), m = rows.interface.size();
  // Unknowns inside first, moments last, and Gauss's elimination up to them.
  std::vector<unsigned int> place(n);
  for (unsigned int k = 0, inside = 0; k < n; ++k)
  {
    const auto found = std::lower_bound(rows.interface.begin(), rows.interface.end(), k);
    const bool is_kept = found != rows.interface.end() && *found == k;
    place[k] = is_kept ? n - m + (found - rows.interface.begin()) : inside++;
  }
  FullMatrix<double> dense(n, n);
  for (unsigned int column = 0; column < n; ++column)
    for (int k = A.column_start[column]; k < A.column_start[column + 1]; ++k)
      dense(place[A.row[k]], place[column]) = dense(place[column], place[A.row[k]]) = A.value[k];
  for (unsigned int k = 0; k < n - m; ++k)
    for (unsigned int i = k + 1; i < n; ++i)
      if (const double factor = dense(i, k) / dense(k, k))
        for (unsigned int j = k; j < n; ++j)
          dense(i, j) -= factor * dense(k, j);
  FullMatrix<double> S_p(m, m);
  S_p.fill(dense, 0, 0, n - m, n - m);
  S_p.gauss_jordan();
  const SchurComplement reduced = discrete.reduce();
  const auto w = [&](const unsigned int i)
  { return discrete.contact_space.multipliers()[i].weight; };
  for (unsigned int i = 0; i < m; ++i)
    for (unsigned int j = 0; j < m; ++j)
    {
      const unsigned int a = rows.B[i][0].first, b = rows.B[j][0].first;
      EXPECT_NEAR(reduced.S()(i, j), w(i) * S_p(a, b) * w(j), 1e-11 * reduced.S()(i, i));
    }
}

/** A solution keeps mesh and spaces: what is asked of it after the run is what was asked in its step. */
TEST(Solution, OutlivesItsStep)
{
  const Scene<2> scene = shipped_scene("han-6-12", {{"Adaptivity/Maximum steps", "5"}});
  std::vector<Solution<2>> solutions;
  std::vector<double> estimates, resultants;
  {
    AdaptiveSolver<2> solver(scene);
    solver.run(
        [&](const StepReport<2> &step)
        {
          solutions.push_back(step.solution());
          estimates.push_back(step.estimate.total());
          resultants.push_back(step.contact.at(0).friction_resultant);
        });
  }
  ASSERT_EQ(solutions.size(), 5u);
  for (unsigned int k = 0; k < solutions.size(); ++k)
  {
    EXPECT_EQ(estimate_error(SolutionField(solutions[k])).total(), estimates[k]);
    EXPECT_EQ(contact_states(SolutionField(solutions[k])).at(0).friction_resultant, resultants[k]);
  }
}

/** `p + 2` Gauss points on cells and edges take loads that are three degrees higher than p. */
TEST(Loads, OfDegreePPlusThreeAreIntegratedExactly)
{
  for (const unsigned int p : {1u, 2u, 3u, 5u})
  {
    const std::string power = "^" + std::to_string(p + 3);
    const std::string smooth = "(x" + power + " - 0.5*x); (0.3 - y" + power + ")";
    for (const std::string loaded : {"Boundary right/Traction", "Boundary bottom/Traction",
                                     "Boundary left/Traction", "Body force/Expression"})
    {
      const Scene<2> scene = scene_of(
          {given::box("1, 1.5", "1, 2"), {"Boundary top/Displacement", "0; 0"}, {loaded, smooth}});
      const RandomMesh mesh(scene, 1, 1, p, p);
      const Laboratory discrete(scene, mesh);
      std::mt19937 random(p);
      const Solution<2> field = discrete.random_field(random);
      const double work = Oracle(field, 5).work(field.u);
      EXPECT_NEAR(discrete.system.work(field.u), work, 1e-12) << loaded << ", p = " << p;
      EXPECT_GT(std::abs(work), 1e-3);
    }
  }
}

// ---------------------------------------------------------------- patch tests

/** Corners counterclockwise from the bottom left; the contact edge lies on y = 0. */
struct Block
{
  std::string name;
  std::array<Point<2>, 4> corners;
  double angle; ///< by which the whole scene is turned about the origin

  Tensor<1, 2> turned(const Tensor<1, 2> &v) const
  {
    return Point<2>(std::cos(angle) * v[0] - std::sin(angle) * v[1],
                    std::sin(angle) * v[0] + std::cos(angle) * v[1]);
  }

  /** The local y of a point, as an expression of the global x and y. */
  std::string height() const
  {
    return "(" + in_digits(-std::sin(angle)) + "*x + " + in_digits(std::cos(angle)) + "*y)";
  }

  std::string corner_text() const
  {
    std::string result;
    for (const Point<2> &corner : corners)
    {
      const Tensor<1, 2> x = turned(corner);
      result += (result.empty() ? "" : "; ") + in_digits(x[0]) + ", " + in_digits(x[1]);
    }
    return result;
  }
};

std::ostream &operator<<(std::ostream &out, const Block &block)
{
  return out << block.name;
}

/** Simple shear in the block's own axes, `u = (foot + strain y) e_x`, shear stress mu strain. */
struct Shear
{
  double foot, strain, friction_bound;
  bool top_is_held = true; ///< else friction alone holds the block
};

constexpr double young = 2.6, poisson = 0.3, shear_modulus = 1.;

/** The sides carry the traction of the shear stress; the top does, or follows the displacement. */
Scene<2> shear_scene(const Block &block, const Shear &shear)
{
  Overrides entries = {given::quadrilateral("Geometry", block.corner_text(), "2, 2"),
                       given::elastic(in_digits(young), in_digits(poisson)),
                       given::rough("bottom", "bilateral", in_digits(shear.friction_bound))};
  std::vector<std::tuple<std::string, int, int>> loaded = {{"right", 1, 2}, {"left", 3, 0}};
  const Tensor<1, 2> along = block.turned(Point<2>(1., 0.));
  const std::string u =
      "(" + in_digits(shear.foot) + " + " + in_digits(shear.strain) + "*" + block.height() + ")";
  if (shear.top_is_held)
    entries.emplace_back("Boundary top/Displacement",
                         in_digits(along[0]) + "*" + u + "; " + in_digits(along[1]) + "*" + u);
  else
    loaded.emplace_back("top", 2, 3);
  const double tau = shear_modulus * shear.strain;
  for (const auto &[side, first, second] : loaded)
  {
    const Tensor<1, 2> edge = block.corners[second] - block.corners[first];
    const Tensor<1, 2> n = Point<2>(edge[1], -edge[0]) / edge.norm();
    const Tensor<1, 2> traction = block.turned(Point<2>(tau * n[1], tau * n[0]));
    entries.emplace_back("Boundary " + side + "/Traction",
                         in_digits(traction[0]) + "; " + in_digits(traction[1]));
  }
  return scene_of(entries);
}

/** Largest difference of nodal values to a displacement field, with the field's largest value. */
std::pair<double, double> nodal_error(const Solution<2> &solution,
                                      const std::function<Tensor<1, 2>(const Point<2> &)> &field)
{
  const MappingQ1<2> mapping;
  double error = 0, largest = 0;
  for (const auto &cell : solution.displacement_space.dof_handler().active_cell_iterators())
  {
    const FiniteElement<2> &fe = cell->get_fe();
    const auto dofs = solution.displacement_space.cell_dofs(cell->active_cell_index());
    for (unsigned int i = 0; i < fe.n_dofs_per_cell(); ++i)
    {
      const Point<2> x = mapping.transform_unit_to_real_cell(cell, fe.unit_support_point(i));
      const double expected = field(x)[fe.system_to_component_index(i).first];
      error = std::max(error, std::abs(solution.u[dofs[i]] - expected));
      largest = std::max(largest, std::abs(expected));
    }
  }
  return {error, largest};
}

class PatchTest : public ::testing::TestWithParam<std::tuple<Block, unsigned int>>
{
protected:
  const Block block = std::get<0>(GetParam());
  const unsigned int seed = std::get<1>(GetParam());

  /** Solve on a random hp mesh; displacement, multiplier and a vanishing indicator. */
  void expect_exact(const Shear &shear, const double multiplier) const
  {
    const Scene<2> scene = shear_scene(block, shear);
    const RandomMesh mesh(scene, seed, 2);
    const Laboratory discrete(scene, mesh);
    const Solution<2> solution = discrete.solve();
    if (shear.strain > 1e-6) // a block that is moved has round-off to correct
    {
      EXPECT_EQ(discrete.algebraic.corrections, 0u);
    }
    const auto [error, largest] =
        nodal_error(solution,
                    [&](const Point<2> &x)
                    {
                      const double height = x * block.turned(Point<2>(0., 1.));
                      return (shear.foot + shear.strain * height) * block.turned(Point<2>(1., 0.));
                    });
    // Where friction alone holds the block, a soft spring does for the solver, at a loss of digits.
    const double loss = shear.top_is_held ? 1. : 1000.;
    EXPECT_LE(error, 1e-10 * loss * largest);
    for (const double z : solution.z)
      EXPECT_NEAR(z, multiplier * shear.friction_bound, 1e-10 * loss * shear.friction_bound);
    EXPECT_LE(estimate_error(SolutionField(solution)).total(), 1e-9 * loss * young * largest);
  }
};

TEST_P(PatchTest, StickBelowTheBound)
{
  expect_exact({0., 0.04, 0.1}, 0.4);
  expect_exact({0., -0.09, 0.1}, -0.9);
}

TEST_P(PatchTest, SlipAboveTheBound)
{
  expect_exact({0.3, 0.1, 0.1}, 1.);
  expect_exact({-0.2, -0.1, 0.1}, -1.);
}

TEST_P(PatchTest, ExactThreshold)
{
  expect_exact({0., 0.1, 0.1}, 1.);
}

TEST_P(PatchTest, TinyBound)
{
  expect_exact({0.3, 1e-12, 1e-12}, 1.);
}

TEST_P(PatchTest, WithoutFrictionTheBlockRolls)
{
  expect_exact({0.3, 0., 0.}, 0.);
}

TEST_P(PatchTest, FrictionAloneHoldsTheBlock)
{
  expect_exact({0., 0.04, 0.1, false}, 0.4);
  expect_exact({0., -0.09, 0.1, false}, -0.9);
}

const double thirty_degrees = numbers::PI / 6;

INSTANTIATE_TEST_SUITE_P(
    , PatchTest,
    ::testing::Combine(
        ::testing::Values(
            Block{"Box", {{{0, 0}, {2, 0}, {2, 1}, {0, 1}}}, 0.},
            Block{"TurnedBox", {{{0, 0}, {2, 0}, {2, 1}, {0, 1}}}, thirty_degrees},
            Block{"Parallelogram", {{{0, 0}, {2, 0}, {2.7, 1}, {0.7, 1}}}, 0.},
            Block{"Trapezoid", {{{0, 0}, {2, 0}, {1.6, 1}, {0.5, 1}}}, 0.},
            Block{"TurnedQuadrilateral", {{{0, 0}, {2, 0}, {2.3, 1.4}, {-0.2, 0.9}}}, 3.5}),
        ::testing::Values(1u, 2u)),
    [](const auto &info)
    { return std::get<0>(info.param).name + std::to_string(std::get<1>(info.param)); });

TEST(ExactThreshold, DoesNotCycle)
{
  const Block block{"Box", {{{0, 0}, {2, 0}, {2, 1}, {0, 1}}}, 0.};
  const Scene<2> scene = shear_scene(block, {0., 0.1, 0.1});
  const RandomMesh mesh(scene, 7, 2);
  const Laboratory discrete(scene, mesh);
  Vector<double> lambda(discrete.contact_space.n_multipliers());
  Mprgp::Settings settings;
  settings.tolerance = scene.solver.qp_tolerance;
  const QpReport report =
      Mprgp(settings).solve(discrete.quadratic_program(discrete.reduce()), lambda);
  EXPECT_TRUE(report.converged);
  EXPECT_LE(report.multiplications, 500u);
}

/** `u_t` is orthogonal to the multiplier space, and no multiplier is at its bound. */
TEST(LargeFrictionBound, TheWholeContactBoundarySticks)
{
  const Scene<2> scene = shipped_scene("han-6-12", {{"Boundary bottom/Friction bound", "4.5e6"}});
  const RandomMesh mesh(scene, 11, 2);
  const Laboratory discrete(scene, mesh);
  const Solution<2> solution = discrete.solve();
  const Vector<double> moments = Oracle(solution).tangential_moments(solution.u);
  EXPECT_LT(solution.z.linfty_norm(), 1e-3 * 4.5e6);
  EXPECT_LE(moments.linfty_norm(), 1e-10 * solution.u.linfty_norm());
}

// ---------------------------------------------------------------- rotation

/** Example 5.2, turned by @p angle about the origin. */
Scene<2> turned_square(const double angle)
{
  const Block block{"", {{{0, 0}, {4, 0}, {4, 4}, {0, 4}}}, angle};
  const std::string pressure = "(1.5*(5 - " + block.height() + "))";
  const auto component = [&](const unsigned int c)
  {
    return pressure + "*" + in_digits(block.turned(Point<2>(1., 0.))[c]) + " - 0.75*" +
           in_digits(block.turned(Point<2>(0., 1.))[c]);
  };
  return shipped_scene("han-6-12",
                       {given::quadrilateral("Geometry", block.corner_text()),
                        {"Geometry/Lower corner", "0, 0"},
                        {"Geometry/Upper corner", "1, 1"},
                        {"Boundary left/Traction", component(0) + "; " + component(1)}});
}

TEST(Rotation, TurnsTheSolutionOfTheSquare)
{
  const double angle = thirty_degrees;
  const Scene<2> straight = shipped_scene("han-6-12"), turned = turned_square(angle);
  const RandomMesh straight_mesh(straight, 13, 2), turned_mesh(turned, 13, 2);
  const Laboratory first(straight, straight_mesh), second(turned, turned_mesh);
  const Solution<2> u = first.solve(), v = second.solve();
  ASSERT_EQ(u.u.size(), v.u.size());

  double error = 0;
  for (unsigned int cell = 0; cell < straight_mesh.degrees.size(); ++cell)
  {
    const auto a = u.coefficients(cell), b = v.coefficients(cell);
    const unsigned int n = a.size() / 2;
    for (unsigned int i = 0; i < n; ++i)
    {
      error = std::max(error, std::abs(std::cos(angle) * b[i] + std::sin(angle) * b[n + i] - a[i]));
      error = std::max(error,
                       std::abs(-std::sin(angle) * b[i] + std::cos(angle) * b[n + i] - a[n + i]));
    }
  }
  EXPECT_LE(error, 1e-10 * u.u.linfty_norm());
  for (unsigned int i = 0; i < u.z.size(); ++i)
    EXPECT_NEAR(u.z[i], v.z[i], 1e-9 * 4.5);
  const double eta = estimate_error(SolutionField(u)).total();
  EXPECT_NEAR(estimate_error(SolutionField(v)).total(), eta, 1e-9 * eta);
}

/** Cells and free unknowns of the last of six steps of the default method, on a block turned by @p angle and sheared. */
std::pair<unsigned int, unsigned int> default_mesh(const double angle, const Overrides &overrides)
{
  const Block block{"", {{{0, 0}, {2, 0}, {2, 1}, {0, 1}}}, angle};
  const Tensor<1, 2> shear = block.turned(Point<2>(0.02, -0.01));
  const Scene<2> scene =
      scene_of(overrides + Overrides{given::quadrilateral("Geometry", block.corner_text(), "2, 1"),
                                     {"Boundary top/Displacement",
                                      in_digits(shear[0]) + "; " + in_digits(shear[1])},
                                     given::rough("bottom", "bilateral", "0.005"),
                                     {"Adaptivity/Maximum steps", "6"}});
  std::pair<unsigned int, unsigned int> mesh;
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        const DisplacementSpace<2> &space = step.solution().displacement_space;
        mesh = {space.degrees().size(), space.n_free_dofs()};
      });
  return mesh;
}

/** Of the two readings of decay rates only `joint` knows no axes. */
TEST(Rotation, LeavesTheDefaultMeshAsItIs)
{
  const Overrides plain = {{"Adaptivity/Smoothness reading", "plain"}};
  for (const double angle : {thirty_degrees, 2.5})
  {
    EXPECT_EQ(default_mesh(angle, {}), default_mesh(0, {})) << angle;
    EXPECT_NE(default_mesh(angle, plain), default_mesh(0, plain)) << angle;
  }
}

// ---------------------------------------------------------------- random hp meshes

/** The largest jump of @p field over any interior edge, from values on both sides. */
double largest_jump(const Solution<2> &field)
{
  const DoFHandler<2> &dofs = field.displacement_space.dof_handler();
  const auto &elements = dofs.get_fe_collection();
  const hp::QCollection<1> quadrature(QGauss<1>(10));
  const hp::MappingCollection<2> mapping((MappingQ1<2>()));
  hp::FEFaceValues<2> faces(mapping, elements, quadrature, update_values);
  hp::FESubfaceValues<2> subfaces(mapping, elements, quadrature, update_values);
  std::vector<Vector<double>> here(10, Vector<double>(2)), there(10, Vector<double>(2));
  double largest = 0;
  for (const auto &cell : dofs.active_cell_iterators())
    for (const unsigned int face : cell->face_indices())
    {
      if (cell->at_boundary(face) || cell->face(face)->has_children())
        continue;
      faces.reinit(cell, face, 0, 0);
      faces.get_present_fe_values().get_function_values(field.u, here);
      const auto neighbor = cell->neighbor(face);
      if (cell->neighbor_is_coarser(face))
      {
        const auto [other, subface] = cell->neighbor_of_coarser_neighbor(face);
        subfaces.reinit(neighbor, other, subface, 0, 0);
        subfaces.get_present_fe_values().get_function_values(field.u, there);
      }
      else
      {
        faces.reinit(neighbor, cell->neighbor_of_neighbor(face), 0, 0);
        faces.get_present_fe_values().get_function_values(field.u, there);
      }
      for (unsigned int q = 0; q < here.size(); ++q)
      {
        there[q] -= here[q];
        largest = std::max(largest, there[q].linfty_norm());
      }
    }
  return largest;
}

class RandomHpMesh : public ::testing::TestWithParam<unsigned int>
{
protected:
  const unsigned int seed = GetParam();
};

TEST_P(RandomHpMesh, IsConforming)
{
  const Scene<2> scene = shipped_scene("han-6-13");
  const RandomMesh mesh(scene, seed, 3, 1 + seed % 2, 8);
  ASSERT_TRUE(mesh.mesh.has_hanging_nodes());
  // Degree 1 is not for contact, but the displacement space alone must cope with it.
  const auto spaces = std::make_shared<const Spaces<2>>(scene, borrowed(mesh.mesh), mesh.degrees,
                                                        std::make_shared<const ShapeTables<2>>());
  const DisplacementSpace<2> &space = spaces->displacement_space;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  Vector<double> u(space.n_dofs());
  for (double &value : u)
    value = uniform(random);
  space.constraints().distribute(u);
  EXPECT_LE(largest_jump({scene, spaces, u, {}}), 1e-12 * u.linfty_norm());
}

/** A random displacement under the constraints of deal.II meets ours, and their number is the same. */
TEST_P(RandomHpMesh, IsTheSpaceOfDealII)
{
  const Scene<2> scene = scene_of({{"Boundary top/Displacement", "0; 0"}});
  const RandomMesh mesh(scene, seed, 3, 2, 8);
  const ShapeTables<2> tables;
  const DisplacementSpace<2> space(scene, mesh.mesh, mesh.degrees, tables);
  AffineConstraints<double> dealii_constraints;
  DoFTools::make_hanging_node_constraints(space.dof_handler(), dealii_constraints);
  VectorTools::interpolate_boundary_values(space.dof_handler(), scene.boundaries[3].id,
                                           Functions::ZeroFunction<2>(2), dealii_constraints);
  dealii_constraints.close();
  EXPECT_EQ(space.constraints().n_constraints(), dealii_constraints.n_constraints());

  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  Vector<double> u(space.n_dofs());
  for (double &value : u)
    value = uniform(random);
  dealii_constraints.distribute(u);
  Vector<double> ours(u);
  space.constraints().distribute(ours);
  ours -= u;
  EXPECT_LE(ours.linfty_norm(), 1e-10 * u.linfty_norm());
}

/** Their squares multiply the round-off of the stiffness; deal.II's own weights reach thousands. */
TEST_P(RandomHpMesh, ConstraintsDoNotMultiplyRoundOff)
{
  const Scene<2> scene = shipped_scene("han-6-13");
  const RandomMesh mesh(scene, seed, 3, 3, 14);
  const ShapeTables<2> tables;
  const DisplacementSpace<2> space(scene, mesh.mesh, mesh.degrees, tables);
  for (const auto &line : space.constraints().get_lines())
    for (const auto &[unknown, weight] : line.entries)
      EXPECT_LE(std::abs(weight), 10.) << "unknown " << unknown;
}

TEST_P(RandomHpMesh, ReproducesLinearDisplacements)
{
  const std::string linear = "0.3 + 0.1*x - 0.2*y; 0.05*x + 0.4*y - 0.1";
  Overrides entries = {given::quadrilateral("Geometry", "0, 0; 3, 0.2; 2.6, 2; -0.3, 1.5", "3, 2")};
  for (const std::string side : {"left", "right", "bottom", "top"})
    entries.emplace_back("Boundary " + side + "/Displacement", linear);
  const Scene<2> scene = scene_of(entries);
  const RandomMesh mesh(scene, seed, 3);
  const Laboratory discrete(scene, mesh);
  const auto [error, largest] = nodal_error(
      discrete.solve(), [](const Point<2> &x)
      { return Point<2>(0.3 + 0.1 * x[0] - 0.2 * x[1], 0.05 * x[0] + 0.4 * x[1] - 0.1); });
  EXPECT_LE(error, 1e-10 * largest);
}

TEST_P(RandomHpMesh, SchurComplementIsPositiveDefinite)
{
  for (const std::string name : {"han-6-12", "han-6-13"}) // the first meets a clamped edge
  {
    const Scene<2> scene = shipped_scene(name);
    const RandomMesh mesh(scene, seed, 2);
    const Laboratory discrete(scene, mesh);
    const SchurComplement reduced = discrete.reduce();
    EXPECT_EQ(reduced.S().m(), discrete.contact_space.n_multipliers());
    EXPECT_LE(condition_number(scaled_by_diagonal(reduced.S())), 1e6);
  }
}

INSTANTIATE_TEST_SUITE_P(, RandomHpMesh, ::testing::Range(1u, 6u));

// ---------------------------------------------------------------- stages that do not run

const Overrides pushed_block = {{"Geometry/Subdivisions", "2, 2"},
                                {"Boundary top/Displacement", "0.1; 0"},
                                {"Boundary left/Traction", "1; 0"},
                                {"Adaptivity/Maximum steps", "3"}};

Overrides pushed_block_with(const Overrides &more)
{
  Overrides entries = pushed_block;
  entries.insert(entries.end(), more.begin(), more.end());
  return entries;
}

void expect_no_quadratic_program(const Scene<2> &scene, const bool has_contact)
{
  unsigned int n_steps = 0;
  AdaptiveSolver<2>(scene).run(
      [&](const StepReport<2> &step)
      {
        ++n_steps;
        EXPECT_EQ(step.solution().contact_space.faces().empty(), !has_contact);
        EXPECT_EQ(step.solution().contact_space.n_multipliers(), 0u);
        EXPECT_EQ(step.solution().z.size(), 0u);
        EXPECT_EQ(step.reduced->qp.multiplications, 0u);
        EXPECT_EQ(step.times.qp, 0.);
        EXPECT_EQ(step.energies.slack, 0.);
      });
  EXPECT_EQ(n_steps, 3u);
}

void expect_empty_reduction(const Scene<2> &scene)
{
  const RandomMesh mesh(scene, 1, 1);
  const Laboratory discrete(scene, mesh);
  EXPECT_TRUE(discrete.discretisation.contact_rows.interface.empty());
  EXPECT_EQ(discrete.discretisation.contact_rows.n_rows(), 0u);
  const SchurComplement reduced = discrete.reduce();
  EXPECT_EQ(reduced.S().m(), 0u);
  EXPECT_EQ(reduced.d().size(), 0u);
}

TEST(StagesNotNamed, WithoutFrictionThereIsNoMultiplier)
{
  for (const std::string bound : {"", "0", "0.0"})
  {
    const Scene<2> scene =
        scene_of(pushed_block_with({given::rough("bottom", "bilateral", bound)}));
    EXPECT_FALSE(scene.has_friction());
    expect_no_quadratic_program(scene, true);
    expect_empty_reduction(scene);
  }
}

TEST(StagesNotNamed, AFrictionBoundThatVanishesEverywhereIsNoFriction)
{
  const Scene<2> scene = scene_of(pushed_block_with({given::rough("bottom", "bilateral", "0*x")}));
  expect_no_quadratic_program(scene, true);
  expect_empty_reduction(scene);
}

TEST(StagesNotNamed, WithoutContactItIsOneLinearSolve)
{
  const Scene<2> scene = scene_of(pushed_block);
  EXPECT_FALSE(scene.has_contact());
  expect_no_quadratic_program(scene, false);
  expect_empty_reduction(scene);
}

TEST(StagesNotNamed, NoMultiplierWhereTheBoundVanishes)
{
  const Scene<2> scene =
      shipped_scene("han-6-12", {{"Boundary bottom/Friction bound", "(x < 2) ? 0 : 4.5"}});
  const RandomMesh mesh(scene, 1, 1);
  const Laboratory discrete(scene, mesh);
  unsigned int n_multipliers = 0;
  for (const ContactFace<2> &face : discrete.contact_space.faces())
  {
    const unsigned int expected = face.point(0.5)[0] < 2. ? 0 : face.degree - 1;
    EXPECT_EQ(face.n_multipliers, expected);
    n_multipliers += expected;
  }
  EXPECT_EQ(discrete.contact_space.n_multipliers(), n_multipliers);
  EXPECT_GT(n_multipliers, 0u);
  const Solution<2> solution = discrete.solve();
  const Oracle oracle(solution);
  EXPECT_LE(oracle.residual(solution).l2_norm(), 1e-10 * oracle.load().l2_norm());
}

TEST(StagesNotNamed, OnlyABodyForceKeepsTheInteriorBlock)
{
  const auto interior_block = [](const Overrides &entries)
  {
    const Scene<2> scene = scene_of(entries);
    const ShapeTables<2> tables;
    CondensedElements<2> elements(scene, tables);
    const CellMap<2>::Vertices square = {{{0, 0}, {1, 0}, {0, 1}, {1, 1}}};
    return elements.get(CellMap<2>(square), 4, 0)->factor.size();
  };
  EXPECT_EQ(interior_block(pushed_block), 0u);
  EXPECT_EQ(interior_block(pushed_block_with({{"Body force/Expression", "0; 0"}})), 0u);
  EXPECT_EQ(interior_block(pushed_block_with({{"Body force/Expression", "0; -1"}})), 18u * 18u);
}
} // namespace
