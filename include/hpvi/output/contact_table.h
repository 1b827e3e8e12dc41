// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_contact_table_h
#define hpvi_contact_table_h

#include <hpvi/output/record.h>
#include <hpvi/results/contact_history.h>

#include <vector>

namespace hpvi
{
/**
 * Rows of `contact-NN.csv`: the points of each contact boundary, along its tangent; in space the tangential columns
 * are vectors along the axes of the body, with the suffixes _x, _y, _z.
 */
template <int dim>
std::vector<Record> contact_rows(const Scene<dim> &scene,
                                 const std::vector<ContactState<dim>> &contact);

/** Rows of `contact-history.csv`: what has happened at the points of each contact boundary, in the same order. */
template <int dim>
std::vector<Record> contact_history_rows(const Scene<dim> &scene,
                                         const std::vector<ContactHistory> &contact);

/** Its columns of numbers, of one point of a contact that wears by Archard's coefficient @p wear; 0: it does not. */
Record history_record(const PointHistory &point, double wear);
} // namespace hpvi

#endif
