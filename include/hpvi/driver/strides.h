// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_strides_h
#define hpvi_strides_h

#include <hpvi/plane/mesh.h>
#include <hpvi/results/contact_state.h>

#include <functional>
#include <vector>

namespace hpvi
{
/** What a stride of hpa4 starts from: one solution. */
struct StrideStart
{
  const Scene<2> &scene;
  const dealii::Triangulation<2> &mesh;
  const Degrees &degrees;
  const std::vector<double> &eta;                      ///< by active cell
  std::function<double(unsigned int cell)> decay_rate; ///< of Legendre coefficients
  const std::vector<ContactState<2>> &contact;
};

/**
 * MARK of hpa4: refinements, one after the other, after which the indicator is expected to be @p part of what it is, each of which
 * bisects or raises p by what is expected of the cells that the one before has made. @p complete adds to the marks of a mesh what
 * another law asks for. Expected, and acted upon where eta_K is above its share `part * eta / sqrt(n)` of n cells, are
 *
 *     eta * exp(-0.8 b) of one degree more, where b > 0.8 is the decay rate,
 *     eta * 2^(-a) of a quarter at a singular point, a = 3/4 where sides or materials meet, 3/2 where a zone of contact ends,
 *     eta / 25, b = 1.2 of the other quarters; both have a degree less than the whole,
 *     eta / 12 of a quarter of a cell that is smooth, e^b - 1 twice as large.
 *
 * Singular points are those of the scene, ends of zones, and vertices about which all cells are rough. A cell that is rough for no such
 * reason is bisected once. An end of a zone is known to an eighth of its edge: cells at it are bisected no further. Cells of
 * @p unresolved are bisected, and once more their quarters at the boundary.
 */
Refinement stride(const StrideStart &start, double part, const Refinement &unresolved,
                  const std::function<void(const dealii::Triangulation<2> &, const Degrees &,
                                           Refinement &)> &complete);

/** Of the error, the part that a stride aims at, where @p needed of it, below 1, is wanted; 0: as little as can be. */
double part_of_stride(double needed);
} // namespace hpvi

#endif
