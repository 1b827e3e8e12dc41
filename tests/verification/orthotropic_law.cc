// SPDX-License-Identifier: LGPL-2.1-or-later
// Hooke's law of orthotropic materials, beside tensors of fourth order that are turned component by component.
#include <gtest/gtest.h>
#include <hpvi/results/stress_extrema.h>
#include <hpvi/scene/material.h>

#include <cmath>
#include <limits>
#include <random>

using namespace dealii;
using namespace hpvi;

namespace
{
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
using Compliance = Tensor<4, 3>; ///< eps_ij = S_ijkl sigma_kl

/** In the axes of the material, from engineering constants. */
Compliance own_compliance(const Orthotropy &m)
{
  Compliance S;
  for (unsigned int i = 0; i < 3; ++i)
    S[i][i][i][i] = 1 / m.young[i];
  const auto set = [&](const unsigned int i, const unsigned int j, const double nu, const double G)
  {
    S[i][i][j][j] = S[j][j][i][i] = -nu / m.young[i];
    S[i][j][i][j] = S[i][j][j][i] = S[j][i][i][j] = S[j][i][j][i] = 1 / (4 * G);
  };
  set(0, 1, m.poisson[0], m.shear);
  set(0, 2, m.poisson[1], m.shear_across[0]); // nobody asks for these in the plane
  set(1, 2, m.poisson[2], m.shear_across[1]);
  return S;
}

/** In the frame in which its axes are the columns of @p R. */
Compliance turned(const Compliance &S, const Tensor<2, 3> &R)
{
  Compliance result;
  for (unsigned int n = 0; n < 6561; ++n)
  {
    const auto digit = [n](const unsigned int place)
    { return n / static_cast<unsigned int>(std::pow(3, place) + 0.5) % 3; };
    result[digit(0)][digit(1)][digit(2)][digit(3)] +=
        R[digit(0)][digit(4)] * R[digit(1)][digit(5)] * R[digit(2)][digit(6)] *
        R[digit(3)][digit(7)] * S[digit(4)][digit(5)][digit(6)][digit(7)];
  }
  return result;
}

Compliance turned(const Compliance &S, const double degrees)
{
  const double angle = degrees * numbers::PI / 180;
  Tensor<2, 3> R;
  R[0][0] = R[1][1] = std::cos(angle);
  R[1][0] = std::sin(angle);
  R[0][1] = -R[1][0];
  R[2][2] = 1;
  return turned(S, R);
}

/** Strain in the plane of a stress there, and the stress across it that keeps eps_zz = 0 in plane strain. */
struct Response
{
  SymmetricTensor<2, 2> strain;
  double transverse = 0;

  Response(const Compliance &S, const SymmetricTensor<2, 2> &sigma, const PlaneModel plane)
  {
    for (unsigned int k = 0; k < 2 && plane == PlaneModel::strain; ++k)
      for (unsigned int l = 0; l < 2; ++l)
        transverse -= S[2][2][k][l] * sigma[k][l] / S[2][2][2][2];
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int j = i; j < 2; ++j)
      {
        strain[i][j] = S[i][j][2][2] * transverse;
        for (unsigned int k = 0; k < 2; ++k)
          for (unsigned int l = 0; l < 2; ++l)
            strain[i][j] += S[i][j][k][l] * sigma[k][l];
      }
  }
};

class Dice
{
public:
  double operator()(const double low, const double high)
  {
    return std::uniform_real_distribution<double>(low, high)(random);
  }

  template <int rank, int dim = 2>
  Tensor<rank, dim> tensor()
  {
    Tensor<rank, dim> result;
    for (unsigned int i = 0; i < Tensor<rank, dim>::n_independent_components; ++i)
      result[Tensor<rank, dim>::unrolled_to_component_indices(i)] = (*this)(-1, 1);
    return result;
  }

  /** Elastic in both planes, with nothing that isotropic formulas could use. */
  Material material(const PlaneModel plane)
  {
    Material result{no_number, no_number, plane};
    do
    {
      Orthotropy own;
      for (unsigned int i = 0; i < 3; ++i)
      {
        own.young[i] = std::pow(10, (*this)(-1.5, 1.5));
        own.poisson[i] = (*this)(-1, 1);
      }
      own.shear = std::pow(10, (*this)(-1.5, 1.));
      own.angle = (*this)(-360, 360);
      own.shear_across = {{std::pow(10, (*this)(-1.5, 1.)), std::pow(10, (*this)(-1.5, 1.))}};
      own.axes = {{tensor<1, 3>(), tensor<1, 3>()}};
      result.orthotropy = own;
    } while (result.orthotropy->flaw(PlaneModel::strain));
    return result;
  }

private:
  std::mt19937 random{5};
};

