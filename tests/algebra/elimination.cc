// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>
#include <hpvi/algebra/linear_solver.h>
#include <hpvi/algebra/supervariables.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <vector>

namespace
{
using namespace dealii;
using hpvi::EliminationHints;
using hpvi::LinearSolver;
using hpvi::Supervariables;
using hpvi::SymmetricMatrix;
using Numbers = std::vector<unsigned int>;

TEST(Supervariables, AreThoseOfTheSameSets)
{
  Supervariables supervariables(Numbers(6, 0));
  EXPECT_EQ(supervariables.numbers(), Numbers(6, 0));
  supervariables.split({1, 2, 4});
  supervariables.split({4, 5, 2});
  EXPECT_EQ(supervariables.numbers(), (Numbers{0, 1, 2, 0, 2, 3}));
  supervariables.split({0, 3}); // all of a number: nothing changes
  EXPECT_EQ(supervariables.numbers(), (Numbers{0, 1, 2, 0, 2, 3}));

  Supervariables known(Numbers{7, 7, 2, 2});
  known.split({0, 2});
  EXPECT_EQ(known.numbers(), (Numbers{0, 1, 2, 3}));
}

/** A grid of 12 x 12 nodes with one to four unknowns each, all of neighbours coupled. */
struct Grid
{
  static constexpr unsigned int n_nodes = 12;
  SymmetricMatrix A;
  EliminationHints hints;
  Numbers interface; ///< half of the first row

  Grid()
  {
    std::vector<Numbers> unknowns(n_nodes * n_nodes);
    unsigned int n = 0;
    for (unsigned int round = 0; round < 4; ++round) // those of a node do not follow one another
      for (unsigned int node = 0; node < unknowns.size(); ++node)
        if (round <= node % 4)
          unknowns[node].push_back(n++);
    std::vector<std::map<unsigned int, double>> columns(n);
    hints.supervariables.resize(n);
    hints.stage.resize(n);
    for (unsigned int node = 0; node < unknowns.size(); ++node)
      for (const unsigned int i : unknowns[node])
      {
        if (node < n_nodes && i % 2 == 0)
          interface.push_back(i);
        hints.supervariables[i] = node;
        hints.stage[i] = node % n_nodes == n_nodes / 2 ? 3 : node % 5 == 0 ? 1 : 0; // 2 has none
        for (const int x : {-1, 0, 1})
          for (const int y : {-1, 0, 1})
          {
            const unsigned int column = node % n_nodes + x, row = node / n_nodes + y;
            if (column < n_nodes && row < n_nodes)
              for (const unsigned int j : unknowns[row * n_nodes + column])
                if (j >= i)
                  columns[j][i] = i == j ? 100. : -1. / (1 + (i * j) % 7);
          }
      }
    std::sort(interface.begin(), interface.end());
    hints.supervariables = Supervariables(hints.supervariables).numbers();
    for (const auto &column : columns)
    {
      for (const auto &[row, value] : column)
      {
        A.row.push_back(row);
        A.value.push_back(value);
      }
      A.column_start.push_back(A.row.size());
    }
  }
};

/** Whatever is known of the matrix beforehand, the solution and the Schur complement are the same. */
TEST(Elimination, FactorsTheSameMatrixWithHints)
{
  const Grid grid;
  const unsigned int n = grid.A.n();
  const std::vector<hpvi::Stabilisation> stabilisation = {
      {{{grid.interface[0], 0.6}, {grid.interface[7], 0.8}}, 2.}, {{{grid.interface[1], 1.}}, 3.}};
  Vector<double> f(n);
  std::iota(f.begin(), f.end(), 1.);
  for (const bool are_kept : {false, true})
    for (const bool are_stabilised : {false, true})
    {
      const auto solver = [&](const EliminationHints &hints)
      {
        return LinearSolver(grid.A, are_kept ? grid.interface : Numbers(), 0.,
                            are_stabilised ? stabilisation : std::vector<hpvi::Stabilisation>(),
                            hints);
      };
      const LinearSolver plain = solver({});
      const Vector<double> x = plain.solve(f);
      for (const EliminationHints &hints :
           {grid.hints, EliminationHints{grid.hints.supervariables, {}}, {{}, grid.hints.stage}})
      {
        const LinearSolver hinted = solver(hints);
        Vector<double> difference = hinted.solve(f);
        difference -= x;
        EXPECT_LE(difference.linfty_norm(), 1e-13 * x.linfty_norm());
        if (!are_kept)
          continue;
        const unsigned int m = grid.interface.size();
        const auto complement = [&](const LinearSolver &of)
        {
          FullMatrix<double> S(m);
          for (unsigned int i = 0; i < m; ++i)
            for (unsigned int j = 0; j < m; ++j)
              for (unsigned int k = 0; k <= std::min(i, j); ++k)
                S(of.interface_order()[i], of.interface_order()[j]) +=
                    of.kept_factor()(i, k) * of.kept_factor()(j, k);
          return S;
        };
        FullMatrix<double> S = complement(hinted);
        S.add(-1., complement(plain));
        EXPECT_LE(S.linfty_norm(), 1e-12 * complement(plain).linfty_norm());
        EXPECT_EQ(
            std::set<unsigned int>(hinted.interface_order().begin(), hinted.interface_order().end())
                .size(),
            m);
      }
    }
}
} // namespace
