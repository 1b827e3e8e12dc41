// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_friction_patch_h
#define hpvi_friction_patch_h

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>
#include <hpvi/bound/edge_polynomial.h>

#include <vector>

namespace hpvi
{
/** One face of the patch of a vertex a: the data of l_a on it. */
struct PatchFace
{
  unsigned int face = 0, end = 0;
  double work = 0;                ///< int psi_a z_N
  double limit = 0;               ///< int psi_a g
  dealii::Vector<double> moments; ///< int psi_a g L_i
  dealii::FullMatrix<double> H;   ///< of 1/2 l'Hl - h'l, half of what is to be minimised
  dealii::Vector<double> h;
  EdgePolynomial l;
  double missing = 0; ///< this face's share of the work that g l_a leaves undone
  double slip = 0;    ///< 1 or -1 where all Gauss points of z_N slip that way
  bool leans = false; ///< is the end of slip on the face?

  /**
   * 1 or -1 where no other l does the work of z_N, or the face slips everywhere; else 0. There l below 1 would cost
   * int g (1 - l) |u_t|, of first order in what z_N misses of g; making up for that is of second.
   */
  double forced() const;
};

/**
 * Finds l on the one or two sides of the patch of a vertex, and what work it leaves undone: by a quadratic program
 * on those that no forced slip determines.
 */
void distribute(const std::vector<PatchFace *> &sides);
} // namespace hpvi

#endif