template <class Test>
void for_each_material(const Test &test)
{
  Dice dice;
  for (const PlaneModel plane : {PlaneModel::stress, PlaneModel::strain})
    for (unsigned int n = 0; n < 40; ++n)
      test(dice.material(plane), dice);
}

/** How much may be lost: the law is C, the inverse of S. */
double tolerance(const Material &material, const int dim = 2)
{
  return 1e-13 * (1 + material.locking_ratio(dim));
}

/** Axis 1, what is left of the second vector, and what is at right angles to both. */
Tensor<2, 3> frame_of(const std::array<Tensor<1, 3>, 2> &axes)
{
  const Tensor<1, 3> first = axes[0] / axes[0].norm(), rest = axes[1] - (axes[1] * first) * first,
                     second = rest / rest.norm(), third = cross_product_3d(first, second);
  Tensor<2, 3> R;
  for (unsigned int d = 0; d < 3; ++d)
    R[d] = Tensor<1, 3>({first[d], second[d], third[d]});
  return R;
}
} // namespace

TEST(OrthotropicLaw, IsTheTurnedTensor)
{
  for_each_material(
      [](const Material &material, Dice &dice)
      {
        const SymmetricTensor<2, 2> sigma = symmetrize(dice.tensor<2>());
        const Response expected(
            turned(own_compliance(*material.orthotropy), material.orthotropy->angle), sigma,
            material.plane);
        const HookesLaw<2> law(material);
        EXPECT_LT((law.stress(Tensor<2, 2>(expected.strain)) - sigma).norm(), tolerance(material));
        EXPECT_NEAR(law.complementary_product(sigma, sigma), expected.strain * sigma,
                    1e-13 * expected.strain.norm());
        EXPECT_NEAR(material.transverse_stress(sigma), expected.transverse,
                    1e-13 * (1 + std::abs(expected.transverse)));
        SymmetricTensor<2, 3> full;
        full[0][0] = sigma[0][0], full[1][1] = sigma[1][1], full[0][1] = sigma[0][1];
        full[2][2] = expected.transverse;
        EXPECT_NEAR(von_mises<2>(material, sigma), std::sqrt(1.5) * deviator(full).norm(), 1e-12);
      });
}

/** What expands without stress in the plane, held across it in plane strain. */
TEST(OrthotropicLaw, InitialStrainsAreThoseOfTheTurnedTensor)
{
  for_each_material(
      [](const Material &material, Dice &dice)
      {
        const Compliance S =
            turned(own_compliance(*material.orthotropy), material.orthotropy->angle);
        const PlaneStrain initial{{dice(-1, 1), dice(-1, 1), dice(-1, 1), dice(-1, 1)}};
        const double across =
            material.plane == PlaneModel::strain ? -initial[3] / S[2][2][2][2] : 0.;
        SymmetricTensor<2, 2> expected;
        expected[0][0] = initial[0] + S[0][0][2][2] * across;
        expected[1][1] = initial[1] + S[1][1][2][2] * across;
        expected[0][1] = initial[2] + S[0][1][2][2] * across;
        EXPECT_LT((material.in_plane(initial) - expected).norm(), 1e-13 * (1 + expected.norm()));
        EXPECT_NEAR(material.transverse_stress(SymmetricTensor<2, 2>(), initial[3]), across,
                    1e-13 * (1 + std::abs(across)));
      });
}

TEST(OrthotropicLaw, AgreesWithItself)
{
  for_each_material(
      [](const Material &material, Dice &dice)
      {
        const HookesLaw<2> law(material);
        const Tensor<2, 2> one = dice.tensor<2>(), other = dice.tensor<2>();
        const SymmetricTensor<2, 2> s = law.stress(one), t = symmetrize(other);
        const double scale = tolerance(material) * s.norm();
        EXPECT_NEAR(law.energy_product(one), s * symmetrize(one), scale);
        EXPECT_NEAR(law.complementary_product(s, t), symmetrize(one) * t, tolerance(material));
        EXPECT_NEAR(law.complementary_product(Tensor<2, 2>(s), Tensor<2, 2>(t)),
                    law.complementary_product(s, t), tolerance(material));
        EXPECT_NEAR(s * symmetrize(other), law.stress(other) * symmetrize(one), scale);
        const Tensor<1, 2> n = dice.tensor<1>();
        EXPECT_LT((law.traction(one, n) - s * n).norm(), scale);
      });
}

