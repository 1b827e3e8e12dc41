// SPDX-License-Identifier: LGPL-2.1-or-later
#include "programs.h"

#include <hpvi/solvers/equality_constraints.h>

namespace
{
using namespace algebra;
using hpvi::EqualityConstraints;

/** Columns (3, 4) and (0, 10) of length 5 and 10. */
EqualityConstraints constraints(const Vector<double> &e, const Vector<double> &round_off = {})
{
  EqualityConstraints result{FullMatrix<double>(2, 2), e, round_off};
  result.G(0, 0) = 3.;
  result.G(1, 0) = 4.;
  result.G(1, 1) = 10.;
  return result;
}

TEST(EqualityConstraints, ImbalanceInPartsOfForces)
{
  // Forces 3 + 4 + 8 = 15 over 5 and 10 + 9 = 19 over 10: f = 3; gaps 1 and -1.
  EXPECT_NEAR(constraints(vec({8., 9.})).imbalance(vec({1., 1.}), vec({0., 0.}), 1e-10),
              1. / (5 * 3), 1e-15);
  EXPECT_EQ(constraints(vec({7., 10.})).imbalance(vec({1., 1.}), vec({0., 0.}), 1e-10), 0.);
  EXPECT_EQ(constraints(vec({0., 0.})).imbalance(vec({0., 0.}), vec({0., 0.}), 1e-10), 0.);
  EXPECT_TRUE(std::isnan(
      constraints(vec({8., 9.})).imbalance(vec({not_a_number, 1.}), vec({0., 0.}), 1e-10)));
}

/** Forces that are nothing but noise: f = 7e-20 / 5 beside noise 2 (3 + 4) and 20. */
TEST(EqualityConstraints, ImbalanceOfNoise)
{
  const Vector<double> z = vec({1e-20, 1e-20}), none = vec({0., 0.}), noise = vec({2., 2.});
  EXPECT_NEAR(constraints(none).imbalance(z, none, 1e-10), 1., 1e-12);
  EXPECT_NEAR(constraints(none).imbalance(z, noise, 1e-10), 7e-20 / 14, 1e-30);
  // The tolerance 1e-10 is reached where the gap is as large as the round-off of e.
  EXPECT_NEAR(constraints(none, vec({7e-20, 1e-10})).imbalance(z, none, 1e-10), 1e-10, 1e-18);
}

TEST(EqualityConstraints, RootOfAPenalty)
{
  FullMatrix<double> Gamma(2, 2), product(2, 2);
  Gamma(0, 0) = 4.;
  Gamma(1, 1) = 3.;
  Gamma(0, 1) = Gamma(1, 0) = 2.;
  const FullMatrix<double> L = hpvi::root_of(Gamma);
  L.mTmult(product, L);
  product.add(-1., Gamma);
  EXPECT_LE(product.frobenius_norm(), 1e-14);
  EXPECT_EQ(hpvi::root_of(FullMatrix<double>()).m(), 0u);
}
} // namespace
