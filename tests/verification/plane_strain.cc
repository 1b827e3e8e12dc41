// SPDX-License-Identifier: LGPL-2.1-or-later
// Plane strain in absolute numbers: Hooke's law from E and nu, patches, stick meets slip.
#include "discretisation.h"

#include <deal.II/base/quadrature_lib.h>
#include <hpvi/bound/mixed_problem.h>
#include <hpvi/plane/internal_forces.h>
#include <hpvi/results/contact_traces.h>
#include <hpvi/results/solution_field.h>

#include <complex>

namespace
{
using namespace verification;

// ---------------------------------------------------------------- Hooke's law

/**
 * The strain that a stress in the plane causes, from the engineering constants alone:
 * `E eps = (1 + nu) sigma - nu (tr sigma + sigma_zz) I`, where sigma_zz vanishes in plane stress and
 * keeps eps_zz = 0 in plane strain.
 */
SymmetricTensor<2, 2> strain_of(const SymmetricTensor<2, 2> &sigma, const Material &material)
{
  const double nu = material.poisson, in_plane = trace(sigma);
  const double out_of_plane = material.plane == PlaneModel::strain ? nu * in_plane : 0.;
  return ((1 + nu) * sigma - nu * (in_plane + out_of_plane) * unit_symmetric_tensor<2>()) /
         material.young;
}

TEST(HookesLaw, IsTheInverseOfTheEngineeringOne)
{
  Tensor<2, 2> gradient;
  gradient[0][0] = 0.3;
  gradient[0][1] = -0.7;
  gradient[1][0] = 0.2;
  gradient[1][1] = 0.4;
  for (const PlaneModel plane : {PlaneModel::stress, PlaneModel::strain})
    for (const double nu : {-0.3, 0., 0.25, 0.4, 0.49})
    {
      const Material material{7., nu, plane};
      EXPECT_LE(
          (strain_of(HookesLaw<2>(material).stress(gradient), material) - symmetrize(gradient))
              .norm(),
          1e-13)
          << "nu = " << nu;
      EXPECT_NEAR(material.kolosov(),
                  plane == PlaneModel::strain ? 3 - 4 * nu : (3 - nu) / (1 + nu), 1e-13);
    }
}

/** `s : C^-1 s = s : eps` for s = C eps, and the part of s that resists the change of volume is that of energy_product(). */
template <int dim>
void expect_complementary_energy(const Material &material)
{
  Tensor<2, dim> gradient;
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      gradient[i][j] = 0.3 + 0.1 * i - 0.4 * j + 0.2 * i * j;
  const HookesLaw<dim> law(material);
  const SymmetricTensor<2, dim> stress = law.stress(gradient);
  const double energy = law.energy_product(gradient);
  EXPECT_NEAR(law.complementary_product(stress, stress), energy, 1e-12 * energy);
  EXPECT_NEAR(law.volumetric_stress(trace(stress)), law.volume_modulus() * trace(gradient),
              1e-13 * stress.norm());
}

TEST(HookesLaw, HasTheSameEnergyOfStressAndStrain)
{
  for (const PlaneModel plane : {PlaneModel::stress, PlaneModel::strain})
    for (const double nu : {-0.3, 0., 0.25, 0.49})
    {
      SCOPED_TRACE("nu = " + std::to_string(nu));
      expect_complementary_energy<2>({7., nu, plane});
      expect_complementary_energy<3>({7., nu, plane});
    }
}

/** The material says what locks, and where von Mises' stress needs sigma_zz. */
TEST(Material, AnswersWhatStagesAsk)
{
  const Material rubber{3., 0.499}, steel{210., 0.3}, sheet{3., 0.499, PlaneModel::stress};
  EXPECT_TRUE(rubber.is_nearly_incompressible(2));
  EXPECT_FALSE(steel.is_nearly_incompressible(2));
  EXPECT_FALSE(sheet.is_nearly_incompressible(2)); // it grows thinner instead
  EXPECT_EQ(rubber.locking_in_words(2), "Poisson's ratio 0.499 is near 1/2 (lambda/mu = 499)");
  const SymmetricTensor<2, 2> sigma = 2. * unit_symmetric_tensor<2>();
  EXPECT_EQ(steel.transverse_stress(sigma), 1.2);
  EXPECT_EQ(sheet.transverse_stress(sigma), 0.);
}

// ---------------------------------------------------------------- changes of volume

/** Least squares by powers of total degree below p, on the reference cell: values at points with weights. */
Vector<double> projected(const Vector<double> &values, const QGauss<2> &gauss, const unsigned int p)
{
  std::vector<Vector<double>> powers;
  for (unsigned int i = 0; i < p; ++i)
    for (unsigned int j = 0; i + j < p; ++j)
    {
      Vector<double> power(gauss.size());
      for (unsigned int q = 0; q < gauss.size(); ++q)
        power[q] = std::pow(2 * gauss.point(q)[0] - 1, i) * std::pow(2 * gauss.point(q)[1] - 1, j);
      powers.push_back(power);
    }
  const unsigned int n = powers.size();
  FullMatrix<double> normal(n, n);
  Vector<double> right(n), amplitudes(n), result(gauss.size());
  for (unsigned int q = 0; q < gauss.size(); ++q)
    for (unsigned int i = 0; i < n; ++i)
    {
      right[i] += gauss.weight(q) * powers[i][q] * values[q];
      for (unsigned int j = 0; j < n; ++j)
        normal(i, j) += gauss.weight(q) * powers[i][q] * powers[j][q];
    }
  normal.gauss_jordan();
  normal.vmult(amplitudes, right);
  for (unsigned int i = 0; i < n; ++i)
    result.add(amplitudes[i], powers[i]);
  return result;
}

/** `int 2 mu eps : eps + lambda (Pi div u)^2` of one cell. */
double projected_energy(const Solution<2> &solution, const unsigned int index,
                        const CellMap<2> &map)
{
  const unsigned int p = solution.displacement_space.degrees()[index];
  const QGauss<2> gauss(12);
  const Material &material = solution.scene.materials[0];
  const ShapeTable<2> table = tabulate<2>(p, gauss.get_points(), gauss.get_weights(), false);
  const std::vector<double> d = evaluate(table.derivatives, solution.coefficients(index));
  const Tensor<2, 2> J = map.jacobian({0.5, 0.5});
  Vector<double> divergence(gauss.size());
  double result = 0;
  for (unsigned int q = 0; q < gauss.size(); ++q)
  {
    Tensor<2, 2> reference;
    for (unsigned int c = 0; c < 2; ++c)
      for (unsigned int j = 0; j < 2; ++j)
        reference[c][j] = d[(c * gauss.size() + q) * 2 + j];
    const SymmetricTensor<2, 2> strain = symmetrize(reference * invert(J));
    divergence[q] = trace(strain);
    result += gauss.weight(q) * determinant(J) * 2 * material.mu() * (strain * strain);
  }
  const Vector<double> kept = projected(divergence, gauss, p);
  for (unsigned int q = 0; q < gauss.size(); ++q)
    result += gauss.weight(q) * determinant(J) * material.lambda(2) * kept[q] * kept[q];
  return result;
}

/** Volume::projected in matrices and in forces from strains, against an integral of the definition. */
TEST(ChangeOfVolume, IsThatOfPolynomialsOfDegreeBelowP)
{
  const Scene<2> scene =
      shipped_scene("han-6-12", {given::quadrilateral("Geometry", "1, 0; 3, 1; 2.5, 2; 0.5, 1"),
                                 {"Material/Plane", "strain"},
                                 {"Material/Poisson's ratio", "0.4999"}});
  std::mt19937 random(3);
  const RandomMesh mesh(scene, 2, 1, 2, 6);
  const Laboratory lab(scene, mesh);
  const Solution<2> field = lab.random_field(random);
  const ElementMatrices<2> matrices(scene, lab.tables, Volume::projected);
  double energy = 0;
  for (const auto &cell : lab.displacement_space.dof_handler().active_cell_iterators())
  {
    const unsigned int index = cell->active_cell_index();
    const CellMap<2> map = map_of<2>(cell);
    const double own = projected_energy(field, index, map);
    Vector<double> local(lab.displacement_space.cell_dofs(index).size());
    for (unsigned int i = 0; i < local.size(); ++i)
      local[i] = field.u[lab.displacement_space.cell_dofs(index)[i]];
    const FullMatrix<double> K =
        matrices.stiffness(map, lab.displacement_space.degrees()[index], cell->material_id());
    EXPECT_NEAR(K.matrix_norm_square(local), own, 1e-8 * own);
    energy += own;
  }
  const InternalForces forces =
      internal_forces(scene, lab.displacement_space, lab.tables, field.u, Volume::projected);
  EXPECT_NEAR(forces.energy_product, energy, 1e-8 * energy);
  EXPECT_NEAR(forces.forces * field.u, energy, 1e-8 * energy);
  EXPECT_GT(internal_forces(scene, lab.displacement_space, lab.tables, field.u).energy_product,
            1.1 * energy);
}

/** The mixed method does not lock: with p = 2 shear is as near as with nu = 0.3, where the usual one is far off. */
TEST(MixedProblem, DoesNotLock)
{
  const auto shear_error = [](const std::string &nu, const bool is_mixed)
  {
    const Scene<2> scene = shipped_scene("plane-strain", {{"Material/Poisson's ratio", nu}});
    const RandomMesh mesh(scene, 2, 1, 2, 2);
    const Laboratory lab(scene, mesh);
    const Solution<2> usual = lab.solve();
    std::unique_ptr<LinearSolver> none;
    const Solution<2> solution = is_mixed ? MixedProblem(scene).solve(usual, none) : usual;
    double error = 0, norm = 0;
    const QGauss<2> gauss(12);
    for (const auto &cell : lab.displacement_space.dof_handler().active_cell_iterators())
    {
      const CellMap<2> map = map_of<2>(cell);
      const Tensor<2, 2> J = map.jacobian({0.5, 0.5});
      const ShapeTable<2> table = tabulate<2>(2, gauss.get_points(), gauss.get_weights(), false);
      const std::vector<double> d =
          evaluate(table.derivatives, solution.coefficients(cell->active_cell_index()));
      for (unsigned int q = 0; q < gauss.size(); ++q)
      {
        Tensor<2, 2> reference;
        for (unsigned int c = 0; c < 2; ++c)
          for (unsigned int j = 0; j < 2; ++j)
            reference[c][j] = d[(c * gauss.size() + q) * 2 + j];
        const Tensor<2, 2> exact = scene.exact_solution->gradient(map.point(gauss.point(q)));
        error += gauss.weight(q) * determinant(J) *
                 std::pow(deviator(symmetrize(reference * invert(J) - exact)).norm(), 2);
        norm += gauss.weight(q) * determinant(J) * std::pow(deviator(symmetrize(exact)).norm(), 2);
      }
    }
    return std::sqrt(error / norm);
  };
  const double far_from_it = shear_error("0.3", false);
  EXPECT_LE(shear_error("0.499999", true), 2. * far_from_it);
  EXPECT_GE(shear_error("0.499999", false), 3. * far_from_it);
}

// ---------------------------------------------------------------- patches

/** A block of 2 by 1 on a frictionless plane, E = 2 and nu = 1/4, in the plane model of default. */
Scene<2> block(const Overrides &more)
{
  Overrides entries = {given::box("2, 1", "2, 2"),
                       given::elastic("2", "0.25"),
                       {"Boundary left/Displacement", "0; free"},
                       {"Boundary bottom/Contact", "bilateral"}};
  entries.insert(entries.end(), more.begin(), more.end());
  return scene_of(entries);
}

/** A uniform state of stress, and the displacement of the upper right corner. */
struct Uniform
{
  double sigma_x, sigma_y, u_x, u_y;
};

void expect_uniform(const Scene<2> &scene, const Uniform &expected)
{
  const RandomMesh mesh(scene, 1, 2);
  const Laboratory discrete(scene, mesh);
  const Solution<2> solution = discrete.solve();
  double largest_x = 0, largest_y = 0;
  for (const auto &cell : solution.displacement_space.dof_handler().active_cell_iterators())
    for (const unsigned int v : cell->vertex_indices())
      if (cell->vertex(v).distance(Point<2>(2., 1.)) < 1e-12)
      {
        largest_x = solution.u[cell->vertex_dof_index(v, 0, cell->active_fe_index())];
        largest_y = solution.u[cell->vertex_dof_index(v, 1, cell->active_fe_index())];
      }
  EXPECT_NEAR(largest_x, expected.u_x, 1e-11);
  EXPECT_NEAR(largest_y, expected.u_y, 1e-11);
  for (const ContactFace<2> &face : solution.contact_space.faces())
  {
    const ContactTraces<2> traces(face, 3, solution);
    for (unsigned int q = 0; q < 3; ++q)
    {
      EXPECT_NEAR(traces.sigma(q)[0][0], expected.sigma_x, 1e-10);
      EXPECT_NEAR(traces.sigma(q)[1][1], expected.sigma_y, 1e-10);
      EXPECT_NEAR(traces.sigma(q)[0][1], 0., 1e-10);
    }
  }
  // sigma : eps times the area 2
  const double a = 2 * (expected.sigma_x * expected.u_x / 2 + expected.sigma_y * expected.u_y);
  EXPECT_NEAR(internal_forces(scene, discrete.displacement_space, discrete.tables, solution.u)
                  .energy_product,
              a, 1e-11);
  EXPECT_LE(estimate_error(SolutionField(solution)).total(), 1e-9);
}

/** Confined: sigma_y = E (1-nu)/((1+nu)(1-2nu)) eps = 2.4 eps, sigma_x = nu/(1-nu) sigma_y. */
TEST(PlaneStrainPatch, ConfinedCompression)
{
  expect_uniform(block({{"Boundary right/Displacement", "0; free"},
                        {"Boundary top/Displacement", "free; -0.01"}}),
                 {-0.008, -0.024, 0., -0.01});
}

/** With free sides eps_y = (1-nu^2)/E sigma_y, eps_x = -nu(1+nu)/E sigma_y. */
TEST(PlaneStrainPatch, FreeSides)
{
  expect_uniform(block({{"Boundary top/Traction", "0; -0.32"}}), {0., -0.32, 0.1, -0.15});
}

/** `E eps_x = (1-nu^2) sigma_x - nu(1+nu) sigma_y`, and so for y. */
TEST(PlaneStrainPatch, TwoTractions)
{
  expect_uniform(
      block({{"Boundary top/Traction", "0; 0.32"}, {"Boundary right/Traction", "0.64; 0"}}),
      {0.64, 0.32, 0.5, 0.05});
}

// ---------------------------------------------------------------- stick meets slip

/**
 * Stress of StickSlip at the angle @p theta and distance 1 of the transition, without the constant
 * shear g; it grows like r^{1/2}. From Kolosov's formulas
 * `sigma_x + sigma_y = 4 Re phi'`, `sigma_y - sigma_x + 2 i sigma_xy = 2 (conj(z) phi'' + psi')` with
 * `phi = A (-z)^{3/2}`, `psi = -(kappa + 3/2) phi`.
 */
SymmetricTensor<2, 2> stress_at_distance_one(const double theta, const double A, const double kappa)
{
  const std::complex<double> root = std::polar(1., (theta - numbers::PI) / 2);
  const std::complex<double> deviator =
      2. * (0.75 * A * std::polar(1., -theta) / root + 1.5 * (kappa + 1.5) * A * root);
  const double sum = 4 * (-1.5 * A * root).real();
  SymmetricTensor<2, 2> sigma;
  sigma[0][0] = (sum - deviator.real()) / 2;
  sigma[1][1] = (sum + deviator.real()) / 2;
  sigma[0][1] = deviator.imag() / 2;
  return sigma;
}

/**
 * |u|_a^2 of StickSlip with c = 0 and L = 1 over (-1,1) x (0,1): on every ray sigma : eps is a
 * polynomial in r^{1/2}, integrated by hand up to the boundary; the angle is left to Gauss.
 */
double energy_of_stick_slip(const Material &material, const double kappa, const double g)
{
  const double A = g / (1.5 * (1 + kappa));
  SymmetricTensor<2, 2> shear;
  shear[0][1] = g;
  const auto product = [&](const SymmetricTensor<2, 2> &a, const SymmetricTensor<2, 2> &b)
  { return a * strain_of(b, material); };
  const QGauss<1> gauss(30);
  double energy = 0;
  for (unsigned int eighth = 0; eighth < 4; ++eighth) // the rays to the corners lie between
    for (unsigned int q = 0; q < gauss.size(); ++q)
    {
      const double theta = (eighth + gauss.point(q)[0]) * numbers::PI / 4;
      const double R = 1 / std::max(std::abs(std::cos(theta)), std::sin(theta));
      const SymmetricTensor<2, 2> sigma = stress_at_distance_one(theta, A, kappa);
      energy += gauss.weight(q) * numbers::PI / 4 *
                (product(shear, shear) * std::pow(R, 2) / 2 +
                 2 * product(sigma, shear) * std::pow(R, 2.5) / 2.5 +
                 product(sigma, sigma) * std::pow(R, 3) / 3);
    }
  return energy;
}

/** The number that is known for plane stress is found this way, too. */
TEST(PlaneStrain, EnergyByRaysIsThatByBoxesInPlaneStress)
{
  const Material material{1., 0.3, PlaneModel::stress};
  EXPECT_NEAR(energy_of_stick_slip(material, 2.7 / 1.3, 0.3), 0.37710185557, 1e-11);
}

using PlaneStrainScene = ::testing::TestWithParam<const char *>;

/** |u|_a^2, j(u) and the friction force, all from E = 1, nu and g = 0.3 alone. */
TEST_P(PlaneStrainScene, HasTheEnergiesOfTheClosedForm)
{
  const double nu = std::stod(GetParam()), g = 0.3, mu = 1 / (2 * (1 + nu)), kappa = 3 - 4 * nu;
  const Material material{1., nu, PlaneModel::strain};
  const double a = energy_of_stick_slip(material, kappa, g);
  // int g (kappa A/mu) (-x)^{3/2} over the slip zone
  const double friction = 4. / 15 * kappa * g * g / (mu * (1 + kappa));
  unsigned int n_steps = 0;
  each_step<2>(shipped_scene("plane-strain", {{"Material/Poisson's ratio", GetParam()}}),
               [&](const StepReport<2> &step)
               {
                 ++n_steps;
                 EXPECT_NEAR(std::pow(step.errors.energy_norm, 2), a, 1e-12);
                 EXPECT_NEAR(step.errors.reference_energy, 0.5 * a + friction, 1e-12);
                 if (step.stopped_by.empty())
                   return;
                 const Energies &e = step.energies;
                 EXPECT_LT(step.errors.energy, 1e-6);
                 EXPECT_NEAR(e.norm * e.norm, a, 1e-6);
                 EXPECT_NEAR(e.energy - 0.5 * e.norm * e.norm, friction, 1e-6); // no load works
                 EXPECT_NEAR(step.contact.at(0).friction_resultant, -4. / 3 * g,
                             1e-6); // lambda = 1, then 1 - sqrt(x)
               });
  EXPECT_GE(n_steps, 15u);
}

INSTANTIATE_TEST_SUITE_P(, PlaneStrainScene, ::testing::Values("0.4", "0.3"),
                         [](const auto &info) { return std::string("Nu") + (info.param + 2); });
} // namespace