namespace
{
template <int dim>
void expect_stiffness_and_divergence(const Material &material, Dice &dice)
{
  const HookesLaw<dim> law(material);
  const Tensor<1, dim> phi = dice.tensor<1, dim>(), psi = dice.tensor<1, dim>(); // gradients
  for (unsigned int c = 0; c < dim; ++c)
    for (unsigned int d = 0; d < dim; ++d)
    {
      Tensor<2, dim> one, other;
      one[c] = phi;
      other[d] = psi;
      EXPECT_NEAR(law.stiffness([&](const unsigned int a, const unsigned int b)
                                { return phi[a] * psi[b]; },
                                c, d),
                  law.stress(one) * symmetrize(other), 1e-13 * law.stress(one).norm());
    }
  Tensor<3, dim> second = dice.tensor<3, dim>();
  for (unsigned int i = 0; i < dim; ++i)
    for (unsigned int j = 0; j < dim; ++j)
      for (unsigned int k = 0; k < j; ++k)
        second[i][j][k] = second[i][k][j];
  Tensor<1, dim> expected;
  for (unsigned int k = 0; k < dim; ++k) // d sigma/d x_k e_k
  {
    Tensor<2, dim> slope;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        slope[i][j] = second[i][j][k];
    for (unsigned int i = 0; i < dim; ++i)
      expected[i] += law.stress(slope)[i][k];
  }
  EXPECT_LT((law.divergence_of_stress(second) - expected).norm(),
            1e-12 * expected.norm() + tolerance(material, dim));
}

template <int dim>
void expect_extreme_stiffnesses(const Material &material, Dice &dice)
{
  const HookesLaw<dim> law(material);
  const double c = material.coercivity(dim), most = c * (1 + material.locking_ratio(dim));
  double least = std::numeric_limits<double>::max(), largest = 0;
  SymmetricTensor<2, dim> softest = symmetrize(dice.tensor<2, dim>()), stiffest = softest;
  for (unsigned int k = 0; k < 400; ++k) // power iterations
  {
    stiffest = law.stress(Tensor<2, dim>(stiffest));
    stiffest /= stiffest.norm();
    softest = most * softest - law.stress(Tensor<2, dim>(softest));
    softest /= softest.norm();
    for (const auto &strain : {stiffest, softest})
    {
      least = std::min(least, law.energy_product(Tensor<2, dim>(strain)));
      largest = std::max(largest, law.energy_product(Tensor<2, dim>(strain)));
    }
  }
  EXPECT_GE(least, c * (1 - 1e-12) - 1e-14 * most);
  EXPECT_LE(least, 1.3 * c + 1e-2 * most);
  EXPECT_NEAR(largest, most, 1e-2 * most);
}
} // namespace

TEST(OrthotropicLaw, StiffnessAndDivergenceAreThoseOfItsStress)
{
  for_each_material(
      [](const Material &material, Dice &dice)
      {
        expect_stiffness_and_divergence<2>(material, dice);
        expect_stiffness_and_divergence<3>(material, dice);
      });
}

/** Both are attained: by strains of all directions and shares. */
TEST(OrthotropicLaw, CoercivityIsTheLeastStiffness)
{
  for_each_material(
      [](const Material &material, Dice &dice)
      {
        expect_extreme_stiffnesses<2>(material, dice);
        expect_extreme_stiffnesses<3>(material, dice);
      });
}

TEST(OrthotropicLaw, InSpaceIsTheTurnedTensor)
{
  for_each_material(
      [](const Material &material, Dice &dice)
      {
        const Compliance S =
            turned(own_compliance(*material.orthotropy), frame_of(material.orthotropy->axes));
        const SymmetricTensor<2, 3> sigma = symmetrize(dice.tensor<2, 3>()),
                                    other = symmetrize(dice.tensor<2, 3>());
        const Tensor<2, 3> strain = double_contract<2, 0, 3, 1>(S, Tensor<2, 3>(sigma));
        const HookesLaw<3> law(material);
        const double small = tolerance(material, 3);
        EXPECT_LT((law.stress(strain) - sigma).norm(), small);
        EXPECT_NEAR(law.energy_product(strain), scalar_product(strain, sigma),
                    small * strain.norm());
        EXPECT_NEAR(law.complementary_product(sigma, other), scalar_product(strain, other),
                    1e-13 * strain.norm());
      });
}

