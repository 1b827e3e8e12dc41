// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_corner_stress_h
#define hpvi_corner_stress_h

#include <array>
#include <vector>

namespace hpvi
{
/**
 * The additional stress of a marked corner of a StressElement of degree @p m at xi, eta in [-1,1]: xx, yy, xy in the
 * frame of the cell.
 */
std::array<double, 3> corner_stress(unsigned int m, unsigned int corner, double xi, double eta);

/** A point of [-1,1]^2 with its weight. */
struct CornerPoint
{
  double xi, eta, weight;
};

/** Points with the same xi, or the same eta. */
struct CornerLine
{
  bool has_one_xi;
  std::vector<CornerPoint> points;
};

/** A rule for integrals with corner stresses, line by line: in each quarter Duffy's, collapsed into the corner. */
std::vector<CornerLine> corner_lines(unsigned int n_gauss);
} // namespace hpvi

#endif
