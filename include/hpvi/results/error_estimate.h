// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_error_estimate_h
#define hpvi_error_estimate_h

#include <mpi.h>

#include <vector>

namespace hpvi
{
/**
 * Squared contributions to eta_K^2, by active cell index, zero on cells of other processes; unit stress^2
 * length^dim.
 */
struct ErrorEstimate
{
  std::vector<double> volume;  ///< h_K^2/p_K^2 |r_K|^2
  std::vector<double> jumps;   ///< h_K/p_K |R_E|^2 over interior edges
  std::vector<double> neumann; ///< h_K/p_K |R_E|^2 over Gamma_N
  std::vector<double> contact; ///< h_K/p_K |R_E|^2 over Gamma_C, of the tangential traction
  /** Of unilateral contact, with T_Nn = -lambda_Nn; empty without it: */
  std::vector<double> normal;      ///< h_K/p_K |sigma_n - G_n + lambda_Nn|^2
  std::vector<double> penetration; ///< mu^2 p_K/h_K |max(u_Nn - u_0, 0)|^2
  std::vector<double> tension;     ///< h_K/p_K |min(lambda_Nn, 0)|^2
  /**
   * Of Coulomb friction, empty without it: `h_K/p_K |max(|lambda_Nt| - mu_f max(lambda_Nn, 0), 0)|^2`,
   * what friction exceeds between the points at which its law holds (Hild & Lleras, SIAM J. Numer.
   * Anal. 47, 2009, p. 3550).
   */
  std::vector<double> excess;

  /** eta_K of (4.50). */
  double indicator(unsigned int cell) const;

  std::vector<double> indicators() const; ///< eta_K by active cell index

  /** eta = (sum_K eta_K^2)^{1/2}; the print of (4.51) lacks the square. */
  double total() const;
};

/** Roots of the sums of its parts over the cells of all processes; 0 for those that are empty. */
struct EstimateNorms
{
  double volume = 0, jumps = 0, neumann = 0, contact = 0;
  double normal = 0, penetration = 0, tension = 0, excess = 0;
  double total = 0; ///< eta
};

EstimateNorms norms(const ErrorEstimate &estimate, MPI_Comm communicator); ///< collective
} // namespace hpvi

#endif
