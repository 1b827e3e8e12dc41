// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_contact_trace_h
#define hpvi_contact_trace_h

#include <hpvi/bound/edge_polynomial.h>
#include <hpvi/plane/solution.h>
#include <hpvi/plane/unknowns.h>

#include <vector>

namespace hpvi
{
/** One component of the displacement on a contact face by the unknowns of the linear system; between two bodies of its jump. */
struct Trace
{
  std::vector<unsigned int> unknowns;
  dealii::FullMatrix<double> legendre; ///< coefficients x unknowns
  std::vector<double> u;               ///< those of u_Nt, or of u_Nn - u_0

  EdgePolynomial rest(const dealii::Vector<double> &w) const; ///< u minus that of w

  /** By more unknowns, from @p first on, with their coefficients: degree x unknowns. */
  void extend(const dealii::FullMatrix<double> &more, unsigned int first);
};

/** That of u_N along @p direction. @p legendre: coefficients of a polynomial from its values at the nodes of the face. */
Trace trace_of(const ContactFace<2> &face, const dealii::Tensor<1, 2> &direction,
               const Solution<2> &solution, const Unknowns<2> &unknowns,
               const dealii::FullMatrix<double> &legendre);
} // namespace hpvi

#endif
