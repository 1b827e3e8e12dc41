// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_dense_work_h
#define hpvi_dense_work_h

#include <cstddef>
#include <string>

namespace hpvi
{
/**
 * What the dense matrices of one step cost, from their sizes alone. It grows with the second and
 * third power of the unknowns on the contact boundary, however few there are inside the body.
 */
struct DenseWork
{
  std::size_t n_contact, n_multipliers;

  /** The most at once: L_cc, Y and S of SchurComplement; or Y, S and a solver's two copies of S. */
  double bytes() const;

  /**
   * The operations of L_cc and Y, S, and one factorisation of S, at 20 billion a second: what cores
   * of 2020 do, and about half of what they could, which leaves time for the quadratic program.
   */
  double seconds() const;

  std::string name() const; ///< for messages

  /** One line with these numbers where it takes more than a second, else empty. */
  std::string note() const;
};
} // namespace hpvi

#endif
