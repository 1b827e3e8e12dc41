// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_supervariables_h
#define hpvi_supervariables_h

#include <vector>

namespace hpvi
{
/**
 * Unknowns 0, ..., n - 1 that have entries in the same places of a sparse matrix, as those of one edge have: what orders and analyses the
 * matrix needs only one of them. A matrix that is a sum of dense ones is known by their unknowns: those that occur in the same
 * ones are alike. (I. Duff, J. Reid, doi:10.1145/356044.356047.)
 */
class Supervariables
{
public:
  /** Unknowns of one number are alike so far. */
  explicit Supervariables(std::vector<unsigned int> numbers);

  /** Unknowns of @p some are not like others. Each is there once. */
  void split(const std::vector<unsigned int> &some);

  /** By unknown; counted as they are met. */
  std::vector<unsigned int> numbers() const;

private:
  std::vector<unsigned int> of; ///< by unknown: a number that those alike have, among others
  std::vector<unsigned int> last_split, moved; ///< by such a number: when, and where to
  unsigned int n_splits = 0;
};
} // namespace hpvi

#endif
