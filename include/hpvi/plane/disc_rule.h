// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_disc_rule_h
#define hpvi_disc_rule_h

#include <hpvi/plane/cell_map.h>

#include <vector>

namespace hpvi
{
/** Points of the unit cell, each with the area of the body that it stands for [length^2]. */
struct DiscRule
{
  std::vector<dealii::Point<2>> points;
  std::vector<double> areas;
};

/**
 * For integrals over the part of a cell in the disc about @p centre with this @p radius; empty where there is none. That part
 * is cut into sectors from one point of the unit cell to each piece of its boundary, which is an edge of the cell or an arc
 * of the circle: with @p n_gauss points in each direction of a sector exact for polynomials up to the arcs, which are
 * so short that their error is that of round-off from about 6 points on.
 */
DiscRule disc_rule(const CellMap<2> &map, const dealii::Point<2> &centre, double radius,
                   unsigned int n_gauss);
} // namespace hpvi

#endif
