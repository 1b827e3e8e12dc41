// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef hpvi_contact_table_h
#define hpvi_contact_table_h

#include <hpvi/discretisation/solution.h>

#include <string>

namespace hpvi
{
/** `contact-NN.csv`: traces at the Gauss points of the contact faces, sorted along the tangent. */
template <int dim>
std::string contact_table(const Solution<dim> &solution, const ShapeTables<dim> &tables);
} // namespace hpvi

#endif
