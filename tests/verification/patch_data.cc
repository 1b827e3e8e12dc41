// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>
#include <hpvi/bound/patch_data.h>

#include <cmath>
#include <random>

namespace
{
using namespace dealii;
using namespace hpvi;

/** A skew parallelogram three times as long as wide, and an element with a free corner and more than a cell of degree p needs. */
struct Cell
{
  static constexpr double h = 0.35;
  Tensor<2, 2> B{{{1.7, 0.4}, {0., 1. / 1.7}}};
  Material material;
  const unsigned int p, m;
  const StressElement element;

  Cell(const unsigned int p, const unsigned int marked)
      : material{3., 0.3}, p(p), m(p + 3), element(m, B, material, marked)
  {
  }

  /** Of displacements with random values at nodes. */
  Modes<3> stress(const LegendreTables &legendre) const
  {
    std::mt19937 random(p);
    std::uniform_real_distribution<double> values(-1., 1.);
    std::vector<double> coefficients(2 * (p + 1) * (p + 1));
    for (double &coefficient : coefficients)
      coefficient = values(random);
    return stress_modes({p, B, h, &material}, coefficients, m + 1, legendre);
  }
};

using DataOfStress = ::testing::TestWithParam<unsigned int>;

/** Data of modes times modes are those of stress and force, whatever corners are free. */
TEST_P(DataOfStress, AreLinear)
{
  const LegendreTables legendre;
  for (const unsigned int marked : {0U, 5U})
  {
    const Cell cell(GetParam(), marked);
    CellStress stress{cell.stress(legendre), Modes<2>(marked == 0 ? 0 : cell.p + 2)};
    for (unsigned int k = 0; k < stress.force.coefficients.size(); ++k)
      stress.force.coefficients[k] = std::sin(k + 1.);
    const PatchData own = patch_data(cell.element, {stress}),
                    of_modes = data_of_modes(cell.element, cell.p, stress.force.n);
    std::vector<double> modes;
    append_modes(stress, cell.p, modes);
    ASSERT_EQ(modes.size(), n_modes(cell.p, stress.force.n));
    const auto expect_sum = [&](const std::vector<double> &expected, const std::vector<double> &all)
    {
      ASSERT_EQ(all.size(), expected.size() * modes.size());
      double largest = 0;
      for (const double value : expected)
        largest = std::max(largest, std::abs(value));
      EXPECT_GT(largest, 0.1);
      for (unsigned int i = 0; i < expected.size(); ++i)
      {
        double sum = 0;
        for (unsigned int k = 0; k < modes.size(); ++k)
          sum += all[k * expected.size() + i] * modes[k];
        EXPECT_NEAR(sum, expected[i], 1e-12 * largest) << i;
      }
    };
    expect_sum(own.r, of_modes.r);
    expect_sum(own.sides, of_modes.sides);
  }
}

/** A cell has the same data beside others, and those of stress and force are those of either. */
TEST_P(DataOfStress, AreThoseOfOneCell)
{
  const LegendreTables legendre;
  const Cell cell(GetParam(), 2);
  const Modes<3> sigma = cell.stress(legendre);
  Modes<2> force(cell.p + 1);
  for (double &coefficient : force.coefficients)
    coefficient = 0.3 - coefficient;
  const PatchData all =
      patch_data(cell.element, {{sigma, force}, {sigma, Modes<2>()}, {Modes<3>(), force}});
  const std::size_t n_r = cell.element.n_data, n_sides = all.sides.size() / 3;
  ASSERT_EQ(all.r.size(), 3 * n_r);
  for (std::size_t i = 0; i < n_r; ++i)
    EXPECT_NEAR(all.r[i], all.r[n_r + i] + all.r[2 * n_r + i], 1e-12);
  for (std::size_t i = 0; i < n_sides; ++i)
    EXPECT_NEAR(all.sides[i], all.sides[n_sides + i] + all.sides[2 * n_sides + i], 1e-11);
}

INSTANTIATE_TEST_SUITE_P(Degrees, DataOfStress, ::testing::Values(2U, 3U, 6U));
} // namespace
