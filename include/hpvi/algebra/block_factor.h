// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_block_factor_h
#define hpvi_block_factor_h

#include <hpvi/algebra/block_cholesky.h>
#include <hpvi/algebra/pooled_matrix.h>

#include <memory>

namespace hpvi
{
/** The factor L of a symmetric matrix of some hundred rows, `A = L L'`, in little more memory than it has entries. */
class BlockFactor
{
public:
  BlockFactor() = default; ///< of no rows
  BlockFactor(const BlockCholesky &cholesky, MatrixPool &pool);

  unsigned int n() const
  {
    return size;
  }

  void solve(double *x) const; ///< `x := A^-1 x`

private:
  unsigned int size = 0;
  std::shared_ptr<double>
      entries; ///< block after block the inverse of its diagonal part and what is below
};
} // namespace hpvi

#endif