/** Jones's inequalities beside eigenvalues. */
TEST(OrthotropicLaw, FlawsAreNegativeEigenvalues)
{
  Dice dice;
  unsigned int n_flawed = 0, n_sound = 0;
  for (unsigned int n = 0; n < 2000; ++n)
  {
    Orthotropy own;
    for (unsigned int i = 0; i < 3; ++i)
    {
      own.young[i] = std::pow(10, dice(-1, 1));
      own.poisson[i] = dice(-1.5, 1.5);
    }
    SymmetricTensor<2, 3> S;
    for (unsigned int i = 0; i < 3; ++i)
      S[i][i] = 1 / own.young[i];
    S[0][1] = -own.poisson[0] / own.young[0];
    S[0][2] = -own.poisson[1] / own.young[0];
    S[1][2] = -own.poisson[2] / own.young[1];
    const double in_plane = S[0][0] * S[1][1] - S[0][1] * S[0][1];
    EXPECT_EQ(own.flaw(PlaneModel::stress).has_value(), in_plane <= 0);
    const double least = eigenvalues(S)[2];
    EXPECT_EQ(own.flaw(PlaneModel::strain).has_value(), least <= 0) << least;
    ++(least > 0 ? n_sound : n_flawed);
  }
  EXPECT_GT(n_flawed, 200u);
  EXPECT_GT(n_sound, 200u);
}

TEST(OrthotropicLaw, EqualModuliAreIsotropic)
{
  Dice dice;
  for (const PlaneModel plane : {PlaneModel::stress, PlaneModel::strain})
    for (const double nu : {-0.3, 0., 0.3, 0.49})
    {
      const Material isotropic{3., nu, plane};
      Material same{no_number, no_number, plane};
      same.orthotropy = Orthotropy{{{3, 3, 3}}, {{nu, nu, nu}}, isotropic.mu(), 33.};
      ASSERT_FALSE(same.flaw());
      EXPECT_NEAR(same.residual_weight(), isotropic.residual_weight(), 1e-14);
      EXPECT_NEAR(same.modulus(2), isotropic.modulus(2), 1e-14);
      EXPECT_NEAR(same.coercivity(2), isotropic.coercivity(2), 1e-12);
      const double ratio = isotropic.locking_ratio(2);
      EXPECT_NEAR(same.locking_ratio(2), nu < 0 ? -ratio / (1 + ratio) : ratio,
                  1e-12 * (1 + ratio));
      const Tensor<2, 2> gradient = dice.tensor<2>();
      const SymmetricTensor<2, 2> sigma = HookesLaw<2>(isotropic).stress(gradient);
      EXPECT_LT((HookesLaw<2>(same).stress(gradient) - sigma).norm(), 1e-12 * sigma.norm());
      EXPECT_NEAR(von_mises<2>(same, sigma), von_mises<2>(isotropic, sigma), 1e-12 * sigma.norm());
      same.orthotropy->shear_across = {{isotropic.mu(), isotropic.mu()}};
      same.orthotropy->axes = {{dice.tensor<1, 3>(), dice.tensor<1, 3>()}};
      EXPECT_NEAR(same.coercivity(3), isotropic.coercivity(3), 1e-12);
      const Tensor<2, 3> in_space = dice.tensor<2, 3>();
      const SymmetricTensor<2, 3> stress = HookesLaw<3>(isotropic).stress(in_space);
      EXPECT_LT((HookesLaw<3>(same).stress(in_space) - stress).norm(), 1e-12 * stress.norm());
      const PlaneStrain heated{{0.1, 0.1, 0, 0.1}};
      EXPECT_LT((same.in_plane(heated) - isotropic.in_plane(heated)).norm(), 1e-14);
    }
}

