// SPDX-License-Identifier: LGPL-2.1-or-later
#include <hpvi/algebra/dense_algebra.h>
#include <hpvi/algebra/supernodal_solve.h>
#include <hpvi/algebra/triangular.h>
#include <hpvi/base/thread_pool.h>

#include <algorithm>
#include <vector>

namespace hpvi
{
namespace
{
/** The supernodes of a factor, each a dense block of columns. */
class Blocks
{
public:
  explicit Blocks(const cholmod_factor &L)
      : super(static_cast<const int *>(L.super)), pi(static_cast<const int *>(L.pi)),
        px(static_cast<const int *>(L.px)), rows(static_cast<const int *>(L.s)),
        x(static_cast<const double *>(L.x))
  {
  }

  int first_column(const int s) const
  {
    return super[s];
  }
  unsigned int n_columns(const int s) const
  {
    return super[s + 1] - super[s];
  }
  unsigned int n_below(const int s) const
  {
    return pi[s + 1] - pi[s] - n_columns(s);
  }
  const int *below(const int s) const ///< rows, ascending
  {
    return rows + pi[s] + n_columns(s);
  }

  /** Solves with the triangle; @p product: what is to be subtracted from the rows below. */
  void forward(const int s, double *const y, std::vector<double> &product) const
  {
    const unsigned int n = n_columns(s), m = n + n_below(s);
    product.resize(n_below(s));
    solve_triangular('N', n, 1, {x + px[s], m}, y + first_column(s), n);
    if (m > n)
      multiply('N', 'N', m - n, 1, n, 1., {x + px[s] + n, m}, {y + first_column(s), n}, 0.,
               product.data(), m - n);
  }

  void backward(const int s, double *const y, std::vector<double> &product) const
  {
    const unsigned int n = n_columns(s), m = n + n_below(s);
    product.resize(n_below(s));
    for (unsigned int i = 0; i < m - n; ++i)
      product[i] = y[below(s)[i]];
    if (m > n)
      multiply('T', 'N', n, 1, m - n, -1., {x + px[s] + n, m}, {product.data(), m - n}, 1.,
               y + first_column(s), n);
    solve_triangular('T', n, 1, {x + px[s], m}, y + first_column(s), n);
  }

private:
  const int *const super, *const pi, *const px, *const rows;
  const double *const x;
};

/** @p outside: what the subtree adds to the rows below its root, which are all that it adds to outside. */
void solve_forward(const Blocks &L, const std::vector<int> &subtree, double *const x,
                   std::vector<double> &outside)
{
  const int root = subtree.back(), end = L.first_column(root) + static_cast<int>(L.n_columns(root));
  outside.assign(L.n_below(root), 0.);
  std::vector<double> product;
  for (const int s : subtree)
  {
    L.forward(s, x, product);
    unsigned int place = 0;
    for (unsigned int i = 0; i < product.size(); ++i)
    {
      const int row = L.below(s)[i];
      if (row < end)
      {
        x[row] -= product[i];
        continue;
      }
      while (L.below(root)[place] < row)
        ++place;
      outside[place] += product[i];
    }
  }
}
} // namespace

void solve_forward(const cholmod_factor &L, const SharedSupernodes &shared, double *const x)
{
  const Blocks blocks(L);
  std::vector<std::vector<double>> outside(shared.subtrees.size());
  parallel_for_each(shared.subtrees.size(), 1,
                    [&](const unsigned int k)
                    { solve_forward(blocks, shared.subtrees[k], x, outside[k]); });
  for (unsigned int k = 0; k < outside.size(); ++k)
    for (unsigned int i = 0; i < outside[k].size(); ++i)
      x[blocks.below(shared.subtrees[k].back())[i]] -= outside[k][i];
  std::vector<double> product;
  for (const std::vector<int> &level : shared.above)
    for (const int s : level)
    {
      blocks.forward(s, x, product);
      for (unsigned int i = 0; i < product.size(); ++i)
        x[blocks.below(s)[i]] -= product[i];
    }
}

void solve_backward(const cholmod_factor &L, const SharedSupernodes &shared, double *const x)
{
  const Blocks blocks(L);
  std::vector<double> product;
  for (auto level = shared.above.rbegin(); level != shared.above.rend(); ++level)
    for (const int s : *level)
      blocks.backward(s, x, product);
  parallel_for_each(shared.subtrees.size(), 1,
                    [&](const unsigned int k)
                    {
                      std::vector<double> own;
                      for (auto s = shared.subtrees[k].rbegin(); s != shared.subtrees[k].rend();
                           ++s)
                        blocks.backward(*s, x, own);
                    });
}
} // namespace hpvi
