// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_contact_line_h
#define hpvi_contact_line_h

#include <hpvi/results/contact_history.h>

#include <string>
#include <vector>

namespace hpvi
{
/**
 * `contact-NN.vtu`: the points of `contact-NN.csv` in their order, in the plane joined by a line along each piece of a contact boundary.
 * Displacement and traction are vectors along the axes of the body, so that the line moves with it; `state` is 0 where contact is
 * open, 1 where it slips, 2 where it sticks; `weight` is what a point stands for, of an axisymmetric body around the axis;
 * `arc_length` runs along chords between the points, from the beginning of each boundary, over what lies between its pieces. At the
 * end of a load step it has the columns of `contact-history.csv`, of @p history.
 */
template <int dim>
std::string contact_line(const Scene<dim> &scene, const std::vector<ContactState<dim>> &contact,
                         unsigned int step, const std::vector<ContactHistory> &history = {});
} // namespace hpvi

#endif