/** A multiple of 90 degrees is exact: no shear of 1e-17 couples to tension. */
TEST(OrthotropicLaw, QuarterTurnsAreExact)
{
  Material material{no_number, no_number, PlaneModel::strain};
  for (const double angle : {-360., -270., -90., 0., 90., 180., 360.})
  {
    material.orthotropy = Orthotropy{{{7, 2, 3}}, {{0.3, 0.2, 0.4}}, 1.3, angle};
    const VoigtMatrix S = material.orthotropy->compliance(PlaneModel::strain);
    EXPECT_EQ(S[0][2], 0.);
    EXPECT_EQ(S[1][2], 0.);
    EXPECT_EQ(S[0][0] < S[1][1], std::fmod(angle, 180.) == 0.);
  }
  for (const double length : {1e-150, 3., 1e150}) // axis 1 along -z, 2 along x, 3 along -y
  {
    material.orthotropy->axes = {{Tensor<1, 3>({0, 0, -length}), Tensor<1, 3>({length, 0, 0.})}};
    const Voigt<3> S = material.orthotropy->compliance_in_space();
    EXPECT_EQ(S[2][2], 1. / 7);
    EXPECT_EQ(S[0][0], 1. / 2);
    EXPECT_EQ(S[1][1], 1. / 3);
    EXPECT_EQ(S[0][2], -0.3 / 7);
    EXPECT_EQ(S[4][4], 1 / 1.3);
    for (unsigned int k = 3; k < 6; ++k)
      for (unsigned int l = 0; l < k; ++l)
        EXPECT_EQ(S[k][l], 0.);
  }
}

/** Fibres that rise to the right turn towards the load. */
TEST(OrthotropicLaw, TensionOffAxisShears)
{
  Material material{no_number, no_number, PlaneModel::stress};
  const SymmetricTensor<2, 2> tension = symmetrize(outer_product(Point<2>(1, 0), Point<2>(1, 0)));
  for (const double angle : {30., -30., 150.})
  {
    material.orthotropy = Orthotropy{{{100, 2, 2}}, {{0.3, 0.3, 0.3}}, 1., angle};
    const VoigtMatrix S = material.orthotropy->compliance(material.plane);
    EXPECT_EQ(S[2][0] < 0, angle == 30.) << angle;
    EXPECT_NEAR(material.transverse_stress(tension), 0., 0.);
  }
}

TEST(OrthotropicLaw, ModuliOfAnyUnitAreInverted)
{
  for (const double unit : {1e-100, 1e-60, 1., 1e60, 1e98})
  {
    Material material{no_number, no_number, PlaneModel::strain};
    material.orthotropy = Orthotropy{{{unit, 9 * unit, 2 * unit}}, {{0.1, 0.2, 0.3}}, unit, 20.};
    ASSERT_FALSE(material.flaw());
    const Tensor<2, 2> gradient({{1., 2.}, {3., 4.}});
    const SymmetricTensor<2, 2> s = HookesLaw<2>(material).stress(gradient);
    material.orthotropy = Orthotropy{{{1, 9, 2}}, {{0.1, 0.2, 0.3}}, 1, 20.};
    EXPECT_LT((s / unit - HookesLaw<2>(material).stress(gradient)).norm(), 1e-12);
  }
}

TEST(OrthotropicLaw, CodeMayNotSayWhatNoFileMay)
{
  const auto flaw = [](const Orthotropy &own)
  {
    Material material{1., 0.3, PlaneModel::strain};
    material.orthotropy = own;
    const auto flaw = material.flaw();
    return flaw ? flaw->entry : "";
  };
  EXPECT_EQ(flaw({{{1, 2, 3}}, {{0.1, 0.1, 0.1}}, 1, 0}), "");
  EXPECT_EQ(flaw({{{1, -2, 3}}, {{0.1, 0.1, 0.1}}, 1, 0}), "Young's moduli");
  EXPECT_EQ(flaw({{{1, 2, no_number}}, {{0.1, 0.1, 0.1}}, 1, 0}), "Young's moduli");
  EXPECT_EQ(flaw({{{1, 2, 3}}, {{0.1, no_number, 0.1}}, 1, 0}), "Poisson's ratios");
  EXPECT_EQ(flaw({{{1, 2, 3}}, {{0.1, 0.1, 0.1}}, 0, 0}), "Shear moduli");
  EXPECT_EQ(flaw({{{1, 2, 3}}, {{0.1, 0.1, 0.1}}, 1, no_number}), "Angle");
  EXPECT_EQ(flaw({{{1, 2, 3}}, {{0.1, 0.1, 0.1}}, 1, 0, {{1, -1}}}), "Shear moduli");
  const Tensor<1, 3> axis({1e-90, 2e-90, 0});
  EXPECT_EQ(flaw({{{1, 2, 3}}, {{0.1, 0.1, 0.1}}, 1, 0, {{1, 1}}, {{axis, -3e80 * axis}}}), "Axes");
  EXPECT_EQ(flaw({{{1, 2, 3}}, {{0.1, 0.1, 0.1}}, 1, 0, {{1, 1}}, {{axis, 0. * axis}}}), "Axes");
}
