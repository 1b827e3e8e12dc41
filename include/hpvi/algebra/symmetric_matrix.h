// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_symmetric_matrix_h
#define hpvi_symmetric_matrix_h

#include <cstddef>
#include <vector>

namespace hpvi
{
/** The upper triangle of a sparse symmetric matrix by compressed columns, rows in any order. */
struct SymmetricMatrix
{
  std::vector<int> column_start{0}; ///< size n + 1
  std::vector<int> row;             ///< of each entry, <= its column
  std::vector<double> value;

  /**
   * Make room for @p n_entries. Throws NumericalFailure where they are more than an index can count,
   * or than there is memory for.
   */
  void reserve(std::size_t n_entries);

  void resize(std::size_t n_entries); ///< likewise, and have them, new ones zero

  unsigned int n() const
  {
    return column_start.size() - 1;
  }
};
} // namespace hpvi

#endif
